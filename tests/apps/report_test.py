# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""--report: its keys, and the agreement of its figures with the run and the files."""
import csv
import json

from command_helpers import *


def keys(value):
    return set(value) if isinstance(value, dict) else set()


class Report(CommandTest):
    TOP = {'schema_version', 'version', 'command', 'status', 'message', 'input', 'options', 'result',
           'iterations', 'injectivity_tests', 'flips', 'remedies', 'seconds',
           'peak_memory_bytes', 'threads'}
    INPUT = {'file', 'vertices', 'faces', 'components', 'boundary_loops', 'euler_characteristic', 'area',
             'repairs'}
    RESULT = {'degree', 'control_points', 'variables', 'energy', 'value', 'initial_value',
              'value_quadrature', 'max_density', 'sigma_max', 'sigma_min', 'locally_injective',
              'min_det_bound', 'globally_injective', 'boundary', 'seam_residual', 'constraint_residual',
              'factor_solve_seconds'}
    ITERATION = {'iteration', 'degree', 'level', 'phase', 'outcome', 'remedy', 'energy', 'minimized',
                 'relative_decrease', 'step', 'gradient_norm', 'curvature', 'factorizations',
                 'failed_factorizations', 'elapsed', 'seconds'}
    STEP_SECONDS = {'assemble', 'factorize', 'solve', 'line_search', 'other'}
    SECONDS = {'read', 'initialize', 'optimize', 'write', 'total'}

    def test_schema(self):
        pins = self.write('pins.json', '{"handles": [{"vertex": 100, "target": "initial"}]}')
        self.run_ok('parametrize', '--quiet', generated('cap'), '-o', self.path('o.json'), '-o',
                    self.path('o.csv'), '-o', self.path('o.vtu'), '--report', self.path('r.json'),
                    '--threads', '2', '--pins', pins)
        with open(self.path('r.json')) as f:
            r = json.load(f)
        with open(self.path('o.json')) as f:
            self.assertEqual(json.load(f), r)
        self.assertLessEqual(self.TOP, keys(r))
        self.assertLessEqual(self.INPUT, keys(r['input']))
        self.assertLessEqual(self.RESULT, keys(r['result']))
        self.assertLessEqual(self.SECONDS, keys(r['seconds']))
        self.assertEqual(keys(r['flips']), {'intended', 'performed'})
        self.assertEqual(r['remedies'], {remedy: {'runs': 0, 'gained': 0} for remedy in (
            'deepen', 'refine', 'exclude', 'follow-barrier')})
        self.assertEqual(r['seconds']['scaffold'], 0)
        self.assertEqual((r['schema_version'], r['command'], r['status'], r['threads']),
                         (2, 'parametrize', 'converged', 2))
        self.assertEqual(r['version'], self.run_ok('--version').out.split()[1])
        v, _, faces, _ = read_obj(generated('cap'))
        self.assertEqual((r['input']['vertices'], r['input']['faces']), (len(v), len(faces)))
        self.assertEqual((r['input']['components'], r['input']['boundary_loops'],
                          r['input']['euler_characteristic'], r['input']['repairs']), (1, 1, 1, []))
        self.assertTrue(r['input']['file'].endswith('cap.obj'))
        result = r['result']
        self.assertEqual(result['degree'], 3)
        self.assertEqual(result['energy'], 'symmetric-dirichlet')
        vtu = Vtu(self.path('o.vtu'))
        self.assertEqual(result['control_points'], len(vtu.rows('uv')))
        self.assertEqual(result['variables'], 2 * result['control_points'] - 2)
        self.assertIs(result['locally_injective'], True)
        self.assertIs(result['globally_injective'], True)
        self.assertEqual(result['boundary']['contacts'], [])
        self.assertGreater(result['boundary']['pairs_tested'], 10)
        self.assertIsNone(result['seam_residual'])
        self.assertLess(result['constraint_residual'], 1e-12)
        self.assertLess(result['value'], result['initial_value'])
        self.assertAlmostEqual(result['value_quadrature'], result['value'], delta=0.02)
        self.assertGreater(result['sigma_max'], 1)
        self.assertLess(result['sigma_min'], 1)
        self.assertEqual(result['min_det_bound'], min(vtu.arrays['min_det']))
        self.assertGreater(result['min_det_bound'], 0)
        self.assertGreater(r['peak_memory_bytes'], 1 << 20)
        self.assertGreaterEqual(len(r['injectivity_tests']['depth']), 6)
        self.assertGreater(sum(r['injectivity_tests']['depth']), 0)
        # Options are recorded with their requested values.
        self.assertEqual(r['options']['degree'], 3)
        self.assertEqual(r['options']['boundary'], 'free')
        # The parts of the time add up to at most the total.
        self.assertLessEqual(sum(r['seconds'][k] for k in self.SECONDS - {'total'}),
                             r['seconds']['total'])

        energy = result['initial_value']
        for k, step in enumerate(r['iterations']):
            self.assertLessEqual(self.ITERATION, keys(step))
            self.assertLessEqual(self.STEP_SECONDS, keys(step['seconds']))
            self.assertEqual(step['iteration'], k + 1)
        self.assertLess(r['iterations'][-1]['energy'], energy)
        self.assertEqual(r['iterations'][-1]['degree'], 3)

        with open(self.path('o.csv')) as f:
            rows = list(csv.DictReader(f))
        self.assertEqual(len(rows), len(r['iterations']))
        for row, step in zip(rows, r['iterations']):
            for name in ('iteration', 'degree', 'level', 'energy', 'minimized', 'relative_decrease',
                         'step', 'gradient_norm', 'factorizations', 'failed_factorizations',
                         'elapsed'):
                self.assertEqual(float(row[name]), step[name], name)
            for name in self.STEP_SECONDS:
                self.assertEqual(float(row[name]), step['seconds'][name], name)
            self.assertEqual((row['phase'], row['remedy']), ('newton', ''))
            self.assertEqual((step['phase'], step['remedy']), ('newton', None))
            self.assertEqual((row['outcome'], row['curvature']), (step['outcome'], step['curvature']))
            self.assertEqual((step['level'], step['minimized']), (0, step['energy']))
            self.assertEqual(step['outcome'] == 'moved', step['step'] > 0)

    def test_rows_tell_all_the_time(self):
        """The seconds of rows add up to the time at which each of them ends."""
        for options in ([], ['--bijective', '--degree', '2'], ['--energy', 'arap', '--boundary', 'fixed']):
            self.run_ok('parametrize', '--quiet', generated('tube'), '-o', self.path('o.json'), *options)
            report = json.loads(self.read('o.json'))
            self.assertGreater(len(report['iterations']), 3)
            spent = 0
            for step in report['iterations']:
                self.assertEqual(set(step['seconds']), self.STEP_SECONDS)
                self.assertGreaterEqual(min(step['seconds'].values()), 0)
                spent += sum(step['seconds'].values())
                self.assertAlmostEqual(step['elapsed'], spent, delta=1e-9)
                self.assertGreaterEqual(step['factorizations'], step['failed_factorizations'])  # a factor may be reused
            seconds = report['seconds']
            self.assertLess(seconds['read'] + seconds['initialize'],
                            report['iterations'][0]['seconds']['other'])
            self.assertLess(spent, seconds['total'])

    def test_the_last_step_is_listed_if_it_is_not_taken(self):
        self.run_ok('parametrize', '--quiet', generated('tube'), '-o', self.path('o.json'),
                    '--degree', '1', '--tolerance', '1e-13')
        *_, before, last = json.loads(self.read('o.json'))['iterations']
        self.assertEqual((before['outcome'], last['outcome']), ('moved', 'at-minimum'))
        self.assertEqual((last['step'], last['energy']), (0, before['energy']))
        self.assertGreater(last['factorizations'], 0)

    def test_the_time_of_a_factorization(self):
        """Its cost is known from the run, measured after runs without a factorization, or null if nothing is solved."""
        def cost(*options, code=0):
            self.run_ok('parametrize', '--quiet', '--force', *options, '-o', self.path('o.json'), code=code)
            report = json.loads(self.read('o.json'))
            return report['result']['factor_solve_seconds'], report['iterations']

        seconds, steps = cost(generated('tube'), '--degree', '2')
        last = [s['seconds'] for s in steps if s['degree'] == 2]
        self.assertLessEqual(seconds, max(s['factorize'] + s['solve'] for s in last))
        self.assertGreater(seconds, 0)
        for options in ([], ['--degree', '2', '--bijective']):
            seconds, steps = cost(generated('tube'), '--max-iterations', '0', *options, code=LIMIT)
            self.assertEqual(steps, [])
            self.assertGreater(seconds, 0)
        triangle = self.write('t.obj', 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n')
        self.assertEqual(cost(triangle, '--degree', '1', '--boundary', 'fixed'), (None, []))

    def test_remedies_phases_and_scaffold_time(self):
        """Remedies, phases and the scaffold's time, if there are any."""
        def run(name, *options):
            self.run_ok('parametrize', '--quiet', generated(name), '-o', self.path('o.csv'), '--report',
                        self.path('r.json'), *options)
            with open(self.path('r.json')) as f, open(self.path('o.csv')) as g:
                report, rows = json.load(f), list(csv.DictReader(g))
            steps = report['iterations']
            self.assertEqual([(r['phase'], r['remedy'] or None) for r in rows],
                             [(s['phase'], s['remedy']) for s in steps])
            return report, [s['phase'] for s in steps], [s['remedy'] for s in steps]

        report, phases, remedies = run('cap', '--energy', 'log-isometric', '--degree', '3')
        deepen = report['remedies']['deepen']
        self.assertGreaterEqual(deepen['runs'], 1)
        self.assertGreater(deepen['gained'], 1e-3)
        self.assertEqual(remedies.count('deepen'), deepen['runs'])
        self.assertEqual(set(remedies), {'deepen', None})
        self.assertEqual(set(phases), {'newton'})
        report, phases, _ = run('cap', '--energy', 'log-isometric', '--degree', '2', '--bijective',
                                '--write-scaffold', self.path('s.vtu'))
        self.assertEqual(set(phases), {'newton'})
        seconds = report['seconds']
        self.assertTrue(0 < seconds['scaffold'] < seconds['optimize'], seconds)
        report, phases, remedies = run('tube', '--energy', 'amips-exponential', '--degree', '1')
        entry = phases.count('entry')
        self.assertGreater(entry, 3)
        self.assertEqual(phases, ['entry'] * entry + ['newton'] * (len(phases) - entry))
        self.assertEqual(set(remedies), {None})

    def test_value_keeps_all_digits(self):
        self.run_ok('parametrize', '--quiet', generated('tube'), '-o', self.path('o.vtu'), '--report',
                    self.path('r.json'), '--degree', '2')
        text = self.read('r.json').decode()
        value = json.loads(text)['result']['value']
        self.assertIn('"value": %r' % value, text)  # shortest text that reads back as the same double
        self.assertEqual(value, Vtu(self.path('o.vtu')).claims['value'])
        self.assertGreaterEqual(len(repr(value)), 15)
        # The weighted sum of the cells' means is the value.
        vtu = Vtu(self.path('o.vtu'))
        points, total, area = vtu.rows('Points'), 0, 0
        for cell, mean in zip(vtu.cells(), vtu.arrays['distortion']):
            a, b, c = (points[p] for p in cell[:3])
            u, w = [[q[k] - a[k] for k in range(3)] for q in (b, c)]
            normal = [u[(k + 1) % 3] * w[(k + 2) % 3] - u[(k + 2) % 3] * w[(k + 1) % 3]
                      for k in range(3)]
            part = 0.5 * math.sqrt(sum(x * x for x in normal))
            total, area = total + part * mean, area + part
        self.assertAlmostEqual(total / area, value, delta=1e-11 * value)


if __name__ == '__main__':
    main()
