#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Measures the excess energy of `converged` runs: random strips and disks, solved twice.

Every mesh is solved at the default tolerance and at 1e-12. The relative excess of the first energy over the
second is the quantity that the tolerance bounds (docs/interface.md, --tolerance). Meshes
are made from their numbers, the same on every machine: strips that are folded along their edges (they have
flat maps with energy 4), strips with bumps, bumpy disks, fans around a vertex with any sum
of angles; degrees 1, 2, 3 in turn. Prints a table of the largest excesses, and their
distribution by kind and degree. Exit code 0 if every run ends `converged` or with a reason, and no
excess of a converged run is above --most.

Sample runs:
  bench/tolerance.py                                  # 200 problems
  bench/tolerance.py --count 40 --energy arap
  bench/tolerance.py --binary OLD/majorant --json old.json --folder build/tolerance
"""
import json
import math
import random
import sys
import tempfile
from pathlib import Path

import common

KINDS = ('folded', 'bumpy', 'disk', 'fan')
TIGHT = 1e-12
MOST_ITERATIONS = 20000
# The columns of the table.
HEADER = ['mesh', 'degree', 'faces', 'status', 'message', 'iterations', 'energy', 'at 1e-12',
          'iterations', 'energy', 'excess']


# ------------------------------------------------------------------ meshes
def split(chance, a, b, c, d):
    """Returns two triangles of a quadrilateral a b c d."""
    return [(a, b, c), (a, c, d)] if chance.random() < 0.5 else [(a, b, d), (b, c, d)]


def turned(v, axis, angle):
    """Returns v, rotated about a unit axis (Rodrigues)."""
    c, s = math.cos(angle), math.sin(angle)
    dot = sum(a * b for a, b in zip(v, axis))
    cross = (axis[1] * v[2] - axis[2] * v[1], axis[2] * v[0] - axis[0] * v[2],
             axis[0] * v[1] - axis[1] * v[0])
    return [v[k] * c + cross[k] * s + axis[k] * dot * (1 - c) for k in range(3)]


def folded_strip(chance):
    """Returns a strip of quadrilaterals, folded along the edges between them, which has an isometric map."""
    cells, width = chance.randrange(20, 90), chance.uniform(0.2, 3)
    turn = chance.uniform(0, 0.12)
    left, right, heading, x, y = [], [], 0.0, 0.0, 0.0
    for _ in range(cells + 1):
        half = width * chance.uniform(0.35, 0.65)
        tilt = heading + chance.uniform(-0.2, 0.2)
        left.append([x - half * math.sin(tilt), y + half * math.cos(tilt), 0.0])
        right.append([x + half * math.sin(tilt), y - half * math.cos(tilt), 0.0])
        heading += chance.uniform(-turn, turn)
        step = chance.uniform(0.6, 1.4)
        x, y = x + step * math.cos(heading), y + step * math.sin(heading)
    fold = chance.uniform(0, 0.6)
    for k in range(1, cells):                    # the part beyond this edge turns about it
        origin = left[k]
        axis = [r - o for r, o in zip(right[k], origin)]
        length = math.sqrt(sum(a * a for a in axis))
        axis, angle = [a / length for a in axis], chance.uniform(-fold, fold)
        for side in (left, right):
            for j in range(k + 1, cells + 1):
                moved = turned([p - o for p, o in zip(side[j], origin)], axis, angle)
                side[j] = [m + o for m, o in zip(moved, origin)]
    vertices = [p for pair in zip(left, right) for p in pair]
    faces = []
    for k in range(cells):
        faces += split(chance, 2 * k, 2 * k + 1, 2 * k + 3, 2 * k + 2)
    return vertices, faces


def grid(chance, columns, rows, height):
    """Returns a grid with jitter and heights; faces are split at random."""
    vertices = [(i + chance.uniform(-0.2, 0.2), j + chance.uniform(-0.2, 0.2),
                 height * chance.uniform(-1, 1)) for j in range(rows + 1) for i in range(columns + 1)]
    faces = []
    for j in range(rows):
        for i in range(columns):
            a = j * (columns + 1) + i
            faces += split(chance, a, a + 1, a + columns + 2, a + columns + 1)
    return vertices, faces


def bumpy_strip(chance):
    return grid(chance, chance.randrange(20, 60), chance.randrange(1, 4), chance.uniform(0.05, 1.5))


def bumpy_disk(chance):
    return grid(chance, chance.randrange(5, 11), chance.randrange(5, 11), chance.uniform(0.05, 1.5))


def fan(chance):
    """Returns two rings of triangles around a vertex, whose sum of angles is between 90 and 700 degrees."""
    spokes, total = chance.randrange(5, 37), math.radians(chance.uniform(90, 700))
    flat = total / (2 * math.pi)                 # below 1 a cone, above 1 the folds of a saddle
    vertices = [(0.0, 0.0, 0.0)]
    for ring in (1, 2):
        for k in range(spokes):
            angle = 2 * math.pi * k / spokes
            radius = ring * chance.uniform(0.8, 1.2)
            if flat <= 1:
                slope, wave = math.acos(flat), 0.0
            else:
                slope, wave = 0.0, math.sqrt(flat * flat - 1)
            out = radius * math.cos(slope)
            vertices.append((out * math.cos(angle), out * math.sin(angle),
                             radius * math.sin(slope) + radius * wave * (0.5 if k % 2 else -0.5)))
    faces = []
    for k in range(spokes):
        a, b = 1 + k, 1 + (k + 1) % spokes
        faces.append((0, a, b))
        faces += split(chance, a, a + spokes, b + spokes, b)
    return vertices, faces


MAKERS = {'folded': folded_strip, 'bumpy': bumpy_strip, 'disk': bumpy_disk, 'fan': fan}


def mesh_of(number):
    """Returns (name, degree, vertices, faces) of a problem."""
    kind = KINDS[number % len(KINDS)]
    vertices, faces = MAKERS[kind](random.Random(number))
    return '%s_%03d' % (kind, number), 1 + number // len(KINDS) % 3, vertices, faces


# ------------------------------------------------------------------ runs
def solve(options, path, degree, folder, *flags):
    """Returns (report, problem) of one run."""
    report_path = folder / 'report.json'
    report_path.unlink(missing_ok=True)
    common.parametrize(options, path, [folder / 'map.vtu'], '--degree', degree, '--energy', options.energy,
                       '--threads', 1, '--force', '--report', report_path, *flags)
    return common.load_report(report_path)


def measure(options, number, meshes, folder):
    """Returns one row as a dictionary."""
    name, degree, vertices, faces = mesh_of(number)
    path = meshes / (name + '.obj')
    common.write_obj(path, vertices, faces)
    row = {'mesh': name, 'degree': degree, 'faces': len(faces)}
    default = ['--tolerance', options.tolerance] if options.tolerance else []
    tight = ['--tolerance', TIGHT, '--max-iterations', MOST_ITERATIONS]
    for key, flags in (('default', default), ('tight', tight)):
        report, problem = solve(options, path, degree, folder, *flags)
        if problem:
            return dict(row, problem=problem)
        row[key] = {'status': report['status'], 'message': report['message'],
                    'iterations': len(common.steps_taken(report)),
                    'factorizations': common.factorizations(report),
                    'decrement': report['result']['newton_decrement'],
                    'energy': report['result']['value_quadrature']}
    best = min(row['default']['energy'], row['tight']['energy'])
    row['excess'] = (row['default']['energy'] - best) / max(abs(best), 1e-300)
    return row


# ------------------------------------------------------------------ tables
def largest_table(rows, most):
    table = []
    for row in sorted(rows, key=lambda row: -row.get('excess', math.inf))[:most]:
        if 'problem' in row:
            table.append([row['mesh'], row['degree'], row['faces'], row['problem']] + ['-'] * 7)
            continue
        a, b = row['default'], row['tight']
        table.append([row['mesh'], row['degree'], row['faces'], a['status'], a['message'], a['iterations'],
                      '%.10g' % a['energy'], b['status'], b['iterations'], '%.10g' % b['energy'],
                      '%.1e' % row['excess']])
    return common.markdown_table(HEADER, table)


def quantile(values, part):
    return sorted(values)[min(len(values) - 1, int(part * len(values)))]


def summary_table(rows):
    header = ['kind', 'degree', 'runs', 'converged', 'iterations', 'factorizations', 'excess: median',
              '90 %', 'largest']
    table = []
    for kind in KINDS + ('all',):
        for degree in ((1, 2, 3) if kind != 'all' else ('all',)):
            group = [row for row in rows if 'excess' in row and kind in ('all', row['mesh'].split('_')[0])
                     and degree in ('all', row['degree'])]
            if not group:
                continue
            converged = [row for row in group if row['default']['status'] == 'converged']
            excess = [row['excess'] for row in converged] or [0]
            table.append([kind, degree, len(group), len(converged),
                          sum(row['default']['iterations'] for row in group),
                          sum(row['default']['factorizations'] for row in group)]
                         + ['%.1e' % value for value in (quantile(excess, 0.5), quantile(excess, 0.9),
                                                         max(excess))])
    return common.markdown_table(header, table)


def parse_arguments():
    parser = common.parser(__doc__)
    parser.add_argument('--count', type=int, default=200, help='problems')
    parser.add_argument('--only', metavar='N,N', help='these problems')
    parser.add_argument('--energy', default='symmetric-dirichlet')
    parser.add_argument('--tolerance', help='in place of the default')
    parser.add_argument('--most', type=float, default=1e-6, help='excess that passes')
    parser.add_argument('--rows', type=int, default=12, help='of the table of the largest excesses')
    parser.add_argument('--json', type=Path, help='all rows, as JSON')
    parser.add_argument('--folder', type=Path, help='for the meshes; a temporary one if not given')
    return parser.parse_args()


def main():
    options = parse_arguments()
    with tempfile.TemporaryDirectory(prefix='majorant_tolerance_') as place:
        meshes = options.folder or Path(place)
        meshes.mkdir(parents=True, exist_ok=True)
        numbers = [int(word) for word in options.only.split(',')] if options.only else range(options.count)
        rows = [measure(options, number, meshes, Path(place)) for number in numbers]
    if options.json:
        options.json.write_text(json.dumps(rows, indent=1) + '\n')
    print('\n'.join(largest_table(rows, options.rows)), '\n')
    print('\n'.join(summary_table(rows)))
    bad = [row for row in rows if 'problem' in row or (row['default']['status'] == 'converged' and
                                                       row['excess'] > options.most)]
    print('\nabove %g or without a map: %d of %d' % (options.most, len(bad), len(rows)))
    return 1 if bad else 0


if __name__ == '__main__':
    sys.exit(main())
