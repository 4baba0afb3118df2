# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of quads of surfaces."""
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
    """A pure quad mesh of a surface, judged: V (#V, 3), Q (#Q, 4) rows of V, and the report of the run."""

    def __init__(self, made: _core.Quads):
        self._made = made
        self.V: Doubles = made.vertices
        self.Q: Integers = made.faces
        self.report: dict[str, Any] = json.loads(made.report)
        self.status: str = self.report['status']

    def save(self, path: str | os.PathLike) -> None:
        """As `majorant quads` writes it: .obj, .ply or .vtu, read back and judged before it takes its name."""
        _core.save_quads(self._made, _arrays.path(path))

    def _repr_html_(self) -> str:
        """In notebooks: the mesh, seen from one side."""
        return cell(repr(self), picture(solid_picture(self.V, self.Q)))

    def __repr__(self) -> str:
        return f'<majorant.QuadMesh: {len(self.Q)} quads, {self.report["result"]["quads"]["irregular"]} irregular vertices>'


def quad_mesh(V: ArrayLike, F: Faces, *, count: int | None = None, edge_length: float | None = None,
              features: str | float | ArrayLike | None = None, cones: Mapping[int, int] | None = None,
              strict: bool = False, time_limit: float | None = None, threads: int = 0,
              callback: Callback | None = None) -> QuadMesh:
    """A pure quad mesh of any orientable surface, aligned to a smooth cross field, none of its quads folded or
    turned over.

        quads = majorant.quad_mesh(V, F, count=4000)
        quads.V, quads.Q                     # (#V, 3), (#Q, 4)
        quads.report['result']['quads']['irregular']

    count, or edge_length in the units of V; neither: half as many quads as triangles. Edges of quads cover borders
    and features: edges inside with so many degrees between the normals of their faces (features=35, the default but
    with cones), (#E, 2) vertices of edges, or 'none'. cones: {vertex: quarter turns around it}, of closed surfaces
    without features. strict: refuse what would be repaired (UnsupportedError). Limits and callback as for
    `parametrize`. docs/quads.md has all of it; report is that of `majorant quads --report`.

    Raises InfeasibleError where no map or no valid quads were found, with the reason.
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
