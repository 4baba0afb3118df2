# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Overlaps are always searched for: their mention in the summary line, the report and `check`. An overlap is no
violation unless bijectivity was requested."""
import json

from command_helpers import *


def times_covered(p, triangles):
    def side(a, b):
        return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
    return sum(min(side(a, b), side(b, c), side(c, a)) > 0 for a, b, c in triangles)


class Overlaps(CommandTest):
    def run_and_check(self, verb, mesh, *args, code=OK):
        """Returns the lines of the run and of check, and the result sections of both reports."""
        out, report = self.path('out.vtu'), self.path('report.json')
        run = self.run_ok(verb, mesh, '-o', out, '--report', report, '--force', *args, code=code)
        with open(report) as f:
            made = json.load(f)['result']
        checked = self.run_ok('check', out, '--report', report, *(['--cuts', 'free'] if verb == 'unwrap' else []))
        with open(report) as f:
            found = json.load(f)['result']
        self.assertIn(made['overlaps'], '\n'.join(run.printed()))
        self.assertIn(found['overlaps'], checked.printed()[-1])
        return made, found

    def test_an_overlap_is_named_and_no_violation(self):
        mesh = self.write('ramp.obj', obj_text(*ramp(1.3)))
        for degree in (1, 2, 3):
            for result in self.run_and_check('parametrize', mesh, '--degree', degree):
                self.assertIs(result['globally_injective'], False)
                self.assertTrue(result['overlaps'].startswith('locally injective, overlaps itself near ('))
                near = tuple(map(float, re.search(r'near \((.*), (.*)\)', result['overlaps']).groups()))
                self.assertLess(math.dist(near, result['boundary']['covered_twice']), 1e-4)
                self.assertTrue(result['boundary']['contacts'])
            if degree > 1:
                continue
            map_, p = Vtu(self.path('out.vtu')), result['boundary']['covered_twice']
            uv = map_.rows('uv')
            self.assertGreaterEqual(times_covered(p, [[uv[v] for v in cell] for cell in map_.cells()]), 2)
        self.found(self.path('out.vtu'), '--certify', says='not globally injective')

    def test_inverted_maps_are_not_called_injective(self):
        self.run_ok('parametrize', self.write('ramp.obj', obj_text(*ramp(1.3))), '-o', self.path('a.vtu'),
                    '--degree', 1)
        vtu = Vtu(self.path('a.vtu'))
        inner = 3 * 10 + 1
        vtu.arrays['uv'][vtu.components['uv'] * inner] += 0.6
        self.run_ok('check', vtu.write(self.path('b.vtu')), '--report', self.path('b.json'), code=INVALID)
        result = json.loads(self.read('b.json'))['result']
        self.assertEqual((result['locally_injective'], result['globally_injective']), (False, False))
        self.assertTrue(result['overlaps'].startswith('not locally injective, overlaps itself near ('),
                        result['overlaps'])

    def test_no_overlap(self):
        for mesh, flags in ((self.write('grid.obj', obj_text(*grid(5))), []),
                            (self.write('ramp.obj', obj_text(*ramp(1.3))), ['--bijective'])):
            for degree in (1, 3):
                for result in self.run_and_check('parametrize', mesh, '--degree', degree, *flags):
                    self.assertIs(result['globally_injective'], True)
                    self.assertEqual(result['overlaps'], 'no overlaps')
                    self.assertIsNone(result['boundary']['covered_twice'])
                    self.assertIs(result['boundary']['contacts_complete'], True)

    def test_pictures_have_the_words_of_the_report(self):
        """Pictures use the words of the report; places refer to the file, even if the picture is turned."""
        for bend, kept in ((1.3, True), (0.3, False)):
            mesh = self.write('ramp.obj', obj_text(*ramp(bend)))
            self.run_ok('parametrize', mesh, '--degree', 2, '-o', self.path('a.svg'), '-o', self.path('a.png'),
                        '-o', self.path('a.vtu'), '--report', self.path('r.json'), '--force')
            words = json.loads(self.read('r.json'))['result']['overlaps'].removeprefix('locally injective, ')
            drawing = self.read('a.svg').decode()
            self.assertEqual('>%s</text>' % words in drawing, kept)
            self.assertEqual('stroke="#e6007a"' in drawing, kept)
            self.run_ok('convert', self.path('a.vtu'), '-o', self.path('b.svg'), '-o', self.path('b.png'))
            self.assertEqual(self.read('b.svg').decode(), drawing)
            self.assertEqual(self.read('b.png'), self.read('a.png'))

    def test_limits_do_not_skip_the_overlap_test(self):
        mesh = self.write('ramp.obj', obj_text(*ramp(1.3)))
        for flags in (['--time-limit', 0], ['--max-iterations', 2]):
            made, found = self.run_and_check('parametrize', mesh, '--init', 'tutte', *flags, code=LIMIT)
            self.assertIs(made['globally_injective'], True)  # Tutte's map or nearly so
            self.assertEqual(made['overlaps'], found['overlaps'])

    def test_deform(self):
        points, faces = ramp(1.3)
        flat = self.write('flat.obj', obj_text([(x, y, 0) for x, y, _ in points], faces))
        pins = self.write('pins.json', '{"handles": [{"vertex": 0, "target": "initial"}]}')
        for result in self.run_and_check('deform', flat, '--pins', pins, '--degree', 1):
            self.assertIs(result['globally_injective'], False)
            self.assertIn('overlaps itself near', result['overlaps'])

    def test_boundaries_that_touch(self):
        """Two adjacent squares without common vertices: nothing is covered twice, and no overlap is reported."""
        uv = [(0, 0), (1, 0), (1, 1), (0, 1), (1, 0), (2, 0), (2, 1), (1, 1)]
        points = [(x, y, 0) for x, y in uv[:4]] + [(x + 3, y, 0) for x, y in uv[4:]]
        faces = [(0, 1, 2), (0, 2, 3), (4, 5, 6), (4, 6, 7)]
        touching = self.write('touching.obj', obj_text(points, faces, uv))
        self.assertIn('touches or overlaps itself near (1, ', self.run_ok('check', touching).out)
        overlapping = self.write('overlapping.obj', obj_text(
            points, faces, uv[:4] + [(u - 0.25, v) for u, v in uv[4:]]))
        self.assertRegex(self.run_ok('check', overlapping).out,
                         r'valid, degree 1: locally injective, overlaps itself near \(\S+ \S+\), '
                         r'4 of 4 faces lie on others, 25 % of the layout[,;]')
        self.assertIn(', 4 of 4 faces lie on others, 25 % of the layout\n', self.found(overlapping, '--certify').out)
        self.assertNotIn('lie on others', self.run_ok('check', touching).out)
        inside = self.write('inside.obj', obj_text(
            points, faces, uv[:4] + [(0.25 * u, 0.25 * v + 0.6) for u, v in uv[4:]]))
        self.run_ok('check', inside, '--report', self.path('r.json'))
        self.assertIn('one component lies inside another', self.run_ok('check', inside).out)
        extent = json.loads(self.read('r.json'))['result']['overlap']
        self.assertEqual(extent['faces'], 3)
        self.assertAlmostEqual(extent['share'], 2 / 17, delta=1e-12)

    def test_unwrap(self):
        for result in self.run_and_check('unwrap', generated('buckle')):
            self.assertIs(result['globally_injective'], True)
            self.assertEqual(result['overlaps'], 'no overlaps')
        made, found = self.run_and_check('unwrap', generated('buckle'), '--seams', 'sharp=20', '--no-pack')
        self.assertGreater(made['charts'], 1)
        self.assertIs(made['globally_injective'], False)
        self.assertTrue(made['overlaps'].startswith('each chart without overlaps, the layout overlaps itself near ('))
        self.assertIs(found['globally_injective'], False)

    def test_seams_and_cones(self):
        """The image of a surface that is cut at seams winds around cones, which is no violation."""
        for result in self.run_and_check('seamless', generated('buckle'), '--degree', 1):
            self.assertGreater(len(result['cones']), 0)
            self.assertIs(result['globally_injective'], False)
            self.assertIn('cut open along its seams it overlaps itself near (', result['overlaps'])
            self.assertIn('as maps with cones may', result['overlaps'])


if __name__ == '__main__':
    main()
