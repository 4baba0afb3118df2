#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Energies and terms by value alone: dual numbers, and differences if these cannot follow."""
import warnings

import helpers
import numpy as np
import pytest

import majorant
from majorant._duals import Dual
from majorant._derivatives import PointFunction

V, F = helpers.grid(6)
POINTS = np.eye(3) + 0.2 * np.random.default_rng(0).normal(size=(7, 3, 3))
W = np.array([1.0, 2.0, 3.0])


def det(J):
    return J[:, 0, 0] * J[:, 1, 1] - J[:, 0, 1] * J[:, 1, 0]


def dirichlet(J):
    return (J ** 2).sum((1, 2)) * (1 + 1 / det(J) ** 2)


def arap(J):
    squared = (J ** 2).sum((1, 2))
    return squared - 2 * np.sqrt(squared + 2 * det(J)) + 2


def mips(J):
    return (J ** 2).sum((1, 2)) / det(J)


# Returns four nonlinear functions of each point.
def four(f):
    return lambda J: f(J[:, 0, 0], J[:, 0, 1], J[:, 1, 1], J[:, 2, 0])


FORMULAS = {
    'inverse': lambda J: (J ** 2).sum((1, 2)) + (np.linalg.inv(J) ** 2).sum((1, 2)),
    'inverse of 2 by 2': lambda J: (np.linalg.inv(J[:, :2, :2]) ** 3).sum(axis=(1, 2)),
    'determinant': lambda J: np.linalg.det(J) ** -1.5 + np.log(np.linalg.det(J)),
    'einsum of three': lambda J: np.einsum('qij,qjk,qkl->q', J, J, J),
    'einsum with data': lambda J: np.einsum('qij,jk->qik', J, np.arange(9.0).reshape(3, 3)).sum((1, 2)) ** 2,
    'matmul': lambda J: np.trace(J.swapaxes(1, 2) @ J @ np.diag(W), axis1=1, axis2=2) ** 2,
    'matmul with vectors': lambda J: ((J @ W) ** 2).sum(1) ** 2 + (W @ J).prod(1),
    'norms': lambda J: (np.linalg.norm(J, axis=(1, 2)) + np.linalg.norm(J[:, 0], axis=1) ** 3
                        + np.linalg.norm(J[:, [1, 0], :], axis=-1)[:, 0]),
    'exponentials': four(lambda x, y, z, w: np.exp(x) / np.sqrt(z) + np.expm1(y) + np.log1p(x) * np.log2(z)
                         + np.log10(x) + np.cbrt(z) + np.sinh(x) * np.cosh(y) + np.tanh(w)),
    'angles': four(lambda x, y, z, w: np.sin(x) * np.cos(y) + np.tan(w) + np.arctan2(x, z) + np.hypot(y, x)
                   + np.arctan(y) + np.arcsin(y / 2) + np.arccos(w / 3)),
    'powers': four(lambda x, y, z, w: x ** z + 2 ** y + z ** 3 + y ** 2 + x ** 0.5 + 1 / x - z + abs(w) * +w
                   + np.square(x) + np.reciprocal(z) + np.power(x, np.arange(7)) + y ** 1 + w ** 0),
    'kinks': lambda J: (np.where(J > 0.1, J ** 3, 2 * J * J).sum((1, 2)) + np.maximum(J[:, 0, 0], J[:, 1, 1]) ** 2
                        + np.minimum(J, 0.3).sum((1, 2)) ** 2 + np.clip(J, -0.1, 0.2).sum((1, 2)) ** 2
                        + J.max(1).sum(1) ** 2 + np.min(J.reshape(-1, 9), axis=1) ** 2 + np.sign(J).sum((1, 2)) * J[:, 0, 0]),
    'broadcast': lambda J: ((J[:, :1, 0] + W).sum(1) ** 2 + np.einsum('qi->q', J[:, :1, 1] + W) ** 2
                            + np.einsum('qi,qi->q', J[:, 1:2, 1] + W, J[:, 2]) + (J[:, 2] * J[:, :1, 1]).prod(1)),
    'joined': lambda J: ((np.stack([J[:, 0], J[:, 1]], axis=-1) ** 3).sum((1, 2))
                         + np.concatenate([J, np.ones((len(J), 1, 3))], 1).mean((1, 2)) ** 2
                         + np.column_stack([J[:, 0, 0], J[:, 1]]).sum(1) ** 2 + np.hstack([J[:, 0], J[:, 1]]).sum(1) ** 2
                         + np.vstack([J[:, 0, 0], J[:, 1, 1]]).prod(0)),
    'moved': lambda J: ((np.moveaxis(J, 1, 2)[:, 0] * J[:, :, 1]).sum(1) + J.transpose(1, 0, 2)[0].T[2] ** 2
                        + np.diff(J, axis=1).reshape(-1, 6).sum(1) ** 2 + np.flip(J, axis=1)[:, 0, 0] ** 3),
    'indices': lambda J: (J[:, [0, 1], [1, 2]].sum(1) ** 2 + J[np.arange(len(J)), 0, 0] ** 2
                          + J[..., 1, None].sum((1, 2)) ** 2 + (J[:, None] * J[:, :, None]).sum((1, 2, 3))
                          + (np.zeros_like(J) + J)[:, 2, 2] ** 2),
}


def differences(f, points, h=1e-4):
    steps = np.eye(points[0].size).reshape(-1, *points.shape[1:]) * h
    gradient = np.stack([(f(points + e) - f(points - e)) / (2 * h) for e in steps], -1)
    hessian = np.stack([np.stack([(f(points + e + d) - f(points + e - d) - f(points - e + d) + f(points - e - d))
                                  / (4 * h * h) for e in steps], -1) for d in steps], -1)
    return gradient, hessian


@pytest.mark.parametrize('formula', FORMULAS.values(), ids=FORMULAS)
def test_dual_numbers(formula):
    found = formula(Dual.variables(POINTS))
    gradient, hessian = differences(formula, POINTS)
    assert np.allclose(found.value, formula(POINTS), rtol=1e-13)
    assert abs(found.gradient - gradient).max() < 1e-6 * abs(gradient).max()
    assert abs(found.hessian - hessian).max() < 1e-5 * abs(hessian).max()


@pytest.mark.parametrize('name', [name for name in FORMULAS if name != 'powers'])     # its data have 7 points
def test_as_many_points_as_there_are(name):
    """Constants are stored once, and zeros are left out, also for many points."""
    few, many = (FORMULAS[name](Dual.variables(points)) for points in (POINTS, np.tile(POINTS, (9, 1, 1))))
    assert np.allclose(many.value, np.tile(few.value, 9), rtol=1e-13)
    assert abs(many.gradient - np.tile(few.gradient, (9, 1))).max() < 1e-12 * abs(few.gradient).max()
    assert abs(many.hessian - np.tile(few.hessian, (9, 1, 1))).max() < 1e-12 * abs(few.hessian).max()


def test_data_of_many_points():
    """Derivatives at more points than one batch of dual numbers has."""
    q = 20000
    x, data = np.random.default_rng(5).normal(size=(q, 3)), np.arange(q)[:, None] / q
    f = PointFunction('many', 'element', lambda z, e, d: d[:, 0] * (z ** 3).sum(1) + e, None)
    value, gradient, hessian = f.linearize(x, np.arange(q), data)
    assert np.allclose(value, data[:, 0] * (x ** 3).sum(1) + np.arange(q))
    assert np.allclose(gradient, 3 * data.T * x.T ** 2)
    assert np.allclose(hessian[[0, 2, 5]], 6 * data.T * x.T) and (hessian[[1, 3, 4]] == 0).all()


def into(array, key, x):
    array[key] = x


@pytest.mark.parametrize('lossy', [
    np.asarray, np.array, np.linalg.svd, np.cross, np.add.reduce, np.fft.fft, lambda x: x.foo,
    lambda x: float(x[0, 0, 0]), lambda x: x.__iadd__(1), lambda x: np.arange(3.0).__iadd__(x[0, 0]),
    lambda x: into(np.zeros(7), 0, x[0, 0, 0]), lambda x: into(np.zeros((7, 3)), (slice(None), 0), x[:, 0, 0]),
    lambda x: into(x, 0, 1.0), lambda x: np.add(x, 1, out=np.zeros(x.shape)), lambda x: np.linalg.norm(x, 1, axis=1),
    lambda x: np.einsum('qij', x), lambda x: np.linalg.det(x[:, :1, :1]), lambda x: np.vectorize(float)(x),
])
def test_derivatives_are_not_lost(lossy):
    with pytest.raises((TypeError, ValueError, AttributeError)):
        lossy(Dual.variables(POINTS))


@pytest.mark.filterwarnings('ignore')      # PointFunction hides them
def test_powers_at_zero():
    x = Dual.variables(np.array([[0.0, 2.0]]))
    for p, slope, bend in [(0, 0, 0), (1, 1, 0), (2, 0, 2), (3, 0, 0)]:
        found = x[:, 0] ** p
        assert (found.gradient[0, 0], found.hessian[0, 0, 0]) == (slope, bend), p
    together = x[:, 0] ** np.array([0, 1, 2])
    assert together.hessian[:, 0, 0].tolist() == [0, 0, 2]
    assert (np.hypot(x[:, 0], 0 * x[:, 1]).gradient == 0).all()
    assert abs(x)[:, 0].gradient[0, 0] == 1


def with_svd(J):
    s = np.linalg.svd(J, compute_uv=False)
    return (s ** 2 + 1 / s ** 2).sum(1)


def in_place(J):
    squared = (J ** 2).sum((1, 2))
    out = np.zeros(len(J))
    out += squared * (1 + 1 / det(J) ** 2)
    return out


@pytest.mark.parametrize('name, value', [('symmetric-dirichlet', dirichlet), ('arap', arap), ('mips', mips)])
@pytest.mark.parametrize('degree', [1, 3])
def test_the_minimum_of_the_value_alone(name, value, degree):
    options = dict(degree=degree, init='tutte', tolerance=1e-12)
    energies = [majorant.Density(name, value, free_scale='arbitrary' if name == 'mips' else 'determined',
                                 barrier='strong' if name == 'symmetric-dirichlet' else None,
                                 domain='everywhere' if name == 'arap' else 'positive'), name]
    assert energies[0].derivatives == 'dual numbers'
    ours, theirs = (majorant.parametrize(V, F, energy=e, **options).report['result']['value'] for e in energies)
    assert abs(ours - theirs) <= 1e-9 * theirs


@pytest.mark.parametrize('value', [with_svd, in_place])
def test_the_minimum_by_differences(value):
    density = majorant.Density('symmetric Dirichlet', value, barrier='strong')
    assert density.derivatives == 'differences'
    options = dict(degree=2, init='tutte', tolerance=1e-12)
    ours, theirs = (majorant.parametrize(V, F, energy=e, **options).report['result']['value']
                    for e in (density, 'symmetric-dirichlet'))
    assert abs(ours - theirs) <= 1e-9 * theirs


def test_derivatives_of_all_kinds_are_checked():
    J = np.eye(2) + 0.1 * np.random.default_rng(1).normal(size=(20, 2, 2))
    exact = majorant.Density('dual', dirichlet).differentiate(J)
    for value, kind, close in [(dirichlet, 'dual numbers', 1e-13), (with_svd, 'differences', 1e-8)]:
        density = majorant.Density('x', value)
        density.check_derivatives(J)
        assert density.derivatives == kind
        for found, expected in zip(density.differentiate(J), exact):
            assert abs(found - expected).max() < close * abs(expected).max()
    given = majorant.Density('given', dirichlet, lambda J: exact)
    assert given.derivatives == 'given'

    def stepped(J):     # a jump of the slope that dual numbers do not detect
        return (J ** 2).sum((1, 2)) + 1e-3 * np.floor(1000 * J[:, 0, 0])

    with pytest.raises(AssertionError, match=r'gradient\[0\] at point'):
        majorant.Density('stepped', stepped).check_derivatives(np.round(J, 3))


def test_near_the_end_of_the_domain_steps_are_small():
    J = np.array([np.diag([1, 10.0 ** -k]) for k in range(1, 5)])
    exact = majorant.Density('dual', dirichlet).differentiate(J)
    found = majorant.Density('svd', with_svd).differentiate(J)
    for f, e in zip(found, exact):
        axes = tuple(range(1, e.ndim))
        assert (abs(f - e).max(axes) < 1e-4 * abs(e).max(axes)).all()
    outside = majorant.Density('svd', with_svd).differentiate(np.array([np.diag([1.0, -1]), np.eye(2)]))
    assert np.isnan(outside[0][0]).all() and np.isfinite(outside[0][1]).all()


def test_differences_that_do_not_agree():
    kink = majorant.Density('kink', lambda J: np.asarray(np.abs(J[:, 0, 0] - 1) + (J ** 2).sum((1, 2))))
    J = np.stack([2 * np.eye(2), np.eye(2)])
    assert kink.derivatives == 'differences'
    kink.check_derivatives(J[:1])
    with pytest.raises(majorant.UsageError, match=r"'kink' at point 1, \[1.0, 0.0, 0.0, 1.0\]: differences"):
        kink.differentiate(J)


def test_functions_that_are_flat_or_offset():
    for value in (lambda z: np.asarray(0 * z[:, 0]), lambda z: np.asarray(1e6 + z[:, 0] - 2 * z[:, 1]),
                  lambda z: np.asarray(1e3 + z[:, 0] * z[:, 1])):
        f = PointFunction('f', 'point', value, None)
        gradient, hessian = f.differentiate(np.array([[0.0, 0.0], [1.0, 2.0]]))
        expected = differences(value, np.array([[0.0, 0.0], [1.0, 2.0]]), 1e-2)
        assert np.allclose(gradient, expected[0], atol=1e-6) and np.allclose(hessian, expected[1], atol=1e-3)


EDGES = np.array([[0, 1], [1, 2], [2, 0]])
LENGTHS = np.array([3.0, 4.0, 5.0])


@pytest.mark.parametrize('kind, norm', [('dual numbers', np.linalg.norm),
                                        ('differences', lambda d, axis: np.sqrt(np.asarray(d ** 2).sum(axis)))])
def test_terms_of_the_value_alone(kind, norm):
    term = majorant.element_term(EDGES, lambda z, e: (norm(z[:, 2:] - z[:, :2], axis=1) - LENGTHS[e]) ** 2, block=2)
    assert term.derivatives == kind
    start = [7, 1, 9, 1, 8, 3]
    term.check_derivatives(start)
    problem = majorant.Problem(6).add(term).constrain(np.eye(6)[[0, 1, 3]], [7, 1, 1])
    solution = problem.minimize(start)
    x = solution.x.reshape(3, 2)
    assert solution.status == 'converged' and term.derivatives == kind
    assert np.allclose(np.linalg.norm(x[EDGES[:, 0]] - x[EDGES[:, 1]], axis=1), LENGTHS, atol=1e-7)
    assert majorant.linear_term([1, 2]).derivatives is None


def test_elements_whose_differences_do_not_agree():
    term = majorant.element_term([[0], [1], [2]], lambda z, e: np.asarray(abs(z[:, 0] - (e == 1))))
    with pytest.raises(majorant.UsageError, match="'element term' at element 1"):
        majorant.Problem(3).add(term).gradient([5.0, 1.0, 5.0])
    kink = PointFunction('kink', 'element', lambda z, e: np.asarray(abs(z[:, 0])), None)
    with pytest.raises(majorant.UsageError, match="'kink' at element 8"):
        kink.differentiate(np.array([[1.0], [0.0]]), np.array([9, 8], dtype=np.int32))


def test_exceptions_of_values_are_passed_on():
    class Mine(Exception):
        pass

    def broken(J):
        raise Mine

    def wrong(J):
        return J.reshape(-1, 3) @ np.eye(2)

    with pytest.raises(Mine):
        majorant.Density('broken', broken).differentiate(POINTS[:, :2, :2])
    with pytest.raises(ValueError, match='matmul'):
        majorant.Density('wrong', wrong).differentiate(POINTS[:6, :2, :2])
    with pytest.raises(majorant.UsageError, match="value of 'matrix' at 7 points has shape"):
        majorant.Density('matrix', lambda J: J).differentiate(POINTS[:, :2, :2])


def test_no_warnings_of_numpy():
    with warnings.catch_warnings():
        warnings.simplefilter('error')
        density = majorant.Density('x', dirichlet)
        density.differentiate(np.zeros((2, 2, 2)))
        majorant.Density('x', with_svd).differentiate(np.zeros((2, 2, 2)))


if __name__ == '__main__':
    helpers.main(__file__)
