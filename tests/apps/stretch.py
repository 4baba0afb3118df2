# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""The L2 stretch [SSGH01] of the charts of a VTU of degree 1, each at its own scale, from the digits of the file."""
import math

from command_helpers import Vtu


def _cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def _triangle(p, t):
    """Returns (area on the surface, area in the plane, area times (Gamma^2 + gamma^2) / 2)."""
    (u0, v0), (u1, v1), (u2, v2) = t
    twice = (u1 - u0) * (v2 - v0) - (u2 - u0) * (v1 - v0)
    s = [(a * (v1 - v2) + b * (v2 - v0) + c * (v0 - v1)) / twice for a, b, c in zip(*p)]
    r = [(a * (u2 - u1) + b * (u0 - u2) + c * (u1 - u0)) / twice for a, b, c in zip(*p)]
    area = math.hypot(*_cross([b - a for a, b in zip(p[0], p[1])], [c - a for a, c in zip(p[0], p[2])])) / 2
    return area, twice / 2, area * (sum(x * x for x in s) + sum(x * x for x in r)) / 2


def stretches(path):
    """Returns the stretches by chart."""
    vtu = Vtu(path)
    points, uv = vtu.rows('Points'), vtu.rows('uv')
    sums = {}
    for cell, chart in zip(vtu.cells(), vtu.arrays['chart']):
        parts = sums.setdefault(chart, [0, 0, 0])
        for k, x in enumerate(_triangle([points[v] for v in cell], [uv[v][:2] for v in cell])):
            parts[k] += x
    return [math.sqrt(square / area * (image / area)) for _, (area, image, square) in sorted(sums.items())]
