# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Two hundred hard-surface models: plates, blocks and solids of revolution, with 1 to 8 quads per side.

    for name, points, faces in family(): ...

Points are (x, y, z), faces tuples of corners from 0, counterclockwise from outside.
"""
import math
from itertools import product

KINDS = ('open box', 'lid', 'tray', 'shaft', 'L-block', 'gear', 'bracket')
SIDES = range(1, 9)
VARIANTS = 4


class Builder:
    """Points, identified by position, and quads between them."""

    def __init__(self):
        self.number, self.faces = {}, []

    def vertex(self, p):
        return self.number.setdefault(tuple(round(x, 9) + 0.0 for x in p), len(self.number))

    def face(self, *corners):
        face = []
        for v in map(self.vertex, corners):
            if v not in face:
                face.append(v)
        if len(face) > 2:
            self.faces.append(tuple(face))

    def patch(self, a, b, c, d, n, m=None):
        """Adds the flat quad a b c d as n by m quads."""
        m = m or n

        def at(i, j):
            s, t = i / n, j / m
            return tuple((1 - s) * (1 - t) * p + s * (1 - t) * q + s * t * r + (1 - s) * t * o
                         for p, q, r, o in zip(a, b, c, d))
        for i, j in product(range(n), range(m)):
            self.face(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1))

    def mesh(self):
        return list(self.number), self.faces


def open_box(n, width, depth, height):
    b = Builder()
    corners = [(0, 0), (width, 0), (width, depth), (0, depth)]
    low, high = ([(x, y, z) for x, y in corners] for z in (0, height))
    b.patch(*low[::-1], n)
    for k in range(4):
        b.patch(low[k], low[(k + 1) % 4], high[(k + 1) % 4], high[k], n)
    return b.mesh()


def tray(n, width, depth, height, rim):
    """Returns an open box with a rim, seen from inside, whose walls lean outwards."""
    b = Builder()

    def loop(grow, z):
        return [(-grow, -grow, z), (width + grow, -grow, z), (width + grow, depth + grow, z), (-grow, depth + grow, z)]
    loops = [loop(0, 0), loop(0.3 * height, height), loop(0.3 * height + rim, height)]
    b.patch(*loops[0], n)
    for one, other in zip(loops, loops[1:]):
        for k in range(4):
            b.patch(one[(k + 1) % 4], one[k], other[k], other[(k + 1) % 4], n)
    return b.mesh()


def lathe(n, radii_and_heights, around):
    """Returns a solid of revolution about z: n rings of quads between consecutive corners of the outline; closed on
    the axis."""
    b = Builder()
    outline = []
    for (r, z), (s, w) in zip(radii_and_heights, radii_and_heights[1:]):
        outline += [(r + (s - r) * i / n, z + (w - z) * i / n) for i in range(n)]
    outline.append(radii_and_heights[-1])

    def at(k, radius, z):
        angle = 2 * math.pi * k / around
        return radius * math.cos(angle), radius * math.sin(angle), z
    for (r, z), (s, w) in zip(outline, outline[1:]):
        for k in range(around):
            b.face(at(k, r, z), at(k + 1, r, z), at(k + 1, s, w), at(k, s, w))
    return b.mesh()


def blocks(n, xs, ys, zs, cells):
    """Returns the surface of some boxes of a grid with these planes, n by n quads for each side of a box."""
    b, planes, cells = Builder(), (xs, ys, zs), set(cells)
    for cell in sorted(cells):
        for axis, side in product(range(3), (0, 1)):
            beyond = list(cell)
            beyond[axis] += 2 * side - 1
            if tuple(beyond) in cells:
                continue
            corners = []
            for i, j in ((0, 0), (1, 0), (1, 1), (0, 1)):
                at = list(cell)
                at[axis] += side
                at[(axis + 1) % 3] += i
                at[(axis + 2) % 3] += j
                corners.append(tuple(float(plane[k]) for plane, k in zip(planes, at)))
            b.patch(*(corners if side else corners[::-1]), n)
    return b.mesh()


def gear(n, teeth, radius, depth, height):
    """Returns a ring with teeth around a bore."""
    b = Builder()
    outer, inner = [], []
    for k in range(4 * teeth):
        angle = 2 * math.pi * (k + 0.15 * (-1) ** k) / (4 * teeth)
        r = radius + (depth if k % 4 in (1, 2) else 0)
        outer.append((r * math.cos(angle), r * math.sin(angle)))
        inner.append((0.4 * radius * math.cos(angle), 0.4 * radius * math.sin(angle)))
    for k in range(4 * teeth):
        p, q, s, r = outer[k - 1], outer[k], inner[k], inner[k - 1]
        low, high = [(*x, 0) for x in (p, q, s, r)], [(*x, height) for x in (p, q, s, r)]
        b.patch(low[0], low[1], high[1], high[0], n)
        b.patch(low[2], low[3], high[3], high[2], n)
        b.patch(*high, n)
        b.patch(*low[::-1], n)
    return b.mesh()


def model(kind, n, variant):
    v = variant
    if kind == 'open box':
        return open_box(n, 1 + 0.5 * v, 1, 1 + 0.7 * (v % 3))
    if kind == 'lid':
        return open_box(n, 2 + v, 1.5, 0.2 + 0.1 * v)
    if kind == 'tray':
        return tray(n, 2 + 0.5 * v, 1.4, 0.4 + 0.2 * v, 0.15 + 0.1 * v)
    if kind == 'shaft':
        steps = [(0, 0), (1, 0), (1, 1 + v), (0.6, 1 + v), (0.6, 3 + v), (0.35, 3 + v), (0.35, 4 + v), (0, 4 + v)]
        return lathe(n, steps[:8 - 2 * (v == 3)], 8 + 4 * v)
    if kind == 'L-block':
        cells = [(0, 0, 0), (1, 0, 0), (0, 1, 0)] + [(0, 0, 1)] * (v > 1)
        return blocks(n, (0, 1, 2 + v), (0, 1 + 0.3 * v, 3), (0, 1, 2), cells)
    if kind == 'gear':
        return gear(n, 6 + 2 * v, 1, 0.25 + 0.05 * v, 0.4)
    plate = 0.12 + 0.04 * v  # bracket
    cells = [(x, y, 0) for x in range(3) for y in range(2)] + [(0, y, 1) for y in range(2)]
    cells += [(2, y, 1) for y in range(2)] * (v % 2) + [(1, 0, 1)] * (v > 1)
    return blocks(n, (0, plate, 1.2, 1.2 + plate), (0, plate, 1), (0, plate, 1), cells)


def family():
    """Yields 200 models (name, points, faces)."""
    models = [('%s %d %d' % (kind, n, v), kind, n, v) for v in range(VARIANTS) for n in SIDES for kind in KINDS]
    for name, kind, n, v in models[:200]:
        yield (name, *model(kind, n, v))
