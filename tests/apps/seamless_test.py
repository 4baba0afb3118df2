# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""parametrize --seamless and the verdicts of check on its results, unchanged and tampered with."""
import json
import os
import subprocess

from seamless_helpers import *


class Seamless(SeamlessTest):
    def test_results_pass(self):
        for name, path in self.results.items():
            with self.subTest(name):
                report = self.path('report.json')
                outcome = self.run_ok('check', path, '--surface', self.mesh_of(name), '--report',
                                      report)
                self.assertIn('cones', outcome.out)
                with open(report) as f:
                    found = json.load(f)['result']
                printed = self.report(name)['result']
                self.assertEqual(found['cones'], printed['cones'])
                self.assertTrue(found['locally_injective'])
                for result in (found, printed):
                    self.assertLess(result['seam_residual_ulp'], 100)
                    self.assertLess(result['seam_residual'], 1e-12)  # relative to a layout of some units

    def test_cones(self):
        points = cube(4)[0]
        corners = [v for v, p in enumerate(points) if min(map(abs, p)) > 0.85]
        self.assertEqual(len(corners), 8)
        for name in ('cube1', 'cube2', 'cube4'):
            cones = self.report(name)['result']['cones']
            self.assertEqual(sorted(c['vertex'] for c in cones), corners)
            self.assertEqual({c['quarter_turns'] for c in cones}, {3})
            self.assertEqual(sum(c['index'] for c in cones), 2)  # Euler characteristic
            vtu = Vtu(self.results[name])
            self.assertIs(vtu.claims['seams'], True)
            self.assertEqual(vtu.claims['cones'], cones)
            marked = {v for v, c in zip(vtu.arrays['input_vertex'], vtu.arrays['cone']) if c}
            self.assertEqual(sorted(marked), corners)
            self.assertEqual(set(vtu.arrays['cone']), {0, 3})
        self.assertEqual(self.report('torus3')['result']['cones'], [])

    def test_the_start(self):
        start = self.report('cube1')['seam_start']
        self.assertEqual((start['chains'], start['seam_edges']), (12, 48))
        self.assertLess(start['residual'], 1e-12)
        self.assertLess(start['moved'], 1e-12)
        self.assertNotIn('seam_start', json.loads(self.plain_report()))

    def plain_report(self):
        self.run_ok('parametrize', '--quiet', generated('cap'), '-o', self.path('r.json'),
                    '--degree', '1')
        return self.read('r.json')

    def test_marks_of_seams(self):
        for name in ('cube1', 'cube4'):
            vtu = Vtu(self.results[name])
            self.assertEqual(vtu.components['seam_edges'], 3)
            # Both cells of an edge have the same seam number; on a seam they share no point.
            sides = {}
            for cell, marks in zip(vtu.cells(), vtu.rows('seam_edges')):
                for k in range(3):
                    points = {cell[k], cell[(k + 1) % 3]}
                    ends = frozenset(vtu.arrays['input_vertex'][p] for p in points)
                    sides.setdefault(ends, []).append((marks[k], points))
            for (mark, points), (same, others) in sides.values():
                self.assertEqual(mark, same)
                self.assertEqual(mark > 0, points.isdisjoint(others))
                for p in points if mark else ():
                    self.assertGreater(vtu.arrays['seam'][p], 0)
            self.assertEqual({m for row in vtu.rows('seam_edges') for m in row}, set(range(13)))

    # ---------------------------------------------------------------- tampering
    def tampered(self, name, change, *says, surface=()):
        vtu = Vtu(self.results[name])
        change(vtu)
        path = vtu.write(self.path(name + '_tampered.vtu'))
        self.found(path, *surface, says=[path, 'invalid', *says])

    def seam_point(self, vtu):
        cell, k = next((c, k) for c, row in enumerate(vtu.rows('seam_edges')) for k in range(3)
                       if row[k])
        return cell, k, vtu.cells()[cell]

    def test_a_moved_point_on_a_seam(self):
        for name in ('cube1', 'cube2', 'cube4', 'torus3', 'open3'):
            for amount in (1e-6, 1e-3):
                def move(vtu):
                    _, k, cell = self.seam_point(vtu)
                    n = vtu.claims['degree']
                    vtu.arrays['uv'][2 * cell[3 + k * (n - 1) if n > 1 else k]] += amount
                self.tampered(name, move, 'seam', 'edge (')

    def test_a_torn_seam(self):
        def move(vtu):
            _, k, cell = self.seam_point(vtu)
            vtu.arrays['uv'][2 * cell[k]] += 0.05
        self.tampered('cube1', move, 'not seamless', 'edge (')

    def test_a_duplicated_point(self):
        def duplicate(vtu, cell, local):
            size = len(vtu.cells()[0])
            point = vtu.cells()[cell][local]
            for array in ('uv', 'Points', 'input_vertex', 'cone', 'seam'):
                k = vtu.components[array]
                vtu.arrays[array] += vtu.arrays[array][k * point:k * (point + 1)]
            vtu.arrays['connectivity'][cell * size + local] = len(vtu.rows('uv')) - 1
        for name in ('cube1', 'cube2', 'cube4'):
            vtu = Vtu(self.results[name])
            cell, k, _ = self.seam_point(vtu)
            duplicate(vtu, cell, k)
            path = vtu.write(self.path('duplicated.vtu'))
            if name == 'cube1':  # only its points show where it is cut
                self.found(path, says=[path, 'not marked as a seam', 'edge ('])
            else:  # equal values are continuous, even without shared points
                self.run_ok('check', path, '--surface', self.mesh_of(name))

    def test_lies_about_cones(self):
        def drop(vtu):
            vtu.claims['cones'].pop()
        def add(vtu):
            vtu.claims['cones'].append({'vertex': 1, 'quarter_turns': 5, 'index': -0.25})
        def change(vtu):
            vtu.claims['cones'][0]['quarter_turns'] = 2
        for lie in (drop, add, change):
            self.tampered('cube2', lie, 'quarter turns', 'vertex')
        def mark(vtu):
            point = vtu.arrays['cone'].index(0)
            vtu.arrays['cone'][point] = 5
        self.tampered('cube1', mark, 'marked as a cone')

    def test_no_seams_to_claim(self):
        path = self.path('plain.vtu')
        self.run_ok('parametrize', '--quiet', generated('cap'), '-o', path, '--degree', '1')
        self.assertIn('(0 seam edges)', self.run_ok('check', path, '--seamless').out)
        vtu = Vtu(self.results['cube1'])
        vtu.claims['seams'] = False
        vtu.claims.pop('cones')
        denied = vtu.write(self.path('denied.vtu'))
        self.assertIn('6 charts', self.run_ok('check', denied).out)  # cut along its claimed cuts
        vtu.claims.pop('cuts')
        vtu.write(denied)
        self.found(denied, says=['the sides of 48 inner edges', '--cuts free'])
        self.assertIn('6 charts', self.run_ok('check', denied, '--cuts', 'free').out)

    def test_a_cone_without_a_seam(self):
        # Squares wind twice around vertex 0: an angle of 720 degrees, without a cut.
        rim = [(math.cos(a), math.sin(a)) for a in (2 * math.pi * k / 8 for k in range(16))]
        texture = [(0, 0)] + [(x * (1 + 0.1 * (k % 3)), y * (1 + 0.1 * (k % 3)))
                              for k, (x, y) in enumerate(rim)]
        points = [(0, 0, 0)] + [(2 * math.cos(a), 2 * math.sin(a), k % 2)
                                for k, a in enumerate(math.pi * k / 8 for k in range(16))]
        faces = [(0, k + 1, (k + 1) % 16 + 1) for k in range(16)]
        mesh = self.write('double.obj', textured_obj(points, faces, texture, faces))
        for n in (1, 2):
            out = self.path('double.vtu')
            self.run_ok('parametrize', '--quiet', mesh, '--seamless', '--degree', n, '-o', out,
                        '-o', self.path('double.svg'))
            self.assertEqual(Vtu(out).claims['cones'],
                             [{'vertex': 0, 'quarter_turns': 8, 'index': -1.0}])
            self.run_ok('check', out, '--surface', mesh)
            vtu = Vtu(out)
            vtu.claims['seams'] = False
            denied = vtu.write(self.path('denied.vtu'))
            self.found(denied, says='more than once')

    def test_seamless_from_nothing(self):
        # The input's texture coordinates do not matter for a map that does not use them.
        mesh = self.meshes['torus']
        for n in (1, 2):
            out = self.path('made.vtu')
            self.run_ok('seamless', '--quiet', mesh, '--degree', n, '-o', out, '--report',
                        self.path('made.json'))
            self.run_ok('check', out, '--surface', mesh)
            report = json.loads(self.read('made.json'))
            self.assertEqual(Vtu(out).claims['cones'], report['result']['cones'])
            self.assertIn('chains', report['seam_start'])

    def test_another_cut(self):
        points, faces, texture, charts = triangles(cube(4))
        # With one chart turned by 90 degrees, cuts are equal and rotations differ.
        turned = list(texture)
        for t in range(25):
            turned[t] = (-texture[t][1], texture[t][0])
        other = self.write('turned.obj', textured_obj(points, faces, turned, charts))
        for result in (self.results['cube2'], self.results['cube1'].replace('.vtu', '.obj')):
            flags = ['--seamless'] if result.endswith('.obj') else []
            self.run_ok('check', result, '--surface', self.meshes['cube'], *flags)
            self.found(result, '--surface', other, *flags,
                         says=['quarter turns', 'edge ('])
        other = self.write('torus.obj', textured_obj(*torus_map(16, 8)[:2], *[
            [(x + 1, y) for x, y in torus_map(16, 8)[2]], torus_map(16, 8)[3]]))
        self.run_ok('check', self.results['torus3'], '--surface', other)  # vertices are moved only

    def test_a_surface_without_texture(self):
        points, faces, _, _ = triangles(cube(4))
        plain = self.write('plain.obj', obj_text(points, faces))
        self.run_ok('check', self.results['cube2'], '--surface', plain)
        self.refused(UNSUPPORTED, 'parametrize', plain, '--seamless', '-o', self.path('o.vtu'),
                     says='texture')

    # ---------------------------------------------------------------- pins and boundaries
    def test_pins_on_seams(self):
        vertex = self.report('cube1')['result']['cones'][0]['vertex']
        pins = self.write('pins.json', json.dumps(
            {'handles': [{'vertex': v, 'target': 'initial'} for v in (vertex, 1)]}))
        for n in (1, 2):
            out = self.path('pinned.vtu')
            self.run_ok('parametrize', '--quiet', self.meshes['cube'], '--seamless', '--degree', n,
                        '--pins', pins, '-o', out)
            claims = Vtu(out).claims['pins']
            self.assertEqual(len([p for p in claims if p['vertex'] == vertex]), 3)
            self.run_ok('check', out, '--surface', self.meshes['cube'])
            for lie in (lambda pins: pins[0].update(target=[17.0, 0.0]), lambda pins: pins.pop(0)):
                vtu = Vtu(out)
                lie(vtu.claims['pins'])
                path = vtu.write(self.path('moved.vtu'))
                self.found(path, says='the pin of vertex')

    def test_a_fixed_boundary(self):
        for name in ('fixed1', 'fixed3'):
            self.run_ok('check', self.results[name], '--surface', self.meshes['open'])
            vtu = Vtu(self.results[name])
            cells, marks, n = vtu.cells(), vtu.rows('seam_edges'), vtu.claims['degree']
            edges = {}
            for cell, row in zip(cells, marks):
                for k in range(3):
                    if row[k] == 0:
                        inner = cell[3 + k * (n - 1)] if n > 1 else cell[k]
                        ends = sorted((cell[k], cell[(k + 1) % 3]))
                        edges.setdefault(tuple(ends), []).append(inner)
            on_seams = {cell[k] for cell, row in zip(cells, marks) for k in range(3)
                        if row[k] or row[(k + 2) % 3]}
            point = next(e[0] for e in edges.values() if len(e) == 1 and e[0] not in on_seams)
            vtu.arrays['uv'][2 * point + 1] += 1e-6
            path = vtu.write(self.path('moved.vtu'))
            self.found(path, '--surface', self.meshes['open'], says='boundary')

    # ---------------------------------------------------------------- independent checkers
    def test_the_checker(self):
        for name, path in self.results.items():
            with self.subTest(name):
                self.judge(path, self.mesh_of(name), '--seamless')
        vtu = Vtu(self.results['cube2'])
        vtu.arrays['uv'][2 * self.seam_point(vtu)[2][0]] += 1e-3
        self.judge(vtu.write(self.path('moved.vtu')), self.mesh_of('cube2'), '--seamless', code=1)

    @where(VERIFY)
    def test_verify(self):
        for name, path in self.results.items():
            mesh = self.mesh_of(name)
            process = subprocess.run(['/usr/bin/python3', VERIFY, path, '--mesh', mesh, '--cuts',
                                      'auto', '--same-cuts', mesh, '--max-cut-fraction', '0.6',
                                      '--no-energy'], text=True, stdout=subprocess.PIPE,
                                     stderr=subprocess.PIPE, timeout=300)
            self.assertEqual(process.returncode, 0, name + process.stdout[-2000:] + process.stderr)
            self.assertTrue(json.loads(process.stdout)['ok']['same_cuts'])

    @where(os.path.join(SHARED, 'data', 'public', 'seamless'))
    def test_public_meshes(self):
        folder = os.path.join(SHARED, 'data', 'public', 'seamless')
        for name in sorted(os.listdir(folder)):
            mesh = os.path.join(folder, name)
            for n in (1, 2):
                out = self.path('out.vtu')
                self.run_ok('parametrize', '--quiet', mesh, '--seamless', '--degree', n, '-o', out)
                self.run_ok('check', out, '--surface', mesh)


if __name__ == '__main__':
    main()
