# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Numpy functions of many points at once, with given derivatives, dual numbers or finite differences."""
from __future__ import annotations

import inspect
import math
from typing import Any, Callable

import numpy as np

from ._duals import Dual
from ._errors import UsageError

# Tolerance for the symmetry of a Hessian, relative to its largest entry. Chosen, not tuned: rounding and
# finite differences stay below it, an error in a formula does not.
_SYMMETRY = 1e-3

# The first step h of differences, relative to the largest entry of a point, and the number of further
# steps, each an eighth of the one before. h = eps^(1/6) balances the rounding error of second differences,
# eps / h^2, and the error of their extrapolation, h^4. Near the boundary of a domain functions change over
# small distances: the last h is 1e-8.
_STEP = 2e-3
_FALL = 1 / 8
_FALLS = 6
# Tolerance for the difference of derivatives from h and from 2 h, relative to the function's size. The
# error of the extrapolated derivatives is then about its square.
_AGREEMENT = 1e-4

# Numbers in one array of dual numbers. Batches of points are so small that several arrays fit into the cache.
_CHUNK = 65536

# Exceptions that dual numbers raise if they cannot evaluate a formula.
_LOST = (TypeError, ValueError, AttributeError)


class PointFunction:
    """A function value(points, *data) -> (q,) of points (q, ...). data has a row for each point, except for vectors
    after the first item, which belong to all points.

    derivatives(points, *data) -> gradient (q, k) and Hessian (q, k, k) by the k entries of a point;
    None: from value alone. name and place ('point', 'element') are for messages. The number of a place is the
    first item of data, or the index of the point. inside(points) -> (q,) flags: the domain, which is further
    restricted to finite values. rank 1: value returns (q,) or (q, m), evaluate() and the other methods
    have a second axis of m; derivatives may then return the gradient alone.
    """

    def __init__(self, name: str, place: str, value: Callable[..., Any], derivatives: Callable[..., Any] | None,
                 inside: Callable[[np.ndarray], np.ndarray] | None = None, rank: int = 0):
        for function in (value,) if derivatives is None else (value, derivatives):
            if not callable(function):
                raise UsageError(f'{function!r} cannot be called: a function in numpy is needed')
        self._name, self._place, self._rank = name, place, rank
        self._value, self._derivatives, self._inside = value, derivatives, inside
        self._used = None if derivatives is None else 'given'

    def derivatives(self, *samples: tuple[Any, ...]) -> str:
        """'given', 'dual numbers' or 'differences': the source used so far. Before the first use, the source for the
        first of the samples (points and data) that value accepts."""
        if self._used is not None:
            return self._used
        for sample in samples:
            try:
                with np.errstate(all='ignore'):
                    followed = self._followed(*sample) is not None
            except IndexError:      # a matrix of another size
                followed = False
            finally:
                self._used = None
            if followed:
                return 'dual numbers'
        return 'differences'

    def evaluate(self, points: np.ndarray, *data: Any) -> np.ndarray:
        kept = points.view()
        kept.flags.writeable = False    # later calls get the same array
        with np.errstate(all='ignore'):
            found = self._value(kept, *data)
        q = len(points)
        if not self._rank:
            return self._as_array('value', found, (q,))
        m = np.shape(found)[1] if np.ndim(found) == 2 else 1
        return self._as_array('value', found, (q, m), (q,))

    def linearize(self, points: np.ndarray, *data: Any) -> tuple[np.ndarray, np.ndarray, Any]:
        """Returns values (q,), gradients (k, q) and lower triangles of Hessians (k (k + 1) / 2, q), row by row;
        with rank 1 (m, q), (m, k, q) and (m, k (k + 1) / 2, q), or None for Hessians that are not given."""
        found = self._followed(points, *data) if self._derivatives is None else None
        if found is not None:
            return found
        value = self.evaluate(points, *data)
        gradient, hessian = self._differentiated(points, *data)
        if hessian is not None:
            rows, columns = np.tril_indices(hessian.shape[-1])
            flat = np.moveaxis(hessian, 0, -1).reshape(*hessian.shape[1:-2], -1, len(hessian))
            hessian = np.take(flat, rows * hessian.shape[-1] + columns, axis=-2)
        return np.moveaxis(value, 0, -1), np.moveaxis(gradient, 0, -1), hessian

    def differentiate(self, points: np.ndarray, *data: Any) -> tuple[np.ndarray, Any]:
        """Returns gradients (q, k) and Hessians (q, k, k); with rank 1 (q, m, k), and (q, m, k, k) or None."""
        if self._derivatives is not None:
            return self._differentiated(points, *data)
        _, slopes, triangles = self.linearize(points, *data)
        k = slopes.shape[-2]
        hessian = np.empty((*slopes.shape[:-2], slopes.shape[-1], k, k))
        rows, columns = np.tril_indices(k)
        hessian[..., rows, columns] = hessian[..., columns, rows] = np.moveaxis(triangles, -2, -1)
        return np.moveaxis(slopes, -1, 0), np.moveaxis(hessian, -3, 0)

    def _differentiated(self, points: np.ndarray, *data: Any) -> tuple[np.ndarray, Any]:
        """Returns gradients and Hessians from the given function or by differences."""
        if self._derivatives is None:
            with np.errstate(all='ignore'):
                return self._differences(points, *data)
        with np.errstate(all='ignore'):
            given = self._derivatives(points, *data)
        q, k = len(points), math.prod(points.shape[1:])
        if self._rank:
            gradient, *hessian = given if isinstance(given, tuple) else (given,)
            m = np.shape(gradient)[1] if np.ndim(gradient) == 3 else 1
            return (self._as_array('gradient', gradient, (q, m, k), (q, k)),
                    self._as_array('Hessian', hessian[0], (q, m, k, k), (q, k, k)) if hessian else None)
        if not isinstance(given, tuple) or len(given) != 2:
            raise UsageError(f'derivatives of {self._name!r} returned {type(given).__name__}, not (gradient, '
                             'Hessian)')
        return (self._as_array('gradient', given[0], (q, k), points.shape),
                self._symmetric(self._as_array('Hessian', given[1], (q, k, k), points.shape + points.shape[1:]), *data))

    def check(self, points: np.ndarray, tolerance: float, *data: Any) -> None:
        """Raises AssertionError if derivatives disagree with differences of values."""
        gradient, hessian = self.differentiate(points, *data)
        step = 1e-6 * np.maximum(1, np.abs(points).max())
        slope = np.empty_like(gradient)
        bend = np.empty((*gradient.shape, gradient.shape[-1]))
        for k, unit in enumerate(np.eye(gradient.shape[-1])):
            move = step * unit.reshape(points.shape[1:])
            slope[..., k] = (self.evaluate(points + move, *data) - self.evaluate(points - move, *data)) / (2 * step)
            bend[..., k] = (self.differentiate(points + move, *data)[0]
                            - self.differentiate(points - move, *data)[0]) / (2 * step)
        numbers = data[0] if data else np.arange(len(points))
        _agree('gradient', self._place, numbers, gradient, slope, tolerance)
        if hessian is not None:
            _agree('Hessian', self._place, numbers, hessian, bend, tolerance)

    def _as_array(self, what: str, array: Any, *shapes: tuple[int, ...]) -> np.ndarray:
        """Converts the result of a function to an array of the first of these shapes."""
        try:
            array = np.asarray(array)
        except ValueError:
            raise UsageError(f'{what} of {self._name!r} is no array: its rows have different lengths') from None
        if array.dtype.kind not in 'iuf' or array.shape not in shapes:
            remedy = '' if what != 'value' or array.ndim == len(shapes[0]) else \
                f'; return one number for each {self._place}' + ', or a row of them' * self._rank
            raise UsageError(f'{what} of {self._name!r} at {shapes[0][0]} {self._place}s has shape {array.shape} and '
                             f'type {array.dtype}, not shape {" or ".join(str(s) for s in dict.fromkeys(shapes))} of '
                             f'numbers{remedy}')
        return np.asarray(array, dtype=np.float64).reshape(shapes[0])

    def require_arguments(self, names: tuple[str, ...]) -> None:
        """Raises UsageError if a function cannot be called with these arguments."""
        for function in (self._value, *(() if self._derivatives is None else (self._derivatives,))):
            try:
                inspect.signature(function).bind(*names)
            except TypeError as wrong:
                raise UsageError(f'the function of {self._name!r} does not take the arguments {", ".join(names)}: '
                                 f'{wrong}') from None
            except ValueError:      # no signature is known
                pass

    def _number(self, row: int, *data: Any) -> int:
        return int(data[0][row]) if data else row

    def _symmetric(self, hessians: np.ndarray, *data: Any) -> np.ndarray:
        """Checks the symmetry of Hessians. Points without finite values are ignored."""
        with np.errstate(all='ignore'):
            bound = _SYMMETRY * np.abs(hessians).max(axis=(1, 2), initial=0, keepdims=True)
            differs = np.abs(hessians - hessians.transpose(0, 2, 1)) > bound
        if differs.any():
            p, i, k = (int(n) for n in np.argwhere(differs)[0])
            raise UsageError(f'Hessian of {self._name!r} at {self._place} {self._number(p, *data)} is not symmetric: '
                             f'[{i}, {k}] is {hessians[p, i, k]}, [{k}, {i}] is {hessians[p, k, i]}')
        return hessians

    # ---- from the value alone --------------------------------------------------------------------
    def _followed(self, points: np.ndarray, *data: Any) -> tuple[np.ndarray, np.ndarray, np.ndarray] | None:
        """Returns the result of linearize() by dual numbers, or None if the value uses functions that they lack."""
        if self._used == 'differences':
            return None
        q, k = len(points), math.prod(points.shape[1:])
        rows = k * (k + 1) // 2
        some = max(1, _CHUNK // (1 + k + rows))
        out: tuple[np.ndarray, ...] = ()
        for begin in range(0, max(1, q), some):
            part = points[begin:begin + some]
            at = slice(begin, begin + len(part))
            try:
                with np.errstate(all='ignore'):
                    found = self._value(Dual.variables(part), *_rows_of(data, at))
            except _LOST:
                found = None
            if not isinstance(found, Dual) or found.shape[:1] != (len(part),) or found.ndim > 1 + self._rank:
                self._used = 'differences'
                return None
            if self._rank:      # one row of derivatives for each of the values of a point
                found = (found if found.ndim == 2 else found[:, None]).T
            front = found.shape[:-1]
            if not out:
                out = np.empty((*front, q)), np.empty((*front, k, q)), np.empty((*front, rows, q))
            elif out[0].shape[:-1] != front:
                raise UsageError(f'{self._name!r} has {front[0]} values at some {self._place}s, '
                                 f'{out[0].shape[0]} at others')
            out[0][..., at] = found.value
            found.write_rows(*(o[..., at].swapaxes(0, -2) for o in out[1:]))
        self._used = 'dual numbers'
        return out[0], out[1], out[2]

    def _differences(self, points: np.ndarray, *data: Any) -> tuple[np.ndarray, np.ndarray]:
        """Returns derivatives by central differences, extrapolated from two steps. If these disagree, smaller steps are
        tried. NaN outside of the domain."""
        if self._rank:
            parts = [self._component(j)._differences(points, *data)
                     for j in range(self.evaluate(points, *data).shape[1])]
            return np.stack([part[0] for part in parts], axis=1), np.stack([part[1] for part in parts], axis=1)
        q, k = len(points), math.prod(points.shape[1:])
        flat = points.reshape(q, k)
        gradient, hessian = np.full((q, k), np.nan), np.full((q, k, k), np.nan)
        middle = self._values(points, np.arange(q), *data)
        rows = np.flatnonzero(np.isfinite(middle))
        size = np.abs(flat).max(axis=1)
        step = _STEP * np.where(size == 0, 1, size)
        for _ in range(_FALLS + 1):
            if not len(rows):
                return gradient, hessian
            fine, coarse = self._stencils(flat[rows], middle[rows], step[rows], rows, points.shape[1:], *data)
            differs = _disagreement(fine, coarse, np.abs(middle[rows]), step[rows] / _STEP)
            for out, f, c in zip((gradient, hessian), fine, coarse):
                out[rows] = f + (f - c) / 3
            rows = rows[~(differs <= _AGREEMENT)]
            step[rows] *= _FALL
        if len(rows):
            raise UsageError(
                f'{self._name!r} at {self._place} {self._number(int(rows[0]), *data)}, {flat[rows[0]].tolist()}: '
                'differences of its values with two steps do not agree; give derivatives, or write it with what '
                'dual numbers have (docs/python.md)')
        return gradient, hessian

    def _component(self, j: int) -> 'PointFunction':
        return PointFunction(self._name, self._place, lambda *points: self.evaluate(*points)[:, j], None)

    def _values(self, points: np.ndarray, rows: np.ndarray, *data: Any) -> np.ndarray:
        """Returns the values at the points of these rows; not finite outside the domain."""
        found = self.evaluate(points, *_rows_of(data, rows))
        return found if self._inside is None else np.where(self._inside(points), found, np.inf)

    def _stencils(self, flat: np.ndarray, middle: np.ndarray, step: np.ndarray, rows: np.ndarray,
                  shape: tuple[int, ...], *data: Any) -> tuple[Any, Any]:
        """Returns (gradient, Hessian) from differences with this step, and those with twice the step."""
        (q, k), unit = flat.shape, np.eye(flat.shape[1])
        low, high = np.tril_indices(k, -1)
        both = unit[low] + unit[high]
        moves = np.concatenate([s * e for s in (1, 2) for e in (unit, -unit, both, -both)])
        values = np.empty((len(moves), q))
        some = max(1, 8192 // q)    # points of one call
        for begin in range(0, len(moves), some):
            part = moves[begin:begin + some]
            at = flat + part[:, None, :] * step[:, None]
            values[begin:begin + some] = self._values(at.reshape(-1, *shape), np.tile(rows, len(part)),
                                                      *data).reshape(len(part), q)
        out = []
        for h, f in zip((step, 2 * step), np.split(values, 2)):
            up, down, out_up, out_down = np.split(f, np.cumsum([k, k, len(low)]))
            hessian = np.empty((k, k, q))
            hessian[range(k), range(k)] = diagonal = (up + down - 2 * middle) / h ** 2
            mixed = ((out_up + out_down - 2 * middle) / h ** 2 - diagonal[low] - diagonal[high]) / 2
            hessian[low, high] = hessian[high, low] = mixed
            out.append((((up - down) / (2 * h)).T, np.moveaxis(hessian, -1, 0)))
        return out[0], out[1]


def _rows_of(data: tuple[Any, ...], rows: Any) -> tuple[Any, ...]:
    """Returns the data of these rows."""
    return tuple(d if k > 0 and d.ndim == 1 else d[rows] for k, d in enumerate(data))


def _disagreement(fine: Any, coarse: Any, value: np.ndarray, size: np.ndarray) -> np.ndarray:
    """Returns the error of each point, relative to the function and its first and second derivative at the scale of the
    point."""
    def largest(part: np.ndarray) -> np.ndarray:
        return np.abs(part).reshape(len(part), -1).max(axis=1)

    slope, bend = largest(fine[0]), largest(fine[1])
    whole = np.maximum(np.maximum(value, slope * size), bend * size ** 2)
    found = np.maximum(largest(fine[0] - coarse[0]) * size, largest(fine[1] - coarse[1]) * size ** 2)
    return np.where(found == 0, 0, found / whole)


def _agree(what: str, place: str, numbers: np.ndarray, given: np.ndarray, expected: np.ndarray, tolerance: float) -> None:
    """Raises AssertionError unless given and expected numbers agree to a tolerance, relative to the entry, the largest
    entry of the point, or this entry at all points."""
    largest = np.abs(expected).max(axis=tuple(range(1, expected.ndim)), keepdims=True)
    scale = np.maximum(np.abs(given), np.abs(expected)) + largest + np.abs(expected).max(axis=0) + 1e-12
    worst = np.unravel_index(np.argmax(np.nan_to_num(np.abs(given - expected) / scale, nan=np.inf)), given.shape)
    if not np.abs(given - expected)[worst] <= tolerance * scale[worst]:
        point, *entry = (int(i) for i in worst)
        raise AssertionError(f'{what}{entry} at {place} {numbers[point]} is {given[worst]}, differences say {expected[worst]}')
