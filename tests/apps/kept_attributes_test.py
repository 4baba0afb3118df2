# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Attributes that an OBJ keeps from its input, and compressed inputs by other programs."""
import gzip
import os
import subprocess
import unittest

from command_helpers import *

RESAVE = '''
import sys, vtk
reader = vtk.vtkXMLUnstructuredGridReader()
reader.SetFileName(sys.argv[1])
writer = vtk.vtkXMLUnstructuredGridWriter()
writer.SetInputConnection(reader.GetOutputPort())
writer.SetFileName(sys.argv[2])
getattr(writer, 'SetDataModeTo' + sys.argv[3])()
writer.SetEncodeAppendedData(int(sys.argv[4]))
assert writer.Write() == 1
'''


def lines_of(path, without=()):
    with open(path) as f:
        return [line.split() for line in f if line.split() and line.split()[0] not in without]


class KeptAttributes(CommandTest):
    MODEL = '''# by hand
mtllib my own.mtl
o thing
v 0 0 0 0.5 0.25 1
v 1 0 0 1 1 1
v 1 1 0.1
v 0 1 0
v 7 7 7
vn 0 0 1
g left
s 1
usemtl red paint
f 1//1 2//1 3//1 4//1
g right
s off
f 2 6 3
p 5
l 1 2 3
v 2 0.5 0
'''

    def setUp(self):
        super().setUp()
        for folder in ('in', 'out'):
            os.mkdir(self.path(folder))
        self.mesh = self.write('in/model.obj', self.MODEL)
        self.write('in/my own.mtl', 'newmtl red paint\n')

    def test_everything_but_vt_is_as_given(self):
        self.run_ok('parametrize', self.mesh, self.path('in/out.obj'))
        ours = lines_of(self.path('in/out.obj'), without=('vt', '#'))
        expected = [line.split() for line in self.MODEL.splitlines()[1:]]
        for line in ours + expected:
            if line[0] == 'f':
                corners = [(c.split('/') + ['', ''])[:3] for c in line[1:]]
                line[1:] = ['%s//%s' % (v, vn) for v, _, vn in corners]
        by_kind = lambda lines: (  # v and vn may move, the other lines keep their order
            [l for l in lines if l[0] == 'v'], [l for l in lines if l[0] == 'vn'],
            [l for l in lines if l[0] not in ('v', 'vn')])
        self.assertEqual(by_kind(ours), by_kind(expected))

    def test_materials_are_found_from_another_folder(self):
        self.run_ok('parametrize', self.mesh, self.path('out/out.obj'))
        with open(self.path('out/out.obj')) as f:
            name = [l for l in f if l.startswith('mtllib ')][0][len('mtllib '):].rstrip('\n')
        self.assertTrue(os.path.isfile(os.path.join(self.path('out'), name)), name)

    def test_gzip(self):
        with open(self.mesh, 'rb') as f:
            content = f.read()
        with gzip.open(self.path('in/packed.OBJ.gz'), 'wb') as f:
            f.write(content)
        self.run_ok('parametrize', self.path('in/packed.OBJ.gz'), self.path('in/a.obj'))
        self.run_ok('parametrize', self.mesh, self.path('in/b.obj'))
        self.assertEqual(self.read('in/a.obj'), self.read('in/b.obj'))
        self.run_ok('check', self.path('in/a.obj'), '--surface', self.path('in/packed.OBJ.gz'))
        whole = self.read('in/packed.OBJ.gz')
        for name, damaged in [('cut', whole[:-9]), ('bad', whole[:-6] + b'x' + whole[-5:]),
                              ('plain', content)]:
            path = self.write('in/%s.obj.gz' % name, damaged)
            self.refused(UNREADABLE, 'info', path, says=name + '.obj.gz: ')

    def test_ply_colours(self):
        mesh = self.write('in/a.ply', 'ply\nformat ascii 1.0\nelement vertex 3\n' + ''.join(
            'property %s\n' % p for p in ('float x', 'float y', 'float z', 'uchar red',
                                          'uchar green', 'uchar blue')) +
            'element face 1\nproperty list uchar int vertex_indices\nend_header\n'
            '0 0 0 255 0 51\n1 0 0 0 0 0\n0 1 0 0 0 255\n3 0 1 2\n')
        self.run_ok('parametrize', mesh, self.path('out/out.obj'))
        self.assertEqual([l[4:] for l in lines_of(self.path('out/out.obj')) if l[0] == 'v'],
                         [['1', '0', '0.2'], ['0', '0', '0'], ['0', '0', '1']])

    @where('/usr/lib/python3/dist-packages/vtk.py')
    def test_a_result_that_vtk_has_saved_with_its_defaults(self):
        out = self.path('out/out.vtu')
        self.run_ok('parametrize', generated('cap'), '-o', out, '--degree', 2)
        for mode, encode in [('Appended', 0), ('Appended', 1), ('Binary', 0), ('Ascii', 0)]:
            saved = self.path('out/saved.vtu')
            subprocess.run(['/usr/bin/python3', '-c', RESAVE, out, saved, mode, str(encode)],
                           check=True, timeout=120)
            if mode != 'Ascii':
                self.assertIn(b'vtkZLibDataCompressor', self.read('out/saved.vtu'))
            self.run_ok('check', saved, '--surface', generated('cap'))


if __name__ == '__main__':
    main()
