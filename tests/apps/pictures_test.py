#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""-o map.svg and -o map.png: one scale, the flags of pictures, refusals in one line."""
import json
import re
import unittest

from command_helpers import UNREADABLE, USAGE, CommandTest, generated, grid, majorant, obj_text, read_png


class Pictures(CommandTest):

    def map(self, name, *more):
        self.run_ok('parametrize', generated(name), '--quiet', '-o', self.path('a.vtu'), *more)
        return self.path('a.vtu')

    def picture(self, result, *more, name='a.png'):
        self.run_ok('convert', result, '-o', self.path(name), '--force', *more)
        return self.read(name)

    def test_the_largest_value_is_one_number(self):
        """The report, captions, and pages of the run and of check agree; it is neither a mean of a triangle nor a
        value of a pixel."""
        for verb, mesh, flags in (('parametrize', 'creature', ['--degree', 3]), ('seamless', 'buckle', ['--degree', 2]),
                                  ('unwrap', 'buckle', [])):
            report, page, drawing, result = map(self.path, ('r.json', 'a.html', 'a.svg', 'a.vtu'))
            self.run_ok(verb, generated(mesh), '--quiet', '--force', '-o', result, '-o', page, '-o', drawing,
                        '--report', report, *flags)
            with open(report) as f:
                value = json.load(f)['result']['max_density']
            with open(drawing) as f:
                printed = re.search(r'largest ([\d.e+]+)', f.read())[1]
            self.assertEqual(printed, '%.4g' % value)
            cuts = ['--cuts', 'free'] if verb == 'unwrap' else []
            self.run_ok('check', result, '-o', self.path('b.html'), '--quiet', '--force', *cuts)
            for name in ('a.html', 'b.html'):
                found = re.search(r'"max_density":([\d.e+]+)', self.read(name).decode())[1]
                self.assertAlmostEqual(float(found) / value, 1, delta=1e-9)

    def test_faces_without_area_are_not_turned_over(self):
        """They have no orientation; the numbers of other faces do not depend on them."""
        points = [(0, 0, 0), (1, 0, 0), (2, 0, 0), (0, 1, 0), (2, 1, 0)]
        mesh = self.write('flake.obj', obj_text(points, [(0, 2, 4), (0, 4, 3), (0, 1, 2)]))
        self.run_ok('unwrap', mesh, '-o', self.path('a.obj'), '-o', self.path('a.svg'), '-o', self.path('a.png'))
        outcome = self.run_ok('convert', self.path('a.obj'), '-o', self.path('b.svg'), '-o', self.path('b.png'))
        self.assertIn('a.obj: 1 face has no area\n', outcome.err)
        self.assertNotIn('turned over', outcome.err)
        magenta = (214, 0, 190)
        for name in ('a', 'b'):
            drawing = self.read(name + '.svg').decode()
            self.assertIn('1 face has no area', drawing)
            self.assertNotIn('turned over', drawing)
            width, height, rows = read_png(self.read(name + '.png'))
            self.assertFalse(any(tuple(row[3 * x:3 * x + 3]) == magenta for row in rows for x in range(width)))
        texture = [(x, y) for x, y, _ in points]
        texture[1] = (1, 0.5)  # the face without area is negative in the plane
        below = self.write('c.obj', obj_text(points, [(0, 2, 4), (0, 4, 3), (0, 2, 1), (0, 1, 2)], texture))
        printed = self.run_ok('convert', below, '-o', self.path('c.svg')).err
        self.assertIn('1 triangle turned over', printed)
        self.assertIn('2 faces have no area', printed)

    def test_two_maps_have_one_scale(self):
        legends = []
        for degree in (1, 2):
            text = self.picture(self.map('creature', '--degree', degree), name='a.svg').decode()
            self.assertIn('symmetric-dirichlet density, degree %d<' % degree, text)
            self.assertIn('<rect width="1000"', text)
            legends.append(re.findall(r'<path fill="(#[0-9a-f]{6})" d=', text)[:72] +
                           re.findall(r'>([0-9.]+)</text>', text))
        self.assertGreater(len(legends[0]), 60)
        self.assertEqual(*legends)
        text = self.picture(self.path('a.vtu'), '--color-range', '4,10', name='a.svg').decode()
        self.assertIn('>10</text>', text)

    def test_png_of_layout_and_surface(self):
        result = self.map('creature', '--degree', 3)
        for more in ([], ['--view', '1,0.5,2'], ['--view=-1,0,0', '--color-by', 'area'],
                     ['--color-by', 'sigma-min', '--color-range', '0.5,2']):
            data = self.picture(result, '--size', '120,90', '--threads', 1, *more)
            self.assertEqual(data, self.picture(result, '--size', '120,90', '--threads', 2, *more))
            width, height, rows = read_png(data)
            self.assertEqual((width, height), (120, 90))
            inside = sum(row[3 * x:3 * x + 3] != b'\xff\xff\xff'
                         for row in rows for x in range(width))
            self.assertGreater(inside, 500, more)
        picture = self.picture(result, '--size', '64,64', name='i.png')
        self.assertNotEqual(self.picture(result, '--view', '1,0.5,2', '--size', '64,64', '--image',
                                         self.path('i.png')),
                            self.picture(result, '--view', '1,0.5,2', '--size', '64,64'))
        self.assertEqual(picture, self.read('i.png'))

    def test_inverted_triangles_are_reported(self):
        """Also for files by other programs, whose colours belong to no energy."""
        points, faces = grid(4)
        uv = [(x + 0.6 * (k == 6), y) for k, (x, y, _) in enumerate(points)]
        own = self.write('own.obj', obj_text(points, faces, uv))
        outcome = self.run_ok('convert', own, '-o', self.path('a.svg'), '-o', self.path('a.png'))
        self.assertIn(own + ': 2 triangles turned over, magenta in pictures\n', outcome.err)
        self.assertIn('>2 triangles turned over</text>', self.read('a.svg').decode())
        for flags in ((), ('--view', '0,0,1'), ('--color-by', 'area')):
            _, _, rows = read_png(self.picture(own, '--size', '200,200', *flags))
            self.assertIn(bytes((214, 0, 190)), {row[3 * x:3 * x + 3] for row in rows for x in range(200)}, flags)
        self.assertIn('>2 triangles turned over, not counted in the numbers above</text>',
                      self.picture(own, '--color-by', 'area', name='a.svg').decode())

    def test_quantities_of_triangles(self):
        result = self.map('creature', '--degree', 2)
        drawn = {name: self.picture(result, '--color-by', name, name='a.svg').decode()
                 for name in ('density', 'area', 'angle', 'sigma-max', 'sigma-min')}
        self.assertEqual(len(set(drawn.values())), len(drawn))
        self.assertEqual(drawn['density'].encode(), self.picture(result, name='a.svg'))
        for name in ('area', 'sigma-max'):
            self.assertRegex(drawn[name], r'>%s[^<]*, degree 2<' % name.split('-')[0])
        bare = self.path('bare.obj')  # claims no energy: other quantities than the density are measured
        self.run_ok('convert', result, '-o', bare)
        self.picture(bare, '--color-by', 'angle', name='a.svg')
        outcome = majorant('convert', bare, '-o', self.path('a.svg'), '--force', '--color-by',
                           'density')
        self.assertEqual(outcome.code, USAGE)
        self.assertIn('no density', outcome.err)

    def test_a_view_that_is_chosen(self):
        """The default is the page's first view, which shows the front of a disk."""
        result = self.map('cap', '--degree', 1)
        self.run_ok('convert', result, '-o', self.path('a.html'))
        text = self.read('a.html').decode()
        eye = json.loads(re.search(r'id="data">(.*?)</script>', text, re.S).group(1))['eye']
        chosen = self.picture(result, '--view', '--size', '80,60')
        self.assertEqual(chosen, self.picture(result, '--size', '80,60', '--view', 'auto'))
        self.assertEqual(chosen, self.picture(result, '--size', '80,60',
                                              '--view=' + ','.join(map(repr, eye))))
        self.assertNotEqual(chosen, self.picture(result, '--size', '80,60', '--view=0.1,-1,0.2'))

    def test_align(self):
        result = self.map('creature', '--degree', 1)
        drawn = {answer: self.picture(result, *answer.split(), name='a.svg')
                 for answer in ('', '--align yes', '--align no', '--align')}
        self.assertEqual(drawn[''], drawn['--align yes'])
        self.assertEqual(drawn['--align'], drawn['--align yes'])
        self.assertNotEqual(drawn[''], drawn['--align no'])
        self.assertNotEqual(self.picture(result, '--grid', 'auto', name='a.svg'),
                            self.picture(result, '--grid', 'auto', '--align', 'no', name='a.svg'))

    def test_refusals(self):
        result = self.map('creature', '--degree', 1)
        out = ('-o', self.path('a.png'))
        self.write('no.png', 'no picture')
        for code, flags, says in (
                (USAGE, ('--size', '10,20'), '16 to 8192'), (USAGE, ('--size', '10'), '--size'),
                (USAGE, ('--size', '100.5,100'), '--size'),
                (USAGE, ('--view', '0,0,0'), 'direction'), (USAGE, ('--view', '1,2'), 'direction'),
                (USAGE, ('--view', '1,2,nan'), 'direction'),
                (USAGE, ('--color-range', '4'), 'two numbers'),
                (USAGE, ('--color-range', '10,4'), 'two numbers'),
                (USAGE, ('--color-range', '3,10'), '4 at isometry'),
                (USAGE, ('--color-by', 'areas'), 'area'),
                (USAGE, ('--align', 'maybe'), 'no'),
                (USAGE, ('--image', self.path('missing.png')), 'missing.png'),
                (UNREADABLE, ('--image', self.path('no.png')), 'give a PNG image')):
            outcome = majorant('convert', result, *out, *flags)
            self.assertEqual(outcome.code, code, (flags, outcome.err))
            self.assertIn(says, outcome.err, flags)
            self.assertEqual(outcome.err.count('\n'), 1, outcome.err)
        self.assertEqual(self.files(), ['a.vtu', 'no.png'])

    def test_images_are_looked_at_before_the_work_and_not_replaced(self):
        self.write('no.png', 'no picture')
        result = self.map('creature', '--degree', 1)
        image = self.path('a.png')
        self.run_ok('convert', result, '-o', image)
        drawn = self.read('a.png')
        for verb in ('parametrize', 'unwrap'):
            self.refused(UNREADABLE, verb, generated('cap'), '-o', self.path('b.png'), '--image',
                         self.path('no.png'), says='give a PNG image')
            self.refused(USAGE, verb, generated('cap'), '-o', image, '--image', image, says='--force')
        self.refused(USAGE, 'convert', result, '-o', image, '--image', image, says='--force')
        self.assertEqual(self.read('a.png'), drawn)


if __name__ == '__main__':
    unittest.main()
