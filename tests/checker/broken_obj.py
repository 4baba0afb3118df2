# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the broken OBJ files (see `make_broken_files.py`)."""
import math

from broken_vtu import RING, Case, octagon
from small_maps import (Refined, SmallMap, cube, fan, obj_bytes, obj_of, plate, square_grid,
                        straight, strip)

SQUARE = [(0, 0, 0), (1, 0, 0), (1, 1, 0.25), (0, 1, 0)]  # one bent quad


def one_quad(texture):
    return obj_bytes(SQUARE, [(0, 1, 2, 3)], texture, [(0, 1, 2, 3)])


def polygons():
    yield Case('hourglass_quad.obj', one_quad([(0, 0), (1, 0), (0, 1), (1, 1)]), 'positivity',
               'the image of a quad crosses itself')
    yield Case('flat_quad.obj', one_quad([(0, 0), (1, 0), (2, 0), (1, 1)][:3] + [(1, 0)]),
               'positivity', 'the image of a quad lies on a line')
    yield Case('negative_quad.obj', one_quad([(0, 0), (0, 1), (1, 1), (1, 0)]), 'positivity',
               'the image of a quad is upside down')
    small = square_grid(polygons=True, n=1)
    data = obj_bytes(small.surface[0], [(0, 1, 3, 2), (0, 1, 3)],
                     [(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 1, 2, 3), (0, 1, 2)])
    yield Case('quad_and_half.obj', data, 'coverage', 'half of a quad is mapped again', 'quad')
    data = obj_bytes(small.surface[0], [(0, 3, 1, 2)],
                     [(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 1, 2, 3)])
    yield Case('corners_in_another_order.obj', data, 'orientation',
               'the corners of a quad come in another order than the surface has them', 'quad')


def triangles():
    small = square_grid()
    small.set(0, 2, (0.5, 0.4375))
    yield Case('torn.obj', obj_of(small), 'continuity', 'one face has a vt of its own', 'grid')
    small = square_grid()
    small.set(0, 2, (0.5, math.nextafter(0.5, 1)))
    yield Case('torn_in_the_last_digit.obj', obj_of(small), 'continuity',
               'the same, one ulp away', 'grid')
    small = square_grid()
    small.move(4, (0.5, -0.125))
    yield Case('inverted.obj', obj_of(small), 'positivity', 'two faces are inverted')
    small = square_grid()
    small.move(4, (0.25, 0))
    yield Case('zero_area.obj', obj_of(small), 'positivity', 'an area is exactly zero')
    data = obj_bytes([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)],
                     [('0.1', '0.7'), ('0.4', '1.0'), ('0.0', '0.6')], [(0, 1, 2)])
    yield Case('zero_in_decimals.obj', data, 'positivity',
               'the decimals lie on a line; only rounded to doubles is the area positive')
    small = square_grid()
    small.keep([0, 1, 2, 4, 5, 6, 7])
    yield Case('missing_face.obj', obj_of(small), 'coverage', 'a face is missing', 'grid')
    small = square_grid()
    small.keep([0, 1, 2, 3, 4, 5, 6, 7, 5])
    small.shift([8], (2, 0))
    yield Case('doubled_face.obj', obj_of(small), 'coverage', 'a face is there twice', 'grid')
    small = square_grid()
    small.turn(6, (0, 2, 1))
    small.uv[6] = [(-x, y) for x, y in small.uv[6]]
    yield Case('mirrored_face.obj', obj_of(small), 'orientation', 'a face is turned over', 'grid')
    turns = [(4, 1), (-1, 4), (-4, -1), (1, -4), (4, 0), (-1, 3), (-3, -1), (2, -3)]
    small = SmallMap(*octagon(), 1, ([(0, 0)] + turns, straight))
    yield Case('fan_winds_twice.obj', obj_of(small), 'angles',
               'eight positive faces wind twice around their centre')
    small = strip(RING + [((1.25, 0.75), (-0.5, 0.5)), ((2, 0.5), (2, -1))])
    yield Case('more_than_a_turn.obj', obj_of(small), 'overlap',
               'a ribbon of more than one turn lies over its own start', '', ['--overlap'])
    small = square_grid()
    small.shift([4, 5, 6, 7], (1, 0))
    small.shift([4, 5, 6, 7], (0, -0.5))
    yield Case('charts_touch.obj', obj_of(small), 'touching', 'two charts share an edge', 'grid',
               ['--overlap', '--cuts', 'free'])
    small = cube()
    small.set(0, 1, (1.000001, 0))
    yield Case('seam_off_by_1e-6.obj', obj_of(small), 'continuity',
               'a corner at a seam is off by 1e-6', 'cube', ['--seamless'])


def refined():
    fine = Refined(square_grid())
    # Restores the last face, so that its neighbours keep the midpoints of their edges.
    corners = [fine.faces[28][0], fine.faces[29][1], fine.faces[30][2]]
    chart = [fine.charts[28][0], fine.charts[29][1], fine.charts[30][2]]
    fine.faces[28:], fine.charts[28:] = [tuple(corners)], [tuple(chart)]
    yield Case('hanging_vertex.obj', fine.write(), 'continuity',
               'an edge is cut on one side only', 'grid')
    fine = Refined(square_grid())
    del fine.faces[3], fine.charts[3]
    yield Case('hole_in_a_face.obj', fine.write(), 'coverage',
               'the middle piece of a cut face is missing', 'grid')
    fine = Refined(square_grid())
    fine.faces.append(fine.faces[3])
    fine.charts.append(fine.charts[3])
    yield Case('piece_twice.obj', fine.write(), 'coverage', 'one piece of a face is there twice',
               'grid')
    fine = Refined(fan())
    x, y, z = fine.positions[7]
    fine.positions[7] = x, y, z + 1
    yield Case('piece_off_its_face.obj', fine.write(), 'coverage',
               'a new vertex does not lie on the surface', 'fan')
    positions, faces, texture = plate()[1]
    positions[4], positions[5] = positions[5], positions[4]
    yield Case('folded_in_space.obj', obj_bytes(positions, faces, texture, faces), 'orientation',
               'two new vertices are swapped: pieces of a flat part lie over each other', 'plate')
    fine = Refined(fan())
    new = len(fine.texture)
    fine.texture.append(tuple(c * 17 / 16 for c in fine.texture[fine.charts[0][1]]))
    fine.charts[0] = (fine.charts[0][0], new, fine.charts[0][2])
    yield Case('torn_at_a_new_vertex.obj', fine.write(), 'continuity',
               'a vertex on a cut edge is mapped to two places', 'fan')


def unreadable():
    data = obj_of(square_grid())
    yield Case('face_without_vt.obj', data[:-1].rsplit(b'\n', 1)[0] + b'\nf 1 2 3\n', 'unreadable',
               'a face has no texture coordinates')
    yield Case('index_out_of_range.obj', data + b'f 1/1 2/2 3/99\n', 'unreadable',
               'a face names a vt that is not there')
    yield Case('infinite.obj', data.replace(b'vt 1 1', b'vt 1e400 1'), 'unreadable',
               'a coordinate beyond all doubles')


def cases():
    for group in (polygons, triangles, refined, unreadable):
        yield from group()
