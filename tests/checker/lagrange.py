# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Conversion between control points and values at the lattice points of a cell (Lagrange cells).

A polynomial of degree n is fixed by its values at the points (i, j, k) / n. Its control points are rational
combinations of these values, computed in fractions, so that nothing is rounded. Those on an edge depend only
on the values on that edge, so neighbouring cells agree exactly.
"""
from fractions import Fraction
from functools import lru_cache
from math import factorial

from bernstein import vtk_order


def bernstein_value(index, point):
    """Returns B_ijk at barycentric coordinates; exact for fractions."""
    value = Fraction(factorial(sum(index)))
    for power, x in zip(index, point):
        value *= Fraction(x) ** power / factorial(power)
    return value


@lru_cache(None)
def _lattice(degree):
    """Returns the matrix whose row p has the Bernstein polynomials at the lattice point p."""
    order = vtk_order(degree)
    return [[bernstein_value(index, [Fraction(x, degree) for x in point]) for index in order]
            for point in order]


def values(points, degree):
    """Returns the values (pairs of Fractions) at the lattice points of the cell with these control points."""
    return [tuple(sum(b * Fraction(p[d]) for b, p in zip(row, points)) for d in (0, 1))
            for row in _lattice(degree)]


@lru_cache(None)
def weights(degree):
    """Returns the inverse of the matrix of Bernstein values, by Gauss-Jordan elimination: row q has the
    weights of the values at the lattice points, in VTK's order, for control point q."""
    size = len(vtk_order(degree))
    rows = [row + [Fraction(int(p == q)) for q in range(size)]
            for p, row in enumerate(_lattice(degree))]
    for column in range(size):
        pivot = next(r for r in range(column, size) if rows[r][column] != 0)
        rows[column], rows[pivot] = rows[pivot], rows[column]
        factor = rows[column][column]
        rows[column] = [x / factor for x in rows[column]]
        for r in range(size):
            if r != column and rows[r][column] != 0:
                factor = rows[r][column]
                rows[r] = [x - factor * y for x, y in zip(rows[r], rows[column])]
    return [[(place, weight) for place, weight in enumerate(row[size:]) if weight != 0]
            for row in rows]


def control_points(values, degree):
    """Returns the control points (pairs of Fractions) of the cell with these values (pairs of doubles), both
    in VTK's order."""
    if degree == 1:
        return list(values)
    exact = [tuple(map(Fraction, value)) for value in values]
    return [tuple(sum(weight * exact[place][d] for place, weight in row) for d in (0, 1))
            for row in weights(degree)]
