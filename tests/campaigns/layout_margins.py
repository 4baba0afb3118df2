# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Measures padding and margin of fifty atlases of majorant unwrap on the digits of their OBJ files.

    python3 tests/campaigns/layout_margins.py build/release/apps/majorant [--meshes FOLDER] [--every K]

The atlases include tiles, stacks, densities, upright and kept islands. No measure of the program is used. A
chart is a set of faces connected by vt indices; stacked charts have the same set of edges. The distance of
other charts is the minimum over all pairs of boundary edges, the margin the minimum distance of coordinates
from the border of their tile, both in pixels. The last line counts distances below the padding by more than
1e-6 pixels.
"""
import argparse
import glob
import itertools
import json
import math
import os
import subprocess
import sys
import tempfile

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'apps'))
from command_helpers import obj_text  # noqa: E402
from hard_surfaces import family  # noqa: E402

ROUNDING = 1e-6  # pixels


# ------------------------------------------------------------------ meshes
def turned(points, k):
    """Returns the points after a motion of space that depends on k; every third one is a mirror image."""
    a, b = 0.7 * k, 1.1 * k
    out = []
    for x, y, z in points:
        if k % 3 == 2:
            x = -x
        x, y = x * math.cos(a) - y * math.sin(a), x * math.sin(a) + y * math.cos(a)
        y, z = y * math.cos(b) - z * math.sin(b), y * math.sin(b) + z * math.cos(b)
        out.append((x + 9 * (k % 5), y + 9 * (k // 5), z))
    return out


def copies(points, faces, count):
    """Returns copies of one part, with mirror images."""
    all_points, all_faces = [], []
    for k in range(count):
        base = len(all_points)
        all_points += turned(points, k)
        mirrored = k % 3 == 2
        all_faces += [tuple(base + v for v in (reversed(f) if mirrored else f)) for f in faces]
    return all_points, all_faces


def leaf(n):
    """Returns a bent strip without symmetry, of 2 n triangles."""
    points = [(i / n, s * (1 + 0.3 * math.sin(3 * i / n)) + 0.2 * i / n, 0.1 * math.sin(5 * i / n) * (1 + s))
              for i in range(n + 1) for s in (0, 0.4)]
    faces = [f for i in range(n) for a in [2 * i] for f in ((a, a + 2, a + 3), (a, a + 3, a + 1))]
    return points, faces


def bolt(n):
    """Returns an open hexagonal cap: a fan and its wall, with one corner longer than the others."""
    ring = [(math.cos(2 * math.pi * i / n), math.sin(2 * math.pi * i / n)) for i in range(n)]
    points = [(0, 0, 0.5)] + [(x, y, 0) for x, y in ring] + [(1.1 * x, 1.1 * y, -1 - 0.1 * (i == 0))
                                                             for i, (x, y) in enumerate(ring)]
    faces = [(0, 1 + i, 1 + (i + 1) % n) for i in range(n)]
    for i in range(n):
        a, b = 1 + i, 1 + (i + 1) % n
        faces += [(a, a + n, b + n), (a, b + n, b)]
    return points, faces


def islands(count):
    """Returns textured polygons of all sizes, one island each."""
    points, faces, uv = [], [], []
    for k in range(count):
        n, r = 3 + k % 6, 0.3 + (k % 7) / 3
        base = len(points)
        for i in range(n):
            a = 2 * math.pi * i / n + k
            p = (r * math.cos(a), r * (0.4 + 0.1 * (k % 5)) * math.sin(a))
            points.append((p[0] + 5 * k, p[1], 0.0))
            uv.append(p)
        faces.append(tuple(range(base, base + n)))
    lines = ['v %r %r %r' % p for p in points] + ['vt %r %r' % p for p in uv]
    lines += ['f ' + ' '.join('%d/%d' % (v + 1, v + 1) for v in f) for f in faces]
    return '\n'.join(lines) + '\n'


def runs(folder):
    """Yields (name, text of a mesh, flags, padding, resolution)."""
    solid = [(name, obj_text(points, faces)) for name, points, faces in itertools.islice(family(), 0, 60, 6)]
    heaps = [('leaves', obj_text(*copies(*leaf(6), 30))), ('bolts', obj_text(*copies(*bolt(6), 24)))]
    public = []
    for path in sorted(glob.glob(os.path.join(folder, '*.obj')))[:4]:
        if os.path.getsize(path) < 1 << 20:
            with open(path) as f:
                public.append((os.path.basename(path), f.read()))
    frames = [(4, 1024), (0, 512), (16, 2048), (7, 333)]
    made = 0
    for (name, text), flags in itertools.chain(
            itertools.product(heaps, (['--stack', 'equal'], ['--stack', 'mirrored'], ['--udim', '3'], [],
                                      ['--udim', '4', '--stack', 'mirrored'], ['--upright', 'z'])),
            itertools.product([('islands', islands(60))], (['--seams', 'uv', '--keep-shape'],
                                                           ['--seams', 'uv', '--keep-shape', '--udim', '5'],
                                                           ['--seams', 'uv', '--upright', 'y'])),
            itertools.product(solid, ([], ['--udim', '2'], ['--upright', 'z', '--udim', '3'])),
            itertools.product(public, ([], ['--seams', 'sharp', '--udim', '12']))):
        padding, resolution = frames[made % len(frames)]
        made += 1
        yield name, text, flags, padding, resolution
    text = heaps[0][1]
    for density, tiles in ((40, 1), (90, 3), (150, 9)):
        yield 'leaves', text, ['--texel-density', str(density), '--udim', str(tiles)], 4, 1024


# ------------------------------------------------------------------ the digits
def read(path):
    uv, faces = [], []
    with open(path) as f:
        for line in f:
            if line.startswith('vt '):
                uv.append(tuple(map(float, line.split()[1:3])))
            elif line.startswith('f '):
                faces.append([int(word.split('/')[1]) - 1 for word in line.split()[1:]])
    return np.array(uv), faces


def charts_of(uv, faces):
    parent = list(range(len(uv)))

    def find(a):
        while parent[a] != a:
            parent[a] = parent[parent[a]]
            a = parent[a]
        return a
    for face in faces:
        for t in face:
            parent[find(t)] = find(face[0])
    charts = {}
    for face in faces:
        charts.setdefault(find(face[0]), []).append(face)
    return list(charts.values())


def edges_of(chart):
    """Returns edges as pairs of vt indices, with their numbers of faces."""
    count = {}
    for face in chart:
        for a, b in zip(face, face[1:] + face[:1]):
            count[min(a, b), max(a, b)] = count.get((min(a, b), max(a, b)), 0) + 1
    return count


def distance(a, b):
    """Returns the least distance of two sets of segments, n x 4 and m x 4; 0 if two cross."""
    p, q = a[:, None, :2], a[:, None, 2:]
    r, s = b[None, :, :2], b[None, :, 2:]

    def cross(o, x, y):
        u, v = x - o, y - o
        return u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]
    crosses = (cross(p, q, r) * cross(p, q, s) < 0) & (cross(r, s, p) * cross(r, s, q) < 0)
    if crosses.any():
        return 0.0

    def to_segment(x, o, e):
        d = e - o
        t = np.clip(((x - o) * d).sum(-1) / np.maximum((d * d).sum(-1), 1e-300), 0, 1)
        return np.sqrt((((x - o) - t[..., None] * d) ** 2).sum(-1))
    return min(to_segment(x, o, e).min() for x, o, e in ((p, r, s), (q, r, s), (r, p, q), (s, p, q)))


def measure(path):
    """Returns (charts, stacks, mirrored, tiles, least distance, least margin); lengths in sides of the
    square."""
    uv, faces = read(path)
    charts = charts_of(uv, faces)
    places, mirrored, tiles, margin = {}, 0, set(), math.inf
    for chart in charts:
        edges = edges_of(chart)
        key = frozenset(frozenset((tuple(uv[a]), tuple(uv[b]))) for a, b in edges)
        area = sum(sum(uv[a][0] * uv[b][1] - uv[a][1] * uv[b][0] for a, b in zip(f, f[1:] + f[:1])) for f in chart)
        mirrored += area < 0
        rim = np.array([[*uv[a], *uv[b]] for (a, b), n in edges.items() if n == 1])
        places.setdefault(key, []).append(rim)
        points = uv[sorted({t for face in chart for t in face})]
        tile = np.floor(points.mean(0))
        tiles.add(tuple(tile))
        margin = min(margin, (points - tile).min(), (tile + 1 - points).min())
    rims = [rim[0] for rim in places.values()]
    boxes = [(r.reshape(-1, 2).min(0), r.reshape(-1, 2).max(0)) for r in rims]
    least = math.inf
    order = sorted(range(len(rims)), key=lambda k: boxes[k][0][0])
    for i, k in enumerate(order):
        for j in order[i + 1:]:
            if boxes[j][0][0] > boxes[k][1][0] + min(least, 1):
                break
            gap = np.maximum(boxes[j][0] - boxes[k][1], boxes[k][0] - boxes[j][1]).max()
            if gap < least:
                for part in range(0, len(rims[k]), 256):
                    least = min(least, distance(rims[k][part:part + 256], rims[j]))
    return len(charts), sum(len(r) > 1 for r in places.values()), mirrored, len(tiles), least, margin


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('majorant')
    parser.add_argument('--meshes', default='../shared/data/public/closed')
    parser.add_argument('--every', type=int, default=1)
    args = parser.parse_args()
    count = near = lost = stacks = mirrored = most = 0
    worst = [math.inf, math.inf]
    with tempfile.TemporaryDirectory() as folder:
        mesh, out, report = (os.path.join(folder, name) for name in ('in.obj', 'out.obj', 'r.json'))
        for name, text, flags, padding, resolution in itertools.islice(runs(args.meshes), 0, None, args.every):
            with open(mesh, 'w') as f:
                f.write(text)
            done = subprocess.run([args.majorant, 'unwrap', mesh, '-o', out, '--threads', '1', '--quiet', '--report', report,
                                   '--padding', str(padding), '--resolution', str(resolution), *flags],
                                  text=True, stderr=subprocess.PIPE)
            count += 1
            if done.returncode:
                lost += 1
                print('%-14s %s exit %d: %s' % (name, ' '.join(flags), done.returncode, done.stderr.strip()[-200:]))
                continue
            found = measure(out)
            with open(report) as f:
                fill = json.load(f)['result']['fill']
            gap, margin = found[4] * resolution, found[5] * resolution
            is_near = gap < padding - ROUNDING or margin < padding - ROUNDING or gap <= 0
            near += is_near
            stacks, mirrored, most = stacks + found[1], mirrored + found[2], max(most, found[3])
            worst = [min(worst[0], gap - padding), min(worst[1], margin - padding)]
            print('%-14s %-44s %3d charts %2d stacks %2d mirrored %2d tiles, fill %.3f: %9.4f and %9.4f px of %g%s' % (
                name, ' '.join(flags), *found[:4], fill, gap, margin, padding, '  NEAR' if is_near else ''), flush=True)
    print('%d atlases, %d stacks, %d mirrored charts, up to %d tiles: %d nearer than their padding, %d lost; least excess '
          '%.3g px of distances, %.3g px of margins' % (count, stacks, mirrored, most, near, lost, *worst))
    return 1 if near + lost > 0 else 0


if __name__ == '__main__':
    sys.exit(main())
