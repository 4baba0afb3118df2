# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Creases, numbers of charts, fill and presets of majorant unwrap."""
from command_helpers import *
from hard_surfaces import model, open_box
from unwrap_helpers import *

UNSHEARED = 4 + 1e-6


def arch(n):
    """Half a ring, flat, much longer than wide."""
    points, faces = [], []
    for i in range(n + 1):
        a = math.pi * i / n
        points += [(r * math.cos(a), r * math.sin(a), 0) for r in (0.95, 1.0)]
    for i in range(n):
        faces.append((2 * i, 2 * i + 1, 2 * i + 3, 2 * i + 2))
    return points, faces


class Creases(UnwrapTest):
    def test_panels_are_not_sheared(self):
        for kind in ('open box', 'lid', 'tray', 'shaft', 'L-block', 'gear', 'bracket'):
            for n, variant in ((1, 1), (3, 2)):
                with self.subTest(kind=kind, n=n):
                    _, report = self.unwrap(self.mesh(*model(kind, n, variant)))
                    self.assertLess(report['result']['value'], UNSHEARED)
                    self.assertEqual(report['status'], 'converged')

    def marked(self, marks):
        """The length of the seams of a sphere whose upper and lower half are marked."""
        points, faces = sphere(8)
        halves = [[f for f in faces if (sum(points[v][2] for v in f) > 0) == upper] for upper in (True, False)]
        text = ''.join('v %r %r %r\n' % tuple(p) for p in points)
        for half, mark in zip(halves, marks):
            text += mark + '\n' + ''.join('f %d %d %d\n' % tuple(v + 1 for v in f) for f in half)
        mesh = self.write('marked.obj', text)
        self.run_ok('unwrap', mesh, '-o', self.path('cuts.vtu'), '--report', self.path('r.json'))
        with open(self.path('r.json')) as f:
            seam = json.load(f)['result']['seam_length']
        return seam

    def test_marks_of_files_attract_seams(self):
        plain = self.marked(('', ''))
        self.assertEqual(self.marked(('s 1', 's 1')), plain)
        self.assertEqual(self.marked(('s off', 's off')), plain)  # all edges: says nothing
        for marks in (('s 1', 's 2'), ('usemtl a', 'usemtl b')):
            self.assertNotEqual(self.marked(marks), plain)  # a border costs a quarter


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

    def test_fill(self):
        mesh = self.mesh(*sphere(8))
        _, auto = self.unwrap(mesh)
        _, full = self.unwrap(mesh, '--fill', 0.6)
        self.assertLess(auto['result']['fill'], 0.6)
        self.assertGreaterEqual(full['result']['fill'], 0.6)
        outcome = self.run_ok('unwrap', mesh, self.path('o.obj'), '--fill', 0.99)
        self.assertIn('not --fill 0.99', outcome.err)

    def test_presets(self):
        mesh = self.mesh(*open_box(2, 1, 1, 1))
        _, game = self.unwrap(mesh, '--preset', 'game', '--padding', 9)
        for key, value in (('preset', 'game'), ('padding', 9), ('resolution', 2048), ('fill', 0.6),
                           ('max_stretch', 1.01), ('charts', 'auto')):
            self.assertEqual(game['options'][key], value, key)
        _, single = self.unwrap(mesh, '--preset', 'single', '--resolution', 99)
        self.assertEqual((single['options']['charts'], single['options']['resolution']), ('one', 99))

    def test_refused(self):
        mesh = self.mesh(*open_box(1, 1, 1, 1))
        none = self.write('none.json', '{"edges": []}')
        for flags, says in ((['--charts', 0], 'neither auto nor one nor a number'),
                            (['--charts', 'two'], 'neither auto nor one nor a number'),
                            (['--fill', 1], 'no part of a square'),
                            (['--fill', 0.5, '--no-pack'], '--fill'),
                            (['--charts', 'one', '--fill', 0.5], '--charts one leaves them'),
                            (['--seams', none, '--charts', 3], '--charts divides charts of --seams auto'),
                            (['--preset', 'film'], 'film')):
            self.refused(USAGE, 'unwrap', mesh, self.path('o.obj'), *flags, says=says)


if __name__ == '__main__':
    main()
