# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Small maps for the checker's tests, made from formulas, and files of every format with them.

All coordinates are computed in fractions and rounded once, so that both sides of an edge have the same
doubles on every machine.
"""
import base64
import copy
import json
import struct
from fractions import Fraction

from bernstein import vtk_order


class SmallMap:
    """A map to be written; tests change its fields to damage it.

    surface: positions in space and faces (tuples of vertex numbers) of the mesh that is mapped
    degree; corners: three vertex numbers per cell; uv: control points per cell, VTK's order
    input_face: the face of the surface for each cell, as written
    claims: written unless None
    """

    def __init__(self, positions, faces, degree, image):
        """image: vertex number -> place in the plane; bend: the pair (places, function from exact to exact
        points) by which control points are moved."""
        places, bend = image
        self.surface = positions, faces
        self.degree, self.claims = degree, None
        fans = [(f, (face[0], face[k], face[k + 1])) for f, face in enumerate(faces)
                for k in range(1, len(face) - 1)]
        self.corners = [corners for _, corners in fans]
        self.input_face = [f for f, _ in fans]
        self.uv = []
        for cell in self.corners:
            flat = elevated([places[v] for v in cell], degree)
            self.uv.append([tuple(float(x) for x in bend(*point)) for point in flat])

    def copy(self):
        return copy.deepcopy(self)

    def set(self, cell, place, point):
        """Sets one control point of one cell (exact or float)."""
        self.uv[cell][place] = tuple(float(x) for x in point)

    def move(self, vertex, point):
        """Moves a vertex in the plane, for all cells (degree 1)."""
        for cell, corners in enumerate(self.corners):
            for k, v in enumerate(corners):
                if v == vertex:
                    self.set(cell, k, point)

    def shift(self, cells, step):
        for cell in cells:
            self.uv[cell] = [(x + step[0], y + step[1]) for x, y in self.uv[cell]]

    def keep(self, cells):
        """Keeps the cells with these numbers; a repeated number duplicates the cell."""
        self.corners = [self.corners[c] for c in cells]
        self.uv = [list(self.uv[c]) for c in cells]
        self.input_face = [self.input_face[c] for c in cells]

    def turn(self, cell, order):
        """Permutes the corners of a cell together with its control points, whose positions in space and plane
        stay."""
        points = {index: p for index, p in zip(vtk_order(self.degree), self.uv[cell])}
        self.uv[cell] = [points[tuple(index[order.index(k)] for k in range(3))]
                         for index in vtk_order(self.degree)]
        self.corners[cell] = tuple(self.corners[cell][k] for k in order)


def straight(x, y):
    return x, y


def bent(x, y):
    """Moves the control points of a map of width about 1 by a few hundredths."""
    return x + y * y / 16 - x * y / 32, y - x * x / 16 + x / 8


def elevated(corners, degree):
    """Returns the exact control points of degree n of a flat triangle, in VTK's order."""
    return [tuple(sum(w * Fraction(c) for w, c in zip(index, axis)) / degree
                  for axis in zip(*corners)) for index in vtk_order(degree)]


# ------------------------------------------------------------------ VTU
_CODES = {'Float32': 'f', 'Float64': 'd', 'Int32': 'i', 'Int64': 'q', 'UInt8': 'B'}


class VtuText:
    """The encoding of a VTU: format 'ascii', 'binary', 'raw' or 'base64' (the last two appended), header
    type, type of the real numbers, and whether equal points are shared."""

    def __init__(self, form='ascii', header='UInt64', real='Float64', share=True):
        self.form, self.header, self.real, self.share = form, header, real, share

    def write(self, small, weights=None, numbers=None, positions=None, types=None, scalars=()):
        """Returns the bytes of a file. weights: one per control point of every cell; numbers: replacements of
        vertex numbers, by vertex, or {} to leave them out; positions: replacements of positions in space, by
        (cell, place); types: those of the cells; scalars: more PointData, (name, value)."""
        places = {v: tuple(map(Fraction, p)) for v, p in enumerate(small.surface[0])}
        rows, known, connectivity = [], {}, []
        for c, (corners, uv) in enumerate(zip(small.corners, small.uv)):
            flat = elevated([places[v] for v in corners], small.degree)
            for q, (space, plane) in enumerate(zip(flat, uv)):
                vertex = corners[q] if q < 3 else -1
                row = ((positions or {}).get((c, q)) or tuple(float(x) for x in space), plane,
                       (numbers or {}).get(vertex, vertex),
                       weights[c][q] if weights else None)
                key = row if self.share else len(rows)
                if key not in known:
                    known[key] = len(rows)
                    rows.append(row)
                connectivity.append(known[key])
        size = len(small.uv[0])
        self.appended = b''
        data = self.array(self.real, 'uv', 2, [x for row in rows for x in row[1]])
        if numbers != {}:
            data += self.array('Int32', 'input_vertex', 1, [row[2] for row in rows])
        if weights:
            data += self.array(self.real, 'RationalWeights', 1, [row[3] for row in rows])
        for name, value in scalars:
            data += self.array('Float64', name, 1, [value] * len(rows))
        count = len(small.uv)
        kind = 5 if small.degree == 1 else 76
        cells = (self.array('Int64', 'connectivity', 1, connectivity)
                 + self.array('Int64', 'offsets', 1, [size * (c + 1) for c in range(count)])
                 + self.array('UInt8', 'types', 1, types or [kind] * count))
        faces = self.array('Int32', 'input_face', 1, small.input_face)
        points = self.array('Float64', 'Points', 3, [x for row in rows for x in row[0]])
        return self.document(small.claims, len(rows), count, (data, faces, points, cells))

    def document(self, claims, points, cells, sections):
        """Returns the file around its arrays. sections: the texts of the sections of points, cells, places
        and connectivity."""
        data, faces, places, connectivity = sections
        text = ('<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="1.0" '
                'byte_order="LittleEndian" header_type="%s">\n<UnstructuredGrid>\n%s'
                '<Piece NumberOfPoints="%d" NumberOfCells="%d">\n<PointData>\n%s</PointData>\n'
                '<CellData>\n%s</CellData>\n<Points>\n%s</Points>\n<Cells>\n%s</Cells>\n'
                '</Piece>\n</UnstructuredGrid>\n'
                % (self.header, _claims(claims), points, cells, data, faces, places, connectivity)
                ).encode()
        if self.appended:
            text += (b'<AppendedData encoding="%s">\n_%s\n</AppendedData>\n'
                     % (self.form.encode(), self.appended))
        return text + b'</VTKFile>\n'

    def array(self, kind, name, width, values):
        """Returns one DataArray; the bytes of appended arrays go to `appended`."""
        head = '<DataArray type="%s" Name="%s" NumberOfComponents="%d"' % (kind, name, width)
        if self.form == 'ascii':
            return '%s format="ascii">\n%s\n</DataArray>\n' % (head, ' '.join(map(_number, values)))
        raw = struct.pack('<%d%s' % (len(values), _CODES[kind]), *values)
        raw = struct.pack('<I' if self.header == 'UInt32' else '<Q', len(raw)) + raw
        if self.form == 'binary':
            text = base64.b64encode(raw).decode()
            return '%s format="binary">\n%s\n</DataArray>\n' % (head, text)
        head += ' format="appended" offset="%d"/>\n' % len(self.appended)
        self.appended += raw if self.form == 'raw' else base64.b64encode(raw)
        return head


def _number(value):
    """Returns the shortest digits that read back as the same double, 0.5 and 1 rather than 0.50 and 1.0."""
    return repr(value)[:-2] if repr(value).endswith('.0') else repr(value)


def _claims(claims):
    if claims is None:
        return ''
    letters = ' '.join(map(str, json.dumps(claims).encode() + b'\0'))
    return ('<FieldData>\n<Array type="String" Name="majorant_claims" NumberOfTuples="1" '
            'format="ascii">\n%s\n</Array>\n</FieldData>\n' % letters)


# ------------------------------------------------------------------ OBJ
def obj_bytes(positions, faces, texture=None, charts=None):
    """Returns an OBJ. charts: for every face its indices into `texture`, from 0."""
    lines = ['v ' + ' '.join(map(_number, map(float, p))) for p in positions]
    lines += ['vt ' + ' '.join(t if isinstance(t, str) else _number(float(t)) for t in p)
              for p in texture or []]
    for f, face in enumerate(faces):
        lines.append('f ' + ' '.join('%d/%d' % (v + 1, charts[f][k] + 1) if charts else str(v + 1)
                                     for k, v in enumerate(face)))
    return ('\n'.join(lines) + '\n').encode()


def obj_of(small):
    """Returns a map of degree 1 as an OBJ with one texture coordinate per different value."""
    texture = sorted({p for uv in small.uv for p in uv})
    number = {p: k for k, p in enumerate(texture)}
    return obj_bytes(small.surface[0], small.corners, texture,
                     [[number[p] for p in uv] for uv in small.uv])


class Refined:
    """A map of degree 1 in which every face is cut into four at the midpoints of its edges, as in an OBJ:
    positions, faces, texture, charts. Tests may change all of them."""

    def __init__(self, small):
        self.positions = [tuple(map(Fraction, p)) for p in small.surface[0]]
        self.faces, self.texture, self.charts = [], [], []
        self.known = {}
        for corners, uv in zip(small.corners, small.uv):
            plane = [tuple(map(Fraction, p)) for p in uv]
            v = list(corners) + [self._vertex(corners[k], corners[k - 2]) for k in range(3)]
            t = [self._texture(p) for p in plane]
            t += [self._texture(_middle(plane[k], plane[k - 2])) for k in range(3)]
            for piece in ((0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5)):
                self.faces.append(tuple(v[k] for k in piece))
                self.charts.append(tuple(t[k] for k in piece))

    def _vertex(self, a, b):
        key = 'v', frozenset((a, b))
        if key not in self.known:
            self.known[key] = len(self.positions)
            self.positions.append(_middle(self.positions[a], self.positions[b]))
        return self.known[key]

    def _texture(self, point):
        if ('t', point) not in self.known:
            self.known['t', point] = len(self.texture)
            self.texture.append(point)
        return self.known['t', point]

    def write(self):
        return obj_bytes(self.positions, self.faces, self.texture, self.charts)


def _middle(p, q):
    return tuple((x + y) / 2 for x, y in zip(p, q))


# ------------------------------------------------------------------ shapes
_RING = [(4, 0), (2, 3), (-2, 3), (-4, 0), (-2, -3), (2, -3)]  # a hexagon


def fan(degree=1, bend=straight):
    """Returns a tent: six triangles around vertex 0."""
    places = [(0, 0)] + [(Fraction(x, 4), Fraction(y, 4)) for x, y in _RING]
    faces = [(0, 1 + k, 1 + (k + 1) % 6) for k in range(6)]
    return SmallMap([(x, y, 0.5 if v == 0 else 0) for v, (x, y) in enumerate(places)], faces,
                    degree, (places, bend))


def square_grid(degree=1, bend=straight, n=2, polygons=False):
    """Returns n x n bumpy squares over the unit square, optionally as triangles."""
    def vertex(i, j):
        return j * (n + 1) + i
    places = [(Fraction(i, n), Fraction(j, n)) for j in range(n + 1) for i in range(n + 1)]
    positions = [(x, y, x * y / 2 - x * x / 4) for x, y in places]
    squares = [(vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1))
               for j in range(n) for i in range(n)]
    faces = squares if polygons else [(q[0], q[a], q[a + 1]) for q in squares for a in (1, 2)]
    return SmallMap(positions, faces, degree, (places, bend))


def strip(path, degree=1, bend=straight):
    """Returns a ribbon through pairs of points of the plane, (inner, outer). In space it is straight."""
    places = [tuple(map(Fraction, p)) for pair in path for p in pair]
    positions = [(Fraction(k // 2), Fraction(k % 2), 0) for k in range(len(places))]
    faces = []
    for k in range(0, len(places) - 2, 2):
        faces += [(k, k + 2, k + 3), (k, k + 3, k + 1)]
    # In the plane of the mesh, outer points are below inner ones, so that faces look up.
    return SmallMap([(x, -y, z) for x, y, z in positions],
                    [face[::-1] for face in faces], degree, (places, bend))


def pieces(triangles, degree=1, bend=straight):
    """Returns separate triangles, far apart in space."""
    places = [tuple(map(Fraction, p)) for t in triangles for p in t]
    positions = [(Fraction(4 * (v // 3) + (v % 3 == 1)), Fraction(int(v % 3 == 2)), Fraction(0))
                 for v in range(len(places))]
    faces = [(3 * t, 3 * t + 1, 3 * t + 2) for t in range(len(triangles))]
    return SmallMap(positions, faces, degree, (places, bend))


def from_polynomials(x, y, degree):
    """Returns one triangle with the control points of the polynomials x, y: dicts (p, q) -> coefficient of
    b^p c^q in the barycentric coordinates b, c of its corners (0, 0), (1, 0), (0, 1)."""
    small = pieces([[(0, 0), (1, 0), (0, 1)]], degree)
    for place, (_, j, k) in enumerate(vtk_order(degree)):
        point = []
        for polynomial in (x, y):
            # The blossom of b^p c^q at j times corner 1 and k times corner 2.
            value = sum(Fraction(factor) * _falling(j, p) * _falling(k, q) / _falling(degree, p + q)
                        for (p, q), factor in polynomial.items())
            assert Fraction(float(value)) == value, 'not a double'
            point.append(value)
        small.set(0, place, point)
    return small


def _falling(n, k):
    product = 1
    for i in range(k):
        product *= n - i
    return Fraction(product)


def plate():
    """Returns a flat square of two triangles, and the same square cut at two inner vertices."""
    corners = [(0, 0), (4, 0), (4, 4), (0, 4), (3, 2), (1, 2)]
    pieces_of_it = [(0, 1, 4), (1, 2, 4), (2, 5, 4), (2, 3, 5), (3, 0, 5), (0, 4, 5)]
    positions = [(x, y, 1) for x, y in corners]
    return (positions[:4], [(0, 1, 2), (0, 2, 3)]), (positions, pieces_of_it, corners)


def cube(degree=1):
    """Returns the unit cube of twelve triangles, unfolded into six unit squares that match along all edges up
    to quarter turns: seams, and eight cones of three quarter turns."""
    sides = [((0, 0, 0), (0, 1, 0), (1, 0, 0)), ((0, 0, 1), (1, 0, 0), (0, 1, 0)),
             ((0, 0, 0), (1, 0, 0), (0, 0, 1)), ((0, 1, 0), (0, 0, 1), (1, 0, 0)),
             ((0, 0, 0), (0, 0, 1), (0, 1, 0)), ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
    numbers, faces, places = {}, [], []
    for s, (origin, e, f) in enumerate(sides):
        square = [tuple(o + a * x + b * y for o, x, y in zip(origin, e, f))
                  for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
        corners = [numbers.setdefault(p, len(numbers)) for p in square]
        plane = [(Fraction(2 * s + a), Fraction(b)) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
        for k in (1, 2):
            faces.append((corners[0], corners[k], corners[k + 1]))
            places.append([plane[0], plane[k], plane[k + 1]])
    small = SmallMap(list(numbers), faces, degree, ([(0, 0)] * 8, straight))
    for cell, corners in enumerate(places):
        small.uv[cell] = [tuple(map(float, p)) for p in elevated(corners, degree)]
    return small
