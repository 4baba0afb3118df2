# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Files and messages of a run: formats, streams, conversion, independence of threads."""
import csv
import json

from command_helpers import *


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
            done = self.run_ok(*args, '--quiet')
            self.assertEqual((done.out, done.err), ('', ''))

    def test_existing_files_are_replaced(self):
        self.write('out.vtu', 'old')
        self.run_ok('parametrize', '--quiet', generated('cap'), self.path('out.vtu'), '--degree', '1', '--force')
        self.assertTrue(self.read('out.vtu').startswith(b'<?xml'))
        self.assertEqual(self.files(), ['out.vtu'])


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
            self.assertEqual(len(vtu.rows('uv')), count)  # points are shared if the map is continuous
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
            parts = sum(len(re.findall('[mM]', path)) for path in re.findall(' d="([^"]*)"', text))
            self.assertGreaterEqual(parts, 360)
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
            self.assertEqual(a.arrays, b.arrays)  # no number is nan, so that equality is bitwise
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
            # The first boundary vertex stays the first one, so that the start has the same orientation;
            # all others are renumbered.
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
