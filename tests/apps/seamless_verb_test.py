# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""majorant seamless: plain meshes of every kind, cones from files, starts, limits, refusals."""
import json
import signal
import subprocess
import unittest

from command_helpers import *

DIRECTIONS = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]


def octahedron(rounds=0, shape=lambda p: p):
    """Subdivides an octahedron towards the unit sphere; the first 6 vertices are the corners."""
    points = list(DIRECTIONS)
    faces = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    for _ in range(rounds):
        middle, finer = {}, []

        def between(a, b):
            key = min(a, b), max(a, b)
            if key not in middle:
                p = [x + y for x, y in zip(points[a], points[b])]
                length = math.sqrt(sum(x * x for x in p))
                middle[key] = len(points)
                points.append(tuple(x / length for x in p))
            return middle[key]

        for a, b, c in faces:
            d, e, f = between(a, b), between(b, c), between(c, a)
            finer += [(a, d, f), (d, b, e), (f, e, c), (d, e, f)]
        faces = finer
    return [shape(p) for p in points], faces


class Floats(CommandTest):
    def test_formats_that_cannot_hold_seams_are_refused_before_the_work(self):
        mesh, out = generated('buckle'), self.path('a.glb')
        self.refused(USAGE, 'seamless', mesh, '-o', out, says=['a.glb', 'floats', '.obj'])
        offered = majorant('seamless', '--help').out.split('--output')[1].split('repeatable')[0]
        self.assertIn('.ply', offered)
        self.assertNotIn('.glb', offered)
        self.run_ok('seamless', mesh, '-q', '-o', self.path('a.vtu'), '-o', self.path('a.obj'), '--degree', '1')
        self.refused(USAGE, 'parametrize', self.path('a.obj'), '--seamless', '-o', out, says=['a.glb', '.vtu'])
        self.refused(USAGE, 'convert', self.path('a.vtu'), '-o', out, says=['a.glb', '.vtu'])
        self.assertEqual(self.files(), ['a.obj', 'a.vtu'])


def scaled(mesh, factor):
    return [tuple(factor * x for x in p) for p in mesh[0]], mesh[1]


class Seamless(CommandTest):
    def mesh(self, name, points, faces):
        return self.write(name + '.obj', obj_text(points, faces))

    def cones(self, cones, name='cones.json', **more):
        return self.write(name, json.dumps({'cones': cones, **more}))

    def made(self, mesh, *args, code=OK):
        """Runs `seamless`, `check`, tests/checker and verify.py. Returns the report."""
        out, report = self.path('out.vtu'), self.path('report.json')
        self.run_ok('seamless', mesh, '-o', out, '--report', report, '--quiet', *args, code=code)
        self.run_ok('check', out, '--surface', mesh, '--seamless')
        self.judge(out, mesh, '--seamless')
        if os.path.exists(VERIFY):
            done = subprocess.run(['/usr/bin/python3', VERIFY, out, '--mesh', mesh, '--cuts', 'auto',
                                   '--no-energy', '--max-cut-fraction', '1'], capture_output=True)
            self.assertEqual(done.returncode, 0, done.stdout)
        with open(report) as f:
            data = json.load(f)
        self.assertEqual(data['command'], 'seamless')
        self.assertTrue(data['result']['locally_injective'])
        self.assertLess(data['result']['seam_residual_ulp'], 100)
        return data

    def turns(self, data):
        return {c['vertex']: c['quarter_turns'] for c in data['result']['cones']}

    # ---------------------------------------------------------------- meshes
    def test_plain_meshes(self):
        for name, mesh, euler in (('octahedron', octahedron(), 2), ('sphere', octahedron(2), 2),
                                  ('needle', octahedron(2, lambda p: (p[0], p[1], 40 * p[2])), 2),
                                  ('torus', torus(12, 8, 0), 0)):
            with self.subTest(name):
                data = self.made(self.mesh(name, *mesh), '--degree', 2)
                self.assertEqual(sum(4 - q for q in self.turns(data).values()), 4 * euler)
                self.assertIn(data['options']['init'], ('field', 'scaled-field'))

    def test_the_shipped_buckle(self):
        data = self.made(generated('buckle'), '--degree', 1)
        self.assertEqual(data['input']['euler_characteristic'], 0)
        self.assertLess(data['result']['value'], 4.2)
        self.assertEqual(data['options']['init'], 'field')
        start = data['seam_start']
        self.assertEqual(start['inverted'] > 0, start['untangling_steps'] > 0)
        # A ring: its seams run around it and to its cones, with several edges per chain.
        self.assertGreaterEqual(start['chains'], 2)
        self.assertGreater(start['seam_edges'], start['chains'])

    def test_scale_does_not_matter(self):
        values = [self.made(self.mesh('s', *scaled(octahedron(2), s)), '--degree', 1)['result']['value']
                  for s in (1, 1e-6, 1e6)]
        for value in values[1:]:
            self.assertAlmostEqual(value, values[0], delta=1e-6 * values[0])

    def test_bounded_meshes(self):
        disk = self.mesh('disk', *grid(6))
        self.assertEqual(self.turns(self.made_bounded(disk)), {})
        data = self.made_bounded(disk, '--cones', self.cones([{'vertex': 24, 'quarter_turns': 3}]))
        self.assertEqual(self.turns(data), {24: 3})
        self.made_bounded(self.mesh('hole', *torus(12, 8, 2)))

    def made_bounded(self, mesh, *args):
        out, report = self.path('out.vtu'), self.path('report.json')
        self.run_ok('seamless', mesh, '-o', out, '--report', report, '--degree', 1, *args)
        self.run_ok('check', out, '--surface', mesh)
        with open(report) as f:
            data = json.load(f)
        data['result'].setdefault('cones', [])
        return data

    # ---------------------------------------------------------------- cones
    def test_cones_from_a_file(self):
        sphere = self.mesh('sphere', *octahedron(3))
        pillow = [{'vertex': v, 'quarter_turns': 2} for v in range(4)]
        forms = {'turns': self.cones(pillow), 'base 1': self.cones(
                     [{'vertex': v + 1, 'index': 0.5} for v in range(4)], 'b.json', index_base=1)}
        for form, path in forms.items():
            for start in ('automatic', 'field', 'scaled-field', 'conformal'):
                with self.subTest(form + ' ' + start):
                    data = self.made(sphere, '--cones', path, '--start', start, '--degree', 1)
                    self.assertEqual(self.turns(data), {0: 2, 1: 2, 2: 2, 3: 2})
                    if start != 'automatic':
                        self.assertEqual(data['options']['init'], start)

    def test_no_cones(self):
        """An empty list requests a map without cones; it does not mean automatic cones."""
        for m, n in (3, 3), (12, 8):
            data = self.made(self.mesh('torus', *torus(m, n, 0)), '--degree', 1, '--cones',
                             self.cones([]))
            self.assertEqual(self.turns(data), {})
        self.refused(USAGE, 'seamless', self.mesh('sphere', *octahedron(1)), '-o',
                     self.path('out.vtu'), '--cones', self.cones([]), says='must be 8')

    def test_impossible_cones(self):
        """A torus with one cone of 270 and one of 450 degrees has no seamless map."""
        mesh = self.mesh('torus', *torus(12, 8, 0))
        cones = self.cones([{'vertex': 5, 'quarter_turns': 3}, {'vertex': 60, 'quarter_turns': 5}])
        self.refused(INVALID, 'seamless', mesh, '-o', self.path('out.vtu'), '--cones', cones,
                     says=('torus.obj', 'no injective seamless map', 'cone', '--cones'))
        self.assertNotIn('out.vtu', self.files())

    def test_refused_cones(self):
        sphere, disk = self.mesh('sphere', *octahedron(2)), self.mesh('disk', *grid(4))
        eight = [{'vertex': v, 'quarter_turns': 3} for v in range(8)]
        twelve = [{'vertex': v, 'quarter_turns': 3} for v in range(6, 18)]
        for mesh, cones, code, says in (
                (sphere, eight[1:], USAGE, 'must be 8'),
                (sphere, twelve + [{'vertex': 0, 'quarter_turns': 8}], USAGE, 'hold'),
                (disk, eight[:1], USAGE, 'boundary'),
                (sphere, eight + [{'vertex': 0, 'quarter_turns': 2}], UNREADABLE, 'two different'),
                (sphere, [{'vertex': 99999, 'quarter_turns': 3}], UNREADABLE, 'out of range'),
                (sphere, [{'vertex': 1, 'index': 0.3}], UNREADABLE, 'whole number'),
                (sphere, [{'vertex': 1, 'quarter_turns': 0}], UNREADABLE, 'whole number')):
            with self.subTest(says):
                self.refused(code, 'seamless', mesh, '-o', self.path('out.vtu'), '--cones',
                             self.cones(cones), says=says)

    def test_conformal_needs_a_sphere_or_a_disk(self):
        self.refused(USAGE, 'seamless', self.mesh('torus', *torus(8, 6, 0)), '-o',
                     self.path('out.vtu'), '--start', 'conformal', says='sphere or a disk')

    # ---------------------------------------------------------------- options
    def test_curvature_alignment(self):
        plain = self.made(generated('buckle'), '--degree', 1)
        aligned = self.made(generated('buckle'), '--degree', 1, '--curvature-alignment', 20)
        self.assertGreaterEqual(len(self.turns(aligned)), len(self.turns(plain)))

    def test_pins_and_handles_on_cones(self):
        sphere = self.mesh('sphere', *octahedron(2))
        cones = self.cones([{'vertex': v, 'quarter_turns': 2} for v in range(4)])
        held = self.write('held.json', json.dumps(
            {'handles': [{'vertex': v, 'target': 'initial'} for v in (0, 10, 40)]}))
        for option in '--pins', '--handles':
            data = self.made(sphere, '--cones', cones, option, held, '--degree', 2)
            self.assertLess(data['result']['constraint_residual'], 1e-9)

    def test_limits(self):
        for limit in (['--max-iterations', 0], ['--max-iterations', 1], ['--time-limit', 0]):
            data = self.made(generated('buckle'), '--degree', 2, *limit, code=LIMIT)
            self.assertEqual(data['result']['degree'], 2)

    def test_ctrl_c(self):
        out = self.path('out.vtu')
        process = subprocess.Popen(
            [BINARY, 'seamless', generated('buckle'), '-o', out, '--degree', '8', '--tolerance',
             '1e-13', '--verbose'], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE, text=True)
        try:
            for line in process.stderr:
                if 'degree 1 ' in line:
                    break
            process.send_signal(signal.SIGINT)
            rest = process.stderr.read()
            self.assertEqual(process.wait(60), LIMIT, rest)
        finally:
            process.kill()
            process.stderr.close()
        self.run_ok('check', out, '--surface', generated('buckle'), '--seamless')

    def test_two_components_are_refused(self):
        points, faces = octahedron()
        both = points + [(x + 5, y, z) for x, y, z in points]
        self.refused(UNSUPPORTED, 'seamless',
                     self.mesh('two', both, faces + [tuple(v + 6 for v in f) for f in faces]), '-o',
                     self.path('out.vtu'), says='component')


class FarTextures(CommandTest):
    """Translations of free maps are arbitrary: distant texture coordinates lose no digits."""

    def test_far_and_huge(self):
        square = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.1), (1.0, 1.0, 0.0), (0.0, 1.0, 0.1)]
        faces = [(0, 1, 2), (0, 2, 3)]
        for name, scale, shift in (('far', 1.0, 1e9), ('huge', 1e8, 1e8), ('near', 1.0, 3.0)):
            with self.subTest(name):
                uv = [(scale * x + shift, scale * y) for x, y, _ in square]
                mesh = self.write(name + '.obj', obj_text(square, faces, uv))
                out = self.path('out.vtu')
                self.run_ok('parametrize', mesh, '-o', out, '--degree', 1, '--seamless', '--quiet')
                self.run_ok('check', out, '--surface', mesh)
                largest = max(abs(x) for p in Vtu(out).rows('uv') for x in p)
                self.assertLess(largest, 10)


if __name__ == '__main__':
    main()
