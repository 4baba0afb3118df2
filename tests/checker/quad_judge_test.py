#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""`majorant check` of quad meshes against a judge that shares no code with it (quad_judge.py): sound meshes,
closed and bordered, and the same with one random defect each. Both find the same kinds of defects.

A campaign with a number of damaged meshes:
    MAJORANT_QUAD_MESHES=2000 python3 tests/checker/quad_judge_test.py
"""
import math
import os
import random
import re
import subprocess
import tempfile
import unittest

from quad_judge import judge

BINARY = os.environ.get('MAJORANT_BINARY', '')
COUNT = int(os.environ.get('MAJORANT_QUAD_MESHES', '60'))
# The messages of `check`, by the judge's names.
MESSAGE = {'no quads': 'no quads? of four vertices|are no faces', 'crowded edge': 'more than two quads',
        'opposed edge': 'run the same way', 'touching vertex': 'merely touch', 'folded': 'folded', 'turned': 'turned',
        'Euler characteristic': 'Euler characteristic of the quads', 'components': 'components of the quads',
        'border loops': 'border loops of the quads', 'other components': 'not component by component', 'off the border': "off the surface's border",
        'border not followed': 'not follow one', 'corner missed': "corners? of the surface's border",
        'feature not covered': 'feature lines? .* not covered', 'far': 'away from the (surface|quads)'}


def torus(m, n):
    points = [((3 + math.cos(b)) * math.cos(a), (3 + math.cos(b)) * math.sin(a), math.sin(b))
              for a in (2 * math.pi * i / m for i in range(m)) for b in (2 * math.pi * j / n for j in range(n))]
    return points, [[i * n + j, (i + 1) % m * n + j, (i + 1) % m * n + (j + 1) % n, i * n + (j + 1) % n]
                    for i in range(m) for j in range(n)]


def plate(m, n, hole):
    """Returns a curved rectangle, optionally with a rectangular hole."""
    points = [(i / m, j / n, 0.1 * math.sin(3 * i / m)) for i in range(m + 1) for j in range(n + 1)]
    faces = [[i * (n + 1) + j, (i + 1) * (n + 1) + j, (i + 1) * (n + 1) + j + 1, i * (n + 1) + j + 1]
             for i in range(m) for j in range(n) if not hole or not (m // 3 <= i < 2 * m // 3 and n // 3 <= j < 2 * n // 3)]
    used = sorted({v for face in faces for v in face})
    number = {v: k for k, v in enumerate(used)}
    return [points[v] for v in used], [[number[v] for v in face] for face in faces]


def block(n):
    """Returns a cube of side n with faces of n^2 quads."""
    number, faces = {}, []
    for axis in range(3):
        for side in (0, n):
            for i in range(n):
                for j in range(n):
                    corners = []
                    for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
                        p = [0, 0, 0]
                        p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3] = side, i + a, j + b
                        corners.append(number.setdefault(tuple(p), len(number)))
                    faces.append(corners if side else corners[::-1])
    return list(number), faces


def drum(n, rings):
    """Returns a cylinder of n sides whose lids are rings around squares: features without corners."""
    points, faces = [], []
    for k in range(rings + 1):
        for i in range(n):
            a = 2 * math.pi * i / n
            points.append((math.cos(a), math.sin(a), k / rings))
    for k in range(rings):
        for i in range(n):
            a, b = k * n + i, k * n + (i + 1) % n
            faces.append([a, b, b + n, a + n])
    for base, is_top in ((0, False), (rings * n, True)):
        first = len(points)
        for i in range(n):
            a = 2 * math.pi * i / n
            points.append((0.5 * math.cos(a), 0.5 * math.sin(a), float(is_top)))
        middle = len(points)
        points.append((0.0, 0.0, float(is_top)))
        lid = [[base + i, base + (i + 1) % n, first + (i + 1) % n, first + i] for i in range(n)]
        lid += [[first + i, first + i + 1, first + (i + 2) % n, middle] for i in range(0, n, 2)]
        faces += lid if is_top else [face[::-1] for face in lid]
    return points, faces


def halves(mesh):
    points, faces = mesh
    return points, [half for a, b, c, d in faces for half in ([a, b, c], [a, c, d])]


def damaged(mesh):
    points, faces = [list(p) for p in mesh[0]], [list(f) for f in mesh[1]]
    kind = random.choice(['move', 'slide', 'flat', 'turn', 'leave out', 'twice', 'join', 'triangle', 'turn all', 'none'])
    v, f = random.randrange(len(points)), random.randrange(len(faces))
    if kind == 'move':
        points[v] = [x + random.gauss(0, random.choice([1e-12, 0.01, 0.3])) for x in points[v]]
    elif kind == 'slide':  # onto the middle of an edge, where a corner is exactly or nearly straight
        a, b = random.choice([(faces[f][0], faces[f][2]), (faces[f][1], faces[f][3])])
        points[faces[f][random.randrange(4)]] = [(x + y) / 2 for x, y in zip(points[a], points[b])]
    elif kind == 'flat':
        face = faces[f]
        points[face[1]] = [x + random.choice([0, 1e-17, -1e-17]) for x in points[face[0]]]
    elif kind == 'turn':
        faces[f].reverse()
    elif kind == 'leave out':
        del faces[f]
    elif kind == 'twice':
        faces.append(list(faces[f]))
    elif kind == 'join':
        w = random.randrange(len(points))
        faces = [[w if x == v else x for x in face] for face in faces]
    elif kind == 'triangle':
        faces[f] = faces[f][:3]
    elif kind == 'turn all':
        faces = [face[::-1] for face in faces]
    return [tuple(p) for p in points], faces


class Agreement(unittest.TestCase):
    def setUp(self):
        random.seed(int(os.environ.get('MAJORANT_SEED', '1')))
        folder = tempfile.TemporaryDirectory(prefix='majorant_quads_')
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def write(self, name, mesh):
        path = os.path.join(self.folder, name)
        with open(path, 'w') as file:
            file.writelines('v %r %r %r\n' % tuple(p) for p in mesh[0])
            file.writelines('f %s\n' % ' '.join(str(v + 1) for v in face) for face in mesh[1])
        return path

    def printed(self, quads, surface, degrees=None):
        """Returns the kinds of defects that the command names."""
        args = [BINARY, 'check', self.write('quads.obj', quads), '--quads']
        if surface:
            args += ['--surface', self.write('surface.obj', surface)]
        if degrees is not None:
            args += ['--features', str(degrees)]
        run = subprocess.run(args, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        found = {kind for kind, words in MESSAGE.items() if re.search(words, run.stdout.split(': ', 2)[2])
                 } if run.returncode == 5 else set()
        self.assertIn(run.returncode, (0, 5), run.stderr + run.stdout)
        self.assertEqual(run.returncode == 5, bool(found), run.stdout)
        return found

    def test_sound_and_damaged(self):
        bases = [torus(9, 6), plate(6, 6, False), plate(9, 6, True)]
        kinds = set()
        for mesh in bases:
            self.assertEqual(judge(mesh, halves(mesh)), set())
            self.assertEqual(self.printed(mesh, halves(mesh)), set())
        for trial in range(COUNT):
            base = random.choice(bases)
            mesh = damaged(base)
            surface = random.choice([None, halves(base)])
            with self.subTest(trial=trial):
                expected = judge(mesh, surface)
                self.assertEqual(self.printed(mesh, surface), expected)
            kinds |= expected
        self.assertGreaterEqual(len(kinds), 8, kinds)  # the trials cover many kinds

    def agreed(self, quads, surface, degrees=None):
        expected = judge(quads, surface, degrees)
        self.assertEqual(self.printed(quads, surface, degrees), expected)
        return expected

    def test_features(self):
        """A cube and a drum with the features of their surfaces: damaged at random, and with a quad edge off
        a feature."""
        for base in (block(4), drum(12, 3)):
            surface = halves(base)
            self.assertEqual(self.agreed(base, surface, 35), set())
            self.assertEqual(self.agreed(base, surface, 95), set())
            for trial in range(COUNT // 3):
                mesh = damaged(base)
                with self.subTest(trial=trial):
                    self.agreed(mesh, surface, 35)
        points, faces = block(4)
        on_edge = next(v for v, p in enumerate(points) if p == (2, 0, 0))

        def moved(v, place):
            return [place if w == v else p for w, p in enumerate(points)], faces
        surface = halves((points, faces))
        self.assertEqual(self.agreed(moved(on_edge, (2.4, 0, 0)), surface, 35), set())  # along the line
        self.assertEqual(self.agreed(moved(on_edge, (2, 0.2, 0)), surface, 35), {'feature not covered', 'far'})
        self.assertEqual(self.agreed(moved(on_edge, (2, 0.2, 0)), surface), {'far'})
        self.assertIn('feature not covered', self.agreed(moved(on_edge, (3.2, 0, 0)), surface, 35))  # out of order
        corner = points.index((0, 0, 0))
        self.assertEqual(self.agreed(moved(corner, (0.3, 0, 0)), surface, 35) - {'far'}, {'feature not covered'})

    def test_borders(self):
        points, faces = plate(6, 6, False)
        surface = halves((points, faces))
        side = next(v for v, p in enumerate(points) if p[0] == 0.5 and p[1] == 0)
        corner = next(v for v, p in enumerate(points) if p[:2] == (0, 0))

        def moved(places):
            return [places.get(v, p) for v, p in enumerate(points)], faces
        x, y, z = points[side]
        self.assertIn('off the border', self.agreed(moved({side: (x, y + 0.01, z)}), surface))
        # A vertex of a side is moved beyond the next one.
        beyond = next(p for p in points if p[0] > 0.6 and p[1] == 0)
        after = next(p for p in points if p[0] > 0.8 and p[1] == 0)
        there = tuple((a + b) / 2 for a, b in zip(beyond, after))
        self.assertIn('border not followed', self.agreed(moved({side: there}), surface))
        # A vertex at a corner is moved half way along its side.
        along = next(p for p in points if 0 < p[0] < 0.2 and p[1] == 0)
        halfway = tuple((a + b) / 2 for a, b in zip(points[corner], along))
        self.assertEqual(self.agreed(moved({corner: halfway}), surface), {'corner missed', 'far'})

    def test_two_loops_on_one(self):
        """A plate with a hole, and one whose hole's loop lies on its outer border."""
        points, faces = plate(9, 6, True)
        surface = halves((points, faces))
        hole = {v for v, p in enumerate(points)
                if 1 / 3 - 1e-9 <= p[0] <= 2 / 3 + 1e-9 and 1 / 3 - 1e-9 <= p[1] <= 2 / 3 + 1e-9}
        outer = [points[v] for v in range(7)]  # the side x = 0
        onto = {v: outer[k % 7] for k, v in enumerate(sorted(hole))}
        quads = [onto.get(v, p) for v, p in enumerate(points)], faces
        self.assertIn('border not followed', self.agreed(quads, surface))

    def test_borders_that_touch(self):
        """Two square holes that count as one, since their common corner is two vertices at one position."""
        points = [(i, j, 0) for i in range(7) for j in range(7)] + [(3, 3, 0)]
        faces = [[7 * i + j, 7 * i + j + 7, 7 * i + j + 8, 7 * i + j + 1] for i in range(6) for j in range(6)
                 if (i, j) not in ((2, 2), (3, 3))]
        one = next(face for face in faces if 24 in face)
        one[one.index(24)] = 49
        surface = halves((list(points), faces))
        self.assertEqual(self.agreed((points, faces), surface), set())
        points[16] = (2, 2.5, 0)  # a vertex of one hole, beyond the next one
        points[17] = (2, 2.2, 0)
        self.assertIn('border not followed', self.agreed((points, faces), surface))

    def test_components_by_themselves(self):
        """A cube and one without two opposite sides, or two cubes without one side: the sums over components
        are equal."""
        def closed(n):
            at = [(i, j, k) for i in (0, 1) for j in (0, 1) for k in (0, 1)]
            sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
            return [(x + 3 * n, y, z) for x, y, z in at], [[v + 8 * n for v in side] for side in sides]

        def both(first, second):
            meshes = [closed(0), closed(1)]
            return meshes[0][0] + meshes[1][0], meshes[0][1][first:] + meshes[1][1][second:]
        self.assertEqual(self.agreed(both(0, 0), halves(both(0, 0))), set())
        surface, quads = both(0, 2), both(1, 1)
        self.assertIn('other components', self.agreed(quads, halves(surface)))


if __name__ == '__main__':
    unittest.main()
