# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Ranks without faces, points on borders, refusals, and ranks that die."""
import unittest

from mpi_helpers import *


def write_square(path, n, holes=()):
    """Writes n by n squares of two triangles each, without those in `holes`."""
    with open(path, 'w') as f:
        for j in range(n + 1):
            for i in range(n + 1):
                f.write('v %d %d %.3f\n' % (i, j, 0.3 * (i * i + j) % 1))
        for j in range(n):
            for i in range(n):
                if (i, j) in holes:
                    continue
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
        """Every vertex of a row through the mesh in turn; the row crosses any border between halves."""
        pins = self.constraints('pins.json', [{'vertex': v, 'target': 'initial'} for v in range(21, 28)])
        handles = self.constraints('handles.json', [{'vertex': v, 'target': [3 + v % 7, 2]} for v in range(21, 28)])
        for option, path in (('--pins', pins), ('--handles', handles)):
            requested = ['--degree', 2, option, path]
            if option == '--handles':
                requested += ['--soft', 1]  # would reveal a handle that is counted twice
            whole = self.serial(self.mesh, *requested)
            for ranks in (2, 3):
                report = self.solve(ranks, self.mesh, *requested)
                self.assertEqual(report['result']['variables'], whole['result']['variables'])
                self.assertLess(abs(report['result']['value'] / whole['result']['value'] - 1), 1e-6)

    def test_pins_away_from_the_start(self):
        """Rank 0 moves the start to the pins; the other ranks, and a resumed run, receive the result."""
        pins = self.path('pins.json')
        for points in ([{'vertex': 0, 'target': [0, 0]}, {'vertex': 48, 'target': [9, 5]}],
                       [{'vertex': 24, 'target': 'initial'}, {'vertex': 6, 'target': [4, -3]},
                        {'vertex': 42, 'target': [-4, 3]}, {'vertex': 0, 'target': [-3, -4]}]):
            self.constraints('pins.json', points)
            whole = self.serial(self.mesh, '--degree', 2, '--pins', pins)
            for ranks in (1, 3):
                report = self.solve(ranks, self.mesh, '--degree', 2, '--pins', pins)
                self.assertEqual(report['result']['variables'], whole['result']['variables'])
                self.assertLess(abs(report['result']['value'] / whole['result']['value'] - 1), 1e-6)
            kept = self.path('run.ckpt')
            steps = len(report['iterations']) - 3
            self.solve(2, self.mesh, '--degree', 2, '--pins', pins, '--checkpoint', kept, '--max-iterations', steps,
                       code=4)
            resumed = self.solve(3, self.mesh, '--degree', 2, '--pins', pins, '--resume', kept)
            self.assertLess(abs(resumed['result']['value'] / whole['result']['value'] - 1), 1e-8)
            self.run_ok('convert', self.path('all.pvtu'), '-o', self.path('one.vtu'))
            one = Vtu(self.path('one.vtu'))
            uv = {vertex: uv for (vertex,), uv in zip(one.rows('input_vertex'), one.rows('uv'))}
            for point in points:
                if point['target'] != 'initial':
                    for c in (0, 1):
                        self.assertAlmostEqual(uv[point['vertex']][c], point['target'][c], 9)

    def test_pins_that_contradict_each_other(self):
        for words, points in ((['--degree', 2], [{'vertex': 3, 'target': [1, 1]}, {'vertex': 5, 'target': [1, 1]}]),
                              (['--boundary', 'fixed'], [{'vertex': 3, 'target': [1, 1]}])):
            pins = self.constraints('pins.json', points)
            whole = majorant('parametrize', self.mesh, '-o', self.path('a.vtu'), '--pins', pins, *words)
            done = mpirun(2, 'parametrize', self.mesh, '-o', self.path('a.pvtu'), '--pins', pins, *words)
            self.assertEqual(done.code, whole.code, done.err)
            self.assertIn(whole.printed()[-1].split('majorant: ')[-1], done.err)

    def test_points_that_cannot_be_held_are_refused_as_by_one_process(self):
        """The rank that owns the points does not matter."""
        for vertex in (0, 48):
            pins = self.constraints('pins.json', [{'vertex': vertex, 'target': 'initial'}])
            handles = self.constraints('handles.json', [{'vertex': vertex, 'target': [2, 2]}])
            far = self.constraints('far.json', [{'vertex': vertex, 'target': [1e200, 2]}])
            for words in (['--pins', pins, '--handles', handles], ['--handles', far]):
                whole = majorant('parametrize', self.mesh, '-o', self.path('a.vtu'), '--init', 'tutte', *words)
                done = mpirun(2, 'parametrize', self.mesh, '-o', self.path('a.pvtu'), *words)
                self.assertEqual(whole.code, UNSUPPORTED, whole.err)
                self.assertEqual(done.code, whole.code, done.err)
                self.assertIn(whole.printed()[-1].split('majorant: ')[-1], done.err)

    def test_holes(self):
        """A hole in the middle, two holes that a border may meet, and a closed strip."""
        ring = self.path('ring.obj')
        with open(ring, 'w') as f:
            for k in range(12):
                x, y = math.cos(k * math.pi / 6), math.sin(k * math.pi / 6)
                f.write('v %f %f 0\nv %f %f 1\n' % (x, y, x, y))
            for k in range(12):
                a, b, c, d = 2 * k, 2 * k + 1, (2 * k + 2) % 24, (2 * k + 3) % 24
                f.write('f %d %d %d\nf %d %d %d\n' % (a + 1, c + 1, d + 1, a + 1, d + 1, b + 1))
        meshes = [ring]
        for name, holes in (('one', [(2, 2), (3, 2), (2, 3)]), ('two', [(1, 1), (4, 3), (4, 4)])):
            meshes.append(self.path(name + '.obj'))
            write_square(meshes[-1], 6, holes)
        for mesh in meshes:
            for options, counts in ((['--degree', 2], (1, 3)), (['--degree', 1, '--boundary', 'fixed'], (2,))):
                whole = self.serial(mesh, *options)
                for ranks in counts:
                    with self.subTest(mesh=mesh, options=options, ranks=ranks):
                        report = self.solve(ranks, mesh, *options)
                        self.assertNotIn('alone', self.printed)  # the ranks have made the start in parts
                        for key in ('variables', 'globally_injective', 'locally_injective'):
                            self.assertEqual(report['result'][key], whole['result'][key])
                        for key in ('value', 'initial_value'):
                            self.assertLess(abs(report['result'][key] / whole['result'][key] - 1), 1e-6)
            self.run_ok('check', self.path('all.pvtu'), '--surface', mesh)

    def test_fixed_boundary_and_weights(self):
        with open(self.path('weights.txt'), 'w') as f:
            f.write('\n'.join(str(1 + k % 5) for k in range(72)))
        for options in (['--boundary', 'fixed'], ['--weights', self.path('weights.txt')],
                        ['--energy', 'symmetric-dirichlet + 0.1*asap']):
            whole = self.serial(self.mesh, '--degree', 3, *options)
            report = self.solve(3, self.mesh, '--degree', 3, *options)
            self.assertEqual(report['result']['variables'], whole['result']['variables'])
            self.assertLess(abs(report['result']['value'] / whole['result']['value'] - 1), 1e-6, options)

    def test_unsupported_options_are_refused_by_name(self):
        for words, named in ((['--bijective'], '--bijective'), (['--improve-mesh'], '--improve-mesh'),
                             (['--boundary-angles'], '--boundary-angles'), (['--seamless'], '--seamless'),
                             (['--init', 'multiresolution'], 'multiresolution')):
            done = mpirun(2, 'parametrize', self.mesh, '-o', self.path('a.pvtu'), *words)
            self.assertEqual(done.code, USAGE, done.err)
            self.assertIn(named, done.err)
            self.assertIn('majorant parametrize', done.err)

    def test_an_error_on_one_rank_ends_all(self):
        done = mpirun(3, 'parametrize', self.path('none.obj'), '-o', self.path('a.pvtu'))
        self.assertEqual(done.code, UNREADABLE, done.err)
        self.assertIn('none.obj', done.err)
        report = self.path('none.json')
        done = mpirun(2, 'parametrize', self.path('none.obj'), '-o', self.path('a.pvtu'), '--report', report)
        self.assertEqual(done.code, UNREADABLE, done.err)
        self.assertEqual(self.report('none.json')['status'], 'unreadable')
        with open(self.path('closed.obj'), 'w') as f:
            f.write('v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n')
        done = mpirun(3, 'parametrize', self.path('closed.obj'), '-o', self.path('a.pvtu'))
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

    def long_run(self, ranks, out='a'):
        return start(ranks, 'parametrize', disk('hand_2500'), '-o', self.path(out + '.pvtu'), '--degree', 3,
                     '--tolerance', 1e-12, '--verbose')

    def test_a_rank_that_is_killed_ends_the_run(self):
        run = self.long_run(3)
        victim = processes_of(run, 3)[1]
        wait_for(run, 'degree 1')
        os.kill(victim, signal.SIGKILL)
        code, printed = ended(run)
        self.assertIn(code, (137, None), printed)
        self.assertFalse(os.path.exists(self.path('a.pvtu')))

    def test_a_user_signal_ends_it_with_the_best_map(self):
        run = self.long_run(2)
        wait_for(run, 'degree 1')
        run.send_signal(signal.SIGUSR1)
        self.assertEqual(ended(run)[0], LIMIT)
        self.run_ok('check', self.path('a.pvtu'), '--surface', disk('hand_2500'))


class WholeOrAbsent(MpiTest):
    """OUT.pvtu after runs that fail while they write."""
    def setUp(self):
        super().setUp()
        self.mesh = disk('nefertiti_500')
        self.solve(3, self.mesh, '--degree', 1)
        self.before = self.files()

    def files(self):
        found = {}
        for name in sorted(os.listdir(self.folder)):
            if name.startswith('all') and 'vtu' in name:
                with open(self.path(name), 'rb') as f:
                    found[name] = f.read()
        return found

    def check(self):
        self.run_ok('check', self.path('all.pvtu'), '--surface', self.mesh)

    def left(self):
        return [name for name in os.listdir(self.folder) if '.tmp' in name]

    def test_a_full_disk(self):
        """One rank has no room for its piece: the earlier map stays bit by bit."""
        for victim in range(2):
            run = start(2, 'parametrize', self.mesh, '-o', self.path('all.pvtu'), '--degree', 3, '--verbose',
                        '--report', self.path('run.json'))
            pids = processes_of(run, 2)
            wait_for(run, 'degree 1')
            resource.prlimit(pids[victim], resource.RLIMIT_FSIZE, (3000, 3000))
            code, printed = ended(run)
            self.assertEqual(code, USAGE, printed)
            self.assertEqual(len([line for line in printed.splitlines() if 'File too large' in line]), 1, printed)
            self.assertRegex(printed, r'majorant-mpi: rank 0: cannot write .*all_\d.vtu: File too large')
            if victim > 0:  # the report of rank 0 has no room either
                output, = self.report('run.json')['outputs']
                self.assertEqual([output['file'], output['written']], [self.path('all.pvtu'), False])
                self.assertIn('File too large', output['message'])
            self.assertEqual(self.files(), self.before)
            self.assertEqual(self.left(), [])
        self.check()

    def test_a_kill_during_writing(self):
        """OUT.pvtu is the earlier map or the new one, and its pieces belong together."""
        for k, victim in enumerate((0, 1, 1)):
            run = start(2, 'parametrize', self.mesh, '-o', self.path('all.pvtu'), '--degree', 2)
            pids = processes_of(run, 2)
            while not self.left() and run.poll() is None:
                time.sleep(0.0005)
            time.sleep(0.004 * k)
            if run.poll() is None:
                os.kill(pids[victim], signal.SIGKILL)
            ended(run)
            if os.path.exists(self.path('all.pvtu')):
                self.check()
            for name in self.left():
                os.remove(self.path(name))

    def test_pieces_of_more_ranks_go(self):
        self.assertIn('all_2.vtu', self.before)
        shutil.copy(self.path('all_2.vtu'), self.path('all_27.vtu'))  # belongs to no map
        self.solve(2, self.mesh, '--degree', 1)
        self.assertEqual(sorted(self.files()), ['all.pvtu', 'all_0.vtu', 'all_1.vtu', 'all_27.vtu'])
        self.check()

    def test_a_link_stays(self):
        os.rename(self.path('all.pvtu'), self.path('other.pvtu'))
        os.symlink('other.pvtu', self.path('all.pvtu'))
        self.solve(2, self.mesh, '--degree', 1)
        self.assertTrue(os.path.islink(self.path('all.pvtu')))
        self.check()


if __name__ == '__main__':
    need_mpi()
    unittest.main()
