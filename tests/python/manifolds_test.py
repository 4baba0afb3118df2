#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Unknowns on manifolds: directions, rotations, phases; what holds them, and derivatives of such solutions."""
import helpers
import numpy as np
import pytest
import scipy.optimize

import majorant

RNG = np.random.default_rng(11)


def eigenproblem(n):
    A = RNG.normal(size=(n, n))
    return A + A.T


def test_a_direction_is_an_eigenvector():
    A = eigenproblem(5)
    form = majorant.element_term([[0, 1, 2, 3, 4]], lambda z, e: sum(A[i, j] * z[:, i] * z[:, j]
                                                                   for i in range(5) for j in range(5)))
    seen = []
    problem = majorant.Problem(5).add(form).on_manifold([[0, 1, 2, 3, 4]], 'sphere')
    solution = problem.minimize(RNG.normal(size=5), callback=lambda record, x: seen.append(np.linalg.norm(x)) or False)
    values, vectors = np.linalg.eigh(A)
    assert solution.status == 'converged' and solution.definite == 'yes'
    assert solution.energy == pytest.approx(values[0], abs=1e-12)
    assert abs(solution.x @ vectors[:, 0]) == pytest.approx(1, abs=1e-10)
    assert np.allclose(seen, 1, atol=1e-14) and len(seen) == len(solution.iterations)


def rotation(axis, angle):
    K = np.cross(np.eye(3), axis / np.linalg.norm(axis))
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K


@pytest.mark.parametrize('size', [4, 9])
def test_rotations_fit_directions(size):
    """Wahba's problem, whose solution is a singular value decomposition."""
    a, R = RNG.normal(size=(20, 3)), rotation(np.array([1.0, 2, -1]), 2.5)
    b = a @ R.T + 0.05 * RNG.normal(size=(20, 3))

    def of_matrix(z, e):
        return np.stack([sum(z[:, 3 * i + k] * a[e, k] for k in range(3)) - b[e, i] for i in range(3)], 1)

    def of_quaternion(z, e):
        w, x, y, s = (z[:, k] for k in range(4))
        M = [[1 - 2 * (y * y + s * s), 2 * (x * y - s * w), 2 * (x * s + y * w)],
             [2 * (x * y + s * w), 1 - 2 * (x * x + s * s), 2 * (y * s - x * w)],
             [2 * (x * s - y * w), 2 * (y * s + x * w), 1 - 2 * (x * x + y * y)]]
        return np.stack([sum(M[i][k] * a[e, k] for k in range(3)) - b[e, i] for i in range(3)], 1)

    fit = majorant.least_squares(np.tile(np.arange(size), (20, 1)), of_matrix if size == 9 else of_quaternion)
    problem = majorant.Problem(size).add(fit).on_manifold([list(range(size))], 'rotation')
    start = np.eye(3).ravel() if size == 9 else [0.2, 0.5, 0.7, -0.4]
    solution = problem.minimize(start)
    U, _, Vt = np.linalg.svd(b.T @ a)
    best = U @ np.diag([1, 1, np.linalg.det(U @ Vt)]) @ Vt
    assert solution.status == 'converged'
    assert solution.energy == pytest.approx(0.5 * ((a @ best.T - b) ** 2).sum(), rel=1e-10)
    if size == 9:
        found = solution.x.reshape(3, 3)
        assert np.allclose(found, best, atol=1e-6) and np.allclose(found @ found.T, np.eye(3), atol=1e-14)
    else:
        assert np.linalg.norm(solution.x) == pytest.approx(1, abs=1e-15)


def test_phases_beside_free_unknowns_and_constraints():
    # Points on the unit circle are connected to points on a line.
    n = 6
    tie = majorant.least_squares([[k, n + k] for k in range(n)], lambda z, e: z[:, :2] - z[:, 2:], block=2)
    A = np.zeros((n, 4 * n))
    A[np.arange(n), 2 * n + 2 * np.arange(n) + 1] = 1
    problem = majorant.Problem(4 * n).add(tie).constrain(A, np.full(n, 2.0))
    problem.on_manifold(np.arange(n), 'unit-complex', block=2)
    start = RNG.normal(size=4 * n)
    start[2 * n + 1::2] = 2
    solution = problem.minimize(start)
    circle, line = solution.x[:2 * n].reshape(n, 2), solution.x[2 * n:].reshape(n, 2)
    assert solution.status == 'converged'
    assert np.allclose(circle, [0, 1], atol=1e-6) and np.allclose(line, [0, 2], atol=1e-6)


def test_data_change_on_manifolds():
    pull = majorant.element_term([[0, 1, 2]], lambda z, e, to: ((z - to) ** 2).sum(1), data=[[1.0, 0, 0]])
    problem = majorant.Problem(3).add(pull).on_manifold([[0, 1, 2]], 'sphere')
    for to in ([[1.0, 0, 0]], [[0, 2.0, 1]]):
        x = problem.update(pull, data=to).minimize([0.5, 0.5, 0]).x
        assert np.allclose(x, np.array(to[0]) / np.linalg.norm(to), atol=1e-6)


RODS = np.array([1.0, 1.3, 0.8, 1.1])
AIM = np.array([1.2, 0.9, -0.4, -1.1])   # the angles that rods would have


def angles_of(x):
    return np.arctan2(x[1::2], x[0::2])


def closed(angles):
    """Both coordinates of the end of the chain."""
    return np.array([RODS @ np.cos(angles), RODS @ np.sin(angles)]) - [1.5, 0.5]


def linkage():
    """Rods as unit complex numbers; the chain of them ends at (1.5, 0.5)."""
    aim = np.stack([np.cos(AIM), np.sin(AIM)], 1).ravel()
    near = majorant.element_term([[k] for k in range(8)], lambda z, e: (z[:, 0] - aim[e]) ** 2)
    chain = majorant.Equality([[0, 2, 4, 6], [1, 3, 5, 7]], lambda z, e: z @ RODS - np.array([1.5, 0.5])[e])
    return majorant.Problem(8).add(near).on_manifold(np.arange(4), 'unit-complex', block=2), chain


def best_of_slsqp(start, more=()):
    """The same in angles: |p - q|^2 of unit complex numbers is 2 - 2 cos of the angle between."""
    return scipy.optimize.minimize(lambda a: (2 - 2 * np.cos(a - AIM)).sum(), start, method='SLSQP',
                                   constraints=[{'type': 'eq', 'fun': closed}, *more], options={'ftol': 1e-14, 'maxiter': 500})


@pytest.mark.parametrize('seed', range(5))
def test_a_linkage_closes(seed):
    start = AIM + np.random.default_rng(seed).normal(size=4)
    problem, chain = linkage()
    seen = []
    solution = problem.hold(chain).minimize(np.stack([np.cos(start), np.sin(start)], 1).ravel(),
                                            callback=lambda record, x: seen.append(x) or False)
    assert solution.status == 'converged' and solution.definite == 'yes'
    x = solution.x
    assert np.allclose(np.hypot(x[0::2], x[1::2]), 1, atol=1e-15) and np.abs(closed(angles_of(x))).max() < 1e-10
    assert len(seen[-1]) == 8 and np.allclose(np.linalg.norm(seen[-1].reshape(4, 2), axis=1), 1, atol=1e-14)
    # A minimum of SLSQP is here; the multipliers make the slope of the Lagrangian by the angles vanish.
    end = best_of_slsqp(angles_of(x))
    assert end.success and np.allclose(np.exp(1j * end.x), x[0::2] + 1j * x[1::2], atol=1e-5)
    assert solution.energy == pytest.approx(end.fun, abs=1e-9)
    a, l = angles_of(x), solution.multipliers
    slope = 2 * np.sin(a - AIM) + RODS * (l[1] * np.cos(a) - l[0] * np.sin(a))
    assert len(l) == 2 and np.abs(slope).max() < 1e-8


def test_a_linkage_with_a_limit():
    problem, chain = linkage()
    # The second joint stays below a height, which the free minimum is above of.
    height = 0.9
    problem.hold(chain).hold(majorant.Inequality([[1, 3]], lambda z, e: height - z @ RODS[:2]))
    start = np.array([0.1, 0.2, -0.1, 0.3])
    solution = problem.minimize(np.stack([np.cos(start), np.sin(start)], 1).ravel())
    assert solution.status == 'converged'
    a = angles_of(solution.x)
    end = best_of_slsqp(a, [{'type': 'ineq', 'fun': lambda b: height - RODS[:2] @ np.sin(b[:2])}])
    assert end.success and solution.energy == pytest.approx(end.fun, abs=1e-7)
    assert RODS[:2] @ np.sin(a[:2]) == pytest.approx(height, abs=1e-6) and np.abs(closed(a)).max() < 1e-10


def test_bounds_and_maps_beside_manifolds():
    # The nearest points of a sphere and of a box; 0 is outside of the box.
    apart = majorant.element_term([[0, 1]], lambda z, e: ((z[:, :3] - z[:, 3:]) ** 2).sum(1), block=3)
    problem = majorant.Problem(6).add(apart).on_manifold([0], 'sphere', block=3)
    lower = [-np.inf] * 3 + [1, 2, -1]
    solution = problem.bound(lower, [np.inf] * 3 + [3, 4, 1]).minimize([0, 0, 1, 0, 0, 0.5])
    assert solution.status == 'converged' and solution.energy == pytest.approx((np.sqrt(5) - 1) ** 2, abs=1e-7)
    assert np.allclose(solution.x, [1 / np.sqrt(5), 2 / np.sqrt(5), 0, 1, 2, 0], atol=1e-6)
    assert solution.phases and (solution.x > lower).all()
    # A map whose last unknowns are a phase that turns it.
    V, F = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]]), np.array([[0, 1, 2], [0, 2, 3]])
    space = majorant.Space(V, F)
    turned = majorant.element_term([[2, 3, 8, 9]], lambda z, e: (z[:, 0] - z[:, 2]) ** 2 + (z[:, 1] - z[:, 3]) ** 2)
    problem = majorant.Problem(10).add(space.energy('symmetric-dirichlet')).add(turned, 10).keep_injective(space)
    problem.constrain(np.eye(10)[:2], [0, 0]).on_manifold([[8, 9]], 'unit-complex')
    solution = problem.minimize([*V[:, :2].ravel(), 0.6, 0.8])
    assert solution.status == 'converged' and solution.energy == pytest.approx(4, abs=1e-5)
    assert np.allclose(solution.x[2:4], solution.x[8:], atol=1e-3)


def test_derivatives_of_solutions_on_manifolds():
    def solve(weight, to, b):
        pull = majorant.element_term([[0, 1, 2]], lambda z, e, p: ((z - p) ** 2).sum(1), data=[to])
        slope = majorant.linear_term([1, 0.5, 0.2, 0.3])
        leans = majorant.Equality([[0, 1, 3]], lambda z, e: z[:, 0] * z[:, 1] + 0.5 * z[:, 2] - 0.2)
        problem = majorant.Problem(4).add(pull).add(slope, weight).hold(leans).constrain([[0, 0, 0, 1]], [b])
        return problem.on_manifold([[0, 1, 2]], 'sphere').minimize([0.2, 0.5, -0.8, b]), pull, slope

    to, dto, h = np.array([0.3, -0.4, 0.7]), np.array([1.0, 2, -1]), 1e-4
    solution, pull, slope = solve(0.4, to, 0.1)
    dL = RNG.normal(size=4)
    d = solution.adjoint(dL)
    for dx, up, down, by_adjoint in (
            (solution.forward(b=[1.0]), solve(0.4, to, 0.1 + h), solve(0.4, to, 0.1 - h), d.b[0]),
            (solution.forward(weights={slope: 1.0}), solve(0.4 + h, to, 0.1), solve(0.4 - h, to, 0.1), d.weights[1]),
            (solution.forward(parameters={pull: [dto]}), solve(0.4, to + h * dto, 0.1), solve(0.4, to - h * dto, 0.1),
             (d.parameters[pull] * dto).sum())):
        expected = (up[0].x - down[0].x) / (2 * h)
        assert np.linalg.norm(expected) > 1e-2 and np.allclose(dx, expected, atol=1e-5 * np.linalg.norm(expected))
        assert by_adjoint == pytest.approx(dL @ dx, abs=1e-8)
        assert abs(dx[:3] @ solution.x[:3]) < 1e-12
    # Without anything that is held.
    free = majorant.element_term([[0, 1, 2]], lambda z, e, p: ((z - p) ** 2).sum(1), data=[to])
    x = majorant.Problem(3).add(free).on_manifold([[0, 1, 2]], 'sphere').minimize([1, 0, 0])
    n = to / np.linalg.norm(to)
    assert np.allclose(x.forward(parameters={free: [dto]}), (dto - n * (n @ dto)) / np.linalg.norm(to), atol=1e-7)


def on_sphere():
    return majorant.Problem(7).on_manifold([[0, 1, 2]], 'sphere')


@pytest.mark.parametrize('call, error, message', [
    (lambda: on_sphere().on_manifold([[3, 4]], 'torus'), majorant.UsageError, "kind='torus'"),
    (lambda: on_sphere().on_manifold([[3, 4, 5]], 'rotation'), majorant.UsageError, 'a point of 3 numbers is on no rotation: 4 or 9'),
    (lambda: on_sphere().on_manifold([[3]], 'sphere'), majorant.UsageError, '2 or more are needed'),
    (lambda: on_sphere().on_manifold([[2, 3]], 'unit-complex'), majorant.UsageError, 'unknown 2 lies on two manifolds'),
    (lambda: on_sphere().on_manifold([[6, 7]], 'unit-complex'), majorant.UsageError, '7'),
    (lambda: majorant.compare(on_sphere().add(majorant.linear_term(np.ones(7))).bound(0), np.ones(7)),
     majorant.UnsupportedError, 'compare: bounds, inequalities, equalities and checkers beside unknowns on manifolds'),
    (lambda: on_sphere().add(majorant.linear_term(np.ones(7))).minimize(np.ones(7), 'lbfgs'), majorant.UsageError, "for method='newton'"),
    (lambda: on_sphere().add(majorant.linear_term(np.ones(7))).constrain([[1] + [0] * 6], [0]).minimize(np.ones(7)),
     majorant.UnsupportedError, 'holds unknown 0, which lies on a sphere'),
    (lambda: on_sphere().add(majorant.linear_term(np.ones(7))).minimize(np.zeros(7)), majorant.UsageError,
     'has no nearest one on the sphere'),
    (lambda: on_sphere().add(majorant.penalty(np.eye(7), np.ones(7))).minimize(np.ones(7)).covariance([3]),
     majorant.UnsupportedError, 'on manifolds have no covariance'),
])
def test_invalid_calls_are_refused(call, error, message):
    with pytest.raises(error) as raised:
        call()
    assert message in str(raised.value)


if __name__ == '__main__':
    helpers.main(__file__)
