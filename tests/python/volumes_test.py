#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Volume meshes as arrays: checked, optimized, written and read again."""
import helpers
import numpy as np
import pytest

import majorant

ORDERS = ((0, 1, 2), (1, 2, 0), (2, 0, 1), (1, 0, 2), (2, 1, 0), (0, 2, 1))


def cube(n):
    """Returns points and cells of n^3 cubes of six tetrahedra."""
    grid = np.array([(i, j, k) for k in range(n + 1) for j in range(n + 1) for i in range(n + 1)], float)
    number = {tuple(p): v for v, p in enumerate(grid.astype(int))}
    cells = []
    for corner in np.ndindex(n, n, n):
        for t, order in enumerate(ORDERS):
            at, cell = list(corner), [number[corner]]
            for axis in order:
                at[axis] += 1
                cell.append(number[tuple(at)])
            cells.append([cell[0], cell[2], cell[1], cell[3]] if t >= 3 else cell)
    return grid, np.array(cells)


def tangled(n=3):
    X, T = cube(n)
    inside = (X.min(axis=1) > 0) & (X.max(axis=1) < n)
    X[inside] += np.where(X[inside] % 2 == 0, 1.3, -0.8)
    return X, T, inside


def test_checked():
    X, T = cube(2)
    mesh = majorant.VolumeMesh(X, {'tetrahedra': T})
    found = mesh.check()
    assert (found['status'], found['checked'], found['invalid']) == ('valid', 48, 0)
    assert repr(mesh) == '<majorant.VolumeMesh: 27 points, 48 tetrahedra of degree 1>'
    kind, degree, nodes, numbers, regions = mesh.blocks[0]
    assert (kind, degree) == ('tetrahedra', 1)
    assert (nodes == T).all() and (numbers == np.arange(48)).all() and not regions.any()
    with pytest.raises(ValueError):
        mesh.points[0] = 1
    turned = majorant.VolumeMesh(X, {'tetrahedra': T[:, [1, 0, 2, 3]]}).check()
    assert (turned['status'], turned['inverted']) == ('invalid', 48)


def test_optimized(tmp_path):
    X, T, inside = tangled()
    mesh = majorant.VolumeMesh(X, {'tetrahedra': T})
    assert mesh.check()['invalid'] > 0
    steps = []
    better, report = majorant.optimize(mesh, callback=lambda step: steps.append(step.energy) and None)
    assert better.check()['status'] == 'valid'
    assert (better.points[~inside] == X[~inside]).all()
    assert report['status'] == 'converged' and report['result']['mesh']['moved_nodes'] == inside.sum()
    assert len(steps) == len(report['iterations'])
    better.save(tmp_path / 'a.msh', binary=True)
    again = majorant.VolumeMesh.read(tmp_path / 'a.msh')
    assert (again.points == better.points).all() and (again.blocks[0][2] == T).all()
    again.save(tmp_path / 'b.msh', msh_version='2.2')
    assert (majorant.VolumeMesh.read(tmp_path / 'b.msh').points == better.points).all()
    helpers.command('mesh', 'check', tmp_path / 'b.msh')


def test_saved_by_the_name(tmp_path):
    """The extension decides the format, with the same points; losses are reported."""
    X, T = cube(2)
    mesh = majorant.VolumeMesh(X + 0.1, {'tetrahedra': T})
    mesh.save(tmp_path / 'a.vtu')
    assert (tmp_path / 'a.vtu').read_text().startswith('<?xml')
    with pytest.warns(UserWarning, match='beside nodes, elements'):
        majorant.VolumeMesh.read(tmp_path / 'a.vtu').save(tmp_path / 'b.msh', msh_version='2.2', binary=True)
    back = majorant.VolumeMesh.read(tmp_path / 'b.msh')
    assert (back.points == mesh.points).all() and (back.blocks[0][2] == T).all()
    for name, words, says in (('c.mesh', {}, '.msh or .vtu'), ('c.msh.gz', {}, '.gz'), ('c.obj', {}, '.msh or .vtu'),
                              ('c.vtu', {'binary': True}, 'of .msh')):
        with pytest.raises(majorant.UsageError, match=says):
            back.save(tmp_path / name, **words)
        assert not (tmp_path / name).exists()


def test_curved_and_planar():
    X = np.array([[0, 0], [2, 0], [0, 2], [1, 0], [1, 1], [0, 1]], float)
    planar = majorant.VolumeMesh(X, {'triangles': [[0, 1, 2, 3, 4, 5]]})
    assert planar.blocks[0][1] == 2 and planar.check()['status'] == 'valid'
    free, _ = majorant.optimize(planar, boundary='free')
    assert (free.points == planar.points).all()  # all elements are valid
    clockwise = majorant.VolumeMesh(X, {'triangles': [[0, 2, 1, 5, 4, 3]]})
    turned, report = majorant.optimize(clockwise)
    assert report['input']['turned'] == 1 and (turned.blocks[0][2] == planar.blocks[0][2]).all()
    assert turned.check()['status'] == 'valid'


def test_impossible():
    X, T = cube(2)
    X[2] = 1.4, 0.8, 0.2  # moves a corner through the opposite side of its cell, which has four boundary points
    with pytest.raises(majorant.InvalidError, match='cannot be valid whatever moves.*elements'):
        majorant.optimize(majorant.VolumeMesh(X, {'tetrahedra': T}))


@pytest.mark.parametrize('call, says', [
    (lambda X, T, m: majorant.VolumeMesh(X, {'pyramids': T}), 'kinds are'),
    (lambda X, T, m: majorant.VolumeMesh(X, {'tetrahedra': T[:, :3]}), '3 columns; 4, 10, 20, 35'),
    (lambda X, T, m: majorant.VolumeMesh(X, {'tetrahedra': T + 100}), 'rows of X'),
    (lambda X, T, m: majorant.VolumeMesh(X * np.nan, {'tetrahedra': T}), 'finite'),
    (lambda X, T, m: majorant.VolumeMesh(X, {}), 'no cells'),
    (lambda X, T, m: m.with_points(X[1:]), 'X'),
    (lambda X, T, m: m.save('a.msh', msh_version='4.0'), 'msh_version'),
    (lambda X, T, m: majorant.optimize(X), 'no VolumeMesh'),
    (lambda X, T, m: majorant.optimize(m, 'mipps'), "did you mean 'mips'"),
    (lambda X, T, m: majorant.optimize(m, 'asap'), 'no energy of volumes'),
    (lambda X, T, m: majorant.optimize(m, target='size'), 'go together'),
    (lambda X, T, m: majorant.optimize(m, target='size', sizes=[1, 2]), '2 sizes for 48'),
    (lambda X, T, m: majorant.optimize(m, boundary='slid'), 'boundary'),
    (lambda X, T, m: majorant.optimize(m, max_iterations=-1), 'max_iterations'),
])
def test_wrong_arguments(call, says):
    X, T = cube(2)
    with pytest.raises(majorant.UsageError, match=says):
        call(X, T, majorant.VolumeMesh(X, {'tetrahedra': T}))


if __name__ == '__main__':
    helpers.main(__file__)
