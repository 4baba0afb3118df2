# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Runs on 1, 2 and 4 ranks reach the result of one process; their pieces are one valid map."""
import unittest

from mpi_helpers import *

MESHES = ['nefertiti_500', 'helix_500', 'plane_500']


class SameAnswer(MpiTest):
    def uv_of_vertices(self, name):
        """Returns uv by input vertex of all pieces, which have the same bits for one vertex."""
        found = {}
        for rank in range(4):
            vtu = Vtu(self.path('%s_%d.vtu' % (name, rank)))
            for (vertex,), uv in zip(vtu.rows('input_vertex'), vtu.rows('uv')):
                if vertex >= 0:
                    found.setdefault(vertex, []).append(uv)
        return found

    def test_energies_and_files(self):
        for mesh in MESHES:
            for degree in (1, 2, 3):
                whole = self.serial(disk(mesh), '--degree', degree)['result']
                for ranks in (1, 2, 4) if degree == 2 else (2, 4):
                    with self.subTest(mesh=mesh, degree=degree, ranks=ranks):
                        report = self.solve(ranks, disk(mesh), '--degree', degree)
                        self.assertEqual(report['status'], 'converged')
                        self.assertTrue(report['result']['locally_injective'])
                        self.assertLess(abs(report['result']['value'] / whole['value'] - 1), 1e-6)
                        self.assertEqual(report['result']['variables'], whole['variables'])
                        self.assertEqual(report['result']['control_points'], whole['control_points'])
                        self.assertEqual(report['result']['globally_injective'], whole['globally_injective'])
                        words = [r['overlaps'].split(' near ')[0] for r in (report['result'], whole)]
                        self.assertEqual(*words)
                        self.assertIn(words[0], ('no overlaps', 'locally injective, overlaps itself'))
                        self.assertEqual(report['linear_solver']['requested'], 'auto')
                        self.assertEqual(sum(r['faces'] for r in report['ranks']), report['input']['faces'])
                shared = [uv for uv in self.uv_of_vertices('all').values() if len(uv) > 1]
                self.assertGreater(len(shared), 10)
                for uv in shared:
                    self.assertEqual(len(set(uv)), 1)
                self.run_ok('check', self.path('all.pvtu'), '--surface', disk(mesh))
                one = self.path('one.vtu')
                self.run_ok('convert', self.path('all.pvtu'), '-o', one)
                self.run_ok('check', one, '--surface', disk(mesh))
                if os.path.exists(VERIFY):
                    done = subprocess.run([sys.executable, VERIFY, one, '--mesh', disk(mesh)],
                                          stdout=subprocess.PIPE, text=True)
                    self.assertEqual(done.returncode, 0, done.stdout)

    def test_conjugate_gradients_give_the_same_bits_every_time(self):
        uv = []
        for out in ('first', 'second'):
            self.solve(3, disk('nefertiti_500'), '--degree', 2, '--linear-solver', 'cg-hypre', out=out)
            uv.append(Vtu(self.path(out + '_1.vtu')).rows('uv'))
        self.assertEqual(uv[0], uv[1])


class Solvers(MpiTest):
    def test_every_rung_ends_at_the_same_minimum(self):
        value = self.serial(disk('nefertiti_500'), '--degree', 2)['result']['value']
        for solver in ('cg-hypre', 'cg-gamg', 'cg-icc', 'mumps'):
            with self.subTest(solver=solver):
                report = self.solve(2, disk('nefertiti_500'), '--degree', 2, '--linear-solver', solver)
                self.assertLess(abs(report['result']['value'] / value - 1), 1e-6)
                self.assertGreater(report['linear_solver'][solver]['solves'], 0)
                if solver == 'cg-hypre':
                    first = report['iterations'][0]
                    self.assertLessEqual(first['solver_iterations'], 10)
                    self.assertLessEqual(first['residual'], 0.1)

    def test_nearly_collapsed_triangles_of_a_start(self):
        report = self.solve(2, disk('scorpion_2500'), '--degree', 1, '--linear-solver', 'cg-hypre',
                            '--max-iterations', 20, code=4)
        self.assertTrue(report['result']['locally_injective'])
        methods = report['linear_solver']
        self.assertGreater(report['result']['initial_value'], report['result']['value'])
        self.assertGreater(methods['cg-hypre']['solves'], 0)


if __name__ == '__main__':
    need_mpi()
    unittest.main()
