# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that the committed bundles of the pages are those that esbuild makes of their sources."""
import os
import shutil
import subprocess
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import browser

WEB = os.path.join(os.environ.get('MAJORANT_SOURCE_DIR', ''), 'pictures/web')


class Bundle(unittest.TestCase):
    def test_dist_is_made_from_src(self):
        folder = os.path.join(browser.BUILD, 'web')
        browser.npm_ci(WEB, folder, 'esbuild')
        sources = os.path.join(folder, 'src')
        shutil.rmtree(sources, ignore_errors=True)
        shutil.copytree(os.path.join(WEB, 'src'), sources)
        shutil.copy(os.path.join(WEB, 'build.mjs'), folder)
        made = os.path.join(folder, 'dist')
        shutil.rmtree(made, ignore_errors=True)
        subprocess.run(['node', 'build.mjs', made], cwd=folder, check=True, timeout=120)
        committed = os.path.join(WEB, 'dist')
        self.assertEqual(sorted(os.listdir(made)), sorted(os.listdir(committed)))
        for name in os.listdir(made):
            with open(os.path.join(made, name), 'rb') as a, \
                    open(os.path.join(committed, name), 'rb') as b:
                self.assertTrue(a.read() == b.read(),
                                'pictures/web/dist/%s is old: npm ci && npm run build, in pictures/web/' % name)
            self.assertLess(os.path.getsize(os.path.join(committed, name)), 1 << 20)


if __name__ == '__main__':
    browser.require_npm()
    unittest.main()
