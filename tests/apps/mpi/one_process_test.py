# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""--linear-solver of the command: PETSc's solvers in one process, loaded on demand."""
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
        """Tests that both solvers reach the minimum of the direct one, and that the report has their work."""
        whole = self.report(verb, *args)
        self.assertEqual(whole['linear_solver'], {'requested': 'auto', 'used': 'direct'})
        for solver in SOLVERS:
            with self.subTest(solver=solver, args=args):
                report = self.report(verb, *args, '--linear-solver', solver)
                self.assertEqual(report['status'], whole['status'])
                self.assertLess(abs(report['result']['value'] / whole['result']['value'] - 1), tolerance)
                self.assertEqual(report['linear_solver']['requested'], solver)
                self.assertIn(solver, report['linear_solver']['used'].split(' + '))
                self.assertNotIn('direct', report['linear_solver']['used'])
                used = report['linear_solver'][solver]
                self.assertGreater(used['solves'], 0)
                self.assertGreater(used['set_ups'], 0)
                if solver == 'cg-hypre':
                    self.assertGreater(used['iterations'], 0)
                    counted = sum(row['solver_iterations'] for row in report['iterations'])
                    methods = [r for r in report['linear_solver'].values() if isinstance(r, dict)]
                    self.assertLessEqual(counted, sum(r['iterations'] for r in methods))
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

    def test_unwrap_refuses(self):
        self.refused(USAGE, 'unwrap', generated('buckle'), self.path('a.obj'), '--linear-solver', 'mumps',
                     says=['--linear-solver mumps', 'unwrap', 'leave it out'])

    def test_the_command_does_not_link_mpi_or_petsc(self):
        """The command links neither MPI nor PETSc, so that other runs do not wait for them."""
        libraries = subprocess.run(['ldd', BINARY], stdout=subprocess.PIPE, text=True, check=True).stdout
        for name in ('libmpi', 'libpetsc', 'libHYPRE', 'libdmumps'):
            self.assertNotIn(name, libraries)
        needed = subprocess.run(['ldd', PLUGIN], stdout=subprocess.PIPE, text=True, check=True).stdout
        self.assertIn('libpetsc', needed)
        shown = subprocess.run(['nm', '-D', '--defined-only', PLUGIN], stdout=subprocess.PIPE, text=True,
                               check=True).stdout
        self.assertEqual([line.split()[-1] for line in shown.splitlines()], ['majorant_plugin'])


class Memory(CommandTest):
    def run_with(self, bytes_left, *args, multigrid=0, binary=BINARY):
        """Returns the report and the messages on memory, if cg-hypre takes this much."""
        report = self.path('report.json')
        done = Outcome(subprocess.run(
            [binary, 'parametrize', disk('nefertiti_500'), self.path('a.vtu'), '--report', report, *args],
            env=dict(os.environ, MAJORANT_MEMORY_BYTES=str(bytes_left), MAJORANT_MULTIGRID_BYTES=str(multigrid)),
            text=True,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE))
        self.assertEqual(done.code, OK, done.err)
        with open(report) as f:
            return json.load(f), [line for line in done.err.splitlines() if 'are left' in line]

    def test_a_factor_that_does_not_fit(self):
        whole, printed = self.run_with(1 << 40, '--degree', '2')
        self.assertEqual(printed, [])
        self.assertEqual(whole['linear_solver'], {'requested': 'auto', 'used': 'direct'})
        needed = whole['memory']['factor_bytes']
        self.assertEqual(whole['memory']['available_bytes'], 1 << 40)
        report = self.run_with(needed, '--degree', '2')[0]
        self.assertEqual(report['linear_solver']['used'], 'direct', 'exactly as much')
        # With one byte less, only the last degree uses another solver.
        report, printed = self.run_with(needed - 1, '--degree', '2')
        self.assertEqual(len(printed), 1)
        self.assertIn('at degree 2', printed[0], 'foreseen')
        self.assertIn('solving by cg-hypre', printed[0])
        by = {row['degree']: row['solver_iterations'] for row in report['iterations']}
        self.assertEqual(by[1], 0)
        self.assertEqual(report['linear_solver']['used'], 'direct + cg-hypre')
        self.assertGreater(report['linear_solver']['cg-hypre']['solves'], 0)
        self.assertLess(abs(report['result']['value'] / whole['result']['value'] - 1), 1e-6)
        report, printed = self.run_with(1000, '--degree', '2')
        self.assertEqual(len(printed), 1, 'once a run')
        self.assertGreater(report['iterations'][0]['solver_iterations'], 0)

    def test_the_smaller_solver_is_used_if_neither_fits(self):
        """Neither solver fits; small factors take less memory than PETSc itself."""
        report, printed = self.run_with(1000, '--degree', '2', multigrid=10**8)
        self.assertEqual(len(printed), 1)
        self.assertIn('at degree 2', printed[0])
        self.assertIn('the run goes on with direct, since cg-hypre would take 0.1 GB', printed[0])
        self.assertEqual(report['linear_solver']['used'], 'direct')
        self.assertEqual(report['memory']['multigrid_bytes'], 10**8)

    def test_the_last_degree_is_foreseen(self):
        """The message comes before the first step, although lower degrees fit."""
        whole = self.run_with(1 << 40, '--degree', '3')[0]
        self.assertIsNone(whole['memory']['foreseen_bytes'], 'sure to fit')
        report = self.path('report.json')
        left = whole['memory']['factor_bytes'] - 1
        done = Outcome(subprocess.run(
            [BINARY, 'parametrize', disk('nefertiti_500'), self.path('a.vtu'), '--degree', '3', '--report', report,
             '--verbose', '--init', 'tutte'],
            env=dict(os.environ, MAJORANT_MEMORY_BYTES=str(left), MAJORANT_MULTIGRID_BYTES='0'), text=True,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE))
        self.assertEqual(done.code, OK, done.err)
        lines = done.err.splitlines()
        printed = [k for k, line in enumerate(lines) if 'are left' in line]
        steps = [k for k, line in enumerate(lines) if 'degree 1' in line]
        self.assertEqual(len(printed), 1, done.err)
        self.assertLess(printed[0], steps[0], done.err)
        self.assertIn('at degree 3', lines[printed[0]])
        with open(report) as f:
            run = json.load(f)
        self.assertLess(abs(run['memory']['foreseen_bytes'] / whole['memory']['factor_bytes'] - 1), 0.2)
        by = {row['degree']: row['solver_iterations'] for row in run['iterations']}
        self.assertEqual(by[1], 0)
        self.assertGreater(by[3], 0)

    def test_the_note_is_also_printed_for_charts(self):
        report = self.path('report.json')
        done = Outcome(subprocess.run(
            [BINARY, 'unwrap', generated('buckle'), self.path('a.obj'), '--report', report],
            env=dict(os.environ, MAJORANT_MEMORY_BYTES='1000'), text=True, stdout=subprocess.PIPE,
            stderr=subprocess.PIPE))
        self.assertEqual(done.code, OK, done.err)
        printed = [line for line in done.err.splitlines() if 'are left' in line]
        self.assertEqual(len(printed), 1, done.err)
        self.assertIn('charts', printed[0])
        with open(report) as f:
            self.assertEqual(json.load(f)['memory']['available_bytes'], 1000)

    def test_a_requested_solver_is_used_without_a_note(self):
        report, printed = self.run_with(1000, '--degree', '1', '--linear-solver', 'direct')
        self.assertEqual(printed, [])
        self.assertEqual(report['linear_solver']['used'], 'direct')

    def test_without_the_plugin_the_run_goes_on_with_direct(self):
        binary = shutil.copy(BINARY, self.path('majorant'))
        report, printed = self.run_with(1000, '--degree', '1', binary=binary)
        self.assertEqual(report['linear_solver']['used'], 'direct')
        self.assertEqual(len(printed), 1)
        for part in ('the run goes on with direct', 'libmajorant_petsc.so', 'petsc-dev'):
            self.assertIn(part, printed[0])


class Collapsed(CommandTest):
    """Tutte's map of a long finger, some of whose triangles are 1e-10 of the others."""

    def finger(self, around=24, rings=60):
        points, radius = [(0, 0, rings)], around / (2 * math.pi)
        for j in range(rings + 5):
            r, z = (radius, rings - j) if j <= rings else (radius * (1 + 0.5 * (j - rings)), 0)
            points += [(r * math.cos(2 * math.pi * i / around), r * math.sin(2 * math.pi * i / around), z)
                       for i in range(around)]
        faces = [(0, 1 + i, 1 + (i + 1) % around) for i in range(around)]
        for a in range(1, 1 + around * (rings + 4), around):
            for i in range(around):
                j = (i + 1) % around
                faces += [(a + i, a + around + i, a + around + j), (a + i, a + around + j, a + j)]
        return self.write('finger.obj', obj_text(points, faces))

    def check_descent(self, mesh, petsc='', *, falls):
        out = {}
        for solver in ('mumps', 'cg-hypre'):
            report = self.path('report.json')
            done = Outcome(subprocess.run(
                [MPI_BINARY, 'parametrize', mesh, '-o', self.path('a.pvtu'), '--degree', '1', '--init', 'tutte',
                 '--linear-solver', solver, '--report', report, '--quiet', '--petsc-options', petsc],
                env=ENVIRONMENT, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE))
            self.assertEqual(done.code, OK, done.err)
            with open(report) as f:
                out[solver] = json.load(f)
        self.assertGreater(out['mumps']['result']['initial_value'], 1e5)
        value = out['mumps']['result']['value']
        self.assertLess(out['cg-hypre']['result']['value'] / value - 1, 2e-3)
        self.assertTrue(out['cg-hypre']['result']['locally_injective'])
        methods = out['cg-hypre']['linear_solver']
        self.assertEqual(methods['cg-hypre']['falls'] > 0, falls, methods)
        if falls:
            self.assertGreater(methods['cg-icc']['solves'] + methods['mumps']['solves'], 0)

    def test_multigrid_copes(self):
        self.check_descent(self.finger(), falls=False)

    def test_a_failing_solver_is_replaced(self):
        """Without a preconditioner conjugate gradients do not converge, and the next method solves."""
        self.check_descent(self.finger(), '-majorant_hypre_pc_type none', falls=True)

    @where(os.path.join(DATA, 'disks', 'scorpion_10000.obj'))
    def test_scorpion(self):
        self.check_descent(os.path.join(DATA, 'disks', 'scorpion_10000.obj'), '-majorant_hypre_pc_type none',
                           falls=True)


class Elsewhere(CommandTest):
    """The program in another folder, with and without the plugin."""

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
        """cmake --install of both components, to another folder."""
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
