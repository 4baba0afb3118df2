#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""majorant compare: outputs, choice of methods, errors."""
import csv
import json
import math
import os
import re
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from command_helpers import *

CAP, TUBE = generated('cap'), generated('tube')
COLUMNS = ['method', 'iteration', 'seconds', 'energy', 'gradient_norm', 'step', 'min_det']


class Compare(CommandTest):
    def compare(self, *flags, mesh=CAP):
        return majorant('compare', mesh, '--quiet', *flags)

    def rows(self, name):
        with open(self.path(name), newline='') as file:
            reader = csv.DictReader(file)
            self.assertEqual(reader.fieldnames, COLUMNS)
            return list(reader)

    def test_every_method_agrees(self):
        outcome = self.compare('--degree', 1, '-o', self.path('c.csv'), '-o', self.path('c.html'),
                               '--report', self.path('c.json'), '--max-iterations', 5000)
        self.assertEqual(outcome.code, 0, outcome.err)
        report = json.loads(open(self.path('c.json')).read())
        best = report['result']['best_energy']
        names = [m['method'] for m in report['result']['methods']]
        self.assertEqual(len(names), len(set(names)))
        for absent in ('newton-cholmod', 'newton-mumps', 'newton-cg-hypre'):  # only if they are named
            self.assertNotIn(absent, names)
        for expected in ('newton', 'newton-absolute', 'newton-adaptive', 'newton-reweighted', 'newton-eigen', 'lbfgs', 'gradient-flow',
                         *(('ceres-lbfgs', 'ceres-nlcg', 'ceres-lm') if has_gpl_parts() else ())):
            self.assertIn(expected, names)
        for method in report['result']['methods']:
            self.assertLess(method['energy'], best * (1 + 1e-4), method)
            self.assertGreater(method['min_det'], 0)
            self.assertIn(method['method'], outcome.out)
            self.assertEqual(method['definite'], 'yes', method)  # although the gradient is not 0
            self.assertEqual(method['notes'], [], method)
            parts = method['seconds_by_part']
            if method['method'].startswith('ceres'):
                self.assertEqual(set(parts.values()), {None})
                self.assertEqual(method['factorizations'] > 0, method['method'] == 'ceres-lm')
                continue
            self.assertLessEqual(sum(parts.values()), method['seconds'])
            self.assertGreater(min(parts.values()), 0, method)
            self.assertGreater(method['factorizations'], 0)
        self.check_rows(names)
        page = open(self.path('c.html')).read()
        requested = set(re.findall('https?:[^"\']*', page))
        self.assertLessEqual(requested, {'http://www.w3.org/2000/svg'})  # a namespace, not an address that is loaded
        self.assertIn('newton-eigen', page)

    def check_rows(self, names):
        rows = self.rows('c.csv')
        starts = [row for row in rows if row['iteration'] == '0']
        self.assertEqual([row['method'] for row in starts], names)
        self.assertEqual(len({row['energy'] for row in starts}), 1)
        for name in names:
            mine = [row for row in rows if row['method'] == name]
            seconds = [float(row['seconds']) for row in mine]
            self.assertEqual(seconds, sorted(seconds))
            self.assertLess(float(mine[-1]['energy']), float(mine[0]['energy']))
            self.assertLess(float(mine[-1]['gradient_norm']), float(mine[0]['gradient_norm']))
            self.assertTrue(all(math.isfinite(float(row['energy'])) for row in mine))

    def test_methods_that_do_not_fit_are_left_out(self):
        outcome = self.compare('--degree', 1, '--energy', 'mips', '--report', self.path('m.json'),
                               '--time-limit', 5)
        self.assertEqual(outcome.code, 0, outcome.err)
        names = [m['method'] for m in json.loads(open(self.path('m.json')).read())['result']['methods']]
        self.assertIn('newton-majorizer', names)
        for absent in ('newton-reweighted', 'newton-paper-majorizer', 'ceres-lm'):
            self.assertNotIn(absent, names)

    def test_chosen_methods(self):
        outcome = self.compare('--degree', 2, '--methods', 'lbfgs, newton,lbfgs', '-o',
                               self.path('c.csv'), mesh=TUBE)
        self.assertEqual(outcome.code, 0, outcome.err)
        self.assertEqual({row['method'] for row in self.rows('c.csv')}, {'lbfgs', 'newton'})
        first = [row for row in self.rows('c.csv') if row['iteration'] == '0']
        self.assertEqual([row['method'] for row in first], ['lbfgs', 'newton'])

    def test_linear_solvers(self):
        """One system for all solvers, each to its own accuracy. A missing solver is reported and is no error."""
        outcome = self.compare('--degree', 2, '--linear-solvers', 'all', '--report', self.path('l.json'),
                               '--max-iterations', 3)
        self.assertEqual(outcome.code, 0, outcome.err)
        report = json.loads(open(self.path('l.json')).read())
        self.assertEqual([m['method'] for m in report['result']['methods']], ['newton'])
        rows = {row['name']: row for row in report['result']['linear_solvers']}
        self.assertEqual(list(rows), ['direct', 'cholmod', 'eigen', 'mumps', 'cg-hypre'])
        for name, row in rows.items():
            self.assertIn(name, outcome.out)
            if row['message']:
                self.assertIn(name, ('cholmod', 'mumps', 'cg-hypre'))
                self.assertIn('.so', row['message'])
                continue
            self.assertLess(row['residual'], 1e-7 if name == 'cg-hypre' else 1e-11, name)
            for part in ('analyze', 'factorize', 'solve'):
                self.assertGreater(row[part + '_seconds'], 0)
            self.assertTrue(row['description'])
        two = self.compare('--degree', 1, '--linear-solvers', 'eigen, direct', '--methods', 'lbfgs', '--report', '-',
                           '--max-iterations', 3)
        report = json.loads(two.out)
        self.assertEqual([row['name'] for row in report['result']['linear_solvers']], ['eigen', 'direct'])
        self.assertEqual([m['method'] for m in report['result']['methods']], ['lbfgs'])

    def test_linear_solvers_as_methods(self):
        """Newton's steps do not depend on the linear solver."""
        names = ['newton', 'newton-cholmod', 'newton-mumps', 'newton-cg-hypre']
        present = [name for name in names if name == 'newton' or os.path.exists(os.path.join(
            os.path.dirname(BINARY), 'libmajorant_%s.so' % ('cholmod' if 'cholmod' in name else 'petsc')))]
        outcome = self.compare('--degree', 1, '--methods', ','.join(present), '--report', '-', '--max-iterations', 2,
                               '--time-limit', 1000)
        self.assertEqual(outcome.code, 0, outcome.err)
        methods = json.loads(outcome.out)['result']['methods']
        self.assertEqual([m['method'] for m in methods], present)
        for method in methods:
            self.assertEqual((method['status'], method['iterations']), ('max_iterations', 2), method)
            self.assertLess(abs(method['energy'] - methods[0]['energy']), 1e-3 * methods[0]['energy'])
            self.assertGreater(method['factorizations'], 1)

    def test_time_limit_of_each_method(self):
        """A mesh on which a single step takes longer than the limit: methods end within a step."""
        outcome = self.compare('--degree', 8, '--time-limit', 0.02, '--report', '-', mesh=generated('creature'))
        self.assertEqual(outcome.code, 0, outcome.err)
        methods = json.loads(outcome.out)['result']['methods']
        self.assertGreater(len(methods), 8)
        for method in methods:
            self.assertEqual((method['status'], method['iterations']), ('time_limit', 0), method)

    def test_limits(self):
        outcome = self.compare('--degree', 1, '--methods', 'gradient-flow', '--max-iterations', 3,
                               '-o', self.path('c.csv'))
        self.assertEqual(outcome.code, 0, outcome.err)
        self.assertEqual(len(self.rows('c.csv')), 4)
        self.assertIn('max_iterations', outcome.out)

    def test_errors_are_one_line(self):
        for code, flags in ((1, ['--methods', 'newtn']),
                            (1, ['--linear-solvers', 'cholmud']),
                            (1, ['--methods', 'ceres-lm', '--energy', 'arap']),
                            (1, ['--methods', 'newton-reweighted', '--energy', 'mips']),
                            (1, ['--energy', 'asap']),
                            (1, ['--curvature', 'exact']),
                            (1, ['--time-limit', 'nan']),
                            (1, ['-o', self.path('c.vtu')]),
                            (1, ['-o', self.path('nowhere/c.csv')])):
            outcome = self.compare('--degree', 1, *flags)
            self.assertEqual(outcome.code, code, '%s\n%s' % (flags, outcome.err))
            self.assertEqual(len(outcome.err.strip().splitlines()), 1, outcome.err)
        self.assertEqual(self.compare(mesh=self.path('missing.obj')).code, 2)

    def test_an_infinite_start_is_infeasible(self):
        outcome = self.compare('--energy', 'amips-exponential', '--degree', 1,
                               mesh=generated('creature'))
        self.assertEqual(outcome.code, 3, outcome.err)
        self.assertIn('take another energy', outcome.err)


if __name__ == '__main__':
    main()
