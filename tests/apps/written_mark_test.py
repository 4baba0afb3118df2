#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Every mesh or map file of every verb has majorant's mark once, also if its input had one. Everything else is
unchanged, and other programs read the file."""
import contextlib
import os
import re
import unittest

import command_helpers as helpers
from command_helpers import CommandTest, majorant, obj_text
from mesh_optimize_test import tangled

try:
    import gmsh
except ImportError:
    gmsh = None

MARK = rb'majorant \d+\.\d+\.\d+'
# The pattern of the mark, by extension.
PLACES = {'.obj': rb'# %s\n', '.mtl': rb'# %s\n',
          '.ply': rb'ply\nformat binary_little_endian 1.0\ncomment %s\n',
          '.msh': rb'\$MeshFormat\n[^$]*\$EndMeshFormat\n\$Comments\n%s\n\$EndComments\n',
          '.mesh': rb'(MFEM mesh v1.0|MeshVersionFormatted 2)\n# %s\n',
          '.vtu': rb'<\?xml version="1.0"\?>\n<!-- %s -->\n<VTKFile ',
          '.gltf': rb'[^\0]*"asset": \{\s*"generator": "%s",',
          '.glb': rb'glTF[\s\S]{16}[^\0]*"asset":\{"generator":"%s",'}
CLAIMS = (rb'<\?xml version="1.0"\?>\n<VTKFile [^>]*>\n<UnstructuredGrid>\n<FieldData>\n'
          rb'<DataArray type="UInt8" Name="majorant_claims" NumberOfTuples="\d+" format="ascii">\n')
MFEM = ('MFEM mesh v1.0\n\n# two squares\ndimension\n2\n\nelements\n2\n1 3 0 1 4 3\n2 3 1 2 5 4\n\nboundary\n0\n\n'
        'vertices\n6\n2\n0 0\n1 0\n2 0.2\n0 1\n1.1 1\n2 1\n')


class WrittenMark(CommandTest):
    def require_mark(self, name):
        data, extension = self.read(name), os.path.splitext(name)[1]
        if extension == '.vtu' and b'majorant_claims' in data:
            self.assertRegex(data, b'^' + CLAIMS, name)
            self.assertEqual(len(re.findall(MARK, data)), 0, name)
        else:
            self.assertRegex(data[:4096], b'^' + PLACES[extension] % MARK, name)
            self.assertEqual(len(re.findall(MARK, data)), 1, name)

    def made(self, *args, extensions, name='out'):
        outputs = [name + e for e in extensions]
        for runs in ([[o] for o in outputs] if args[0] == 'mesh' else [outputs]):
            self.run_ok(*args, '--quiet', '--force', *[word for o in runs for word in ('-o', self.path(o))])
        for output in outputs:
            self.require_mark(output)
        return [self.path(o) for o in outputs]

    def test_maps_and_layouts(self):
        maps = ['.vtu', '.obj', '.ply', '.glb', '.gltf', '.msh']
        disk = self.write('disk.obj', obj_text(*helpers.grid(3)))
        self.made('parametrize', disk, extensions=maps)
        self.made('parametrize', disk, '--degree', 2, '--msh', 'surface', extensions=maps)
        closed = self.write('torus.obj', obj_text(*helpers.torus(8, 6, 0)))
        self.made('unwrap', closed, extensions=maps, name='layout')
        self.made('seamless', closed, extensions=['.vtu', '.obj', '.ply', '.msh'])
        self.made('convert', self.path('layout.vtu'), extensions=maps)
        self.made('quads', closed, '--count', 60, extensions=['.obj', '.ply', '.vtu'], name='quads')

    def test_marks_do_not_pile_up(self):
        disk = self.write('disk.obj', '# of a disk\n# majorant 0.0.1\n' + obj_text(*helpers.grid(3)))
        for extension in ('.obj', '.glb', '.gltf', '.ply', '.msh', '.vtu'):
            words = ['--degree', 1] + (['--msh', 'surface'] if extension == '.msh' else [])
            (before,) = self.made('parametrize', disk, *words, extensions=[extension])
            first = self.read('out' + extension)
            for _ in range(2):
                self.made('parametrize', before, *words, extensions=[extension])
            if extension == '.obj':
                self.assertEqual(re.findall(b'^#.*$', first, re.M), [b'# majorant ' + self.version(), b'# of a disk'])
                self.assertEqual(re.findall(b'^#.*$', self.read('out.obj'), re.M),
                                 [b'# majorant ' + self.version(), b'# of a disk'])

    @staticmethod
    def version():
        return re.match(r'majorant (\S+) ', majorant('--version').out)[1].encode()

    def test_volumes(self):
        lines = re.sub('(Dimension|Vertices|Tetrahedra) ', r'\1\n', tangled(2))  # gmsh reads numbers on lines of their own
        medit, mfem = self.write('medit.mesh', lines), self.write('mfem.mesh', MFEM)
        self.run_ok('mesh', 'check', medit, '-o', self.path('bad.vtu'), code=helpers.INVALID)
        self.require_mark('bad.vtu')
        self.made('mesh', 'optimize', mfem, extensions=['.mesh', '.msh', '.vtu'], name='squares')
        self.made('mesh', 'optimize', medit, extensions=['.mesh', '.msh', '.vtu'], name='cube')
        forms = [(version, encoding) for version in ('2.2', '4.1') for encoding in ([], ['--binary'])]
        for version, encoding in forms:
            self.made('mesh', 'optimize', medit, '--msh-version', version, *encoding, extensions=['.msh'])
            for again in (['--msh-version', version, *encoding], ['--msh-version', '4.1'], []):
                self.made('mesh', 'optimize', self.path('out.msh'), *again, extensions=['.msh'], name='again')
            self.opens_in_gmsh('out.msh', 3)
        for name in ('cube.mesh', 'squares.mesh', 'cube.vtu', 'squares.msh'):
            self.made('mesh', 'optimize', self.path(name), extensions=[os.path.splitext(name)[1]], name='again')
        self.opens_in_gmsh('cube.mesh', 3)

    def opens_in_gmsh(self, name, dimension):
        """Tests that gmsh opens the file with elements and without a warning."""
        if gmsh is None:
            return
        gmsh.initialize(['-v', '0'])
        with contextlib.ExitStack() as stack:
            stack.callback(gmsh.finalize)
            gmsh.option.setNumber('General.Terminal', 0)
            gmsh.logger.start()
            stack.callback(gmsh.logger.stop)
            gmsh.open(self.path(name))
            self.assertEqual([line for line in gmsh.logger.get() if not line.startswith('Info')], [], name)
            self.assertGreater(len(gmsh.model.mesh.getElements(dimension)[1]), 0, name)

    @unittest.skipIf(gmsh is None, 'no gmsh')
    def test_gmsh_has_no_warnings(self):
        disk = self.write('disk.obj', obj_text(*helpers.grid(3)))
        for degree in (1, 3):
            for content in ('image', 'surface'):
                self.made('parametrize', disk, '--degree', degree, '--msh', content, extensions=['.msh'])
                self.opens_in_gmsh('out.msh', 2)


if __name__ == '__main__':
    helpers.main()
