# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""System calls show which files are opened in the current directory and in the home folder: those of the command
line, and temporary files beside outputs (docs/trust.md)."""
import os
import re
import shutil
import subprocess
import sys
import unittest

from command_helpers import *

MPI_BINARY = os.environ.get('MAJORANT_MPI_BINARY', '')
PLUGIN = os.path.join(os.path.dirname(BINARY), 'libmajorant_petsc.so')
PYTHON = os.path.join(os.environ.get('MAJORANT_BUILD_DIR', ''), 'python')
CALL = re.compile(r'^(?:\d+ +)?(\w+)\((.*)')
TEMPORARY = re.compile(r'\.majorant-\d+-\d+\.tmp(\.\w+)?')


@unittest.skipUnless(shutil.which('strace'), 'no strace')
class LookedUp(CommandTest):
    def setUp(self):
        super().setUp()
        for name in ('data', 'home'):
            os.mkdir(self.path(name))
        shutil.copy(generated('cap'), self.path('data/in.obj'))

    def looked_up(self, *words, code=OK, environment=()):
        """Returns the names that a run looks up in the current directory and in the home folder."""
        trace = self.path('trace')
        done = subprocess.run(['strace', '-f', '-s', '4096', '-e', 'trace=%file', '-o', trace, *map(str, words)],
                              cwd=self.path('data'), stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True,
                              env=dict(os.environ, HOME=self.path('home'), OMPI_ALLOW_RUN_AS_ROOT='1',
                                       OMPI_ALLOW_RUN_AS_ROOT_CONFIRM='1', **dict(environment)))
        if 'ptrace' in done.stderr and 'not permitted' in done.stderr:
            self.skipTest('no ptrace here')
        self.assertEqual(done.returncode, code, done.stderr)
        here, home = set(), set()
        with open(trace, errors='replace') as f:
            for line in f:
                # The name of a folder whose descriptor is used (openat(11, ...)) is in the call that opened it.
                call = CALL.match(line)
                if not call or (call[2].startswith(tuple('0123456789'))):
                    continue
                names = 2 if call[1].startswith(('rename', 'link', 'symlink')) else 1  # other texts are results of the call
                for name in re.findall(r'"((?:[^"\\]|\\.)*)"', call[2])[:names]:
                    if name.startswith(self.path('home')):
                        home.add(os.path.relpath(name, self.path('home')))
                    elif not name.startswith('/') and name or name.startswith(self.path('data')):
                        here.add(os.path.relpath(os.path.join(self.path('data'), name), self.path('data')))
        return {TEMPORARY.sub('TEMPORARY', name) for name in here}, home

    def test_the_command(self):
        verbs = (('unwrap', 'in.obj', '-o', 'out.obj', '-o', 'page.html', '-o', 'a.png', '--report', 'run.json'),
                 ('check', 'out.obj', '--surface', 'in.obj', '--cuts', 'free'),
                 ('convert', 'out.obj', '-o', 'out.vtu'), ('info', 'in.obj', '--plan'),
                 ('compare', 'in.obj', '-o', 'a.csv', '--methods', 'newton', '--max-iterations', '2'),
                 ('parametrize', 'in.obj', '-o', 'out.vtu', '--degree', '2'))
        for words in verbs:
            with self.subTest(words=words):
                here, home = self.looked_up(BINARY, *words)
                self.assertLessEqual(here, set(words) | {'.', 'TEMPORARY', words[0]}, here)
                self.assertEqual(home, set())

    @unittest.skipUnless(os.path.exists(PLUGIN), 'no libmajorant_petsc.so')
    def test_with_petsc(self):
        """OpenMPI has settings and components per user; it does not search for them in the folder of the data."""
        for solver in ('mumps', 'cg-hypre'):
            words = ('parametrize', 'in.obj', '-o', 'out.vtu', '--degree', '1', '--linear-solver', solver)
            here, home = self.looked_up(BINARY, *words)
            self.assertLessEqual(here, set(words) | {'.', 'TEMPORARY'}, here)
            self.assertEqual([name for name in home if not name.startswith(('.openmpi', '.pmix'))], [])

    @unittest.skipUnless(MPI_BINARY and os.path.exists(MPI_BINARY), 'no majorant-mpi')
    def test_several_processes(self):
        words = ('parametrize', 'in.obj', '-o', 'out.pvtu', '--degree', '1')
        here, home = self.looked_up(MPI_BINARY, *words)
        self.assertLessEqual(here, set(words) | {'.', 'TEMPORARY', 'out_0.vtu'}, here)
        self.assertEqual([name for name in home if not name.startswith(('.openmpi', '.pmix'))], [])

    @unittest.skipUnless(os.path.exists(os.path.join(PYTHON, 'majorant')), 'no Python package')
    def test_the_python_package(self):
        """With -I, Python itself does not search the current directory for modules."""
        script = ('import sys; sys.path.insert(0, %r); import majorant; V, F = majorant.read_mesh("in.obj"); '
                  'majorant.parametrize(V, F).save("out.vtu"); majorant.read("out.vtu")' % PYTHON)
        here, home = self.looked_up('/usr/bin/python3', '-I', '-c', script)
        self.assertLessEqual(here, {'in.obj', 'out.vtu', '.', 'TEMPORARY'}, here)
        self.assertEqual([name for name in home if not name.startswith('.local')], [])

    def test_no_plugin_of_the_current_directory(self):
        shutil.copy(BINARY, self.path('majorant'))
        for place in ('libmajorant_petsc.so', 'majorant/libmajorant_petsc.so', 'lib/majorant/libmajorant_petsc.so'):
            os.makedirs(os.path.dirname(self.path('data/' + place)), exist_ok=True)
            with open(self.path('data/' + place), 'w') as f:
                f.write('evil')
        done = Outcome(subprocess.run([self.path('majorant'), 'parametrize', 'in.obj', 'a.vtu', '--linear-solver',
                                       'mumps'], cwd=self.path('data'), text=True, stdout=subprocess.PIPE,
                                      stderr=subprocess.PIPE,
                                      env=dict(os.environ, LD_LIBRARY_PATH='', MAJORANT_PLUGINS='.')))
        self.assertEqual(done.code, UNREADABLE, done.err)
        self.assertIn('there is no libmajorant_petsc.so in ' + self.folder, done.err)


if __name__ == '__main__':
    main()
