# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""The position of unwrap's layout: in the unit square with a border, in every format; or in units of the mesh."""
import json
import math

from command_helpers import *
from unwrap_helpers import *


class Placement(UnwrapTest):
    def report(self, name='r.json'):
        return json.loads(self.read(name))

    def scaled(self, factor):
        points, faces = both(sphere(3), torus(12, 8, 0))
        return self.mesh([tuple(factor * x for x in p) for p in points], faces)

    def test_straight_charts_lie_along_the_square(self):
        """The smallest box around a cross is at 45 degrees."""
        squares = [(1, 0), (0, 1), (1, 1), (2, 1), (1, 2)]
        number, faces = {}, []
        for x, y in squares:
            faces.append(tuple(number.setdefault(p, len(number))
                               for p in ((x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1))))
        turned = [(0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y, 0.0) for x, y in number]
        layout, _ = self.unwrap(self.mesh(turned, faces), '--padding', '2')
        for a, b in layout.outline(layout.charts[0]):
            along = [abs(x - y) / layout.scale for x, y in zip(a, b)]
            self.assertLess(min(along), 1e-9)

    def test_a_border_as_wide_as_the_padding(self):
        """The width by the digits, for one chart and many, and meshes of any size."""
        for factor, padding, resolution in [(1, 4, 1024), (57.7, 16, 512), (1e-5, 0, 1024), (1e4, 60, 256)]:
            with self.subTest(factor=factor, padding=padding):
                self.run_ok('unwrap', self.scaled(factor), '-o', self.path('a.obj'), '--padding', padding,
                            '--resolution', resolution)
                layout = Layout(self.path('a.obj'))
                uv = [[x / layout.scale for x in p] for p in layout.uv]
                border = padding / resolution
                low, high = (f(x for p in uv for x in p) for f in (min, max))
                self.assertGreaterEqual(low, border - 1e-12)
                self.assertLessEqual(high, 1 - border + 1e-12)
                self.assertLess(low - border, 1e-9)  # the border is no wider
                for axis in (0, 1):  # the larger side fills the square
                    span = max(p[axis] for p in uv) - min(p[axis] for p in uv)
                    if abs(span - (1 - 2 * border)) < 1e-9:
                        break
                else:
                    self.fail('the layout does not fill its square')

    def test_panels_whose_cuts_close_again_are_written(self):
        """A coarse torus of flat panels: coinciding sides of a cut are separated by rounding only."""
        mesh = self.mesh(*both(sphere(3), torus(8, 6, 0)))
        self.run_ok('unwrap', mesh, '-o', self.path('a.obj'), '--padding', 60, '--resolution', 256)

    def test_one_chart_has_a_border_too(self):
        self.run_ok('unwrap', generated('creature'), '-o', self.path('a.obj'), '--padding', 32)
        layout = Layout(self.path('a.obj'))
        low = min(x / layout.scale for p in layout.uv for x in p)
        self.assertAlmostEqual(low, 32 / 1024, places=9)

    def test_every_format_has_the_same_layout(self):
        names = ['a.obj', 'a.ply', 'a.vtu', 'a.msh', 'a.glb', 'a.gltf']
        outputs = [word for name in names for word in ('-o', self.path(name))]
        mesh = self.scaled(20)
        self.run_ok('unwrap', mesh, *outputs)
        for name in names[1:]:
            with self.subTest(name):
                self.run_ok('convert', self.path(name), '-o', self.path('b.obj'))
                one, other = Layout(self.path('a.obj')), Layout(self.path('b.obj'))
                for k in (0, 1):
                    ends = [[f(p[k] / layout.scale for p in layout.uv) for f in (min, max)] for layout in (one, other)]
                    for x, y in zip(*ends):
                        self.assertAlmostEqual(x, y, places=6)

    def test_energies_are_those_at_the_size_of_the_mesh(self):
        mesh = self.scaled(57.7)
        reports = {}
        for scale in ('unit', 'model'):
            self.run_ok('unwrap', mesh, '-o', self.path(scale + '.vtu'), '--scale', scale, '--report',
                        self.path('r.json'))
            reports[scale] = self.report()['result']
        for key in ('value', 'sigma_max', 'sigma_min', 'max_density', 'min_det_bound', 'stretch_l2', 'fill', 'side'):
            self.assertAlmostEqual(reports['unit'][key], reports['model'][key], places=9, msg=key)
        self.assertEqual(reports['model']['layout_scale'], 1)
        self.assertAlmostEqual(reports['unit']['layout_scale'] * reports['unit']['side'], 1, places=9)

    def test_check_divides_by_the_scale(self):
        mesh = self.scaled(57.7)
        self.run_ok('unwrap', mesh, '-o', self.path('a.vtu'), '-o', self.path('a.obj'), '--report', self.path('r.json'))
        result = self.report()['result']
        for name, assumed in (('a.vtu', False), ('a.obj', True)):
            printed = self.run_ok('check', self.path(name), '--surface', mesh, '--certify', '--report', self.path('c.json'))
            found = self.report('c.json')['result']
            self.assertAlmostEqual(found['value'], result['value'], delta=1e-3 * result['value'])
            self.assertEqual(found['scale_is_assumed'], assumed)
            self.assertEqual('best scale' in printed.out, assumed)
            self.assertAlmostEqual(found['layout_scale'] / result['layout_scale'], 1, delta=0.05 if assumed else 1e-12)

    def test_a_claimed_scale_that_is_not_so(self):
        self.run_ok('unwrap', self.scaled(3), '-o', self.path('a.vtu'))
        for changes, says in ((dict(layout_scale=2), 'layout_scale'), (dict(normalized=None), ''),
                              (dict(normalized=None, layout_scale=2), 'energy')):
            file = Vtu(self.path('a.vtu'))
            if 'layout_scale' in changes:
                changes['layout_scale'] *= file.claims['layout_scale']
            file.claims.update(changes)
            file.write(self.path('b.vtu'))
            if says:
                self.found(self.path('b.vtu'), says=says)
            else:
                self.run_ok('check', self.path('b.vtu'))

    def test_points_keep_the_units_of_the_mesh(self):
        points, faces = grid(4, lambda x, y: 0)
        mesh = self.mesh(points, faces)
        pins = self.write('pins.json', json.dumps({'handles': [{'vertex': 0, 'target': [3, 4]},
                                                               {'vertex': 4, 'target': [4, 4]}]}))
        self.run_ok('unwrap', mesh, '-o', self.path('a.obj'), '--pins', pins, '--report', self.path('r.json'))
        self.assertEqual(self.report()['result']['layout_scale'], 1)
        self.refused(USAGE, 'unwrap', mesh, '-o', self.path('b.obj'), '--pins', pins, '--scale', 'unit',
                     says=['--scale unit', 'pins'])
        self.refused(USAGE, 'unwrap', mesh, '-o', self.path('b.obj'), '--normalize', '--scale', 'model',
                     says='--normalize')

    def test_parametrize_keeps_the_units_of_the_mesh(self):
        self.run_ok('parametrize', generated('cap'), '-o', self.path('a.vtu'), '--degree', 1, '--report',
                    self.path('r.json'))
        self.assertEqual(self.report()['result']['layout_scale'], 1)

    def test_padding_that_leaves_no_square(self):
        outcome = self.run_ok('unwrap', generated('cap'), '-o', self.path('a.obj'), '--padding', 512,
                              code=USAGE)
        self.assertIn('lower the one or raise the other', outcome.err.splitlines()[-1])
        self.assertFalse(os.path.exists(self.path('a.obj')))


if __name__ == '__main__':
    unittest.main()
