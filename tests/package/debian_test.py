#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests the Debian packages: their contents, and unpacked programs; with MAJORANT_DEBIAN_ROOT=DIR also their
installation in a new Debian (cmake/scripts/try_packages.py)."""
import hashlib
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = os.environ['MAJORANT_SOURCE_DIR']
BUILD = os.environ['MAJORANT_BUILD_DIR']
sys.path.insert(0, os.path.join(SOURCE, 'cmake/scripts'))
import try_packages  # noqa: E402


@unittest.skipUnless(shutil.which('cpack'), 'no cpack')
class WithoutTools(unittest.TestCase):
    """A package without dependencies could be installed anywhere, but would not run."""

    def pack(self, *programs):
        """Returns cpack's exit code and output if only these programs exist, and the packages it made."""
        with tempfile.TemporaryDirectory(prefix='majorant_debian_') as folder:
            bin_folder, out = os.path.join(folder, 'bin'), os.path.join(folder, 'out')
            os.mkdir(bin_folder)
            for name in programs:
                with open(os.path.join(bin_folder, name), 'w') as f:
                    f.write('#!/bin/sh\nexit 1\n')
                os.chmod(f.name, 0o755)
            done = subprocess.run([shutil.which('cpack'), '-G', 'DEB', '-B', out], cwd=BUILD, text=True,
                                  env={**os.environ, 'PATH': bin_folder}, stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT)
            return done.returncode, done.stdout, [path for path in Path(folder).rglob('*.deb')]

    def test_the_error_names_the_missing_packages(self):
        for programs, packages in (((), 'dpkg-dev file'), (('dpkg-shlibdeps',), 'file'), (('file',), 'dpkg-dev')):
            with self.subTest(programs):
                code, printed, made = self.pack(*programs)
                self.assertNotEqual(code, 0)
                lines = [line for line in printed.splitlines() if 'apt-get install' in line]
                self.assertEqual(len(lines), 1, printed)
                self.assertTrue(lines[0].endswith(': apt-get install ' + packages), printed)
                self.assertEqual(made, [])

    def test_the_tools_are_listed_among_the_packages(self):
        with open(os.path.join(SOURCE, 'cmake/scripts/packages_core.txt')) as f:
            self.assertLessEqual({'dpkg-dev', 'file'}, set(f.read().split()))


@unittest.skipIf(try_packages.missing_tools(), 'no ' + ', '.join(try_packages.missing_tools()))
class Packages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix='majorant_debian_')
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.packages = try_packages.packages_of(BUILD, cls.folder)

    def test_contents(self):
        self.assertEqual(sorted(self.packages), ['libmajorant-dev', 'majorant'])
        for name, path in self.packages.items():
            try_packages.check_contents(name, path)

    def test_unpacked_it_runs_and_sums_agree(self):
        root = os.path.join(self.folder, 'root')
        subprocess.check_call(['dpkg-deb', '--raw-extract', self.packages['majorant'], root])
        with open(os.path.join(root, 'DEBIAN/md5sums')) as f:
            sums = [line.split() for line in f]
        self.assertGreater(len(sums), 5)
        for digest, name in sums:
            with open(os.path.join(root, name), 'rb') as f:
                self.assertEqual(hashlib.md5(f.read()).hexdigest(), digest, name)
        out = os.path.join(self.folder, 'out.obj')
        subprocess.check_call([os.path.join(root, 'usr/bin/majorant'), 'parametrize', '--quiet',
                               os.path.join(SOURCE, 'examples/meshes/cap.obj'), out])
        self.assertGreater(os.path.getsize(out), 1000)

    @unittest.skipUnless(os.environ.get('MAJORANT_DEBIAN_ROOT'), 'no MAJORANT_DEBIAN_ROOT')
    def test_in_a_new_debian(self):
        done = subprocess.run([os.path.join(SOURCE, 'cmake/scripts/try_packages.py'), BUILD, '--root',
                               os.environ['MAJORANT_DEBIAN_ROOT']], text=True, stdout=subprocess.PIPE)
        if done.returncode == try_packages.SKIPPED:
            self.skipTest(done.stdout.splitlines()[-1])
        self.assertEqual(done.returncode, 0)


if __name__ == '__main__':
    unittest.main()
