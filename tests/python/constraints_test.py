#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Least squares with robust losses, inequalities, bounds."""
import helpers
import numpy as np
import pytest
import scipy.optimize

import majorant

INF = np.inf
T = np.linspace(0, 1, 40)
RNG = np.random.default_rng(4)
Y = 2 * np.exp(-1.5 * T) + 0.02 * RNG.normal(size=40)
Y[::8] += 3      # outliers
NODES = np.tile([0, 1], (40, 1))


def curve(z, e):
    return z[:, 0] * np.exp(z[:, 1] * T[e]) - Y[e]


def curve_derivatives(z, e):
    E = np.exp(z[:, 1] * T[e])
    first = np.stack([E, z[:, 0] * T[e] * E], axis=1)
    mixed = T[e] * E
    second = np.stack([np.stack([0 * E, mixed], 1), np.stack([mixed, z[:, 0] * T[e] ** 2 * E], 1)], 1)
    return first, second


def rho(loss, width):
    """Returns the loss as a function of s = |r|^2, like Ceres and scipy."""
    b = width ** 2
    return {
        None: lambda s: s,
        'huber': lambda s: np.where(s <= b, s, 2 * width * np.sqrt(s) - b),
        'soft-l1': lambda s: 2 * b * (np.sqrt(1 + s / b) - 1),
        'cauchy': lambda s: b * np.log1p(s / b),
        'arctan': lambda s: width * np.arctan2(s, width),
        'tukey': lambda s: np.where(s > b, b / 3, b / 3 * (1 - (1 - s / b) ** 3)),
    }[loss]


@pytest.mark.parametrize('loss', [None, 'huber', 'soft-l1', 'cauchy', 'arctan', 'tukey'])
@pytest.mark.parametrize('curvature', ['projected', 'reweighted'])
@pytest.mark.parametrize('derivatives', [None, curve_derivatives, lambda z, e: curve_derivatives(z, e)[0]],
                         ids=['value', 'both', 'first'])
def test_fits(loss, curvature, derivatives):
    options = {} if loss is None else dict(loss=loss, width=0.3)
    term = majorant.least_squares(NODES, curve, derivatives, **options)
    assert term.derivatives == ('dual numbers' if derivatives is None else 'given')
    term.check_derivatives([1.5, -1.0])
    problem = majorant.Problem(2).add(term)
    of = rho(loss, 0.3)
    energy = lambda x: of(curve(np.tile(x, (40, 1)), np.arange(40)) ** 2).sum() / 2  # noqa: E731
    assert problem.value([1.5, -1]) == pytest.approx(energy([1.5, -1]), rel=1e-13)
    solution = problem.minimize([1.9, -1.4], curvature=curvature, tolerance=1e-12)
    best = scipy.optimize.minimize(energy, [1.9, -1.4], method='Nelder-Mead', options=dict(xatol=1e-10, fatol=1e-14))
    assert solution.status == 'converged'
    assert solution.energy == pytest.approx(best.fun, rel=1e-9)
    assert np.allclose(solution.x, best.x, atol=1e-5)
    if loss not in (None, 'huber', 'soft-l1'):
        assert np.allclose(solution.x, [2, -1.5], atol=0.1)      # outliers have no effect


@pytest.mark.parametrize('method', helpers.of_ceres('ceres-lm', 'ceres-dogleg'))
@pytest.mark.parametrize('loss', [None, 'huber', 'cauchy'])
@pytest.mark.parametrize('derivatives', [None, lambda z, e: curve_derivatives(z, e)[0]], ids=['value', 'first'])
def test_trust_regions_of_ceres_end_at_the_same_minimum(method, loss, derivatives):
    options = {} if loss is None else dict(loss=loss, width=0.3)
    problem = majorant.Problem(2).add(majorant.least_squares(NODES, curve, derivatives, **options), 3.0)
    ours = problem.minimize([1.9, -1.4], 'levenberg-marquardt', tolerance=1e-12)
    theirs = problem.minimize([1.9, -1.4], method)
    assert ours.status == theirs.status == 'converged', theirs
    assert theirs.energy == pytest.approx(ours.energy, rel=1e-9)
    assert np.allclose(theirs.x, ours.x, atol=1e-5)
    assert theirs.energy == problem.value(theirs.x) and len(theirs.iterations) >= 2


@pytest.mark.parametrize('method', helpers.of_ceres('ceres-lm', 'ceres-dogleg'))
def test_trust_regions_of_ceres_are_for_least_squares(method):
    problem = majorant.Problem(2).add(majorant.least_squares(NODES, curve)).add(majorant.linear_term([1, 2]))
    with pytest.raises(majorant.UsageError, match="term 'linear' is no sum of squares"):
        problem.minimize([1.9, -1.4], method)


@pytest.mark.parametrize('loss', [None, 'huber', 'soft-l1', 'cauchy', 'arctan', 'tukey'])
def test_curvatures_of_least_squares(loss):
    options = {} if loss is None else dict(loss=loss, width=0.7)
    problem = majorant.Problem(2).add(majorant.least_squares(NODES, curve, **options))
    x, h = np.array([1.4, -0.9]), 1e-5
    steps = h * np.eye(2)
    slope = [(problem.value(x + e) - problem.value(x - e)) / (2 * h) for e in steps]
    bend = np.column_stack([(problem.gradient(x + e) - problem.gradient(x - e)) / (2 * h) for e in steps])
    assert np.allclose(problem.gradient(x), slope, rtol=1e-7)
    assert np.allclose(problem.hessian(x).toarray(), bend, rtol=1e-6)
    J = curve_derivatives(np.tile(x, (40, 1)), np.arange(40))[0]
    for curvature in ('projected', 'reweighted'):
        found = problem.hessian(x, curvature).toarray()
        assert (np.linalg.eigvalsh(found) >= 0).all()
        if loss is None:
            assert np.allclose(found, J.T @ J)
    first_only = majorant.Problem(2).add(majorant.least_squares(NODES, curve, lambda z, e: curve_derivatives(z, e)[0],
                                                                **options))
    assert np.allclose(first_only.hessian(x, 'reweighted').toarray(), found)
    with pytest.raises(majorant.UsageError, match="'exact'"):
        first_only.hessian(x)


def test_residuals_of_several_numbers():
    """Points on a circle: centre and radius, residuals (dx, dy) to the nearest point."""
    angles = RNG.uniform(0, 2 * np.pi, 30)
    P = np.array([1.0, 2.0]) + 3 * np.column_stack([np.cos(angles), np.sin(angles)]) + 0.01 * RNG.normal(size=(30, 2))

    def residuals(z, e):
        away = P[e] - z[:, :2]
        return away * (1 - z[:, 2:] / np.sqrt((away ** 2).sum(1))[:, None])

    nodes = np.tile([0, 1, 2], (30, 1))
    found = []
    for f in (residuals, lambda z, e: residuals(np.asarray(z), e)):
        term = majorant.least_squares(nodes, f)
        term.check_derivatives([0.5, 1.5, 2.0])
        found.append((term.derivatives, majorant.Problem(3).add(term).minimize([0.5, 1.5, 2.0])))
    assert [kind for kind, _ in found] == ['dual numbers', 'differences']
    for _, solution in found:
        assert solution.status == 'converged' and np.allclose(solution.x, [1, 2, 3], atol=0.02)
    assert np.allclose(found[0][1].x, found[1][1].x, atol=1e-7)


def project(camera, point):
    """Returns images of the points by cameras (rotation vector, translation), divided by depth."""
    w, t = camera[:, :3], camera[:, 3:]
    angle2 = (w ** 2).sum(1)
    angle = np.sqrt(angle2)
    cross = np.stack([w[:, 1] * point[:, 2] - w[:, 2] * point[:, 1], w[:, 2] * point[:, 0] - w[:, 0] * point[:, 2],
                      w[:, 0] * point[:, 1] - w[:, 1] * point[:, 0]], axis=1)
    along = (w * point).sum(1) * (1 - np.cos(angle)) / angle2
    q = point * np.cos(angle)[:, None] + cross * (np.sin(angle) / angle)[:, None] + w * along[:, None] + t
    return q[:, :2] / q[:, 2:]


def test_a_bundle_adjustment_ends_where_scipy_does():
    """Frame and scale are free; blocks have 6 and 3 unknowns."""
    rng = np.random.default_rng(8)
    cameras, points = 5, 30
    x = np.concatenate([np.column_stack([0.1 * rng.normal(size=(cameras, 1)), 0.25 * np.arange(cameras) - 0.45,
                                         0.1 * rng.normal(size=(cameras, 3)), np.full(cameras, 5)]).ravel(),
                        rng.uniform(-1, 1, 3 * points)])
    camera, point = (k.ravel() for k in np.meshgrid(np.arange(cameras), np.arange(points), indexing='ij'))
    nodes = majorant.parameter_blocks((6 * camera, 6), (6 * cameras + 3 * point, 3))
    assert nodes.shape == (150, 9) and list(nodes[31]) == [6, 7, 8, 9, 10, 11, 33, 34, 35]
    seen = project(x[nodes[:, :6]], x[nodes[:, 6:]]) + 0.002 * rng.normal(size=(150, 2))
    seen[::17] += 0.3 * rng.normal(size=seen[::17].shape)
    start = x + 0.03 * rng.normal(size=x.shape)

    def residuals(z, e):
        return project(z[:, :6], z[:, 6:]) - seen[e]

    term = majorant.least_squares(nodes, residuals, loss='huber', width=0.01)
    term.check_derivatives(start)
    problem = majorant.Problem(len(x)).add(term)
    ours = problem.minimize(start, 'levenberg-marquardt', tolerance=1e-13)

    def energy_and_slope(x):
        return problem.value(x), problem.gradient(x)

    r = residuals(ours.x[nodes], np.arange(150))
    s = (r ** 2).sum(1)
    assert ours.energy == pytest.approx(rho('huber', 0.01)(s).sum() / 2, rel=1e-12)
    assert ours.status == 'converged' and ours.iterations[-1]['shift'] < 1e-4
    theirs = scipy.optimize.minimize(energy_and_slope, ours.x + 1e-3 * rng.normal(size=x.shape), jac=True,
                                     method='L-BFGS-B', options=dict(maxiter=20000, maxfun=40000, ftol=1e-15, gtol=1e-12))
    assert theirs.fun == pytest.approx(ours.energy, rel=1e-4) and ours.energy <= theirs.fun * (1 + 1e-9)
    newton = problem.minimize(start, tolerance=1e-13)
    assert newton.energy == pytest.approx(ours.energy, rel=1e-8)


def distance(z, e):
    return ((z[:, 2:] - z[:, :2]) ** 2).sum(1) - 1


PAIRS = [[0, 1], [0, 2], [1, 2]]


def target_problem():
    """Returns a problem with three points that are attracted to one."""
    return majorant.Problem(6).add(majorant.penalty(np.eye(6), np.zeros(6)), 0.5)


@pytest.mark.parametrize('start', [
    [2, 0, -1, 2, -1, -2],              # inside
    [0.1, 0, -0.1, 0.1, -0.1, -0.2],    # outside: the run first moves inside
])
def test_points_that_stay_apart(start):
    apart = majorant.Inequality(PAIRS, distance, block=2, name='apart')
    apart.check_derivatives(start)
    assert apart.derivatives == 'dual numbers' and repr(apart) == "<majorant.Inequality 'apart'>"
    problem = target_problem().hold(apart)
    solution = problem.minimize(start)
    x = solution.x.reshape(3, 2)
    assert solution.status == 'converged'
    sides = [np.linalg.norm(x[i] - x[j]) for i, j in PAIRS]
    assert np.allclose(sides, 1, atol=1e-6) and min(sides) > 1      # an equilateral triangle of side 1 about the origin
    assert solution.energy == pytest.approx(0.5, abs=1e-6)          # 3 * (1 / sqrt(3))^2 / 2
    assert solution.phases[-1]['gap'] <= 1e-8 < solution.phases[0]['gap']
    assert problem.value(solution.x) == pytest.approx(solution.energy)      # the energy contains no barriers
    rough = problem.minimize(start, gap=1e-2)
    assert len(rough.phases) < len(solution.phases) and rough.energy > solution.energy


def test_penalties_of_inequalities():
    apart = majorant.Inequality(PAIRS, distance, block=2)
    assert apart.penalty().derivatives == 'dual numbers'
    start = [0.3, 0, -0.1, 0.3, -0.1, -0.2]
    apart.penalty().check_derivatives(start)
    alone = majorant.Problem(6).add(apart.penalty())
    steps = 1e-5 * np.eye(6)
    assert np.allclose(alone.gradient(start), [(alone.value(start + e) - alone.value(start - e)) / 2e-5 for e in steps],
                       atol=1e-7)
    assert np.allclose(alone.hessian(start).toarray(),
                       [(alone.gradient(start + e) - alone.gradient(start - e)) / 2e-5 for e in steps], atol=1e-6)
    solution = target_problem().add(apart.penalty(), 1e4).minimize(start)
    x = solution.x.reshape(3, 2)
    sides = np.array([np.linalg.norm(x[i] - x[j]) for i, j in PAIRS])
    assert solution.status == 'converged' and (sides < 1).all() and (sides > 1 - 1e-3).all()


def test_an_inequality_by_differences():
    apart = majorant.Inequality(PAIRS, lambda z, e: np.asarray(distance(z, e)), block=2)
    solution = target_problem().hold(apart).minimize([2, 0, -1, 2, -1, -2])
    assert apart.derivatives == 'differences' and solution.energy == pytest.approx(0.5, abs=1e-6)


@pytest.mark.parametrize('start', [np.full(6, 0.5), np.full(6, 7.0)])
def test_bounds(start):
    A, b = RNG.normal(size=(9, 6)), 3 * RNG.normal(size=9)
    lower, upper = np.array([0, -INF, 0.2, 0, -INF, 0]), np.array([1, 0.6, INF, 1, INF, 1])
    problem = majorant.Problem(6).add(majorant.penalty(A, b), 0.5).bound(lower, upper)
    solution = problem.minimize(start)
    oracle = scipy.optimize.lsq_linear(A, b, (lower, upper), tol=1e-14)
    assert solution.status == 'converged'
    assert (lower < solution.x).all() and (solution.x < upper).all()
    assert solution.energy == pytest.approx(oracle.cost, rel=1e-7)
    assert np.allclose(solution.x, oracle.x, atol=1e-5)


def test_bounds_with_constraints_and_one_number():
    problem = majorant.Problem(3).add(majorant.linear_term([1, 2, 3])).bound(0).constrain([[1, 1, 1]], [1])
    solution = problem.minimize([1 / 3] * 3)
    assert solution.energy == pytest.approx(1, abs=1e-6) and np.allclose(solution.x, [1, 0, 0], atol=1e-6)
    assert sum(solution.x) == pytest.approx(1, abs=1e-14)


def test_bounds_that_nothing_meets():
    problem = majorant.Problem(1).add(majorant.penalty([[1.0]], [0]))
    problem.hold(majorant.Inequality([[0]], lambda z, e: -1 - z[:, 0] ** 2, name='never'))
    solution = problem.minimize([0.3])
    assert solution.status == 'infeasible' and 'never' in solution.message


def rods_of(lengths):
    return majorant.Equality([[k, k + 1] for k in range(len(lengths))],
                             lambda z, e: ((z[:, 2:] - z[:, :2]) ** 2).sum(1) - np.asarray(lengths)[e] ** 2,
                             block=2, name='rods')


def hanging_chain(lengths, end):
    """Returns rods between two pins with a weight at every joint."""
    joints = len(lengths) + 1
    weight = np.tile([0.0, 1.0], joints)
    pins = np.zeros((4, 2 * joints))
    pins[[0, 1, 2, 3], [0, 1, -2, -1]] = 1
    problem = majorant.Problem(2 * joints).add(majorant.linear_term(weight)).constrain(pins, [0, 0, end, 0])
    t = np.linspace(0, 1, joints)
    return problem.hold(rods_of(lengths)), np.stack([end * t, -t * (1 - t)], 1).ravel()


def test_rods_that_keep_their_lengths():
    lengths = np.array([0.4, 0.5, 0.7, 0.3])
    problem, start = hanging_chain(lengths, 1.4)
    solution = problem.minimize(start)
    x = solution.x.reshape(-1, 2)
    assert solution.status == 'converged' and solution.definite == 'yes'
    assert np.allclose(np.linalg.norm(np.diff(x, axis=0), axis=1), lengths, atol=1e-14)
    assert solution.phases[-1]['violation'] <= 1e-14
    # At each inner joint, the weight balances the forces 2 l d of its two rods.
    forces = 2 * solution.multipliers[:, None] * np.diff(x, axis=0)
    assert np.allclose(forces[:-1] - forces[1:], [0, -1], atol=1e-12)
    oracle = scipy.optimize.minimize(
        lambda z: z[1::2].sum(), start, method='SLSQP', jac=lambda z: np.tile([0.0, 1.0], 5), options={'ftol': 1e-14},
        constraints=[{'type': 'eq', 'fun': lambda z: ((np.diff(z.reshape(-1, 2), axis=0)) ** 2).sum(1) - lengths ** 2},
                     {'type': 'eq', 'fun': lambda z: z[[0, 1, 8, 9]] - [0, 0, 1.4, 0]}])
    assert solution.energy == pytest.approx(oracle.fun, abs=1e-7) and np.allclose(solution.x, oracle.x, atol=1e-4)


def test_derivatives_under_equalities():
    lengths = np.array([0.4, 0.5, 0.7, 0.3])
    solution = (lambda problem, start: problem.minimize(start))(*hanging_chain(lengths, 1.4))
    moved = [(lambda problem, start: problem.minimize(start).x)(*hanging_chain(lengths, 1.4 + h)) for h in (1e-4, -1e-4)]
    db = np.array([0, 0, 1.0, 0])
    assert np.allclose(solution.forward(b=db), (moved[0] - moved[1]) / 2e-4, atol=1e-6)
    slope = RNG.normal(size=10)
    assert solution.adjoint(slope).b @ db == pytest.approx(slope @ solution.forward(b=db), rel=1e-9)


def test_equalities_with_bounds():
    sphere = majorant.Equality([[0, 1, 2]], lambda z, e: (z ** 2).sum(1) - 1)
    sphere.check_derivatives([0.3, 0.2, -0.4])
    problem = majorant.Problem(3).add(majorant.linear_term([1, 2, 3])).bound(-0.5).hold(sphere)
    solution = problem.minimize([1, 0, 0])
    assert solution.status == 'converged' and abs(np.linalg.norm(solution.x) - 1) < 1e-12
    # The corner of all three bounds is a minimum of the violation, which the run must leave.
    assert np.allclose(solution.x, [np.sqrt(0.5), -0.5, -0.5], atol=1e-6)


def test_equalities_that_nothing_meets():
    problem = majorant.Problem(1).add(majorant.penalty([[1.0]], [0]))
    problem.hold(majorant.Equality([[0]], lambda z, e: 1 + z[:, 0] ** 2, name='never'))
    solution = problem.minimize([0.3])
    assert solution.status == 'infeasible' and "'never' at unknown 0 is 1, not 0" in solution.message
    assert len(solution.iterations) < 60


def test_a_map_in_a_box():
    V, F = helpers.grid(5)
    space = majorant.Space(V, F)
    x = space.tutte()
    problem = majorant.Problem(space.size).add(space.energy(), 1 / space.area).keep_injective(space)
    free = problem.minimize(x).x.reshape(-1, 2)
    low, high = free.min(0), free.max(0)
    room = 0.3 * (high - low)
    middle = (low + high) / 2
    problem.bound(np.tile(middle - room, space.node_count), np.tile(middle + room, space.node_count))
    held = problem.minimize(((free - middle) * 0.5 + middle).ravel())
    uv = held.x.reshape(-1, 2)
    assert held.status == 'converged' and (abs(uv - middle) < room).all() and (abs(uv - middle) > 0.99 * room).any()
    corners = uv[space.cells]
    assert (np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) > 0).all()


@pytest.mark.parametrize('call, message', [
    (lambda p: majorant.least_squares(NODES, curve, loss='huber'), "loss='huber' needs a width"),
    (lambda p: majorant.least_squares(NODES, curve, width=1.0), 'width=1.0 is of a loss: huber, soft-l1, cauchy, arctan, tukey'),
    (lambda p: majorant.least_squares(NODES, curve, loss='hubert'), "loss='hubert' is none of 'huber', "),
    (lambda p: majorant.least_squares(NODES, curve, loss='l1', width=1.0), "loss='l1' is none of"),
    (lambda p: majorant.least_squares(NODES, curve, loss='huber', width=0), 'width=0 is no number above 0'),
    (lambda p: majorant.least_squares(NODES, 3), 'cannot be called'),
    (lambda p: majorant.parameter_blocks(), 'needs at least one'),
    (lambda p: majorant.parameter_blocks(([0, 1], 2), ([0], 3)), 'blocks have 2, 1 elements'),
    (lambda p: majorant.parameter_blocks(([0, 1], 0)), 'size=0 is no integer from 1'),
    (lambda p: majorant.parameter_blocks(([0.5], 2)), 'first holds floating-point numbers'),
    (lambda p: p.hold(majorant.penalty(np.eye(2), [0, 0])), 'is neither an Inequality nor an Equality'),
    (lambda p: p.hold(majorant.Inequality([[5]], curve)), 'node 0 of element 0 is 5; the problem has 2 unknowns'),
    (lambda p: p.bound(1, 1), 'lower[0] is 1.0, not below upper[0], 1.0'),
    (lambda p: p.bound([0, 1, 2]), 'lower is neither a number nor 2 numbers'),
    (lambda p: p.bound([0, np.nan]), 'lower[1] is nan'),
    (lambda p: p.bound(), 'nothing to hold'),
    (lambda p: p.bound(0).minimize([1, 1], 'lbfgs'), "bounds, inequalities and equalities are for method='newton', not 'lbfgs'"),
    (lambda p: p.minimize([1, 1], gap=1e-3), 'gap is of bounds and inequalities'),
    (lambda p: p.bound(0).minimize([1, 1], gap=0), 'gap=0 is no number above 0'),
    (lambda p: p.add(majorant.least_squares([[0, 1]], lambda z, e: np.zeros((len(z), 2, 2)))).value([1, 1]),
     "value of 'least squares' at 1 elements has shape"),
])
def test_invalid_calls_are_refused(call, message):
    with pytest.raises(majorant.UsageError) as raised:
        call(majorant.Problem(2).add(majorant.penalty(np.eye(2), [0, 0])))
    assert message in str(raised.value)


def test_exceptions_of_inequalities_are_passed_on():
    class Mine(Exception):
        pass

    def broken(z, e):
        raise Mine

    with pytest.raises(Mine):
        target_problem().hold(majorant.Inequality(PAIRS, broken, block=2)).minimize(np.zeros(6))


if __name__ == '__main__':
    helpers.main(__file__)
