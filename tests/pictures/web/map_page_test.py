# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests the page of a map in Chromium: no errors, no network, numbers as in the files, control by keys."""
import json
import os
import re
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..', 'apps'))
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import browser
from command_helpers import (INVALID, CommandTest, Vtu, generated, grid, main, obj_text, ramp, torus)
from uv_pass_test import evaluate

HOSTILE = '<b id=x>&"\'</script><script>document.title=1</script>'


class MapPage(CommandTest):
    def play(self, what, page, **options):
        """Returns the findings of the scene; errors and requests fail the test."""
        found = browser.run('behaviour.mjs', what, self.path(page), options)
        self.assertEqual([found['surprises'], found['requests']], [[], []])
        return found['result']

    def make(self, *args, mesh=None, code=0):
        mesh = mesh or self.write('bumpy.obj', obj_text(*grid(8)))
        self.run_ok('parametrize', '--quiet', mesh, '-o', self.path('a.html'), '-o',
                    self.path('a.vtu'), '--report', self.path('a.json'), *args, code=code)

    def test_hostile_title(self):
        mesh = self.write(HOSTILE.replace('/', '\\') + '.obj', obj_text(*grid(2)))
        self.make('--degree', 2, mesh=mesh)
        found = self.play('facts', 'a.html')
        self.assertEqual(found['title'], os.path.basename(mesh))
        self.assertEqual(found['heading'], os.path.basename(mesh))
        self.assertEqual(found['elements'], 2)

    def test_invalid_maps_name_their_defects(self):
        self.make('--degree', 2)
        vtu = Vtu(self.path('a.vtu'))
        vtu.arrays['uv'][vtu.components['uv'] * 20] += 10
        vtu.write(self.path('bad.vtu'))
        self.run_ok('check', self.path('bad.vtu'), '-o', self.path('bad.html'), code=INVALID)
        text = self.play('facts', 'bad.html')['text']
        self.assertIn('turned over', text)
        self.assertIn('invalid', text)
        faults = self.play('faults', 'bad.html')
        self.assertGreater(len(faults), 1)
        for fault in faults:  # faults are not covered by other faces
            self.assertIn(fault['seen'], [f['face'] for f in faults])

    def test_elements_are_not_faces(self):
        """The page of a volume mesh has elements instead of faces, with the numbers of the input."""
        vertices = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1)]
        mesh = self.write('a.mesh', '\n'.join([
            'MeshVersionFormatted 2', 'Dimension 3', 'Vertices 5',
            *('%d %d %d 0' % point for point in vertices),
            'Tetrahedra 2', '1 2 3 4 7', '3 2 4 5 8', 'End', '']))
        self.run_ok('mesh', 'check', mesh, '-o', self.path('bad.html'), code=INVALID)
        text = self.play('facts', 'bad.html')['text']
        for words in ('2 elements · invalid · 1 element fails', 'element 2 (tetrahedra, region 8)',
                      'element 1 ', 'Point at an element'):
            self.assertIn(words, ' '.join(text.split()))
        self.assertNotIn('straight', text)  # all elements are straight
        self.assertNotIn(' face', text.split('all of the report')[0])
        found = self.play('faults', 'bad.html')
        self.assertEqual(len(found), 1)

    def test_large_maps_have_coarser_pages(self):
        """The run and the page report a coarser page and its number of faces; numbers are those of the map."""
        mesh = self.write('bumpy.obj', obj_text(*grid(40)))
        os.environ['MAJORANT_PAGE_BYTES'] = '70000'
        self.addCleanup(os.environ.pop, 'MAJORANT_PAGE_BYTES', None)
        run = self.run_ok('parametrize', mesh, '--degree', 1, '-o', self.path('a.html'),
                          '--report', self.path('a.json'))
        faces = 2 * 40 * 40
        shown = re.search(r'a.html: shows ([\d,]+) of 3,200 faces', run.err)
        self.assertTrue(shown, run.err)
        self.assertLess(int(shown.group(1).replace(',', '')), faces // 2)
        text = ' '.join(self.play('facts', 'a.html')['text'].split())
        self.assertIn('linear, %s of 3,200 faces shown' % shown.group(1), text)
        self.assertIn('This page shows %s of 3,200 faces' % shown.group(1), text)
        value = json.loads(self.read('a.json'))['result']['value']
        self.assertIn('%.5g' % value, text)
        self.assertNotIn('straight', text.split('all of the')[0].split('This page')[1])
        self.run_ok('parametrize', mesh, '-o', self.path('c.html'), '--degree', 3)
        text = ' '.join(self.play('facts', 'c.html')['text'].split())
        self.assertIn('The map has degree 3; its edges are drawn straight.', text)
        del os.environ['MAJORANT_PAGE_BYTES']
        run = self.run_ok('parametrize', mesh, '--degree', 1, '-o', self.path('b.html'))
        self.assertNotIn('shows', run.err)
        self.assertNotIn('shown', self.play('facts', 'b.html')['text'].split('all of the')[0])

    def test_draw_calls(self):
        points = {'handles': [{'vertex': 0, 'target': 'initial'}]}
        closed = self.write('torus.obj', obj_text(*torus(10, 6, 0)))
        self.run_ok('seamless', closed, '-o', self.path('s.html'), '--degree', 3)
        self.make('--bijective', '--degree', 3, '--snapshots', 3,
                  '--handles', self.write('h.json', json.dumps(points)))
        for page in ('a.html', 's.html'):
            calls = self.play('draw', page)
            self.assertGreater(len(calls), 3)
            self.assertLessEqual(max(calls), 10, calls)
            halved = self.play('draw', page, hash='straight=0.5')
            self.assertLessEqual(max(halved), 10, halved)
            self.assertGreater(min(halved), min(calls))
            self.assertGreater(min(calls), 1, calls)

    def test_hover_equals_the_files(self):
        self.make('--degree', 3)
        vtu, report = Vtu(self.path('a.vtu')), json.loads(self.read('a.json'))
        uv, cells = np.array(vtu.rows('uv')), vtu.cells()
        faces = [3, 40, 77, 120]
        for found in self.play('hover', 'a.html', faces=faces):
            self.assertEqual(found['place']['face'], found['face'], found)
            values, xi = found['values'], found['place']['xi']
            self.assertLess(np.abs(np.array(xi) - [0.2, 0.3, 0.5]).max(), 0.05)
            expected = evaluate(3, uv[cells[found['face']]][:, :2], xi)
            self.assertLess(np.abs(expected - [values['u'], values['v']]).max(), 1e-12)
            S, s = values['sigma-max'], values['sigma-min']
            self.assertLessEqual(S, report['result']['sigma_max'] * 1.01)
            self.assertGreaterEqual(s, report['result']['sigma_min'] * 0.99)
            self.assertAlmostEqual(values['density'], S * S + s * s + 1 / (S * S) + 1 / (s * s), 9)
            digits = '%.3f' % values['u']
            self.assertIn(digits[:-1], found['text'])

    def test_keys_alone(self):
        self.make('--degree', 2, '--snapshots', 4)
        found = self.play('keys', 'a.html')
        stations = found['stations']
        names = {s['id'] for s in stations} | {s['text'] for s in stations}
        for name in ('surface', 'layout', 'home', 'save', 'wipe'):
            self.assertIn(name, names)
        for station in stations:
            self.assertTrue(station['visible'], station)
            self.assertTrue(station['outline'], station)
            self.assertTrue(station['text'] or station['name'] or station['tag'] == 'INPUT', station)
        self.assertNotEqual(found['before']['surface'], found['turned']['surface'])
        self.assertIsNone(found['turned']['pinned'])
        self.assertIn('face', found['chosen']['message'])
        self.assertNotEqual(found['neighbour']['pinned']['face'], found['chosen']['pinned']['face'])
        self.assertIsNone(found['free']['pinned'])
        self.assertNotEqual(found['free']['layout'], found['moved']['layout'])

    def test_the_film_is_not_the_result(self):
        self.make('--degree', 2, '--snapshots', 4, '--init', 'tutte', mesh=generated('creature'))
        found = self.play('film', 'a.html')
        value = '%.5g' % json.loads(self.read('a.json'))['result']['value']
        self.assertIn(value, found['atEnd']['summary'])
        self.assertEqual((found['atEnd']['heading'], found['atEnd']['isPast']), ('Measured', False))
        self.assertIn('iteration 0', found['inFilm']['summary'])
        self.assertNotIn(value, found['inFilm']['summary'])
        self.assertEqual((found['inFilm']['heading'], found['inFilm']['isPast']),
                         ('Measured, iteration 0', True))
        start = json.loads(self.read('a.json'))['result']['initial_value']
        self.assertAlmostEqual(float(found['inFilm']['numbers']['energy']), start, delta=1e-3 * start)
        self.assertNotEqual(found['inFilm']['numbers']['largest density'],
                            found['atEnd']['numbers']['largest density'])
        self.assertEqual((found['inFilm']['ending'], found['atEnd']['ending']), (False, True))
        for moment in ('inFilm', 'atEnd'):  # Tutte's circle is larger than the result
            self.assertLess(found[moment]['reach'], 1)
        self.assertEqual(found['after'], found['atEnd'])

    def test_a_saved_picture_says_which_side_is_which(self):
        self.make('--degree', 3)
        found = self.play('wipe', 'a.html', wipe=0.5)
        self.assertEqual(found['labels'], ['straight', 'cubic'])
        whole = self.play('wipe', 'a.html', wipe=0)
        for with_line, without in zip(found['ink'], whole['ink']):
            self.assertGreater(with_line, 0.5)  # the line is dashed and 1.5 pixels wide
            self.assertLess(without, with_line)

    def test_overlaps_are_marked(self):
        mesh = self.write('ramp.obj', obj_text(*ramp(1.3)))
        self.make('--degree', 2, mesh=mesh)
        contacts = json.loads(self.read('a.json'))['result']['boundary']['contacts']
        self.run_ok('check', self.path('a.vtu'), '-o', self.path('c.html'))
        for page in ('a.html', 'c.html'):
            found = self.play('overlaps', page)
            self.assertEqual(found['contacts'], len(contacts))
            self.assertEqual(found['marks'], 2 * len(contacts))
            self.assertIn('Boundary edges meet: ', found['listed'])
            self.assertIn('(%d, %d)' % tuple(contacts[0]['edges'][0]), found['listed'])
            self.assertIn('locally injective, overlaps itself near (', found['summary'])
            self.assertIn('overlaps', found['toggles'])
            self.assertTrue(found['shown'])
            self.assertIsNotNone(found['pinned'])
        self.make('--degree', 2, '--bijective', mesh=mesh)
        self.assertIn('no overlaps', self.play('facts', 'a.html')['text'])

    def test_without_webgl(self):
        self.make('--degree', 2)
        found = self.play('facts', 'a.html', flags=['--disable-3d-apis'])
        self.assertFalse(found['hasWebGl'])
        self.assertIn('WebGL2', found['text'])
        value = json.loads(self.read('a.json'))['result']['value']
        self.assertIn('%.5g' % value, found['text'])

    def test_any_width(self):
        self.make('--degree', 2)
        for width, height in ((390, 800), (768, 1024), (1600, 900)):
            found = self.play('facts', 'a.html', width=width, height=height)
            self.assertLessEqual(found['overflow'], 0, width)

    def test_size(self):
        """The page of 10,000 cubic triangles is smaller than 3 MB."""
        mesh = self.write('large.obj', obj_text(*grid(71)))
        self.run_ok('parametrize', '--quiet', mesh, '-o', self.path('a.html'), '--degree', 3,
                    '--max-iterations', 1, code=4)
        self.assertLess(os.path.getsize(self.path('a.html')), 3e6)
        self.assertEqual(self.play('facts', 'a.html')['title'], 'large.obj')


if __name__ == '__main__':
    browser.require_npm()
    browser.require_chromium()
    main()
