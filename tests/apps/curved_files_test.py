# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Files of curved maps for other programs: Lagrange cells in .vtu, .msh, and .ply without curves."""
import math
import os
import resource
import subprocess

from command_helpers import *

# A quadratic cell whose determinant is 2 h at corner 0, and at least 1/4 elsewhere.
CELL = [(0.1, 0.1), (1.1, 0.1), (0.1, 1.1), (0.6, 0.1), (0.6, 0.6), (0.6, 0.1)]
FLAT = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0.5, 0, 0), (0.5, 0.5, 0), (0, 0.5, 0)]


def nearly_inverted(h, min_det=-1.0):
    uv = [list(p) for p in CELL]
    uv[5][1] += h
    def array(name, width, values, kind='Float64'):
        return ('<DataArray type="%s" Name="%s" NumberOfComponents="%d" format="ascii">%s'
                '</DataArray>' % (kind, name, width, ' '.join(repr(x) for x in values)))
    return ('<VTKFile type="UnstructuredGrid" version="1.0"><UnstructuredGrid>'
            '<Piece NumberOfPoints="6" NumberOfCells="1"><PointData>%s</PointData>'
            '<CellData>%s</CellData><Points>%s</Points><Cells>%s%s%s</Cells></Piece></UnstructuredGrid></VTKFile>'
            % (array('uv', 2, sum(uv, [])), array('min_det', 1, [min_det]), array('Points', 3, sum(map(list, FLAT), [])),
               array('connectivity', 1, range(6), 'Int64'), array('offsets', 1, [6], 'Int64'),
               array('types', 1, [76], 'UInt8')))


class CurvedFiles(CommandTest):
    def setUp(self):
        super().setUp()
        self.mesh = self.write('mesh.obj', obj_text(*grid(3)))

    def solve(self, *options, verb='parametrize'):
        self.run_ok(verb, '--quiet', self.mesh, *options)

    def test_round_trips_stay_valid(self):
        path = self.path
        for degree in (1, 2, 5, 8):
            outcome = majorant('parametrize', '--quiet', self.mesh, '-o', path('a.vtu'), '--degree',
                               degree, '--bijective', '--max-iterations', '3')
            self.assertIn(outcome.code, (OK, LIMIT), outcome.err)
            self.run_ok('convert', path('a.vtu'), '-o', path('a.msh'))
            self.run_ok('convert', path('a.msh'), '-o', path('b.vtu'))
            self.run_ok('convert', path('b.vtu'), '-o', path('b.msh'))
            for result in ('a.msh', 'b.vtu', 'b.msh'):
                self.run_ok('check', path(result), '--certify')
            for options in (['--vtu', 'lagrange'], ['--msh', 'surface']):
                other = path('c.vtu') if '--vtu' in options else path('c.msh')
                self.run_ok('convert', path('a.vtu'), '-o', other, *options)
                self.run_ok('convert', other, '-o', path('d.vtu'))
                for result in (other, path('d.vtu')):
                    self.run_ok('check', result, '--surface', self.mesh, '--certify')
                self.judge(path('d.vtu'), self.mesh)

    def test_claims_hold_of_lagrange_cells(self):
        """Energy, arrays, pins and the square of --normalize, of a run and after conversion."""
        for name, options in (('a', ['--normalize']), ('b', ['--boundary', 'fixed'])):
            a, b = self.path(name + '.vtu'), self.path('converted.vtu')
            self.solve('-o', a, '--vtu', 'lagrange', '--degree', '4', *options)
            self.assertEqual(set(Vtu(a).arrays['types']), {69})
            self.run_ok('convert', a, '-o', b)
            self.assertEqual(set(Vtu(b).arrays['types']), {76})
            for result in (a, b):
                self.run_ok('check', result, '--surface', self.mesh)

    def test_bounds_of_lagrange_cells(self):
        """min_det is that of the map before its values were rounded."""
        for k in range(8):
            h = (1 + k / 7) * 1e-10
            near = self.write('near.vtu', nearly_inverted(h))
            self.run_ok('check', near, '--report', self.path('r.json'))
            bound = json.loads(self.read('r.json'))['result']['min_det_bound']
            self.assertAlmostEqual(bound / (2 * h), 1, 4)
            self.write('near.vtu', nearly_inverted(h, bound))
            self.run_ok('check', near)
            self.run_ok('convert', near, '-o', self.path('a.vtu'), '--vtu', 'lagrange')
            self.run_ok('check', self.path('a.vtu'))
        self.write('near.vtu', nearly_inverted(h, 1.01 * bound))
        self.found(near, says='is claimed')

    def test_distortions_that_the_digits_do_not_tell(self):
        """At a tube's end, cells are 1e-12 of the layout: interpolated values lose them by rounding."""
        sides, rings = 4, 28
        points = [(math.cos(a), math.sin(a), ring) for ring in range(rings + 1) for a in
                  [2 * math.pi * (corner + ring % 2 / 2) / sides for corner in range(sides)]] + [(0, 0, rings + 0.3)]
        faces = []
        for ring in range(rings):
            for corner in range(sides):
                a, b = (ring * sides + (corner + k) % sides for k in (0, 1))
                c, d = a + sides, b + sides
                faces += [(a, b, c), (b, d, c)] if ring % 2 == 0 else [(a, d, c), (a, b, d)]
        last = sides * rings
        faces += [(last + k, last + (k + 1) % sides, last + sides) for k in range(sides)]
        tube = self.write('tube.obj', obj_text(points, faces))
        self.run_ok('parametrize', '--quiet', tube, '-o', self.path('a.vtu'), '--energy', 'mips', '--boundary',
                    'fixed', '--degree', '2', '--normalize')
        self.run_ok('check', self.path('a.vtu'))
        self.run_ok('convert', self.path('a.vtu'), '-o', self.path('l.vtu'), '--vtu', 'lagrange')
        self.run_ok('check', self.path('l.vtu'))

    def test_images_of_cut_surfaces(self):
        """Charts, and a closed surface whose sides of cuts are at different places."""
        ball = self.write('ball.obj', obj_text(*torus(6, 5, 0)))
        self.run_ok('unwrap', '--quiet', ball, '-o', self.path('a.msh'), '-o', self.path('a.ply'),
                    '-o', self.path('a.vtu'), '--vtu', 'lagrange', '--degree', '2')
        for result in ('a.msh', 'a.ply', 'a.vtu'):
            self.run_ok('check', self.path(result), '--certify')
        for result in ('a.ply', 'a.vtu'):
            self.run_ok('check', self.path(result), '--surface', ball, '--certify')
        self.run_ok('convert', self.path('a.vtu'), '-o', self.path('b.msh'), '--msh', 'surface')
        self.run_ok('check', self.path('b.msh'), '--surface', ball)

    def test_an_image_is_no_map_of_a_surface(self):
        self.solve('-o', self.path('a.msh'), '-o', self.path('b.vtu'), '--degree', '2')
        self.refused(UNSUPPORTED, 'check', self.path('a.msh'), '--surface', self.mesh,
                     says=['a.msh', 'image', '--msh surface'])
        self.run_ok('check', self.path('a.msh'))
        self.run_ok('convert', self.path('b.vtu'), '-o', self.path('s.msh'), '--msh', 'surface')
        self.run_ok('check', self.path('s.msh'), '--surface', self.mesh)
        other = self.write('other.obj', obj_text(*grid(3, lambda x, y: x * y)))
        outcome = majorant('check', self.path('s.msh'), '--surface', other)
        self.assertEqual(outcome.code, INVALID)  # this file has a surface
        flat = self.write('flat.obj', obj_text(*grid(3, lambda x, y: 0)))
        self.run_ok('parametrize', '--quiet', flat, '-o', self.path('f.vtu'), '--init', 'tutte')
        self.run_ok('convert', self.path('f.vtu'), '-o', self.path('f.msh'))
        self.refused(UNSUPPORTED, 'check', self.path('f.msh'), '--surface', flat, says='image')

    def test_degree_of_formats_without_curves(self):
        for files, degree in ((['a.ply'], 1), (['a.ply', 'a.obj'], 1), (['a.ply', 'a.svg'], 1),
                              (['a.msh'], 3), (['a.ply', 'a.msh'], 3), (['a.ply', 'a.vtu'], 3)):
            outputs = sum((['-o', self.path(f)] for f in files), [])
            self.solve(*outputs, '--report', self.path('r.json'), '--max-iterations', '300')
            report = json.loads(self.read('r.json'))
            self.assertEqual(report['result']['degree'], degree, files)

    def test_ply_has_the_faces_of_the_input(self):
        mesh = self.write('quads.obj', obj_text(*quads(3)))
        self.run_ok('parametrize', '--quiet', mesh, self.path('a.ply'))
        header = self.read('a.ply').split(b'end_header')[0].decode()
        self.assertIn('element vertex 16', header)
        self.assertIn('element face 9', header)
        self.run_ok('check', self.path('a.ply'), '--surface', mesh, '--certify')
        self.run_ok('convert', self.path('a.ply'), '-o', self.path('b.vtu'))
        self.run_ok('check', self.path('b.vtu'))

    def test_at_the_limit_of_injectivity(self):
        """Rounding of values may turn the cell over: only the lossless file is written."""
        for h, code in ((1e-12, OK), (1e-16, INVALID)):
            near = self.write('near.vtu', nearly_inverted(h))
            self.run_ok('check', near)
            self.run_ok('convert', near, '-o', self.path('bezier.vtu'))
            for name, options in (('a.msh', []), ('s.msh', ['--msh', 'surface']),
                                  ('l.vtu', ['--vtu', 'lagrange'])):
                arguments = ('convert', near, '-o', self.path(name), *options)
                if code == OK:
                    self.run_ok(*arguments)
                    os.remove(self.path(name))
                else:
                    self.refused(INVALID, *arguments,
                                 says=[name, 'is not written', 'positive: cell 0'])
                    self.assertNotIn(name, self.files())

    def test_too_large_for_the_disk(self):
        def lower():
            resource.setrlimit(resource.RLIMIT_FSIZE, (4000, 4000))
        self.solve('-o', self.path('map.vtu'), '--degree', '4')
        for name, method in (('a.msh', []), ('a.ply', ['--refine', '4']), ('l.vtu', ['--vtu', 'lagrange'])):
            self.write(name, 'old')
            process = subprocess.run([BINARY, 'convert', self.path('map.vtu'), '-o', self.path(name), '--force', *method],
                                     stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                     stderr=subprocess.PIPE, text=True, preexec_fn=lower,
                                     timeout=300)
            self.assertEqual(process.returncode, USAGE, process.stderr)
            self.assertIn('File too large', process.stderr)
            self.assertEqual(self.read(name), b'old')
        self.assertEqual(len(self.files()), 5)

    def test_options_are_choices(self):
        for option, choices in (('--vtu', '{bezier,lagrange}'), ('--msh', '{image,surface}')):
            self.refused(USAGE, 'convert', self.mesh, '-o', self.path('a.msh'), option, 'curved',
                         says=[option, choices])


if __name__ == '__main__':
    main()
