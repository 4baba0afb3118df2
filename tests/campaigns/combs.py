#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Deforms combs by handles, so that the image touches itself in many places, and checks how runs end.

A comb is a flat sheet whose teeth are slits apart; handles at the tips of every other tooth push it against
its neighbours. `deform --bijective` keeps the teeth from passing through each other, with scaffold triangles
in every slit that become long and thin. Widths of teeth and slits, lengths, cells and targets follow from the
number of the comb on every machine. The exit code is 0 if every file passes `check --certify` and all runs
but --stalled of them converge. At a corner of the feasible set, the last digits decide whether a run leaves
it (one in 60), and these differ between instruction sets.

Sample runs:
  tests/campaigns/combs.py                                      # 50 combs of 12 teeth
  tests/campaigns/combs.py --count 20 --teeth 6
  tests/campaigns/combs.py --binary OLD/majorant --only 5,7,13
"""
import argparse
import json
import random
import sys
import tempfile
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[2] / 'bench'))
import common  # noqa: E402

DEGREE = 2
HEADER = ['comb', 'faces', 'targets', 'status', 'message', 'iterations', 'seconds', 'energy', 'handles']


# ------------------------------------------------------------------ meshes
def comb(teeth, width, slit, length, rows, columns, base):
    """Returns (vertices, faces, the vertex in the middle of each tip)."""
    xs, is_slit = [], []
    for tooth in range(teeth):
        left = tooth * (width + slit)
        xs += [left + width * column / columns for column in range(columns + 1)]
        is_slit += [False] * columns + [True]
    ys = [-base, 0.0] + [length * (row + 1) / rows for row in range(rows)]
    numbers, vertices, faces = {}, [], []

    def vertex(i, j):
        if (i, j) not in numbers:
            numbers[i, j] = len(vertices)
            vertices.append((xs[i], ys[j], 0.0))
        return numbers[i, j]

    for j in range(len(ys) - 1):
        for i in range(len(xs) - 1):
            if j > 0 and is_slit[i]:
                continue
            a, b, c, d = vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)
            faces += [(a, b, c), (a, c, d)] if (i + j) % 2 else [(a, b, d), (b, c, d)]
    top = len(ys) - 1
    return vertices, faces, [vertex(t * (columns + 1) + columns // 2, top) for t in range(teeth)]


def moved(chance, way, part, pitch, length, tooth):
    """Returns the target of a tooth's tip."""
    sign = -1 if tooth % 2 else 1
    if way == 'side':
        return part * length / 2, -0.2 * part
    if way == 'alternate':
        return sign * part * pitch, -0.1
    if way == 'up':
        return 0.0, (0.5 if tooth % 2 else -0.2) * part * length
    if way == 'lean':
        return part * pitch, -0.15 * length * part
    return chance.uniform(-2, 2) * part * pitch, chance.uniform(-1, 0.5) * part


def problem_of(number, teeth):
    """Returns (vertices, faces, handles, direction in which they are pulled)."""
    chance = random.Random(number)
    width, slit = chance.choice([0.2, 0.4, 0.7, 1.0]), chance.choice([0.01, 0.05, 0.1, 0.2])
    length, rows, columns = chance.uniform(2, 6), chance.choice([4, 6, 8]), chance.choice([1, 2])
    vertices, faces, tips = comb(teeth, width, slit, length, rows, columns, chance.choice([0.3, 1.0]))
    way, part = chance.choice(['side', 'alternate', 'random', 'up', 'lean']), chance.uniform(0.2, 1.5)
    handles = []
    for k, tip in enumerate(tips[::2]):
        x, y = moved(chance, way, part, width + slit, length, k)
        handles.append({'vertex': tip, 'target': [vertices[tip][0] + x, vertices[tip][1] + y]})
    return vertices, faces, handles, way


# ------------------------------------------------------------------ runs
def solve(options, number, folder):
    """Returns one row, and whether its file is valid."""
    vertices, faces, handles, way = problem_of(number, options.teeth)
    stem = folder / ('comb_%03d' % number)
    mesh, pulled, out = stem.with_suffix('.obj'), stem.with_suffix('.json'), stem.with_suffix('.vtu')
    common.write_obj(mesh, vertices, faces)
    pulled.write_text(json.dumps({'handles': handles}))
    report_path = folder / 'report.json'
    report_path.unlink(missing_ok=True)
    done = common.parametrize(options, mesh, [out], '--handles', pulled, '--bijective', '--degree', DEGREE,
                              '--threads', 1, '--force', '--report', report_path, verb='deform')
    report, problem = common.load_report(report_path)
    if problem:
        return [number, len(faces), way, 'exit %s' % done.code, problem] + ['-'] * 4, False
    checked = common.run([options.binary.resolve(), 'check', out, '--certify', '--quiet'], options.timeout)
    row = [number, len(faces), way, report['status'], report['message'], len(common.steps_taken(report)),
           '%.1f' % done.seconds, '%.9g' % report['result']['value'],
           '%.2g' % report['result']['handle_distance']]
    return row, checked.code == 0


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    common.add_options(parser, timeout=120)
    parser.add_argument('--count', type=int, default=50, help='combs')
    parser.add_argument('--only', metavar='N,N', help='these combs')
    parser.add_argument('--teeth', type=int, default=12)
    parser.add_argument('--stalled', type=int, default=0, help='number of combs that may stall')
    parser.add_argument('--folder', type=Path, help='for the files; a temporary one if not given')
    return parser.parse_args()


def main():
    options = parse_arguments()
    numbers = [int(word) for word in options.only.split(',')] if options.only else range(options.count)
    with tempfile.TemporaryDirectory(prefix='majorant_combs_') as place:
        folder = options.folder or Path(place)
        folder.mkdir(parents=True, exist_ok=True)
        runs = [solve(options, number, folder) for number in numbers]
    print('\n'.join(common.markdown_table(HEADER, [row for row, _ in runs])))
    good = sum(row[3] == 'converged' for row, valid in runs if valid)
    print('\nconverged and valid: %d of %d' % (good, len(runs)))
    return 0 if all(valid for _, valid in runs) and good >= len(runs) - options.stalled else 1


if __name__ == '__main__':
    sys.exit(main())
