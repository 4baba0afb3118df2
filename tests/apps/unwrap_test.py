# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""majorant unwrap: any mesh becomes charts side by side; files and numbers of the report."""
import json
import os
import re
import shlex
import xml.etree.ElementTree as xml

from command_helpers import *
from unwrap_helpers import *


class Surfaces(UnwrapTest):
    def test_closed_ones_of_any_genus(self):
        for name, mesh, charts in [('cube', (cube(3)[0], triangles(cube(3)[1])), 1),
                                   ('sphere', sphere(4), 1), ('torus', torus(12, 8, 0), 1),
                                   ('two', both(sphere(3), torus(12, 8, 0)), 2)]:
            with self.subTest(name):
                layout, report = self.clean(self.mesh(*mesh), '--fill', 0)
                self.judged()
                self.assertEqual((report['status'], report['repairs']), ('converged', []))
                self.assertEqual(len(layout.charts), charts)
                self.assertGreater(report['result']['seam_length'], 0)
                self.assertEqual(report['result']['degree'], 1)

    def test_a_cube_is_unfolded_whole(self):
        _, report = self.clean(self.mesh(cube(3)[0], triangles(cube(3)[1])), '--fill', 0)
        self.assertAlmostEqual(report['result']['value'], 4, places=9)
        self.assertAlmostEqual(report['result']['stretch_max'], 1, places=5)
        self.assertAlmostEqual(report['result']['seam_length'], 7, places=9)

    def test_one_scale_for_all(self):
        """A developable surface keeps all its lengths beside any other chart."""
        flat = grid(3, lambda x, y: 0)
        layout, report = self.clean(self.mesh(*both(flat, sphere(3))), '--scale', 'model')
        k = next(k for k, chart in enumerate(layout.charts) if 0 in chart)
        area = sum(layout.area(face) for face in layout.charts[k]) / 2 / layout.scale ** 2
        self.assertAlmostEqual(area, 1, places=6)

    def test_no_verb_means_unwrap(self):
        mesh = self.mesh(*torus(8, 6, 0))
        self.run_ok(mesh, self.path('plain.obj'))
        self.run_ok('unwrap', mesh, self.path('named.obj'))
        self.assertEqual(self.read('plain.obj'), self.read('named.obj'))
        self.run_ok(mesh, '-o', self.path('more.obj'), '--quiet', '--normalize')

    def test_threads_change_nothing(self):
        mesh = self.mesh(*both(sphere(3), torus(8, 6, 0)))
        for threads in (1, 2):
            self.run_ok('unwrap', mesh, '-o', self.path('%d.obj' % threads), '--threads', threads)
        self.assertEqual(self.read('1.obj'), self.read('2.obj'))

    def test_no_time_at_all(self):
        _, report = self.clean(self.mesh(*both(sphere(4), torus(12, 8, 0))), '--time-limit', 0,
                               code=LIMIT)
        self.judged()
        self.assertEqual(report['status'], 'time_limit')

    def test_charts_that_did_not_converge_are_named(self):
        mesh = self.mesh(*both(sphere(4), torus(12, 8, 0)))
        outcome = self.run_ok('unwrap', mesh, self.path('a.obj'), '--max-iterations', 1, code=LIMIT)
        for start in ('chart 1 (face 1 and 191 more): max_iterations',
                      'chart 2 (face 193 and 191 more): max_iterations'):
            self.assertIn('%s: %s' % (mesh, start), outcome.err)

    def test_any_scale(self):
        """Scaling by a power of two keeps the digits, also with pins and in the unit square."""
        points, faces = both(sphere(3), torus(8, 6, 0))
        corners, squares = {}, {}
        for power in (0, -498, -332, 332, 498):
            factor = 2.0 ** power
            mesh = self.mesh([tuple(factor * x for x in p) for p in points], faces)
            pins = self.write('pins.json', json.dumps({'handles': [
                {'vertex': 0, 'target': [3 * factor, 4 * factor]}]}))
            _, report = self.unwrap(mesh, '--pins', pins)
            corners[power] = self.corners('out.obj', factor)
            self.assertIn((3, 4), corners[power])
            self.assertEqual(corners[power], corners[0], power)
            for key in ('seam_length', 'side', 'distance'):
                report['result'][key] /= factor
            for key in ('seam_length', 'side', 'distance', 'fill', 'value', 'stretch_l2'):
                self.assertAlmostEqual(report['result'][key], self.first(key, report), places=9)
            self.run_ok('unwrap', mesh, '-o', self.path('square.obj'), '--normalize')
            squares[power] = self.corners('square.obj', 1)
            self.assertEqual(squares[power], squares[0], power)
        for factor in (1e200, 1e-200):
            mesh = self.mesh([tuple(factor * x for x in p) for p in points], faces)
            for verb in ('unwrap', 'parametrize'):
                self.refused(UNSUPPORTED, verb, mesh, self.path('none.obj'),
                             says=('mesh.obj', 'range of doubles', 'scale the mesh'))
            self.assertFalse(os.path.exists(self.path('none.obj')))
        # Differences of these coordinates overflow.
        largest = max(abs(x) for p in points for x in p)
        mesh = self.mesh([tuple(1.7e308 * (x / largest) for x in p) for p in points], faces)
        self.refused(UNSUPPORTED, 'unwrap', mesh, self.path('none.obj'),
                     says=('mesh.obj', 'range of doubles', 'scale the mesh'))

    def corners(self, name, factor):
        """Returns the coordinates of each corner of each face, divided by the factor."""
        _, uv, _, texture = read_obj(self.path(name))
        return [tuple(x / factor for x in uv[t]) for face in texture for t in face]

    def first(self, key, report):
        """Returns the value in the first report."""
        self.firsts = getattr(self, 'firsts', {})
        return self.firsts.setdefault(key, report['result'][key])

    def test_pieces_without_area_are_taken_apart(self):
        flat, faces = grid(3, lambda x, y: 0)
        for name, points in [('line', [(p[0], 0, 0) for p in flat]),
                             ('slanted line', [(p[0] / 3, p[0] / 7, p[0] / 11) for p in flat]),
                             ('point', [(1, 1, 1) for _ in flat])]:
            with self.subTest(name):
                _, report = self.unwrap(self.mesh(points, faces))
                self.assertEqual(report['status'], 'converged')
                self.assertEqual(len(report['charts']), len(faces))

    def test_a_grid_of_slivers_is_one_chart(self):
        flat, faces = grid(6, lambda x, y: 0)
        mesh = self.mesh([(1e6 * p[0], 1e-7 * p[1], 0) for p in flat], faces)
        _, report = self.unwrap(mesh, '--charts', 'one')  # auto would divide the long chart to fill the square
        self.assertEqual(len(report['charts']), 1)

    def test_faces_smaller_than_rounding_leave_a_valid_file(self):
        """Twelfth powers as spacings: the smallest edges are 1e-16 of the largest."""
        n = 20
        points = [((i / n) ** 12, (j / n) ** 12, 0) for i in range(n + 1) for j in range(n + 1)]
        faces = [f for a in (i * (n + 1) + j for i in range(n) for j in range(n))
                 for f in ((a, a + n + 1, a + n + 2), (a, a + n + 2, a + 1))]
        _, report = self.unwrap(self.mesh(points, faces))
        self.assertEqual([o['written'] for o in report['outputs']], [True])

    def test_polygons_of_one_vertex(self):
        mesh = self.mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 0, 0, 0), (0, 1, 0, 2), (0, 1, 2)])
        self.assertEqual(self.unwrap(mesh)[1]['status'], 'converged')

    def test_a_piece_far_smaller_than_the_rest(self):
        points, faces = sphere(2)
        tiny = [tuple(1e-100 * x for x in p) for p in points]
        both_faces = faces + [tuple(k + len(points) for k in f) for f in faces]
        self.refused(UNSUPPORTED, 'unwrap', self.mesh(points + tiny, both_faces), self.path('a.obj'),
                     says=['piece of face %d' % (len(faces) + 1), 'file of its own'])

    def test_far_from_the_origin(self):
        points, faces = sphere(3)
        far = [tuple(x * 1e-3 + 1e6 for x in p) for p in points]
        layout, report = self.clean(self.mesh(far, faces))
        self.assertEqual(self.repaired(report), {'moved_to_origin': 1})
        self.assertEqual([tuple(p) for p in layout.v], far)  # the vertices are not moved


class Files(UnwrapTest):
    def test_curved(self):
        mesh = self.mesh(*both(sphere(2), torus(6, 4, 0)))
        values = []
        for degree in (1, 2, 3):
            out = self.path('%d.vtu' % degree)
            outcome = self.run_ok('unwrap', mesh, '-o', out, '-o', self.path('%d.obj' % degree),
                                  '--degree', degree, '--refine', 2, '--max-stretch', 1.1, '--fill', 0,  # options for equal cuts
                                  '--report', self.path('r.json'))
            for line in re.findall(r'^proof: majorant (.*)$', outcome.err, re.M):
                self.run_ok(*shlex.split(line))
            self.judge_alone(out, '--cuts', 'free', '--overlap')
            self.judge_alone(self.path('%d.obj' % degree), '--cuts', 'free', '--overlap')
            with open(self.path('r.json')) as f:
                result = json.load(f)['result']
            values.append(result['value'])
            vtu = Vtu(out)
            self.assertEqual(sorted(set(vtu.arrays['chart'])), [0, 1])
            self.assertEqual(vtu.arrays['chart'].count(0), 48)
            self.assertEqual(len(vtu.arrays['input_face']), 96)
            self.assertEqual(vtu.claims['bijective'], True)
            layout = Layout(self.path('%d.obj' % degree))
            self.assertGreaterEqual(len(layout.faces), 4 * 96)
            self.assertEqual(layout.overlapping(), [])
        self.assertGreater(values[0], values[1])
        self.assertGreater(values[1], values[2])

    def test_picture(self):
        mesh = self.mesh(*both(sphere(2), torus(6, 4, 0)))
        self.run_ok('unwrap', mesh, '-o', self.path('a.svg'), '--grid')
        root = xml.parse(self.path('a.svg')).getroot()
        self.assertTrue(root.tag.endswith('svg'))
        self.assertEqual(self.read('a.svg').count(b'nan'), 0)

    MODEL = '''mtllib paint.mtl
o thing
v 0 0 0 0.5 0.25 1
v 1 0 0 1 0 0
v 1 1 0 0 1 0
v 0 1 0 0 0 1
v 0 0 1 0 0 0
v 1 0 1 1 1 1
v 1 1 1 0.5 0.5 0.5
v 0 1 1 0.25 0.25 0.25
v 9 9 9 0 0 0
vn 0 0 -1
vn 0 0 1
g low
s 1
usemtl red paint
f 1//1 4//1 3//1 2//1
g high
f 5//2 6//2 7//2 8//2
usemtl blue
s off
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5
f 4 5 8
p 9
l 1 9
'''

    def test_everything_but_vt_is_as_given(self):
        mesh = self.write('model.obj', self.MODEL)
        self.write('paint.mtl', 'newmtl red paint\nnewmtl blue\n')
        layout, report = self.clean(mesh)
        kept = []
        for line in layout.text.splitlines():
            words = line.split()
            if words and words[0] not in ('vt', '#'):
                if words[0] == 'f':
                    corners = [(c.split('/') + ['', ''])[:3] for c in words[1:]]
                    words[1:] = [v + '//' + n if n else v for v, _, n in corners]
                kept.append(words)
        expected = [line.split() for line in self.MODEL.splitlines()]
        for words in (['v'], ['vn'], None):  # each kind keeps its order, faces also among groups and materials
            def of_kind(lines):
                return [l for l in lines if (l[0] in words if words else l[0] not in ('v', 'vn'))]
            self.assertEqual(of_kind(kept), of_kind(expected))
        self.assertEqual(report['input']['faces'], 12)
        os.mkdir(self.path('other'))
        self.run_ok('unwrap', mesh, '-o', self.path('other/out.obj'))
        self.assertIn(b'mtllib ../paint.mtl', self.read('other/out.obj'))

    def test_several_at_once(self):
        mesh = self.mesh(*torus(6, 4, 0))
        self.run_ok('unwrap', mesh, self.path('a.obj'), '-o', self.path('a.vtu'), '-o',
                    self.path('a.svg'), '-o', self.path('a.json'), '--quiet')
        self.assertEqual(self.files(), ['a.json', 'a.obj', 'a.svg', 'a.vtu', 'mesh.obj'])
        with open(self.path('a.json')) as f:
            report = json.load(f)
        self.assertEqual([o['file'] for o in report['outputs']],
                         [self.path(n) for n in ('a.vtu', 'a.svg', 'a.obj')])
        self.refused(USAGE, 'unwrap', mesh, self.path('a.csv'), says='.csv')
        self.refused(USAGE, 'unwrap', mesh, says='output')
        self.refused(USAGE, 'unwrap', mesh, '-o', '/dev/full', says=('/dev/full', 'no extension', '.obj'))

    def test_numbers_of_the_report_are_those_of_the_layout(self):
        points, faces = both(sphere(2), torus(6, 4, 0))
        layout, report = self.clean(self.mesh(points, faces), '--scale', 'model', '--fill', 0)
        sides = {}
        for face, texture in zip(layout.faces, layout.texture):
            for i in range(3):
                sides.setdefault(frozenset((face[i - 1], face[i])), []).append(
                    frozenset((texture[i - 1], texture[i])))
        seam = [edge for edge, used in sides.items() if len(set(used)) == 2]
        length = sum(math.dist(*(points[v] for v in edge)) for edge in seam)
        self.assertEqual(report['result']['seam_edges'], len(seam))
        self.assertAlmostEqual(report['result']['seam_length'], length, places=9)
        area = report['input']['area']
        self.assertAlmostEqual(report['result']['seam_length_relative'], length / math.sqrt(area))
        self.assertEqual([chart['faces'] for chart in report['charts']], [48, 48])
        self.assertAlmostEqual(sum(chart['area'] for chart in report['charts']), area)
        value = sum(chart['area'] * chart['value'] for chart in report['charts']) / area
        self.assertAlmostEqual(report['result']['value'], value)
        self.assertAlmostEqual(report['result']['value'], self.energy(points, layout), places=6)

    def energy(self, points, layout):
        """Returns the mean symmetric Dirichlet energy of the written digits, from cotangents and edges."""
        total = area = 0
        for k, (face, texture) in enumerate(zip(layout.faces, layout.texture)):
            p, q = ([c[i] for i in f] for c, f in ((points, face), (layout.uv, texture)))
            q = [tuple(x / layout.scale for x in a) for a in q]
            dirichlet, doubled = [], []
            for own, other in ((p, q), (q, p)):  # the map from own to other
                a, b, c = (math.dist(own[i - 2], own[i - 1]) for i in range(3))
                twice = math.sqrt((a + b + c) * (b + c - a) * (a + c - b) * (a + b - c)) / 2
                squares = [a * a, b * b, c * c]
                cots = [(sum(squares) - 2 * s) / (2 * twice) for s in squares]
                far = [math.dist(other[i - 2], other[i - 1]) ** 2 for i in range(3)]
                dirichlet.append(sum(c * f for c, f in zip(cots, far)))  # twice the area times |J|^2
                doubled.append(twice)
            total += dirichlet[0] / 2 + dirichlet[1] / 2 * doubled[0] / doubled[1]
            area += doubled[0] / 2
        return total / area


if __name__ == '__main__':
    main()
