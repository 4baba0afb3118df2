# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Optimization problems of one's own: sums of sparse terms, constraints that hold exactly."""
from __future__ import annotations

import math
from typing import Any, Callable

import numpy as np
from numpy.typing import ArrayLike

from . import _arrays, _core, _options
from ._derivatives import PointFunction
from ._errors import UsageError
from ._types import Doubles, Energy, Faces, Integers

_METHODS = ('newton', 'lbfgs', 'gradient-flow', 'ceres-lbfgs', 'ceres-nlcg')


class Space:
    """Piecewise polynomial maps of a surface: a Bezier triangle of degree n on every face.

        space = majorant.Space(V, F, degree=2)
        x = space.tutte()                               # unknowns: u, v of every node

    A map is 2 numbers per node, x[2 k], x[2 k + 1] = u, v of node k; the first nodes are the vertices
    of the surface (`input_vertices`: their rows of V), then come those on edges and in faces.
    """

    def __init__(self, V: ArrayLike, F: Faces, degree: int = 1):
        n = _options.integer('degree', degree, 1, _core.max_degree)
        self._core = _core.Space(_arrays.mesh(V, F), n)
        self.degree: int = self._core.degree
        self.node_count: int = self._core.node_count
        self.size: int = 2 * self.node_count  #: of x
        self.area: float = self._core.area

    @property
    def nodes(self) -> Doubles:
        """(#N, 3): the nodes on the surface."""
        return self._core.nodes

    @property
    def cells(self) -> Integers:
        """(#F, (n+1)(n+2)/2): nodes of the faces, in VTK's order (`Map.cells`)."""
        return self._core.cells

    @property
    def input_vertices(self) -> Integers:
        """(#vertices,): rows of V."""
        return self._core.input_vertices

    def tutte(self) -> Doubles:
        """An injective map of a disk to start from: x."""
        return self._core.tutte()

    def linear(self, uv: ArrayLike) -> Doubles:
        """The map that is linear on the faces, uv (#V, 2) at the rows of V: x."""
        array = _arrays.floats('uv', uv, (None, 2))
        if len(array) <= self.input_vertices.max():
            raise UsageError(f'uv has {len(array)} rows; vertices go up to {self.input_vertices.max()}')
        return self._core.elevate(array[self.input_vertices].ravel())

    def energy(self, energy: Energy = 'symmetric-dirichlet', quadrature: int = 0) -> 'Term':
        """The integral of an energy over the surface, as a term: names, sums, and a `Density`, as for
        `parametrize`. quadrature: lattice points on a face; 0: the optimizer's own rule."""
        summands, _ = _options.energies(energy)
        points = _options.integer('quadrature', quadrature, 0, 10000)
        return Term(self._core.energy_terms(summands, points), self.size)


class Term:
    """A sum of functions of few unknowns, for `Problem.add`: see `Space.energy`, `penalty`,
    `linear_term`, `element_term`."""

    def __init__(self, parts: list[tuple[_core.Term, float]], size: int, *, of_all: bool = False,
                 elements: tuple[Doubles, PointFunction] | None = None):
        self._parts, self._size = parts, size
        self._of_all = of_all  # of a problem with exactly `size` unknowns, not of the first ones
        self._elements = elements  # their unknowns, a row each, and f

    @property
    def name(self) -> str:
        return ' + '.join(part.name for part, _ in self._parts)

    @property
    def derivatives(self) -> str | None:
        """Of a function of yours, where derivatives come from: 'given', 'dual numbers' or 'differences'."""
        if self._elements is None:
            return None
        unknowns, function = self._elements
        return function.derivatives((np.linspace(1, 2, unknowns.shape[1])[None], np.zeros(1, dtype=np.int32)))

    def check_derivatives(self, x: ArrayLike, tolerance: float = 1e-5) -> None:
        """Of an `element_term`: raises AssertionError, naming entry and element, where the derivatives
        at x, inside of the domain, are not those of the value."""
        if self._elements is None:
            raise UsageError(f'{self.name}: the derivatives of element_term alone are yours to check')
        unknowns, function = self._elements
        z = _arrays.floats('x', x, (None,))
        if len(z) < self._size:
            raise UsageError(f'x has {len(z)} numbers, {self.name} takes {self._size}')
        function.check(z[unknowns], tolerance, np.arange(len(unknowns), dtype=np.int32))

    def __repr__(self) -> str:
        return f'<majorant.Term {self.name!r}>'


def penalty(A: Any, b: ArrayLike) -> Term:
    """|A x - b|^2: rows of a scipy.sparse matrix, or a dense one, as soft constraints.

    For short rows, of 512 unknowns at most. What must hold is not for a penalty: `Problem.constrain`.
    """
    starts, columns, values, targets, size = _arrays.rows(A, b)
    empty = np.flatnonzero(np.diff(starts) == 0)
    longest = int(np.diff(starts).max(initial=0))
    if len(empty) or longest > 512:
        raise UsageError(f'row {empty[0]} of A is empty' if len(empty) else
                         f'a row of A has {longest} entries, more than 512')
    return Term([(_core.penalty(starts, columns, values, targets), 1.0)], size, of_all=True)


def linear_term(c: ArrayLike) -> Term:
    """c . x: loads, gravity. Something else has to hold x, or the energy has no minimum."""
    coefficients = _arrays.floats('c', c, (None,))
    return Term([(_core.linear_term(coefficients), 1.0)], len(coefficients), of_all=True)


def element_term(nodes: ArrayLike, value: Callable[..., Any], derivatives: Callable[..., Any] | None = None, *,
                 block: int = 1, name: str = 'element term') -> Term:
    """sum over elements e of f(the unknowns of e), with f in numpy, for many elements at once.

        def value(z, e):                      # z (q, k), e (q,): numbers of the elements -> (q,)
            return ((z[:, 1] - z[:, 0]) ** 2 - rest[e]) ** 2

        springs = majorant.element_term(edges, value)

    Derivatives are made of the value, as those of a `Density` are, or given:

        def derivatives(z, e): ...            # -> (q, k), (q, k, k): gradient and Hessian

    nodes: (#E, nodes of an element); a node is `block` unknowns that follow each other, so that z has
    k = block * nodes columns: z[:, block * i + c] = x[block * nodes[e, i] + c]. value may be inf or NaN
    outside of its domain. The Hessian is exact and symmetric (UsageError where it is not); solvers make
    it definite where they need that. `Term.check_derivatives` compares it with differences.
    """
    block = _options.integer('block', block, 1, 64)
    cells = _arrays.integers('nodes', nodes, (None, None), 2**31 - 1, 'nodes')
    if not cells.size:
        raise UsageError('nodes is empty')
    function = PointFunction(str(name), 'element', value, derivatives)
    unknowns = (block * cells[:, :, None].astype(np.int64) + np.arange(block)).reshape(len(cells), -1)
    return Term([(_core.element_term(str(name), cells, block, function), 1.0)],
                (int(cells.max()) + 1) * block, elements=(unknowns, function))


class Solution:
    """Where a minimization ended: x, energy, status, message, and iterations, a list of dictionaries."""

    def __init__(self, x: Doubles, energy: float, status: str, message: str,
                 iterations: list[dict[str, Any]]):
        self.x, self.energy, self.status, self.message, self.iterations = x, energy, status, message, iterations

    def __repr__(self) -> str:
        return (f'<majorant.Solution: energy {self.energy!r}, {self.status} after {len(self.iterations)} '
                'iterations>')


class Problem:
    """minimize sum of weight * term(x), subject to A x = b exactly, along injective maps if asked for.

        space = majorant.Space(V, F, degree=2)
        problem = majorant.Problem(space.size)
        problem.add(space.energy('symmetric-dirichlet'), 1 / space.area)
        problem.constrain(scipy.sparse.csr_array(...), b)
        problem.keep_injective(space)
        solution = problem.minimize(space.tutte())

    Constraints are eliminated: solvers see reduced unknowns y with x = Z y + c. Without constraints y is
    x. A term's Hessian is sparse by its elements; the pattern is found once.
    """

    def __init__(self, size: int):
        self._core = _core.Problem(_options.integer('size', size, 1, 2**31 - 1))

    @property
    def full_size(self) -> int:
        """Of x."""
        return self._core.full_size

    @property
    def size(self) -> int:
        """Of y."""
        return self._core.size

    def add(self, term: Term, weight: float = 1.0) -> 'Problem':
        if not isinstance(term, Term):
            raise UsageError(f'{term!r} is no Term')
        if term._size > self.full_size:
            raise UsageError(f'{term.name} has unknowns up to {term._size - 1}; the problem has {self.full_size}')
        if term._of_all and term._size != self.full_size:
            raise UsageError(f'{term.name} is of {term._size} unknowns, the problem has {self.full_size}')
        factor = _options.number('weight', weight, 0, _options.LARGEST, zero=True)
        for part, own in term._parts:
            self._core.add(part, factor * own)
        return self

    def constrain(self, A: Any, b: ArrayLike) -> 'Problem':
        """A x = b, exactly: a scipy.sparse matrix, or a dense one.

        Rows may depend on each other; rows that contradict others raise UnsupportedError when the
        problem is first used. Of rows of integers that is decided exactly, of others to within some
        roundings.
        """
        starts, columns, values, targets, size = _arrays.rows(A, b)
        if size != self.full_size:
            raise UsageError(f'A has {size} columns, the problem {self.full_size} unknowns')
        self._core.constrain(starts, columns, values, targets)
        return self

    def keep_injective(self, space: Space) -> 'Problem':
        """The first unknowns are a map in this space; steps are shortened so that det J > 0, proven on
        all of every face."""
        if not isinstance(space, Space):
            raise UsageError(f'{space!r} is no Space')
        if space.size > self.full_size:
            raise UsageError(f'the space has {space.size} unknowns, the problem {self.full_size}')
        self._core.keep_injective(space._core)
        return self

    def reduce(self, x: ArrayLike) -> Doubles:
        """y of x, which satisfies the constraints."""
        return self._core.reduce(_arrays.floats('x', x, (self.full_size,)))

    def expand(self, y: ArrayLike) -> Doubles:
        """x = Z y + c."""
        return self._core.expand(_arrays.floats('y', y, (self.size,)))

    def value(self, y: ArrayLike) -> float:
        """The energy; inf outside of its domain."""
        return self._core.value(_arrays.floats('y', y, (self.size,)))

    def gradient(self, y: ArrayLike) -> Doubles:
        """By y, inside of the domain."""
        return self._core.linearize(_arrays.floats('y', y, (self.size,)), 'projected')[1]

    def hessian(self, y: ArrayLike, curvature: str = 'exact') -> Any:
        """By y, as scipy.sparse.csc_array, both triangles. curvature: 'exact', 'projected', 'majorizer',
        'paper-majorizer', 'reweighted', where all terms have it."""
        import scipy.sparse
        model = _curvature(curvature)
        _, _, starts, rows, values = self._core.linearize(_arrays.floats('y', y, (self.size,)), model)
        lower = scipy.sparse.csc_matrix((values, rows, starts), shape=(self.size, self.size))
        return (lower + scipy.sparse.tril(lower, -1).T).tocsc()

    def minimize(self, x0: ArrayLike, method: str = 'newton', *, curvature: str = 'projected',
                 linear_solver: str = 'direct', tolerance: float | None = None,
                 max_iterations: int = _options.MAX_ITERATIONS, time_limit: float | None = None, threads: int = 0,
                 callback: Callable[[dict[str, Any], Doubles], Any] | None = None) -> Solution:
        """A local minimum near x0, which satisfies the constraints.

        method: 'newton'; 'lbfgs' and 'gradient-flow', with one factorization; 'ceres-lbfgs' and
        'ceres-nlcg', to compare with: those have no curvature and no linear_solver, and conjugate
        gradients end far from ill-conditioned minima (and tell stderr of their restarts).
        linear_solver: 'direct' or 'eigen'. tolerance: relative decrease of the energy in one
        iteration to stop at; None: the method's own. callback(record, x), after every iteration:
        something true ends the run.
        """
        limit = math.inf if time_limit is None else _options.number('time_limit', time_limit, 0, zero=True)
        keywords = {
            'method': _options.choice('method', method, _METHODS),
            'curvature': _curvature(curvature),
            'linear_solver': _options.choice('linear_solver', linear_solver, ('direct', 'eigen')),
            'tolerance': None if tolerance is None else _options.number('tolerance', tolerance, 0, zero=True),
            'max_iterations': _options.integer('max_iterations', max_iterations, 0, 2**31 - 1),
            'time_limit': limit,
            'threads': _options.integer('threads', threads, 0, 1024),
        }
        return Solution(*self._core.minimize(_arrays.floats('x0', x0, (self.full_size,)), keywords,
                                             _options.callback(callback)))


def _curvature(name: Any) -> str:
    return _options.choice('curvature', name, ('projected', 'majorizer', 'paper-majorizer', 'exact',
                                               'reweighted'))
