# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Checks and converts array arguments. Messages name the argument."""
from __future__ import annotations

import os
from typing import Any, Sequence

import numpy as np

from . import _core
from ._errors import UnsupportedError, UsageError

_LARGEST = np.iinfo(np.int32).max


def path(value: Any) -> str | bytes:
    """Returns the name of a file. Raises UsageError for a null character, at which the system would cut the name."""
    name = os.fspath(value)
    if (b'\0' if isinstance(name, bytes) else '\0') in name:
        raise UsageError(f'{name!r} has a null character, which no file name has')
    return name


def floats(name: str, value: Any, shape: Sequence[int | None]) -> np.ndarray:
    """Returns the value as float64 in C order. It must be finite and of this shape (None: any length)."""
    array = _array(name, value, 'biuf', 'numbers')
    _require_shape(name, array, shape)
    array = np.ascontiguousarray(array, dtype=np.float64)
    if not np.isfinite(array).all():
        where = tuple(int(i) for i in np.argwhere(~np.isfinite(array))[0])
        raise UsageError(f'{name}{list(where)} is {array[where]}; all numbers must be finite')
    return array


def numbers(name: str, value: Any) -> np.ndarray:
    """Returns the value as real numbers of any shape."""
    return _array(name, value, 'biuf', 'numbers')


def integers(name: str, value: Any, shape: Sequence[int | None], below: int, of: str) -> np.ndarray:
    """Returns the value as int32 in C order. Each must be in 0 .. below - 1; `of` names what they count."""
    array = _array(name, value, 'iu', 'integers')
    _require_shape(name, array, shape)
    outside = (array < 0) | (array >= below)
    if outside.any():
        where = tuple(int(i) for i in np.argwhere(outside)[0])
        count = (f'there are {below} {of}, from 0' if below < _LARGEST else
                 f'{of} are counted from 0' + f' to {_LARGEST - 1}' * bool(array[where] > 0))
        raise UsageError(f'{name}{list(where)} is {array[where]}, but {count}')
    return np.ascontiguousarray(array, dtype=np.int32)


def _array(name: str, value: Any, kinds: str, expected: str) -> np.ndarray:
    try:
        array = np.asarray(value)
    except ValueError:
        raise UsageError(f'{name} is no array: its rows have different lengths') from None
    if array.dtype.kind not in kinds or array.dtype.kind == 'b':
        raise UsageError(f'{name} holds {_held(array)}, not {expected}')
    return array


def _held(array: np.ndarray) -> str:
    return {'c': 'complex numbers', 'f': 'floating-point numbers', 'b': 'truth values',
            'U': 'text', 'S': 'bytes', 'O': 'Python objects (rows of different lengths?)'
            }.get(array.dtype.kind, f'values of type {array.dtype}')


def _require_shape(name: str, array: np.ndarray, shape: Sequence[int | None]) -> None:
    fits = array.ndim == len(shape) and all(
        expected is None or expected == found for expected, found in zip(shape, array.shape))
    if not fits:
        sides = ', '.join('n' if side is None else str(side) for side in shape)
        raise UsageError(f'{name} has shape {array.shape}, not ({sides}{"," if len(shape) == 1 else ""})')


def positions(V: Any) -> np.ndarray:
    """Returns positions, #V by 3. V may be #V by 2; z is then 0."""
    array = _array('V', V, 'biuf', 'numbers')
    if array.ndim == 2 and array.shape[1] == 2:
        array = np.column_stack([floats('V', array, (None, 2)), np.zeros(len(array))])
    array = floats('V', array, (None, 3))
    if not len(array):
        raise UsageError('V is empty: a mesh needs vertices')
    if len(array) > _LARGEST:
        raise UnsupportedError(f'V has {len(array)} rows, more than {_LARGEST}')
    return array


def polygons(F: Any, vertices: int) -> tuple[np.ndarray, np.ndarray]:
    """Returns the corners of all faces in one array, and the start of each face."""
    rows: Any = F if isinstance(F, np.ndarray) else list(F)
    mixed = not isinstance(rows, np.ndarray) and len({np.size(row) for row in rows}) > 1
    if not mixed:
        if np.ndim(rows) == 2 and np.shape(rows)[1] < 3:
            raise UsageError(f'F has shape {np.shape(rows)}: faces need at least three corners')
        array = integers('F', rows, (None, np.shape(rows)[1] if np.ndim(rows) == 2 else 3),
                         vertices, 'vertices')
        if not len(array):
            raise UsageError('F is empty: a mesh needs faces')
        starts = np.arange(len(array) + 1, dtype=np.int32) * array.shape[1]
        return array.ravel(), starts.astype(np.int32)
    lists = [integers(f'F[{k}]', row, (None,), vertices, 'vertices') for k, row in enumerate(rows)]
    for k, row in enumerate(lists):
        if len(row) < 3:
            raise UsageError(f'F[{k}] has {len(row)} corners: faces need at least three')
    starts = np.cumsum([0] + [len(row) for row in lists])
    return np.concatenate(lists), starts.astype(np.int32)


def mesh(V: Any, F: Any, uv: Any = None) -> _core.Mesh:
    """Returns the mesh with these vertices, faces and texture coordinates, #V by 2 or #F by corners by 2."""
    points = positions(V)
    corners, starts = polygons(F, len(points))
    if uv is None:
        return _core.mesh_of_arrays(points, (corners, starts))
    array = _array('uv', uv, 'biuf', 'numbers')
    if array.ndim == 2:
        coordinates = floats('uv', array, (len(points), 2))
        return _core.mesh_of_arrays(points, (corners, starts), coordinates, (corners, starts))
    sides = starts[1] - starts[0]
    if len(corners) != sides * (len(starts) - 1):
        raise UsageError('uv by corner needs faces with equally many corners; give one row a vertex')
    coordinates = floats('uv', array, (len(starts) - 1, int(sides), 2))
    # Corners of one vertex with equal coordinates share them. The map is cut where they differ.
    keys = np.column_stack([corners, coordinates.reshape(-1, 2)])
    _, first, number = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    return _core.mesh_of_arrays(points, (corners, starts), coordinates.reshape(-1, 2)[first],
                                (number.ravel().astype(np.int32), starts))


def points(name: str, value: Any, vertices: int) -> tuple[np.ndarray, np.ndarray] | None:
    """Returns vertices and their targets from {vertex: (u, v)}. None for (u, v): the vertex's position in the start."""
    if value is None:
        return None
    if not hasattr(value, 'items'):
        raise UsageError(f'{name} is no dictionary {{vertex: (u, v)}}, with None for (u, v) where a '
                         'vertex stays where the start has it')
    numbers: list[Any] = []
    targets: list[Any] = []
    for vertex, target in value.items():
        numbers.append(vertex)
        if target is None:
            targets.append([np.nan, np.nan])
        else:
            targets.append(floats(f'{name}[{vertex}]', target, (2,)))
    return (integers(name, np.array(numbers, dtype=None if numbers else int), (None,), vertices,
                     'vertices'), np.array(targets, dtype=float).reshape(-1, 2))


def rows(A: Any, b: Any) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, int]:
    """Returns A in compressed rows (three arrays), the right-hand sides, and the number of columns."""
    if hasattr(A, 'tocsr'):
        matrix = A.tocsr()
        matrix.sum_duplicates()
    else:
        import scipy.sparse
        matrix = scipy.sparse.csr_matrix(floats('A', A, (None, None)))
    _array('A', matrix.data, 'biuf', 'numbers')
    wrong = np.flatnonzero(~np.isfinite(matrix.data))
    if len(wrong):
        row = int(np.searchsorted(matrix.indptr, wrong[0], 'right')) - 1
        raise UsageError(f'A[{row}, {matrix.indices[wrong[0]]}] is {matrix.data[wrong[0]]}; all numbers must be finite')
    values = floats('A', matrix.data, (None,))
    targets = floats('b', b, (matrix.shape[0],))
    return (matrix.indptr.astype(np.int32), matrix.indices.astype(np.int32), values, targets,
            int(matrix.shape[1]))
