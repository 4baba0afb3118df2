# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Quad meshes of surfaces."""
from __future__ import annotations

import json
import math
import numbers
import os
from typing import Any, Mapping

from numpy.typing import ArrayLike

from . import _arrays, _core, _options
from ._cells import cell, picture, solid_picture
from ._errors import UsageError
from ._types import Callback, Doubles, Faces, Integers


class QuadMesh:
    """A proven pure quad mesh of a surface: V (#V, 3), Q (#Q, 4) rows of V, and the report of the run."""

    def __init__(self, made: _core.Quads):
        self._made = made
        self.V: Doubles = made.vertices
        self.Q: Integers = made.faces
        self.report: dict[str, Any] = json.loads(made.report)
        self.status: str = self.report['status']

    def save(self, path: str | os.PathLike) -> None:
        """Writes .obj, .ply or .vtu as `majorant quads` does. The file is read back and judged before it gets its
        name."""
        _core.save_quads(self._made, _arrays.path(path))

    def _repr_html_(self) -> str:
        """Returns a picture of the mesh, seen from one side, for notebooks."""
        return cell(repr(self), picture(solid_picture(self.V, self.Q)))

    def __repr__(self) -> str:
        return f'<majorant.QuadMesh: {len(self.Q)} quads, {self.report["result"]["quads"]["irregular"]} irregular vertices>'


def quad_mesh(V: ArrayLike, F: Faces, *, count: int | None = None, edge_length: float | None = None,
              features: str | float | ArrayLike | None = None, cones: Mapping[int, int] | None = None,
              strict: bool = False, time_limit: float | None = None, threads: int = 0,
              callback: Callback | None = None) -> QuadMesh:
    """Makes a pure quad mesh of any orientable surface, aligned to a smooth cross field, without folded quads and
    quads that are turned over. Returns a `QuadMesh`.

        quads = majorant.quad_mesh(V, F, count=4000)
        quads.V, quads.Q                     # (#V, 3), (#Q, 4)
        quads.report['result']['quads']['irregular']

        count           number of quads; None: half the number of triangles
        edge_length     edge length of quads in units of V; in place of count
        features        edges that edges of quads cover, like borders: an angle in degrees between the normals of their
                        faces (35, the default without cones), (#E, 2) vertices of edges, or 'none'
        cones           {vertex: quarter turns}, of closed surfaces without features
        strict          whether meshes that need repair are refused (UnsupportedError)

    Limits and callback as for `parametrize`. The report is that of `majorant quads --report`. docs/quads.md
    describes the method. Raises InfeasibleError, with the reason, if no map or no valid quads were found.
    """
    arguments = {k: v for k, v in locals().items() if k not in ('V', 'F', 'callback')}
    mesh = _arrays.mesh(V, F)
    if count is not None and edge_length is not None:
        raise UsageError('count and edge_length both say how many quads there are; leave one of the two out')
    words, edges = _features(features, len(mesh.positions))
    arguments['features'] = words or (f'{len(edges)} edges' if edges is not None else None)
    pairs = None if cones is None else _options.cones(cones, len(mesh.positions))
    arguments['cones'] = pairs and {str(vertex): turns for vertex, turns in pairs}
    keywords = {
        'count': None if count is None else _options.integer('count', count, 1, 100_000_000),
        'edge_length': None if edge_length is None else _options.number('edge_length', edge_length, 0),
        'feature_words': words,
        'feature_edges': edges,
        'cones': pairs,
        'strict': _options.truth('strict', strict),
        'time_limit': math.inf if time_limit is None else _options.number('time_limit', time_limit, 0, zero=True, infinite=True),
        'threads': _options.integer('threads', threads, 0, 1024),
        'as_json': json.dumps(arguments),
    }
    return QuadMesh(_core.quad_mesh(mesh, keywords, _options.callback(callback)))


def _features(features: Any, vertices: int) -> tuple[str, list[list[int]] | None]:
    """Returns features as words of the library, or as pairs of vertices."""
    if features is None:
        return '', None
    if isinstance(features, str):
        return _options.choice('features', features, ('none',)), None
    if isinstance(features, numbers.Real) and not isinstance(features, bool):
        return repr(_options.number('features', features, 0, 180)), None
    return '', _arrays.integers('features', features, (None, 2), vertices, 'vertices').tolist()
