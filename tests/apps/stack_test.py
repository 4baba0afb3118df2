# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Charts that share a place of the layout: the eligible charts, the claims of files, the tests of check."""
import json
import math
import random

from command_helpers import *
from unwrap_helpers import *


def leaf(n=4):
    """Returns a bent strip without a symmetry."""
    points = [(i / n, s * (1 + 0.3 * math.sin(3 * i / n)) + 0.2 * i / n, 0.1 * math.sin(5 * i / n) * (1 + s))
              for i in range(n + 1) for s in (0, 0.4)]
    faces = [f for i in range(n) for a in [2 * i] for f in ((a, a + 2, a + 3), (a, a + 3, a + 1))]
    return points, faces


def moved(points, k, mirror=False):
    a = 0.7 * k
    out = []
    for x, y, z in points:
        x = -x if mirror else x
        out.append((x * math.cos(a) - y * math.sin(a) + 4 * k, x * math.sin(a) + y * math.cos(a), z + k))
    return out


def row(senses):
    """Returns leaves, one for each letter: s, unchanged; m, mirrored; o, another shape, larger at one end."""
    points, faces = [], []
    for k, sense in enumerate(senses):
        base, (p, f) = len(points), leaf()
        if sense == 'o':
            p = p[:-1] + [(p[-1][0] + 0.3, *p[-1][1:])]
        points += moved(p, k, sense == 'm')
        faces += [tuple(base + v for v in (reversed(t) if sense == 'm' else t)) for t in f]
    return points, faces


def symmetric(n=4):
    """Returns a surface that is symmetric about x = 0 and cut there: two quads per row, textured on each side."""
    points = [(x, y, 0.1 * x * x * y) for y in range(n + 1) for x in (-1 - 0.1 * y, 0, 1 + 0.1 * y)]
    faces = [f for r in range(n) for a in [3 * r] for f in ((a, a + 1, a + 4, a + 3), (a + 2, a + 5, a + 4, a + 1))]
    return points, faces


class Stacks(UnwrapTest):
    def places(self, layout):
        """Returns charts by the set of their corners in the plane."""
        found = {}
        for k, chart in enumerate(layout.charts):
            key = frozenset(frozenset(layout.uv[t] for t in layout.texture[f]) for f in chart)
            found.setdefault(key, []).append(k)
        return sorted(found.values())

    def run_stacked(self, mesh, method, *flags):
        self.run_ok('unwrap', mesh, '--stack', method, '-o', self.path('a.obj'), '-o', self.path('a.vtu'), '--report',
                    self.path('r.json'), *flags)
        self.run_ok('check', self.path('a.vtu'), '--certify', '--surface', mesh)
        self.run_ok('check', self.path('a.obj'), '--certify', '--stacked', '--surface', mesh)
        return Layout(self.path('a.obj')), json.loads(self.read('r.json'))

    def test_copies_lie_on_each_other(self):
        mesh = self.mesh(*row('ssmoss'))
        layout, report = self.run_stacked(mesh, 'equal')
        self.assertEqual(self.places(layout), [[0, 1, 4, 5], [2], [3]])
        self.assertEqual([c['stack'] for c in report['charts']], [0, 0, None, None, 0, 0])
        self.assertFalse(any(c['mirrored'] for c in report['charts']))
        layout, report = self.run_stacked(mesh, 'mirrored')
        self.assertEqual(self.places(layout), [[0, 1, 2, 4, 5], [3]])
        self.assertEqual([c['mirrored'] for c in report['charts']], [False, False, True, False, False, False])
        for chart, c in zip(layout.charts, report['charts']):
            self.assertTrue(all((layout.area(k) < 0) == c['mirrored'] for k in chart))
        layout, report = self.unwrap(mesh, '--stack', 'no')
        self.assertEqual(len(self.places(layout)), 6)
        self.assertEqual({c['stack'] for c in report['charts']}, {None})

    def test_copies_of_other_polygons_lie_beside_each_other(self):
        """A square as one quad and as two triangles: no file can show both at one place."""
        square = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
        points = square + [(x + 3, y, z) for x, y, z in square] + [(x + 6, y, z) for x, y, z in square]
        mesh = self.mesh(points, [(0, 1, 2, 3), (4, 5, 6), (4, 6, 7), (8, 9, 10, 11)])
        for method in ('equal', 'mirrored'):
            layout, report = self.run_stacked(mesh, method)
            self.assertEqual([c['stack'] for c in report['charts']], [0, None, 0])

    def test_copies_whose_vertices_are_split(self):
        """Also if faces of copies are interleaved."""
        points, faces = row('ssm')
        for step in (1, 5):
            split, polygons = list(points), []
            for k in range(len(faces)):
                face = faces[k * step % len(faces)]
                is_split = k * step % 4 > 1
                polygons.append(tuple(range(len(split), len(split) + len(face))) if is_split else face)
                split += [points[v] for v in face] if is_split else []
            with self.subTest(step):
                _, report = self.run_stacked(self.mesh(split, polygons), 'mirrored')
                self.assertEqual([c['stack'] for c in report['charts']], [0, 0, 0])
                self.assertEqual(sum(c['mirrored'] for c in report['charts']), 1)
                printed = self.run_ok('check', self.path('a.obj'), '--certify', '--stacked')
                self.assertIn('1 stack of 3 charts, 1 mirrored', printed.out)

    def test_copies_are_cut_alike(self):
        """Closed parts with different vertex numbers, which by themselves would be cut differently."""
        part, faces = sphere(6)
        part = [(1.2 * x + 0.2 * y * z, y + 0.3 * x * x, 0.8 * z + 0.1 * x * y * y) for x, y, z in part]
        points, all_faces = [], []
        for k, sense in enumerate('ssmsm'):
            order = random.Random(k).sample(range(len(part)), len(part))
            number = {v: len(points) + i for i, v in enumerate(order)}
            points += moved([part[v] for v in order], k, sense == 'm')
            turned = [tuple(number[v] for v in (reversed(f) if sense == 'm' else f)) for f in faces]
            all_faces += random.Random(-k - 1).sample(turned, len(turned))
        mesh = self.mesh(points, all_faces)
        flags = ('--max-stretch', '1.02')
        layout, report = self.run_stacked(mesh, 'mirrored', *flags)
        self.assertEqual(len(self.places(layout)), len(layout.charts) // 5)
        self.assertEqual(sum(c['mirrored'] for c in report['charts']), len(layout.charts) // 5 * 2)
        layout, _ = self.run_stacked(mesh, 'equal', *flags)
        self.assertEqual(sorted(map(len, self.places(layout)))[-1], 3)

    def test_stacks_in_tiles_and_every_format(self):
        mesh = self.mesh(*row('smsosmosms'))
        outputs = [word for name in ('a.ply', 'a.glb', 'a.html', 'a.svg') for word in ('-o', self.path(name))]
        _, report = self.run_stacked(mesh, 'mirrored', '--udim', 2, *outputs)
        self.assertLessEqual(report['result']['tiles'], 2)
        for name in ('a.ply', 'a.glb'):
            printed = self.run_ok('check', self.path(name), '--certify', '--stacked')
            self.assertIn('stack', printed.out)
        self.run_ok('convert', self.path('a.vtu'), '-o', self.path('b.obj'))
        self.assertEqual(len(self.places(Layout(self.path('b.obj')))), 2)

    def test_halves_of_one_surface_fold_at_their_seam(self):
        points, faces = symmetric()
        edges = [[3 * r + 1, 3 * r + 4] for r in range(4)]
        mesh = self.mesh(points, faces)
        seams = self.write('seams.json', json.dumps({'edges': edges}))
        layout, report = self.run_stacked(mesh, 'mirrored', '--seams', seams)
        self.assertEqual(report['result']['charts'], 2)
        self.assertEqual(sum(c['mirrored'] for c in report['charts']), 1)
        self.assertEqual(len(self.places(layout)), 1)

    def test_check_counts_stacks(self):
        mesh = self.mesh(*row('sms'))
        self.run_stacked(mesh, 'mirrored')
        printed = self.run_ok('check', self.path('a.vtu'), '--report', self.path('c.json'))
        self.assertIn('1 stack of 3 charts, 1 mirrored', printed.out)
        self.assertEqual(json.loads(self.read('c.json'))['result']['stacks'], {'stacks': 1, 'charts': 3, 'mirrored': 1})
        self.found(self.path('a.obj'), '--certify', says='positive')
        energy = json.loads(self.read('r.json'))['result']['value']
        self.assertAlmostEqual(json.loads(self.read('c.json'))['result']['value'], energy, delta=1e-6)

    def test_false_claims(self):
        self.run_stacked(self.mesh(*row('smso')), 'mirrored')
        self.assertEqual(Vtu(self.path('a.vtu')).claims['stacks'], [{'charts': [0, 1, 2], 'mirrored': [1]}])
        for charts, mirrored, says in (([0, 1, 2], [], 'mirrored, which is not claimed'),
                                       ([0, 1, 2], [1, 2], 'claimed to be mirrored'),
                                       ([0, 1, 3], [1], 'not congruent'), ([0, 1], [1], 'not claimed'),
                                       ([0, 1, 2, 9], [1], 'no chart 9')):
            with self.subTest(charts=charts, mirrored=mirrored):
                vtu = Vtu(self.path('a.vtu'))
                vtu.claims['stacks'] = [{'charts': charts, 'mirrored': mirrored}]
                self.found(vtu.write(self.path('b.vtu')), says=says)
        vtu = Vtu(self.path('a.vtu'))
        del vtu.claims['stacks']
        self.found(vtu.write(self.path('b.vtu')), says='positive')
        vtu.claims['stacks'] = [{'charts': [0.5], 'mirrored': []}]
        self.refused(UNREADABLE, 'check', vtu.write(self.path('b.vtu')), says='majorant_claims.stacks')

    def test_one_digit_off(self):
        self.run_stacked(self.mesh(*row('ss')), 'equal')
        lines = self.read('a.obj').decode().splitlines()
        k = max(i for i, line in enumerate(lines) if line.startswith('vt '))
        _, u, v = lines[k].split()
        lines[k] = 'vt %r %s' % (math.nextafter(float(u), 1), v)
        self.found(self.write('c.obj', '\n'.join(lines) + '\n'), '--stacked', '--certify', says='not globally injective')

    def test_options_that_break_stacks_are_refused(self):
        mesh = self.mesh(*row('ss'))
        pins = self.write('p.json', '{"handles": [{"vertex": 0, "target": [0, 0]}]}')
        for words, says in ((['--degree', 2], '--degree'), (['--refine', 2], '--refine'), (['--pins', pins], '--pins'),
                            (['-o', self.path('x.msh')], '.msh'), (['--no-pack'], '--no-pack'),
                            (['--seams', 'uv', '--keep-shape'], '--keep-shape')):
            self.refused(USAGE, 'unwrap', mesh, '--stack', 'equal', '-o', self.path('x.obj'), *words, says=says)


if __name__ == '__main__':
    main()
