# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Reads VTK's XML unstructured grids: one triangle, Bezier or Lagrange triangle of one degree per cell.

Accepts inline base64 and ascii, appended raw and base64, UInt32 and UInt64 headers, both byte orders.
Everything else (compression, other cells, unequal rational weights, values that are not finite) is refused
with `Unreadable`: a checker that guesses proves nothing.
"""
import base64
import json
import re
import struct
import xml.etree.ElementTree as ElementTree

TRIANGLE, LAGRANGE_TRIANGLE, BEZIER_TRIANGLE = 5, 69, 76
LARGEST = 1e300  # Limit of coordinates, so that distances are finite.
_CODES = {'Float32': 'f', 'Float64': 'd', 'Int8': 'b', 'UInt8': 'B', 'Int16': 'h', 'UInt16': 'H',
          'Int32': 'i', 'UInt32': 'I', 'Int64': 'q', 'UInt64': 'Q'}


class Unreadable(Exception):
    """The error of a file that is damaged, or has content that this checker does not judge."""


class VtuFile:
    """The content of a file. positions, uv: one tuple of floats per point; cells: lists of point numbers in
    VTK's order; degree; is_lagrange: uv are values at lattice points; input_vertex: one int per point, or
    None; claims: the JSON of majorant_claims, or None.
    """

    def __init__(self, data):
        root, appended = _parse(data)
        if root.tag != 'VTKFile' or root.get('type') != 'UnstructuredGrid':
            raise Unreadable('not an unstructured grid')
        if root.get('compressor'):
            raise Unreadable('compressed')
        decoder = _Decoder(root, appended)
        self.positions, self.uv, self.cells, self.input_vertex = [], [], [], []
        types = []
        pieces = root.findall('UnstructuredGrid/Piece')
        if not pieces:
            raise Unreadable('no piece')
        for piece in pieces:
            types += self._read_piece(piece, decoder)
        if not self.cells:
            raise Unreadable('no cells')
        if len(self.input_vertex) != len(self.uv):
            self.input_vertex = None
        self.degree = _degree(types, self.cells)
        self.is_lagrange = types[0] == LAGRANGE_TRIANGLE
        self.claims = _claims(root)

    def _read_piece(self, piece, decoder):
        first = len(self.positions)
        points = _arrays(piece.find('Points'))
        position_array = next(iter(points.values()), None)
        if position_array is None:
            raise Unreadable('no points')
        positions = decoder.rows(position_array, (3,))
        data = piece.find('PointData')
        arrays = _arrays(data)
        if 'uv' not in arrays:
            raise Unreadable('no PointData uv')
        uv = [row[:2] for row in decoder.rows(arrays['uv'], (2, 3))]
        if len(uv) != len(positions) or len(uv) != _count(piece, 'NumberOfPoints'):
            raise Unreadable('%d points, %d uv' % (len(positions), len(uv)))
        if not all(abs(c) <= LARGEST for row in positions + uv for c in row):
            raise Unreadable('a coordinate is not finite, or beyond %g' % LARGEST)
        _refuse_rational(data, arrays, decoder)
        if 'input_vertex' in arrays:
            self.input_vertex += [int(v) for v in decoder.values(arrays['input_vertex'])]
        cells = _arrays(piece.find('Cells'))
        for name in ('connectivity', 'offsets', 'types'):
            if name not in cells:
                raise Unreadable('no cell ' + name)
        connectivity = decoder.values(cells['connectivity'])
        offsets = decoder.values(cells['offsets'])
        types = decoder.values(cells['types'])
        if len(types) != len(offsets) or len(types) != _count(piece, 'NumberOfCells'):
            raise Unreadable('%d cell types, %d offsets' % (len(types), len(offsets)))
        if any(not 0 <= p < len(uv) for p in connectivity):
            raise Unreadable('a cell has a point that is not there')
        begin = 0
        for end in offsets:
            if not begin < end <= len(connectivity):
                raise Unreadable('offsets do not fit the connectivity')
            self.cells.append([first + p for p in connectivity[begin:end]])
            begin = end
        if begin != len(connectivity):
            raise Unreadable('offsets do not fit the connectivity')
        degrees = _arrays(piece.find('CellData')).get('HigherOrderDegrees')
        if degrees is not None:
            sizes = {(d + 1) * (d + 2) // 2: d for d in range(1, 9)}
            for cell, row in zip(self.cells[-len(types):], decoder.rows(degrees, (3,))):
                if {row[0], row[1]} != {sizes.get(len(cell))}:
                    raise Unreadable('HigherOrderDegrees do not fit the cells')
        self.positions += positions
        self.uv += uv
        return types


def _count(piece, name):
    try:
        return int(piece.get(name, ''))
    except ValueError:
        raise Unreadable('no ' + name)


def _arrays(element):
    if element is None:
        return {}
    found = {}
    for array in element.findall('DataArray'):
        if array.get('Name') in found:
            raise Unreadable('two arrays named %s' % array.get('Name'))
        found[array.get('Name')] = array
    return found


def _refuse_rational(data, arrays, decoder):
    """Refuses rational cells: weights that are not all equal."""
    names = {data.get('RationalWeights'), 'RationalWeights'} & set(arrays)
    for name in names:
        if len(set(decoder.values(arrays[name]))) > 1:
            raise Unreadable('rational cells')


def _degree(types, cells):
    sizes = {len(cell) for cell in cells}
    kinds = set(types)
    if len(kinds) != 1 or len(sizes) != 1:
        raise Unreadable('cells of several kinds or degrees')
    size, kind = sizes.pop(), kinds.pop()
    if kind == TRIANGLE and size == 3:
        return 1
    for degree in range(1, 9):
        if kind in (BEZIER_TRIANGLE, LAGRANGE_TRIANGLE) and size == (degree + 1) * (degree + 2) // 2:
            return degree
    raise Unreadable('cells of type %d with %d points' % (kind, size))


def _claims(root):
    """Returns the claims, for listing only; None if there are none or they are not JSON."""
    for array in list(root.iter('DataArray')) + list(root.iter('Array')):  # VTK writes strings as Array
        if array.get('Name') == 'majorant_claims' and array.get('format') == 'ascii':
            try:
                return json.loads(bytes(map(int, (array.text or '').split())).rstrip(b'\0'))
            except (ValueError, RecursionError):
                return None
    return None


def _parse(data):
    """Returns the XML tree and the appended bytes (after the underscore), which need not be XML."""
    appended = None
    start = re.search(rb'<AppendedData\s+encoding="(\w+)"\s*>\s*_', data)
    if start:
        end = data.rfind(b'</AppendedData>')
        if end < start.end():
            raise Unreadable('appended data without an end')
        appended = start.group(1).decode(), data[start.end():end]
        data = data[:start.start()] + data[end + len(b'</AppendedData>'):]
    try:
        return ElementTree.fromstring(data), appended
    except ElementTree.ParseError as error:
        raise Unreadable('XML: %s' % error)


class _Decoder:
    def __init__(self, root, appended):
        self.order = {'LittleEndian': '<', 'BigEndian': '>'}.get(
            root.get('byte_order', 'LittleEndian'), '<')
        header = root.get('header_type', 'UInt32')
        if header not in ('UInt32', 'UInt64'):
            raise Unreadable('header type ' + header)
        self.header = self.order + _CODES[header]
        self.appended = appended

    def rows(self, array, widths):
        """Returns the values in tuples of NumberOfComponents, which must be one of `widths`."""
        try:
            width = int(array.get('NumberOfComponents', '1'))
        except ValueError:
            width = 0
        values = self.values(array)
        if width not in widths or len(values) % width:
            raise Unreadable('array %s has %d values in rows of %d'
                             % (array.get('Name'), len(values), width))
        return [tuple(values[i:i + width]) for i in range(0, len(values), width)]

    def values(self, array):
        code = _CODES.get(array.get('type'))
        if code is None:
            raise Unreadable('array of type %s' % array.get('type'))
        kind = array.get('format')
        try:
            if kind == 'ascii':
                convert = float if code in 'fd' else int
                values = [convert(word) for word in (array.text or '').split()]
                if code == 'f':  # the value that a reader of single precision gets
                    values = [struct.unpack('f', struct.pack('f', v))[0] for v in values]
                return values
            raw = self._bytes(array, kind)
            count = len(raw) // struct.calcsize(code)
            if count * struct.calcsize(code) != len(raw):
                raise Unreadable('array %s is cut off' % array.get('Name'))
            return list(struct.unpack('%s%d%s' % (self.order, count, code), raw))
        except (ValueError, struct.error, OverflowError) as error:
            raise Unreadable('array %s: %s' % (array.get('Name'), error))

    def _bytes(self, array, kind):
        width = struct.calcsize(self.header)
        if kind == 'binary':
            return self._sized(_base64((array.text or '').encode(), width), width, array)
        if kind != 'appended' or self.appended is None:
            raise Unreadable('array of format %s' % kind)
        encoding, data = self.appended
        offset = int(array.get('offset', ''))
        if not 0 <= offset <= len(data):
            raise Unreadable('array %s lies outside of the appended data' % array.get('Name'))
        if encoding == 'raw':
            size = self._size(data[offset:offset + width], width, array)
            return self._sized(data[offset:offset + width + size], width, array)
        if encoding == 'base64':
            rest = re.match(rb'[A-Za-z0-9+/=\s]*', data[offset:]).group()
            return self._sized(_base64(rest, width), width, array, 'more follows')
        raise Unreadable('appended data as %s' % encoding)

    def _size(self, raw, width, array):
        if len(raw) < width:
            raise Unreadable('array %s is cut off' % array.get('Name'))
        return struct.unpack(self.header, raw[:width])[0]

    def _sized(self, raw, width, array, rest=None):
        size = self._size(raw, width, array)
        if len(raw) - width < size or (rest is None and len(raw) - width != size):
            raise Unreadable('array %s has %d bytes, not %d'
                             % (array.get('Name'), len(raw) - width, size))
        return raw[width:width + size]


def _base64(text, width):
    """Returns the bytes of one array. Header and values may be encoded together or separately; the header
    then ends in padding."""
    text = b''.join(text.split())
    ahead = (width + 2) // 3 * 4
    if text[:ahead].endswith(b'='):
        head = base64.b64decode(text[:ahead], validate=True)
        text = text[ahead:]
    else:
        head = b''
    first = text.find(b'=')
    if first >= 0:
        text = text[:(first + 3) // 4 * 4]
    elif len(text) % 4:
        text = text[:len(text) // 4 * 4]
    return head + base64.b64decode(text, validate=True)
