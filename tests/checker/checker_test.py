# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that the checker refuses every broken file for its reason and accepts every good one, that the files
are those of their script, and the arithmetic that small files do not cover."""
import contextlib
import io
import json
import os
import random
import subprocess
import sys
import unittest
from fractions import Fraction
from math import factorial

HERE = os.path.dirname(os.path.abspath(__file__))
MAPS = os.path.join(HERE, '..', 'data', 'maps')

import bernstein
import check_map
import exact
import make_broken_files
from result_map import _triangulation


def judge(path, entry, more=()):
    """Runs the checker on a file of the index. Returns (exit code, last line)."""
    arguments = [os.path.join(MAPS, path)] + entry['options'] + list(more)
    if entry['surface']:
        arguments += ['--surface', os.path.join(MAPS, 'surfaces', entry['surface'] + '.obj')]
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        code = check_map.main(arguments)
    return code, out.getvalue().splitlines()[-1]


class Files(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with open(os.path.join(MAPS, 'index.json')) as file:
            cls.index = json.load(file)

    def test_there_are_enough_files(self):
        self.assertGreaterEqual(sum(path.startswith('broken/') for path in self.index), 50)
        self.assertGreaterEqual(sum(path.startswith('good/') for path in self.index), 15)

    def test_the_script_makes_the_committed_bytes(self):
        made = make_broken_files.files()
        there = {os.path.relpath(os.path.join(folder, name), MAPS)
                 for folder, _, names in os.walk(MAPS) for name in names}
        self.assertEqual(there, set(made))
        for path, data in made.items():
            with open(os.path.join(MAPS, path), 'rb') as file:
                self.assertEqual(file.read(), data, path)

    def test_broken_files_are_refused_for_their_reason(self):
        for path, entry in self.index.items():
            if path.startswith('broken/'):
                with self.subTest(path):
                    code, line = judge(path, entry)
                    if entry['reason'] == 'unreadable':
                        self.assertEqual((code, line.split()[0]), (2, 'unreadable'), line)
                    else:
                        self.assertEqual((code, line.split()[0]), (1, 'bad'), line)
                        self.assertIn(' %s (' % entry['reason'], line)

    def test_good_files_are_accepted(self):
        for path, entry in self.index.items():
            if path.startswith('good/'):
                with self.subTest(path):
                    code, line = judge(path, entry)
                    self.assertEqual((code, line.split()[0]), (0, 'ok'), line)

    def test_some_defects_need_a_surface_or_an_option(self):
        # Each file is refused with the option only, and for its reason only.
        for path, option, reason in (('broken/nested_2.vtu', '--overlap', 'overlap'),
                                     ('broken/touching_end_1.vtu', '--overlap', 'touching')):
            entry = dict(self.index[path])
            self.assertIn(reason, judge(path, entry)[1])
            entry['options'] = [o for o in entry['options'] if o != option]
            self.assertEqual(judge(path, entry)[0], 0, path)
        entry = dict(self.index['broken/mirrored_map_2.vtu'], surface='')
        self.assertEqual(judge('broken/mirrored_map_2.vtu', entry)[0], 0)

    def test_seams_need_their_option(self):
        entry = dict(self.index['good/cube_1.vtu'], options=[])
        code, line = judge('good/cube_1.vtu', entry)
        self.assertEqual(code, 1)
        self.assertIn('continuity (12)', line)

    def test_as_a_command(self):
        for path, code in (('good/grid_3.vtu', 0), ('broken/zero_area_1.vtu', 1),
                           ('broken/truncated_1.vtu', 2)):
            process = subprocess.run(
                [sys.executable, os.path.join(HERE, 'check_map.py'), os.path.join(MAPS, path),
                 '--json'], stdout=subprocess.PIPE, text=True, timeout=60)
            self.assertEqual(process.returncode, code)
            self.assertEqual(process.stdout.splitlines()[-1].split()[0],
                             ['ok', 'bad', 'unreadable'][code])


def value(coefficients, degree, point):
    """Returns the value of a polynomial by the definition of Bernstein polynomials."""
    total = Fraction(0)
    for (i, j, k), c in coefficients.items():
        basis = Fraction(factorial(degree), factorial(i) * factorial(j) * factorial(k))
        total += c * basis * point[0] ** i * point[1] ** j * point[2] ** k
    return total


def random_net(degree, size=9):
    return [(random.randint(-size, size), random.randint(-size, size))
            for _ in bernstein.vtk_order(degree)]


class Arithmetic(unittest.TestCase):
    POINT = Fraction(1, 7), Fraction(2, 7), Fraction(4, 7)

    def setUp(self):
        random.seed(5)

    def test_orders_hold_every_index_once(self):
        for n in range(1, 9):
            order = bernstein.vtk_order(n)
            self.assertEqual(len(set(order)), (n + 1) * (n + 2) // 2)
            self.assertTrue(all(sum(index) == n for index in order))
            for side in range(3):
                row = [order[p] for p in bernstein.edge_points(n, side)]
                self.assertTrue(all(index[(side + 2) % 3] == 0 for index in row))
                self.assertEqual([index[(side + 1) % 3] for index in row], list(range(n + 1)))

    def test_determinants_by_differentiation(self):
        for n in range(1, 9):
            net = random_net(n)
            found = value(bernstein.determinant(net, n), 2 * n - 2, self.POINT)
            by_axis = [dict(zip(bernstein.vtk_order(n), axis)) for axis in zip(*net)]

            def slope(c, e):
                lower = [(i, j, n - 1 - i - j) for i in range(n) for j in range(n - i)]
                ends = {(i, j, k): (c[(i, j + 1, k) if e == 1 else (i, j, k + 1)], c[i + 1, j, k])
                        for i, j, k in lower}
                return value({index: n * (b - a) for index, (b, a) in ends.items()}, n - 1,
                             self.POINT)
            (xb, yb), (xc, yc) = [[slope(c, e) for c in by_axis] for e in (1, 2)]
            factor = Fraction(n * n * factorial(n - 1) ** 2, factorial(2 * n - 2))
            self.assertEqual(xb * yc - xc * yb, factor * found)

    def test_halves_are_the_same_polynomial(self):
        n = 6
        net = {(i, j, n - i - j): random.randint(-9, 9) for i in range(n + 1)
               for j in range(n + 1 - i)}
        first, second = bernstein.bisect(net, n)
        a, b, c = self.POINT
        self.assertEqual(value(first, n, (a, b, c)), 2 ** n * value(net, n, (b, c + a / 2, a / 2)))
        self.assertEqual(value(second, n, (a, b, c)), 2 ** n * value(net, n, (c, a / 2, b + a / 2)))

    def test_verdicts_against_sampling(self):
        verdicts = set()
        for n in (2, 3, 4):
            grid = [(Fraction(i, 8), Fraction(j, 8), Fraction(8 - i - j, 8))
                    for i in range(9) for j in range(9 - i)]
            for amount in (1, 2, 3, 4, 6):
                for _ in range(4):
                    net = [(4 * n * j // n * n + random.randint(-amount, amount),
                            4 * n * k // n * n + random.randint(-amount, amount))
                           for _, j, k in bernstein.vtk_order(n)]
                    verdict = bernstein.positivity([tuple(map(float, p)) for p in net], n)
                    det = bernstein.determinant(net, n)
                    if min(value(det, 2 * n - 2, point) for point in grid) <= 0:
                        self.assertEqual(verdict, bernstein.NOT_POSITIVE)
                    verdicts.add(verdict)
        self.assertLessEqual({bernstein.POSITIVE, bernstein.NOT_POSITIVE}, verdicts)

    def test_orientation_where_doubles_fail(self):
        for _ in range(200):
            a = (random.random(), random.random())
            d = (random.random(), random.random())
            b = (a[0] + d[0], a[1] + d[1])
            c = (a[0] + d[0] / 3, a[1] + d[1] / 3)
            area = exact.cross(*[tuple(map(Fraction, p)) for p in (a, b, c)])
            self.assertEqual(exact.orientation(a, b, c), (area > 0) - (area < 0))
        self.assertEqual(exact.orientation((0.0, 0.0), (1e-200, 0.0), (0.0, 1e-200)), 1)
        self.assertEqual(exact.orientation((0.0, 0.0), (5e-324, 0.0), (0.0, 5e-324)), 1)

    def test_triangulations(self):
        comb = [(0, 0)] + [(20 - k, 1 + 7 * (k % 2)) for k in range(21)]
        for polygon in (comb, [(x / 2, y / 2) for x, y in comb]):
            polygon = [tuple(map(float, p)) for p in polygon]
            for reverse in (False, True):
                points = polygon[::-1] if reverse else polygon
                found = _triangulation(points)
                if not found:
                    continue
                self.assertEqual(len(found), len(points) - 2)
                self.assertTrue(all(exact.orientation(*[points[k] for k in t]) > 0 for t in found))
                total = sum(exact.cross(*[tuple(map(Fraction, points[k])) for k in t])
                            for t in found)
                self.assertEqual(total, sum(
                    Fraction(p[0]) * Fraction(q[1]) - Fraction(p[1]) * Fraction(q[0])
                    for p, q in zip(points, points[1:] + points[:1])))
                break
            else:
                self.fail('no triangulation')
        self.assertEqual(_triangulation([(0.0, 0.0), (2.0, 0.0), (1.0, 0.0), (1.0, -1.0)]), [])


if __name__ == '__main__':
    unittest.main()
