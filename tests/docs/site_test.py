#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that cmake/scripts/make_site.py makes the site without warnings, with a search and the viewer, and
finds broken links."""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ['MAJORANT_SOURCE_DIR'])
NEEDED = [name for name in ('mkdocs', 'doxygen') if not shutil.which(name)]


@unittest.skipIf(NEEDED, 'no ' + ', '.join(NEEDED))
class Site(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory(prefix='majorant_site_')
        self.addCleanup(place.cleanup)
        self.root = Path(place.name)
        for path in SOURCE.iterdir():
            if path.name == 'docs':
                shutil.copytree(path, self.root / path.name)
            elif path.name == 'cmake':  # with the scripts
                shutil.copytree(path, self.root / path.name, ignore=shutil.ignore_patterns('__pycache__'))
            elif path.name not in ('build', '.git', 'out'):
                (self.root / path.name).symlink_to(path)

    def make(self, *words):
        return subprocess.run([sys.executable, self.root / 'cmake/scripts/make_site.py', *words], text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    def test_is_made(self):
        done = self.make()
        self.assertEqual(done.returncode, 0, done.stdout)
        site = self.root / 'build/site'
        self.assertIn('seamless', (site / 'search/search_index.json').read_text())
        self.assertIn('<iframe src="creature.html"', (site / 'viewer.html').read_text())
        self.assertEqual((site / 'creature.html').read_bytes(), (SOURCE / 'docs/creature.html').read_bytes())
        self.assertGreater(len(list((site / 'api').glob('*.html'))), 100)
        self.assertIn('href="measurements.html#charts"', (site / 'atlas.html').read_text())
        self.assertNotIn('measurements.html', (site / 'search/search_index.json').read_text())
        for page in (self.root / 'docs').glob('*.md'):
            self.assertTrue((site / page.with_suffix('.html').name).exists(), page.name)

    def test_links_that_lead_nowhere(self):
        page = self.root / 'docs/start.md'
        page.write_text(page.read_text() + '\n[a](method.md#no-such-heading)\n')
        (self.root / 'docs/creature.html').unlink()
        (self.root / 'README.md').unlink()  # the copy also links to it
        (self.root / 'README.md').write_text('# majorant\n')
        done = self.make('--no-headers')
        self.assertEqual(done.returncode, 1)
        self.assertIn('start.html: no method.html#no-such-heading', done.stdout)
        self.assertIn('viewer.html: no creature.html', done.stdout)


if __name__ == '__main__':
    unittest.main()
