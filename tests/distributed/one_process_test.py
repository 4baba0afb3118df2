# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""--linear-solver of the command: PETSc's solvers in one process, loaded when they are asked for."""
import os
import shutil
import unittest

from mpi_helpers import *

PLUGIN = os.path.join(os.path.dirname(BINARY), 'libmajorant_petsc.so')
SOLVERS = ['mumps', 'cg-hypre']


class OneProcess(CommandTest):
    def report(self, verb, *args, code=0, name='report'):
        done = self.run_ok(verb, *args, '-o', self.path(name + '.vtu'), '--report', self.path(name + '.json'),
                           '--quiet', code=code)
        self.assertEqual(done.err, '', 'MPI has nothing to say')
        with open(self.path(name + '.json')) as f:
            return json.load(f)

    def same(self, verb, *args, tolerance=1e-8):
        """By both solvers the minimum of the direct one; what they did is in the report."""
        whole = self.report(verb, *args)
        self.assertIsNone(whole['linear_solver'])
        for solver in SOLVERS:
            with self.subTest(solver=solver, args=args):
                report = self.report(verb, *args, '--linear-solver', solver)
                self.assertEqual(report['status'], whole['status'])
                self.assertLess(abs(report['result']['value'] / whole['result']['value'] - 1), tolerance)
                used = report['linear_solver'][solver]
                self.assertGreater(used['solves'], 0)
                self.assertGreater(used['set_ups'], 0)
                if solver == 'cg-hypre':
                    self.assertGreater(used['iterations'], 0)
                    counted = sum(row['solver_iterations'] for row in report['iterations'])
                    rungs = [r for r in report['linear_solver'].values() if isinstance(r, dict)]
                    self.assertLessEqual(counted, sum(r['iterations'] for r in rungs))
        return whole

    def test_meshes_and_degrees(self):
        for mesh in ('nefertiti_500', 'helix_500', 'plane_500'):
            for degree in (1, 2, 3):
                self.same('parametrize', disk(mesh), '--degree', degree, '--tolerance', '1e-10')

    def test_options(self):
        mesh = disk('nefertiti_500')
        self.same('parametrize', mesh, '--degree', 1, '--boundary', 'fixed')
        self.same('parametrize', mesh, '--degree', 2, '--init', 'tutte')
        self.same('parametrize', mesh, '--degree', 1, '--energy', 'arap + 0.1*symmetric-dirichlet')
        self.same('parametrize', disk('helix_500'), '--degree', 1, '--bijective', tolerance=1e-4)

    def test_other_verbs(self):
        self.same('seamless', generated('buckle'), '--degree', 2)
        self.same('parametrize', generated('buckle'), '--degree', 1, '--seams', 'auto')
        flat = self.write('flat.obj', obj_text(*grid(6, lambda x, y: 0)))
        pull = self.write('pull.json', '{"handles": [{"vertex": 0, "target": [-0.2, 0.3]},'
                                       '{"vertex": 48, "target": [1.1, 1]}]}')
        self.same('deform', flat, '--degree', 2, '--handles', pull)

    def test_the_old_name_of_direct(self):
        mesh, out = disk('nefertiti_500'), []
        for name in ('auto', 'direct', 'cholmod'):
            self.report('parametrize', mesh, '--degree', 1, '--linear-solver', name, name=name)
            out.append(Vtu(self.path(name + '.vtu')).rows('uv'))
        self.assertEqual(out[0], out[1])
        self.assertEqual(out[0], out[2])

    def test_unwrap_refuses(self):
        self.refused(USAGE, 'unwrap', generated('buckle'), self.path('a.obj'), '--linear-solver', 'mumps',
                     says=['--linear-solver mumps', 'unwrap', 'leave it out'])

    def test_what_it_links(self):
        """Neither MPI nor PETSc: who does not ask for them does not wait for them."""
        libraries = subprocess.run(['ldd', BINARY], stdout=subprocess.PIPE, text=True, check=True).stdout
        for name in ('libmpi', 'libpetsc', 'libHYPRE', 'libdmumps'):
            self.assertNotIn(name, libraries)
        needed = subprocess.run(['ldd', PLUGIN], stdout=subprocess.PIPE, text=True, check=True).stdout
        self.assertIn('libpetsc', needed)
        shown = subprocess.run(['nm', '-D', '--defined-only', PLUGIN], stdout=subprocess.PIPE, text=True,
                               check=True).stdout
        self.assertEqual([line.split()[-1] for line in shown.splitlines()], ['majorant_solver_plugin'])


class Elsewhere(CommandTest):
    """The program somewhere else, with and without the plugin."""

    def setUp(self):
        super().setUp()
        os.makedirs(self.path('bin'))
        shutil.copy(BINARY, self.path('bin/majorant'))
        self.mesh = self.write('grid.obj', obj_text(*grid(5)))

    def run_there(self, *args):
        return Outcome(subprocess.run([self.path('bin/majorant'), 'parametrize', self.mesh, self.path('a.vtu'),
                                       *args], text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE))

    def test_missing(self):
        for solver in SOLVERS:
            done = self.run_there('--linear-solver', solver)
            self.assertEqual(done.code, UNREADABLE, done.err)
            self.assertEqual(done.err.count('\n'), 1)
            for part in ('--linear-solver ' + solver, 'libmajorant_petsc.so', 'petsc-dev', 'leave the option out'):
                self.assertIn(part, done.err)
            self.assertFalse(os.path.exists(self.path('a.vtu')))
        self.assertEqual(self.run_there().code, OK)

    def test_broken(self):
        self.write('bin/libmajorant_petsc.so', 'nothing')
        done = self.run_there('--linear-solver', 'mumps')
        self.assertEqual(done.code, UNREADABLE, done.err)
        self.assertIn('cannot be loaded', done.err)

    def test_installed(self):
        """cmake --install of both components, anywhere."""
        build, tree = os.environ['MAJORANT_BUILD_DIR'], self.path('tree')
        for component in ('command', 'mpi'):
            subprocess.run(['cmake', '--install', build, '--prefix', tree, '--component', component], check=True,
                           stdout=subprocess.DEVNULL)
        done = Outcome(subprocess.run([os.path.join(tree, 'bin', 'majorant'), 'parametrize', self.mesh,
                                       self.path('a.vtu'), '--linear-solver', 'cg-hypre', '--quiet'],
                                      text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE))
        self.assertEqual(done.code, OK, done.err)
        self.assertEqual(done.err, '')


if __name__ == '__main__':
    need_mpi()
    unittest.main()
