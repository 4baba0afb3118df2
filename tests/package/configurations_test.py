#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests the content of configurations that take too long to build here. cmake/scripts/try_configurations.py
builds them; its own checks are tested here on small examples."""
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = os.environ['MAJORANT_SOURCE_DIR']
BUILD = os.environ['MAJORANT_BUILD_DIR']
sys.path.insert(0, os.path.join(SOURCE, 'cmake/scripts'))
import try_configurations  # noqa: E402

WITH_CGAL = {'mesh/internal/large_polygon.cpp', 'parametrization/scaffold/internal/scaffold_triangulation.cpp'}
GPL = r'/(CGAL|libnest2d|polyclipping|ceres|glog|gflags|suitesparse/(?!c?amd|SuiteSparse_config)\w+|nlopt)[/.]'


def run(*command):
    done = subprocess.run(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    assert done.returncode == 0, '%s: %d\n%s' % (command, done.returncode, done.stdout)
    return done.stdout


@unittest.skipUnless(shutil.which('ninja'), 'no ninja')
class Configurations(unittest.TestCase):
    def configure(self, *options):
        folder = tempfile.mkdtemp(prefix='majorant_configuration_')
        self.addCleanup(shutil.rmtree, folder)
        run('cmake', '-S', SOURCE, '-B', folder, '-G', 'Ninja', '-DCMAKE_EXPORT_COMPILE_COMMANDS=ON',
            '-DMAJORANT_BUILD_TESTS=OFF', '-DMAJORANT_BUILD_BENCH=OFF', *options)
        return folder

    def sources(self, folder):
        with open(os.path.join(folder, 'compile_commands.json')) as f:
            return {os.path.relpath(entry['file'], SOURCE) for entry in json.load(f)
                    if entry['file'].startswith(SOURCE + '/') and '/generated/' not in entry['file']}

    def test_without_gpl_parts_their_packages_are_not_searched(self):
        others = ('CGALHeaders', 'Nest2D', 'Ceres', 'CHOLMOD', 'CGAL')
        folder = self.configure('-DMAJORANT_GPL=OFF', *('-DCMAKE_DISABLE_FIND_PACKAGE_%s=ON' % o for o in others))
        sources = self.sources(folder)
        self.assertIn('parametrization/packing/internal/no_nesting.cpp', sources)
        self.assertNotIn('parametrization/packing/internal/nesting.cpp', sources)
        self.assertTrue(WITH_CGAL | {'mesh/incremental_delaunay.cpp'} <= sources, sources)
        with open(os.path.join(folder, 'compile_commands.json')) as f:
            self.assertNotRegex(f.read(), 'MAJORANT_HAS_CGAL|CGAL_DISABLE_GMP')
        self.check_that_every_verb_is_compiled_without_cgal(folder)
        link = run('ninja', '-C', folder, '-t', 'commands', 'apps/majorant').splitlines()[-1]
        self.assertIn('libmetis', link)
        for name in ('ceres', 'cholmod', 'blas', 'nlopt', 'clipping', 'gmp', 'glog'):
            self.assertNotIn(name, link)
        self.check_what_their_sources_include(sources - WITH_CGAL)

    def check_that_every_verb_is_compiled_without_cgal(self, folder):
        """Checks syntax and includes of the sources that differ without CGAL, with their commands in that
        build."""
        with open(os.path.join(folder, 'compile_commands.json')) as f:
            entries = {os.path.relpath(entry['file'], SOURCE): entry for entry in json.load(f)}
        flags = lambda name: [word for word in shlex.split(entries[name]['command'])
                              if re.match('-(D|I|isystem|std)', word) or word.startswith('/usr/include')]
        for name in sorted(WITH_CGAL):
            headers = run(os.environ.get('CXX', 'c++'), *flags(name), '-fsyntax-only', '-H', os.path.join(SOURCE, name))
            self.assertIn('incremental_delaunay.h', headers)
            self.assertNotRegex(headers, GPL)

    def check_what_their_sources_include(self, sources):
        """Checks by the compiler's dependency lists of this build that sources of both configurations include no
        headers of GPL libraries."""
        deps = run('ninja', '-C', BUILD, '-t', 'deps') if os.path.exists(BUILD + '/build.ninja') else ''
        wrong, seen = [], set()
        for entry in deps.split('\n\n'):  # an object, then its dependencies: one source or several
            names = [os.path.normpath(os.path.join(BUILD, line.strip())) for line in entry.splitlines()[1:]]
            both = {os.path.relpath(name, SOURCE) for name in names if name.endswith('.cpp')} & sources
            seen |= both
            wrong += ['%s: %s' % (min(both), name) for name in names
                      if both and not name.startswith(SOURCE + '/') and re.search(GPL, name)]
        self.assertEqual(wrong[:5], [])
        if len(seen) < 150:
            self.skipTest('no object of every source in this build, %d only' % len(seen))

    def test_the_names_of_shared_libraries(self):
        folder = self.configure('-DBUILD_SHARED_LIBS=ON')
        self.assertRegex(try_configurations.version(), r'^\d+\.\d+\.\d+$')
        for name in ('majorant', 'majorant_framework', 'majorant_solvers'):
            link = run('ninja', '-C', folder, '-t', 'commands', 'lib/lib%s.so' % name).splitlines()[-2:]
            link = ' '.join(link)
            self.assertIn('-soname,lib%s.so.%s' % (name, try_configurations.soversion()), link)
            self.assertIn('exported_symbols.map', link)
        framework = run('ninja', '-C', folder, '-t', 'inputs', 'lib/libmajorant_framework.so')
        for module in ('mesh', 'io', 'solve', 'ceres'):
            self.assertNotIn('majorant_%s.dir' % module, framework)
        self.assertIn('majorant_terms.dir', framework)
        everything_else = run('ninja', '-C', folder, '-t', 'inputs', 'lib/libmajorant.so')
        self.assertNotIn('majorant_ceres.dir', everything_else)
        self.assertIn('majorant_ceres.dir', run('ninja', '-C', folder, '-t', 'inputs', 'lib/libmajorant_solvers.so'))

    def test_the_symbols_that_are_shown_are_ours(self):
        """Tests the linker script on a small library."""
        folder = tempfile.mkdtemp(prefix='majorant_symbols_')
        self.addCleanup(shutil.rmtree, folder)
        code = os.path.join(folder, 'x.cpp')
        with open(code, 'w') as f:
            f.write('#include <vector>\n#include <stdexcept>\n'
                    'int theirs() { return 1; }\nnamespace other { int f() { return 2; } }\n'
                    'namespace majorant { struct Error : std::runtime_error { using runtime_error::runtime_error;\n'
                    'virtual ~Error(); int k() const; }; Error::~Error() {} int Error::k() const { return 1; }\n'
                    'std::vector<double> g(std::vector<double> v) { v.push_back(theirs()); return v; } }\n')
        library = os.path.join(folder, 'libx.so')
        run(os.environ.get('CXX', 'c++'), '-shared', '-fPIC', '-O1', code, '-o', library,
            '-Wl,--version-script=' + os.path.join(SOURCE, 'cmake/exported_symbols.map'))
        names = {line.split()[0] for line in run('nm', '-D', '--defined-only', '--format=posix', library).splitlines()}
        self.assertTrue({'_ZN8majorant1gESt6vectorIdSaIdEE', '_ZTIN8majorant5ErrorE', '_ZTVN8majorant5ErrorE',
                         '_ZNK8majorant5Error1kEv'} <= names, names)
        self.assertEqual([name for name in names if 'majorant' not in name], [])


if __name__ == '__main__':
    unittest.main()
