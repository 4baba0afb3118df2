# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Runs that are stopped or killed continue from their checkpoint, on any number of ranks. Files that are no
checkpoint of the run are refused."""
import random
import struct
import tempfile
import unittest

from mpi_helpers import *

SEED = 1  # seed of the moments at which runs are killed


def alone(*args, **options):
    """Runs one rank without mpirun, which is enough for refusals."""
    return Outcome(subprocess.run([MPI_BINARY] + [str(a) for a in args], text=True, env=ENVIRONMENT,
                                  stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, timeout=300, **options))


def checksum(data):
    """Returns the 64-bit FNV-1a hash."""
    value = 0xcbf29ce484222325
    for byte in data:
        value = (value ^ byte) * 0x100000001b3 % 2**64
    return struct.pack('<Q', value)


class Resumed(MpiTest):
    def value(self, report):
        self.assertEqual(report['status'], 'converged')
        self.assertTrue(report['result']['locally_injective'])
        return report['result']['value']

    def assertSame(self, report, whole):
        """Compares the ends of runs to a tolerance of 1e-9, which do not depend on their paths."""
        self.assertLess(abs(self.value(report) / self.value(whole) - 1), 1e-8)

    def test_on_any_number_of_ranks(self):
        """Runs are stopped at each degree, with pins, handles, weights and a fixed boundary."""
        handles, weights = self.path('handles.json'), self.path('weights.txt')
        with open(handles, 'w') as f:
            json.dump({'handles': [{'vertex': 5, 'target': [0.1, 0.2]}, {'vertex': 40, 'target': 'initial'}]}, f)
        with open(weights, 'w') as f:
            f.write('\n'.join(str(1 + k % 5) for k in range(face_count(disk('nefertiti_500')))))
        kept = self.path('run.ckpt')
        for degree, ranks, others, options in ((1, 3, (1, 2, 4), []), (2, 2, (3,), ['--handles', handles]),
                                               (3, 1, (2,), ['--weights', weights]),
                                               (2, 1, (2,), ['--boundary', 'fixed'])):
            requested = ['--degree', 3, '--tolerance', 1e-9] + options
            whole = self.solve(1, disk('nefertiti_500'), *requested)
            # The run is stopped in the middle of this degree.
            degrees = [row['degree'] for row in whole['iterations']]
            steps = degrees.index(degree) + max(1, degrees.count(degree) // 2)
            stopped = self.solve(ranks, disk('nefertiti_500'), *requested, '--checkpoint', kept, '--max-iterations',
                                 steps, code=LIMIT)
            self.assertEqual(len(stopped['iterations']), steps)
            self.assertGreater(stopped['checkpoint']['written'], 0)
            for count in others:
                with self.subTest(steps=steps, ranks=count, options=options):
                    report = self.solve(count, disk('nefertiti_500'), *requested, '--resume', kept)
                    self.assertSame(report, whole)
                    self.assertEqual(report['resumed']['ranks'], ranks)
                    self.assertEqual(report['resumed']['iterations'], steps)
                    first, last = report['iterations'][0], stopped['iterations'][-1]
                    self.assertEqual(report['resumed']['degree'], first['degree'])
                    if first['degree'] == last['degree']:
                        self.assertLess(first['energy'], last['energy'])
                    self.assertEqual(report['result']['initial_value'], stopped['result']['initial_value'])
                    self.assertEqual(report['result']['start'], 'tutte')
        self.run_ok('check', self.path('all.pvtu'), '--surface', disk('nefertiti_500'))

    def test_the_way_into_the_domain(self):
        """An energy that overflows at the start: the run is stopped before and after it is finite."""
        requested = ['--degree', 2, '--energy', 'amips-exponential', '--tolerance', 1e-9]
        whole = self.solve(1, generated('creature'), *requested)
        self.assertIsNone(whole['result']['initial_value'])
        for steps in (3, 12, 30):
            self.solve(1, generated('creature'), *requested, '--checkpoint', self.path('run.ckpt'), '--every', 1,
                       '--max-iterations', steps, code=UNSUPPORTED if steps == 3 else LIMIT)
            self.assertSame(self.solve(2, generated('creature'), *requested, '--resume', self.path('run.ckpt')), whole)

    def test_killed_at_any_moment(self):
        """tests/campaigns/kill_and_resume.py does this more often."""
        moments = random.Random(SEED)
        mesh, requested = disk('helix_500'), ['--degree', 3, '--tolerance', 1e-9]
        whole = self.solve(2, mesh, *requested)
        kept = self.path('run.ckpt')
        for ranks, others in ((2, 3), (3, 1)):
            run = start(ranks, 'parametrize', mesh, '-o', self.path('a.pvtu'), *requested, '--checkpoint', kept,
                        '--every', 1)
            pids = processes_of(run, ranks)
            time.sleep(moments.uniform(0, whole['seconds']['total']))
            if run.poll() is None:
                os.kill(moments.choice(pids), signal.SIGKILL)
            ended(run)
            resume = ['--resume', kept] if os.path.exists(kept) else []
            self.assertSame(self.solve(others, mesh, *requested, *resume), whole)

    def test_a_signal_and_the_time_limit_keep_it(self):
        mesh, kept = disk('hand_2500'), self.path('run.ckpt')
        requested = ['--degree', 1, '--tolerance', 1e-9]
        run = start(2, 'parametrize', mesh, '-o', self.path('a.pvtu'), *requested, '--checkpoint', kept, '--every',
                    1000, '--verbose')
        wait_for(run, 'degree 1')
        run.send_signal(signal.SIGUSR1)
        self.assertEqual(ended(run)[0], LIMIT)
        self.assertTrue(os.path.exists(kept))
        report = self.solve(3, mesh, *requested, '--resume', kept, '--checkpoint', kept, '--time-limit', 0, code=LIMIT)
        self.assertEqual(report['iterations'], [])
        before = report['resumed']['iterations']
        report = self.solve(2, mesh, *requested, '--resume', kept, '--max-iterations', 2, '--checkpoint', kept,
                            code=LIMIT)
        self.assertEqual(report['resumed']['iterations'], before)
        report = self.solve(2, mesh, *requested, '--resume', kept)
        self.assertEqual(report['resumed']['iterations'], before + 2)
        self.assertGreater(report['resumed']['seconds'], 0)
        self.assertSame(report, self.solve(2, mesh, *requested))


class Refused(MpiTest):
    @classmethod
    def setUpClass(cls):
        """One checkpoint for all, of degree 2 from its first step on."""
        super().setUpClass()
        with tempfile.TemporaryDirectory() as folder:
            kept = os.path.join(folder, 'run.ckpt')
            done = alone('parametrize', disk('nefertiti_500'), '--degree', '2', '-o', os.path.join(folder, 'a.pvtu'),
                         '--elevation', 'direct', '--checkpoint', kept, '--max-iterations', 4)
            assert done.code == LIMIT, done.err
            with open(kept, 'rb') as f:
                cls.data = f.read()

    def setUp(self):
        super().setUp()
        self.mesh, self.kept = disk('nefertiti_500'), self.path('run.ckpt')
        self.requested = ['--degree', '2', '-o', self.path('a.pvtu')]
        with open(self.kept, 'wb') as f:
            f.write(self.data)

    def refuse(self, word, mesh=None, requested=(), data=None, path=None):
        path = path or self.path('other.ckpt')
        if data is not None:
            with open(path, 'wb') as f:
                f.write(data)
        done = alone('parametrize', mesh or self.mesh, *self.requested, *requested, '--resume', path)
        self.assertEqual(done.code, UNREADABLE, done.err)
        self.assertEqual(len(done.printed()), 1, done.err)
        self.assertIn(word, done.err)
        self.assertIn(path, done.err)
        return done.err

    def test_damaged_and_missing_checkpoints(self):
        """checkpoint_file_test.cpp damages files in more ways."""
        for word, data in (('no checkpoint', b'v 0 0 0\n'), ('cut short', self.data[:500]),
                           ('damaged', self.data[:600] + b'x' + self.data[601:])):
            self.refuse(word, data=data)
        self.refuse('check the name', path=self.path('absent.ckpt'))
        data = self.data[:8] + struct.pack('<Q', 2) + self.data[16:-8]
        self.assertIn('version 1', self.refuse('version 2', data=data + checksum(data)))

    def test_forged_files(self):
        """Contents that no run of this surface can write, under a correct checksum. checkpoint_file_test.cpp tests
        the reader alone."""
        size = struct.unpack('<Q', self.data[16:24])[0]
        header, rest = json.loads(self.data[24:24 + size]), self.data[24 + size:-8]
        v, f, n = header['vertices'], header['faces'], header['degree']

        def forged(header, rest=rest):
            text = json.dumps(header).encode() if isinstance(header, dict) else header
            data = self.data[:16] + struct.pack('<Q', len(text)) + text + rest
            return data + checksum(data)

        # Arrays with consistent lengths, but of another surface or degree.
        others = (n + 1) * (n + 2) // 2 - 3
        self.refuse("'vertices'", data=forged(dict(header, vertices=v + 1), rest + bytes(32)))
        self.refuse("'faces'", data=forged(dict(header, faces=f + 1), rest + bytes(16 * others + 1)))
        self.refuse("'degree'", data=forged(dict(header, degree=3), rest[:32 * v] + bytes((16 * 7 + 1) * f)))
        for key in ('identity', 'state', 'start', 'pins', 'iterations', 'seconds', 'ranks'):
            self.refuse("'%s'" % key, data=forged({k: w for k, w in header.items() if k != key}))
        for key, value in (('iterations', -1), ('ranks', 0), ('seconds', None), ('start', 3), ('pins', [[0, 0, 0]]),
                           ('handles', {}), ('identity', []), ('state', None)):
            self.refuse('header', data=forged(dict(header, **{key: value})))
        for text in (b'', b'[]', b'[' * 100000, b'\xff\xfe'):
            self.refuse('header', data=forged(text))
        # Finite numbers that are no map: the solver detects this.
        points = bytearray(rest)
        points[16 * v:16 * v + 16] = struct.pack('<dd', 1e300, -1e300)
        with open(self.path('far.ckpt'), 'wb') as out:
            out.write(forged(header, bytes(points)))
        done = alone('parametrize', self.mesh, *self.requested, '--resume', self.path('far.ckpt'))
        self.assertEqual(done.code, UNREADABLE, done.err)
        self.assertIn('the map of the checkpoint is not injective', done.err)

    def test_the_format_is_as_documented(self):
        self.assertEqual(self.data[:8], b'majorckp')
        version, size = struct.unpack('<QQ', self.data[8:24])
        self.assertEqual(version, 1)
        header = json.loads(self.data[24:24 + size])
        v, f, n = header['vertices'], header['faces'], header['degree']
        others = (n + 1) * (n + 2) // 2 - 3
        self.assertEqual(others, 3)
        self.assertEqual(len(self.data), 24 + size + 16 * v + 16 * v + 16 * others * f + f + 8)
        self.assertEqual(checksum(self.data[:-8]), self.data[-8:])
        numbers = struct.unpack_from('<%dd' % (4 * v + 2 * others * f), self.data, 24 + size)
        for x in numbers:
            self.assertTrue(x == 0 or 1e-30 < abs(x) < 1e6, 'bytes of something else: %r' % x)
        self.assertLess(max(self.data[-8 - f:-8]), 5, 'levels')

    def test_other_surfaces_and_other_options(self):
        pins = self.path('pins.json')
        with open(pins, 'w') as f:
            json.dump({'handles': [{'vertex': 3, 'target': 'initial'}]}, f)
        with open(self.mesh) as f:
            lines = f.readlines()
        x = [k for k, line in enumerate(lines) if line.startswith('v ')][7]
        words = lines[x].split()
        lines[x] = ' '.join(words[:3] + [repr(float(words[3]) + 1e-7)]) + '\n'
        with open(self.path('moved.obj'), 'w') as f:
            f.writelines(lines)
        self.refuse('another surface', path=self.kept, mesh=self.path('moved.obj'))
        self.refuse('--energy', path=self.kept, requested=['--energy', 'mips'])
        self.refuse('--boundary', path=self.kept, requested=['--boundary', 'fixed'])
        self.refuse('--pins', path=self.kept, requested=['--pins', pins])
        self.refuse('--handles', path=self.kept, requested=['--handles', pins])
        self.refuse('--quadrature', path=self.kept, requested=['--quadrature', 36])
        self.requested[1] = '3'
        self.assertIn('--degree 2', self.refuse('--degree', path=self.kept))

    def test_on_several_ranks_all_end(self):
        done = mpirun(2, 'parametrize', disk('helix_500'), *self.requested, '--resume', self.kept)
        self.assertEqual(done.code, UNREADABLE, done.err)

    def test_names_that_cannot_be_written(self):
        for name in (self.path('none/run.ckpt'), self.path('run.txt'), self.path('a.pvtu')):
            done = alone('parametrize', self.mesh, *self.requested, '--checkpoint', name)
            self.assertEqual(done.code, USAGE, done.err)

    def test_a_full_disk_leaves_the_older_one(self):
        """Files of more than 10 KB cannot be written from here on: the run continues with a message."""
        run = start(2, 'parametrize', disk('hand_2500'), '-o', self.path('b.pvtu'), '--degree', 1, '--checkpoint',
                    self.path('b.ckpt'), '--every', 1, '--verbose')
        wait_for(run, 'degree 1')
        while not os.path.exists(self.path('b.ckpt')):
            time.sleep(0.01)
        for pid in processes_of(run, 2):
            resource.prlimit(pid, resource.RLIMIT_FSIZE, (10000, 10000))
        code, printed = ended(run)
        self.assertEqual(code, USAGE)  # the map cannot be written either
        self.assertIn('b.ckpt: File too large; the run goes on', printed)
        self.assertEqual([n for n in os.listdir(self.folder) if '.tmp' in n], [])
        report = self.solve(2, disk('hand_2500'), '--degree', 1, '--resume', self.path('b.ckpt'))
        self.assertGreater(report['resumed']['iterations'], 0)


if __name__ == '__main__':
    need_mpi()
    unittest.main()
