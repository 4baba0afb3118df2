#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests parts of the package: the framework alone, by CMake and by pkg-config; build types; add_subdirectory."""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = os.environ.get('MAJORANT_SOURCE_DIR', '')
BUILD = os.environ.get('MAJORANT_BUILD_DIR', '')
HERE = os.path.dirname(os.path.abspath(__file__))
FRAMEWORK = os.path.join(HERE, 'framework_consumer')
with open(os.path.join(BUILD, 'CMakeCache.txt')) as cache:
    GPL = 'MAJORANT_GPL:BOOL=OFF' not in cache.read()
# Packages that no consumer of the framework may search for or link.
NOT_NEEDED = ('nlohmann_json', 'CGAL', 'OpenMesh', 'Ceres', 'PNG', 'Cairo', 'ZLIB', 'Nest2D',
              'CHOLMOD')
NOT_LINKED = ('json', 'CGAL', 'gmp', 'OpenMesh', 'ceres', 'cholmod', 'blas', 'png', 'libz.', 'nlopt', 'clipp')


def run(*command, **options):
    done = subprocess.run(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, **options)
    assert done.returncode == 0, '%s: %d\n%s' % (command, done.returncode, done.stdout[-3000:])
    return done.stdout


class Components(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix='majorant_components_')
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.prefix = os.path.join(cls.folder, 'prefix')
        run('cmake', '--install', BUILD, '--prefix', cls.prefix)

    def configure(self, source, name, *options):
        build = os.path.join(self.folder, name)
        return build, run('cmake', '-S', source, '-B', build, '-DCMAKE_PREFIX_PATH=' + self.prefix, *options)

    def assert_runs_alone(self, program):
        self.assertAlmostEqual(float(run(program)), 73.5, 9)
        loaded = run('ldd', program)
        for name in NOT_LINKED:
            self.assertNotIn(name, loaded)

    def test_the_framework_needs_nothing_else(self):
        build, _ = self.configure(FRAMEWORK, 'framework', '-DCMAKE_BUILD_TYPE=Release',
                                  *('-DCMAKE_DISABLE_FIND_PACKAGE_%s=ON' % name for name in NOT_NEEDED))
        link = run('cmake', '--build', build, '--verbose')
        self.assert_runs_alone(os.path.join(build, 'framework_consumer'))
        line = next(l for l in link.splitlines() if '-o framework_consumer' in l)
        for name in NOT_LINKED:
            self.assertNotIn(name, line.lower().replace('libmajorant', ''))

    def test_a_component_that_does_not_exist(self):
        source = os.path.join(self.folder, 'wrong')
        os.mkdir(source)
        with open(os.path.join(source, 'CMakeLists.txt'), 'w') as f:
            f.write('cmake_minimum_required(VERSION 3.22)\nproject(wrong LANGUAGES CXX)\n'
                    'find_package(majorant REQUIRED COMPONENTS frame)\n')
        with self.assertRaisesRegex(AssertionError, 'no component frame'):
            self.configure(source, 'wrong_build')

    @unittest.skipUnless(GPL, 'a build without GPL parts has no CHOLMOD')
    def test_cholmod(self):
        source = os.path.join(self.folder, 'with_cholmod')
        os.mkdir(source)
        with open(os.path.join(source, 'CMakeLists.txt'), 'w') as f:
            f.write('cmake_minimum_required(VERSION 3.22)\nproject(with_cholmod LANGUAGES C CXX)\n'
                    'find_package(majorant REQUIRED COMPONENTS framework cholmod)\n'
                    'add_executable(with_cholmod main.cpp)\n'
                    'target_link_libraries(with_cholmod PRIVATE majorant::cholmod)\n')
        with open(os.path.join(source, 'main.cpp'), 'w') as f:
            f.write('#include <iostream>\n#include "majorant/framework/cholmod_solver.h"\n'
                    'int main() {\n  majorant::SparsePattern p;\n  p.append_column({1});\n  p.append_column({});\n'
                    '  p.order_in_blocks(1);\n  const auto s = majorant::make_cholmod_solver();\n  s->analyze(p);\n'
                    '  if (s->factorize(Eigen::Vector3d(2, 1, 2), 0) != majorant::FactorStatus::Ok) return 1;\n'
                    '  majorant::Vec x;\n  s->solve(Eigen::Vector2d(3, 3), x);\n  std::cout << x[0] + x[1];\n}\n')
        build, _ = self.configure(source, 'with_cholmod_build', '-DCMAKE_DISABLE_FIND_PACKAGE_PNG=ON',
                                  '-DCMAKE_DISABLE_FIND_PACKAGE_nlohmann_json=ON')
        run('cmake', '--build', build)
        program = os.path.join(build, 'with_cholmod')
        self.assertAlmostEqual(float(run(program)), 2, 12)
        self.assertNotIn('ceres', run('ldd', program))

    def pkg_config(self, *arguments):
        libdir = next(d for d, _, files in os.walk(self.prefix) if 'majorant.pc' in files)
        environment = dict(os.environ, PKG_CONFIG_PATH=libdir)
        return run('pkg-config', *arguments, env=environment).split()

    @unittest.skipUnless(shutil.which('pkg-config'), 'no pkg-config')
    def test_pkg_config_of_the_framework(self):
        program = os.path.join(self.folder, 'by_pkg_config')
        flags = self.pkg_config('--cflags', '--libs', 'majorant-framework')
        run(os.environ.get('CXX', 'c++'), '-std=c++20', '-O1', os.path.join(FRAMEWORK, 'main.cpp'),
            '-o', program, *flags, '-Wl,-rpath,' + os.path.join(self.prefix, 'lib'))
        self.assert_runs_alone(program)

    @unittest.skipUnless(shutil.which('pkg-config'), 'no pkg-config')
    def test_pkg_config_of_everything(self):
        program = os.path.join(self.folder, 'all_by_pkg_config')
        flags = self.pkg_config('--cflags', '--libs', 'majorant')
        run(os.environ.get('CXX', 'c++'), '-std=c++20', '-O0', os.path.join(HERE, 'consumer', 'main.cpp'),
            '-o', program, *flags)
        mesh, report = os.path.join(SOURCE, 'examples/meshes/cap.obj'), os.path.join(self.folder, 'cap.json')
        run(os.path.join(self.prefix, 'bin', 'majorant'), 'parametrize', mesh, os.path.join(self.folder, 'cap.vtu'),
            '--init', 'tutte', '--degree', '3', '--report', report)
        with open(report) as f:
            expected = json.load(f)['result']['value']
        self.assertAlmostEqual(float(run(program, mesh)) / expected, 1, delta=1e-9)  # see package_test.py

    @unittest.skipUnless(shutil.which('pkg-config'), 'no pkg-config')
    def test_pkg_config_knows_the_version_and_every_archive(self):
        version = self.pkg_config('--modversion', 'majorant')
        self.assertEqual(version, run(os.path.join(self.prefix, 'bin', 'majorant'), '--version').split()[1:2])
        self.pkg_config('--print-errors', '--exists', 'majorant', 'majorant-framework')
        libs = self.pkg_config('--libs', 'majorant')
        archives = {name[3:-2] for _, _, files in os.walk(self.prefix) for name in files if name.endswith('.a')}
        self.assertEqual(archives - {flag[2:] for flag in libs}, set())

    def test_a_consumer_without_a_build_type_gets_a_message(self):
        _, printed = self.configure(FRAMEWORK, 'no_type')
        self.assertIn('26 times', printed)
        for name, option in (('type', '-DCMAKE_BUILD_TYPE=Release'), ('flags', '-DCMAKE_CXX_FLAGS=-O2')):
            _, printed = self.configure(FRAMEWORK, name, option)
            self.assertNotIn('26 times', printed)

    def test_a_parent_project_gets_release(self):
        parent = os.path.join(HERE, 'parent')
        for name, options, expected in (('parent', [], 'Release'),
                                        ('debug', ['-DCMAKE_BUILD_TYPE=Debug'], 'Debug')):
            with self.subTest(name):
                build, printed = self.configure(parent, name, '-DMAJORANT_SOURCE_DIR=' + SOURCE,
                                             '-DCMAKE_EXPORT_COMPILE_COMMANDS=ON', *options)
                self.assertEqual('so it is Release' in printed, not options)
                with open(os.path.join(build, 'build_type')) as f:
                    self.assertEqual(f.read(), expected)
                with open(os.path.join(build, 'compile_commands.json')) as f:
                    commands = {os.path.relpath(entry['file'], HERE): entry['command'] for entry in json.load(f)}
                self.assertEqual('-O3' in commands['framework_consumer/main.cpp'], expected == 'Release')


if __name__ == '__main__':
    if not os.path.isdir(BUILD):
        sys.exit('set MAJORANT_BUILD_DIR')
    unittest.main()
