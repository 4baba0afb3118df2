# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Requested cuts of unwrap, and the placement of the charts."""
import json
from fractions import Fraction

from command_helpers import *
from unwrap_helpers import *


class Seams(UnwrapTest):
    def box(self):
        return self.mesh(cube(2)[0], cube(2)[1])

    def cut_edges(self, points):
        """Returns seven whole edges of the cube, which open it to a cross."""
        corner = lambda *p: points.index(tuple(map(float, p)))
        path = [((0, 0, 0), (0, 0, 1)), ((1, 0, 0), (1, 0, 1)), ((0, 1, 0), (0, 1, 1)),
                ((1, 1, 0), (1, 1, 1)), ((0, 0, 1), (1, 0, 1)), ((0, 0, 1), (0, 1, 1)),
                ((0, 1, 1), (1, 1, 1))]
        edges = []
        for a, b in path:
            middle = tuple((x + y) / 2 for x, y in zip(a, b))
            edges += [(corner(*a), corner(*middle)), (corner(*middle), corner(*b))]
        return edges

    def test_a_file(self):
        points, faces = cube(2)
        edges = self.cut_edges(points)
        for base in (0, 1):
            path = self.write('seams.json', json.dumps(
                {'index_base': base, 'edges': [[a + base, b + base] for a, b in edges]}))
            layout, report = self.clean(self.box(), '--seams', path)
            self.judged()
            self.assertEqual(report['result']['seam_edges'], 14)
            self.assertEqual(report['result']['added_seam_edges'], 0)
            self.assertLessEqual(report['result']['seam_length'], 8 + 1e-9)  # at least 7 edges of the box
            self.assertAlmostEqual(report['result']['value'], 4, places=9)
            self.assertEqual(len(layout.charts), 1)

    def test_surfaces_left_closed_by_a_file_are_opened(self):
        points, faces = cube(2)
        path = self.write('seams.json', json.dumps({'edges': self.cut_edges(points)[:2]}))
        _, report = self.clean(self.box(), '--seams', path)
        self.assertEqual(report['result']['seam_edges'] - report['result']['added_seam_edges'], 2)
        path = self.write('none.json', '{"edges": []}')
        _, report = self.clean(self.box(), '--seams', path)
        self.assertEqual(report['result']['seam_edges'], report['result']['added_seam_edges'])
        self.assertGreater(report['result']['added_seam_length'], 0)

    def test_pairs_that_are_no_edges(self):
        points, faces = cube(2)
        far = (points.index((0, 0, 0)), points.index((1, 1, 1)))
        for a, b in (far, faces[0][0::2]):  # a distant edge, and the diagonal of a polygon
            path = self.write('seams.json', json.dumps({'edges': [[int(a), int(b)]]}))
            self.refused(USAGE, 'unwrap', self.box(), self.path('o.obj'), '--seams', path,
                         says=('seams.json', '%d and %d' % (a, b)))
        path = self.write('seams.json', '{"edges": [[0, 99]]}')
        self.refused(UNREADABLE, 'unwrap', self.box(), self.path('o.obj'), '--seams', path,
                     says=('seams.json', '99'))
        self.refused(UNREADABLE, 'unwrap', self.box(), self.path('o.obj'), '--seams',
                     self.path('no.json'), says='no.json')

    def test_sharp(self):
        layout, report = self.clean(self.box(), '--seams', 'sharp', '--fill', 0)
        self.judged()
        self.assertGreater(report['result']['seam_length'], 6.999)  # a cross, perhaps in two parts
        self.assertAlmostEqual(report['result']['value'], 4, places=6)
        self.assertLessEqual(len(layout.charts), 2 + 24 / 200)
        _, report = self.clean(self.mesh(*sphere(4)), '--seams', 'sharp=30')
        self.assertEqual(report['result']['seam_edges'], report['result']['added_seam_edges'])
        for angle in ('x', '0', '180', ''):
            self.refused(USAGE, 'unwrap', self.box(), self.path('o.obj'), '--seams', 'sharp=' + angle,
                         says='--seams sharp=' + angle)

    def islands(self, change=lambda face, uv: uv, shared=True):
        """Writes the cube with one square island per side as OBJ; equal vt share a number, or have new ones."""
        points, faces = cube(2)
        lines, number = ['v %r %r %r' % p for p in points], {}
        for k, face in enumerate(faces):
            corners = []
            side = k // 4
            for v in face:
                uv = [x for axis, x in enumerate(points[v]) if axis != side // 2]
                if (side % 2 == 0) != (side // 2 == 1):
                    uv = uv[::-1]
                uv = change(k, (uv[0] + 2 * side, uv[1]))
                key = (uv, side) if shared else (k, v)
                if key not in number:
                    number[key] = len(number) + 1
                    lines.append('vt %r %r' % uv)
                corners.append('%d/%d' % (v + 1, number[key]))
            lines.append('f ' + ' '.join(corners))
        return self.write('islands.obj', '\n'.join(lines) + '\n')

    def starts(self, report):
        return [chart['start'] for chart in report['charts']]

    def test_islands_of_the_file(self):
        mesh = self.islands()
        layout, report = self.clean(mesh, '--seams', 'uv')
        self.judged()
        self.assertEqual((len(layout.charts), self.starts(report)), (6, ['texture'] * 6))
        self.assertAlmostEqual(report['result']['seam_length'], 12)
        self.assertEqual(report['result']['added_seam_edges'], 0)

    def test_islands_by_value(self):
        """Many programs write a separate vt for every corner."""
        layout, report = self.clean(self.islands(shared=False), '--seams', 'uv')
        self.assertEqual((len(layout.charts), self.starts(report)), (6, ['texture'] * 6))

    def test_islands_turned_and_mirrored(self):
        mirrored = self.islands(lambda k, uv: (-uv[0], uv[1]))
        _, report = self.clean(mirrored, '--seams', 'uv')
        self.assertEqual(self.starts(report), ['texture'] * 6)
        stacked = self.islands(lambda k, uv: (uv[0] % 2, uv[1]) if k >= 4 else (uv[1], -uv[0]))
        layout, report = self.clean(stacked, '--seams', 'uv')
        self.assertEqual((len(layout.charts), set(self.starts(report))), (6, {'texture'}))

    def test_islands_that_are_no_maps(self):
        flat = self.islands(lambda k, uv: (0, 0) if k // 4 == 2 else uv)
        _, report = self.clean(flat, '--seams', 'uv')
        self.assertEqual(self.starts(report).count('anew'), 1)
        folded = self.islands(lambda k, uv: (uv[0] + 0.9, uv[1] + 0.9)
                              if k // 4 == 3 and uv == (6.5, 0.5) else uv)
        _, report = self.clean(folded, '--seams', 'uv')
        self.assertEqual(self.starts(report).count('untangled'), 1)
        self.assertEqual(self.starts(report).count('texture'), 5)

    def test_islands_that_are_not_there(self):
        self.refused(UNSUPPORTED, 'unwrap', self.box(), self.path('o.obj'), '--seams', 'uv',
                     says=('texture coordinates', '--seams auto'))

    def test_faces_without_texture(self):
        """Three sides around a corner lose their coordinates, one of them only at some corners."""
        self.islands()
        kept = []
        for line in self.read('islands.obj').decode().splitlines():
            k = sum(l.startswith('f ') for l in kept)
            if line.startswith('f ') and k // 4 in (0, 2, 4):
                corners = line.split()[1:]
                line = 'f ' + ' '.join(c if k == 0 and c != corners[1] else c.split('/')[0]
                                       for c in corners)
            kept.append(line)
        mesh = self.write('partial.obj', '\n'.join(kept) + '\n')
        layout, report = self.clean(mesh, '--seams', 'uv')
        self.judged()
        self.assertEqual(sorted(self.starts(report)), ['texture'] * 3 + ['unfolded'])
        self.assertEqual(report['result']['untextured_faces'], 12)
        self.assertAlmostEqual(report['result']['value'], 4)  # the corner can be cut open without distortion
        self.assertGreater(report['result']['added_seam_edges'], 0)
        outcome = self.run_ok('unwrap', mesh, self.path('again.obj'), '--seams', 'uv')
        self.assertIn('12 faces without texture coordinates, cut as by --seams auto', outcome.err)
        self.assertIn('a vt index at some corners only: the face is read without texture coordinates', outcome.err)

    def test_less_stretch_takes_longer_seams(self):
        mesh = self.mesh(*sphere(8))
        (_, loose), (_, tight) = (self.unwrap(mesh, '--max-stretch', s) for s in (1.2, 1.01))
        self.assertLess(loose['result']['seam_length'], tight['result']['seam_length'])
        self.assertGreater(loose['result']['stretch_l2'], tight['result']['stretch_l2'])
        self.refused(USAGE, 'unwrap', mesh, self.path('o.obj'), '--max-stretch', 1,
                     says='--max-stretch')


class Packed(UnwrapTest):
    def many(self):
        mesh = sphere(2)
        for k in range(3):
            mesh = both(mesh, grid(2 + k, lambda x, y: 0), (0, 0, 3 + k))
        return self.mesh(*both(mesh, torus(6, 4, 0)))

    def test_padding(self):
        for padding, resolution in ((4, 1024), (16, 256), (0.5, 4096)):
            layout, report = self.clean_but_padding(padding, resolution)
            self.assertGreaterEqual(report['result']['distance'],
                                    padding / resolution * report['result']['side'])
            self.assertAlmostEqual(report['result']['side'] * report['result']['layout_scale'], 1)
            self.assertAlmostEqual(layout.side() / layout.scale, 1 - 2 * padding / resolution)
            self.assertAlmostEqual(report['result']['fill'], self.filled(layout), places=9)

    def clean_but_padding(self, padding, resolution):
        layout, report = self.unwrap(self.many(), '--padding', padding, '--resolution', resolution)
        self.assertEqual(layout.overlapping(), [])
        least = Fraction(str(padding)) / Fraction(str(resolution)) * layout.scale * (1 - Fraction(1, 10**12))
        self.assertGreaterEqual(layout.nearest_charts(), least ** 2)
        return layout, report

    def filled(self, layout):
        """Returns the covered fraction of the unit square."""
        return sum(layout.area(k) for k in range(len(layout.faces))) / 2 / layout.scale ** 2

    def test_no_padding(self):
        layout, _ = self.unwrap(self.many(), '--padding', 0)
        self.assertEqual(layout.overlapping(), [])
        self.judged()

    def test_padding_that_leaves_no_room(self):
        self.refused(USAGE, 'unwrap', '--quiet', self.many(), self.path('o.obj'), '--padding', 2000,
                     says='padding')
        for flags in (['--padding', '-1'], ['--resolution', '0'], ['--padding', 'nan']):
            self.refused(USAGE, 'unwrap', self.many(), self.path('o.obj'), *flags, says=flags[0])

    def test_not_packed(self):
        layout, report = self.unwrap(self.many(), '--no-pack')
        self.assertIs(report['result']['globally_injective'], not layout.overlapping())
        self.assertNotIn('fill', report['result'])
        for chart in layout.charts:
            alone = set(chart)
            self.assertFalse([p for p in layout.overlapping() if set(p) <= alone])

    def test_normalized(self):
        layout, report = self.clean(self.many(), '--normalize')
        self.judged()
        self.assertTrue(all(0 <= x <= layout.scale for p in layout.uv for x in p))
        self.assertGreater(layout.side() / layout.scale, 0.99)

    def pinned(self, targets):
        return self.write('pins.json', json.dumps(
            {'handles': [{'vertex': v, 'target': uv} for v, uv in targets.items()]}))

    def test_charts_with_pins_stay(self):
        flat, ball = grid(3, lambda x, y: 0), sphere(2)
        mesh = self.mesh(*both(flat, ball))
        for targets in ({0: (7, -3)}, {0: (7, -3), 3: (7, -2)}, {0: (1e4, 1e4), 15: (1e4 - 1, 1e4 + 1)},
                        {5: (0.25, 0.5), 9: (0.75, 0.25)}):
            layout, report = self.clean(mesh, '--pins', self.pinned(targets))
            self.judged()
            self.assertEqual([chart['pinned'] for chart in report['charts']], [True, False])
            at_vertex = {v: layout.uv[t] for face, texture in zip(layout.faces, layout.texture)
                         for v, t in zip(face, texture)}
            for v, uv in targets.items():
                self.assertEqual(at_vertex[v], tuple(Fraction(x) * layout.scale for x in uv))

    def test_a_pin_on_every_chart(self):
        flat = grid(2, lambda x, y: 0)
        mesh = self.mesh(*both(flat, flat))
        layout, report = self.clean(mesh, '--pins', self.pinned({0: (0, 0), 9: (3, 0)}))
        self.assertEqual([chart['pinned'] for chart in report['charts']], [True, True])


if __name__ == '__main__':
    main()
