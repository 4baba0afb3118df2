# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests the search paths of programs and libraries. An empty or relative entry is the current directory,
which may hold anybody's files."""
import os
import re
import shutil
import subprocess
import tempfile
import unittest

SOURCE = os.environ['MAJORANT_SOURCE_DIR']
BUILD = os.environ['MAJORANT_BUILD_DIR']


def run(*command):
    done = subprocess.run(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    assert done.returncode == 0, '%s: exit %d\n%s' % (command, done.returncode, done.stdout)
    return done.stdout


def relative_entries(path):
    return [entry for entry in path.split(':')
            if not os.path.isabs(entry) and not re.match(r'\$ORIGIN(/|$)', entry)]


def binaries(tree):
    """Yields programs, libraries and modules of a tree, without objects."""
    for folder, folders, names in os.walk(tree):
        folders[:] = [name for name in folders if name != 'CMakeFiles']
        for name in names:
            file = os.path.join(folder, name)
            if os.path.islink(file) or not (os.access(file, os.X_OK) or '.so' in name):
                continue
            with open(file, 'rb') as f:
                if f.read(4) == b'\x7fELF':
                    yield file


def search_paths(file):
    """Returns the folders of DT_RPATH and DT_RUNPATH."""
    return re.findall(r'\((?:RPATH|RUNPATH)\).*\[(.*)\]', run('readelf', '-dW', file))


class SearchPaths(unittest.TestCase):
    def test_no_relative_search_paths(self):
        files = list(binaries(BUILD))
        self.assertIn(os.path.join(BUILD, 'apps', 'majorant'), files)
        wrong = {file: path for file in files for path in search_paths(file) if relative_entries(path)}
        self.assertEqual(wrong, {})

    @unittest.skipUnless(os.path.exists(os.path.join(BUILD, 'apps', 'majorant-mpi')), 'no majorant-mpi')
    def test_an_evil_library_in_the_current_directory(self):
        with tempfile.TemporaryDirectory() as folder:
            source = os.path.join(folder, 'evil.c')
            with open(source, 'w') as f:
                f.write('#include <stdio.h>\n__attribute__((constructor)) static void run(void)'
                        ' { fclose(fopen("PWNED", "w")); }\n')
            for name in self.needed(os.path.join(BUILD, 'apps', 'majorant-mpi')):
                run('cc', '-shared', '-fPIC', '-Wl,-soname,' + name, '-o', os.path.join(folder, name), source)
            done = subprocess.run([os.path.join(BUILD, 'apps', 'majorant-mpi'), '--version'], cwd=folder,
                                  env=dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT='1',
                                           OMPI_ALLOW_RUN_AS_ROOT_CONFIRM='1'),
                                  text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            self.assertEqual(done.returncode, 0, done.stdout)
            self.assertNotIn('PWNED', os.listdir(folder))

    def needed(self, program):
        names = re.findall(r'\(NEEDED\).*\[(.*)\]', run('readelf', '-dW', program))
        return [name for name in names if re.match(r'lib(c?amd|metis|petsc|ptscotch|mpi)', name)]

    def test_shared_libraries(self):
        """Tests shared libraries by the command lines that would link them."""
        folder = tempfile.mkdtemp(prefix='majorant_paths_')
        self.addCleanup(shutil.rmtree, folder)
        run('cmake', '-S', SOURCE, '-B', folder, '-G', 'Ninja', '-DBUILD_SHARED_LIBS=ON',
            '-DMAJORANT_BUILD_TESTS=OFF', '-DMAJORANT_BUILD_BENCH=OFF', '-DMAJORANT_BUILD_PYTHON=OFF')
        link = run('ninja', '-C', folder, '-t', 'commands', 'apps/majorant', 'lib/libmajorant.so')
        paths = re.findall(r'-Wl,-rpath,(\S+)', link)
        self.assertGreaterEqual(len(paths), 3, 'the program and two libraries')
        for path in paths:
            self.assertEqual(relative_entries(path.replace('\\$ORIGIN', '$ORIGIN').strip('"\'')), [], path)
        self.assertTrue(any('ORIGIN/../lib' in path for path in paths), paths)


if __name__ == '__main__':
    unittest.main()
