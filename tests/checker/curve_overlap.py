# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Decides overlaps of curved cells by exact subdivision with limits (`overlap` does it for straight cells).

If every cell is positive, nothing overlaps if the boundary curves are simple and do not meet, and the loops
are nested so that the winding number is zero on the right of each.

Two pieces of curve are apart if a line separates their control polygons, or if they start at one point of the
surface and lie in separate cones from there. They cross if each passes from one side to the other of a strip
that contains the other piece. All other pairs are bisected; curves that touch between their ends stay
undecided.
"""
from collections import Counter
from fractions import Fraction
from math import comb

from exact import integers
from overlap import candidate_pairs

MAX_DEPTH = 60       # bisections of one curve
MAX_PAIRS = 20000    # pairs of pieces that are examined for one pair of curves
APART, CROSSING, TOUCHING, UNKNOWN = 'apart', 'crossing', 'touching', 'unknown'


class Piece:
    """A piece of a boundary curve. points: integers, to be divided by 2^shift; ends: a name of each end,
    equal for equal points of the surface."""
    __slots__ = 'points', 'shift', 'ends', 'depth', 'box'

    def __init__(self, points, shift, ends, depth):
        self.points, self.shift, self.ends, self.depth = points, shift, ends, depth
        xs, ys = [p[0] for p in points], [p[1] for p in points]
        self.box = min(xs), max(xs), min(ys), max(ys)

    def halves(self):
        n = len(self.points) - 1
        row, left, right = self.points, [], []
        for level in range(n + 1):
            scale = 1 << (n - level)
            left.append((row[0][0] * scale, row[0][1] * scale))
            right.append((row[-1][0] * scale, row[-1][1] * scale))
            row = [(p[0] + q[0], p[1] + q[1]) for p, q in zip(row, row[1:])]
        middle = object()  # a name that equals no other
        return (Piece(left, self.shift + n, (self.ends[0], middle), self.depth + 1),
                Piece(right[::-1], self.shift + n, (middle, self.ends[1]), self.depth + 1))

    def extent(self):
        """Returns the longer side of the bounding box, to compare pieces."""
        a, b, c, d = self.box
        return Fraction(max(b - a, d - c), 1 << self.shift)


def _common(one, other):
    """Returns the points of both pieces over a common denominator."""
    shift = max(one.shift, other.shift)
    return [[(x << shift - piece.shift, y << shift - piece.shift) for x, y in piece.points]
            for piece in (one, other)]


def _sub(a, b):
    return a[0] - b[0], a[1] - b[1]


def _cross(a, b):
    return a[0] * b[1] - a[1] * b[0]


def _dot(a, b):
    return a[0] * b[0] + a[1] * b[1]


def check_curved_overlap(sides, loops, may_touch, findings):
    """Judges the boundary of curved cells. sides: see `overlap.boundary`; loops: lists of indices into
    `sides`, in order."""
    degree = len(sides[0][2]) - 1
    flat = integers([p for _, _, row in sides for p in row])
    pieces = [Piece(flat[k * (degree + 1):(k + 1) * (degree + 1)], 0, side[:2], 0)
              for k, side in enumerate(sides)]
    verdicts = [(simple(piece), (i, i)) for i, piece in enumerate(pieces)]
    verdicts += [(meet(pieces[i], pieces[j]), (i, j))
                 for i, j in candidate_pairs([row for _, _, row in sides])]
    clean = True
    for verdict, (i, j) in verdicts:
        what = 'the edges %s and %s' % (sides[i][:2], sides[j][:2])
        if verdict == CROSSING:
            findings.bad('overlap', what + ' cross')
        elif verdict == TOUCHING and not may_touch:
            findings.bad('touching', what + ' touch')
        elif verdict != APART:
            findings.undecided('overlap', 'do %s meet?' % what)
        clean = clean and verdict == APART
    if clean:
        _check_nesting(pieces, loops, sides, findings)


# ------------------------------------------------------------------ pairs of pieces
def simple(piece):
    """Returns APART if a curve does not meet itself."""
    stack = [piece]
    while stack:
        part = stack.pop()
        chord = _sub(part.points[-1], part.points[0])
        if all(_dot(_sub(q, p), chord) > 0 for p, q in zip(part.points, part.points[1:])):
            continue  # the curve advances along its chord
        if part.depth >= MAX_DEPTH // 4:
            return UNKNOWN
        left, right = part.halves()
        verdict = meet(left, right)
        if verdict != APART:
            return verdict
        stack += [left, right]
    return APART


def meet(one, other):
    """Returns APART, CROSSING, TOUCHING or UNKNOWN for two pieces."""
    stack, looked, verdict = [(one, other)], 0, APART
    while stack:
        a, b = stack.pop()
        looked += 1
        found = _look(a, b)
        if found in (CROSSING, TOUCHING):
            return found
        if found == APART:
            continue
        if looked > MAX_PAIRS:
            return UNKNOWN
        big, small = (a, b) if a.extent() >= b.extent() else (b, a)
        if big.depth >= MAX_DEPTH:
            verdict = UNKNOWN
            continue
        stack += [(half, small) for half in big.halves()]
    return verdict


def _look(one, other):
    """Compares two control polygons. Returns None if they do not decide."""
    p, q = _common(one, other)
    shared = None
    for i, end in ((0, p[0]), (1, p[-1])):
        for j, point in ((0, q[0]), (1, q[-1])):
            if end == point:
                if one.ends[i] is not other.ends[j] and one.ends[i] != other.ends[j]:
                    return TOUCHING
                shared = i, j
    if p == q or p == q[::-1]:
        return TOUCHING
    if shared is not None:
        i, j = shared
        return APART if _separate_cones(p[::-1] if i else p, q[::-1] if j else q) else None
    for direction in ((1, 0), (0, 1), _sub(p[-1], p[0]), _sub(q[-1], q[0])):
        for normal in (direction, (-direction[1], direction[0])):
            a, b = [_dot(normal, x) for x in p], [_dot(normal, x) for x in q]
            if max(a) < min(b) or max(b) < min(a):
                return APART
    if _passes(p, q) and _passes(q, p):
        return CROSSING
    return None


def _passes(p, q):
    """Returns whether p passes from one side to the other of a strip along q's chord that contains q."""
    chord = _sub(q[-1], q[0])
    strip = [_cross(chord, _sub(x, q[0])) for x in q]
    start, end = _cross(chord, _sub(p[0], q[0])), _cross(chord, _sub(p[-1], q[0]))
    return (start < min(strip) and end > max(strip)) or (end < min(strip) and start > max(strip))


def _separate_cones(p, q):
    """Returns whether two polygons from a common start lie in cones that meet only there."""
    cones = []
    for points in (p, q):
        low = high = _sub(points[1], points[0])
        if low == (0, 0):
            return False
        for point in points[2:]:
            d = _sub(point, points[0])
            if d == (0, 0):
                return False
            # Widens the cone to contain d, which must be within half a turn of both ends.
            if _cross(low, d) < 0:
                low = d
            elif _cross(high, d) > 0:
                high = d
            if any(_dot(low, x) <= 0 for x in (high, d)) or _dot(high, d) <= 0:
                return False  # wider than a quarter turn: bisected
        cones.append((low, high))
    (a, b), (c, d) = cones
    return not (_within(a, c, d) or _within(b, c, d) or _within(c, a, b) or _within(d, a, b))


def _within(x, low, high):
    return _cross(low, x) >= 0 and _cross(x, high) >= 0 and _dot(low, x) + _dot(high, x) > 0


# ------------------------------------------------------------------ nesting
def _check_nesting(pieces, loops, sides, findings):
    """Checks that the winding number is zero on the right of every loop, for simple loops that do not meet."""
    boxes = [(min(pieces[k].box[0] for k in loop), max(pieces[k].box[1] for k in loop),
              min(pieces[k].box[2] for k in loop), max(pieces[k].box[3] for k in loop))
             for loop in loops]
    starts = Counter(pieces[k].points[0] for loop in loops for k in loop)
    for at, loop in enumerate(loops):
        free = [pieces[k].points[0] for k in loop if starts[pieces[k].points[0]] == 1]
        if not free:
            findings.undecided('overlap', 'loops meet at all their vertices')
            return
        x, y = point = free[0]
        winding = 0 if sum(_area(pieces[k].points) for k in loop) > 0 else -1
        for other, (a, b, c, d) in enumerate(boxes):
            if other != at and a <= x <= b and c <= y <= d:
                winding += sum(_crossings(pieces[k], point) for k in loops[other])
        if winding:
            findings.bad('overlap', 'the image lies on both sides of the loop with edge %s'
                         % (sides[loop[0]][:2],))


def _area(points):
    """Returns a positive multiple (the same for all curves of a degree) of the area between the curve and the
    origin: the integral of x dy - y dx."""
    n = len(points) - 1
    total = Fraction(0)
    for i, p in enumerate(points):
        for j in range(n):
            step = _sub(points[j + 1], points[j])
            total += Fraction(comb(n, i) * comb(n - 1, j) * _cross(p, step),
                              comb(2 * n - 1, i + j))
    return total


def _crossings(piece, point):
    """Counts the crossings of a curve with the ray from a point along the x-axis, upwards minus downwards;
    the curve does not contain the point."""
    stack, total = [piece], 0
    while stack:
        part = stack.pop()
        x, y = point[0] << part.shift, point[1] << part.shift
        a, b, c, d = part.box
        if b < x or y < c or y > d:
            continue
        if a > x:
            total += (part.points[-1][1] > y) - (part.points[0][1] > y)
        elif (part.points[0][1] > y) == (part.points[-1][1] > y) and part.depth > MAX_DEPTH:
            raise ArithmeticError('a point on a curve')
        else:
            stack += part.halves()
    return total


def link(edges, keys, sides):
    """Returns the loops of the boundary sides as lists of indices into `sides`. The next side at a vertex is
    found through the cells around it."""
    number = {side[:2]: k for k, side in enumerate(sides)}
    following = {}
    for edge in number:
        cell, side = edges.sides[edge]
        leaving = edge[1], keys[cell][(side + 2) % 3]
        while leaving not in number:
            cell, side = edges.sides[leaving[::-1]]
            leaving = edge[1], keys[cell][(side + 2) % 3]
        following[number[edge]] = number[leaving]
    loops, left = [], set(following)
    while left:
        loop = [left.pop()]
        while following[loop[-1]] != loop[0]:
            loop.append(following[loop[-1]])
            left.remove(loop[-1])
        loops.append(loop)
    return loops
