# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that the sectors around every inner vertex add up to one turn. det J > 0 alone allows a fan that
winds twice around its centre.

A sector is the angle between the tangents of its cell's two edges at the corner, which point to the control
points next to it. It is positive and less than half a turn, since det J > 0 at the corner. At a vertex
without cuts, the last tangent of a sector is the first one of the next sector, so turns are counted exactly,
as the number of sectors that contain the direction of the x-axis. At a vertex with seams, the sum is a
multiple of a quarter turn, which the seams' rotations determine modulo four.
"""
import math
from collections import Counter

from exact import orientation
from surface import cycle

# Tolerance, in quarter turns, of a sum at a vertex with seams: the seams' own tolerance and the error of
# atan2.
ROUNDING = 0.1


def _neighbours(degree, corner):
    """Returns the places, in VTK's order, of the control points next to a corner: on its leaving and its
    arriving edge."""
    if degree == 1:
        return (corner + 1) % 3, (corner + 2) % 3
    per_edge = degree - 1
    return 3 + corner * per_edge, 2 + ((corner + 2) % 3 + 1) * per_edge


def _lower(origin, point):
    """Returns whether the direction from origin to point is in [pi, 2 pi). Exact: signs of differences."""
    return point[1] < origin[1] or (point[1] == origin[1] and point[0] < origin[0])


def check_angles(result, keys, edges, findings):
    """Judges every closed fan whose edges are continuous or seams. Notes the cones."""
    done, cones = set(), Counter()
    for edge in edges.sides:
        if edge in done:
            continue
        fan = _fan(edge, keys, edges)
        if fan is None:
            continue
        done.update(fan)
        crossed = [side[::-1] for side in fan]
        if any(side not in edges.equal and side not in edges.seams for side in crossed):
            continue
        corners = [_corner(result, edges, side) for side in fan]
        if any(orientation(origin, leave, arrive) <= 0 for origin, leave, arrive in corners):
            continue  # reported by another check
        vertex = edge[0]
        if all(side in edges.equal for side in crossed):
            turns = sum(_lower(origin, leave) and not _lower(origin, arrive)
                        for origin, leave, arrive in corners)
            if turns != 1:
                findings.bad('angles', '%d turns around vertex %s' % (turns, vertex))
        else:
            quarters = _quarters(corners)
            rotations = sum(edges.seams.get(side[::-1], 0) for side in _arriving(fan, keys, edges))
            if quarters is None or (quarters - rotations) % 4:
                findings.bad('angles', 'the angles around vertex %s are no multiple of a quarter '
                             'turn that fits its seams' % (vertex,))
            elif quarters != 4:
                cones[quarters] += 1
    if edges.seams:
        findings.note('cones', ', '.join('%d of %d quarters' % (count, quarters)
                                         for quarters, count in sorted(cones.items())) or 0)


def _fan(edge, keys, edges):
    """Returns the leaving edges of all sectors around the first vertex of `edge`, counterclockwise; None if
    the boundary ends the fan."""
    fan, at = [], edge
    while at in edges.sides:
        fan.append(at)
        cell, side = edges.sides[at]
        at = at[0], keys[cell][(side + 2) % 3]
        if at == edge:
            return fan
        if len(fan) > len(edges.sides):
            return None
    return None


def _arriving(fan, keys, edges):
    """Returns the arriving edges of a fan's sectors, reversed; these are the leaving edges of the next
    sectors."""
    return [(edge[0], keys[cell][(side + 2) % 3])
            for edge in fan for cell, side in [edges.sides[edge]]]


def _corner(result, edges, edge):
    cell, corner = edges.sides[edge]
    uv = result.cells[cell].uv
    leave, arrive = _neighbours(result.degree, corner)
    return uv[corner], uv[leave], uv[arrive]


def _quarters(corners):
    """Returns the sum of the sectors in quarter turns; None if it is not close to an integer."""
    total = 0.0
    for (x, y), (a, b), (c, d) in corners:
        total += math.atan2((a - x) * (d - y) - (b - y) * (c - x),
                            (a - x) * (c - x) + (b - y) * (d - y))
    quarters = total / (math.pi / 2)
    return round(quarters) if abs(quarters - round(quarters)) < ROUNDING else None
