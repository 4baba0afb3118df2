# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Exact arithmetic on doubles. Every finite double is an integer times a power of two, so signs of
polynomials are found in Python's integers, without rounding and much faster than in fractions."""
from math import lcm

# Half a unit in the last place of 1: the relative error of one operation on doubles.
UNIT = 2.0 ** -53


def integers(points):
    """Returns points (pairs of doubles, integers or Fractions) times one common positive number, a power of
    two for doubles, as pairs of integers."""
    ratios = [(x.as_integer_ratio(), y.as_integer_ratio()) for x, y in points]
    scale = 1
    for (_, a), (_, b) in ratios:
        scale = lcm(scale, a, b)
    return [(n * (scale // d), m * (scale // e)) for (n, d), (m, e) in ratios]


def cross(a, b, c):
    """Returns twice the signed area of the triangle a, b, c; exact for integers and fractions."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def orientation(a, b, c):
    """Returns the exact sign (1, 0 or -1) of the area of a triangle of doubles.

    The filter: a product and its two differences have an error of at most three units, the last subtraction
    of one. 8 units of the products' size are a bound unless a number underflows. Smaller values are computed
    in integers.
    """
    left = (b[0] - a[0]) * (c[1] - a[1])
    right = (b[1] - a[1]) * (c[0] - a[0])
    area, size = left - right, abs(left) + abs(right)
    if 1e-280 < size < 1e300 and abs(area) > 8 * UNIT * size:
        return 1 if area > 0 else -1
    exact = cross(*integers([a, b, c]))
    return (exact > 0) - (exact < 0)
