# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""The placement of charts: upright, in tiles, at requested densities, in the shapes of a file; groups of an OBJ."""
import json
import math
import os

from command_helpers import *
from unwrap_helpers import *


def tetrahedra(count, size=lambda k: 1.0):
    """Returns closed pieces in a row."""
    points, faces = [], []
    for k in range(count):
        s = size(k)
        base = len(points)
        points += [(3 * k + s * x, s * y, s * z) for x, y, z in ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1))]
        faces += [tuple(base + i for i in f) for f in ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3))]
    return points, faces


def box_net():
    """Returns a box in six islands, each with its own coordinates, of different sizes in the plane."""
    points, faces = cube(1)
    uv, texture = [], []
    for k, face in enumerate(faces):
        s = 1 + 0.3 * k
        texture.append(tuple(range(4 * k, 4 * k + 4)))
        uv += [(10 * k, 0), (10 * k + s, 0), (10 * k + s, s), (10 * k, s)]
    return points, faces, uv, texture


def textured(points, faces, uv, texture, head=''):
    lines = [head] if head else []
    lines += ['v %r %r %r' % tuple(float(x) for x in p) for p in points]
    lines += ['vt %r %r' % tuple(float(x) for x in p) for p in uv]
    lines += ['f ' + ' '.join('%d/%d' % (v + 1, t + 1) for v, t in zip(f, g)) for f, g in zip(faces, texture)]
    return '\n'.join(lines) + '\n'


class LayoutTest(UnwrapTest):
    def tiles_of(self, layout):
        """Returns for every chart, by the digits, the tile that contains all of its points."""
        tiles = []
        for chart in layout.charts:
            found = {tuple(x // layout.scale for x in layout.uv[t]) for k in chart for t in layout.texture[k]}
            self.assertEqual(len(found), 1)
            tiles.append(found.pop())
        return tiles

    def within(self, layout, border):
        border -= Fraction(1, 10**12)
        for chart, (i, j) in zip(layout.charts, self.tiles_of(layout)):
            for k in chart:
                for t in layout.texture[k]:
                    for x, low in zip(layout.uv[t], (i, j)):
                        self.assertGreaterEqual(x, (low + border) * layout.scale)
                        self.assertLessEqual(x, (low + 1 - border) * layout.scale)

    def spaced(self, layout, padding, resolution):
        """Tests the distances of charts in all tiles; borders separate charts of different tiles."""
        least = Fraction(padding) / Fraction(resolution) * layout.scale
        self.assertGreaterEqual(layout.nearest_charts(), least ** 2)


class Upright(LayoutTest):
    def up_of(self, layout, points, chart, axis):
        """Returns the mean direction of the axis in the plane, over the chart."""
        total = [0.0, 0.0]
        for k in chart:
            a, b, c = (points[v] for v in layout.faces[k][:3])
            p, q, r = ([x / layout.scale for x in layout.uv[t]] for t in layout.texture[k][:3])
            e, f = [y - x for x, y in zip(a, b)], [y - x for x, y in zip(a, c)]
            ee, ef, ff = (sum(x * y for x, y in zip(s, t)) for s, t in ((e, e), (e, f), (f, f)))
            area = math.sqrt(ee * ff - ef * ef)
            s, t = e[axis], f[axis]
            x, y = (ff * s - ef * t) / area ** 2, (ee * t - ef * s) / area ** 2
            for i in (0, 1):
                total[i] += area * (x * (q[i] - p[i]) + y * (r[i] - p[i]))
        return total

    def test_every_chart_has_the_axis_upwards(self):
        points, faces = [], []
        for k in range(6):  # bent sheets, rotated in space
            p, f = grid(3)
            c, s, d, t = math.cos(k + 0.4), math.sin(k + 0.4), math.cos(2 * k + 0.7), math.sin(2 * k + 0.7)
            p = [(c * x - s * y, s * x + c * y, z) for x, y, z in p]
            faces += [tuple(len(points) + v for v in face) for face in f]
            points += [(x + 3 * k, d * y - t * z, t * y + d * z) for x, y, z in p]
        mesh = self.mesh(points, faces)
        for k, axis in enumerate('xyz'):
            with self.subTest(axis=axis):
                layout, report = self.unwrap(mesh, '--upright', axis)
                self.assertEqual(report['options']['upright'], axis)
                self.apart(layout, 4, 1024)
                for chart in layout.charts:
                    x, y = self.up_of(layout, points, chart, k)
                    self.assertGreater(y, 0)
                    self.assertLess(abs(x), 1e-6 * y)

    def test_charts_across_the_axis_are_turned_as_they_fit(self):
        points = [(0, 0, 0), (3, 1, 0), (2.9, 1.3, 0), (-0.1, 0.3, 0)]
        layout, _ = self.unwrap(self.mesh(points, [(0, 1, 2), (0, 2, 3)]), '--upright', 'z')
        self.apart(layout, 4, 1024)
        low = min(p[1] for p in layout.uv)
        self.assertGreater(sum(p[1] - low < 1e-9 * layout.scale for p in layout.uv), 1)  # a side is horizontal


class KeptShapes(LayoutTest):
    def squares(self, layout):
        """Returns squared distances of all corners of every chart, in units of the layout."""
        found = []
        for chart in layout.charts:
            corners = [t for k in chart for t in layout.texture[k]]
            found.append([[sum(Fraction(a - b, layout.scale) ** 2 for a, b in zip(layout.uv[s], layout.uv[t]))
                           for s in corners] for t in corners])
        return found

    def test_islands_are_congruent_at_one_scale(self):
        mesh = self.write('box.obj', textured(*box_net()))
        before = self.squares(Layout(mesh))
        layout, report = self.unwrap(mesh, '--seams', 'uv', '--keep-shape')
        after = self.squares(layout)
        scale = after[0][0][1] / before[0][0][1]
        for one, other in zip(before, after):
            for row, moved in zip(one, other):
                for a, b in zip(row, moved):
                    self.assertLess(abs(math.sqrt(a * scale) - math.sqrt(b)), 1e-12)
        self.apart(layout, 4, 1024)
        self.assertEqual(report['result']['charts'], 6)
        self.assertTrue(report['options']['keep_shape'])
        self.assertEqual({c['start'] for c in report['charts']}, {'texture'})

    def islands_refused(self, text, *says):
        self.refused(UNSUPPORTED, 'unwrap', self.write('bad.obj', text), '-o', self.path('x.obj'), '--seams', 'uv',
                     '--keep-shape', says=says)
        self.assertFalse(os.path.exists(self.path('x.obj')))

    def test_flipped_and_overlapping_islands_are_refused(self):
        points, faces, uv, texture = box_net()
        mirrored = [(-x, y) for x, y in uv]
        self.islands_refused(textured(points, faces, mirrored, texture), 'turned over', 'leave out --keep-shape')
        flipped = uv[:8] + [uv[8], uv[11], uv[10], uv[9]] + uv[12:]
        self.islands_refused(textured(points, faces, flipped, texture), 'face 3 is turned over')
        flat = uv[:12] + [(x, 0) for x, _ in uv[12:16]] + uv[16:]
        self.islands_refused(textured(points, faces, flat, texture), 'face 4 has no area')
        self.islands_refused(textured(points, faces[:5], uv, texture[:5]) + 'f %d %d %d %d\n' % tuple(v + 1 for v in faces[5]),
                     'face 6 has no texture coordinates')
        turns, steps = 1.2, 24  # one island that winds around a ring more than once
        ring = [(r * math.cos(a), r * math.sin(a)) for k in range(steps + 1) for r in (1, 2)
                for a in [2 * math.pi * turns * k / steps]]
        strip = [(k, r, 0) for k in range(steps + 1) for r in (0, 1)]
        quads = [(2 * k, 2 * k + 1, 2 * k + 3, 2 * k + 2) for k in range(steps)]
        quads = [tuple(reversed(q)) for q in quads]
        self.islands_refused(textured(strip, quads, [(-x, y) for x, y in ring], quads), 'overlaps itself')

    def test_missing_and_conflicting_options(self):
        mesh = self.write('box.obj', textured(*box_net()))
        for flags, says in [(['--keep-shape'], '--seams uv'),
                            (['--seams', 'uv', '--keep-shape', '--degree', 2], '--degree'),
                            (['--seams', 'uv', '--keep-shape', '--texel-density', self.write('d.json', '{"other": 2}')],
                             '--texel-density')]:
            outcome = self.refused(USAGE, 'unwrap', mesh, '-o', self.path('x.obj'), *flags)
            self.assertIn(says, outcome.err)


class Tiles(LayoutTest):
    def test_charts_are_spread_with_a_border_in_each(self):
        points, faces = tetrahedra(30, lambda k: 1 + k % 5)
        mesh = self.mesh(points, faces)
        for tiles, padding in ((1, 4), (3, 4), (12, 0), (4, 20)):
            with self.subTest(tiles=tiles, padding=padding):
                layout, report = self.unwrap(mesh, '--udim', tiles, '--padding', padding, '--resolution', 512)
                self.within(layout, Fraction(padding, 512))
                self.spaced(layout, padding, 512)
                found = [1001 + i + 10 * j for i, j in self.tiles_of(layout)]
                self.assertEqual(found, [c['tile'] for c in report['charts']])
                self.assertEqual(len(set(found)), report['result']['tiles'])
                self.assertLessEqual(report['result']['tiles'], tiles)
                self.assertGreater(report['result']['tiles'], tiles / 2)
                if tiles == 12:
                    self.assertIn(1011, found)  # a tile of the second row

    def test_a_material_for_every_tile(self):
        points, faces = tetrahedra(12)
        text = obj_text(points, faces)
        text = text.replace('f ', 'mtllib a.mtl\nusemtl red\ng all\nf ', 1)
        layout, report = self.unwrap(self.write('m.obj', text), '--udim', 4)
        material, by_face = None, []
        for line in layout.text.splitlines():
            if line.startswith('usemtl'):
                material = line.split()[1]
            if line.startswith('f '):
                by_face.append(material)
        tile = {k: c['tile'] for chart, c in zip(layout.charts, report['charts']) for k in chart}
        self.assertEqual(by_face, [str(tile[k]) for k in range(len(layout.faces))])
        self.assertNotIn('mtllib', layout.text)
        self.assertIn('g all', layout.text)

    def test_with_more_tiles_there_is_more_density(self):
        mesh = self.mesh(*tetrahedra(30))
        densities = [self.unwrap(mesh, '--udim', n)[1]['result']['texel_density'] for n in (1, 4, 9)]
        self.assertGreater(densities[1], 1.7 * densities[0])
        self.assertGreater(densities[2], 1.3 * densities[1])

    def test_every_format_is_proven(self):
        mesh = self.mesh(*tetrahedra(9))
        names = ('a.vtu', 'a.obj', 'a.ply', 'a.glb', 'a.msh')
        outputs = [word for name in names for word in ('-o', self.path(name))]
        self.run_ok('unwrap', mesh, '--udim', 3, '--msh', 'surface', *outputs)
        for name in names:
            self.run_ok('check', self.path(name), '--certify', '--surface', mesh)

    def test_options_that_place_charts_are_refused(self):
        mesh = self.mesh(*tetrahedra(3))
        pins = self.write('p.json', '{"handles": [{"vertex": 0, "target": [0, 0]}]}')
        for words, says in ((['--scale', 'model'], '--scale model'), (['--pins', pins], '--pins'),
                            (['--no-pack'], '--no-pack')):
            outcome = self.refused(USAGE, 'unwrap', mesh, '--udim', 2, '-o', self.path('x.obj'), *words)
            self.assertIn(says, outcome.err)
        for n in ('0', '101', '1.5'):
            self.refused(USAGE, 'unwrap', mesh, '--udim', n, '-o', self.path('x.obj'))


class TexelDensity(LayoutTest):
    def density(self, layout, points, chart, resolution):
        uv = sum(layout.area(k) for k in chart) / layout.scale ** 2
        surface = sum(2 * area_of([points[v] for v in layout.faces[k]]) for k in chart)
        return resolution * math.sqrt(uv / surface)

    def test_one_density_for_all_charts(self):
        points, faces = tetrahedra(9)
        mesh = self.mesh(points, faces)
        for density, tiles in ((50, 1), (150, 4)):
            layout, report = self.unwrap(mesh, '--texel-density', density, '--udim', tiles)
            for chart in layout.charts:
                self.assertAlmostEqual(self.density(layout, points, chart, 1024), density, delta=1e-4 * density)
            self.assertAlmostEqual(report['result']['texel_density'], density, delta=1e-4 * density)
            self.assertAlmostEqual(report['result']['layout_scale'], density / 1024, places=12)
            self.spaced(layout, 4, 1024)
            self.within(layout, Fraction(4, 1024))

    def test_the_reported_density_is_that_of_the_layout(self):
        points, faces = sphere(6)
        for words in ([], ['--texel-density', 100], ['--udim', 2]):
            layout, report = self.unwrap(self.mesh(points, faces), '--max-stretch', 1.2, *words)
            there = self.density(layout, points, [k for chart in layout.charts for k in chart], 1024)
            self.assertAlmostEqual(report['result']['texel_density'] / there, 1, delta=1e-9)

    def test_a_density_that_does_not_fit_names_the_largest_one(self):
        mesh = self.mesh(*tetrahedra(9))
        outcome = self.refused(UNSUPPORTED, 'unwrap', mesh, '-o', self.path('x.obj'), '--texel-density', 1000,
                               '--quiet')
        times = float(re.search(r'need ([\d.]+) times', outcome.err).group(1))
        self.run_ok('unwrap', mesh, '-o', self.path('x.obj'), '--texel-density', 0.97 * 1000 / times)

    def test_densities_of_any_size_are_answered(self):
        """Wrong units: sizes that overflow on the way end with the line above, too."""
        mesh = self.mesh(*tetrahedra(9))
        for density in ('1e9', '1e100', '1e300'):
            self.refused(UNSUPPORTED, 'unwrap', mesh, '-o', self.path('x.obj'), '--texel-density', density, '--quiet',
                         says='a lower texel density')
        points, faces = tetrahedra(2)
        text = obj_text(points, faces)
        first, rest = text.split('f ', 1)
        both = self.write('both.obj', first + 'usemtl a\nf ' + rest.replace('f ', 'usemtl b\nf ', 1))
        for ratio in ('1e10', '1e12', '1e300'):
            printed = self.write('densities.json', '{"materials": {"a": 1, "b": %s}}' % ratio)
            self.refused(UNSUPPORTED, 'unwrap', both, '-o', self.path('x.obj'), '--texel-density', printed, '--resolution', 64,
                         '--quiet')

    def test_a_number_for_every_material(self):
        points, faces = sphere(4)
        text = obj_text(points, faces)
        head, *lines = text.split('f ')
        half = len(lines) // 2
        text = head + 'usemtl wood\n' + ''.join('f ' + x for x in lines[:half]) + 'usemtl iron\n' + ''.join(
            'f ' + x for x in lines[half:])
        mesh = self.write('m.obj', text)
        printed = self.write('d.json', '{"materials": {"wood": 200, "iron": 50}, "comment": "x"}')
        layout, report = self.unwrap(mesh, '--texel-density', printed)
        self.run_ok('unwrap', mesh, '--texel-density', printed, '-o', self.path('m.vtu'))
        self.spaced(layout, 4, 1024)
        sums = {}
        for chart in layout.charts:
            kinds = {k < half for k in chart}
            self.assertEqual(len(kinds), 1)  # charts are cut where the density changes
            entry = sums.setdefault(kinds.pop(), [0, 0])
            entry[0] += sum(layout.area(k) for k in chart) / layout.scale ** 2
            entry[1] += sum(2 * area_of([points[v] for v in layout.faces[k]]) for k in chart)
        wood, iron = (1024 * math.sqrt(a / b) for a, b in (sums[True], sums[False]))
        self.assertAlmostEqual(wood / iron, 4, delta=0.05)
        self.assertAlmostEqual(wood, 200, delta=4)
        self.run_ok('check', self.path('m.vtu'), '--certify', '--surface', mesh)

    def test_invalid_density_files(self):
        mesh = self.mesh(*tetrahedra(2))
        for text, code, says in (('{"materials": {"no": 3}}', USAGE, "no material 'no'"),
                                 ('{"materials": {}}', USAGE, 'faces without a material'),
                                 ('{"other": -1}', UNREADABLE, '"other"'), ('{"other": 1', UNREADABLE, 'JSON'),
                                 ('[]', UNREADABLE, 'materials')):
            outcome = self.refused(code, 'unwrap', mesh, '-o', self.path('x.obj'), '--texel-density', self.write('d.json', text))
            self.assertIn(says, outcome.err)
        for word in ('0', 'nan', 'no_such_file'):
            self.refused(USAGE, 'unwrap', mesh, '-o', self.path('x.obj'), '--texel-density', word)


class LinesOfAnObj(LayoutTest):
    BLOCKS = '''# made by hand
# cones of the rocket
# cone vertex 3 quarter_turns 3, as it should be
mtllib sub/a.mtl
o first
v 0 0 0
v 1 0 0
v 0 1 0
usemtl red
# three corners
f 1 2 3
o second
v 5 0 0
v 6 0 0
v 6 1 0
v 5 1 0
g wall
f 4 5 6
f 4 6 7
# the end
'''

    def test_comments_and_blocks_stay_in_order(self):
        self.run_ok('unwrap', self.write('b.obj', self.BLOCKS), '-o', self.path('out.obj'))
        lines = [line for line in without_mark(self.read('out.obj')).decode().splitlines()
                 if not line.startswith('vt ')]
        kept = [line if not line.startswith('f ') else 'f ' + ' '.join(w.split('/')[0] for w in line.split()[1:])
                for line in lines]
        self.assertEqual(kept, self.BLOCKS.splitlines())

    def test_a_header_stays_above_the_vertices(self):
        text = self.BLOCKS[:self.BLOCKS.index('o second')]
        self.run_ok('unwrap', self.write('b.obj', text), '-o', self.path('out.obj'))
        lines = without_mark(self.read('out.obj')).decode().splitlines()
        self.assertEqual(lines[:6], text.splitlines()[:6])

    def test_texture_coordinates_stand_before_faces_that_use_them(self):
        self.run_ok('unwrap', self.write('b.obj', self.BLOCKS), '-o', self.path('out.obj'))
        seen = {'v': 0, 'vt': 0}
        for line in self.read('out.obj').decode().splitlines():
            word, *rest = line.split()
            if word in seen:
                seen[word] += 1
            if word == 'f':
                for corner in rest:
                    v, t = corner.split('/')
                    self.assertLessEqual(int(v), seen['v'])
                    self.assertLessEqual(int(t), seen['vt'])

    def test_a_group_for_every_chart(self):
        points, faces = tetrahedra(3)
        text = obj_text(points, faces).replace('f ', 'g metal\nf ', 1)
        layout, _ = self.unwrap(self.write('g.obj', text), '--groups')
        group, found = None, []
        for line in layout.text.splitlines():
            if line.startswith('g '):
                group = line
            if line.startswith('f '):
                found.append(group)
        for k, chart in enumerate(layout.charts):
            self.assertEqual({found[f] for f in chart}, {'g metal chart_%d' % k})
        outcome = self.refused(USAGE, 'unwrap', self.path('g.obj'), '--groups', '-o', self.path('x.vtu'))
        self.assertIn('add -o OUT.obj', outcome.err)

    def test_material_files_elsewhere_are_refused(self):
        points, faces = tetrahedra(1)
        for name in ('../a.mtl', '/etc/a.mtl', 'sub/../../a.mtl', '..\\a.mtl', 'C:\\a.mtl'):
            mesh = self.write('m.obj', 'mtllib %s\n' % name + obj_text(points, faces))
            for verb in ('unwrap',):
                outcome = self.refused(UNSUPPORTED, verb, mesh, '-o', self.path('x.obj'))
                self.assertIn('mtllib', outcome.err)
                self.assertEqual(outcome.err.count('\n'), 1)
            self.run_ok('unwrap', mesh, '-o', self.path('x.vtu'))  # which names no groups
        self.run_ok('unwrap', self.write('m.obj', 'mtllib sub/my own.mtl\n' + obj_text(points, faces)), '-o',
                    self.path('x.obj'))


def area_of(corners):
    """Returns the area of a triangle in space."""
    a, b, c = corners
    e, f = [y - x for x, y in zip(a, b)], [y - x for x, y in zip(a, c)]
    ee, ef, ff = (sum(x * y for x, y in zip(s, t)) for s, t in ((e, e), (e, f), (f, f)))
    return math.sqrt(max(ee * ff - ef * ef, 0)) / 2


if __name__ == '__main__':
    main()
