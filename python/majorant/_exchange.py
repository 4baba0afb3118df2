# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of meshio and trimesh, recognized by their attributes; neither package is needed."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ._errors import UnsupportedError, UsageError
from ._types import Doubles

if TYPE_CHECKING:
    from ._maps import Map

# Cells of meshio that are not faces, and its triangles by degree.
_NO_FACES = ('vertex', 'line')
_LAGRANGE = 'VTK_LAGRANGE_TRIANGLE'
_TRIANGLES = ('triangle', 'triangle6', 'triangle10', 'triangle15', 'triangle21', 'triangle28', 'triangle36',
              'triangle45')


def mesh_arrays(mesh: Any) -> tuple[Doubles, Any]:
    """Returns V and F of a mesh of meshio (points, cells) or trimesh (vertices, faces), or of an object with these
    attributes.

        uv = majorant.flatten(*majorant.mesh_arrays(meshio.read('bunny.ply')))

    F is (#F, 3) or, if faces differ in size, a list. Points and lines are left out. Raises UnsupportedError for
    tetrahedra, and for cells with more nodes than corners.
    """
    if hasattr(mesh, 'vertices') and hasattr(mesh, 'faces'):
        return np.asarray(mesh.vertices, dtype=float), np.asarray(mesh.faces)
    if not hasattr(mesh, 'points') or not hasattr(mesh, 'cells'):
        raise UsageError(f'{type(mesh).__name__} has neither vertices and faces nor points and cells')
    blocks = []
    for block in mesh.cells:
        if block.type in _NO_FACES:
            continue
        if block.type not in ('triangle', 'quad') and not block.type.startswith('polygon'):
            raise UnsupportedError(f'cells of type {block.type!r} are no polygons')
        blocks.append(np.asarray(block.data))
    if not blocks:
        raise UsageError('the mesh has no faces')
    if len({block.shape[1] for block in blocks}) == 1:
        return np.asarray(mesh.points, dtype=float), np.concatenate(blocks)
    return np.asarray(mesh.points, dtype=float), [face for block in blocks for face in block]


def to_meshio(map: 'Map', names: str) -> Any:
    try:
        import meshio
    except ImportError:
        raise UsageError('to_meshio needs meshio (Debian: python3-meshio)') from None
    uv = np.zeros((len(map.control_points), 3))
    uv[map.cells, :2] = map.evaluate(np.arange(len(map.cells))[:, None], map._lattice)
    data: dict[str, Any] = {'input_face': [map.input_faces], 'chart': [map.charts]}
    if len(map.distortion):
        data['distortion'] = [map.distortion]
    name = _LAGRANGE if names == 'vtk' and map.degree > 2 else _TRIANGLES[map.degree - 1]
    return meshio.Mesh(map.nodes, [(name, map.cells)], point_data={'uv': uv}, cell_data=data)


def to_trimesh(map: 'Map') -> Any:
    try:
        import trimesh
    except ImportError:
        raise UsageError('to_trimesh needs trimesh') from None
    if map.degree > 1:
        raise UnsupportedError('trimesh has straight triangles; save the map as .obj, which cuts curved ones as it '
                               'takes, or take degree=1')
    return trimesh.Trimesh(vertices=map.nodes, faces=map.cells, process=False,
                           visual=trimesh.visual.TextureVisuals(uv=map.control_points))
