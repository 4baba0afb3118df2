#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""majorant.compare: rows, files, problems of every kind, and all notes, each provoked once."""
import csv
import time

import helpers
import numpy as np
import pytest

import majorant

N = 12
EDGES = np.stack([np.arange(N - 1), np.arange(1, N)], axis=1)


def springs(ends=True):
    def value(z, e):
        d = ((z[:, 2:] - z[:, :2]) ** 2).sum(1)
        return d + 0.01 / d + 0.1 * (z[:, 1] + z[:, 3])

    problem = majorant.Problem(2 * N).add(majorant.element_term(EDGES, value, block=2))
    A = np.zeros((4, 2 * N))
    A[range(4), [0, 1, 2 * N - 2, 2 * N - 1]] = 1
    return problem.constrain(A, [0, 0, 3, 0]) if ends else problem


def line():
    x = np.stack([np.linspace(0, 3, N), np.zeros(N)], axis=1)
    x[3, 1] = 0.2
    return x.ravel()


def notes(table):
    return table.notes + [note for row in table for note in row.notes]


def test_rows_print_and_iterate(tmp_path):
    table = majorant.compare(springs(), line(), max_iterations=300)
    names = [row.method for row in table]
    assert len(names) == len(set(names)) == len(table) > 15
    text = str(table)
    for row in table:
        assert row.method in text
        if row.status == 'not_applicable':
            assert row.message and row.iterations == 0 and np.isnan(row.energy) and len(row.x) == 0
            continue
        assert len(row.points['energy']) == row.iterations + 1
        if row.method == 'gradient-flow':  # the metric at the start is a poor approximation
            assert row.status == 'max_iterations' and row.iterations == 300 and 'gradient' in row.notes[0]
            continue
        assert row.status == 'converged' and row.notes == [], row
        assert row.energy == pytest.approx(table['newton'].energy, rel=1e-6)
        assert row.definite == 'yes' and row.distance < 1e-2 and row.gradient_norm < 1e-3
        assert row.x[-2:] == pytest.approx([3, 0]) and row.seconds > 0
        if row.method.startswith('ceres'):
            assert np.isnan(list(row.seconds_by_part.values())).all()
        else:
            assert row.factorizations > 0 and sum(row.seconds_by_part.values()) <= row.seconds
    assert [table[k].method for k in range(len(table))] == names
    assert table.notes == []
    assert table['newton'].iterations == len(springs().minimize(line()).iterations)
    assert table['levenberg-marquardt'].status == 'not_applicable'
    assert ('squares' if helpers.HAS_GPL_PARTS else 'not in this program') in table['ceres-lm'].message
    assert 'PETSc' in table['newton-mumps'].message
    assert table['newton-cholmod'].status == ('converged' if helpers.HAS_GPL_PARTS else 'not_applicable')

    table.to_csv(tmp_path / 'rows.csv')
    table.to_csv(tmp_path / 'points.csv', points=True)
    table.page(tmp_path / 'page.html')
    with open(tmp_path / 'rows.csv', newline='') as file:
        rows = list(csv.DictReader(file))
    assert [row['method'] for row in rows] == names
    assert float(rows[0]['energy']) == table[0].energy and int(rows[0]['factorizations']) == table[0].factorizations
    with open(tmp_path / 'points.csv', newline='') as file:
        points = [row for row in csv.DictReader(file) if row['method'] == 'lbfgs']
    assert [float(p['energy']) for p in points] == list(table['lbfgs'].points['energy'])
    page = (tmp_path / 'page.html').read_text()
    assert page.startswith('<!DOCTYPE html>') and 'min det' not in page
    for name in names:
        assert name in page and name in table._repr_html_()


def test_chosen_methods_and_wrong_arguments():
    table = majorant.compare(springs(), line(), ['lbfgs', 'newton'], max_iterations=2, title='springs')
    assert [row.method for row in table] == ['lbfgs', 'newton']
    assert [row.status for row in table] == ['max_iterations'] * 2
    with pytest.raises(KeyError):
        table['ceres-lm']
    with pytest.raises(majorant.UsageError, match="'newtn'.*newton-absolute.*'lbfgs'"):
        majorant.compare(springs(), line(), ['newton', 'newtn'])
    for wrong in (dict(methods='newton'), dict(methods=5), dict(methods=[]), dict(time_limit=-1),
                  dict(max_iterations=1.5), dict(tolerance=float('nan'))):
        with pytest.raises(majorant.UsageError):
            majorant.compare(springs(), line(), **wrong)
    with pytest.raises(majorant.UsageError):
        majorant.compare(springs(), line()[1:])
    with pytest.raises(majorant.UsageError):
        majorant.compare('springs', line())


def test_least_squares_bounds_equalities_manifolds():
    t = np.linspace(0, 1, 30)
    fit = majorant.least_squares(np.tile([0, 1], (30, 1)),
                                 lambda z, e: z[:, 0] * np.exp(z[:, 1] * t[e]) - 2 * np.exp(-1.5 * t[e]))
    table = majorant.compare(majorant.Problem(2).add(fit), [1, 0])
    for name in ('newton', 'levenberg-marquardt', *(('ceres-lm', 'ceres-dogleg') if helpers.HAS_GPL_PARTS else ())):
        assert table[name].status == 'converged' and abs(table[name].x - [2, -1.5]).max() < 1e-4, name

    table = majorant.compare(springs().bound(lower=-0.02), line())
    assert table['newton-exact'].x.min() == pytest.approx(-0.02, abs=1e-4)
    assert table['newton'].energy == pytest.approx(table['newton-absolute'].energy, rel=1e-6)
    assert 'bounds' in table['lbfgs'].message

    circle = majorant.Equality([[5]], lambda z, e: (z ** 2).sum(1) - 1, block=2)
    table = majorant.compare(springs().hold(circle), line())
    assert table['newton'].status == 'converged' and np.linalg.norm(table['newton'].x[10:12]) == pytest.approx(1)

    form = majorant.element_term([[0, 1, 2]], lambda z, e: z[:, 0] ** 2 + 2 * z[:, 1] ** 2 + 3 * z[:, 2] ** 2)
    problem = majorant.Problem(3).add(form).on_manifold([[0, 1, 2]], 'sphere')
    table = majorant.compare(problem, [1, 0.5, 0.5])
    assert table['newton'].energy == pytest.approx(1) and 'manifolds' in table['lbfgs'].message

    V, F = majorant.read_mesh(str(helpers.SOURCE / 'examples/meshes/cap.obj'))
    space = majorant.Space(V, F)
    problem = majorant.Problem(space.size).add(space.energy(), 1 / space.area).keep_injective(space)
    table = majorant.compare(problem.constrain(np.eye(space.size)[:4], space.tutte()[:4]), space.tutte())
    assert table['newton-reweighted'].status == 'converged' and table['newton-majorizer'].status == 'converged'


def test_notes():
    def compared(problem, x0, methods=('newton', 'lbfgs')):
        return notes(majorant.compare(problem, x0, methods))

    def well(gradient):
        value = lambda z, e: (z[:, 0] ** 2 - 1) ** 2
        def derivatives(z, e):
            return gradient * 4 * z * (z ** 2 - 1), (12 * z ** 2 - 4)[:, :, None]
        return majorant.Problem(1).add(majorant.element_term([[0]], value, derivatives))

    assert [note for note in compared(well(1.5), [1.2]) if 'gradient of term' in note and 'at the start' in note]
    assert compared(well(1), [1.2]) == []

    saddle = majorant.element_term([[0, 1]], lambda z, e: z[:, 0] ** 2 - z[:, 1] ** 2 + z[:, 1] ** 4)
    assert len([note for note in compared(majorant.Problem(2).add(saddle), [1, 0]) if 'indefinite' in note]) == 2
    assert compared(majorant.Problem(2).add(saddle), [1, 0.5]) == []


def test_limits_and_exceptions():
    def slow(z, e):
        time.sleep(0.005)
        return z[:, 0] ** 4 + z[:, 0]

    table = majorant.compare(majorant.Problem(1).add(majorant.element_term([[0]], slow)), [1e6], time_limit=0.05)
    assert {row.status for row in table if row.status != 'not_applicable'} == {'time_limit'}

    def broken(z, e):
        raise ZeroDivisionError('mine')

    with pytest.raises(ZeroDivisionError, match='mine'):
        majorant.compare(majorant.Problem(1).add(majorant.element_term([[0]], broken)), [1])


if __name__ == '__main__':
    helpers.main(__file__)
