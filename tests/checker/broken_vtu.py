# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the broken VTU files (see `make_broken_files.py`); each function makes one kind of damage."""
import math
from fractions import Fraction as F

from small_maps import (SmallMap, VtuText, bent, cube, fan, from_polynomials, pieces, square_grid,
                        straight, strip)

TEXT = VtuText()


class Case:
    """A file of the collection. data: its bytes; word: the word of the finding ('' for good files); why: the
    reason as text; surface: the name of its mesh ('' if none is needed); options: those of check_map.py."""

    def __init__(self, name, data, word, why, surface='', options=()):
        self.name, self.data, self.word, self.why = name, data, word, why
        self.surface, self.options = surface, list(options)


def torn():
    for degree in (1, 3):
        small = fan(degree, bent)
        x, y = small.uv[0][1]
        small.set(0, 1, (x + 0.05, y - 0.1))
        yield Case('torn_spoke_%d.vtu' % degree, TEXT.write(small), 'continuity',
                   'a fan torn at the outer end of one spoke', 'fan')
    small = square_grid(1)
    x, y = small.uv[0][2]
    small.set(0, 2, (math.nextafter(x, 2), y))
    yield Case('torn_by_one_ulp_1.vtu', TEXT.write(small), 'continuity',
               'the middle vertex differs by one unit in the last place in one cell', 'grid')
    small = square_grid(3, bent)
    x, y = small.uv[0][5]
    small.set(0, 5, (x, math.nextafter(y, -1)))
    yield Case('torn_edge_by_one_ulp_3.vtu', TEXT.write(small), 'continuity',
               'an edge\'s inner control point differs by one ulp: corners agree', 'grid')
    small = square_grid(2, bent)
    x, y = small.uv[0][4]
    small.set(0, 4, (x + 0.02, y))
    yield Case('torn_lens_2.vtu', TEXT.write(small), 'continuity',
               'one edge bulges on one side only', 'grid')
    small = square_grid(4, bent)
    small.shift([6, 7], (2, 0))
    yield Case('torn_island_4.vtu', TEXT.write(small), 'continuity',
               'two cells lie elsewhere as a chart of their own', 'grid')


def turned():
    for degree in (1, 4):
        small = square_grid(degree, bent if degree > 1 else straight)
        small.turn(3, (0, 2, 1))
        small.uv[3] = [(-x, y) for x, y in small.uv[3]]
        yield Case('mirrored_cell_%d.vtu' % degree, TEXT.write(small), 'orientation',
                   'one cell is the mirror image of its face, and mapped positively', 'grid')
    small = square_grid(2, bent)
    for cell in range(len(small.uv)):
        small.turn(cell, (1, 0, 2))
        small.uv[cell] = [(-x, y) for x, y in small.uv[cell]]
    yield Case('mirrored_map_2.vtu', TEXT.write(small), 'orientation',
               'the whole map is a mirror image: continuous, positive, upside down', 'grid')
    small = square_grid(2, bent)
    small.uv = [[(-x, y) for x, y in uv] for uv in small.uv]
    yield Case('negative_map_2.vtu', TEXT.write(small), 'positivity',
               'every determinant is negative')
    small = square_grid(1)
    small.uv[4] = small.uv[4][1:] + small.uv[4][:1]
    yield Case('shifted_corners_1.vtu', TEXT.write(small), 'continuity',
               'the plane corners of one cell are shifted by one', 'grid')
    small = square_grid(3, bent)
    corners = small.corners[1]
    small.turn(1, (1, 2, 0))
    small.corners[1] = corners
    yield Case('shifted_corners_3.vtu', TEXT.write(small), 'continuity',
               'a cubic cell is turned by one corner against its face', 'grid')


def covered():
    small = square_grid(1, n=1)
    small.corners[1] = small.corners[0]
    small.uv[1] = [(x + 2, y) for x, y in small.uv[0]]
    yield Case('half_of_a_quad_twice_1.vtu', TEXT.write(small), 'coverage',
               'one half of a quad is mapped twice, the other not at all', 'quad')
    for degree in (1, 3):
        small = square_grid(degree)
        small.keep([0, 1, 2, 4, 5, 6, 7])
        yield Case('missing_face_%d.vtu' % degree, TEXT.write(small), 'coverage',
                   'one face of the surface has no cell', 'grid')
    small = square_grid(1)
    small.keep([0, 1, 2, 3, 4, 5, 6, 7, 3])
    yield Case('doubled_cell_1.vtu', TEXT.write(small), 'coverage', 'one cell is there twice',
               'grid')
    small = square_grid(2, bent)
    small.keep([0, 1, 2, 3, 4, 5, 6, 7, 0])
    small.shift([8], (3, 0))
    yield Case('doubled_cell_elsewhere_2.vtu', TEXT.write(small), 'coverage',
               'one face is mapped to two places', 'grid')
    small = square_grid(1)
    small.corners[0] = (0, 1, 8)
    yield Case('foreign_cell_1.vtu', TEXT.write(small), 'coverage',
               'the corners of one cell belong to no one face', 'grid')
    small = square_grid(1)
    yield Case('swapped_numbers_1.vtu', TEXT.write(small, numbers={4: 5, 5: 4}), 'vertices',
               'input_vertex of two vertices is swapped', 'grid')
    small = square_grid(2, bent)
    place = tuple(float(x) for x in small.surface[0][4])
    moved = {(c, k): (place[0], place[1], place[2] + 0.125)
             for c, corners in enumerate(small.corners) for k, v in enumerate(corners) if v == 4}
    yield Case('moved_in_space_2.vtu', TEXT.write(small, positions=moved), 'vertices',
               'the middle vertex does not lie where the surface has it', 'grid')
    small = square_grid(2, bent)
    yield Case('not_flat_2.vtu', TEXT.write(small, positions={(1, 4): (0.5, 0.25, 0.25)}),
               'flatness', 'a control point in space is off its flat triangle')


def not_positive():
    small = square_grid(1)
    small.move(4, (0.5, 0))
    yield Case('zero_area_1.vtu', TEXT.write(small), 'positivity',
               'the middle vertex moved onto an edge: one area is exactly zero')
    small = pieces([[(0, 0), (1, 1), (0.5, 0.5)]])
    small.set(0, 2, (0.5, math.nextafter(0.5, 0)))
    yield Case('below_zero_by_one_ulp_1.vtu', TEXT.write(small), 'positivity',
               'a corner lies one ulp beyond the line through the others')
    small = fan(2)
    x, y = small.uv[0][1]
    small.set(0, 5, (x / 4, y / 4))
    small.set(1, 3, (x / 4, y / 4))
    yield Case('zero_at_a_corner_2.vtu', TEXT.write(small), 'positivity',
               'the tangents at a corner are parallel: det J = 0 there only')
    small = pieces([[(0, 0), (1, 0), (0, 1)]], 2)
    small.set(0, 3, (0.5, 0.75))
    yield Case('negative_on_an_edge_2.vtu', TEXT.write(small), 'positivity',
               'an edge bulges beyond the cell')
    # det J / 36 = (b - 1/2)^2 + (c - 1/4)^2 + eps
    for name, degree, eps, why in (
            ('zero_inside_3.vtu', 3, F(0), 'det J = 0 at one inner point, positive elsewhere'),
            ('negative_inside_4.vtu', 4, -F(1, 1024), 'det J < 0 in a small disk inside only')):
        y = {(2, 1): 3, (1, 1): -3, (0, 1): F(3, 4) + F(3, 16) + 3 * eps, (0, 2): F(-3, 4),
             (0, 3): 1}
        yield Case(name, TEXT.write(from_polynomials({(1, 0): 12}, y, degree)), 'positivity', why)
    small = fan(3, bent)
    x, y = small.uv[2][9]
    small.set(2, 9, (x + 4, y))
    yield Case('inner_point_far_3.vtu', TEXT.write(small), 'positivity',
               'the inner control point of one cell lies far away')
    small = pieces([[(0, 0), (4, 0), (0, 4)]], 2)
    for place, point in ((3, (2, 1)), (4, (1, 1.25)), (5, (0.75, 2))):
        small.set(0, place, point)
    yield Case('positive_control_net_2.vtu', TEXT.write(small), 'positivity',
               'edges curve in; the corners and the chord triangle are positive')


def wound():
    turns = [(4, 1), (-1, 4), (-4, -1), (1, -4), (4, 0), (-1, 3), (-3, -1), (2, -3)]
    for degree in (1, 2):
        small = SmallMap(*octagon(), degree, ([(0, 0)] + turns, straight))
        yield Case('fan_winds_twice_%d.vtu' % degree, TEXT.write(small), 'angles',
                   'eight positive cells wind twice around their centre', 'octagon')


def octagon():
    """Returns positions and faces of eight triangles around vertex 0."""
    corners = [(4, 1), (1, 4), (-1, 4), (-4, 1), (-4, -1), (-1, -4), (1, -4), (4, -1)]
    return ([(0, 0, 1)] + [(x, y, 0) for x, y in corners],
            [(0, 1 + k, 1 + (k + 1) % 8) for k in range(8)])


# A square ring as pairs (inner, outer), counterclockwise from the lower left, not closed.
RING = [((1, 1), (0, 0)), ((3, 1), (4, 0)), ((3, 3), (4, 4)), ((1, 3), (0, 4))]


def overlapping():
    more = ['--overlap']
    for degree in (1, 3):
        small = strip(RING + [((1.25, 0.75), (-0.5, 0.5)), ((2, 0.5), (2, -1))], degree)
        yield Case('more_than_a_turn_%d.vtu' % degree, TEXT.write(small), 'overlap',
                   'a ribbon of more than one turn lies over its own start', '', more)
    for degree in (1, 2):
        small = pieces([[(0, 0), (8, 0), (0, 8)], [(1, 1), (2, 1), (1, 2)]], degree)
        yield Case('nested_%d.vtu' % degree, TEXT.write(small), 'overlap',
                   'a chart lies inside of another one; boundaries do not meet', '', more)
    small = strip(RING + [((0.625, math.nextafter(0.625, 0)), (-1, 1))])
    yield Case('crossing_by_one_ulp_1.vtu', TEXT.write(small), 'overlap',
               'the end of a ribbon reaches one ulp over its start', '', more)
    small = strip(RING + [((0.625, 0.625), (-1, 1))])
    yield Case('touching_end_1.vtu', TEXT.write(small), 'touching',
               'the end of a ribbon touches its start in one point', '', more)
    small = pieces([[(0, 0), (4, 0), (0, 4)], [(0, -0.5), (2, -2), (4, -0.5)]], 2)
    small.set(0, 3, (2, -1.25))
    yield Case('curves_cross_2.vtu', TEXT.write(small), 'overlap',
               'two charts whose corners are apart: a curved edge bulges into the other', '', more)


def claiming():
    small = square_grid(1)
    small.move(4, (0.5, -0.0625))
    small.claims = {'degree': 1, 'normalized': {'origin': [0, -1e17], 'size': 1e-17}}
    yield Case('claims_normalized_1.vtu', TEXT.write(small), 'positivity',
               'negative; a claim of another origin and size would round that away')
    small = square_grid(1)
    small.keep([0, 0, 2, 3, 4, 5, 6, 7])
    small.claims = {'degree': 1, 'other_triangles': True}
    yield Case('claims_other_triangles_1.vtu', TEXT.write(small), 'coverage',
               'one face twice, one not at all, under a claim of flipped edges', 'grid')
    small = fan(1, bent)
    x, y = small.uv[0][1]
    small.set(0, 1, (x + 0.05, y - 0.1))
    small.claims = {'degree': 1, 'seams': True, 'cones': []}
    yield Case('claims_seams_1.vtu', TEXT.write(small), 'continuity',
               'a tear under a claim of seams, which does not fit by quarter turns', 'fan',
               ['--seamless'])


def bad_seams():
    seamless = ['--seamless']
    for degree, step, name, why in (
            (1, (1e-6, 0), 'seam_off_by_1e-6_1.vtu', 'a corner at a seam is off by 1e-6'),
            (2, (0, 0.0625), 'seam_off_2.vtu', 'a corner at a seam is off by 1/16')):
        small = cube(degree)
        x, y = small.uv[0][0]
        small.set(0, 0, (x + step[0], y + step[1]))
        small.set(1, 0, small.uv[0][0])
        yield Case(name, TEXT.write(small), 'continuity', why, 'cube', seamless)
    small = cube(1)
    for cell in (4, 5):
        small.uv[cell] = [(2 * x, 2 * y) for x, y in small.uv[cell]]
    yield Case('seam_of_two_sizes_1.vtu', TEXT.write(small), 'continuity',
               'one side of the cube is twice as large as the others', 'cube', seamless)
    small = cube(1)
    for cell in (6, 7):
        small.uv[cell] = [(0.6 * x - 0.8 * y, 0.8 * x + 0.6 * y) for x, y in small.uv[cell]]
    yield Case('seam_of_53_degrees_1.vtu', TEXT.write(small), 'continuity',
               'one side is rotated by no quarter turn', 'cube', seamless)
    small = cube(3)
    x, y = small.uv[0][3]
    small.set(0, 3, (x, y - 1e-4))
    yield Case('seam_bulges_3.vtu', TEXT.write(small), 'continuity',
               'a control point between the ends of a seam is off by 1e-4', 'cube', seamless)


def unreadable():
    small = square_grid(2, bent)
    weights = [[1.0] * 6 for _ in small.uv]
    weights[3][4] = -5.0
    yield Case('rational_weights_2.vtu', TEXT.write(small, weights=weights), 'unreadable',
               'one weight is -5: the cells are rational')
    data = TEXT.write(fan(3), weights=[[1.0] * 3 + [0.5] * 7] * 6)
    data = data.replace(b'<PointData>', b'<PointData RationalWeights="w">')
    data = data.replace(b'"RationalWeights" Num', b'"w" Num')
    yield Case('rational_by_attribute_3.vtu', data, 'unreadable',
               'weights that differ, under another name')
    data = VtuText('binary').write(square_grid(1))
    yield Case('truncated_1.vtu', data[:len(data) * 2 // 3], 'unreadable', 'the file is cut off')
    data = TEXT.write(square_grid(1))
    yield Case('short_array_1.vtu', data.replace(b'0.5 0.5', b'0.5', 1), 'unreadable',
               'an array lacks a number')
    small = square_grid(1)
    small.set(5, 1, (float('nan'), 0))
    yield Case('not_a_number_1.vtu', TEXT.write(small), 'unreadable', 'a coordinate is nan')
    yield Case('mixed_cells_1.vtu', TEXT.write(square_grid(1), types=[5] * 7 + [69]),
               'unreadable', 'cells of two types')


def cases():
    for group in (torn, turned, covered, not_positive, wound, overlapping, claiming, bad_seams,
                  unreadable):
        yield from group()
