#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""The add-on for Blender: in the background on objects of blender_objects.py, and with windows in blender_windows.py."""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile
from pathlib import Path

SOURCE = Path(os.environ['MAJORANT_SOURCE_DIR'])
BUILD = Path(os.environ['MAJORANT_BUILD_DIR'])
HERE = SOURCE / 'tests/adapters'
SCRIPT = SOURCE / 'cmake/scripts/make_blender_addon.py'

if not shutil.which('blender'):
    raise unittest.SkipTest('no blender (apt-get install blender)')
if not list((BUILD / 'python/majorant').glob('_core*.so')):
    raise unittest.SkipTest('no Python package in this build')


class Addon(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.holder.cleanup)
        cls.folder = Path(cls.holder.name)
        (cls.folder / 'addons').mkdir()
        (cls.folder / 'addons/majorant_blender').symlink_to(SOURCE / 'adapters/blender')

    def blender(self, *words, before=(), package=BUILD / 'python', code=0):
        """Runs Blender with separate settings; returns its output."""
        environment = {**os.environ, 'MAJORANT_ADDON': str(self.folder / 'addons'), 'PYTHONPATH': str(package or ''),
                       'BLENDER_USER_CONFIG': str(self.folder / 'config'), 'BLENDER_USER_SCRIPTS': str(self.folder / 'scripts'),
                       'BLENDER_USER_DATAFILES': str(self.folder / 'data'), 'HOME': str(self.folder),
                       'LIBGL_ALWAYS_SOFTWARE': '1', 'PYTHONDONTWRITEBYTECODE': '1'}
        options = ['--factory-startup', '--python-exit-code', '1'] + (['--python-use-system-env'] if package else [])
        done = subprocess.run([*before, 'blender', *options, *map(str, words)], env=environment, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=1200)
        self.assertEqual(done.returncode, code, done.stdout[-4000:])
        return done.stdout

    def require_cases(self, printed, least):
        failed = [line for line in printed.splitlines() if line.startswith('failed ')]
        self.assertEqual(failed, [], printed[-6000:])
        self.assertGreaterEqual(sum(line.startswith('ok ') for line in printed.splitlines()), least, printed[-4000:])

    def test_in_the_background(self):
        self.require_cases(self.blender('-b', '--python', HERE / 'blender_objects.py'), 30)

    @unittest.skipUnless(shutil.which('xvfb-run'), 'no xvfb-run (apt-get install xvfb)')
    def test_with_windows(self):
        screen = ['xvfb-run', '-a', '-s', '-screen 0 1280x800x24']
        printed = self.blender('--enable-event-simulate', '--window-geometry', '0', '0', '1280', '800', '--python',
                               HERE / 'blender_windows.py', '--', self.folder, before=screen)
        if 'no OpenGL' in printed:
            self.skipTest('no OpenGL 3.3 under xvfb')
        self.require_cases(printed, 4)

    def test_without_the_module_there_is_a_remedy(self):
        script = self.folder / 'missing.py'
        script.write_text('import os, sys\nsys.path.insert(0, os.environ["MAJORANT_ADDON"])\n'
                          'import bpy, majorant_blender\nmajorant_blender.register()\n'
                          'try:\n    bpy.ops.majorant.unwrap()\n'
                          'except RuntimeError as error:\n    print("says:", error)\n')
        printed = self.blender('-b', '--python', script, package=None)
        self.assertIn('says: Error: The Python module majorant is missing for Python', printed)
        self.assertIn('pip install', printed)

    def test_the_zip_is_installed_and_brings_its_module(self):
        wheel = self.wheel()
        target = self.folder / 'majorant_blender.zip'
        subprocess.run([sys.executable, SCRIPT, target, wheel], check=True, stdout=subprocess.DEVNULL)
        first = target.read_bytes()
        subprocess.run([sys.executable, SCRIPT, target, wheel], check=True, stdout=subprocess.DEVNULL)
        self.assertEqual(target.read_bytes(), first)
        with zipfile.ZipFile(target) as archive:
            names = archive.namelist()
            manifest = archive.read('majorant_blender/blender_manifest.toml').decode()
        self.assertIn(f'majorant_blender/wheels/{wheel.name}', names)
        self.assertIn('majorant_blender/LICENSE', names)
        self.assertIn(f'wheels = ["./wheels/{wheel.name}"]', manifest)
        script = self.folder / 'install.py'
        script.write_text(f'import bpy, sys\nbpy.ops.preferences.addon_install(filepath={str(target)!r})\n'
                          'bpy.ops.preferences.addon_enable(module="majorant_blender")\n'
                          'print(bpy.ops.majorant.unwrap(), "majorant of", sys.modules["majorant"].__file__)\n')
        printed = self.blender('-b', '--python', script, package=None)
        self.assertIn(f"{{'FINISHED'}} majorant of {self.folder}/data/majorant/", printed)

    def wheel(self):
        made = subprocess.run([sys.executable, SOURCE / 'cmake/scripts/make_wheel.py', BUILD, self.folder / 'dist'],
                              text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        if made.returncode != 0:
            self.skipTest('no wheel of this build')
        return Path(made.stdout.strip().splitlines()[-1])


if __name__ == '__main__':
    unittest.main()
