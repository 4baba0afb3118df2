# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""`info` predicts what the verbs do with a mesh."""
import json
import os
import unittest

from command_helpers import *


def annulus(n=12):
    points = [(r * math.cos(2 * math.pi * i / n), r * math.sin(2 * math.pi * i / n), 0.1 * r)
              for r in (1, 2) for i in range(n)]
    faces = []
    for i in range(n):
        a, b = i, (i + 1) % n
        faces += [(a, n + a, n + b), (a, n + b, b)]
    return points, faces


def fin():
    points, faces = grid(3)
    return points + [(0.5, 0.5, 5.0)], faces + [(5, 6, len(points))]


def turned():
    points, faces = grid(3)
    return points, [f[::-1] if k in (2, 9) else f for k, f in enumerate(faces)]


class Info(CommandTest):
    def info(self, points, faces, name='mesh.obj', uv=None):
        path = self.write(name, obj_text(points, faces, uv))
        text = self.run_ok('info', path)
        self.assertEqual(text.err, '')
        outcome = self.run_ok('info', path, '--report', '-')
        self.assertEqual(outcome.err, '')
        report = json.loads(outcome.out)
        self.assertIn('verdict: %s\n' % report['message'], text.out)
        self.assertEqual(report['input']['file'], path)
        return path, text.out, report

    def keeps_its_word(self, path, verdict):
        """Tests that verbs that can run according to the verdict do, and a verb that would refuse does."""
        words = verdict.split(' can run')[0].split() if ' can run' in verdict else ['parametrize']
        outcome = majorant(*words, path, '-o', self.path('out.vtu'), '--degree', 1)
        if ' can run' in verdict:
            self.assertEqual(outcome.code, OK, outcome.err)
            return
        self.assertEqual(outcome.code, UNSUPPORTED)
        reason = outcome.err[len('majorant: '):].rstrip('\n').split(';')[0]
        self.assertIn(reason, verdict)
        self.assertEqual(verdict.count('`majorant unwrap'), 1, verdict)

    def test_help_names_the_degree(self):
        """Help has the default degree of each verb, the one in its report."""
        by_outputs = '(3, or 1 where all data outputs are without curves: .obj .ply .glb .gltf)'
        for verb, words in (('unwrap', '(1)'), ('compare', '(3)'), ('parametrize', by_outputs), ('seamless', by_outputs),
                            ('deform', by_outputs)):
            text = re.sub(r'\s+', ' ', self.run_ok(verb, '--help').out)
            self.assertIn('polynomial degree ' + words, text, verb)
        for verb, out, degree in (('unwrap', 'a.vtu', 1), ('parametrize', 'a.vtu', 3), ('parametrize', 'a.obj', 1)):
            self.run_ok(verb, self.write('grid.obj', obj_text(*grid(3))), self.path(out), '--force', '--quiet',
                        '--report', self.path('r.json'))
            with open(self.path('r.json')) as f:
                self.assertEqual(json.load(f)['result']['degree'], degree)

    def test_a_map_is_named_and_not_judged_by_its_corners(self):
        """Corners of a valid curved map may be turned over as straight triangles."""
        turned_over = 0
        for degree in (1, 2, 3):
            result = self.path('result.vtu')
            self.run_ok('parametrize', generated('creature'), result, '--degree', degree, '--quiet', '--force')
            outcome = self.run_ok('info', result)
            report = json.loads(self.run_ok('info', result, '--report', '-').out)
            vtu = Vtu(result)
            uv = vtu.rows('uv')
            for a, b, c in ([uv[v] for v in cell[:3]] for cell in vtu.cells()):
                turned_over += (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) <= 0
            self.assertIn('map: of degree %d; it claims symmetric-dirichlet %.6f, nothing of overlaps; '
                          '`majorant check %s` proves it\n' % (degree, vtu.claims['value'], result), outcome.out)
            self.assertEqual(report['result']['map']['degree'], degree)
            self.assertEqual(report['result']['map']['claims']['value'], vtu.claims['value'])
            for word in ('repair', 'not injective'):
                self.assertNotIn(word, outcome.out)
            self.assertIn('verdict: parametrize can run', outcome.out)
        self.assertGreater(turned_over, 0)
        plain = self.run_ok('info', generated('creature')).out
        self.assertNotIn('map:', plain)

    def test_the_verdict_holds(self):
        for name, (points, faces), says in [
            ('disk', grid(3), 'parametrize can run'),
            ('annulus', annulus(), ' can run'),
            ('closed', torus(6, 5, 0), '`majorant seamless`'),
            ('handle', torus(6, 5, 1), '`majorant seamless`'),
            ('fin', fin(), '`majorant unwrap'),
            ('turned', turned(), '`majorant unwrap'),
        ]:
            with self.subTest(mesh=name):
                path, _, report = self.info(points, faces, name + '.obj')
                self.assertIn(says, report['message'])
                self.keeps_its_word(path, report['message'])
                if ' can run' not in report['message']:  # the remedy comes first
                    self.assertTrue(report['message'].startswith('use `majorant unwrap %s -o OUT.obj`' % path))

    def test_a_defect_is_no_case_for_seamless(self):
        _, _, report = self.info(*fin())
        self.assertNotIn('seamless', report['message'])

    def test_all_defects_with_counts_and_places(self):
        points, faces = turned()
        first = len(points)
        other = [(x + 9, y, z) for x, y, z in points]
        faces += [tuple(v + first for v in f) for f in grid(3)[1]]
        points = points + other + [(9.5, 0.5, 5.0)]
        faces += [(first + 5, first + 6, 2 * first), faces[-1]]
        path, text, report = self.info(points, faces)
        defects = {d['kind']: d for d in report['result']['defects']}
        self.assertEqual(defects['inconsistent_face']['places'], [[2], [9]])
        self.assertEqual(defects['duplicate_face']['count'], 1)
        self.assertEqual(defects['non_manifold_edge']['places'], [[first + 5, first + 6]])
        self.assertEqual(text.count('\ndefect: '), len(report['result']['defects']))
        self.assertRegex(text, r'\ndefect: 2 faces [^\n]*\(faces? 3, 10\)')
        self.assertEqual(report['input']['components'], 4)

    def test_polygons_that_cross_themselves(self):
        points, faces = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)], [(0, 1, 2, 3)]
        _, text, report = self.info(points, faces)
        self.assertIn({'kind': 'crossing_polygon', 'count': 1, 'places': [[0]]}, report['result']['defects'])
        self.assertIn('\ndefect: 1 polygon crosses itself (face 1)\n', text)

    def test_info_does_not_recommend_unwrap_if_it_would_refuse(self):
        points, faces = torus(6, 5, 0)
        tiny = [tuple(1e-100 * x for x in p) for p in points]
        pieces = faces + [tuple(v + len(points) for v in f) for f in faces]
        for name, mesh in (('tiny piece', (points + tiny, pieces)),
                           ('large', ([tuple(1e200 * x for x in p) for p in points], faces)),
                           ('small', ([tuple(1e-200 * x for x in p) for p in points], faces))):
            with self.subTest(name):
                path, text, report = self.info(*mesh)
                reason = self.refused(UNSUPPORTED, 'unwrap', path, self.path('out.obj'))
                reason = reason.err[len('majorant: '):].rstrip('\n')
                self.assertIn('; and unwrap: ' + reason, report['message'])
                plan = self.run_ok('info', path, '--plan').out
                self.assertIn('plan: unwrap would refuse: %s\n' % reason, plan)
                report = json.loads(self.run_ok('info', path, '--plan', '--report', '-').out)
                self.assertEqual(report['result']['plan'], {'message': reason})

    def test_no_defects(self):
        _, text, report = self.info(*grid(3))
        self.assertEqual(report['result']['defects'], [])
        self.assertNotIn('defect', text)

    def test_warnings(self):
        path = self.write('odd.obj', 'newthing 1\n' + obj_text(*grid(3)))
        self.assertIn("\nwarning: %s:1: 1 line skipped" % path, self.run_ok('info', path).out)
        report = json.loads(self.run_ok('info', path, '--report', '-').out)
        self.assertEqual(len(report['input']['warnings']), 1)
        out = self.path('out.obj')
        err = self.run_ok('parametrize', path, out, '--quiet', '--report', self.path('r.json')).err
        self.assertEqual(err.count('majorant: warning: '), 1)
        with open(self.path('r.json')) as f:
            self.assertEqual(json.load(f)['input']['warnings'], report['input']['warnings'])
        self.assertEqual(majorant('check', out, '--surface', path).err.count('warning'), 1)

    def test_reports_of_other_verbs_on_stdout(self):
        mesh = generated('cap')
        outcome = self.run_ok('parametrize', mesh, self.path('out.obj'), '--report', '-')
        self.assertEqual(json.loads(outcome.out)['status'], 'converged')
        outcome = self.run_ok('compare', mesh, '--degree', 1, '--methods', 'newton', '--report', '-')
        self.assertEqual(json.loads(outcome.out)['command'], 'compare')
        self.assertEqual(self.files(), ['out.obj'])


if __name__ == '__main__':
    main()
