# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""check accepts the results of parametrize, and exits with 5 on every kind of tampering."""
import json
import os

from command_helpers import *


class Check(CommandTest):
    @classmethod
    def setUpClass(cls):
        cls.shared = tempfile.mkdtemp(prefix='majorant_check_')
        cls.addClassCleanup(shutil.rmtree, cls.shared)
        cls.mesh = generated('cap')
        pins = os.path.join(cls.shared, 'pins.json')
        with open(pins, 'w') as f:
            json.dump({'handles': [{'vertex': v, 'target': 'initial'} for v in (100, 150)]}, f)
        cls.results = {}
        for name, options in {'free1': ['--degree', '1'], 'free3': ['--degree', '3'],
                              'pins1': ['--degree', '1', '--pins', pins],
                              'pins2': ['--degree', '2', '--pins', pins],
                              'fixed1': ['--degree', '1', '--boundary', 'fixed'],
                              'fixed3': ['--degree', '3', '--boundary', 'fixed']}.items():
            cls.results[name] = os.path.join(cls.shared, name + '.vtu')
            outcome = majorant('parametrize', '--quiet', cls.mesh, '-o', cls.results[name], *options)
            assert outcome.code == OK, outcome.err

    def tampered(self, name, change, says=''):
        """Applies `change` to a fresh copy of a result; check must exit with 5 and give the reason."""
        vtu = Vtu(self.results[name])
        change(vtu)
        path = vtu.write(self.path(name + '_tampered.vtu'))
        self.found(path, says=[path, 'invalid', says])
        return path

    def test_untouched_results_pass(self):
        for name, path in self.results.items():
            report = self.path('report.json')
            outcome = self.run_ok('check', path, '--surface', self.mesh, '--report', report)
            self.assertEqual(len(outcome.printed()), 1, outcome.err)
            with open(report) as f:
                data = json.load(f)
            self.assertEqual((data['schema_version'], data['command'], data['status']),
                             (2, 'check', 'valid'))
            self.assertEqual(data['result']['findings'], [])
            self.assertTrue(data['result']['locally_injective'])
            self.assertAlmostEqual(data['result']['value'], Vtu(path).claims['value'], delta=1e-9)

    def test_files_that_are_rewritten_unchanged_are_valid(self):
        # Files that are rewritten without a change are valid, so that failures below are due to tampering.
        for name in self.results:
            path = Vtu(self.results[name]).write(self.path('copy.vtu'))
            with open(self.results[name], 'rb') as f:
                self.assertEqual(self.read('copy.vtu').split(b'<Piece')[1],
                                 f.read().split(b'<Piece')[1])
            self.run_ok('check', path, '--surface', self.mesh)

    def test_a_flipped_triangle(self):
        def swap(vtu):
            a, b = vtu.cells()[200][:2]
            uv = vtu.arrays['uv']
            for c in (0, 1):
                uv[2 * a + c], uv[2 * b + c] = uv[2 * b + c], uv[2 * a + c]
        for name in ('free1', 'free3'):
            self.tampered(name, swap, 'det J')

    def test_an_inner_control_point_far_away(self):
        def move(vtu):
            vtu.arrays['uv'][2 * vtu.cells()[200][-1]] += 3
        self.tampered('free3', move, 'det J')

    def test_broken_continuity(self):
        for name in ('free1', 'free3'):
            def tear(vtu, local):
                # Cell 200 gets its own copy of one point, slightly moved in the plane.
                point = vtu.cells()[200][local]
                size = len(vtu.cells()[0])
                for array in ('uv', 'Points', 'input_vertex'):
                    k = vtu.components[array]
                    vtu.arrays[array] += vtu.arrays[array][k * point:k * (point + 1)]
                vtu.arrays['uv'][-1] += 1e-3
                vtu.arrays['connectivity'][200 * size + local] = len(vtu.rows('uv')) - 1
            if name == 'free3':
                path = self.tampered(name, lambda vtu: tear(vtu, 3), 'continuous')  # a point of an edge
                for out in 'out.vtu', 'out.msh':  # convert does not write it either
                    self.refused(INVALID, 'convert', path, '-o', self.path(out), says='is not written')
                    self.assertFalse(os.path.exists(self.path(out)))
            self.tampered(name, lambda vtu: tear(vtu, 0))                    # a corner

    def test_a_moved_pin(self):
        def move(vtu):
            point = vtu.arrays['input_vertex'].index(100)
            vtu.arrays['uv'][2 * point] += 1e-5
        for name in ('pins1', 'pins2'):
            self.tampered(name, move, 'pin of vertex 100')

    def test_a_pin_that_is_not_there(self):
        def claim(vtu):
            vtu.claims['pins'].append({'vertex': 120, 'target': [7, 7]})
        self.tampered('pins1', claim, 'pin of vertex 120')

    def test_a_lie_about_the_energy(self):
        for factor in (0.99, 1.01, 1.001):
            def lie(vtu):
                vtu.claims['value'] *= factor
            self.tampered('free3', lie, 'energy')
        vtu = Vtu(self.results['free3'])  # a value within the accuracy of energies is no false claim
        vtu.claims['value'] *= 1 + 1e-6
        self.run_ok('check', vtu.write(self.path('close.vtu')))

    def test_a_lie_about_the_degree(self):
        self.tampered('free3', lambda vtu: vtu.claims.update(degree=2), 'degree')

    def test_a_moved_fixed_boundary(self):
        for name in ('fixed1', 'fixed3'):
            def move(vtu):
                edges = {}
                n = vtu.claims['degree']
                for cell in vtu.cells():
                    for k in range(3):
                        a, b = cell[k], cell[(k + 1) % 3]
                        inner = cell[3 + k * (n - 1)] if n > 1 else a
                        edges.setdefault((min(a, b), max(a, b)), []).append(inner)
                point = next(e[0] for e in edges.values() if len(e) == 1)
                vtu.arrays['uv'][2 * point + 1] += 1e-6
            self.tampered(name, move, 'boundary')

    def test_a_free_boundary_that_claims_to_be_fixed(self):
        self.tampered('free3', lambda vtu: vtu.claims.update(boundary='fixed'), 'boundary')

    def test_a_seamless_map_that_needs_no_seams(self):
        vtu = Vtu(self.results['free1'])
        vtu.claims.update(seams=True)
        self.assertIn('0 seam edges', self.run_ok('check', vtu.write(self.path('seams.vtu'))).out)
        self.assertIn('0 seam edges', self.run_ok('check', self.results['free3'], '--seamless').out)

    def ramp(self, turns):
        """Writes a textured OBJ: a ramp of 40 quads, mapped straight down, which overlaps itself beyond one turn."""
        lines = []
        for i in range(41):
            t = 2 * math.pi * turns * i / 40
            for r in (1, 2):
                x, y = r * math.cos(t), r * math.sin(t)
                lines.append('v %r %r %r\nvt %r %r' % (x, y, i / 40, x, y))
        for i in range(40):
            a, b, c, d = 2 * i + 1, 2 * i + 2, 2 * i + 3, 2 * i + 4
            for p, q, r in ((a, b, d), (a, d, c)):
                lines.append('f %d/%d %d/%d %d/%d' % (p, p, q, q, r, r))
        return self.write('ramp.obj', '\n'.join(lines) + '\n')

    def report_of(self, *args, code=OK):
        report = self.path('report.json')
        self.run_ok('check', *args, '--report', report, code=code)
        with open(report) as f:
            return json.load(f)

    def test_global_injectivity(self):
        for path in self.results.values():
            result = self.report_of(path, '--certify')['result']
            self.assertIs(result['globally_injective'], True)
            self.assertGreater(result['boundary']['pairs_tested'], 10)
            self.assertEqual(result['boundary']['contacts'], [])
        for turns in (0.5, 0.99):
            self.run_ok('check', self.ramp(turns), '--certify')

    def test_an_overlap(self):
        path = self.ramp(1.2)
        self.run_ok('check', path)  # no claim of injectivity
        result = self.report_of(path)['result']
        self.assertIs(result['globally_injective'], False)
        contact = result['boundary']['contacts'][0]
        self.assertTrue(contact['certain'])
        edges, (u, v) = contact['edges'], contact['uv']
        for a, b in edges:  # sides or ends of the ramp
            self.assertTrue(abs(a - b) == 2 or {a, b} in ({0, 1}, {80, 81}), (a, b))
        self.assertTrue(0.9 < math.hypot(u, v) < 2.1)
        self.found(path, '--certify',
                     says=['not globally injective', '(%d, %d) and (%d, %d) meet near'
                           % (*edges[0], *edges[1])])

    def test_touching_ends(self):
        # Two corners of the last edge are moved onto corners of the first.
        path = self.ramp(0.99)
        lines = self.read('ramp.obj').decode().split('\n')
        texture = [k for k, line in enumerate(lines) if line.startswith('vt ')]
        for k in (0, 1):
            lines[texture[80 + k]] = lines[texture[k]]
        self.run_ok('check', path)
        self.found(self.write('ramp.obj', '\n'.join(lines)), '--certify',
                     says='meet near')

    def test_claims_to_be_bijective(self):
        def claim(vtu):
            vtu.claims['bijective'] = True
        vtu = Vtu(self.results['free3'])
        claim(vtu)
        self.run_ok('check', vtu.write(self.path('claim.vtu')))

        def pull(vtu):  # moves a boundary corner to the other side, which also inverts its triangles
            claim(vtu)
            uv, edges = vtu.arrays['uv'], {}
            for cell in vtu.cells():
                for k in range(3):
                    edges.setdefault(frozenset((cell[k], cell[(k + 1) % 3])), []).append(cell)
            a = min(next(e for e, cells in edges.items() if len(cells) == 1))
            middle = [sum(uv[c::2]) / (len(uv) // 2) for c in (0, 1)]
            for c in (0, 1):
                uv[2 * a + c] += 2.5 * (middle[c] - uv[2 * a + c])
        self.tampered('free3', pull, 'not globally injective')

    def test_maps_that_are_not_locally_injective_are_not_certified(self):
        def swap(vtu):
            a, b = vtu.cells()[200][:2]
            uv = vtu.arrays['uv']
            for c in (0, 1):
                uv[2 * a + c], uv[2 * b + c] = uv[2 * b + c], uv[2 * a + c]
        path = self.tampered('free1', swap, 'det J')
        report = self.report_of(path, '--certify', code=INVALID)
        self.assertIs(report['result']['globally_injective'], None)
        self.assertEqual(report['result']['overlaps'], 'not decided: the map is not locally injective')
        self.assertTrue(any('could not be decided' in finding for finding in report['result']['findings']))

    @where(os.path.join(SHARED, 'data', 'public', 'disks'))
    def test_public_meshes(self):
        for name, injective in {'plane_500': False, 'spot_500': True}.items():
            mesh = os.path.join(SHARED, 'data', 'public', 'disks', name + '.obj')
            out = self.path('out.vtu')
            report = self.path('run.json')
            self.run_ok('parametrize', '--quiet', mesh, '-o', out, '--degree', '2', '--report',
                        report)
            with open(report) as f:
                self.assertIs(json.load(f)['result']['globally_injective'], injective)
            self.run_ok('check', out, '--certify', code=OK if injective else INVALID)

    def test_a_bent_surface(self):
        def bend(vtu):
            vtu.arrays['Points'][3 * vtu.cells()[200][-1] + 2] += 0.05
        self.tampered('free3', bend, 'flat')

    def test_another_surface(self):
        for other in ('wavy_disk', 'tube'):
            self.found(self.results['free3'], '--surface', generated(other),
                         says='surface')
        v, _, faces, _ = read_obj(self.mesh)
        moved = [tuple(p) for p in v]
        moved[17] = (moved[17][0] + 1e-3, moved[17][1], moved[17][2])
        for points, polygons in ((moved, faces), (v, faces + [(0, 1, 2)]), (v, faces[:-1])):
            path = self.write('other.obj', obj_text(points, polygons))
            self.found(self.results['free3'], '--surface', path)

    def test_a_face_that_is_mapped_as_another(self):
        # The vertices are those of another cell: --surface must compare the face's corners, too.
        def exchange(vtu):
            f = vtu.arrays['input_face']
            f[3], f[200] = f[200], f[3]
        vtu = Vtu(self.results['free3'])
        exchange(vtu)
        self.found(vtu.write(self.path('exchanged.vtu')), '--surface', self.mesh)

    def test_a_missing_cell(self):
        def drop(vtu):
            size = len(vtu.cells()[0])
            del vtu.arrays['connectivity'][-size:]
            for name in ('offsets', 'types', 'input_face', 'distortion', 'min_det', 'sigma_1', 'sigma_2',
                         'area_distortion', 'angle_distortion', 'stretch_l2', 'stretch_linf'):
                vtu.arrays[name].pop()
            vtu.text = vtu.text.replace('NumberOfCells="486"', 'NumberOfCells="485"')
        vtu = Vtu(self.results['free1'])
        drop(vtu)
        path = vtu.write(self.path('dropped.vtu'))
        self.found(path, '--surface', self.mesh)

    def test_an_obj_result(self):
        self.run_ok('convert', self.results['free1'], '-o', self.path('out.obj'))
        self.run_ok('check', self.path('out.obj'))
        self.run_ok('check', self.path('out.obj'), '--surface', self.mesh)
        text = self.read('out.obj').decode().split('\n')
        first = next(k for k, line in enumerate(text) if line.startswith('vt '))
        text[first + 30] = 'vt 50 50'
        self.found(self.write('bad.obj', '\n'.join(text)), says='bad.obj')
        self.refused(UNSUPPORTED, 'check', self.mesh, says='has no texture coordinates; use `majorant unwrap`')
        self.refused(UNSUPPORTED, 'convert', self.mesh, '-o', self.path('o.svg'), says='has no texture coordinates')

    def test_the_report_of_a_failure(self):
        path = self.tampered('free1', lambda vtu: vtu.claims.update(value=3.0))
        report = self.path('report.json')
        self.found(path, '--report', report)
        with open(report) as f:
            data = json.load(f)
        self.assertEqual(data['status'], 'invalid')
        self.assertEqual(len(data['result']['findings']), 1)
        self.assertIn('energy', data['message'])

    def test_quiet(self):
        outcome = self.run_ok('check', '--quiet', self.results['free1'])
        self.assertEqual((outcome.out, outcome.err), ('', ''))


if __name__ == '__main__':
    main()
