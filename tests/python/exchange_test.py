#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Maps in matplotlib, and from and to meshes of meshio and trimesh."""
import re
import sys
import types

import helpers
import numpy as np
import pytest

import majorant

V, F = helpers.grid(5)


@pytest.fixture(scope='module')
def plt():
    matplotlib = pytest.importorskip('matplotlib')
    matplotlib.use('Agg')
    import matplotlib.pyplot as plt
    return plt


def lengths(curves):
    return np.linalg.norm(np.diff(curves, axis=-2), axis=-1).sum(-1)


@pytest.mark.parametrize('degree', [1, 3])
def test_a_plot_has_faces_and_the_boundary(plt, degree):
    r = majorant.parametrize(V, F, degree=degree)
    figure, ax = plt.subplots()
    assert r.plot(ax) is ax
    faces, boundary = ax.collections
    assert np.allclose(faces.get_array(), r.distortion) and boundary.get_label() == 'boundary'
    paths = faces.get_paths()
    # The outline is one closed line with round corners and this width, without gaps between pieces.
    outline, = boundary.get_segments()
    assert len(paths) == len(F) and len(outline) == 20 * (1 if degree == 1 else 12) + 1
    assert np.array_equal(outline[0], outline[-1]) and boundary.get_joinstyle() == 'round'
    assert boundary.get_linewidth() == 1 and faces.get_linewidth() == 0.3
    # The outline of a face passes through its corners, and along its curved edges.
    assert np.allclose(paths[7].vertices[0], r.corner_uv[7, 0])
    sides = [np.abs(paths[7].vertices - r.evaluate(7, b)).max(1).min() for b in ([0.5, 0.5, 0], [0, 0.5, 0.5])]
    straight = np.abs(r.evaluate(7, [0.5, 0.5, 0]) - r.corner_uv[7, :2].mean(0)).max()
    assert len(paths[7].vertices) == (4 if degree == 1 else 37)
    assert (max(sides) < 1e-12 and straight > 1e-6) if degree == 3 else straight < 1e-12
    figure.canvas.draw()
    low, high = ax.dataLim.min, ax.dataLim.max
    assert np.allclose(low, r.uv.min(0), atol=0.05) and np.allclose(high, r.uv.max(0), atol=0.05)
    r.plot(ax, np.arange(len(F)), cmap='magma')
    assert ax.collections[2].get_array()[3] == 3 and ax.collections[2].get_cmap().name == 'magma'
    r.plot(ax, vmin=4, vmax=6, edges=False, linewidth=0.1)
    assert ax.collections[4].get_clim() == (4, 6)
    assert [ax.collections[k].get_linewidth() for k in (4, 5)] == [0.1, 0.1]
    with pytest.raises(majorant.UsageError, match=r'values has shape \(3,\), not \(50,\)'):
        r.plot(ax, [1, 2, 3])


def rgb(text):
    return [int(text[k:k + 2], 16) for k in (1, 3, 5)]


def test_a_plot_has_the_colours_of_drawings(plt):
    r = majorant.parametrize(*helpers.grid(6, 0.8), degree=1)
    ax = r.plot(plt.figure().gca(), align=True)
    faces = ax.collections[0]
    faces.update_scalarmappable()
    shown = np.round(255 * faces.get_facecolors()[:, :3])
    drawn = {tuple(rgb(c)) for c in re.findall(r'<path fill="(#[0-9a-f]{6})" stroke', r.svg('density'))}
    assert len(drawn) > 5
    for color in shown:  # at most 1/256 of the scale
        assert np.abs(np.array(list(drawn)) - color).max(1).min() <= 3
    assert faces.norm.inverse(faces.norm(7.0)) == pytest.approx(7)
    low, high = ax.dataLim.min, ax.dataLim.max
    assert (high - low)[0] >= (high - low)[1]


def test_a_plot_shows_inverted_triangles(plt, tmp_path):
    uv = V[:, :2].copy()
    uv[7] += 0.9, 0
    lines = [f'v {x} {y} {z}' for x, y, z in V] + [f'vt {u} {v}' for u, v in uv]
    lines += ['f ' + ' '.join(f'{k}/{k}' for k in face + 1) for face in F]
    (tmp_path / 'own.obj').write_text('\n'.join(lines))
    ax = majorant.read(tmp_path / 'own.obj').plot(plt.figure().gca())
    over = ax.collections[1]
    assert over.get_label() == '2 triangles turned over'
    assert np.allclose(255 * over.get_facecolor()[0, :3], (214, 0, 190))


def test_a_plot_has_seams_and_charts(plt):
    r = majorant.unwrap(*helpers.torus(), seams='sharp=10')
    assert len(np.unique(r.charts)) > 1
    ax = r.plot(plt.figure().gca())
    faces, seams = ax.collections
    assert seams.get_label() == 'seams' and len(seams.get_segments()) == len(np.unique(r.charts))
    colors = faces.get_facecolor()
    assert len(np.unique(colors, axis=0)) == min(12, len(np.unique(r.charts)))
    assert (colors[r.charts == 0] == colors[r.charts == 0][0]).all()
    assert r.plot() is plt.gca()


def test_without_matplotlib(monkeypatch):
    monkeypatch.setitem(sys.modules, 'matplotlib.pyplot', None)
    with pytest.raises(majorant.UsageError, match='plot needs matplotlib'):
        majorant.parametrize(V, F, degree=1).plot()


@pytest.mark.parametrize('degree', [1, 2, 3, 4])
def test_to_meshio_and_back(tmp_path, degree):
    meshio = pytest.importorskip('meshio')
    r = majorant.parametrize(V, F, degree=degree)
    mesh = r.to_meshio()
    block, = mesh.cells
    assert block.type == {1: 'triangle', 2: 'triangle6', 3: 'triangle10', 4: 'triangle15'}[degree]
    assert np.array_equal(block.data, r.cells) and np.array_equal(mesh.points, r.nodes)
    uv = mesh.point_data['uv'][:, :2]
    assert np.allclose(uv[r.cells[:, :3]], r.corner_uv) and not mesh.point_data['uv'][:, 2].any()
    middle = uv[r.cells[:, 3]] if degree == 2 else r.evaluate(np.arange(len(F)), [0.5, 0.5, 0])
    assert np.allclose(middle, r.evaluate(np.arange(len(F)), [0.5, 0.5, 0]))
    if degree == 1:
        mesh.write(tmp_path / 'a.vtu')
        back = meshio.read(tmp_path / 'a.vtu')
        assert np.array_equal(majorant.flatten(*majorant.mesh_arrays(back)), majorant.flatten(r.nodes, r.cells))
    else:
        with pytest.raises(majorant.UnsupportedError, match='triangle'):
            majorant.mesh_arrays(mesh)


@pytest.mark.parametrize('degree', [2, 3, 5])
def test_meshio_writes_curved_triangles(tmp_path, degree):
    meshio = pytest.importorskip('meshio')
    r = majorant.parametrize(V, F, degree=degree)
    for names, name, options in (('vtk', 'a.vtu', {}), ('gmsh', 'a.msh', {'file_format': 'gmsh'})):
        r.to_meshio(names).write(tmp_path / name, **options)
        block, = meshio.read(tmp_path / name).cells
        assert np.array_equal(block.data, r.cells)
    with pytest.raises(majorant.UsageError, match='names'):
        r.to_meshio('vtu')


def test_nodes_of_meshio_are_where_the_surface_is_evaluated():
    """Values at the nodes of a Lagrange triangle of degree 3 are its polynomial."""
    r = majorant.parametrize(V, F, degree=3)
    uv = r.to_meshio().point_data['uv'][:, :2]
    cell = r.cells[11]
    corner = r.nodes[cell[:3]]
    for node, point in zip(cell, r.nodes[cell]):
        bary = np.linalg.lstsq(np.vstack([corner.T, np.ones(3)]), np.append(point, 1), rcond=None)[0]
        assert np.allclose(uv[node], r.evaluate(11, bary), atol=1e-9)


def block(kind, data):
    return types.SimpleNamespace(type=kind, data=np.array(data))


def test_meshes_by_their_attributes():
    uv = majorant.flatten(V, F)
    trimesh = types.SimpleNamespace(vertices=V, faces=F)
    meshio = types.SimpleNamespace(points=V, cells=[block('line', [[0, 1]]), block('triangle', F[:30]),
                                                    block('vertex', [[2]]), block('triangle', F[30:])])
    for mesh in (trimesh, meshio):
        assert np.array_equal(majorant.flatten(*majorant.mesh_arrays(mesh)), uv)
        assert isinstance(majorant.mesh_arrays(mesh)[1], np.ndarray)
    quads = types.SimpleNamespace(points=V, cells=[block('quad', [[0, 1, 7, 6]]), block('triangle', [[1, 2, 8], [1, 8, 7]])])
    points, faces = majorant.mesh_arrays(quads)
    assert [list(f) for f in faces] == [[0, 1, 7, 6], [1, 2, 8], [1, 8, 7]]
    assert len(majorant.parametrize(points, faces, degree=1).cells) == 4
    for wrong, kind, message in [
            (3, majorant.UsageError, 'int has neither vertices and faces nor points and cells'),
            (types.SimpleNamespace(points=V, cells=[block('line', [[0, 1]])]), majorant.UsageError, 'no faces'),
            (types.SimpleNamespace(points=V, cells=[block('tetra', [[0, 1, 2, 3]])]), majorant.UnsupportedError,
             "cells of type 'tetra' are no polygons"),
            (types.SimpleNamespace(points=V, cells=[block('quad9', [range(9)])]), majorant.UnsupportedError, 'quad9')]:
        with pytest.raises(kind, match=message):
            majorant.mesh_arrays(wrong)


def test_to_trimesh(monkeypatch):
    made = types.SimpleNamespace(Trimesh=lambda **printed: printed,
                                 visual=types.SimpleNamespace(TextureVisuals=lambda uv: uv))
    monkeypatch.setitem(sys.modules, 'trimesh', made)
    r = majorant.unwrap(*helpers.torus())
    printed = r.to_trimesh()
    assert printed['process'] is False
    assert np.array_equal(printed['visual'][printed['faces']], r.corner_uv)
    assert np.array_equal(printed['vertices'], helpers.torus()[0][r.input_vertices])
    with pytest.raises(majorant.UnsupportedError, match='straight triangles'):
        majorant.parametrize(V, F, degree=2).to_trimesh()
    monkeypatch.setitem(sys.modules, 'trimesh', None)
    with pytest.raises(majorant.UsageError, match='needs trimesh'):
        r.to_trimesh()


if __name__ == '__main__':
    helpers.main(__file__)
