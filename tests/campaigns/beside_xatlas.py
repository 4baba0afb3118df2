#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Compares majorant unwrap with xatlas: seams, charts and fill at the same stretch and padding.

    npm install watlas@1.0.1
    tests/campaigns/beside_xatlas.py build/release/apps/majorant --watlas node_modules/watlas [--meshes FOLDER]

xatlas runs with its default charts, brute-force packing and rotations. `unwrap` runs with the L2 stretch of
xatlas' layout as --max-stretch (at least 1.0005), and once with `--preset game`. This script measures both
layouts. Seams: the length of edges with different coordinates on their two sides, divided by the square root
of the area. L2 stretch: the mean by area over all charts, each at its own scale as in the limit, without
degenerate faces. Fill: that of the smallest square around the layout. Both programs get the same triangles,
by ear clipping, without texture coordinates, normals and groups. Padding is 4 pixels of 1024. Exit code 1 if
the median seam is above half of xatlas', or the preset's median of charts is above a third, or its median
fill below 0.55.
"""
import argparse
import glob
import json
import math
import os
import statistics
import subprocess
import sys
import tempfile
from collections import defaultdict

import numpy as np

PADDING, RESOLUTION = 4, 1024
PATTERNS = ('closed/*.obj', 'messy/derived/*.obj', 'messy/real/*.obj')
# The smallest limit that is passed on; boxes alone reach 1.
LEAST_LIMIT = 1.0005

XATLAS = '''
import * as watlas from '%s/dist/watlas.js';
import { readFileSync } from 'fs';
await watlas.Initialize();
const { positions, indices } = JSON.parse(readFileSync(process.argv[2]));
const atlas = new watlas.Atlas();
atlas.addMesh({ vertexPositionData: new Float32Array(positions), vertexCount: positions.length / 3,
  vertexPositionStride: 12, indexData: new Uint32Array(indices), indexCount: indices.length });
atlas.computeCharts({});
atlas.packCharts({ padding: %d, resolution: %d, bilinear: false, blockAlign: false, bruteForce: true,
  rotateCharts: true, rotateChartsToAxis: true, createImage: false });
const out = [], uv = [];
const mesh = atlas.getMesh(0), index = new Uint32Array(mesh.indexCount);
mesh.getIndexArray(index);
for (let k = 0; k < index.length; ++k) {
  const v = mesh.getVertex(index[k]);
  out.push([v.xref, v.chartIndex, v.uv[0], v.uv[1]]);
}
console.log(JSON.stringify({ width: atlas.width, height: atlas.height, charts: atlas.chartCount,
  atlases: atlas.atlasCount, corners: out }));
'''


def clipped(points):
    """Returns the triangles of a polygon as corner indices, in its mean plane. Clips the ear with the largest
    minimum angle; among all corners if there is no ear (a polygon that crosses itself)."""
    p = np.asarray(points)
    normal = sum(np.cross(p[k - 1] - p[0], p[k] - p[0]) for k in range(1, len(p)))
    axis = int(np.abs(normal).argmax())
    flat = np.delete(p, axis, 1) * (1, 1 if (normal[axis] > 0) == (axis != 1) else -1)

    def turn(a, b, c):
        u, w = flat[b] - flat[a], flat[c] - flat[a]
        return u[0] * w[1] - u[1] * w[0]

    def least_angle(t):
        angles = []
        for k in range(3):
            u, w = p[t[(k + 1) % 3]] - p[t[k]], p[t[(k + 2) % 3]] - p[t[k]]
            angles.append(math.atan2(np.linalg.norm(np.cross(u, w)), u.dot(w)))
        return min(angles)
    left, out = list(range(len(p))), []
    while len(left) > 3:
        corners = [(left[k - 1], left[k], left[(k + 1) % len(left)]) for k in range(len(left))]
        ears = [t for t in corners if turn(*t) > 0 and not any(
            turn(t[0], t[1], q) >= 0 and turn(t[1], t[2], q) >= 0 and turn(t[2], t[0], q) >= 0
            for q in left if q not in t)]
        best = max(ears or corners, key=least_angle)
        out.append(best)
        left.remove(best[1])
    return out + [tuple(left)]


def read(path):
    """Returns (positions, triangles as corners (v, vt), uv)."""
    v, vt, faces = [], [], []
    with open(path, errors='replace') as f:
        for line in f:
            w = line.split()
            if w[:1] == ['v']:
                v.append([float(x) for x in w[1:4]])
            elif w[:1] == ['vt']:
                vt.append([float(x) for x in w[1:3]])
            elif w[:1] == ['f']:
                c = []
                for word in w[1:]:
                    n = (word.split('/') + [''])[:2]
                    i, t = int(n[0]), int(n[1] or 0)
                    c.append((i - 1 if i > 0 else len(v) + i, t - 1))
                faces.append(c)
    triangles = []
    for c in faces:
        cut = clipped([v[i] for i, _ in c]) if len(c) > 3 else [(0, 1, 2)]
        triangles += [tuple(c[k] for k in t) for t in cut]
    return np.array(v), triangles, np.array(vt)


def areas_and_square(p, t):
    """Returns by triangle: area on the surface, area in the plane, and area times (Gamma^2 + gamma^2) / 2."""
    twice = (t[:, 1, 0] - t[:, 0, 0]) * (t[:, 2, 1] - t[:, 0, 1]) - (t[:, 2, 0] - t[:, 0, 0]) * (t[:, 1, 1] - t[:, 0, 1])
    with np.errstate(all='ignore'):
        s = sum(p[:, k] * (t[:, (k + 1) % 3, 1] - t[:, (k + 2) % 3, 1])[:, None] for k in range(3)) / twice[:, None]
        r = sum(p[:, k] * (t[:, (k + 2) % 3, 0] - t[:, (k + 1) % 3, 0])[:, None] for k in range(3)) / twice[:, None]
    area = np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1) / 2
    return area, np.abs(twice) / 2, area * ((s * s).sum(1) + (r * r).sum(1)) / 2


def measured(p, t, chart, side):
    """Returns L2 stretch over all charts, and the fill of a square with this side (0: the smallest one around
    the triangles)."""
    area, image, square = areas_and_square(p, t)
    # Leaves out faces without an area in the plane, up to single precision.
    good = (area > 0) & (image > 1e-9 * image.max()) & np.isfinite(square)
    sums = defaultdict(lambda: np.zeros(3))
    for c, a, i, s in zip(chart[good], area[good], image[good], square[good]):
        sums[c] += (a, i, s)
    whole = sum(a for a, _, _ in sums.values())
    if not whole:
        raise ValueError('no face has an area in the layout')
    l2 = math.sqrt(sum(s * i / a for a, i, s in sums.values()) / whole)
    side = side or (t.reshape(-1, 2).max(0) - t.reshape(-1, 2).min(0)).max()
    return l2, image.sum() / side ** 2, area.sum(), int((~good & (area > 0)).sum())


def seam(v, faces, corner_of):
    """Returns the length of edges whose two faces have different corners."""
    sides = defaultdict(list)
    for f, face in enumerate(faces):
        for k in range(3):
            a, b = face[k][0], face[(k + 1) % 3][0]
            ends = (corner_of(f, k), corner_of(f, (k + 1) % 3))
            sides[min(a, b), max(a, b)].append(ends if a < b else ends[::-1])
    return sum(np.linalg.norm(v[a] - v[b]) for (a, b), s in sides.items() if len(s) == 2 and s[0] != s[1])


def by_xatlas(folder, watlas, v, faces):
    script, data = os.path.join(folder, 'x.mjs'), os.path.join(folder, 'x.json')
    with open(script, 'w') as f:
        f.write(XATLAS % (os.path.abspath(watlas), PADDING, RESOLUTION))
    with open(data, 'w') as f:
        json.dump({'positions': v.ravel().tolist(), 'indices': [c[0] for face in faces for c in face]}, f)
    done = subprocess.run(['node', script, data], capture_output=True, text=True, timeout=1200)
    printed = json.loads(done.stdout.strip().splitlines()[-1])
    corners = np.array(printed['corners'])
    if len(corners) != 3 * len(faces):
        raise ValueError('xatlas left faces out')
    xref, chart, t = corners[:, 0].astype(int), corners[:, 1].astype(int), corners[:, 2:].reshape(-1, 3, 2)
    order = {}
    for k, x in enumerate(xref):  # faces may have another order
        order.setdefault(k // 3, []).append(x)
    their = [[(x, (chart[3 * f + k], *t[f, k])) for k, x in enumerate(order[f])] for f in range(len(faces))]
    l2, fill, area, lost = measured(v[xref].reshape(-1, 3, 3), t, chart[::3], max(printed['width'], printed['height']))
    length = seam(v, their, lambda f, k: their[f][k][1]) / math.sqrt(area)
    return {'charts': printed['charts'], 'l2': l2, 'fill': fill, 'seam': length, 'lost': lost}


def by_majorant(folder, majorant, path, *flags):
    out, report = os.path.join(folder, 'out.obj'), os.path.join(folder, 'r.json')
    done = subprocess.run([majorant, 'unwrap', path, '-o', out, '--report', report, '--quiet', '--threads', '1',
                           '--padding', str(PADDING), '--resolution', str(RESOLUTION), *flags],
                          capture_output=True, text=True)
    if done.returncode not in (0, 4):
        raise ValueError('exit %d: %s' % (done.returncode, done.stderr.strip()[-100:]))
    v, faces, uv = read(out)
    with open(report) as f:
        printed = json.load(f)
    # Makes charts of faces that share a vt.
    parent = list(range(len(uv)))

    def find(a):
        while parent[a] != a:
            parent[a] = a = parent[parent[a]]
        return a
    for face in faces:
        for c in face[1:]:
            parent[find(c[1])] = find(face[0][1])
    chart = np.array([find(face[0][1]) for face in faces])
    p = v[[c[0] for face in faces for c in face]].reshape(-1, 3, 3)
    t = uv[[c[1] for face in faces for c in face]].reshape(-1, 3, 2)
    l2, _, area, _ = measured(p, t, chart, 0)
    length = seam(v, faces, lambda f, k: faces[f][k][1]) / math.sqrt(area)
    return {'charts': len(printed['charts']), 'l2': l2, 'fill': printed['result']['fill'], 'seam': length}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('majorant')
    parser.add_argument('--watlas', required=True)
    parser.add_argument('--meshes', default='../shared/data/public')
    parser.add_argument('--most-faces', type=int, default=20000)
    args = parser.parse_args()
    rows = []
    print('| file | faces | xatlas: charts | seam | L2 | fill | at its L2: charts | seam | L2 | fill | game: charts | seam | '
          'L2 | fill |\n|' + '---|' * 14)
    with tempfile.TemporaryDirectory() as folder:
        for pattern in PATTERNS:
            for path in sorted(glob.glob(os.path.join(args.meshes, pattern))):
                try:
                    v, faces, _ = read(path)
                    if not 0 < len(faces) <= args.most_faces:
                        continue
                    given = os.path.join(folder, 'given.obj')
                    with open(given, 'w') as f:
                        f.writelines('v %r %r %r\n' % tuple(map(float, p)) for p in v)
                        f.writelines('f %d %d %d\n' % tuple(c[0] + 1 for c in face) for face in faces)
                    x = by_xatlas(folder, args.watlas, v, faces)
                    same = by_majorant(folder, args.majorant, given, '--max-stretch',
                                       repr(max(LEAST_LIMIT, round(x['l2'], 5))))
                    game = by_majorant(folder, args.majorant, given, '--preset', 'game')
                except (ValueError, IndexError, json.JSONDecodeError, subprocess.TimeoutExpired) as e:
                    print('| %s | %s |' % (os.path.basename(path), str(e)[:100]), flush=True)
                    continue
                rows.append((x, same, game))
                print('| %s | %d | %s |' % (os.path.basename(path), len(faces), ' | '.join(
                    '%d | %.2f | %.4f | %.2f' % (r['charts'], r['seam'], r['l2'], r['fill']) for r in rows[-1])),
                    flush=True)
    if not rows:
        sys.exit('no meshes in %s' % args.meshes)
    median = statistics.median
    ratio = median(same['seam'] / x['seam'] for x, same, _ in rows if x['seam'] > 0)
    charts = median(game['charts'] / x['charts'] for x, _, game in rows)
    fill, their = median(game['fill'] for _, _, game in rows), median(x['fill'] for x, _, _ in rows)
    print('\n%d files; medians: at the L2 of xatlas %.2f of its seam; --preset game: fill %.2f beside %.2f, %.2f of its '
          'charts.' % (len(rows), ratio, fill, their, charts))
    return ratio > 0.5 or fill < 0.55 or charts > 1 / 3


if __name__ == '__main__':
    sys.exit(main())
