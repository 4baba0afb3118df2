#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Compares majorant unwrap --seams uv --keep-shape on twenty textured files with xatlas' packing of the same
islands.

    npm install watlas@1.0.1
    tests/campaigns/pack_only.py build/release/apps/majorant --watlas node_modules/watlas [--meshes FOLDER]

The files are layouts of other meshes with islands at random positions and rotations. Three values are
measured for every file. First, the largest deviation of an island's point from a motion of the plane, with
one scale for all islands, in sides of the square. Second, the least distance of two islands, by
layout_margins.py. Third, the fill of the square within the border, next to that of xatlas, which leaves no
border (brute force, rotations, the same padding in pixels of an equal square). Files whose islands touch
themselves after the rotation are refused and not counted. Exit code 1 if an island is missing, not congruent
within 1e-12 or nearer than its padding, or the fill is below xatlas'.
"""
import argparse
import glob
import json
import math
import os
import random
import subprocess
import sys
import tempfile

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from layout_margins import charts_of, islands, measure, read  # noqa: E402

PADDING, RESOLUTION = 4, 1024

XATLAS = '''
import * as watlas from '%s/dist/watlas.js';
import { readFileSync } from 'fs';
await watlas.Initialize();
const { uv, indices } = JSON.parse(readFileSync(process.argv[2]));
const atlas = new watlas.Atlas();
atlas.addUvMesh({ vertexUvData: new Float32Array(uv), vertexCount: uv.length / 2, vertexStride: 8,
  indexData: new Uint32Array(indices), indexCount: indices.length });
atlas.computeCharts({});
atlas.packCharts({ padding: %d, resolution: %d, bilinear: false, blockAlign: false, bruteForce: true,
  rotateCharts: true, rotateChartsToAxis: true, createImage: false });
let area = 0;
for (let i = 0; i < atlas.meshCount; ++i) {
  const mesh = atlas.getMesh(i), index = new Uint32Array(mesh.indexCount);
  mesh.getIndexArray(index);
  const p = (k) => mesh.getVertex(index[k]).uv;
  for (let k = 0; k < index.length; k += 3) {
    const [a, b, c] = [p(k), p(k + 1), p(k + 2)];
    area += Math.abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
  }
}
console.log(JSON.stringify({ width: atlas.width, height: atlas.height, atlases: atlas.atlasCount, area }));
'''


def scattered(path, out, seed):
    """Writes the file with its islands rotated and put at random positions."""
    rng = random.Random(seed)
    uv, faces = read(path)
    uv = uv.copy()
    for chart in charts_of(uv, faces):
        points = sorted({t for face in chart for t in face})
        a = rng.uniform(0, 2 * math.pi)
        turn = np.array([[math.cos(a), -math.sin(a)], [math.sin(a), math.cos(a)]])
        uv[points] = 7 * (uv[points] @ turn.T) + [rng.uniform(-3, 3), rng.uniform(-3, 3)]
    k = 0
    with open(path) as f, open(out, 'w') as g:
        for line in f:
            if line.startswith('vt '):
                line = 'vt %r %r\n' % tuple(map(float, uv[k]))
                k += 1
            g.write(line)


def deviation(before, after):
    """Returns the largest distance of an island's point from its image under one motion, at the common scale."""
    uv, faces = read(before)
    new, moved = read(after)
    pairs, areas = [], [0.0, 0.0]
    for chart, other in zip(charts_of(uv, faces), charts_of(new, moved)):
        corners = dict(zip((t for f in chart for t in f), (t for f in other for t in f)))
        a, b = uv[list(corners)], new[list(corners.values())]
        pairs.append((a - a.mean(0), b - b.mean(0)))
        for side, (points, list_) in enumerate(((uv, chart), (new, other))):
            for f in list_:
                areas[side] += sum(points[s][0] * points[t][1] - points[s][1] * points[t][0]
                                   for s, t in zip(f, f[1:] + f[:1]))
    scale = math.sqrt(areas[1] / areas[0])
    worst = 0
    for a, b in pairs:
        c, s = (a * b).sum(), (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum()
        c, s = c / math.hypot(c, s), s / math.hypot(c, s)
        turn = np.array([[c, -s], [s, c]])
        worst = max(worst, np.sqrt((((scale * a) @ turn.T - b) ** 2).sum(1)).max())
    return worst


def xatlas(folder, package, path):
    uv, faces = read(path)
    triangles = [t for f in faces for k in range(1, len(f) - 1) for t in (f[0], f[k], f[k + 1])]
    with open(os.path.join(folder, 'mesh.json'), 'w') as f:
        json.dump({'uv': [float(x) for p in uv for x in p], 'indices': triangles}, f)
    with open(os.path.join(folder, 'pack.mjs'), 'w') as f:
        f.write(XATLAS % (os.path.abspath(package), PADDING, RESOLUTION))
    done = subprocess.run(['node', os.path.join(folder, 'pack.mjs'), os.path.join(folder, 'mesh.json')], text=True,
                          stdout=subprocess.PIPE, check=True)
    return json.loads(done.stdout.splitlines()[-1])


def files(folder, program, out):
    """Yields the paths of the textured files."""
    path = os.path.join(out, 'islands.obj')
    with open(path, 'w') as f:
        f.write(islands(60))
    yield 'islands', path
    for source in sorted(glob.glob(os.path.join(folder, 'closed', '*.obj')) +
                         glob.glob(os.path.join(folder, 'disks', '*_500.obj'))):
        name = os.path.basename(source)[:-4]
        path = os.path.join(out, name + '.obj')
        angle = 20 if '_500' in name else 45
        done = subprocess.run([program, 'unwrap', source, '-o', path, '--quiet', '--threads', '1', '--weld', 'no', '--seams',
                               'sharp=%d' % angle], stderr=subprocess.PIPE, text=True)
        if done.returncode == 0:
            yield name, path


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('majorant')
    parser.add_argument('--watlas')
    parser.add_argument('--meshes', default='../shared/data/public')
    parser.add_argument('--count', type=int, default=20)
    args = parser.parse_args()
    bad, ahead, count, worst, refused = 0, 0, 0, 0, []
    print('| file | islands | off by | pixels apart | fill | xatlas | pixels |\n|---|---|---|---|---|---|---|')
    with tempfile.TemporaryDirectory() as folder:
        given, out, report = (os.path.join(folder, name) for name in ('given.obj', 'out.obj', 'r.json'))
        for name, path in files(args.meshes, args.majorant, folder):
            if count == args.count:
                break
            scattered(path, given, count)
            size, their = RESOLUTION, None
            if args.watlas:
                printed = xatlas(folder, args.watlas, given)
                size = max(printed['width'], printed['height'])
                their = printed['area'] / size ** 2 / printed['atlases']
            done = subprocess.run([args.majorant, 'unwrap', given, '-o', out, '--seams', 'uv', '--keep-shape', '--quiet',
                                   '--threads', '1', '--padding', str(PADDING), '--resolution', str(size), '--report',
                                   report], stderr=subprocess.PIPE, text=True)
            if done.returncode == 3 and 'overlaps itself' in done.stderr:
                refused.append(name)
                continue
            count += 1
            if done.returncode:
                bad += 1
                print('| %s | exit %d: %s |' % (name, done.returncode, done.stderr.strip()[-200:]))
                continue
            with open(report) as f:
                fill = json.load(f)['result']['fill'] / (1 - 2 * PADDING / size) ** 2
            off, found = deviation(given, out), measure(out)
            gap = found[4] * size
            is_bad = off > 1e-12 or gap < PADDING - 1e-6 or (their is not None and fill < their)
            bad, worst = bad + is_bad, max(worst, off)
            ahead += their is not None and fill >= their
            print('| %s | %d | %.1e | %.4f | %.4f%s | %s | %d |' % (
                name, found[0], off, gap, fill, ' BAD' if is_bad else '', '-' if their is None else '%.4f' % their,
                size), flush=True)
    print('\n%d files: off by %.1e at most, fill at least as xatlas in %d, %d bad; refused, since islands touch '
          'themselves: %s.' % (count, worst, ahead, bad, ', '.join(refused) or 'none'))
    return bad > 0


if __name__ == '__main__':
    sys.exit(main())
