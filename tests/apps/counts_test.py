#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""The work of maps: iterations, factorizations, energies of the line search, certificates.

Fails if a count is more than 2 % above the committed figure, tests/data/counts.json; times are not
tested. Uses the meshes of examples/meshes/, and public ones if they are there. After a change that
costs more on purpose, or that costs less, rewrite the figures and give the reason in the commit:

  MAJORANT_BINARY=build/release/apps/majorant MAJORANT_SOURCE_DIR=. MAJORANT_SHARED_DIR=../shared \
      tests/apps/counts_test.py --write
"""
import json
import os
import sys
import tempfile
import unittest
from concurrent.futures import ThreadPoolExecutor

from command_helpers import OK, SHARED, SOURCE, generated, majorant, where

FIGURES = os.path.join(SOURCE, 'tests', 'data', 'counts.json')
DISKS = os.path.join(SHARED, 'data', 'public', 'disks')
MARGIN = 0.02  # counts are the same on all machines with AVX2 or AVX-512
OURS = {
    'tube, degree 1': ['tube', '--degree', '1'],
    'tube, degree 3': ['tube', '--degree', '3'],
    'ribbon, degree 2, fixed': ['ribbon', '--degree', '2', '--boundary', 'fixed'],
    'tube, degree 1, bijective': ['tube', '--degree', '1', '--bijective'],
    'tube, degree 1, arap, fixed': ['tube', '--degree', '1', '--energy', 'arap', '--boundary', 'fixed'],
}
PUBLIC = {
    'spot_2500, degree 1': ['spot_2500', '--degree', '1'],
    'hand_500, degree 1': ['hand_500', '--degree', '1'],
    'hand_500, degree 2': ['hand_500', '--degree', '2'],
    'scorpion_500, degree 1': ['scorpion_500', '--degree', '1'],
    'helix_500, degree 1, bijective': ['helix_500', '--degree', '1', '--bijective'],
    'koala_500, degree 2, bijective': ['koala_500', '--degree', '2', '--bijective'],
    'koala_500, degree 3': ['koala_500', '--degree', '3'],
    'spot_10000, degree 1': ['spot_10000', '--degree', '1'],
    'scorpion_10000, degree 1': ['scorpion_10000', '--degree', '1'],
}


def mesh_file(name):
    return generated(name) if os.path.exists(generated(name)) else os.path.join(DISKS, name + '.obj')


def counts(words):
    """Returns the counts of one run. words: its mesh, then its flags."""
    name, *flags = words
    with tempfile.TemporaryDirectory(prefix='majorant_counts_') as folder:
        path = os.path.join(folder, 'report.json')
        outcome = majorant('parametrize', mesh_file(name), '-o', path, '--quiet', '--threads', '1', *flags)
        if outcome.code != OK:
            raise AssertionError('%s: %s' % (words, outcome.err))
        with open(path) as f:
            report = json.load(f)
    steps = [step for step in report['iterations'] if step['level'] == 0]
    start = [step for step in report['iterations'] if step['level'] > 0]
    found = {'iterations': len(steps),
             'factorizations': sum(step['factorizations'] for step in steps),
             'trials': sum(step['trials'] for step in steps),
             'certificates': sum(report['injectivity_tests']['depth'])}
    if start:
        found['on coarser meshes'] = len(start)
        found['factorizations there'] = sum(step['factorizations'] for step in start)
    return found


def all_counts(runs):
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        return dict(zip(runs, pool.map(counts, runs.values())))


def risen(figures, found):
    """Returns a line for each count that exceeds its figure by more than the margin."""
    return ['%s: %s are %d, were %d' % (run, kind, count, figures[run][kind])
            for run, kinds in found.items() for kind, count in kinds.items()
            if count > (1 + MARGIN) * figures[run][kind]]


def committed():
    with open(FIGURES) as f:
        return json.load(f)


class Counts(unittest.TestCase):
    def expect_no_more(self, runs):
        self.assertEqual(risen(committed(), all_counts(runs)), [])

    def test_on_our_meshes(self):
        self.expect_no_more(OURS)

    @where(DISKS)
    def test_on_public_meshes(self):
        self.expect_no_more(PUBLIC)

    def test_figures_are_those_of_the_runs(self):
        figures = committed()
        self.assertEqual(list(figures), [*OURS, *PUBLIC])
        for kinds in figures.values():
            self.assertEqual(list(kinds)[:4], ['iterations', 'factorizations', 'trials', 'certificates'])
            self.assertGreater(min(kinds.values()), 0)
        starts = [run for run, kinds in figures.items() if 'factorizations there' in kinds]
        self.assertEqual(starts, ['spot_10000, degree 1', 'scorpion_10000, degree 1'])

    def test_a_rise_is_noticed(self):
        figures = {'run': {'iterations': 100, 'trials': 30}}
        self.assertEqual(risen(figures, {'run': {'iterations': 102, 'trials': 1}}), [])
        self.assertEqual(risen(figures, {'run': {'iterations': 103, 'trials': 1}}),
                         ['run: iterations are 103, were 100'])


def write_figures():
    with open(FIGURES, 'w') as f:
        json.dump(all_counts({**OURS, **PUBLIC}), f, indent=1)
        f.write('\n')


if __name__ == '__main__':
    write_figures() if sys.argv[1:] == ['--write'] else unittest.main()
