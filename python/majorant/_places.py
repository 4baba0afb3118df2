# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""From places to points of a surface: where a point of the layout comes from, what is nearest in space."""
from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from . import _arrays, _core, _options
from ._errors import UsageError
from ._maps import Map
from ._types import Doubles, Flags, Integers


class Places(NamedTuple):
    """A point of the surface for each of some points of the layout, of any shape S."""
    face: Integers  #: S: row of `Map.faces`; -1: proven to lie outside of the layout
    bary: Doubles  #: S + (3,): barycentric coordinates, >= 0; 0 outside
    undecided: Flags  #: S: not proven, or within rounding of the layout's border


class Preimages(NamedTuple):
    """All points of the surface that a map takes to some points of the layout, one behind the other."""
    point: Integers  #: (#,): the point of the layout, ascending; of S counted row by row
    face: Integers  #: (#,): row of `Map.faces`, ascending for one point
    bary: Doubles  #: (#, 3)
    undecided: Flags  #: (#,): there may be more of them here, or none


class NearestPoints(NamedTuple):
    """The nearest point of a surface for each of some points in space, of any shape S."""
    face: Integers  #: S: row of F
    bary: Doubles  #: S + (3,): barycentric coordinates, >= 0
    distance: Doubles  #: S


class InverseMap:
    """The inverse of a map: from points of the layout to points of the surface, proven.

        inverse = majorant.InverseMap(r)
        face, bary, undecided = inverse.locate(uv)             # uv: (..., 2)
        xyz = (V[r.faces[face]] * bary[..., None]).sum(-2)     # where face >= 0

    A layout without overlaps has exactly one preimage of every point inside and none of those outside.
    A point on an edge or a vertex belongs to the smallest of its faces. Straight faces are decided
    exactly; of curved ones the iteration is proven to contract, and what the rounding of its last digits leaves
    open counts as inside and is `undecided`. What r.evaluate rounds on the border may lie just outside.
    r.evaluate(face, bary) is uv to 1e-12 of the layout.

    r: a `Map`, of any degree, of charts or seamless. Not for the nearest point of a layout: points outside
    have no preimage; `SurfaceTree` knows what is near in space.
    """

    def __init__(self, r: Map):
        if not isinstance(r, Map):
            raise UsageError(f'{type(r).__name__} is no Map; take one that a solver or `read` returns')
        self._inverse = _core.InverseMap(r._file)

    def locate(self, uv: ArrayLike, *, threads: int = 0) -> Places:
        """One preimage of every point, the one with the smallest face. uv: S + (2,), finite. threads: 0 takes
        all; results do not depend on it."""
        points, shape = _points('uv', uv, 2)
        face, bary, undecided = self._inverse.locate(points, _threads(threads))
        return Places(face.reshape(shape), bary.reshape((*shape, 3)), undecided.reshape(shape))

    def preimages(self, uv: ArrayLike, *, threads: int = 0) -> Preimages:
        """All preimages of every point: of maps that overlap, several. Arguments as for `locate`.

            counts = np.bincount(inverse.preimages(uv).point, minlength=len(uv))
        """
        points, _ = _points('uv', uv, 2)
        return Preimages(*self._inverse.locate_all(points, _threads(threads)))


class SurfaceTree:
    """The nearest points of a triangle surface, exact but for rounding.

        tree = majorant.SurfaceTree(V, F)
        face, bary, distance = tree.nearest(points)            # points: (..., 3)

    V: (#V, 3); F: (#F, 3) triangles, of any surface, with defects or not. Of faces at one distance any may
    be named. Not for points inside of solids: distances have no sign.
    """

    def __init__(self, V: ArrayLike, F: ArrayLike):
        positions = _arrays.positions(V)
        faces = _arrays.integers('F', F, (None, 3), len(positions), 'vertices')
        if not len(faces):
            raise UsageError('F is empty: a surface needs faces')
        self._tree = _core.SurfaceTree(positions, faces)

    def nearest(self, points: ArrayLike, *, threads: int = 0) -> NearestPoints:
        """points: S + (3,), finite. threads: 0 takes all; distances do not depend on it."""
        places, shape = _points('points', points, 3)
        face, bary, distance = self._tree.nearest(places, _threads(threads))
        return NearestPoints(face.reshape(shape), bary.reshape((*shape, 3)), distance.reshape(shape))


def _threads(value: Any) -> int:
    return _options.integer('threads', value, 0, 1024)


def _points(name: str, value: Any, dimension: int) -> tuple[Doubles, tuple[int, ...]]:
    """Rows of that many finite numbers, and the shape that they had."""
    shape = np.shape(value)
    if not shape or shape[-1] != dimension:
        raise UsageError(f'{name} has shape {shape}; the last side must be {dimension}')
    return _arrays.floats(name, value, shape).reshape(-1, dimension), shape[:-1]
