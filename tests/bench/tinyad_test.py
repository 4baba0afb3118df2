#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests bench/tinyad: its rows reach the minima of small generated meshes in few steps, and the programs are
short."""
import csv
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ['MAJORANT_SOURCE_DIR'])
PROGRAM = Path(os.environ['MAJORANT_BUILD_DIR']) / 'bench/tinyad'
sys.dont_write_bytecode = True
sys.path.insert(0, str(SOURCE / 'bench'))
import tinyad  # noqa: E402

# The minimum, or the energy at the end of the schedule of weights, and the largest number of steps.
MINIMA = {
    ('parametrization', 'lambda'): (7.77316991566693, 18),
    ('parametrization', 'energy'): (7.77316991566693, 18),
    ('deformation SD', 'lambda'): (6.38253506607246, 20),
    ('deformation SD', 'density'): (6.38253506607246, 25),
    ('deformation SD', 'hard pins'): (6.38253607827815, 20),
    ('deformation exp SD', 'lambda'): (671.407287106122, 26),
    ('deformation exp SD', 'density'): (671.407287106122, 32),
    ('deformation exp SD', 'hard pins'): (672.632102919581, 48),
    ('deformation AMIPS', 'lambda'): (7.52787686879235, 26),
    ('deformation AMIPS', 'density'): (7.52787686879235, 35),
    ('deformation AMIPS', 'hard pins'): (7.52788519266441, 28),
    ('deformation conformal AMIPS', 'lambda'): (3.08739443457544, 12),
    ('deformation conformal AMIPS', 'density'): (3.08739443457544, 20),
    ('deformation conformal AMIPS', 'hard pins'): (3.08739448725804, 14),
    ('sphere default', 'lambda'): (335.431381719041, 12),
    ('sphere default', 'manifold'): (335.431381719041, 12),
    ('sphere equator', 'lambda'): (478.161751639283, 90),
    ('sphere equator', 'manifold'): (478.161751639283, 50),
    ('sphere northpole', 'lambda'): (444.795168860754, 55),
    ('sphere northpole', 'manifold'): (444.795168860754, 42),
    ('polycurl', 'lambda'): (3.33840629270176, 60),
    ('polycurl', 'terms'): (3.37467734421156, 90),
    ('planar quads', 'lambda'): (0.000284092952966145, 12),
    ('planar quads', 'least squares'): (0.000284092952966145, 12),
    ('planar quads', 'equality'): (0.00185792810841505, 130),
    ('polygon', 'lambda'): (21.8243812632352, 12),
    ('polygon', 'minimum'): (21.8243812632352, 12),
    ('basic', 'variables'): (-1.29341853330593, 1),
    ('basic', 'vector'): (-1.29341853330593, 1),
    ('angle', 'variables'): (0.186996800891085, 1),
    ('angle', 'vector'): (0.186996800891085, 1),
}


@unittest.skipUnless(PROGRAM.exists(), 'no bench/tinyad')
class Rows(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        done = subprocess.run([PROGRAM], capture_output=True, text=True, check=True)
        cls.rows = {(row['problem'], row['row']): row for row in csv.DictReader(done.stdout.splitlines())}

    def test_rows_reach_their_minima(self):
        quads = any(problem == 'planar quads' for problem, _ in self.rows)   # no quads without OpenMesh
        self.assertEqual(set(self.rows), {key for key in MINIMA if quads or key[0] != 'planar quads'})
        for key, row in self.rows.items():
            with self.subTest(key):
                energy, steps = MINIMA[key]
                self.assertEqual(row['status'], 'converged')
                self.assertAlmostEqual(float(row['energy']) / energy, 1, delta=1e-9)
                self.assertLessEqual(int(row['steps']), steps)
                self.assertLessEqual(float(row['violation']), 1e-10)

    def test_a_target_is_met_on_the_way(self):
        done = subprocess.run([PROGRAM, '--only', 'parametrization', '--row', 'energy', '--target', '8'],
                              capture_output=True, text=True, check=True)
        row, = csv.DictReader(done.stdout.splitlines())
        self.assertEqual(row['status'], 'interrupted')
        self.assertEqual(row['steps_to_target'], row['steps'])
        self.assertLess(int(row['steps']), int(self.rows['parametrization', 'energy']['steps']))
        self.assertLessEqual(float(row['seconds_to_target']), float(row['seconds']))

    def test_arrays_are_written(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([PROGRAM, '--only', 'deformation', '--write', folder], check=True)
            pins = (Path(folder) / 'deformation/pins.txt').read_text().split()
            self.assertEqual(pins[:2], ['28', '1'])
            self.assertEqual(len(pins), 30)

    def test_a_folder_without_meshes_is_refused(self):
        done = subprocess.run([PROGRAM, '--data', '/none', '--only', 'sphere'], capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertIn('/none/giraffe_embedding.obj', done.stderr)


class Lines(unittest.TestCase):
    def test_statements_of_a_line_are_counted(self):
        self.assertEqual(tinyad.count('int a = 1;  // one; two\nfor (int k = 0; k < 3; ++k) a += k;\n'), 3)
        self.assertEqual(tinyad.count('f(%s);' % ', '.join(['argument'] * 20)), 3)

    def test_rows_are_short(self):
        figures = tinyad.read_figures(tinyad.FIGURES)
        theirs = {name.split()[0]: figure['lines'] for name, figure in figures.items()}
        own = tinyad.own_lines()
        ours = {}
        for (problem, row), lines in own.items():
            if row and row not in tinyad.EXACT:
                whole = lines + own.get((problem, ''), 0)
                ours[problem] = min(ours.get(problem, whole), whole)
        self.assertEqual(set(ours), set(theirs))
        self.assertLessEqual(sum(ours.values()), 0.6 * sum(theirs.values()))


if __name__ == '__main__':
    unittest.main()
