#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests the wheel of `make wheel` in an environment with numpy and no other system packages."""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile
from pathlib import Path

SOURCE = Path(os.environ['MAJORANT_SOURCE_DIR'])
BUILD = Path(os.environ['MAJORANT_BUILD_DIR'])
SCRIPT = SOURCE / 'cmake/scripts/make_wheel.py'
sys.path.insert(0, str(SCRIPT.parent))
import make_wheel  # noqa: E402

PYTHON = '/usr/bin/python3'
NUMPY = Path('/usr/lib/python3/dist-packages')
GPL = make_wheel.has_gpl_parts(BUILD)

if not list((BUILD / 'python/majorant').glob('_core*.so')):
    raise unittest.SkipTest('no Python package in the build')
if 'BUILD_SHARED_LIBS:BOOL=ON' in (BUILD / 'CMakeCache.txt').read_text():
    raise unittest.SkipTest('no wheels of builds with shared libraries')

# Prints the libraries that importing loads, besides those of numpy, and the CPU seconds.
IMPORT = '''
import json, time, numpy
def libraries():
    return {line.split()[-1] for line in open('/proc/self/maps') if '.so' in line}
before = libraries()
started = time.process_time()
import majorant
print(json.dumps({'seconds': time.process_time() - started, 'new': sorted(libraries() - before), 'file': majorant.__file__}))
'''
WORK = '''
import majorant, majorant.xatlas as xatlas, numpy as np
V, F = majorant.read_mesh('mesh.obj')
vmapping, indices, uvs = xatlas.parametrize(V, F)
assert (vmapping[indices] == F).all() and uvs.dtype == np.float32
r = majorant.unwrap(V, F)
for name in ('out.obj', 'out.glb', 'out.svg', 'out.png', 'out.html', 'out.vtu'):
    r.save(name)
loaded = {line.split()[-1] for line in open('/proc/self/maps') if 'libcairo' in line}
assert all('majorant.libs' in name for name in loaded) and loaded, loaded
'''
CERES = '''
import majorant, numpy as np
x = majorant.Problem(2)
x.add(majorant.penalty(np.eye(2), [3.0, 4.0]))
print(x.minimize([0.0, 0.0], method='ceres-lbfgs').x)
loaded = {line.split()[-1] for line in open('/proc/self/maps') if 'libglog' in line}
assert all('majorant.libs' in name for name in loaded) and loaded, loaded
'''


class Wheel(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp())
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.wheel = Path(cls.run_words(SCRIPT, BUILD, cls.folder / 'dist').strip())

    @classmethod
    def run_words(cls, *words, **options):
        environment = {k: v for k, v in os.environ.items() if not k.startswith('PYTHON')}
        done = subprocess.run(list(map(str, words)), capture_output=True, text=True, cwd=cls.folder,
                              env={**environment, 'PIP_DISABLE_PIP_VERSION_CHECK': '1'}, **options)
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout

    @classmethod
    def environment(cls):
        """Returns an interpreter with the wheel and numpy."""
        home = cls.folder / 'environment'
        if not home.exists():
            cls.run_words(PYTHON, '-m', 'venv', home)
            site = next(home.glob('lib/python3*/site-packages'))
            for found in NUMPY.glob('numpy*'):
                (site / found.name).symlink_to(found)
            cls.run_words(home / 'bin/pip', 'install', '--no-index', cls.wheel)
        return home / 'bin/python'

    def test_name(self):
        version = re.search(r'project\(majorant VERSION (\S+)', (SOURCE / 'CMakeLists.txt').read_text())[1]
        tag = 'cp%s%s' % tuple(self.run_words(PYTHON, '-c', 'import sys; print(*sys.version_info[:2])').split())
        version += '' if GPL else make_wheel.PERMISSIVE
        self.assertEqual(self.wheel.name, f'majorant-{version}-{tag}-{tag}-manylinux_2_36_x86_64.whl')

    def test_needs_only_libraries_of_manylinux(self):
        self.assertIn('MB', self.run_words(SCRIPT, '--check', self.wheel))

    def test_the_check_finds_defects(self):
        """Checks a wheel without one of its libraries, and one with an unused library."""
        broken = self.folder / self.wheel.name
        with zipfile.ZipFile(self.wheel) as old, zipfile.ZipFile(broken, 'w') as new:
            for name in old.namelist():
                if not name.startswith('majorant.libs/libfmt'):
                    new.writestr(name, old.read(name))
            new.writestr('majorant.libs/libx.so', old.read(next(n for n in old.namelist() if 'libs/libfmt' in n)))
        done = subprocess.run([SCRIPT, '--check', broken], capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stdout, r'needs libfmt\S*, which is not there')
        self.assertIn('nothing needs libx.so', done.stdout)

    def test_is_reproducible(self):
        again = Path(self.run_words(SCRIPT, BUILD, self.folder / 'again').strip())
        self.assertEqual(again.read_bytes(), self.wheel.read_bytes())

    def test_metadata(self):
        with zipfile.ZipFile(self.wheel) as archive:
            names = archive.namelist()
            info = next(n for n in names if n.endswith('METADATA'))
            text = archive.read(info).decode()
        head, page = text.split('\n\n', 1)
        self.assertEqual(page, (SOURCE / 'README.md').read_text())
        self.assertIn('Requires-Dist: numpy', head)
        licence = re.search('^License-Expression: (.*)$', head, re.M)[1]
        self.assertEqual('GPL-3.0-or-later' in licence, GPL)
        self.assertIn('majorant/py.typed', names)
        self.assertIn('majorant/_core.pyi', names)
        texts = {Path(name).stem for name in names if '/licenses/' in name}
        self.assertIn('libcairo2', texts)
        for package in ('libcgal-dev', 'libceres-dev', 'libcholmod3'):
            self.assertEqual(package in texts, GPL, package)

    def test_the_licence_of_a_permissive_wheel_names_no_gpl(self):
        head = make_wheel.metadata('1' + make_wheel.PERMISSIVE, make_wheel.LICENCES).split('\n\n', 1)[0]
        licence = re.search('^License-Expression: (.*)$', head, re.M)[1]
        self.assertTrue(licence.startswith('BSD-3-Clause AND '), licence)
        self.assertNotIn('GPL', licence)

    @unittest.skipUnless(GPL, 'this build has no GPL parts')
    def test_a_permissive_wheel_may_not_have_the_libraries_of_this_one(self):
        other = self.folder / self.wheel.name.replace('-cp', make_wheel.PERMISSIVE + '-cp', 1)
        shutil.copy(self.wheel, other)
        defects = list(make_wheel.defects(other))
        self.assertTrue(any('libnlopt' in line for line in defects), defects)
        self.assertIn('the licence names the GPL', defects)

    def test_works_without_packages_of_the_system(self):
        python = self.environment()
        done = subprocess.run([python, '-c', 'import scipy'], capture_output=True, text=True)
        self.assertIn('ModuleNotFoundError', done.stderr)
        found = json.loads(self.run_words(python, '-c', IMPORT))
        site = str(python.parent.parent)
        self.assertTrue(found['file'].startswith(site))
        system = r'/(libstdc\+\+|libgcc_s|libm|libc|libdl|libpthread|librt)\.so|/lib-dynload/'
        outside = [name for name in found['new'] if not name.startswith(site) and not re.search(system, name)]
        self.assertEqual(outside, [])
        self.assertFalse([n for n in found['new'] if re.search('cairo|OpenEXR|glog|cholmod|blas|X11', n)])
        shutil.copy(SOURCE / 'examples/meshes/creature.obj', self.folder / 'mesh.obj')
        self.run_words(python, '-c', WORK)

    def test_the_page_leads_to_a_textured_file(self):
        """Runs the lines and the program of docs/python.md, with a pip that downloads nothing and finds
        numpy."""
        page = (SOURCE / 'docs/python.md').read_text().split('## From pip to a textured file')[1]
        lines, program = (re.search(rf'^```{kind}\n(.*?)^```', page, re.S | re.M)[1] for kind in ('sh', 'python'))
        folder = self.folder / 'textured file'
        home = folder / 'home'
        home.mkdir(parents=True)
        (folder / 'examples').symlink_to(SOURCE / 'examples')
        (folder / self.wheel.name).symlink_to(self.wheel)
        (folder / 'textured.py').write_text(program)
        environment = {'HOME': str(home), 'PATH': '/usr/bin:/bin', 'PIP_NO_INDEX': '1', 'PIP_DISABLE_PIP_VERSION_CHECK': '1'}
        for line in lines.splitlines():
            done = subprocess.run(['sh', '-ec', line], cwd=folder, env=environment, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, line + '\n' + done.stdout + done.stderr)
            if 'venv' in line:
                site = next((home / 'textured').glob('lib/python3*/site-packages'))
                for found in NUMPY.glob('numpy*'):
                    (site / found.name).symlink_to(found)
        data = (folder / 'creature.glb').read_bytes()
        size = int.from_bytes(data[12:16], 'little')
        content = json.loads(data[20:20 + size])
        view = content['bufferViews'][content['images'][0]['bufferView']]
        image = data[28 + size:][view['byteOffset']:view['byteOffset'] + view['byteLength']]
        self.assertEqual(image[:8], b'\x89PNG\r\n\x1a\n')
        self.assertIn('TEXCOORD_0', content['meshes'][0]['primitives'][0]['attributes'])
        self.assertEqual(content['meshes'][0]['primitives'][0]['material'], 0)

    def test_import_is_quick(self):
        python = self.environment()
        self.run_words(python, '-c', IMPORT)
        seconds = [json.loads(self.run_words(python, '-c', IMPORT))['seconds'] for _ in range(5)]
        self.assertLess(min(seconds), 0.15)

    @unittest.skipUnless(GPL, 'no Ceres in this build')
    def test_ceres_is_loaded_when_it_is_used(self):
        done = subprocess.run([PYTHON, '-c', 'import scipy'], capture_output=True)
        if done.returncode:
            self.skipTest('no scipy')
        folder = self.folder / 'unpacked'
        with zipfile.ZipFile(self.wheel) as archive:
            archive.extractall(folder)
        done = subprocess.run([PYTHON, '-c', CERES], capture_output=True, text=True, cwd=self.folder,
                              env={**os.environ, 'PYTHONPATH': str(folder)})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual([round(float(word), 6) for word in re.findall(r'[\d.]+', done.stdout)], [3, 4])


if __name__ == '__main__':
    unittest.main()
