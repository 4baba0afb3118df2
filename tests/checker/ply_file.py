# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Reads PLY meshes, binary (little endian) or ascii, with texture coordinates s and t of vertices.

Vertices with the same `input_vertex` are one vertex. Other data are skipped; texture coordinates of corners
are refused.
"""
import struct

from vtu_file import LARGEST, Unreadable

_CODES = {'char': 'b', 'int8': 'b', 'uchar': 'B', 'uint8': 'B', 'short': 'h', 'int16': 'h',
          'ushort': 'H', 'uint16': 'H', 'int': 'i', 'int32': 'i', 'uint': 'I', 'uint32': 'I',
          'float': 'f', 'float32': 'f', 'double': 'd', 'float64': 'd'}
_FORMATS = ('ascii', 'binary_little_endian')


class PlyFile:
    """The content of a file. v: triples of doubles; vt: pairs, one per vertex of the file; vt_text: None,
    since these are doubles; faces: lists of pairs (index into v, index into vt)."""

    def __init__(self, data):
        end = data.find(b'end_header')
        if not data.startswith(b'ply') or end < 0:
            raise Unreadable('no PLY header')
        body = data[data.find(b'\n', end) + 1:]
        self.kind, elements = _header(data[:end].decode('latin-1').splitlines())
        take = _words(body) if self.kind == 'ascii' else _binary(body)
        try:
            tables = {name: [[_property(p, take) for p in properties] for _ in range(count)]
                      for name, count, properties in elements}
        except (struct.error, StopIteration, ValueError) as error:
            raise Unreadable('the body is cut off: %s' % error)
        names = {name: [p[-1] for p in properties] for name, _, properties in elements}
        self._read(tables.get('vertex', []), names.get('vertex', []), tables.get('face', []),
                   names.get('face', []))

    def _read(self, vertices, columns, faces, face_columns):
        if not {'x', 'y', 'z', 's', 't'} <= set(columns):
            raise Unreadable('vertices without x, y, z, s, t')
        pick = [columns.index(name) for name in 'xyzst']
        rows = [[float(row[k]) for k in pick] for row in vertices]
        if not all(abs(x) <= LARGEST for row in rows for x in row):
            raise Unreadable('a coordinate is not finite, or beyond %g' % LARGEST)
        names = [row[columns.index('input_vertex')] for row in vertices] \
            if 'input_vertex' in columns else list(range(len(rows)))
        self.vt, self.vt_text = [tuple(row[3:]) for row in rows], None
        self.v = [None] * (max(names, default=-1) + 1)
        if min(names, default=0) < 0:
            raise Unreadable('a negative input_vertex')
        for name, row in zip(names, rows):
            if self.v[name] not in (None, tuple(row[:3])):
                raise Unreadable('input_vertex %d lies in two places' % name)
            self.v[name] = tuple(row[:3])
        corners = next((k for k, name in enumerate(face_columns)
                        if name in ('vertex_indices', 'vertex_index')), None)
        if corners is None or not faces:
            raise Unreadable('no faces')
        self.faces = []
        for face in faces:
            if len(face[corners]) < 3 or any(not 0 <= c < len(rows) for c in face[corners]):
                raise Unreadable('face %d has too few corners, or one that is not there'
                                 % (len(self.faces) + 1))
            self.faces.append([(names[c], c) for c in face[corners]])


def _header(lines):
    """Returns (format, [(element, count, properties)]); a property: (type, name) or (count type, type, name)."""
    kind, elements = None, []
    for line in lines:
        words = line.split()
        if not words or words[0] in ('ply', 'comment', 'obj_info'):
            continue
        if words[0] == 'format':
            kind = words[1]
        elif words[0] == 'element':
            elements.append((words[1], int(words[2]), []))
        elif words[0] == 'property' and elements:
            types = words[2:-1] if words[1] == 'list' else words[1:-1]
            if not all(t in _CODES for t in types):
                raise Unreadable('property: ' + line)
            elements[-1][2].append(tuple(_CODES[t] for t in types) + (words[-1],))
        else:
            raise Unreadable('header: ' + line)
    if kind not in _FORMATS:
        raise Unreadable('format %s' % kind)
    return kind, elements


def _property(kinds, take):
    if len(kinds) == 2:
        return take(kinds[0])
    return [take(kinds[1]) for _ in range(take(kinds[0]))]


def _binary(body):
    place = 0

    def take(code):
        nonlocal place
        value, = struct.unpack_from('<' + code, body, place)
        place += struct.calcsize('<' + code)
        return value
    return take


def _words(body):
    words = iter(body.decode('latin-1').split())
    return lambda code: (float if code in 'fd' else int)(next(words))
