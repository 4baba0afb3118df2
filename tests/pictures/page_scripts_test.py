#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests the parts of the page that need no browser: `node --test pictures/web/test`.

Without node the exit code is 77, which ctest reports as skipped.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

WEB = pathlib.Path(os.environ['MAJORANT_SOURCE_DIR']) / 'pictures/web'


class PageScripts(unittest.TestCase):
    def test_units(self):
        run = subprocess.run(['node', '--test', 'test/'], cwd=WEB, capture_output=True, text=True,
                             timeout=120)
        self.assertEqual(run.returncode, 0, run.stdout)
        self.assertGreaterEqual(int(re.search(r'pass (\d+)', run.stdout)[1]), 10)

    def test_the_bundle_cannot_end_its_script_element(self):
        bundle = (WEB / 'dist' / 'map_page.js').read_bytes()
        self.assertLess(len(bundle), 1 << 20)
        self.assertNotRegex(bundle, b'(?i)</script|<!--')


if __name__ == '__main__':
    if not shutil.which('node'):
        print('skipped: no node')
        sys.exit(77)
    unittest.main()
