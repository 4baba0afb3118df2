#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Checks GLB files of the command by Khronos' validator and Blender's importer: they must be valid, and the
same model.

Models are those of tests/gltf/gltf_files.py (several primitives, strips, sparse and quantized accessors,
skins, morph targets, animations, cameras, instances, tangents, two sets of texture coordinates,
KHR_texture_transform, variants, extras), and OBJ files of triangles with materials and pictures. Commands:
`unwrap`, `unwrap --bake`, `unwrap --preset lightmap`; of OBJ `convert`, `unwrap`, `unwrap --bake`. --more
FOLDER adds GLB files, for example compressed ones; if NAME.plain.glb exists beside NAME.glb, the result is
compared with it.

The validator must find no error in the written file. Blender imports both files, and the script compares them
object by object: the corners of all triangles in space (as sets of triangles, since splits along seams
renumber vertices), their materials, and the numbers of keys, groups, actions and cameras. The new layout must
lie in the unit square, in the requested set. Images must use the same coordinates as before, corner by
corner, except base colours that moved.

Prints a Markdown table and each file that differs; exit code 0 exactly if none does. Needs blender and npm.

Sample runs:
  tests/campaigns/gltf_round_trips.py --build build/release --count 300
  tests/campaigns/gltf_round_trips.py --build build/release --first 41 --count 1 --keep findings
"""
import argparse
import collections
import json
import os
import random
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

HERE = Path(__file__).resolve().parent
MODEL_WAYS = ['unwrap', 'unwrap --bake', 'unwrap --preset lightmap']
OBJ_WAYS = ['obj: convert', 'obj: unwrap', 'obj: unwrap --bake']
# positions of OBJ files are multiples of 2^-10; Blender rotates them
SNAP = 2.0**14


# ------------------------------------------------------------------ inside of Blender
def layers_read(material, active):
    """Returns (names of the layers that base colours read, names of those that other images read)."""
    base, other = [], []
    for node in material.node_tree.nodes if material is not None and material.use_nodes else ():
        if node.type != 'TEX_IMAGE':
            continue
        at = node
        while at is not None and at.type != 'UVMAP':
            links = at.inputs['Vector'].links if 'Vector' in at.inputs else ()
            at = links[0].from_node if links else None
        ends, is_base = [link for output in node.outputs for link in output.links], False
        while ends:                               # through nodes that mix it with factors and vertex colours
            link = ends.pop()
            is_base |= link.to_socket.name == 'Base Color'
            if link.to_node.type in ('MIX', 'MIX_RGB'):
                ends += [after for output in link.to_node.outputs for after in output.links]
        (base if is_base else other).append(at.uv_map if at else active)
    return sorted(set(base)), sorted(set(other))


def imported(path):
    """Returns for each object its triangles: material, corners in space, and layers of texture coordinates
    (all, those that base colours read, those that other images read)."""
    import bpy
    bpy.ops.wm.read_factory_settings(use_empty=True)
    if path.endswith('.obj'):
        bpy.ops.wm.obj_import(filepath=path)
    else:
        bpy.ops.import_scene.gltf(filepath=path)
    objects = []
    for thing in sorted(bpy.data.objects, key=lambda thing: thing.name):
        if thing.type != 'MESH':
            continue
        mesh = thing.data
        names = [layer.name for layer in mesh.uv_layers]
        of = lambda name, polygon: [list(mesh.uv_layers[name].data[k].uv) for k in polygon.loop_indices]
        read = [layers_read(slot, names[0]) if names else ([], []) for slot in mesh.materials] or [([], [])]
        triangles = []
        for p in mesh.polygons:
            material = mesh.materials[p.material_index] if mesh.materials else None
            base, other = read[p.material_index] if mesh.materials else ([], [])
            triangles.append({'material': material.name.split('.')[0] if material else '',
                              'corners': [list(thing.matrix_world @ mesh.vertices[mesh.loops[k].vertex_index].co)
                                          for k in p.loop_indices],
                              'layers': [of(name, p) for name in names], 'base': [of(name, p) for name in base],
                              'other': [of(name, p) for name in other]})
        objects.append({'name': thing.name, 'keys': len(mesh.shape_keys.key_blocks) if mesh.shape_keys else 0,
                        'groups': len(thing.vertex_groups), 'triangles': triangles})
    return {'objects': objects, 'actions': len(bpy.data.actions), 'cameras': len(bpy.data.cameras)}


def import_all(folder):
    import numpy
    numpy.bool = bool  # the importer of Blender 3.4 uses the name that numpy 1.24 removed
    for name in sorted(os.listdir(folder)):
        if name in ('in.glb', 'in.obj', 'out.glb'):
            path = os.path.join(folder, name)
            try:
                found = imported(path)
            except Exception as error:            # a file that Blender cannot import is a finding
                found = {'error': str(error)[-300:]}
            with open(path + '.json', 'w') as f:
                json.dump(found, f)


# ------------------------------------------------------------------ models
def png(value):
    """Returns an image of 8 x 8 pixels."""
    def chunk(kind, data):
        return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))
    rows = b''.join(b'\0' + bytes([value, 16 * x, 16 * y] * 1) + bytes([value, 90, 16 * y]) * 7
                    for x, y in ((k, k) for k in range(8)))
    return (b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', struct.pack('>IIBBBBB', 8, 8, 8, 2, 0, 0, 0)) +
            chunk(b'IDAT', zlib.compress(rows)) + chunk(b'IEND', b''))


def textured_obj(k, folder):
    """Returns triangles of a closed box with a bumpy top, with materials with and without images; positions
    are multiples of 2^-10."""
    r = random.Random(k)
    n, count = r.randint(2, 5), r.randint(1, 4)
    corners, vt, faces = [], [], []
    number = {}
    def vertex(*p):
        if p not in number:
            number[p] = len(corners) + 1
            corners.append(p)
        return number[p]
    for axis in range(3):
        for side in (0, n):
            for j in range(n):
                for i in range(n):
                    square = []
                    for a, b in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)):
                        p = [0, 0, 0]
                        p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3] = side, a, b
                        u = (a + 0.5 * (axis == 1)) / (n + 1)
                        vt.append((u if side else 1 - u, b / n))
                        square.append((vertex(*p), len(vt)))
                    square = square if side else square[::-1]
                    faces += [(square[0], square[1], square[2]), (square[0], square[2], square[3])]
    moved = {p: [c * 256 + r.randint(-60, 60) for c in p] for p in corners}
    lines = ['mtllib in.mtl'] + ['v %r %r %r' % tuple(c / 1024 for c in moved[p]) for p in corners]
    lines += ['vt %r %r' % t for t in vt]
    for f, face in enumerate(faces):
        if f % max(1, len(faces) // (2 * count)) == 0:
            lines.append('usemtl stuff%d' % r.randrange(count))
        lines.append('f ' + ' '.join('%d/%d' % c for c in face))
    materials = []
    for m in range(count):
        materials += ['newmtl stuff%d' % m, 'Kd %.2f 0.5 0.5' % (m / 4)]
        if m == 0 or r.random() < 0.7:
            materials.append('map_Kd in%d.png' % m)
            (folder / ('in%d.png' % m)).write_bytes(png(40 * m))
    (folder / 'in.mtl').write_text('\n'.join(materials) + '\n')
    return '\n'.join(lines) + '\n'


# ------------------------------------------------------------------ comparison
def turned(triangle, k):
    """Returns the triangle with its corners from number k on."""
    turn = lambda row: row[k:] + row[:k]
    return {key: value if key == 'material' else turn(value) if key == 'corners' else [turn(layer) for layer in value]
            for key, value in triangle.items()}


def ordered(triangles):
    """Sorts triangles independently of vertex numbers: each starts at its least corner, then all are ordered
    by corners."""
    least = lambda triangle: min(range(3), key=lambda k: turned(triangle, k)['corners'])
    # Corners at one position have no order.
    triangles = [t for t in triangles if len(set(map(tuple, t['corners']))) == 3]
    return sorted((turned(t, least(t)) for t in triangles),
                  key=lambda t: (t['material'], t['corners'], t['base'], t['other'], t['layers'][:1]))


def in_unit_square(layers):
    flat = [c for layer in layers for corner in layer for c in corner]
    return bool(layers) and min(flat) >= 0 and max(flat) <= 1


def compare_triangles(name, old, new, way):
    complaints = []
    if len(old) != len(new):
        return ['%s: %d triangles, was %d' % (name, len(new), len(old))]
    if not new:
        return []
    def same(key, take):
        wrong = sum(take(a) != take(b) for a, b in zip(old, new))
        if wrong:
            complaints.append('%s: %s of %d triangles of %d differ, was %d' % (name, key, wrong, len(new), len(old)))
    for key in ('material', 'corners', 'other'):
        same(key, lambda t: t[key])
    if way.endswith('--bake'):
        if not in_unit_square([t['layers'][0] for t in new if t['layers']]):
            complaints.append('%s: no layout in the unit square' % name)
        same('readers of base colours', lambda t: len(t['base']))
        if any(t['base'] and t['base'] != [t['layers'][0]] for t in new):
            complaints.append('%s: a base colour does not read the new layout' % name)
        return complaints
    same('base', lambda t: t['base'])
    if way.endswith('convert'):
        return complaints
    at = 1 if way.endswith('lightmap') and old and old[0]['layers'] else 0
    if not in_unit_square([t['layers'][at] for t in new if len(t['layers']) > at]):
        complaints.append('%s: no layout in the unit square in set %d' % (name, at))
    # objects without a set of coordinates have the layout in both files
    if at:
        pairs = [(a, b) for a, b in zip(old, new) if len(set(map(tuple, a['layers'][0]))) > 1]
        if any(a['layers'][0] != b['layers'][0] for a, b in pairs):
            complaints.append('%s: set 0 is not what it was' % name)
    return complaints


def compare_objects(before, after, way):
    """Returns the differences as text."""
    complaints = ['%s: %r, was %r' % (key, after[key], before[key]) for key in ('name', 'keys', 'groups')
                  if before[key] != after[key] and not (way.startswith('obj') and key == 'name')]
    return complaints + compare_triangles(after['name'], ordered(before['triangles']), ordered(after['triangles']), way)


def snapped(model):
    for thing in model['objects']:
        for t in thing['triangles']:
            for layer in (t['corners'], *t['layers'], *t['base'], *t['other']):
                layer[:] = [[round(c * SNAP) / SNAP for c in corner] for corner in layer]
    return model


def compare(before, after, way):
    for name, side in (('input', before), ('result', after)):
        if 'error' in side:
            return ['Blender cannot import the %s: %s' % (name, side['error'])]
    if way.startswith('obj'):
        before, after = snapped(before), snapped(after)
    complaints = ['%s: %d, was %d' % (key, after[key], before[key]) for key in ('actions', 'cameras')
                  if before[key] != after[key]]
    if len(before['objects']) != len(after['objects']):
        return complaints + ['%d objects, was %d' % (len(after['objects']), len(before['objects']))]
    for a, b in zip(before['objects'], after['objects']):
        complaints += compare_objects(a, b, way)
    return complaints


# ------------------------------------------------------------------ runs
Trip = collections.namedtuple('Trip', 'name way code said source result')


def trips(options, folder):
    """Runs the command on all inputs; files are in folders of their own."""
    sys.path.insert(0, str(HERE.parent / 'gltf'))
    from gltf_files import random_model
    todo = []
    for k in range(options.first, options.first + options.count):
        own = folder / ('%04d' % k)
        own.mkdir()
        if k % 4 == 3:
            source, way = own / 'in.obj', OBJ_WAYS[k // 4 % 3]
            source.write_text(textured_obj(k, own))
        else:
            source, way = own / 'in.glb', MODEL_WAYS[k % 4]
            source.write_bytes(random_model(1000 + k).glb())
        todo.append((str(k), way, source, source))
    more = sorted(options.more.glob('*.glb')) if options.more else []
    for k, path in enumerate(p for p in more if not p.name.endswith('.plain.glb')):
        own = folder / path.stem
        own.mkdir()
        shutil.copy(path, own / 'given.glb')
        plain = path.with_suffix('.plain.glb')
        shutil.copy(plain if plain.exists() else path, own / 'in.glb')
        todo.append((path.name, MODEL_WAYS[(k + k // 3) % 3], own / 'given.glb', own / 'in.glb'))
    for name, way, source, reference in todo:
        result = source.parent / 'out.glb'
        words = way.split(': ')[-1].split()
        done = subprocess.run([options.majorant, words[0], source, '-o', result, *words[1:], '--quiet'],
                              capture_output=True, text=True, timeout=120)
        yield Trip(name, way, done.returncode, done.stderr.strip(), reference, result)


def validate(paths, build):
    os.environ['MAJORANT_BUILD_DIR'] = str(build)
    os.environ.setdefault('MAJORANT_SOURCE_DIR', str(HERE.parents[1]))
    from gltf_helpers import validated
    with tempfile.TemporaryDirectory() as folder:
        return validated(map(str, paths), folder)


def import_by_blender(options, written):
    """Imports sources and results; writes a JSON beside each."""
    done = subprocess.run([options.blender, '-b', '--factory-startup', '--python-exit-code', '1', '--python',
                           str(Path(__file__).resolve()), '--', *[str(t.source.parent) for t in written]],
                          capture_output=True, text=True)
    if done.returncode:
        sys.exit('blender: %s' % (done.stderr + done.stdout)[-2000:])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--build', type=Path, required=True, help='build folder with the command, into which the validator is installed')
    parser.add_argument('--count', type=int, default=300, help='files')
    parser.add_argument('--first', type=int, default=0, help='number of the first one')
    parser.add_argument('--more', type=Path, help='folder of more GLB files')
    parser.add_argument('--blender', default='blender', help='the program')
    parser.add_argument('--keep', type=Path, help='folder for the files of trips that differ')
    options = parser.parse_args()
    options.majorant = options.build.resolve() / 'apps/majorant'
    rows = collections.defaultdict(collections.Counter)
    with tempfile.TemporaryDirectory(prefix='majorant_trips_') as name:
        folder = Path(name)
        all_trips = list(trips(options, folder))
        written = [trip for trip in all_trips if trip.code in (0, 4)]
        bad = {trip.name: ['exit %d: %s' % (trip.code, trip.printed)] for trip in all_trips
               if trip.code not in (0, 3, 4)}
        for trip in all_trips:
            if trip.code == 3:
                print('%s (%s): refused: %s' % (trip.name, trip.way, trip.printed))
        before = validate([t.source for t in written if t.source.suffix == '.glb'], options.build.resolve())
        known = {}
        for trip, issues in zip((t for t in written if t.source.suffix == '.glb'), before):
            known[trip.name] = {i['code'] for i in issues if i['severity'] == 0}
        for trip, issues in zip(written, validate([t.result for t in written], options.build.resolve())):
            errors = sorted({i['code'] for i in issues if i['severity'] == 0} - known.get(trip.name, set()))
            rows[trip.way]['errors'] += bool(errors)
            if errors:
                bad.setdefault(trip.name, []).append('validator: %s' % ', '.join(errors))
        import_by_blender(options, written)
        for trip in written:
            old, new = (json.loads(Path(str(p) + '.json').read_text()) for p in (trip.source, trip.result))
            complaints = compare(old, new, trip.way)
            rows[trip.way]['triangles'] += sum(len(o['triangles']) for o in new.get('objects', []))
            rows[trip.way]['differ'] += bool(complaints)
            if complaints:
                bad.setdefault(trip.name, []).extend(complaints)
        for trip in all_trips:
            rows[trip.way]['files'] += 1
            rows[trip.way]['written'] += trip.code in (0, 4)
            rows[trip.way]['refused'] += trip.code == 3
            for text in bad.get(trip.name, []):
                print('%s (%s): %s' % (trip.name, trip.way, text))
            if options.keep and trip.name in bad:
                shutil.copytree(trip.source.parent, options.keep / trip.source.parent.name, dirs_exist_ok=True)
    columns = ['files', 'written', 'refused', 'errors', 'triangles', 'differ']
    print('| way | files | written | refused | errors of the validator | triangles compared | differ in Blender |')
    print('|---' * 7 + '|')
    for way in [*MODEL_WAYS, *OBJ_WAYS, 'all']:
        total = sum(rows.values(), collections.Counter()) if way == 'all' else rows[way]
        print('| %s | %s |' % (way, ' | '.join(str(total[c]) for c in columns)))
    return 1 if bad else 0


if __name__ == '__main__':
    if 'bpy' in sys.modules:
        for folder in sys.argv[sys.argv.index('--') + 1:]:
            import_all(folder)
    else:
        sys.exit(main())
