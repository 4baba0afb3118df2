# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Ranks without faces, points on borders, what is refused, and ranks that die."""
import signal
import time
import unittest

from mpi_helpers import *


def write_square(path, n):
    """n by n squares of two triangles."""
    with open(path, 'w') as f:
        for j in range(n + 1):
            for i in range(n + 1):
                f.write('v %d %d %.3f\n' % (i, j, 0.3 * (i * i + j) % 1))
        for j in range(n):
            for i in range(n):
                a = j * (n + 1) + i + 1
                f.write('f %d %d %d\nf %d %d %d\n' % (a, a + 1, a + n + 2, a, a + n + 2, a + n + 1))


class Corners(MpiTest):
    def setUp(self):
        super().setUp()
        self.mesh = self.path('square.obj')
        write_square(self.mesh, 6)

    def test_more_ranks_than_faces(self):
        with open(self.path('triangle.obj'), 'w') as f:
            f.write('v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\nf 1 2 3\nf 1 3 4\n')
        for degree in (1, 3):
            report = self.solve(4, self.path('triangle.obj'), '--degree', degree)
            self.assertEqual([r['faces'] for r in report['ranks']], [1, 1, 0, 0])
            self.assertAlmostEqual(report['result']['value'], 4, 5)
            self.run_ok('check', self.path('all.pvtu'), '--surface', self.path('triangle.obj'))

    def constraints(self, name, points):
        with open(self.path(name), 'w') as f:
            json.dump({'handles': points}, f)
        return self.path(name)

    def test_pins_and_handles_wherever_borders_are(self):
        """Every vertex in turn of a row through the mesh; the row crosses any border between halves."""
        pins = self.constraints('pins.json', [{'vertex': v, 'target': 'initial'} for v in range(21, 28)])
        handles = self.constraints('handles.json', [{'vertex': v, 'target': [3 + v % 7, 2]} for v in range(28, 31)])
        for option, path in (('--pins', pins), ('--handles', handles)):
            whole = self.serial(self.mesh, '--degree', 2, option, path)
            for ranks in (2, 3):
                report = self.solve(ranks, self.mesh, '--degree', 2, option, path)
                self.assertEqual(report['result']['variables'], whole['result']['variables'])
                self.assertLess(abs(report['result']['value'] / whole['result']['value'] - 1), 1e-6)

    def test_fixed_boundary_and_weights(self):
        with open(self.path('weights.txt'), 'w') as f:
            f.write('\n'.join(str(1 + k % 5) for k in range(72)))
        for options in (['--boundary', 'fixed'], ['--weights', self.path('weights.txt')],
                        ['--energy', 'symmetric-dirichlet + 0.1*asap']):
            whole = self.serial(self.mesh, '--degree', 3, *options)
            report = self.solve(3, self.mesh, '--degree', 3, *options)
            self.assertEqual(report['result']['variables'], whole['result']['variables'])
            self.assertLess(abs(report['result']['value'] / whole['result']['value'] - 1), 1e-6, options)

    def test_what_stays_on_one_machine_is_refused_by_name(self):
        for words, named in ((['--bijective'], '--bijective'), (['--improve-mesh'], '--improve-mesh'),
                             (['--boundary-angles'], '--boundary-angles'), (['--seamless'], '--seamless'),
                             (['--init', 'multiresolution'], 'multiresolution')):
            done = mpirun(2, 'parametrize', self.mesh, '-o', self.path('a.pvtu'), *words)
            self.assertEqual(done.code, USAGE, done.err)
            self.assertIn(named, done.err)
            self.assertIn('majorant parametrize', done.err)

    def test_what_one_rank_finds_ends_all(self):
        done = mpirun(3, 'parametrize', self.path('none.obj'), '-o', self.path('a.pvtu'))
        self.assertEqual(done.code, UNREADABLE, done.err)
        self.assertIn('none.obj', done.err)
        with open(self.path('ring.obj'), 'w') as f:  # a strip that closes: no disk
            for k in range(6):
                x, y = math.cos(k * math.pi / 3), math.sin(k * math.pi / 3)
                f.write('v %f %f 0\nv %f %f 1\n' % (x, y, x, y))
            for k in range(6):
                a, b, c, d = 2 * k, 2 * k + 1, (2 * k + 2) % 12, (2 * k + 3) % 12
                f.write('f %d %d %d\nf %d %d %d\n' % (a + 1, c + 1, d + 1, a + 1, d + 1, b + 1))
        done = mpirun(3, 'parametrize', self.path('ring.obj'), '-o', self.path('a.pvtu'))
        self.assertEqual(done.code, UNSUPPORTED, done.err)

    def test_a_missing_piece_is_named(self):
        self.solve(2, self.mesh, '--degree', 1)
        os.remove(self.path('all_1.vtu'))
        done = majorant('check', self.path('all.pvtu'))
        self.assertEqual(done.code, UNREADABLE)
        self.assertIn('all_1.vtu', done.err)

    def test_a_piece_of_another_run_is_found(self):
        self.solve(2, self.mesh, '--degree', 1)
        self.solve(2, self.mesh, '--degree', 1, '--boundary', 'fixed', out='other')
        shutil.copy(self.path('other_1.vtu'), self.path('all_1.vtu'))
        done = majorant('convert', self.path('all.pvtu'), '-o', self.path('one.vtu'))
        self.assertEqual(done.code, UNREADABLE)
        self.assertIn('all_1.vtu', done.err)

    def test_a_rank_that_is_killed_ends_the_run(self):
        run = subprocess.Popen(['mpirun', '-n', '3', MPI_BINARY, 'parametrize', disk('hand_2500'), '-o',
                                self.path('a.pvtu'), '--degree', '3', '--tolerance', '1e-12'],
                               env=ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        victim = None
        for _ in range(100):
            time.sleep(0.1)
            found = subprocess.run(['pgrep', '-P', str(run.pid)], stdout=subprocess.PIPE, text=True)
            ranks = found.stdout.split()
            if len(ranks) == 3:
                victim = int(ranks[1])
                break
        self.assertIsNotNone(victim)
        time.sleep(1)
        os.kill(victim, signal.SIGKILL)
        _, said = run.communicate(timeout=60)
        self.assertEqual(run.returncode, 137, said)
        self.assertFalse(os.path.exists(self.path('a.pvtu')))

    def test_a_user_signal_ends_it_with_the_best_map(self):
        run = subprocess.Popen(['mpirun', '-n', '2', MPI_BINARY, 'parametrize', disk('hand_2500'), '-o',
                                self.path('a.pvtu'), '--degree', '3', '--tolerance', '1e-12', '--verbose'],
                               env=ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        for line in run.stderr:
            if 'degree 1' in line:
                break
        run.send_signal(signal.SIGUSR1)
        run.communicate(timeout=120)
        self.assertEqual(run.returncode, LIMIT)
        self.run_ok('check', self.path('a.pvtu'), '--surface', disk('hand_2500'))


if __name__ == '__main__':
    need_mpi()
    unittest.main()
