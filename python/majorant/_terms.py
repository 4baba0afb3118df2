# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Terms and inequalities of problems, from functions in numpy."""
from __future__ import annotations

import warnings
from typing import Any, Callable

import numpy as np
from numpy.typing import ArrayLike

from . import _arrays, _core, _options
from ._derivatives import PointFunction
from ._duals import lower_triangle
from ._errors import UsageError
from ._types import Doubles, Integers, Nodes

# Upper bounds on the unknowns of an element, and on the second derivatives of all elements of a term, each
# counted like the largest element. An entry takes 4 bytes for its position, and 8 for its value during assembly.
_LARGEST_ELEMENT = 1024
_MOST_ENTRIES = 2**31 - 1

_ARGUMENTS = ('z', 'e', 'data')  # names for the arguments of element functions

LOSSES = ('huber', 'soft-l1', 'cauchy', 'arctan', 'tukey')
_EXACT = ('exact', 'projected')


class Elements:
    """The nodes of the elements of a term: (#E, nodes of an element), or a list of nodes for each element, of any
    lengths. A node has `block` unknowns."""

    def __init__(self, nodes: Nodes, block: int):
        self.block = _options.integer('block', block, 1, 64)
        rows = _rows_of(nodes)
        if not len(rows):
            raise UsageError('nodes is empty: a term has one element or more')
        if isinstance(rows, list):
            self.cells, self.counts = _padded(rows)
        else:
            if rows.ndim != 2:
                raise UsageError(f'nodes has shape {rows.shape}, not (#elements, nodes of each): one row an element')
            if not rows.size:
                raise UsageError('nodes[0] is empty: an element has one node or more')
            self.cells = _arrays.integers('nodes', rows, (None, None), 2**31 - 1, 'nodes')
            self.counts = np.empty(0, dtype=np.int32)       # empty: all elements have equally many nodes
        largest = self.block * self.cells.shape[1]
        if largest > _LARGEST_ELEMENT or len(self.cells) * largest * (largest + 1) // 2 > _MOST_ENTRIES:
            raise UsageError(f'{len(self.cells)} elements, the largest with {largest} unknowns, have too many second '
                             f'derivatives: an element has {_LARGEST_ELEMENT} unknowns at most; make large elements '
                             'a term of their own')
        self.size = (int(self.cells.max()) + 1) * self.block  #: least number of unknowns of a problem with this term
        self.numbers = np.arange(len(self.cells), dtype=np.int32)

    @property
    def groups(self) -> list[tuple[Integers, int]]:
        """Returns pairs of the elements with equally many nodes, and that number of nodes."""
        if not len(self.counts):
            return [(self.numbers, self.cells.shape[1])]
        return [(np.flatnonzero(self.counts == n).astype(np.int32), int(n)) for n in np.unique(self.counts)]

    def require_within(self, size: int, name: str) -> None:
        """Raises UsageError for a node beyond the `size` unknowns of a problem."""
        outside = self.cells.astype(np.int64) >= size // self.block
        if outside.any():
            e, k = (int(i) for i in np.argwhere(outside)[0])
            raise UsageError(f'{name}: node {k} of element {e} is {self.cells[e, k]}; the problem has {size} unknowns, '
                             f'nodes 0 to {size // self.block - 1} of {self.block} each')

    def of(self, x: Doubles, elements: Integers, count: int) -> Doubles:
        """Returns z of these elements, which have `count` nodes each."""
        nodes = self.block * self.cells[elements, :count, None].astype(np.int64)
        return x[(nodes + np.arange(self.block)).reshape(len(elements), -1)]


def _rows_of(nodes: Any) -> np.ndarray | list[Any]:
    """Returns nodes as an array, or as a list of rows that differ in length."""
    if not hasattr(nodes, '__len__') or isinstance(nodes, (str, bytes, dict, set, frozenset)):
        raise UsageError(f'nodes is a {type(nodes).__name__}, neither an array (#elements, nodes of each) nor a list '
                         'with the nodes of each element')
    try:
        with warnings.catch_warnings():
            warnings.simplefilter('ignore')     # numpy before 1.24 warns and makes an array of objects
            array = np.asarray(nodes)
    except ValueError:
        return list(nodes)
    return list(nodes) if array.dtype == object and array.ndim == 1 else array


def _padded(lists: list[Any]) -> tuple[Integers, Integers]:
    """Returns rows of equal length, in which the first node fills up short elements, and the numbers of nodes."""
    for e, row in enumerate(lists):
        if not np.size(row):
            raise UsageError(f'nodes[{e}] is empty: an element has one node or more')
    rows = [_arrays.integers(f'nodes[{e}]', row, (None,), 2**31 - 1, 'nodes') for e, row in enumerate(lists)]
    counts = np.array([len(row) for row in rows], dtype=np.int32)
    cells = np.repeat(np.array([row[:1] for row in rows]), counts.max(), axis=1)
    cells[np.arange(counts.max()) < counts[:, None]] = np.concatenate(rows)
    return cells, counts


class _Function:
    """A user's function at elements, with a test of its derivatives."""

    def __init__(self, name: str, elements: Elements, function: PointFunction, data: Doubles | None = None):
        self.name, self._elements, self._function = name, elements, function
        self._data = () if data is None else (data,)

    @property
    def derivatives(self) -> str:
        """The source of derivatives: 'given', 'dual numbers' or 'differences'."""
        return self._function.derivatives(*_samples(self._elements, self._data))

    def check_derivatives(self, x: ArrayLike, tolerance: float = 1e-5) -> None:
        """Raises AssertionError, naming entry and element, if derivatives at x disagree with differences of the
        value. x must be inside of the domain."""
        at = _arrays.floats('x', x, (None,))
        if len(at) < self._elements.size:
            raise UsageError(f'x has {len(at)} numbers, {self.name} takes {self._elements.size}')
        for elements, count in self._elements.groups:
            self._function.check(self._elements.of(at, elements, count), tolerance, elements,
                                 *(d if d.ndim == 1 else d[elements] for d in self._data))


def _samples(elements: Elements, data: tuple[Doubles, ...]) -> list[tuple[Any, ...]]:
    """Returns the arguments of a function at one element of each size."""
    return [(np.linspace(1, 2, elements.block * count)[None], members[:1],
             *(d if d.ndim == 1 else d[members[:1]] for d in data)) for members, count in elements.groups]


class Term:
    """A sum of functions of few unknowns, for `Problem.add`. Made by `Space.energy`, `penalty`, `linear_term`,
    `element_term`, `least_squares`, `Inequality.penalty`."""

    def __init__(self, parts: list[tuple[_core.Term, float]], size: int, *, of_all: bool = False,
                 function: _Function | None = None, space: Any = None):
        self._parts, self._size = parts, size
        self._space = space  # the space of an energy
        self._of_all = of_all  # whether the problem must have exactly `size` unknowns
        self._function = function

    @property
    def name(self) -> str:
        return ' + '.join(part.name for part, _ in self._parts)

    @property
    def derivatives(self) -> str | None:
        """The source of derivatives of a user's function: 'given', 'dual numbers' or 'differences'."""
        return None if self._function is None else self._function.derivatives

    def check_derivatives(self, x: ArrayLike, tolerance: float = 1e-5) -> None:
        """Raises AssertionError, naming entry and element, if the derivatives of an `element_term` or
        `least_squares` at x disagree with differences of the value (of the residuals). x must be inside of the
        domain."""
        if self._function is None:
            raise UsageError(f'{self.name}: the derivatives of functions in numpy alone are yours to check')
        self._function.check_derivatives(x, tolerance)

    def __repr__(self) -> str:
        return f'<majorant.Term {self.name!r}>'


def penalty(A: Any, b: ArrayLike) -> Term:
    """Returns the term |A x - b|^2, rows of a scipy.sparse matrix or a dense one as soft constraints.

    Rows have at most 512 unknowns. For constraints that must hold use `Problem.constrain`.
    """
    starts, columns, values, targets, size = _arrays.rows(A, b)
    empty = np.flatnonzero(np.diff(starts) == 0)
    longest = int(np.diff(starts).max(initial=0))
    if len(empty) or longest > 512:
        raise UsageError(f'row {empty[0]} of A is empty' if len(empty) else
                         f'a row of A has {longest} entries, more than 512')
    return Term([(_core.penalty(starts, columns, values, targets), 1.0)], size, of_all=True)


def linear_term(c: ArrayLike) -> Term:
    """Returns the term c . x, for loads and gravity. Another term must bound the energy from below."""
    coefficients = _arrays.floats('c', c, (None,))
    return Term([(_core.linear_term(coefficients), 1.0)], len(coefficients), of_all=True)


def element_term(nodes: Nodes, value: Callable[..., Any], derivatives: Callable[..., Any] | None = None, *,
                 block: int = 1, data: ArrayLike | None = None, name: str = 'element term') -> Term:
    """Returns the term sum over elements e of f(unknowns of e), with f in numpy for many elements at once.

        def value(z, e):                      # z (q, k), e (q,): numbers of the elements -> (q,)
            return ((z[:, 1] - z[:, 0]) ** 2 - rest[e]) ** 2

        springs = majorant.element_term(edges, value)

    Derivatives come from the value, as those of a `Density`, or are given:

        def derivatives(z, e): ...            # -> (q, k), (q, k, k): gradient and Hessian

    nodes: (#E, nodes of an element). A node is `block` consecutive unknowns, so that z has k = block * nodes
    columns: z[:, block * i + c] = x[block * nodes[e, i] + c]. Elements of different sizes are a list with
    the nodes of each, such as the faces of a mesh of polygons,

        def planarity(z, e): p = z.reshape(len(z), -1, 3) ...      # once for triangles, once for quads

        majorant.element_term([[0, 1, 2], [2, 1, 3, 4]], planarity, block=3)

    and each call has elements of one size. value may be inf or NaN outside of its domain. The Hessian is exact and
    symmetric (otherwise UsageError); solvers make it definite if necessary. `Term.check_derivatives` compares it
    with differences.

    data: numbers that may change between solves (`Problem.update`), passed to the functions as a third
    argument: a vector (m,), which is passed whole, or (#E, m), of which the rows of e are passed, (q, m).
    """
    elements = Elements(nodes, block)
    function = PointFunction(_named(name), 'element', value, derivatives)
    function.require_arguments(_ARGUMENTS[:2 if data is None else 3])
    return _term(name, elements, function, _Plain(function), _EXACT, _data(data, elements))


def least_squares(nodes: Nodes, residuals: Callable[..., Any], derivatives: Callable[..., Any] | None = None, *,
                  loss: str | None = None, width: float | None = None, block: int = 1,
                  data: ArrayLike | None = None, name: str = 'least squares') -> Term:
    """Returns the term sum over elements e of rho(|r|^2) / 2, with the residuals r of e in numpy for many elements
    at once.

        def residuals(z, e):                  # z (q, k), e (q,) -> (q,), or (q, m) for m residuals each
            return z[:, 0] * np.exp(z[:, 1] * t[e]) - y[e]

        fit = majorant.least_squares([[0, 1]] * len(t), residuals, loss='huber', width=0.1)

    loss: the growth for |r| above `width`: 'huber' (linear), 'soft-l1' (linear, smooth), 'cauchy' (logarithmic),
    'arctan' (bounded), 'tukey' (constant: outliers have no effect); None: rho(s) = s.
    Curvature: 'projected' and 'reweighted' are Gauss-Newton's; 'exact' adds the second derivatives of r.
    derivatives(z, e), if given, returns dr/dz, (q, k) or (q, m, k), or the pair of it and the second derivatives,
    (q, k, k) or (q, m, k, k), which 'exact' requires. nodes, block, data: as for `element_term`.
    """
    if loss is not None:
        _options.choice('loss', loss, LOSSES)
    if (loss is None) != (width is None):
        raise UsageError(f'width={width!r} is of a loss: {", ".join(LOSSES)}' if loss is None else
                         f'loss={loss!r} needs a width, in the units of the residuals')
    elements = Elements(nodes, block)
    function = PointFunction(_named(name), 'element', residuals, derivatives, rank=1)
    function.require_arguments(_ARGUMENTS[:2 if data is None else 3])
    squares = _Squares(function, loss,
                       1.0 if width is None else _options.number('width', width, 0, _options.LARGEST))
    curvatures: tuple[str, ...] = ('projected', 'reweighted')
    numbers = _data(data, elements)
    if derivatives is None or _gives_bends(derivatives, elements, numbers):
        curvatures = ('exact', *curvatures)
    return _term(name, elements, function, squares, curvatures, numbers)


def _gives_bends(derivatives: Callable[..., Any], elements: Elements, data: Doubles | None) -> bool:
    with np.errstate(all='ignore'):
        return isinstance(derivatives(*_samples(elements, () if data is None else (data,))[0]), tuple)


def _data(data: ArrayLike | None, elements: Elements) -> Doubles | None:
    """Returns the data of elements, (m,) for all of them or one row each."""
    if data is None:
        return None
    numbers = _arrays.numbers('data', data)
    array = _arrays.floats('data', numbers, (None,) if numbers.ndim == 1 else (len(elements.cells), None))
    if not array.size:
        raise UsageError('data is empty')
    return array


def parameter_blocks(*blocks: tuple[ArrayLike, int]) -> Integers:
    """Returns the unknowns of elements with blocks of different sizes, (#E, sum of the sizes).

        camera, point = np.array(seen).T                # numbers, of each observation
        nodes = majorant.parameter_blocks((6 * camera, 6), (6 * cameras + 3 * point, 3))
        term = majorant.least_squares(nodes, residuals)    # z[:, :6] the camera, z[:, 6:] the point

    blocks: (first, size), the first unknown (#E,) of a block of this size.
    """
    if not blocks:
        raise UsageError('parameter_blocks needs at least one (first, size)')
    columns = []
    for first, size in blocks:
        start = _arrays.integers('first', first, (None,), 2**31 - 1, 'unknowns')
        columns.append(start[:, None] + np.arange(_options.integer('size', size, 1, 512), dtype=np.int32))
    if len({len(column) for column in columns}) > 1:
        raise UsageError(f'blocks have {", ".join(str(len(column)) for column in columns)} elements')
    return np.concatenate(columns, axis=1)


class _Held:
    """A condition on a function g of the unknowns of elements."""

    def __init__(self, nodes: Nodes, value: Callable[..., Any], derivatives: Callable[..., Any] | None,
                 block: int, name: str):
        self.name = _named(name)
        self._elements = Elements(nodes, block)
        self._function = PointFunction(self.name, 'element', value, derivatives)
        self._function.require_arguments(_ARGUMENTS[:2])
        self._checked = _Function(self.name, self._elements, self._function)
        self._size = self._elements.size

    @property
    def derivatives(self) -> str:
        """The source of derivatives: 'given', 'dual numbers' or 'differences'."""
        return self._checked.derivatives

    def check_derivatives(self, x: ArrayLike, tolerance: float = 1e-5) -> None:
        """Raises AssertionError, naming entry and element, if the derivatives of g at x disagree with differences."""
        self._checked.check_derivatives(x, tolerance)

    def __repr__(self) -> str:
        return f'<majorant.{type(self).__name__} {self.name!r}>'


class Equality(_Held):
    """g(unknowns of e) = 0 for every element e, with g in numpy for many elements at once.

        def too_long(z, e):                   # z (q, k), e (q,) -> (q,)
            return ((z[:, 2:] - z[:, :2]) ** 2).sum(1) - length[e] ** 2

        problem.hold(majorant.Equality(rods, too_long, block=2))
        solution = problem.minimize(x0)       # x0 need not satisfy it
        solution.multipliers                  # one per rod: gradient of the energy + l . gradient of g = 0

    Scale g to size about 1, with derivatives that do not vanish where g = 0. Equalities may depend on each
    other. For linear ones use `Problem.constrain`, which eliminates them. Derivatives, nodes, block: as for
    `element_term`. To differentiate solutions by a number in g, make it an unknown that `Problem.constrain` fixes.
    """

    def __init__(self, nodes: Nodes, value: Callable[..., Any], derivatives: Callable[..., Any] | None = None, *,
                 block: int = 1, name: str = 'equality'):
        super().__init__(nodes, value, derivatives, block, name)
        self._augmented = _Outer(self._function, _augmented)


class Inequality(_Held):
    """g(unknowns of e) >= 0 for every element e, with g in numpy for many elements at once.

        def gap(z, e):                        # z (q, k), e (q,) -> (q,)
            return ((z[:, 2:] - z[:, :2]) ** 2).sum(1) - 0.25

        apart = majorant.Inequality(pairs, gap, block=2)
        problem.hold(apart)                   # exactly
        problem.add(apart.penalty(), 1e3)     # or softly

    Scale g to size about 1. Derivatives, nodes, block: as for `element_term`.
    """

    def __init__(self, nodes: Nodes, value: Callable[..., Any], derivatives: Callable[..., Any] | None = None, *,
                 block: int = 1, name: str = 'inequality'):
        super().__init__(nodes, value, derivatives, block, name)

    def penalty(self) -> Term:
        """Returns the term sum of min(g, 0)^2. Any start is allowed; at the minimum g is about -|multiplier| / (2
        weight)."""
        return _term(self.name, self._elements, self._function, _Outer(self._function, _violation), _EXACT)

    # ---- called by the module --------------------------------------------------------------------
    def evaluate(self, z: Doubles, e: Integers) -> Doubles:
        return self._function.evaluate(z, e)

    def barrier(self, slack: float) -> '_Outer':
        """Returns the function -log(g + slack)."""
        return _Outer(self._function, lambda g: _logarithm(g + slack))

    def violation(self, margin: float) -> '_Outer':
        """Returns the function max(0, margin - g)^2."""
        return _Outer(self._function, lambda g: _violation(g - margin))


def _named(name: Any) -> str:
    if not isinstance(name, str) or not name:
        raise UsageError(f'name={name!r} is no name')
    return name


def _term(name: str, elements: Elements, function: PointFunction, model: Any, curvatures: tuple[str, ...],
          data: Doubles | None = None) -> Term:
    part = _core.element_term(name, elements.cells, elements.counts, elements.block, model, list(curvatures), data)
    return Term([(part, 1.0)], elements.size, function=_Function(name, elements, function, data))


class _Plain:
    """The functions of a term that the module calls: values, and values with gradients and Hessians. `exact` is the
    weight of the second derivatives of residuals; other terms always have full second derivatives."""

    def __init__(self, function: PointFunction):
        self.evaluate, self._function = function.evaluate, function

    def linearize(self, z: Doubles, e: Integers, exact: float, *data: Doubles) -> tuple[Doubles, Doubles, Any]:
        return self._function.linearize(z, e, *data)


class _Outer:
    """A function of g and of the elements' data: outer(g, *data) -> value, first and second derivative by g."""

    def __init__(self, function: PointFunction, outer: Callable[..., tuple[Doubles, ...]]):
        self._function, self._outer = function, outer

    def evaluate(self, z: Doubles, e: Integers, *data: Doubles) -> Doubles:
        with np.errstate(all='ignore'):
            return self._outer(self._function.evaluate(z, e), *data)[0]

    def linearize(self, z: Doubles, e: Integers, exact: float, *data: Doubles) -> tuple[Doubles, Doubles, Doubles]:
        g, gradient, hessian = self._function.linearize(z, e)
        with np.errstate(all='ignore'):
            value, slope, bend = self._outer(g, *data)
            return value, slope * gradient, slope * hessian + lower_triangle(bend * gradient, gradient)


def _violation(g: Doubles) -> tuple[Doubles, ...]:
    low = np.minimum(g, 0.0)
    return low * low, 2.0 * low, np.where(g < 0, 2.0, 0.0)


def _augmented(g: Doubles, data: Doubles) -> tuple[Doubles, ...]:
    """Returns l g + r g^2 / 2 and its derivatives by g, with rows (l, r) of data."""
    multiplier, penalty = data.T
    return multiplier * g + 0.5 * penalty * g * g, multiplier + penalty * g, penalty


def _logarithm(room: Doubles) -> tuple[Doubles, ...]:
    return np.where(room > 0, -np.log(room), np.inf), -1 / room, 1 / room ** 2


class _Squares:
    """The function rho(|r|^2) / 2, by the formulas of framework/terms/least_squares.h."""

    def __init__(self, residuals: PointFunction, loss: str | None, width: float):
        self._residuals, self._loss, self._width = residuals, loss, width

    def evaluate(self, z: Doubles, e: Integers, *data: Doubles) -> Doubles:
        return self._rho((self._residuals.evaluate(z, e, *data) ** 2).sum(1))[0] / 2

    def linearize(self, z: Doubles, e: Integers, exact: float, *data: Doubles) -> tuple[Doubles, Doubles, Doubles]:
        r, J, H = self._residuals.linearize(z, e, *data)
        with np.errstate(all='ignore'):
            rho, slope, bend = self._rho((r ** 2).sum(0))
            gradient = np.einsum('mq,mkq->kq', r, J)
            model = lower_triangle(J[0], J[0])
            for row in J[1:]:
                model += lower_triangle(row, row)
            if exact and H is not None:
                model += exact * np.einsum('mq,mkq->kq', r, H)
            model *= slope
            if bend.any():
                model += lower_triangle(2 * np.where(bend < 0, exact * bend, bend) * gradient, gradient)
            return rho / 2, slope * gradient, model

    # ---- for ResidualTerm: single elements ------------------------------------------------------
    def residuals(self, z: Doubles, e: Integers, *data: Doubles) -> Doubles:
        return self._residuals.evaluate(z, e, *data)

    def jacobian(self, z: Doubles, e: Integers, *data: Doubles) -> Doubles:
        return self._residuals.differentiate(z, e, *data)[0]

    def loss(self, s: float) -> tuple[float, ...]:
        return tuple(float(part[0]) for part in self._rho(np.array([s])))

    def _rho(self, s: Doubles) -> tuple[Doubles, ...]:
        if self._loss is None:
            return s, np.ones_like(s), np.zeros_like(s)
        return tuple(_core.robust_loss(self._loss, self._width, s))
