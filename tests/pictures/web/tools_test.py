# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests the controls of the page of a map: links, fitted colours, marks, search, charts, pictures; axe."""
import base64
import json
import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..', 'apps'))
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import browser
from command_helpers import CommandTest, bumpy, grid, main, obj_text, ramp, torus

MEETS = np.array([0xe6, 0x00, 0x7a])


class Tools(CommandTest):
    def play(self, what, page='a.html', **options):
        found = browser.run('tools.mjs', what, self.path(page), options)
        self.assertEqual([found['surprises'], found['requests']], [[], []])
        return found['result']

    def make(self, *args, mesh=None):
        mesh = mesh or self.write('bumpy.obj', obj_text(*grid(6, lambda x, y: 2 * bumpy(x, y))))
        self.run_ok('parametrize', '--quiet', mesh, '-o', self.path('a.html'), '-o',
                    self.path('a.vtu'), *args)

    def make_atlas(self):
        mesh = self.write('torus.obj', obj_text(*torus(10, 6, 0)))
        self.run_ok('unwrap', '--quiet', mesh, '--seams', 'sharp=20', '-o', self.path('a.html'))

    def make_deformation(self):
        mesh = self.write('flat.obj', obj_text(*grid(6, lambda x, y: 0)))
        handles = {'handles': [{'vertex': 0, 'target': 'initial'}, {'vertex': 48, 'target': [1.4, 1.2]}]}
        self.run_ok('deform', '--quiet', mesh, '--handles', self.write('h.json', json.dumps(handles)),
                    '-o', self.path('a.html'))

    # ---------------------------------------------------------------- links, colours
    def test_a_link_holds_all_that_is_switched(self):
        self.make_deformation()
        found = self.play('link')
        opened, switched, followed, reset = (found[k] for k in ('opened', 'switched', 'followed', 'reset'))
        same = {'hash', 'texture', 'pinned', 'surface', 'layout'}
        changed = {name for name in opened if opened[name] != switched[name]}
        self.assertLessEqual({'edges', 'points', 'square', 'rest', 'squares', 'show', 'range', 'brush',
                              'wipe', 'pictureScale', 'isTransparent', 'texture'}, changed)
        for name in changed - same:
            if isinstance(switched[name], list):
                self.assertLess(np.abs(np.array(switched[name]) - followed[name]).max(), 1e-3, name)
            else:
                self.assertEqual(switched[name], followed[name], name)
        for name in ('surface', 'layout'):
            self.assertNotEqual(opened[name], switched[name])
            self.assertLess(np.abs(np.array(switched[name]) - followed[name]).max(), 1e-3, name)
        self.assertEqual(followed['pinned']['face'], 3)
        self.assertEqual(followed['texture'], 'grid')
        self.assertEqual(reset, opened)
        self.assertNotIn('#', found['address'])

    def test_colours_fit_the_map(self):
        self.make('--degree', 2)
        found = self.play('fit')
        before, fitted, after = (found[k] for k in ('before', 'fitted', 'after'))
        self.assertEqual((before['low'], before['high'], before['range']), (4, 40, None))
        self.assertEqual(fitted['low'], 4)
        self.assertLess(fitted['high'], 10)
        self.assertGreater(fitted['high'], 4.01)
        self.assertNotEqual(fitted['shader'], before['shader'])
        self.assertEqual(fitted['ticks'][0], '4')
        self.assertIn('%.4g' % fitted['high'], fitted['strip'])
        self.assertEqual(after, before)

    def test_the_range_of_the_command_is_that_of_the_page(self):
        self.make('--degree', 2, '--color-range', '4,4.5')
        found = self.play('fit')['before']
        self.assertEqual((found['low'], found['high']), (4, 4.5))

    # ---------------------------------------------------------------- marks in the layout
    def test_overlaps_are_hatched(self):
        mesh = self.write('ramp.obj', obj_text(*ramp(1.3)))
        self.make('--degree', 1, mesh=mesh)
        from command_helpers import Vtu
        vtu = Vtu(self.path('a.vtu'))
        uv, cells = np.array(vtu.rows('uv'))[:, :2], np.array(vtu.cells())

        def covered(at):
            count = 0
            for c in cells:
                p, q, r = uv[c[:3]]
                w = np.linalg.solve(np.column_stack([q - p, r - p]), at - p)
                count += w.min() > 0.02 and w.sum() < 0.98
            return count
        middles = [uv[c[:3]].mean(axis=0) for c in cells]
        twice = [m for m in middles if covered(m) == 2][:6]
        self.assertTrue(twice)
        # Middles far from the edges that meet, which are marked.
        once = sorted((m for m in middles if covered(m) == 1),
                      key=lambda m: -min(np.linalg.norm(m - t) for t in twice))[:6]
        places = [list(m) for m in twice + once]
        off = {name: False for name in ('edges', 'seams', 'points')}
        pixels = [np.array(p).reshape(-1, 4)[:, :3] for p in
                  self.play('colors', places=places, changes=off, width=1200, height=800)]
        stripes = [np.mean(np.abs(p - MEETS).max(axis=1) < 70) for p in pixels]
        self.assertGreater(min(stripes[:len(twice)]), 0.1)
        self.assertEqual(max(stripes[len(twice):]), 0)
        plain = self.play('colors', places=places, changes={**off, 'overlaps': False})
        for p in plain:
            self.assertEqual(np.mean(np.abs(np.array(p).reshape(-1, 4)[:, :3] - MEETS).max(axis=1) < 70), 0)

    def test_the_unit_square_is_drawn(self):
        self.make('--normalize', '--degree', 1)
        places = [[0.5, 0], [0, 0.5], [1, 0.5]]

        def ink(**changes):
            found = self.play('colors', places=places, changes={'seams': False, **changes})
            return [np.array(p).reshape(-1, 4)[:, 3].astype(int) for p in found]
        drawn, plain = ink(), ink(square=False)
        self.assertTrue(all(np.count_nonzero(a != b) > 8 for a, b in zip(drawn, plain)), 'on at first')

    def test_a_deformation_has_its_texture_at_rest(self):
        """The squares are those of the source or, on request, of the image; both views have the same."""
        self.make_deformation()
        for rest in (True, False):
            found = self.play('squares', changes={'rest': rest, 'edges': False})
            for view in ('surface', 'layout'):
                places = [place for place in found if place['clear']]
                agree = [place[view] > 128 for place in places] == [
                    place['isLight'] for place in places]
                self.assertGreater(len(places), 20)
                self.assertTrue(agree, (rest, view))

    def test_the_face_beyond_a_cut_is_shown(self):
        self.make_atlas()
        data = json.loads(self.read('a.html').decode().split('id="data">')[1].split('</script>')[0])
        cells = np.frombuffer(base64.b64decode(data['cells']), '<u4').reshape(-1, 3)
        edges = {}
        for face, c in enumerate(cells):
            for k in range(3):
                edges.setdefault(tuple(sorted((c[k], c[(k + 1) % 3]))), []).append((face, k))
        face, edge = next(sides[0] for sides in edges.values() if len(sides) == 1)
        xi = [0, 0, 0]
        xi[edge], xi[(edge + 1) % 3], xi[(edge + 2) % 3] = 0.68, 0.3, 0.02
        found = self.play('partner', place={'face': face, 'xi': xi})
        partner = found['partner']
        self.assertEqual(partner['here'], {'face': face, 'edge': edge})
        self.assertNotEqual(partner['there']['face'], face)
        self.assertLess(found['off'], 1e-6)
        self.assertIn('across the cut', found['readout'])
        self.assertEqual(len(found['lines']), 2)

    # ---------------------------------------------------------------- help, search, charts
    def test_help(self):
        self.make('--degree', 1)
        found = self.play('help')
        self.assertEqual(found['states'], [False, True, False, True])
        for word in ('arrows', 'double click', 'drop an image', 'two', 'Escape', 'Shift and arrows'):
            self.assertIn(word, found['text'])

    def test_faces_and_vertices_are_found(self):
        self.make('--degree', 2)
        searches = [['face', '17'], ['vertex', '30'], ['face', '9999'], ['vertex', '-1']]
        face, vertex, none, wrong = self.play('search', searches=searches)
        self.assertEqual(face['pinned']['face'], 17)
        self.assertLess(np.abs(face['at']).max(), 1e-6)
        self.assertEqual(sorted(vertex['pinned']['xi']), [0, 0, 1])
        self.assertEqual(none['message'], 'no face 9999 here')
        self.assertEqual(wrong['message'], 'no vertex -1 here')
        self.assertEqual(none['pinned'], vertex['pinned'])

    def test_charts_are_listed(self):
        self.make_atlas()
        found = self.play('charts')
        self.assertGreater(len(found['found']), 1)
        self.assertIn('%d charts' % len(found['found']), found['listed'])
        for entry in found['found']:
            self.assertTrue(entry['isSeen'], entry)
            self.assertIn('chart %d\n' % entry['chart'], found['listed'].replace(' ' + str(
                entry['count']), '\n'))
        self.assertEqual(len({entry['chart'] for entry in found['found']}), len(found['found']))

    # ---------------------------------------------------------------- pictures
    def test_pictures_of_any_size_without_paper(self):
        self.make('--degree', 2)
        images = {}
        for scale in (1, 2, 4):
            found = self.play('picture', changes={'pictureScale': scale, 'isTransparent': scale > 1,
                                                  'show': 'density', 'wipe': 0.5})
            raw = base64.b64decode(found['bytes'])
            images[scale] = np.frombuffer(raw, np.uint8).reshape(found['height'], found['width'], 4)
            self.assertEqual(found['pixelAfter'], 1)
        for scale in (2, 4):
            rows, columns = images[1].shape[:2]
            self.assertLessEqual(abs(images[scale].shape[0] - scale * rows), scale)
            self.assertLessEqual(abs(images[scale].shape[1] - scale * columns), scale)
            self.assertEqual(images[scale][2, 2, 3], 0)
            small = images[scale][::scale, ::scale][:rows, :columns].astype(int)
            whole = images[1][:small.shape[0], :small.shape[1]]
            both = (small[..., 3] == 255) & (whole.min(axis=2) < 230)
            self.assertGreater(np.count_nonzero(both), 2000)
            off = np.abs(small - whole).max(axis=2)[both]
            self.assertLess(np.median(off), 12)
        self.assertEqual(images[1][..., 3].min(), 255)

    # ---------------------------------------------------------------- two results
    def test_two_results_side_by_side(self):
        mesh = self.write('bumpy.obj', obj_text(*grid(6, lambda x, y: 2 * bumpy(x, y))))
        for name, flags in (('a', ('--degree', 3)), ('b', ('--degree', 1, '--energy', 'arap'))):
            self.run_ok('parametrize', '--quiet', mesh, '-o', self.path(name + '.vtu'), *flags)
        self.run_ok('compare', self.path('a.vtu'), self.path('b.vtu'), '-o', self.path('ab.html'))
        found = self.play('pair', 'ab.html', width=1000, height=900)
        self.assertEqual((found['show'], found['views']), ('density', 4))
        self.assertGreaterEqual(min(found['above']), 0)  # captions cover no part of a view
        self.assertEqual(found['heading'], 'a.vtu | b.vtu')
        for view in ('surface', 'layout'):
            self.assertLess(np.abs(np.subtract(*found['poses'][view])).max(), 1e-9)
        self.assertEqual(found['ends'][0], -found['ends'][1])
        self.assertGreater(np.ptp(found['positions']), 0.1)
        for side in found['sides']:
            off = np.abs(np.array(side) - found['positions'])
            self.assertLess(np.median(off), 0.03)  # a pixel differs from the middle of its face
        self.assertIn('A | B', found['readout'])
        self.assertIn('difference', found['readout'])
        self.assertEqual(found['marked'], [5, 5])
        axe = self.play('axe', 'ab.html', width=390, height=800, touch=True)
        self.assertEqual(axe['violations'], [])
        self.assertLessEqual(axe['overflow'], 0)

    # ---------------------------------------------------------------- anybody, anywhere
    def test_axe_finds_nothing(self):
        self.make_atlas()
        os.rename(self.path('a.html'), self.path('atlas.html'))
        self.make('--degree', 2, '--snapshots', 2)
        for page, options in (('a.html', {}), ('a.html', {'dark': True, 'changes': {'show': 'density'}}),
                              ('a.html', {'open': '#help-open'}), ('atlas.html', {'dark': True}),
                              ('atlas.html', {'width': 390, 'height': 800, 'touch': True})):
            found = self.play('axe', page, **options)
            self.assertEqual(found['violations'], [], (page, options))
            self.assertGreater(found['passes'], 15)

    def test_colours_are_in_sight_on_a_phone(self):
        self.make('--degree', 2)
        found = self.play('axe', width=390, height=800, touch=True, changes={'show': 'density'})
        top, bottom, height = found['strip']
        self.assertGreater(bottom - top, 30)
        self.assertLessEqual(bottom, height)
        self.assertLessEqual(found['overflow'], 0)


if __name__ == '__main__':
    browser.require_npm()
    browser.require_chromium()
    main()
