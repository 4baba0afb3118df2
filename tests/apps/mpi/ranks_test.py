# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""The C++ tests of this folder on two ranks; ctest runs them on one."""
import unittest

from mpi_helpers import *

PROGRAM = os.path.join(os.environ['MAJORANT_BUILD_DIR'], 'tests', 'apps_mpi_tests')


class OnTwoRanks(unittest.TestCase):
    def test_every_test_passes(self):
        done = subprocess.run(['mpirun', '-n', '2', PROGRAM], env=ENVIRONMENT, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stdout[-4000:])
        self.assertEqual(done.stdout.count('[  PASSED  ]'), 2)


if __name__ == '__main__':
    need_mpi()
    unittest.main()
