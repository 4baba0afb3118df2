# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Finds the face of the surface on which each cell lies, and decides whether the cells cover every face
exactly once.

Whole faces are decided by counting. Put the corners of an n-gon on a circle, in order. Triangles of its
corners with the polygon's orientation are then positive in the plane, so the number of triangles over a point
is the winding number of their common boundary. If this boundary, after opposite edges cancel, is the polygon,
the number is one everywhere inside, and the triangles are a triangulation. This needs no coordinates and
rounds nothing.

Cells that are not triangles of a face's corners (pieces of a tessellated face, edges flipped inside flat
parts) are left to `patches`, which uses the same argument in the plane of the faces.
"""
import math
from collections import Counter

from patches import cover_by_place
from result_map import ObjFile, diagonal
from vtu_file import Unreadable

TOLERANCE = 1e-9  # largest distance of a point's positions in two files, relative to the surface's size


class Surface:
    """A surface. positions; faces: tuples of vertex numbers; sides: directed edge -> its face."""

    def __init__(self, positions, faces):
        self.positions, self.faces = positions, faces
        self.sides, self.twice = {}, []
        for f, face in enumerate(faces):
            if len(set(face)) != len(face):
                raise Unreadable('the surface\'s face %d names a vertex twice' % (f + 1))
            for edge in cycle(face):
                if edge in self.sides:
                    self.twice.append(edge)
                self.sides[edge] = f
        self.measure()

    def measure(self):
        self.size = diagonal([self.positions[v] for face in self.faces for v in face])
        self.tolerance = TOLERANCE * self.size


def cycle(corners):
    return list(zip(corners, corners[1:] + corners[:1]))


def read_surface(path):
    if not path.endswith('.obj'):
        raise Unreadable('a surface is read from OBJ only')
    with open(path, 'rb') as file:
        obj = ObjFile(file.read())
    return Surface(obj.v, [tuple(v for v, _ in face) for face in obj.faces])


class Placement:
    """The faces of all cells. keys: the three corners of every cell as vertex numbers of the surface, or
    ('new', number in the file) for a corner that is no vertex of it; None for a cell on no face.
    interior: directed edges of cells that need a partner, by keys."""

    def __init__(self, count):
        self.keys, self.interior = [None] * count, {}


def place(result, surface, findings):
    """Finds every cell's face. Reports defects to `findings` (see findings.py)."""
    placement = Placement(len(result.cells))
    _to_unit_size(result, surface)
    if surface.twice:
        findings.bad('manifold', 'the surface has the edge %s twice' % (surface.twice[0],))
    candidates = _candidates(result, surface, findings)
    incident = {}
    for f, face in enumerate(surface.faces):
        for at, v in enumerate(face):
            incident.setdefault(v, {})[f] = at
    by_face, homeless = [[] for _ in surface.faces], []
    for c, cell in enumerate(result.cells):
        found, mirrored = _fit(cell, candidates, incident, by_face)
        if found:
            face, placement.keys[c] = found
            by_face[face].append((c, placement.keys[c]))
        elif mirrored is not None:
            findings.bad('orientation', '%s is the mirror image of face %d'
                         % (cell.name, mirrored + 1))
        else:
            homeless.append(c)
    left_over = []
    for f, face in enumerate(surface.faces):
        if not _covers(face, [corners for _, corners in by_face[f]]):
            left_over.append(f)
            homeless += [c for c, _ in by_face[f]]
    if left_over or homeless:
        cover_by_place(result, surface, left_over, homeless, candidates, placement, findings)
    for f in set(range(len(surface.faces))) - set(left_over):
        for a, b in cycle(surface.faces[f]):
            if (b, a) in surface.sides:
                placement.interior[a, b] = a, b
    return placement


def _to_unit_size(result, surface):
    """Scales both by a power of two, so that products of lengths neither overflow nor vanish."""
    exponent = -math.frexp(surface.size)[1]

    def scaled(points):
        return [tuple(math.ldexp(c, exponent) for c in point) for point in points]
    try:
        result.positions = scaled(result.positions)
    except OverflowError:
        raise Unreadable('the result is far larger than its surface')
    surface.positions = scaled(surface.positions)
    surface.measure()


def _covers(face, triangles):
    boundary = Counter()
    for triangle in triangles:
        for a, b in cycle(triangle):
            if boundary[b, a]:
                boundary[b, a] -= 1
            else:
                boundary[a, b] += 1
    return +boundary == Counter(cycle(face))


def _fit(cell, candidates, incident, by_face):
    """Returns ((face, keys), None), (None, the face whose mirror image the cell is), or (None, None)."""
    options = [candidates[v] for v in cell.corners]
    if not all(options):
        return None, None
    fits, mirrored = [], None
    faces = set.intersection(*[{f for v in vs for f in incident.get(v, ())} for vs in options])
    for f in faces:
        # At most one of several coincident vertices belongs to a face, unless the face is degenerate.
        keys = [next(v for v in vs if f in incident.get(v, ())) for vs in options]
        a, b, c = [incident[v][f] for v in keys]
        if a < b < c or b < c < a or c < a < b:
            fits.append((f, keys))
        elif len({a, b, c}) == 3:
            mirrored = f
    if fits:  # two faces with the same corners: both are filled
        return min(fits, key=lambda fit: len(by_face[fit[0]])), None
    return None, mirrored


def _candidates(result, surface, findings):
    """Returns for every vertex of the file its candidates among the surface's vertices: the one with its
    number if that is at its position, else all vertices at its position."""
    used = {v for cell in result.cells for v in cell.corners}
    exact = {}
    for v in sorted({v for face in surface.faces for v in face}):
        exact.setdefault(surface.positions[v], []).append(v)
    near, candidates = None, [[] for _ in result.positions]
    for v in used:
        point, number = result.positions[v], result.numbers[v]
        if number is not None and 0 <= number < len(surface.positions):
            if math.dist(point, surface.positions[number]) <= surface.tolerance:
                candidates[v] = [number]
                continue
        if result.kind == 'cells' and number is not None:
            findings.bad('vertices', 'a point says that it is vertex %d, which lies elsewhere'
                         % number)
        candidates[v] = exact.get(point, [])
        if not candidates[v]:
            near = near or _Near(exact, surface.tolerance)
            candidates[v] = near.find(point)
    return candidates


class _Near:
    """Finds points within a tolerance of a point, by a grid of boxes twice as wide."""

    def __init__(self, exact, tolerance):
        self.width, self.tolerance, self.boxes = 2 * tolerance or 1e-300, tolerance, {}
        for point, vertices in exact.items():
            self.boxes.setdefault(self._box(point), []).append((point, vertices))

    def _box(self, point):
        return tuple(math.floor(c / self.width) for c in point)

    def find(self, point):
        x, y, z = self._box(point)
        found = []
        for box in ((x + i, y + j, z + k) for i in (-1, 0, 1) for j in (-1, 0, 1)
                    for k in (-1, 0, 1)):
            for other, vertices in self.boxes.get(box, ()):
                if math.dist(point, other) <= self.tolerance:
                    found += vertices
        return found
