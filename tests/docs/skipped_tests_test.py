#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""What is not run is seen: tests/main.py, and what scripts/skipped_tests.py makes of ctest's report."""
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ['MAJORANT_SOURCE_DIR'])
HEAD = 'import unittest\nclass A(unittest.TestCase):\n'
RUN = '    def test_run(self): pass\n'
LACK = '    @unittest.skipIf(True, "no moon")\n    def test_lack(self): pass\n'
WHOLE = 'import unittest\n@unittest.skipIf(True, "no sun")\nclass B(unittest.TestCase):\n' + RUN
FAIL = '    def test_fail(self): self.fail()\n'
CLASS = '    @classmethod\n    def setUpClass(cls): raise unittest.SkipTest("no stars")\n'
TAIL = 'unittest.main()\n'


class Skipped(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix='majorant_skipped_')
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_test(self, text, *arguments):
        """Exit code, and what it says of what it skipped."""
        path = self.folder / 'x_test.py'
        path.write_text(text)
        done = subprocess.run([sys.executable, SOURCE / 'tests/main.py', path, *arguments], text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        return done.returncode, done.stdout.splitlines()

    def test_main(self):
        self.assertEqual(self.run_test(HEAD + RUN + TAIL), (0, []))
        self.assertEqual(self.run_test(HEAD + RUN + LACK + TAIL), (0, ['skipped A.test_lack: no moon']))
        self.assertEqual(self.run_test(HEAD + FAIL + LACK + TAIL), (1, ['skipped A.test_lack: no moon']))
        self.assertEqual(self.run_test(HEAD + LACK + WHOLE + TAIL), (77, [
            'skipped A.test_lack: no moon', 'skipped B.test_run: no sun', 'skipped: no moon; no sun']))
        self.assertEqual(self.run_test(HEAD + CLASS + RUN + TAIL),
                         (77, ['skipped A: no stars', 'skipped: no stars']))
        other = HEAD.replace('A(', 'B(') + RUN
        self.assertEqual(self.run_test(HEAD + CLASS + RUN + other + TAIL), (0, ['skipped A: no stars']))
        self.assertEqual(self.run_test('import unittest\nraise unittest.SkipTest("no rain")\n'),
                         (77, ['skipped: no rain']))
        self.assertEqual(self.run_test(HEAD + '    pass\n' + TAIL), (1, []))
        self.assertEqual(self.run_test(HEAD + RUN + FAIL + TAIL, 'A.test_run'), (0, []))

    def summary(self, *cases):
        path = self.folder / 'tests.xml'
        path.write_text('<testsuite>%s</testsuite>' % ''.join(
            '<testcase name="%s">%s<system-out>%s</system-out></testcase>' % case for case in cases))
        return subprocess.run([sys.executable, SOURCE / 'scripts/skipped_tests.py', path], text=True, check=True,
                              stdout=subprocess.PIPE).stdout.strip()

    def test_what_is_said(self):
        run = ('a', '', 'skipped\nOK')
        self.assertEqual(self.summary(run), 'every test was run')
        self.assertEqual(self.summary(run, ('b', '', 'x\nskipped B.x: no moon\nskipped B.y: no moon\nOK'),
                                      ('c', '<skipped/>', 'skipped C.x: no sun\nskipped: no sun'),
                                      ('d', '<skipped/>', 'bye')),
                         'not run: b B.x, b B.y (no moon); c (no sun); d (not said why)')


if __name__ == '__main__':
    unittest.main()
