# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""PETSc gets only --petsc-options, since its options can load libraries and write files."""
import os
import unittest

from mpi_helpers import *

EVIL = '''#include <stdio.h>
__attribute__((constructor)) static void run(void) { fclose(fopen("%s", "w")); }
'''


class PetscOptions(CommandTest):
    def setUp(self):
        super().setUp()
        self.mesh = self.write('grid.obj', obj_text(*grid(5, lambda x, y: x * y)))
        self.proof = self.path('PWNED')
        source = self.write('evil.c', EVIL % self.proof)
        subprocess.run(['cc', '-shared', '-fPIC', '-o', self.path('evil.so'), source], check=True)
        os.mkdir(self.path('home'))

    def run_here(self, *words, environment=()):
        """Runs in the folder of the mesh, with a separate home folder."""
        return Outcome(subprocess.run([str(word) for word in words], cwd=self.folder, text=True,
                                      env=dict(ENVIRONMENT, HOME=self.path('home'), **dict(environment)),
                                      stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE))

    def runs(self):
        """Yields all ways to use PETSc."""
        for solver in ('mumps', 'cg-hypre'):
            yield [BINARY, 'parametrize', self.mesh, 'a.vtu', '--linear-solver', solver], {}
        yield [BINARY, 'parametrize', self.mesh, 'a.vtu'], {'MAJORANT_MEMORY_BYTES': '1000',
                                                           'MAJORANT_MULTIGRID_BYTES': '0'}
        yield [MPI_BINARY, 'parametrize', self.mesh, '-o', 'a.pvtu', '--degree', '1'], {}
        yield ['mpirun', '-n', '2', MPI_BINARY, 'parametrize', self.mesh, '-o', 'a.pvtu', '--degree', '1'], {}

    def test_no_file_is_obeyed(self):
        text = '-dll_append %s\n-log_view :%s\n' % (self.path('evil.so'), self.proof)
        for name in ('.petscrc', 'petscrc', 'home/.petscrc'):
            self.write(name, text)
        for words, environment in self.runs():
            with self.subTest(words=words):
                done = self.run_here(*words, environment=environment)
                self.assertEqual(done.code, OK, done.err)
                self.assertFalse(os.path.exists(self.proof))

    def test_no_variable_is_obeyed(self):
        evil = self.path('evil.so')
        for name, text in (('PETSC_OPTIONS', '-dll_append ' + evil),
                           ('PETSC_OPTIONS_YAML', 'dll_append: ' + evil),
                           ('PETSC_OPTIONS', '-options_file ' + self.write('words', '-dll_append ' + evil))):
            for words, environment in self.runs():
                with self.subTest(variable=name, words=words):
                    done = self.run_here(*words, environment={**environment, name: text})
                    self.assertEqual(done.code, OK, done.err)
                    self.assertFalse(os.path.exists(self.proof))

    def test_the_option_is_obeyed(self):
        """All options of the user are passed on, even those that load a library."""
        for words, environment in self.runs():
            with self.subTest(words=words):
                options = '-dll_append ' + self.path('evil.so')
                done = self.run_here(*words, '--petsc-options', options, environment=environment)
                self.assertEqual(done.code, OK, done.err)
                self.assertTrue(os.path.exists(self.proof))
                os.unlink(self.proof)

    def test_options_reach_the_solvers(self):
        for words in ([BINARY, 'parametrize', self.mesh, 'a.vtu'],
                      [MPI_BINARY, 'parametrize', self.mesh, '-o', 'a.pvtu', '--degree', '1']):
            done = self.run_here(*words, '--linear-solver', 'cg-hypre',
                                 '--petsc-options=-majorant_hypre_ksp_monitor -majorant_hypre_ksp_rtol 1e-3')
            self.assertEqual(done.code, OK, done.err)
            self.assertIn('KSP Residual norm', done.out)
            self.assertNotIn('warning', done.err)

    def commands(self):
        yield [BINARY, 'parametrize', self.mesh, 'a.vtu', '--linear-solver', 'mumps']
        yield [MPI_BINARY, 'parametrize', self.mesh, '-o', 'a.pvtu', '--degree', '1']

    def test_wrong_words(self):
        for words in self.commands():
            for text, says in (('ksp_monitor', "'ksp_monitor'"), ('-ksp_rtol 1 2', "'2'"), ('-5', "'-5'"),
                               ('-help', 'ends? the program'), ('-info --version', 'ends? the program'),
                               ('-options_file none', 'none'), ('-dll_append ./none.so', 'none.so')):
                with self.subTest(words=words, text=text):
                    done = self.run_here(*words, '--petsc-options', text)
                    self.assertEqual(done.code, USAGE, done.err)
                    self.assertEqual(done.err.count('\n'), 1, done.err)
                    self.assertRegex(done.err, says)
                    self.assertIn('--petsc-options', done.err)
                    self.assertEqual(done.out, '')
                    self.assertFalse([name for name in self.files() if name.startswith('a')], self.files())

    def test_options_that_petsc_does_not_use(self):
        for words in self.commands():
            done = self.run_here(*words, '--petsc-options', '-majorant_hypre_ksp_rtoll 1e-3')
            self.assertEqual(done.code, OK, done.err)
            self.assertIn('PETSc did not use -majorant_hypre_ksp_rtoll', done.err)
        done = self.run_here(BINARY, 'parametrize', self.mesh, 'a.vtu', '--petsc-options', '-info')
        self.assertEqual(done.code, OK, done.err)
        self.assertIn('--petsc-options has no effect', done.err)


if __name__ == '__main__':
    need_mpi()
    unittest.main()
