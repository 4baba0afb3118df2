# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Results compared with checkers that share no code with the library: tests/checker in the repository, and
../shared/tools/verify.py (needs numpy and scipy) if it is there."""
import json
import math
import os
import subprocess

from command_helpers import *


def symmetric_dirichlet(path):
    """Returns (mean, largest) |J|^2 + |J^-1|^2 of a map of degree 1, from the corners of its cells."""
    vtu, sum_, area_, largest = Vtu(path), 0, 0, 0
    points, uv = vtu.rows('Points'), vtu.rows('uv')
    for a, b, c in vtu.cells():
        u, v = ([q - p for p, q in zip(points[a], points[k])] for k in (b, c))
        length = math.hypot(*u)
        along = sum(s * t for s, t in zip(u, v)) / length
        across = math.sqrt(sum(t * t for t in v) - along * along)
        # Columns of J in the frame of the face: uv_b - uv_a belongs to (length, 0).
        x = [(q - p) / length for p, q in zip(uv[a], uv[b])]
        y = [(q - p - along * s) / across for p, q, s in zip(uv[a], uv[c], x)]
        det, norm = x[0] * y[1] - x[1] * y[0], x[0] ** 2 + x[1] ** 2 + y[0] ** 2 + y[1] ** 2
        density, area = norm * (1 + 1 / det ** 2), length * across / 2
        sum_, area_, largest = sum_ + area * density, area_ + area, max(largest, density)
    return sum_ / area_, largest


class Solved(CommandTest):
    def solve(self, mesh, degree, *args):
        out = self.path('out.vtu')
        self.run_ok('parametrize', '--quiet', mesh, '-o', out, '--degree', degree, '--report',
                    self.path('r.json'), *args)
        with open(self.path('r.json')) as f:
            return out, json.load(f)['result']

    def start(self, mesh):
        """Returns the initial map of runs."""
        self.run_ok('parametrize', '--quiet', mesh, '-o', self.path('start.vtu'), '--degree', '1',
                    '--max-iterations', '0', code=LIMIT)
        return self.path('start.vtu')

    def cap_with_pins(self):
        return self.write('pins.json', json.dumps(
            {'handles': [{'vertex': v, 'target': 'initial'} for v in (0, 100, 150)]}))


class Checked(Solved):
    def test_generated_meshes(self):
        for name in ('cap', 'tube', 'wavy_disk', 'ribbon'):
            for n in (1, 3):
                with self.subTest(mesh=name, degree=n):
                    out, result = self.solve(generated(name), n)
                    self.judge(out, generated(name))
                    if n == 1:
                        mean, largest = symmetric_dirichlet(out)
                        self.assertAlmostEqual(mean / result['value'], 1, delta=1e-9)
                        self.assertAlmostEqual(largest / result['max_density'], 1, delta=1e-9)

    def test_the_creature(self):
        out, _ = self.solve(generated('creature'), 2)
        self.judge(out, generated('creature'))

    def test_obj(self):
        self.solve(generated('cap'), 1, '-o', self.path('out.obj'))
        self.judge(self.path('out.obj'), generated('cap'))

    def test_pins(self):
        mesh = generated('cap')
        start = Vtu(self.start(mesh)).rows('uv')
        for n in (1, 3):
            out, _ = self.solve(mesh, n, '--pins', self.cap_with_pins())
            self.judge(out, mesh)
            claims, uv = Vtu(out).claims['pins'], Vtu(out).rows('uv')
            self.assertEqual([p['vertex'] for p in claims], [0, 100, 150])
            for pin in claims:
                self.assertEqual(tuple(pin['target']), uv[pin['vertex']])
                for a, b in zip(pin['target'], start[pin['vertex']]):
                    self.assertAlmostEqual(a, b, delta=1e-15)

    def test_fixed_boundary(self):
        for name in ('cap', 'wavy_disk'):
            mesh = generated(name)
            vtu = Vtu(self.start(mesh))
            sides = [(cell[k], cell[(k + 1) % 3]) for cell in vtu.cells() for k in range(3)]
            boundary = {v for side in set(sides) if side[::-1] not in set(sides) for v in side}
            self.assertGreater(len(boundary), 20)
            held = [vtu.rows('uv')[v] for v in sorted(boundary)]
            for n in (1, 3):
                out, _ = self.solve(mesh, n, '--boundary', 'fixed')
                self.judge(out, mesh)
                self.assertEqual([Vtu(out).rows('uv')[v] for v in sorted(boundary)], held)
            out, _ = self.solve(mesh, 3)
            self.assertNotEqual([Vtu(out).rows('uv')[v] for v in sorted(boundary)], held)


@where(VERIFY)
class Verify(Solved):
    def verify(self, result, mesh, *args, code=0):
        process = subprocess.run(['/usr/bin/python3', VERIFY, result, '--mesh', mesh, '--m', '40',
                                  *map(str, args)], text=True, stdout=subprocess.PIPE,
                                 stderr=subprocess.PIPE, timeout=300)
        self.assertEqual(process.returncode, code, process.stdout[-2000:] + process.stderr)
        return json.loads(process.stdout)

    def test_generated_meshes(self):
        for name in ('cap', 'tube', 'wavy_disk', 'ribbon'):
            for n in (1, 3):
                with self.subTest(mesh=name, degree=n):
                    out, result = self.solve(generated(name), n)
                    found = self.verify(out, generated(name))
                    self.assertTrue(found['ok']['all'])
                    self.assertIs(found['mesh_match']['same_face_order'], True)
                    # Its lattice of 820 points has an error of about 1e-3 for curved maps.
                    self.assertAlmostEqual(found['energy']['E_SD'] / result['value'], 1,
                                           delta=1e-9 if n == 1 else 3e-3)
                    if n == 1:
                        self.assertAlmostEqual(found['energy']['max_SD'] / result['max_density'], 1,
                                               delta=1e-9)

    def test_the_creature(self):
        out, _ = self.solve(generated('creature'), 2)
        self.assertTrue(self.verify(out, generated('creature'), '--no-energy')['ok']['all'])

    def test_obj(self):
        out, result = self.solve(generated('cap'), 1, '-o', self.path('out.obj'))
        found = self.verify(self.path('out.obj'), generated('cap'))
        self.assertAlmostEqual(found['energy']['E_SD'] / result['value'], 1, delta=1e-9)

    def test_pins(self):
        mesh = generated('cap')
        for n in (1, 3):
            out, _ = self.solve(mesh, n, '--pins', self.cap_with_pins())
            claims = Vtu(out).claims['pins']
            held = self.write('held.json', json.dumps({'handles': claims}))
            self.verify(out, mesh, '--constraints', held, '--no-energy')
            claims[1]['target'][0] += 1e-5
            held = self.write('moved.json', json.dumps({'handles': claims}))
            self.verify(out, mesh, '--constraints', held, '--no-energy', code=1)

    def test_fixed_boundary(self):
        for name in ('cap', 'wavy_disk'):
            mesh = generated(name)
            constraints = self.write('c.json', json.dumps({'fixed_boundary': self.start(mesh)}))
            for n in (1, 3):
                out, _ = self.solve(mesh, n, '--boundary', 'fixed')
                found = self.verify(out, mesh, '--constraints', constraints, '--no-energy')
                self.assertTrue(found['ok']['fixed_boundary'])
            out, _ = self.solve(mesh, 3)
            self.verify(out, mesh, '--constraints', constraints, '--no-energy', code=1)


if __name__ == '__main__':
    main()
