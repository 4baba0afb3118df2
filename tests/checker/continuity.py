# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Checks whether the map is continuous across the inner edges of the surface, by the values of the control
points on both sides and not by point numbers of the file.

Two sides whose control points have equal values are one curve. All other edges are cuts. A cut is a seam if a
rotation by quarter turns and a translation take one side to the other, within SEAM_TOLERANCE of the layout's
diagonal.
"""
from result_map import diagonal
from surface import cycle

SEAM_TOLERANCE = 1e-9
_TURNS = ((1, 0), (0, 1), (-1, 0), (0, -1))  # powers of i


class Edges:
    """The classified edges. sides: (key, key) -> (cell, side); equal: directed edges whose partner has the
    same values; seams: directed edge -> k, where side = i^k partner + t; cuts: the other directed edges with
    a partner."""

    def __init__(self):
        self.sides, self.equal, self.seams, self.cuts = {}, set(), {}, set()


def join(result, keys, findings):
    """Classifies all edges between cells. keys: three vertices per cell; None leaves a cell out."""
    edges = Edges()
    for c, corners in enumerate(keys):
        for side, edge in enumerate(cycle(corners) if corners else ()):
            if edge in edges.sides:
                findings.bad('manifold', '%s and %s have an edge in the same direction'
                             % (result.cells[edges.sides[edge][0]].name, result.cells[c].name))
            edges.sides[edge] = c, side
    size = diagonal([p for cell in result.cells for p in cell.uv])
    for (a, b), (c, side) in edges.sides.items():
        other = edges.sides.get((b, a))
        if other is None:
            continue
        row = result.cells[c].row(side, result.degree)
        partner = result.cells[other[0]].row(other[1], result.degree)[::-1]
        turn = None
        if row == partner:
            edges.equal.add((a, b))
            continue
        turn = _quarter_turns(row, partner, SEAM_TOLERANCE * size)
        if turn is None:
            edges.cuts.add((a, b))
        else:
            edges.seams[a, b] = turn
    return edges


def _quarter_turns(row, partner, tolerance):
    """Returns k with row = i^k partner + t up to the tolerance, or None."""
    (x, y), (p, q) = row[0], partner[0]
    steps = [(u - x, v - y) for u, v in row]
    others = [(u - p, v - q) for u, v in partner]
    best = None
    for k, (c, s) in enumerate(_TURNS):
        worst = max(max(abs(u - (c * a - s * b)), abs(v - (s * a + c * b)))
                    for (u, v), (a, b) in zip(steps, others))
        if worst <= tolerance and (best is None or worst < best[0]):
            best = worst, k
    return best and best[1]


def charts(result, edges):
    """Returns the number of charts: components of cells joined by continuous edges."""
    parent = list(range(len(result.cells)))

    def root(c):
        while parent[c] != c:
            parent[c] = parent[parent[c]]
            c = parent[c]
        return c
    for a, b in edges.equal:
        parent[root(edges.sides[a, b][0])] = root(edges.sides[b, a][0])
    return len({root(c) for c in range(len(result.cells))})
