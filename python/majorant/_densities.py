# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Energies of one's own, as numpy functions of the Jacobian."""
from __future__ import annotations

from typing import Any, Callable

import numpy as np

from ._errors import UsageError
from ._options import choice

# Of the largest entry of a Hessian, by how much two that should be equal may differ. Origin: chosen,
# not tuned; roundings and differences of values stay below, a formula with a slip does not.
_SYMMETRY = 1e-3


class Density:
    """An energy given by a density of the Jacobian J: E = sum over faces of the integral of e(J).

        def value(J):                                   # (q, 2, 2) -> (q,)
            return (J ** 2).sum((1, 2)) / np.linalg.det(J)

        def derivatives(J):                             # -> (q, 2, 2), (q, 2, 2, 2, 2)
            ...

        mips = majorant.Density('mips', value, derivatives, free_scale='arbitrary')
        r = majorant.parametrize(V, F, energy=mips)

    J is the derivative of the map in an orthonormal frame of the face, at q points at once: some
    thousand, from several threads one after the other. derivatives(J) returns the gradient de/dJ and
    the Hessian d2e/dJ2 (as (q, 2, 2, 2, 2) or (q, 4, 4), exact, not made definite), from formulas or
    from any tool that makes them:

        grad = jax.vmap(jax.grad(e)); hess = jax.vmap(jax.hessian(e))
        majorant.Density('mine', jax.vmap(e), lambda J: (grad(J), hess(J)))

    `check_derivatives` compares them with differences. What the functions raise is raised by whoever
    called; warnings of numpy are not shown, as points outside of the domain are asked for too.

    domain      'positive': e is +inf where det J <= 0, whatever value(J) says there; 'everywhere'
    barrier     'strong' if e grows as fast as that of symmetric Dirichlet where det J -> 0, 'weak' if
                it grows at all, 'none' if not; None: by the domain
    free_scale  'determined' if the scale of a free map has a minimum, 'arbitrary' if e does not
                depend on it, 'collapses' if smaller is better (then pins or a boundary must hold it)
    """

    def __init__(self, name: str, value: Callable[[np.ndarray], Any],
                 derivatives: Callable[[np.ndarray], tuple[Any, Any]], *, domain: str = 'positive',
                 barrier: str | None = None, free_scale: str = 'determined'):
        if not isinstance(name, str) or not name:
            raise UsageError(f'name={name!r} is no name')
        for function in (value, derivatives):
            if not callable(function):
                raise UsageError(f'{function!r} cannot be called')
        self.name = name
        self.domain = choice('domain', domain, ('positive', 'everywhere'))
        self.barrier = choice('barrier', barrier or ('weak' if domain == 'positive' else 'none'),
                              ('none', 'weak', 'strong'))
        self.free_scale = choice('free_scale', free_scale, ('determined', 'arbitrary', 'collapses'))
        self._value, self._derivatives = value, derivatives

    def evaluate(self, J: np.ndarray) -> np.ndarray:
        """e at every J: (q,)."""
        with np.errstate(all='ignore'):
            return _as('value', self._value(J), (len(J),))

    def differentiate(self, J: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Gradient (q, m d) and Hessian (q, m d, m d) at every J."""
        with np.errstate(all='ignore'):
            found = self._derivatives(J)
        if not isinstance(found, tuple) or len(found) != 2:
            raise UsageError(f'derivatives of {self.name!r} returned {type(found).__name__}, not (gradient, '
                             'Hessian)')
        n, size = len(J), J[0].size if len(J) else 4
        return (_as('gradient', found[0], (n, size), J.shape),
                symmetric(f'{self.name!r} at point', np.arange(n),
                          _as('Hessian', found[1], (n, size, size), J.shape + J.shape[1:])))

    def check_derivatives(self, J: Any, tolerance: float = 1e-5) -> None:
        """Raises AssertionError, naming entry and point, where derivatives(J) are not those of value(J).

        J: (q, 2, 2), inside of the domain and away from its boundary.
        """
        require_derivatives(self.evaluate, self.differentiate, 'point', np.asarray(J, dtype=float), tolerance)

    def __repr__(self) -> str:
        return f'<majorant.Density {self.name!r}>'


def _as(what: str, array: Any, *shapes: tuple[int, ...]) -> np.ndarray:
    array = np.asarray(array)
    if array.dtype.kind not in 'iuf' or array.shape not in shapes:
        raise UsageError(f'{what} of {shapes[0][0]} points has shape {array.shape} and type {array.dtype}, '
                         f'not shape {" or ".join(str(shape) for shape in shapes)} of numbers')
    return np.ascontiguousarray(array, dtype=np.float64).reshape(shapes[0])


def symmetric(place: str, numbers: np.ndarray, hessians: np.ndarray) -> np.ndarray:
    """The same (n, k, k), of the places with these numbers. Raises UsageError where one is not
    symmetric; what is not finite is not looked at."""
    with np.errstate(all='ignore'):
        bound = _SYMMETRY * np.abs(hessians).max(axis=(1, 2), initial=0, keepdims=True)
        differs = np.abs(hessians - hessians.transpose(0, 2, 1)) > bound
    if differs.any():
        p, i, k = (int(n) for n in np.argwhere(differs)[0])
        raise UsageError(f'Hessian of {place} {numbers[p]} is not symmetric: [{i}, {k}] is {hessians[p, i, k]}, '
                         f'[{k}, {i}] is {hessians[p, k, i]}')
    return hessians


def require_derivatives(evaluate: Callable[..., np.ndarray], differentiate: Callable[..., Any], place: str,
                        points: np.ndarray, tolerance: float) -> None:
    """Raises AssertionError where differentiate(points) is not what differences of evaluate give."""
    gradient, hessian = differentiate(points)
    size = points[0].size
    step = 1e-6 * np.maximum(1, np.abs(points).max())
    for k in range(size):
        move = np.zeros(size)
        move[k] = step
        move = move.reshape(points.shape[1:])
        slope = (evaluate(points + move) - evaluate(points - move)) / (2 * step)
        _agree(f'gradient[{k}] at {place}', gradient[:, k], slope, tolerance)
        bend = (differentiate(points + move)[0] - differentiate(points - move)[0]) / (2 * step)
        for i in range(size):
            _agree(f'Hessian[{i}, {k}] at {place}', hessian[:, i, k], bend[:, i], tolerance)


def _agree(what: str, given: np.ndarray, expected: np.ndarray, tolerance: float) -> None:
    scale = np.maximum(np.abs(given), np.abs(expected)) + np.abs(expected).max() + 1e-12
    worst = int(np.argmax(np.abs(given - expected) / scale))
    if abs(given[worst] - expected[worst]) > tolerance * scale[worst]:
        raise AssertionError(f'{what} {worst} is {given[worst]}, differences say {expected[worst]}')
