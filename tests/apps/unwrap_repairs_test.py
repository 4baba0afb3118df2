# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""majorant unwrap of meshes with defects: what it repairs, and that its files are maps of them."""
import math
import os
import re
import shlex

from command_helpers import *
from unwrap_helpers import *


class Repairs(UnwrapTest):
    def test_moebius(self):
        points, faces = moebius(20)
        mesh = self.mesh(points, faces)
        layout, report = self.unwrap(mesh)
        repairs = self.repaired(report)
        self.assertEqual(repairs['cut_edge'], 1)
        seam = report['result']
        self.assertEqual((seam['repair_seam_edges'], seam['seam_edges']), (1, 1))
        cut = report['repairs'][-1]['places'][0]
        self.assertEqual(report['repairs'][-1]['kind'], 'cut_edge')
        self.assertEqual(seam['seam_length'], math.dist(*(points[v] for v in cut)))
        self.assertEqual(seam['repair_seam_length'], seam['seam_length'])
        self.same_but_turned(layout, faces, repairs.get('turned_face', 0))
        self.assertTrue(all(layout.area(k) > 0 for k in range(len(faces))))
        self.assertEqual(layout.overlapping(), [])

    def same_but_turned(self, layout, faces, turned):
        def around(face):  # from its smallest corner on
            first = face.index(min(face))
            return face[first:] + face[:first]
        self.assertEqual(len(layout.faces), len(faces))
        self.assertEqual(turned, sum(f != g for f, g in zip(layout.faces, faces)))
        for got, given in zip(layout.faces, faces):
            self.assertTrue(got == given or around(got) == around(given[::-1]), (got, given))

    def test_flipped_faces(self):
        points, faces = sphere(3)
        flipped = [f[::-1] if k in (5, 6, 40) else f for k, f in enumerate(faces)]
        layout, report = self.unwrap(self.mesh(points, flipped))
        self.assertEqual(self.repaired(report), {'turned_face': 3})
        self.assertEqual(report['repairs'][0]['places'], [5, 6, 40])
        self.same_but_turned(layout, flipped, 3)
        self.assertEqual(layout.overlapping(), [])
        self.judged()

    def test_polygons_that_cross_themselves(self):
        star = [(math.sin(0.8 * math.pi * k), math.cos(0.8 * math.pi * k), 0) for k in range(5)]
        for name, polygon in (('star', star), ('bow', [(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)])):
            with self.subTest(name):
                square = [(x, y, 3) for x, y in ((0, 0), (2, 0), (1, 0.3), (0, 2))]  # concave, but simple
                n = len(polygon)
                mesh = self.mesh(polygon + square, [tuple(range(n)), tuple(range(n, n + 4))])
                _, report = self.unwrap(mesh)
                crossing = [r for r in report['repairs'] if r['kind'] == 'crossing_polygon']
                self.assertEqual([(r['count'], r['places']) for r in crossing], [(1, [0])])
                self.refused(UNSUPPORTED, 'unwrap', mesh, self.path('bad.obj'), '--strict', says='--strict')

    def test_a_fin(self):
        points, faces = sphere(3)
        layout, report = self.clean(self.mesh(points + [(3, 3, 3)], faces + [(*faces[0][:2], len(points))]))
        self.assertEqual(self.repaired(report), {'split_edge': 1})
        self.assertEqual(report['repairs'][0]['places'], [sorted(faces[0][:2])])
        self.assertEqual(sorted(map(len, layout.charts)), [1, len(faces)])

    def test_a_duplicate_face(self):
        points, faces = sphere(3)
        for twin in (faces[7], faces[7][::-1]):
            layout, report = self.clean(self.mesh(points, faces + [twin]))
            self.assertEqual(self.repaired(report), {'duplicate_face': 1})
            self.assertEqual(sorted(map(len, layout.charts)), [1, len(faces)])

    def test_faces_without_area(self):
        points, faces = grid(4, lambda x, y: 0.2 * math.sin(3 * x))
        points[6] = points[7]                                      # edges of no length, too
        points[16] = tuple((a + b) / 2 for a, b in zip(points[11], points[21]))
        points[17] = tuple((a + b) / 2 for a, b in zip(points[16], points[18]))
        layout, report = self.clean(self.mesh(points, faces))
        self.assertEqual(set(self.repaired(report)), {'regularized_face'})
        self.judged()

    def test_a_pinched_vertex(self):
        one, other = sphere(2), sphere(2)
        points, faces = both(one, other)
        meeting = [tuple(0 if v == len(one[0]) else v for v in f) for f in faces]
        layout, report = self.clean(self.mesh(points, meeting))
        self.assertEqual(self.repaired(report), {'split_vertex': 1})
        self.assertEqual(report['repairs'][0]['places'], [0])
        self.assertEqual(len(layout.charts), 2)

    def test_a_soup_is_welded(self):
        layout, report = self.clean(self.mesh(*soup(*sphere(2))))
        self.assertEqual(self.repaired(report), {'welded': 3 * 48 - 26})
        self.assertEqual(len(layout.charts), 1)

    def halves(self):
        """A grid whose two halves share no vertex along the line between them."""
        points, faces = grid(4, lambda x, y: 0)
        copy = {v: len(points) + k for k, v in enumerate(range(10, 15))}
        upper = [tuple(copy.get(v, v) if k >= 16 else v for v in f) for k, f in enumerate(faces)]
        return points + [points[v] for v in copy], upper

    def test_weld_only_when_asked(self):
        mesh = self.mesh(*self.halves())
        self.assertEqual(len(self.clean(mesh)[0].charts), 2)
        layout, report = self.clean(mesh, '--weld', 0)
        self.assertEqual((len(layout.charts), self.repaired(report)), (1, {'welded': 5}))
        points, faces = self.halves()
        moved = [(x + 1e-6, y, z) for x, y, z in points[25:]]
        mesh = self.mesh(points[:25] + moved, faces)
        self.assertEqual(len(self.clean(mesh, '--weld', 0)[0].charts), 2)
        layout, _ = self.unwrap(mesh, '--weld', '1e-5')  # at one place now: that of the first ones
        self.assertEqual(len(layout.charts), 1)
        back = dict(zip(range(25, 30), range(10, 15)))
        self.assertEqual(layout.faces, [tuple(back.get(v, v) for v in f) for f in faces])

    def test_strict_refuses_what_would_be_repaired(self):
        points, faces = sphere(2)
        self.clean(self.mesh(points, faces), '--strict')
        for says, mesh in [('turned', (points, [faces[0][::-1]] + faces[1:])),
                           ('duplicate', (points, faces + faces[:1])),
                           ('edge', (points + [(3, 3, 3)], faces + [(*faces[0][:2], len(points))])),
                           ('area', (points, faces + [(faces[0][0], faces[0][1], faces[0][1])])),
                           ('welded', soup(points, faces)), ('one side', moebius(9))]:
            with self.subTest(says):
                outcome = self.refused(UNSUPPORTED, 'unwrap', self.mesh(*mesh), self.path('bad.obj'),
                                       '--strict', says=(self.path('mesh.obj'), '--strict'))
                self.assertFalse(os.path.exists(self.path('bad.obj')))
                if says not in ('one side', 'area'):
                    self.assertIn(says, outcome.err)


class Proofs(UnwrapTest):
    """What check says of unwrap's files beside the mesh as it was."""

    # Each with another defect, or many; the first of them public.
    PUBLIC = [os.path.join('messy', 'derived', name + '.obj') for name in (
        'duplicate_face', 'fin', 'holes_touching_in_a_vertex', 'klein_bottle', 'moebius', 'pinched_vertex',
        'soup', 'split_at_uv_seams', 't_junctions', 'three_flipped_faces', 'two_rooms_inner_wall',
        'zero_area_faces', 'crack_equal')]

    def prove(self, mesh):
        """True where unwrap maps it; then its files are maps of it."""
        outputs = [self.path('out.' + kind) for kind in ('obj', 'vtu')]
        outcome = majorant('unwrap', mesh, '-o', outputs[0], '-o', outputs[1])
        if outcome.code != OK:
            self.assertEqual(outcome.code, UNREADABLE, outcome.err)
            return False
        commands = re.findall(r'^proof: majorant (.*)$', outcome.err, re.M)
        self.assertEqual(len(commands), 2)
        for command in commands:
            self.run_ok(*shlex.split(command), '--surface', mesh)
        return True

    @where(os.path.join(SHARED, 'data/public/messy'))
    def test_public_defects(self):
        public = os.path.join(SHARED, 'data', 'public')
        for name in self.PUBLIC:
            with self.subTest(name):
                self.assertTrue(self.prove(os.path.join(public, name)))
        bad = os.path.join(public, 'bad')
        proven = sum(self.prove(os.path.join(bad, name)) for name in sorted(os.listdir(bad))
                     if name.endswith('.obj'))
        self.assertGreaterEqual(proven, 26)

    def test_polygons_with_defects(self):
        points, faces = cube(2)
        turned_and_twice = [faces[0][::-1]] + faces[1:] + [faces[5]]
        self.assertTrue(self.prove(self.mesh(points, turned_and_twice)))

    def test_files_that_are_not_of_it(self):
        points, faces = sphere(3)
        fin = faces + [(*faces[0][:2], len(points))]
        mesh = self.mesh(points + [(3, 3, 3)], fin)
        self.assertTrue(self.prove(mesh))
        text = self.read('out.obj').decode()
        lines = text.splitlines()
        first = next(k for k, line in enumerate(lines) if line.startswith('f '))
        spoiled = {
            'a face less': lines[:-1],
            'another place': [line.replace('v 3 3 3', 'v 3 3 3.0001') for line in lines],
        }
        for name, changed in spoiled.items():
            with self.subTest(name):
                self.assertNotEqual(changed, lines)
                path = self.write('spoiled.obj', '\n'.join(changed) + '\n')
                outcome = majorant('check', path, '--surface', mesh)
                self.assertEqual(outcome.code, INVALID, outcome.err)
                self.assertIn('surface: ', outcome.out)
        in_another_order = lines[:first] + lines[first + 1:] + lines[first:first + 1]
        path = self.write('order.obj', '\n'.join(in_another_order) + '\n')
        self.run_ok('check', path, '--surface', mesh)  # the same faces
        other = self.mesh(points + [(3, 3, 3)], [fin[0][::-1]] + fin[1:], name='other.obj')
        self.run_ok('check', self.path('out.vtu'), '--surface', other)  # turned back
        moved = self.mesh(points + [(3, 3, 4)], fin, name='moved.obj')
        for kind in ('obj', 'vtu'):
            self.run_ok('check', self.path('out.' + kind), '--surface', moved, code=INVALID)
            self.run_ok('check', self.path('out.' + kind), '--cuts', 'none', '--surface', mesh,
                        code=INVALID)  # repairs take apart: cuts


if __name__ == '__main__':
    main()
