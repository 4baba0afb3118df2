#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Problems made in Python: terms, constraints, solvers, user energies."""
import json
import threading

import helpers
import numpy as np
import pytest
import scipy.linalg
import scipy.sparse

import majorant

V, F = helpers.grid(6)


def invariants(J):
    """Returns det J, the cofactor of J, and J, as rows."""
    cofactor = np.stack([J[:, 1, 1], -J[:, 1, 0], -J[:, 0, 1], J[:, 0, 0]], axis=1)
    return J[:, 0, 0] * J[:, 1, 1] - J[:, 0, 1] * J[:, 1, 0], cofactor, J.reshape(-1, 4)


# The Hessian of det J by the entries of J.
SKEW = np.array([[0, 0, 0, 1], [0, 0, -1, 0], [0, -1, 0, 0], [1, 0, 0, 0]], float)


def dirichlet(J):
    det, _, flat = invariants(J)
    return (flat ** 2).sum(1) * (1 + 1 / det ** 2)


def dirichlet_derivatives(J):
    det, c, j = invariants(J)
    n = (j ** 2).sum(1)
    a, b = 1 + det ** -2., -2 * n / det ** 3
    gradient = 2 * a[:, None] * j + b[:, None] * c
    outer = lambda x, y: x[:, :, None] * y[:, None, :]  # noqa: E731
    hessian = (2 * a[:, None, None] * np.eye(4) + (-4 / det ** 3)[:, None, None] * (outer(j, c) + outer(c, j))
               + (6 * n / det ** 4)[:, None, None] * outer(c, c) + b[:, None, None] * SKEW)
    return gradient, hessian


OURS = majorant.Density('symmetric-dirichlet in numpy', dirichlet, dirichlet_derivatives, barrier='strong')


def problem_of(energy, degree=2, **options):
    space = majorant.Space(V, F, degree)
    problem = majorant.Problem(space.size)
    problem.add(space.energy(energy, **options), 1 / space.area)
    return space, problem


def points():
    rng = np.random.default_rng(2)
    J = np.eye(2) + 0.3 * rng.normal(size=(50, 2, 2))
    return J[np.linalg.det(J) > 0.1]


def test_derivatives_are_checked():
    OURS.check_derivatives(points())
    wrong = majorant.Density('wrong', dirichlet, lambda J: (1.01 * dirichlet_derivatives(J)[0],
                                                           dirichlet_derivatives(J)[1]))
    with pytest.raises(AssertionError, match='gradient'):
        wrong.check_derivatives(points())
    wrong = majorant.Density('wrong', dirichlet, lambda J: (dirichlet_derivatives(J)[0],
                                                           1.01 * dirichlet_derivatives(J)[1]))
    with pytest.raises(AssertionError, match='Hessian'):
        wrong.check_derivatives(points())


@pytest.mark.parametrize('degree', [1, 2, 3])
def test_numpy_densities_have_the_built_in_values(degree):
    space, theirs = problem_of('symmetric-dirichlet', degree)
    _, ours = problem_of(OURS, degree)
    x = space.tutte()
    assert ours.value(x) == pytest.approx(theirs.value(x), rel=1e-13)
    assert np.allclose(ours.gradient(x), theirs.gradient(x), rtol=1e-11, atol=1e-12)
    for curvature in ('exact', 'projected'):
        a, b = ours.hessian(x, curvature), theirs.hessian(x, curvature)
        assert abs(a - b).max() < 1e-10 * abs(b).max(), curvature


def test_numpy_densities_lead_to_the_same_map():
    ours = majorant.parametrize(V, F, degree=2, energy=OURS, init='tutte', tolerance=1e-12)
    theirs = majorant.parametrize(V, F, degree=2, init='tutte', tolerance=1e-12)
    a, b = (r.report['result']['value'] for r in (ours, theirs))
    assert abs(a - b) <= 1e-10 * b
    assert len(ours.report['iterations']) == len(theirs.report['iterations'])


def test_files_of_energies_without_a_name_pass_check(tmp_path):
    for solver in (majorant.parametrize, majorant.unwrap):
        r = solver(V, F, degree=2, energy=[(OURS, 1), ('arap', 0.5)])
        r.save(tmp_path / 'mine.vtu')
        assert majorant.check(tmp_path / 'mine.vtu', V, F)
        helpers.command('check', tmp_path / 'mine.vtu', '--quiet')
        assert r.report['result']['energy'] == '' and r.report['result']['value'] > 4
        # Files claim no energy that other programs do not know, and pictures use other quantities.
        assert not len(r.distortion) and not {'energy', 'value'} & set(json.loads(r._file.claims))
        assert r.svg() == r.svg('area') and 'energy 4' in repr(r)


def test_values_outside_of_the_domain_are_infinite():
    space, problem = problem_of(majorant.Density('sum', lambda J: J.sum((1, 2)), dirichlet_derivatives), 1)
    x = space.tutte()
    x[1::2] *= -1
    assert problem.value(x) == np.inf
    _, everywhere = problem_of(majorant.Density('sum', lambda J: J.sum((1, 2)), dirichlet_derivatives,
                                                domain='everywhere'), 1)
    assert np.isfinite(everywhere.value(x))


class Mine(Exception):
    pass


@pytest.mark.parametrize('threads', [1, 2])
def test_exceptions_of_densities_are_passed_on(threads):
    mine, calls, after = Mine('broken'), [], []

    def value(J):
        if after or len(J) > 1000:      # chunks of curved elements are large
            after.append(len(J))
            raise mine
        calls.append(len(J))
        return dirichlet(J)

    broken = majorant.Density('broken', value, dirichlet_derivatives)
    with pytest.raises(Mine) as raised:
        majorant.parametrize(*helpers.grid(30), degree=2, energy=broken, threads=threads)
    assert raised.value is mine and raised.traceback[-1].name == 'value'
    assert calls and len(after) <= threads      # no further chunk begins
    with pytest.raises(Mine):
        problem_of(majorant.Density('broken', value, dirichlet_derivatives))[1].value(
            majorant.Space(V, F, 2).tutte())


@pytest.mark.parametrize('value, derivatives, message', [
    (lambda J: J, dirichlet_derivatives, 'value of'),
    (lambda J: dirichlet(J)[:-1], dirichlet_derivatives, 'value of'),
    (lambda J: dirichlet(J).astype(complex), dirichlet_derivatives, 'value of'),
    (dirichlet, lambda J: dirichlet_derivatives(J)[0], 'not \\(gradient, Hessian\\)'),
    (dirichlet, lambda J: (J, J), 'Hessian of'),
    (dirichlet, lambda J: (J[:, 0], np.zeros((len(J), 4, 4))), 'gradient of'),
])
def test_densities_of_another_shape(value, derivatives, message):
    space, problem = problem_of(majorant.Density('wrong', value, derivatives))
    with pytest.raises(majorant.UsageError, match=message):
        problem.gradient(space.tutte())


def test_two_threads_with_densities():
    serial = majorant.flatten(V, F, energy=OURS)
    found = [None, None]

    def solve(k):
        found[k] = majorant.flatten(V, F, energy=OURS)

    threads = [threading.Thread(target=solve, args=(k,)) for k in range(2)]
    for t in threads:
        t.start()
    for t in threads:
        t.join()
    assert np.array_equal(found[0], serial) and np.array_equal(found[1], serial)


def springs(rest):
    def value(z, e):
        return ((z[:, 2:] - z[:, :2]) ** 2).sum(1) - 2 * rest[e] * np.linalg.norm(z[:, 2:] - z[:, :2], axis=1)

    def derivatives(z, e):
        d = z[:, 2:] - z[:, :2]
        r = np.linalg.norm(d, axis=1)
        g = 2 * d * (1 - rest[e] / r)[:, None]
        H = (2 * (1 - rest[e] / r)[:, None, None] * np.eye(2)
             + (2 * rest[e] / r ** 3)[:, None, None] * d[:, :, None] * d[:, None, :])
        return np.hstack([-g, g]), np.block([[H, -H], [-H, H]])

    return value, derivatives


def test_springs_find_their_lengths():
    edges = np.array([[0, 1], [1, 2], [2, 0]])
    lengths = np.array([3.0, 4.0, 5.0])
    problem = majorant.Problem(6).add(majorant.element_term(edges, *springs(lengths), block=2))
    hold = scipy.sparse.csr_array(([1, 1, 1], ([0, 1, 2], [0, 1, 3])), shape=(3, 6))   # point 0, v of point 1
    problem.constrain(hold, [7, 1, 1])
    assert problem.size == 3 and problem.full_size == 6
    seen = []
    solution = problem.minimize([7, 1, 9, 1, 8, 3], callback=lambda record, x: seen.append((record, x)))
    x = solution.x.reshape(3, 2)
    assert solution.status == 'converged'
    assert np.allclose(np.linalg.norm(x[edges[:, 0]] - x[edges[:, 1]], axis=1), lengths, atol=1e-8)
    assert tuple(x[0]) == (7, 1) and x[1, 1] == 1
    assert [r['energy'] for r, _ in seen] == [r['energy'] for r in solution.iterations]
    assert np.array_equal(seen[-1][1], solution.x)


@pytest.mark.parametrize('method', ['newton', 'lbfgs', 'gradient-flow', *helpers.of_ceres('ceres-lbfgs', 'ceres-nlcg')])
@pytest.mark.parametrize('linear_solver', ['direct', 'eigen'])
def test_solvers_by_name(method, linear_solver):
    rng = np.random.default_rng(3)
    A, b = rng.normal(size=(8, 6)), rng.normal(size=8)
    problem = majorant.Problem(6).add(majorant.penalty(A, b), 0.5)
    solution = problem.minimize(np.zeros(6), method, linear_solver=linear_solver)
    expected = np.linalg.lstsq(A, b, rcond=None)[0]
    # Conjugate gradients of Ceres end when a line search fails, at condition number 2600.
    assert solution.status == ('stalled' if method == 'ceres-nlcg' else 'converged'), solution
    energy, close = (1e-6, 5e-3) if method == 'ceres-nlcg' else (1e-9, 1e-5)
    assert solution.energy == pytest.approx(problem.value(expected), rel=energy), solution
    assert np.allclose(solution.x, expected, atol=close), solution
    assert solution.x.flags.writeable and len(problem.minimize(
        np.zeros(6), method, linear_solver=linear_solver, tolerance=1e-2).iterations) <= len(solution.iterations)
    assert np.allclose(problem.hessian(np.zeros(6)).toarray(), A.T @ A)


@pytest.mark.skipif(helpers.HAS_GPL_PARTS, reason='this build has Ceres')
def test_methods_of_ceres_name_the_build_that_has_them():
    with pytest.raises(majorant.UnsupportedError, match="'ceres-lbfgs' is not in this package.*MAJORANT_GPL"):
        majorant.Problem(2).add(majorant.penalty(np.eye(2), [1, 2])).minimize([0, 0], 'ceres-lbfgs')


def test_constraints_of_real_coefficients():
    rng = np.random.default_rng(5)
    A, b, C, d = rng.normal(size=(8, 6)), rng.normal(size=8), rng.normal(size=(2, 6)), rng.normal(size=2)
    C = np.vstack([C, C[0] / 3 + C[1]])         # a dependent row
    d = np.append(d, d[0] / 3 + d[1])
    problem = majorant.Problem(6).add(majorant.penalty(A, b), 0.5).constrain(scipy.sparse.coo_array(C), d)
    assert problem.size == 4
    x0 = np.linalg.lstsq(C, d, rcond=None)[0]
    solution = problem.minimize(x0)
    assert np.allclose(C @ solution.x, d, atol=1e-13)
    free = scipy.linalg.null_space(C)           # the oracle: least squares in the null space
    y = np.linalg.lstsq(A @ free, b - A @ x0, rcond=None)[0]
    assert np.allclose(solution.x, x0 + free @ y, atol=1e-7)
    with pytest.raises(majorant.UnsupportedError, match=r'A\[1\]'):
        majorant.Problem(6).add(majorant.penalty(A, b)).constrain([C[0], 0.1 * C[0]], [1, 2]).size


def test_loads():
    stiffness = np.diag([2.0, 4.0, 8.0])
    c = np.array([1.0, 0.0, -3.0])
    problem = majorant.Problem(3).add(majorant.penalty(stiffness, np.zeros(3)), 0.5).add(majorant.linear_term(-c), 2)
    assert np.allclose(problem.minimize(np.ones(3)).x, 2 * c / np.diag(stiffness) ** 2, atol=1e-12)
    assert np.allclose(problem.gradient(np.zeros(3)), -2 * c)


def test_a_map_by_hand_is_that_of_parametrize():
    space, problem = problem_of('symmetric-dirichlet', 1)
    problem.keep_injective(space)
    solution = problem.minimize(space.tutte(), tolerance=1e-12)
    r = majorant.parametrize(V, F, degree=1, tolerance=1e-12)
    assert solution.energy == pytest.approx(r.report['result']['value'], rel=1e-8)
    assert np.allclose(problem.gradient(solution.x), 0, atol=1e-5)


def test_spaces():
    space = majorant.Space(V, F, 3)
    uv = majorant.flatten(V, F)
    x = space.linear(uv)
    assert x.shape == (space.size,) == (2 * space.node_count,)
    assert np.array_equal(x.reshape(-1, 2)[:len(V)], uv[space.input_vertices])
    assert np.allclose(space.nodes[:len(V)], V[space.input_vertices]) and space.cells.shape == (len(F), 10)
    assert space.area == pytest.approx(majorant.Space(V, F).area)
    both = space.energy('arap + 0.1*mips')
    assert both.name == 'arap + mips'
    assert majorant.Problem(space.size).add(both).value(x) == pytest.approx(
        majorant.Problem(space.size).add(space.energy('arap')).add(space.energy('mips'), 0.1).value(x))


@pytest.mark.parametrize('call, kind, message', [
    (lambda p: p.constrain([[0.5, np.inf, 0, 0, 0, 0]], [1]), majorant.UsageError, 'A[0, 1] is inf'),
    (lambda p: p.constrain([['1', 0, 0, 0, 0, 0]], [1]), majorant.UsageError, 'A holds text, not numbers'),
    (lambda p: p.constrain(scipy.sparse.csr_array(np.full((1, 6), 1j)), [1]), majorant.UsageError,
     'A holds complex numbers'),
    (lambda p: p.constrain(scipy.sparse.csr_array([[0, 0, 1.0, 0, 0, 0], [0, 0, 0, np.nan, 0, 0]]), [1, 1]),
     majorant.UsageError, 'A[1, 3] is nan'),
    (lambda p: p.constrain(np.eye(7), np.zeros(7)), majorant.UsageError, 'A has 7 columns, the problem 6'),
    (lambda p: p.constrain(np.zeros((1, 7)), [0]), majorant.UsageError, 'A has 7 columns, the problem 6'),
    (lambda p: p.constrain(np.eye(5), np.zeros(5)), majorant.UsageError, 'A has 5 columns, the problem 6'),
    (lambda p: p.constrain(scipy.sparse.csr_array((1, 9)), [0]), majorant.UsageError, 'A has 9 columns'),
    (lambda p: p.constrain(np.eye(6), np.zeros(5)), majorant.UsageError, 'b has shape (5,), not (6,)'),
    (lambda p: p.constrain([[1, 0, 0, 0, 0, 0]] * 2, [1, 2]).size, majorant.UnsupportedError, "row 'A[1]' is off"),
    (lambda p: p.constrain([[1, 0, 0, 0, 0, 0]], [1]).constrain([[1, 0, 0, 0, 0, 0]], [2]).size,
     majorant.UnsupportedError, "row 'A[0] of constrain() number 2' is off"),
    (lambda p: p.add(majorant.element_term([[0, 1], [2, 9]], *springs(np.ones(2)))), majorant.UsageError,
     'element term: node 1 of element 1 is 9; the problem has 6 unknowns, nodes 0 to 5 of 1 each'),
    (lambda p: majorant.element_term([0, 1], *springs(np.ones(1))), majorant.UsageError,
     'nodes has shape (2,), not (#elements, nodes of each)'),
    (lambda p: majorant.element_term([[0, -1]], *springs(np.ones(1))), majorant.UsageError,
     'nodes[0, 1] is -1, but nodes are counted from 0'),
    (lambda p: majorant.Density('d', dirichlet, dirichlet_derivatives).check_derivatives(np.eye(2)),
     majorant.UsageError, 'J has shape (2, 2), not (q, 2, 2) or (q, 3, 3)'),
    (lambda p: p.minimize(np.zeros(5)), majorant.UsageError, 'x0 has shape (5,), not (6,)'),
    (lambda p: p.minimize(np.full(6, np.nan)), majorant.UsageError, 'x0[0] is nan'),
    (lambda p: p.minimize(np.zeros(6), 'bfgs'), majorant.UsageError, "method='bfgs' is none of"),
    (lambda p: p.minimize(np.zeros(6), linear_solver='lu'), majorant.UsageError, "linear_solver='lu' is none"),
    (lambda p: p.minimize(np.zeros(6), curvature='gauss'), majorant.UsageError, "curvature='gauss' is none"),
    (lambda p: p.add('arap'), majorant.UsageError, "'arap' is no Term"),
    (lambda p: p.add(majorant.penalty(np.eye(7), np.zeros(7))), majorant.UsageError, 'unknowns up to 6'),
    (lambda p: p.add(majorant.penalty(np.eye(6, 7), np.zeros(6))), majorant.UsageError, 'unknowns up to 6'),
    (lambda p: p.add(majorant.penalty(np.eye(5), np.zeros(5))), majorant.UsageError,
     'is of 5 unknowns, the problem has 6'),
    (lambda p: p.add(majorant.linear_term(np.ones(5))), majorant.UsageError, 'is of 5 unknowns, the problem has 6'),
    (lambda p: majorant.penalty(np.eye(6), np.zeros(6)).check_derivatives(np.zeros(6)), majorant.UsageError,
     'the derivatives of functions in numpy alone'),
    (lambda p: p.add(majorant.penalty(np.eye(6), np.zeros(6)), -1), majorant.UsageError, 'weight=-1 is no number'),
    (lambda p: p.keep_injective(majorant.Space(V, F)), majorant.UsageError, 'the problem 6'),
    (lambda p: p.keep_injective(3), majorant.UsageError, '3 is no Space'),
    (lambda p: majorant.penalty(np.zeros((2, 3)), [0, 0]), majorant.UsageError, 'row 0 of A is empty'),
    (lambda p: majorant.element_term([[0.5, 1]], *springs(np.ones(1))), majorant.UsageError, 'not integers'),
    (lambda p: majorant.element_term([[0, 1]], 3, 3), majorant.UsageError, 'cannot be called'),
    (lambda p: majorant.Density('', dirichlet, dirichlet_derivatives), majorant.UsageError, 'is no name'),
    (lambda p: majorant.Density('x', dirichlet, dirichlet_derivatives, barrier='high'), majorant.UsageError,
     "barrier='high' is none of"),
    (lambda p: majorant.Problem(0), majorant.UsageError, 'size=0 is no integer from 1'),
    (lambda p: majorant.Space(V, F).linear(V[:3, :2]), majorant.UsageError, 'uv has 3 rows'),
])
def test_invalid_calls_are_refused(call, kind, message):
    problem = majorant.Problem(6).add(majorant.penalty(np.eye(6), np.zeros(6)))
    with pytest.raises(kind) as raised:
        call(problem)
    assert message in str(raised.value)


def test_exceptions_of_element_functions_are_passed_on():
    def broken(z, e):
        raise Mine

    problem = majorant.Problem(4).add(majorant.element_term([[0, 1]], broken, broken, block=2))
    with pytest.raises(Mine):
        problem.value(np.zeros(4))
    with pytest.raises(Mine):
        problem.minimize(np.zeros(4))


def test_hessians_that_are_not_symmetric():
    """Hessians of elements and densities are tested; otherwise a run would continue to its limit."""
    value, derivatives = springs(np.ones(3))

    def one_sided(z, e):
        gradient, hessian = derivatives(z, e)
        hessian[e == 2, 0, 3] += 1
        return gradient, hessian

    edges = [[0, 1], [1, 2], [2, 0]]
    x = np.array([0, 0, 1, 0.1, 0.2, 1])
    for functions, refused in [((value, derivatives), None), ((value, one_sided), "'net' at element 2")]:
        problem = majorant.Problem(6).add(majorant.element_term(edges, *functions, block=2, name='net'))
        if refused is None:
            problem.minimize(x, max_iterations=3)
            continue
        for call in (lambda: problem.minimize(x, max_iterations=3), lambda: problem.hessian(x)):
            with pytest.raises(majorant.UsageError, match=refused + r' is not symmetric: \[0, 3\] is'):
                call()

    def askew(J):
        gradient, hessian = dirichlet_derivatives(J)
        return gradient, hessian.reshape(-1, 4, 4) + np.eye(4, k=1)

    space, problem = problem_of(majorant.Density('askew', dirichlet, askew))
    with pytest.raises(majorant.UsageError, match="Hessian of 'askew' at point 0 is not symmetric"):
        problem.gradient(space.tutte())


def test_derivatives_of_elements_are_checked():
    value, derivatives = springs(np.ones(3))
    edges, x = [[0, 1], [1, 2], [2, 0]], np.array([0, 0, 1, 0.1, 0.2, 1])

    def wrong(which):
        def changed(z, e):
            found = [part.copy() for part in derivatives(z, e)]
            found[which][e == 1] *= 1.01
            return tuple(found)
        return majorant.element_term(edges, value, changed, block=2)

    majorant.element_term(edges, value, derivatives, block=2).check_derivatives(x)
    for which, entry in [(0, r'gradient\[\d\] at element 1 is'), (1, r'Hessian\[\d, \d\] at element 1 is')]:
        with pytest.raises(AssertionError, match=entry):
            wrong(which).check_derivatives(x)
    with pytest.raises(majorant.UsageError, match='x has 5 numbers, element term takes 6'):
        wrong(0).check_derivatives(x[:5])


def test_callbacks_of_problems_end_them():
    space, problem = problem_of('symmetric-dirichlet', 1)
    assert problem.minimize(space.tutte(), callback=lambda record, x: True).status == 'interrupted'
    with pytest.raises(Mine):
        def callback(record, x):
            raise Mine
        problem.minimize(space.tutte(), callback=callback)


if __name__ == '__main__':
    helpers.main(__file__)
