# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Little address space: a run ends with the reason, or does all its work; it never hangs."""
import gzip
import resource
import subprocess

from command_helpers import *

MIB = 1 << 20


class Memory(CommandTest):
    def run_within(self, mebibytes, *args):
        def lower():
            resource.setrlimit(resource.RLIMIT_AS, (mebibytes * MIB,) * 2)
        return Outcome(subprocess.run([BINARY] + [str(a) for a in args], stdin=subprocess.DEVNULL,
                                      stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                      preexec_fn=lower, timeout=120))

    def all_or_nothing(self, mesh, degree, limits):
        """Returns codes by limit. Exit code 0 gives the same file as a run without a limit."""
        job = ('parametrize', generated(mesh), '-o', self.path('out.vtu'), '--degree', degree, '--quiet')
        self.run_ok(*job)
        expected, codes = self.read('out.vtu'), []
        for limit in limits:
            os.unlink(self.path('out.vtu'))
            outcome = self.run_within(limit, *job)
            if outcome.code == OK:
                self.assertEqual(self.read('out.vtu'), expected)
            else:
                self.assertEqual(outcome.code, UNSUPPORTED, (limit, outcome.err))
                self.assertIn('out of memory', outcome.err.splitlines()[-1])
                self.assertEqual(self.files(), [])
                self.write('out.vtu', '')
            codes.append(outcome.code)
        return codes

    def test_around_the_threshold(self):
        codes = self.all_or_nothing('wavy_disk', 5, (40, 46, 47, 48, 49, 50, 260))
        self.assertEqual((codes[0], codes[-1]), (UNSUPPORTED, OK))

    def test_exhausted_later(self):
        codes = self.all_or_nothing('creature', 3, (40, 60, 62, 63, 64, 400))
        self.assertEqual((codes[0], codes[-1]), (UNSUPPORTED, OK))

    def test_a_small_file_that_stands_for_a_large_one(self):
        mesh = self.path('bomb.obj.gz')
        with gzip.open(mesh, 'wb', compresslevel=9) as f:
            for _ in range(600):
                f.write(b' ' * MIB)
        self.assertLess(os.path.getsize(mesh), MIB)
        outcome = self.run_within(400, 'info', mesh)
        self.assertEqual(outcome.code, UNSUPPORTED)
        self.assertIn('out of memory', outcome.err)

    def test_verbs_without_a_solver_need_no_more_than_their_files(self):
        self.assertEqual(self.run_within(120, 'info', generated('cap')).code, OK)


if __name__ == '__main__':
    main()
