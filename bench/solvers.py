#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Iterations and seconds until the energy is within 1 % and 0.01 % of the best one, for every method of `majorant
compare`.

Public meshes at degrees 1 and 3. All methods solve the same problem from the same start (Tutte's map, elevated). A
dash: not reached within the limits. Needs an idle machine; prints Markdown.

Sample runs:
  bench/solvers.py > /tmp/solvers.md
  bench/solvers.py --meshes spot_500 --degrees 1 --time-limit 5
"""
import sys
import tempfile
from pathlib import Path

import common

MESHES = ['spot_500', 'blub_2500', 'goathead_2500', 'nefertiti_2500', 'mountain_2500']


def measure(options, mesh, degree, folder):
    path = options.shared / 'data/public/disks' / (mesh + '.obj')
    report = Path(folder) / 'report.json'
    done = common.run([options.binary, 'compare', path, '--degree', degree, '--report', report,
                       '--time-limit', options.time_limit, '--max-iterations', 10000, '--quiet'],
                      options.timeout)
    if done.code != 0:
        sys.exit('%s degree %d: exit %s: %s' % (mesh, degree, done.code, done.stderr.strip()))
    return common.load_strict(report)


def cell(point):
    return '-' if point is None else '%d it, %.3g s' % (point['iterations'], point['seconds'])


def main():
    parser = common.parser(__doc__, timeout=3600)
    parser.add_argument('--meshes', type=lambda t: t.split(','), default=MESHES)
    parser.add_argument('--degrees', type=lambda t: [int(w) for w in t.split(',')], default=[1, 3])
    parser.add_argument('--time-limit', type=float, default=20, help='seconds for each method')
    options = parser.parse_args()
    common.require_files(options)
    common.require_idle(options)
    with tempfile.TemporaryDirectory() as folder:
        for degree in options.degrees:
            runs = {mesh: measure(options, mesh, degree, folder) for mesh in options.meshes}
            first = next(iter(runs.values()))
            print('\nDegree %d, to 1 %% / 0.01 %% of the best energy; %s, at most %g s each:\n' % (
                degree, first['result']['machine'], options.time_limit))
            table = common.Table('', 'method', *runs)
            for k, method in enumerate(first['result']['methods']):
                cells = ['%s / %s' % (cell(r['result']['methods'][k]['within']['0.01']),
                                      cell(r['result']['methods'][k]['within']['0.0001'])) for r in runs.values()]
                table.row(method['method'], *cells)
    return 0


if __name__ == '__main__':
    sys.exit(main())
