# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Decides exactly, in integers, whether the image of a map with straight cells overlaps or touches itself.

If every cell is positive, the number of surface points over a point of the plane is the winding number of the
boundary of all charts, which has the surface on its left. It is zero far away and changes at boundary
segments only, so nothing overlaps if and only if it is at most one on both sides of every segment. Segments
that cross are an overlap. All others are cut at their common points; the number is then constant along each
side of a part.

Boundary points that coincide although they are different points of the surface touch: the map does not
overlap, but is not injective. Two copies of one vertex may coincide.
"""
import math
from collections import Counter

from exact import cross, integers


def boundary(result, keys):
    """Returns the sides of cells without a continuous partner as (first key, last key, control points). Cells
    that share a directed edge or lie on no face (keys None) keep their sides."""
    sides, partners = [], Counter()
    for c, cell in enumerate(result.cells):
        corners = keys[c] or [('file', v) for v in cell.corners]
        for side in range(3):
            row = cell.row(side, result.degree)
            sides.append((corners[side], corners[(side + 1) % 3], row))
            partners[sides[-1][0], sides[-1][1], tuple(row)] += 1
    left = []
    for a, b, row in sides:
        if partners[b, a, tuple(row[::-1])]:
            partners[b, a, tuple(row[::-1])] -= 1
        else:
            left.append((a, b, row))
    return left


def check_straight_overlap(sides, may_touch, findings):
    """Judges the boundary of a map of degree 1 with positive cells only. sides: see `boundary`."""
    points = integers([p for _, _, row in sides for p in row])
    segments = list(zip(points[::2], points[1::2]))
    keys = [side[:2] for side in sides]
    contacts = [set() for _ in segments]
    touching = []
    for i, j in candidate_pairs([row for _, _, row in sides]):
        meeting = _meet(segments[i], segments[j])
        if meeting is None:
            findings.bad('overlap', 'the edges %s and %s cross' % (keys[i], keys[j]))
            continue
        for point, one, other in meeting:
            contacts[i].add(point)
            contacts[j].add(point)
            same = one is not None and other is not None and keys[i][one] == keys[j][other]
            if not same:
                touching.append((i, j))
    if 'overlap' not in findings.violations:
        _check_winding(segments, contacts, keys, findings)
    if not may_touch:
        for i, j in touching:
            findings.bad('touching', 'the edges %s and %s touch' % (keys[i], keys[j]))


def candidate_pairs(rows):
    """Returns pairs (i, j), i < j, of control polygons whose boxes may meet, by a grid."""
    boxes = [(min(x for x, _ in row), max(x for x, _ in row),
              min(y for _, y in row), max(y for _, y in row)) for row in rows]
    left, low = min(b[0] for b in boxes), min(b[2] for b in boxes)
    extent = max(max(b[1] for b in boxes) - left, max(b[3] for b in boxes) - low)
    width = extent / math.sqrt(len(rows)) or 1.0
    grid = {}
    for i, row in enumerate(rows):
        for column, bottom, top in _columns(row, boxes[i], left, width, 1e-9 * extent):
            for y in range(math.floor((bottom - low) / width),
                           math.floor((top - low) / width) + 1):
                grid.setdefault((column, y), []).append(i)
    found = set()
    for members in grid.values():
        for at, i in enumerate(members):
            a, b, c, d = boxes[i]
            for j in members[at + 1:]:
                e, f, g, h = boxes[j]
                if a <= f and e <= b and c <= h and g <= d:
                    found.add((i, j))
    return found


def _columns(row, box, left, width, margin):
    """Returns (column of the grid, lowest y, highest y) of a control polygon. For a segment only its part in
    the column counts, with a margin far above rounding."""
    x, z, bottom, top = box
    first, last = math.floor((x - left) / width), math.floor((z - left) / width)
    if len(row) > 2 or first == last:
        return [(column, bottom, top) for column in range(first, last + 1)]
    slope = (row[1][1] - row[0][1]) / (row[1][0] - row[0][0])
    columns = []
    for column in range(first, last + 1):
        ends = [min(max(left + c * width, x), z) for c in (column, column + 1)]
        ys = [row[0][1] + slope * (e - row[0][0]) for e in ends]
        columns.append((column, max(bottom, min(ys) - margin), min(top, max(ys) + margin)))
    return columns


def _meet(one, other):
    """Returns None if two segments cross; else their common points, each with the end (0, 1 or None) of
    either segment. For a common part these are its ends."""
    (p, q), (r, s) = one, other
    sides = cross(p, q, r), cross(p, q, s), cross(r, s, p), cross(r, s, q)
    if sides[0] * sides[1] < 0 and sides[2] * sides[3] < 0:
        return None
    found = {}
    for point, side in ((r, sides[0]), (s, sides[1])):
        if side == 0 and _between(p, q, point):
            found[point] = _end(one, point), _end(other, point)
    for point, side in ((p, sides[2]), (q, sides[3])):
        if side == 0 and _between(r, s, point):
            found[point] = _end(one, point), _end(other, point)
    return [(point, *ends) for point, ends in found.items()]


def _between(a, b, point):
    return (min(a[0], b[0]) <= point[0] <= max(a[0], b[0])
            and min(a[1], b[1]) <= point[1] <= max(a[1], b[1]))


def _end(segment, point):
    return segment.index(point) if point in segment else None


def _check_winding(segments, contacts, keys, findings):
    """Checks the winding numbers on both sides of every part of every segment, once for each run of segments
    whose common points are on no others."""
    ends = {}
    for i, (a, b) in enumerate(segments):
        ends.setdefault(a, []).append(i)
        ends.setdefault(b, []).append(i)
    counter = _Winding(segments)
    seen = set()
    for i, (a, b) in enumerate(segments):
        inner = sorted((p for p in contacts[i] if p not in (a, b)),
                       key=lambda p: abs(p[0] - a[0]) + abs(p[1] - a[1]))
        cuts = [a] + inner + [b]
        if not inner and i in seen:
            continue
        for u, v in zip(cuts, cuts[1:]):
            if counter.right_of(u, v) > 1 or counter.right_of(v, u) > 1:
                findings.bad('overlap', 'the image lies twice beside the edge %s' % (keys[i],))
                return
        if not inner:
            _follow(i, segments, contacts, ends, seen)


def _follow(i, segments, contacts, ends, seen):
    """Marks the segments that follow i through points where exactly two segments meet."""
    while i not in seen:
        seen.add(i)
        a, b = segments[i]
        at = ends[b]
        if len(at) != 2:
            return
        j = at[0] if at[1] == i else at[1]
        if segments[j][0] != b or not contacts[j] <= set(segments[j]):
            return
        i = j


class _Winding:
    """The winding numbers of all segments around points, by bands of the y-axis."""

    def __init__(self, segments):
        self.segments = segments
        self.low = min(y for segment in segments for _, y in segment)
        self.height = sum(abs(b[1] - a[1]) for a, b in segments) // len(segments) + 1
        self.bands = {}
        for segment in segments:
            y, z = sorted((segment[0][1], segment[1][1]))
            if y == z:
                continue
            for band in range((y - self.low) // self.height, (z - self.low) // self.height + 1):
                self.bands.setdefault(band, []).append(segment)

    def right_of(self, u, v):
        """Returns the number just right of the middle of a part u, v of segments on which no other segment
        ends."""
        mid = u[0] + v[0], u[1] + v[1]  # twice the middle
        normal = v[1] - u[1], u[0] - v[0]
        winding = 0
        for a, b in self.bands.get((mid[1] // 2 - self.low) // self.height, ()):
            above = (2 * a[1] <= mid[1], 2 * b[1] <= mid[1])
            if normal[1] < 0:  # the point is infinitesimally lower
                above = (2 * a[1] < mid[1], 2 * b[1] < mid[1])
            if above[0] == above[1]:
                continue
            d = b[0] - a[0], b[1] - a[1]
            side = d[0] * (mid[1] - 2 * a[1]) - d[1] * (mid[0] - 2 * a[0])
            side = side or d[0] * normal[1] - d[1] * normal[0]
            if above[0] and side > 0:
                winding += 1
            elif above[1] and side < 0:
                winding -= 1
        return winding
