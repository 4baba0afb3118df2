# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Makes valid files that look unusual or are close to an invalid one (see `make_broken_files.py`)."""
import math
from fractions import Fraction as F

from broken_vtu import RING, TEXT, Case
from small_maps import (Refined, VtuText, bent, cube, fan, from_polynomials, obj_bytes, obj_of,
                        pieces, plate, square_grid, strip)


def good(name, data, why, surface='', options=()):
    return Case(name, data, '', why, surface, options)


def encodings():
    for degree in (1, 2, 3, 4):
        bend = {'bend': bent} if degree > 1 else {}
        yield good('grid_%d.vtu' % degree, VtuText('binary').write(square_grid(degree, **bend)),
                   'a map of degree %d, base64' % degree, 'grid', ['--overlap'])
    small = fan(3, bent)
    yield good('appended_raw_3.vtu', VtuText('raw', 'UInt32').write(small),
               'appended raw data, 32-bit sizes', 'fan', ['--overlap'])
    yield good('appended_base64_3.vtu', VtuText('base64').write(small),
               'appended base64, 64-bit sizes', 'fan')
    yield good('float32_2.vtu', VtuText('binary', real='Float32').write(fan(2)),
               'single precision', 'fan')
    yield good('nothing_shared_3.vtu', VtuText(share=False).write(square_grid(3, bent)),
               'every cell has its own points, with equal values', 'grid', ['--overlap'])
    yield good('without_numbers_2.vtu', TEXT.write(fan(2, bent), numbers={}),
               'no input_vertex: vertices are found by place', 'fan')
    yield good('equal_weights_2.vtu', TEXT.write(fan(2), weights=[[0.5] * 6] * 6),
               'rational weights that are all equal', 'fan')
    small = square_grid(1)
    small.claims = {'degree': 3, 'energy': 'none', 'seams': True,
                    'normalized': {'origin': [1e9, 0], 'size': 1e-9}}
    yield good('wrong_claims_1.vtu', TEXT.write(small), 'a good map under senseless claims',
               'grid', ['--overlap'])


def narrow():
    small = pieces([[(0, 0), (1, 1), (0.5, 0.5)]])
    small.set(0, 2, (0.5, math.nextafter(0.5, 1)))
    yield good('positive_by_one_ulp_1.vtu', TEXT.write(small), 'an area of one ulp')
    y = {(2, 1): 3, (1, 1): -3, (0, 1): F(15, 16) + F(3, 1024), (0, 2): F(-3, 4), (0, 3): 1}
    yield good('positive_valley_3.vtu', TEXT.write(from_polynomials({(1, 0): 12}, y, 3)),
               'det J falls to a thousandth of its size inside, and stays positive')
    small = strip(RING + [((0.625, math.nextafter(0.625, 1)), (-1, 1))])
    yield good('apart_by_one_ulp_1.vtu', TEXT.write(small),
               'the end of a ribbon is one ulp away from its start', '', ['--overlap'])
    small = pieces([[(0, 0), (4, 0), (0, 4)], [(0, -0.5), (2, -2), (4, -0.5)]], 2)
    small.set(1, 5, (2, -0.0625))
    yield good('curves_apart_2.vtu', TEXT.write(small), 'two curved charts, close to each other',
               '', ['--overlap'])
    ring = strip(RING + RING[:1])
    yield good('chart_in_a_hole_1.vtu', TEXT.write(_closed(ring)),
               'a ring with a chart in its hole', '', ['--overlap'])


def _closed(ring):
    """Returns a strip that is joined to its start, with a triangle in its hole."""
    last = len(ring.surface[0]) - 2
    glue = {last: 0, last + 1: 1}
    ring.corners = [tuple(glue.get(v, v) for v in corners) for corners in ring.corners]
    ring.surface[0][last] = (20, 0, 0)
    ring.surface[0][last + 1] = (21, 0, 0)
    ring.surface[0].append((20, 1, 0))
    ring.corners.append((last, last + 1, last + 2))
    ring.input_face.append(len(ring.input_face))
    ring.uv.append([(1.5, 1.5), (2.5, 1.5), (2.0, 2.5)])
    return ring


def seams():
    for degree in (1, 2):
        yield good('cube_%d.vtu' % degree, TEXT.write(cube(degree)), 'seams that fit', 'cube',
                   ['--seamless', '--overlap'])
    yield good('cube_cut_1.vtu', TEXT.write(cube(1)), 'the same, cut freely', 'cube',
               ['--cuts', 'free', '--overlap'])
    small = square_grid(2, bent)
    small.shift([6, 7], (3, 1))
    yield good('cut_off_2.vtu', TEXT.write(small), 'a chart of its own, cuts allowed', 'grid',
               ['--cuts', 'free', '--overlap'])


def texture():
    yield good('grid.obj', obj_of(square_grid()), 'plain', 'grid', ['--overlap'])
    yield good('cube.obj', obj_of(cube()), 'texture seams', 'cube', ['--seamless', '--overlap'])
    fine = Refined(square_grid())
    yield good('refined.obj', fine.write(), 'every face cut into four', 'grid', ['--overlap'])
    fine = Refined(fan())
    yield good('refined_fan.obj', fine.write(), 'the same, no two faces in one plane', 'fan')
    positions, faces, texture = plate()[1]
    yield good('cut_otherwise.obj', obj_bytes(positions, faces, texture, faces),
               'a flat part cut along other edges than the surface has', 'plate', ['--overlap'])
    small = square_grid(polygons=True, n=1)
    data = obj_bytes(small.surface[0], [(0, 1, 3, 2)], [(0, 0), (1, 0), (0.25, 0.25), (0, 1)],
                     [(0, 1, 2, 3)])
    yield good('reflex_quad.obj', data, 'a quad that is not convex in the plane', 'quad',
               ['--overlap'])
    data = obj_bytes(small.surface[0], [], [(0, 0), (1, 0), (1, 1), (0, 1)])
    data += b'# negative numbers, CRLF\r\nf -4/-4 -3/-3 -1/-2 -2/-1\r\n'
    yield good('negative_indices.obj', data, 'negative indices, a comment, CRLF', 'quad')
    hexagon = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]  # an L shape
    data = obj_bytes([(x, y, 0) for x, y in hexagon], [range(6)], hexagon, [range(6)])
    yield good('polygon.obj', data, 'an L with six corners', '', ['--overlap'])


def cases():
    for group in (encodings, narrow, seams, texture):
        yield from group()
