#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Compares every texel of random bakes with a closed form.

Each trial draws a folded sheet of one to four flat panels. The sheet consists of triangles, quads, larger
polygons (some not convex) or all of these, and has a layout. A carrier has the same or other polygons on the
same sheet, as OBJ, PLY (text and binary), GLB or VTU, with and without texture coordinates, normals and
colours. The sheet is flat in each panel, so every value has a closed form in the panel's coordinates:
positions, normals, numbers of polygons, colours, distortion, images, and rows of a table by polygons,
vertices and corners. The command writes PNG of 8 and 16 bits, EXR and NPY. NumPy evaluates the form at every
texel whose centre lies in a chart, without the library. Some trials are `unwrap --bake`, whose images are
compared at all texels in its own layout.

Prints a Markdown table and each trial that differs; exit code 0 exactly if none does.

Sample runs:
  tests/campaigns/random_bakes.py --count 500
  tests/campaigns/random_bakes.py --first 137 --count 1 --keep findings      (repeats one trial)
"""
import argparse
import collections
import json
import math
import shutil
import struct
import sys
import tempfile
import zlib
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path += [str(ROOT / 'bench'), str(ROOT / 'tests/gltf')]
import common  # noqa: E402
from gltf_files import FLOAT, INDICES, Model, Reader, UBYTE, UINT, USHORT  # noqa: E402

MARGIN = 1e-7                                     # distance of texels from edges, in coordinates of the sheet
# distance from cuts within which images may differ by CUT_CODES
CUT_TEXELS = 3
CUT_CODES = 3.6
NUMBERS = {'position': 'xyz', 'normal': 'xyz', 'color': 'rgb', 'face': ['face'],
           'distortion': ['sigma_1', 'sigma_2', 'area_distortion', 'angle_distortion', 'stretch_l2', 'stretch_linf']}


# ------------------------------------------------------------------ images
def chunk(kind, data):
    return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))


def png_bytes(codes):
    """Returns a PNG of an array of uint8 or uint16, height x width x 1 to 4 channels."""
    height, width, channels = codes.shape
    rows = codes.astype(codes.dtype.newbyteorder('>')).reshape(height, -1)
    content = b''.join(b'\0' + row.tobytes() for row in rows)
    header = struct.pack('>IIBBBBB', width, height, 8 * codes.dtype.itemsize, (0, 4, 2, 6)[channels - 1], 0, 0, 0)
    return b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', header) + chunk(b'IDAT', zlib.compress(content)) + chunk(b'IEND', b'')


def read_png(content):
    """Returns the codes, height x width x channels, and the largest possible code."""
    at, data = 8, b''
    while at < len(content):
        size, kind = struct.unpack_from('>I4s', content, at)
        if kind == b'IHDR':
            width, height, bits, color = struct.unpack_from('>IIBB', content, at + 8)
        if kind == b'IDAT':
            data += content[at + 8:at + 8 + size]
        at += 12 + size
    channels, size = {0: 1, 4: 2, 2: 3, 6: 4}[color], bits // 8
    step, raw = channels * size, zlib.decompress(data)
    rows, before = [], bytearray(width * step)
    for y in range(height):
        line = raw[y * (width * step + 1):(y + 1) * (width * step + 1)]
        row = bytearray(line[1:])
        for i in range(len(row)):
            left, corner = (row[i - step], before[i - step]) if i >= step else (0, 0)
            up = before[i]
            paeth = min((left, up, corner), key=lambda c: abs(c - (left + up - corner)))
            row[i] = (row[i] + (0, left, up, (left + up) // 2, paeth)[line[0]]) & 255
        rows.append(bytes(row))
        before = row
    kind = '>u%d' % size
    return np.frombuffer(b''.join(rows), kind).reshape(height, width, channels).astype(float), 256 ** size - 1


def read_exr(content):
    """Returns {channel: height x width} of a file of scan lines with 32-bit floats, without compression or
    with ZIP."""
    at, head = 8, {}
    def text():
        nonlocal at
        end = content.index(b'\0', at)
        word, at = content[at:end], end + 1
        return word
    while content[at]:
        name, _ = text(), text()
        size, = struct.unpack_from('<i', content, at)
        head[name], at = content[at + 4:at + 4 + size], at + 4 + size
    at += 1
    names, place = [], 0
    while head[b'channels'][place]:
        end = head[b'channels'].index(b'\0', place)
        names.append(head[b'channels'][place:end].decode())
        assert struct.unpack_from('<i', head[b'channels'], end + 1)[0] == 2, 'no floats'
        place = end + 17
    x0, y0, x1, y1 = struct.unpack('<4i', head[b'dataWindow'])
    width, height, lines = x1 - x0 + 1, y1 - y0 + 1, {0: 1, 2: 1, 3: 16}[head[b'compression'][0]]
    planes = {name: np.empty((height, width)) for name in names}
    for offset in struct.unpack_from('<%dQ' % -(-height // lines), content, at):
        y, size = struct.unpack_from('<2i', content, offset)
        data, count = content[offset + 8:offset + 8 + size], min(lines, y1 + 1 - y)
        if size < 4 * width * len(names) * count:
            part = np.frombuffer(zlib.decompress(data), np.uint8).astype(int)
            part = (np.cumsum(np.concatenate([part[:1], part[1:] - 128])) & 255).astype(np.uint8)
            half = (len(part) + 1) // 2
            mixed = np.empty(len(part), np.uint8)
            mixed[0::2], mixed[1::2] = part[:half], part[half:]
            data = mixed.tobytes()
        block = np.frombuffer(data, '<f4').reshape(count, len(names), width)
        for k, name in enumerate(names):
            planes[name][y - y0:y - y0 + count] = block[:, k]
    return planes


def decoded(code):
    """Returns the linear light of sRGB codes in [0, 1]."""
    code = np.asarray(code, float)
    return np.where(code <= 0.04045, code / 12.92, ((np.maximum(code, 0) + 0.055) / 1.055) ** 2.4)


def encoded(light):
    light = np.clip(np.asarray(light, float), 0, 1)
    return np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)


class Picture:
    """An image of random codes, and its values at texture coordinates."""

    def __init__(self, random, channels=None):
        self.random = random
        height, width = random.integers(5, 24, 2)
        channels = channels or int(random.choice([1, 2, 3, 3, 4]))
        kind = np.uint16 if random.random() < 0.3 else np.uint8
        self.codes = random.integers(0, np.iinfo(kind).max + 1, (height, width, channels)).astype(kind)
        self.values = self.codes / np.iinfo(kind).max

    def light(self, linear):
        colors = self.values.shape[2] - (self.values.shape[2] % 2 == 0)
        light = self.values.copy()
        if not linear:
            light[:, :, :colors] = decoded(light[:, :, :colors])
        return light

    def sampled(self, uv, is_nearest, linear, wrap=('repeat', 'repeat')):
        """Returns (values, whether rounding cannot change the texel) at rows of texture coordinates."""
        light = self.light(linear)
        height, width = light.shape[:2]
        x, y = uv[:, 0] * width, (1 - uv[:, 1]) * height
        def wrapped(i, size, mode):
            if mode == 'clamp':
                return np.clip(i, 0, size - 1)
            if mode == 'mirror':
                i = i % (2 * size)
                return np.where(i < size, i, 2 * size - 1 - i)
            return i % size
        def at(i, j):
            return light[wrapped(j, height, wrap[1]), wrapped(i, width, wrap[0])]
        if is_nearest:
            off = np.minimum(np.abs(x - np.round(x)), np.abs(y - np.round(y)))
            return at(np.floor(x).astype(int), np.floor(y).astype(int)), off > 1e-3
        i, j = np.floor(x - 0.5).astype(int), np.floor(y - 0.5).astype(int)
        s, t = (x - 0.5 - i)[:, None], (y - 0.5 - j)[:, None]
        return (1 - t) * ((1 - s) * at(i, j) + s * at(i + 1, j)) + t * (
            (1 - s) * at(i, j + 1) + s * at(i + 1, j + 1)), np.ones(len(uv), bool)


# ------------------------------------------------------------------ surfaces
def cells_of_block(random, kind):
    """Returns the polygons of a block of 2 x 2 cells, as positions (i, j) of its 3 x 3 vertices."""
    square = lambda i, j: [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
    def triangles(i, j):
        a, b, c, d = square(i, j)
        return [[a, b, c], [a, c, d]] if random.random() < 0.5 else [[a, b, d], [b, c, d]]
    squares = [(0, 0), (1, 0), (0, 1), (1, 1)]
    if kind == 'triangles':
        return sum((triangles(*s) for s in squares), [])
    if kind == 'quads':
        return [square(*s) for s in squares]
    if kind == 'mixture':
        kind = random.choice(['triangles', 'quads', 'polygons', 'polygons'])
        if kind != 'polygons':
            return cells_of_block(random, kind)
    form = random.integers(4)
    if form == 0:                                 # an octagon
        return [[(0, 0), (1, 0), (2, 0), (2, 1), (2, 2), (1, 2), (0, 2), (0, 1)]]
    if form == 1:                                 # an L shape, which is not convex, and a square
        return [[(0, 0), (1, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2), (0, 1)], square(1, 1)]
    if form == 2:                                 # hexagons side by side
        return [[(0, 0), (1, 0), (1, 1), (1, 2), (0, 2), (0, 1)], [(1, 0), (2, 0), (2, 1), (2, 2), (1, 2), (1, 1)]]
    return [[(0, 0), (1, 0), (2, 0), (1, 1), (0, 1)], [(2, 0), (2, 1), (2, 2), (1, 2), (1, 1)], square(0, 1)]


class Folds:
    """The positions of panels in space. Points are those of the unfolded sheet, with panel k between x = k
    and x = k + 1."""

    def __init__(self, random, panels):
        self.panels = panels
        angles = np.cumsum(random.uniform(-1.2, 1.2, panels))
        self.directions = np.stack([np.cos(angles), 0 * angles, np.sin(angles)], -1)
        self.starts = np.concatenate([[[0, 0, 0]], np.cumsum(self.directions, 0)])
        turn, _ = np.linalg.qr(random.normal(size=(3, 3)))
        self.linear = turn @ np.diag(random.uniform(0.5, 2, 3)) * 10.0 ** random.uniform(-1, 2)
        self.shift = random.uniform(-1, 1, 3) * np.abs(self.linear).max()

    def frame(self, k):
        """Returns as columns the derivatives of the position in space by x and y of the sheet."""
        return self.linear @ np.stack([self.directions[k], [0, 1, 0]], -1)

    def places(self, q, panel):
        flat = self.starts[panel] + (q[:, :1] - np.asarray(panel)[:, None]) * self.directions[panel]
        flat = flat + q[:, 1:] * [0, 1, 0]
        return flat @ self.linear.T + self.shift

    def normal(self, k):
        normal = np.cross(*self.frame(k).T)
        return normal / np.linalg.norm(normal)


class Sheet:
    """Polygons that cover the panels: vertices q on the unfolded sheet, polygons, and the panel of each."""

    def __init__(self, random, folds, kind):
        n = 2 * int(random.integers(1, 4))
        columns = n * folds.panels + 1
        grid = np.stack(np.meshgrid(np.arange(columns) / n, np.arange(n + 1) / n), -1)
        inner = np.zeros(grid.shape[:2], bool)
        inner[1:-1, 1:-1] = True
        moved = random.uniform(-0.17, 0.17, grid.shape) / n
        moved[:, ::n, 0] = 0                      # hinges stay straight
        grid[inner] += moved[inner]
        self.q = grid.reshape(-1, 2)
        self.polygons, self.panel = [], []
        for j in range(0, n, 2):
            for i in range(0, columns - 1, 2):
                for places in cells_of_block(random, kind):
                    polygon = [(j + b) * columns + i + a for a, b in places]
                    self.polygons.append(list(map(int, np.roll(polygon, random.integers(len(polygon))))))
                    self.panel.append(i // n)
        order = random.permutation(len(self.polygons))
        self.polygons = [self.polygons[k] for k in order]
        self.panel = np.array(self.panel)[order]
        self.finish(folds)

    def finish(self, folds):
        self.folds = folds
        panel = np.minimum(np.floor(self.q[:, 0] + 1e-9).astype(int), folds.panels - 1)
        self.points = folds.places(self.q, panel)

    def triangulated(self):
        """Returns the sheet with its polygons cut into triangles, numbered consecutively; .origin: the
        polygon of each."""
        other = Sheet.__new__(Sheet)
        other.q, other.folds, other.points = self.q, self.folds, self.points
        pieces = [(t, k) for k, polygon in enumerate(self.polygons) for t in ears(self.q, polygon)]
        other.polygons, other.origin = [list(t) for t, _ in pieces], np.array([k for _, k in pieces])
        other.panel = self.panel[other.origin]
        return other

    def located(self, q):
        """Returns the number of the polygon at each position, -1 outside or within MARGIN of an edge."""
        found, near = np.full(len(q), -1), np.zeros(len(q), bool)
        for k, polygon in enumerate(self.polygons):
            inside = np.zeros(len(q), bool)
            corners = self.q[polygon]
            for a, b in zip(corners, np.roll(corners, -1, 0)):
                edge = b - a
                t = np.clip((q - a) @ edge / (edge @ edge), 0, 1)
                near |= ((q - a - t[:, None] * edge) ** 2).sum(1) < MARGIN ** 2
                if a[1] != b[1]:
                    crosses = (a[1] > q[:, 1]) != (b[1] > q[:, 1])
                    inside ^= crosses & (q[:, 0] < a[0] + (q[:, 1] - a[1]) * edge[0] / edge[1])
            found[inside] = k
        found[near] = -1
        return found

    def barycentric(self, q, triangle):
        """Returns the barycentric coordinates of positions in triangles."""
        corners = self.q[np.array([self.polygons[k] for k in triangle]).reshape(-1, 3)]
        a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        p = q - corners[:, 0]
        det = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
        s, t = (p[:, 0] * b[:, 1] - p[:, 1] * b[:, 0]) / det, (a[:, 0] * p[:, 1] - a[:, 1] * p[:, 0]) / det
        return np.stack([1 - s - t, s, t], -1)


def ears(q, polygon):
    """Returns a triangulation of a simple counterclockwise polygon."""
    cross = lambda a, b, c: (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    left, triangles = list(polygon), []
    while len(left) > 3:
        def quality(k):
            a, b, c = left[k - 1], left[k], left[(k + 1) % len(left)]
            if any(min(cross(q[a], q[b], q[p]), cross(q[b], q[c], q[p]), cross(q[c], q[a], q[p])) > -1e-9
                   for p in left if p not in (a, b, c)):
                return -1
            return cross(q[a], q[b], q[c])
        k = max(range(len(left)), key=quality)
        triangles.append((left[k - 1], left[k], left[(k + 1) % len(left)]))
        del left[k]
    return triangles + [tuple(left)]


class Layout:
    """Texture coordinates that are affine in the sheet's; `parts` has the map of each polygon."""

    def __init__(self, matrices, shifts, part):
        self.matrices, self.shifts, self.part = np.array(matrices), np.array(shifts), np.asarray(part)

    def at(self, q, polygon):
        part = self.part[polygon]
        return np.einsum('kij,kj->ki', self.matrices[part], q) + self.shifts[part]


def placed(random, corners, box):
    """Returns a random affine map that keeps the orientation and maps the corners into the box (x0, y0, x1,
    y1)."""
    angle = random.uniform(0, 2 * math.pi)
    turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    matrix = turn @ np.array([[1, random.uniform(-0.7, 0.7)], [0, random.uniform(0.4, 2)]])
    image = corners @ matrix.T
    low, size = image.min(0), np.ptp(image, 0)
    factor = min((box[2] - box[0]) / size[0], (box[3] - box[1]) / size[1]) * random.uniform(0.7, 1)
    room = np.array([box[2] - box[0], box[3] - box[1]]) - factor * size
    return factor * matrix, np.array(box[:2]) + room * random.uniform(0, 1, 2) - factor * low


def atlas(random, sheet):
    """Returns a layout without overlaps in the unit square: the whole sheet, or its panels separately."""
    panels = sheet.folds.panels
    if random.random() < 0.3:
        corners = np.array([(0, 0), (panels, 0), (panels, 1), (0, 1)], float)
        matrix, shift = placed(random, corners, (0.02, 0.02, 0.98, 0.98))
        return Layout([matrix], [shift], 0 * sheet.panel)
    side = math.ceil(math.sqrt(panels))
    maps = []
    for k in range(panels):
        i, j = k % side, k // side
        maps.append(placed(random, np.array([(k, 0), (k + 1, 0), (k + 1, 1), (k, 1)], float),
                           ((i + 0.05) / side, (j + 0.05) / side, (i + 0.95) / side, (j + 0.95) / side)))
    return Layout([m for m, _ in maps], [s for _, s in maps], sheet.panel)


def islands(random, sheet, beyond):
    """Returns a layout with an island for each polygon; islands may overlap and leave the unit square."""
    maps = []
    for polygon in sheet.polygons:
        at = random.uniform(0, 0.6, 2) + (random.integers(-2, 3, 2) if beyond else 0)
        maps.append(placed(random, sheet.q[polygon], (*at, *(at + random.uniform(0.1, 0.4)))))
    return Layout([m for m, _ in maps], [s for _, s in maps], np.arange(len(maps)))


# ------------------------------------------------------------------ files
class Carrier:
    """A sheet with its data. By corner: vt, vn; by vertex: colors."""

    def __init__(self, sheet):
        self.sheet, self.layout, self.vn, self.colors = sheet, None, None, None
        self.materials, self.library = None, ''   # by polygon
        self.rows_by_vertex = False

    def vt(self):
        """Returns a list with the rows by corner of each polygon."""
        sheet = self.sheet
        return [self.layout.at(sheet.q[p], np.full(len(p), k)) for k, p in enumerate(sheet.polygons)]

    def unique_vt(self):
        """Returns the different rows, and their indices by corner."""
        rows, numbers, known = [], [], {}
        for k, (polygon, values) in enumerate(zip(self.sheet.polygons, self.vt())):
            part = int(self.layout.part[k])
            for v, row in zip(polygon, values):
                if (part, v) not in known:
                    known[part, v] = len(rows)
                    rows.append(row)
            numbers.append([known[part, v] for v in polygon])
        return np.array(rows), numbers


def obj_text(c):
    lines = ['mtllib ' + c.library] if c.library else []
    for k, p in enumerate(c.sheet.points):
        lines.append('v %.17g %.17g %.17g' % tuple(p) + (' %.17g %.17g %.17g' % tuple(c.colors[k])
                                                        if c.colors is not None else ''))
    numbers = None
    if c.layout:
        rows, numbers = c.unique_vt()
        lines += ['vt %.17g %.17g' % tuple(r) for r in rows]
    first = 1
    for k, polygon in enumerate(c.sheet.polygons):
        if c.vn:
            lines += ['vn %.17g %.17g %.17g' % tuple(r) for r in c.vn[k]]
        if c.library and (k == 0 or c.materials[k] != c.materials[k - 1]):
            lines.append('usemtl m%d' % c.materials[k])
        words = []
        for i, v in enumerate(polygon):
            word = '%d' % (v + 1)
            if numbers or c.vn:
                word += '/' + ('%d' % (numbers[k][i] + 1) if numbers else '')
            words.append(word + ('/%d' % (first + i) if c.vn else ''))
        first += len(polygon)
        lines.append('f ' + ' '.join(words))
    return ('\n'.join(lines) + '\n').encode()


def ply_bytes(c, random):
    """Returns PLY as text or bytes of either order, with texture coordinates by corner, and colours as bytes
    or floats."""
    form = random.choice(['ascii', 'binary_little_endian', 'binary_big_endian'])
    codes = c.colors is not None and c.colors_are_bytes
    head = ['ply', 'format %s 1.0' % form, 'element vertex %d' % len(c.sheet.points)]
    head += ['property double ' + x for x in 'xyz']
    if c.colors is not None:
        head += ['property %s %s' % ('uchar' if codes else 'float', x) for x in ('red', 'green', 'blue')]
    head += ['element face %d' % len(c.sheet.polygons), 'property list uchar int vertex_indices']
    head += ['property list uchar double texcoord'] if c.layout else []
    order = '>' if 'big' in form else '<'
    vt = c.vt() if c.layout else None
    body = b''
    for k, p in enumerate(c.sheet.points):
        color = () if c.colors is None else tuple(c.colors[k])
        color = tuple(int(round(255 * x)) for x in color) if codes else color
        body += ' '.join(['%.17g' % x for x in (*p, *color)]).encode() + b'\n' if form == 'ascii' else struct.pack(
            order + '3d' + ('' if not color else '3B' if codes else '3f'), *p, *color)
    for k, polygon in enumerate(c.sheet.polygons):
        flat = vt[k].ravel() if vt else []
        if form == 'ascii':
            words = [len(polygon), *polygon] + ([len(flat), *('%.17g' % x for x in flat)] if vt else [])
            body += ' '.join(map(str, words)).encode() + b'\n'
        else:
            body += struct.pack(order + 'B%di' % len(polygon), len(polygon), *polygon)
            body += struct.pack(order + 'B%dd' % len(flat), len(flat), *flat) if vt else b''
    return '\n'.join(head + ['end_header', '']).encode() + body


def vtu_bytes(c, with_numbers):
    """Returns triangles (c.sheet is triangulated) with separate points for each part of the layout."""
    rows, numbers = c.unique_vt()
    vertex_of = {}
    for polygon, row in zip(c.sheet.polygons, numbers):
        vertex_of.update(zip(row, polygon))
    vertices = [vertex_of[k] for k in range(len(rows))]
    def array(kind, name, values, width):
        return ('<DataArray type="%s" Name="%s" NumberOfComponents="%d" format="ascii">\n%s\n</DataArray>\n'
                % (kind, name, width, ' '.join(map(str, values))))
    real = lambda values: ['%.17g' % x for x in np.asarray(values).ravel()]
    point_data = array('Float64', 'uv', real(rows), 2)
    cell_data = ''
    if with_numbers:
        point_data += array('Int64', 'input_vertex', vertices, 1)
        cell_data = '<CellData>\n%s</CellData>\n' % array('Int64', 'input_face', c.sheet.origin, 1)
    count = len(c.sheet.polygons)
    return ('<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian">\n<UnstructuredGrid>\n'
            '<Piece NumberOfPoints="%d" NumberOfCells="%d">\n<PointData>\n%s</PointData>\n%s<Points>\n%s</Points>\n'
            '<Cells>\n%s%s%s</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n' % (
                len(rows), count, point_data, cell_data, array('Float64', 'Points', real(c.sheet.points[vertices]), 3),
                array('Int64', 'connectivity', sum(numbers, []), 1),
                array('Int64', 'offsets', range(3, 3 * count + 1, 3), 1), array('UInt8', 'types', [5] * count, 1))
            ).encode(), vertices


def glb_bytes(c, random, pictures=(), wraps=()):
    """Writes triangles in one or several primitives, with a vertex for each corner. Returns the bytes and the
    numbers of triangles in the order of the file."""
    model, count = Model(), len(c.sheet.polygons)
    parts = c.materials if c.materials is not None else np.sort(random.integers(0, random.integers(1, 4), count))
    vt, order, primitives = c.vt() if c.layout else None, [], []
    gl = {'repeat': 10497, 'clamp': 33071, 'mirror': 33648}
    material_of = {}
    for k, picture in enumerate(pictures):
        image = model.add('images', {'bufferView': model.view(png_bytes(picture.codes)), 'mimeType': 'image/png'})
        sampler = model.add('samplers', {'wrapS': gl[wraps[k][0]], 'wrapT': gl[wraps[k][1]]})
        texture = model.add('textures', {'source': image, 'sampler': sampler})
        material_of[k] = model.add('materials', {'pbrMetallicRoughness': {'baseColorTexture': {'index': texture}}})
    for part in sorted(set(map(int, parts))):
        own = [k for k in range(count) if parts[k] == part]
        order += own
        corner = lambda values: [list(map(float, row)) for k in own for row in values(k)]
        attributes = {'POSITION': model.accessor(corner(lambda k: c.sheet.points[c.sheet.polygons[k]]), bounds=True)}
        if c.vn:
            attributes['NORMAL'] = model.accessor(corner(lambda k: c.vn[k]))
        if vt:
            attributes['TEXCOORD_0'] = model.accessor(corner(lambda k: vt[k] * [1, -1] + [0, 1]))
        if c.colors is not None:
            kind = c.color_kind
            rows = corner(lambda k: c.colors[c.sheet.polygons[k]])
            if kind != FLOAT:
                rows = [[int(round(x * (255 if kind == UBYTE else 65535))) for x in row] for row in rows]
            attributes['COLOR_0'] = model.accessor(rows, kind, normalized=kind != FLOAT)
        entry = {'attributes': attributes, 'indices': model.accessor([[k] for k in range(3 * len(own))], UINT, INDICES)}
        if part in material_of:
            entry['material'] = material_of[part]
        primitives.append(entry)
    mesh = model.add('meshes', {'primitives': primitives})
    model.add('scenes', {'nodes': [model.add('nodes', {'mesh': mesh})]})
    model.json['scene'] = 0
    return model.glb(), np.array(order)


# ------------------------------------------------------------------ trials
Trial = collections.namedtuple('Trial', 'what carrier polygons output texels worst bad')


class Refused(Exception):
    """The error of a command that did not do what the trial requires."""


class Maker:
    """One trial: its files in `folder`, the command, and the expected values."""

    def __init__(self, options, index, folder):
        self.random = np.random.default_rng([options.seed, index])
        self.options, self.folder = options, folder

    def chance(self, p):
        return self.random.random() < p

    def choice(self, values):
        return values[int(self.random.integers(len(values)))]

    def write(self, name, content):
        (self.folder / name).write_bytes(content)
        return self.folder / name

    def run(self, *words):
        self.words = [str(w) for w in words]
        report = self.folder / 'report.json'
        done = common.run([self.options.binary, *self.words, '--report', report], self.options.timeout)
        if done.code != 0:
            raise Refused('exit %s: %s' % (done.code, done.stderr.strip()[:300]))
        return json.loads(report.read_text())['result']

    # -------------------------------------------------------------- the target
    def target(self, name='new'):
        """Writes a layout to bake into; keeps its sheet, layout and polygons."""
        kind = self.choice(['triangles', 'quads', 'polygons', 'mixture'])
        self.new = Carrier(Sheet(self.random, self.folds, kind))
        self.new.layout = atlas(self.random, self.new.sheet)
        form = self.choice(['obj', 'obj', 'ply', 'glb', 'vtu'])
        self.new_polygons, self.new_form = kind, form
        return self.written(self.new, form, name)

    def written(self, c, form, name):
        """Writes a carrier. GLB and VTU hold triangles, so c.sheet may be replaced by a triangulated one."""
        if form in ('glb', 'vtu'):
            self.cut(c)
        path = '%s.%s' % (name, form)
        if form == 'obj':
            return self.write(path, obj_text(c))
        if form == 'ply':
            return self.write(path, ply_bytes(c, self.random))
        if form == 'vtu':
            content, c.vertex_of_point = vtu_bytes(c, c.with_numbers)
            return self.write(path, content)
        content, order = glb_bytes(c, self.random, getattr(c, 'pictures', ()), getattr(c, 'wraps', ()))
        self.reorder(c, order)
        return self.write(path, content)

    def cut(self, c):
        sheet = c.sheet.triangulated()
        corner_of = [{v: i for i, v in enumerate(p)} for p in c.sheet.polygons]
        if c.vn:
            c.vn = [np.array([c.vn[o][corner_of[o][v]] for v in t]) for t, o in zip(sheet.polygons, sheet.origin)]
        if c.layout:
            c.layout = Layout(c.layout.matrices, c.layout.shifts, c.layout.part[sheet.origin])
        if c.materials is not None:
            c.materials = c.materials[sheet.origin]
        c.sheet = sheet
        # Points without a number in a VTU are joined if they are at one position.
        c.with_numbers = self.chance(0.6) or c.rows_by_vertex

    def reorder(self, c, order):
        c.sheet.polygons = [c.sheet.polygons[k] for k in order]
        c.sheet.panel, c.sheet.origin = c.sheet.panel[order], c.sheet.origin[order]
        c.vn = [c.vn[k] for k in order] if c.vn else None
        if c.layout:
            c.layout.part = c.layout.part[order]
        if c.materials is not None:
            c.materials = c.materials[order]

    # -------------------------------------------------------------- the carrier
    def old(self, what):
        """Returns (file, Carrier), in a format that can hold the requested data."""
        self.same = self.chance(0.4)
        kind = self.new_polygons if self.same else self.choice(['triangles', 'quads', 'polygons', 'mixture'])
        self.old_polygons = kind
        forms = {'normal of corners': ['obj', 'obj', 'glb'], 'color': ['obj', 'ply', 'glb'], 'model': ['obj', 'glb'],
                 'corners': ['obj', 'ply', 'glb']}.get(what, ['obj', 'ply', 'glb', 'vtu'])
        form = self.choice(forms)
        sheet = self.new_sheet if self.same else Sheet(self.random, self.folds, kind)
        c = Carrier(sheet)
        is_textured = what in ('distortion', 'image', 'model') or form == 'vtu' or self.chance(0.5)
        if is_textured:
            beyond = what in ('image', 'model') and self.chance(0.4)
            c.layout = islands(self.random, sheet, beyond) if self.chance(0.6) or beyond else atlas(self.random, sheet)
        if what == 'normal of corners' or (form in ('obj', 'glb') and self.chance(0.3)):
            c.vn = self.corner_normals(c, form)
        if what == 'color':
            self.color(c, form)
        if what == 'model':
            self.model(c, form)
        self.form = form
        c.rows_by_vertex = what == 'vertices'
        return self.written(c, form, 'old'), c

    def corner_normals(self, c, form):
        """Returns normals: one per polygon with more than three corners, one per corner of triangles."""
        unit = lambda rows: rows / np.linalg.norm(rows, axis=1)[:, None]
        rows = []
        for k, polygon in enumerate(c.sheet.polygons):
            some = unit(c.sheet.folds.normal(c.sheet.panel[k]) + self.random.normal(size=(3, 3)) * 0.5)
            varies = len(polygon) == 3 and form == 'obj'
            rows.append(some if varies else np.repeat(some[:1], len(polygon), 0))
        return rows

    def color(self, c, form):
        """Sets colours that are affine on the sheet in the space in which they are mixed, so that the
        triangulation does not matter."""
        self.linear = self.chance(0.4)
        slope = self.random.uniform(-1, 1, (2, 3)) * [[0.4 / self.folds.panels], [0.4]]
        middle = np.array([self.folds.panels / 2, 0.5])
        self.affine = lambda q: 0.5 + (q - middle) @ slope
        exact = self.affine(c.sheet.q)
        c.colors_are_bytes = form == 'ply' and self.chance(0.5)
        c.color_kind = self.choice([FLOAT, UBYTE, USHORT])
        c.colors = exact if self.linear or form == 'glb' else encoded(exact)
        self.color_off = 0.0                      # error of mixed values by rounding of colours
        if form == 'ply' and c.colors_are_bytes:
            self.color_off = 0.51 / 255 * (1 if self.linear else 2.3)
        elif form == 'ply':
            self.color_off = 2e-7
        elif form == 'glb':
            self.color_off = {FLOAT: 1e-7, UBYTE: 0.51 / 255, USHORT: 0.51 / 65535}[c.color_kind]

    def model(self, c, form):
        """Sets materials with images."""
        count = int(self.random.integers(1, 4))
        c.materials = self.random.integers(0, count, len(c.sheet.polygons))
        c.pictures = [Picture(self.random) for _ in range(count)]
        words = ['repeat', 'repeat', 'clamp'] if form == 'obj' else ['repeat', 'clamp', 'mirror']
        c.wraps = []
        for k in range(count):
            first = self.choice(words)
            c.wraps.append((first, first if form == 'obj' else self.choice(words)))
        if form == 'obj':
            c.library = 'old.mtl'
            lines = []
            for k, picture in enumerate(c.pictures):
                self.write('p%d.png' % k, png_bytes(picture.codes))
                lines += ['newmtl m%d' % k, 'map_Kd %sp%d.png' % ('-clamp on ' if c.wraps[k][0] == 'clamp' else '', k)]
            self.write('old.mtl', ('\n'.join(lines) + '\n').encode())

    # -------------------------------------------------------------- what is right
    def table(self, what, c):
        """Writes the rows of a table as .npy. Returns their values as a function of a position in a polygon."""
        sheet, width = c.sheet, int(self.random.integers(1, 5))
        numbers = sheet.origin if self.form == 'vtu' and c.with_numbers else np.arange(len(sheet.polygons))
        kind = self.choice(['<f8', '<f4'])
        if what == 'faces':
            rows = self.random.uniform(-5, 5, (numbers.max() + 1, width))
            right = lambda q, j: rows[numbers[j]]
        elif what == 'vertices':
            slope, base = self.random.uniform(-1, 1, (2, width)), self.random.uniform(-1, 1, width)
            at = sheet.q
            if self.form == 'glb':                # the file has a vertex for each corner
                at = sheet.q[np.array(sheet.polygons).ravel()]
            rows = at @ slope + base
            right = lambda q, j: q @ slope + base
        else:
            slopes, bases = self.random.uniform(-1, 1, (len(sheet.polygons), 2, width)), self.random.uniform(
                -1, 1, (len(sheet.polygons), width))
            rows = np.concatenate([sheet.q[p] @ slopes[k] + bases[k] for k, p in enumerate(sheet.polygons)])
            right = lambda q, j: np.einsum('ki,kij->kj', q, slopes[j]) + bases[j]
        array = np.asarray(rows, kind)
        if width == 1 and self.chance(0.5):
            array = array[:, 0]
        np.save(self.folder / 'rows.npy', array)
        self.channels = ['c%d' % k for k in range(width)]
        return right, 1e-5

    def distortion(self, c):
        """Returns the distortion of each polygon, from its affine map and the frame of its panel."""
        sheet, layout = c.sheet, c.layout
        cross = lambda a, b: a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
        area = np.array([0.5 * cross(sheet.q[p], np.roll(sheet.q[p], -1, 0)).sum() for p in sheet.polygons])
        det = np.abs(np.linalg.det(layout.matrices[layout.part]))
        stretch = np.array([np.linalg.norm(np.cross(*self.folds.frame(k).T)) for k in sheet.panel])
        scale = math.sqrt((area * stretch).sum() / (area * det).sum())
        rows = []
        for k in range(len(sheet.polygons)):
            _, r = np.linalg.qr(self.folds.frame(sheet.panel[k]))
            s1, s2 = np.linalg.svd(scale * layout.matrices[layout.part[k]] @ np.linalg.inv(r), compute_uv=False)
            rows.append([s1, s2, s1 * s2, s1 / s2, math.sqrt(0.5 / s1 ** 2 + 0.5 / s2 ** 2), 1 / s2])
        rows = np.array(rows)
        return lambda q, j: rows[j]

    def expected(self, what, c):
        """Returns (expected value at (q, polygon of the carrier), tolerance relative to the largest value)."""
        sheet = c.sheet
        float_off = 3e-6 if 'glb' in (self.form, self.new_form) else 2e-7
        if what == 'position':
            return lambda q, j: self.folds.places(q, sheet.panel[j]), float_off
        if what in ('normal', 'normal of corners'):
            if not c.vn:
                flat = np.array([self.folds.normal(k) for k in range(self.folds.panels)])
                return lambda q, j: flat[sheet.panel[j]], 4 * float_off
            def right(q, j):
                normals = np.array([c.vn[k][0] for k in j]).reshape(-1, 3)
                varying = np.array([len(c.vn[k]) == 3 for k in j], bool)
                if varying.any():
                    weights = sheet.barycentric(q[varying], j[varying])
                    mixed = np.einsum('ki,kij->kj', weights, np.array([c.vn[k] for k in j[varying]]))
                    normals[varying] = mixed / np.linalg.norm(mixed, axis=1)[:, None]
                return normals
            return right, 30 * float_off
        if what == 'face':
            numbers = sheet.origin if self.form == 'vtu' and c.with_numbers else np.arange(len(sheet.polygons))
            return lambda q, j: numbers[j][:, None], 0
        if what == 'color':
            return lambda q, j: self.affine(q), 2e-6 + self.color_off
        if what == 'distortion':
            return self.distortion(c), 1e-4
        return self.table(what, c)

    # -------------------------------------------------------------- reading the output
    def output(self, path, names):
        """Returns the content of a file, height x width x channels, as light or numbers, and the error by
        rounding."""
        content = path.read_bytes()
        if path.suffix == '.npy':
            values = np.load(path).astype(float)
            return values.reshape(*values.shape[:2], -1), 0
        if path.suffix == '.exr':
            planes = read_exr(content)
            if len(names) in planes or not set(names) <= set(planes):
                names = {1: ['Y'], 2: ['Y', 'A'], 3: ['R', 'G', 'B'], 4: ['R', 'G', 'B', 'A']}[len(names)]
            return np.stack([planes[n] for n in names], -1), 0
        codes, largest = read_png(content)
        return codes / largest, 0.501 / largest

    # -------------------------------------------------------------- one trial
    def bake(self):
        random = self.random
        self.folds = Folds(random, int(random.integers(1, 5)))
        what = self.choice(['position', 'position', 'normal', 'normal of corners', 'face', 'color', 'color',
                            'distortion', 'faces', 'vertices', 'corners', 'image', 'image', 'model', 'model'])
        path = self.target()
        # The polygons before formats of triangles cut them, for carriers with the same polygons.
        self.new_sheet = self.new.sheet if self.new_form in ('obj', 'ply') else None
        if self.new_sheet is None:
            self.new_sheet = Sheet(random, self.folds, self.new_polygons)
        old, c = self.old(what)
        width, height = (int(x) for x in random.integers(12, 80, 2))
        words = ['bake', path, '--from', old, '--size', '%d,%d' % (width, height)]
        linear = getattr(self, 'linear', False)
        nearest_filter, picture = False, None
        if what in ('image', 'model'):
            linear = what == 'image' and self.chance(0.3)
            nearest_filter = self.chance(0.4)
            words += ['--filter', 'nearest'] if nearest_filter else []
        if what == 'image':
            picture = Picture(random)
            words += ['--image', self.write('picture.png', png_bytes(picture.codes))]
        elif what == 'model':
            pass
        elif what == 'color':
            words += ['--attribute', 'color'] if self.chance(0.6) else []
        elif what in ('faces', 'vertices', 'corners'):
            words += ['--attribute', self.folder / 'rows.npy']
        else:
            words += ['--attribute', what.split()[0]]
        words += ['--linear'] if linear else []
        png = what in ('image', 'model', 'color', 'normal', 'normal of corners')
        out = self.folder / ('out' + self.choice(['.npy', '.exr'] + ['.png'] * 2 * png))
        if out.suffix == '.png' and self.chance(0.6):
            words += ['--depth', self.choice(['8', '16'])]
        samples = int(self.choice([1, 1, 1, 2, 3]))
        if nearest_filter or what in ('face', 'faces', 'distortion', 'normal of corners', 'normal'):
            samples = 1
        words += ['--samples', samples] if samples > 1 else []
        method = self.choice(['auto', 'auto', 'nearest'])
        words += ['--method', method]
        if out.suffix != '.npy' or self.chance(0.3):
            padding = int(random.integers(0, 6))
            words += ['--padding', padding]
        else:
            padding = 0
        if what in ('image', 'model'):
            right, names = self.image_values(what, c, picture, nearest_filter, linear)
            tolerance = 2e-6
        else:
            right, tolerance = self.expected(what, c)
            names = list(NUMBERS.get(what.split()[0], getattr(self, 'channels', [])))
        report = self.run(*words, '-o', out)['bake']
        return self.compare(what, c, report, out, names, right, tolerance, width, height, samples, padding, linear)

    def image_values(self, what, c, picture, is_nearest, linear):
        pictures = [picture] if picture else c.pictures
        of = c.materials if what == 'model' else np.zeros(len(c.sheet.polygons), int)
        wraps = c.wraps if what == 'model' else [('repeat', 'repeat')]
        used = sorted(set(map(int, of))) if what == 'model' else [0]
        widths = [pictures[k].codes.shape[2] for k in used]
        channels = widths[0] if len(used) == 1 else 4 if any(w % 2 == 0 for w in widths) else 3
        def right(q, j):
            values, sure = np.empty((len(q), channels)), np.empty(len(q), bool)
            uv = c.layout.at(q, j)
            for k in used:
                mine = of[j] == k
                found, certain = pictures[k].sampled(uv[mine], is_nearest, linear, wraps[k])
                sure[mine] = certain
                if found.shape[1] != channels:
                    alpha = found[:, -1:] if found.shape[1] % 2 == 0 else np.ones((len(found), 1))
                    colors = found[:, :3] if found.shape[1] > 2 else np.repeat(found[:, :1], 3, 1)
                    found = np.concatenate([colors, alpha], 1)[:, :channels]
                values[mine] = found
            self.sure = sure
            return values
        return right, ['c'] * channels

    def compare(self, what, c, report, out, names, right, tolerance, width, height, samples, padding, linear):
        layout, folds = self.new.layout, self.folds
        steps = (np.arange(samples) + 0.5) / samples
        x = (np.arange(width)[:, None] + steps).ravel() / width
        y = 1 - (np.arange(height)[:, None] + steps).ravel() / height
        centers = np.stack(np.meshgrid(x, y), -1)  # rows of samples, from the top
        panel, q, off = self.panels_at(centers.reshape(-1, 2), width, height)
        inside = panel >= 0
        polygon = np.full(len(panel), -1)
        polygon[inside] = c.sheet.located(q[inside])
        known = polygon >= 0
        values = np.full((len(panel), len(names)), np.nan)
        if known.any():
            values[known] = right(q[known], polygon[known])
            if hasattr(self, 'sure'):
                values[np.flatnonzero(known)[~self.sure]] = np.nan
        block = lambda a: a.reshape(height, samples, width, samples, -1).transpose(0, 2, 1, 3, 4).reshape(
            height, width, samples ** 2, -1)
        mean = block(values).mean(2)
        is_color = what in ('image', 'model', 'color')
        found, rounding = self.output(out, names)
        bad = []
        if found.shape != mean.shape:
            return 'shape %s, expected %s' % (found.shape, mean.shape), 0, 0
        far = block(off)[:, :, :, 0].min(2)       # distance of texels from the border of a panel
        if out.suffix == '.png':
            if what.startswith('normal'):
                mean = mean / 2 + 0.5
            elif not linear:
                colors = mean.shape[2] - (mean.shape[2] % 2 == 0)
                mean[:, :, :colors] = encoded(mean[:, :, :colors])
        sure = ~np.isnan(mean).any(2)
        size = max(1.0, np.abs(mean[sure]).max()) if sure.any() else 1
        if out.suffix == '.png' and is_color and not linear:
            tolerance = tolerance * 13           # the slope of sRGB codes at black
        if what == 'color' and not linear and self.color_off > 1e-3:
            tolerance = tolerance * 1.5
        allowed = np.full(mean.shape[:2], tolerance * size + rounding)
        error = np.abs(found - mean).max(2)
        if what in ('image', 'model'):            # texels at cuts may differ by some codes
            at_cut = far < CUT_TEXELS
            is_light = out.suffix != '.png' and not linear
            codes = np.abs(encoded(found) - encoded(mean) if is_light else found - mean)
            error = np.where(at_cut, codes.max(2), error)
            allowed = np.where(at_cut, CUT_CODES / 255 + rounding, allowed)
        wrong = sure & ~(error <= allowed)
        if wrong.any():
            y, x = np.argwhere(wrong)[0]
            bad.append('%d of %d texels differ, at (%d, %d) %s, right %s' % (
                wrong.sum(), sure.sum(), x, y, found[y, x], mean[y, x]))
        self.judge_counts(bad, report, block(panel)[:, :, :, 0], samples, found, far, out, what, padding)
        worst = (error / np.maximum(allowed, 1e-300))[sure].max() if sure.any() else 0
        return '; '.join(bad), int(sure.sum()), float(worst)

    def panels_at(self, uv, width, height):
        """Returns for each position: the panel of the target's layout (-1: none, or near a border), the
        position on the sheet, and the distance in texels from the border of the panel (negative outside)."""
        layout, count = self.new.layout, self.folds.panels
        found, q_of, off = np.full(len(uv), -1), np.zeros((len(uv), 2)), np.full(len(uv), -np.inf)
        whole = len(layout.matrices) == 1
        for k in range(1 if whole else count):
            inverse = np.linalg.inv(layout.matrices[k])
            q = (uv - layout.shifts[k]) @ inverse.T
            low, high = (0, count) if whole else (k, k + 1)
            texels = np.array([width, height], float)
            # The distance to the line q_i = constant: |q_i - constant| / |gradient of q_i by texels|.
            slopes = np.linalg.norm(inverse / texels, axis=1)
            distance = np.min([(q[:, 0] - low) / slopes[0], (high - q[:, 0]) / slopes[0],
                               q[:, 1] / slopes[1], (1 - q[:, 1]) / slopes[1]], axis=0)
            inside = distance > 1e-6
            found[inside], q_of[inside] = (np.minimum(np.floor(q[inside, 0]), count - 1) if whole else k), q[inside]
            off = np.maximum(off, distance)
        return found, q_of, off

    def judge_counts(self, bad, report, panel, samples, found, far, out, what, padding):
        if report['doubly_covered'] or report['undecided'] or report['misses'] or report['opposed']:
            bad.append('counts %s' % {k: report[k] for k in ('doubly_covered', 'undecided', 'misses', 'opposed')})
        if samples == 1 and abs(int((panel >= 0).sum()) - report['covered']) > (np.abs(far) < 1e-6).sum():
            bad.append('%d texels covered, right %d' % (report['covered'], (panel >= 0).sum()))
        if report['charts'] != len(self.new.layout.matrices):
            bad.append('%d charts, right %d' % (report['charts'], len(self.new.layout.matrices)))
        if out.suffix == '.npy' and padding == 0:
            # A bilinear filter reads texels at a distance of at most one; farther texels are empty.
            is_dark = what in ('image', 'model', 'color', 'normal', 'normal of corners')
            beside = found[far < -2.5]
            wrong = beside != (-1 if what == 'face' else 0) if is_dark or what == 'face' else ~np.isnan(beside)
            wrong = wrong.any(1)
            if wrong.any():
                bad.append('%d texels beside the layout are not empty: %s' % (wrong.sum(), beside[wrong][0]))

    # -------------------------------------------------------------- unwrap --bake
    def unwrap(self):
        """Bakes triangles with images, and compares each texel of the new image with the old one at the same
        point."""
        random = self.random
        self.folds = Folds(random, int(random.integers(1, 5)))
        self.new_form = ''
        form = self.choice(['obj', 'glb'])
        c = Carrier(Sheet(random, self.folds, 'triangles'))
        c.layout = islands(random, c.sheet, False) if self.chance(0.5) else atlas(random, c.sheet)
        self.model(c, form)
        self.form, self.old_polygons = form, 'triangles'
        c.pictures = [Picture(random, 3) for _ in c.pictures]
        for k, picture in enumerate(c.pictures):
            picture.codes = picture.codes.astype(np.uint8) if picture.codes.dtype == np.uint8 else (
                picture.codes // 257).astype(np.uint8)
            picture.values = picture.codes / 255
            if form == 'obj':
                self.write('p%d.png' % k, png_bytes(picture.codes))
        path = self.written(c, form, 'old')
        out = self.folder / ('new.' + self.choice([form, form, 'glb']))
        size = int(random.integers(48, 160))
        self.run('unwrap', path, '-o', out, '--bake', '--resolution', size, '--padding', 2)
        if out.suffix == '.obj':
            uv, pixels = read_obj_layout(out), read_png((self.folder / 'new.png').read_bytes())
        else:
            places, uv, pixels = read_glb_layout(out)
            # A file may order triangles by material.
            middles = np.array([c.sheet.points[p].mean(0) for p in c.sheet.polygons])
            number = [int(((middles - m) ** 2).sum(1).argmin()) for m in places.mean(1)]
            if sorted(number) != list(range(len(middles))):
                return 'triangles are not those of the input', 0, 0
            uv = uv[np.argsort(number)]
        return self.compare_unwrapped(c, uv, *pixels)

    def compare_unwrapped(self, c, uv, codes, largest):
        """Compares the images. uv: three rows per triangle, in the input's order."""
        height, width = codes.shape[:2]
        centers = np.stack(np.meshgrid((np.arange(width) + 0.5) / width, 1 - (np.arange(height) + 0.5) / height), -1)
        centers = centers.reshape(-1, 2)
        worst, bad, count = 0.0, [], 0
        for k, corners in enumerate(uv):
            a, b = corners[1] - corners[0], corners[2] - corners[0]
            det = a[0] * b[1] - a[1] * b[0]
            p = centers - corners[0]
            s, t = (p[:, 0] * b[1] - p[:, 1] * b[0]) / det, (a[0] * p[:, 1] - a[1] * p[:, 0]) / det
            bary = np.stack([1 - s - t, s, t], -1)
            mine = (bary > 1e-4).all(1)
            if not mine.any():
                continue
            q = bary[mine] @ c.sheet.q[c.sheet.polygons[k]]
            old = c.layout.at(q, np.full(mine.sum(), k))
            m = c.materials[k]
            light, _ = c.pictures[m].sampled(old, False, False, c.wraps[m])
            error = np.abs(codes.reshape(-1, codes.shape[2])[mine][:, :3] - largest * encoded(light)).max(1)
            count += mine.sum()
            worst = max(worst, error.max())
            if error.max() > CUT_CODES:
                bad.append('triangle %d is off by %.1f codes' % (k, error.max()))
        if not count:
            bad.append('no texel')
        return '; '.join(bad[:3]) + ('; %d triangles' % len(bad) if len(bad) > 3 else ''), int(count), worst / CUT_CODES


def read_obj_layout(path):
    vt, rows = [], []
    for line in path.read_text().splitlines():
        words = line.split()
        if words[:1] == ['vt']:
            vt.append([float(x) for x in words[1:3]])
        if words[:1] == ['f']:
            rows.append([int(w.split('/')[1]) - 1 for w in words[1:]])
    return np.array(vt)[np.array(rows)]


def read_glb_layout(path):
    """Returns the triangles' corners in space and their texture coordinates, with v upwards, and the base
    colour."""
    reader = Reader(path.read_bytes())
    places, rows, picture = [], [], None
    for p, primitive in enumerate(reader.json['meshes'][0]['primitives']):
        material = reader.json['materials'][primitive['material']]
        reference = material['pbrMetallicRoughness']['baseColorTexture']
        own = np.array(reader.attribute(0, p, 'TEXCOORD_%d' % reference.get('texCoord', 0)))
        rows.append(own[np.array(reader.triangles(0, p))] * [1, -1] + [0, 1])
        places.append(np.array(reader.attribute(0, p, 'POSITION'))[np.array(reader.triangles(0, p))])
        image = reader.json['images'][reader.json['textures'][reference['index']]['source']]
        picture = bytes(reader.view(image['bufferView'])[0])
    return np.concatenate(places), np.concatenate(rows), read_png(picture)


def one(options, index, folder):
    maker = Maker(options, index, folder)
    maker.words, maker.form, maker.old_polygons = [], '', ''
    what = 'unwrap --bake' if maker.chance(0.12) else ''
    try:
        bad, texels, worst = maker.unwrap() if what else maker.bake()
    except Refused as refusal:
        bad, texels, worst = str(refusal), 0, 0
    words = ' '.join(maker.words)
    def value(flag, default):
        return maker.words[maker.words.index(flag) + 1] if flag in maker.words else default
    if not what:
        what = 'image' if '--image' in words else Path(value('--attribute', 'textures or colours')).name
    output = Path(value('-o', '')).suffix
    if bad:
        print('%d: %s from %s (%s): %s\n  %s' % (index, what, maker.form, maker.old_polygons, bad, words), flush=True)
    return Trial(what, maker.form, maker.old_polygons, output, texels, worst, bad)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--binary', type=Path, default=common.DEFAULT_BINARY, help='the majorant program')
    parser.add_argument('--timeout', type=float, default=60, help='seconds a run may take')
    parser.add_argument('--count', type=int, default=500, help='trials')
    parser.add_argument('--first', type=int, default=0, help='number of the first one')
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--keep', type=Path, help='folder for the files of trials that differ')
    options = parser.parse_args()
    options.binary = options.binary.resolve()
    trials = []
    for index in range(options.first, options.first + options.count):
        with tempfile.TemporaryDirectory(prefix='majorant_bakes_') as name:
            trials.append(one(options, index, Path(name)))
            if trials[-1].bad and options.keep:
                shutil.copytree(name, options.keep / str(index), dirs_exist_ok=True)
    for key in ('what', 'carrier', 'polygons', 'output'):
        rows = []
        for name in sorted({getattr(t, key) for t in trials}) + ['all']:
            own = [t for t in trials if name in ('all', getattr(t, key))]
            rows.append([name, len(own), sum(t.texels for t in own), '%.2f' % max(t.worst for t in own),
                         sum(bool(t.bad) for t in own)])
        header = [key, 'bakes', 'texels compared', 'largest error / allowed', 'differ']
        print('\n'.join(common.markdown_table(header, rows)), end='\n\n')
    return 1 if any(t.bad for t in trials) else 0


if __name__ == '__main__':
    sys.exit(main())
