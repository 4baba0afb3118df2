# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""majorant unwrap of meshes with defects: repairs, and proofs that its files are maps of them."""
import json
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
        layout, report = self.unwrap(mesh, '--fill', 0)
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
        def around(face):  # starting at its smallest corner
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
                square = [(x, y, 3) for x, y in ((0, 0), (2, 0), (1, 0.3), (0, 2))]  # concave and simple
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
            layout, report = self.clean(self.mesh(points, faces + [twin]), '--fill', 0)
            self.assertEqual(self.repaired(report), {'duplicate_face': 1})
            self.assertEqual(sorted(map(len, layout.charts)), [1, len(faces)])

    def test_faces_without_area(self):
        points, faces = grid(4, lambda x, y: 0.2 * math.sin(3 * x))
        points[6] = points[7]                                      # also edges without length
        points[16] = tuple((a + b) / 2 for a, b in zip(points[11], points[21]))
        points[17] = tuple((a + b) / 2 for a, b in zip(points[16], points[18]))
        layout, report = self.clean(self.mesh(points, faces))
        self.assertEqual(set(self.repaired(report)), {'regularized_face'})
        self.judged()

    def test_a_pinched_vertex(self):
        one, other = sphere(2), sphere(2)
        points, faces = both(one, other)
        meeting = [tuple(0 if v == len(one[0]) else v for v in f) for f in faces]
        layout, report = self.clean(self.mesh(points, meeting), '--charts', 'one')
        self.assertEqual(self.repaired(report), {'split_vertex': 1})
        self.assertEqual(report['repairs'][0]['places'], [0])
        self.assertEqual(len(layout.charts), 2)

    def test_a_soup_is_welded(self):
        layout, report = self.clean(self.mesh(*soup(*sphere(2))), '--fill', 0)
        self.assertEqual(self.repaired(report), {'welded': 3 * 48 - 26})
        self.assertEqual(len(layout.charts), 1)

    def halves(self):
        """Returns a grid whose two halves share no vertex along the line between them."""
        points, faces = grid(4, lambda x, y: 0)
        copy = {v: len(points) + k for k, v in enumerate(range(10, 15))}
        upper = [tuple(copy.get(v, v) if k >= 16 else v for v in f) for k, f in enumerate(faces)]
        return points + [points[v] for v in copy], upper

    def test_weld(self):
        mesh = self.mesh(*self.halves())
        self.assertEqual(len(self.clean(mesh, '--weld', 'no')[0].charts), 2)
        for words in ([], ['--weld', 'auto'], ['--weld', 0]):
            layout, report = self.clean(mesh, *words)
            self.assertEqual((len(layout.charts), self.repaired(report)), (1, {'welded': 5}))
            self.assertEqual(report['repairs'][0]['pieces'], {'before': 2, 'after': 1})
        self.assertIn('2 pieces before, 1 after', self.run_ok('unwrap', mesh, self.path('o.obj')).err)
        refused = self.refused(UNSUPPORTED, 'unwrap', mesh, self.path('p.obj'), '--weld', 1000,
                               says=['vertices 1000 apart cannot be welded', 'edges of 0.25 and less'])
        usable = re.search(r'such as ([0-9.e-]+)$', refused.err.strip())[1]
        self.assertEqual(len(self.clean(mesh, '--weld', usable)[0].charts), 1)
        edges = self.write('edges.json', '{"edges": []}')  # edges by vertex number
        self.assertEqual(len(self.clean(mesh, '--seams', edges)[0].charts), 2)
        for word in ('yes', '-1', 'inf', 'nan', ''):
            self.refused(USAGE, 'unwrap', mesh, self.path('o.obj'), '--weld', word, says='--weld')
        points, faces = self.halves()
        moved = [(x + 1e-6, y, z) for x, y, z in points[25:]]
        mesh = self.mesh(points[:25] + moved, faces)
        for words in ([], ['--weld', 0]):
            self.assertEqual(len(self.clean(mesh, *words)[0].charts), 2)
        layout, _ = self.unwrap(mesh, '--weld', '1e-5')  # both are now at the place of the first ones
        self.assertEqual(len(layout.charts), 1)
        back = dict(zip(range(25, 30), range(10, 15)))
        self.assertEqual(layout.faces, [tuple(back.get(v, v) for v in f) for f in faces])

    def test_strict_refuses_defects_that_repair_handles(self):
        points, faces = sphere(2)
        self.clean(self.mesh(points, faces), '--strict')
        self.assertEqual(len(self.clean(self.mesh(*self.halves()), '--strict')[0].charts), 1)  # without repair
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


class SplitExports(UnwrapTest):
    """Meshes of exporters with a vertex for every different attribute. They are still one surface."""

    def export(self, points, faces, key, texture=None):
        """Writes an OBJ with a vertex for each (place, key(face, corner)), normals and distinctive materials."""
        number, lines, body = {}, [], []
        for k, face in enumerate(faces):
            corners = []
            for i, v in enumerate(face):
                one = (v, key(k, i))
                if one not in number:
                    number[one] = len(number) + 1
                    lines.append('v %r %r %r' % tuple(map(float, points[v])))
                corners.append(number[one])
            if k % 3 == 0:
                body.append('usemtl stuff%d' % (k % 2))
            uv = texture and texture(k)
            if uv:
                lines += ['vt %r %r' % tuple(map(float, p)) for p in uv]
                first = sum(line.startswith('vt ') for line in lines) - len(uv)
                body.append('f ' + ' '.join('%d/%d/1' % (c, first + i + 1) for i, c in enumerate(corners)))
            else:
                body.append('f ' + ' '.join('%d//1' % c for c in corners))
        return self.write('export.obj', '\n'.join(lines + ['vn 0 0 1'] + body) + '\n')

    def exports(self, points, faces):
        """Yields (name, key) of the attributes by which exporters split vertices."""
        def normal(k, i):
            a, b, c = (points[v] for v in faces[k][:3])
            u, w = [x - y for x, y in zip(b, a)], [x - y for x, y in zip(c, a)]
            n = (u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0])
            return tuple(round(x / math.hypot(*n), 1) for x in n)
        yield 'normals', normal
        yield 'uv seams', lambda k, i: sum(points[v][0] for v in faces[k]) > 0
        yield 'materials', lambda k, i: k // 3 % 2
        yield 'all corners', lambda k, i: (k, i)

    def same_files(self, export):
        """Tests that vertices, faces, normals and materials are the input's, also the VTU's vertices of corners."""
        kinds = ('v ', 'vn ', 'usemtl')
        lines = [[line for line in text.decode().splitlines() if line.startswith(kinds)]
                 for text in (self.read('export.obj'), self.read('out.obj'))]
        self.assertEqual(len(lines[0]), len(lines[1]))
        for kind in kinds:
            numbers = [[l.split()[1:] for l in part if l.startswith(kind)] for part in lines]
            if kind != 'usemtl':
                numbers = [[list(map(float, l)) for l in part] for part in numbers]
            self.assertEqual(*numbers)
        vtu, faces = Vtu(self.path('out.vtu')), read_obj(export)[2]
        for cell, face in zip(vtu.cells(), vtu.arrays['input_face']):
            named = [vtu.arrays['input_vertex'][p] for p in cell[:3]]
            self.assertLessEqual(set(named), set(faces[face]))
            self.assertEqual(len(set(named)), 3)

    def prove(self, points, faces):
        # Materials are creases, so that the whole mesh gets the materials of the exports.
        whole, report = self.unwrap(self.export(points, faces, lambda k, i: 0))
        for name, key in self.exports(points, faces):
            with self.subTest(name):
                export = self.export(points, faces, key)
                layout, of_export = self.unwrap(export)
                self.assertEqual(len(layout.charts), len(whole.charts))
                self.assertEqual(layout.faces, read_obj(export)[2])
                self.assertEqual([r['kind'] for r in of_export['repairs']], ['welded'])
                pieces = of_export['repairs'][0]['pieces']
                self.assertEqual(pieces['after'], report['input']['components'])
                self.assertGreater(pieces['before'], 1)
                self.run_ok('unwrap', export, '-o', self.path('out.vtu'))
                for out in ('out.obj', 'out.vtu'):
                    self.run_ok('check', self.path(out), '--surface', export, '--certify')
                    if len(faces) < 500:  # the test takes quadratic time
                        self.judge_alone(self.path(out), '--cuts', 'free', '--overlap', '--may-touch', '--surface',
                                         export)
                self.same_files(export)

    def test_one_surface(self):
        self.prove(*cube(3))
        self.prove(*sphere(4))
        self.prove(*both(sphere(3), grid(3, lambda x, y: x * y)))

    def test_cards_stay_two(self):
        points, faces = grid(2, lambda x, y: 0.1 * x * x)
        both_sides = faces + [face[::-1] for face in faces]
        n = len(faces)
        for name, key in [('sides', lambda k, i: k >= n), ('faces', lambda k, i: k),
                          ('pairs', lambda k, i: (k >= n, k % n // 2))]:
            with self.subTest(name):
                export = self.export(points, both_sides, key)
                layout, _ = self.clean(export)
                self.assertEqual(sorted(map(len, layout.charts)), [n, n])
                self.run_ok('check', self.path('out.obj'), '--surface', export, '--certify')

    def test_old_seams(self):
        points, faces = grid(4, lambda x, y: 0)
        side = lambda k: sum(points[v][0] for v in faces[k]) / len(faces[k]) < 0.5
        uv = lambda k: [(points[v][0] + 5 * side(k), points[v][1]) for v in faces[k]]
        for name, key in [('whole', lambda k, i: 0), ('split', lambda k, i: side(k)),
                          ('all corners', lambda k, i: (k, i))]:
            with self.subTest(name):
                mesh = self.export(points, faces, key, uv)
                self.assertEqual(len(self.clean(mesh)[0].charts), 1)
                self.assertEqual(len(self.clean(mesh, '--keep-seams')[0].charts), 2)
                self.assertEqual(len(self.clean(mesh, '--seams', 'sharp', '--keep-seams')[0].charts), 2)

    def test_pins_of_joined_vertices(self):
        points, faces = grid(2, lambda x, y: 0.1 * x * y)
        mesh = self.export(points, faces, lambda k, i: k // 3)
        vertices = read_obj(mesh)[0]
        corner = vertices.index(max(vertices))
        last = len(vertices) - 1 - vertices[::-1].index(vertices[faces[0][2]])  # a copy that is replaced by another vertex
        for vertex in (corner, last):
            pins = self.write('pins.json', json.dumps({'handles': [{'vertex': vertex, 'target': [3, 4]}]}))
            self.run_ok('unwrap', mesh, '-o', self.path('o.vtu'), '--pins', pins)
            vtu = Vtu(self.path('o.vtu'))
            found = {uv[:2] for v, uv in zip(vtu.arrays['input_vertex'], vtu.rows('uv')) if v == vertex}
            self.assertEqual(found, {(3.0, 4.0)})

    @where(os.path.join(SHARED, 'data/public/closed'))
    def test_public(self):
        points, _, faces, _ = read_obj(os.path.join(SHARED, 'data/public/closed/spot_1654.obj'))
        self.prove(points, faces)


class Proofs(UnwrapTest):
    """Verdicts of check on unwrap's files with the original mesh."""

    # Each mesh has other defects; the first ones are public.
    PUBLIC = [os.path.join('messy', 'derived', name + '.obj') for name in (
        'duplicate_face', 'fin', 'holes_touching_in_a_vertex', 'klein_bottle', 'moebius', 'pinched_vertex',
        'soup', 'split_at_uv_seams', 't_junctions', 'three_flipped_faces', 'two_rooms_inner_wall',
        'zero_area_faces', 'crack_equal')]

    def prove(self, mesh):
        """Returns whether unwrap maps the mesh; its files must then be maps of it."""
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

    def test_files_of_another_surface_are_not_proven(self):
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
        self.run_ok('check', path, '--surface', mesh)  # the faces are equal
        other = self.mesh(points + [(3, 3, 3)], [fin[0][::-1]] + fin[1:], name='other.obj')
        self.run_ok('check', self.path('out.vtu'), '--surface', other)  # the orientation is restored
        moved = self.mesh(points + [(3, 3, 4)], fin, name='moved.obj')
        for kind in ('obj', 'vtu'):
            self.run_ok('check', self.path('out.' + kind), '--surface', moved, code=INVALID)
            self.run_ok('check', self.path('out.' + kind), '--cuts', 'none', '--surface', mesh,
                        code=INVALID)  # repairs separate parts, which makes cuts


if __name__ == '__main__':
    main()
