# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""The result as the checks see it, for every file format: triangular cells of one degree, judged by the
values in the file. Continuity is decided by values, never by point numbers."""
import math
from fractions import Fraction

from bernstein import edge_points, vtk_order
from exact import cross, integers, orientation
from lagrange import control_points
from msh_file import MshFile
from ply_file import PlyFile
from vtu_file import LARGEST, Unreadable, VtuFile

# largest number n of corners for which all triangulations of a polygon are tried, in time n^3
MAX_POLYGON = 40


class Cell:
    """One triangle of the map.

    corners: three vertex numbers of the file (see `ResultMap.positions`)
    uv: control points in VTK's order, pairs of doubles
    name: the name in messages
    """
    __slots__ = 'corners', 'uv', 'name'

    def __init__(self, corners, uv, name):
        self.corners, self.uv, self.name = corners, uv, name

    def row(self, side, degree):
        """Returns the control points along a side, from corner `side` to the next."""
        return [self.uv[p] for p in edge_points(degree, side)]


class ResultMap:
    """A result. degree; cells; positions: those of the vertices of cells, in space; numbers: the surface
    vertex of each according to the file, or None; kind: 'cells' or 'polygons'; claims; not_flat: names of
    cells that are not the elevation of their flat triangle; bad_polygons: names of polygons without a
    positive triangulation; undecided_polygons."""

    def __init__(self, kind, degree):
        self.kind, self.degree = kind, degree
        self.cells, self.positions, self.numbers = [], [], []
        self.claims, self.faces = None, 0
        self.not_flat, self.bad_polygons, self.undecided_polygons = [], [], []

    def size(self):
        """Returns the diagonal of the bounding box of the surface."""
        return diagonal(self.positions)


def diagonal(points):
    return math.dist([min(c) for c in zip(*points)], [max(c) for c in zip(*points)])


def read_result(path):
    with open(path, 'rb') as file:
        data = file.read()
    if path.endswith('.vtu'):
        return _from_vtu(VtuFile(data))
    if path.endswith('.msh'):
        return _from_msh(MshFile(data))
    if path.endswith('.obj'):
        return _from_polygons(ObjFile(data))
    if path.endswith('.ply'):
        return _from_polygons(PlyFile(data))
    raise Unreadable('neither .vtu, .msh, .obj nor .ply')


# ------------------------------------------------------------------ VTU
def _from_vtu(vtu):
    result = ResultMap('cells', vtu.degree)
    result.claims, result.faces = vtu.claims, len(vtu.cells)
    places, numbers = {}, vtu.input_vertex

    def vertex(point):
        # Points are one vertex if they have the same number and position, or, without numbers, the same
        # position.
        number = numbers[point] if numbers and numbers[point] >= 0 else None
        key = number, vtu.positions[point]
        if key not in places:
            places[key] = len(result.positions)
            result.positions.append(vtu.positions[point])
            result.numbers.append(number)
        return places[key]

    for c, cell in enumerate(vtu.cells):
        uv = [vtu.uv[p] for p in cell]
        result.cells.append(Cell([vertex(p) for p in cell[:3]],
                                 control_points(uv, vtu.degree) if vtu.is_lagrange else uv,
                                 'cell %d' % c))
    _find_not_flat(result, vtu.positions, vtu.cells)
    return result


def _find_not_flat(result, positions, cells):
    """Finds cells that are not flat. The control points of a flat triangle are its lattice points, as are its
    values there."""
    if result.degree == 1:
        return
    tolerance = 1e-9 * result.size()
    for cell, points in zip(result.cells, cells):
        if not _flat([positions[p] for p in points], result.degree, tolerance):
            result.not_flat.append(cell.name)


def _flat(points, degree, tolerance):
    a, b, c = points[:3]
    for (i, j, k), point in zip(vtk_order(degree), points):
        for x, y, z, value in zip(a, b, c, point):
            if not abs((i * x + j * y + k * z) / degree - value) <= tolerance:
                return False
    return True


# ------------------------------------------------------------------ MSH
def _from_msh(msh):
    """Makes the nodes vertices, as the file does not refer to a surface. The surface of an image is that of
    its corners."""
    result = ResultMap('cells', msh.degree)
    result.faces, places = len(msh.cells), {}
    for c, cell in enumerate(msh.cells):
        corners = []
        for p in cell[:3]:  # copies along cuts have one position on a surface, and several in an image
            key = p if msh.is_image else msh.positions[p]
            if key not in places:
                places[key] = len(result.positions)
                result.positions.append(msh.positions[p])
                result.numbers.append(None)
            corners.append(places[key])
        result.cells.append(Cell(corners, control_points([msh.uv[p] for p in cell], msh.degree),
                                 'cell %d' % c))
    if not msh.is_image:
        _find_not_flat(result, msh.positions, msh.cells)
    return result


# ------------------------------------------------------------------ OBJ, PLY
class ObjFile:
    """The content of an OBJ. v: triples of doubles; vt: pairs of doubles, vt_text: their digits; faces: lists
    of pairs (vertex, texture coordinate or None), from 0."""

    def __init__(self, data):
        self.v, self.vt, self.vt_text, self.faces = [], [], [], []
        try:
            text = data.decode('utf-8', 'surrogateescape').replace('\\\n', ' ')
        except UnicodeDecodeError as error:
            raise Unreadable(str(error))
        for number, line in enumerate(text.splitlines(), 1):
            words = line.partition('#')[0].split()
            try:
                if not words:
                    continue
                if words[0] == 'v':
                    self.v.append(_finite(words[1:4], 3))
                elif words[0] == 'vt':
                    self.vt.append(_finite(words[1:3], 2))
                    self.vt_text.append(words[1:3])
                elif words[0] == 'f':
                    self.faces.append([self._corner(word) for word in words[1:]])
                    if len(self.faces[-1]) < 3:
                        raise ValueError('a face with fewer than three corners')
            except ValueError as error:
                raise Unreadable('line %d: %s' % (number, error))
        if not self.faces:
            raise Unreadable('no faces')
        for f, face in enumerate(self.faces):
            if any(v >= len(self.v) or (t or 0) >= max(1, len(self.vt)) for v, t in face):
                raise Unreadable('face %d has a corner that is not there' % (f + 1))

    def _corner(self, word):
        parts = word.split('/')
        numbers = [self._number(parts[0], len(self.v)), None]
        if len(parts) > 1 and parts[1]:
            numbers[1] = self._number(parts[1], len(self.vt))
        return tuple(numbers)

    @staticmethod
    def _number(word, count):
        number = int(word)
        if number == 0 or count + number < 0:
            raise ValueError('%s is no index' % word)
        return number - 1 if number > 0 else count + number


def _finite(words, count):
    values = tuple(float(word) for word in words)
    if len(values) != count or not all(abs(value) <= LARGEST for value in values):
        raise ValueError('%d finite numbers are needed' % count)
    return values


def _from_polygons(obj):
    """Makes a result of an ObjFile or a PlyFile."""
    result = ResultMap('polygons', 1)
    result.positions, result.numbers = obj.v, list(range(len(obj.v)))
    result.faces = len(obj.faces)
    for f, face in enumerate(obj.faces):
        name = 'face %d' % (f + 1)
        if any(t is None for _, t in face):
            raise Unreadable(name + ' has no texture coordinates')
        texture = [obj.vt[t] for _, t in face]
        triangles = _triangulation(texture)
        if triangles is None:
            result.undecided_polygons.append(name)
        elif not triangles:
            result.bad_polygons.append(name)
        elif obj.vt_text and not all(_positive_as_written([obj.vt_text[face[k][1]] for k in triangle],
                                          [texture[k] for k in triangle])
                     for triangle in triangles):
            result.bad_polygons.append(name + ' (its decimals)')
        elif not _unfolded_by_readers([obj.v[v] for v, _ in face], texture):
            result.bad_polygons.append(name + ' (cut from its first corner)')
        for triangle in triangles or [(0, k, k + 1) for k in range(1, len(face) - 1)]:
            result.cells.append(Cell([face[k][0] for k in triangle],
                                     [texture[k] for k in triangle], name))
    return result


def _unfolded_by_readers(corners, texture):
    """Returns whether the fan from the first corner, into which other programs cut a polygon, has positive
    triangles in the plane; triangles without an area in space do not count. True if the fan does not face one
    side in space."""
    fan = [(0, k, k + 1) for k in range(1, len(corners) - 1)]

    def area_vector(a, b, c):
        u, v = [corners[b][i] - corners[a][i] for i in range(3)], [corners[c][i] - corners[a][i] for i in range(3)]
        return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
    vectors = [area_vector(*t) for t in fan]
    normal = [sum(v[i] for v in vectors) for i in range(3)]
    length = math.hypot(*normal)
    heights = []
    for t, v in zip(fan, vectors):
        longest = max(math.dist(corners[t[i]], corners[t[i - 1]]) for i in range(3))
        heights.append(0 if length == 0 or longest == 0 else
                       sum(x * n for x, n in zip(v, normal)) / length / longest ** 2)
    if min(heights) < -1e-6:
        return True
    return all(height <= 1e-6 or orientation(*[texture[k] for k in t]) > 0 for t, height in zip(fan, heights))


def _positive_as_written(words, points):
    """Returns whether the triangle of the written decimals is positive. The doubles that readers make of them
    differ by up to one unit each; if that cannot change the sign, the doubles (positive) decide."""
    a, b, c = points
    size = max(abs(x) for p in points for x in p)
    spread = max(abs(b[0] - a[0]), abs(c[0] - a[0]), abs(b[1] - a[1]), abs(c[1] - a[1]))
    if 1e-280 < size < 1e300 and cross(a, b, c) > 2.0 ** -48 * size * spread > 1e-280:
        return True
    try:
        return cross(*[(Fraction(x), Fraction(y)) for x, y in words]) > 0
    except ValueError:  # digits that float() accepts and Fraction() does not
        return True


def _triangulation(points):
    """Returns the index triples of an exact triangulation of a planar polygon into positive triangles; [] if
    there is none, None if that is undecided (many corners)."""
    n = len(points)
    if n == 3:
        return [(0, 1, 2)] if orientation(*points) > 0 else []
    if n > MAX_POLYGON:
        return _clip_ears(integers(points))
    # best[i, j]: the third corner of the triangle at the diagonal i, j, if the part from i to j has a
    # triangulation
    exact, best = integers(points), {(i, i + 1): None for i in range(n - 1)}
    for length in range(2, n):
        for i in range(n - length):
            j = i + length
            for k in range(i + 1, j):
                if ((i, k) in best and (k, j) in best
                        and cross(exact[i], exact[k], exact[j]) > 0):
                    best[i, j] = k
                    break
    if (0, n - 1) not in best:
        return []
    triangles, stack = [], [(0, n - 1)]
    while stack:
        i, j = stack.pop()
        k = best[i, j]
        if k is not None:
            triangles.append((i, k, j))
            stack += [(i, k), (k, j)]
    return triangles


def _clip_ears(points):
    """Clips ears whose closed triangle holds no other corner, which triangulates every simple polygon."""
    left, triangles = list(range(len(points))), []
    while len(left) > 3:
        for at, i in enumerate(left):
            h, j = left[at - 1], left[(at + 1) % len(left)]
            a, b, c = points[h], points[i], points[j]
            if cross(a, b, c) > 0 and not any(
                    min(cross(a, b, points[k]), cross(b, c, points[k]), cross(c, a, points[k])) >= 0
                    for k in left if k not in (h, i, j)):
                triangles.append((h, i, j))
                del left[at]
                break
        else:
            return None
    return triangles + [tuple(left)] if cross(*[points[k] for k in left]) > 0 else None
