#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Judges a map in a file exactly, from the definitions, on the digits that the file holds.

    check_map.py RESULT.(vtu|msh|obj|ply) [--surface S.obj] [--cuts none|free] [--seamless] [--overlap]
                 [--may-touch] [--json]

The last line is `ok ...`, `bad ...`, `undecided ...` or `unreadable ...`; exit code 0, 1, 3, 2
(4: the checker itself failed).
docs/files.md says what each word means and what is not decided.
"""
import argparse
import json
import sys
import traceback

import continuity
from angles import check_angles
from bernstein import NOT_POSITIVE, UNDECIDED, positivity
from curve_overlap import check_curved_overlap, link
from exact import orientation
from findings import Findings
from result_map import read_result
from overlap import boundary, check_straight_overlap
from surface import Placement, place, read_surface
from vtu_file import Unreadable

EXIT = {'ok': 0, 'bad': 1, 'undecided': 3}
UNREADABLE, ERROR = 2, 4


def check_positivity(result, findings):
    """Checks det J > 0 on every closed cell. Returns whether it is proven."""
    good = not result.bad_polygons and not result.undecided_polygons
    for name in result.bad_polygons:
        findings.bad('positivity', '%s has no positive triangulation' % name)
    for name in result.undecided_polygons:
        findings.undecided('positivity', '%s has many corners and no ear' % name)
    if result.kind == 'polygons':
        return good
    for cell in result.cells:
        if result.degree == 1:
            verdict = None if orientation(*cell.uv) > 0 else NOT_POSITIVE
        else:
            verdict = positivity(cell.uv, result.degree)
        if verdict == NOT_POSITIVE:
            findings.bad('positivity', 'det J <= 0 in %s' % cell.name)
        elif verdict == UNDECIDED:
            findings.undecided('positivity', 'det J > 0 in %s?' % cell.name)
        good = good and verdict not in (NOT_POSITIVE, UNDECIDED)
    return good


def check_continuity(result, placement, edges, options, findings):
    """Judges the edges that `continuity.join` classified."""
    for edge, (a, b) in placement.interior.items():
        if edge[::-1] not in edges.sides and edge in edges.sides:
            findings.bad('continuity', 'the pieces on the two sides of edge (%d, %d) do not meet'
                         % (a, b))
    seams, cuts = set(edges.seams), set(edges.cuts)
    if not options.seamless:
        cuts |= seams
        seams = set()
    lone = {frozenset(edge) for edge in cuts}
    findings.note('seams', len({frozenset(edge) for edge in seams}))
    findings.note('cuts', len(lone))
    findings.note('charts', continuity.charts(result, edges))
    if options.cuts == 'none':
        for edge in sorted(tuple(sorted(map(str, edge))) for edge in lone):
            findings.bad('continuity', 'the sides of edge (%s) differ' % ', '.join(edge))


def check(path, options):
    """Returns the findings about a file. Throws Unreadable."""
    findings = Findings()
    result = read_result(path)
    findings.note('cells', len(result.cells))
    findings.note('degree', result.degree)
    positive = check_positivity(result, findings)
    for cell in result.cells:
        if len(set(cell.corners)) < 3:
            findings.bad('manifold', '%s has a vertex twice' % cell.name)
    for name in result.not_flat:
        findings.bad('flatness', '%s is not the elevation of its flat triangle' % name)
    if options.surface:
        placement = place(result, read_surface(options.surface), findings)
    else:
        placement = own_surface(result, findings)
    edges = continuity.join(result, placement.keys, findings)
    check_continuity(result, placement, edges, options, findings)
    check_angles(result, placement.keys, edges, findings)
    if not options.seamless:
        findings.notes.pop('cones', None)  # of seams that count as cuts here
    if options.overlap:
        check_overlap(result, placement.keys, positive, edges, options, findings)
    return findings


def check_overlap(result, keys, positive, edges, options, findings):
    """Checks for overlaps if all cells are positive, as the boundary decides only then; curved cells also
    need closed loops."""
    sides = boundary(result, keys)
    loops = all(keys) and 'manifold' not in findings.violations
    if not positive or not (loops or result.degree == 1):
        findings.note('overlap', 'not judged')
    elif not sides:
        findings.bad('overlap', 'a map without a boundary')
    elif result.degree == 1:
        check_straight_overlap(sides, options.may_touch, findings)
    else:
        check_curved_overlap(sides, link(edges, keys, sides), options.may_touch, findings)


def own_surface(result, findings):
    """Makes the cells themselves the surface if none is given; vertices are those of the file."""
    placement = Placement(len(result.cells))
    placement.keys = [cell.corners for cell in result.cells]
    places = {}
    for number, point in zip(result.numbers, result.positions):
        if number is not None and places.setdefault(number, point) != point:
            findings.bad('vertices', 'vertex %d lies in two places' % number)
    return placement


def parse(arguments):
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('result')
    parser.add_argument('--surface', help='the mesh that was mapped, OBJ')
    parser.add_argument('--cuts', choices=['none', 'free'], default='none')
    parser.add_argument('--seamless', action='store_true')
    parser.add_argument('--overlap', action='store_true')
    parser.add_argument('--may-touch', action='store_true')
    parser.add_argument('--json', action='store_true', help='all findings, before the last line')
    return parser.parse_args(arguments)


def main(arguments):
    options = parse(arguments)
    try:
        findings = check(options.result, options)
    except (Unreadable, OSError) as error:
        print('unreadable %s' % error)
        return UNREADABLE
    except Exception:  # Python's own exit code would look like a verdict
        traceback.print_exc()
        print('error of the checker itself')
        return ERROR
    if options.json:
        print(json.dumps(findings.report(), indent=1))
    print(findings.summary())
    return EXIT[findings.verdict]


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
