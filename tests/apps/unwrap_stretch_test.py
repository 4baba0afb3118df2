# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""The stretch of charts of majorant unwrap, measured from the digits of its files."""
import json

from command_helpers import *
from hard_surfaces import family, open_box
from stretch import stretches
from unwrap_helpers import *

MOST = 1.015


class StretchLimit(UnwrapTest):
    def kept(self, mesh, *flags, limit=MOST):
        _, report = self.unwrap(mesh, *flags)
        self.run_ok('unwrap', mesh, self.path('out.vtu'), *flags)
        found = stretches(self.path('out.vtu'))
        self.assertLessEqual(max(found), limit)
        self.assertEqual(len(found), len(report['charts']))
        for mine, chart in zip(found, report['charts']):
            self.assertAlmostEqual(mine, chart['stretch_l2'], places=9)
        return report

    def test_an_open_box_of_five_quads(self):
        report = self.kept(self.mesh(*open_box(1, 1, 1, 1)))
        self.assertEqual(report['result']['charts'], 1)
        self.assertAlmostEqual(report['result']['value'], 4, places=6)
        self.assertAlmostEqual(report['result']['seam_length'], 4, places=6)

    def test_one_of_eleven_of_the_family(self):
        for k, (name, points, faces) in enumerate(family()):
            if k % 11 == 3 and len(faces) < 1500:
                with self.subTest(name):
                    self.kept(self.mesh(points, faces))

    def test_smooth_surfaces(self):
        for mesh in (sphere(6), torus(24, 12, 0), grid(9, lambda x, y: 0.6 * math.sin(6 * x) * math.cos(5 * y))):
            self.kept(self.mesh(*mesh))
            self.kept(self.mesh(*mesh), '--max-stretch', 1.003, limit=1.003)
        self.kept(self.mesh(*sphere(6)), '--seams', 'sharp=20')

    def test_curved_maps(self):
        mesh = self.mesh(*open_box(2, 1, 1, 1))
        self.run_ok('unwrap', mesh, '-o', self.path('o.vtu'), '--degree', 3, '--report', self.path('r.json'))
        with open(self.path('r.json')) as f:
            self.assertLessEqual(max(c['stretch_l2'] for c in json.load(f)['charts']), MOST)

    def test_given_seams_are_not_extended(self):
        points, faces = open_box(1, 1, 1, 1)
        mesh, none = self.mesh(points, faces), self.write('none.json', '{"edges": []}')
        with_uv = self.mesh(points, triangles(faces), [(p[0], p[1] + 2 * p[2]) for p in points], 'uv.obj')
        for path, flags in ((mesh, ['--seams', none]), (with_uv, ['--seams', 'uv'])):
            _, report = self.unwrap(path, *flags)
            self.assertEqual(report['result']['charts'], 1)
            self.assertGreater(report['charts'][0]['stretch_l2'], MOST)
            self.assertNotIn('--max-stretch', self.run_ok('unwrap', path, self.path('o.obj'), *flags).err)
        points, faces = sphere(2)
        spike = self.mesh([(5, 1, 1)] + points[1:], faces)  # the estimate of its stretch is too small
        self.kept(spike)
        _, report = self.unwrap(spike, '--charts', 'one')
        self.assertEqual(report['result']['charts'], 1)
        self.assertGreater(report['charts'][0]['stretch_l2'], MOST)

    def test_no_time(self):
        outcome = self.run_ok('unwrap', self.mesh(*open_box(1, 1, 1, 1)), self.path('o.obj'), '--time-limit', 0,
                              code=LIMIT)
        self.assertEqual(outcome.err.count('more than --max-stretch 1.015: time_limit'), 1, outcome.err)


if __name__ == '__main__':
    main()
