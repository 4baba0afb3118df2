#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""main.py FILE_test.py [ARGUMENT...]: runs a test script as python3 would, and lists skipped tests.

Each test that was not run is a line `skipped Class.test: no ...`. If no test of the file was run, the last
line is `skipped: no ...` and the exit code 77. cmake/scripts/skipped_tests.py reads both kinds.
"""
import os
import re
import runpy
import sys
import unittest

SKIPPED = 77


class Program(unittest.TestProgram):
    """The replacement of unittest.main()."""

    def runTests(self):
        self.exit = False
        super().runTests()
        skipped = self.result.skipped
        for test, why in skipped:  # a whole class was skipped: setUpClass (__main__.Class)
            name = re.sub(r'setUpClass \((.*)\)', r'\1', test.id()).replace('__main__.', '')
            print('skipped %s: %s' % (name, why))
        started = sum(isinstance(test, unittest.TestCase) for test, _ in skipped)
        if not self.result.wasSuccessful():
            sys.exit(1)
        if skipped and self.result.testsRun == started:
            print('skipped: ' + '; '.join(sorted({why for _, why in skipped})))
            sys.exit(SKIPPED)
        if self.result.testsRun == 0:
            sys.exit('no tests')
        sys.exit(0)


if __name__ == '__main__':
    sys.argv = sys.argv[1:]
    sys.path[0] = os.path.dirname(os.path.abspath(sys.argv[0]))
    unittest.main = Program
    try:
        runpy.run_path(sys.argv[0], run_name='__main__')
    except unittest.SkipTest as why:  # the whole file was skipped before its first test
        print('skipped:', why)
        sys.exit(SKIPPED)
