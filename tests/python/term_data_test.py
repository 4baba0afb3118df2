#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Data of terms that change between solves, matrices and factors of problems, choices of curvature."""
import helpers
import numpy as np
import pytest

import majorant

COUNT = 200
PAIRS = np.stack([np.arange(COUNT), np.arange(1, COUNT + 1)], axis=1)
LENGTHS = np.linspace(0.5, 1.5, COUNT)


def chain(data, value=None):
    """Returns springs in a row whose lengths are data: a vector that is passed whole, or one row each."""
    whole = np.ndim(data) == 1
    default = lambda z, e, l: (z[:, 1] - z[:, 0] - (l[e] if whole else l[:, 0])) ** 2  # noqa: E731
    return majorant.element_term(PAIRS, value or default, data=data, name='chain')


def held(term, weight=10.0):
    problem = majorant.Problem(COUNT + 1).add(term, weight)
    first = np.zeros((1, COUNT + 1))
    first[0, 0] = 1
    return problem.constrain(first, [0])


@pytest.mark.parametrize('data', [LENGTHS, LENGTHS[:, None]])
def test_data_change_without_another_analysis(data):
    term = chain(data)
    problem = held(term)
    assert problem.minimize(np.zeros(COUNT + 1)).x[-1] == pytest.approx(LENGTHS.sum())
    problem.update(term, data=2 * data)
    s = problem.minimize(np.zeros(COUNT + 1))
    assert s.x[-1] == pytest.approx(2 * LENGTHS.sum())
    problem.add(majorant.linear_term(np.zeros(COUNT + 1)))   # the problem is built again, with the present data
    assert problem.minimize(np.zeros(COUNT + 1)).x[-1] == pytest.approx(2 * LENGTHS.sum())
    x = np.random.default_rng(0).normal(size=COUNT + 1)
    term.check_derivatives(x)
    assert term.derivatives == 'dual numbers'


def test_weights_change_alone():
    term = chain(LENGTHS)
    problem = held(term)
    y = np.ones(problem.size)
    before = problem.value(y)
    problem.update(term, weight=20)
    assert problem.value(y) == pytest.approx(2 * before)
    problem.update(term, data=LENGTHS + 1, weight=10)
    assert problem.value(y) != pytest.approx(before)
    problem.update(term, data=LENGTHS)
    assert problem.value(y) == pytest.approx(before)


def test_data_of_residuals():
    t = np.linspace(0, 1, 9)
    samples = np.stack([t, 2 * np.exp(-t)], axis=1)

    def residuals(z, e, s):
        return z[:, 0] * np.exp(z[:, 1] * s[:, 0]) - s[:, 1]

    term = majorant.least_squares([[0, 1]] * len(t), residuals, data=samples)
    problem = majorant.Problem(2).add(term)
    assert problem.minimize([1.0, 0.0]).x == pytest.approx([2, -1], abs=1e-6)
    problem.update(term, data=samples * [1, 3])
    assert problem.minimize([1.0, 0.0]).x == pytest.approx([6, -1], abs=1e-6)
    term.check_derivatives([0.5, 0.3])


@pytest.mark.parametrize('call, message', [
    (lambda p, t: p.update(t, data=np.ones(3)), 'data'),
    (lambda p, t: p.update(t, data=[np.nan] * COUNT), 'data'),
    (lambda p, t: p.update(chain(LENGTHS), weight=2), 'was not added'),
    (lambda p, t: p.update(t, weight=-1), 'weight'),
    (lambda p, t: p.update('chain', weight=1), 'no Term'),
    (lambda p, t: chain(np.ones((3, 2))), 'data'),
    (lambda p, t: chain(np.empty(0)), 'data'),
    (lambda p, t: p.add(free := majorant.linear_term(np.zeros(COUNT + 1))).update(free, data=[1.0]), 'without data'),
    (lambda p, t: p.factor(np.zeros(3)), 'y'),
    (lambda p, t: p.factor(np.zeros(COUNT)).solve(np.ones(3)), 'b'),
    (lambda p, t: p.gradient(np.zeros(COUNT), term=chain(LENGTHS)), 'was not added'),
    (lambda p, t: p.hessian(np.zeros(COUNT), 'adaptive'), 'curvature'),
    (lambda p, t: p.minimize(np.zeros(COUNT + 1), 'lbfgs', curvature='adaptive'), 'curvature'),
    (lambda p, t: p.minimize(np.zeros(COUNT + 1), 'lbfgs', saddles_to_leave=1), 'saddles_to_leave'),
])
def test_wrong_calls(call, message):
    term = chain(LENGTHS)
    problem = held(term)
    value = problem.value(np.ones(problem.size))
    with pytest.raises(majorant.UsageError, match=message):
        call(problem, term)
    assert problem.value(np.ones(problem.size)) == value


def test_the_hessian_its_factor_and_gradients_of_terms():
    term = chain(LENGTHS)
    wells = majorant.element_term(np.arange(1, COUNT + 1)[:, None], lambda z, e: z[:, 0] ** 4 - z[:, 0] ** 2)
    problem = held(term).add(wells, 0.5)
    y = np.random.default_rng(1).uniform(0.6, 2, problem.size)
    H = problem.hessian(y)
    b = np.random.default_rng(2).normal(size=(problem.size, 3))
    factor = problem.factor(y)
    assert np.abs(H @ factor.solve(b) - b).max() < 1e-9
    assert np.abs(H @ factor.solve(b[:, 0]) - b[:, 0]).max() < 1e-9
    parts = problem.gradient(y, term=term) + problem.gradient(y, term=wells)
    assert np.allclose(parts, problem.gradient(y), rtol=0, atol=1e-12 * np.abs(parts).max())
    away = np.full(problem.size, 0.05)
    with pytest.raises(majorant.UnsupportedError, match='not positive definite'):
        majorant.Problem(COUNT + 1).add(wells).factor(np.full(COUNT + 1, 0.05))
    exact, clamped, absolute = (problem.hessian(away, c).toarray() for c in ('exact', 'projected', 'absolute'))
    assert np.allclose(absolute, 2 * clamped - exact)


def test_residuals_and_their_jacobian():
    t = np.linspace(0, 1, 7)
    term = majorant.least_squares([[0, 1]] * 7, lambda z, e: z[:, 0] * np.exp(z[:, 1] * t[e]) - 1)
    problem = majorant.Problem(3).add(term, 4.0).constrain([[0, 1, -2.0]], [0])
    y = np.array([0.3, 0.7])
    r, J = problem.residuals(y, term)
    assert J.shape == (7, 2) and np.allclose(J.T @ r, problem.gradient(y), rtol=1e-12)
    assert problem.value(y) == pytest.approx(r @ r / 2)
    with pytest.raises(majorant.UnsupportedError, match='sum of squares'):
        other = majorant.element_term([[0]], lambda z, e: z[:, 0] ** 2)
        majorant.Problem(1).add(other).residuals([1.0], other)


def test_the_choice_of_curvature_and_saddles():
    saddle = majorant.element_term([[0, 1]], lambda z, e: z[:, 0] ** 2 - z[:, 1] ** 2 + z[:, 1] ** 4)
    problem = majorant.Problem(2).add(saddle)
    stays = problem.minimize([1.0, 0.0])
    assert stays.definite == 'no' and 'saddle' in stays.message
    leaves = problem.minimize([1.0, 0.0], saddles_to_leave=1)
    assert leaves.definite == 'yes' and leaves.energy == pytest.approx(-0.25)
    for curvature in ('projected', 'absolute', 'adaptive'):
        s = problem.minimize([1.0, 0.3], curvature=curvature)
        assert s.status == 'converged' and s.energy == pytest.approx(-0.25)
        assert s.iterations[0]['projection_weight'] == (1 if curvature == 'projected' else 2)
        assert {row['limit'] for row in s.iterations} <= {'none', 'energy', 'domain', 'checker'}


if __name__ == '__main__':
    helpers.main(__file__)
