#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""`majorant mesh check` on meshes by gmsh and VTK, of every kind and degree: exit codes and messages."""
import base64
import collections
import json
import os
import re
import struct
import unittest

import command_helpers as helpers
from command_helpers import INVALID, OK, UNREADABLE, UNSUPPORTED, USAGE, CommandTest, majorant

try:
    import gmsh
except ImportError:
    gmsh = None
try:
    import meshio
except ImportError:
    meshio = None
try:
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
except ImportError:
    vtkXMLUnstructuredGridReader = None

TETRAHEDRA = '''MeshVersionFormatted 2
Dimension 3
Vertices 5
0 0 0 0
1 0 0 0
0 1 0 0
0 0 1 0
1 1 1 0
Tetrahedra 2
1 2 3 4 7
2 3 4 5 8
End
'''


@unittest.skipIf(gmsh is None, 'no python3-gmsh')
class OfGmsh(CommandTest):
    """Balls, cylinders and boxes by gmsh: since they are valid, gmsh's order of nodes is read correctly."""

    def setUp(self):
        super().setUp()
        gmsh.initialize()
        self.addCleanup(gmsh.finalize)
        gmsh.option.setNumber('General.Terminal', 0)

    def model(self, kind):
        gmsh.clear()
        gmsh.option.setNumber('Mesh.MeshSizeMin', 0.5)
        gmsh.option.setNumber('Mesh.MeshSizeMax', 0.5)
        dim = 2 if kind in ('triangles', 'quads') else 3
        if kind == 'tetrahedra':
            gmsh.model.occ.addSphere(0, 0, 0, 1)
        elif kind == 'triangles':
            gmsh.model.occ.addDisk(0, 0, 0, 1, 1)
        else:
            gmsh.model.occ.addRectangle(0, 0, 0, 1, 1)
            if dim == 3:
                gmsh.model.occ.extrude([(2, 1)], 0, 0, 1, [2], [1], recombine=True)
        gmsh.model.occ.synchronize()
        if kind in ('quads', 'hexahedra'):
            gmsh.model.mesh.setTransfiniteSurface(1)
            gmsh.model.mesh.setRecombine(2, 1)
        gmsh.model.addPhysicalGroup(dim, [tag for _, tag in gmsh.model.getEntities(dim)], 77)
        gmsh.model.mesh.generate(dim)

    def test_every_kind_degree_version_and_encoding(self):
        for kind in ('triangles', 'quads', 'tetrahedra', 'wedges', 'hexahedra'):
            self.model(kind)
            for degree in (1, 2, 3, 4):
                gmsh.model.mesh.setOrder(degree)
                for version in (2.2, 4.1):
                    for binary in (0, 1):
                        with self.subTest(kind=kind, degree=degree, version=version, binary=binary):
                            gmsh.option.setNumber('Mesh.MshFileVersion', version)
                            gmsh.option.setNumber('Mesh.Binary', binary)
                            gmsh.write(self.path('a.msh'))
                            self.run_ok('mesh', 'check', self.path('a.msh'), '--report', self.path('r.json'))
                            with open(self.path('r.json')) as f:
                                report = json.load(f)
                            mesh = report['result']['mesh']
                            self.assertEqual((report['status'], mesh['orders']), ('valid', [degree]))
                            self.assertGreater(mesh['elements'][kind], 3)
                            self.assertGreater(mesh['min_scaled_jacobian'], 0.05)
                            if version == 2.2:
                                self.assertEqual(mesh['worst'][0]['region'], 77)

    def test_serendipity(self):
        gmsh.option.setNumber('Mesh.SecondOrderIncomplete', 1)
        for kind in ('quads', 'wedges', 'hexahedra'):
            self.model(kind)
            gmsh.model.mesh.setOrder(2)
            gmsh.write(self.path('a.msh'))
            self.assertIn('serendipity', self.run_ok('mesh', 'check', self.path('a.msh')).out)

    def test_agrees_with_its_own_bounds(self):
        """Compares with AnalyseMeshQuality's least det J, which refers to [-1, 1] on segments, on tangled cells."""
        self.model('tetrahedra')
        gmsh.model.mesh.setOrder(3)
        tags, points, _ = gmsh.model.mesh.getNodes(3)
        for k, tag in enumerate(tags[::3]):
            x = points[9 * k:9 * k + 3] + 0.2 * (k % 3 - 1)
            gmsh.model.mesh.setNode(tag, x, [])
        gmsh.write(self.path('a.msh'))
        done = majorant('mesh', 'check', self.path('a.msh'), '--report', self.path('r.json'), '--list', 10000)
        self.assertEqual(done.code, INVALID)
        with open(self.path('r.json')) as f:
            worst = {e['element']: e for e in json.load(f)['result']['mesh']['worst']}
        self.assertEqual(len(worst), len(gmsh.model.mesh.getElements(3)[1][0]))
        elements = list(worst)
        least = gmsh.model.mesh.getElementQualities(elements, 'minSJ') if hasattr(
            gmsh.model.mesh, 'getElementQualities') else None
        if least is not None:
            for element, value in zip(elements, least):
                self.assertEqual(value > 0, worst[element]['verdict'] == 'valid', element)


class Verdicts(CommandTest):
    def test_a_valid_mesh(self):
        done = self.run_ok('mesh', 'check', self.write('a.mesh', TETRAHEDRA))
        self.assertRegex(done.out, r'\A\S+: valid: det J > 0 all over; 2 tetrahedra of degree 1; min det J in '
                                   r'\[1, 1\], scaled Jacobian at least 0\.\d+, mean 0\.\d+\n\Z')
        self.assertEqual(self.run_ok('mesh', 'check', self.path('a.mesh'), '-q').out, '')

    def test_inverted_and_overlapping_elements(self):
        path = self.write('a.mesh', TETRAHEDRA.replace('2 3 4 5 8', '3 2 4 5 8'))
        done = self.run_ok('mesh', 'check', path, code=INVALID)
        self.assertIn(': invalid: 1 of 2 elements have det J <= 0 somewhere, 1 of them everywhere; ', done.out)
        self.assertRegex(done.out, r'\n  element 2 \(tetrahedra, region 8\): min det J in \[-2, -2\] at ')
        # Two elements on the same side of their triangle, and an element that is listed twice.
        for cell, says in (('3 2 4 6 8', '1 shared side has both elements on one side, which overlap, first 1 and 2'),
                           ('2 3 1 4 8', '1 element is listed twice, first 2, which is 1')):
            c = self.write('c.mesh', TETRAHEDRA.replace('Vertices 5', 'Vertices 6').replace(
                '1 1 1 0\n', '1 1 1 0\n0 0.1 0.1 0\n').replace('2 3 4 5 8', cell))
            done = self.run_ok('mesh', 'check', c, '--report', self.path('r.json'), code=INVALID)
            self.assertIn(': invalid: %s; ' % says, done.out)
            with open(self.path('r.json')) as f:
                mesh = json.load(f)['result']['mesh']
            self.assertEqual((mesh['invalid'], mesh['overlapping'] + mesh['repeated']), (0, [[1, 2]]))
        both = self.write('b.mesh', TETRAHEDRA.replace('2 3 4 5 8', '3 2 4 5 8').replace('1 2 3 4 7', '2 1 3 4 7'))
        self.assertIn('all 2 elements are turned around', self.run_ok('mesh', 'check', both, code=INVALID).out)

    def test_report_on_stdout(self):
        path = self.write('a.mesh', TETRAHEDRA)
        done = self.run_ok('mesh', 'check', path, '--report', '-')
        self.assertEqual(json.loads(done.out)['command'], 'mesh check')
        self.assertIn(': valid: ', done.err)

    def test_the_same_on_any_number_of_threads(self):
        path = self.write('a.mesh', TETRAHEDRA)
        outs = {self.run_ok('mesh', 'check', path, '--threads', n).out for n in (1, 2, 3)}
        self.assertEqual(len(outs), 1)

    def test_refusals(self):
        self.check_refusal(UNREADABLE, 'none.mesh')
        self.check_refusal(UNREADABLE, self.write('a.msh', 'hello'))
        self.check_refusal(UNSUPPORTED, self.write('a.obj', 'v 0 0 0\n'))
        self.check_refusal(UNREADABLE, self.write('n.mesh', TETRAHEDRA.replace('Tetrahedra 2', 'Tetrahedra 1')))
        self.check_refusal(UNSUPPORTED, self.write('p.mesh', TETRAHEDRA.replace('Tetrahedra 2', 'Pyramids 2')))
        self.check_refusal(USAGE, self.write('a.mesh', TETRAHEDRA), '-o', self.path('bad.obj'))
        self.check_refusal(UNREADABLE, self.write('b.mesh', TETRAHEDRA[:100]))

    def check_refusal(self, code, *words):
        done = majorant('mesh', 'check', *words)
        self.assertEqual(done.code, code, done.err)
        self.assertEqual(done.err.count('\n'), 1, done.err)
        self.assertEqual(done.out, '')


class DegreesOfVtk(CommandTest):
    """Degrees that differ between the directions of a cell are found from the number of its points."""

    def check(self, kind, points, degrees, code, says):
        array = '' if degrees is None else (
            '<CellData HigherOrderDegrees="D"><DataArray type="Float64" Name="D" NumberOfComponents="3" format="ascii">'
            '%s</DataArray></CellData>' % degrees)
        path = self.write('a.vtu', (
            '<VTKFile type="UnstructuredGrid" version="2.2" byte_order="LittleEndian"><UnstructuredGrid>'
            '<Piece NumberOfPoints="{0}" NumberOfCells="1">{1}<Points><DataArray type="Float64" NumberOfComponents="3" '
            'format="ascii">{2}</DataArray></Points><Cells><DataArray type="Int64" Name="connectivity" format="ascii">'
            '{3}</DataArray><DataArray type="Int64" Name="offsets" format="ascii">{0}</DataArray><DataArray '
            'type="UInt8" Name="types" format="ascii">{4}</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>'
            ).format(points, array, '0 1 2 ' * points, ' '.join(map(str, range(points))), kind))
        done = majorant('mesh', 'check', path)
        self.assertEqual(done.code, code, done.err)
        self.assertIn(says, done.err)

    def test_different_degrees_are_refused(self):
        quad, tetrahedron, hexahedron, wedge = 70, 71, 72, 73
        one = 'the same in all directions'
        for kind, points, degrees in ((quad, 16, '1 7 0'), (quad, 12, None), (quad, 14, None), (hexahedron, 64, '1 3 7'),
                                      (hexahedron, 24, None), (wedge, 18, '1 1 5'), (wedge, 12, None)):
            with self.subTest(kind=kind, points=points):
                self.check(kind, points, degrees, UNSUPPORTED, one)
        self.check(quad, 16, '1 7 0', UNSUPPORTED, 'cell 0 of degrees 1, 7; ')
        for kind, points in ((quad, 13), (hexahedron, 10), (wedge, 17), (tetrahedron, 12)):
            with self.subTest(kind=kind, points=points):
                self.check(kind, points, None, UNREADABLE, 'points')
        self.check(quad, 16, '3 3', UNREADABLE, 'D')
        self.check(quad, 16, '3 3 0', INVALID, '')  # all points at one place
        self.check(tetrahedron, 10, '2 0 0', INVALID, '')


class BadElements(CommandTest):
    @unittest.skipIf(meshio is None, 'no meshio')
    def test_as_a_vtu_for_meshio(self):
        """meshio reads only version 1.0, and quadratic cells by name."""
        text = ('MeshVersionFormatted 2\nDimension 3\nVertices 10\n' + ''.join(
            '%d %d %d 0\n' % at for at in ((0, 0, 0), (0, 2, 0), (2, 0, 0), (0, 0, 2), (0, 1, 0), (1, 1, 0), (1, 0, 0),
                                           (0, 0, 1), (0, 1, 1), (1, 0, 1))) +
            'TetrahedraP2 1\n1 2 3 4 5 6 7 8 9 10 3\nEnd\n')
        self.run_ok('mesh', 'check', self.write('a.mesh', text), '-o', self.path('bad.vtu'), code=INVALID)
        mesh = meshio.read(self.path('bad.vtu'))
        self.assertEqual([(block.type, len(block.data)) for block in mesh.cells], [('tetra10', 1)])
        self.assertEqual(list(mesh.cell_data['region'][0]), [3])
        again = self.run_ok('mesh', 'check', self.path('bad.vtu'), code=INVALID)
        self.assertIn('1 tetrahedra of degree 2', again.out)

    @unittest.skipIf(vtkXMLUnstructuredGridReader is None, 'no VTK')
    def test_as_a_vtu(self):
        path = self.write('a.mesh', TETRAHEDRA.replace('2 3 4 5 8', '3 2 4 5 8'))
        self.run_ok('mesh', 'check', path, '-o', self.path('bad.vtu'), code=INVALID)
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(self.path('bad.vtu'))
        reader.Update()
        grid = reader.GetOutput()
        self.assertEqual((grid.GetNumberOfCells(), grid.GetCellType(0)), (1, 10))
        self.assertEqual(grid.GetCellData().GetArray('number').GetValue(0), 2)
        self.assertAlmostEqual(grid.GetCellData().GetArray('min_det_high').GetValue(0), -2, 12)
        again = self.run_ok('mesh', 'check', self.path('bad.vtu'), code=INVALID)
        self.assertIn('all 1 elements are turned around', again.out)


class Page(CommandTest):
    def data(self, name):
        return json.loads(re.search(r'id="data">(.*?)</script>', self.read(name).decode(), re.S)[1])

    def test_the_worst_elements(self):
        path = self.write('a.mesh', TETRAHEDRA.replace('2 3 4 5 8', '3 2 4 5 8'))
        self.run_ok('mesh', 'check', path, '-o', self.path('bad.html'), code=INVALID)
        data = self.data('bad.html')
        self.assertEqual((data['title'], data['faces'], data['facts']['status']), ('a.mesh', 8, 'invalid'))
        (fault,) = data['faults']
        self.assertLess(fault['face'], 4)  # the first faces are the four sides of the worst element
        self.assertRegex(fault['text'], r'\Aelement 2 \(tetrahedra, region 8\): min det J in \[-2, -2\] at ')
        numbers = struct.unpack('<8i', base64.b64decode(data['input_face']))
        self.assertEqual(numbers, (2,) * 4 + (1,) * 4)
        self.assertNotIn(self.folder, self.read('bad.html').decode())
        self.run_ok('mesh', 'check', path, '-o', self.path('worst.html'), '--list', 1, code=INVALID)
        self.assertEqual(self.data('worst.html')['faces'], 4)
        done = majorant('mesh', 'check', path, '-o', self.path('none.html'), '--list', 0)
        self.assertEqual((done.code, 'one at least' in done.err), (USAGE, True))

    def test_valid_ones(self):
        path = self.write('a.mesh', TETRAHEDRA)
        self.run_ok('mesh', 'check', path, '-o', self.path('best.html'))
        data = self.data('best.html')
        self.assertEqual((data['faces'], data['faults'], data['facts']['status']), (8, [], 'valid'))


class Picture(CommandTest):
    FLIPPED = (214, 0, 190)

    def colors(self, name):
        """Returns every colour of the picture of 1000 by 800 pixels, with its number of pixels."""
        width, height, rows = helpers.read_png(self.read(name))
        self.assertEqual((width, height), (1000, 800))
        return collections.Counter(pixel for row in rows for pixel in zip(row[::3], row[1::3], row[2::3]))

    def test_the_mesh_cut_open(self):
        """Invalid elements are magenta, as in every picture; the worst elements are marked if any are listed."""
        marked, number_of = (190, 0, 30), {}
        for name, text in (('good', TETRAHEDRA), ('bad', TETRAHEDRA.replace('2 3 4 5 8', '3 2 4 5 8'))):
            path = self.write('a.mesh', text)
            for listed in (0, 1, 2):
                picture = '%s%d.png' % (name, listed)
                self.run_ok('mesh', 'check', path, '-o', self.path(picture), '--list', listed,
                            code=INVALID if name == 'bad' else OK)
                colors = self.colors(picture)
                flipped = sum(count for color, count in colors.items()
                              if color[0] > 0 and color[1] == 0 and abs(color[2] / color[0] - 190 / 214) < 0.02)
                self.assertEqual(flipped > 1000, name == 'bad', (name, listed, flipped))
                number_of[name, listed] = colors[marked]
            self.assertEqual(number_of[name, 0], 0)
            self.assertGreater(number_of[name, 1], 100)
            self.assertGreater(number_of[name, 2], number_of[name, 1])


class Public(CommandTest):
    FOLDER = os.path.join(helpers.SHARED, 'data', 'public', 'volumes')

    @helpers.where(FOLDER)
    def test_tangled_ones_are_named(self):
        for name, least in (('generated/tangled_o2_n4_25.msh', 1), ('mfem/jagged.mesh', 1)):
            done = self.run_ok('mesh', 'check', os.path.join(self.FOLDER, name), code=INVALID)
            count = int(re.search(r'invalid: (\d+) of \d+ elements', done.out)[1])
            self.assertGreaterEqual(count, least)
            self.assertEqual(done.out.count('\n  element '), min(count, 10))


if __name__ == '__main__':
    helpers.main()
