#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""CHOLMOD, CGAL, Ceres and OpenMesh do the work that docs/architecture.md (Dependencies) states.

Each test breaks one library in a copy of a program: the first bytes of its functions become an instruction
that no processor has. A run that uses the library by the documentation then ends by SIGILL, and other
runs end as before. So a replacement that gives the same results is detected.
"""
import os
import re
import shutil
import signal
import subprocess
import sys
import unittest

from command_helpers import *

BUILD = os.environ['MAJORANT_BUILD_DIR']
APPS = os.path.dirname(BINARY)
CAP = generated('cap')
TRAP = b'\x0f\x0b'  # ud2 of x86-64


def tool_output(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def functions(path, pattern, *flags):
    """Returns addresses of the functions in a file whose names match the pattern."""
    found = set()
    for line in tool_output('nm', '-C', '--defined-only', *flags, path).splitlines():
        match = re.match(r'([0-9a-f]+) [tTwW] (.*)', line)
        if match and re.search(pattern, match[2]):
            found.add(int(match[1], 16))
    return found


def offset_of(path):
    """Returns the offset of an address in the file."""
    segments = [[int(word, 16) for word in match.groups()] for match in re.finditer(
        r'LOAD\s+(0x[0-9a-f]+) (0x[0-9a-f]+) 0x[0-9a-f]+ (0x[0-9a-f]+) ', tool_output('readelf', '-lW', path))]
    return lambda address: next(address - start + offset for offset, start, size in segments
                                if start <= address < start + size)


def break_functions(path, pattern, *flags):
    """Breaks these functions of the file, and returns their number."""
    addresses = functions(path, pattern, *flags)
    offset = offset_of(path)
    with open(path, 'r+b') as file:
        for address in addresses:
            file.seek(offset(address))
            file.write(TRAP)
    return len(addresses)


def library_of(path, name):
    """Returns the shared library of that name that a file loads, or None."""
    match = re.search(r'%s\S* => (\S+)' % re.escape(name), tool_output('ldd', path))
    return match and match[1]


def built(path):
    return unittest.skipUnless(os.path.exists(path), 'no %s' % os.path.basename(path))


@unittest.skipUnless(os.uname().machine == 'x86_64', 'the instruction is one of x86-64')
@unittest.skipIf('libasan' in tool_output('ldd', BINARY), 'sanitizers are linked')
class OtherLibraries(CommandTest):
    def copy_program(self):
        """Returns a copy of the command with the libraries that it loads on demand."""
        folder = self.path('program')
        os.makedirs(folder)
        for name in ['majorant'] + [name for name in os.listdir(APPS) if name.endswith('.so')]:
            shutil.copy(os.path.join(APPS, name), folder)
        return os.path.join(folder, 'majorant')

    def copy_library(self, user, name):
        """Returns a copy of a shared library of `user`, in a folder that loaders search first."""
        source = library_of(user, name)
        self.assertTrue(source, '%s loads no %s' % (user, name))
        folder = self.path('libraries')
        os.makedirs(folder, exist_ok=True)
        return shutil.copy(source, os.path.join(folder, os.path.basename(source)))

    def code_of(self, program, *words):
        environment = dict(os.environ, LD_LIBRARY_PATH=self.path('libraries'))
        return subprocess.run([program, *map(str, words)], env=environment, stdin=subprocess.DEVNULL,
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode

    def assert_broken(self, program, *words):
        self.assertEqual(self.code_of(program, *words), -signal.SIGILL, words)

    def assert_works(self, program, *words):
        self.assertEqual(self.code_of(program, *words), OK, words)

    @built(os.path.join(APPS, 'libmajorant_cholmod.so'))
    def test_cholmod_factorizes(self):
        plugin = os.path.join(APPS, 'libmajorant_cholmod.so')
        library = self.copy_library(plugin, 'libcholmod')
        self.assertGreater(break_functions(library, r'^cholmod_(factorize(_p)?|super_numeric|rowfac(_mask2?)?)$', '-D'), 2)
        program = self.copy_program()
        out = self.path('a.vtu')
        self.assert_broken(program, 'parametrize', CAP, out, '--linear-solver', 'cholmod')
        self.assert_broken(program, 'compare', CAP, '--degree', 1, '--methods', 'newton-cholmod')
        self.assert_broken(program, 'compare', CAP, '--degree', 1, '--linear-solvers', 'cholmod')
        self.assert_works(program, 'parametrize', CAP, out)
        self.assert_works(program, 'compare', CAP, '--degree', 1, '--linear-solvers', 'direct,eigen')

    @built(os.path.join(APPS, 'libmajorant_ceres.so'))
    def test_ceres_minimizes(self):
        program = self.copy_program()
        plugin = os.path.join(os.path.dirname(program), 'libmajorant_ceres.so')
        if library_of(plugin, 'libceres'):
            broken = break_functions(self.copy_library(plugin, 'libceres'), r'^ceres::(GradientProblemSolver|Solver)::Solve\(', '-D')
        else:
            broken = break_functions(plugin, r'^ceres::(GradientProblemSolver|Solver)::Solve\(')
        self.assertGreaterEqual(broken, 2)
        for method in ('ceres-lbfgs', 'ceres-nlcg', 'ceres-lm'):
            self.assert_broken(program, 'compare', CAP, '--degree', 1, '--methods', method)
        self.assert_works(program, 'compare', CAP, '--degree', 1, '--methods', 'newton,lbfgs,gradient-flow')

    def polygon(self, corners):
        """Writes a star with so many corners as one face."""
        path = self.path('star%d.obj' % corners)
        with open(path, 'w') as file:
            for k in range(corners):
                r, t = 1 + 0.5 * (k % 2), 2 * math.pi * k / corners
                file.write('v %.17g %.17g 0\n' % (r * math.cos(t), r * math.sin(t)))
            file.write('f ' + ' '.join(str(k + 1) for k in range(corners)) + '\n')
        return path

    @unittest.skipUnless(has_gpl_parts(), 'a build without GPL parts has no CGAL')
    def test_cgal_triangulates_scaffolds_and_large_polygons(self):
        program = self.copy_program()
        self.assertGreater(break_functions(program, r'^CGAL::.*Constrained_.*triangulation.*::'), 4)
        large, small, out = self.polygon(2100), self.polygon(200), self.path('a.vtu')
        self.assert_works(BINARY, 'parametrize', large, out, '--degree', 1)
        self.assert_broken(program, 'parametrize', large, out, '--degree', 1)
        self.assert_works(program, 'parametrize', small, out, '--degree', 1)
        self.assert_broken(program, 'parametrize', CAP, out, '--bijective', '--write-scaffold', self.path('s.vtu'))
        self.assert_works(program, 'parametrize', CAP, out)

    @built(os.path.join(BUILD, 'examples/example_openmesh'))
    def test_openmesh_holds_the_mesh_of_the_adapter(self):
        for example in ('openmesh', 'planar_quads'):
            with self.subTest(example):
                program = os.path.join(BUILD, 'examples/example_' + example)
                words = CAP, self.path('o.vtu')
                self.assert_works(program, *words)
                library = self.copy_library(program, 'libOpenMeshCore')
                self.assertGreater(break_functions(library, r'^OpenMesh::\w+Connectivity::add_face\(', '-D'), 0)
                self.assert_broken(program, *words)
                shutil.rmtree(self.path('libraries'))

    @unittest.skipUnless(has_gpl_parts(), 'a build without GPL parts has no Ceres and no CHOLMOD')
    @built(os.path.join(BUILD, 'python/majorant'))
    def test_python_calls_ceres_and_cholmod(self):
        package = os.path.join(BUILD, 'python/majorant')
        core = next(name for name in os.listdir(package) if name.startswith('_core') and name.endswith('.so'))
        folder = self.path('python/majorant')
        os.makedirs(folder)
        for name in os.listdir(package):
            if name not in (core, '_ceres.so', '__pycache__'):
                os.symlink(os.path.join(package, name), os.path.join(folder, name))
        home = shutil.copy(os.path.join(package, core), folder)  # parts are loaded from its folder
        if os.path.exists(os.path.join(package, '_ceres.so')):
            home = shutil.copy(os.path.join(package, '_ceres.so'), folder)
        self.assertGreaterEqual(break_functions(home, r'^ceres::(GradientProblemSolver|Solver)::Solve\('), 2)
        library = self.copy_library(home, 'libcholmod')
        self.assertGreater(break_functions(library, r'^cholmod_(factorize(_p)?|super_numeric|rowfac(_mask2?)?)$', '-D'), 2)
        text = '''if True:
            import sys
            sys.path.insert(0, %r)
            import majorant, numpy as np
            problem = majorant.Problem(2).add(majorant.penalty(np.eye(2), np.ones(2)))
            majorant.compare(problem, [0, 0], [sys.argv[1]])
        ''' % os.path.dirname(folder)
        for method in ('ceres-lbfgs', 'newton-cholmod'):
            self.assert_broken(sys.executable, '-c', text, method)
        self.assert_works(sys.executable, '-c', text, 'newton')


if __name__ == '__main__':
    main()
