#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Measures the effect of solver rules: maps of the public disks with one rule changed at a time.

The first row has the rules of parametrize(). Every row has: iterations and remedies of all meshes
together, the number of stalled runs, and the relative change of the energy from the first row: the worst, the
best and the mean over the meshes (positive: higher). Rules without effect (scaffold.* without
--bijective, bounds.* without --bounded) are skipped. Exit code 0 unless a run fails.

Sample runs:
  bench/tune.py --degree 3
  bench/tune.py --bijective --degree 3 scaffold.share remedies.barrier_rounds
  bench/tune.py --bounded 1.2 --meshes '^(spot|koala)_500$' bounds.weights.fall bounds.first_share
  bench/tune.py --values 1e-5,1e-3 --meshes '^spot_500$' stopping.stall_decrement
"""
import argparse
import json
import re
import sys

import common

TUNE = common.ROOT / 'build/release/bench/majorant_tune'
# The values in the tables. Rules without values follow from their origin and need no measurement.
VALUES = {
    'accuracy_rounds': '0,6',
    'blend.below': '0,1e-4,1e-2',
    'blend.fall': '0.1,0.5',
    'blend.hold': '0,4',
    'blend.least': '0.02,0.2',
    'blend.short_step': '0,0.5',
    'blend.whole_steps': '0,5',
    'bounds.entry.tolerance': '1e-2,1e-4',
    'bounds.weights.fall': '0.03,0.3',
    'bounds.first_share': '0.01,1',
    'bounds.entry.harder': '3,100',
    'bounds.centred': '1e-3,0.1',
    'bounds.least_barrier': '1e-9,1e-3',
    'bounds.least_energy': '1e-6,1',
    'bounds.entry.least_progress': '0,0.1',
    'bounds.weights.most_phases': '20,80',
    'deepest_bisection': '5,9,20',
    'depth': '3,9',
    'elevation_tolerance': '1e-2,1e-6',
    'lagged.below': '0,1e-3,1e-2',
    'lagged.history': '4,16',
    'lagged.short_step': '0.01,0.2',
    'lagged.steps': '4,12',
    'line_search.barrier_decrement': '0.3,0.6,1e300',
    'line_search.barrier_gain': '0.03,0.3',
    'line_search.boundary_fraction': '0.5,0.99',
    'line_search.largest_growth': '2,16',
    'line_search.most_improvements': '0,2',
    'quadrature.boundary_guard': '3e-4,3e-2',
    'quadrature.refinements': '2,6',
    'quadrature.corner_guard': '1e-4,1e-2',
    'quadrature.error': '3e-6,3e-4',
    'remedies.barrier_rounds': '0,1',
    'remedies.barrier_tolerance': '1e-3,1e-5',
    'remedies.excluded_iterations': '3,30',
    'remedies.stall_rounds': '0,10',
    'scaffold.at_rest': '0,1e-6,1e-4',
    'scaffold.depth': '0,13,40',
    'scaffold.part_of_tolerance': '1,0.5,0.1',
    'scaffold.relax_steps': '1,20',
    'scaffold.same_lambda': '0,0.2',
    'scaffold.share': '1e-4,1e-2',
    'scaffold.share_at_rest': '1e-3,1e-5',
    'scaffold.short_bound': '0,1',
    'scaffold.still_moving': '0,1e-5,1e300',
    'scaffold.tail_steps': '2,3',
    'soft_start': '1e3,1e300',
    'stopping.fallback_step': '0.01,0.5',
    'stopping.last_factor': '0.01,1,10',
    'stopping.plateau_factor': '0.5,8,1e300',
    'stopping.plateau_steps': '100,10000',
    'stopping.plateau_window': '6,24',
    'stopping.relative_decrease': '1e-4,1e-8',
    'stopping.saddle_part': '1e-3,1',
    'stopping.stall_decrement': '1e-6,1e-2',
    'stopping.stall_iterations': '1,10',
    'stopping.stall_step': '1e-5,1e-1',
    'stopping.tail_factor': '3,100',
    'stopping.tail_steps': '1,3',
}
HEADER = ['rule', 'value', 'iterations', 'remedies', 'stalled', 'energy, worst', 'best', 'mean']


def solve(options, mesh, changes):
    """Returns the line that majorant_tune prints for a mesh."""
    command = [options.tune, mesh, '--degree', options.degree]
    command += ['--energy', options.energy]
    command += ['--bijective'] * options.bijective + ['--fixed'] * options.fixed
    command += ['--bounded', options.bounded] if options.bounded else []
    for change in changes:
        command += ['--set', change]
    done = common.run(command, options.timeout)
    if done.code != 0:
        sys.exit('%s: exit %s, %s' % (' '.join(map(str, command)), done.code, done.stderr.strip()))
    return json.loads(done.stdout)


def row(name, value, runs, usual):
    parts = [run['energy'] / base['energy'] - 1 for run, base in zip(runs, usual)]
    cells = [name, value, sum(run['iterations'] for run in runs), sum(run['remedies'] for run in runs),
             sum(run['status'] == 'stalled' for run in runs)]
    if runs is usual:
        return cells + ['-'] * 3
    return cells + ['%+.0e' % part for part in (max(parts), min(parts), sum(parts) / len(parts))]


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    common.add_options(parser)
    parser.add_argument('rules', nargs='*', help='names of majorant_tune --list; all with values')
    parser.add_argument('--tune', default=TUNE, help='the majorant_tune program')
    parser.add_argument('--values', help='instead of the usual ones, separated by commas')
    parser.add_argument('--meshes', default='_500$', metavar='REGEX', help='searched in the names')
    parser.add_argument('--degree', type=int, default=2)
    parser.add_argument('--energy', default='symmetric-dirichlet')
    parser.add_argument('--bijective', action='store_true')
    parser.add_argument('--fixed', action='store_true')
    parser.add_argument('--bounded', metavar='X', help='the largest stretch X times below the free map\'s')
    return parser.parse_args()


def main():
    options = parse_arguments()
    folder = options.shared / 'data/public/disks'
    meshes = sorted(path for path in folder.glob('*.obj') if re.search(options.meshes, path.stem))
    if not meshes:
        sys.exit('%s: no such meshes' % folder)
    usual = [solve(options, mesh, []) for mesh in meshes]
    print('\n'.join(common.markdown_table(HEADER, [row('as it is', '', usual, usual)])), flush=True)
    for name in options.rules or VALUES:
        if name.startswith('scaffold.') and not options.bijective:
            continue
        if name.startswith('bounds.') and not options.bounded:
            continue
        for value in (options.values or VALUES[name]).split(','):
            runs = [solve(options, mesh, ['%s=%s' % (name, value)]) for mesh in meshes]
            cells = row('`%s`' % name, value, runs, usual)
            print('| %s |' % ' | '.join(map(str, cells)), flush=True)
    return 0


if __name__ == '__main__':
    sys.exit(main())
