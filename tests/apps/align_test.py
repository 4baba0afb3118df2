# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Layouts turned until the longer side of their smallest enclosing rectangle is horizontal: data files by --align and
--normalize, before they are certified and with claims; pictures and pages."""
import base64
import json
import math
import re
import struct
import subprocess

from command_helpers import *


def hull(points):
    """Returns the corners of the convex hull, counterclockwise."""
    points, chains = sorted(set(points)), []
    for ordered in (points, points[::-1]):
        chain = []
        for p in ordered:
            while len(chain) > 1 and ((chain[-1][0] - chain[-2][0]) * (p[1] - chain[-1][1]) <=
                                      (chain[-1][1] - chain[-2][1]) * (p[0] - chain[-1][0])):
                chain.pop()
            chain.append(p)
        chains += chain[:-1]
    return chains


def extents(points, x, y):
    """Returns the extents along (x, y) and across."""
    along, across = [x * u + y * v for u, v in points], [x * v - y * u for u, v in points]
    return max(along) - min(along), max(across) - min(across)


def smallest_area(points):
    """Returns the least area of rectangles with a side along an edge of the hull; one of them is the smallest of
    all."""
    corners, least = hull(points), math.inf
    for p, q in zip(corners, corners[1:] + corners[:1]):
        length = math.dist(p, q)
        width, height = extents(corners, (q[0] - p[0]) / length, (q[1] - p[1]) / length)
        least = min(least, width * height)
    return least


class Align(CommandTest):
    def assert_lies(self, uv):
        points = [tuple(p[:2]) for p in uv]
        width, height = extents(points, 1, 0)
        self.assertGreaterEqual(width, (1 - 2e-6) * height)
        self.assertLessEqual(width * height, (1 + 2e-6) * smallest_area(points))

    def verified(self, result, mesh, *options):
        if os.path.exists(VERIFY):
            done = subprocess.run(['/usr/bin/python3', VERIFY, result, '--mesh', mesh, '--no-energy', *options],
                                  text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            self.assertEqual(done.returncode, 0, done.stdout[-2000:])

    def data(self, name):
        text = self.read(name).decode()
        return json.loads(re.search(r'id="data">(.*?)</script>', text, re.S).group(1))

    # ---------------------------------------------------------------- runs
    def test_a_disk_in_every_format(self):
        mesh = generated('creature')
        for degree in (1, 3):
            files = ['a.vtu', 'a.obj', 'a.ply', 'a.msh', 'a.html', 'a.svg']
            outputs = sum((['-o', self.path(f)] for f in files), [])
            self.run_ok('parametrize', mesh, *outputs, '--quiet', '--degree', degree, '--align')
            result = Vtu(self.path('a.vtu'))
            self.assert_lies(result.rows('uv'))
            x, y = result.claims['aligned']['direction']
            self.assertLess(abs(math.hypot(x, y) - 1), 1e-15)
            self.assertGreater(abs(y), 0.01)  # the side is not horizontal
            for name in files[:3]:
                self.run_ok('check', self.path(name), '--surface', mesh)
            self.run_ok('check', self.path('a.msh'))
            self.judge(self.path('a.vtu'), mesh)
            self.verified(self.path('a.vtu'), mesh)
            page = self.data('a.html')
            raw = base64.b64decode(page['uv'])
            self.assertEqual(sorted(struct.unpack('<%dd' % (len(raw) // 8), raw)),
                             sorted(x for row in result.rows('uv') for x in row[:2]))

    def test_the_aligned_map_is_the_rotated_map(self):
        mesh = generated('creature')
        run = ('parametrize', mesh, '--quiet', '--degree', 2)
        self.run_ok(*run, '-o', self.path('a.vtu'))
        self.run_ok(*run, '-o', self.path('b.vtu'), '--align')
        self.run_ok('convert', self.path('a.vtu'), '-o', self.path('c.vtu'), '--align')
        a, b, c = (Vtu(self.path(name)) for name in ('a.vtu', 'b.vtu', 'c.vtu'))
        self.assertIsNone(a.claims['aligned'])
        (dx, dy), size = b.claims['aligned']['direction'], max(map(abs, a.arrays['uv']))
        for p, q in zip(a.rows('uv'), b.rows('uv')):
            self.assertAlmostEqual(dx * p[0] + dy * p[1], q[0], delta=1e-14 * size)
            self.assertAlmostEqual(dx * p[1] - dy * p[0], q[1], delta=1e-14 * size)
        self.assertEqual(b.arrays['uv'], c.arrays['uv'])
        self.assertEqual(b.claims['aligned'], c.claims['aligned'])
        self.run_ok('check', self.path('c.vtu'), '--surface', mesh)
        self.run_ok('convert', self.path('c.vtu'), '-o', self.path('d.vtu'), '--align')
        self.assertEqual(self.read('c.vtu'), self.read('d.vtu'))

    def test_in_the_unit_square(self):
        mesh = generated('creature')
        self.run_ok('parametrize', mesh, '-o', self.path('a.vtu'), '--quiet', '--align', '--normalize')
        result = Vtu(self.path('a.vtu'))
        uv = [p[:2] for p in result.rows('uv')]
        self.assert_lies(uv)
        low, high = ([f(p[k] for p in uv) for k in (0, 1)] for f in (min, max))
        self.assertEqual(low, [0, 0])
        self.assertEqual(max(high), 1)
        self.run_ok('check', self.path('a.vtu'), '--surface', mesh)
        self.verified(self.path('a.vtu'), mesh)

    def test_layouts_that_rounding_would_invert_are_not_turned(self):
        """A kite whose image grows out of its lowest corner, layer by layer. The first layers are small beside the
        last, and have their digits only if this corner is at (0, 0)."""
        def kite(base):
            layers = [(base ** k * x, base ** k * y) for k in range(-16, 1) for x, y in ((1, 0.2), (0.2, 1))]
            return [(0.0, 0.0), *layers, (1.2, 0.5), (0.5, 1.2)]
        faces = [(0, 1, 2)] + [f for k in range(1, 35, 2) for f in ((k, k + 2, k + 3), (k, k + 3, k + 1))]
        lines = ['v %r %r 0' % p for p in kite(1.5)] + ['vt %r %r' % p for p in kite(16.0)]
        lines += ['f ' + ' '.join('%d/%d' % (v + 1, v + 1) for v in face) for face in faces]
        mesh = self.write('kite.obj', '\n'.join(lines) + '\n')
        options = ['--init', 'input', '--degree', 1, '--max-iterations', 0, '-o', self.path('a.vtu'), '--normalize']
        printed = self.run_ok('parametrize', mesh, *options, code=LIMIT).err
        self.assertIn('kite.obj: --normalize leaves the layout unturned', printed)
        self.assertIsNone(Vtu(self.path('a.vtu')).claims['aligned'])
        self.run_ok('check', self.path('a.vtu'), '--surface', mesh)
        self.assertEqual('', self.run_ok('parametrize', '--quiet', mesh, *options, code=LIMIT).err)

    def test_a_square_sheet_fills_the_square(self):
        mesh = self.write('sheet.obj', obj_text(*grid(20, lambda x, y: 0.05 * math.sin(3 * x) * y)))
        for options in (['--normalize'], ['--normalize', '--align'], ['--align']):
            self.run_ok('parametrize', mesh, '-o', self.path('a.vtu'), '--quiet', '--degree', 1, *options)
            result = Vtu(self.path('a.vtu'))
            uv, area = result.rows('uv'), 0
            for cell in result.cells():
                (ax, ay), (bx, by), (cx, cy) = (uv[k][:2] for k in cell[:3])
                area += ((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)) / 2
            width, height = extents([p[:2] for p in uv], 1, 0)
            self.assertGreater(area, 0.95 * max(width, height) ** 2, options)
            self.run_ok('check', self.path('a.vtu'), '--surface', mesh)
        self.run_ok('parametrize', mesh, '-o', self.path('b.vtu'), '--quiet', '--degree', 1, '--normalize',
                    '--align', 'no')
        self.assertIsNone(Vtu(self.path('b.vtu')).claims['aligned'])

    def test_pictures_and_pages_lie_alike(self):
        """Pictures with and without a grid; the page keeps the file's coordinates and names its rotation."""
        mesh = generated('creature')
        outputs = sum((['-o', self.path(f)] for f in ('a.vtu', 'a.svg', 'a.html')), [])
        self.run_ok('parametrize', mesh, *outputs, '--quiet', '--degree', 1)
        self.run_ok('convert', self.path('a.vtu'), '-o', self.path('g.svg'), '--grid', 1)
        self.run_ok('convert', self.path('a.vtu'), '-o', self.path('no.html'), '--align', 'no')
        uv, x, y = [p[:2] for p in Vtu(self.path('a.vtu')).rows('uv')], *self.data('a.html')['direction']
        self.assert_lies([(x * u + y * v, x * v - y * u) for u, v in uv])
        self.assertGreater(abs(y), 0.01)
        self.assertEqual(self.data('no.html')['direction'], [1, 0])
        shapes = [re.search(r'<g class="cells".*?</g>|<path[^>]*>', self.read(f).decode(), re.S).group(0)
                  for f in ('a.svg', 'g.svg')]
        self.assertEqual(*shapes)
        # A line of constant u of the file has the direction (-y, x), turned, in the drawing, with either sign.
        grid_path = re.search(r'clip-path="[^>]*>\s*<path[^>]* d="M[^l]*l(-?[.0-9]+) ?(-?[.0-9]+)',
                              self.read('g.svg').decode())
        right, down = map(float, grid_path.groups())
        length = math.hypot(right, down)
        self.assertAlmostEqual(right / length, y, delta=1e-4)
        self.assertAlmostEqual(-down / length, x, delta=1e-4)

    def test_the_scaffold_turns_along(self):
        mesh = self.write('mesh.obj', obj_text(*grid(4, lambda x, y: 0.9 * math.sin(3 * x + y))))
        self.run_ok('parametrize', mesh, '-o', self.path('a.vtu'), '-o', self.path('a.svg'),
                    '--bijective', '--degree', 2, '--quiet', '--align',
                    '--write-scaffold', self.path('s.vtu'))
        result, around = (Vtu(self.path(name)) for name in ('a.vtu', 's.vtu'))
        self.assertIsNotNone(result.claims['aligned'])
        self.run_ok('check', self.path('a.vtu'), '--surface', mesh, '--certify')
        self.run_ok('check', self.path('s.vtu'))
        self.verified(self.path('a.vtu'), mesh, '--require-global')
        boundary = [p for p, v in zip(result.rows('uv'), result.arrays['input_vertex'])
                    if v % 5 in (0, 4) and v >= 0 or 0 <= v < 5 or v >= 20]
        self.assertEqual(len(boundary), 16)
        self.assertLessEqual({p[:2] for p in boundary}, {p[:2] for p in around.rows('uv')})

    def test_seams_survive(self):
        mesh = generated('buckle')
        for degree in (1, 2):
            self.run_ok('seamless', mesh, '-o', self.path('a.vtu'), '--quiet', '--degree', degree, '--align')
            result = Vtu(self.path('a.vtu'))
            self.assert_lies(result.rows('uv'))
            self.run_ok('check', self.path('a.vtu'), '--surface', mesh)
            self.judge(self.path('a.vtu'), mesh, '--seamless')
            self.verified(self.path('a.vtu'), mesh, '--cuts', 'auto')

    def test_the_film_turns_along(self):
        mesh = generated('creature')
        frames = []
        for more in ([], ['--align']):
            self.run_ok('parametrize', mesh, '-o', self.path('a.html'), '--quiet', '--degree', 1,
                        '--snapshots', 2, *more)
            snapshots = self.data('a.html')['snapshots']
            raw = [base64.b64decode(s['uv']) for s in snapshots]
            frames.append([struct.unpack('<%df' % (len(r) // 4), r) for r in raw])
        dx, dy = self.data('a.html')['claims']['aligned']['direction']
        self.assertGreater(len(frames[0]), 2)
        for before, after in zip(*frames):
            size = max(map(abs, before))
            for k in range(0, len(before), 2):
                u, v = before[k:k + 2]
                self.assertAlmostEqual(dx * u + dy * v, after[k], delta=1e-6 * size)
                self.assertAlmostEqual(dx * v - dy * u, after[k + 1], delta=1e-6 * size)

    # ---------------------------------------------------------------- claims
    def test_a_boundary_is_compared_as_the_run_had_it(self):
        """No program writes such a file, but its claims have a meaning."""
        mesh = generated('cap')
        self.run_ok('parametrize', mesh, '-o', self.path('a.vtu'), '--quiet', '--degree', 2,
                    '--boundary', 'fixed')
        turned, direction = Vtu(self.path('a.vtu')), (0.6, 0.8)
        for p, (u, v, *rest) in enumerate(turned.rows('uv')):
            k = turned.components['uv'] * p
            turned.arrays['uv'][k:k + 2] = 0.6 * u + 0.8 * v, 0.6 * v - 0.8 * u
        self.found(turned.write(self.path('b.vtu')), '--surface', mesh,
                     says="the boundary is off the initial map's")
        turned.claims['aligned'] = {'direction': direction}
        self.run_ok('check', turned.write(self.path('b.vtu')), '--surface', mesh)

    def test_files_without_claims_are_turned(self):
        mesh = generated('creature')
        self.run_ok('parametrize', mesh, '-o', self.path('a.obj'), '--quiet')
        self.run_ok('convert', self.path('a.obj'), '-o', self.path('b.obj'), '-o', self.path('b.vtu'),
                    '--align')
        _, vt, _, faces = read_obj(self.path('b.obj'))
        self.assert_lies(vt)
        for name in ('b.obj', 'b.vtu'):
            self.run_ok('check', self.path(name), '--surface', mesh)

    # ---------------------------------------------------------------- held layouts
    def test_layouts_held_by_points_are_not_turned(self):
        mesh = self.write('mesh.obj', obj_text(*grid(3)))
        flat = self.write('flat.obj', obj_text(*grid(3, lambda x, y: 0)))
        pins = self.write('pins.json', '{"handles": [{"vertex": 0, "target": "initial"}]}')
        handles = self.write('handles.json', '{"handles": [{"vertex": 0, "target": [-0.1, 0]}]}')
        out, before = self.path('a.vtu'), self.files()
        for says, run in (('pins', ('parametrize', mesh, '--pins', pins)),
                          ('handles', ('parametrize', mesh, '--handles', handles)),
                          ('--boundary fixed', ('parametrize', mesh, '--boundary', 'fixed')),
                          ('handles', ('deform', flat, '--handles', handles)),
                          ('charts', ('unwrap', mesh))):
            for name in ('a.vtu', 'a.html'):
                self.refused(USAGE, *run, '-o', self.path(name), '--align', says=['--align', says])
            self.assertEqual(self.files(), before)
            self.run_ok(*run, '-o', self.path('a.svg'), '--align', '--quiet', '--degree', 1)
            self.run_ok(*run, '-o', out, '--align', 'no', '--quiet', '--degree', 1)
            self.refused(USAGE, 'convert', out, '-o', self.path('b.obj'), '--align', says=['--align', out])
            self.run_ok('convert', out, '-o', self.path('b.svg'), '--align')
            for name in ('a.svg', 'a.vtu', 'b.svg'):
                os.remove(self.path(name))
        self.run_ok('parametrize', mesh, '-o', out, '--normalize', '--quiet')
        self.refused(USAGE, 'convert', out, '-o', self.path('b.vtu'), '--align', says='unit square')


if __name__ == '__main__':
    main()
