# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Runs in Blender: tests of the add-on on generated objects, by checks of UV layouts that share no code with it.

    blender -b --factory-startup --python-exit-code 1 --python blender_objects.py -- CASE...

The environment has MAJORANT_ADDON, a folder whose majorant_blender is the add-on. Prints `ok CASE` for each case that holds.
"""
import os
import sys
import traceback

import bmesh
import bpy
import numpy as np

sys.dont_write_bytecode = True
sys.path.insert(0, os.environ['MAJORANT_ADDON'])


# ---- checks --------------------------------------------------------------------------------------
def uvs(mesh):
    return np.array([tuple(loop.uv) for loop in mesh.uv_layers.active.data], np.float32)


def triangles_of(mesh):
    mesh.calc_loop_triangles()
    return np.array([tuple(triangle.loops) for triangle in mesh.loop_triangles]).reshape(-1, 3)


def areas(corners):
    a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    return (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2


def overlaps(corners):
    """Returns pairs of triangles with common inner points, by separating axes."""
    corners = corners[areas(corners) != 0]
    ccw = np.where((areas(corners) > 0)[:, None, None], corners, corners[:, ::-1])
    found = 0
    for k in range(len(ccw)):
        others = ccw[k + 1:]
        apart = np.zeros(len(others), bool)
        for i in range(3):
            p, q = ccw[k, i], ccw[k, (i + 1) % 3]
            side = (q - p)[0] * (others[:, :, 1] - p[1]) - (q - p)[1] * (others[:, :, 0] - p[0])
            apart |= (side <= 1e-12).all(1)
            P, Q = others[:, i], others[:, (i + 1) % 3]
            side = ((Q - P)[:, :1] * (ccw[k, :, 1] - P[:, 1:]) - (Q - P)[:, 1:] * (ccw[k, :, 0] - P[:, :1]))
            apart |= (side <= 1e-12).all(1)
        found += int((~apart).sum())
    return found


def require_valid(meshes, square=True, turned=0):
    """Requires that Blender's triangles are positive, do not overlap and lie in the unit square."""
    all_corners = []
    for mesh in meshes:
        uv = uvs(mesh).astype(float)
        assert np.isfinite(uv).all()
        if square:
            assert uv.min() >= 0 and uv.max() <= 1, (uv.min(0), uv.max(0))
        corners = uv[triangles_of(mesh)]
        wrong = int((areas(corners) <= 0).sum())
        assert wrong == turned, f'{wrong} triangles of {mesh.name} are turned over'
        all_corners.append(corners)
    assert overlaps(np.concatenate(all_corners)) == 0, 'triangles overlap'


def stretch(thing, world=True):
    """Returns the largest ratio of edge lengths in the layout and in space, divided by the least one."""
    mesh = thing.data
    matrix = np.array(thing.matrix_world)[:3, :3] if world else np.eye(3)
    V = np.array([tuple(vertex.co) for vertex in mesh.vertices], float) @ matrix.T
    uv, ratios = uvs(mesh).astype(float), []
    for polygon in mesh.polygons:
        loops = list(polygon.loop_indices)
        for a, b in zip(loops, loops[1:] + loops[:1]):
            length = np.linalg.norm(V[mesh.loops[a].vertex_index] - V[mesh.loops[b].vertex_index])
            if length > 0:
                ratios.append(np.linalg.norm(uv[a] - uv[b]) / length)
    return max(ratios) / min(ratios)


def cuts(mesh):
    """Returns the edges with two faces whose uvs differ."""
    uv, sides = uvs(mesh), {}
    for polygon in mesh.polygons:
        loops = list(polygon.loop_indices)
        for a, b in zip(loops, loops[1:] + loops[:1]):
            v, w = mesh.loops[a].vertex_index, mesh.loops[b].vertex_index
            places = (tuple(uv[a]), tuple(uv[b]))
            sides.setdefault((min(v, w), max(v, w)), []).append(places if v < w else places[::-1])
    return {edge for edge, both in sides.items() if len(both) == 2 and both[0] != both[1]}


def islands(mesh):
    """Returns the number of islands: faces are connected by edges with equal uvs."""
    uv, parent, first = uvs(mesh), list(range(len(mesh.polygons))), {}

    def root(k):
        while parent[k] != k:
            parent[k] = parent[parent[k]]
            k = parent[k]
        return k
    for polygon in mesh.polygons:
        places = [tuple(uv[k]) for k in polygon.loop_indices]
        for edge in zip(places, places[1:] + places[:1]):
            parent[root(polygon.index)] = root(first.setdefault(frozenset(edge), polygon.index))
    return len({root(k) for k in range(len(parent))})


def everything_else(thing):
    """Returns the data that an operator on UVs must not change."""
    mesh = thing.data
    return (
        [tuple(vertex.co) for vertex in mesh.vertices],
        [(tuple(edge.vertices), edge.use_seam, edge.use_edge_sharp) for edge in mesh.edges],
        [(tuple(polygon.vertices), polygon.material_index, polygon.use_smooth) for polygon in mesh.polygons],
        [material.name if material else None for material in mesh.materials],
        [modifier.name for modifier in thing.modifiers],
        [tuple(row) for row in thing.matrix_world],
        [(layer.name, [tuple(loop.uv) for loop in layer.data]) for layer in mesh.uv_layers if layer != mesh.uv_layers.active],
        [group.name for group in thing.vertex_groups],
    )


# ---- objects -------------------------------------------------------------------------------------
def clear():
    if bpy.context.mode != 'OBJECT':
        bpy.ops.object.mode_set(mode='OBJECT')
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    for mesh in list(bpy.data.meshes):
        bpy.data.meshes.remove(mesh)


def add(kind, **options):
    getattr(bpy.ops.mesh, f'primitive_{kind}_add')(**options)
    return bpy.context.object


def made_of(name, V, F):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(V, [], F)
    mesh.update()
    thing = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(thing)
    choose(thing)
    return thing


def choose(*things):
    for thing in bpy.data.objects:
        thing.select_set(thing in things)
    bpy.context.view_layer.objects.active = things[0] if things else None
    bpy.context.view_layer.update()


def unwrapped(*things, square=True, turned=0, **options):
    """Unwraps these objects, and checks the properties of every result."""
    choose(*things)
    before = [everything_else(thing) for thing in things]
    assert bpy.ops.majorant.unwrap(**options) == {'FINISHED'}
    assert [everything_else(thing) for thing in things] == before, 'something else was changed'
    require_valid([mesh for mesh in {thing.data for thing in things}], square, turned)
    return things[0].data


def refused(operator, words, **options):
    try:
        operator(**options)
    except RuntimeError as error:
        assert words in str(error), error
    else:
        raise AssertionError(f'no refusal: {words}')


# ---- cases ---------------------------------------------------------------------------------------
def cube():
    thing = add('cube')
    mesh = unwrapped(thing)
    assert len(mesh.uv_layers) == 1 and stretch(thing) < 1.001
    assert bpy.ops.majorant.check() == {'FINISHED'} and bpy.context.scene.majorant.verdict == 'valid'


def cube_without_map():
    thing = add('cube', calc_uvs=False)
    assert not thing.data.uv_layers
    unwrapped(thing)


def monkey():
    thing = add('monkey')
    unwrapped(thing)
    assert stretch(thing) < 4 and islands(thing.data) <= 10


def open_grid():
    thing = add('grid', x_subdivisions=7, y_subdivisions=5, size=3)
    assert islands(unwrapped(thing)) == 1 and stretch(thing) < 1.001


def polygons_of_many_sides():
    unwrapped(add('cylinder', vertices=17))
    unwrapped(add('circle', vertices=32, fill_type='NGON'))


def mixed_polygons():
    thing = add('uv_sphere', segments=12, ring_count=8)
    assert {len(polygon.vertices) for polygon in thing.data.polygons} == {3, 4}
    unwrapped(thing)


def torus_with_a_handle():
    unwrapped(add('torus', major_segments=16, minor_segments=8))


def concave_polygon():
    base = [(0, 0), (3, 0), (3, 1), (2, 1), (2, 3), (1, 3), (1, 1), (0, 1)]
    V = [(x, y, z) for z in (0, 1) for x, y in base]
    n = len(base)
    F = [tuple(range(n))[::-1], tuple(range(n, 2 * n))] + [(k, (k + 1) % n, n + (k + 1) % n, n + k) for k in range(n)]
    thing = made_of('tee', V, F)
    unwrapped(thing)
    assert stretch(thing) < 1.001


def bent_quad():
    """A quad whose image is not convex: Blender's triangles of it must be positive."""
    unwrapped(made_of('arrow', [(0, 0, 0), (4, -2, 0), (1, 0, 0.2), (4, 2, 0)], [(0, 1, 2, 3)]))


def mirrored():
    thing = add('monkey', scale=(-1, 1, 1))
    thing.scale = (-1, 1, 1)
    unwrapped(thing)


def far_from_the_origin():
    thing = add('monkey', location=(1e6, -2e6, 3e5))
    unwrapped(thing)
    other = add('cube')
    for vertex in other.data.vertices:
        vertex.co.x += 20000
    unwrapped(other)
    assert stretch(other) < 1.001


def scaled():
    thing = add('cube')
    thing.scale = (1, 5, 0.2)
    unwrapped(thing)
    assert stretch(thing) < 1.001, 'the layout is not that of the object in the world'
    unwrapped(thing, scale=False)
    assert stretch(thing, world=False) < 1.001


def tiny_and_flat():
    thing = add('cube')
    thing.scale = (1e-5, 1e-5, 1e-5)
    unwrapped(thing)
    thing.scale = (1, 1, 0)
    unwrapped(thing)


def modifiers():
    thing = add('monkey')
    thing.modifiers.new('halves', 'MIRROR')
    thing.modifiers.new('smooth', 'SUBSURF').levels = 2
    unwrapped(thing)
    assert len(thing.modifiers) == 2 and len(thing.data.polygons) == 500


def two_materials():
    thing = add('cube')
    for name in ('red', 'blue'):
        thing.data.materials.append(bpy.data.materials.new(name))
    for polygon in thing.data.polygons:
        polygon.material_index = polygon.index % 2
        polygon.use_smooth = polygon.index == 3
    unwrapped(thing)


def marked_seams():
    thing = add('cube')
    marked = {(0, 1), (2, 3), (4, 5), (6, 7), (1, 3), (1, 5), (5, 7)}
    keys = {tuple(sorted(edge.vertices)): edge for edge in thing.data.edges}
    chosen = {key for key in marked if key in keys}
    for key in chosen:
        keys[key].use_seam = True
    unwrapped(thing, seams='MARKED')
    assert cuts(thing.data) == chosen, (cuts(thing.data), chosen)
    sphere = add('uv_sphere', segments=16, ring_count=8)  # a marked equator, and automatic seams
    equator = [edge for edge in sphere.data.edges if all(abs(sphere.data.vertices[v].co.z) < 1e-6 for v in edge.vertices)]
    assert len(equator) == 16
    for edge in equator:
        edge.use_seam = True
    unwrapped(sphere)
    assert {tuple(sorted(edge.vertices)) for edge in equator} <= cuts(sphere.data)
    unwrapped(sphere, seams='MARKED')
    assert {tuple(sorted(edge.vertices)) for edge in equator} == cuts(sphere.data) and islands(sphere.data) == 2


def seams_of_the_map():
    thing = add('cube')
    unwrapped(thing)
    for edge in thing.data.edges:
        edge.use_seam = False
    before = cuts(thing.data)
    unwrapped(thing, seams='UV')
    assert cuts(thing.data) == before


def pins():
    thing = add('grid', x_subdivisions=6, y_subdivisions=6, calc_uvs=True)
    layer = thing.data.uv_layers.active.data
    held, place = {}, {0: (0.05, 0.11), 3: (0.21, 0.1), 20: (0.4, 0.26)}
    for loop, entry in zip(thing.data.loops, layer):
        if loop.vertex_index in place:
            entry.uv = place[loop.vertex_index]
            entry.pin_uv = True
            held[loop.index] = tuple(entry.uv)
    assert held
    unwrapped(thing, square=False)
    after = uvs(thing.data)
    assert all(tuple(after[loop]) == place for loop, place in held.items()), 'a pin moved'
    assert [entry.pin_uv for entry in layer].count(True) == len(held)
    unwrapped(thing, hold_pins=False)
    assert any(tuple(uvs(thing.data)[loop]) != place for loop, place in held.items())


def loose_parts():
    V, F = [], []
    for k in range(4):
        V += [(x + 3 * k, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1 + k)]
        F += [tuple(8 * k + v for v in face) for face in ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4),
                                                          (1, 5, 7, 3))]
    V += [(50, 50, 50)]  # a vertex without a face
    thing = made_of('loose', V, F)
    unwrapped(thing)
    assert islands(thing.data) >= 4 and stretch(thing) < 1.001


def empty_mesh():
    thing = made_of('empty', [], [])
    refused(bpy.ops.majorant.unwrap, 'nothing to work on')
    other = add('cube')
    choose(thing, other)
    assert bpy.ops.majorant.unwrap() == {'FINISHED'}  # without the empty one
    require_valid([other.data])
    wires = made_of('points', [(0, 0, 0), (1, 0, 0)], [])
    refused(bpy.ops.majorant.unwrap, 'nothing to work on')
    assert not wires.data.uv_layers


def not_manifold():
    thing = made_of('book', [(0, 0, 0), (0, 0, 1), (1, 0, 0), (1, 0, 1), (0, 1, 0), (0, 1, 1), (-1, -1, 0), (-1, -1, 1)],
                    [(0, 2, 3, 1), (0, 4, 5, 1), (0, 6, 7, 1)])
    unwrapped(thing, turned=sum(areas(uvs_after(thing)[triangles_of(thing.data)]) <= 0))


def uvs_after(thing):
    choose(thing)
    assert bpy.ops.majorant.unwrap() == {'FINISHED'}
    return uvs(thing.data).astype(float)


def turned_faces():
    """A face of opposite orientation has opposite orientation in the layout, and no other face has."""
    thing = made_of('strip', [(x, y, 0) for x in range(5) for y in (0, 1)],
                    [(0, 2, 3, 1), (2, 4, 5, 3), (4, 5, 7, 6), (6, 8, 9, 7)])
    unwrapped(thing, turned=2)


def doubled_vertices():
    thing = add('cube')
    V, F = [], []
    for polygon in thing.data.polygons:
        F.append(tuple(range(len(V), len(V) + 4)))
        V += [tuple(thing.data.vertices[v].co) for v in polygon.vertices]
    split = made_of('split', V, F)
    unwrapped(split, join=False)
    places = uvs(split.data)
    alone = len(np.unique(places, axis=0))
    unwrapped(split)
    assert len(np.unique(uvs(split.data), axis=0)) < alone == 24, 'equal edges were not joined'


def faces_without_area():
    thing = made_of('flat', [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (2, 0, 0), (2, 1, 0), (1, 0.5, 0)],
                    [(0, 1, 6, 2, 3), (1, 4, 5, 2), (1, 2, 6)])
    choose(thing)
    assert bpy.ops.majorant.unwrap() == {'FINISHED'}
    assert overlaps(uvs(thing.data).astype(float)[triangles_of(thing.data)]) == 0


def several_objects():
    a, b, c = add('cube'), add('monkey', location=(5, 0, 0)), add('cone')
    unwrapped(a, b, c)
    for thing in (a, b, c):
        choose(thing)
        assert bpy.ops.majorant.check() == {'FINISHED'}
    choose(a, b, c)
    assert bpy.ops.majorant.unwrap(together=False) == {'FINISHED'}
    for thing in (a, b, c):
        require_valid([thing.data])
        assert np.ptp(uvs(thing.data), axis=0).max() > 0.9, 'an object has no square of its own'
    bpy.ops.majorant.check(together=True)
    assert bpy.context.scene.majorant.verdict == 'invalid', 'overlaps of objects are not found'


def shared_mesh():
    a = add('cube')
    b = bpy.data.objects.new('twin', a.data)
    bpy.context.collection.objects.link(b)
    unwrapped(a, b)


def selected_faces():
    thing = add('grid', x_subdivisions=8, y_subdivisions=8)
    chosen = list(range(20))
    before = uvs(thing.data)
    bpy.context.tool_settings.mesh_select_mode = (False, False, True)
    bpy.ops.object.mode_set(mode='EDIT')
    bpy.ops.mesh.select_all(action='DESELECT')
    edited = bmesh.from_edit_mesh(thing.data)
    for face in edited.faces:
        face.select_set(face.index in chosen)
    bmesh.update_edit_mesh(thing.data)
    assert bpy.ops.majorant.unwrap() == {'FINISHED'}
    assert thing.mode == 'EDIT'
    bpy.ops.object.mode_set(mode='OBJECT')
    after = uvs(thing.data)
    inside = np.zeros(len(before), bool)
    for k in chosen:
        inside[list(thing.data.polygons[k].loop_indices)] = True
    assert 0 < inside.sum() < len(inside)
    assert (after[~inside] == before[~inside]).all() and (after[inside] != before[inside]).any()
    assert [polygon.index for polygon in thing.data.polygons if polygon.select] == chosen


def edited_maps():
    """UV maps of an edited mesh are read and written, too: packed, checked, unwrapped by their borders, with pins."""
    thing = add('cube')
    unwrapped(thing, seams='SHARP', charts=6)
    layer = thing.data.uv_layers.active.data
    for entry in layer:
        entry.uv = entry.uv.x * 3 - 7, entry.uv.y * 3 + 2
    bpy.ops.object.mode_set(mode='EDIT')
    bpy.ops.mesh.select_all(action='SELECT')
    assert bpy.ops.majorant.pack() == {'FINISHED'}
    assert bpy.ops.majorant.check() == {'FINISHED'} and bpy.context.scene.majorant.verdict == 'valid'
    bpy.ops.object.mode_set(mode='OBJECT')
    require_valid([thing.data])
    before = cuts(thing.data)
    held = thing.data.polygons[1].loop_indices[0]
    thing.data.uv_layers.active.data[held].pin_uv = True
    place = tuple(thing.data.uv_layers.active.data[held].uv)
    bpy.ops.object.mode_set(mode='EDIT')
    assert bpy.ops.majorant.unwrap(seams='UV') == {'FINISHED'}
    assert bpy.ops.majorant.check(select=True) == {'FINISHED'} and bpy.context.scene.majorant.verdict == 'valid'
    bpy.ops.object.mode_set(mode='OBJECT')
    require_valid([thing.data], square=False)
    assert cuts(thing.data) == before and tuple(uvs(thing.data)[held]) == place


def new_map():
    thing = add('monkey')
    before = uvs(thing.data)
    assert bpy.ops.majorant.unwrap(new_map=True) == {'FINISHED'}
    assert len(thing.data.uv_layers) == 2 and thing.data.uv_layers.active_index == 1
    require_valid([thing.data])
    thing.data.uv_layers.active_index = 0
    assert (uvs(thing.data) == before).all()


def packed():
    thing = add('cube')
    unwrapped(thing, seams='SHARP')
    layer = thing.data.uv_layers.active.data
    for entry in layer:
        entry.uv = entry.uv.x * 3 - 7, entry.uv.y * 3 + 2
    before, others = uvs(thing.data).astype(float), everything_else(thing)
    assert bpy.ops.majorant.pack(padding=8) == {'FINISHED'}
    assert everything_else(thing) == others
    require_valid([thing.data])
    after = uvs(thing.data).astype(float)
    ratio = [np.linalg.norm(np.diff(after[list(p.loop_indices)], axis=0), axis=1)
             / np.linalg.norm(np.diff(before[list(p.loop_indices)], axis=0), axis=1) for p in thing.data.polygons]
    assert np.ptp(ratio) < 1e-5, 'shapes changed'
    # Islands with a pin keep their bits, and the others are placed beside them.
    thing = add('cube')
    unwrapped(thing, seams='SHARP', sharp_angle=30, charts=6)
    loops = list(thing.data.polygons[2].loop_indices)
    layer = thing.data.uv_layers.active.data
    assert islands(thing.data) > 1
    layer[loops[0]].pin_uv = True
    before = uvs(thing.data)
    assert bpy.ops.majorant.pack() == {'FINISHED'}
    assert (uvs(thing.data)[loops] == before[loops]).all()
    require_valid([thing.data], square=False)


def checked():
    thing = add('grid', x_subdivisions=4, y_subdivisions=4)
    assert bpy.ops.majorant.check() == {'FINISHED'} and bpy.context.scene.majorant.verdict == 'valid'
    layer, polygon = thing.data.uv_layers.active.data, thing.data.polygons[5]
    places = [tuple(layer[k].uv) for k in polygon.loop_indices]
    for k, place in zip(polygon.loop_indices, places[::-1]):
        layer[k].uv = place
    before = uvs(thing.data)
    bpy.ops.majorant.check()
    assert bpy.context.scene.majorant.verdict == 'invalid'
    assert [p.index for p in thing.data.polygons if p.select] == [5]
    assert (uvs(thing.data) == before).all()
    for k, place in zip(polygon.loop_indices, [tuple(layer[k].uv) for k in thing.data.polygons[9].loop_indices]):
        layer[k].uv = place
    bpy.ops.majorant.check()
    assert bpy.context.scene.majorant.verdict == 'invalid'
    assert 5 in {p.index for p in thing.data.polygons if p.select}
    bare = add('cube', calc_uvs=False)
    choose(bare)
    refused(bpy.ops.majorant.check, 'no UV map')
    refused(bpy.ops.majorant.pack, 'no UV map')


def quads():
    thing = add('monkey', location=(3, 2, 1), scale=(1, 1, 1))
    thing.scale = (-1, 2, 1)
    thing.data.materials.append(bpy.data.materials.new('skin'))
    thing.modifiers.new('smooth', 'SUBSURF')
    choose(thing)
    before = everything_else(thing)
    assert bpy.ops.majorant.quads(count=800) == {'FINISHED'}
    new = bpy.context.object
    assert new != thing and thing.hide_get() and everything_else(thing) == before
    assert {len(polygon.vertices) for polygon in new.data.polygons} == {4} and len(new.data.polygons) > 400
    assert not new.data.validate() and [m.name for m in new.data.materials] == ['skin']
    old = [np.array([tuple(v.co) for v in t.data.vertices]) for t in (thing, new)]
    assert (abs(old[0].max(0) - old[1].max(0)) < 0.1).all() and (abs(old[0].min(0) - old[1].min(0)) < 0.1).all()
    assert (np.array(new.matrix_world) == np.array(thing.matrix_world)).all()
    for material in (new, thing):
        assert len(material.data.materials) == 1


def baked():
    thing = add('monkey')
    picture = bpy.data.images.new('picture', 64, 64)
    v, u = np.meshgrid((np.arange(64) + 0.5) / 64, (np.arange(64) + 0.5) / 64, indexing='ij')
    picture.pixels.foreach_set(np.stack([u, v, 0.25 + 0 * u, 1 + 0 * u], -1).astype(np.float32).ravel())
    material = bpy.data.materials.new('textured')
    material.use_nodes = True
    node = material.node_tree.nodes.new('ShaderNodeTexImage')
    node.image = picture
    shader = next(n for n in material.node_tree.nodes if n.type == 'BSDF_PRINCIPLED')
    material.node_tree.links.new(node.outputs['Color'], shader.inputs['Base Color'])
    thing.data.materials.append(material)
    choose(thing)
    old = uvs(thing.data)
    assert bpy.ops.majorant.unwrap(new_map=True) == {'FINISHED'}
    layers = [layer.name for layer in thing.data.uv_layers]
    assert bpy.ops.majorant.bake(size=512, image_name='moved') == {'FINISHED'}
    image = bpy.data.images['moved']
    assert tuple(image.size) == (512, 512) and image.packed_file is not None
    assert [layer.name for layer in thing.data.uv_layers] == layers
    pixels = np.array(image.pixels[:]).reshape(512, 512, 4)
    new = uvs(thing.data)
    errors = []
    for corners in triangles_of(thing.data)[::7]:  # colours are the old coordinates
        x, y = np.floor(new[corners].mean(0) * 512).astype(int)
        errors.append(abs(pixels[y, x, :2] - old[corners].mean(0)).max())
    assert np.median(errors) < 0.02, np.median(errors)
    assert bpy.ops.majorant.bake(source='NORMAL', size=64) == {'FINISHED'}
    cube = add('cube')
    choose(cube, thing)
    unwrapped(cube)
    choose(cube, thing)
    assert bpy.ops.majorant.bake(size=64, distance=3, from_map=layers[0], image_name='near') == {'FINISHED'}
    assert 0.2 < np.array(bpy.data.images['near'].pixels[:]).reshape(-1, 4)[:, 2].max() < 0.3
    choose(cube)
    refused(bpy.ops.majorant.bake, 'has no UV map')


CASES = [cube, cube_without_map, monkey, open_grid, polygons_of_many_sides, mixed_polygons, torus_with_a_handle,
         concave_polygon, bent_quad, mirrored, far_from_the_origin, scaled, tiny_and_flat, modifiers, two_materials,
         marked_seams, seams_of_the_map, pins, loose_parts, empty_mesh, not_manifold, turned_faces, doubled_vertices,
         faces_without_area, several_objects, shared_mesh, selected_faces, edited_maps, new_map, packed, checked, quads, baked]


def main():
    import majorant_blender
    majorant_blender.register()
    names = sys.argv[sys.argv.index('--') + 1:] if '--' in sys.argv else []
    for case in CASES:
        if names and case.__name__ not in names:
            continue
        clear()
        try:
            case()
            print(f'ok {case.__name__}', flush=True)
        except Exception:
            print(f'failed {case.__name__}: {traceback.format_exc()}', flush=True)
    majorant_blender.unregister()


if __name__ == '__main__':
    main()
