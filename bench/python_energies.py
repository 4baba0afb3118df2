#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Measures energies in NumPy: a Markdown table of one linearization (energy, gradient, Hessian, assembly).

Symmetric Dirichlet on a bumpy square, by the kernel and as a Density: of formulas, of its value alone in
dual numbers, and of its value alone by differences. At degree 1 also as an element_term of the 6 unknowns of a
triangle, in dual numbers. Milliseconds of CPU time, the least of several runs.

Sample runs:
  bench/python_energies.py
  bench/python_energies.py --cells 30 --degrees 1 2 --build build/release
"""
import argparse
import sys
import time
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent


def surface(n):
    """Returns a bumpy square of 2 n^2 triangles."""
    x, y = (c.ravel() for c in np.meshgrid(np.linspace(0, 1, n + 1), np.linspace(0, 1, n + 1)))
    k = np.arange((n + 1) ** 2).reshape(n + 1, n + 1)
    a, b, c, d = k[:-1, :-1].ravel(), k[:-1, 1:].ravel(), k[1:, 1:].ravel(), k[1:, :-1].ravel()
    F = np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])])
    return np.column_stack([x, y, 0.3 * np.sin(3 * x) * np.cos(4 * y)]), F


def value(J):
    det = J[:, 0, 0] * J[:, 1, 1] - J[:, 0, 1] * J[:, 1, 0]
    return (J ** 2).sum((1, 2)) * (1 + 1 / det ** 2)


def derivatives(J):
    det = J[:, 0, 0] * J[:, 1, 1] - J[:, 0, 1] * J[:, 1, 0]
    c = np.stack([J[:, 1, 1], -J[:, 1, 0], -J[:, 0, 1], J[:, 0, 0]], axis=1)
    j = J.reshape(-1, 4)
    n = (j ** 2).sum(1)
    outer = lambda x, y: x[:, :, None] * y[:, None, :]  # noqa: E731
    column = lambda x: x[:, None, None]  # noqa: E731
    skew = np.fliplr(np.diag([1.0, -1, -1, 1]))
    gradient = 2 * (1 + det ** -2)[:, None] * j - (2 * n / det ** 3)[:, None] * c
    hessian = (column(2 * (1 + det ** -2)) * np.eye(4) - column(4 / det ** 3) * (outer(j, c) + outer(c, j))
               + column(6 * n / det ** 4) * outer(c, c) - column(2 * n / det ** 3) * skew)
    return gradient, hessian


def triangles(majorant, space, V):
    """Returns the same energy as a term of the corners of straight triangles."""
    cells = space.cells
    rest = V[space.input_vertices]
    a, b = (rest[cells[:, k]] - rest[cells[:, 0]] for k in (1, 2))
    length = np.linalg.norm(a, axis=1)
    along = (a * b).sum(1) / length
    height = np.sqrt((b ** 2).sum(1) - along ** 2)
    area = length * height / 2

    def energy(z, e):
        p = z.reshape(len(z), 3, 2)
        x = (p[:, 1] - p[:, 0]) / length[e, None]
        y = (p[:, 2] - p[:, 0] - along[e, None] * x) / height[e, None]
        det = x[:, 0] * y[:, 1] - x[:, 1] * y[:, 0]
        return area[e] * ((x ** 2).sum(1) + (y ** 2).sum(1)) * (1 + 1 / det ** 2)

    return majorant.element_term(cells, energy, block=2)


def least_time(call, runs):
    found = []
    for _ in range(runs):
        begin = time.process_time()
        call()
        found.append(time.process_time() - begin)
    return 1000 * min(found)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--build', type=Path, default=ROOT / 'build/release', help='build tree with the package')
    parser.add_argument('--cells', type=int, default=71, help='of a side of the square')
    parser.add_argument('--degrees', type=int, nargs='+', default=[1, 2, 3])
    parser.add_argument('--runs', type=int, default=3)
    options = parser.parse_args()
    sys.path.insert(0, str(options.build / 'python'))
    import majorant

    V, F = surface(options.cells)
    kinds = {'kernel': 'symmetric-dirichlet', 'formulas in numpy': majorant.Density('mine', value, derivatives),
             'value alone, dual numbers': majorant.Density('mine', value),
             'value alone, differences': majorant.Density('mine', lambda J: np.asarray(value(J)))}
    table = {kind: [] for kind in (*kinds, 'element_term, dual numbers')}
    for degree in options.degrees:
        space = majorant.Space(V, F, degree)
        x = space.tutte()
        for kind, energy in kinds.items():
            problem = majorant.Problem(space.size).add(space.energy(energy))
            problem.gradient(x)
            table[kind].append(least_time(lambda: problem.gradient(x), options.runs))
        if degree == 1:
            problem = majorant.Problem(space.size).add(triangles(majorant, space, V))
            assert abs(problem.value(x) / majorant.Problem(space.size).add(space.energy()).value(x) - 1) < 1e-10
            problem.gradient(x)
            table['element_term, dual numbers'].append(least_time(lambda: problem.gradient(x), options.runs))
    print('| %s faces | %s |' % (f'{len(F):,}', ' | '.join('degree %d' % d for d in options.degrees)))
    print('|---' * (len(options.degrees) + 1) + '|')
    for kind, times in table.items():
        cells = ['%.3g ms (%.1f)' % (t, t / k) for t, k in zip(times, table['kernel'])]
        print('| %s | %s |' % (kind, ' | '.join(cells + [''] * (len(options.degrees) - len(cells)))))


if __name__ == '__main__':
    main()
