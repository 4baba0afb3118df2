# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Optimization problems: sums of sparse terms, with constraints that hold exactly."""
from __future__ import annotations

import math
from typing import Any, Callable, Mapping

import numpy as np
from numpy.typing import ArrayLike

from . import _arrays, _core, _options
from ._errors import UnsupportedError, UsageError
from ._terms import Equality, Inequality, Term
from ._types import Doubles, Energy, Faces, Integers

_METHODS = ('newton', 'levenberg-marquardt', 'lbfgs', 'gradient-flow', 'ceres-lbfgs', 'ceres-nlcg', 'ceres-lm',
            'ceres-dogleg')


class Space:
    """Piecewise polynomial maps: a Bezier element of degree n for every cell.

        space = majorant.Space(V, F, degree=2)          # of a surface, onto the plane
        x = space.tutte()                               # unknowns: u, v of every node
        space = majorant.Space(V, T, cells='tetrahedra')
        x = space.linear(V)                             # u, v, w: the identity

    cells: 'triangles' of a surface, V (#V, 3) and F as for `parametrize`; 'quads', V (#V, 2) or (#V, 3)
    and F (#F, 4) counterclockwise, whose maps to the plane are bilinear or of degree n in both directions;
    'tetrahedra', V (#V, 3) and F (#T, 4) of positive volume, mapped into space.

    A map is d = `dimension` numbers per node: x[d k], ..., x[d k + d - 1] for node k. The first nodes are
    the vertices (`input_vertices`: their rows of V), followed by the nodes on edges and in cells.
    """

    def __init__(self, V: ArrayLike, F: Faces, degree: int = 1, *, cells: str = 'triangles'):
        kind = _options.choice('cells', cells, ('triangles', 'quads', 'tetrahedra'))
        n = _options.integer('degree', degree, 1,
                             _core.max_tetrahedron_degree if kind == 'tetrahedra' else _core.max_degree)
        if kind == 'triangles':
            mesh = _arrays.mesh(V, F)
            self._core = _core.triangle_space(mesh, n)
            self._shape: tuple[int, ...] = (len(mesh.positions), 3)
        else:
            positions = _vertices(V, kind)
            self._shape = positions.shape
            corners = _arrays.integers('F', F, (None, 4), len(positions), 'vertices')
            if kind == 'tetrahedra':
                _require_positive(positions, corners)
            make = _core.quad_space if kind == 'quads' else _core.tetrahedron_space
            self._core = make(positions, corners, n)
        self._kind = kind
        self.degree: int = self._core.degree
        self.dimension: int = self._core.dimension  #: dimension of the image, 2 or 3
        self.node_count: int = self._core.node_count
        self.size: int = self.dimension * self.node_count  #: number of unknowns x
        self.area: float = self._core.area  #: area or volume of the cells

    @property
    def nodes(self) -> Doubles:
        """(#N, 3), or (#N, 2) for quads in the plane: positions of the nodes on the rest shape."""
        return self._core.nodes

    @property
    def cells(self) -> Integers:
        """(#F, nodes of a cell): nodes of the cells, in VTK's order (`Map.cells`)."""
        return self._core.cells

    @property
    def input_vertices(self) -> Integers:
        """(#vertices,): the row of V of each vertex node."""
        return self._core.input_vertices

    def tutte(self) -> Doubles:
        """Returns x of Tutte's embedding, an injective map of a disk of triangles."""
        if self._kind != 'triangles':
            raise UsageError(f'tutte is of triangles; {self._kind} start from linear(images of V)')
        return self._core.tutte()

    def linear(self, uv: ArrayLike) -> Doubles:
        """Returns x of the map that is linear (quads: bilinear) on the cells, with images uv (#V, d) of the rows of
        V."""
        array = _arrays.floats('uv', uv, (None, self.dimension))
        if len(array) <= self.input_vertices.max():
            raise UsageError(f'uv has {len(array)} rows; vertices go up to {self.input_vertices.max()}')
        return self._core.linear(array[self.input_vertices])

    def energy(self, energy: Energy = 'symmetric-dirichlet', quadrature: int = 0) -> Term:
        """Returns a term: the integral of an energy over the cells. energy: a name, a sum or a `Density`, as for
        `parametrize`; for tetrahedra a `Density` with J (q, 3, 3). quadrature: number of lattice points in a triangle;
        0, and for other cells: the optimizer's rule."""
        summands, _ = _options.energies(energy)
        if self.dimension == 3 and any(isinstance(e, str) for e, _ in summands):
            raise UsageError('energies with a name are of planar maps; give a Density, whose J is (q, 3, 3)')
        points = _options.integer('quadrature', quadrature, 0, 10000)
        if points and self._kind != 'triangles':
            raise UsageError(f'quadrature is of triangles; {self._kind} have a rule of their own')
        return Term(_core.energy_terms(self._core, summands, points), self.size, space=self)


class Solution:
    """The end point of a minimization: x, energy, status, message, and iterations, a list of dictionaries.

    phases: for a problem with bounds, a dictionary for each weight `mu` of their barriers: `gap`, `iterations` and
    `status`. For convex problems `gap` bounds the excess of `energy` over the minimum.
    multipliers: for a problem with equalities, l of energy + sum of l . g, one for each element of all
    equalities in the order of `Problem.hold`; otherwise empty.
    definite: 'yes' if the exact Hessian is positive definite, so that x is a minimum; 'no' at a saddle;
    otherwise 'not tested'.
    """

    def __init__(self, x: Doubles, energy: float, status: str, message: str,
                 iterations: list[dict[str, Any]], phases: list[dict[str, Any]], definite: str,
                 multipliers: Doubles, solved: _core.SolvedProblem, places: dict[Term, list[list[tuple[int, float]]]]):
        self.x, self.energy, self.status, self.message = x, energy, status, message
        self.iterations, self.phases, self.definite = iterations, phases, definite
        self.multipliers = multipliers
        self._solved, self._places = solved, places
        self._sensitivity: _core.Sensitivity | None = None

    def _derivatives(self) -> _core.Sensitivity:
        if self._sensitivity is None:
            self._sensitivity = _core.Sensitivity(self._solved)
        return self._sensitivity

    @property
    def derivative_error(self) -> float:
        """An estimate of |x - x*| / |x|, where x* is the minimum at which `forward` and `adjoint` differentiate.
        Exact Newton steps approach it first; the estimate is at most 1e-9 unless they did not converge."""
        return self._derivatives().error

    @property
    def barrier_bias(self) -> float:
        """The displacement of x by the barriers of bounds and inequalities, relative to |x|, to first order. It is
        the bias of `forward` and `adjoint`; 0 without barriers."""
        return self._derivatives().bias()

    def forward(self, *, b: ArrayLike | None = None, weights: Mapping[Term, float] | None = None,
                parameters: Mapping[Term, ArrayLike] | None = None,
                rest: Mapping[Space, ArrayLike] | None = None) -> Doubles:
        """Returns dx, the change of x with the data of the problem.

        The changes of data are: db of all rows of `Problem.constrain` in their order; weights {term: dw};
        data {term: ddata}, of the shape of the term's data; and rest vertices of spaces of degree 1,
        {space: dV}. The derivative follows from the implicit function theorem at the minimum, with the exact
        Hessian, which is factorized once for `forward` and `adjoint`. Bounds and inequalities enter by the
        barriers of the last phase (`barrier_bias`). Raises UnsupportedError at a saddle, if a motion of the
        unknowns does not change the energy, and if `keep_injective` holds a map.
        """
        core = self._derivatives()
        heavier = [(place, _options.number('weights', change, -_options.LARGEST, _options.LARGEST) * own)
                   for term, change in (weights or {}).items() for place, own in self._parts(term)]
        moved = []
        for term, change in (parameters or {}).items():
            own_data = term._function._data if term._function is not None else ()
            if not own_data:
                raise UsageError(f'{term.name} was made without data')
            numbers = _arrays.floats('parameters', change, own_data[0].shape).ravel()
            moved += [(place, numbers) for place, _ in self._parts(term)]
        along = []
        for space, change in (rest or {}).items():
            dV = _arrays.floats('rest', change, self._rest_shape(space))
            along.append(core.rest_gradient(space._core, self._terms_on(space), dV[space.input_vertices]))
        gradient: Doubles | None = np.sum(along, axis=0) if along else None
        return core.forward(None if b is None else _arrays.floats('b', b, (self._solved.row_count,)),
                            heavier, moved, gradient)

    def adjoint(self, dL_dx: ArrayLike) -> 'Adjoint':
        """Returns the derivative of a function L of x by the data of the problem, given dL/dx at x.

        Its parts are `b`, by the right-hand sides of all rows of `Problem.constrain` in their order; `weights`,
        by term in the order of `Problem.add`; `parameters[term]`, of the shape of the term's data; and
        `rest[space]`, by the vertices of a space of degree 1, of the shape of V. Raises as `forward`."""
        slope = _arrays.floats('dL_dx', dL_dx, (len(self.x),))
        core = self._derivatives()
        b, weights, parameters, state = core.adjoint(slope)
        by_term: dict[Term, Doubles] = {}
        sums = {}
        for term, added in self._places.items():
            for k, parts in enumerate(added):
                sums[parts[0][0]] = sum(own * weights[place] for place, own in parts)
            if term._function is not None and term._function._data:
                whole = np.sum([parameters[place] for parts in added for place, _ in parts], axis=0)
                by_term[term] = whole.reshape(term._function._data[0].shape)

        def by_rest(space: Space) -> Doubles:
            shape = self._rest_shape(space)
            slopes = core.rest_slopes(space._core, self._terms_on(space), state)
            out = np.zeros(shape)
            out[space.input_vertices] = slopes
            return out

        return Adjoint(b, np.array([sums[place] for place in sorted(sums)]), by_term, _Rest(by_rest))

    def covariance(self, indices: ArrayLike) -> Doubles:
        """Returns the covariance (m, m) of these entries of x: a block of (J^T J)^-1, for problems of
        `least_squares` terms only; 0 for unknowns that constraints fix. Raises UnsupportedError for other terms, and
        if the residuals do not determine all unknowns."""
        unknowns = _arrays.integers('indices', indices, (None,), len(self.x), 'unknowns')
        return self._solved.covariance(unknowns.tolist())

    def _rest_shape(self, space: Space) -> tuple[int, ...]:
        if not isinstance(space, Space):
            raise UsageError(f'{space!r} is no Space')
        if not self._terms_on(space):
            raise UsageError('no energy of the problem is on this space')
        if space.degree > 1 or space._kind == 'quads':
            raise UnsupportedError('rest positions are data of triangles and tetrahedra of degree 1, not of '
                                   f'{space._kind} of degree {space.degree}')
        return space._shape

    def _terms_on(self, space: Space) -> list[int]:
        return [place for term, added in self._places.items() if term._space is space
                for parts in added for place, _ in parts]

    def _parts(self, term: Term) -> list[tuple[int, float]]:
        if term not in self._places:
            raise UsageError(f'{getattr(term, "name", term)} is no term of the problem')
        return [part for parts in self._places[term] for part in parts]

    def __repr__(self) -> str:
        return (f'<majorant.Solution: energy {self.energy!r}, {self.status} after {len(self.iterations)} '
                'iterations>')


class _Rest:
    """Derivatives by the vertices of a space, computed on access."""

    def __init__(self, make: Callable[[Space], Doubles]):
        self._make = make

    def __getitem__(self, space: Space) -> Doubles:
        return self._make(space)


class Adjoint:
    """The derivatives of a function L by the data of a problem: see `Solution.adjoint`."""

    def __init__(self, b: Doubles, weights: Doubles, parameters: dict[Term, Doubles], rest: _Rest):
        self.b, self.weights, self.parameters, self.rest = b, weights, parameters, rest


class Factor:
    """A factorized Hessian: see `Problem.factor`."""

    def __init__(self, core: _core.Factor, size: int):
        self._core, self._size = core, size

    def solve(self, b: ArrayLike) -> Doubles:
        """Returns H^-1 b for b (size,), or (size, m) with m right-hand sides."""
        columns = _arrays.floats('b', b, (self._size,) if np.ndim(b) == 1 else (self._size, None))
        x = self._core.solve(columns.reshape(self._size, -1))
        return x[:, 0] if columns.ndim == 1 else x


class Problem:
    """Minimizes the sum of weight * term(x) subject to A x = b exactly, to inequalities and bounds, and on request
    along injective maps.

        space = majorant.Space(V, F, degree=2)
        problem = majorant.Problem(space.size)
        problem.add(space.energy('symmetric-dirichlet'), 1 / space.area)
        problem.constrain(scipy.sparse.csr_array(...), b)
        problem.keep_injective(space)
        solution = problem.minimize(space.tutte())

    Constraints are eliminated: solvers see reduced unknowns y with x = Z y + c. Without constraints y is
    x. The Hessian of a term is sparse by its elements, and its pattern is computed once.
    """

    def __init__(self, size: int):
        self._core = _core.Problem(_options.integer('size', size, 1, 2**31 - 1))
        self._has_bounds = False
        self._holds = False  # bounds, inequalities or equalities
        self._on_manifolds = False
        self._places: dict[Term, list[list[tuple[int, float]]]] = {}

    @property
    def full_size(self) -> int:
        """The number of unknowns x."""
        return self._core.full_size

    @property
    def size(self) -> int:
        """The number of reduced unknowns y."""
        return self._core.size

    def add(self, term: Term, weight: float = 1.0) -> 'Problem':
        if not isinstance(term, Term):
            raise UsageError(f'{term!r} is no Term')
        if term._function is not None:
            term._function._elements.require_within(self.full_size, term.name)
        if term._size > self.full_size:
            raise UsageError(f'{term.name} has unknowns up to {term._size - 1}; the problem has {self.full_size}')
        if term._of_all and term._size != self.full_size:
            raise UsageError(f'{term.name} is of {term._size} unknowns, the problem has {self.full_size}')
        factor = _options.number('weight', weight, 0, _options.LARGEST, zero=True)
        self._places.setdefault(term, []).append([(self._core.add(part, factor * own), own) for part, own in term._parts])
        return self

    def update(self, term: Term, *, weight: float | None = None, data: ArrayLike | None = None) -> 'Problem':
        """Changes the weight of a term, or its data, which must keep their shape. The analysis of the problem is
        kept. For values that change between solves, such as the last time step."""
        places = self._places_of(term)
        factor = None if weight is None else _options.number('weight', weight, 0, _options.LARGEST, zero=True)
        numbers = None
        if data is not None:
            own = term._function._data if term._function is not None else ()
            if not own:
                raise UsageError(f'{term.name} was made without data')
            numbers = _arrays.floats('data', data, own[0].shape).ravel()
        for parts in places:
            for place, own_weight in parts:
                self._core.update(place, None if factor is None else factor * own_weight, numbers)
        return self

    def set_right_hand_sides(self, b: ArrayLike) -> 'Problem':
        """Changes the right-hand sides of all rows of `constrain`, in their order."""
        self._core.set_right_hand_sides(_arrays.floats('b', b, (self._core.row_count,)))
        return self

    def _places_of(self, term: Term) -> list[list[tuple[int, float]]]:
        if not isinstance(term, Term):
            raise UsageError(f'{term!r} is no Term')
        if term not in self._places:
            raise UsageError(f'{term.name} was not added to this problem')
        return self._places[term]

    def constrain(self, A: Any, b: ArrayLike) -> 'Problem':
        """Adds the constraint A x = b, which holds exactly. A: a scipy.sparse matrix, or a dense one.

        Rows may depend on each other. Rows that contradict others raise UnsupportedError when the problem is
        first used. The test is exact for integer rows, and up to rounding for others.
        """
        starts, columns, values, targets, size = _arrays.rows(A, b)
        if size != self.full_size:
            raise UsageError(f'A has {size} columns, the problem {self.full_size} unknowns')
        self._core.constrain(starts, columns, values, targets)
        return self

    def keep_injective(self, space: Space) -> 'Problem':
        """Declares that the first unknowns are a map in this space with det J > 0. Steps are shortened so that this
        is proven on all points of every cell."""
        if not isinstance(space, Space):
            raise UsageError(f'{space!r} is no Space')
        if space.size > self.full_size:
            raise UsageError(f'the space has {space.size} unknowns, the problem {self.full_size}')
        self._core.keep_injective(space._core)
        return self

    def hold(self, condition: Inequality | Equality) -> 'Problem':
        """Adds a condition: g >= 0 at every element of an inequality, up to the gap of `minimize`, or g = 0 at every
        element of an equality, to 1e-10. The start may violate both."""
        if not isinstance(condition, (Inequality, Equality)):
            raise UsageError(f'{condition!r} is neither an Inequality nor an Equality')
        elements = condition._elements
        elements.require_within(self.full_size, condition.name)
        if isinstance(condition, Equality):
            self._core.hold_equality(condition.name, elements.cells, elements.counts, elements.block,
                                     condition._augmented)
        else:
            self._core.hold(condition.name, elements.cells, elements.counts, elements.block, condition)
            self._has_bounds = True
        self._holds = True
        return self

    def on_manifold(self, nodes: ArrayLike, kind: str, *, block: int = 1) -> 'Problem':
        """Restricts points to a manifold: x stays there up to rounding, and `minimize` moves along it.

            problem.on_manifold(np.arange(100), 'sphere', block=3)      # 100 directions

        nodes: a row for each point, of the nodes whose `block` unknowns each are its numbers; of one node
        each a list will do. kind: 'sphere', |x| = 1 in 2 or more dimensions; 'unit-complex', the same of 2
        numbers; 'rotation', of 4 numbers unit quaternions, of 9 rotation matrices, by rows or by columns.
        Points of x0 are brought to the nearest one first. Calls add up; terms, bounds, inequalities and
        equalities see x as always. By 'newton' alone (UsageError); constraints on such unknowns raise
        UnsupportedError: there they are equalities.
        """
        _options.choice('kind', kind, tuple(_MANIFOLDS))
        size = _options.integer('block', block, 1, 2**31 - 1)
        rows = _arrays.numbers('nodes', nodes)
        count = self.full_size // size
        if rows.ndim not in (1, 2):
            raise UsageError(f'nodes has shape {rows.shape}, not (#points,) or (#points, nodes of each)')
        if not rows.size:
            raise UsageError(f'nodes is empty: put one point or more on a {kind}')
        array = _arrays.integers('nodes', rows[:, None] if rows.ndim == 1 else rows, (None, None), count,
                                 'nodes' if size == 1 else f'nodes of {size} unknowns')
        unknowns = (size * array[:, :, None] + np.arange(size, dtype=np.int32)).reshape(len(array), -1)
        if not _MANIFOLDS[kind](unknowns.shape[1]):
            raise UsageError(f'a point of {unknowns.shape[1]} numbers is on no {kind}: '
                             f'{_NUMBERS_OF[kind]} are needed')
        self._core.on_manifold(kind, np.ascontiguousarray(unknowns, dtype=np.int32))
        self._on_manifolds = True
        return self

    def bound(self, lower: ArrayLike = -math.inf, upper: ArrayLike = math.inf) -> 'Problem':
        """lower <= x <= upper, one number for all unknowns or one for each, infinite where there is none;
        to the gap of `minimize`. It may start outside. What is fixed is not for bounds: `constrain`."""
        low, high = (_limits(name, value, self.full_size) for name, value in (('lower', lower), ('upper', upper)))
        if not (low < high).all():
            k = int(np.argmin(low < high))
            raise UsageError(f'lower[{k}] is {low[k]}, not below upper[{k}], {high[k]}')
        if np.isinf(low).all() and np.isinf(high).all():
            raise UsageError('nothing to hold: all of lower and upper are infinite')
        self._core.bound(low, high)
        self._has_bounds = self._holds = True
        return self

    def reduce(self, x: ArrayLike) -> Doubles:
        """Returns y of an x that satisfies the constraints."""
        return self._core.reduce(_arrays.floats('x', x, (self.full_size,)))

    def expand(self, y: ArrayLike) -> Doubles:
        """Returns x = Z y + c."""
        return self._core.expand(_arrays.floats('y', y, (self.size,)))

    def value(self, y: ArrayLike) -> float:
        """Returns the energy; inf outside of its domain."""
        return self._core.value(_arrays.floats('y', y, (self.size,)))

    def gradient(self, y: ArrayLike, term: Term | None = None) -> Doubles:
        """Returns the gradient by y inside of the domain, of all terms, or of one with its weight."""
        at = _arrays.floats('y', y, (self.size,))
        if term is None:
            return self._core.linearize(at, 'projected')[1]
        return np.sum([self._core.gradient_of(place, at) for parts in self._places_of(term) for place, _ in parts],
                      axis=0)

    def hessian(self, y: ArrayLike, curvature: str = 'exact') -> Any:
        """Returns the Hessian by y as scipy.sparse.csc_matrix with both triangles. curvature: 'exact', 'projected',
        'absolute' (negative eigenvalues replaced by their absolute values instead of 0), 'majorizer',
        'paper-majorizer' or 'reweighted'; all terms must support it."""
        import scipy.sparse
        model = _curvature(curvature, 'absolute')
        _, _, starts, rows, values = self._core.linearize(_arrays.floats('y', y, (self.size,)), model)
        lower = scipy.sparse.csc_matrix((values, rows, starts), shape=(self.size, self.size))
        return (lower + scipy.sparse.tril(lower, -1).T).tocsc()

    def residuals(self, y: ArrayLike, term: Term) -> tuple[Doubles, Any]:
        """Returns the residuals of a `least_squares` term, times the square roots of weights, and their derivative
        by y, a scipy.sparse.csr_matrix."""
        import scipy.sparse
        at = _arrays.floats('y', y, (self.size,))
        parts = [self._core.residuals(place, at) for added in self._places_of(term) for place, _ in added]
        rows = [scipy.sparse.csr_matrix((values, columns, starts), shape=(len(r), self.size))
                for r, starts, columns, values in parts]
        return np.concatenate([part[0] for part in parts]), scipy.sparse.vstack(rows, 'csr')

    def factor(self, y: ArrayLike, curvature: str = 'exact') -> 'Factor':
        """Returns the factorized Hessian by y: `problem.factor(y).solve(b)` is H^-1 b. Raises UnsupportedError if it
        is not positive definite. curvature: as for `hessian`."""
        return Factor(self._core.factor(_arrays.floats('y', y, (self.size,)), _curvature(curvature, 'absolute')),
                      self.size)

    def minimize(self, x0: ArrayLike, method: str = 'newton', *, curvature: str = 'projected',
                 linear_solver: str = 'direct', tolerance: float | None = None,
                 max_iterations: int = _options.MAX_ITERATIONS, time_limit: float | None = None, threads: int = 0,
                 gap: float | None = None, saddles_to_leave: int = 0,
                 callback: Callable[[dict[str, Any], Doubles], Any] | None = None) -> Solution:
        """Returns a local minimum near x0, which satisfies the constraints.

            method          'newton'; 'lbfgs' and 'gradient-flow', with one factorization; 'levenberg-marquardt', damped
                            steps for `least_squares` terms that leave some unknowns undetermined, with damping
                            'shift' in the iterations; to compare with: 'ceres-lbfgs', 'ceres-nlcg', and for problems of
                            `least_squares` terms only 'ceres-lm' and 'ceres-dogleg'. Methods of Ceres have no
                            curvature and no linear_solver; conjugate gradients end far from ill-conditioned minima
                            and print their restarts to stderr.
            curvature       as for `hessian`; for 'newton' only: 'absolute', and 'adaptive', which chooses between
                            'absolute' and 'projected' after every step
            linear_solver   'direct' or 'eigen'
            tolerance       relative decrease of the energy in one iteration at which the run stops; None: the method's
                            default
            callback        callback(record, x) after every iteration; a true return value ends the run
            saddles_to_leave
                            upper bound on the saddles that a run of 'newton' leaves along negative curvature after it
                            has converged at one
            gap             excess of the energy, relative to it, that the last barrier may cause; None: 1e-8

        Bounds and inequalities are enforced by barriers whose weight falls to 0; only 'newton' supports them, and x0
        may violate them. Status 'infeasible' gives the violation: it has a minimum above 0, so that convex bounds
        exclude all points. 'stalled' means that no point inside was found, which proves nothing. Equalities are
        enforced by multipliers (`Solution.multipliers`), which converge in the same phases, to |g| <= 1e-10. For
        them 'infeasible' names the one of largest violation if their violation has a minimum above 0.
        """
        if self._holds and method != 'newton':
            raise UsageError(f"bounds, inequalities and equalities are for method='newton', not {method!r}")
        if self._on_manifolds and (method != 'newton' or saddles_to_leave):
            raise UsageError("unknowns on manifolds are for method='newton', without saddles_to_leave")
        if gap is not None and not self._has_bounds:
            raise UsageError('gap is of bounds and inequalities; hold some, or leave it out')
        if saddles_to_leave and (self._holds or method != 'newton'):
            raise UsageError("saddles_to_leave is of method='newton' without bounds and equalities")
        limit = math.inf if time_limit is None else _options.number('time_limit', time_limit, 0, zero=True, infinite=True)
        keywords = {
            'method': _options.choice('method', method, _METHODS),
            'curvature': _curvature(curvature, *(('absolute', 'adaptive') if method == 'newton' else ())),
            'linear_solver': _options.choice('linear_solver', linear_solver, ('direct', 'eigen')),
            'tolerance': None if tolerance is None else _options.number('tolerance', tolerance, 0, zero=True),
            'max_iterations': _options.integer('max_iterations', max_iterations, 0, 2**31 - 1),
            'time_limit': limit,
            'threads': _options.integer('threads', threads, 0, 1024),
            'gap': None if gap is None else _options.number('gap', gap, 0, 1),
            'saddles_to_leave': _options.integer('saddles_to_leave', saddles_to_leave, 0, 2**31 - 1),
        }
        return Solution(*self._core.minimize(_arrays.floats('x0', x0, (self.full_size,)), keywords,
                                             _options.callback(callback)),
                        {term: [list(parts) for parts in added] for term, added in self._places.items()})


_MANIFOLDS: dict[str, Callable[[int], bool]] = {
    'sphere': lambda size: size >= 2, 'rotation': lambda size: size in (4, 9), 'unit-complex': lambda size: size == 2}
_NUMBERS_OF = {'sphere': '2 or more', 'rotation': '4 or 9', 'unit-complex': '2'}


def _curvature(name: Any, *more: str) -> str:
    return _options.choice('curvature', name, ('projected', 'majorizer', 'paper-majorizer', 'exact',
                                               'reweighted', *more))


def _limits(name: str, value: Any, size: int) -> Doubles:
    """Returns the limits as one number for each unknown."""
    array = np.asarray(value)
    if array.dtype.kind not in 'iuf' or array.shape not in ((), (size,)):
        raise UsageError(f'{name} is neither a number nor {size} numbers')
    if np.isnan(array).any():
        raise UsageError(f'{name} is nan' if array.ndim == 0 else f'{name}[{int(np.argmax(np.isnan(array)))}] is nan')
    return np.ascontiguousarray(np.broadcast_to(array, (size,)), dtype=np.float64)


def _vertices(V: ArrayLike, kind: str) -> Doubles:
    plane = kind == 'quads' and np.ndim(V) == 2 and np.shape(V)[1] == 2
    return _arrays.floats('V', V, (None, 2 if plane else 3))


def _require_positive(V: Doubles, T: Integers) -> None:
    corners = V[T]
    turned = np.flatnonzero(~(np.linalg.det(corners[:, 1:] - corners[:, :1]) > 0))
    if len(turned):
        raise UnsupportedError(f'tetrahedron {turned[0]} has no positive volume; exchange two of its corners')
