# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Decides coverage by position, for cells that are not triangles of a face's corners.

Neighbouring faces in one plane form a patch. Its pieces are the cells with corners in that plane and the
centre in one of its faces. All pieces must be positive in the plane. The number of pieces over a point is
then the winding number of their common boundary. If this boundary, after opposite edges cancel, is the
patch's boundary, the patch is covered exactly once. Positions agree within `Surface.tolerance`. A face that
is not flat is a patch of its own, projected along its mean normal; its pieces may be as far from the mean
plane as its corners.
"""
import math
from collections import Counter


def cover_by_place(result, surface, faces, cells, candidates, placement, findings):
    """Sets `placement` for `cells`, which must cover `faces` and nothing else."""
    patches = _patches(surface, faces)
    finder = _Finder(surface, patches)
    for c in cells:
        points = [result.positions[v] for v in result.cells[c].corners]
        patch = finder.find(points)
        placement.keys[c] = [candidates[v][0] if len(candidates[v]) == 1 else ('new', v)
                             for v in result.cells[c].corners]
        if patch is None:
            findings.bad('coverage', '%s lies on no face that is still to be covered'
                         % result.cells[c].name)
            placement.keys[c] = None
        else:
            patch.pieces.append(c)
    for patch in patches:
        _check_patch(patch, result, surface, placement, findings)


class Patch:
    """A patch. faces; normal (unit); origin: a point of its plane; depth: the largest distance of its corners
    from the plane."""

    def __init__(self, surface, faces, normal):
        self.faces, self.normal, self.pieces = faces, normal, []
        corners = [surface.positions[v] for f in faces for v in surface.faces[f]]
        self.origin = tuple(sum(c) / len(corners) for c in zip(*corners))
        self.depth = max(abs(self.height(p)) for p in corners) + surface.tolerance

    def height(self, point):
        return sum(n * (x - o) for n, x, o in zip(self.normal, point, self.origin))


def _sub(a, b):
    return tuple(x - y for x, y in zip(a, b))


def _cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def _dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def _area_vector(points):
    """Returns twice the area of a polygon in space, as a vector along its mean normal."""
    total = (0.0, 0.0, 0.0)
    for p, q in zip(points[1:], points[2:]):
        turn = _cross(_sub(p, points[0]), _sub(q, points[0]))
        total = tuple(x + y for x, y in zip(total, turn))
    return total


def _unit(vector):
    length = math.sqrt(_dot(vector, vector))
    return tuple(x / length for x in vector) if length else (0.0, 0.0, 0.0)


def _patches(surface, faces):
    """Grows patches across edges while all corners stay in the plane of the first face."""
    left, patches = set(faces), []
    for first in faces:
        if first not in left:
            continue
        left.remove(first)
        seed = Patch(surface, [first], _unit(_area_vector(
            [surface.positions[v] for v in surface.faces[first]])))
        members, stack = [first], [first] if seed.depth <= 2 * surface.tolerance else []
        while stack:
            face = surface.faces[stack.pop()]
            for a, b in zip(face, face[1:] + face[:1]):
                other = surface.sides.get((b, a))
                if other in left and _in_plane(seed, surface, other):
                    left.remove(other)
                    members.append(other)
                    stack.append(other)
        patches.append(Patch(surface, members, seed.normal) if len(members) > 1 else seed)
    return patches


def _in_plane(patch, surface, face):
    points = [surface.positions[v] for v in surface.faces[face]]
    return (all(abs(patch.height(p)) <= surface.tolerance for p in points)
            and _dot(_area_vector(points), patch.normal) > 0)


class _Finder:
    """Finds the patch on which a triangle in space lies, by a grid over the boxes of the faces."""

    def __init__(self, surface, patches):
        self.surface, self.boxes, self.limits = surface, {}, {}
        count = sum(len(patch.faces) for patch in patches)
        self.width = surface.size / max(1.0, math.sqrt(count)) or 1.0
        for patch in patches:
            for f in patch.faces:
                points = [surface.positions[v] for v in surface.faces[f]]
                low = [min(c) - patch.depth for c in zip(*points)]
                high = [max(c) + patch.depth for c in zip(*points)]
                self.limits[f] = low, high
                ranges = [range(math.floor(a / self.width), math.floor(b / self.width) + 1)
                          for a, b in zip(low, high)]
                for box in ((x, y, z) for x in ranges[0] for y in ranges[1] for z in ranges[2]):
                    self.boxes.setdefault(box, []).append((patch, f))

    def find(self, points):
        """Returns the patch whose plane contains the points and in which the centre lies deepest inside a
        face."""
        centre = tuple(sum(c) / 3 for c in zip(*points))
        best = None
        for patch, f in self.boxes.get(tuple(math.floor(c / self.width) for c in centre), ()):
            low, high = self.limits[f]
            if not all(a <= c <= b for a, c, b in zip(low, centre, high)):
                continue
            if not all(abs(patch.height(p)) <= patch.depth for p in points):
                continue
            depth = self._inside(patch, f, centre)
            if depth is not None and (best is None or depth > best[0]):
                best = depth, patch
        return best and best[1]

    def _inside(self, patch, f, point):
        """Returns how deep a point lies in a face (distance to the nearest edge of a triangle of it), or None
        outside."""
        corners = [self.surface.positions[v] for v in self.surface.faces[f]]
        winding, nearest = 0.0, math.inf
        for a, b in zip(corners, corners[1:] + corners[:1]):
            u, v = _sub(a, point), _sub(b, point)
            turn = _dot(_cross(u, v), patch.normal)
            winding += math.atan2(turn, _dot(u, v))
            nearest = min(nearest, abs(turn) / (math.dist(a, b) or 1.0))
        return nearest if winding > math.pi or nearest <= self.surface.tolerance else None


def _check_patch(patch, result, surface, placement, findings):
    name = 'face %d' % (patch.faces[0] + 1)
    if not patch.pieces:
        for f in patch.faces:
            findings.bad('coverage', 'face %d is not covered' % (f + 1))
        return
    boundary = Counter()
    for c in patch.pieces:
        points = [result.positions[v] for v in result.cells[c].corners]
        area = _dot(_area_vector(points), patch.normal)
        longest = max(math.dist(p, q) for p in points for q in points)
        if not area > -surface.tolerance * longest:
            findings.bad('orientation', '%s lies upside down on %s' % (result.cells[c].name, name))
            return
        keys = placement.keys[c]
        for a, b in zip(keys, keys[1:] + keys[:1]):
            if boundary[b, a]:
                boundary[b, a] -= 1
            else:
                boundary[a, b] += 1
    places = {}
    for c in patch.pieces:
        for key, v in zip(placement.keys[c], result.cells[c].corners):
            places[key] = result.positions[v]
    follow = {}
    for (a, b), count in boundary.items():
        if count:
            follow.setdefault(a, []).extend([b] * count)
    members = set(patch.faces)
    for f in patch.faces:
        face = surface.faces[f]
        for a, b in zip(face, face[1:] + face[:1]):
            if surface.sides.get((b, a)) in members:
                continue
            if not _walk(a, b, follow, places, surface, placement):
                findings.bad('coverage', '%s is not covered exactly once along its edge (%d, %d)'
                             % (name, a, b))
                return
    if any(follow.values()):
        findings.bad('coverage', 'the cells on %s have a boundary inside of it, or cover parts '
                     'of it twice' % name)


def _walk(a, b, follow, places, surface, placement):
    """Removes the boundary edges on the straight line from vertex a to vertex b from `follow`."""
    start, end = surface.positions[a], surface.positions[b]
    length = math.dist(start, end)
    at, reached = a, 0.0
    while at != b:
        best = None
        for key in follow.get(at, ()):
            point = end if key == b else places[key]
            along = _dot(_sub(point, start), _sub(end, start)) / (length * length)
            off = math.dist(point, tuple(x + along * (y - x) for x, y in zip(start, end)))
            if off <= surface.tolerance and reached < along <= 1 + TINY:
                if best is None or along < best[0]:
                    best = along, key
        if best is None:
            return False
        follow[at].remove(best[1])
        if (b, a) in surface.sides:
            placement.interior[at, best[1]] = a, b
        reached, at = best
    return True


TINY = 1e-12  # rounding of a position along an edge
