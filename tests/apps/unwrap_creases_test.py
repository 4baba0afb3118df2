# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Creases, numbers of charts, fill and presets of majorant unwrap."""
import random

from command_helpers import *
from hard_surfaces import model, open_box
from unwrap_helpers import *

UNSHEARED = 4 + 1e-6


def arch(n):
    """Returns half of a flat ring, much longer than wide."""
    points, faces = [], []
    for i in range(n + 1):
        a = math.pi * i / n
        points += [(r * math.cos(a), r * math.sin(a), 0) for r in (0.95, 1.0)]
    for i in range(n):
        faces.append((2 * i, 2 * i + 1, 2 * i + 3, 2 * i + 2))
    return points, faces


def windows(seed):
    """Returns two window frames side by side, and a sill on the inner edge of one, at random and randomly numbered.

    The sill is hinged at a corner of its frame. Folded flat into the hole, its side lies on half of the frame's next
    edge.
    """
    rng = random.Random(seed)

    def size(low, high):
        return round(rng.uniform(low, high), 3)
    d, top, bottom, height, width = size(.08, .15), size(.1, .2), size(.1, .2), size(.6, .8), size(.35, .45)
    depth, z, y, x = size(.05, .15), size(0, 1), size(0, 1), size(-1, 1)
    places = {'a': (x, y), 'b': (x, y + height), 'c': (x - d, y + height - top), 'd': (x - d, y + bottom),
              'e': (x - width, y + height), 'f': (x - width + d, y + height - top), 'g': (x - width, y),
              'h': (x - width + d, y + bottom), 'i': (x + width, y + height), 'j': (x + d, y + height - top),
              'k': (x + width - d, y + height - top), 'l': (x + d, y + bottom)}
    places = {name: p + (z,) for name, p in places.items()}
    for name, on in (('m', 'l'), ('n', 'j')):
        places[name] = places[on][:2] + (z - depth,)
    names = sorted(places)
    rng.shuffle(names)
    faces = [tuple(names.index(name) for name in face) for face in ('abcd', 'befc', 'eghf', 'ibjk', 'balj', 'jlmn')]
    return [tuple(round(v, 6) for v in places[name]) for name in names], faces


def seam_where(vtu, points, weight):
    """Returns the length of the seams of a file, each edge weighted by weight(midpoint)."""
    edges = [[points[v] for v in edge] for edge in Vtu(vtu).claims['cuts']]
    return sum(math.dist(a, b) * weight(tuple((x + y) / 2 for x, y in zip(a, b))) for a, b in edges)


class Creases(UnwrapTest):
    def test_panels_are_not_sheared(self):
        for kind in ('open box', 'lid', 'tray', 'shaft', 'L-block', 'gear', 'bracket'):
            for n, variant in ((1, 1), (3, 2)):
                with self.subTest(kind=kind, n=n):
                    _, report = self.unwrap(self.mesh(*model(kind, n, variant)))
                    self.assertLess(report['result']['value'], UNSHEARED)
                    self.assertEqual(report['status'], 'converged')

    def test_panels_that_touch_unfolded_are_cut(self):
        for seed in (0, 27):
            with self.subTest(seed=seed):
                _, report = self.unwrap(self.mesh(*windows(seed)))
                self.assertEqual(report['result']['charts'], 2)
                self.assertLess(report['result']['value'], UNSHEARED)
                for chart in report['charts']:
                    self.assertTrue(chart['clearance'] is None or chart['clearance'] > 1e-7, chart)

    def test_flat_rings_are_whole(self):
        """A gear with n quads per side: two faces with a hole, the bore, the rim. Planes are only cut to divide
        charts."""
        for n, variant in ((1, 1), (2, 0)):
            with self.subTest(n=n):
                points, faces = model('gear', n, variant)
                mesh = self.mesh(points, faces)
                _, report = self.unwrap(mesh, '--fill', 0)
                self.assertLessEqual(report['result']['charts'], 6)
                self.run_ok('unwrap', mesh, self.path('cuts.vtu'), '--fill', 0)
                height = max(p[2] for p in points)
                faces = seam_where(self.path('cuts.vtu'), points, lambda p: p[2] in (0, height))
                inside = seam_where(self.path('cuts.vtu'), points,
                                    lambda p: p[2] in (0, height) and 0.41 < math.hypot(*p[:2]) < 0.9)
                self.assertGreater(faces, 1)
                self.assertEqual(inside, 0)

    def marked(self, marks):
        """Returns, for a sphere with marked halves, the length of its seams, and its fraction between the halves."""
        points, faces = sphere(8)
        halves = [[f for f in faces if (sum(points[v][2] for v in f) > 0) == upper] for upper in (True, False)]
        text = ''.join('v %r %r %r\n' % tuple(p) for p in points)
        for half, mark in zip(halves, marks):
            text += mark + '\n' + ''.join('f %d %d %d\n' % tuple(v + 1 for v in f) for f in half)
        mesh = self.write('marked.obj', text)
        self.run_ok('unwrap', mesh, '-o', self.path('cuts.vtu'), '--report', self.path('r.json'))
        seam = json.loads(self.read('r.json'))['result']['seam_length']
        return seam, seam_where(self.path('cuts.vtu'), points, lambda p: p[2] == 0) / seam

    def test_marks_of_files_attract_seams(self):
        plain = self.marked(('', ''))
        self.assertEqual(self.marked(('s 1', 's 1')), plain)
        self.assertEqual(self.marked(('s off', 's off')), plain)  # marks on all edges have no effect
        for marks in (('s 1', 's 2'), ('usemtl a', 'usemtl b')):
            self.assertGreater(self.marked(marks)[1], plain[1] + 0.1)  # seams on marked edges cost a quarter


class HiddenSeams(UnwrapTest):
    def test_seams_avoid_the_visible_side(self):
        points, faces = sphere(8)
        mesh = self.mesh(points, faces)
        seen = {}
        for flags in ((), ('--hide-from', '0,0,1')):
            self.run_ok('unwrap', mesh, '-o', self.path('a.vtu'), '--report', self.path('r.json'), *flags)
            report = json.loads(self.read('r.json'))
            length = report['result']['seam_length']
            cosine = seam_where(self.path('a.vtu'), points, lambda p: max(0, p[2])) / length
            seen[flags] = cosine, report['result']['seam_visibility']
            self.assertEqual(report['options']['hide_from'], flags[1] if flags else None)
        around, hidden = seen.values()
        self.assertAlmostEqual(around[1], 1, places=9)  # visible from some direction, since the shape is convex
        self.assertAlmostEqual(*hidden, delta=0.02)
        self.assertLess(hidden[0], around[0] / 2)


class OneOrMany(UnwrapTest):
    def test_numbers(self):
        mesh = self.mesh(*sphere(6))
        for count in (2, 5, 12):
            layout, report = self.unwrap(mesh, '--charts', count)
            self.assertEqual(report['result']['charts'], count)
            self.assertEqual(report['options']['charts'], count)
            self.assertEqual(len(layout.charts), count)
            self.assertLessEqual(max(c['stretch_l2'] for c in report['charts']), 1.015)
        two = self.mesh(*both(sphere(2), sphere(2)))
        outcome = self.run_ok('unwrap', two, self.path('o.obj'), '--charts', 1)
        self.assertIn('2 charts, not --charts 1', outcome.err)

    def test_long_thin_charts_are_divided(self):
        mesh = self.mesh(*arch(60))
        _, whole = self.unwrap(mesh, '--charts', 'one')
        _, auto = self.unwrap(mesh)
        self.assertEqual(whole['result']['charts'], 1)
        self.assertGreater(auto['result']['charts'], 1)
        self.assertGreater(auto['result']['fill'], 1.5 * whole['result']['fill'])

    def test_long_charts_are_divided_for_the_square(self):
        """A box sixty times as long as wide fills its bounding box, but no square."""
        mesh = self.mesh(*open_box(8, 1, 1, 60))
        _, whole = self.unwrap(mesh, '--charts', 'one')
        _, auto = self.unwrap(mesh)
        self.assertLess(whole['result']['fill'], 0.1)
        self.assertGreater(auto['result']['fill'], 2 * whole['result']['fill'])
        self.assertLessEqual(auto['result']['charts'], 6)

    def test_fill(self):
        mesh = self.mesh(*sphere(8))
        _, undivided = self.unwrap(mesh, '--fill', 0)
        _, full = self.unwrap(mesh, '--fill', 0.6)
        self.assertEqual((undivided['options']['fill'], undivided['result']['charts']), (0, 1))
        self.assertLess(undivided['result']['fill'], 0.6)
        self.assertGreaterEqual(full['result']['fill'], 0.6)
        outcome = self.run_ok('unwrap', mesh, self.path('o.obj'), '--fill', 0.99)
        self.assertIn('not --fill 0.99', outcome.err)
        for flags in (('--fill', 0.99), ('--charts', 99)):
            outcome = self.run_ok('unwrap', mesh, self.path('o.obj'), '--time-limit', 0, *flags, code=LIMIT)
            self.assertRegex(outcome.err, 'not %s %s: the time limit was reached' % flags)

    def test_half_of_the_square_is_filled_for_little_seam(self):
        """A flat L without a requested fill: there is no line about it."""
        points, faces = grid(20, lambda x, y: 0)
        mesh = self.mesh(points, [f for f in faces if min(max(points[v][axis] for v in f) for axis in (0, 1)) < 0.21])
        _, undivided = self.unwrap(mesh, '--fill', 0)
        _, auto = self.unwrap(mesh)
        self.assertEqual((undivided['options']['fill'], auto['options']['fill']), (0, None))
        self.assertEqual(undivided['result']['charts'], 1)
        self.assertLess(undivided['result']['fill'], 0.4)
        self.assertGreaterEqual(auto['result']['fill'], 0.5)
        self.assertLess(auto['result']['seam_length'], 0.6 * 4 / 2)
        outcome = self.run_ok('unwrap', mesh, self.path('o.obj'))
        self.assertNotIn('not --fill', outcome.err)
        _, paint = self.unwrap(mesh, '--preset', 'paint')
        self.assertEqual((paint['options']['fill'], paint['result']['charts']), (0, 1))

    def test_charts_that_may_not_be_cut_are_counted(self):
        cap = self.mesh(*open_box(4, 1, 1, 1))
        outcome = self.run_ok('unwrap', cap, self.path('o.obj'), '--charts', 'one', '--max-stretch', 1.001)
        self.assertNotIn('forbids', outcome.err)
        points, faces = sphere(4)
        edges = self.write('seams.json', '{"edges": [[%d, %d]]}' % tuple(faces[0][:2]))
        ball = self.mesh(points, faces)
        outcome = self.run_ok('unwrap', ball, self.path('o.obj'), '--seams', edges)
        self.assertRegex(outcome.err, r'1 chart stretches more than 1\.015, up to \d\.\d+: --seams forbids cutting')

    def test_presets(self):
        mesh = self.mesh(*open_box(2, 1, 1, 1))
        _, game = self.unwrap(mesh, '--preset', 'game', '--padding', 9)
        for key, value in (('preset', 'game'), ('padding', 9), ('resolution', 2048), ('fill', 0.6),
                           ('max_stretch', 1.01), ('charts', 'auto')):
            self.assertEqual(game['options'][key], value, key)
        _, five = self.unwrap(mesh, '--preset', 'game', '--charts', 5)
        self.assertEqual((five['options']['fill'], five['result']['charts']), (None, 5))
        _, single = self.unwrap(mesh, '--preset', 'single', '--resolution', 99)
        self.assertEqual((single['options']['charts'], single['options']['resolution']), ('one', 99))

    def test_refused(self):
        mesh = self.mesh(*open_box(1, 1, 1, 1))
        none = self.write('none.json', '{"edges": []}')
        for flags, says in ((['--charts', 0], 'not auto, one, or a whole number'),
                            (['--charts', 'two'], 'not auto, one, or a whole number'),
                            (['--fill', 1], 'not a fraction of the square'),
                            (['--fill', 0.5, '--no-pack'], '--fill'),
                            (['--charts', 'one', '--fill', 0.5], '--charts one leaves them'),
                            (['--charts', 5, '--fill', 0.9], '--charts 5 until there are so many'),
                            (['--seams', none, '--charts', 3], '--charts divides charts made by --seams auto'),
                            (['--preset', 'film'], 'film')):
            self.refused(USAGE, 'unwrap', mesh, self.path('o.obj'), *flags, says=says)


if __name__ == '__main__':
    main()
