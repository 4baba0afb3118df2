# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""The kinds of valid files of check_campaign.py, and of files near the limits. Every function of KINDS takes
a random generator and returns a Case with its truth. This module is imported, not run.
"""
import math
import struct
from fractions import Fraction

import campaign_maps as maps
from exact import orientation
from small_maps import Refined, VtuText, from_polynomials

VALID, INVALID, UNREADABLE = 'valid', 'invalid', 'unreadable'
DIFFERS = 'differs'  # the decimals of an OBJ and the doubles that readers make of them have different truths


class Case:
    """A file and how it is judged.

    data, extension; truth: a word above, or None if the Python checker decides
    surface: bytes of an OBJ or None; cuts: 'none', 'free' or None; seamless, certify: options claims: those
    of the file, or None; unseen: the verdict expected of the Python checker if the truth is about claims,
    which it does not read
    """

    def __init__(self, made, data, extension, truth, **flags):
        self.data, self.extension, self.truth = data, extension, truth
        self.surface, self.cuts, self.seamless, self.certify = None, None, False, False
        self.claims = made.claims if extension == '.vtu' else None
        self.is_closed, self.degree, self.faces = made.is_closed, made.degree, len(made.uv)
        self.unseen = None
        self.__dict__.update(flags)

    def seamless_at_all(self):
        """Returns whether seams are permitted, by an option or by a claim of the file."""
        return self.seamless or bool(self.claims and self.claims.get('seams'))

    def cut_rule(self):
        """Returns the option of the checker, which reads no claims, for the default --cuts auto."""
        speaks = self.claims and ('version' in self.claims or self.claims.get('seams'))
        return self.cuts or ('none' if speaks or self.seamless else 'free')  # required seams must fit


def write(made, rng, truth=VALID, extension=None, as_polygons=False, **flags):
    """Returns a file of the map in a random format."""
    forced = made.degree > 1 or made.weights or flags.get('unseen') or made.claims
    extension = extension or ('.vtu' if forced else rng.choice(('.vtu', '.obj')))
    if extension == '.obj':
        return Case(made, made.obj(as_polygons), extension, truth, **flags)
    return Case(made, made.vtu(rng.choice(('binary', 'binary', 'ascii', 'raw'))), extension, truth,
                **flags)


def strict(made, rng):
    """Returns options for which an edge with different sides is a violation."""
    return {'cuts': 'none', 'surface': rng.choice((None, made.mesh, made.mesh))}


# ------------------------------------------------------------------ good maps
def size_of(rng):
    """Returns a random number of faces: usually up to 200, in one of twelve cases up to 2,500."""
    return round(math.exp(rng.uniform(0, math.log(200)))) if rng.random() < 0.92 \
        else rng.randrange(200, 2500)


def shape(rng, least=1):
    """Returns (n, m) with about size_of / 2 squares, n * m >= least."""
    squares = max(least, size_of(rng) // 2, 1)
    n = max(1, round(math.sqrt(squares) * math.exp(rng.uniform(-0.5, 0.5))))
    return n, max(1, squares // n, -(-least // n))


def bent(made, rng):
    """Applies a little noise and a smooth bijection of the plane; the truth stays."""
    maps.noise(made, rng, rng.choice((0, 0.05, 0.12)))
    made.apply(maps.shears(rng, max(1.0, made.size()), rng.choice((0.1, 0.25))))
    made.apply(maps.similarity(rng))
    return made


def degree_of(rng):
    return rng.choice((1, 2, 3, 4))


def disk(rng, degree=None):
    is_polygonal = rng.random() < 0.3
    return bent(maps.grid(*shape(rng), degree or degree_of(rng), rng, False, is_polygonal), rng)


def holed(rng, degree=None):
    """Returns an annulus, or a disk with holes."""
    degree = degree or degree_of(rng)
    n, m = shape(rng, 9)
    if rng.random() < 0.5:
        return bent(maps.ring(max(6, n), max(1, m * n // max(6, n)), degree, rng), rng)
    return bent(maps.grid(max(3, n), max(3, m), degree, rng, holes=True), rng)


def closed(rng, degree=None):
    """Returns a seamless map of a cube, an open box or a torus."""
    degree = degree or degree_of(rng)
    if rng.random() < 0.5:
        n = max(1, round(math.sqrt(size_of(rng) / 12)))
        made = maps.cube(n, degree, rng, rng.choice((6, 6, 5)))
        maps.noise(made, rng, 0.12)
    else:
        n, m = shape(rng, 9)
        n, m = max(3, n), max(3, m)
        made = maps.torus(n, m, degree, rng)
        maps.noise(made, rng, 0.12, (n, m))
    made.apply(maps.similarity(rng))
    return made


def base(rng, degree=None):
    """Returns (map, options): the map is valid under the strictest cut rule with these options."""
    kind = rng.randrange(4)
    if kind < 2:
        return (disk, holed)[kind](rng, degree), {}
    return (holed(rng, degree), {}) if kind == 2 else (closed(rng, degree), {'seamless': True})


def smooth(rng):
    made = disk(rng)
    truly_claimed(made, rng)
    return write(made, rng, certify=True, **strict(made, rng))


def with_holes(rng):
    made = holed(rng)
    truly_claimed(made, rng)
    return write(made, rng, certify=True, **strict(made, rng))


def truly_claimed(made, rng, **more):
    if rng.random() < 0.5:
        made.claims = {'version': '0.1.0', 'degree': made.degree, 'boundary': 'free', **more}


def seamless(rng):
    made = closed(rng)
    truly_claimed(made, rng, seams=True)
    return write(made, rng, seamless=made.claims is None or rng.random() < 0.5,
                 certify=rng.random() < 0.5, **strict(made, rng))


def cut_freely(rng):
    """Returns charts: a closed map without its seams, or a disk in distant parts."""
    if rng.random() < 0.5:
        made = closed(rng)
    else:
        made = (disk if rng.random() < 0.5 else holed)(rng)
        move_part(made, rng)
    return write(made, rng, None if rng.random() < 0.3 else VALID, cuts='free',
                 surface=rng.choice((None, made.mesh)))


def move_part(made, rng):
    """Moves the last cells elsewhere."""
    first = rng.randrange(1, len(made.uv)) if len(made.uv) > 1 else 0
    made.shift(range(first, len(made.uv)), (2 * made.size(), 0))


def polygons(rng):
    made = bent(maps.grid(*shape(rng), 1, rng, rng.random() < 0.3, True), rng)
    return write(made, rng, as_polygons=True, certify=True, **strict(made, rng))


def tessellated(rng):
    made = maps.grid(*shape(rng), 1, rng)
    made.surface = made.positions, made.polygons
    fine = Refined(made) if len(made.uv) <= 200 else None
    if fine is None:
        return write(made, rng, certify=True, **strict(made, rng))
    bend = maps.shears(rng, max(1.0, made.size()), 0.1)
    fine.texture = [bend(float(x), float(y)) for x, y in fine.texture]
    return Case(made, fine.write(), '.obj', VALID, faces=len(fine.faces), certify=True,
                **strict(made, rng))


# ------------------------------------------------------------------ near the limits
def moved(rng):
    """Moves random control points; some maps stay valid."""
    made, options = base(rng)
    # A control point is moved in all of its cells, so that the map stays continuous.
    reach = made.size() / math.sqrt(len(made.uv)) / made.degree * math.exp(rng.uniform(-4, 0.5))
    points = sorted({p for uv in made.uv for p in uv})
    some = set(rng.sample(points, min(len(points), rng.choice((1, 3, 30)))))
    step = {p: (rng.uniform(-reach, reach), rng.uniform(-reach, reach)) for p in some}
    made.apply(lambda x, y: (x + step[x, y][0], y + step[x, y][1]) if (x, y) in step else (x, y))
    return write(made, rng, None, **options, **strict(made, rng))


def steps(value, count):
    """Returns the double that is `count` units in the last place away."""
    for _ in range(abs(count)):
        value = math.nextafter(value, math.inf if count > 0 else -math.inf)
    return value


def by_one_ulp(rng):
    """Puts a corner up to two units in the last place from the line through two others: det J is zero or
    almost zero."""
    a, b = [(rng.uniform(-1, 1), rng.uniform(-1, 1)) for _ in 'ab']
    if rng.random() < 0.3:
        a, b = [(round(64 * x) / 64, round(64 * y) / 64) for x, y in (a, b)]
    t = rng.choice((0.5, 0.25, rng.random(), -rng.random(), 1 + rng.random()))
    c = (steps(a[0] + t * (b[0] - a[0]), rng.randrange(-2, 3)),
         steps(a[1] + t * (b[1] - a[1]), rng.randrange(-2, 3)))
    degree = rng.choice((1, 1, 1, 2, 3, 4))
    made = maps.Map([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)], degree, [[a, b, c]])
    if rng.random() < 0.7:
        made = maps.several([made, (holed if rng.random() < 0.5 else disk)(rng, degree)])
    if degree > 1:  # control points between the corners are rounded as well
        return write(made, rng, None)
    if rng.random() < 0.4:
        return write(made, rng, VALID if orientation(a, b, c) > 0 else INVALID, '.vtu')
    return write(made, rng, truth_of_obj([a, b, c]), '.obj')


def truth_of_obj(points):
    """Returns the truth for a triangle's decimals and for its doubles; DIFFERS if they are not equal."""
    a, b, c = [(Fraction(repr(x)), Fraction(repr(y))) for x, y in points]
    written = (b[0] - a[0]) * (c[1] - a[1]) > (b[1] - a[1]) * (c[0] - a[0])
    if written != (orientation(*points) > 0):
        return DIFFERS
    return VALID if written else INVALID


def near_zero_inside(rng):
    """Returns a cell with det J / 36 = (b - 1/2)^2 + (c - 1/4)^2 + eps, whose minimum is at an inner point."""
    eps = rng.choice((-1, 0, 1, 1)) * Fraction(1, 2 ** rng.randrange(4, 40))
    y = {(2, 1): 3, (1, 1): -3, (0, 1): Fraction(15, 16) + 3 * eps, (0, 2): Fraction(-3, 4),
         (0, 3): 1}
    small = from_polynomials({(1, 0): 12}, y, rng.choice((3, 4)))
    small.is_closed = False
    return Case(small, VtuText().write(small), '.vtu', VALID if eps > 0 else INVALID)


def contacts(rng):
    """Returns two rectangles side by side: separate, touching at an edge or a corner, or overlapping."""
    degree = degree_of(rng)
    parts = [maps.grid(*[rng.randrange(1, 8) for _ in 'nm'], degree, rng, rng.random() < 0.3)
             for _ in 'ab']
    for part in parts:
        maps.noise(part, rng, 0.1)
    width = max(x for uv in parts[0].uv for x, _ in uv)
    height = max(y for uv in parts[0].uv for _, y in uv)
    ulp = math.ulp(width)
    gap = rng.choice((0, 0, ulp, 2 * ulp, -ulp, -2 * ulp, 2 ** -20, -2 ** -20, 0.25, -0.25))
    up = rng.choice((0, height / 2, height))
    parts[1].apply(lambda x, y: (x + width + gap, y + up))
    made = maps.several(parts)
    return write(made, rng, contact_truth(gap), certify=True, **strict(made, rng))


def contact_truth(gap):
    return VALID if gap > 0 else INVALID


def nested(rng):
    """Returns a chart in the hole of another one, or on it; boundaries do not meet."""
    degree, is_valid = degree_of(rng), rng.random() < 0.5
    outer = maps.ring(rng.randrange(12, 40), rng.randrange(1, 5), degree, rng)
    inner = maps.grid(rng.randrange(1, 6), rng.randrange(1, 6), degree, rng)
    maps.noise(outer, rng, 0.1)
    maps.noise(inner, rng, 0.1)
    scale = 1 / inner.size()
    away = 0 if is_valid else max(x for uv in outer.uv for x, _ in uv) - 0.9
    inner.apply(lambda x, y: (scale * (x / 2) + away, scale * (y / 2)))
    made = maps.several([outer, inner])
    made.apply(maps.similarity(rng))
    return write(made, rng, VALID if is_valid else INVALID, certify=True, **strict(made, rng))


def near_curves(rng):
    """Returns a curved edge whose lowest point is `gap` above a straight one."""
    gap = rng.choice((0, 1, 1, -1)) * 3 * 2.0 ** -rng.randrange(4, 40)
    degree = rng.choice((2, 3, 4))
    edge = {2: (1, -1 + 2 * gap, 1), 3: (3, -1 + 4 * gap / 3, -1 + 4 * gap / 3, 3),
            4: (3, 0, 8 * gap / 3 - 1, 0, 3)}[degree]
    span = [12 * (k / degree - 0.5) for k in range(degree + 1)]
    top = maps.Map([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)], degree,
                   [[(span[0], edge[0]), (span[-1], edge[-1]), (0.0, 60.0)]])
    for k, place in enumerate(top.row(0, 0)):
        top.set(0, place, (span[k], edge[k]))
    low = maps.Map([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)], degree,
                   [[(24.0, 0.0), (-24.0, 0.0), (0.0, -24.0)]])
    made = maps.several([top, low])
    return write(made, rng, contact_truth(gap), certify=True)


def ribbons(rng):
    """Returns a spiral of up to two turns, with or without overlap."""
    per_turn, turns = rng.randrange(10, 60), rng.choice((0.7, 0.9, 1.2, 1.6))
    pitch = rng.choice((0, 0.3, 1.4))
    count = max(2, round(per_turn * turns))

    def place(k, r):
        angle, radius = 2 * math.pi * k / per_turn, 2 + r + pitch * k / per_turn
        return radius * math.cos(angle), radius * math.sin(angle)
    faces, places = [], []
    for k in range(count):
        corners = [(k, 0), (k, 1), (k + 1, 1), (k + 1, 0)]
        for part in ((0, 1, 2), (0, 2, 3)):
            faces.append(tuple(2 * corners[i][0] + corners[i][1] for i in part))
            places.append([place(*corners[i]) for i in part])
    positions = [(k // 2, -(k % 2), 0) for k in range(2 * count + 2)]
    made = maps.Map(positions, faces, degree_of(rng), places)
    made.apply(maps.similarity(rng))
    is_valid = count < per_turn or pitch > 1.3
    if is_valid or rng.random() < 0.7:
        return write(made, rng, VALID if is_valid else INVALID, certify=True, **strict(made, rng))
    made.claims = {'version': '0.1.0', 'bijective': True}
    return write(made, rng, INVALID, '.vtu', certify=False, unseen='ok')


def ring_ends(rng):
    """Returns a square ring whose end comes near its start, touches it, or overlaps it."""
    t = rng.randrange(8, 56) / 64
    gap = rng.choice((0, 0, 1, -1, 2, -2))
    y = rng.choice((steps(t, gap), t + gap / 64, t + gap * 2.0 ** -30))
    pairs = [((1, 1), (0, 0)), ((3, 1), (4, 0)), ((3, 3), (4, 4)), ((1, 3), (0, 4)),
             ((t, y), (-1, 1))]
    scale, quarters = 2.0 ** rng.randrange(-20, 20), rng.randrange(4)
    places = [tuple(scale * float(c) for c in p) for pair in pairs for p in pair]
    for _ in range(quarters):
        places = [(-v, u) for u, v in places]
    faces = []
    for k in range(0, len(places) - 2, 2):
        faces += [(k + 3, k + 2, k), (k + 1, k + 3, k)]
    positions = [(k // 2, -(k % 2), 0) for k in range(len(places))]
    made = maps.Map(positions, faces, rng.choice((1, 1, 2, 4)),
                    [[places[v] for v in face] for face in faces])
    exact = made.degree == 1 or y == round(y * 64) / 64
    return write(made, rng, contact_truth(y - t) if exact else None, certify=True)


def fans(rng):
    """Returns a fan that winds once or twice around an inner vertex."""
    turns = rng.choice((1, 2))
    count = rng.randrange(4 * turns, 40 * turns)
    jitter = [rng.uniform(-0.3, 0.3) for _ in range(count)]

    def rim(k, times):
        angle = 2 * math.pi * times * (k % count + jitter[k % count]) / count
        return math.cos(angle), math.sin(angle)
    positions = [(0, 0, 1)] + [(*rim(k, 1), 0) for k in range(count)]
    faces = [(0, 1 + k, 1 + (k + 1) % count) for k in range(count)]
    places = [[(0.0, 0.0), rim(k, turns), rim(k + 1, turns)] for k in range(count)]
    made = maps.Map(positions, faces, degree_of(rng), places)
    made.apply(maps.similarity(rng))
    return write(made, rng, VALID if turns == 1 else INVALID, **strict(made, rng))


def rounded(rng):
    """Returns a map with uv of single precision, or far from the origin."""
    made, options = base(rng)
    if rng.random() < 0.5:
        far = made.size() * 2.0 ** rng.randrange(20, 54)
        made.apply(lambda x, y: (x + far, y - far))
        return write(made, rng, None, **options)
    made.apply(lambda x, y: struct.unpack('2f', struct.pack('2f', x, y)))
    return Case(made, made.vtu('binary', 'Float32'), '.vtu', None, **options)


KINDS = {
    'smooth maps of disks': (300, smooth), 'annuli, holes': (250, with_holes),
    'closed, seamless': (250, seamless), 'charts, cut freely': (200, cut_freely),
    'polygons': (150, polygons), 'tessellated': (100, tessellated),
    'rounded': (120, rounded), 'control points moved': (400, moved),
    'det J off zero by ulps': (300, by_one_ulp), 'det J near zero inside': (80, near_zero_inside),
    'charts apart, touching, over': (250, contacts),
    'ring ends apart, touching, over': (150, ring_ends),
    'curves near each other': (100, near_curves), 'ribbons': (150, ribbons),
    'fans around once, twice': (120, fans), 'charts inside each other': (80, nested)}
