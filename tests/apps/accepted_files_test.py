# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""`check FILE --surface IN` accepts every file written with exit code 0, and `convert` writes it in every format.
The meshes are the small ones of tests/campaigns/accepted_files.py, and the creature, whose seam has every position
twice."""
import pathlib

from command_helpers import *

sys.path.append(os.path.join(SOURCE, 'tests/campaigns'))
import accepted_files as campaign  # noqa: E402


class Accepted(CommandTest):
    def examine(self, verb, mesh, degree, converts=True, flags=()):
        folder = pathlib.Path(tempfile.mkdtemp(dir=self.folder))
        job = campaign.Job(os.path.basename(mesh), mesh, verb, degree, list(flags))
        case = campaign.Case(BINARY, job, folder, 300).examine(converts)
        self.assertEqual(case.problems, [], job)
        self.assertEqual(case.counts['refused runs'], 0, job)
        self.assertEqual(case.counts['refused by rounding'], 0, job)
        self.assertGreaterEqual(case.counts['checks'], len(campaign.FORMATS))

    def small(self, name, degrees, converts=True):
        verb, mesh = campaign.SMALL[name]
        path = self.write(name + '.obj', obj_text(*mesh))
        for degree in degrees:
            self.examine(verb, path, degree, converts)

    def test_vertices_not_shared(self):
        self.small('two_of_a_soup', (2,))
        self.small('soup', (1, 3), converts=False)

    def test_sheets_that_touch(self):
        self.small('loose_bow_tie', (1, 4))
        self.small('bow_tie', (2,), converts=False)
        self.small('fin', (2,))

    def test_one_side(self):
        self.small('moebius', (1, 3))

    def test_faces_twice_or_turned(self):
        self.small('doubled', (2,))
        self.small('some_turned', (1, 2), converts=False)

    def test_two_vertices_at_one_place(self):
        self.small('slit', (1, 3))
        self.small('slit_atlas', (2,), converts=False)
        self.examine('parametrize', generated('creature'), 3, converts=False)

    def test_closed_surfaces(self):
        self.small('octahedron', (1, 2))
        self.small('torus', (1,))

    def test_deformed(self):
        handles = self.write('handles.json', json.dumps({'handles': [
            {'vertex': 0, 'target': [0, 0]}, {'vertex': 15, 'target': [1.5, 0.5]}]}))
        mesh = self.write('flat.obj', obj_text(*grid(3, lambda x, y: 0)))
        self.examine('deform', mesh, 2, flags=['--handles', handles])

    def test_data_that_a_format_cannot_hold_are_reported(self):
        mesh = self.write('octahedron.obj', obj_text(*campaign.OCTAHEDRON))
        outputs = ('a.vtu', 'a.obj', 'a.msh')
        err = self.run_ok('unwrap', mesh, '--degree', '2', *(w for o in outputs for w in (
            '-o', self.path(o)))).err
        self.assertIn('a.obj: does not hold curves', err)
        self.assertIn('a.msh: does not hold the surface (--msh surface does)\n', err)
        self.assertNotIn('a.vtu: does not', err)
        for name, flags, what in (
                ('b.obj', [], 'curves, but straight pieces of them, charts, claims'),
                ('b.msh', [], 'the surface (--msh surface does), claims'),
                ('c.msh', ['--msh', 'surface'], 'claims')):
            done = self.run_ok('convert', self.path('a.vtu'), '-o', self.path(name), *flags)
            self.assertEqual(done.printed()[:-1], ['%s: does not hold %s' % (self.path(name), what)])
        done = self.run_ok('convert', self.path('a.vtu'), '-o', self.path('b.vtu'))
        self.assertEqual(done.printed()[:-1], [])


if __name__ == '__main__':
    main()
