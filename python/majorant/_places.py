# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Point queries: preimages of points of the layout, and nearest points in space."""
from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from . import _arrays, _core, _options
from ._errors import UsageError
from ._maps import Map
from ._types import Doubles, Flags, Integers


class Places(NamedTuple):
    """The preimages of points of the layout, of any shape S."""
    face: Integers  #: S: row of `Map.faces`; -1: the point is proven to lie outside of the layout
    bary: Doubles  #: S + (3,): barycentric coordinates, >= 0; all 0 outside of the layout
    undecided: Flags  #: S: whether the preimage is not proven, or within rounding of the layout's border


class Preimages(NamedTuple):
    """All preimages of points of the layout, of any shape S, in one list."""
    point: Integers  #: (#,): index of the point, ascending; row by row in S
    face: Integers  #: (#,): row of `Map.faces`, ascending for each point
    bary: Doubles  #: (#, 3)
    undecided: Flags  #: (#,): whether there may be another number of preimages here


class NearestPoints(NamedTuple):
    """The nearest points of a surface to points in space, of any shape S."""
    face: Integers  #: S: row of F
    bary: Doubles  #: S + (3,): barycentric coordinates, >= 0
    distance: Doubles  #: S


class InverseMap:
    """The inverse of a map: from points of the layout to points of the surface, proven.

        inverse = majorant.InverseMap(r)
        face, bary, undecided = inverse.locate(uv)             # uv: (..., 2)
        xyz = (V[r.faces[face]] * bary[..., None]).sum(-2)     # where face >= 0

    In a layout without overlaps, every point inside has exactly one preimage, and points outside have none. A point on
    an edge or a vertex belongs to the face of least index. Straight faces are decided exactly. On curved faces the
    iteration is proven to contract; a point that the rounding of its last digits leaves open counts as inside and
    is `undecided`. r.evaluate(face, bary) is uv to 1e-12 of the layout; on the border its rounding may place it just
    outside.

    r: a `Map`, of any degree, of charts or seamless. Not for the nearest point of a layout, since points outside have
    no preimage; for nearest points in space use `SurfaceTree`.
    """

    def __init__(self, r: Map):
        if not isinstance(r, Map):
            raise UsageError(f'{type(r).__name__} is no Map; take one that a solver or `read` returns')
        self._inverse = _core.InverseMap(r._file)

    def locate(self, uv: ArrayLike, *, threads: int = 0) -> Places:
        """Returns one preimage of every point, the one of least face index. uv: S + (2,), finite. threads: 0: all;
        results do not depend on it."""
        points, shape = _points('uv', uv, 2)
        face, bary, undecided = self._inverse.locate(points, _threads(threads))
        return Places(face.reshape(shape), bary.reshape((*shape, 3)), undecided.reshape(shape))

    def preimages(self, uv: ArrayLike, *, threads: int = 0) -> Preimages:
        """Returns all preimages of every point; there are several if the map overlaps. Arguments as for `locate`.

            counts = np.bincount(inverse.preimages(uv).point, minlength=len(uv))
        """
        points, _ = _points('uv', uv, 2)
        return Preimages(*self._inverse.locate_all(points, _threads(threads)))


class SurfaceTree:
    """A search tree for nearest points of a triangle surface, exact up to rounding.

        tree = majorant.SurfaceTree(V, F)
        face, bary, distance = tree.nearest(points)            # points: (..., 3)

    V: (#V, 3); F: (#F, 3) triangles of any surface, also with defects. Among faces at the same distance, any may be
    returned. Distances have no sign, so that they do not tell the inside of a solid.
    """

    def __init__(self, V: ArrayLike, F: ArrayLike):
        positions = _arrays.positions(V)
        faces = _arrays.integers('F', F, (None, 3), len(positions), 'vertices')
        if not len(faces):
            raise UsageError('F is empty: a surface needs faces')
        self._tree = _core.SurfaceTree(positions, faces)

    def nearest(self, points: ArrayLike, *, threads: int = 0) -> NearestPoints:
        """Returns the nearest points. points: S + (3,), finite. threads: 0: all; distances do not depend on it."""
        places, shape = _points('points', points, 3)
        face, bary, distance = self._tree.nearest(places, _threads(threads))
        return NearestPoints(face.reshape(shape), bary.reshape((*shape, 3)), distance.reshape(shape))


def _threads(value: Any) -> int:
    return _options.integer('threads', value, 0, 1024)


def _points(name: str, value: Any, dimension: int) -> tuple[Doubles, tuple[int, ...]]:
    """Returns the value as rows of so many finite numbers, and its shape without the last axis."""
    shape = np.shape(value)
    if not shape or shape[-1] != dimension:
        raise UsageError(f'{name} has shape {shape}; the last side must be {dimension}')
    return _arrays.floats(name, value, shape).reshape(-1, dimension), shape[:-1]
