# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests gestures on the page of a map: brush, film, dropped images, fingers, selection, pictures."""
import base64
import json
import math
import os
import re
import sys
from fractions import Fraction

import numpy as np
from PIL import Image

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..', 'apps'))
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import browser
from command_helpers import CommandTest, bumpy, grid, main, obj_text

SIZE = 240  # width and height of passes that are read back
VIEWS = ('surface', 'layout')


def position(scale, value):
    """Returns the position of a value on a scale, as defined in docs/web_page.md."""
    def stretched(x):
        return np.log(np.maximum(x / scale['neutral'] if scale['diverging']
                                 else 1 + (x - scale['neutral']) / scale['unit'], 1e-300))
    t, low, high = stretched(value), stretched(scale['low']), stretched(scale['high'])
    if scale['diverging']:
        t = np.where(t < 0, 0.5 - 0.5 * t / low, 0.5 + 0.5 * t / high)
    else:
        t = (t - low) / (high - low)
    return np.clip(t, 0, 1)


def pixels(passed):
    return np.frombuffer(base64.b64decode(passed), np.uint8).reshape(SIZE, SIZE, 4).astype(float)


def pair(image):
    """Returns the two numbers of 16 bits in each pixel."""
    return (256 * image[..., 0::2] + image[..., 1::2]) / 65535


class Gestures(CommandTest):
    def play(self, what, **options):
        found = browser.run('gestures.mjs', what, self.path('a.html'), options)
        self.assertEqual([found['surprises'], found['requests']], [[], []])
        return found['result']

    def make(self, *args, steep=1):
        mesh = self.write('bumpy.obj', obj_text(*grid(6, lambda x, y: steep * bumpy(x, y))))
        self.run_ok('parametrize', '--quiet', mesh, '-o', self.path('a.html'), *args)
        text = self.read('a.html').decode()
        self.data = json.loads(re.search(r'id="data">(.*?)</script>', text, re.S).group(1))
        self.scales = {scale['name']: scale for scale in self.data['scales']}

    def colors(self, name):
        raw = base64.b64decode(self.scales[name]['colors'])
        return np.frombuffer(raw, np.uint8).reshape(256, 3).astype(int)

    # ---------------------------------------------------------------- the scale and its brush
    def test_brush_selects(self):
        self.make('--degree', 3, steep=6)
        found = self.play('brush')
        self.assertIsNone(found['before'].get('brush'))
        self.assertFalse(any(b['outside'] for b in found['before']['bins']))
        brushed, width = found['brushed'], found['brushed']['width']
        required = [(part * width - 14) / (width - 28) for part in (0.3, 0.5)]
        self.assertLess(np.abs(np.array(brushed['brush']) - required).max(), 0.01)
        low, high = brushed['brush']
        for part in brushed['bins']:
            middle = (part['x'] - 14) / (width - 28) + 0.5 / 96
            self.assertEqual(part['outside'], not low <= middle <= high, part)
        heights = {inside: sum(b['height'] for b in brushed['bins'] if b['outside'] != inside)
                   for inside in (True, False)}
        share = heights[True] / sum(heights.values())
        printed = float(re.search(r'([\d.]+) % of the surface between', brushed['note']).group(1))
        self.assertAlmostEqual(printed / 100, share, delta=0.05)
        self.assertGreater(share, 0.05)
        self.assertLess(share, 0.95)
        colors = self.colors('area')
        for view, passes in found['views'].items():
            color, quantity = pixels(passes['heat']), pixels(passes['quantityPass'])
            at = pair(quantity)[..., 0]
            drawn = (color[..., 3] == 255) & (pair(quantity)[..., 1] == 1)
            clear = drawn & (np.abs(at - low) > 1e-3) & (np.abs(at - high) > 1e-3)
            outside = (at < low) | (at > high)
            for part in (outside, ~outside):
                self.assertGreater(np.count_nonzero(clear & part), 500, view)
            hue = color[..., :3] / np.maximum(color[..., :3].max(axis=2, keepdims=True), 1)
            self.assertLess(np.ptp(hue[clear & outside], axis=1).max(), 0.01, view)
            expected = colors[np.round(255 * at).astype(int)]
            expected = expected / expected.max(axis=2, keepdims=True)
            self.assertLess(np.abs(hue - expected)[clear & ~outside].max(), 0.03, view)
            self.assertGreater(np.ptp(expected[clear & ~outside], axis=1).max(), 0.1, view)
        self.assertAlmostEqual(found['wider']['brush'][1], high + 1 / 64, 6)
        self.assertIsNone(found['after']['brush'])
        self.assertEqual(found['after']['bins'], found['before']['bins'])

    def test_quantities(self):
        """Compares fragments of both views with numpy's values of the control points, and their positions in
        the layout."""
        degree = 3
        self.make('--degree', degree, steep=6)
        found = self.play('quantities', place={'face': 30, 'xi': [0.3, 0.3, 0.4]}, zoom=30)
        array = lambda key, kind: np.frombuffer(base64.b64decode(self.data[key]), kind)
        uv, cells = array('uv', '<f8').reshape(-1, 2), array('cells', '<u4').reshape(-1, 10)
        points = array('positions', '<f8').reshape(-1, 3)
        indices = [(i, j, degree - i - j) for i in range(degree, -1, -1)
                   for j in range(degree - i, -1, -1)]

        def image(face, xi):
            weights = [math.factorial(degree) / math.prod(map(math.factorial, m)) *
                       math.prod(x ** e for x, e in zip(xi, m)) for m in indices]
            return np.array(weights) @ uv[cells[face]]

        def singular_values(face, xi, h=1e-5):
            along = [np.array(d) * h for d in ((1, 0, -1), (0, 1, -1))]
            d = np.column_stack([(image(face, xi + e) - image(face, xi - e)) / (2 * h)
                                 for e in along])
            p = points[cells[face][[0, 6, 9]]]
            edges = np.column_stack([p[0] - p[2], p[1] - p[2]])
            frame = np.linalg.qr(edges)[1]
            return np.linalg.svd(d @ np.linalg.inv(frame))[1]

        quantities = {'density': lambda S, s: S * S + s * s + S ** -2 + s ** -2,
                      'area': lambda S, s: S * s, 'angle': lambda S, s: S / s,
                      'sigma_max': lambda S, s: S, 'sigma_min': lambda S, s: s}
        self.assertEqual({name.replace('-', '_') for name in self.scales}, set(quantities))
        center, size = np.array(found['frame']['center']), found['frame']['size']
        for view in (*VIEWS, 'near'):
            passes = found[view]
            face = pixels(passes['facePass'])
            face = (65536 * face[..., 0] + 256 * face[..., 1] + face[..., 2] - 1).astype(int)
            xi, place = pair(pixels(passes['baryPass'])), pair(pixels(passes['uvPass']))
            rows, columns = np.nonzero(face >= 0)
            self.assertGreater(len(rows), 5000, view)
            shown = {name: pair(pixels(passes[name]))[..., 0] for name in self.scales
                     if name in passes}
            random = np.random.default_rng(2).choice(len(rows), 200, replace=False)
            pixel = found['frame']['extent'] * size / SIZE
            if view == 'near':
                pixel /= found['frame']['zoom']
                self.assertGreater(found['frame']['zoom'], 20)
            for y, x in zip(rows[random], columns[random]):
                at = np.array([*xi[y, x], 1 - xi[y, x].sum()])
                off = np.abs((place[y, x] - 0.5) * size + center - image(face[y, x], at)).max()
                self.assertLess(off, max(0.5 * pixel, 1e-4 * size), view)
                S, s = singular_values(face[y, x], at)
                for name in shown:
                    expected = position(self.scales[name], quantities[name.replace('-', '_')](S, s))
                    self.assertLess(abs(shown[name][y, x] - expected), 5e-4, (view, name, S, s))

    def test_legend(self):
        self.make('--degree', 2)
        drawn = self.play('brush')['before']
        scale = self.scales['area']
        colors = self.colors('area')
        inner = drawn['width'] - 28
        self.assertEqual(len(drawn['ticks']), len(scale['ticks']))
        for x, tick in zip(drawn['ticks'], scale['ticks']):
            self.assertAlmostEqual((x - 14) / inner, float(position(scale, tick['value'])), 6)
        for label in drawn['labels']:
            at = float(position(scale, float(Fraction(label['text']))))
            self.assertAlmostEqual((label['x'] - 14) / inner, at, 2)
        self.assertIn('1', [label['text'] for label in drawn['labels']])
        self.assertEqual(len(drawn['colors']), 128)
        for rect in drawn['colors']:
            middle = (rect['x'] - 14) / inner + 0.5 / 128
            rgb = [int(x) for x in re.findall(r'\d+', rect['fill'])]
            self.assertLessEqual(np.abs(colors[round(255 * middle)] - rgb).max(), 3)

    # ---------------------------------------------------------------- the run as a film
    def test_film(self):
        self.make('--degree', 3, '--snapshots', 2)
        frames = self.data['snapshots']
        self.assertGreater(len(frames), 3)
        cells = np.frombuffer(base64.b64decode(self.data['cells']), '<u4').reshape(-1, 10)
        places = [{'face': face, 'xi': xi} for face in (3, 50)
                  for xi in ([1, 0, 0], [0, 1, 0], [0, 0, 1])]
        found = self.play('film', places=places, reducedMotion='no-preference')
        for name, frame in (('start', 0), ('second', 1), ('again', len(frames) - 1),
                            ('end', len(frames) - 1), ('played', len(frames) - 1)):
            shown = found[name]
            self.assertEqual(shown['frame'], frame if frame < len(frames) - 1 else None, name)
            self.assertEqual(shown['slider'], str(frame))
            self.assertIn('iteration %d,' % frames[frame]['iteration'], shown['caption'])
            uv = np.frombuffer(base64.b64decode(frames[frame]['uv']), '<f4').reshape(-1, 2)
            for place, values in zip(places, shown['measured']):
                corner = cells[place['face']][[0, 6, 9][place['xi'].index(1)]]
                self.assertLess(np.abs(uv[corner] - [values['u'], values['v']]).max(), 1e-6)
        for name in ('uv', 'layout'):
            self.assertEqual(found['again'][name], found['end'][name])
            self.assertEqual(found['played'][name], found['end'][name])
            changed = pixels(found['start'][name]) != pixels(found['end'][name])
            self.assertGreater(np.count_nonzero(changed), 1000, name)
        self.assertEqual(found['played']['label'], 'play')

    def test_reduced_motion_stops_the_film(self):
        self.make('--degree', 1, '--snapshots', 1)
        found = self.play('film', places=[], reducedMotion='reduce')
        self.assertFalse(found['end']['playShown'])
        self.assertEqual(found['start']['frame'], 0)

    # ---------------------------------------------------------------- images
    def test_dropped_image(self):
        """An image of four quarters in four colours is upright, in the position that docs/web_page.md
        defines."""
        colors = np.array([[[255, 0, 0], [0, 255, 0]], [[0, 0, 255], [255, 255, 0]]], np.uint8)
        Image.fromarray(np.kron(colors, np.ones((32, 32, 1), np.uint8))).save(self.path('i.png'))
        for normalized in (False, True):
            self.make('--degree', 3, *(['--normalize'] if normalized else []))
            found = self.play('drop', image=self.path('i.png'))
            self.assertEqual(found['refused']['texture'], 'checker')
            self.assertIn('no.png', found['refused']['notice'])
            self.assertEqual([found['taken'][k] for k in ('show', 'texture', 'noticeShown')],
                             ['texture', 'image', False])
            center, size = np.array(found['uvFrame']['center']), found['uvFrame']['size']
            for view, passes in found['views'].items():
                color, uv = pixels(passes['image']), pair(pixels(passes['uvPass']))
                drawn = color[..., 3] == 255
                at = uv if not normalized else (uv - 0.5) * size + center
                # The first row of an image is the upper one, with large v.
                part = at % 1
                expected = colors[(part[..., 1] < 0.5).astype(int),
                                  (part[..., 0] > 0.5).astype(int)]
                clear = drawn & (np.abs(part * 2 - np.round(part * 2)).min(axis=2) > 0.1)
                seen = color[..., :3] / np.maximum(color[..., :3].max(axis=2, keepdims=True), 1)
                self.assertGreater(np.count_nonzero(clear), 5000)
                wrong = np.abs(seen - expected / 255).max(axis=2)[clear] > 0.1
                self.assertEqual(np.count_nonzero(wrong), 0, (view, normalized))

    # ---------------------------------------------------------------- fingers, selection, links
    def test_touch(self):
        self.make('--degree', 2)
        found = self.play('touch', touch=True, face=37, width=900, height=700)
        for view, other in (VIEWS, VIEWS[::-1]):
            steps = found[view]
            before, dragged, turned, pinched = (
                steps[k][view] for k in ('before', 'dragged', 'turned', 'pinched'))
            self.assertEqual(before, dragged)  # one finger scrolls the page
            self.assertTrue(steps['hinted'])
            if view == 'surface':
                self.assertGreater(np.abs(np.array(before[:3]) - turned[:3]).max(), 0.1)
                self.assertLess(turned[0], before[0])  # the dragged view follows the fingers
            else:
                self.assertLess(turned[0], before[0])
                self.assertGreater(turned[1], before[1])
            self.assertAlmostEqual(before[-1], turned[-1], delta=0.05 * before[-1])
            self.assertGreater(pinched[-1], 1.5 * before[-1])
            self.assertEqual(steps['before'][other], steps['turned'][other])
            self.assertEqual(steps['tapped']['pinned']['face'], 37)
            self.assertIsNone(steps['turned']['pinned'])
        self.assertGreater(found['scroll'], 100)

    def test_selection(self):
        self.make('--degree', 3)
        found = self.play('choose', face=20, hash='face=12&show=area&brush=0.2,0.8')
        self.assertEqual(found['opened']['pinned']['face'], 12)
        self.assertEqual(found['opened']['show'], 'area')
        self.assertEqual(found['opened']['brush'], [0.2, 0.8])
        for view in VIEWS:
            steps = found[view]
            self.assertEqual(steps['clicked']['pinned']['face'], 20)
            self.assertIn('Selected', steps['clicked']['readout'])
            read = re.search(r'x y z\s+(\S+) +(\S+) +(\S+)', steps['clicked']['readout'])
            points, faces = grid(6, bumpy)
            place = np.array([points[v] for v in faces[20]]).T @ steps['clicked']['pinned']['xi']
            np.testing.assert_allclose([float(x) for x in read.groups()], place, atol=1e-5)
            self.assertIsNone(steps['released']['pinned'])
            self.assertEqual(steps['hovered']['hovered']['face'], 20)
            self.assertIsNone(steps['left']['hovered'])
            face = pixels(steps['marked']['facePass'])
            number = 65536 * face[..., 0] + 256 * face[..., 1] + face[..., 2] - 1
            plain = pixels(steps['plain'])
            for name, color in (('selected', steps['marked']['checker']),
                                ('pointed at', steps['pointed'])):
                changed = np.abs(pixels(color) - plain).max(axis=2) > 4
                self.assertGreater(np.mean(changed[number == 20]), 0.9, (view, name))
                self.assertEqual(np.count_nonzero(changed[number != 20]), 0, (view, name))

    def test_saved_picture(self):
        self.make('--degree', 2)
        found = self.play('save', out=self.path('saved.png'))
        self.assertEqual(found['name'], 'bumpy.png')
        image = np.asarray(Image.open(self.path('saved.png')).convert('RGB')).astype(int)
        self.assertEqual(image.shape[1], round(found['canvas']['width']))
        self.assertGreater(image.shape[0], found['canvas']['height'] + 100)  # title and legend
        legend = image[-50:-20].reshape(-1, 3)
        for color in self.colors('density')[::32]:
            self.assertLess(np.abs(legend - color).max(axis=1).min(), 4)
        middle = image[44:44 + int(found['canvas']['height'])]
        self.assertGreater(np.mean(middle.min(axis=2) < 250), 0.3)  # the views


if __name__ == '__main__':
    browser.require_npm()
    browser.require_chromium()
    main()
