#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests bench/elasticity: iterations on small problems of the public suite, and pressures of elements that do
not lock."""
import os
import subprocess
import sys
import unittest
from pathlib import Path

SOURCE = Path(os.environ['MAJORANT_SOURCE_DIR'])
PROGRAM = Path(os.environ['MAJORANT_BUILD_DIR']) / 'bench/elasticity'
sys.dont_write_bytecode = True


def tables(*sections):
    """Returns the tables of these sections as rows of cells, headings first."""
    done = subprocess.run([sys.executable, SOURCE / 'bench/elasticity.py', '--program', PROGRAM, '--boxes', '8',
                           '--only', ','.join(sections)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    found = []
    for block in done.stdout.split('\n\n'):
        rows = [[cell.strip() for cell in line.strip('|').split(' |')] for line in block.splitlines()
                if line.startswith('| ')]
        if rows:
            found.append(rows)
    return found


def column(table, heading):
    return [row[table[0].index(heading)] for row in table[1:]]


@unittest.skipUnless(PROGRAM.exists(), 'no bench/elasticity')
class Suite(unittest.TestCase):
    def test_disks_take_at_most_as_many_iterations_as_the_suite(self):
        table, = tables('disks')
        means = dict(zip(column(table, 'method'), column(table, 'iterations, mean [least-most]')))
        for method in ('clamp', 'absolute', 'composite majorization', 'blend (default)'):
            self.assertLessEqual(float(means[method].split()[0]), 8.8, method)
        self.assertEqual(set(column(table, 'reached')), {'6 of 6'})

    def test_newton_without_filters_solves_all_sets(self):
        disks, squares = tables('sets')
        self.assertEqual(set(column(disks, 'reached')), {'40 of 40'})
        self.assertEqual(set(column(squares, 'reached')), {'12 of 12'})

    def test_folded_starts_are_untangled(self):
        table, = tables('folds')
        self.assertEqual(len(table), 10)
        self.assertIn('**8 of 8**', table[-1][2])
        self.assertEqual(table[-1][3], '8 of 8')

    def test_poissons_ratio_in_the_plane(self):
        locks, neo_hookean, stable = tables('plane')
        self.assertLessEqual(int(column(locks, 'clamp')[-1]), 242)
        at_most = {'absolute': 39, 'Gauss-Newton of the volume': 20, 'mean dilatation': 20}
        for table in (neo_hookean, stable):
            for method, most in at_most.items():
                self.assertLessEqual(int(column(table, method)[4]), most, method)
        volume = [int(cell) for cell in column(stable, 'Gauss-Newton of the volume')]
        self.assertLessEqual(volume[-1] - volume[0], 5)       # nu 0.49999 and 0.3
        projected = [int(cell) for cell in column(stable, 'mean dilatation')]
        self.assertLessEqual(projected[-1] - projected[0], 5)

    def test_a_ring_does_not_lock(self):
        table, = tables('ring')
        finest = {row[0]: row for row in table[1:]}
        self.assertEqual(len(finest), 4)
        for row in table[1:]:
            self.assertLessEqual(int(row[4]) - int(row[3]), 5, row)
        for name in ('quadrilaterals of degree 2, 1', 'hexahedra of degree 2, 1'):
            self.assertLessEqual(float(finest[name][5]), 1.2)
            self.assertLessEqual(float(finest[name][6]), 0.3)

    def test_boxes_take_four_iterations(self):
        table, = tables('boxes')
        self.assertEqual(column(table, 'iterations'), ['4', '4'])
        self.assertEqual(column(table, 'factorizations'), ['4', '4'])


if __name__ == '__main__':
    unittest.main()
