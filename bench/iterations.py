#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""How many Newton steps a linear map with free boundary takes, and where the time goes.

Degree 1, free boundary, the disks with about 10000 faces: iterations until the relative decrease of
the energy falls below 1e-5 and their median; seconds of the optimization against the seconds of
factorizations and solves alone. Factorizations are those of the report, where it has them. Exit code 0 if every run ends with exit 0 and gets there.

Sample runs:
  bench/iterations.py
  bench/iterations.py --meshes '^(spot|koala)_2500$' --threads 2
"""
import argparse
import re
import statistics
import sys
import tempfile
from pathlib import Path

import common

DECREASE = 1e-5
HEADER = ['mesh', 'exit', 'status', 'iterations', 'factorizations', 'to 1e-5', 'optimize s', 'factorize + solve s', 'share %']


def first_below(iterations):
    """The number of the first iteration whose relative decrease is below DECREASE, or None."""
    return next((step['iteration'] for step in iterations if step['relative_decrease'] < DECREASE), None)


def linear_algebra_seconds(iterations):
    return sum(step['seconds']['factorize'] + step['seconds']['solve'] for step in iterations
               if step.get('level', 0) == 0)


def measure(options, path, folder):
    """(row of the table, iterations to 1e-5, optimize seconds, factorize and solve seconds)."""
    report_path = folder / (path.stem + '.json')
    done = common.parametrize(options, path, [folder / 'out.vtu'], '--degree', 1,
                              '--report', report_path, '--threads', options.threads)
    report, problem = common.load_report(report_path)
    if problem or done.code not in (0, 4):
        return [path.stem, done.code, problem or report.get('status')] + ['-'] * 6, None, 0, 0
    steps, whole = common.steps_taken(report), report['seconds']['optimize']
    reached, inner = first_below(steps), linear_algebra_seconds(report['iterations'])
    share = common.cell(100 * inner / whole if whole else None, '%.0f')
    row = [path.stem, done.code, report['status'], len(steps), common.factorizations(report), common.cell(reached),
           '%.3f' % whole, '%.3f' % inner, share]
    return row, reached if done.code == 0 else None, whole, inner


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    common.add_options(parser)
    parser.add_argument('--meshes', default='_10000$', metavar='REGEX', help='searched in the names')
    parser.add_argument('--threads', type=int, default=1)
    return parser.parse_args()


def main():
    options = parse_arguments()
    common.require_files(options)
    folder = options.shared / 'data/public/disks'
    paths = sorted(path for path in folder.glob('*.obj') if re.search(options.meshes, path.stem))
    with tempfile.TemporaryDirectory(prefix='majorant_iterations_') as place:
        runs = [measure(options, path, Path(place)) for path in paths]
    print('\n'.join(common.markdown_table(HEADER, [run[0] for run in runs])))
    reached = [run[1] for run in runs if run[1] is not None]
    whole, inner = sum(run[2] for run in runs), sum(run[3] for run in runs)
    median = statistics.median(reached) if reached else None
    print('\nmedian iterations to a relative decrease of 1e-5: %s (%d of %d meshes)'
          % (common.cell(median), len(reached), len(runs)))
    print('optimize %.2f s, of which factorize and solve %.2f s: factor %s'
          % (whole, inner, common.cell(whole / inner if inner else None, '%.2f')))
    return 0 if runs and len(reached) == len(runs) else 1


if __name__ == '__main__':
    sys.exit(main())
