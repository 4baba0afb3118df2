#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Runs majorant.xatlas on 50 meshes of 5,000 to 500,000 faces such as shape generators make, by seeds.

    PYTHONPATH=build/release/python tests/campaigns/generator_surfaces.py [--only K...] [--xatlas PROGRAM] [-o TABLE.csv]

Each is the level set of blobs and noise on a grid, at single precision. 36 are made by marching cubes, some
with the defects of exporters: duplicate faces, unused vertices, holes, and coordinates of few digits, which
give faces without an area. 14 (28 %) are dual surfaces, a vertex for each cell, whose edges have four faces
wherever the sign of the field alternates around a face of the grid: they are not manifold.

Checks of every mesh: the call returns; `indices` has the shape of F and vmapping[indices] is F; uvs lie in
[0, 1]; the floats are proven (Atlas.proven). Prints seconds of the wall and of the processors, charts, L2
stretch and fill. PROGRAM IN OUT is xatlas with its defaults: it reads int32 #V, #F, float32 V, uint32 F, and
writes uint32 #N, #F, (uint32 vertex, int32 chart, float32 u, v) of N vertices, uint32 F of them. Then the
median number of charts must be at most a third of xatlas', and no stretch larger. Exit code 1 if a check
fails.
"""
import argparse
import csv
import math
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

MESHES = 50
DUAL = 14
SMALLEST, LARGEST = 5_000, 500_000
DEFECTS = ('none', 'duplicates', 'unreferenced', 'holes', 'few-digits')


def cube_cases():
    """Returns the triangles of the 256 cases of marching cubes, as edge indices. Corners have coordinates
    (bit 0, 1, 2).

    On each side of a cube, inner corners are separated in the same way for both of its cubes, which closes
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
                    continue  # the walk around the side enters between n and n + 1
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
    """Returns blobs and noise on n^3 points of a cube, negative at its border. Both are sums of products of
    functions of one coordinate."""
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
    """Yields by axis the lower ends of grid edges with a change of sign, and the position of the zero on
    each."""
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


def dual_surface(f):
    """Returns a vertex for each cell with a change of sign, and two triangles for each such grid edge."""
    size = f.size
    cells, sums, quads = [], [], []
    for k, (at, t, leaves) in enumerate(crossings(f)):
        p = at.astype(float)
        p[:, k] += t
        i, j = np.eye(3, dtype=int)[(k + 1) % 3], np.eye(3, dtype=int)[(k + 2) % 3]
        around = [at - i - j, at - j, at, at - i]  # counterclockwise around the axis
        flat = np.stack([np.ravel_multi_index(tuple(c.T), f.shape) for c in around], 1)
        cells.append(flat.T.ravel())
        sums.append(np.tile(p, (4, 1)))
        quads.append(np.where(leaves[:, None], flat, flat[:, ::-1]))
    cell, sums = np.concatenate(cells), np.concatenate(sums)
    count = np.bincount(cell, minlength=size)
    used = np.flatnonzero(count)
    V = np.stack([np.bincount(cell, sums[:, k], size)[used] for k in range(3)], 1) / count[used, None]
    number = np.full(size, -1)
    number[used] = np.arange(len(used))
    q = number[np.concatenate(quads)]
    return V, np.concatenate([q[:, [0, 1, 2]], q[:, [0, 2, 3]]])


def with_defects(V, F, kind, rng):
    if kind == 'duplicates':
        again = rng.choice(len(F), len(F) // 200)
        F = np.concatenate([F, F[again[::2]], F[again[1::2]][:, ::-1]])
    if kind == 'unreferenced':
        V = np.concatenate([V, rng.uniform(-1, 1, (len(V) // 50, 3))])
    if kind == 'holes':
        F = F[rng.random(len(F)) > 0.01]
    if kind == 'few-digits':
        V = np.round(V * 256) / 256
    return V, F


def surface(number):
    """Returns (V, F, kind) of one of MESHES: float32, uint32."""
    rng = np.random.default_rng(1000 + number)
    target = SMALLEST * (LARGEST / SMALLEST) ** (number / (MESHES - 1))
    is_dual = (number + 1) * DUAL // MESHES > number * DUAL // MESHES
    make = dual_surface if is_dual else marching_cubes
    n, seed = 32, number
    while True:  # the surface is as large as several sides of the cube
        V, F = make(field(n, seed))
        if len(F) > 4 * n * n:
            break
        seed += MESHES
    for _ in range(6):  # with noise there are more faces than the square of the grid's size
        if abs(len(F) / target - 1) < 0.15:
            break
        n = round(n * min(2, math.sqrt(target / max(len(F), 1))))
        V, F = make(field(n, seed))
    kind = DEFECTS[number % len(DEFECTS)]
    V, F = with_defects(V / (n - 1) * 2 - 1, F, kind, rng)
    return V.astype(np.float32), F.astype(np.uint32), ('dual ' if is_dual else 'cubes ') + kind


def nonmanifold_edges(F):
    e = np.sort(np.concatenate([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]]).astype(np.int64), 1)
    _, count = np.unique(e[:, 0] << 32 | e[:, 1], return_counts=True)
    return int((count > 2).sum())


def stretch(V, F, uv, chart):
    """Returns L2 over all charts by area, each at its own scale, without faces that have no area on either
    side."""
    p, t = V[F].astype(float), uv.astype(float)
    twice = ((t[:, 1, 0] - t[:, 0, 0]) * (t[:, 2, 1] - t[:, 0, 1])
             - (t[:, 2, 0] - t[:, 0, 0]) * (t[:, 1, 1] - t[:, 0, 1]))
    with np.errstate(all='ignore'):
        along = [sum(p[:, k] * (t[:, (k + 1) % 3, 1 - i] - t[:, (k + 2) % 3, 1 - i])[:, None] for k in range(3))
                 / twice[:, None] for i in range(2)]
    area = np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1) / 2
    square = area * sum((a * a).sum(1) for a in along) / 2
    # Images thinner than single precision have no stretch.
    good = (area > 0) & (np.abs(twice) > 2e-9 * np.abs(twice).max()) & np.isfinite(square) & (chart >= 0)
    surface, image, squares = (np.bincount(chart[good], x[good]) for x in (area, np.abs(twice) / 2, square))
    some = surface > 0
    return math.sqrt((squares[some] * image[some] / surface[some]).sum() / surface.sum())


def by_majorant(V, F):
    import majorant.xatlas as xatlas
    wall, cpu = time.perf_counter(), time.process_time()
    atlas = xatlas.Atlas()
    atlas.add_mesh(V, F)
    atlas.generate()
    vmapping, indices, uvs = atlas[0]
    row = {'seconds': time.perf_counter() - wall, 'cpu': time.process_time() - cpu, 'charts': atlas.chart_count,
           'fill': atlas.utilization, 'proven': atlas.proven, 'defect': atlas.defect}
    chart = atlas.get_mesh_vertex_assignment(0)[1].astype(np.int32)[indices[:, 0]]
    row['stretch'] = stretch(V, F, uvs[indices], chart)
    row['sound'] = bool(indices.shape == F.shape and (vmapping[indices] == F).all() and 0 <= uvs.min()
                        and uvs.max() <= 1)
    return row


def by_xatlas(program, V, F):
    with tempfile.TemporaryDirectory() as folder:
        given, made = os.path.join(folder, 'in'), os.path.join(folder, 'out')
        Path(given).write_bytes(np.array([len(V), len(F)], np.uint32).tobytes() + V.tobytes() + F.tobytes())
        before = os.times()
        subprocess.run([program, given, made], check=True, stdout=subprocess.DEVNULL)
        after = os.times()
        data = Path(made).read_bytes()
    count = np.frombuffer(data, np.uint32, 2)
    vertex = np.frombuffer(data, [('ref', 'u4'), ('chart', 'i4'), ('uv', 'f4', 2)], count[0], 8)
    faces = np.frombuffer(data, np.uint32, 3 * count[1], 8 + vertex.nbytes).reshape(-1, 3)
    chart = vertex['chart'][faces[:, 0]]
    return {'charts': len(np.unique(chart[chart >= 0])), 'stretch': stretch(V, F, vertex['uv'][faces], chart),
            'cpu': after.children_user + after.children_system - before.children_user - before.children_system}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--only', type=int, nargs='+', default=range(MESHES))
    parser.add_argument('--xatlas', metavar='PROGRAM')
    parser.add_argument('-o', dest='table', metavar='TABLE.csv')
    options = parser.parse_args()
    rows, failures = [], []
    for k in options.only:
        V, F, kind = surface(k)
        row = {'mesh': k, 'kind': kind, 'faces': len(F), 'nonmanifold_edges': nonmanifold_edges(F), **by_majorant(V, F)}
        if not (row['sound'] and row['proven']):
            failures.append(f'mesh {k}: {row["defect"] or "arrays"}')
        if options.xatlas:
            row.update({'xatlas_' + name: value for name, value in by_xatlas(options.xatlas, V, F).items()})
            if row['stretch'] > row['xatlas_stretch']:
                failures.append(f'mesh {k}: stretch')
        rows.append(row)
        print(*(f'{name} {value:.4g}' if isinstance(value, float) else f'{name} {value}' for name, value in row.items()),
              flush=True)
    if options.xatlas:
        ratio = statistics.median(row['charts'] / row['xatlas_charts'] for row in rows)
        print(f'charts, of those of xatlas, in the median: {ratio:.3f}')
        if ratio > 1 / 3:
            failures.append('charts')
    if options.table:
        with open(options.table, 'w', newline='') as file:
            writer = csv.DictWriter(file, rows[0])
            writer.writeheader()
            writer.writerows(rows)
    print('\n'.join(failures) or f'{len(rows)} meshes: all finished, all proven')
    sys.exit(bool(failures))


if __name__ == '__main__':
    main()
