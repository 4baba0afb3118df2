#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Judges a mesh of quads, alone or against its surface, on the digits of two OBJ files.

    quad_judge.py QUADS.obj [SURFACE.obj [DEGREES]]

With SURFACE, neither mesh may be farther from the other than NEAR. With DEGREES, edges of quads have to cover
the inner edges of the surface at which the normals of the faces differ by at least this angle. Prints a line
for every kind of defect and `ok` or `bad`; exit code 0 or 1. Shares no code with the library: signs are those
of integers, and nearest points are found by comparison with all faces.
"""
import heapq
import math
import sys
from collections import defaultdict
from math import lcm

CLOSE = 1e-9    # largest distance of a border vertex from the border, in diagonals of the surface
EQUAL = 1e-12   # relative difference of distances that count as equal
NEAR = 0.02     # largest distance between quads and surface, in diagonals of the surface
# largest distance of a corner from its surface, as a fraction of the quad's longer diagonal
ON_SURFACE = 0.01
CORNER = 35.0   # degrees: at a border vertex with at least this turn a vertex of the quads is required


def read_obj(path):
    positions, faces = [], []
    with open(path) as file:
        for line in file:
            words = line.split()
            if words[:1] == ['v']:
                positions.append(tuple(float(x) for x in words[1:4]))
            elif words[:1] == ['f']:
                numbers = [int(word.split('/')[0]) for word in words[1:]]
                faces.append([n - 1 if n > 0 else len(positions) + n for n in numbers])
    return positions, faces


def integers(points):
    """Returns points of doubles times one positive number, as integers."""
    ratios = [[x.as_integer_ratio() for x in p] for p in points]
    scale = lcm(*(d for p in ratios for _, d in p))
    return [tuple(n * (scale // d) for n, d in p) for p in ratios]


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def is_folded(corners):
    p = integers(corners)
    n = cross(minus(p[2], p[0]), minus(p[3], p[1]))
    return any(dot(cross(minus(p[(k + 1) % 4], p[k]), minus(p[(k + 3) % 4], p[k])), n) <= 0
               for k in range(4))


def agreement(corners, triangle):
    """Returns a positive number if the quad faces the same way as the triangle, a negative one if it faces
    the opposite way."""
    p = integers(list(corners) + list(triangle))
    n = cross(minus(p[2], p[0]), minus(p[3], p[1]))
    return dot(n, cross(minus(p[5], p[4]), minus(p[6], p[4])))


def nearest_on_segment(p, a, b):
    (px, py, pz), (ax, ay, az), (bx, by, bz) = p, a, b
    dx, dy, dz, ex, ey, ez = bx - ax, by - ay, bz - az, px - ax, py - ay, pz - az
    length = dx * dx + dy * dy + dz * dz
    t = min(1.0, max(0.0, (dx * ex + dy * ey + dz * ez) / length)) if length > 0 else 0.0
    return t, math.dist(p, (ax + t * dx, ay + t * dy, az + t * dz))


def distance_to_triangle(p, a, b, c):
    (px, py, pz), (ax, ay, az), (bx, by, bz), (cx, cy, cz) = p, a, b, c
    ux, uy, uz, vx, vy, vz = bx - ax, by - ay, bz - az, cx - ax, cy - ay, cz - az
    nx, ny, nz = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
    size = math.sqrt(nx * nx + ny * ny + nz * nz)
    least = min(nearest_on_segment(p, a, b)[1], nearest_on_segment(p, b, c)[1], nearest_on_segment(p, c, a)[1])
    if size > 0:
        for x, y, z, dx, dy, dz in ((ax, ay, az, ux, uy, uz), (bx, by, bz, cx - bx, cy - by, cz - bz),
                                    (cx, cy, cz, -vx, -vy, -vz)):
            ex, ey, ez = px - x, py - y, pz - z
            if (dy * ez - dz * ey) * nx + (dz * ex - dx * ez) * ny + (dx * ey - dy * ex) * nz < 0:
                break
        else:  # above its inside
            least = min(least, abs((px - ax) * nx + (py - ay) * ny + (pz - az) * nz) / size)
    return least


class Nearest:
    """The faces nearest to a point: several if it is nearest to an edge or a vertex. Searches a binary tree
    of boxes, split along the longest side; nearer boxes are opened first, until the next is farther than the
    nearest face. Results are cached."""
    LEAF = 2  # faces

    def __init__(self, mesh):
        self.mesh, self.known = mesh, {}
        middles = [middle(mesh.corner_points(f)) for f in range(len(mesh.faces))]

        def box(faces):
            points = [p for f in faces for p in mesh.corner_points(f)]
            lows, highs = tuple(map(min, zip(*points))), tuple(map(max, zip(*points)))
            if len(faces) <= self.LEAF:
                return lows, highs, [(f, *mesh.corner_points(f)) for f in faces], None
            axis = max(range(3), key=lambda k: highs[k] - lows[k])
            faces = sorted(faces, key=lambda f: middles[f][axis])
            half = len(faces) // 2
            return lows, highs, None, (box(faces[:half]), box(faces[half:]))
        self.root = box(list(range(len(mesh.faces))))

    def __call__(self, p, close=0.0):
        """Returns the nearest faces. close: the distance by which others may be farther than the nearest one."""
        if (p, close) in self.known:
            return self.known[p, close]
        least, distances, number, queue = math.inf, {}, 0, [(0.0, 0, self.root)]
        while queue:
            bound, _, (_, _, faces, halves) = heapq.heappop(queue)
            if bound > least * (1 + EQUAL) + close:
                break
            for f, *corners in faces or ():
                distances[f] = distance_to_triangle(p, *corners)
                least = min(least, distances[f])
            for half in halves or ():
                number += 1  # boxes at equal distances are not compared
                off = [max(low - x, 0.0, x - high) for low, x, high in zip(half[0], p, half[1])]
                heapq.heappush(queue, (math.hypot(*off), number, half))
        found = [f for f, distance in distances.items() if distance <= least * (1 + EQUAL) + close]
        self.known[p, close] = found
        return found

    def distance(self, p):
        return distance_to_triangle(p, *self.mesh.corner_points(self(p)[0]))


class Mesh:
    def __init__(self, positions, faces):
        self.positions, self.faces = [tuple(p) for p in positions], faces
        self.sides = defaultdict(list)  # directed edge -> faces
        for f, face in enumerate(faces):
            for edge in zip(face, face[1:] + face[:1]):
                self.sides[edge].append(f)

    def corner_points(self, f):
        return [self.positions[v] for v in self.faces[f]]

    def edge_defects(self):
        found = set()
        for (a, b), faces in self.sides.items():
            total = len(faces) + len(self.sides.get((b, a), ()))
            if total > 2:
                found.add('crowded edge')
            elif len(faces) > 1:
                found.add('opposed edge')
        return found

    def has_touching_vertex(self):
        """Returns whether a vertex has faces that are not joined around it by edges."""
        around = defaultdict(list)
        for f, face in enumerate(self.faces):
            for v in face:
                around[v].append(f)
        for v, faces in around.items():
            seen, todo = {faces[0]}, [faces[0]]
            while todo:
                face = self.faces[todo.pop()]
                k = face.index(v)
                for other in (face[(k + 1) % len(face)], face[k - 1]):
                    for g in self.sides.get((v, other), []) + self.sides.get((other, v), []):
                        if g not in seen:
                            seen.add(g)
                            todo.append(g)
            if len(seen) != len(faces):
                return True
        return False

    def component_names(self):
        """Returns for every face one face of its component, the same for all faces of the component."""
        name = list(range(len(self.faces)))

        def find(f):
            while name[f] != f:
                name[f] = name[name[f]]
                f = name[f]
            return f
        for (a, b), faces in self.sides.items():
            for f in faces + self.sides.get((b, a), []):
                name[find(f)] = find(faces[0])
        return [find(f) for f in range(len(self.faces))]

    def components(self):
        """Returns the Euler characteristic and number of border loops of each component, sorted."""
        names = self.component_names()
        parts = [Mesh(self.positions, [face for face, of in zip(self.faces, names) if of == name])
                 for name in set(names)]
        return sorted((part.euler(), len(part.loops())) for part in parts)

    def loops(self):
        """Returns the border loops as vertices, with the faces on their left."""
        then = {a: b for (a, b) in self.sides if (b, a) not in self.sides}
        found = []
        while then:
            first, v, loop = min(then), min(then), []
            while v in then:
                loop.append(v)
                v = then.pop(v)
            assert v == first
            found.append(loop)
        return found

    def euler(self):
        vertices = {v for face in self.faces for v in face}
        edges = {tuple(sorted(edge)) for edge in self.sides}
        return len(vertices) - len(edges) + len(self.faces)


def border_defects(quads, surface):
    found, used = set(), set()
    corners = [surface.positions[v] for face in surface.faces for v in face]
    close = CLOSE * math.dist(*[tuple(pick(x) for x in zip(*corners)) for pick in (min, max)])
    theirs = surface.loops()
    edges = [(n, i, surface.positions[a], surface.positions[b]) for n, loop in enumerate(theirs)
             for i, (a, b) in enumerate(zip(loop, loop[1:] + loop[:1]))]
    at = {}  # position: the vertices there
    for n, loop in enumerate(theirs):
        for i, v in enumerate(loop):
            at.setdefault(tuple(surface.positions[v]), []).append((n, i))

    def places_of(p):
        distance, n, along = min((nearest_on_segment(p, a, b)[1], n, i + nearest_on_segment(p, a, b)[0])
                                 for n, i, a, b in edges)
        if distance > close:
            found.add('off the border')
        shared = [places for q, places in at.items() if len(places) > 1 and math.dist(p, q) <= close]
        return shared[0] if shared else [(n, along)]

    def follows(places, n):
        """Returns whether choosing one place for every vertex leads once around a loop; tries all places of
        the first vertex."""
        choices = [[along for m, along in of_vertex if m == n] for of_vertex in places]
        if not all(choices):
            return False
        length = len(theirs[n])

        def around(start):
            here, sum_of_steps = start, 0.0
            for there in choices[1:] + [[start]]:
                step, here = min(((t - here) % length or length, t) for t in there)
                sum_of_steps += step
            return sum_of_steps
        return min(around(start) for start in choices[0]) < 1.5 * length

    for loop in quads.loops():
        places = [places_of(quads.positions[v]) for v in loop]
        free = [m for m, _ in places[0] if m not in used and follows(places, m)]
        if not free:
            found.add('border not followed')
        n = free[0] if free else places[0][0][0]
        used.add(n)
        for a, b, c in zip(theirs[n][-1:] + theirs[n][:-1], theirs[n], theirs[n][1:] + theirs[n][:1]):
            into, out = (minus(surface.positions[b], surface.positions[a]),
                         minus(surface.positions[c], surface.positions[b]))
            turn = math.degrees(math.atan2(math.sqrt(dot(cross(into, out), cross(into, out))), dot(into, out)))
            if turn >= CORNER and all(math.dist(quads.positions[v], surface.positions[b]) > close for v in loop):
                found.add('corner missed')
    return found


def angle_between(a, b):
    n = cross(a, b)
    return math.degrees(math.atan2(math.sqrt(dot(n, n)), dot(a, b)))


def feature_lines(surface, degrees):
    """Returns the sharp edges as lists of vertices from corner to corner; a line without a corner starts at
    any vertex."""
    normals = []
    for f in range(len(surface.faces)):
        a, b, c = surface.corner_points(f)
        n = cross(minus(b, a), minus(c, a))
        size = math.sqrt(dot(n, n))
        normals.append(tuple(x / size for x in n))
    neighbours, border = defaultdict(set), set()
    for (a, b), (f, *_) in list(surface.sides.items()):
        back = surface.sides.get((b, a), [])
        if not back:
            border |= {a, b}
        elif angle_between(normals[f], normals[back[0]]) >= degrees:
            neighbours[a].add(b)

    def is_corner(v):
        if len(neighbours[v]) != 2 or v in border:
            return True
        a, b = neighbours[v]
        p = surface.positions
        return angle_between(minus(p[v], p[a]), minus(p[b], p[v])) >= CORNER
    corners = {v for v in list(neighbours) if is_corner(v)}
    left = {frozenset((v, w)) for v in list(neighbours) for w in neighbours[v]}
    lines = []
    for start in sorted(corners) + sorted(set(neighbours) - corners):
        for second in sorted(neighbours[start]):
            if frozenset((start, second)) not in left:
                continue
            line = [start, second]
            left.remove(frozenset(line))
            while line[-1] not in corners and line[-1] != start:
                line.append(next(w for w in neighbours[line[-1]] if frozenset((line[-1], w)) in left))
                left.remove(frozenset(line[-2:]))
            lines.append(line)
    return lines, corners


def is_covered(quads, surface, line, is_loop, close):
    """Returns whether edges join the vertices of quads on a line, in order, from end to end."""
    points = [surface.positions[v] for v in line]
    edges = {frozenset(side) for side in quads.sides}
    found = []
    for v in {v for face in quads.faces for v in face}:
        p = quads.positions[v]
        near = [(distance, i + t) for i, (a, b) in enumerate(zip(points, points[1:]))
                for t, distance in [nearest_on_segment(p, a, b)] if distance <= close]
        if near:
            along = min(near)[1]
            is_end = [math.dist(p, end) <= close for end in (points[0], points[-1])]
            found += [(along, v)] if is_loop or not any(is_end) else [
                (end, v) for end, here in zip((0, len(line) - 1), is_end) if here]
    found.sort()
    if is_loop:
        found.append(found[0] if found else None)
    elif not found or found[0][0] != 0 or found[-1][0] != len(line) - 1:
        return False
    return len(found) > 1 and all(frozenset((a, b)) in edges for (_, a), (_, b) in zip(found, found[1:]))


def feature_defects(quads, surface, degrees):
    lines, corners = feature_lines(surface, degrees)
    points = [surface.positions[v] for face in surface.faces for v in face]
    close = CLOSE * math.dist(*[tuple(pick(x) for x in zip(*points)) for pick in (min, max)])
    return set() if all(is_covered(quads, surface, line, line[0] == line[-1] and line[0] not in corners, close)
                        for line in lines) else {'feature not covered'}


def diagonal(mesh):
    points = [mesh.positions[v] for face in mesh.faces for v in face]
    return math.dist(*[tuple(pick(x) for x in zip(*points)) for pick in (min, max)])


def is_turned(quads, f, surface, nearest):
    """Returns whether a quad faces away from a face nearest to its middle, and has a corner that is off the
    surface or faces away from all nearest faces there; or faces away at three corners on the surface."""
    corners = quads.corner_points(f)
    close = CLOSE * diagonal(surface)
    most = ON_SURFACE * max(math.dist(corners[0], corners[2]), math.dist(corners[1], corners[3])) + close
    signs = [[agreement(corners, surface.corner_points(g)) for g in nearest(p, close)]
             if nearest.distance(p) <= most else [] for p in corners]
    if sum(bool(at) and max(at) < 0 for at in signs) > 2:
        return True
    centre = tuple(sum(x) / 4 for x in zip(*corners))
    return (not all(at and max(at) > 0 for at in signs)
            and any(agreement(corners, surface.corner_points(g)) < 0 for g in nearest(centre)))


def middle(points):
    return tuple(sum(x) / len(points) for x in zip(*points))


def is_far(quads, surface, nearest, near):
    """Returns whether the quads are away from the surface or the surface from the quads by more than this
    fraction of its diagonal, at vertices and at the middles of faces and edges."""
    halves = Mesh(quads.positions, [half for a, b, c, d in quads.faces for half in ((a, b, c), (a, c, d))])
    back, most = Nearest(halves), near * diagonal(surface)

    def samples(mesh):
        corners = [mesh.corner_points(f) for f in range(len(mesh.faces))]
        return {p for points in corners for p in points} | {middle(points) for points in corners}
    edges = {middle([quads.positions[a], quads.positions[b]]) for a, b in quads.sides}
    return (any(nearest.distance(p) > most for p in samples(quads) | edges)
            or any(back.distance(p) > most for p in samples(surface)))


def judge(quads, surface=None, degrees=None, near=NEAR):
    """Returns the kinds of defects of a mesh (positions, faces), with or without a surface. degrees: the
    angle of its features, or None; near: see is_far()."""
    quads = Mesh(*quads)
    if not quads.faces or any(len(face) != 4 or len(set(face)) != 4 for face in quads.faces):
        return {'no quads'}
    found = quads.edge_defects()
    if found:
        return found
    if quads.has_touching_vertex():
        return {'touching vertex'}
    if any(is_folded(quads.corner_points(f)) for f in range(len(quads.faces))):
        found.add('folded')
    if surface is None:
        return found
    surface = Mesh(*surface)
    ours, theirs = quads.components(), surface.components()
    loops = [sum(part[1] for part in parts) for parts in (ours, theirs)]
    if sum(part[0] for part in ours) != sum(part[0] for part in theirs):
        found.add('Euler characteristic')
    if len(ours) != len(theirs):
        found.add('components')
    if loops[0] != loops[1]:
        found.add('border loops')
    if ours != theirs and not found & {'Euler characteristic', 'components', 'border loops'}:
        found.add('other components')
    if loops[0] == loops[1] > 0:
        found |= border_defects(quads, surface)
    if degrees is not None:
        found |= feature_defects(quads, surface, degrees)
    nearest = Nearest(surface)
    if any(is_turned(quads, f, surface, nearest) for f in range(len(quads.faces))):
        found.add('turned')
    if is_far(quads, surface, nearest, near):
        found.add('far')
    return found


def main():
    defects = judge(read_obj(sys.argv[1]), read_obj(sys.argv[2]) if len(sys.argv) > 2 else None,
                    float(sys.argv[3]) if len(sys.argv) > 3 else None)
    for defect in sorted(defects):
        print(defect)
    print('bad' if defects else 'ok')
    sys.exit(bool(defects))


if __name__ == '__main__':
    main()
