#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Maps of quads and tetrahedra."""
import itertools

import helpers
import numpy as np
import pytest

import majorant


def box(*n):
    """Returns a box of unit cubes with six tetrahedra around the diagonal of each."""
    number = np.arange(np.prod(np.add(n, 1))).reshape(np.add(n, 1))
    V = np.stack(np.meshgrid(*(np.arange(k + 1.0) for k in n), indexing='ij'), -1).reshape(-1, 3)
    T = []
    for corner in itertools.product(*map(range, n)):
        for order in itertools.permutations(range(3)):
            at, cell = np.array(corner), [number[corner]]
            for axis in order:
                at[axis] += 1
                cell.append(number[tuple(at)])
            even = np.linalg.det(np.eye(3)[list(order)]) > 0
            T.append(cell if even else [cell[0], cell[2], cell[1], cell[3]])
    return V, np.array(T)


def squares(n):
    V, _ = helpers.grid(n, 0)
    k = np.arange((n + 1) ** 2).reshape(n + 1, n + 1)
    return V, np.stack([k[:-1, :-1], k[:-1, 1:], k[1:, 1:], k[1:, :-1]], -1).reshape(-1, 4)


def dirichlet(J):
    return (J ** 2).sum((1, 2)) + (np.linalg.inv(J) ** 2).sum((1, 2))


SOLID = majorant.Density('symmetric Dirichlet in space', dirichlet, barrier='strong')
BEND = np.array([[1.1, 0.2, 0], [0, 0.9, 0.1], [0.3, 0, 1]])


@pytest.mark.parametrize('degree', [1, 2, 3])
def test_tetrahedra(degree):
    V, T = box(2, 1, 1)
    space = majorant.Space(V, T, degree, cells='tetrahedra')
    assert (space.dimension, space.size) == (3, 3 * space.node_count) and space.area == pytest.approx(2)
    assert space.cells.shape == (12, (degree + 1) * (degree + 2) * (degree + 3) // 6)
    assert np.array_equal(space.input_vertices, np.arange(len(V))) and np.allclose(space.nodes[:len(V)], V)
    assert SOLID.derivatives == 'dual numbers'
    problem = majorant.Problem(space.size).add(space.energy(SOLID), 1 / space.area).keep_injective(space)
    x = space.linear(V)
    assert np.allclose(x, space.nodes.ravel()) and problem.value(x) == pytest.approx(6, rel=1e-14)
    # A linear map has the density of its matrix everywhere.
    y = space.linear(V @ BEND.T)
    assert problem.value(y) == pytest.approx(dirichlet(BEND[None])[0], rel=1e-12)
    rng = np.random.default_rng(3)
    z = x + 0.02 * rng.normal(size=space.size)
    d, h = rng.normal(size=space.size), 1e-5
    slope = (problem.value(z + h * d) - problem.value(z - h * d)) / (2 * h)
    assert problem.gradient(z) @ d == pytest.approx(slope, rel=1e-6)
    bend = (problem.gradient(z + h * d) - problem.gradient(z - h * d)) / (2 * h)
    assert np.allclose(problem.hessian(z) @ d, bend, atol=1e-6 * abs(bend).max())
    # One end is fixed, the other one is turned by 30 degrees; the start has det J > 0, and the sides are free.
    ends = np.flatnonzero(np.isin(space.nodes[:, 0], (0, 2)))
    a = np.radians(15) * space.nodes[:, 0]
    turned = np.column_stack([space.nodes[:, 0], np.cos(a) * space.nodes[:, 1] - np.sin(a) * space.nodes[:, 2],
                              np.sin(a) * space.nodes[:, 1] + np.cos(a) * space.nodes[:, 2]])
    rows = (3 * ends[:, None] + np.arange(3)).ravel()
    hold = np.zeros((len(rows), space.size))
    hold[np.arange(len(rows)), rows] = 1
    solution = problem.constrain(hold, turned.ravel()[rows]).minimize(turned.ravel())
    assert solution.status == 'converged' and 6 < solution.energy <= problem.value(problem.reduce(turned.ravel()))


def test_degrees_of_tetrahedra_lower_the_energy():
    V, T = box(2, 1, 1)
    energies = []
    for degree in (1, 2):
        space = majorant.Space(V, T, degree, cells='tetrahedra')
        ends = np.isin(space.nodes[:, 0], (0, 2))
        twist = np.where(space.nodes[:, 0] == 2, 0.4, 0)
        target = np.column_stack([space.nodes[:, 0], space.nodes[:, 1] - twist * space.nodes[:, 2],
                                  space.nodes[:, 2] + twist * space.nodes[:, 1]])
        rows = (3 * np.flatnonzero(ends)[:, None] + np.arange(3)).ravel()
        hold = np.eye(space.size)[rows]
        start = space.linear(V + np.where(V[:, :1] == 2, 0.4, 0) * np.column_stack([0 * V[:, 0], -V[:, 2], V[:, 1]]))
        problem = majorant.Problem(space.size).add(space.energy(SOLID), 1 / space.area).keep_injective(space)
        solution = problem.constrain(hold, target.ravel()[rows]).minimize(start)
        assert solution.status == 'converged'
        energies.append(solution.energy)
    assert energies[1] < energies[0] - 1e-3


@pytest.mark.parametrize('degree', [1, 2])
@pytest.mark.parametrize('energy', ['symmetric-dirichlet', 'density'])
def test_quads(degree, energy):
    V, Q = squares(3)
    energy = majorant.Density('mine', dirichlet, barrier='strong') if energy == 'density' else energy
    space = majorant.Space(V[:, :2], Q, degree, cells='quads')
    assert space.dimension == 2 and space.area == pytest.approx(1) and space.nodes.shape == (space.node_count, 2)
    assert space.cells.shape == (9, (degree + 1) ** 2)
    problem = majorant.Problem(space.size).add(space.energy(energy), 1 / space.area).keep_injective(space)
    x = space.linear(V[:, :2])
    assert problem.value(x) == pytest.approx(4, rel=1e-13)
    moved = x.reshape(-1, 2) * [1.5, 0.8]
    assert problem.value(moved.ravel()) == pytest.approx(dirichlet(np.diag([1.5, 0.8])[None])[0], rel=1e-12)
    held = majorant.Problem(space.size).add(space.energy(energy), 1 / space.area).keep_injective(space)
    solution = held.constrain(np.eye(space.size)[:2], x[:2]).minimize(moved.ravel())
    assert solution.status == 'converged' and solution.energy == pytest.approx(4, rel=1e-9)


def test_quads_of_a_surface():
    V, Q = squares(4)
    V[:, 2] = 0.3 * np.sin(3 * V[:, 0]) * np.cos(2 * V[:, 1])
    energies = []
    for degree in (1, 2):
        space = majorant.Space(V, Q, degree, cells='quads')
        problem = majorant.Problem(space.size).add(space.energy(), 1 / space.area).keep_injective(space)
        solution = problem.minimize(space.linear(V[:, :2]))
        assert solution.status == 'converged'
        energies.append(solution.energy)
    assert 4 < energies[1] < energies[0] < 4.2 and space.area > 1


@pytest.mark.parametrize('call, kind, message', [
    (lambda V, T: majorant.Space(V, T, cells='hexes'), majorant.UsageError, "cells='hexes' is none of"),
    (lambda V, T: majorant.Space(V, T, 7, cells='tetrahedra'), majorant.UsageError, 'degree=7 is no integer from 1 to 6'),
    (lambda V, T: majorant.Space(V, T[:, :3], cells='tetrahedra'), majorant.UsageError, 'F has shape (6, 3), not (n, 4)'),
    (lambda V, T: majorant.Space(V[:, :2], T, cells='tetrahedra'), majorant.UsageError, 'V has shape (8, 2), not (n, 3)'),
    (lambda V, T: majorant.Space(V, T + 1, cells='tetrahedra'), majorant.UsageError, 'but there are 8 vertices'),
    (lambda V, T: majorant.Space(V, T[:, [1, 0, 2, 3]], cells='tetrahedra'), majorant.UnsupportedError,
     'tetrahedron 0 has no positive volume'),
    (lambda V, T: majorant.Space(V, T, cells='tetrahedra').tutte(), majorant.UsageError, 'tutte is of triangles'),
    (lambda V, T: majorant.Space(V, T, cells='tetrahedra').linear(V[:, :2]), majorant.UsageError, 'not (n, 3)'),
    (lambda V, T: majorant.Space(V, T, cells='tetrahedra').energy('arap'), majorant.UsageError, 'give a Density'),
    (lambda V, T: majorant.Space(V, T, cells='tetrahedra').energy(SOLID, 4), majorant.UsageError,
     'quadrature is of triangles'),
])
def test_invalid_calls_are_refused(call, kind, message):
    with pytest.raises(kind) as raised:
        call(*box(1, 1, 1))
    assert message in str(raised.value)


def test_a_formula_of_one_dimension():
    """The source of its derivatives is known before its use, for matrices of any size."""
    for k in (4, 9):
        density = majorant.Density('x', lambda J: (J.reshape(-1, k) ** 2).sum(1))
        assert density.derivatives == 'dual numbers'
    assert majorant.Density('x', lambda J: J[:, 2, 2] ** 2).derivatives == 'dual numbers'


if __name__ == '__main__':
    helpers.main(__file__)
