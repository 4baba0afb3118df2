# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Several methods on one problem."""
from __future__ import annotations

import dataclasses
import math
import os
from typing import Iterator, Sequence

from numpy.typing import ArrayLike

from . import _arrays, _core, _options
from ._errors import UsageError
from ._framework import Problem
from ._types import Doubles


@dataclasses.dataclass(frozen=True)
class ComparedMethod:
    """A row of `Comparison`: a method and what became of it.

    status: as that of a `Solution`; 'not_applicable' where the problem is not for the method, or the method
    not in this build, as `message` says. seconds: the method's own, without what measuring takes;
    seconds_by_part: 'assemble', 'factorize', 'solve', 'line_search'; nan of Ceres. energy and
    gradient_norm: at the end, measured in the same way for all; with bounds and equalities the gradient is
    that of energy, barriers and multipliers together. distance: |x - x'|, x' of the first row with the least
    energy. definite: as that of a `Solution`. notes: sentences on what to look into. points: arrays 'seconds',
    'energy', 'gradient_norm', 'step' by iteration, the start first; the energy is inf where a point does not
    meet what is to hold.
    """
    method: str
    status: str
    message: str
    iterations: int
    factorizations: int
    seconds: float
    seconds_by_part: dict[str, float]
    energy: float
    gradient_norm: float
    distance: float
    definite: str
    notes: list[str]
    x: Doubles
    points: dict[str, Doubles]


class Comparison:
    """The result of `compare`: prints as a table, and is a sequence of rows (`ComparedMethod`).

    notes: sentences on the problem, such as a gradient that disagrees with finite differences.
    """

    def __init__(self, core: _core.Comparison):
        self._core = core
        self._rows = [ComparedMethod(**row) for row in core.rows()]
        self.notes: list[str] = core.notes

    def __iter__(self) -> Iterator[ComparedMethod]:
        return iter(self._rows)

    def __len__(self) -> int:
        return len(self._rows)

    def __getitem__(self, which: int | str) -> ComparedMethod:
        """By number, or by the method's name."""
        if not isinstance(which, str):
            return self._rows[which]
        for row in self._rows:
            if row.method == which:
                return row
        raise KeyError(which)

    def __str__(self) -> str:
        return self._core.text()

    def __repr__(self) -> str:
        return f'<majorant.Comparison: {", ".join(row.method for row in self._rows)}>'

    def _repr_html_(self) -> str:
        """In notebooks: the table."""
        return self._core.html()

    def to_csv(self, path: str | os.PathLike[str], *, points: bool = False) -> None:
        """A line for each row, or for each point of each row."""
        self._core.write_csv(os.fspath(path), _options.truth('points', points))

    def page(self, path: str | os.PathLike[str]) -> None:
        """One self-contained page for a browser: the table, and how the energies fall over iterations and
        seconds."""
        self._core.write_page(os.fspath(path))


def compare(problem: Problem, x0: ArrayLike, methods: Sequence[str] | None = None, *, time_limit: float = 60,
            tolerance: float | None = None, max_iterations: int | None = None, threads: int = 0,
            title: str = '') -> Comparison:
    """Solves a problem by several methods from the same start, x0 as for `Problem.minimize`.

        print(majorant.compare(problem, x0))
        majorant.compare(problem, x0, ['newton', 'lbfgs']).page('methods.html')

    methods: names; None: all. 'newton', and 'newton-projected', 'newton-absolute', 'newton-adaptive',
    'newton-majorizer', 'newton-paper-majorizer', 'newton-reweighted', 'newton-exact', which keep to one
    curvature; 'newton-eigen', 'newton-cholmod' with other linear solvers; 'lbfgs', 'gradient-flow',
    'levenberg-marquardt', 'ceres-lbfgs', 'ceres-lm', 'ceres-dogleg'. Methods that are not for the problem,
    or not in this build, have a row that says so; bounds, inequalities, equalities and manifolds are for
    Newton's alone.

    time_limit: seconds for each method. tolerance: relative decrease of the energy that ends Newton's method.
    max_iterations: of each method; None: its own.

    Notes name gradients that disagree with finite differences, ends where the exact Hessian is indefinite,
    minima that differ, and methods that stopped with a gradient 1000 times as large as that of the others.
    """
    if not isinstance(problem, Problem):
        raise UsageError(f'{problem!r} is no Problem')
    known = tuple(_core.comparison_methods())
    if isinstance(methods, str):
        raise UsageError(f'methods is a list of names, such as [{methods!r}]')
    if methods is not None:
        try:
            methods = list(methods)
        except TypeError:
            raise UsageError(f'methods is {methods!r}, a list of names is needed, or None for all') from None
        if not methods:
            raise UsageError('methods is empty; None compares all of them')
    names = list(known) if methods is None else [_options.choice('method', name, known) for name in methods]
    keywords = {
        'time_limit': _options.number('time_limit', time_limit, 0, math.inf, zero=True, infinite=True),
        'tolerance': None if tolerance is None else _options.number('tolerance', tolerance, 0, zero=True),
        'max_iterations': (None if max_iterations is None
                           else _options.integer('max_iterations', max_iterations, 0, 2**31 - 1)),
        'threads': _options.integer('threads', threads, 0, 1024),
        'title': str(title),
    }
    start = problem._core.compared_from(_arrays.floats('x0', x0, (problem.full_size,)))
    return Comparison(_core.compare(start, names, keywords))
