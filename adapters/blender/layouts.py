# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays of meshes to UV layouts, by majorant. Knows nothing of Blender, and runs on any thread."""
import dataclasses
import math
import os
import re
import tempfile
from fractions import Fraction

import numpy as np

# A square for packed islands beside pinned ones is no smaller than this part of the unit square's side.
MIN_FREE_SIDE = 0.05
# Layouts that are made again because Blender would not draw polygons as majorant has them.
MOST_REPAIRS = 2
# Pins of a vertex that are no farther apart are one, as in Blender's UV editor.
PIN_DISTANCE = 1e-4
# Offenders that are named in a message.
MOST_NAMES = 3


class Refusal(Exception):
    """The request is impossible. The message states the reason and a remedy."""


@dataclasses.dataclass
class Options:
    """seams: 'AUTO', 'MARKED', 'SHARP' (from sharp_angle degrees on) or 'UV', the borders of the active UV map.
    keep_marked: marked seams are cuts beside those of AUTO and SHARP. join: edges at equal positions are one edge, where
    nothing else is cut. scale: distances are those of the world. together: all objects share one square."""
    seams: str = 'AUTO'
    sharp_angle: float = 40.0
    keep_marked: bool = True
    join: bool = True
    hold_pins: bool = True
    preset: str = 'NONE'
    max_stretch: float = 0.0
    charts: int = 0
    padding: float = 4.0
    resolution: int = 1024
    scale: bool = True
    together: bool = True
    time_limit: float = 0.0


@dataclasses.dataclass
class Layout:
    """uvs of the loops of each part, (#L, 2) float32, and what is to be said of them."""
    uvs: list
    charts: int = 0
    stretch: float = 1.0
    warnings: list = dataclasses.field(default_factory=list)


@dataclasses.dataclass
class Surface:
    """Parts as one mesh. V (#V, 3); corners (#L,) rows of V by loop; starts: where the loops of each polygon begin;
    part_starts, part_faces: where the loops and polygons of each part begin."""
    parts: list
    V: np.ndarray
    corners: np.ndarray
    starts: np.ndarray
    part_starts: np.ndarray
    part_faces: np.ndarray
    triangles: np.ndarray
    triangle_faces: np.ndarray

    @property
    def loop_faces(self):
        return np.repeat(np.arange(len(self.starts) - 1), np.diff(self.starts))

    @property
    def polygons(self):
        return polygons_of(self.corners, self.starts)

    def by_part(self, values):
        return np.split(values, self.part_starts[1:-1])

    def name_of(self, face):
        """The object and the number of a polygon."""
        part = int(np.searchsorted(self.part_faces, face, 'right')) - 1
        return f'{self.parts[part].name}: face {self.parts[part].faces[face - self.part_faces[part]]}'


# ---- unwrap --------------------------------------------------------------------------------------
def unwrap(majorant, parts, options, callback=None):
    """Returns a Layout of the parts. Throws Refusal and majorant.Error."""
    groups = [parts] if options.together else [[part] for part in parts]
    layouts = [_unwrap_group(majorant, group, options, callback) for group in groups]
    return _joined(layouts)


def _unwrap_group(majorant, parts, options, callback):
    rows, is_split = [], False
    pinned = options.hold_pins and any(part.pinned is not None and part.pinned.any() for part in parts)
    for part in parts:
        cuts = _cut_edges(part, options)
        if options.seams == 'UV':
            rows.append(rows_by_uv(part))
            is_split = True
        elif cuts.any() or options.seams == 'MARKED' or pinned:
            rows.append(rows_by_sector(part, cuts))
            is_split = True
        else:
            rows.append(part.corners)
    surface = surface_of(parts, rows, options.scale)
    pins, factor = (_pins(surface) if pinned else ({}, 1.0))
    surface.V *= factor
    keywords = _keywords(options, is_split, pins)
    made = majorant.unwrap(surface.V, surface.polygons, callback=callback, **keywords)
    layout = loop_uvs(made, surface, surface.corners)
    bad = unusable_polygons(layout, surface)
    for _ in range(MOST_REPAIRS):
        if bad.any():
            made, layout = _remade(majorant, surface, layout, bad, pins, options, callback)
            bad = unusable_polygons(layout, surface)
    return _finished(surface, layout, made, bad, pins)


def _cut_edges(part, options):
    is_kept = options.seams == 'MARKED' or (options.keep_marked and options.seams != 'UV')
    return part.seam_edges if is_kept else np.zeros_like(part.seam_edges)


def _keywords(options, is_split, pins):
    chooses = options.seams in ('AUTO', 'SHARP')
    seams = {'AUTO': 'auto', 'SHARP': f'sharp={options.sharp_angle:g}'}.get(options.seams, np.zeros((0, 2), int))
    keywords = {'seams': seams, 'weld': 'auto' if options.join and not is_split else 'no', 'padding': options.padding,
                'resolution': options.resolution}
    if options.time_limit > 0:
        keywords['time_limit'] = options.time_limit
    if pins:
        keywords['pins'] = pins
    if not chooses:
        return keywords
    if options.preset != 'NONE':
        keywords['preset'] = options.preset.lower()
        del keywords['padding'], keywords['resolution']
    if pins:  # charts have the scale of the pinned ones
        keywords['fill'] = 0
    if options.max_stretch > 1:
        keywords['max_stretch'] = options.max_stretch
    if options.charts > 0:
        keywords['charts'] = options.charts
        keywords.pop('fill', None)
    if keywords.get('preset') == 'single':
        keywords.pop('fill', None)
    return keywords


def _remade(majorant, surface, layout, bad, pins, options, callback):
    """The layout with the same cuts along edges, in which bad polygons are the triangles that Blender draws.

    Blender cuts a polygon into triangles by its shape in space. Where its image is not convex, triangles of another
    subdivision may be turned over though the polygon is not. A cut along a diagonal of a polygon has no place in a mesh of
    Blender: such a polygon stays with the chart of its first triangle.
    """
    corner = np.concatenate([surface.V[surface.corners], layout.uv], axis=1)
    rows = unique_rows(*corner.T)
    V = np.zeros((rows.max() + 1, 3))
    V[rows] = surface.V[surface.corners]
    loops = rows[surface.triangles[bad[surface.triangle_faces]]]
    kept = np.flatnonzero(~bad)
    polygons = [rows[surface.starts[k]:surface.starts[k + 1]] for k in kept] + list(loops)
    face_of_row = np.concatenate([kept, surface.triangle_faces[bad[surface.triangle_faces]]])
    keywords = {'seams': np.zeros((0, 2), int), 'weld': 'no', 'padding': options.padding, 'resolution': options.resolution}
    if pins:
        first = {int(vertex): int(row) for vertex, row in zip(surface.corners[::-1], rows[::-1])}
        keywords['pins'] = {first[vertex]: place for vertex, place in pins.items()}
    made = majorant.unwrap(V, polygons, callback=callback, **keywords)
    again = loop_uvs(made, surface, rows, face_of_row)
    again.defect = again.defect or layout.defect
    return made, again


def _pins(surface):
    """{row of V: place} and uv units per unit of V, so that charts have the scale of what is pinned."""
    uv = np.concatenate([_or_zero(part.uv, len(part.loops), 2) for part in surface.parts]).astype(float)
    is_pinned = np.concatenate([_or_zero(part.pinned, len(part.loops), 1) for part in surface.parts]).astype(bool)
    pins = {}
    for loop in np.flatnonzero(is_pinned).tolist():
        row, place = int(surface.corners[loop]), (uv[loop, 0], uv[loop, 1])
        if np.abs(np.subtract(pins.setdefault(row, place), place)).max() > PIN_DISTANCE:
            raise Refusal(f'{surface.name_of(surface.loop_faces[loop])}: a vertex is pinned at two places, where no seam '
                          'is; mark a seam there, unpin it, or choose the borders of the UV map as seams')
    triangles = surface.triangles
    p = surface.V[surface.corners[triangles]]
    area = np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1).sum()
    image = abs(doubled_areas(uv[triangles])).sum()
    factor = math.sqrt(image / area) if area > 0 and image > 0 else 0.0
    if factor == 0.0:
        box = surface.V[surface.corners]
        factor = 1 / max(np.ptp(box, axis=0).max(), np.finfo(float).tiny)
    return pins, factor


def _or_zero(values, count, width):
    """Zeros in place of None."""
    return values if values is not None else np.zeros((count, width) if width > 1 else count, np.float32)


def _finished(surface, layout, made, bad, pins):
    result = (made.report or {}).get('result', {})
    warnings = []
    if layout.defect:
        warnings.append('not proven in single precision: ' + layout.defect)
    if layout.turned.any():
        warnings.append(f'{_count(layout.turned, "face")} against its neighbours, in the layout too '
                        f'({_names(surface, layout.turned)}); recalculate the normals')
    if bad.any():
        warnings.append(f'{int(bad.sum())} polygons are drawn with a triangle turned over, or divided '
                        f'({_names(surface, bad)}); triangulate them')
    if layout.missing.any():
        warnings.append(f'{int(layout.missing.sum())} corners have no place')
    if not made.status == 'converged':
        warnings.append(made.message)
    if pins and (layout.uv.min() < 0 or layout.uv.max() > 1):
        warnings.append('charts leave the unit square: they have the scale of the pinned ones, and lie around them')
    return Layout(surface.by_part(layout.uv), int(result.get('charts', 0)), float(result.get('stretch_l2') or 1), warnings)


def _count(mask, noun):
    n = int(mask.sum())
    return f'1 {noun} is turned' if n == 1 else f'{n} {noun}s are turned'


def _names(surface, mask):
    faces = np.flatnonzero(mask)
    return ', '.join(surface.name_of(k) for k in faces[:MOST_NAMES]) + (', ...' if len(faces) > MOST_NAMES else '')


def _joined(layouts):
    return Layout([uv for layout in layouts for uv in layout.uvs], sum(layout.charts for layout in layouts),
                  max(layout.stretch for layout in layouts), [line for layout in layouts for line in layout.warnings])


# ---- pack ----------------------------------------------------------------------------------------
def pack(majorant, parts, options, callback=None):
    """Returns a Layout with the same islands, moved and turned. Islands with pinned uvs stay."""
    for part in parts:
        if part.uv is None:
            raise Refusal(f'{part.name}: has no UV map; unwrap it first')
    groups = [parts] if options.together else [[part] for part in parts]
    return _joined([_pack_group(majorant, group, options, callback) for group in groups])


def _pack_group(majorant, parts, options, callback):
    surface = surface_of(parts, [rows_by_uv(part) for part in parts], options.scale)
    old = np.concatenate([part.uv for part in parts])
    stays = np.zeros(len(surface.starts) - 1, bool)
    if options.hold_pins:
        held = np.concatenate([part.pinned for part in parts])
        stays = _islands_with(surface, held)
    if stays.all():
        raise Refusal('all islands are pinned; unpin those that shall be packed')
    moves = ~stays[surface.loop_faces]
    corners, starts = _without(surface, stays)
    uv = np.zeros((len(surface.V), 2))
    uv[surface.corners] = old
    used, corners = np.unique(corners, return_inverse=True)
    keywords = {'time_limit': options.time_limit} if options.time_limit > 0 else {}
    try:
        made = majorant.unwrap(surface.V[used], polygons_of(corners, starts), uv=uv[used], seams='uv', keep_shape=True, weld='no',
                               padding=options.padding, resolution=options.resolution, callback=callback, **keywords)
    except majorant.Error as error:
        raise type(error)(_with_names(str(error), surface, np.flatnonzero(~stays))) from error
    full = np.full(len(surface.corners), -1)
    full[moves] = corners
    layout = loop_uvs(made, surface, full, np.flatnonzero(~stays))
    new = old.copy()
    new[moves] = layout.uv[moves]
    warnings = ['not proven in single precision: ' + layout.defect] if layout.defect else []
    if stays.any():
        origin, side = free_square(old[~moves])
        new[moves] = (origin + side * new[moves].astype(float)).astype(np.float32)
        if side < 1:
            warnings.append(f'islands are {side:.2f} times as large as without those that are pinned')
    result = (made.report or {}).get('result', {})
    return Layout(surface.by_part(new), int(result.get('charts', 0)), 1.0, warnings)


def free_square(uv):
    """Returns a free square beside the islands that stay: its lower left corner and its side. It is the largest one
    beside their box in the unit square, or the next tile."""
    low, high = np.clip(uv.min(0), 0, 1).astype(float), np.clip(uv.max(0), 0, 1).astype(float)
    if (uv.max(0) <= 0).any() or (uv.min(0) >= 1).any():
        return np.zeros(2), 1.0
    choices = [(1 - high[0], (high[0], 0)), (low[0], (0, 0)), (1 - high[1], (0, high[1])), (low[1], (0, 0))]
    side, origin = max(choices, key=lambda choice: choice[0])
    if side < MIN_FREE_SIDE:
        return np.array([math.ceil(max(float(uv[:, 0].max()), 1.0)), 0.0]), 1.0
    return np.array(origin, float), float(side)


def _islands_with(surface, held):
    """Polygons of islands that have such a loop."""
    faces = len(surface.starts) - 1
    labels = components(faces + len(surface.V), surface.loop_faces, faces + surface.corners)
    return np.isin(labels[:faces], np.unique(labels[surface.loop_faces[held]]))


def _without(surface, left_out):
    keeps = ~left_out[surface.loop_faces]
    sizes = np.diff(surface.starts)[~left_out]
    return surface.corners[keeps], np.concatenate([[0], np.cumsum(sizes)])


def _with_names(message, surface, faces):
    """The message with faces as Blender counts them."""
    name = lambda found: surface.name_of(faces[int(found[1])]) if int(found[1]) < len(faces) else found[0]
    return re.sub(r'\bface (\d+)', name, message)


# ---- check ---------------------------------------------------------------------------------------
@dataclasses.dataclass
class Verdict:
    """The findings of `check`. status: 'valid', 'invalid' or 'undecided'. bad: (#F,) of each part, faces that are turned over,
    have no area or overlap."""
    status: str
    lines: list
    bad: list
    stretch: float
    charts: int


def check(majorant, parts, options, callback=None):
    """The verdict of majorant on the active UV maps, as they are: on the triangles that Blender draws."""
    for part in parts:
        if part.uv is None:
            raise Refusal(f'{part.name}: has no UV map; unwrap it first')
    groups = [parts] if options.together else [[part] for part in parts]
    verdicts = [_check_group(majorant, group, options) for group in groups]
    order = ('valid', 'undecided', 'invalid')
    return Verdict(max((v.status for v in verdicts), key=order.index), [line for v in verdicts for line in v.lines],
                   [bad for v in verdicts for bad in v.bad], max(v.stretch for v in verdicts),
                   sum(v.charts for v in verdicts))


def _check_group(majorant, parts, options):
    surface = surface_of(parts, [rows_by_uv(part) for part in parts], options.scale)
    uv = np.concatenate([part.uv for part in parts])
    faces = len(surface.starts) - 1
    turned = np.zeros(faces, bool)
    turned[surface.triangle_faces[signs(uv[surface.triangles]) <= 0]] = True
    overlapping = np.zeros(faces, bool)
    lines = []
    if turned.any():
        lines.append(f'{_count(turned, "face")} over or without area in the layout ({_names(surface, turned)})')
    outside = (uv < 0).any() or (uv > 1).any()
    if not np.isfinite(uv).all():
        return Verdict('invalid', ['uvs are not finite'], _split_faces(surface, turned), 1.0, 0)
    verdict = _verdict_of_file(majorant, surface, uv, options)
    contacts = (verdict.report['result'].get('boundary') or {}).get('contacts', [])
    if not turned.any():  # their neighbours cross them, too
        overlapping[surface.loop_faces[_loops_of_edges(surface, [edge for contact in contacts for edge in contact['edges']])]] = True
    if overlapping.any():
        lines.append(f'{int(overlapping.sum())} faces at borders that cross ({_names(surface, overlapping)})')
    lines += [finding for finding in verdict.findings if not (turned.any() and 'not all cells are positive' in finding)]
    if outside:
        lines.append('uvs leave the unit square')
    result = verdict.report['result']
    stretch = (result.get('distortion') or {}).get('stretch_l2') or 1.0
    return Verdict(verdict.status, lines, _split_faces(surface, turned | overlapping), float(stretch),
                   int((result.get('cuts') or {}).get('charts') or 0))


def _loops_of_edges(surface, edges):
    """Loops at both ends of border edges, which are pairs of vertices of the file."""
    following = np.arange(len(surface.corners)) + 1
    following[surface.starts[1:] - 1] = surface.starts[:-1]
    a, b = surface.corners, surface.corners[following]
    chosen = {tuple(sorted(edge)) for edge in edges}
    return [k for k, edge in enumerate(zip(np.minimum(a, b).tolist(), np.maximum(a, b).tolist())) if edge in chosen]


def _split_faces(surface, mask):
    return np.split(mask, surface.part_faces[1:-1])


def _verdict_of_file(majorant, surface, uv, options):
    """majorant judges files: an OBJ of the triangles, with digits that give the same floats."""
    lines = ['v %.17g %.17g %.17g' % tuple(row) for row in surface.V.tolist()]
    place = np.zeros((len(surface.V), 2), np.float32)
    place[surface.corners] = uv
    lines += ['vt %.9g %.9g' % tuple(row) for row in place.tolist()]
    lines += ['f %d/%d %d/%d %d/%d' % (a, a, b, b, c, c) for a, b, c in (surface.corners[surface.triangles] + 1).tolist()]
    with tempfile.TemporaryDirectory(prefix='majorant_') as folder:
        path = os.path.join(folder, 'layout.obj')
        with open(path, 'w') as file:
            file.write('\n'.join(lines) + '\n')
        limit = options.time_limit if options.time_limit > 0 else None
        return majorant.check(path, cuts='free', certify=True, time_limit=limit)


# ---- quads ---------------------------------------------------------------------------------------
@dataclasses.dataclass
class Quads:
    """V (#V, 3) in local coordinates, Q (#Q, 4), and for each quad the row of the part's faces that is nearest."""
    V: np.ndarray
    Q: np.ndarray
    faces: np.ndarray
    irregular: int
    warnings: list


def quads(majorant, part, options, count, features, feature_angle, callback=None):
    """A mesh of quads of one part. features: 'ANGLE', 'SHARP' (edges that are marked so) or 'NONE'."""
    surface = surface_of([part], [part.corners], options.scale)
    keywords = {'time_limit': options.time_limit} if options.time_limit > 0 else {}
    if features == 'NONE':
        keywords['features'] = 'none'
    elif features == 'ANGLE':
        keywords['features'] = feature_angle
    else:
        row = np.full(len(part.positions), -1)
        row[part.corners] = surface.corners
        edges = row[part.edges[part.sharp_edges]]
        keywords['features'] = edges[(edges >= 0).all(1)]
        if not len(keywords['features']):
            keywords['features'] = 'none'
    made = majorant.quad_mesh(surface.V, surface.polygons, count=count, callback=callback, **keywords)
    V, Q = np.array(made.V), np.array(made.Q)
    triangles = surface.corners[surface.triangles]
    nearest = majorant.SurfaceTree(surface.V, triangles).nearest(V[Q].mean(1)).face
    local = surface_to_local(V, part, options.scale)
    result = made.report['result']['quads']
    return Quads(local, Q, surface.triangle_faces[nearest], int(result['irregular']), [line.lstrip(': ') for line in made.report.get('warnings', [])])


def surface_to_local(V, part, scale):
    """Local coordinates of points of the surface of one part."""
    linear = part.linear if scale else np.eye(3)
    return V @ np.linalg.inv(linear).T + _middle(part)


# ---- bake ----------------------------------------------------------------------------------------
@dataclasses.dataclass
class Source:
    """The source of a bake: the part that carries it, the layout of its images (#L, 2), the images and the number of each face's;
    or an attribute, 'normal' or 'position'."""
    part: object
    uv: np.ndarray = None
    images: list = dataclasses.field(default_factory=list)
    image_of_face: np.ndarray = None
    attribute: str = ''


def bake(majorant, target, source, size, padding, distance, time_limit):
    """The image in the active layout of the target, and texels that nothing was found for. In one mesh its faces are their
    own places; between two meshes places are the nearest in the world."""
    if target.uv is None:
        raise Refusal(f'{target.name}: has no UV map; unwrap it first')
    is_same = source.part.data == target.data
    middle = _middle(target)
    places = lambda part: part.positions[part.corners] - middle if is_same else part.in_world() - target.in_world().mean(0)
    rows = unique_rows(target.corners)
    V = np.zeros((rows.max() + 1, 3))
    V[rows] = places(target)
    keywords = {'size': size, 'padding': padding}
    if time_limit > 0:
        keywords['time_limit'] = time_limit
    if not is_same:
        used, inverse = np.unique(source.part.corners, return_inverse=True)
        from_V = np.zeros((len(used), 3))
        from_V[inverse] = places(source.part)
        keywords.update(from_V=from_V, from_F=inverse[source.part.triangles])
        if distance > 0:
            keywords['distance'] = distance
    if source.attribute:
        keywords['attribute'] = source.attribute
    else:
        keywords.update(from_uv=source.uv[source.part.triangles].astype(float), images=source.images,
                        image_of_face=source.image_of_face[source.part.triangle_faces])
    baked = majorant.bake(V, rows[target.triangles], target.uv[target.triangles].astype(float), **keywords)
    return baked.image, int(baked.report['result']['bake']['misses'])


# ---- surfaces ------------------------------------------------------------------------------------
def surface_of(parts, rows, scale):
    """The parts as one mesh; rows: by part and loop, numbers of vertices, which have one place each. Every part has its
    own middle at the origin; several ones stand beside each other, so that edges of two never coincide."""
    all_V, corners, triangles, triangle_faces, sizes = [], [], [], [], []
    loops, faces, vertices, place = [0], [0], 0, 0.0
    for part, row in zip(parts, rows):
        used, inverse = np.unique(row, return_inverse=True)
        V = np.zeros((len(used), 3))
        V[inverse] = part.positions[part.corners] - _middle(part)
        V = V @ (part.linear if scale else np.eye(3)).T
        if len(parts) > 1:
            V -= V.min(0)
            V[:, 0] += place
            place += 2.0 ** math.ceil(math.log2(2 * max(float(np.ptp(V, axis=0).max()), 1e-30)))
        all_V.append(V)
        corners.append(inverse + vertices)
        triangles.append(part.triangles + loops[-1])
        triangle_faces.append(part.triangle_faces + faces[-1])
        sizes.append(np.diff(part.starts))
        vertices += len(used)
        loops.append(loops[-1] + len(part.loops))
        faces.append(faces[-1] + len(part.faces))
    return Surface(parts, np.concatenate(all_V), np.concatenate(corners),
                   np.concatenate([[0], np.cumsum(np.concatenate(sizes))]).astype(int), np.array(loops), np.array(faces),
                   np.concatenate(triangles), np.concatenate(triangle_faces))


def _middle(part):
    used = part.positions[part.corners]
    return (used.min(0) + used.max(0)) / 2


def polygons_of(corners, starts):
    """Returns the polygons in the form of majorant's F."""
    sizes = np.diff(starts)
    if (sizes == sizes[0]).all():
        return corners.reshape(-1, sizes[0])
    return np.split(corners, starts[1:-1])


def rows_by_uv(part):
    """A number for each loop; equal where vertex and uv are."""
    bits = np.ascontiguousarray(part.uv + np.float32(0)).view(np.int32)  # -0 is 0
    return unique_rows(part.corners, bits[:, 0], bits[:, 1])


def rows_by_sector(part, cut):
    """A number for each loop; equal for those loops of a vertex whose faces hang together there by edges that are not
    cut. cut: (#E,)."""
    count = len(part.loops)
    following = np.arange(count) + 1
    following[part.starts[1:] - 1] = part.starts[:-1]
    order = np.argsort(part.next_edges, kind='stable')
    edge = part.next_edges[order]
    pair = (edge[1:] == edge[:-1]) & ~cut[edge[1:]]
    one, two = order[:-1][pair], order[1:][pair]
    same = part.corners[one] == part.corners[two]
    a = np.concatenate([one, following[one]])
    b = np.concatenate([np.where(same, two, following[two]), np.where(same, following[two], two)])
    return components(count, a, b)


def components(count, a, b):
    """The smallest number that each of count things hangs together with; a[k] hangs together with b[k]."""
    label = np.arange(count)
    while True:
        least = np.minimum(label[a], label[b])
        before = label.copy()
        np.minimum.at(label, label[a], least)
        np.minimum.at(label, label[b], least)
        np.minimum.at(label, a, least)
        np.minimum.at(label, b, least)
        while True:
            shorter = label[label]
            if (shorter == label).all():
                break
            label = shorter
        if (label == before).all():
            return label


def unique_rows(*columns):
    """A number for each row of some columns, from 0, equal for equal rows."""
    order = np.lexsort(columns)
    new = np.zeros(len(order), bool)
    for column in columns:
        ordered = np.asarray(column)[order]
        new[1:] |= ordered[1:] != ordered[:-1]
    numbers = np.empty(len(order), int)
    numbers[order] = np.cumsum(new)
    return numbers


# ---- layouts of loops ----------------------------------------------------------------------------
@dataclasses.dataclass
class LoopLayout:
    """uv (#L, 2) float32; missing (#L,): loops without a place; divided (#F,): polygons with a corner at two places, cut
    along a diagonal; turned (#F,): polygons that majorant turned; defect: what is not proven of these floats."""
    uv: np.ndarray
    divided: np.ndarray
    missing: np.ndarray
    turned: np.ndarray
    defect: str


def loop_uvs(made, surface, rows, face_of_row=None):
    """The uvs of a map at the loops. rows: the vertex of the map's mesh at each loop, -1: none; face_of_row: polygons that
    the faces of its mesh are parts of."""
    floats, defect = made._in_floats()
    face = np.asarray(floats.input_faces)
    if face_of_row is not None:
        face = face_of_row[face]
    vertex = np.asarray(floats.faces)
    stride = int(max(rows.max(), vertex.max())) + 1
    key = surface.loop_faces * stride + rows
    key[rows < 0] = -1 - np.flatnonzero(rows < 0)
    order = np.argsort(key, kind='stable')
    keys = face[:, None] * stride + vertex
    found = order[np.minimum(np.searchsorted(key[order], keys), len(key) - 1)]
    matches = key[found] == keys
    uv = np.zeros((len(rows), 2), np.float32)
    has = np.zeros(len(rows), bool)
    loop, place = found[matches][::-1], np.asarray(floats.corner_uv)[matches].astype(np.float32)[::-1]
    uv[loop] = place  # of several places that of the first triangle stays
    has[loop] = True
    divided = np.zeros(len(surface.starts) - 1, bool)
    divided[surface.loop_faces[loop[(uv[loop] != place).any(1)]]] = True
    sizes = np.diff(surface.starts)[face]
    along = (found - found[:, :1]) % sizes[:, None]
    turned = np.zeros(len(surface.starts) - 1, bool)
    turned[face[matches.all(1) & (along[:, 1] > along[:, 2])]] = True
    return LoopLayout(uv, divided, ~has & (rows >= 0), turned, defect)


def unusable_polygons(layout, surface):
    """(#F,): polygons that are divided, or have a triangle, as Blender draws them, that is turned over or has no area,
    unless majorant turned the whole polygon."""
    sign = signs(layout.uv[surface.triangles])
    sign[layout.turned[surface.triangle_faces]] *= -1
    bad = layout.divided.copy()
    bad[surface.triangle_faces[sign <= 0]] = True
    return bad


def doubled_areas(corners):
    """(#T, 3, 2) to twice the signed areas."""
    a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]


def signs(corners):
    """The signs of the areas of triangles of floats, exactly."""
    corners = np.asarray(corners, float)
    area = doubled_areas(corners)
    size = np.abs(corners).max((1, 2), initial=0.0)
    sign = np.sign(area).astype(int)
    for k in np.flatnonzero(np.isfinite(area) & (np.abs(area) <= 1e-14 * size * size)):
        (ax, ay), (bx, by), (cx, cy) = [[Fraction(x) for x in point] for point in corners[k].tolist()]
        exact = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
        sign[k] = (exact > 0) - (exact < 0)
    sign[~np.isfinite(area)] = 0
    return sign
