#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Terms, equalities and inequalities whose elements have different numbers of nodes."""
import helpers
import numpy as np
import pytest

import majorant

RNG = np.random.default_rng(7)
SIZES = [3, 5, 3, 12, 4, 5, 1, 3]
COUNT = 20
LISTS = [RNG.permutation(COUNT)[:n].tolist() for n in SIZES]
X = RNG.normal(size=3 * COUNT)
WEIGHTS = np.linspace(1, 2, len(LISTS))


def spread(z, e):
    """Returns the spread of corners around their centre, which is not quadratic and differs by element."""
    p = z.reshape(len(z), -1, 3)
    r = p - p.mean(1, keepdims=True)
    return WEIGHTS[e] * np.sqrt(1 + (r ** 2).sum((1, 2))) + e


def parts(f=spread, **options):
    """Returns the problem with one term for each size."""
    terms = []
    for n in sorted(set(SIZES)):
        members = np.array([e for e, nodes in enumerate(LISTS) if len(nodes) == n])
        terms.append(majorant.element_term([LISTS[e] for e in members], lambda z, e, m=members: f(z, m[e]), block=3,
                                           **options))
    return terms


def problem(*terms):
    p = majorant.Problem(3 * COUNT)
    for term in terms:
        p.add(term, 0.5)
    return p


def test_one_term_is_the_sum_of_terms_of_one_size():
    whole, sum_of_parts = problem(majorant.element_term(LISTS, spread, block=3)), problem(*parts())
    assert whole.value(X) == pytest.approx(sum_of_parts.value(X), rel=1e-14)
    assert np.allclose(whole.gradient(X), sum_of_parts.gradient(X), rtol=1e-13)
    for curvature in ('exact', 'projected'):
        assert abs(whole.hessian(X, curvature) - sum_of_parts.hessian(X, curvature)).max() < 1e-13


def test_functions_see_elements_of_one_size_at_a_time():
    seen = []

    def value(z, e):
        seen.append((z.shape[1], sorted(e.tolist())))
        return (z ** 2).sum(1)

    majorant.Problem(3 * COUNT).add(majorant.element_term(LISTS, value, block=3)).value(X)
    assert sorted(seen) == sorted((3 * n, [e for e, s in enumerate(SIZES) if s == n]) for n in set(SIZES))


def test_all_elements_come_in_one_call():
    calls = []
    edges = np.stack([np.arange(5000), np.arange(1, 5001)], axis=1)
    term = majorant.element_term(edges, lambda z, e: calls.append(len(z)) or (z[:, 1] - z[:, 0] - 1) ** 2)
    majorant.Problem(5001).add(term).value(np.zeros(5001))
    assert calls == [5000]


def test_derivatives_are_checked_by_size_and_named_by_element():
    term = majorant.element_term(LISTS, spread, block=3)
    term.check_derivatives(X)
    assert term.derivatives == 'dual numbers'

    def of_its_size(z, e):
        assert all(z.shape[1] == 3 * SIZES[k] for k in e)
        return (z ** 2).sum(1)

    majorant.element_term(LISTS, of_its_size, block=3).check_derivatives(X)

    def wrong(z, e):
        g = 2 * z
        g[e == 3] += 1
        return g, np.broadcast_to(2 * np.eye(z.shape[1]), (*z.shape, z.shape[1]))

    with pytest.raises(AssertionError, match='at element 3 is'):
        majorant.element_term(LISTS, lambda z, e: (z ** 2).sum(1), wrong, block=3).check_derivatives(X)


@pytest.mark.parametrize('derivatives', [None, lambda z, e, d: (2 * d * z, 2 * d[:, :, None] * np.eye(z.shape[1]))])
def test_rows_of_data_belong_to_elements(derivatives):
    data = RNG.uniform(1, 2, size=(len(LISTS), 1))
    term = majorant.element_term(LISTS, lambda z, e, d: d[:, 0] * (z ** 2).sum(1), derivatives, block=3, data=data)
    expected = sum(d * (X.reshape(-1, 3)[nodes] ** 2).sum() for d, nodes in zip(data[:, 0], LISTS))
    p = majorant.Problem(3 * COUNT).add(term)
    assert p.value(X) == pytest.approx(expected)
    assert p.gradient(X) @ X == pytest.approx(2 * expected)
    term.check_derivatives(X)
    p.update(term, data=3 * data)
    assert p.value(X) == pytest.approx(3 * expected)


def test_residuals_of_elements_of_any_size():
    lists = [[0, 1], [0, 1, 2], [2]]
    term = majorant.least_squares(lists, lambda z, e: z - 1 - e[:, None], loss='huber', width=0.1)
    x = np.array([0.3, 0.9, 2.0])
    p = majorant.Problem(3).add(term)
    r, J = p.residuals(x, term)
    numbers = [k + 1.0 for k, nodes in enumerate(lists) for _ in nodes]
    assert np.allclose(r, np.concatenate([x[n] for n in lists]) - numbers)
    assert np.allclose(J.toarray(), np.eye(3)[np.concatenate(lists)])
    assert majorant.Problem(3).add(majorant.least_squares(lists, lambda z, e: z - 1 - e[:, None])).minimize(x).x == \
        pytest.approx([1.5, 1.5, 2.5])


def planar(z, e):
    """Returns the volume of corners 0, 1, 2 and 3, repeated for each corner beyond the third one."""
    p = z.reshape(len(z), -1, 3)
    a, b = p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]
    n = np.stack([a[:, 1] * b[:, 2] - a[:, 2] * b[:, 1], a[:, 2] * b[:, 0] - a[:, 0] * b[:, 2],
                  a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]], 1)
    n = n / np.sqrt((n ** 2).sum(1, keepdims=True))
    return sum((n * (p[:, k] - p[:, 0])).sum(1) for k in range(3, p.shape[1]))


def test_equalities_have_a_multiplier_an_element():
    faces = [[0, 1, 2, 3], [3, 2, 4, 5, 6], [6, 5, 7, 8]]
    x0 = RNG.normal(size=27)
    stay = majorant.penalty(np.eye(27), x0)

    def of_its_size(z, e):
        assert all(z.shape[1] == 3 * len(faces[k]) for k in e)
        return planar(z, e)

    condition = majorant.Equality(faces, of_its_size, block=3)
    solution = majorant.Problem(27).add(stay).hold(condition).minimize(x0)
    assert solution.status == 'converged' and len(solution.multipliers) == 3
    alone = [majorant.Equality([f], planar, block=3) for f in faces]
    for e, (face, one) in enumerate(zip(faces, alone)):
        assert abs(planar(solution.x.reshape(-1, 3)[face].reshape(1, -1), e)[0]) < 1e-9
    p = majorant.Problem(27).add(stay)
    for one in alone:
        p.hold(one)
    other = p.minimize(x0)
    assert np.allclose(solution.x, other.x, atol=1e-7)
    assert np.allclose(solution.multipliers, other.multipliers, atol=1e-6)


def test_inequalities():
    lists = [[0], [0, 1], [1, 2, 3]]
    held = majorant.Inequality(lists, lambda z, e: (z + 1).sum(1) - z.shape[1] - 1 - e)
    p = majorant.Problem(4).add(majorant.penalty(np.eye(4), np.zeros(4)), 0.5).hold(held)
    x = p.minimize(np.zeros(4)).x
    assert min(x[n].sum() - 1 - e for e, n in enumerate(lists)) >= 0
    assert x == pytest.approx([1, 1, 1, 1], abs=1e-3)


def test_solutions_by_data():
    lists = [[0, 1], [1], [0, 1, 2]]
    data = np.array([[1.0], [2], [6]])
    term = majorant.element_term(lists, lambda z, e, d: (z.sum(1) - d[:, 0]) ** 2, data=data)
    solution = majorant.Problem(3).add(term).minimize(np.zeros(3))
    assert solution.x == pytest.approx([-1, 2, 5])
    by_data = np.stack([solution.adjoint(row).parameters[term][:, 0] for row in np.eye(3)])
    assert np.allclose(by_data, np.linalg.inv([[1, 1, 0], [0, 1, 0], [1, 1, 1]]), atol=1e-8)


def test_on_manifolds():
    lists = [[0, 1], [1], [0, 1, 2], [2, 3, 0, 1]]
    term = majorant.element_term(lists, lambda z, e: ((z.reshape(len(z), -1, 3).sum(1) - [3.0, 1, 2]) ** 2).sum(1), block=3)
    p = majorant.Problem(12).add(term).on_manifold(np.arange(4), 'sphere', block=3)
    solution = p.minimize(RNG.normal(size=12))
    assert solution.status == 'converged'
    assert np.allclose(solution.x.reshape(4, 3), np.array([3, 1, 2]) / np.sqrt(14), atol=1e-6)


def test_large_elements():
    n = 120
    term = majorant.element_term([list(range(n)), [0, 1]], lambda z, e: (z ** 2).sum(1) * (1 + z[:, 0] ** 2))
    x = RNG.normal(size=n)
    H = majorant.Problem(n).add(term).hessian(x).toarray()
    s = (x ** 2).sum()
    expected = 2 * (1 + x[0] ** 2) * np.eye(n)
    expected[0] += 4 * x[0] * x
    expected[:, 0] += 4 * x[0] * x
    expected[0, 0] += 2 * s
    small = x[:2]
    expected[:2, :2] += 2 * (1 + x[0] ** 2) * np.eye(2)
    expected[0, :2] += 4 * x[0] * small
    expected[:2, 0] += 4 * x[0] * small
    expected[0, 0] += 2 * (small ** 2).sum()
    assert np.allclose(H, expected)


@pytest.mark.parametrize('nodes, message', [
    ([[0, 1], []], 'nodes[1] is empty'),
    ([[0, 1], [2, -1, 0]], 'nodes[1][1] is -1'),
    ([[0, 1], [0.5, 1, 2]], 'nodes[1] holds floating-point numbers, not integers'),
    ([[0, 1], [[0, 1]] * 3], 'nodes[1] has shape (3, 2)'),
    ([[0, 1], 'abc'], 'nodes'),
    ([[0], [0, None]], 'nodes[1] holds Python objects'),
    ([list(range(2000)), [0]], 'an element has 1024 unknowns at most'),
    ([list(range(1000))] + [[0]] * 5000, 'make large elements a term of their own'),
])
def test_wrong_lists(nodes, message):
    with pytest.raises(majorant.UsageError) as raised:
        majorant.element_term(nodes, spread)
    assert message in str(raised.value)


def test_nodes_that_the_problem_does_not_have_are_named():
    with pytest.raises(majorant.UsageError, match='node 2 of element 1 is 9'):
        majorant.Problem(9).add(majorant.element_term([[0], [1, 2, 9]], spread))


if __name__ == '__main__':
    helpers.main(__file__)
