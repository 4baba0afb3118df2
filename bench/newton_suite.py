#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Newton's method on problems that are not maps (bench/newton_suite), now and at an earlier commit.

Runs the program, compares each run with that of the same problem and start in --before, and prints
tables: solved problems, factorizations of the runs that both versions solve, all methods. --profile
draws performance profiles [DM02]: the fraction of runs that a method solves with at most t times the
factorizations of the method that needs the fewest; on all problems, and on least squares with the methods
for these only. First-order methods, which hardly factorize, are in the table only.

The file of --before has the columns problem, start, solved, iterations and factorizations of --csv.

Sample runs:
  bench/newton_suite.py                                     # runs; prints the tables
  bench/newton_suite.py --runs today.csv --profile docs/pictures/newton_suite.svg
  bench/newton_suite.py --methods newton,newton-absolute --csv today.csv
"""
import argparse
import csv
import math
import subprocess
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
BENCH = Path(__file__).resolve().parent
sys.path.insert(0, str(BENCH))
sys.path.insert(0, str(BENCH / 'experiments'))
import common  # noqa: E402
import experiment  # noqa: E402

METHODS = ('newton,newton-absolute,newton-adaptive,newton-exact,newton-projected,levenberg-marquardt,'
           'ceres-lm,ceres-dogleg')
COLOURS = ('#777777', '#4477aa', '#ee7733', '#994455', '#228833', '#aa3377', '#66ccee', '#bbbb44', '#000000')
MOST = 64                                         # the right end of the profile


def read_runs(path, method=None):
    """Returns {method: {(problem, start): row}}. method: the method of rows without one."""
    found = {}
    with open(path, newline='') as file:
        for row in csv.DictReader(file):
            for key in ('solved', 'iterations', 'factorizations'):
                row[key] = int(row[key])
            found.setdefault(row.get('method', method), {})[row['problem'], row['start']] = row
    return found


def measured(options):
    """Returns the runs of the current program."""
    if options.runs:
        return read_runs(options.runs)
    with tempfile.TemporaryDirectory(prefix='majorant_suite_') as folder:
        path = options.csv or Path(folder) / 'suite.csv'
        done = subprocess.run([options.program, '--methods', options.methods, '--csv', path],
                              stdout=subprocess.DEVNULL)
        if done.returncode:
            sys.exit('%s: exit code %d' % (options.program, done.returncode))
        return read_runs(path)


def problems(runs):
    return list(dict.fromkeys(problem for problem, _ in runs))


def count(runs, key, only):
    return sum(runs[run][key] for run in only)


def method_row(name, runs):
    whole = [p for p in problems(runs) if all(r['solved'] for (q, _), r in runs.items() if q == p)]
    solved = [run for run in runs if runs[run]['solved']]
    return [name, '%d of %d' % (len(whole), len(problems(runs))), '%d of %d' % (len(solved), len(runs)),
            count(runs, 'iterations', solved), count(runs, 'factorizations', solved)]


def comparison(before, today, names):
    """Returns summary lines on problems that both versions solve, and a row for each problem that differs."""
    both = [run for run in today if today[run]['solved'] and run in before and before[run]['solved']]
    sums = [count(runs, 'factorizations', both) for runs in (before, today)]
    logs = [math.log(max(1, today[run]['factorizations']) / max(1, before[run]['factorizations'])) for run in both]
    lines = ['* runs that both solve: %d; factorizations %d, %d: %.2f times as many; geometric mean %.2f' % (
        len(both), *sums, sums[1] / sums[0], math.exp(sum(logs) / len(logs)))]
    rows = []
    for problem in problems(today):
        runs = [run for run in today if run[0] == problem]
        shared = [run for run in runs if run in both]
        solved = [sum(side[run]['solved'] for run in runs if run in side) for side in (before, today)]
        counts = [count(side, 'factorizations', shared) for side in (before, today)]
        ratio = '%.2f' % (counts[1] / counts[0]) if shared and counts[0] else '-'
        rows.append([problem, *solved, *(counts if shared else '--'), ratio])
    return lines + [''] + common.markdown_table(
        ['problem', 'solved, %s' % names[0], 'solved, %s' % names[1], 'factorizations, %s' % names[0],
         'factorizations, %s' % names[1], 'ratio'], rows)


def draw(sides, path):
    """Draws performance profiles of {name: runs}: of all problems, and of least squares with all methods."""
    few = [runs for runs in sides.values() if len(runs) < max(map(len, sides.values()))]
    figure, axes = experiment.panels(1, 2 if few else 1, 4, 3.2)
    profile({name: runs for name, runs in sides.items() if runs not in few}, sides, axes[0, 0])
    if few:
        shared = {name: {run: row for run, row in runs.items() if run in few[0]} for name, runs in sides.items()}
        profile({name: runs for name, runs in shared.items() if 'newton-' not in name}, sides, axes[0, 1])
        axes[0, 1].set_title('least squares')
    axes[0, 0].set_title('all problems')
    experiment.write_svg(figure, path)


def profile(sides, names, axis):
    """Draws one panel. names: of all methods, each of which has one colour in all panels."""
    colours = dict(zip(names, COLOURS))
    best = {}
    for runs in sides.values():
        for run, row in runs.items():
            if row['solved']:
                best[run] = min(best.get(run, math.inf), max(1, row['factorizations']))
    total = len(next(iter(sides.values())))
    for name, runs in sides.items():
        ratios = sorted(max(1, row['factorizations']) / best[run] for run, row in runs.items() if row['solved'])
        steps = {round(r, 2): 100 * (k + 1) / total for k, r in enumerate(ratios) if r <= MOST}
        steps[MOST] = max(steps.values(), default=0)
        axis.step([1, *steps], [0, *steps.values()], where='post',
                  color=colours[name], label=name)
    axis.set(xscale='log', xlim=(1, MOST), ylim=(0, 101), ylabel='runs solved, %',
             xlabel='factorizations, times the fewest')
    ticks = [2 ** k for k in range(7)]
    axis.set_xticks(ticks, [str(t) for t in ticks])
    axis.set_xticks([], minor=True)
    axis.legend(loc='lower right')


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--program', type=Path, default=common.ROOT / 'build/release/bench/newton_suite')
    parser.add_argument('--methods', default=METHODS, help='of the program, newton among them')
    parser.add_argument('--before', type=Path, default=BENCH / 'newton_suite/dc79a3ec.csv', metavar='CSV')
    parser.add_argument('--runs', type=Path, metavar='CSV', help='runs of today that are there already')
    parser.add_argument('--csv', type=Path, help='where the runs are written')
    parser.add_argument('--profile', type=Path, metavar='SVG')
    options = parser.parse_args()
    commit = options.before.stem
    before = read_runs(options.before, 'newton')['newton']
    today = measured(options)
    rows = [method_row('newton, ' + commit, before)] + [method_row(name, runs) for name, runs in today.items()]
    print('\n'.join(common.markdown_table(
        ['method', 'problems solved', 'runs solved', 'iterations of these', 'factorizations of these'], rows)))
    print()
    print('\n'.join(comparison(before, today['newton'], (commit, 'today'))))
    if options.profile:
        factorizing = {name: runs for name, runs in today.items() if 'lbfgs' not in name}
        draw({'newton, ' + commit: before, **factorizing}, options.profile)
    return 0


if __name__ == '__main__':
    sys.exit(main())
