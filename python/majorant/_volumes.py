# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Volume meshes: check, untangling and optimization."""
from __future__ import annotations

import json
import math
import os
import warnings
from typing import Any, Mapping

import numpy as np
from numpy.typing import ArrayLike

from . import _arrays, _core, _options
from ._cells import cell, picture, solid_picture
from ._errors import InvalidError, UsageError
from ._types import Callback, Doubles, Integers

# Number of nodes of a cell, by kind and degree.
_NODES = {
    'segments': lambda n: n + 1,
    'triangles': lambda n: (n + 1) * (n + 2) // 2,
    'quads': lambda n: (n + 1) ** 2,
    'tetrahedra': lambda n: (n + 1) * (n + 2) * (n + 3) // 6,
    'wedges': lambda n: (n + 1) ** 2 * (n + 2) // 2,
    'hexahedra': lambda n: (n + 1) ** 3,
}
_MAX_DEGREE = 4
_CORNERS = {'triangles': 3, 'quads': 4, 'tetrahedra': 4, 'wedges': 6, 'hexahedra': 8}
# Corners of the sides of solid cells.
_SIDES = {
    'tetrahedra': ((0, 1, 2), (0, 1, 3), (1, 2, 3), (0, 2, 3)),
    'wedges': ((0, 1, 2), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)),
    'hexahedra': ((0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)),
}


class VolumeMesh:
    """A mesh of tetrahedra, hexahedra, wedges, triangles and quads, straight or curved.

        mesh = majorant.VolumeMesh.read('part.msh')
        mesh = majorant.VolumeMesh(X, {'tetrahedra': T})          # T: (#T, 4), (#T, 10), (#T, 20), (#T, 35)
        mesh.check()['invalid']

    X: (#P, 3) points, or (#P, 2) in the plane. Cells are rows of Lagrange nodes of degree 1 .. 4 in VTK's order:
    'tetrahedra', 'wedges', 'hexahedra', 'triangles', 'quads', 'segments'. The cells of highest dimension are the mesh,
    the others its boundary.
    """

    def __init__(self, X: ArrayLike, cells: Mapping[str, ArrayLike]):
        points = np.asarray(X)
        if points.ndim == 2 and points.shape[1] == 2:
            points = np.column_stack([points, np.zeros(len(points))])
        points = _arrays.floats('X', points, (None, 3))
        blocks = []
        for kind, nodes in cells.items():
            if kind not in _NODES:
                raise UsageError(f'cells[{kind!r}]: kinds are {", ".join(repr(k) for k in _NODES)}')
            rows = _arrays.integers(f'cells[{kind!r}]', nodes, (None, None), len(points), 'rows of X')
            degrees = [n for n in range(1, _MAX_DEGREE + 1) if _NODES[kind](n) == rows.shape[1]]
            if not degrees:
                raise UsageError(f'cells[{kind!r}] has {rows.shape[1]} columns; '
                                 f'{", ".join(str(_NODES[kind](n)) for n in range(1, _MAX_DEGREE + 1))} are possible')
            blocks.append((kind, degrees[0], rows))
        if not blocks:
            raise UsageError('no cells')
        self._volume = _core.make_volume(points, blocks)

    @classmethod
    def _of(cls, volume: _core.Volume) -> 'VolumeMesh':
        mesh = cls.__new__(cls)
        mesh._volume = volume
        return mesh

    @classmethod
    def read(cls, path: str | os.PathLike) -> 'VolumeMesh':
        """Reads .msh 2.2 and 4.1 of gmsh, .mesh of MFEM and Medit, .vtu of VTK, also .gz."""
        return cls._of(_core.read_volume(_arrays.path(path)))

    @property
    def points(self) -> Doubles:
        """(#P, 3): the points, shared and read-only."""
        return self._volume.points

    @property
    def blocks(self) -> list[tuple[str, int, Integers, Any, Integers]]:
        """The cells by kind and degree, in the order of the file: (kind, degree, nodes, numbers, regions)."""
        return self._volume.blocks

    def with_points(self, X: ArrayLike) -> 'VolumeMesh':
        """Returns the mesh with these points, (#P, 3)."""
        return self._of(_core.with_points(self._volume, _arrays.floats('X', X, (len(self.points), 3))))

    def check(self, *, time_limit: float | None = None) -> dict[str, Any]:
        """Proves which elements are valid. Returns the section `mesh` of `majorant mesh check --report`, and
        `status`: 'valid', 'invalid' or 'undecided'."""
        status, section = _core.check_volume(self._volume, _limit(time_limit))
        return {'status': status, **json.loads(section)}

    def save(self, path: str | os.PathLike, *, msh_version: str = '', binary: bool = False) -> None:
        """Writes .msh, .vtu, or the format that the mesh was read from. In the format of its file, only points
        change; a .msh may also change its version ('2.2', '4.1') or become binary. A UserWarning names parts of the
        file that are not written. Raises UsageError for other names, and for nodes that have no cells in the format."""
        left_out = _core.write_volume(self._volume, _arrays.path(path),
                                      _options.choice('msh_version', msh_version, ('', '2.2', '4.1')),
                                      'binary' if _options.truth('binary', binary) else '')
        if left_out:
            warnings.warn(f'{os.fspath(path)}: does not hold {", ".join(left_out)}', stacklevel=2)

    def _repr_html_(self) -> str:
        """Returns a picture for notebooks: the cells behind the middle, straight, seen from the front."""
        return cell(repr(self), ''.join(picture(solid_picture(self.points, sides)) for sides in self._sides_behind()))

    def _sides_behind(self) -> list[Integers]:
        """Returns the sides that exactly one of the cells behind the middle has, as triangles and quads."""
        triangles: list[Any] = []
        solids = [block for block in self.blocks if block[0] in _SIDES]
        blocks = solids or [block for block in self.blocks if block[0] in ('triangles', 'quads')]
        centers = [self.points[block[2][:, :_CORNERS[block[0]]]].mean(1) for block in blocks]
        if not centers:
            return []
        depth = np.concatenate(centers) @ [1.0, 0, 0]
        limit = np.median(depth) if solids else np.inf
        for (kind, _, nodes, *_), center in zip(blocks, centers):
            kept = nodes[center @ [1.0, 0, 0] <= limit]
            for side in _SIDES.get(kind) or (tuple(range(_CORNERS[kind])),):
                corners = kept[:, list(side)]
                triangles.append(np.concatenate([corners, corners[:, -1:]], 1) if len(side) == 3 else corners)
        sides = np.concatenate(triangles)
        _, first, count = np.unique(np.sort(sides, axis=1), axis=0, return_index=True, return_counts=True)
        return [sides[first[count == 1]]]

    def __repr__(self) -> str:
        cells = ', '.join(f'{len(block[2])} {block[0]} of degree {block[1]}' for block in self.blocks)
        return f'<majorant.VolumeMesh: {len(self.points)} points, {cells}>'


def optimize(mesh: VolumeMesh, energy: str = 'symmetric-dirichlet', *, target: str = 'ideal',
             sizes: ArrayLike | None = None, boundary: str = 'fixed', tolerance: float = _options.TOLERANCE,
             max_iterations: int = _options.MAX_ITERATIONS, time_limit: float | None = None, threads: int = 0,
             callback: Callback | None = None) -> tuple[VolumeMesh, dict[str, Any]]:
    """Moves nodes until all elements are proven to be valid and have good shapes. Returns the mesh and the report of
    the run.

        better, report = majorant.optimize(mesh, 'mips', boundary='slide')
        report['result']['mesh']['min_scaled_jacobian']

    Elements with reversed orientation are turned first; report['input']['turned'] counts them.

        energy          a name or a sum, as --energy of `majorant mesh optimize`
        target          'ideal', 'initial', or 'size' with sizes
        sizes           edge lengths: one number, or one for each element
        boundary        'fixed', 'slide' or 'free'

    Limits and callback as for `parametrize`; report['status'] tells why the run ended. docs/volumes.md describes the
    method. Raises UnsupportedError for other meshes; InvalidError, naming an element, if it cannot be made valid.
    """
    if not isinstance(mesh, VolumeMesh):
        raise UsageError(f'mesh is {type(mesh).__name__}, no VolumeMesh')
    if not isinstance(energy, str):
        raise UsageError('energy is no name; sums are text, such as "symmetric-dirichlet + 0.1*mips"')
    arguments = _options.choice('target', target, ('ideal', 'initial', 'size'))
    if (arguments == 'size') != (sizes is not None):
        raise UsageError("target='size' and sizes go together")
    lengths = np.zeros(0)
    if sizes is not None:
        lengths = _arrays.floats('sizes', [sizes] if np.isscalar(sizes) else sizes, (None,))
    keywords = {
        'energy': _options.energies(energy)[0],
        'target': arguments,
        'sizes': lengths.tolist(),
        'boundary': _options.choice('boundary', boundary, ('fixed', 'slide', 'free')),
        'tolerance': _options.number('tolerance', tolerance, 0),
        'max_iterations': _options.integer('max_iterations', max_iterations, 0, 2**31 - 1),
        'time_limit': _limit(time_limit),
        'threads': _options.integer('threads', threads, 0, 1024),
    }
    better, is_valid, text = _core.optimize_volume(mesh._volume, keywords, _options.callback(callback))
    report = json.loads(text)
    if not is_valid:
        failed = report['result']['mesh']['impossible'] or [element['element'] for element in report['result']['mesh']['worst']
                                                  if element['verdict'] != 'valid']
        raise InvalidError(f'{report["message"]}: elements {", ".join(map(str, failed[:10]))}')
    return VolumeMesh._of(better), report


def _limit(seconds: float | None) -> float:
    return math.inf if seconds is None else _options.number('time_limit', seconds, 0, zero=True, infinite=True)
