#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""`majorant quads`, and `check` of its files and of others: files, reports, refusals. tests/checker/quad_judge.py
judges the files, too."""
import base64
import json
import math
import os
import re
import struct
import sys
import unittest

import command_helpers as helpers
from command_helpers import INVALID, UNREADABLE, UNSUPPORTED, USAGE, CommandTest, majorant

sys.path.insert(0, os.path.join(helpers.SOURCE, 'tests', 'checker'))
from quad_judge import judge, read_obj  # noqa: E402

CLOSED = os.path.join(helpers.SHARED, 'data', 'public', 'closed')


def torus(m, n, radius=3):
    points = [((radius + math.cos(b)) * math.cos(a), (radius + math.cos(b)) * math.sin(a), math.sin(b))
              for a in (2 * math.pi * i / m for i in range(m)) for b in (2 * math.pi * j / n for j in range(n))]
    faces = []
    for i in range(m):
        for j in range(n):
            a, b = i * n + j, (i + 1) % m * n + j
            c, d = (i + 1) % m * n + (j + 1) % n, i * n + (j + 1) % n
            faces += [(a, b, c), (a, c, d)]
    return points, faces


class Quads(CommandTest):
    def made(self, source, *args):
        """Returns the report of a run, whose quads are valid and judged again."""
        quads = self.path('quads.obj')
        self.run_ok('quads', source, '-o', quads, '--report', self.path('r.json'), '--force', *args)
        # Large quads may be farther from a curved surface than `check` permits by default.
        self.run_ok('check', quads, '--surface', source, '--max-distance', 1)
        self.assertEqual(judge(read_obj(quads), read_obj(source), near=1), set())
        return json.loads(self.read('r.json'))

    def test_generated_surface(self):
        report = self.made(helpers.generated('buckle'), '--count', 1000)
        quads = report['result']['quads']
        self.assertEqual(report['status'], 'converged')
        self.assertEqual((quads['folded'], quads['turned']), (0, 0))
        self.assertEqual(quads['requested'], 1000)
        self.assertLessEqual(abs(quads['count'] - 1000), 50)
        self.assertEqual(quads['euler_characteristic'], report['input']['euler_characteristic'])
        text = self.read('quads.obj').decode().split('\n')
        self.assertTrue(text[0].startswith('# majorant '))
        self.assertEqual({line[:2] for line in text[1:] if line}, {'v ', 'f '})
        self.assertEqual(sum(line.startswith('f ') for line in text), quads['count'])

    def test_edge_length_and_default_count(self):
        path = self.write('torus.obj', helpers.obj_text(*torus(24, 14)))
        area = self.made(path)['input']['area']
        report = json.loads(self.read('r.json'))
        self.assertEqual(report['result']['quads']['requested'], report['input']['faces'] // 2)
        length = (area / 500) ** 0.5
        quads = self.made(path, '--edge-length', repr(length))['result']['quads']
        self.assertAlmostEqual(quads['requested'], 500, delta=1)
        self.assertLess(abs(quads['count'] - 500), 50)

    def test_same_bytes_on_any_number_of_threads(self):
        for threads in (1, 2):
            self.run_ok('quads', helpers.generated('buckle'), self.path('%d.obj' % threads), '--count', 500,
                        '--threads', threads)
        self.assertEqual(self.read('1.obj'), self.read('2.obj'))

    def test_ply_is_the_same_mesh(self):
        self.run_ok('quads', helpers.generated('buckle'), '-o', self.path('a.obj'), '-o', self.path('a.ply'))
        one = self.run_ok('check', self.path('a.obj')).out.split(': ', 1)[1]
        self.assertEqual(self.run_ok('check', self.path('a.ply')).out.split(': ', 1)[1], one)
        self.assertIn('valid', one)

    def test_components_and_orientation(self):
        """Two tori, one of them inside out: quads have the orientation of the faces."""
        points, faces = torus(24, 14)
        both = points + [(x + 20, y, z) for x, y, z in points]
        faces = faces + [tuple(v + len(points) for v in face[::-1]) for face in faces]
        report = self.made(self.write('two.obj', helpers.obj_text(both, faces)), '--count', 800)
        self.assertEqual(report['result']['quads']['components'], 2)
        one = self.made(self.write('one.obj', helpers.obj_text(points, faces[:len(faces) // 2])), '--count', 400)
        self.assertEqual(report['result']['quads']['irregular'], 2 * one['result']['quads']['irregular'])

    def test_few_quads(self):
        """A thin torus whose least number of quads needs no edges on some arcs, alone and beside a cube."""
        points, faces = torus(40, 8, 10)
        path = self.write('thin.obj', helpers.obj_text(points, faces))
        for count in (1, 2):
            quads = self.made(path, '--count', count)['result']['quads']
            self.assertLessEqual(quads['least_count'], quads['count'])
        both = self.write('both.obj', helpers.obj_text(
            points + [(x + 20, y, z) for x, y, z in Check.CUBE],
            faces + [tuple(v + len(points) for v in half)
                     for a, b, c, d in Check.SIDES for half in ((a, b, c), (a, c, d))]))
        for count in (30, 100):
            quads = self.made(both, '--count', count)['result']['quads']
            self.assertAlmostEqual(quads['requested'], count, delta=1)  # each component has its rounded share
            self.assertEqual(quads['least_count'] is not None, quads['count'] > 1.05 * quads['requested'])
            if quads['least_count'] is not None:
                self.assertTrue(6 < quads['least_count'] <= quads['count'], quads)

    def test_counts_that_are_not_met(self):
        """A thin torus of 17 quads is folded: more quads are made, with a message; 100 and 300 are met."""
        points, faces = torus(40, 8, 10)
        path = self.write('thin.obj', helpers.obj_text(points, faces))
        off = 0
        for count in (17, 100, 300):
            report = self.made(path, '--count', count, '--features', 'none')
            made = report['result']['quads']['count']
            is_off = abs(made - count) > 0.05 * count
            off += is_off
            self.assertEqual([re.search('within 5 % of that was found', line) is not None
                              for line in report['warnings']], [True] if is_off else [])
        self.assertEqual(off, 1)

    def test_edges_too_short(self):
        cube = self.write('cube.obj', helpers.obj_text(Check.CUBE, [half for a, b, c, d in Check.SIDES
                                                                    for half in ((a, b, c), (a, c, d))]))
        for length in ('1e-6', '1e-9', '1e-200'):
            self.refused(UNSUPPORTED, 'quads', cube, '-o', self.path('o.obj'), '--edge-length', length, says='too many')
        self.assertEqual(self.made(cube, '--edge-length', '1e200')['result']['quads']['requested'], 0)

    def test_refusals(self):
        buckle, out = helpers.generated('buckle'), self.path('o.obj')
        self.refused(USAGE, 'quads', buckle, '-o', out, '--count', 100, '--edge-length', 1, says='--edge-length')
        self.refused(USAGE, 'quads', buckle, '-o', self.path('o.stl'), says='.stl')
        self.refused(USAGE, 'quads', buckle, says='-o')
        self.refused(UNREADABLE, 'quads', self.path('none.obj'), '-o', out, says='none.obj')
        cones = self.write('cones.json', '{"cones": []}')
        self.refused(UNSUPPORTED, 'quads', helpers.generated('wavy_disk'), '-o', out, '--cones', cones, says='border')
        points, faces = torus(12, 8)
        twice = self.write('twice.obj', helpers.obj_text(points, faces + faces[:1]))
        self.refused(UNSUPPORTED, 'quads', twice, '-o', out, '--strict', says='--strict')
        self.assertEqual(self.files(), ['cones.json', 'twice.obj'])

    def test_borders(self):
        """A plate with four holes, a tube and a wavy disk."""
        points, number, faces = [], {}, []
        for i in range(25):
            for j in range(25):
                if i // 5 % 2 and j // 5 % 2:
                    continue
                corners = []
                for at in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)):
                    if at not in number:
                        number[at] = len(points)
                        points.append((at[0] + 0.1 * math.sin(at[1]), at[1], 0.2 * math.sin(at[0])))
                    corners.append(number[at])
                faces += [(corners[0], corners[1], corners[2]), (corners[0], corners[2], corners[3])]
        plate = self.write('plate.obj', helpers.obj_text(points, faces))
        quads = self.made(plate, '--count', 1000)['result']['quads']
        self.assertEqual(quads['boundary_loops'], 5)
        self.assertLessEqual(abs(quads['count'] - 1000), 50)
        points, faces = torus(24, 16)
        tube = self.write('tube.obj', helpers.obj_text(points, faces[:24 * 16]))
        quads = self.made(tube, '--count', 500)['result']['quads']
        self.assertEqual((quads['boundary_loops'], quads['euler_characteristic']), (2, 0))
        quads = self.made(helpers.generated('wavy_disk'), '--count', 500)['result']['quads']
        self.assertEqual((quads['boundary_loops'], quads['euler_characteristic']), (1, 1))

    def block(self, n, name='block.obj'):
        """Writes a cube of n^2 squares per side, each of two triangles."""
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
                        a, b, c, d = corners if side else corners[::-1]
                        faces += [(a, b, c), (a, c, d)]
        return self.write(name, helpers.obj_text(list(number), faces)), number

    def test_features(self):
        """The edges of a cube, edges of a file, and none, with the verdicts of check."""
        cube, number = self.block(4)
        report = self.made(cube, '--count', 600)
        self.assertEqual(report['result']['quads']['features'], {'requested': 12, 'covered': 12, 'relaxed': 0})
        self.assertEqual(report['options']['features'], None)
        quads = self.path('quads.obj')
        self.assertEqual(judge(read_obj(quads), read_obj(cube), 35), set())
        printed = self.run_ok('check', quads, '--surface', cube, '--features', 35, '--report', self.path('c.json')).out
        self.assertIn('12 feature lines covered', printed)
        self.assertEqual(json.loads(self.read('c.json'))['result']['quads']['features'], {'requested': 12, 'covered': 12, 'relaxed': None})
        edge = [number[i, 0, 0] for i in range(5)]
        path = self.write('edges.json', json.dumps({'edges': list(zip(edge, edge[1:]))}))
        one = self.made(cube, '--count', 100, '--features', path)['result']['quads']
        self.assertEqual(one['features'], {'requested': 1, 'covered': 1, 'relaxed': 0})
        self.run_ok('check', quads, '--surface', cube, '--features', path, '--max-distance', 0.1)
        plain = self.made(cube, '--count', 100, '--features', 'none')['result']['quads']
        self.assertEqual(plain['features'], {'requested': 0, 'covered': 0, 'relaxed': 0})
        bent = self.read('quads.obj').decode().split('\n')
        self.write('bent.obj', '\n'.join(re.sub(r'^v \S+ ', 'v 0.001 ', line) if line.startswith('v 0 ') else line
                                         for line in bent))
        printed = self.run_ok('check', self.path('bent.obj'), '--surface', cube, '--features', 35, code=INVALID).out
        self.assertIn('feature lines are not covered', printed)

    def test_features_that_are_refused(self):
        cube, number = self.block(2)
        out = self.path('o.obj')
        for printed in ('0', '181', '-3'):
            self.refused(USAGE, 'quads', cube, '-o', out, '--features=' + printed, says='degrees')
        self.refused(UNREADABLE, 'quads', cube, '-o', out, '--features', self.path('none.json'), says='none.json')
        across = self.write('across.json', json.dumps({'edges': [[number[0, 0, 0], number[2, 2, 2]]]}))
        self.refused(USAGE, 'quads', cube, '-o', out, '--features', across, says='no edge')
        cones = self.write('cones.json', '{"cones": []}')
        self.refused(UNSUPPORTED, 'quads', cube, '-o', out, '--cones', cones, '--features', 35, says='features')
        self.made(cube, '--count', 96)
        self.refused(USAGE, 'check', self.path('quads.obj'), '--features', 35, says='--surface')

    def test_short_features(self):
        """A cube of few quads keeps its edges, each covered by one edge of a quad. Less sharp lines that are shorter
        than two edges are relaxed, with a message."""
        cube, _ = self.block(4)
        report = self.made(cube, '--count', 6)
        self.assertEqual(report['result']['quads']['features'], {'requested': 12, 'covered': 12, 'relaxed': 0})
        self.assertEqual((report['result']['quads']['count'], report['warnings']), (6, []))
        n, points, faces = 8, [], []
        for z in range(5):
            points += [(math.cos(2 * math.pi * i / n), math.sin(2 * math.pi * i / n), 0.1 * z) for i in range(n)]
        for i in range(n):
            for k in range(4):
                a, b = k * n + i, k * n + (i + 1) % n
                faces += [(a, b, b + n), (a, b + n, a + n)]
        drum = self.write('drum.obj', helpers.obj_text(points, faces))
        report = self.made(drum, '--count', 16)
        self.assertEqual(report['result']['quads']['features'], {'requested': 8, 'covered': 0, 'relaxed': 8})
        self.assertIn('8 of 8 feature lines relaxed', ' '.join(report['warnings']))
        self.assertIn('two edges of so many quads', ' '.join(report['warnings']))

    def kept(self, path, count):
        """Returns about as many quads as requested of a solid, all of whose features are covered."""
        quads = self.made(path, '--count', count)['result']['quads']
        self.assertEqual(quads['features']['relaxed'], 0, quads)
        self.assertGreater(quads['features']['covered'], 0)
        self.assertLessEqual(abs(quads['count'] - count), 0.05 * count)
        return quads

    def prism(self, name, outline, height):
        """Writes a prism over a polygon around the origin, both of whose ends are fans."""
        n, faces = len(outline), []
        points = [(x, y, z) for z in (0, height) for x, y in outline] + [(0, 0, 0), (0, 0, height)]
        for i in range(n):
            j = (i + 1) % n
            faces += [(i, j, n + j), (i, n + j, n + i), (2 * n, j, i), (2 * n + 1, n + i, n + j)]
        return self.write(name, helpers.obj_text(points, faces))

    def test_edges_of_equal_lengths(self):
        """6 x 6 x 5 quads on a cube. All edges of the cube have equal lengths, so that equal numbers would make 150
        or 216."""
        cube = self.write('cube12.obj', helpers.obj_text(Check.CUBE, [half for a, b, c, d in Check.SIDES
                                                                      for half in ((a, b, c), (a, c, d))]))
        for path in (cube, self.block(4)[0]):
            self.assertEqual(self.kept(path, 200)['count'], 192)

    def test_fans(self):
        """A cone and a cylinder with fans as ends: only the vertex in the middle of a fan is off the rims."""
        n = 24
        circle = [(math.cos(2 * math.pi * i / n), math.sin(2 * math.pi * i / n)) for i in range(n)]
        self.assertEqual(self.kept(self.prism('cylinder.obj', circle, 2), 300)['features']['covered'], 2)
        points = [(x, y, 0) for x, y in circle] + [(0, 0, 2), (0, 0, 0)]
        faces = [face for i in range(n) for face in ((i, (i + 1) % n, n), ((i + 1) % n, i, n + 1))]
        cone = self.write('cone.obj', helpers.obj_text(points, faces))
        self.assertEqual(self.kept(cone, 200)['features']['covered'], 1)

    def test_teeth(self):
        """A star whose sides are about as long as edges of quads."""
        n = 24
        star = [((1 if i % 2 else 1.2) * math.cos(2 * math.pi * i / n),
                 (1 if i % 2 else 1.2) * math.sin(2 * math.pi * i / n)) for i in range(n)]
        quads = self.kept(self.prism('star.obj', star, 0.4), 320)
        self.assertEqual(quads['features']['covered'], 3 * n)

    def test_saw(self):
        """48 teeth of 34 degrees, which need no irregular vertices."""
        n = 48
        blade = [(r * math.cos(2 * math.pi * (k + at) / n), r * math.sin(2 * math.pi * (k + at) / n))
                 for k in range(n) for at, r in ((0, 1), (0.9, 1.2))]
        quads = self.run_quads(self.prism('saw.obj', blade, 0.3), 2700)
        self.assertEqual(quads['features'], {'requested': 6 * n, 'covered': 6 * n, 'relaxed': 0})
        self.assertEqual((quads['folded'], quads['turned']), (0, 0))
        self.assertLessEqual(abs(quads['count'] - 2700), 0.05 * 2700)

    def test_ragged_borders(self):
        """A plate with a zigzag border: each corner takes a quad unless the border is smoothed."""
        n = 20
        points = [(i, j + (0.45 if i % 2 else -0.45) * (j in (0, n)), 0) if 0 < i < n else
                  (i + (0.45 if j % 2 else -0.45) * (0 < j < n), j, 0) for i in range(n + 1) for j in range(n + 1)]
        faces = []
        for i in range(n):
            for j in range(n):
                a = i * (n + 1) + j
                b = a + n + 1
                faces += [(a, b, b + 1), (a, b + 1, a + 1)]
        path = self.write('ragged.obj', helpers.obj_text(points, faces))
        before = self.run_quads(path, 100)
        quads = self.path('quads.obj')
        self.run_ok('quads', path, '-o', quads, '--count', 100, '--border-corners', 180, '--force', '--report', self.path('r.json'))
        after = json.loads(self.read('r.json'))['result']['quads']
        self.assertLessEqual(abs(after['count'] - 100), 5)
        self.assertGreater(before['count'], 2 * after['count'])
        self.run_ok('check', quads, '--surface', path, '--border-corners', 180, '--max-distance', 0.1)
        printed = self.run_ok('check', quads, '--surface', path, '--max-distance', 0.1, code=INVALID).out
        self.assertIn("corners of the surface's border have no vertex", printed)
        self.refused(USAGE, 'quads', path, '-o', self.path('o.obj'), '--border-corners', 181, says='--border-corners')

    def closed(self, path, count, components=2):
        quads = self.run_quads(path, count)
        self.assertEqual((quads['components'], quads['boundary_loops']), (components, 0))
        self.assertEqual(quads['features']['relaxed'], 0, quads)
        return quads

    def run_quads(self, path, count):
        self.run_ok('quads', path, '-o', self.path('quads.obj'), '--report', self.path('r.json'), '--force', '--count', count)
        self.run_ok('check', self.path('quads.obj'), '--surface', path, '--max-distance', 1)
        return json.loads(self.read('r.json'))['result']['quads']

    def test_solids_that_touch(self):
        """Two cubes with a face at one place, with a common edge of 4 x 4 squares each, or with a common vertex."""
        halves = [half for a, b, c, d in Check.SIDES for half in ((a, b, c), (a, c, d))]
        for name, by in (('face', (1, 0, 0)), ('edge', (1, 1, 0)), ('vertex', (1, 1, 1))):
            with self.subTest(name):
                other = [tuple(map(sum, zip(p, by))) for p in Check.CUBE]
                points = Check.CUBE + other
                apart = [tuple(v + 8 for v in face) for face in halves]
                if name != 'face':  # the cubes share vertices
                    points = sorted(set(points))
                    number = [points.index(p) for p in Check.CUBE + other]
                    faces = [tuple(number[v] for v in face) for face in halves + apart]
                else:
                    faces = halves + apart
                self.closed(self.write(name + '.obj', helpers.obj_text(points, faces)), 60)

    def test_thin_walls(self):
        """Two nested spheres, the inner one inside out; a bowl whose wall is thinner than the sagitta of its quads."""
        m, n = 24, 13

        def sphere(radius, low=0):
            return [(radius * math.sin(t) * math.cos(a), radius * math.sin(t) * math.sin(a), radius * math.cos(t))
                    for t in (math.pi * (low + (1 - low) * (j + 0.5) / n) for j in range(n))
                    for a in (2 * math.pi * i / m for i in range(m))]

        def bands(first, rows=n):
            return [face for j in range(rows - 1) for i in range(m)
                    for a, b in ((first + j * m + i, first + j * m + (i + 1) % m),)
                    for face in ((a, a + m, b + m), (a, b + m, b))]

        def cap(row, top):
            return [(row + i, row + (i + 1) % m, top) for i in range(m)]
        points, faces = [], []
        for k, radius in enumerate((1, 0.9)):
            first = len(points)
            points += sphere(radius) + [(0, 0, radius), (0, 0, -radius)]
            whole = bands(first) + [f[::-1] for f in cap(first + (n - 1) * m, first + n * m + 1)] + cap(first, first + n * m)
            faces += whole if k == 0 else [face[::-1] for face in whole]
        shell = self.write('shell.obj', helpers.obj_text(points, faces))
        quads = self.run_quads(shell, 100)
        self.assertLessEqual(abs(quads['count'] - 100), 12)
        points, faces = [], []
        for k, radius in enumerate((1, 0.97)):
            first = len(points)
            points += sphere(radius, 0.45) + [(0, 0, -radius)]
            half = bands(first) + [f[::-1] for f in cap(first + (n - 1) * m, first + n * m)]
            faces += half if k == 0 else [face[::-1] for face in half]
        inner = n * m + 1
        for i in range(m):
            j = (i + 1) % m
            faces += [(i, j, inner + j), (i, inner + j, inner + i)]
        bowl = self.write('bowl.obj', helpers.obj_text(points, faces))
        quads = self.run_quads(bowl, 100)
        self.assertLessEqual(abs(quads['count'] - 100), 8)

    def test_edges_without_length(self):
        """Two squares, and between them a triangle with two corners at one place; a polygon with such an edge."""
        points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (1, 1, 0), (2, 0, 0), (2, 1, 0)]
        one = self.write('one.obj', helpers.obj_text(points, [(0, 1, 2, 3), (1, 4, 2), (1, 5, 6, 4)]))
        self.run_quads(one, 30)
        self.assertIn('1 edge of no length collapsed (edge (3, 5))', json.loads(self.read('r.json'))['input']['repairs'])
        self.assertEqual(judge(read_obj(self.path('quads.obj')),
                               (points, [[0, 1, 2], [0, 2, 3], [1, 5, 6], [1, 6, 2]])), set())
        two = self.write('two.obj', helpers.obj_text(points, [(0, 1, 4, 2, 3), (1, 5, 6, 4)]))
        self.assertEqual(self.run_quads(two, 30)['boundary_loops'], 1)
        self.refused(UNSUPPORTED, 'quads', two, '-o', self.path('o.obj'), '--strict', says='no length')

    def test_failures_of_components(self):
        """The message names the component without quads, and its share of the requested number."""
        cones = self.write('cones.json', json.dumps({'cones': [{'vertex': 0, 'quarter_turns': 1}]}))
        both = Check.CUBE + [(x + 5, y, z) for x, y, z in Check.CUBE]
        faces = [tuple(v + k for v in half) for k in (0, 8) for a, b, c, d in Check.SIDES
                 for half in ((a, b, c), (a, c, d))]
        path = self.write('both.obj', helpers.obj_text(both, faces))
        self.refused(UNSUPPORTED, 'quads', path, '-o', self.path('o.obj'), '--cones', cones, '--count', 40,
                     says='component 1 of 2 (20 of the 40 quads, 12 triangles')

    @helpers.where(CLOSED)
    def test_features_in_conflict(self):
        """Features that exclude valid quads of the requested number are relaxed, and the message has the reason."""
        report = self.made(os.path.join(CLOSED, 'plane_27_holes_16747.obj'), '--count', 300, '--features', 35)
        features = report['result']['quads']['features']
        self.assertGreater(features['relaxed'], 0)
        self.assertEqual(features['covered'] + features['relaxed'], features['requested'])
        self.assertIn('; with more of them: no valid quads were made: ', ' '.join(report['warnings']))

    def test_a_cylinder(self):
        """Closed lines without corners, and a vertex in the middle of each end that all its triangles share."""
        n, points, faces = 16, [(0, 0, 0)], []
        rings = [(1, 0), (2, 0), (2, 1), (2, 2), (1, 2)]
        for r, z in rings:
            points += [(r * math.cos(2 * math.pi * i / n), r * math.sin(2 * math.pi * i / n), z) for i in range(n)]
        points.append((0, 0, 2))
        for i in range(n):
            j = (i + 1) % n
            faces += [(0, 1 + j, 1 + i), (len(points) - 1, 1 + 4 * n + i, 1 + 4 * n + j)]
            for k in range(len(rings) - 1):
                a, b, c, d = 1 + k * n + i, 1 + k * n + j, 1 + k * n + n + j, 1 + k * n + n + i
                faces += [(a, b, c), (a, c, d)]
        path = self.write('cylinder.obj', helpers.obj_text(points, faces))
        quads = self.made(path, '--count', 800)['result']['quads']
        self.assertEqual(quads['features'], {'requested': 2, 'covered': 2, 'relaxed': 0})
        self.assertEqual(judge(read_obj(self.path('quads.obj')), read_obj(path), 35), set())

    def test_vtu(self):
        """Patches and irregular vertices, by number of quads."""
        cube, _ = self.block(4)
        path = self.path('q.vtu')
        self.run_ok('quads', cube, '-o', path, '-o', self.path('q.obj'), '--count', 600)
        one = self.run_ok('check', path, '--quads', '--surface', cube).out.split(': ', 1)[1]
        self.assertEqual(self.run_ok('check', self.path('q.obj'), '--surface', cube).out.split(': ', 1)[1], one)
        found = json.loads(self.run_ok('mesh', 'check', path, '--report', '-').out)['result']['mesh']
        self.assertEqual(found['elements']['points'], 8)

    def test_pictures(self):
        """A cube from outside: half of it is visible, its corners are irregular, its edges features."""
        cube, _ = self.block(4)
        names = [self.path('q.' + e) for e in ('svg', 'png', 'html', 'obj')]
        report = self.made(cube, '--count', 600, *[word for name in names for word in ('-o', name)])
        quads = report['result']['quads']
        self.assertEqual([output['written'] for output in report['outputs']], [True] * 5)
        svg = self.read('q.svg').decode()
        self.assertIn('8 vertices of fewer than 4 quads', svg)
        patches = int(re.search('%d quads in ([0-9]+) patches' % quads['count'], svg).group(1))
        cells = len(re.findall('<path fill="(?!#fff)[^"]*" stroke="#333333" stroke-width="0.8" d="M', svg))
        self.assertLess(abs(cells - quads['count'] / 2), 0.1 * quads['count'])
        dots = svg.count('<circle') - 1  # the legend has one circle
        self.assertIn(dots, (4, 6, 7))
        self.assertEqual(self.read('q.png')[:4], b'\x89PNG')
        page = self.read('q.html').decode()
        data = json.loads(re.search('<script type="application/json" id="data">(.*?)</script>', page, re.S).group(1))
        self.assertEqual(data['faces'], 2 * quads['count'])
        self.assertEqual({turns for _, turns in data['cones']}, {3})
        vertices = struct.unpack('<%di' % data['corners'], base64.b64decode(data['input_vertex']))
        self.assertEqual(len({vertices[corner] for corner, _ in data['cones']}), 8)
        charts = struct.unpack('<%di' % data['faces'], base64.b64decode(data['chart']))
        self.assertEqual(len(set(charts)), patches)
        seams = struct.unpack('<%di' % (3 * data['faces']), base64.b64decode(data['seam_edges']))
        on_features = int(re.search(r'(\d+) edges on features', svg).group(1))
        self.assertEqual(sum(seams), 2 * on_features)  # both sides of each edge

    def test_borders_that_touch(self):
        """Two square holes that meet at a corner are one border loop, since two vertices are at that place."""
        points, number, faces = [], {}, []
        for i in range(12):
            for j in range(12):
                if (i // 2, j // 2) in ((2, 2), (3, 3)):
                    continue
                corners = []
                for at in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)):
                    key = at if at != (6, 6) else (at, i < j)
                    if key not in number:
                        number[key] = len(points)
                        points.append((at[0], at[1], 0))
                    corners.append(number[key])
                faces += [(corners[0], corners[1], corners[2]), (corners[0], corners[2], corners[3])]
        path = self.write('touching.obj', helpers.obj_text(points, faces))
        self.assertEqual(self.made(path, '--count', 300)['result']['quads']['boundary_loops'], 2)

    def test_time_limit(self):
        """The limit ends the optimization of the map; the quads then take far less than the second that they have."""
        buckle, quads = helpers.generated('buckle'), self.path('o.obj')
        self.run_ok('quads', buckle, '-o', quads, '--count', 100, '--time-limit', 0, code=helpers.LIMIT)
        self.run_ok('check', quads, '--surface', buckle, '--max-distance', 1)

    @helpers.where(CLOSED)
    def test_public_closed_meshes(self):
        for name in ('spot_1654', 'torus_g1_4608'):
            with self.subTest(name):
                quads = self.made(os.path.join(CLOSED, name + '.obj'), '--count', 1000)['result']['quads']
                self.assertLessEqual(abs(quads['count'] - 1000), 50)


class Check(CommandTest):
    CUBE = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    SIDES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]

    def test_files_of_quads_are_known(self):
        path = self.write('cube.obj', helpers.obj_text(self.CUBE, self.SIDES))
        printed = self.run_ok('check', path, '--report', self.path('r.json')).out
        self.assertIn('valid: 6 quads, Euler characteristic 2', printed)
        self.assertIn('not compared with a surface', printed)
        report = json.loads(self.read('r.json'))
        self.assertEqual(report['result']['quads']['irregular'], 8)
        self.assertIsNone(report['result']['quads']['turned'])

    def test_defects_are_named(self):
        bent = self.CUBE[:7] + [(0.1, 0.1, 1)]
        path = self.write('bent.obj', helpers.obj_text(bent, self.SIDES))
        printed = self.run_ok('check', path, code=INVALID).out
        self.assertIn('folded', printed)
        open_cube = self.write('open.obj', helpers.obj_text(self.CUBE, self.SIDES[:5]))
        cube = self.write('cube.obj', helpers.obj_text(self.CUBE, self.SIDES))
        printed = self.run_ok('check', open_cube, '--surface', cube, code=INVALID).out
        self.assertIn('Euler characteristic of the quads: 1, of the surface: 2', printed)
        self.assertIn('border loops', printed)

    def test_triangles_are_a_map_unless_quads_are_asked_for(self):
        points, faces = torus(8, 6)
        path = self.write('torus.obj', helpers.obj_text(points, faces))
        self.refused(UNSUPPORTED, 'check', path)
        printed = self.run_ok('check', path, '--quads', '--report', self.path('r.json'), code=INVALID)
        self.assertIn('no quads', printed.out)
        quads = json.loads(self.read('r.json'))['result']['quads']
        self.assertEqual(quads.pop('count'), len(faces))

        def values(section):
            return [v for x in section.values() for v in (values(x) if isinstance(x, dict) else [x])]
        self.assertEqual({str(value) for value in values(quads)}, {'None'})  # the other measures are null

    def test_the_distance_to_the_surface(self):
        """A cube five times as large has the same topology, but is away from the surface."""
        cube = self.write('cube.obj', helpers.obj_text(self.CUBE, self.SIDES))
        large = self.write('large.obj', helpers.obj_text([tuple(5 * x for x in p) for p in self.CUBE], self.SIDES))
        self.run_ok('check', cube, '--surface', cube)
        printed = self.run_ok('check', large, '--surface', cube, code=INVALID).out
        self.assertIn('away from the surface', printed)
        self.assertIn('away from the quads', printed)
        self.run_ok('check', large, '--surface', cube, '--max-distance', 5)
        smaller = self.write('smaller.obj', helpers.obj_text([tuple(0.99 * x for x in p) for p in self.CUBE], self.SIDES))
        self.run_ok('check', smaller, '--surface', cube)
        self.run_ok('check', smaller, '--surface', cube, '--max-distance', 0.001, code=INVALID)
        self.refused(USAGE, 'check', cube, '--max-distance', 0.1, says='--surface')

    def test_flags_of_maps(self):
        path = self.write('cube.obj', helpers.obj_text(self.CUBE, self.SIDES))
        for flag in (['--certify'], ['--seamless'], ['--stacked'], ['--cuts', 'none'], ['--distortion', self.path('d.csv')]):
            self.refused(USAGE, 'check', path, *flag, says=flag[0])


if __name__ == '__main__':
    helpers.main()
