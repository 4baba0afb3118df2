# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes of Blender as arrays, and arrays back into them.

A `Part` is what an operator works on: the faces of one mesh that are chosen. Its loops are those of these faces, one
after the other. In Edit Mode arrays are those of the edited mesh, and uvs are written through bmesh.
"""
import dataclasses

import bmesh
import bpy
import numpy as np

MOST_LAYERS = 8


@dataclasses.dataclass
class Part:
    """The chosen faces of a mesh.

    positions      (#V, 3) double, vertices in local coordinates, all of the mesh
    faces          (#F,) numbers of the chosen polygons
    starts         (#F + 1,) the first loop of each polygon in the arrays by loop
    loops          (#L,) numbers of the loops in the mesh
    corners        (#L,) rows of positions
    next_edges     (#L,) the edge from the loop's vertex to that of the next one
    seam_edges     (#E,) True for edges of the mesh that are marked as seams; sharp_edges: as sharp
    edges          (#E, 2) vertices
    triangles      (#T, 3) positions in the arrays by loop, of Blender's own triangles; triangle_faces (#T,) rows of faces
    uv, pinned     (#L, 2) float32 and (#L,), of the active UV map; None without one
    linear         (3, 3) the object's rotation and scale
    matrix         (4, 4) the object's place in the world
    """
    name: str
    data: object
    positions: np.ndarray
    faces: np.ndarray
    starts: np.ndarray
    loops: np.ndarray
    corners: np.ndarray
    next_edges: np.ndarray
    edges: np.ndarray
    seam_edges: np.ndarray
    sharp_edges: np.ndarray
    triangles: np.ndarray
    triangle_faces: np.ndarray
    uv: np.ndarray
    pinned: np.ndarray
    linear: np.ndarray
    matrix: np.ndarray
    signature: tuple

    @property
    def loop_faces(self):
        """(#L,) rows of faces."""
        return np.repeat(np.arange(len(self.faces)), np.diff(self.starts))

    def in_world(self):
        """(#L, 3): places of the loops."""
        return self.positions[self.corners] @ self.matrix[:3, :3].T + self.matrix[:3, 3]


def chosen_parts(context, only_selected=True):
    """The parts of all objects that are selected, or edited; a mesh that several objects share is one part. Second: names
    of objects that have nothing to work on, with the reason."""
    editing = context.mode == 'EDIT_MESH'
    objects = context.objects_in_mode if editing else context.selected_objects
    if not objects and context.object is not None:
        objects = [context.object]
    parts, skipped, seen = [], [], set()
    for thing in objects:
        if thing.type != 'MESH':
            skipped.append((thing.name, 'is no mesh'))
            continue
        if thing.data in seen:
            continue
        seen.add(thing.data)
        if thing.data.library is not None:
            skipped.append((thing.name, 'is linked from another file'))
            continue
        part = part_of(thing, editing and only_selected)
        if len(part.faces) == 0:
            skipped.append((thing.name, 'has no selected face' if editing and len(thing.data.polygons) else 'has no face'))
            continue
        parts.append(part)
    return parts, skipped


def part_of(thing, only_selected):
    mesh = thing.data
    if mesh.is_editmode:
        thing.update_from_editmode()
    positions = _column(mesh.vertices, 'co', 3, np.float32).astype(float).reshape(-1, 3)
    totals = _column(mesh.polygons, 'loop_total', 1, np.int32)
    first = _column(mesh.polygons, 'loop_start', 1, np.int32)
    chosen = np.ones(len(totals), bool)
    if only_selected:
        chosen = _column(mesh.polygons, 'select', 1, bool) & ~_column(mesh.polygons, 'hide', 1, bool)
    faces = np.flatnonzero(chosen)
    starts = np.concatenate([[0], np.cumsum(totals[faces])]).astype(int)
    loops = np.arange(starts[-1]) + np.repeat(first[faces] - starts[:-1], totals[faces])
    corners = _column(mesh.loops, 'vertex_index', 1, np.int32)[loops]
    next_edges = _column(mesh.loops, 'edge_index', 1, np.int32)[loops]
    edges = _column(mesh.edges, 'vertices', 2, np.int32).reshape(-1, 2)
    triangles, triangle_faces = _triangles(mesh, chosen, first, starts)
    uv, pinned = layer_of(mesh, mesh.uv_layers.active, loops)
    return Part(thing.name, mesh, positions, faces, starts, loops, corners.astype(int), next_edges.astype(int), edges,
                _column(mesh.edges, 'use_seam', 1, bool), _column(mesh.edges, 'use_edge_sharp', 1, bool), triangles,
                triangle_faces, uv, pinned, linear_part(thing),
                np.array(thing.matrix_world, dtype=float), signature(mesh))


def layer_of(mesh, layer, loops):
    """The uvs and pins of a UV map at these loops, or None, None. Those of an edited mesh are in its bmesh alone."""
    if layer is None:
        return None, None
    if mesh.is_editmode:
        edited = bmesh.from_edit_mesh(mesh)
        key = edited.loops.layers.uv[layer.name]
        entries = [loop[key] for face in edited.faces for loop in face.loops]
        uv = np.array([entry.uv[:] for entry in entries], np.float32).reshape(-1, 2)
        return uv[loops], np.array([entry.pin_uv for entry in entries], bool)[loops]
    uv = _column(layer.data, 'uv', 2, np.float32).reshape(-1, 2)[loops]
    return uv, _column(layer.data, 'pin_uv', 1, bool)[loops]


def linear_part(thing):
    """Rotation and scale of an object in the world; the identity where an axis has no scale."""
    linear = np.array(thing.matrix_world, dtype=float)[:3, :3]
    sizes = np.linalg.svd(linear, compute_uv=False)
    return linear if sizes[-1] > 1e-6 * sizes[0] else np.eye(3)


def signature(mesh):
    """Equal as long as a mesh has the same faces and places."""
    places = _column(mesh.vertices, 'co', 3, np.float32)
    corners = _column(mesh.loops, 'vertex_index', 1, np.int32)
    return len(mesh.polygons), hash(places.tobytes()), hash(corners.tobytes())


def is_unchanged(part):
    """Returns True if the mesh is unchanged since the part was read."""
    try:
        mesh = part.data
        if mesh.is_editmode:
            next(thing for thing in bpy.data.objects if thing.data == mesh).update_from_editmode()
        return signature(mesh) == part.signature
    except (ReferenceError, StopIteration):
        return False


def write_uv(part, uv, layer_name=''):
    """Writes uvs of the part's loops, (#L, 2), into the active UV map, or a new one of that name, which becomes active.
    All else stays, the bits of other loops, too. Returns the name of the map, or None where the mesh has no room."""
    mesh = part.data
    layer = mesh.uv_layers.active
    if layer is None or layer_name:
        if len(mesh.uv_layers) >= MOST_LAYERS:
            return None
        layer = mesh.uv_layers.new(name=layer_name or 'UVMap')
        mesh.uv_layers.active = layer
    name = layer.name
    if mesh.is_editmode:
        _write_edited(mesh, part, uv, name)
    else:
        values = _column(layer.data, 'uv', 2, np.float32).reshape(-1, 2)
        values[part.loops] = uv
        layer.data.foreach_set('uv', values.ravel())
        mesh.update()
    return name


def _write_edited(mesh, part, uv, name):
    edited = bmesh.from_edit_mesh(mesh)
    layer = edited.loops.layers.uv[name]
    edited.faces.ensure_lookup_table()
    rows = uv.tolist()
    for number, begin in zip(part.faces.tolist(), part.starts.tolist()):
        for k, loop in enumerate(edited.faces[number].loops):
            loop[layer].uv = rows[begin + k]
    bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)


def select_faces(part, rows):
    """Selects these rows of the part's faces, and nothing else of its mesh."""
    mesh = part.data
    chosen = np.zeros(len(mesh.polygons), bool)
    chosen[part.faces[rows]] = True
    if mesh.is_editmode:
        edited = bmesh.from_edit_mesh(mesh)
        edited.faces.ensure_lookup_table()
        for face in edited.faces:
            face.select_set(False)
        for number in np.flatnonzero(chosen):
            edited.faces[number].select_set(True)
        edited.select_flush_mode()
        bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)
        return
    corners = _column(mesh.loops, 'vertex_index', 1, np.int32)
    edge_of_loop = _column(mesh.loops, 'edge_index', 1, np.int32)
    of_chosen = np.repeat(chosen, _column(mesh.polygons, 'loop_total', 1, np.int32))
    vertices, edges = np.zeros(len(mesh.vertices), bool), np.zeros(len(mesh.edges), bool)
    vertices[corners[of_chosen]] = True
    edges[edge_of_loop[of_chosen]] = True
    mesh.polygons.foreach_set('select', chosen)
    mesh.edges.foreach_set('select', edges)
    mesh.vertices.foreach_set('select', vertices)
    mesh.update()


def _triangles(mesh, chosen, first, starts):
    mesh.calc_loop_triangles()
    loops = _column(mesh.loop_triangles, 'loops', 3, np.int32).reshape(-1, 3)
    polygon = _column(mesh.loop_triangles, 'polygon_index', 1, np.int32)
    kept = chosen[polygon]
    row = np.cumsum(chosen) - 1
    faces = row[polygon[kept]]
    return loops[kept] + (starts[faces] - first[polygon[kept]])[:, None], faces


def _column(collection, name, width, dtype):
    """One attribute of all elements."""
    values = np.empty(len(collection) * width, dtype)
    collection.foreach_get(name, values)
    return values
