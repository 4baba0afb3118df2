#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Marks in files for other programs: texture coordinates of a .vtu, charts of a .msh as groups. Files
without these marks are read as before."""
import os
import re
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from command_helpers import *


class MarkedFiles(CommandTest):
    def make(self, name, *args):
        mesh = self.write('torus.obj', obj_text(*torus(10, 6, 0)))
        self.run_ok('unwrap', '--quiet', mesh, '-o', self.path(name), '--seams', 'sharp=20', *args)
        return self.read(name)

    def accepted_without(self, name, pattern):
        """Tests that the file is accepted, with and without the text that matches the pattern."""
        data = self.read(name)
        old, count = re.subn(pattern, b'', data)
        self.assertGreater(count, 0)
        with open(self.path('old_' + name), 'wb') as f:
            f.write(old)
        verdicts = [self.run_ok('check', self.path(n), '--cuts', 'free').out.replace('old_', '')
                    for n in (name, 'old_' + name)]
        self.assertEqual(*verdicts)
        for n in (name, 'old_' + name):
            self.run_ok('convert', '--quiet', '--force', self.path(n), '-o', self.path('again_' + n))
        self.assertEqual(self.read('again_' + name), self.read('again_old_' + name))

    def test_uv_are_texture_coordinates(self):
        for degree in (1, 3):
            self.assertIn(b'<PointData TCoords="uv">', self.make('a.vtu', '--degree', degree))
            self.accepted_without('a.vtu', b' TCoords="uv"')

    def test_vtk_finds_them(self):
        try:
            from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
        except ImportError:
            self.skipTest('no VTK')
        self.make('a.vtu', '--degree', 2)
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(self.path('a.vtu'))
        reader.Update()
        found = reader.GetOutput().GetPointData().GetTCoords()
        self.assertEqual(found.GetName(), 'uv')

    def test_charts_are_groups(self):
        for content in ('image', 'surface'):
            text = self.make('a.msh', '--msh', content).decode()
            names = re.findall(r'^2 (\d+) "chart (\d+)"$', text, re.M)
            self.assertGreater(len(names), 1)
            self.assertEqual([(str(k + 1), str(k)) for k in range(len(names))], names)
            entities = text.split('$Entities\n')[1].split('\n$End')[0].splitlines()[1:]
            self.assertEqual([line.split()[7:] for line in entities],
                             [['1', str(k + 1), '0'] for k in range(len(names))])
        text = re.sub(r'(?s)\$PhysicalNames.*EndPhysicalNames\n', '', text)
        text = re.sub(r'(?m)^(\d+(?: \S+){6}) 1 \d+ 0$', r'\1 0 0', text)
        self.write('old.msh', text)
        for name in ('a.msh', 'old.msh'):
            self.assertIn('valid', self.run_ok('check', self.path(name), '--cuts', 'free').out)

    def test_gmsh_finds_them(self):
        try:
            import gmsh
        except ImportError:
            self.skipTest('no gmsh')
        self.make('a.msh', '--degree', 2)
        gmsh.initialize(['-v', '0'])
        try:
            gmsh.option.setNumber('General.Terminal', 0)
            gmsh.open(self.path('a.msh'))
            groups = gmsh.model.getPhysicalGroups(2)
            names = [gmsh.model.getPhysicalName(*group) for group in groups]
            self.assertGreater(len(groups), 1)
            self.assertEqual(names, ['chart %d' % k for k in range(len(groups))])
            self.assertEqual(list(gmsh.model.getEntitiesForPhysicalGroup(*groups[1])), [2])
        finally:
            gmsh.finalize()


if __name__ == '__main__':
    main()
