# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""The maps of check_campaign.py: surfaces with maps made from formulas, damage, and files of them.

Both sides of an inner edge have equal control points, since each point is computed from the positions of its
corners in a fixed order, and moved by a function of its position. Positions are on a grid of unit squares.
This module is imported, not run.
"""
import math
import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1] / 'checker'))

from bernstein import edge_points, vtk_order
from result_map import ObjFile
from small_maps import SmallMap, VtuText, obj_bytes
from vtu_file import VtuFile

SIDES = [((0, 0, 1), (1, 0, 0), (0, 1, 0)), ((0, 0, 0), (0, 1, 0), (1, 0, 0)),
         ((0, 0, 0), (1, 0, 0), (0, 0, 1)), ((0, 1, 0), (0, 0, 1), (1, 0, 0)),
         ((0, 0, 0), (0, 0, 1), (0, 1, 0)), ((1, 0, 0), (0, 1, 0), (0, 0, 1))]


def between(corners, degree):
    """Returns the control points of a flat triangle in VTK's order, in any dimension."""
    points = []
    for index in vtk_order(degree):
        parts = sorted((c, w) for c, w in zip(corners, index) if w)
        if len(parts) == 1:
            points.append(tuple(parts[0][0]))
        else:
            points.append(tuple(sum(w * c[k] for c, w in parts) / degree
                                for k in range(len(corners[0]))))
    return points


class Map(SmallMap):
    """A SmallMap of floats with up to a few thousand faces.

    positions: those of the vertices in space; polygons: faces of the surface
    corners, uv, input_face: one entry per cell; is_closed: the surface has no boundary, or holes
    mesh: bytes of the surface's OBJ; weights: see VtuText; moved: (cell, control point) -> position in space
    """

    def __init__(self, positions, polygons, degree, places, is_closed=False):
        """places: for every polygon, the positions of its corners in the plane."""
        self.positions = [tuple(map(float, p)) for p in positions]
        self.polygons, self.degree, self.is_closed = polygons, degree, is_closed
        fans = [(f, k) for f, face in enumerate(polygons) for k in range(1, len(face) - 1)]
        self.corners = [tuple(polygons[f][i] for i in (0, k, k + 1)) for f, k in fans]
        self.input_face = [f for f, _ in fans]
        self.uv = [between([places[f][i] for i in (0, k, k + 1)], degree) for f, k in fans]
        self.claims, self.weights, self.moved, self.numbers = None, None, {}, None
        self.mesh = obj_bytes(self.positions, polygons)

    def apply(self, function):
        """Maps every control point by function(x, y)."""
        known = {p: function(*p) for p in {p for uv in self.uv for p in uv}}
        self.uv = [[known[p] for p in uv] for uv in self.uv]

    def size(self):
        xs, ys = zip(*(p for uv in self.uv for p in uv))
        return math.hypot(max(xs) - min(xs), max(ys) - min(ys))

    def inner_edges(self):
        """Returns (cell, side, other cell, other side) of edges that two cells share."""
        sides = {(c[k], c[k - 2]): (n, k) for n, c in enumerate(self.corners) for k in range(3)}
        return [(*side, *sides[edge[::-1]]) for edge, side in sides.items()
                if edge[0] < edge[1] and edge[::-1] in sides]

    def row(self, cell, side):
        """Returns the indices into uv[cell] of the control points along a side."""
        return edge_points(self.degree, side)

    # -------------------------------------------------------------- files
    def vtu(self, form='binary', real='Float64'):
        text = VtuText(form, real=real)
        rows, known, connectivity = [], {}, []
        for c, (corners, uv) in enumerate(zip(self.corners, self.uv)):
            space = between([self.positions[v] for v in corners], self.degree)
            for q, plane in enumerate(uv):
                vertex = corners[q] if q < 3 else -1
                weight = self.weights[c][q] if self.weights else 1
                row = (self.moved.get((c, q), space[q]), plane,
                       (self.numbers or {}).get(vertex, vertex), weight)
                connectivity.append(known.setdefault(row, len(known)))
        rows, count, size = list(known), len(self.uv), len(self.uv[0])
        text.appended = b''
        data = text.array(real, 'uv', 2, [x for row in rows for x in row[1]])
        data += text.array('Int32', 'input_vertex', 1, [row[2] for row in rows])
        if self.weights:
            data += text.array('Float64', 'RationalWeights', 1, [row[3] for row in rows])
        cells = (text.array('Int64', 'connectivity', 1, connectivity)
                 + text.array('Int64', 'offsets', 1, [size * (c + 1) for c in range(count)])
                 + text.array('UInt8', 'types', 1, [5 if self.degree == 1 else 76] * count))
        faces = text.array('Int32', 'input_face', 1, self.input_face)
        points = text.array('Float64', 'Points', 3, [x for row in rows for x in row[0]])
        return text.document(self.claims, len(rows), count, (data, faces, points, cells))

    def obj(self, as_polygons=False):
        """Returns an OBJ of degree 1, with the cells, or the polygons of which they are fans."""
        number = {}
        faces, charts = [], []
        for c, (corners, uv) in enumerate(zip(self.corners, self.uv)):
            texture = [number.setdefault(p, len(number)) for p in uv]
            if as_polygons and c and self.input_face[c] == self.input_face[c - 1]:
                faces[-1].append(corners[2])
                charts[-1].append(texture[2])
            else:
                faces.append(list(corners))
                charts.append(texture)
        return obj_bytes(self.positions, faces, list(number), charts)


def read_vtu(data, mesh, is_closed):
    """Returns a result of the program as a Map; its surface, an OBJ of triangles, has the cells' order."""
    file, surface = VtuFile(data), ObjFile(mesh)
    made = Map(surface.v, [tuple(v for v, _ in f) for f in surface.faces], file.degree,
               [[(0.0, 0.0)] * 3] * len(surface.faces), is_closed)
    made.corners = [tuple(file.input_vertex[p] for p in cell[:3]) for cell in file.cells]
    made.input_face = list(range(len(file.cells)))
    made.uv = [[file.uv[p] for p in cell] for cell in file.cells]
    made.claims, made.mesh = file.claims, mesh
    return made


def read_obj(data, mesh, is_closed):
    """Returns the Map of a textured OBJ of triangles, tessellated or not, on the surface `mesh`."""
    file = ObjFile(data)
    made = Map(file.v, [tuple(v for v, _ in f) for f in file.faces], 1,
               [[file.vt[t] for _, t in f] for f in file.faces], is_closed)
    made.mesh = mesh
    return made


# ------------------------------------------------------------------ surfaces
def grid(n, m, degree, rng, holes=False, is_polygonal=False):
    """Returns n x m bumpy squares; with holes every third square of every third row is missing."""
    missing = {(i, j) for i in range(1, n - 1, 3) for j in range(1, m - 1, 3)} if holes else set()
    squares = [(i, j) for j in range(m) for i in range(n) if (i, j) not in missing]
    a, b = rng.random(), rng.random()
    positions, number, faces, places = [], {}, [], []
    for i, j in squares:
        corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
        for p in corners:
            if p not in number:
                number[p] = len(positions)
                positions.append((p[0], p[1], a * math.sin(p[0]) + b * math.cos(2 * p[1])))
        turn = rng.randrange(2)
        corners = corners[turn:] + corners[:turn]
        for part in [(0, 1, 2, 3)] if is_polygonal else [(0, 1, 2), (0, 2, 3)]:
            faces.append(tuple(number[corners[k]] for k in part))
            places.append([tuple(map(float, corners[k])) for k in part])
    return Map(positions, faces, degree, places, bool(missing))


def ring(n, m, degree, rng):
    """Returns a tube of n x m squares, mapped to an annulus."""
    scale = n / 6

    def place(i, j):
        r, angle = scale + j, 2 * math.pi * (i % n) / n
        return r * math.cos(angle), r * math.sin(angle)
    positions = [(math.cos(2 * math.pi * i / n), -math.sin(2 * math.pi * i / n), j / 2)
                 for j in range(m + 1) for i in range(n)]
    faces, places = [], []
    for j in range(m):
        for i in range(n):
            corners = [(i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j)]
            for part in [(0, 1, 2), (0, 2, 3)]:
                faces.append(tuple(corners[k][1] * n + corners[k][0] % n for k in part))
                places.append([place(*corners[k]) for k in part])
    return Map(positions, faces, degree, places, True)


def cube(n, degree, rng, sides=6):
    """Returns n x n squares on each side of a cube. Each side is a chart, and neighbours match by quarter
    turns."""
    number, positions, faces, places = {}, [], [], []
    for s, (origin, e, f) in enumerate(SIDES[:sides]):
        for i in range(n):
            for j in range(n):
                corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                space = [tuple(n * o + a * x + b * y for o, x, y in zip(origin, e, f))
                         for a, b in corners]
                for p in space:
                    if p not in number:
                        number[p] = len(positions)
                        positions.append(p)
                for part in [(0, 1, 2), (0, 2, 3)]:
                    faces.append(tuple(number[space[k]] for k in part))
                    places.append([(float(corners[k][0] + s * (n + 2)), float(corners[k][1]))
                                   for k in part])
    return Map(positions, faces, degree, places, True)


def torus(n, m, degree, rng):
    """Returns a torus mapped to a rectangle, whose sides match by translations."""
    def point(i, j):
        a, b = 2 * math.pi * i / n, -2 * math.pi * j / m
        return ((3 + math.cos(a)) * math.cos(b), (3 + math.cos(a)) * math.sin(b), math.sin(a))
    positions = [point(i, j) for j in range(m) for i in range(n)]
    faces, places = [], []
    for j in range(m):
        for i in range(n):
            corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
            for part in [(0, 1, 2), (0, 2, 3)]:
                faces.append(tuple(corners[k][1] % m * n + corners[k][0] % n for k in part))
                places.append([tuple(map(float, corners[k])) for k in part])
    return Map(positions, faces, degree, places, True)


def several(parts):
    """Returns one map of parts that share no vertex, all of one degree."""
    made = Map([], [], parts[0].degree, [])
    for k, part in enumerate(parts):
        first, faces = len(made.positions), len(made.polygons)
        made.positions += [(x + 1000 * k, y, z) for x, y, z in part.positions]
        made.polygons += [tuple(v + first for v in face) for face in part.polygons]
        made.corners += [tuple(v + first for v in corners) for corners in part.corners]
        made.input_face += [f + faces for f in part.input_face]
        made.uv += part.uv
        made.is_closed = made.is_closed or part.is_closed
    made.mesh = obj_bytes(made.positions, made.polygons)
    return made


# ------------------------------------------------------------------ bends
def noise(made, rng, strength, period=None):
    """Moves every control point by up to strength / degree; none on the border of the map, unless its
    positions are periodic (width, height)."""
    fixed = set()
    if not period:
        neighbours = {}
        for a, i, b, j in made.inner_edges():
            if made.uv[a][i] == made.uv[b][(j + 1) % 3]:
                neighbours[a, i] = neighbours[b, j] = True
        fixed = {made.uv[c][q] for c in range(len(made.uv)) for k in range(3)
                 if (c, k) not in neighbours for q in made.row(c, k)}
    reach, steps = strength / made.degree, {}

    def moved(x, y):
        if (x, y) in fixed:
            return x, y
        # Periodic copies of a position are equal up to rounding.
        key = (round(x % period[0], 6) % period[0], round(y % period[1], 6) % period[1]) \
            if period else (x, y)
        if key not in steps:
            steps[key] = rng.uniform(-reach, reach), rng.uniform(-reach, reach)
        return x + steps[key][0], y + steps[key][1]
    made.apply(moved)


def shears(rng, extent, strength):
    """Returns a polynomial bijection of the plane: consecutive shears by polynomials of slope at most
    `strength` within the extent."""
    terms = [(rng.uniform(-1, 1), rng.uniform(-1, 1)) for _ in range(rng.choice((1, 2, 2, 3)))]

    def step(t, pair):
        s = t / extent
        return extent * strength / 3 * (pair[0] * s * s + pair[1] * s * s * s)

    def bend(x, y):
        for k, pair in enumerate(terms):
            x, y = (x + step(y, pair), y) if k % 2 else (x, y + step(x, pair))
        return x, y
    return bend


def similarity(rng):
    """Returns a random rotation, scale and offset, some of them extreme."""
    angle = rng.choice((0, rng.uniform(0, 2 * math.pi)))
    scale = rng.choice((1, 1, 0.5, rng.uniform(0.1, 10), 1e-6, 1e6))
    offset = [rng.choice((0, rng.uniform(-100, 100))) * scale for _ in 'uv']
    c, s = scale * math.cos(angle), scale * math.sin(angle)
    return lambda x, y: (c * x - s * y + offset[0], s * x + c * y + offset[1])
