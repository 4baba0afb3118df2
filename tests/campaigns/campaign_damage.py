# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Damages maps and claims for check_campaign.py.

A damage is a function of a valid map, which it changes, a random generator, and the options under which the
map is valid. It returns the truth, or None if the Python checker decides, and the options for which the truth
holds. This module is imported, not run.
"""
import math

import campaign_maps as maps
from campaign_kinds import INVALID, UNREADABLE, VALID, base, steps, strict, write


def tear(made, rng, options):
    """Moves one side of an inner edge by one ulp or more; if seams are allowed, by more than their tolerance."""
    cell, side, _, _ = rng.choice(made.inner_edges())
    place = rng.choice(made.row(cell, side))
    x, y = made.uv[cell][place]
    if not options.get('seamless') and rng.random() < 0.4:
        made.set(cell, place, (steps(x, rng.choice((-1, 1))), y))
    else:
        reach = made.size() * 10.0 ** -rng.choice((2, 4, 6))
        made.set(cell, place, (x + reach, y + rng.uniform(-reach, reach)))
    return INVALID, strict(made, rng)


def torn(rng):
    made, options = base(rng)
    truth, more = tear(made, rng, options)
    if not options and rng.random() < 0.3:
        return write(made, rng, None, cuts='free')
    return write(made, rng, truth, **options, **more)


def mirror(made, rng, options):
    method = rng.randrange(4)
    if method == 0:
        made.apply(lambda x, y: (-x, y))
        return INVALID, {}
    cells = [rng.randrange(len(made.uv))] if method == 1 else range(len(made.uv))
    for cell in cells:
        made.turn(cell, (0, 2, 1))
        made.uv[cell] = [(-x, y) for x, y in made.uv[cell]]
    return (VALID, {}) if method == 3 else (INVALID, {'surface': made.mesh})


def double(made, rng, options):
    """Removes cells, duplicates them, or adds cells that belong to no face."""
    method, count = rng.randrange(4), len(made.uv)
    cell = rng.randrange(count)
    if method == 0 and count > 1:
        made.keep([c for c in range(count) if c != cell])
        return INVALID, {'surface': made.mesh}
    if method == 1:
        made.keep(list(range(count)) + [cell])
        if rng.random() < 0.5:
            made.shift([count], (2 * made.size(), 0))
        return INVALID, {'surface': made.mesh, 'cuts': rng.choice((None, 'free'))}
    if method == 2 and len(made.positions) > 3:
        corners = list(made.corners[cell])
        others = [v for v in range(len(made.positions)) if v not in corners]
        corners[rng.randrange(3)] = rng.choice(others)
        made.corners[cell] = tuple(corners)
        return INVALID, {'surface': made.mesh, 'cuts': rng.choice((None, 'free'))}
    other = (cell + 1) % count
    made.corners[other], made.uv[other] = made.corners[cell], list(made.uv[cell])
    made.shift([other], (2 * made.size(), 0))
    return INVALID, {'surface': made.mesh, 'cuts': rng.choice((None, 'free'))}


def shift(made, rng, options):
    """Moves parts in the plane or in space, or renumbers corners, vertices or faces."""
    method = rng.randrange(5)
    cell = rng.randrange(len(made.uv))
    if method == 0:
        at = rng.choice(made.inner_edges())[0]
        step = made.size() * rng.choice((2, 1e-3))
        made.shift([at], (step, 0))
        if options.get('seamless'):  # a translation is allowed for seams
            return None, strict(made, rng)
        return INVALID, strict(made, rng)
    if method == 1:
        at = rng.choice(made.inner_edges())[0]
        corners = made.corners[at]
        made.turn(at, (1, 2, 0))
        made.corners[at] = corners
        return (None if options.get('seamless') else INVALID), strict(made, rng)
    vertex = made.corners[cell][0]
    if method == 2:
        made.positions = list(made.positions)
        x, y, z = made.positions[vertex]
        made.positions[vertex] = x, y, z + 10.0 ** rng.randrange(-4, 2) * math.dist(
            *[[f(c) for c in zip(*made.positions)] for f in (min, max)])
        return INVALID, {'surface': made.mesh}
    if method == 3:
        made.input_face = made.input_face[1:] + made.input_face[:1]
        return INVALID, {'surface': made.mesh, 'extension': '.vtu', 'unseen': 'ok'}
    other = made.corners[cell][1]
    made.numbers = {vertex: other, other: vertex}
    return INVALID, {'surface': made.mesh, 'extension': '.vtu'}


def bulge(made, rng, options):
    """Moves a control point far away, in the plane or in space."""
    cell, place = rng.randrange(len(made.uv)), rng.randrange(len(made.uv[0]))
    if made.degree > 1 and rng.random() < 0.4:
        place = rng.randrange(3, len(made.uv[0]))
        x, y, z = maps.between([made.positions[v] for v in made.corners[cell]], made.degree)[place]
        made.moved[cell, place] = x, y, z + 1e-2
        return INVALID, {}
    x, y = made.uv[cell][place]
    step = made.size()
    made.apply(lambda u, v: (u + step, v + 0.7 * step) if (u, v) == (x, y) else (u, v))
    return None, {}


def rationalize(made, rng, options):
    weights = [[1.0] * len(uv) for uv in made.uv]
    made.weights = weights
    if rng.random() < 0.3:
        return VALID, {}
    weights[rng.randrange(len(weights))][rng.randrange(len(weights[0]))] = \
        rng.choice((0.5, 2.0, -1.0, steps(1.0, 1), 0.0))
    return UNREADABLE, {}


def damaged(*damages):
    """Returns the kind that damages valid maps in one of these ways."""
    def make(rng):
        made, options = base(rng)
        truth, more = rng.choice(damages)(made, rng, options)
        if truth is None or truth == VALID:
            more = {**strict(made, rng), **more} if truth is None else {'cuts': 'none', **more}
        return write(made, rng, truth, **{**options, **more})
    return make


# ------------------------------------------------------------------ claims
WIDENING = {'normalized': {'origin': [0, -1e17], 'size': 1e-17}, 'other_triangles': True,
            'seams': True, 'bijective': True, 'version': '0.1.0', 'boundary': 'free'}
WRONG_TYPES = [{'degree': 'three'}, {'degree': 1e300}, {'seams': 'yes'}, {'bijective': 1},
               {'pins': 5}, {'cones': [{}]}, {'normalized': {'origin': [0], 'size': 1}}]


def claims(rng):
    """Returns a file with claims that are wrong, would excuse a damage, or have no effect."""
    made, options = base(rng)
    made.claims = {'version': '0.1.0', 'degree': made.degree}
    made.claims.update({'seams': True} if options else {})
    method = rng.randrange(7)
    if method == 0:
        made.claims['energy'] = rng.choice(('none', 'no such energy', ''))
        return write(made, rng, INVALID, unseen='ok', **options)
    if method == 1:
        made.claims['degree'] = made.degree + rng.choice((1, 3))
        return write(made, rng, INVALID, unseen='ok', **options)
    if method == 2:
        vertex = rng.choice(made.corners)[0]
        made.claims.update(rng.choice((
            {'pins': [{'vertex': vertex, 'target': [1e9, 0]}]},
            {'cones': [{'vertex': vertex, 'quarter_turns': 9}]},
            {'value': 1e300, 'normalized': {'origin': [0, 0], 'size': 1e300}})))
        return write(made, rng, INVALID, unseen='ok', **options)
    if method == 3:
        made.claims.update(rng.choice(WRONG_TYPES))
        return write(made, rng, UNREADABLE, unseen='ok', **options)
    if method == 4 and not options:
        made.claims['boundary'] = 'fixed'
        if rng.random() < 0.5:
            tear(made, rng, options)
            return write(made, rng, INVALID, '.vtu', cuts='none')
        return write(made, rng, INVALID, unseen='ok')
    if method == 5:
        made.claims.update({'tool': [1, {'x': None}], 'init': None, 'colour': 'red'})
        return write(made, rng, VALID, **options)
    truth, more = rng.choice((tear, double, bulge))(made, rng, {'seamless': True})
    chosen = rng.sample(sorted(WIDENING), 3)
    made.claims.update({key: WIDENING[key] for key in chosen})
    if truth is None:  # the checker decides about the map; no claim may excuse it
        made.claims = {'version': '0.1.0', 'seams': bool(options), 'other_triangles': True}
    more['seamless'] = bool(made.claims.get('seams'))
    return write(made, rng, truth, extension='.vtu', **more)


def lie(made, rng, options):
    """Falsifies one of the claims that the program makes about its result."""
    claims = made.claims
    method = rng.choice(('value', 'degree', 'pins', 'normalized', 'cones', 'boundary', 'cuts'))
    if method == 'normalized' and claims.get('normalized'):
        claims['normalized']['size'] *= rng.choice((0.5, 2))
    elif method == 'cones':
        cones = claims.setdefault('cones', [])
        cones += [{'vertex': made.corners[0][0], 'quarter_turns': 4}] if not cones else []
        rng.choice(cones)['quarter_turns'] += rng.choice((1, 4))
    elif method == 'boundary' and claims['boundary'] == 'free' and not claims['seams']:
        claims['boundary'] = 'fixed'
    elif method == 'cuts' and claims.get('cuts'):
        claims['cuts'].pop(rng.randrange(len(claims['cuts'])))
    elif method == 'degree':
        claims['degree'] += rng.choice((1, 2))
    elif method == 'pins':
        claims['pins'].append({'vertex': rng.choice(made.corners)[0], 'target': [1e9, 0]})
    else:
        claims['value'] *= rng.choice((0.99, 1.01, 1.001))
    return INVALID, {'unseen': 'ok'}


KINDS = {
    'torn': (300, torn), 'mirrored': (150, damaged(mirror)),
    'doubled, missing': (200, damaged(double)), 'shifted': (250, damaged(shift)),
    'control point far off': (120, damaged(bulge)), 'rational': (100, damaged(rationalize)),
    'wrong claims': (250, claims)}
