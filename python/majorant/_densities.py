# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Energies defined by numpy functions of the Jacobian."""
from __future__ import annotations

from typing import Any, Callable

import numpy as np
from numpy.typing import ArrayLike

from ._derivatives import PointFunction
from ._errors import UsageError
from ._options import choice
from ._types import Doubles


class Density:
    """An energy given by a density of the Jacobian J: E = sum over faces of the integral of e(J).

        def value(J):                                   # (q, 2, 2) -> (q,)
            return (J ** 2).sum((1, 2)) / np.linalg.det(J)

        mips = majorant.Density('mips', value, free_scale='arbitrary')
        r = majorant.parametrize(V, F, energy=mips)

    J is the derivative of the map in an orthonormal frame of the face, at q points at once; (q, 3, 3) for
    tetrahedra (`Space`). Calls have some thousand points and come from several threads, one at a time. The value
    alone is enough. If it uses only the functions that docs/python.md lists, dual numbers give exact derivatives.
    Otherwise finite differences are used, and a UsageError names a point at which two step sizes disagree.
    `derivatives` tells which of them is in use. Formulas for derivatives may be faster,

        def derivatives(J):                             # -> (q, 2, 2), (q, 2, 2, 2, 2)
            ...

        grad = jax.vmap(jax.grad(e)); hess = jax.vmap(jax.hessian(e))
        majorant.Density('mine', jax.vmap(e), lambda J: (grad(J), hess(J)))

    with the gradient de/dJ and the Hessian d2e/dJ2, as (q, 2, 2, 2, 2) or (q, 4, 4), exact and not made definite.
    `check_derivatives` compares them with differences. Exceptions of the functions are raised by the solver.
    Warnings of numpy are suppressed, since functions are also called at points outside of the domain.

    domain      'positive': e is +inf if det J <= 0, whatever value(J) returns there; 'everywhere'
    barrier     growth of e as det J -> 0: 'strong' if as fast as that of symmetric Dirichlet, 'weak' if
                slower, 'none' if e stays bounded; None: implied by the domain
    free_scale  'determined' if the scale of a free map has a minimum, 'arbitrary' if e does not
                depend on it, 'collapses' if smaller is better (then pins or a boundary must hold it)
    """

    def __init__(self, name: str, value: Callable[[Doubles], Any],
                 derivatives: Callable[[Doubles], tuple[Any, Any]] | None = None, *, domain: str = 'positive',
                 barrier: str | None = None, free_scale: str = 'determined'):
        if not isinstance(name, str) or not name:
            raise UsageError(f'name={name!r} is no name')
        self.name = name
        self.domain = choice('domain', domain, ('positive', 'everywhere'))
        self.barrier = choice('barrier', barrier or ('weak' if domain == 'positive' else 'none'),
                              ('none', 'weak', 'strong'))
        self.free_scale = choice('free_scale', free_scale, ('determined', 'arbitrary', 'collapses'))
        inside = (lambda J: np.linalg.det(J) > 0) if domain == 'positive' else None
        self._function = PointFunction(name, 'point', value, derivatives, inside)

    @property
    def derivatives(self) -> str:
        """The source of derivatives: 'given', 'dual numbers' or 'differences'."""
        return self._function.derivatives(*((np.eye(d)[None] + 0.1 * np.arange(d),) for d in (2, 3)))

    def evaluate(self, J: Doubles) -> Doubles:
        """Returns e at every J: (q,)."""
        return self._function.evaluate(J)

    def differentiate(self, J: Doubles) -> tuple[Doubles, Doubles]:
        """Returns the gradient (q, k) and the Hessian (q, k, k) at every J of k entries."""
        return self._function.differentiate(J)

    def _linearize(self, J: Doubles) -> tuple[Doubles, Doubles, Doubles]:
        return self._function.linearize(J)

    def check_derivatives(self, J: ArrayLike, tolerance: float = 1e-5) -> None:
        """Raises AssertionError, naming entry and point, if derivatives disagree with differences of value(J).

        J: (q, 2, 2) or (q, 3, 3), inside of the domain and away from its boundary.
        """
        matrices = np.asarray(J, dtype=float)
        if matrices.ndim != 3 or matrices.shape[1:] not in ((2, 2), (3, 3)):
            raise UsageError(f'J has shape {matrices.shape}, not (q, 2, 2) or (q, 3, 3)')
        self._function.check(matrices, tolerance)

    def __repr__(self) -> str:
        return f'<majorant.Density {self.name!r}>'
