# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Files written with exit code 0 are valid by check, and the statements of check are true."""
import random

from command_helpers import *
from unwrap_helpers import both, cube


def times(factor, points):
    return [tuple(factor * x for x in p) for p in points]


class Sizes(CommandTest):
    def test_lengths_whose_squares_underflow(self):
        points, faces = grid(4)
        for size in (1e-80, 1e-120, 1e-150):
            mesh = self.write('in.obj', obj_text(times(size, points), faces))
            for verb, degree in (('parametrize', '1'), ('parametrize', '2'), ('unwrap', '1')):
                for more in ([], ['--normalize']):
                    with self.subTest(size=size, verb=verb, degree=degree, more=more):
                        outputs = [self.path('a' + end) for end in ('.vtu', '.obj')]
                        self.run_ok(verb, '--quiet', mesh, '--degree', degree, *more,
                                    *(w for o in outputs for w in ('-o', o)))
                        for out in outputs:
                            self.run_ok('check', out)
                            self.run_ok('check', out, '--surface', mesh)

    def test_charts_of_any_size_that_are_not_packed(self):
        points, faces = cube(2)
        for size in (1e-90, 1e40):
            mesh = self.write('in.obj', obj_text(times(size, points), faces))
            self.run_ok('unwrap', '--quiet', mesh, '-o', self.path('a.vtu'), '--no-pack')
            self.run_ok('check', self.path('a.vtu'), '--surface', mesh)

    def test_charts_far_smaller_than_others(self):
        """Claims have the measures of the packed and rounded charts."""
        large = [(0, 0, 0), (100, 0, 3), (0, 100, 7)], [(0, 1, 2)]
        shape = [(0, 0, 0), (1, 0.1, 0.3), (0.2, 1, 0.7), (1.3, 1.4, 0.1)], [(0, 1, 2), (1, 3, 2)]
        for size in (1e-5, 1e-7, 1e-9, 1e-10):
            small = times(size, shape[0]), shape[1]
            mesh = self.write('in.obj', obj_text(*both(large, small, (3, 5, 7))))
            for degree in ('1', '3'):
                for more in ([], ['--normalize']):
                    with self.subTest(size=size, degree=degree, more=more):
                        self.run_ok('unwrap', '--quiet', mesh, '-o', self.path('a.vtu'), '--degree',
                                    degree, *more)
                        self.run_ok('check', self.path('a.vtu'), '--surface', mesh)


class Polygons(CommandTest):
    """check --surface of layouts whose polygons became triangles, or other triangles than those of their shape."""

    def layout_is_valid(self, points, faces, uv=None, *flags):
        mesh = self.write('in.obj', obj_text(points, faces, uv))
        outputs = [self.path('a' + end) for end in ('.vtu', '.obj', '.ply')]
        self.run_ok('unwrap', '--quiet', mesh, *flags, *(w for o in outputs for w in ('-o', o)))
        for out in outputs:
            self.run_ok('check', out, '--surface', mesh)
        return outputs

    def test_quads_that_became_triangles(self):
        points, faces = quads(2)
        a, b, c, d = faces[1]
        count = 0
        for face in ((a, b, c), (c, b, a), (a, b, d), (d, b, a)):  # a half of a quad is repeated
            outputs = self.layout_is_valid(points, [face] + faces)
            count += len(read_obj(outputs[1])[2]) == len(faces) + 2  # one quad became two triangles
            text = self.read('a.obj').decode().splitlines()
            first = next(k for k, line in enumerate(text) if line.startswith('f '))
            shuffled = text[:first] + text[first:][::-1]
            self.run_ok('check', self.write('b.obj', '\n'.join(shuffled) + '\n'), '--surface',
                        self.path('in.obj'))
            self.run_ok('check', self.write('b.obj', '\n'.join(text[:-1]) + '\n'), '--surface',
                        self.path('in.obj'), code=INVALID)
        self.assertEqual(count, 2)

    def test_faces_that_repair_turned(self):
        points, faces = quads(2)
        self.layout_is_valid(points, faces[:3] + [faces[3][::-1]])
        self.layout_is_valid(points, [faces[0][::-1]] + faces[1:] + [faces[1][:3]])

    def test_diagonals_that_old_coordinates_chose(self):
        """Quads that are reflex in space at one corner, and in the texture at the next one."""
        points = [(0, 0, 0), (2, 0, 0.1), (0.4, 0.4, 0), (0, 2, 0.1)]
        texture = [(0, 0), (0.8, 0.5), (2, 0), (1, 2)]
        self.layout_is_valid(points, [(0, 1, 2, 3)], texture, '--seams', 'uv')
        self.layout_is_valid(points, [(0, 1, 2, 3)], texture)


    def unwrapped(self, points, faces, *flags, uv=None, names=('.vtu', '.obj', '.ply', '.glb')):
        """Writes and judges every format; returns the OBJ and the report."""
        mesh = self.write('in.obj', obj_text(points, faces, uv))
        outputs = [self.path('a' + end) for end in names]
        outcome = self.run_ok('unwrap', mesh, *flags, '--force', '--report', self.path('r.json'),
                              *(w for o in outputs for w in ('-o', o)))
        for out in outputs:
            self.run_ok('check', out, '--surface', mesh, '--certify')
        with open(self.path('r.json')) as f:
            return read_obj(self.path('a.obj')), json.load(f), outcome.err

    def test_quads_that_share_two_edges(self):
        """Two quads that are cut along the diagonal between these edges have the same triangle."""
        points = [(-0.1, 0.2, -0.1), (0, -1, 0), (0, -0.8, 0.9), (0.7, 0.5, 0.6), (-0.7, 0.3, 0.6)]
        texture = [(1, 1.9), (0.6, 0), (0.8, -1.6), (2.8, 0.1), (-1.1, 0)]
        faces = [(1, 2, 3, 0), (4, 2, 1, 0)]
        self.unwrapped(points, faces, uv=texture)
        self.unwrapped(points, faces)
        self.unwrapped(points, faces, '--seams', 'uv', uv=texture)

    def test_corners_at_one_place(self):
        """Polygons with coinciding corners, in any order of their numbers."""
        rng = random.Random(5)
        for number in range(6):
            places = [(math.cos(k), math.sin(k), 0) for k in range(6)]
            points, ring = [], []
            for place in places:
                ring.append([len(points) + k for k in range(rng.choice((1, 2, 3)))])
                points += [place] * len(ring[-1])
            points += [(3, 0, 0.2), (3, 1, 0.2)]
            first = [v for corner in ring for v in corner]
            second = (ring[0] + ring[1])[::-1] + [len(points) - 2, len(points) - 1]
            order = rng.sample(range(len(points)), len(points))
            faces = [tuple(order.index(v) for v in face) for face in (first, second)]
            with self.subTest(number=number):
                self.unwrapped([points[v] for v in order], faces, names=('.vtu', '.obj', '.ply'))

    def test_weld_that_leaves_faces_without_area(self):
        """Two quads of six corners at one place, beside faces with an area."""
        points, faces = quads(1)
        count = len(points)
        points = points + [points[0]] * 6
        for more in ([], faces):
            flakes = [tuple(count + k for k in (0, 1, 2, 3)), tuple(count + k for k in (3, 2, 4, 5))]
            mesh = self.write('in.obj', obj_text(points, more + flakes))
            outputs = [self.path('a' + end) for end in ('.vtu', '.obj', '.ply')]
            self.run_ok('unwrap', mesh, '--weld', '0.0001', '--force', *(w for o in outputs for w in ('-o', o)))
            for out in outputs:
                self.run_ok('check', out, '--certify')

    def test_polygons_are_whole_however_they_are_cut(self):
        """A quad that is convex in space and folds along one of its diagonals is written as triangles."""
        points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
        folded = [(0, 0), (1, 0), (0.25, 0.25), (0, 1)]
        other = [(1, 0), (0.25, 0.25), (0, 1), (0, 0)]
        self.run_ok('check', self.write('a.obj', obj_text(points, [(0, 1, 2, 3)], folded)))
        self.found(self.write('b.obj', obj_text(points, [(0, 1, 2, 3)], other)),
                   says='positive: face 0 folds where programs cut it')
        for texture in (folded, other):
            mesh = self.write('c.obj', obj_text(points, [(0, 1, 2, 3)], texture))
            self.run_ok('unwrap', mesh, '-o', self.path('d.obj'), '--seams', 'uv', '--keep-shape', '--force', '--report',
                        self.path('r.json'))
            self.assertEqual([len(f) for f in read_obj(self.path('d.obj'))[2]], [3, 3])
            self.assertEqual(json.loads(self.read('r.json'))['result']['split_faces'], 1)
        corner = [(0, 0, 0), (2, 0, 0), (2, 1, 0), (1, 1, 0), (1, 2, 0), (0, 2, 0)]
        (_, _, faces, _), report, printed = self.unwrapped(corner[1:] + corner[:1], [(0, 1, 2, 3, 4, 5)])
        self.assertEqual([len(f) for f in faces], [6])  # its shape has to be cut, too
        self.assertEqual(report['result']['split_faces'], 0)
        self.assertNotIn('triangles in .obj', printed)

    def test_split_quads_are_reported(self):
        points = [(0, 0, 0), (1, 0, 1.5), (1, 1, 0), (0, 1, 1.5)]
        faces = [(0, 1, 2, 3)]
        mesh = self.write('in.obj', obj_text(points, faces, [(0, 0), (1, 0), (1, 1), (0, 1)]))
        outcome = self.run_ok('unwrap', mesh, '-o', self.path('a.obj'), '--charts', '2', '--report', self.path('r.json'))
        split = sum(len(f) == 3 for f in read_obj(self.path('a.obj'))[2]) // 2
        self.assertEqual(json.loads(self.read('r.json'))['result']['split_faces'], split)
        self.assertEqual('1 face of the input is triangles in .obj and .ply (face 1)' in outcome.err, split == 1)


class Energy(CommandTest):
    """The energy in the verdict."""

    def report(self, path, *args):
        line = self.run_ok('check', path, '--report', self.path('r.json'), *args).printed()[-1]
        with open(self.path('r.json')) as f:
            return line, json.load(f)['result']

    def test_faces_without_area(self):
        flat = 'v 0 0 0\nv 1 0 0\nv 2 0 0\nvt 0 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 3/3\n'
        line, result = self.report(self.write('a.obj', flat))
        self.assertIn('symmetric-dirichlet infinite, since 1 face has no area', line)
        self.assertIsNone(result['value'])
        self.assertIsNone(result['max_density'])
        self.assertEqual(result['faces_without_area'], 1)
        more = ('v 0 0 0\nv 1 0 0\nv 2 0 0\nv 1 1 0\nvt 0 0\nvt 1 -0.1\nvt 2 0\nvt 1 1\n'
                'f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n')
        line, result = self.report(self.write('b.obj', more))
        self.assertIn('infinite, since 1 face has no area (4 over the others at the best scale, uv '
                      'times 1)', line)
        self.assertIsNone(result['value'])
        self.assertAlmostEqual(result['value_over_others'], 4)
        # unwrap writes a file without a claimed energy for such a mesh.
        points = [(0, 0, 0), (1, 0, 0), (2, 0, 0), (1, 1, 0)]
        mesh = self.write('in.obj', obj_text(points, [(0, 1, 2), (0, 2, 3)]))
        self.run_ok('unwrap', '--quiet', mesh, '-o', self.path('c.vtu'))
        line, result = self.report(self.path('c.vtu'), '--surface', mesh)
        self.assertIn('1 face has no area', line)
        self.assertIsNone(result['value'])

    def test_files_without_a_scale_are_measured_at_the_best_one(self):
        points, faces = grid(6)
        mesh = self.write('in.obj', obj_text(points, faces))
        outputs = [self.path('a' + end) for end in ('.vtu', '.obj', '.ply')]
        self.run_ok('parametrize', '--quiet', mesh, '--degree', '1', '--tolerance', '1e-12',
                    *(w for o in outputs for w in ('-o', o)))
        required = Vtu(outputs[0]).claims['value']
        line, result = self.report(outputs[0])
        self.assertFalse(result['scale_is_assumed'])
        self.assertNotIn('best scale', line)
        for out in outputs[1:]:
            line, result = self.report(out)
            self.assertIn(' at the best scale, uv times 1', line)
            self.assertAlmostEqual(result['value'], required, delta=1e-7)
        for factor in (1e-7, 1 / 3, 1e40):  # the map in other units
            v, vt, f, texture = read_obj(outputs[1])
            lines = ['v %r %r %r' % p for p in v] + ['vt %r %r' % tuple(factor * x for x in t) for t in vt]
            lines += ['f ' + ' '.join('%d/%d' % (i + 1, k + 1) for i, k in zip(*c)) for c in zip(f, texture)]
            line, result = self.report(self.write('b.obj', '\n'.join(lines) + '\n'))
            self.assertAlmostEqual(result['value'], required, delta=1e-6)
            self.assertTrue(result['scale_is_assumed'])
            self.assertAlmostEqual(result['layout_scale'] / factor, 1, delta=1e-3)

    def test_the_best_scale_is_best(self):
        """The energy of a map with sigma 2 and 1/4: a t^2 + b / t^2 with a = 4.0625 and b = 16.25."""
        text = 'v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 2 0\nvt 0 0.25\nf 1/1 2/2 3/3\n'
        line, result = self.report(self.write('a.obj', text))
        self.assertAlmostEqual(result['value'], 2 * math.sqrt(4.0625 * 16.25), places=9)
        self.assertAlmostEqual(result['layout_scale'], 2 ** -0.5, places=9)


class Campaign(CommandTest):
    """Small meshes of all kinds in several verbs and formats."""

    @staticmethod
    def mesh(rng):
        n = rng.randrange(1, 4)
        points, faces = (quads if rng.random() < 0.5 else grid)(n)
        points = [tuple(x + rng.uniform(-0.15, 0.15) / n for x in p) for p in points]
        faces = list(faces)
        for _ in range(rng.randrange(4)):
            face, kind = rng.choice(faces), rng.randrange(7)
            corner = (rng.random(), rng.random(), 1)
            if kind == 0:  # a fin
                points.append(corner)
                faces.insert(rng.randrange(len(faces)), (face[0], face[1], len(points) - 1))
            elif kind == 1:  # a repeated face, perhaps reversed
                faces.insert(rng.randrange(len(faces)), face if rng.random() < 0.5 else face[::-1])
            elif kind == 2:
                faces[faces.index(face)] = face[::-1]
            elif kind == 3:
                faces.insert(0, face[:3])
            elif kind == 4:  # a piece that shares one vertex
                points += [corner, (corner[1], corner[0], 1.5)]
                faces.append((face[0], len(points) - 1, len(points) - 2))
            elif kind == 5 and len(faces) > 2:
                faces.remove(face)
            elif kind == 6:  # a separate piece of another size
                small = times(10.0 ** -rng.randrange(8), [corner, (0, 0, 1), (1, 0, 1)])
                points += small
                faces.append(tuple(range(len(points) - 3, len(points))))
        uv = [(x + rng.uniform(-0.1, 0.1) / n, y + rng.uniform(-0.1, 0.1) / n) for x, y, _ in points] \
            if rng.random() < 0.4 else None
        size = 10.0 ** rng.choice((0, 0, 0, -90, 30))
        return times(size, points), faces, uv

    def test_written_files_are_valid(self):
        rng = random.Random(28)
        for number in range(30):
            points, faces, uv = self.mesh(rng)
            mesh = self.write('in.obj', obj_text(points, faces, uv))
            flags = rng.choice(([], ['--normalize'], ['--vtu', 'lagrange']))
            flags = flags + (['--seams', 'uv'] if uv and rng.random() < 0.5 else [])
            outputs = [self.path('a' + end) for end in ('.vtu', '.obj', '.ply')]
            with self.subTest(number=number, flags=flags):
                done = majorant('unwrap', '--quiet', mesh, '--degree', '1', *flags,
                                *(w for o in outputs for w in ('-o', o)))
                self.assertIn(done.code, (OK, LIMIT), done.err)
                for out in outputs:
                    self.run_ok('check', out)
                    self.run_ok('check', out, '--surface', mesh, '--certify')


if __name__ == '__main__':
    main()
