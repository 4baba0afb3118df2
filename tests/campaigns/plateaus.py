#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that runs do not stop early on meshes whose energy decreases slowly far from its minimum.

Long strips that run along a square spiral, bumpy across: a flat map straightens the spiral by rotating
thousands of triangles under stress, and turns of the spiral overlap. Clamped curvature models overestimate
the energy of such a rotation, so steps are short and predict small decreases. The meshes are the same on
every machine (integers and sines), and are written to --folder. Columns: the energy at the default tolerance,
at 1e-11, iterations of both, and the relative excess of the first energy over the second. Exit code 0 if all
runs are valid and the last column is at most 1e-4.

Sample runs:
  tests/campaigns/plateaus.py --folder build/plateaus
  tests/campaigns/plateaus.py --binary OLD/majorant --meshes wide
  tests/campaigns/plateaus.py --disks '_(500|2500)$' --degrees 1,2,3     (instead, on the public disks)
"""
import argparse
import math
import re
import sys
import tempfile
from collections import namedtuple
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[2] / 'bench'))
import common  # noqa: E402

ALLOWED = 1e-4
TIGHT = 1e-11
MOST_ITERATIONS = 20000
HEADER = ['mesh', 'degree', 'faces', 'status', 'iterations', 'energy', 'status at 1e-11', 'iterations',
          'energy', 'above']

# turns: those of the spiral; width: cells across the strip; height, frequency: those of its bumps.
Strip = namedtuple('Strip', 'turns width height frequency')
STRIPS = {
    'narrow': Strip(10, 2, 0.6, 1.3),
    'wide': Strip(8, 3, 1.2, 0.9),
    'bumpy': Strip(8, 3, 1.5, 0.9),
}


# ------------------------------------------------------------------ meshes
def spiral_cells(turns, width):
    """Returns cells (i, j) of a strip along a square spiral whose turns are one cell apart."""
    def square(x, y):
        return {(x + i, y + j) for i in range(width) for j in range(width)}
    cells, x, y, dx, dy = set(), 0, 0, 1, 0
    for side in range(4 * turns):
        for _ in range((side // 2 + 1) * (width + 1)):
            cells |= square(x, y)
            x, y = x + dx, y + dy
        dx, dy = -dy, dx
    return cells | square(x, y)


def strip_mesh(strip):
    """Returns (vertices, faces): two triangles per cell, with heights that are a product of sines."""
    numbers, vertices, faces = {}, [], []

    def vertex(i, j):
        if (i, j) not in numbers:
            numbers[i, j] = len(vertices)
            bump = math.sin(strip.frequency * i) * math.sin(strip.frequency * j)
            vertices.append((i, j, strip.height * bump))
        return numbers[i, j]

    for i, j in sorted(spiral_cells(strip.turns, strip.width)):
        a, b, c, d = vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)
        faces += [(a, b, c), (a, c, d)] if (i + j) % 2 else [(a, b, d), (b, c, d)]
    return vertices, faces


def write_strip(path, strip):
    vertices, faces = strip_mesh(strip)
    lines = ['v %.9g %.9g %.9g' % point for point in vertices]
    lines += ['f %d %d %d' % tuple(corner + 1 for corner in face) for face in faces]
    path.write_text('\n'.join(lines) + '\n')


# ------------------------------------------------------------------ runs
def solve(options, path, degree, folder, *flags):
    """Returns (report, problem) of one run."""
    report_path = folder / 'report.json'
    report_path.unlink(missing_ok=True)
    common.parametrize(options, path, [folder / 'map.vtu'], '--degree', degree, '--threads', 1, '--force',
                       '--report', report_path, *flags)
    return common.load_report(report_path)


def measure(options, path, degree, folder):
    """Returns (row of the table, excess of the first energy over the second or None)."""
    tight = ['--tolerance', TIGHT, '--max-iterations', MOST_ITERATIONS]
    runs = [solve(options, path, degree, folder, *flags) for flags in ([], tight)]
    problem = next((problem for _, problem in runs if problem), None)
    if problem:
        return [path.stem, degree, problem] + ['-'] * (len(HEADER) - 3), None
    reports = [report for report, _ in runs]
    row = [path.stem, degree, reports[0]['input']['faces']]
    for report in reports:
        row += [report['status'], len(common.steps_taken(report)), '%.9g' % report['result']['value']]
    energies = [report['result']['value'] for report in reports]
    above = energies[0] / energies[1] - 1
    valid = all(report['result']['locally_injective'] for report in reports)
    return row + ['%.1e' % above], above if valid else None


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    common.add_options(parser)
    parser.add_argument('--folder', type=Path, help='for the meshes; a temporary one if not given')
    parser.add_argument('--meshes', default='', metavar='REGEX', help='searched in the names of strips')
    parser.add_argument('--disks', metavar='REGEX', help='public disks instead, searched in their names')
    parser.add_argument('--degrees', default='1', metavar='N,N')
    return parser.parse_args()


def main():
    options = parse_arguments()
    common.require_files(options)
    with tempfile.TemporaryDirectory(prefix='majorant_plateaus_') as place:
        folder = options.folder or Path(place)
        folder.mkdir(parents=True, exist_ok=True)
        if options.disks:
            disks = (options.shared / 'data/public/disks').glob('*.obj')
            paths = sorted(path for path in disks if re.search(options.disks, path.stem))
        else:
            names = [name for name in STRIPS if re.search(options.meshes, name)]
            paths = [folder / (name + '.obj') for name in names]
            for name, path in zip(names, paths):
                write_strip(path, STRIPS[name])
        degrees = [int(word) for word in options.degrees.split(',')]
        runs = [measure(options, path, degree, Path(place)) for path in paths for degree in degrees]
    print('\n'.join(common.markdown_table(HEADER, [row for row, _ in runs])))
    good = [above is not None and above <= ALLOWED for _, above in runs]
    print('\nat most %g above: %d of %d' % (ALLOWED, sum(good), len(good)))
    return 0 if runs and all(good) else 1


if __name__ == '__main__':
    sys.exit(main())
