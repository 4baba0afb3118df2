# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Writes small maps in formats with values instead of control points, or with vertices instead of corners:
Lagrange cells in .vtu, .msh of gmsh, .ply (see `make_broken_files.py`)."""
import struct
from fractions import Fraction as F

from broken_vtu import Case
from lagrange import values
from small_maps import VtuText, bent, cube, elevated, fan, square_grid

GMSH_TYPE = {1: 2, 2: 9, 3: 21, 4: 23}
LAGRANGE = 69


def lagrange_vtu(small, form='binary'):
    """Returns the map as a VTU with the rounded values at the lattice points instead of control points."""
    small = with_values(small)
    return VtuText(form).write(small, types=[LAGRANGE] * len(small.uv))


def with_values(small):
    small = small.copy()
    small.uv = [[tuple(map(float, p)) for p in values(uv, small.degree)] for uv in small.uv]
    return small


def msh(small, is_image):
    """Returns gmsh 4.1: the image, or the surface with views u and v. Nodes with equal position and value are
    shared."""
    small = with_values(small)
    places = {v: tuple(map(F, p)) for v, p in enumerate(small.surface[0])}
    nodes, elements = {}, []
    for corners, uv in zip(small.corners, small.uv):
        flat = elevated([places[v] for v in corners], small.degree)
        rows = [(tuple(map(float, space)), plane) for space, plane in zip(flat, uv)]
        elements.append([nodes.setdefault(row, len(nodes) + 1) for row in rows])
    lines = ['$MeshFormat', '4.1 0 8', '$EndMeshFormat', '$Nodes',
             '1 %d 1 %d' % (len(nodes), len(nodes)), '2 1 0 %d' % len(nodes)]
    lines += [str(tag) for tag in nodes.values()]
    lines += [' '.join(map(repr, plane + (0.0,) if is_image else space)) for space, plane in nodes]
    lines += ['$EndNodes', '$Elements', '1 %d 1 %d' % (len(elements), len(elements)),
              '2 1 %d %d' % (GMSH_TYPE[small.degree], len(elements))]
    lines += ['%d %s' % (e + 1, ' '.join(map(str, tags))) for e, tags in enumerate(elements)]
    lines.append('$EndElements')
    for k, name in enumerate(() if is_image else ('u', 'v')):
        lines += ['$NodeData', '1', '"%s"' % name, '1', '0', '3', '0', '1', str(len(nodes))]
        lines += ['%d %r' % (tag, plane[k]) for (_, plane), tag in nodes.items()]
        lines.append('$EndNodeData')
    return ('\n'.join(lines) + '\n').encode()


def ply(small, form='binary_little_endian'):
    """Returns a map of degree 1; vertices on cuts occur several times with one input_vertex."""
    vertices, faces = {}, []
    for corners, uv in zip(small.corners, small.uv):
        faces.append([vertices.setdefault((v, p), len(vertices)) for v, p in zip(corners, uv)])
    head = ['ply', 'format %s 1.0' % form, 'comment a small map', 'element vertex %d' % len(vertices)]
    head += ['property double ' + name for name in ('x', 'y', 'z', 's', 't')]
    head += ['property int input_vertex', 'element face %d' % len(faces),
             'property list uchar int vertex_indices', 'end_header', '']
    rows = [tuple(map(float, small.surface[0][v])) + p + (v,) for v, p in vertices]
    if form == 'ascii':
        body = ''.join(' '.join(map(repr, row)) + '\n' for row in rows)
        body += ''.join('3 %d %d %d\n' % tuple(face) for face in faces)
        return '\n'.join(head).encode() + body.encode()
    body = b''.join(struct.pack('<5di', *row) for row in rows)
    return '\n'.join(head).encode() + body + b''.join(struct.pack('<B3i', 3, *f) for f in faces)


def good_cases():
    def good(name, data, why, surface='', options=()):
        return Case(name, data, '', why, surface, options)
    for degree in (2, 3, 4):
        yield good('lagrange_%d.vtu' % degree, lagrange_vtu(square_grid(degree, bent)),
                   'Lagrange cells of degree %d' % degree, 'grid', ['--overlap'])
    for degree in (1, 3):
        small = fan(degree, bent)
        yield good('surface_%d.msh' % degree, msh(small, False),
                   'gmsh, degree %d: the surface with views u and v' % degree, 'fan', ['--overlap'])
        yield good('image_%d.msh' % degree, msh(small, True), 'the same: the image', '', ['--overlap'])
    yield good('grid.ply', ply(square_grid()), 'binary', 'grid', ['--overlap'])
    yield good('grid_ascii.ply', ply(square_grid(), 'ascii'), 'ascii', 'grid', ['--overlap'])
    yield good('cube.ply', ply(cube()), 'seams: vertices several times', 'cube',
               ['--seamless', '--overlap'])


def turned_inside(degree=2):
    """Returns a map that is positive at all lattice points and not between them."""
    small = square_grid(degree, bent)
    x, y = small.uv[0][3]
    small.set(0, 3, (x, y + 0.375))
    return small


def broken_cases():
    yield Case('lagrange_bulging_2.vtu', lagrange_vtu(turned_inside()), 'positivity',
               'Lagrange cells, one of which folds over')
    small = square_grid(3, bent)
    x, y = small.uv[0][7]
    small.set(0, 7, (x + 1e-12, y))
    yield Case('lagrange_torn_3.vtu', lagrange_vtu(small), 'continuity',
               'values on the two sides of an edge differ in the twelfth digit', 'grid')
    small = fan(3, bent)
    small.shift([4], (F(1, 64), 0))
    yield Case('torn_3.msh', msh(small, False), 'continuity', 'one cell of a surface is moved', 'fan')
    yield Case('folded_2.msh', msh(turned_inside(), True), 'positivity', 'an image that folds over')
    small = square_grid()
    small.move(4, (0.5, -0.125))
    yield Case('inverted.ply', ply(small), 'positivity', 'two faces are inverted')
    small = square_grid()
    small.set(0, 2, (0.5, 0.4375))
    yield Case('torn.ply', ply(small), 'continuity', 'one face has an s, t of its own', 'grid')
    yield Case('truncated.ply', ply(square_grid())[:-5], 'unreadable', 'the last face is cut off')
    data = msh(fan(3, bent), False)
    yield Case('truncated.msh', data[:data.rfind(b'$NodeData') + 80], 'unreadable',
               'the second view ends early')
