"""Results against the independent checker ../shared/tools/verify.py (needs numpy and scipy)."""
import json
import os
import subprocess

from command_helpers import *


@unittest.skipUnless(os.path.exists(VERIFY), 'no ' + VERIFY)
class Verify(CommandTest):
    def solve(self, mesh, degree, *args):
        out = self.path('out.vtu')
        self.run_ok('parametrize', '--quiet', mesh, '-o', out, '--degree', degree, '--report',
                    self.path('r.json'), *args)
        with open(self.path('r.json')) as f:
            return out, json.load(f)['result']

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
                    self.assertIs(found['same_face_order'], True)
                    # Its lattice of 820 points is good to about 1e-3 for curved maps.
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
        pins = self.write('pins.json', json.dumps(
            {'handles': [{'vertex': v, 'target': 'initial'} for v in (0, 100, 150)]}))
        for n in (1, 3):
            out, _ = self.solve(mesh, n, '--pins', pins)
            claims = Vtu(out).claims['pins']
            self.assertEqual([p['vertex'] for p in claims], [0, 100, 150])
            held = self.write('held.json', json.dumps({'handles': claims}))
            self.verify(out, mesh, '--constraints', held, '--no-energy')
            # Where the start has them, too: a run without iterations shows it.
            self.run_ok('parametrize', '--quiet', mesh, '-o', self.path('start.vtu'), '--degree', '1',
                        '--max-iterations', '0', code=LIMIT)
            start = Vtu(self.path('start.vtu')).rows('uv')
            for pin in claims:
                for a, b in zip(pin['target'], start[pin['vertex']]):
                    self.assertAlmostEqual(a, b, delta=1e-15)
            claims[1]['target'][0] += 1e-5
            held = self.write('moved.json', json.dumps({'handles': claims}))
            self.verify(out, mesh, '--constraints', held, '--no-energy', code=1)

    def test_fixed_boundary(self):
        for name in ('cap', 'wavy_disk'):
            mesh = generated(name)
            self.run_ok('parametrize', '--quiet', mesh, '-o', self.path('start.vtu'), '--degree', '1',
                        '--max-iterations', '0', code=LIMIT)
            constraints = self.write('c.json', json.dumps({'fixed_boundary': self.path('start.vtu')}))
            for n in (1, 3):
                out, _ = self.solve(mesh, n, '--boundary', 'fixed')
                found = self.verify(out, mesh, '--constraints', constraints, '--no-energy')
                self.assertTrue(found['ok']['fixed_boundary'])
            out, _ = self.solve(mesh, 3)
            self.verify(out, mesh, '--constraints', constraints, '--no-energy', code=1)


if __name__ == '__main__':
    main()
