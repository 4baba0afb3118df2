#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""majorant.xatlas: the properties that programs of the package xatlas use."""
import math
import os
import signal
import threading
import time
import warnings

import helpers
import numpy as np
import pytest

import majorant
import majorant.xatlas as xatlas


def sound(V, F, result, area=True):
    """Tests types, shapes, order of faces, and range; faces with an area have one in the plane."""
    vmapping, indices, uvs = result
    assert vmapping.dtype == indices.dtype == np.uint32 and uvs.dtype == np.float32
    assert vmapping.shape == (len(uvs),) and uvs.shape == (len(uvs), 2) and indices.shape == np.shape(F)
    assert (vmapping[indices] == F).all()
    assert uvs.min() >= 0 and uvs.max() <= 1
    p = uvs[indices].astype(np.float64)
    a, b = p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]
    images = np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
    if area:
        assert (images > 0).all()
    return images


def written(tmp_path, V, F, result):
    """Writes the layout, which the command judges as a file by another program."""
    vmapping, indices, uvs = result
    xatlas.export(tmp_path / 'out.obj', np.asarray(V)[vmapping], indices, uvs)
    return helpers.command('check', tmp_path / 'out.obj', '--cuts', 'free').stdout


class Tracked(np.ndarray):
    """Arrays that record changes, like those of some mesh packages."""


# ---- code of other programs -------------------------------------------------------------------------
def test_a_mesh_class_that_unwraps_itself(tmp_path):
    """float64 and int64 of a user's class; rows of V are selected by the mapping."""
    V, F = (np.asarray(x).view(Tracked) for x in helpers.torus(8))
    vmapping, faces, uv = xatlas.parametrize(V, F)
    copy = np.asarray(V[vmapping])
    assert len(faces) == len(F) and (copy[faces] == np.asarray(V)[F]).all()
    sound(V, F, (vmapping, faces, uv))
    assert 'no overlaps' in written(tmp_path, V, F, (vmapping, faces, uv))


def test_a_step_between_reduction_and_baking():
    """float32 and int32; vertex attributes follow the mapping."""
    V, F = helpers.grid(12)
    V, F, colors = V.astype(np.float32), F.astype(np.int32), np.arange(len(V))
    vmapping, indices, uvs = xatlas.parametrize(V, F)
    V, F, colors = V[vmapping], indices, colors[vmapping]
    assert V.dtype == np.float32 and len(colors) == len(V) == len(uvs)
    assert F.astype(np.int64).max() == len(V) - 1


def test_a_scene_that_is_joined_first():
    """Several closed pieces as one mesh; the result replaces vertices and faces of the same object."""
    V, F = helpers.octahedron()
    V, F = np.concatenate([V, V + 3]), np.concatenate([F, F + len(V)])
    vmapping, indices, uvs = xatlas.parametrize(V, F)
    sound(V, F, (vmapping, indices, uvs))


def test_charts_of_larger_cost_with_options():
    V, F = helpers.torus(16)
    atlas = xatlas.Atlas()
    atlas.add_mesh(V, F)
    charts, packs = xatlas.ChartOptions(), xatlas.PackOptions()
    charts.max_cost = 8
    packs.padding, packs.resolution = 4, 512
    atlas.generate(charts, packs, verbose=False)
    sound(V, F, atlas[0])
    assert atlas.width == atlas.height == 512 and atlas.atlas_count == 1


# ---- input ----------------------------------------------------------------------------------------
def defective():
    V, F = helpers.grid(6)
    yield 'duplicate faces', V, np.concatenate([F, F[:5], F[5:9, ::-1]]), True
    yield 'a face turned over', V, np.concatenate([F[:3], F[3:5, ::-1], F[5:]]), True
    yield 'edges of three faces', np.concatenate([V, [[0.5, 0.5, 1]]]), np.concatenate([F, [[F[0, 0], F[0, 1], len(V)]]]), True
    yield 'two sheets at a vertex', np.concatenate([V, V[:2] + [0, 0, 2]]), np.concatenate(
        [F, [[0, len(V), len(V) + 1]]]), True
    yield 'unreferenced vertices', np.concatenate([V, [[np.nan, 0, 1e30]], V]), F, True
    yield 'corners that are one vertex', V, np.concatenate([F, [[0, 0, 1], [2, 2, 2]]]), False
    yield 'corners at one place', np.concatenate([V, V[:1]]), np.concatenate([F, [[0, len(V), 1]]]), False
    yield 'faces without an area', V, np.concatenate([F, [[0, 1, 2], [0, 3, 6]]]), False
    holed = V.copy()
    holed[10] = np.nan
    yield 'not a number', holed, F, False
    holed = V.copy()
    holed[10, 2] = np.inf
    yield 'infinite', holed, F, False
    yield 'a soup', V[F.ravel()], np.arange(F.size).reshape(-1, 3), True
    yield 'one triangle', V, F[:1], True
    yield 'tiny', V * 1e-20, F, True
    yield 'huge', V * 1e20, F, True
    yield 'far away', V + 1e6, F, True
    yield 'one place', V * 0, F, False
    yield 'one line', V * [1, 0, 0], F, False
    yield 'nothing but one vertex', V, np.zeros((3, 3), int), False
    yield 'no faces', V, np.zeros((0, 3), int), True
    yield 'nothing', np.zeros((0, 3)), np.zeros((0, 3), int), True


@pytest.mark.parametrize('name, V, F, area', defective(), ids=lambda x: x if isinstance(x, str) else '')
def test_every_mesh_is_taken(name, V, F, area):
    with warnings.catch_warnings():
        warnings.simplefilter('error')
        atlas = xatlas.Atlas()
        atlas.add_mesh(V, F)
        atlas.generate()
    if len(F):
        images = sound(V, F, atlas[0], area)
        p = np.asarray(V)[F]
        with np.errstate(all='ignore'):
            areas = np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1)
        usual = np.isfinite(areas) & (areas > 1e-3 * np.nanmax(areas[np.isfinite(areas)], initial=0)) & (areas > 0)
        assert (images[usual] > 0).all()
    else:
        assert [x.shape for x in atlas[0]] == [(0,), (0, 3), (0, 2)]
        assert atlas.chart_count == atlas.width == atlas.height == 0
    assert atlas.proven


def test_refusals_and_their_exceptions():
    V, F = helpers.octahedron()
    for arguments, word in [((V[:, :2], F), 'Nx3'), ((V, F[:, :2]), 'Nx3'), ((V, [1]), 'Nx3'),
                            ((V, F, V[:, :2]), 'Nx3'), ((V, F, None, V), 'Nx2'), ((V, F, V[:3]), 'first dimension'),
                            ((V, F, None, V[:3, :2]), 'first dimension')]:
        with pytest.raises(ValueError, match=word):
            xatlas.Atlas().add_mesh(*arguments)
    for faces in (F + 1, F - 1):
        with pytest.raises(RuntimeError, match='out of range'):
            xatlas.parametrize(V, faces)
    atlas = xatlas.Atlas()
    for call in (lambda: atlas[0], lambda: atlas.utilization, lambda: atlas.get_mesh_chart(0, 0)):
        with pytest.raises(IndexError, match='out of bounds'):
            call()
    with pytest.raises(ValueError, match='Cannot open'):
        xatlas.export('/nowhere/out.obj', V)


# ---- atlases --------------------------------------------------------------------------------------
def test_several_meshes_share_one_atlas(tmp_path):
    meshes = [helpers.octahedron(), helpers.torus(6), helpers.octahedron()]  # the first and the last one coincide
    atlas = xatlas.Atlas()
    for V, F in meshes:
        atlas.add_mesh(V, F)
    atlas.generate()
    assert len(atlas) == atlas.mesh_count == 3
    charts = [atlas.get_mesh_chart_count(k) for k in range(3)]
    assert sum(charts) == atlas.chart_count and min(charts) > 0
    corners = []
    for k, (V, F) in enumerate(meshes):
        sound(V, F, atlas[k])
        atlases, chart_of_vertex = atlas.get_mesh_vertex_assignment(k)
        assert (atlases == 0).all() and set(chart_of_vertex) == set(range(charts[k]))
        faces = [atlas.get_mesh_chart(k, c).faces for c in range(charts[k])]
        assert (np.sort(np.concatenate(faces)) == np.arange(len(F))).all()
        for c, of_chart in enumerate(faces):
            assert (chart_of_vertex[atlas[k][1][of_chart]] == c).all()
        corners.append(atlas[k][2][atlas[k][1]].astype(float))
    p = np.concatenate(corners)
    a, b = p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]
    assert atlas.utilization == pytest.approx(np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum() / 2, rel=1e-6)
    atlas.save(tmp_path / 'all.obj')
    text = (tmp_path / 'all.obj').read_text()
    assert text.count('\no ') + text.startswith('o ') == 3 and text.count('\nf ') == sum(len(F) for _, F in meshes)
    with pytest.raises(majorant.UsageError, match='several'):
        atlas.save(tmp_path / 'all.glb')


def test_charts_of_meshes_that_touch_stay_apart():
    """Two adjacent sheets; the second one has a triangle at the edge of the first one."""
    V, F = helpers.grid(4, bump=0)
    far = np.concatenate([V + [1, 0, 0], [[0, 0, 0], [0.01, 0, 0], [0, 0, 0.01]]])
    atlas = xatlas.Atlas()
    atlas.add_mesh(V, F)
    atlas.add_mesh(far, np.concatenate([F, [[len(V), len(V) + 1, len(V) + 2]]]))
    atlas.generate()
    assert sum(atlas.get_mesh_chart_count(k) for k in range(2)) == atlas.chart_count


def test_one_mesh_is_saved_as_any_map(tmp_path):
    V, F = helpers.octahedron()
    atlas = xatlas.Atlas()
    atlas.add_mesh(V, F)
    atlas.generate()
    atlas.save(tmp_path / 'out.glb')
    helpers.command('check', tmp_path / 'out.glb')


def test_export_writes_the_given_arrays(tmp_path):
    V, F = helpers.octahedron()
    uv = V[:, :2]
    for keywords, corner in [({}, '1'), ({'uvs': uv}, '1/1'), ({'normals': V}, '1//1'),
                             ({'uvs': uv, 'normals': V}, '1/1/1')]:
        xatlas.export(tmp_path / 'x.obj', V, F, **keywords)
        lines = (tmp_path / 'x.obj').read_text().splitlines()
        assert lines[0] == 'v 1 0 0' and f'f {corner} ' in next(line for line in lines if line[0] == 'f') + ' '
        assert sum(line[0] == 'f' for line in lines) == len(F)
    again, faces = majorant.read_mesh(tmp_path / 'x.obj')
    assert (again == V).all() and (faces == F).all()


# ---- meshes of uvs --------------------------------------------------------------------------------
def flat(n=6):
    V, F = helpers.grid(n, bump=0)
    return V[:, :2], F


def packed(*meshes, **packs):
    atlas = xatlas.Atlas()
    for mesh in meshes:
        atlas.add_uv_mesh(*mesh)
    atlas.generate(pack_options=xatlas.PackOptions(**packs))
    return atlas


def sizes(uv, F):
    """Returns edge lengths and twice the signed areas, by face."""
    p = np.asarray(uv, float)[F]
    a, b = p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]
    return np.linalg.norm(p[:, [1, 2, 0]] - p, axis=2), a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]


def test_islands_are_moved_and_turned():
    """Two layouts, one of them mirrored and twice as large, at one scale in one atlas."""
    _, F, uv = xatlas.parametrize(*helpers.torus(8))
    given = [uv, uv * np.float32([-2, 2])]
    atlas = packed(*((one, F) for one in given))
    assert atlas.proven and atlas.mesh_count == 2 and atlas.chart_count % 2 == 0
    scales = []
    for k, one in enumerate(given):
        vmapping, indices, moved = atlas[k]
        sound(one, F, atlas[k])
        assert len(vmapping) == len(one) and atlas.get_mesh_chart_count(k) == atlas.chart_count // 2
        lengths, areas = sizes(moved, indices)
        before, areas_before = sizes(one, F)
        assert (np.sign(areas) == np.sign(areas_before)).all()
        scales.append(lengths / before)
    assert np.ptp(np.concatenate(scales)) < 1e-4 * scales[0][0, 0]


def test_islands_end_where_materials_do():
    P, F = flat()
    materials = np.arange(len(F)) % 36 // 12
    atlas = packed((P, F, materials))
    charts = [atlas.get_mesh_chart(0, k) for k in range(atlas.chart_count)]
    assert sorted(chart.material for chart in charts) == [0, 1, 2]
    for chart in charts:
        assert (materials[chart.faces] == chart.material).all()
    assert len(atlas[0][0]) > len(P)  # vertices between two materials are repeated
    sound(P, F, atlas[0])


def test_islands_hang_together_where_places_are_equal():
    P, F = flat()
    soup = P[F.ravel()], np.arange(F.size).reshape(-1, 3)
    assert packed(soup).chart_count == packed((P, F)).chart_count == 1
    on_each_other = np.concatenate([P, P, P]), np.concatenate([F, F + len(P), F[:, ::-1] + 2 * len(P)])
    atlas = packed(on_each_other)
    assert atlas.chart_count == 3 and atlas.proven
    sound(*on_each_other, atlas[0])


def test_islands_that_overlap_themselves_are_divided():
    t, k = np.linspace(0, 4 * np.pi, 60), np.arange(59)
    circle = np.stack([np.cos(t), np.sin(t)], 1)
    F = np.concatenate([np.stack([k, k + 60, k + 61], 1), np.stack([k, k + 61, k + 1], 1)])
    with pytest.warns(UserWarning, match='islands overlap themselves'):
        atlas = packed((np.concatenate([circle, 2 * circle]), F))
    assert atlas.chart_count > 1 and atlas.proven


def test_every_mesh_of_uvs_is_taken():
    P, F = flat()
    odd = np.concatenate([P, [[np.nan, 0]]]), np.concatenate([F, [[0, 0, 1], [0, 1, 2], [0, 1, len(P)]]])
    atlas = packed(odd)
    sound(*odd, atlas[0], area=False)
    assert atlas.proven and packed((np.zeros((0, 2)), np.zeros((0, 3), int))).chart_count == 0
    tiles = packed(*[(P, F)] * 4, resolution=128, texels_per_unit=100)
    assert tiles.atlas_count == 4 and tiles.texels_per_unit == pytest.approx(100)


def test_refusals_of_meshes_of_uvs(tmp_path):
    P, F = flat()
    for arguments, word in [((P[:, :1], F), 'Nx2'), ((P, F[:, :2]), 'Nx3'), ((P, F, [1]), 'first dimension')]:
        with pytest.raises(ValueError, match=word):
            xatlas.Atlas().add_uv_mesh(*arguments)
    with pytest.raises(RuntimeError, match='out of range'):
        xatlas.Atlas().add_uv_mesh(P, F + 1)
    atlas = packed((P, F))
    with pytest.raises(RuntimeError, match='not both'):
        atlas.add_mesh(*helpers.octahedron())
    assert atlas.mesh_count == 1
    atlas.save(tmp_path / 'flat.obj')
    assert (tmp_path / 'flat.obj').read_text().count('\nf ') == len(F)


# ---- options --------------------------------------------------------------------------------------
def test_options_hold_what_those_of_xatlas_do():
    charts, packs = xatlas.ChartOptions(), xatlas.PackOptions()
    for options, name, value in [(packs, 'resolution', -1), (packs, 'padding', 1.5), (packs, 'bilinear', 2),
                                 (charts, 'max_cost', 'high'), (charts, 'max_iterations', 2 ** 32)]:
        with pytest.raises(TypeError, match=f'{name} is {value!r}'):
            setattr(options, name, value)
    with pytest.raises(TypeError, match='PackOptions.resolution is -1'):
        xatlas.PackOptions(resolution=-1)
    with pytest.raises(AttributeError, match='maxCost'):
        charts.maxCost = 4
    charts.max_cost, packs.padding, packs.bilinear = np.float32(3), np.uint8(3), np.bool_(False)


@pytest.mark.parametrize('cost', [math.nan, math.inf, -1, 0])
def test_any_cost(cost):
    V, F = helpers.torus(6)
    generated(V, F, {'max_cost': cost})
    generated(V, F, {'max_chart_area': cost}, {'texels_per_unit': cost})


def generated(V, F, charts=None, packs=None):
    atlas = xatlas.Atlas()
    atlas.add_mesh(V, F)
    atlas.generate(xatlas.ChartOptions(**(charts or {})), xatlas.PackOptions(**(packs or {})))
    sound(V, F, atlas[0])
    return atlas


def least_distance(atlas, mesh=0):
    """Returns the least distance between vertices of different charts, in texels."""
    _, _, uvs = atlas[mesh]
    chart = atlas.get_mesh_vertex_assignment(mesh)[1]
    p = uvs.astype(float) * (atlas.width, atlas.height)
    far = np.linalg.norm(p[:, None] - p[None], axis=2)
    return far[chart[:, None] != chart[None]].min()


def test_padding():
    V, F = helpers.torus(10)
    for padding, resolution in [(2, 256), (16, 256)]:
        atlas = generated(V, F, {'max_chart_area': 40}, {'padding': padding, 'resolution': resolution})
        assert padding + 1 <= least_distance(atlas)
    loose = generated(V, F, {'max_chart_area': 40}, {'padding': 16, 'resolution': 256, 'bilinear': False})
    assert 16 <= least_distance(loose)


def test_area_of_charts():
    V, F = helpers.torus(12)
    p = V[F]
    area = np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1) / 2
    most = area.sum() / 7
    atlas = generated(V, F, {'max_chart_area': most})
    charts = [atlas.get_mesh_chart(0, k) for k in range(atlas.chart_count)]
    assert max(area[chart.faces].sum() for chart in charts) <= most
    assert len(charts) >= 8 > generated(V, F).chart_count


def test_cost():
    V, F = helpers.torus(24)
    few, many = (generated(V, F, {'max_cost': cost}).chart_count for cost in (20, 0.05))
    assert few < many


def test_texels():
    V, F = helpers.torus(8)
    one = generated(V, F, packs={'texels_per_unit': 20})
    p = V[F]
    area = np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1).sum() / 2
    assert one.texels_per_unit == pytest.approx(20, rel=1e-3)
    assert one.utilization * one.width * one.height == pytest.approx(400 * area, rel=0.05)
    tiles = generated(V, F, packs={'texels_per_unit': 20, 'resolution': 128})
    assert tiles.width == tiles.height == 128 and tiles.atlas_count > 1
    assert set(tiles.get_mesh_vertex_assignment(0)[0]) == set(range(tiles.atlas_count))
    covered = sum(tiles.get_utilization(k) for k in range(tiles.atlas_count)) * 128 ** 2
    assert covered == pytest.approx(400 * area, rel=0.05)


def test_turns_of_charts():
    """Strips along one axis, some of which would fill a square better if turned."""
    V, F = helpers.grid(4, bump=0)
    V = np.concatenate([V * [9 - k, 1 + k / 2, 1] + [0, 3 * k, k] for k in range(5)])
    F = np.concatenate([F + len(V) // 5 * k for k in range(5)])

    def upright(turns):
        atlas = generated(V, F, packs={'rotate_charts': turns})
        sides = []
        for k in range(atlas.chart_count):
            p = atlas[0][2][atlas[0][1][atlas.get_mesh_chart(0, k).faces]].reshape(-1, 2)
            sides.append(np.ptp(p, axis=0))
        return sum(high > wide for wide, high in sides), len(sides)
    assert upright(False)[0] in (0, upright(False)[1])
    assert 0 < upright(True)[0] < upright(True)[1]


def test_other_options_warn_once():
    V, F = helpers.octahedron()
    xatlas._warned.clear()
    with pytest.warns(UserWarning, match='max_iterations has no effect'):
        generated(V, F, {'max_iterations': 4})
    with warnings.catch_warnings():
        warnings.simplefilter('error')
        generated(V, F, {'max_iterations': 4, 'fix_winding': True}, {'bruteForce': True})
    with pytest.raises((AttributeError, TypeError)):
        xatlas.PackOptions(rotate=True)


def test_picture_of_charts():
    V, F = helpers.octahedron()
    atlas = generated(V, F, packs={'create_image': True, 'resolution': 200})
    image = atlas.chart_image
    assert image.shape == (200, 200, 3) and image.dtype == np.uint8
    assert (image.any(2)).mean() == pytest.approx(atlas.utilization, abs=0.02)
    vmapping, indices, uvs = atlas[0]
    u, v = uvs[indices[0]].mean(0)
    assert image[int(v * 200), int(u * 200)].any()
    with pytest.raises(RuntimeError, match='create_image'):
        generated(V, F).chart_image


# ---- runs -----------------------------------------------------------------------------------------
def test_the_report_of_a_run(capsys):
    V, F = helpers.octahedron()
    atlas = xatlas.Atlas()
    atlas.add_mesh(V, F)
    atlas.generate(verbose=True)
    printed = capsys.readouterr().out
    assert 'Charts: %d' % atlas.chart_count in printed and 'Size: 1024x1024' in printed


def test_progress_is_called_back():
    steps = []
    xatlas.parametrize(*helpers.grid(10), callback=lambda step: steps.append(step.energy))
    assert steps and all(np.isfinite(steps))

    def fails(step):
        raise KeyError('mine')
    with pytest.raises(KeyError, match='mine'):
        xatlas.parametrize(*helpers.grid(10), callback=fails)


def test_other_threads_run_and_interrupts_end_it():
    V, F = helpers.grid(150)
    ticks, done = [], threading.Event()

    def count():
        while not done.wait(0.005):
            ticks.append(time.perf_counter())
    thread = threading.Thread(target=count)
    thread.start()
    started = time.perf_counter()
    timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        while True:
            xatlas.parametrize(V, F)
    ended = time.perf_counter()
    done.set()
    thread.join()
    assert len([t for t in ticks if started < t < ended]) > 5


if __name__ == '__main__':
    helpers.main(__file__)
