#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests bench/newton_suite: its minima are minima, and Newton's method reaches them."""
import csv
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ['MAJORANT_SOURCE_DIR'])
PROGRAM = Path(os.environ['MAJORANT_BUILD_DIR']) / 'bench/newton_suite'
sys.dont_write_bytecode = True

# The least number of ten starts that default options solve; for all other problems it is ten.
SOLVED = {
    'rope over disk': 9, 'powell, badly scaled': 8, 'beale': 9, 'gulf': 2, 'biggs exp6': 8, 'trigonometric': 9,
    'p-laplacian 4': 9}


def suite(*options):
    return subprocess.run([PROGRAM, *options], capture_output=True, text=True)


def cells(text):
    """Returns the rows of a Markdown table."""
    return [[cell.strip() for cell in line.strip('|\n').split(' |')]
            for line in text.splitlines() if line.startswith('| ')][1:]


@unittest.skipUnless(PROGRAM.exists(), 'no bench/newton_suite')
class Suite(unittest.TestCase):
    def test_minima_are_minima(self):
        done = suite('--verify')
        self.assertEqual(done.returncode, 0, [row for row in cells(done.stdout) if row[-1] != 'yes'])
        self.assertGreaterEqual(len(cells(done.stdout)), 130)

    def test_runs_end_at_minima(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / 'runs.csv'
            done = suite('--csv', path)
            self.assertEqual(done.returncode, 0, done.stderr)
            with open(path, newline='') as file:
                runs = list(csv.DictReader(file))
        solved = {}
        for run in runs:
            solved.setdefault(run['problem'], []).append(int(run['solved']))
        for problem, ends in solved.items():
            with self.subTest(problem):
                self.assertEqual(len(ends), 10)
                self.assertGreaterEqual(sum(ends), SOLVED.get(problem, 10))
        self.assertEqual([name for name in SOLVED if name not in solved], [])

    def test_every_problem_says_where_it_is_from(self):
        known = re.findall(r'^\| \[(\w+)\] \|', (SOURCE / 'docs/references.md').read_text(), re.M)
        rows = cells(suite('--list').stdout)
        self.assertGreaterEqual(len(rows), 30)
        for name, _, source, minima in rows:
            self.assertIn(source, [*known, 'own'], name)
            self.assertLessEqual(len(minima.split(',')), 3, name)

    def test_unknown_names_are_refused(self):
        for options, words in ((['--only', 'no such'], 'no such problem'), (['--methods', 'none'], 'no such method')):
            done = suite(*options)
            self.assertEqual(done.returncode, 1)
            self.assertEqual(done.stderr, 'newton_suite: %s %s: %s%s\n' % (
                *options, words, ', see --help' if 'method' in words else ''))


if __name__ == '__main__':
    unittest.main()
