#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Derivatives of solutions by the data of their problems, compared with differences of whole solves; covariances."""
import helpers
import numpy as np
import pytest

import majorant

N = 5
NODES = np.arange(N * N).reshape(N, N)
EDGES = np.concatenate([np.stack([NODES[:, :-1], NODES[:, 1:]], -1).reshape(-1, 2),
                        np.stack([NODES[:-1], NODES[1:]], -1).reshape(-1, 2)])
CORNERS = NODES[[0, 0, -1, -1], [0, -1, 0, -1]]
LENGTHS = np.full(len(EDGES), 1.1)
B = np.array([0, 0, 0, N - 1, 0, 0, 0, N - 1, 0, N - 1, N - 1, 0.2])


def stretch(z, e, length):
    d = z[:, 3:] - z[:, :3]
    own = length[e] if length.ndim == 1 else length[:, 0]
    return ((d ** 2).sum(1) / own ** 2 - 1) ** 2


def net(lengths=LENGTHS, b=B, weight=1.5):
    """Returns a hanging net: the problem, its springs, a start."""
    springs = majorant.element_term(EDGES, stretch, block=3, data=lengths, name='springs')
    load = np.zeros(3 * N * N)
    load[2::3] = 0.05
    held = np.zeros((12, 3 * N * N))
    held[np.arange(12), (3 * CORNERS[:, None] + np.arange(3)).ravel()] = 1
    problem = majorant.Problem(3 * N * N).add(springs, weight).add(majorant.linear_term(load)).constrain(held, b)
    y, x = np.divmod(np.arange(N * N), N)
    start = np.stack([x, y, -0.3 * np.sin(3 * x / (N - 1)) * (y + 1) / N], 1).ravel()
    start[(3 * CORNERS[:, None] + np.arange(3)).ravel()] = b
    return problem, springs, start


def solve(**data):
    problem, springs, start = net(**data)
    s = problem.minimize(start, tolerance=1e-13)
    assert s.status == 'converged'
    y = problem.reduce(s.x)
    for _ in range(3):
        y = y - problem.factor(y).solve(problem.gradient(y))
    return s, springs, problem.expand(y)


@pytest.mark.parametrize('lengths', [LENGTHS, LENGTHS[:, None]])
def test_forward_and_adjoint_are_those_of_differences(lengths):
    rng = np.random.default_rng(1)
    db, dw, dl = rng.normal(size=12), 0.7, rng.normal(size=lengths.shape)
    s, springs, _ = solve(lengths=lengths)
    dx = s.forward(b=db, weights={springs: dw}, parameters={springs: dl})

    def at(t):
        return solve(lengths=lengths + t * dl, b=B + t * db, weight=1.5 + t * dw)[2]

    h = 3e-4
    expected = (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h)
    assert np.linalg.norm(dx - expected) < 1e-7 * np.linalg.norm(expected)
    slope = rng.normal(size=len(s.x))
    back = s.adjoint(slope)
    assert back.b.shape == (12,) and back.weights.shape == (2,) and back.parameters[springs].shape == lengths.shape
    product = back.b @ db + back.weights[0] * dw + (back.parameters[springs] * dl).sum()
    assert product == pytest.approx(slope @ dx, rel=1e-8)


def test_the_solution_keeps_the_data_that_it_was_solved_with():
    problem, springs, start = net()
    s = problem.minimize(start)
    before = s.adjoint(np.ones(len(s.x))).b
    problem.update(springs, data=2 * LENGTHS)
    problem.add(majorant.linear_term(np.ones(3 * N * N)))
    assert np.array_equal(s.adjoint(np.ones(len(s.x))).b, before)


def test_named_energies_pins_and_weights():
    V = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0.4], [0, 1, 0], [0.5, 0.5, 0.5]])
    F = np.array([[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
    space = majorant.Space(V, F)
    A = np.zeros((4, space.size))
    A[range(4), range(4)] = 1

    def solved(b, w):
        problem = majorant.Problem(space.size).add(space.energy(), w).add(space.energy('arap'), 0.5).constrain(A, b)
        s = problem.minimize(np.concatenate([b, space.tutte()[4:]]), tolerance=1e-13)
        y = problem.reduce(s.x)
        for _ in range(3):
            y = y - problem.factor(y).solve(problem.gradient(y))
        return s, problem.expand(y)

    b, db, h = space.tutte()[:4], np.array([0.1, 0.2, -0.3, 0.1]), 1e-3
    s, _ = solved(b, 1.0)
    dx = s.forward(b=db)
    expected = (8 * (solved(b + h * db, 1)[1] - solved(b - h * db, 1)[1])
                - (solved(b + 2 * h * db, 1)[1] - solved(b - 2 * h * db, 1)[1])) / (12 * h)
    assert np.linalg.norm(dx - expected) < 1e-7 * np.linalg.norm(expected)
    slope = np.linspace(-1, 1, space.size)
    back = s.adjoint(slope)
    by_weight = (8 * (solved(b, 1 + h)[1] - solved(b, 1 - h)[1])
                 - (solved(b, 1 + 2 * h)[1] - solved(b, 1 - 2 * h)[1])) / (12 * h)
    assert back.weights[0] == pytest.approx(slope @ by_weight, rel=1e-6)
    assert back.b @ db == pytest.approx(slope @ dx, rel=1e-9)


def test_bounds_count_by_the_barrier_that_is_left():
    def solved(target):
        return majorant.Problem(1).add(majorant.penalty([[1.0]], [target])).bound(upper=[1.0]).minimize([0.0])

    held, free = solved(3.0), solved(0.2)
    assert held.x == pytest.approx([1.0], abs=1e-4)
    wide = majorant.element_term([[0]], lambda z, e, t: (z[:, 0] - t[0]) ** 2, data=[0.2])
    s = majorant.Problem(1).add(wide).bound(upper=[1.0]).minimize([0.0])
    assert s.adjoint([1.0]).parameters[wide] == pytest.approx([1.0], abs=1e-3)
    wide = majorant.element_term([[0]], lambda z, e, t: (z[:, 0] - t[0]) ** 2, data=[3.0])
    s = majorant.Problem(1).add(wide).bound(upper=[1.0]).minimize([0.0])
    assert s.adjoint([1.0]).parameters[wide] == pytest.approx([0.0], abs=1e-3)
    assert free.x == pytest.approx([0.2], abs=1e-4)


V4 = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0.4], [0, 1, 0], [0.5, 0.5, 0.5]])
F4 = np.array([[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])


def flattened(V=V4, degree=1):
    """Returns the solution and the space of a pyramid with two held corners."""
    space = majorant.Space(V, F4, degree)
    problem = majorant.Problem(space.size).add(space.energy(), 0.7).add(space.energy('arap'), 0.5)
    problem.constrain(np.eye(4, space.size), [0, 0, 1.1, 0.1])
    start = space.tutte()
    turn = start[2:4] - start[:2]
    a = np.array([[turn[0], turn[1]], [-turn[1], turn[0]]]) / (turn @ turn)
    a = np.array([[1.1, -0.1], [0.1, 1.1]]) @ a
    start = ((start.reshape(-1, 2) - start[:2]) @ a.T).ravel()
    start[:4] = [0, 0, 1.1, 0.1]
    return problem.minimize(start, tolerance=1e-13), space, problem


def test_rest_positions_of_a_space():
    rng = np.random.default_rng(2)
    dV = rng.normal(size=V4.shape)

    def at(t):
        s, _, problem = flattened(V4 + t * dV)
        y = problem.reduce(s.x)
        for _ in range(3):
            y = y - problem.factor(y).solve(problem.gradient(y))
        return problem.expand(y)

    s, space, _ = flattened()
    dx, h = s.forward(rest={space: dV}), 1e-3
    expected = (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h)
    assert np.linalg.norm(dx - expected) < 1e-7 * np.linalg.norm(expected)
    slope = rng.normal(size=len(s.x))
    by_rest = s.adjoint(slope).rest[space]
    assert by_rest.shape == V4.shape
    assert (by_rest * dV).sum() == pytest.approx(slope @ dx, rel=1e-9)


def test_errors_and_biases_are_reported():
    s, _, _ = flattened()
    assert s.derivative_error < 1e-9 and s.barrier_bias == 0
    rough = net()[0].minimize(net()[2], max_iterations=8)
    assert rough.derivative_error < 1e-9          # after exact Newton steps
    wide = majorant.element_term([[0]], lambda z, e, t: (z[:, 0] - t[0]) ** 2, data=[3.0])
    held = majorant.Problem(1).add(wide).bound(upper=[1.0]).minimize([0.0], gap=1e-4)
    assert 1e-7 < held.barrier_bias < 1e-3
    assert held.barrier_bias == pytest.approx(1 - held.x[0], rel=0.1)


SADDLE = majorant.element_term([[0, 1]], lambda z, e: z[:, 0] ** 2 - z[:, 1] ** 2 + z[:, 1] ** 4)
FREE = majorant.element_term([[0, 1]], lambda z, e: (z[:, 1] - z[:, 0] - 1) ** 2)
USAGE, UNSUPPORTED = majorant.UsageError, majorant.UnsupportedError


@pytest.mark.parametrize('call, kind, message', [
    (lambda s, t: s.forward(b=np.ones(3)), USAGE, 'b'),
    (lambda s, t: s.forward(b=[np.nan] * 12), USAGE, 'b'),
    (lambda s, t: s.forward(b='abc'), USAGE, 'b'),
    (lambda s, t: s.forward(b=np.ones((12, 1))), USAGE, 'b'),
    (lambda s, t: s.forward(weights={net()[1]: 1.0}), USAGE, 'no term'),
    (lambda s, t: s.forward(weights={t: np.nan}), USAGE, 'weights'),
    (lambda s, t: s.forward(weights={'springs': 1.0}), USAGE, 'no term'),
    (lambda s, t: s.forward(parameters={t: np.ones(3)}), USAGE, 'parameters'),
    (lambda s, t: s.forward(parameters={t: np.full(len(EDGES), np.inf)}), USAGE, 'parameters'),
    (lambda s, t: s.forward(parameters={majorant.linear_term(np.ones(75)): [1.0]}), USAGE, 'without data'),
    (lambda s, t: s.forward(parameters={net()[1]: LENGTHS}), USAGE, 'no term'),
    (lambda s, t: s.forward(rest={1: V4}), USAGE, 'no Space'),
    (lambda s, t: s.forward(rest={majorant.Space(V4, F4): V4}), USAGE, 'no energy of the problem'),
    (lambda s, t: flattened(degree=2)[0].adjoint(np.ones(26)).rest[1], USAGE, 'no Space'),
    (lambda s, t: (lambda r: r[0].forward(rest={r[1]: V4}))(flattened(degree=2)), UNSUPPORTED, 'degree 2'),
    (lambda s, t: (lambda r: r[0].forward(rest={r[1]: V4[:3]}))(flattened()), USAGE, 'rest'),
    (lambda s, t: (lambda r: r[0].forward(rest={r[1]: np.nan * V4}))(flattened()), USAGE, 'rest'),
    (lambda s, t: s.adjoint(np.ones(3)), USAGE, 'dL_dx'),
    (lambda s, t: s.adjoint(np.ones((75, 1))), USAGE, 'dL_dx'),
    (lambda s, t: s.adjoint(np.full(75, np.nan)), USAGE, 'dL_dx'),
    (lambda s, t: s.adjoint(None), USAGE, 'dL_dx'),
    (lambda s, t: s.covariance([0]), UNSUPPORTED, 'sum of squares'),
    (lambda s, t: s.covariance([10 ** 6]), USAGE, 'indices'),
    (lambda s, t: s.covariance([-1]), USAGE, 'indices'),
    (lambda s, t: s.covariance([0.5]), USAGE, 'indices'),
    (lambda s, t: majorant.Problem(2).add(SADDLE).minimize([1.0, 0.0]).adjoint([1.0, 0.0]), UNSUPPORTED, 'saddle'),
    (lambda s, t: majorant.Problem(2).add(SADDLE).minimize([1.0, 0.0]).derivative_error, UNSUPPORTED, 'saddle'),
    (lambda s, t: majorant.Problem(2).add(FREE).minimize([0.0, 0.0]).forward(), UNSUPPORTED, 'motion'),
    (lambda s, t: majorant.Problem(2).add(FREE).minimize([0.0, 0.0]).barrier_bias, UNSUPPORTED, 'motion'),
    (lambda s, t: s.adjoint(np.ones(75)).parameters[net()[1]], KeyError, ''),
])
def test_wrong_calls(call, kind, message):
    problem, springs, start = net()
    with pytest.raises(kind, match=message):
        call(problem.minimize(start), springs)


def test_solutions_that_are_no_function_of_the_data():
    saddle = majorant.element_term([[0, 1]], lambda z, e: z[:, 0] ** 2 - z[:, 1] ** 2 + z[:, 1] ** 4)
    with pytest.raises(majorant.UnsupportedError, match='saddle'):
        majorant.Problem(2).add(saddle).minimize([1.0, 0.0]).adjoint([1.0, 0.0])
    free = majorant.element_term([[0, 1]], lambda z, e: (z[:, 1] - z[:, 0] - 1) ** 2)
    with pytest.raises(majorant.UnsupportedError):
        majorant.Problem(2).add(free).minimize([0.0, 0.0]).forward()


def test_the_covariance_of_a_fit():
    t = np.linspace(0, 2, 30)
    fit = majorant.least_squares([[0, 1, 2]] * 30,
                                 lambda z, e: z[:, 0] * np.exp(z[:, 1] * t[e]) + z[:, 2] - np.cos(3 * t[e]))
    s = majorant.Problem(3).add(fit, 2.0).minimize([1.0, -1.0, 0.0])
    a, b, _ = s.x
    J = np.stack([np.exp(b * t), a * t * np.exp(b * t), np.ones(30)], 1)
    expected = np.linalg.inv(2 * J.T @ J)
    assert np.allclose(s.covariance([2, 0]), expected[np.ix_([2, 0], [2, 0])], rtol=1e-9)
    poor = majorant.least_squares([[0, 1]], lambda z, e: z[:, 0] + z[:, 1] - 1)
    with pytest.raises(majorant.UnsupportedError, match='singular'):
        majorant.Problem(2).add(poor).minimize([0.0, 0.0]).covariance([0])


if __name__ == '__main__':
    helpers.main(__file__)
