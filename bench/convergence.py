#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""How the methods of majorant.compare() converge on three problems, as a picture and a table.

The problems, all generated:
  map     the free flattening of a bumpy square, symmetric Dirichlet, from Tutte's map: barriers at every element
  block   a block of tetrahedra, symmetric Dirichlet, stretched by 1.4, one end held and the other one turned by
          60 degrees
  ropes   a rope of 60 springs with weights, which starts compressed and crooked: flat directions

Each panel shows the energy above the least one that any method reached, over iterations;
methods that factorize nothing are drawn in grey. Every method has at most 100 iterations.

Sample run:
  PYTHONPATH=build/release/python bench/convergence.py --picture docs/pictures/convergence.svg
"""
import argparse
import sys
from pathlib import Path

import numpy as np

sys.dont_write_bytecode = True
BENCH = Path(__file__).resolve().parent
sys.path.insert(0, str(BENCH))
sys.path.insert(0, str(BENCH / 'experiments'))
import common  # noqa: E402
import experiment  # noqa: E402

METHODS = ['newton', 'newton-projected', 'newton-absolute', 'newton-exact', 'newton-majorizer', 'lbfgs', 'ceres-lbfgs']
COLOURS = ('#000000', '#228833', '#4477aa', '#994455', '#ee7733', '#999999', '#cccccc')
FLOOR = 1e-12                                   # of the whole decrease; rounding below


def grid(n, height):
    """Vertices and triangles of a square of n x n cells with bumps of that height."""
    t = np.linspace(0, 1, n + 1)
    x, y = np.meshgrid(t, t, indexing='ij')
    V = np.stack([x, y, height * np.sin(7 * x) * np.cos(5 * y)], axis=-1).reshape(-1, 3)
    k = np.arange((n + 1) ** 2).reshape(n + 1, n + 1)
    a, b, c, d = (s.ravel() for s in (k[:-1, :-1], k[1:, :-1], k[1:, 1:], k[:-1, 1:]))
    return V, np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])


def map_problem(majorant):
    V, F = grid(24, 0.3)
    space = majorant.Space(V, F, degree=1)
    problem = majorant.Problem(space.size)
    problem.add(space.energy('symmetric-dirichlet'), 1 / space.area).keep_injective(space)
    return problem, space.tutte()


def block_problem(majorant):
    n = np.array([6, 2, 2])
    points = np.stack(np.meshgrid(*(np.arange(k + 1) for k in n), indexing='ij'), -1).reshape(-1, 3)
    number = {tuple(p): k for k, p in enumerate(points)}
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    cubes = [[number[tuple(p + c)] for c in np.array(corners)] for p in points if (p < n).all()]
    # Six tetrahedra around the diagonal 0-6 of each cube.
    around = [1, 2, 3, 7, 4, 5]
    T = np.array([[cube[0], cube[a], cube[b], cube[6]] for cube in cubes for a, b in zip(around, np.roll(around, -1))])
    V = points / n.max()
    det = np.linalg.det(V[T[:, 1:]] - V[T[:, :1]])
    T[det < 0] = T[det < 0][:, [0, 2, 1, 3]]
    space = majorant.Space(V, T, degree=1, cells='tetrahedra')

    density = majorant.Density('|J|^2 + |J^-1|^2', lambda J: (J ** 2).sum((1, 2)) + (np.linalg.inv(J) ** 2).sum((1, 2)),
                               barrier='strong')
    problem = majorant.Problem(space.size).add(space.energy(density), 1 / space.area).keep_injective(space)
    x = space.linear(V).reshape(-1, 3)
    share = V[:, 0] / V[:, 0].max()
    turn = np.pi / 3 * share
    middle = V[:, 1:].mean(0)
    y, z = (V[:, 1:] - middle).T
    twisted = np.stack([V[:, 0] * 1.4, y * np.cos(turn) - z * np.sin(turn), y * np.sin(turn) + z * np.cos(turn)], 1)
    twisted[:, 1:] += middle
    start = x.copy()
    start[:] = space.linear(twisted).reshape(-1, 3)
    held = np.repeat((share == 0) | (share == 1), 3)
    rows = np.flatnonzero(held)
    problem.constrain(np.eye(space.size)[rows], start.ravel()[rows])
    return problem, start.ravel()


def rope_problem(majorant):
    n = 60
    edges = np.stack([np.arange(n), np.arange(1, n + 1)], axis=1)

    def spring(z, e):
        d = z[:, 2:] - z[:, :2]
        return 50 * n * ((d ** 2).sum(1) ** 0.5 - 1 / n) ** 2

    weights = np.zeros(2 * (n + 1))
    weights[1::2] = 1 / n
    problem = majorant.Problem(2 * (n + 1)).add(majorant.element_term(edges, spring, block=2))
    problem.add(majorant.linear_term(weights))
    ends = [0, 1, 2 * n, 2 * n + 1]
    problem.constrain(np.eye(2 * (n + 1))[ends], [0, 0, 0.6, 0])
    x = np.stack([np.linspace(0, 0.6, n + 1), np.zeros(n + 1)], 1)
    x[1:-1] += 0.004 * np.random.default_rng(3).normal(size=(n - 1, 2))
    return problem, x.ravel()


PROBLEMS = {'map': map_problem, 'block': block_problem, 'ropes': rope_problem}


def draw(tables, path):
    figure, axes = experiment.panels(1, len(tables), 3.6, 3.2)
    for axis, (name, table) in zip(axes[0], tables.items()):
        least = min(row.points['energy'].min() for row in table if len(row.points['energy']))
        for colour, row in zip(COLOURS, table):
            energy = row.points['energy']
            if not len(energy):
                continue
            above = np.maximum((energy - least) / (energy[0] - least), FLOOR)
            axis.semilogy(np.arange(len(energy)), above, color=colour, label=row.method)
        axis.set(title=name, xlabel='iterations', xscale='symlog', ylim=(FLOOR / 2, 2))
        axis.set_ylabel('energy above the least, part of the decrease')
    axes[0, -1].legend(*axes[0, 0].get_legend_handles_labels(), loc='lower left')
    experiment.write_svg(figure, path)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--picture', type=Path, metavar='SVG')
    options = parser.parse_args()
    import majorant
    tables = {}
    for name, make in PROBLEMS.items():
        problem, x = make(majorant)
        tables[name] = majorant.compare(problem, x, METHODS, title=name, max_iterations=100)
        print('%s: %d unknowns' % (name, len(x)))
        print('\n'.join(common.markdown_table(
            ['method', 'status', 'iterations', 'factorizations', 'energy', 'notes'],
            [[row.method, row.status, row.iterations, row.factorizations, '%.10g' % row.energy, '; '.join(row.notes)]
             for row in tables[name]])))
        print()
    if options.picture:
        draw(tables, options.picture)
    return 0


if __name__ == '__main__':
    sys.exit(main())
