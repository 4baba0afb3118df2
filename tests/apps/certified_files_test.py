# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Files written with exit code 0 or 4 are valid; other files do not exist."""
import json
from fractions import Fraction

from command_helpers import *


def flipped(path):
    """Returns faces of a textured OBJ without positive area, exactly by its digits (polygons: by ears)."""
    with open(path) as f:
        lines = [line.split() for line in f]
    vt = [tuple(map(Fraction, words[1:3])) for words in lines if words and words[0] == 'vt']

    def turn(a, b, c):
        return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])

    def is_positive(corners):
        corners = list(corners)
        while len(corners) > 3:
            for k in range(len(corners)):
                a, b, c = corners[k - 1], corners[k], corners[(k + 1) % len(corners)]
                if turn(a, b, c) > 0 and not any(
                        p not in (a, b, c) and min(turn(a, b, p), turn(b, c, p), turn(c, a, p)) >= 0
                        for p in corners):
                    del corners[k]
                    break
            else:
                return False
        return turn(*corners) > 0

    faces = [[vt[int(w.split('/')[1]) - 1] for w in words[1:]]
             for words in lines if words and words[0] == 'f']
    return sum(not is_positive(face) for face in faces)


def tube(sides, rings):
    """Returns an open prism of squares with a cap, whose map has triangles of very different sizes."""
    points, faces = [], []
    for j in range(rings + 1):
        for i in range(sides):
            a = 2 * math.pi * i / sides
            points.append((math.cos(a), math.sin(a), 0.9 * j))
    for j in range(rings):
        for i in range(sides):
            a, b = j * sides + i, j * sides + (i + 1) % sides
            faces += [(a, b, b + sides), (a, b + sides, a + sides)]
    points.append((0, 0, 0.9 * rings + 0.3))
    last = rings * sides
    faces += [(last + i, last + (i + 1) % sides, len(points) - 1) for i in range(sides)]
    return points, faces


class DefaultDegree(CommandTest):
    def degree(self, verb, mesh, *outputs, options=()):
        args = [a for o in outputs for a in ('-o', self.path(o))]
        self.run_ok(verb, '--quiet', mesh, *args, *options, '--report', self.path('r.json'))
        with open(self.path('r.json')) as f:
            return json.load(f)['result']['degree']

    def test_one_where_all_data_are_straight(self):
        mesh = generated('cap')
        self.assertEqual(self.degree('parametrize', mesh, 'a.obj'), 1)
        self.assertEqual(self.degree('parametrize', mesh, 'a.obj', 'a.svg', 'a.csv', 'a.json'), 1)
        self.assertEqual(self.degree('parametrize', mesh, 'a.obj', 'a.vtu'), 3)
        self.assertEqual(self.degree('parametrize', mesh, 'a.vtu'), 3)
        self.assertEqual(self.degree('parametrize', mesh, 'a.svg'), 3)
        self.assertEqual(self.degree('parametrize', mesh, 'a.obj', options=['--degree', '2']), 2)
        self.assertEqual(self.degree('seamless', generated('buckle'), 'a.obj'), 1)

    def test_the_mesh_comes_back(self):
        points, faces = quads(6)
        text = obj_text(points, faces)
        head, tail = text.split('\nf ', 1)
        grouped = head + '\nmtllib a.mtl\ng first\nusemtl red\nf ' + tail.replace(
            '\nf ', '\ng second\nusemtl blue\nf ', 1)
        mesh = self.write('in.obj', grouped)
        self.run_ok('parametrize', '--quiet', mesh, self.path('out.obj'))
        v, _, out, texture = read_obj(self.path('out.obj'))
        self.assertEqual((v, out), (points, [tuple(f) for f in faces]))
        self.assertEqual([len(t) for t in texture], [4] * len(faces))
        for line in ('mtllib a.mtl', 'g first', 'usemtl red', 'g second', 'usemtl blue'):
            self.assertEqual(self.read('out.obj').decode().count('\n%s\n' % line), 1)
        self.assertEqual(flipped(self.path('out.obj')), 0)
        self.run_ok('check', self.path('out.obj'), '--surface', mesh)


class Certified(CommandTest):
    def test_curved_maps_in_straight_files(self):
        # If every cell is sampled on a lattice, pieces of the creature's cubic map turn over.
        out = self.path('out.obj')
        for options in (['--degree', '3'], ['--degree', '4', '--refine', '2'],
                        ['--degree', '3', '--normalize']):
            self.run_ok('parametrize', '--quiet', generated('creature'), '-o', out, *options)
            self.assertEqual(flipped(out), 0)
            self.run_ok('check', out, '--surface', generated('creature'))

    def test_polygons_that_are_not_flat(self):
        mesh = self.write('quads.obj', obj_text(*quads(5)))
        for options in (['--refine', '2'], ['--degree', '3', '--refine', '2']):
            self.run_ok('parametrize', '--quiet', mesh, '-o', self.path('out.obj'), *options)
            self.assertEqual(flipped(self.path('out.obj')), 0)
            self.run_ok('check', self.path('out.obj'), '--surface', mesh)

    def test_far_from_the_origin(self):
        points, faces = grid(5)
        far = [(x + 1e6, y - 1e6, z + 1e6) for x, y, z in points]
        mesh = self.write('far.obj', obj_text(far, faces))
        self.run_ok('parametrize', '--quiet', mesh, '-o', self.path('out.obj'), '--refine', '3')
        self.run_ok('check', self.path('out.obj'), '--surface', mesh)

    def test_bijective_in_straight_files(self):
        out = self.path('out.obj')
        self.run_ok('parametrize', '--quiet', generated('ribbon'), '-o', out, '--degree', '3',
                    '--bijective')
        self.assertEqual(flipped(out), 0)
        self.run_ok('check', out, '--surface', generated('ribbon'), '--certify')

    def test_normalized_tubes(self):
        # Moving the layout would lose the smallest triangles of these maps: files are refused, or valid.
        codes = set()
        for sides, rings in ((4, 40), (4, 48), (5, 50)):
            mesh = self.write('tube.obj', obj_text(*tube(sides, rings)))
            for energy in ('mips', 'asap'):
                for name in ('vtu', 'obj'):
                    out = self.path('out.' + name)
                    outcome = majorant('parametrize', '--quiet', mesh, '-o', out, '--degree', '1',
                                       '--boundary', 'fixed', '--energy', energy, '--normalize')
                    self.assertIn(outcome.code, (OK, LIMIT, INVALID), outcome.err)
                    codes.add(outcome.code)
                    if outcome.code == INVALID:
                        # The proof of the moved layout refuses it or, at the limit of digits, that of the file.
                        self.assertRegex(outcome.err, '--normalize|is not written, since')
                        self.assertFalse(os.path.exists(out))
                        continue
                    self.run_ok('check', out, '--surface', mesh)
                    os.remove(out)
        self.assertIn(INVALID, codes)  # otherwise this test has tested nothing

    def test_normalized_results_pass_their_own_check(self):
        for name, options in (('cap', ['--energy', 'mips']), ('tube', []), ('wavy_disk', [])):
            for degree in ('1', '3'):
                for out in ('out.vtu', 'out.obj'):
                    self.run_ok('parametrize', '--quiet', generated(name), '-o', self.path(out),
                                '--normalize', '--degree', degree, *options)
                    self.run_ok('check', self.path(out), '--surface', generated(name))

    def test_invalid_maps_are_not_converted(self):
        self.run_ok('parametrize', '--quiet', generated('cap'), '-o', self.path('good.vtu'))
        vtu = Vtu(self.path('good.vtu'))
        vtu.arrays['uv'][2 * vtu.cells()[200][-1]] += 3
        bad = vtu.write(self.path('bad.vtu'))
        outcome = majorant('convert', bad, '-o', self.path('a.vtu'), '-o', self.path('a.svg'), '-o',
                           self.path('a.obj'))
        self.assertEqual(outcome.code, INVALID, outcome.err)
        self.assertIn('cell 200', outcome.err)
        # Pictures show defects. The straight triangles between the cells' corners are valid.
        self.assertIn('written: %s, %s' % (self.path('a.svg'), self.path('a.obj')), outcome.err)
        self.assertEqual(self.files(), ['a.obj', 'a.svg', 'bad.vtu', 'good.vtu'])
        self.assertEqual(flipped(self.path('a.obj')), 0)
        self.run_ok('check', self.path('a.obj'), '--surface', generated('cap'))


if __name__ == '__main__':
    main()
