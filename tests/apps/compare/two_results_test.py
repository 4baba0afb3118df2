#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""majorant compare A.vtu B.vtu -o AB.html -o AB.svg: two results of one surface, face by face."""
import base64
import json
import os
import re
import sys

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from command_helpers import *


class TwoResults(CommandTest):
    def make(self, name, *args, verb='parametrize', mesh=None):
        mesh = mesh or self.write('bumpy.obj', obj_text(*grid(6, lambda x, y: 2 * bumpy(x, y))))
        self.run_ok(verb, '--quiet', mesh, '-o', self.path(name), *args)

    def data(self):
        text = self.read('ab.html').decode()
        return json.loads(re.search(r'id="data">(.*?)</script>', text, re.S).group(1))

    @staticmethod
    def corners(data):
        """Returns positions on the surface of the corners of every face."""
        array = lambda key, kind: np.frombuffer(base64.b64decode(data[key]), kind)
        n = data['degree']
        size = (n + 1) * (n + 2) // 2
        cells = array('cells', '<u4').reshape(-1, size)[:, [0, size - n - 1, size - 1]]
        return array('positions', '<f8').reshape(-1, 3)[cells]

    def test_faces_of_both_are_one(self):
        self.make('a.vtu', '--degree', 2)
        self.make('b.vtu', '--degree', 3, '--energy', 'mips')
        self.run_ok('compare', self.path('a.vtu'), self.path('b.vtu'), '-o', self.path('ab.html'))
        data = self.data()
        self.assertEqual([data['title'], data['other']['title']], ['a.vtu', 'b.vtu'])
        self.assertIn('<title>a.vtu | b.vtu</title>', self.read('ab.html').decode())
        self.assertEqual([data['degree'], data['other']['degree']], [2, 3])
        self.assertTrue(np.array_equal(self.corners(data), self.corners(data['other'])))
        self.assertNotIn(self.folder, self.read('ab.html').decode())

    def test_in_any_order_and_cut_anyhow(self):
        mesh = self.write('torus.obj', obj_text(*torus(10, 6, 0)))
        self.make('a.vtu', '--degree', 2, verb='unwrap', mesh=mesh)
        self.make('c.vtu', '--degree', 2, '--seams', 'sharp=20', verb='unwrap', mesh=mesh)
        vtu = Vtu(self.path('c.vtu'))  # faces in reverse order, corners rotated by one
        count, size = len(vtu.cells()), 6
        order = [2, 0, 1, 5, 3, 4]  # a quadratic cell in VTK's order: corners, then edges 01, 12, 20
        connectivity = np.array(vtu.arrays['connectivity']).reshape(count, size)[::-1][:, order]
        vtu.arrays['connectivity'][:] = connectivity.ravel().tolist()
        for name in ('input_face', 'distortion', 'min_det', 'chart', 'sigma_1', 'sigma_2', 'area_distortion',
                     'angle_distortion', 'stretch_l2', 'stretch_linf'):
            if name in vtu.arrays:
                vtu.arrays[name][:] = list(vtu.arrays[name])[::-1]
        vtu.write(self.path('b.vtu'))
        self.run_ok('compare', self.path('a.vtu'), self.path('b.vtu'), '-o', self.path('ab.html'))
        data = self.data()
        self.assertTrue(np.array_equal(self.corners(data), self.corners(data['other'])))
        chart = np.frombuffer(base64.b64decode(data['other']['chart']), '<i4')
        self.run_ok('compare', self.path('a.vtu'), self.path('c.vtu'), '-o', self.path('ab.html'))
        straight = self.data()
        self.assertEqual(chart.tolist(), np.frombuffer(
            base64.b64decode(straight['other']['chart']), '<i4').tolist())

        def uv(data):
            cells = np.frombuffer(base64.b64decode(data['cells']), '<u4').reshape(-1, size)
            return np.frombuffer(base64.b64decode(data['uv']), '<f8').reshape(-1, 2)[cells]
        self.assertTrue(np.array_equal(uv(data['other']), uv(straight['other'])))

    def drawing(self, *flags):
        self.run_ok('compare', self.path('a.vtu'), self.path('b.vtu'), '-o', self.path('ab.svg'), '--force', *flags)
        return self.read('ab.svg').decode()

    def test_a_drawing_of_both(self):
        """One scale, one range of colours, one legend; the densities are those of the first file's energy."""
        self.make('a.vtu', '--degree', 2)
        self.make('b.vtu', '--degree', 3, '--energy', 'mips', '--normalize')
        text = self.drawing('--color-range', '4,4.5')
        printed = re.findall(r'<text[^>]*>([^<]*)</text>', text)
        for line in ('a.vtu, degree 2', 'b.vtu, degree 3', 'symmetric-dirichlet density', 'isometry 4', '4.5'):
            self.assertEqual(printed.count(line), 1, (line, printed))
        report = self.path('b.json')
        self.run_ok('check', self.path('a.vtu'), '--report', report, '--quiet')
        with open(report) as f:
            largest = json.load(f)['result']['max_density']
        self.assertIn('smallest', ' '.join(printed))
        self.assertIn('largest %.4g' % largest, ' '.join(printed))
        self.assertNotIn(self.folder, text)
        # The layouts are side by side.
        fills = re.findall(r'<path fill="#[0-9a-f]{6}" stroke="[^"]*" stroke-width="[^"]*" d="([^"]*)"', text)
        self.assertGreater(len(fills), 4)
        firsts = [float(re.match(r'M([\d.]+)', fill)[1]) for fill in fills]
        self.assertTrue(min(firsts) < 500 < max(firsts))
        self.assertEqual(len(set(re.findall(r'<clipPath id="([^"]*)"', text))), text.count('<clipPath'))
        # There is one scale: a map beside itself has the same paths twice, moved.
        self.run_ok('compare', self.path('a.vtu'), self.path('a.vtu'), '-o', self.path('aa.svg'))
        fills = re.findall(r'<path fill="#[0-9a-f]{6}" stroke="[^"]*" stroke-width="[^"]*" d="M([^a-z]*)([^"]*)"',
                           self.read('aa.svg').decode())
        half = len(fills) // 2
        self.assertEqual([d for _, d in fills[:half]], [d for _, d in fills[half:]])

    def test_a_drawing_obeys_the_options_of_drawings(self):
        self.make('a.vtu', '--degree', 2)
        self.make('b.vtu', '--degree', 1)
        small = self.drawing('--size', '700,500', '--edges', 'no', '--color-by', 'area', '--transparent')
        self.assertIn('width="700" height="500"', small)
        self.assertIn('>area distortion<', small)
        self.assertNotIn('<rect', small)
        bare = self.drawing('--legend', 'no')
        self.assertEqual(re.findall(r'<text[^>]*>([^<]*)</text>', bare), ['a.vtu, degree 2', 'b.vtu, degree 1'])
        outcome = majorant('compare', self.path('a.vtu'), self.path('b.vtu'), '-o', self.path('x.svg'), '--size', '300,100')
        self.assertEqual(outcome.code, USAGE)
        self.assertRegex(outcome.err, r'its legends are .*, or leave the legends out with --legend no; ')
        outcome = majorant('compare', self.path('a.vtu'), self.path('b.vtu'), '-o', self.path('x.html'), '--size', '300')
        self.assertEqual(outcome.code, USAGE)
        self.assertIn('add -o OUT.svg', outcome.err)

    def test_results_of_different_surfaces_are_refused(self):
        self.make('a.vtu')
        self.make('b.vtu', mesh=self.write('other.obj', obj_text(*grid(6))))
        self.make('c.vtu', mesh=self.write('small.obj', obj_text(*grid(3))))
        for other, word in (('b.vtu', 'triangle 0 of the first'), ('c.vtu', '72 and 18 triangles')):
            outcome = majorant('compare', self.path('a.vtu'), self.path(other), '-o', self.path('ab.html'))
            self.assertEqual(outcome.code, UNSUPPORTED)
            self.assertEqual(len(outcome.err.splitlines()), 1, outcome.err)
            self.assertIn('different surfaces', outcome.err)
            self.assertIn(word, outcome.err)
            self.assertFalse(os.path.exists(self.path('ab.html')))

    def test_options_of_problems_are_refused(self):
        self.make('a.vtu')
        for flags in (('--methods', 'newton'), ('--degree', '2')):
            outcome = majorant('compare', self.path('a.vtu'), self.path('a.vtu'), '-o',
                               self.path('ab.html'), *flags)
            self.assertEqual(outcome.code, USAGE)
            self.assertIn(flags[0], outcome.err)
        outcome = majorant('compare', self.path('a.vtu'), self.path('a.vtu'), '-o', self.path('a.csv'))
        self.assertEqual(outcome.code, USAGE)


if __name__ == '__main__':
    main()
