#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests bench/hock_schittkowski: BarrierMinimizer solves the collection from the published starts."""
import os
import subprocess
import unittest
from pathlib import Path

PROGRAM = Path(os.environ['MAJORANT_BUILD_DIR']) / 'bench/hock_schittkowski'

# Problems that end in other local minima than the published ones.
ELSEWHERE = {16, 20, 59, 97, 109}
# Problems whose end depends on rounding: another elimination order reaches the iteration limit.
FRAGILE = {116}
# The largest number of iterations of problems that take more than MOST.
MOST = 110
ITERATIONS = {57: 160, 65: 140, 75: 130, 95: 320, 96: 200, 97: 250, 98: 210, 101: 980, 102: 380, 103: 320, 106: 280,
              108: 230, 109: 180, 114: 140}


@unittest.skipUnless(PROGRAM.exists(), 'no bench/hock_schittkowski')
class Collection(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        done = subprocess.run([PROGRAM], capture_output=True, text=True)
        cls.code = done.returncode
        rows = [[cell.strip() for cell in line.strip('|\n').split(' |')]
                for line in done.stdout.splitlines() if line.startswith('| ')][1:]
        cls.rows = {int(row[0]): row for row in rows}
        cls.sound = {number: row for number, row in cls.rows.items() if number not in FRAGILE}

    def test_minima_are_the_published_ones(self):
        self.assertEqual(len(self.rows), 94)
        if 'solved' == self.rows[116][13]:
            self.assertEqual(self.code, 0)
        for number, row in self.sound.items():
            with self.subTest(number):
                expected = 'another local minimum' if number in ELSEWHERE else 'solved'
                self.assertEqual(expected, row[13])

    def test_constraints_hold(self):
        for number, row in self.sound.items():
            with self.subTest(number):
                self.assertLessEqual(float(row[8]), 1e-10)
                self.assertGreater(float(row[9]), 0)

    def test_iterations_are_few(self):
        for number, row in self.sound.items():
            with self.subTest(number):
                self.assertLessEqual(int(row[10]), ITERATIONS.get(number, MOST))


if __name__ == '__main__':
    unittest.main()
