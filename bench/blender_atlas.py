#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Blender's smart project and majorant unwrap on the same meshes, measured by the same code.

  charts    pieces that are connected across edges whose two sides have the same texture coordinates
  seam      length of the other inner edges, relative to the square root of the surface's area
  E         symmetric Dirichlet energy, mean over the surface, at the scale of the layout that minimizes it
  stretch   mean square stretch [SSGH01] at equal areas; 1 is an isometry
  fill      area of the triangles in the plane, relative to that of the square around them
  flipped   triangles without positive area; E and stretch are then those of the others

Smart project: angle limit 66 degrees and area weight 0, its defaults, island margin 0.004, which is the
padding of 4 pixels of 1024. The times are not compared. Debian: apt-get install blender.

Sample runs:
  bench/blender_atlas.py                                                 # SHARED/data/public/closed
  bench/blender_atlas.py 'messy/derived/cube_8*' --flags='--max-stretch 1.05'
"""
import argparse
import math
import sys
import tempfile
from pathlib import Path

import numpy as np

HEADER = ('file', 'by', 'charts', 'seam', 'E', 'stretch', 'fill', 'flipped')
ISLAND_MARGIN, ANGLE_LIMIT = 0.004, 66.0


# ------------------------------------------------------------------ inside of Blender
def project_all(folder):
    """Maps each NAME.npz (vertices, faces) of the folder to NAME.npy, #F by 3 by 2."""
    import bpy
    for path in sorted(Path(folder).glob('*.npz')):
        data = np.load(path)
        mesh = bpy.data.meshes.new(path.stem)
        mesh.from_pydata(data['vertices'].tolist(), [], data['faces'].tolist())
        thing = bpy.data.objects.new(path.stem, mesh)
        bpy.context.collection.objects.link(thing)
        bpy.context.view_layer.objects.active = thing
        thing.select_set(True)
        bpy.ops.object.mode_set(mode='EDIT')
        bpy.ops.mesh.select_all(action='SELECT')
        bpy.ops.uv.smart_project(angle_limit=math.radians(ANGLE_LIMIT), island_margin=ISLAND_MARGIN)
        bpy.ops.object.mode_set(mode='OBJECT')
        uv = np.empty(2 * len(mesh.loops))
        mesh.uv_layers.active.data.foreach_get('uv', uv)
        np.save(path.with_suffix('.npy'), uv.reshape(-1, 3, 2))
        thing.select_set(False)


# ------------------------------------------------------------------ measures
def triangles_of(path):
    """Returns vertices (#V by 3), faces (#F by 3), texture coordinates (#F by 3 by 2) or None, of an OBJ."""
    vertices, vt, faces, texture = [], [], [], []
    for line in Path(path).read_text().splitlines():
        words = line.split()
        if words[:1] == ['v']:
            vertices.append([float(x) for x in words[1:4]])
        elif words[:1] == ['vt']:
            vt.append([float(x) for x in words[1:3]])
        elif words[:1] == ['f']:
            corners = [word.split('/') for word in words[1:]]
            if len(corners) != 3:
                sys.exit('%s: triangles only' % path)
            faces.append([int(c[0]) - 1 for c in corners])
            texture.append([int(c[1]) - 1 for c in corners if len(c) > 1 and c[1]])
    uv = np.array(vt)[np.array(texture)] if all(map(len, texture)) else None
    return np.array(vertices), np.array(faces), uv


def squares(vertices, faces, uv):
    """Returns (|J|^2, |J^-1|^2, area on the surface, signed area in the plane), by face."""
    a, b = (vertices[faces[:, k]] - vertices[faces[:, 0]] for k in (1, 2))
    length = np.linalg.norm(a, axis=1)
    x = np.einsum('ij,ij->i', a, b) / length
    y = np.linalg.norm(np.cross(a, b), axis=1) / length
    p, q = uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]
    du = p / length[:, None]                              # images of unit vectors along a and across it
    dv = (q - x[:, None] * du) / y[:, None]
    dirichlet = (du ** 2).sum(1) + (dv ** 2).sum(1)
    det = du[:, 0] * dv[:, 1] - du[:, 1] * dv[:, 0]
    with np.errstate(divide='ignore', invalid='ignore'):
        inverse = dirichlet / det ** 2
    area = length * y / 2
    return dirichlet, inverse, area, area * det


def seams_and_charts(vertices, faces, uv):
    """Returns (length of inner edges whose sides differ, number of pieces)."""
    sides, parent, length = {}, list(range(len(faces))), 0.0

    def find(a):
        while parent[a] != a:
            parent[a] = a = parent[parent[a]]
        return a
    for k, face in enumerate(faces.tolist()):
        for i in range(3):
            a, b = face[i - 1], face[i]
            ends = (tuple(uv[k, i - 1]), tuple(uv[k, i]))
            sides.setdefault((min(a, b), max(a, b)), []).append((k, ends if a < b else ends[::-1]))
    for (a, b), uses in sides.items():
        if len(uses) == 2 and uses[0][1] == uses[1][1]:
            parent[find(uses[0][0])] = find(uses[1][0])
        elif len(uses) == 2:
            length += float(np.linalg.norm(vertices[a] - vertices[b]))
    return length, len({find(k) for k in range(len(faces))})


def measure(vertices, faces, uv):
    dirichlet, inverse, area, image = squares(vertices, faces, uv)
    seam, charts = seams_and_charts(vertices, faces, uv)
    good = image > 0
    mean = lambda values: float((area * values)[good].sum() / area[good].sum())
    box = np.ptp(uv.reshape(-1, 2), axis=0)
    return {'charts': charts, 'seam': seam / math.sqrt(area.sum()),
            'E': 2 * math.sqrt(mean(dirichlet) * mean(inverse)),
            'stretch': math.sqrt(mean(inverse) / 2 * image[good].sum() / area[good].sum()),
            'fill': float(np.abs(image).sum() / box.max() ** 2), 'flipped': int((~good).sum())}


# ------------------------------------------------------------------ all meshes
def run_blender(options, meshes, folder):
    """Returns texture coordinates by name, for the meshes that Blender mapped."""
    import common
    for path, (vertices, faces, _) in meshes.items():
        np.savez(Path(folder) / (path.stem + '.npz'), vertices=vertices, faces=faces)
    done = common.run([options.blender, '-b', '--factory-startup', '--python', __file__, '--', folder],
                      options.timeout)
    found = {path: Path(folder) / (path.stem + '.npy') for path in meshes}
    if not all(file.exists() for file in found.values()):
        sys.exit('blender: %s' % (done.stderr + done.stdout)[-2000:])
    return {path: np.load(file) for path, file in found.items()}


def run_majorant(options, path, folder):
    import common
    out = Path(folder) / (path.stem + '.obj')
    done = common.run([options.binary, 'unwrap', path, '-o', out, '--scale', 'model', '--quiet', '--threads', 1,
                       *options.flags.split()], options.timeout)
    if done.code not in (0, 4):
        sys.exit(done.stderr)
    return triangles_of(out)


def row(path, by, values):
    return (path.stem, by, values['charts'], '%.2f' % values['seam'], '%.4f' % values['E'],
            '%.3f' % values['stretch'], '%.2f' % values['fill'], values['flipped'])


def main():
    import common
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    common.add_options(parser, timeout=3000)
    parser.add_argument('patterns', nargs='*', default=['closed/*.obj'], help='below SHARED/data/public')
    parser.add_argument('--flags', default='', help='options of unwrap, in one word')
    parser.add_argument('--blender', default='blender', help='the program')
    options = parser.parse_args()
    public, rows = options.shared / 'data/public', []
    meshes = {path: triangles_of(path) for pattern in options.patterns
              for path in sorted(public.glob(pattern))}
    with tempfile.TemporaryDirectory(prefix='majorant_blender_') as folder:
        theirs = run_blender(options, meshes, folder)
        for path, (vertices, faces, _) in meshes.items():
            rows.append(row(path, 'Blender', measure(vertices, faces, theirs[path])))
            rows.append(row(path, 'unwrap', measure(*run_majorant(options, path, folder))))
    print('\n'.join(common.markdown_table(HEADER, rows)))
    return 0


if __name__ == '__main__':
    if 'bpy' in sys.modules:
        project_all(sys.argv[sys.argv.index('--') + 1])
    else:
        sys.exit(main())
