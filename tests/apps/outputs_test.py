# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""What a run writes and says: formats, report, trace, streams, conversion, no dependence on threads."""
import csv
import json
import os
import re

from command_helpers import *


def keys(value):
    return set(value) if isinstance(value, dict) else set()


class Streams(CommandTest):
    def test_positional_output_and_several_outputs(self):
        mesh = generated('cap')
        self.run_ok('parametrize', mesh, self.path('bare.obj'), '--degree', '1')
        self.run_ok('parametrize', mesh, '--degree', '1', '-o', self.path('a.vtu'), '-o',
                    self.path('a.obj'), '-o', self.path('a.svg'), '-o', self.path('a.json'), '-o',
                    self.path('a.csv'), '-o', self.path('B.OBJ'))
        self.assertEqual(self.files(), ['B.OBJ', 'a.csv', 'a.json', 'a.obj', 'a.svg', 'a.vtu',
                                        'bare.obj'])
        self.assertEqual(self.read('a.obj'), self.read('bare.obj'))
        self.assertEqual(self.read('a.obj'), self.read('B.OBJ'))
        for name in self.files():
            self.assertGreater(len(self.read(name)), 100, name)

    def test_stdout_is_for_data(self):
        for args in (['--quiet'], [], ['--verbose']):
            outcome = self.run_ok('parametrize', generated('cap'), '-o', self.path('out.vtu'),
                                  '--degree', '2', *args)
            self.assertEqual(outcome.out, '', args)
            if args == ['--quiet']:
                self.assertEqual(outcome.err, '')
            else:
                self.assertIn('converged', outcome.err.splitlines()[-1])
            self.assertNotIn('\r', outcome.err)  # no live line without a terminal
        verbose = outcome.err.count('iteration ')
        with_trace = self.run_ok('parametrize', generated('cap'), '-o', self.path('t.csv'), '--degree',
                                 '2')
        with open(self.path('t.csv')) as f:
            self.assertEqual(verbose, len(list(csv.DictReader(f))))
        self.assertLess(with_trace.err.count('iteration '), verbose)

    def test_other_verbs(self):
        self.run_ok('parametrize', '--quiet', generated('cap'), self.path('a.vtu'), '--degree', '2')
        for args in (['check', self.path('a.vtu')],
                     ['convert', self.path('a.vtu'), '-o', self.path('b.obj')]):
            self.assertEqual(self.run_ok(*args).out, '')
            self.assertEqual(self.run_ok(*args, '--quiet').err, '')

    def test_existing_files_are_replaced(self):
        self.write('out.vtu', 'old')
        self.run_ok('parametrize', '--quiet', generated('cap'), self.path('out.vtu'), '--degree', '1')
        self.assertTrue(self.read('out.vtu').startswith(b'<?xml'))
        self.assertEqual(self.files(), ['out.vtu'])

    def test_an_old_result_survives_a_refusal(self):
        self.write('out.vtu', 'old')
        self.write('bad.obj', 'v 0 0 0\n')
        self.refused(UNREADABLE, 'parametrize', self.path('bad.obj'), self.path('out.vtu'))
        self.assertEqual(self.read('out.vtu'), b'old')


class Info(CommandTest):
    def test_a_good_mesh(self):
        points, faces = quads(3)
        mesh = self.write('mesh.obj', obj_text(points + [(9, 9, 9)], faces))
        outcome = self.run_ok('info', mesh, '--report', self.path('r.json'))
        for part in ('mesh.obj', 'vertices: 17', 'polygons: 9', 'triangles: 18', 'components: 1',
                     'boundary loops: 1', 'Euler characteristic: 1', 'unreferenced', 'triangulated',
                     'parametrize can run'):
            self.assertIn(part, outcome.out)
        self.assertEqual(outcome.err, '')
        with open(self.path('r.json')) as f:
            data = json.load(f)
        self.assertEqual(data['command'], 'info')
        self.assertEqual((data['input']['vertices'], data['input']['faces']), (16, 18))
        self.assertEqual(len(data['input']['repairs']), 2)

    def test_a_bad_mesh(self):
        mesh = self.write('mesh.obj', obj_text(*torus(8, 6, 1)))
        outcome = self.run_ok('info', mesh)
        self.assertIn('would refuse', outcome.out)
        self.assertIn('genus 1', outcome.out)
        self.assertIn('Euler characteristic: -1', outcome.out)


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
                         (1, 'parametrize', 'converged', 2))
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
        # Options are recorded as asked.
        self.assertEqual(r['options']['degree'], 3)
        self.assertEqual(r['options']['boundary'], 'free')
        # Parts of the time add up to no more than all of it.
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
        """Seconds of rows add up to the time at which each of them ends."""
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
                self.assertGreaterEqual(step['factorizations'], step['failed_factorizations'])  # or kept
            seconds = report['seconds']
            self.assertLess(seconds['read'] + seconds['initialize'],
                            report['iterations'][0]['seconds']['other'])
            self.assertLess(spent, seconds['total'])

    def test_the_step_that_is_not_taken(self):
        self.run_ok('parametrize', '--quiet', generated('tube'), '-o', self.path('o.json'),
                    '--degree', '1', '--tolerance', '1e-13')
        *_, before, last = json.loads(self.read('o.json'))['iterations']
        self.assertEqual((before['outcome'], last['outcome']), ('moved', 'at-minimum'))
        self.assertEqual((last['step'], last['energy']), (0, before['energy']))
        self.assertGreater(last['factorizations'], 0)

    def test_what_a_factorization_costs(self):
        """Known from the run, measured after runs without one, null where nothing is to be solved."""
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

    def test_what_a_run_went_through(self):
        """Remedies, phases and the scaffold's time, where there is something to say of them."""
        def run(name, *options):
            self.run_ok('parametrize', '--quiet', generated(name), '-o', self.path('o.csv'), '--report',
                        self.path('r.json'), *options)
            with open(self.path('r.json')) as f, open(self.path('o.csv')) as g:
                report, rows = json.load(f), list(csv.DictReader(g))
            steps = report['iterations']
            self.assertEqual([(r['phase'], r['remedy'] or None) for r in rows],
                             [(s['phase'], s['remedy']) for s in steps])
            return report, [s['phase'] for s in steps], [s['remedy'] for s in steps]

        report, phases, remedies = run('cap', '--energy', 'log-isometric', '--degree', '2', '--bijective')
        deepen = report['remedies']['deepen']
        self.assertGreaterEqual(deepen['runs'], 1)
        self.assertGreater(deepen['gained'], 1e-3)
        self.assertEqual(remedies.count('deepen'), deepen['runs'])
        self.assertEqual(set(remedies), {'deepen', None})
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
        self.assertIn('"value": %r' % value, text)  # shortest text that gives the double back
        self.assertEqual(value, Vtu(self.path('o.vtu')).claims['value'])
        self.assertGreaterEqual(len(repr(value)), 15)
        # The sum of the cells' means gives it back.
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


class Formats(CommandTest):
    def test_vtu_fields(self):
        v, _, faces, _ = read_obj(generated('cap'))
        for n in (1, 2, 3, 4):
            path = self.path('o%d.vtu' % n)
            self.run_ok('parametrize', '--quiet', generated('cap'), '-o', path, '--degree', n)
            vtu = Vtu(path)
            size = (n + 1) * (n + 2) // 2
            edges = {tuple(sorted((f[k], f[(k + 1) % 3]))) for f in faces for k in range(3)}
            count = len(v) + (n - 1) * len(edges) + (n - 1) * (n - 2) // 2 * len(faces)
            self.assertEqual(vtu.types['uv'], 'Float64')
            self.assertEqual(len(vtu.rows('uv')), count)  # shared wherever the map is continuous
            self.assertEqual(len(vtu.rows('Points')), count)
            self.assertEqual(set(vtu.arrays['types']), {5 if n == 1 else 76})
            self.assertEqual({len(c) for c in vtu.cells()}, {size})
            self.assertEqual(vtu.arrays['input_face'], list(range(len(faces))))
            for name in ('distortion', 'min_det'):
                self.assertEqual(len(vtu.arrays[name]), len(faces))
                self.assertTrue(all(math.isfinite(x) and x > 0 for x in vtu.arrays[name]))
            for cell, face in zip(vtu.cells(), faces):
                self.assertEqual([vtu.arrays['input_vertex'][p] for p in cell[:3]], list(face))
                self.assertEqual([vtu.rows('Points')[p] for p in cell[:3]] if n == 1 else 0,
                                 [v[k] for k in face] if n == 1 else 0)
            for key in ('energy', 'value', 'boundary', 'seams', 'bijective', 'pins', 'options',
                        'version', 'degree'):
                self.assertIn(key, vtu.claims)
            self.assertEqual(vtu.claims['degree'], n)
            self.assertNotIn('RationalWeights', vtu.text)

    # VTK's order for a cubic: corners, then two points on each of the edges 01, 12, 20, then the middle.
    def test_control_points_of_flat_triangles(self):
        self.run_ok('parametrize', '--quiet', generated('tube'), '-o', self.path('o.vtu'))
        vtu = Vtu(self.path('o.vtu'))
        points = vtu.rows('Points')
        order = [(3, 0, 0), (0, 3, 0), (0, 0, 3), (2, 1, 0), (1, 2, 0), (0, 2, 1), (0, 1, 2), (1, 0, 2),
                 (2, 0, 1), (1, 1, 1)]
        for cell in vtu.cells():
            for local, weights in enumerate(order):
                for c in range(3):
                    flat = sum(w * points[cell[k]][c] for k, w in enumerate(weights)) / 3
                    self.assertAlmostEqual(points[cell[local]][c], flat, delta=1e-13)

    def test_obj_of_degree_1_keeps_the_mesh(self):
        points, faces = quads(4)
        text = obj_text(points, faces).replace('f ', 'usemtl brick\nf ', 1)
        mesh = self.write('mesh.obj', 'o thing\n' + text)
        self.run_ok('parametrize', '--quiet', mesh, '-o', self.path('o.obj'), '-o', self.path('o.vtu'),
                    '--degree', '1')
        v, vt, polygons, texture = read_obj(self.path('o.obj'))
        self.assertEqual(v, points)
        self.assertEqual(polygons, faces)
        self.assertIn('usemtl brick', self.read('o.obj').decode())
        self.assertEqual([len(t) for t in texture], [4] * len(faces))
        vtu = Vtu(self.path('o.vtu'))
        uv = dict(zip(vtu.arrays['input_vertex'], vtu.rows('uv')))
        for polygon, corners in zip(polygons, texture):
            for vertex, t in zip(polygon, corners):
                self.assertEqual(vt[t], uv[vertex])

    def test_refined_obj(self):
        v, _, faces, _ = read_obj(generated('cap'))
        edges = {tuple(sorted((f[k], f[(k + 1) % 3]))) for f in faces for k in range(3)}
        for args, k in (([], 1), (['--refine', '1'], 1), (['--refine', '5'], 5)):
            self.run_ok('parametrize', '--quiet', generated('cap'), '-o', self.path('o.obj'), '--degree',
                        '2', *args)
            points, vt, triangles, texture = read_obj(self.path('o.obj'))
            self.assertEqual(len(triangles), k * k * len(faces))
            self.assertEqual(len(points),
                             len(v) + (k - 1) * len(edges) + (k - 1) * (k - 2) // 2 * len(faces))
            self.assertEqual(len(vt), len(points))
            self.assertEqual(points[:len(v)], v)
            self.assertTrue(all(len(t) == 3 for t in texture))

    def test_svg(self):
        for n in (1, 3, 4):
            self.run_ok('parametrize', '--quiet', generated('tube'), '-o', self.path('o.svg'),
                        '--degree', n)
            text = self.read('o.svg').decode()
            self.assertGreaterEqual(text.count('<path'), 360)
            self.assertNotIn('nan', text.lower())
            self.assertTrue(text.rstrip().endswith('</svg>'))

    def test_normalize(self):
        self.run_ok('parametrize', '--quiet', generated('cap'), '-o', self.path('o.vtu'), '--degree',
                    '2', '--normalize')
        uv = Vtu(self.path('o.vtu')).rows('uv')
        for c in (0, 1):
            self.assertEqual(min(p[c] for p in uv), 0)
        self.assertEqual(max(max(p) for p in uv), 1)
        self.run_ok('check', self.path('o.vtu'), '--surface', generated('cap'))


class Convert(CommandTest):
    def test_vtu_to_vtu_is_lossless(self):
        for n in (1, 3):
            self.run_ok('parametrize', '--quiet', generated('cap'), '-o', self.path('a.vtu'),
                        '--degree', n)
            self.run_ok('convert', self.path('a.vtu'), '-o', self.path('b.vtu'))
            self.run_ok('convert', self.path('b.vtu'), self.path('c.vtu'))
            a, b = Vtu(self.path('a.vtu')), Vtu(self.path('b.vtu'))
            self.assertEqual(a.arrays, b.arrays)  # no number here is nan: equality is bitwise
            self.assertEqual(a.claims, b.claims)
            self.assertEqual(self.read('b.vtu'), self.read('c.vtu'))
            self.run_ok('check', self.path('b.vtu'), '--surface', generated('cap'))

    def test_formats_agree_with_parametrize(self):
        for n in (1, 3):
            names = ['a.vtu', 'a.obj', 'a.svg']
            self.run_ok('parametrize', '--quiet', generated('cap'), '--degree', n,
                        *[x for name in names for x in ('-o', self.path(name))])
            self.run_ok('convert', self.path('a.vtu'), '-o', self.path('b.obj'), '-o',
                        self.path('b.svg'))
            self.assertEqual(self.read('a.svg'), self.read('b.svg'))
            self.assertEqual(read_obj(self.path('a.obj')), read_obj(self.path('b.obj')))

    def test_refine(self):
        self.run_ok('parametrize', '--quiet', generated('cap'), self.path('a.vtu'), '--degree', '2')
        self.run_ok('convert', self.path('a.vtu'), self.path('b.obj'), '--refine', '4')
        self.assertEqual(len(read_obj(self.path('b.obj'))[2]), 16 * 486)

    def test_a_result_is_a_mesh_again(self):
        self.run_ok('parametrize', '--quiet', generated('cap'), self.path('a.vtu'), '--degree', '3')
        self.run_ok('parametrize', '--quiet', self.path('a.vtu'), self.path('b.vtu'), '--degree', '3')
        a, b = Vtu(self.path('a.vtu')), Vtu(self.path('b.vtu'))
        self.assertEqual(a.arrays['uv'], b.arrays['uv'])


class Invariance(CommandTest):
    def value(self, mesh, *args):
        self.run_ok('parametrize', '--quiet', mesh, '-o', self.path('r.json'), *args)
        with open(self.path('r.json')) as f:
            return json.load(f)['result']['value']

    def test_threads(self):
        for name, n in (('tube', 1), ('tube', 3), ('cap', 4), ('creature', 2)):
            for k in (1, 2, 3):
                self.run_ok('parametrize', '--quiet', generated(name), '--threads', k, '--degree', n,
                            *[x for end in ('vtu', 'obj', 'svg')
                              for x in ('-o', self.path('%d.%s' % (k, end)))])
            for end in ('vtu', 'obj', 'svg'):
                for k in (2, 3):
                    self.assertEqual(self.read('1.' + end), self.read('%d.%s' % (k, end)), (name, n))

    def test_scale_rotation_and_numbering(self):
        c, s = math.cos(0.7), math.sin(0.7)
        for name in ('tube', 'cap', 'wavy_disk'):
            v, _, faces, _ = read_obj(generated(name))
            edges = {(f[k], f[(k + 1) % 3]) for f in faces for k in range(3)}
            boundary = {a for a, b in edges if (b, a) not in edges}
            # The first boundary vertex stays first among them (the start is the same picture then),
            # everything else moves.
            first = min(boundary)
            order = sorted(range(len(v)), key=lambda k: (k != first, (k * 7919) % len(v), k))
            new = {old: k for k, old in enumerate(order)}
            variants = {
                'small': ([tuple(1e-6 * x for x in p) for p in v], faces),
                'large': ([tuple(1e6 * x for x in p) for p in v], faces),
                'odd scale': ([tuple(0.3 * x for x in p) for p in v], faces),
                'turned': ([(c * x - s * z, y, s * x + c * z) for x, y, z in v], faces),
                'turned twice': ([(c * y - s * z, s * y + c * z, x) for x, y, z in v], faces),
                'numbered': ([v[k] for k in order], [tuple(new[k] for k in f) for f in faces]),
                'faces in reverse': (v, [f[1:] + f[:1] for f in reversed(faces)]),
            }
            for n in (1, 3):
                expected = self.value(generated(name), '--degree', n, '--tolerance', '1e-10')
                for kind, mesh in variants.items():
                    path = self.write('variant.obj', obj_text(*mesh))
                    value = self.value(path, '--degree', n, '--tolerance', '1e-10')
                    with self.subTest(mesh=name, degree=n, variant=kind):
                        self.assertAlmostEqual(value / expected, 1, delta=1e-9)


if __name__ == '__main__':
    main()
