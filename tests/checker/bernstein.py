# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Decides exactly whether det J > 0 on the closed triangle: the definition of an injective Bezier cell.

A cell of degree n is sum B_ijk(a, b, c) p_ijk, |ijk| = n, with Bernstein polynomials B_ijk = n!/(i! j! k!)
a^i b^j c^k in barycentric coordinates. Its determinant is a polynomial of degree 2n - 2. If all its Bernstein
coefficients are positive, so is the polynomial; its coefficients at the corners are its values there. Under
bisection the coefficients converge to the values, which decides the sign unless the minimum is zero at a
point that is no corner of any piece. The depth limit then gives `UNDECIDED`.
"""
from functools import lru_cache
from math import comb

from exact import UNIT, integers

POSITIVE, NOT_POSITIVE, UNDECIDED = 'positive', 'not positive', 'undecided'
MAX_DEPTH = 80      # Bisections of one triangle: edges of pieces are 2^-40 of the cell's.
MAX_PIECES = 6000   # pieces of one triangle


@lru_cache(None)
def vtk_order(degree):
    """Returns index triples (i, j, k), where i belongs to the first corner, in VTK's order: corners, edges
    01, 12, 20, then the interior as a triangle of degree n - 3."""
    if degree == 0:
        return [(0, 0, 0)]
    n = degree
    order = [(n, 0, 0), (0, n, 0), (0, 0, n)]
    order += [(n - s, s, 0) for s in range(1, n)]
    order += [(0, n - s, s) for s in range(1, n)]
    order += [(s, 0, n - s) for s in range(1, n)]
    if n >= 3:
        order += [(i + 1, j + 1, k + 1) for i, j, k in vtk_order(n - 3)]
    return order


@lru_cache(None)
def edge_points(degree, side):
    """Returns the places, in VTK's order, of the control points from corner `side` to the next one."""
    inner = [3 + side * (degree - 1) + s for s in range(degree - 1)]
    return [side] + inner + [(side + 1) % 3]


@lru_cache(None)
def _products(degree):
    """Returns for every coefficient of det J: its weight, the derivative r by b, the derivative s by c, and
    the places of the differences' ends in VTK's order. The common positive factor n^2/C(...) is left out."""
    place = {index: q for q, index in enumerate(vtk_order(degree))}
    lower = [(i, j, degree - 1 - i - j) for i in range(degree) for j in range(degree - i)]
    ends = [(place[i + 1, j, k], place[i, j + 1, k], place[i, j, k + 1]) for i, j, k in lower]
    sums = {}
    for p, r in enumerate(lower):
        for q, s in enumerate(lower):
            t = tuple(x + y for x, y in zip(r, s))
            weight = comb(t[0], r[0]) * comb(t[1], r[1]) * comb(t[2], r[2])
            sums.setdefault(t, []).append((weight, p, q))
    return ends, sums


def determinant(points, degree):
    """Returns the Bernstein coefficients {(i, j, k): value} of a positive multiple of det J. Exact for
    integers and fractions."""
    ends, sums = _products(degree)
    by_b = [(points[b][0] - points[a][0], points[b][1] - points[a][1]) for a, b, _ in ends]
    by_c = [(points[c][0] - points[a][0], points[c][1] - points[a][1]) for a, _, c in ends]
    return {t: sum(w * (by_b[p][0] * by_c[q][1] - by_b[p][1] * by_c[q][0]) for w, p, q in terms)
            for t, terms in sums.items()}


def _surely_positive(points, degree):
    """Returns whether all coefficients are positive in spite of rounding: each term has an error below 4
    units of its size, the sum of m terms of m more."""
    ends, sums = _products(degree)
    by_b = [(points[b][0] - points[a][0], points[b][1] - points[a][1]) for a, b, _ in ends]
    by_c = [(points[c][0] - points[a][0], points[c][1] - points[a][1]) for a, _, c in ends]
    products = [[(b[0] * c[1], b[1] * c[0]) for c in by_c] for b in by_b]
    for terms in sums.values():
        value = size = 0.0
        for w, p, q in terms:
            left, right = products[p][q]
            value += w * (left - right)
            size += w * (abs(left) + abs(right))
        if not (1e-280 < size < 1e300 and value > (2 * len(terms) + 10) * UNIT * size):
            return False
    return True


def positivity(points, degree):
    """Returns POSITIVE, NOT_POSITIVE or UNDECIDED for a cell's control points (pairs of doubles, VTK's
    order)."""
    if _surely_positive(points, degree):
        return POSITIVE
    return polynomial_positivity(determinant(integers(points), degree), 2 * degree - 2)


def polynomial_positivity(coefficients, degree):
    """Decides the sign of a polynomial from its Bernstein coefficients (integers or fractions)."""
    stack, pieces = [(coefficients, 0)], 0
    undecided = False
    corners = [(degree, 0, 0), (0, degree, 0), (0, 0, degree)]
    while stack:
        piece, depth = stack.pop()
        if any(piece[corner] <= 0 for corner in corners):
            return NOT_POSITIVE
        if min(piece.values()) > 0:
            continue
        pieces += 1
        if depth == MAX_DEPTH or pieces > MAX_PIECES:
            undecided = True  # another piece may still be a witness
            if pieces > MAX_PIECES:
                break
            continue
        stack += [(half, depth + 1) for half in bisect(piece, degree)]
    return UNDECIDED if undecided else POSITIVE


def bisect(piece, degree):
    """Returns the halves of a triangle, cut from its first corner A to the middle M of BC, as (M, A, B) and
    (M, C, A). The corners are rotated so that repeated bisection cuts every edge. Coefficients are multiplied
    by 2^degree, so that integers stay integers."""
    first, second = {}, {}
    for i in range(degree + 1):
        row = [piece[i, degree - i - k, k] for k in range(degree - i + 1)]  # from B to C
        length = degree - i
        scale = 1 << i
        for level in range(length + 1):
            # After `level` averages: the ends of the row belong to the halves next to B and C.
            rest = length - level
            factor = scale << rest
            first[level, i, rest] = row[0] * factor
            second[level, rest, i] = row[-1] * factor
            row = [x + y for x, y in zip(row, row[1:])]
    return first, second
