# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Our files in the programs that they are for, and their files in ours: VTK, meshio and gmsh.

Exits with 77, which ctest shows as skipped, if one of their Python modules is not installed.
"""
import contextlib
import sys

from command_helpers import *

try:
    import gmsh
    import meshio
    import numpy as np
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError as error:
    print('skipped: no', error.name)
    sys.exit(77)

DEGREES = range(1, 9)
GMSH_TYPE = dict(zip(range(1, 9), (2, 9, 21, 23, 25, 42, 43, 44)))
INSIDE = np.array([(a, b, 6 - a - b) for a in range(1, 5) for b in range(1, 6 - a)]) / 6


def multi_indices(n):
    if n <= 0:
        return [(0, 0, 0)] * (n == 0)
    edges = [(n - s, s, 0) for s in range(1, n)]
    edges += [(0, n - s, s) for s in range(1, n)]
    edges += [(s, 0, n - s) for s in range(1, n)]
    inner = [(i + 1, j + 1, k + 1) for i, j, k in multi_indices(n - 3)]
    return [(n, 0, 0), (0, n, 0), (0, 0, n)] + edges + inner


def bernstein(n):
    """Returns points inside by basis functions."""
    return np.array([[math.factorial(n) * np.prod([x**i / math.factorial(i)
                                                   for x, i in zip(point, index)])
                      for index in multi_indices(n)] for point in INSIDE])


def grid_of(path):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


class Gmsh:
    """A session of gmsh, which ends with the `with` block."""

    @staticmethod
    def close():
        gmsh.finalize()


class OtherTools(CommandTest):
    @classmethod
    def setUpClass(cls):
        """Makes a map of every degree in every format."""
        cls.maps = tempfile.mkdtemp(prefix='majorant_apps_')
        cls.addClassCleanup(shutil.rmtree, cls.maps)
        mesh = os.path.join(cls.maps, 'mesh.obj')
        with open(mesh, 'w') as f:
            f.write(obj_text(*grid(3)))
        cls.bezier = {}
        for n in DEGREES:
            outcome = majorant('parametrize', '--quiet', mesh, '-o', cls.map_path('%d.vtu' % n),
                               '-o', cls.map_path('%d.msh' % n), '--degree', n,
                               '--max-iterations', 2)
            assert outcome.code in (OK, LIMIT), outcome.err
            for option, name in ((['--vtu', 'lagrange'], '%d.lagrange.vtu'),
                                 (['--msh', 'surface'], '%d.surface.msh'), ([], '%d.ply')):
                outcome = majorant('convert', cls.map_path('%d.vtu' % n), '-o',
                                   cls.map_path(name % n), *option)
                assert outcome.code == OK, outcome.err
            cls.bezier[n] = Vtu(cls.map_path('%d.vtu' % n))
        cls.mesh = mesh

    @classmethod
    def map_path(cls, name):
        return os.path.join(cls.maps, name)

    def control(self, n, name):
        """Returns control points of the Bezier file: cells by points by coordinates."""
        rows = np.array(self.bezier[n].rows(name))
        return rows[np.array(self.bezier[n].cells())]

    def close(self, found, required, what, tolerance=1e-12):
        found, required = np.array(found), np.array(required)
        self.assertEqual(found.shape, required.shape, what)
        worst = np.abs(found - required).max()
        self.assertLessEqual(worst, tolerance * np.abs(required).max(), what)

    def nodes(self, n, name):
        """Returns values of the map at the lattice points of every cell, in VTK's order."""
        lattice = np.array(multi_indices(n)) / n
        weights = np.array([[math.factorial(n) * np.prod([x**i / math.factorial(i)
                                                          for x, i in zip(point, index)])
                             for index in multi_indices(n)] for point in lattice])
        return np.einsum('pk,ckd->cpd', weights, self.control(n, name))

    def test_vtk_evaluates_lagrange_cells(self):
        for n in DEGREES:
            grid = grid_of(self.map_path('%d.lagrange.vtu' % n))
            self.assertEqual(grid.GetNumberOfCells(), len(self.bezier[n].cells()))
            uv = vtk_to_numpy(grid.GetPointData().GetArray('uv'))
            plane = vtk.vtkUnstructuredGrid()
            plane.DeepCopy(grid)
            flat = vtk.vtkPoints()
            flat.SetDataTypeToDouble()
            for u, v in uv:
                flat.InsertNextPoint(u, v, 0)
            plane.SetPoints(flat)
            for name, mesh, width in (('Points', grid, 3), ('uv', plane, 2)):
                values = np.einsum('pk,ckd->cpd', bernstein(n), self.control(n, name))
                for c in range(mesh.GetNumberOfCells()):
                    cell = mesh.GetCell(c)
                    self.assertEqual(cell.GetCellType(), 5 if n == 1 else 69)
                    found = []
                    for r, s, t in INSIDE:
                        x, weights = [0.0] * 3, [0.0] * cell.GetNumberOfPoints()
                        cell.EvaluateLocation(vtk.reference(0), [s, t, 0.0], x, weights)
                        found.append(x[:width])
                    self.close(found, values[c], 'degree %d, %s' % (n, name))

    def test_vtk_saves_what_check_reads(self):
        """VTK compresses by zlib by default, in blocks of several sizes; uncompressed files are tested, too."""
        for name in ('3.vtu', '3.lagrange.vtu', '1.vtu'):
            grid = grid_of(self.map_path(name))
            for mode in ('Appended', 'Binary'):
                for block, header in ((32768, 32), (64, 64), (1024, 64), (8192, 32)):
                    for compressor in ('ZLib', 'None'):
                        writer = vtk.vtkXMLUnstructuredGridWriter()
                        writer.SetInputData(grid)
                        writer.SetFileName(self.path('saved.vtu'))
                        getattr(writer, 'SetDataModeTo' + mode)()
                        getattr(writer, 'SetCompressorTypeTo' + compressor)()
                        getattr(writer, 'SetHeaderTypeToUInt%d' % header)()
                        writer.SetBlockSize(block)
                        self.assertEqual(writer.Write(), 1)
                        with self.subTest(name=name, mode=mode, block=block, header=header,
                                          compressor=compressor):
                            self.run_ok('check', self.path('saved.vtu'), '--surface', self.mesh)
                        if compressor == 'ZLib':
                            self.assertIn(b'vtkZLibDataCompressor', self.read('saved.vtu'))

    def test_vtk_defaults(self):
        writer = vtk.vtkXMLUnstructuredGridWriter()
        writer.SetInputData(grid_of(self.map_path('3.vtu')))
        writer.SetFileName(self.path('saved.vtu'))
        writer.Write()
        self.run_ok('check', self.path('saved.vtu'), '--surface', self.mesh)

    def test_meshio_reads_vtu(self):
        for n, name, kind in [(1, '1.vtu', 'triangle')] + [
                (n, '%d.lagrange.vtu' % n, 'VTK_LAGRANGE_TRIANGLE') for n in DEGREES if n > 1]:
            mesh = meshio.read(self.map_path(name))
            cells = [block for block in mesh.cells]
            self.assertEqual([block.type for block in cells], [kind])
            ours = self.bezier[n]
            self.assertEqual(cells[0].data.tolist(), [list(c) for c in ours.cells()])
            self.assertEqual(mesh.points.tolist(), [list(p) for p in ours.rows('Points')])
            found = np.asarray(mesh.point_data['uv']).reshape(-1, 2)[cells[0].data]
            self.close(found, self.nodes(n, 'uv'), name)
            claims = bytes(np.asarray(mesh.field_data['majorant_claims'], dtype=np.uint8))
            self.assertEqual(json.loads(claims)['degree'], n)

    def test_meshio_reads_msh_and_ply(self):
        for n in (1, 2, 3):
            mesh = meshio.read(self.map_path('%d.msh' % n))
            self.assertEqual(sum(len(block.data) for block in mesh.cells),
                             len(self.bezier[n].cells()))
            self.assertEqual(len(mesh.points), len(self.bezier[n].rows('uv')))
        mesh = meshio.read(self.map_path('1.ply'))
        v, vt, faces, texture = read_obj(self.obj(1))
        self.assertEqual(mesh.points.tolist(), [list(p) for p in v])
        self.assertEqual(mesh.cells[0].data.tolist(), [list(f) for f in faces])
        uv = [vt[dict(zip(sum(faces, ()), sum(texture, ())))[k]] for k in range(len(v))]
        self.assertEqual(list(zip(mesh.point_data['s'], mesh.point_data['t'])), uv)

    def obj(self, n):
        self.run_ok('convert', self.map_path('%d.vtu' % n), '-o', self.path('map.obj'))
        return self.path('map.obj')

    def in_gmsh(self, path):
        gmsh.initialize(['-v', '0'])
        gmsh.option.setNumber('General.Terminal', 0)
        gmsh.open(path)
        return contextlib.closing(Gmsh())

    def elements_in_gmsh(self, n):
        """Returns tags of elements, and coordinates of their nodes: cells by nodes by 3."""
        types, tags, nodes = gmsh.model.mesh.getElements(2)
        self.assertEqual(list(types), [GMSH_TYPE[n]])
        node_tags, coordinates, _ = gmsh.model.mesh.getNodes()
        place = dict(zip(node_tags.tolist(), coordinates.reshape(-1, 3)))
        cells = nodes[0].reshape(-1, (n + 1) * (n + 2) // 2)
        return tags[0], np.array([[place[t] for t in cell] for cell in cells.tolist()])

    def test_gmsh_sees_the_image(self):
        for n in DEGREES:
            with self.subTest(degree=n), self.in_gmsh(self.map_path('%d.msh' % n)):
                tags, coordinates = self.elements_in_gmsh(n)
                self.assertEqual(len(tags), len(self.bezier[n].cells()))
                self.close(coordinates[:, :, :2], self.nodes(n, 'uv'), 'nodes')
                self.assertEqual(np.abs(coordinates[:, :, 2]).max(), 0)
                # gmsh evaluates the elements; its polynomials lose some digits at high degrees.
                local = np.zeros((len(INSIDE), 3))
                local[:, :2] = INSIDE[:, 1:]
                _, determinants, points = gmsh.model.mesh.getJacobians(GMSH_TYPE[n],
                                                                       local.flatten())
                required = np.einsum('pk,ckd->cpd', bernstein(n), self.control(n, 'uv'))
                self.close(points.reshape(len(tags), len(INSIDE), 3)[:, :, :2], required, 'inside',
                           1e-10)
                self.assertGreater(determinants.min(), 0)
                smallest = self.smallest_jacobians()
                self.assertEqual(len(smallest), len(tags))
                self.assertGreater(min(smallest), 0)

    def smallest_jacobians(self):
        for option, value in (('JacobianDeterminant', 1), ('CreateView', 1), ('Recompute', 1),
                              ('DimensionOfElements', 2)):
            gmsh.plugin.setNumber('AnalyseMeshQuality', option, value)
        gmsh.plugin.run('AnalyseMeshQuality')
        _, _, data, _, _ = gmsh.view.getModelData(gmsh.view.getTags()[-1], 0)
        return [min(values) for values in data]

    def test_gmsh_finds_inverted_cells(self):
        """Tests the oracle: gmsh and check find a cell with a node far outside."""
        with open(self.map_path('3.msh')) as f:
            lines = f.read().split('\n')
        inner = lines[lines.index('$Elements') + 3].split()[-1]  # the inner node of a cell
        start = lines.index('$Nodes') + 3
        count = int(lines[start - 1].split()[3])
        lines[start + count + lines[start:start + count].index(inner)] = '100 100 0'
        path = self.write('inverted.msh', '\n'.join(lines))
        with self.in_gmsh(path):
            self.assertLess(min(self.smallest_jacobians()), 0)
        self.found(path, says='positive')

    def test_gmsh_sees_the_surface_and_its_views(self):
        for n in (1, 3, 8):
            with self.subTest(degree=n), self.in_gmsh(self.map_path('%d.surface.msh' % n)):
                tags, coordinates = self.elements_in_gmsh(n)
                self.close(coordinates, self.control(n, 'Points'), 'nodes')
                nodes = self.nodes(n, 'uv')
                _, _, cells = gmsh.model.mesh.getElements(2)
                for axis, (view, name) in enumerate(zip(gmsh.view.getTags(), 'uv')):
                    self.assertEqual(gmsh.option.getString('View[%d].Name' % axis), name)
                    kind, node_tags, data, _, components = gmsh.view.getModelData(view, 0)
                    self.assertEqual((kind, components), ('NodeData', 1))
                    value = dict(zip(node_tags, [d[0] for d in data]))
                    found = [[value[t] for t in cell]
                             for cell in cells[0].reshape(len(tags), -1).tolist()]
                    self.close(found, nodes[:, :, axis], 'view ' + name)

    def test_gmsh_saves_what_check_reads(self):
        for n in DEGREES:
            with self.in_gmsh(self.map_path('%d.msh' % n)):
                gmsh.option.setNumber('Mesh.MshFileVersion', 4.1)
                gmsh.option.setNumber('Mesh.SaveAll', 1)
                gmsh.write(self.path('saved.msh'))
            self.run_ok('check', self.path('saved.msh'), '--certify')

    def test_a_mesh_made_by_gmsh(self):
        """A disk with curved edges: points and lines are skipped, and its cells are judged."""
        with self.in_gmsh(self.write('none.geo', '')):
            gmsh.model.occ.addDisk(0, 0, 0, 1, 1)
            gmsh.model.occ.synchronize()
            gmsh.option.setNumber('Mesh.CharacteristicLengthMax', 0.5)
            gmsh.model.mesh.generate(2)
            gmsh.model.mesh.setOrder(3)
            gmsh.write(self.path('disk.msh'))
        self.run_ok('check', self.path('disk.msh'), '--certify')
        self.run_ok('parametrize', '--quiet', self.path('disk.msh'), '-o', self.path('disk.vtu'),
                    '--degree', '2')


if __name__ == '__main__':
    main()
