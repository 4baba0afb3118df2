# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""majorant unwrap IN.glb -o OUT.glb, looked at by Blender's own importer: is the model the same, with the new layout?

    python3 tests/campaigns/blender_gltf.py build/release/apps/majorant [--count 60] [--blender blender]

The files are those of tests/gltf/gltf_files.py (transforms, strips, sparse accessors, indices of 8, 16, 32 bit, skins,
morph targets, instances). Both files are imported; compared, object by object, are the corners of all triangles in
space (as sets of triangles: splits along seams renumber vertices), their materials, and the texture coordinates: the
first layer of OUT lies in the unit square, and the texture coordinates that its images read are those that they
read before, corner by corner. Exit 1 where something differs. Debian: apt-get install blender.
"""
import argparse
import json
import os
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))


# ------------------------------------------------------------------ inside of Blender
def layers_read(material, active):
    """Names of the layers that images of the material read."""
    found = set()
    for node in material.node_tree.nodes if material is not None and material.use_nodes else ():
        if node.type != 'TEX_IMAGE':
            continue
        at = node
        while at is not None and at.type != 'UVMAP':
            links = at.inputs['Vector'].links if 'Vector' in at.inputs else ()
            at = links[0].from_node if links else None
        found.add(at.uv_map if at else active)
    return sorted(found)


def imported(path):
    """Of each object: its triangles as their material, corners in space, first texture coordinates, and those that
    images of the material read."""
    import bpy
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=path)
    objects = []
    for thing in sorted(bpy.data.objects, key=lambda thing: thing.name):
        if thing.type != 'MESH':
            continue
        mesh = thing.data
        layers = list(mesh.uv_layers)
        of = lambda layer, polygon: [list(layer.data[k].uv) for k in polygon.loop_indices]
        read = [[mesh.uv_layers[name] for name in layers_read(slot, layers[0].name)] if layers else []
                for slot in mesh.materials] or [[]]
        triangles = [{'material': mesh.materials[p.material_index].name.split('.')[0] if mesh.materials and
                      mesh.materials[p.material_index] else '',
                      'corners': [list(thing.matrix_world @ mesh.vertices[mesh.loops[k].vertex_index].co)
                                  for k in p.loop_indices],
                      'first': of(layers[0], p) if layers else [],
                      'read': [of(layer, p) for layer in read[p.material_index]]} for p in mesh.polygons]
        objects.append({'name': thing.name, 'keys': len(mesh.shape_keys.key_blocks) if mesh.shape_keys else 0,
                        'groups': len(thing.vertex_groups), 'triangles': triangles})
    return {'objects': objects, 'actions': len(bpy.data.actions), 'cameras': len(bpy.data.cameras)}


def import_all(folder):
    import numpy
    numpy.bool = bool  # the importer of Blender 3.4 has the name that numpy 1.24 dropped
    for name in sorted(os.listdir(folder)):
        if name.endswith('.glb'):
            with open(os.path.join(folder, name + '.json'), 'w') as f:
                json.dump(imported(os.path.join(folder, name)), f)


# ------------------------------------------------------------------ comparison
def turned(triangle, k):
    """Its corners from number k on."""
    turn = lambda row: row[k:] + row[:k]
    return {'material': triangle['material'], 'corners': turn(triangle['corners']), 'first': turn(triangle['first']),
            'read': [turn(layer) for layer in triangle['read']]}


def ordered(triangles):
    """In an order that numbers of vertices do not change: each from its least corner on, then all by their corners."""
    least = lambda triangle: min(range(3), key=lambda k: turned(triangle, k)['corners'])
    return sorted((turned(t, least(t)) for t in triangles), key=lambda t: (t['material'], t['corners'], t['read']))


def compare_objects(before, after):
    """What differs, in words."""
    complaints = ['%s: %r, was %r' % (key, after[key], before[key]) for key in ('name', 'keys', 'groups')
                  if before[key] != after[key]]
    old, new = ordered(before['triangles']), ordered(after['triangles'])
    for key in ('material', 'corners', 'read'):
        if [t[key] for t in old] != [t[key] for t in new]:
            complaints.append('%s: %s of %d triangles of %d, was %d' % (
                before['name'], key, sum(a[key] != b[key] for a, b in zip(old, new)), len(new), len(old)))
    flat = [c for t in new for corner in t['first'] for c in corner]
    if len(flat) != 6 * len(new) or min(flat) < 0 or max(flat) > 1:
        complaints.append('%s: no layout in the unit square' % after['name'])
    return complaints


def compare(before, after):
    complaints = ['%s: %d, was %d' % (key, after[key], before[key]) for key in ('actions', 'cameras')
                  if before[key] != after[key]]
    if len(before['objects']) != len(after['objects']):
        return complaints + ['%d objects, was %d' % (len(after['objects']), len(before['objects']))]
    for a, b in zip(before['objects'], after['objects']):
        complaints += compare_objects(a, b)
    return complaints


def main():
    sys.path.insert(0, os.path.join(os.path.dirname(HERE), 'gltf'))
    from gltf_files import random_model
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('majorant', help='the command')
    parser.add_argument('--count', type=int, default=60, help='files')
    parser.add_argument('--blender', default='blender', help='the program')
    options = parser.parse_args()
    codes, bad, triangles = {}, 0, 0
    with tempfile.TemporaryDirectory(prefix='majorant_blender_') as folder:
        at = lambda k, side: os.path.join(folder, '%03d_%s.glb' % (k, side))
        for k in range(options.count):
            with open(at(k, 'in'), 'wb') as f:
                f.write(random_model(k).glb())
            done = subprocess.run([options.majorant, 'unwrap', at(k, 'in'), '-o', at(k, 'out'), '--quiet'],
                                  capture_output=True, text=True)
            codes[done.returncode] = codes.get(done.returncode, 0) + 1
            if done.returncode not in (0, 4):
                print('%d: exit %d, %s' % (k, done.returncode, done.stderr.strip()))
        seen = subprocess.run([options.blender, '-b', '--factory-startup', '--python-exit-code', '1', '--python',
                               os.path.abspath(__file__), '--', folder], capture_output=True, text=True)
        if seen.returncode:
            sys.exit('blender: %s' % (seen.stderr + seen.stdout)[-2000:])
        for k in range(options.count):
            if not os.path.exists(at(k, 'out')):
                continue
            before, after = (json.load(open(at(k, side) + '.json')) for side in ('in', 'out'))
            complaints = compare(before, after)
            triangles += sum(len(o['triangles']) for o in after['objects'])
            bad += bool(complaints)
            for text in complaints:
                print('%d: %s' % (k, text))
    print('%d files, exit codes %s, %d triangles compared, %d differ' % (
        options.count, json.dumps({str(c): n for c, n in sorted(codes.items())}), triangles, bad))
    return 1 if bad else 0


if __name__ == '__main__':
    if 'bpy' in sys.modules:
        import_all(sys.argv[sys.argv.index('--') + 1])
    else:
        sys.exit(main())
