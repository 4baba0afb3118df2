#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Unknowns on manifolds: directions, rotations, phases."""
import helpers
import numpy as np
import pytest

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


def on_sphere():
    return majorant.Problem(7).on_manifold([[0, 1, 2]], 'sphere')


@pytest.mark.parametrize('call, error, message', [
    (lambda: on_sphere().on_manifold([[3, 4]], 'torus'), majorant.UsageError, "kind='torus'"),
    (lambda: on_sphere().on_manifold([[3, 4, 5]], 'rotation'), majorant.UsageError, 'a point of 3 numbers is on no rotation: 4 or 9'),
    (lambda: on_sphere().on_manifold([[3]], 'sphere'), majorant.UsageError, '2 or more are needed'),
    (lambda: on_sphere().on_manifold([[2, 3]], 'unit-complex'), majorant.UsageError, 'unknown 2 lies on two manifolds'),
    (lambda: on_sphere().on_manifold([[6, 7]], 'unit-complex'), majorant.UsageError, '7'),
    (lambda: on_sphere().bound(0), majorant.UsageError, 'a problem has manifolds, or bounds'),
    (lambda: on_sphere().hold(majorant.Equality([[3]], lambda z, e: z[:, 0])), majorant.UsageError, 'a problem has manifolds'),
    (lambda: majorant.Problem(3).bound(0).on_manifold([[0, 1]], 'sphere'), majorant.UsageError, 'a problem has manifolds'),
    (lambda: on_sphere().add(majorant.linear_term(np.ones(7))).minimize(np.ones(7), 'lbfgs'), majorant.UsageError, "for method='newton'"),
    (lambda: on_sphere().add(majorant.linear_term(np.ones(7))).constrain([[1] + [0] * 6], [0]).minimize(np.ones(7)),
     majorant.UnsupportedError, 'holds unknown 0, which lies on a sphere'),
    (lambda: on_sphere().add(majorant.linear_term(np.ones(7))).minimize(np.zeros(7)), majorant.UsageError,
     'has no nearest one on the sphere'),
    (lambda: on_sphere().add(majorant.penalty(np.eye(7), np.ones(7))).minimize(np.ones(7)).forward(), majorant.UnsupportedError,
     'on manifolds have no derivatives'),
])
def test_what_cannot_be(call, error, message):
    with pytest.raises(error) as raised:
        call()
    assert message in str(raised.value)


if __name__ == '__main__':
    helpers.main(__file__)
