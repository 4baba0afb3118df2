# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Installs the build, builds a program against the package, and compares it with the command."""
import concurrent.futures
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

BINARY = os.environ.get('MAJORANT_BINARY', '')
SOURCE = os.environ.get('MAJORANT_SOURCE_DIR', '')
BUILD = os.environ.get('MAJORANT_BUILD_DIR', '')
CONSUMER = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'consumer')


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix='majorant_package_')
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.prefix = os.path.join(cls.folder, 'prefix')
        cls.build = os.path.join(cls.folder, 'build')
        cls.do('cmake', '--install', BUILD, '--prefix', cls.prefix)
        cls.do('cmake', '-S', CONSUMER, '-B', cls.build, '-DCMAKE_BUILD_TYPE=Release',
               '-DCMAKE_PREFIX_PATH=' + cls.prefix)
        cls.do('cmake', '--build', cls.build)

    @staticmethod
    def do(*command):
        done = subprocess.run(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        assert done.returncode == 0, '%s: %d\n%s' % (command, done.returncode, done.stdout)
        return done.stdout

    def installed(self):
        for folder, _, files in os.walk(self.prefix):
            for name in files:
                yield os.path.join(folder, name)

    def test_the_consumer_gets_the_value_of_the_command(self):
        for name in ('cap', 'tube'):
            mesh = os.path.join(SOURCE, 'examples/meshes', name + '.obj')
            report = os.path.join(self.folder, 'report.json')
            self.do(BINARY, 'parametrize', '--quiet', mesh, '-o', report, '--degree', '3')
            with open(report) as f:
                expected = json.load(f)['result']['value']
            value = float(self.do(os.path.join(self.build, 'consumer'), mesh))
            # Inline code of the headers is compiled with other flags, so the last digits may differ.
            self.assertAlmostEqual(value / expected, 1, delta=1e-9)

    def test_volumes(self):
        """Four tetrahedra around a point outside of them become valid, with the command's report."""
        mesh, report = (os.path.join(self.folder, name) for name in ('a.mesh', 'report.json'))
        with open(mesh, 'w') as f:
            f.write('MeshVersionFormatted 2\nDimension 3\nVertices 5\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n'
                    '-0.1 0.2 0.2 0\nTetrahedra 4\n5 2 3 4 1\n1 5 3 4 1\n1 2 5 4 1\n1 2 3 5 1\nEnd\n')
        self.do(BINARY, 'mesh', 'optimize', mesh, '-o', os.path.join(self.folder, 'b.mesh'), '--report', report)
        with open(report) as f:
            expected = json.load(f)
        invalid, least = self.do(os.path.join(self.build, 'volumes'), mesh).split()
        self.assertEqual(int(invalid), expected['input']['invalid'])
        self.assertGreater(int(invalid), 0)
        self.assertAlmostEqual(float(least) / expected['result']['mesh']['min_scaled_jacobian'], 1, delta=1e-9)

    def test_exceptions_reach_the_consumer(self):
        done = subprocess.run([os.path.join(self.build, 'consumer'), '/nonexistent/mesh.obj'], text=True,
                              stderr=subprocess.PIPE)
        self.assertEqual(done.returncode, 3)
        self.assertIn('/nonexistent/mesh.obj', done.stderr)

    def test_the_installed_command_runs(self):
        self.assertIn('majorant', self.do(os.path.join(self.prefix, 'bin', 'majorant'), '--version'))

    def test_the_schema_of_reports(self):
        with open(os.path.join(self.prefix, 'share', 'majorant', 'report.schema.json')) as f:
            self.assertIn('schema_version', json.load(f)['required'])

    def test_the_package_does_not_point_back(self):
        names = list(self.installed())
        self.assertTrue(any(n.endswith('majorantConfig.cmake') for n in names))
        for name in names:
            if name.endswith('.cmake'):
                with open(name) as f:
                    text = f.read()
                for place in (SOURCE + '/', BUILD + '/'):
                    self.assertNotIn(place, text, name)

    def headers(self):
        root = os.path.join(self.prefix, 'include')
        return root, sorted(os.path.relpath(n, root) for n in self.installed() if n.endswith('.h'))

    def test_the_installed_headers_are_the_public_ones(self):
        _, headers = self.headers()
        with open(os.path.join(SOURCE, 'cmake/public_headers.txt')) as f:
            listed = [line.strip() for line in f if line.strip() and not line.startswith('#')]
        self.assertEqual(headers, sorted(listed))
        self.assertEqual([n for n in headers if '/internal/' in n], [])

    def test_comments_name_installed_headers(self):
        root, headers = self.headers()
        known = {os.path.basename(name) for name in headers}
        wrong = []
        for name in headers:  # a user of the package has no other files
            with open(os.path.join(root, name)) as f:
                for number, line in enumerate(f, 1):
                    for other in re.findall(r'[\w/.]+\.(?:h|cpp)\b', line.partition('//')[2]):
                        if os.path.basename(other) not in known:
                            wrong.append('%s:%d: %s' % (name, number, other))
        self.assertEqual(wrong, [])

    def begins_with_eigen(self, name):
        """Returns whether all includes of a header come first and lead to Eigen: then Eigen may be included
        earlier without an effect."""
        root, _ = self.headers()
        found, todo = set(), [name]
        while todo:
            with open(os.path.join(root, todo.pop())) as f:
                text = re.sub('//.*', '', f.read())
            if not re.fullmatch(r'(#.*|\s)*', text[:max(text.rfind('#include'), 0)]):
                return False
            new = set(re.findall(r'^#include ["<](.*)[">]', text, re.M)) - found
            found |= new
            todo += [other for other in new if other.startswith('majorant/')]
        return 'Eigen/Core' in found

    def test_every_header_compiles_alone(self):
        root, headers = self.headers()
        compiler = [os.environ.get('CXX', 'c++'), '-std=c++20', '-Wall', '-Wextra', '-I' + root,
                    '-isystem', '/usr/include/eigen3', '-DEIGEN_MAX_ALIGN_BYTES=16',
                    '-DEIGEN_MALLOC_ALREADY_ALIGNED=1']
        eigen = os.path.join(self.folder, 'eigen.h')
        with open(eigen, 'w') as f:
            f.write('#include <Eigen/Core>\n')  # precompiled
        self.do(*compiler, '-x', 'c++-header', eigen)
        def compile_alone(name):
            first = ['-include', eigen] if self.begins_with_eigen(name) else []
            return name, subprocess.run([*compiler, '-fsyntax-only', *first, '-x', 'c++', '-'], text=True,
                                        input='#include "%s"\n' % name, stdout=subprocess.PIPE,
                                        stderr=subprocess.STDOUT)
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            for name, done in pool.map(compile_alone, headers):
                with self.subTest(name):
                    self.assertEqual(done.returncode, 0, done.stdout[:2000])

    def test_headers_include_installed_headers(self):
        root, headers = self.headers()
        self.assertGreater(len(headers), 20)
        missing = []
        for name in headers:  # our headers that a header includes must be installed
            with open(os.path.join(root, name)) as f:
                for line in f:
                    if line.startswith('#include "'):
                        included = line.split('"')[1]
                        self.assertTrue(included.startswith('majorant/'), name + ': ' + line)
                        if not os.path.exists(os.path.join(root, included)):
                            missing.append('%s: %s' % (name, included))
        self.assertEqual(missing, [])


if __name__ == '__main__':
    if not os.path.exists(BINARY) or not os.path.isdir(BUILD):
        sys.exit('set MAJORANT_BINARY and MAJORANT_BUILD_DIR')
    unittest.main()
