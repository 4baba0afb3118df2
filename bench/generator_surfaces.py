#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""majorant.xatlas beside xatlas on 50 meshes as generators of shapes make them, of 5,000 to 500,000 faces, by seeds.

    npm install watlas@1.0.1

Each mesh is the level set of blobs and noise on a grid, in single precision. 36 are made by marching cubes, some with
defects of exporters: vertices that no face uses, holes, or coordinates of few digits, which give faces without an
area. 14 (28 %) are not manifold. 10 of these are dual surfaces, with a vertex for each cell and two triangles for each
crossed edge of the grid. 4 are surfaces of solids, which touch at edges of four faces. 6 are of walls thinner than a
cell, whose two sides share vertices. 2 have duplicate faces. In 2 vertices are merged, as by a weld.

majorant.xatlas runs in a process of its own. Its seconds are of the wall, without the start of the interpreter.
xatlas (watlas) has its defaults. Stretch is L2 over all charts, each at its own scale, measured here for both.
Defects: faces are others than those of F, uvs lie outside of [0, 1], the floats are not proven (Atlas.proven), or
layout.py of SHARED finds turned or overlapping faces in one of at most --judged faces. The row of a mesh says whether
it keeps the targets: no defect; at most 2 s up to 5,750 faces, else 60 s for 450,000; at most a third of the charts of
xatlas, at no larger stretch. Exit code 0 exactly if all do.

Sample runs:
  bench/generator_surfaces.py --watlas node_modules/watlas
  bench/generator_surfaces.py --most-faces 30000 --busy      # the small ones, without xatlas
  bench/generator_surfaces.py --only 3 17 --keep /tmp/meshes # with files of meshes and layouts
"""
import argparse
import json
import math
import statistics
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

import common

MESHES = 50
NOT_MANIFOLD = 14
SMALLEST, LARGEST = 5_000, 500_000
DEFECTS = ('none', 'unreferenced', 'holes', 'few digits')
KINDS = ('walls', 'solids', 'merged', 'walls', 'twice', 'solids', 'walls')
# Thickness of walls, in mean differences of the field between neighbours around a zero.
THICKNESS = 0.5
# Cells in which vertices are merged, in cells of the grid.
WIDTH = 0.7
# Most faces and seconds.
SMALL, LARGE = (5_750, 2), (450_000, 60)

# A mesh is int32 #V, #F, float32 V, uint32 F. A layout is uint32 #N, #F, N vertices (uint32 vertex, int32 chart,
# float32 u, v), uint32 F of them.
XATLAS = '''
import * as watlas from '%s/dist/watlas.js';
import { readFileSync, writeFileSync } from 'fs';
await watlas.Initialize();
const data = new Uint8Array(readFileSync(process.argv[2])).buffer, [vertices, faces] = new Uint32Array(data, 0, 2);
const start = performance.now(), atlas = new watlas.Atlas();
atlas.addMesh({ vertexPositionData: new Float32Array(data, 8, 3 * vertices), vertexCount: vertices,
  vertexPositionStride: 12, indexData: new Uint32Array(data, 8 + 12 * vertices), indexCount: 3 * faces });
atlas.generate({}, {});
const seconds = (performance.now() - start) / 1000;
const mesh = atlas.getMesh(0), count = mesh.vertexCount, index = new Uint32Array(mesh.indexCount);
mesh.getIndexArray(index);
const out = new ArrayBuffer(8 + 16 * count + 4 * index.length), integers = new Int32Array(out);
const floats = new Float32Array(out);
integers.set([count, index.length / 3]);
for (let k = 0; k < count; ++k) {
  const v = mesh.getVertex(k);
  integers.set([v.xref, v.chartIndex], 2 + 4 * k);
  floats.set(v.uv, 4 + 4 * k);
}
integers.set(index, 2 + 4 * count);
writeFileSync(process.argv[3], new Uint8Array(out));
console.log(JSON.stringify({ seconds }));
'''


def cube_cases():
    """Triangles of the 256 cases of marching cubes, as numbers of edges. Corners have coordinates (bit 0, 1, 2).

    On each side of the cube the corners inside are kept apart from each other, on both of its cubes alike: that closes
    the surface."""
    edges = [(a, a | 1 << k) for k in range(3) for a in range(8) if not a >> k & 1]
    number = {frozenset(e): n for n, e in enumerate(edges)}
    sides = []
    for k in range(3):
        i, j = 1 << (k + 1) % 3, 1 << (k + 2) % 3
        sides += [(0, j, i | j, i), tuple(c | 1 << k for c in (0, i, i | j, j))]
    cases = []
    for mask in range(256):
        follower = {}
        for side in sides:
            for n in range(4):
                if mask >> side[n] & 1 or not mask >> side[n - 3] & 1:
                    continue  # from n to n + 1 the walk around the side enters
                m = n + 1
                while mask >> side[(m + 1) % 4] & 1:
                    m += 1
                enters = number[frozenset((side[n], side[n - 3]))]
                leaves = number[frozenset((side[m % 4], side[(m + 1) % 4]))]
                follower[leaves] = enters
        triangles = []
        while follower:
            loop = [next(iter(follower))]
            while follower[loop[-1]] != loop[0]:
                loop.append(follower.pop(loop[-1]))
            follower.pop(loop[-1])
            triangles += [(loop[0], loop[k], loop[k + 1]) for k in range(1, len(loop) - 1)]
        cases.append(triangles)
    return edges, cases


EDGES, CASES = cube_cases()


def field(n, seed):
    """Blobs and noise on n^3 points of a cube, negative at its border. Both are sums of products of functions of one
    coordinate each."""
    rng = np.random.default_rng(seed)
    x = np.linspace(-1, 1, n)

    def sum_of(factors, weights):
        a, b, c = (f.astype(np.complex64) for f in factors)
        pairs = (a[:, None, :] * b[None, :, :]).reshape(n * n, -1) * weights.astype(np.float32)
        return (pairs @ c.T).real.reshape(n, n, n)
    blobs = rng.integers(3, 9)
    centers, widths = rng.uniform(-0.55, 0.55, (3, blobs)), rng.uniform(0.02, 0.12, blobs)
    f = sum_of(np.exp(-(x[None, :, None] - centers[:, None, :]) ** 2 / widths), np.ones(blobs))
    waves = rng.normal(size=(3, 24)) * rng.uniform(3, 14, 24)
    f += sum_of(np.exp(1j * (x[None, :, None] * waves[:, None, :] + rng.uniform(0, 7, 24) / 3)),
                rng.uniform(0.01, 0.06, 24))
    f += np.float32(rng.choice([0, 0.004, 0.02])) * rng.standard_normal(f.shape, np.float32) - np.float32(0.6)
    for k in range(3):
        f[(slice(None),) * k + (0,)] = f[(slice(None),) * k + (-1,)] = -1
    return f


def crossings(f):
    """By axis: the lower ends of grid edges whose ends have different signs, and where along them the field is 0."""
    for k in range(3):
        low, high = f.take(range(f.shape[k] - 1), k), f.take(range(1, f.shape[k]), k)
        at = np.argwhere((low > 0) != (high > 0))
        a, b = low[tuple(at.T)], high[tuple(at.T)]
        yield at, a / (a - b), a > 0


def marching_cubes(f):
    n = f.shape[0]
    inside = f > 0
    V = []
    numbers = [np.full(f.shape, -1, np.int32) for _ in range(3)]
    count = 0
    for k, (at, t, _) in enumerate(crossings(f)):
        numbers[k][tuple(at.T)] = count + np.arange(len(at))
        count += len(at)
        p = at.astype(float)
        p[:, k] += t
        V.append(p)
    case = np.zeros((n - 1,) * 3, np.uint8)
    for c in range(8):
        offset = [c >> k & 1 for k in range(3)]
        case |= inside[tuple(slice(o, n - 1 + o) for o in offset)].astype(np.uint8) << c
    F = []
    mixed = np.argwhere((case != 0) & (case != 255))
    of_cell = case[tuple(mixed.T)]
    order = np.argsort(of_cell, kind='stable')
    for cells in np.split(mixed[order], np.flatnonzero(np.diff(of_cell[order])) + 1):
        for triangle in CASES[case[tuple(cells[0])]]:
            corners = []
            for e in triangle:
                a, b = EDGES[e]
                at = cells + [a >> k & 1 for k in range(3)]
                corners.append(numbers[(b - a).bit_length() - 1][tuple(at.T)])
            F.append(np.stack(corners, 1))
    return np.concatenate(V), np.concatenate(F)


def dual_surface(f, is_wall):
    """A vertex for each cell with a change of sign, two triangles for each grid edge with one. A wall has two sides;
    an edge that crosses both has the triangles of one."""
    sides = [f]
    if is_wall:
        low, high = (np.concatenate([f.take(range(k, len(f) - 1 + k), axis).ravel() for axis in range(3)])
                     for k in (0, 1))
        sides.append(THICKNESS * np.abs(high - low)[(low > 0) != (high > 0)].mean() - f)
    places, quads, edges = [], [], []
    for side in sides:
        for k, (at, t, leaves) in enumerate(crossings(side)):
            p = at.astype(float)
            p[:, k] += t
            i, j = np.eye(3, dtype=int)[(k + 1) % 3], np.eye(3, dtype=int)[(k + 2) % 3]
            around = [at - i - j, at - j, at, at - i]  # counterclockwise around the axis
            flat = np.stack([np.ravel_multi_index(tuple(c.T), f.shape) for c in around], 1)
            quads.append(np.where(leaves[:, None], flat, flat[:, ::-1]))
            places.append(p)
            edges.append(3 * flat[:, 2] + k)
    first = np.unique(np.concatenate(edges), return_index=True)[1]
    quads, places = np.concatenate(quads)[first], np.concatenate(places)[first]
    cells, q = np.unique(quads, return_inverse=True)
    q = q.reshape(-1, 4)
    V = np.stack([np.bincount(q.ravel(), np.repeat(places[:, k], 4)) for k in range(3)], 1)
    return V / np.bincount(q.ravel())[:, None], np.concatenate([q[:, [0, 1, 2]], q[:, [0, 2, 3]]])


def merged(V, F, cell):
    """Merges the vertices in each cell of a grid. Faces of two vertices are left out."""
    _, first, number = np.unique(np.floor(V / cell).astype(int), axis=0, return_index=True, return_inverse=True)
    F = number.reshape(-1)[F]
    return V[first], F[(F[:, 0] != F[:, 1]) & (F[:, 1] != F[:, 2]) & (F[:, 2] != F[:, 0])]


def with_defects(V, F, kind, cell, rng):
    if kind == 'merged':
        V, F = merged(V, F, WIDTH * cell)
    if kind == 'twice':
        again = rng.choice(len(F), len(F) // 200)
        F = np.concatenate([F, F[again[::2]], F[again[1::2]][:, ::-1]])
    if kind == 'unreferenced':
        V = np.concatenate([V, rng.uniform(-1, 1, (len(V) // 50, 3))])
    if kind == 'holes':
        F = F[rng.random(len(F)) > 0.01]
    if kind == 'few digits':
        V = np.round(V * 256) / 256
    return V, F


def surface(number):
    """Returns (V, F, kind) of one of MESHES: float32, uint32."""
    rng = np.random.default_rng(1000 + number)
    target = SMALLEST * (LARGEST / SMALLEST) ** (number / (MESHES - 1))
    before, after = ((number + k) * NOT_MANIFOLD // MESHES for k in (0, 1))
    kind = KINDS[before % len(KINDS)] if after > before else DEFECTS[(number - before) % len(DEFECTS)]

    def make(n):
        f = field(n, seed)
        return dual_surface(f, kind == 'walls') if kind in ('walls', 'solids') else marching_cubes(f)
    n, seed = 32, number
    while len((mesh := make(n))[1]) <= 4 * n * n:  # surfaces as large as several sides of the cube
        seed += MESHES
    for _ in range(6):  # noise makes more faces than the square of the grid says
        count = len(mesh[1])
        if abs(count / target - 1) < 0.15:
            break
        n = round(n * min(2, math.sqrt(target / max(count, 1))))
        mesh = make(n)
    V, F = with_defects(mesh[0] / (n - 1) * 2 - 1, mesh[1], kind, 2 / (n - 1), rng)
    return V.astype(np.float32), F.astype(np.uint32), kind


def shared_edges(F):
    """Returns the number of edges of three faces or more."""
    e = np.sort(np.concatenate([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]]).astype(np.int64), 1)
    return int((np.unique(e[:, 0] << 32 | e[:, 1], return_counts=True)[1] > 2).sum())


# ------------------------------------------------------------------ layouts
def read_layout(path):
    """Returns vertices, charts (-1: none), uvs and faces of a layout."""
    data = path.read_bytes()
    count = np.frombuffer(data, np.uint32, 2)
    v = np.frombuffer(data, [('row', 'u4'), ('chart', 'i4'), ('uv', 'f4', 2)], count[0], 8)
    return v['row'], v['chart'], v['uv'], np.frombuffer(data, np.uint32, 3 * count[1], 8 + v.nbytes).reshape(-1, 3)


def layout_by(command, given, made, timeout):
    """Returns what a program printed, and its layout; or the reason why there is none."""
    made.unlink(missing_ok=True)
    done = common.run([*command, given, made], timeout)
    if done.code == common.TIMEOUT:
        return 'over %g s' % timeout, None
    if done.code:
        return 'exit %s: %s' % (done.code, (done.stderr.strip() or '-').splitlines()[-1][:100]), None
    return json.loads(done.stdout.splitlines()[-1]), read_layout(made)


def stretch(V, F, uv, chart):
    """L2 over all charts by area, each at its own scale; faces without an area on either side are left out."""
    p, t = V[F].astype(float), uv.astype(float)
    twice = ((t[:, 1, 0] - t[:, 0, 0]) * (t[:, 2, 1] - t[:, 0, 1])
             - (t[:, 2, 0] - t[:, 0, 0]) * (t[:, 1, 1] - t[:, 0, 1]))
    with np.errstate(all='ignore'):
        along = [sum(p[:, k] * (t[:, (k + 1) % 3, 1 - i] - t[:, (k + 2) % 3, 1 - i])[:, None] for k in range(3))
                 / twice[:, None] for i in range(2)]
    area = np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1) / 2
    square = area * sum((a * a).sum(1) for a in along) / 2
    # Images thinner than single precision say nothing.
    good = (area > 0) & (np.abs(twice) > 2e-9 * np.abs(twice).max()) & np.isfinite(square) & (chart >= 0)
    surface, image, squares = (np.bincount(chart[good], x[good]) for x in (area, np.abs(twice) / 2, square))
    some = surface > 0
    return math.sqrt((squares[some] * image[some] / surface[some]).sum() / surface.sum())


def measured(V, layout):
    """Returns the number of charts, and stretch."""
    rows, charts, uvs, faces = layout
    chart = charts[faces[:, 0]]
    return len(np.unique(chart[chart >= 0])), stretch(V, rows[faces], uvs[faces], chart)


def defects(options, V, F, printed, layout, path):
    """Returns defects of a layout of majorant. Faces without an area are not judged."""
    rows, charts, uvs, faces = layout
    found = [printed['defect']] if printed['defect'] else []
    if faces.shape != F.shape or (rows[faces] != F).any():
        found.append('other faces')
    if not (0 <= uvs.min() and uvs.max() <= 1):
        found.append('outside of the square')
    p = V[F].astype(float)
    has_image = (np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]) != 0).any(1)
    if len(F) <= options.judged or options.keep:
        lines = ['v 0 0 0'] + ['vt %.9g %.9g' % tuple(p) for p in uvs]
        t = uvs[faces].astype(float)
        a, b = t[:, 1] - t[:, 0], t[:, 2] - t[:, 0]
        is_turned = a[:, 0] * b[:, 1] < a[:, 1] * b[:, 0]  # since F may disagree with itself; folds overlap
        rows = np.where(is_turned[:, None], faces[:, ::-1], faces)
        lines += ['f 1/%d 1/%d 1/%d' % tuple(face) for face in rows[has_image] + 1]
        path.write_text('\n'.join(lines) + '\n')
    if len(F) <= options.judged:
        judge = common.run([common.PYTHON, options.shared / 'tools/layout.py', path, '--overlap', '--unit'],
                           options.timeout)
        last = (judge.stdout.strip() or judge.stderr.strip() or 'layout.py: no answer').splitlines()[-1]
        found += [] if last.startswith('ok') else [last]
    return found


def row(options, number, folder, table):
    """Measures one mesh. Returns charts and stretch of both programs if there are any."""
    given, ours, theirs, judged = (folder / ('%d.%s' % (number, end)) for end in ('mesh', 'majorant', 'xatlas', 'obj'))
    V, F, kind = surface(number)
    given.write_bytes(np.array([len(V), len(F)], np.uint32).tobytes() + V.tobytes() + F.tobytes())
    limit = SMALL[1] if len(F) <= SMALL[0] else LARGE[1] * max(1, len(F) / LARGE[0])
    printed, layout = layout_by([common.PYTHON, __file__, '--unwrap'], given, ours, options.timeout)
    if layout is None:
        table.judged(number, kind, len(F), shared_edges(F), *'------', printed, kept=False)
        return None
    found = defects(options, V, F, printed, layout, judged)
    charts, l2 = measured(V, layout)
    kept = not found and printed['seconds'] <= limit
    their_cells, pair = ('-', '-', '-'), None
    if options.watlas:
        script = folder / 'xatlas.mjs'
        script.write_text(XATLAS % options.watlas.resolve())
        their, layout = layout_by(['node', script], given, theirs, options.timeout)
        their_cells = (their, '-', '-')
        if layout is not None:
            pair = (charts, l2, *measured(V, layout))
            kept = kept and 3 * charts <= pair[2] and l2 <= pair[3]
            their_cells = ('%.1f' % their['seconds'], pair[2], '%.4f' % pair[3])
    table.judged(number, kind, len(F), shared_edges(F), '%.1f' % printed['seconds'], charts, '%.4f' % l2, *their_cells,
                 '; '.join(found) or 'ok', kept=kept)
    return pair


def unwrap(given, made):
    """Reads a mesh, writes its layout by majorant.xatlas, and prints seconds and the defect."""
    import majorant.xatlas as xatlas
    data = Path(given).read_bytes()
    count = np.frombuffer(data, np.uint32, 2)
    V = np.frombuffer(data, np.float32, 3 * count[0], 8).reshape(-1, 3)
    F = np.frombuffer(data, np.uint32, 3 * count[1], 8 + V.nbytes).reshape(-1, 3)
    start = time.perf_counter()
    atlas = xatlas.Atlas()
    atlas.add_mesh(V, F)
    atlas.generate()
    rows, faces, uvs = atlas[0]
    seconds = time.perf_counter() - start
    vertices = np.empty(len(rows), [('row', 'u4'), ('chart', 'i4'), ('uv', 'f4', 2)])
    vertices['row'], vertices['uv'] = rows, uvs
    vertices['chart'] = atlas.get_mesh_vertex_assignment(0)[1].astype(np.int32)
    Path(made).write_bytes(np.array([len(rows), len(faces)], np.uint32).tobytes() + vertices.tobytes()
                           + faces.tobytes())
    print(json.dumps({'seconds': seconds, 'defect': atlas.defect}))


def main():
    parser = common.parser(__doc__, 1800)
    parser.add_argument('--watlas', type=Path, help='folder of the package')
    parser.add_argument('--only', type=int, nargs='+', default=range(MESHES), help='numbers of meshes')
    parser.add_argument('--most-faces', type=int, default=2 * LARGEST)
    parser.add_argument('--judged', type=int, default=20_000, help='most faces of a layout that layout.py judges')
    parser.add_argument('--keep', type=Path, help='folder for meshes and layouts')
    parser.add_argument('--unwrap', nargs=2, type=Path, help=argparse.SUPPRESS)
    options = parser.parse_args()
    sys.path.insert(0, str(options.binary.resolve().parent.parent / 'python'))
    if options.unwrap:
        return unwrap(*options.unwrap)
    common.require_files(options)
    common.require_idle(options)
    table = common.Table('', 'mesh', 'kind', 'faces', 'not manifold', 's', 'charts', 'stretch', 'xatlas: s', 'charts',
                         'stretch', 'defects', 'kept')
    pairs = []
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.keep or Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        for number in options.only:
            if SMALLEST * (LARGEST / SMALLEST) ** (number / (MESHES - 1)) <= options.most_faces:
                pairs.append(row(options, number, folder, table))
    both = [pair for pair in pairs if pair]
    summary = '%d meshes' % len(pairs)
    if both:
        ratios = [a / b for a, _, b, _ in both]
        summary += ', %d with a layout of xatlas: of its charts %.2f in the median, %.2f at most; stretch larger in %d' \
            % (len(both), statistics.median(ratios), max(ratios), sum(s > t for _, s, _, t in both))
    table.end(summary + '.')
    return 0 if table.kept else 1


if __name__ == '__main__':
    sys.exit(main())
