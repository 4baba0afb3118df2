#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Random small problems with equalities, curved inequalities and bounds, judged by their optimality
conditions.

A problem has 2 to 12 unknowns and is feasible by construction: all its constraints hold at a random point.
Its start is another one, up to five times as far away. Problem k has the random seed k and is the same on
every machine. A run that ends "converged" is wrong if the gradient of the Lagrangian with the returned
multipliers does not vanish, with the best multipliers of inequalities and bounds, by non-negative least
squares; if these are not complementary; if an equality is violated by more than 1e-10; or if the point is
outside. Derivatives of this judge are complex steps. Problems that do not converge are solved by scipy's
SLSQP from the start and from RESTARTS points around it: if no run ends at a feasible point, the problem does
not count as solvable.

With --thin the problems have 2 to 4 unknowns and 1 to 3 quadratic constraints. Their gradients are nearly
opposite at the random point, where inequalities have a slack of 1e-6 to 0.1. The feasible set is then thin,
and violations near it are small although they have no minimum there.

Prints a row for every problem that is wrong or not solved, a table of the runs that did not converge by
SLSQP's result, and a summary. Exit code 0 if nothing is wrong and at least the fraction SOLVED of the
solvable problems converges.

Sample runs (PYTHONPATH: the folder with the module):
  PYTHONPATH=build/release/python tests/campaigns/constrained_minima.py --count 400
  PYTHONPATH=build/release/python tests/campaigns/constrained_minima.py --first 118 --count 1 --curvature absolute
  PYTHONPATH=build/release/python tests/campaigns/constrained_minima.py --thin --count 1000
"""
import argparse
import collections
import sys
import time
import warnings

import numpy as np
import scipy.optimize

import majorant

SOLVED = 0.99
RESTARTS = 10
# Tolerances: of an equality, relative to its gradient; of the Lagrangian's gradient, relative to its largest
# component; of multiplier times slack, relative to the energy.
VIOLATION, STATIONARITY, COMPLEMENTARITY = 1.01e-10, 1e-5, 1e-6
# Lower bound of the scale of the gradient, relative to the energy: at an inner minimum all components vanish.
FLOOR = 1e-3


class RandomProblem:
    """A random problem. energy, equalities, inequalities: functions of points in rows; lower, upper, start,
    feasible: points."""

    def __init__(self, seed):
        r = np.random.default_rng(seed)
        self.size = n = int(r.integers(2, 13))
        self.feasible = x = r.uniform(-1, 1, size=n)
        self.energy = self._energy(r, n)
        self.equalities = [self._equality(r, n, x) for _ in range(int(r.integers(1, min(n, 7))))]
        self.inequalities = [self._inequality(r, n, x) for _ in range(int(r.choice([0, 1, 2], p=[0.35, 0.4, 0.25])))]
        self.lower, self.upper = np.full(n, -np.inf), np.full(n, np.inf)
        if r.random() < 0.5:
            for i in range(n):
                if r.random() < 0.5:
                    self.lower[i] = x[i] - r.uniform(0.05, 1)
                if r.random() < 0.5:
                    self.upper[i] = x[i] + r.uniform(0.05, 1)
        self.start = x + r.normal(size=n) * 10.0 ** r.uniform(-2, 0.7)

    @staticmethod
    def _energy(r, n):
        kind, scale, c = int(r.integers(0, 3)), _scale(r), r.normal(size=n)
        Q = r.normal(size=(n, n))
        Q = Q @ Q.T / n + 0.1 * np.eye(n)
        if kind == 0:
            return lambda z: scale * 0.5 * (((z - c) @ Q) * (z - c)).sum(-1)
        if kind == 1:
            return lambda z: scale * (((z - c) ** 4).sum(-1) + 0.3 * z[..., 0] * z[..., -1])
        return lambda z: scale * ((1 - z[..., :-1]) ** 2 + 5 * (z[..., 1:] - z[..., :-1] ** 2) ** 2).sum(-1)

    @staticmethod
    def _equality(r, n, x):
        kind, scale, w, B = int(r.integers(0, 4)), _scale(r), r.normal(size=n), 0.5 * r.normal(size=(n, n))
        f = [lambda z: (z * z) @ (np.abs(w) + 0.1),
             lambda z: z @ w + ((z @ B) * z).sum(-1),
             lambda z: np.sin(z @ w) + 0.5 * z[..., 0] * z[..., -1],
             lambda z: np.exp(0.5 * (z @ w))][kind]
        value = f(x[None])[0]
        return lambda z: scale * (f(z) - value)

    @staticmethod
    def _inequality(r, n, x):
        w, c = r.normal(size=n), x + r.normal(size=n)
        room = r.uniform(0.05, 1)
        if r.random() < 0.7:   # inside a paraboloid
            return lambda z: (z - x) @ w + room - 0.2 * ((z - x) ** 2).sum(-1)
        radius = max(((x - c) ** 2).sum() - room, 0.01 * ((x - c) ** 2).sum())   # outside a ball
        return lambda z: ((z - c) ** 2).sum(-1) - radius

    def solve(self, **options):
        nodes = np.arange(self.size)[None]
        problem = majorant.Problem(self.size).add(majorant.element_term(nodes, lambda z, e: self.energy(z)))
        for g in self.equalities:
            problem.hold(majorant.Equality(nodes, lambda z, e, g=g: g(z)))
        for h in self.inequalities:
            problem.hold(majorant.Inequality(nodes, lambda z, e, h=h: h(z)))
        if np.isfinite(self.lower).any() or np.isfinite(self.upper).any():
            problem.bound(self.lower, self.upper)
        return problem.minimize(self.start, max_iterations=2000, **options)

    def rooms(self, x):
        """Returns (slacks, their gradients) of inequalities and finite bounds; slacks are positive inside."""
        n = self.size
        slacks, rows = [h(x[None])[0] for h in self.inequalities], [_gradient(h, x) for h in self.inequalities]
        for i in range(n):
            for value, sign in ((x[i] - self.lower[i], 1.0), (self.upper[i] - x[i], -1.0)):
                if np.isfinite(value):
                    slacks.append(value)
                    rows.append(sign * np.eye(n)[i])
        return np.array(slacks), np.array(rows).reshape(len(slacks), n)

    def faults(self, solution):
        """Returns the defects of a point that is claimed to be a minimum."""
        x, l = solution.x, solution.multipliers
        g = np.array([f(x[None])[0] for f in self.equalities])
        G = np.array([_gradient(f, x) for f in self.equalities]).reshape(len(g), self.size)
        slopes = np.maximum(1, np.linalg.norm(G, axis=1))
        found = []
        if not np.isfinite(x).all() or not np.isfinite(l).all():
            return ['not finite']
        if np.max(np.abs(g) / slopes, initial=0) > VIOLATION:
            found.append(f'an equality is violated by {np.max(np.abs(g) / slopes):.1e}')
        slack, H = self.rooms(x)
        if (slack <= 0).any():
            found.append('outside')
        gradient = _gradient(self.energy, x)
        rest = gradient + l @ G
        energy = max(1.0, abs(solution.energy))
        size = max(FLOOR * energy, np.abs(gradient).max(), np.abs(l[:, None] * G).max(initial=0))
        if len(slack):
            # The cost of a multiplier is the sum of its share of the residual and its product with the slack.
            norms = np.linalg.norm(H, axis=1)
            costs = np.diag(slack / norms * STATIONARITY * size / (COMPLEMENTARITY * energy))
            m, _ = scipy.optimize.nnls(np.vstack([(H / norms[:, None]).T, costs]), np.append(rest, 0 * norms))
            m = m / norms
            rest = rest - m @ H
            waste = float(np.max(m * slack)) / energy
            if waste > COMPLEMENTARITY:
                found.append(f'multiplier times slack is {waste:.1e}')
        if np.abs(rest).max() > STATIONARITY * size:
            found.append(f'the gradient of the Lagrangian is {np.abs(rest).max() / size:.1e}')
        return found

    def oracle(self):
        """Returns (the least energy of SLSQP at a feasible point, whether the run from the start ends at
        one), or None if no run ends at one."""
        constraints = [{'type': 'eq', 'fun': lambda z, g=g: g(z[None])[0]} for g in self.equalities]
        constraints += [{'type': 'ineq', 'fun': lambda z, h=h: h(z[None])[0]} for h in self.inequalities]
        r = np.random.default_rng(len(self.equalities))
        spread = np.linalg.norm(self.start - self.feasible)
        best = from_start = None
        for k in range(1 + RESTARTS):
            start = self.start + (k > 0) * spread * r.normal(size=self.size) / np.sqrt(self.size)
            start = np.clip(start, self.lower, self.upper)
            try:
                end = scipy.optimize.minimize(lambda z: self.energy(z[None])[0], start, method='SLSQP',
                                              constraints=constraints, bounds=list(zip(self.lower, self.upper)),
                                              options={'maxiter': 500, 'ftol': 1e-10})
            except ValueError:
                continue
            worst = max((abs(g(end.x[None])[0]) for g in self.equalities), default=0)
            least = min([h(end.x[None])[0] for h in self.inequalities], default=0)
            if not (end.success and worst < 1e-7 and least > -1e-7):
                continue
            if k == 0:
                from_start = True
            if best is None or end.fun < best:
                best = float(end.fun)
        return None if best is None else (best, bool(from_start))


class ThinProblem(RandomProblem):
    def __init__(self, seed):
        r = np.random.default_rng(seed)
        self.size = n = int(r.integers(2, 5))
        self.feasible = x = r.uniform(-1, 1, size=n)
        self.energy = self._energy(r, n)
        self.equalities, self.inequalities = [], []
        self.lower, self.upper = np.full(n, -np.inf), np.full(n, np.inf)
        across = r.normal(size=n)
        for k in range(int(r.integers(1, 4))):
            slope = (-1) ** k * across + 10.0 ** r.uniform(-3, 0) * r.normal(size=n)
            bend = r.normal(size=(n, n)) * 10.0 ** r.uniform(-1, 1)
            if r.random() < 0.3 and len(self.equalities) < n - 1:
                self.equalities.append(self._quadratic(x, slope, bend, 0))
            else:
                self.inequalities.append(self._quadratic(x, slope, bend, 10.0 ** r.uniform(-6, -1)))
        self.start = x + r.normal(size=n) * 10.0 ** r.uniform(-2, 0.7)

    @staticmethod
    def _quadratic(x, slope, bend, room):
        return lambda z: (z - x) @ slope + (((z - x) @ bend) * (z - x)).sum(-1) + room


def _scale(r):
    """Returns 1, or with probability 0.3 a number in [1e-3, 1e3]."""
    return 10.0 ** r.uniform(-3, 3) if r.random() < 0.3 else 1.0


def _gradient(f, x):
    steps = x[None] + 1e-30j * np.eye(len(x))
    return f(steps).imag / 1e-30


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--first', type=int, default=0, help='seed of the first problem')
    parser.add_argument('--count', type=int, default=400)
    parser.add_argument('--curvature', default='projected')
    parser.add_argument('--no-oracle', action='store_true', help='count all problems as solvable')
    parser.add_argument('--thin', action='store_true', help='thin feasible sets')
    options = parser.parse_args()
    warnings.filterwarnings('ignore')
    counts, unsolved, wrong, iterations, saddles = collections.Counter(), 0, 0, 0, 0
    table = collections.Counter()   # (status, result of SLSQP)
    begin = time.process_time()
    for seed in range(options.first, options.first + options.count):
        problem = (ThinProblem if options.thin else RandomProblem)(seed)
        solution = problem.solve(curvature=options.curvature)
        counts[solution.status] += 1
        iterations += len(solution.iterations)
        text = ''
        if solution.status == 'converged':
            saddles += 'saddle' in solution.message
            text = '; '.join(problem.faults(solution))
            wrong += bool(text)
            text = text and f'WRONG: {text} ({solution.message})'
        else:
            found = None if options.no_oracle else problem.oracle()
            solvable = options.no_oracle or found is not None
            unsolved += solvable
            where = 'nowhere' if not found else 'from the start' if found[1] else 'from another start'
            table[solution.status, 'not asked' if options.no_oracle else where] += 1
            text = f'{solution.status}: {solution.message} (E {solution.energy:.6g}'
            text += f', SLSQP {where} {found[0]:.6g})' if found else ', no oracle)' if solvable else ', nor SLSQP)'
        if text:
            kinds = (f'{problem.size} unknowns, {len(problem.equalities)} + {len(problem.inequalities)} + '
                     f'{int(np.isfinite(problem.lower).sum() + np.isfinite(problem.upper).sum())}')
            print(f'{seed}: {kinds}, {len(solution.iterations)} iterations: {text}', flush=True)
    for (status, where), count in sorted(table.items()):
        print(f'{status:>16}, SLSQP feasible {where:<18} {count:5}')
    solvable = counts['converged'] + unsolved
    print(f'{options.count} problems, {solvable} solvable: {counts["converged"]} converged, {wrong} of them wrong, '
          f'{saddles} at a saddle; {dict(counts)}; {iterations} iterations, {time.process_time() - begin:.0f} s')
    return 0 if wrong == 0 and counts['converged'] >= SOLVED * solvable else 1


if __name__ == '__main__':
    sys.exit(main())
