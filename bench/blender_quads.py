#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""QuadriFlow in Blender and majorant quads on the same meshes, measured by the same code.

  quads       number of quads; QuadriFlow is called up to 6 times, until its number is within 5 %
  irregular   inner vertices of other than four quads
  J           mean over quads of the least sine of a corner, with respect to the normal of the diagonals
  min J       the least of these sines
  folded      quads with a corner whose sine is not positive
  angles      mean of |angle - 90 degrees| over corners

QuadriFlow runs with its defaults, which do not follow sharp edges, and seed 0; quads runs without features. With
--sharp both follow sharp edges. A line says so if QuadriFlow makes no quads. Seconds are CPU seconds, of all calls of
QuadriFlow together. Debian: apt-get install blender.

Sample runs:
  bench/blender_quads.py                                   # SHARED/data/public/closed, 4000 quads
  bench/blender_quads.py 'closed/spot*' --count 1000 --sharp
"""
import argparse
import math
import resource
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

HEADER = ('file', 'by', 'quads', 'irregular', 'J', 'min J', 'folded', 'angles', 's')
CLOSE, CALLS = 0.05, 6


# ------------------------------------------------------------------ inside of Blender
def remesh_all(folder, count, is_sharp):
    """Maps each NAME.npz (vertices, faces) of the folder to NAME_quads.npz (vertices, faces, seconds)."""
    import bpy
    for path in sorted(Path(folder).glob('*.npz')):
        data, target_count, best, start = np.load(path), count, None, time.process_time()
        for _ in range(CALLS):
            mesh = bpy.data.meshes.new(path.stem)
            mesh.from_pydata(data['vertices'].tolist(), [], data['faces'].tolist())
            thing = bpy.data.objects.new(path.stem, mesh)
            bpy.context.collection.objects.link(thing)
            bpy.context.view_layer.objects.active = thing
            thing.select_set(True)
            bpy.ops.object.quadriflow_remesh(mode='FACES', target_faces=target_count, seed=0, use_preserve_sharp=is_sharp)
            faces = [list(polygon.vertices) for polygon in thing.data.polygons]
            vertices = np.array([list(vertex.co) for vertex in thing.data.vertices])
            thing.select_set(False)
            if not faces or any(len(face) != 4 for face in faces):
                break
            off = abs(len(faces) / count - 1)
            if best is None or off < best[0]:
                best = off, vertices, np.array(faces)
            if off <= CLOSE:
                break
            target_count = max(1, round(target_count * count / len(faces)))
        if best:
            np.savez(path.with_name(path.stem + '_quads'), vertices=best[1], faces=best[2],
                     seconds=time.process_time() - start)


# ------------------------------------------------------------------ measures
def read_obj(path):
    vertices, faces = [], []
    for line in Path(path).read_text().splitlines():
        words = line.split()
        if words[:1] == ['v']:
            vertices.append([float(x) for x in words[1:4]])
        elif words[:1] == ['f']:
            faces.append([int(word.split('/')[0]) - 1 for word in words[1:]])
    return np.array(vertices), np.array(faces)


def measure(vertices, quads):
    corner = vertices[quads]
    normal = np.cross(corner[:, 2] - corner[:, 0], corner[:, 3] - corner[:, 1])
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)
    ahead = np.roll(corner, -1, axis=1) - corner
    behind = np.roll(corner, 1, axis=1) - corner
    lengths = np.maximum(np.linalg.norm(ahead, axis=2) * np.linalg.norm(behind, axis=2), 1e-300)
    sines = np.einsum('ijk,ik->ij', np.cross(ahead, behind), normal) / lengths
    cosines = np.einsum('ijk,ijk->ij', ahead, behind) / lengths
    angles = np.degrees(np.arccos(np.clip(cosines, -1, 1)))
    sides = np.sort(np.stack([quads, np.roll(quads, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    edges, uses = np.unique(sides, axis=0, return_counts=True)
    valence = np.bincount(quads.ravel(), minlength=len(vertices))
    inner = valence > 0
    inner[edges[uses == 1].ravel()] = False
    least = sines.min(axis=1)
    return {'quads': len(quads), 'irregular': int((inner & (valence != 4)).sum()), 'J': least.mean(), 'min': least.min(),
            'folded': int((least <= 0).sum()), 'angles': np.abs(angles - 90).mean()}


# ------------------------------------------------------------------ all meshes
def run_blender(options, meshes, folder):
    import common
    for path, (vertices, faces) in meshes.items():
        np.savez(Path(folder) / (path.stem + '.npz'), vertices=vertices, faces=faces)
    done = common.run([options.blender, '-b', '--factory-startup', '--python', __file__, '--', folder, options.count,
                       int(options.sharp)], options.timeout)
    if done.code != 0:
        sys.exit('blender: %s' % (done.stderr + done.stdout)[-2000:])
    found = {path: Path(folder) / (path.stem + '_quads.npz') for path in meshes}
    return {path: np.load(file) for path, file in found.items() if file.exists()}


def run_majorant(options, path, folder):
    import common
    out = Path(folder) / (path.stem + '.obj')
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    done = common.run([options.binary, 'quads', path, '-o', out, '--count', options.count, '--quiet', '--threads', 1,
                       *(() if options.sharp else ('--features', 'none'))], options.timeout)
    if done.code not in (0, 4):
        sys.exit(done.stderr)
    return read_obj(out), resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def row(name, by, values, seconds):
    return (name, by, values['quads'], values['irregular'], '%.4f' % values['J'], '%.3f' % values['min'],
            values['folded'], '%.2f' % values['angles'], '%.1f' % seconds)


def main():
    import common
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    common.add_options(parser, timeout=3000)
    parser.add_argument('patterns', nargs='*', default=['closed/*.obj'], help='below SHARED/data/public')
    parser.add_argument('--count', type=int, default=4000)
    parser.add_argument('--sharp', action='store_true', help='edges of quads follow sharp edges')
    parser.add_argument('--blender', default='blender', help='the program')
    options = parser.parse_args()
    public, rows, ratios, deviation = options.shared / 'data/public', [], [], {'QuadriFlow': [], 'quads': []}
    meshes = {path: read_obj(path) for pattern in options.patterns for path in sorted(public.glob(pattern))}
    with tempfile.TemporaryDirectory(prefix='majorant_quads_') as folder:
        theirs = run_blender(options, meshes, folder)
        for path in meshes:
            (vertices, quads), seconds = run_majorant(options, path, folder)
            ours = measure(vertices, quads)
            rows.append(row(path.stem, 'quads', ours, seconds))
            if path not in theirs:
                rows.append((path.stem, 'QuadriFlow', 'none') + ('',) * 6)
                continue
            found = measure(theirs[path]['vertices'], theirs[path]['faces'])
            rows.append(row(path.stem, 'QuadriFlow', found, float(theirs[path]['seconds'])))
            ratios.append((ours['irregular'] + 1) / (found['irregular'] + 1))
            deviation['QuadriFlow'].append(found['angles'])
            deviation['quads'].append(ours['angles'])
    print('\n'.join(common.markdown_table(HEADER, rows)))
    if ratios:
        print('\nOf %d meshes: (irregular + 1) over that of QuadriFlow, geometric mean %.3f, largest %.2f; angles off by '
              '%.2f degrees in the mean, QuadriFlow %.2f.' % (
                  len(ratios), math.exp(np.log(ratios).mean()), max(ratios), np.mean(deviation['quads']),
                  np.mean(deviation['QuadriFlow'])))
    return 0


if __name__ == '__main__':
    if 'bpy' in sys.modules:
        words = sys.argv[sys.argv.index('--') + 1:]
        remesh_all(words[0], int(words[1]), bool(int(words[2])))
    else:
        sys.exit(main())
