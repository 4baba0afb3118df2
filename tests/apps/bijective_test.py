# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""--bijective and deform: exit codes, claims, and their proof by check."""
import json
import os

from command_helpers import *


def without(faces, *quads):
    return [f for k, f in enumerate(faces) if k // 2 not in quads]


class Bijective(CommandTest):
    def report_of(self, *args, code=OK):
        report = self.path('report.json')
        self.run_ok(*args, '--quiet', '--report', report, code=code)
        with open(report) as f:
            return json.load(f)

    def test_a_ramp_that_would_overlap(self):
        mesh = self.write('ramp.obj', obj_text(*ramp(1.3)))
        for degree in (1, 2, 3):
            free, held = self.path('free.vtu'), self.path('held.vtu')
            report = self.report_of('parametrize', mesh, '-o', free, '--degree', degree)
            self.assertIs(report['result']['globally_injective'], False)
            self.assertEqual(report['flips'], {'intended': 0, 'performed': 0})
            self.assertFalse(Vtu(free).claims.get('bijective'))
            self.run_ok('check', free)  # no claim of injectivity
            self.found(free, '--certify', says='not globally injective')

            report = self.report_of('parametrize', mesh, '-o', held, '--degree', degree, '--bijective')
            self.assertEqual(report['status'], 'converged')
            self.assertIs(report['result']['globally_injective'], True)
            self.assertIs(report['options']['bijective'], True)
            self.assertEqual(report['flips']['performed'] > 0, degree > 1)  # degree 1 has no scaffold
            self.assertIs(Vtu(held).claims['bijective'], True)
            self.run_ok('check', held, '--surface', mesh, '--certify')

    def test_a_limit_leaves_an_injective_map(self):
        mesh = self.write('ramp.obj', obj_text(*ramp(1.3)))
        for iterations in (0, 3, 10):
            out = self.path('out.vtu')
            self.run_ok('parametrize', mesh, '-o', out, '--quiet', '--bijective',
                        '--max-iterations', iterations, code=LIMIT)
            self.run_ok('check', out, '--certify')

    def test_a_start_that_overlaps(self):
        points, faces = ramp(1.3)
        mesh = self.write('ramp.obj', obj_text(points, faces, [p[:2] for p in points]))
        self.run_ok('parametrize', mesh, '-o', self.path('out.vtu'), '--quiet', '--init', 'input')
        self.refused(UNSUPPORTED, 'parametrize', mesh, '-o', self.path('other.vtu'), '--quiet',
                     '--init', 'input', '--bijective')
        self.assertNotIn('other.vtu', self.files())

    def test_holes(self):
        points, faces = grid(6)
        mesh = self.write('holes.obj', obj_text(points, without(faces, 14, 15, 27)))
        out = self.path('out.vtu')
        self.run_ok('parametrize', mesh, '-o', out, '--quiet')  # with or without overlaps
        report = self.report_of('parametrize', mesh, '-o', out, '--bijective', '--degree', 2)
        self.assertEqual(report['input']['boundary_loops'], 3)
        self.assertIs(report['result']['globally_injective'], True)
        self.run_ok('check', out, '--surface', mesh, '--certify')

    def test_the_scaffold_is_drawn_behind_the_map(self):
        mesh = self.write('ramp.obj', obj_text(*ramp(1.3)))
        for flags, drawings in ((['--bijective', '--write-scaffold', self.path('s.vtu')], 1), ([], 0)):
            self.run_ok('parametrize', mesh, '-o', self.path('out.svg'), '--quiet', '--degree', 2,
                        '--max-iterations', 5, *flags, code=LIMIT)
            self.assertEqual(self.read('out.svg').count(b'clip-path="url(#drawing)"'), drawings)

    def test_the_scaffold_as_a_file(self):
        mesh = self.write('ramp.obj', obj_text(*ramp(1.3)))
        for name, degree in (('scaffold.vtu', 1), ('curved.vtu', 2), ('scaffold.svg', 2)):
            self.run_ok('parametrize', mesh, '-o', self.path('out.vtu'), '--quiet', '--bijective',
                        '--degree', degree, '--elevation', 'direct', '--max-iterations', 5,
                        '--write-scaffold', self.path(name), code=LIMIT)
            self.assertGreater(len(self.read(name)), 1000)
        self.refused(USAGE, 'parametrize', mesh, '-o', self.path('out.vtu'), '--quiet',
                     '--write-scaffold', self.path('scaffold.vtu'), says='--bijective')


class Deform(CommandTest):
    def bar(self, height=lambda x, y: 0.0):
        points, faces = grid(12, height)
        return self.write('bar.obj', obj_text([(4 * x, y, z) for x, y, z in points], faces))

    def targets(self, turn=2.0):
        """Returns targets: the left end stays, the right end is turned and moved back."""
        handles = []
        for j in (0, 4, 8, 12):
            y = j / 12
            handles.append({'vertex': 13 * j, 'target': [0, y]})
            handles.append({'vertex': 13 * j + 12,
                            'target': [2.4 - math.sin(turn) * (y - 0.5), 1.8 + math.cos(turn) * (y - 0.5)]})
        return self.write('targets.json', json.dumps({'handles': handles})), handles

    def test_soft_and_hard(self):
        mesh, (file, handles) = self.bar(), self.targets()
        for flag, within in (('--handles', 0.01 * math.hypot(4, 1)), ('--pins', 1e-14)):
            for more in ([], ['--bijective']):
                out, report = self.path('bent.vtu'), self.path('report.json')
                self.run_ok('deform', mesh, flag, file, '-o', out, '--degree', 2, '--quiet',
                            '--report', report, *more)
                vtu = Vtu(out)
                place = dict(zip(vtu.arrays['input_vertex'], vtu.rows('uv')))
                for h in handles:
                    self.assertLessEqual(math.dist(place[h['vertex']][:2], h['target']), within)
                with open(report) as f:
                    data = json.load(f)
                self.assertEqual((data['command'], data['status']), ('deform', 'converged'))
                self.run_ok('check', out, '--surface', mesh)
                if more:
                    self.run_ok('check', out, '--certify')
                    self.assertIs(vtu.claims['bijective'], True)

    def test_clockwise_as_counterclockwise(self):
        """A planar mesh has no side: targets and results are in its own plane."""
        mesh, (file, handles) = self.bar(), self.targets()
        points, _, faces, _ = read_obj(mesh)
        turned = self.write('turned.obj', obj_text(points, [f[::-1] for f in faces]))
        results = {}
        for name in (mesh, turned):
            outcome = self.run_ok('deform', name, '--handles', file, '--degree', 1, '-o', self.path('a.vtu'), '-o',
                                  self.path('a.obj'), '--report', self.path('r.json'), '--force')
            self.assertEqual('all faces are clockwise' in outcome.err, name == turned)
            for out in ('a.vtu', 'a.obj'):
                self.run_ok('check', self.path(out), '--certify', '--surface', name)
            vtu = Vtu(self.path('a.vtu'))
            place = dict(zip(vtu.arrays['input_vertex'], vtu.rows('uv')))
            for h in handles:
                self.assertLessEqual(math.dist(place[h['vertex']][:2], h['target']), 0.01 * math.hypot(4, 1))
            results[name] = json.loads(self.read('r.json'))['result']['value']
        self.assertAlmostEqual(results[turned], results[mesh], places=6)
        bent = self.write('bent.obj', obj_text([(x, y, 0.1 * x * y) for x, y, _ in points], [f[::-1] for f in faces]))
        mirrored = self.write('b.obj', obj_text([(x, y, 0.1 * x * y) for x, y, _ in points], faces,
                                                [p[:2] for p in points]))
        self.run_ok('check', mirrored, '--surface', bent, code=INVALID)  # a mesh that is not planar has a side

    def test_every_output(self):
        mesh, (file, _) = self.bar(), self.targets()
        self.run_ok('deform', mesh, '--handles', file, '--quiet', '-o', self.path('a.svg'),
                    '-o', self.path('a.obj'), '-o', self.path('a.json'))
        self.assertTrue({'a.svg', 'a.obj', 'a.json'} <= set(self.files()))

    def test_refusals(self):
        mesh, (file, _) = self.bar(), self.targets()
        out = self.path('out.vtu')
        self.refused(USAGE, 'deform', mesh, '-o', out, says=['--handles', '--pins'])
        self.refused(UNSUPPORTED, 'deform', self.bar(bumpy), '--handles', file, '-o', out,
                     says='off the plane')
        mesh = self.bar()
        swapped = self.write('swapped.json', json.dumps({'handles': [
            {'vertex': 40, 'target': [4 * 2 / 12, 3 / 12]}, {'vertex': 41, 'target': [4 / 12, 3 / 12]},
            {'vertex': 54, 'target': [4 * 2 / 12, 4 / 12]}]}))
        self.refused(UNSUPPORTED, 'deform', mesh, '--pins', swapped, '-o', out, '--degree', 1,
                     '--quiet', says=["no valid way to the pins' targets", 'vertex '])
        self.assertNotIn('out.vtu', self.files())


if __name__ == '__main__':
    main()
