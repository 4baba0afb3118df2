#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Wrong calls of equalities, inequalities, manifolds and elements of any size: each raises one line that
names what is wrong, or ends with a status that does."""
import helpers
import numpy as np
import pytest

import majorant

NAN, INF = np.nan, np.inf


def circle(z, e):
    return (z ** 2).sum(1) - 1


def free(n=2):
    return majorant.Problem(n).add(majorant.penalty(np.eye(n), np.zeros(n)))


def equality(value=circle, derivatives=None, nodes=((0, 1),), **options):
    return majorant.Equality(nodes, value, derivatives, **options)


def held(*arguments, start=(1, 1), **options):
    return free().hold(equality(*arguments, **options)).minimize(start)


def on(nodes, kind='sphere', n=9, **options):
    return free(n).on_manifold(nodes, kind, **options)


def lists(value=circle, derivatives=None, nodes=((0,), (0, 1)), **options):
    return majorant.element_term(nodes, value, derivatives, **options)


def exact(z, e):
    return 2 * z, np.broadcast_to(2 * np.eye(z.shape[1]), (*z.shape, z.shape[1]))


def scaled(z, e, d):
    return circle(z, e) * d[e]


def with_data(data=(1.0, 2.0)):
    term = lists(scaled, data=data)
    return majorant.Problem(2).add(term), term


USAGE = [
    # what functions return
    (lambda: held(lambda z, e: circle(z, e)[:, None]), 'return one number for each element'),
    (lambda: held(lambda z, e: 0.0), "value of 'equality' at 1 elements has shape ()"),
    (lambda: held(lambda z, e: None), 'has shape () and type object'),
    (lambda: held(lambda z, e: ['a']), 'has shape (1,) and type <U1, not shape (1,) of numbers'),
    (lambda: held(lambda z, e: circle(z, e) + 0j), 'type complex128, not shape (1,) of numbers'),
    (lambda: held(lambda z, e: circle(z, e) > 0), 'type bool, not shape (1,) of numbers'),
    (lambda: held(lambda z, e: [[1], [1, 2]]), "value of 'equality' is no array: its rows have different lengths"),
    (lambda: held(circle, lambda z, e: 2 * z), "derivatives of 'equality' returned ndarray, not (gradient, Hessian)"),
    (lambda: held(circle, lambda z, e: (2 * z[:, :1], exact(z, e)[1])), "gradient of 'equality' at 1 elements has shape (1, 1)"),
    (lambda: held(circle, lambda z, e: (2 * z, np.eye(2))), "Hessian of 'equality' at 1 elements has shape (2, 2)"),
    (lambda: held(circle, lambda z, e: (2 * z, exact(z, e)[1] + [[0, 1], [0, 0]])), "Hessian of 'equality' at element 0 is not symmetric"),
    (lambda: free().hold(majorant.Inequality([[0], [0, 1]], lambda z, e: z)).minimize([1, 1]), "value of 'inequality' at 1 elements has shape (1, 1)"),
    (lambda: majorant.Problem(2).add(lists(circle, lambda z, e: (np.zeros((len(z), 2)), np.zeros((len(z), 2, 2))))).gradient([1, 1]),
     'has shape (1, 2) and type float64, not shape (1, 1)'),
    (lambda: majorant.Problem(2).add(majorant.least_squares([[0], [0, 1]], lambda z, e: np.zeros((len(z), 1, 1)))).value([1, 1]),
     'return one number for each element, or a row of them'),
    # functions
    (lambda: equality(3), '3 cannot be called: a function in numpy is needed'),
    (lambda: equality(lambda z: z[:, 0]), 'does not take the arguments z, e: too many positional arguments'),
    (lambda: equality(circle, lambda z, e, more: None), "does not take the arguments z, e: missing a required argument: 'more'"),
    (lambda: lists(circle, data=[1.0, 2.0]), 'does not take the arguments z, e, data'),
    (lambda: lists(lambda z, e, d: circle(z, e)), "missing a required argument: 'd'"),
    (lambda: equality(name=None), 'name=None is no name'),
    (lambda: lists(name=''), "name='' is no name"),
    # nodes
    (lambda: equality(nodes=[0, 1]), 'nodes has shape (2,), not (#elements, nodes of each): one row an element'),
    (lambda: equality(nodes=[]), 'nodes is empty: a term has one element or more'),
    (lambda: equality(nodes=[[]]), 'nodes[0] is empty'),
    (lambda: equality(nodes=[[0.0, 1]]), 'nodes holds floating-point numbers, not integers'),
    (lambda: equality(nodes=[[True, False]]), 'nodes holds truth values, not integers'),
    (lambda: equality(nodes=[[0, -1]]), 'nodes[0, 1] is -1, but nodes are counted from 0'),
    (lambda: equality(nodes=[[2**40]]), 'nodes are counted from 0 to 2147483646'),
    (lambda: equality(nodes=None), 'nodes is a NoneType, neither an array'),
    (lambda: equality(nodes=3), 'nodes is a int, neither an array'),
    (lambda: lists(nodes='abc'), 'nodes is a str, neither an array'),
    (lambda: lists(nodes={0: [1]}), 'nodes is a dict, neither an array'),
    (lambda: lists(nodes={(0,), (0, 1)}), 'nodes is a set, neither an array'),
    (lambda: lists(nodes=([k] for k in range(3))), 'nodes is a generator, neither an array'),
    (lambda: lists(nodes=[[0], [1j, 0]]), 'nodes[1] holds complex numbers, not integers'),
    (lambda: lists(nodes=[[[0]], [[0], [1]]]), 'nodes[0] has shape (1, 1), not (n,)'),
    (lambda: lists(nodes=[[0], [2**31, 1]]), 'nodes[1][0] is 2147483648'),
    (lambda: free().hold(equality(nodes=[[2**31 - 2]], block=3)), 'the problem has 2 unknowns'),
    (lambda: held(nodes=[[0, 2]]), 'equality: node 1 of element 0 is 2; the problem has 2 unknowns'),
    (lambda: equality(block=0), 'block=0 is no integer from 1 to 64'),
    (lambda: equality(block=2.0), 'block=2.0 is no integer'),
    (lambda: equality().check_derivatives([NAN, 1]), 'x[0] is nan; all numbers must be finite'),
    (lambda: equality().check_derivatives([1]), 'x has 1 numbers, equality takes 2'),
    # data
    (lambda: lists(scaled, data=np.ones((3, 1))), 'data has shape (3, 1), not (2, n)'),
    (lambda: lists(scaled, data=[[1], [1, 2]]), 'data is no array: its rows have different lengths'),
    (lambda: with_data([NAN, 1]), 'data[0] is nan; all numbers must be finite'),
    (lambda: (lambda p, t: p.update(t, data=[1.0]))(*with_data()), 'data has shape (1,), not (2,)'),
    (lambda: (lambda p, t: p.update(t, data=[INF, 1]))(*with_data()), 'data[0] is inf'),
    # what is held, and how it is solved
    (lambda: free().hold(circle), 'is neither an Inequality nor an Equality'),
    (lambda: free().hold(majorant.Equality), 'is neither an Inequality nor an Equality'),
    (lambda: free().add(equality()), 'is no Term'),
    (lambda: free().hold(equality()).update(equality()), 'is no Term'),
    (lambda: held(start=[NAN, 1]), 'x0[0] is nan'),
    (lambda: held(start=[1j, 1]), 'x0 holds complex numbers'),
    (lambda: held(start=[[1, 1]]), 'x0 has shape (1, 2), not (2,)'),
    (lambda: held(start=[[1], [1, 2]]), 'x0 is no array: its rows have different lengths'),
    (lambda: free().hold(equality()).minimize([1, 1], 'levenberg-marquardt'), "for method='newton', not 'levenberg-marquardt'"),
    (lambda: free().hold(equality()).minimize([1, 1], saddles_to_leave=2), "saddles_to_leave is of method='newton' without"),
    (lambda: free().hold(equality()).minimize([1, 1], gap=1e-3), 'gap is of bounds and inequalities'),
    (lambda: free().hold(equality()).minimize([1, 1], callback=3), 'callback=3 cannot be called'),
    # manifolds
    (lambda: on([[0, 1, 2], [3, 4]]), 'nodes is no array: its rows have different lengths'),
    (lambda: on([]), 'nodes is empty: put one point or more on a sphere'),
    (lambda: on([[]]), 'nodes is empty'),
    (lambda: on([[[0, 1]]]), 'nodes has shape (1, 1, 2), not (#points,) or (#points, nodes of each)'),
    (lambda: on(1, block=2), 'nodes has shape (), not (#points,)'),
    (lambda: on('ab', block=2), 'nodes holds text, not numbers'),
    (lambda: on([[0.0, 1]]), 'nodes holds floating-point numbers, not integers'),
    (lambda: on([[0, -1]]), 'nodes[0, 1] is -1, but there are 9 nodes, from 0'),
    (lambda: on([3], block=3), 'is 3, but there are 3 nodes of 3 unknowns, from 0'),
    (lambda: on([3], block=0), 'block=0 is no integer'),
    (lambda: on([[0, 1]], None), "kind=None is none of 'sphere'"),
    (lambda: on([[0, 0, 1]]), 'unknown 0 lies on two manifolds, or twice on one'),
    (lambda: on([[0, 1, 2], [2, 3, 4]]), 'unknown 2 lies on two manifolds, or twice on one'),
    (lambda: on([[0, 1, 2]], 'unit-complex'), 'a point of 3 numbers is on no unit-complex: 2 are needed'),
    (lambda: on([[0, 1, 2]]).minimize([NAN] * 9), 'x0[0] is nan'),
    (lambda: on([[0, 1, 2]]).minimize(np.zeros(9)), 'has no nearest one on the sphere; start elsewhere'),
    (lambda: on([list(range(9))], 'rotation').minimize(np.zeros(9)), 'has no nearest one on the rotation; start elsewhere'),
    (lambda: on([list(range(9))], 'rotation').minimize(-np.eye(3).ravel()), 'has no nearest one on the rotation'),
    (lambda: on([[0, 1, 2]]).minimize(np.ones(9), saddles_to_leave=1), 'without saddles_to_leave'),
    (lambda: on([[0, 1, 2]]).minimize(np.ones(9), gap=1e-3), 'gap is of bounds and inequalities'),
    (lambda: on([[0, 1, 2]]).hold(equality()).minimize(np.ones(9), 'lbfgs'), "bounds, inequalities and equalities are for method='newton'"),
    (lambda: on([[0, 1, 2]]).bound(0, 1).minimize(np.zeros(9)), 'has no nearest one on the sphere; start elsewhere'),
    (lambda: majorant.Problem(2).on_manifold([[0, 1]], 'sphere').minimize([1, 0]), 'the problem has no terms'),
]


@pytest.mark.parametrize('call, message', USAGE, ids=[str(k) + ' ' + m for k, (_, m) in enumerate(USAGE)])
def test_errors_name_the_defect(call, message):
    with pytest.raises(majorant.UsageError) as raised:
        call()
    assert message in str(raised.value) and '\n' not in str(raised.value)


UNSUPPORTED = [
    (lambda: on([[0, 1, 2]]).constrain([[1] * 9], [1]).minimize(np.ones(9)), 'holds unknown 0, which lies on a sphere'),
    (lambda: majorant.compare(on([[0, 1, 2]]).hold(equality()), np.ones(9)), 'are for minimize() alone'),
    (lambda: majorant.Problem(2).add(majorant.least_squares([[0, 1]], lambda z, e: z - 2)).on_manifold([[0, 1]], 'sphere')
     .minimize([1, 0]).covariance([0]), 'solutions on manifolds have no covariance here'),
    (lambda: held().covariance([0]), 'covariance'),
]


@pytest.mark.parametrize('call, message', UNSUPPORTED)
def test_missing_names_are_listed(call, message):
    with pytest.raises(majorant.UnsupportedError) as raised:
        call()
    assert message in str(raised.value) and '\n' not in str(raised.value)


INFEASIBLE = [
    (lambda: held(lambda z, e: NAN * circle(z, e)), "value is inf in element 0 of term 'equality'"),
    (lambda: held(circle, lambda z, e: (NAN * z, exact(z, e)[1])), 'or its derivatives are not finite at the start'),
    (lambda: held(lambda z, e: 0 * z[:, 0] + 1), "'equality' at element 0, which begins with unknown 0 is 1, not 0"),
    (lambda: free().hold(equality()).hold(equality(lambda z, e: circle(z, e) - 3)).minimize([1, 0.5]), "'equality' at element 0"),
    (lambda: free().constrain(np.eye(2), [3, 3]).hold(equality()).minimize([3, 3]), 'is 17, not 0'),
    (lambda: free().hold(majorant.Inequality([[0], [0, 1]], lambda z, e: np.log(z[:, 0]))).minimize([-1, 1]), "term 'inequality'"),
    (lambda: majorant.Problem(2).on_manifold([[0, 1]], 'sphere').add(lists(lambda z, e: np.log(-1 - z[:, 0] ** 2))).minimize([1, 0]),
     'lies outside'),
]


@pytest.mark.parametrize('call, message', INFEASIBLE)
def test_ends_with_a_reason(call, message):
    solution = call()
    assert solution.status == 'infeasible' and message in solution.message and '\n' not in solution.message
    assert np.isfinite(solution.x).all()


@pytest.mark.parametrize('hold', [
    lambda p, f: p.hold(equality(f)), lambda p, f: p.add(lists(f)),
    lambda p, f: p.add(lists(f)).on_manifold([[0, 1]], 'sphere')])
def test_exceptions_of_functions_are_passed_on(hold):
    def wrong(z, e):
        raise ZeroDivisionError('mine')

    with pytest.raises(ZeroDivisionError, match='mine'):
        hold(free(), wrong).minimize([1, 1])


def test_points_are_read_only():
    def writes(z, e):
        z[:] = 5
        return z[:, 0]

    with pytest.raises(ValueError, match='read-only'):
        free().add(lists(writes)).gradient([1, 1])


@pytest.mark.parametrize('nodes', [
    np.array([[0, 1], [1, 2]], dtype=np.uint8), np.array([[0, 1], [1, 2]], dtype='>i4'),
    np.array([[0, 9, 1, 9], [1, 9, 2, 9]])[:, ::2], np.asfortranarray([[0, 1], [1, 2]]), ((0, 1), (1, 2)),
    [np.array([0, 1]), (1, 2)]])
def test_any_layout_of_the_same_nodes(nodes):
    x = np.array([1.0, 2, 4])
    assert majorant.Problem(3).add(lists(nodes=nodes)).value(x) == 23


if __name__ == '__main__':
    helpers.main(__file__)
