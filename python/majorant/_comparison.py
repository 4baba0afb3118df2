# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Comparison of several methods on one problem."""
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
    """The result of one method: a row of `Comparison`.

    status: as of a `Solution`, or 'not_applicable' if the method does not fit the problem or is not in this build;
    `message` gives the reason. seconds: time of the method without the measurements. seconds_by_part:
    'assemble', 'factorize', 'solve', 'line_search'; nan for Ceres. energy, gradient_norm: at the end, measured in the
    same way for all methods; with bounds and equalities, the gradient is that of energy, barriers and multipliers
    together. distance: |x - x'| with x' of the first row of least energy. definite: as of a `Solution`. notes:
    sentences on results to look into. points: arrays 'seconds', 'energy', 'gradient_norm', 'step' by iteration, the
    start first; the energy is inf at points that violate bounds, inequalities or equalities.
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
    """The result of `compare`: a sequence of rows (`ComparedMethod`) that prints as a table.

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
        """Returns a row by its index or by the name of its method."""
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
        """Returns the table for notebooks."""
        return self._core.html()

    def to_csv(self, path: str | os.PathLike[str], *, points: bool = False) -> None:
        """Writes a line for each row or, with points=True, for each point of each row."""
        self._core.write_csv(os.fspath(path), _options.truth('points', points))

    def page(self, path: str | os.PathLike[str]) -> None:
        """Writes a self-contained page for a browser: the table, and plots of the energies over iterations and
        seconds."""
        self._core.write_page(os.fspath(path))


def compare(problem: Problem, x0: ArrayLike, methods: Sequence[str] | None = None, *, time_limit: float = 60,
            tolerance: float | None = None, max_iterations: int | None = None, threads: int = 0,
            title: str = '') -> Comparison:
    """Solves a problem by several methods from the same start, x0 as for `Problem.minimize`.

        print(majorant.compare(problem, x0))
        majorant.compare(problem, x0, ['newton', 'lbfgs']).page('methods.html')

    methods: names; None: all. 'newton'; Newton's method with one fixed curvature: 'newton-projected',
    'newton-absolute', 'newton-adaptive', 'newton-majorizer', 'newton-paper-majorizer', 'newton-reweighted',
    'newton-exact'; with other linear solvers: 'newton-eigen', 'newton-cholmod'; 'lbfgs', 'gradient-flow',
    'levenberg-marquardt', 'ceres-lbfgs', 'ceres-lm', 'ceres-dogleg'. The row of a method that does not fit the
    problem, or is not in this build, says so. Only Newton's method takes bounds, inequalities, equalities and
    manifolds.

    time_limit: seconds for each method. tolerance: relative decrease of the energy at which Newton's method stops.
    max_iterations: of each method; None: its default.

    Notes report gradients that disagree with finite differences, ends at which the exact Hessian is indefinite,
    different minima, and methods whose final gradient is 1000 times as large as that of the others.
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
