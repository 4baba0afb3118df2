#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Solvers, maps, files: results equal those of the command bit by bit."""
import copy
import json
import pickle
import re
import subprocess
import sys

import helpers
import numpy as np
import pytest

import majorant


def curved():
    return majorant.parametrize(*helpers.mesh('cap'), degree=3)


@pytest.fixture(scope='module')
def cap():
    return curved()


def areas(corners):
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    return 0.5 * ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])


def test_flatten_gives_uv_in_the_order_of_V():
    V, F = helpers.grid(6)
    uv = majorant.flatten(V, F)
    assert uv.shape == (len(V), 2) and uv.dtype == np.float64
    assert (areas(uv[F]) > 0).all()
    order = np.random.default_rng(1).permutation(len(V))
    moved = majorant.flatten(V[order], np.argsort(order)[F])
    # Another numbering may give another rotation, so that only the shape is compared.
    distance = lambda p: np.linalg.norm(p[:, None] - p[None], axis=2)  # noqa: E731
    assert np.allclose(distance(moved), distance(uv[order]), atol=1e-4)


def test_unused_vertices_lie_with_the_first_corner():
    """They are never NaN or outside of the layout, and the others do not depend on them."""
    V, F = helpers.grid(3)
    uv = majorant.flatten(np.vstack([[[9, 9, 9]], V, [[7, 7, 7]]]), F + 1)
    assert np.isfinite(uv).all() and (uv[0] == uv[-1]).all()
    assert (uv[0] == uv[1 + F[0, 0]]).all()
    assert np.array_equal(uv[1:-1], majorant.flatten(V, F))


def pieces(V, F, count):
    return np.vstack([V + 3 * k for k in range(count)]), np.vstack([F + k * len(V) for k in range(count)])


def punctured(V, F):
    return V, F[2:]


@pytest.mark.parametrize('mesh, message', [
    (helpers.octahedron(), 'the surface is closed (genus 0, no boundary); unwrap() cuts it open'),
    (helpers.torus(), 'the surface is closed (genus 1, no boundary); unwrap() cuts it open'),
    (punctured(*helpers.torus()), 'the surface has genus 1 (one boundary loop, Euler characteristic -1); unwrap()'),
    (pieces(*helpers.grid(3), 2), 'face 18: the mesh has 2 components, a second one starts here; unwrap()'),
    (pieces(*helpers.octahedron(), 3), 'the mesh has 3 components'),
    ((helpers.grid(2)[0], [[0, 1, 2], [1, 0, 3], [0, 1, 4]]), 'face 2: edge (0, 1) has more than two faces'),
])
@pytest.mark.parametrize('solver', [majorant.flatten, majorant.parametrize])
def test_flatten_refers_other_surfaces_to_unwrap(solver, mesh, message):
    with pytest.raises(majorant.UnsupportedError) as raised:
        solver(*mesh)
    assert raised.value.exit_code == 3 and message in str(raised.value) and 'unwrap()' in str(raised.value)
    majorant.unwrap(*mesh)


def test_flatten_accepts_holes():
    V, F = helpers.grid(6)
    F = np.delete(F, [14, 15, 50, 51], axis=0)
    uv = majorant.flatten(V, F)
    assert (areas(uv[F]) > 0).all()


def test_flatten_is_of_degree_1():
    with pytest.raises(majorant.UsageError, match='parametrize'):
        majorant.flatten(*helpers.grid(2), degree=2)


def test_arrays_of_a_map(cap):
    V, F = helpers.mesh('cap')
    assert cap.status == 'converged' and cap.degree == 3
    assert (cap.faces == F).all() and (cap.input_faces == np.arange(len(F))).all()
    assert cap.corner_uv.shape == (len(F), 3, 2)
    assert np.array_equal(cap.uv[F], cap.corner_uv)
    assert cap.cells.shape == (len(F), 10) and cap.cells.max() + 1 == len(cap.control_points)
    assert np.array_equal(cap.nodes[cap.cells[:, :3]], V[F])
    assert len(cap.distortion) == len(F) and (cap.distortion >= 4 - 1e-9).all()
    assert (cap.charts == 0).all() and cap.cones == {}
    size = np.linalg.norm(np.cross(*(V[F[:, k]] - V[F[:, 0]] for k in (1, 2))), axis=1)
    assert cap.report['result']['value'] == pytest.approx(np.average(cap.distortion, weights=size), rel=1e-9)
    assert '486 faces' in repr(cap) or f'{len(F)} faces' in repr(cap)


def test_no_copies(cap):
    first, second = cap.control_points, cap.control_points
    assert np.shares_memory(first, second)
    assert first.flags.c_contiguous and not first.flags.writeable and not first.flags.owndata
    with pytest.raises(ValueError):
        first[0] = 0
    kept = curved().control_points          # must outlive its map
    assert np.array_equal(kept, first)


def test_evaluate_at_corners_and_in_numpy_shapes(cap):
    F = len(cap.faces)
    for corner in range(3):
        assert np.allclose(cap.evaluate(np.arange(F), np.eye(3)[corner]), cap.corner_uv[:, corner], atol=1e-14)
    assert cap.evaluate(0, [1 / 3] * 3).shape == (2,)
    assert cap.evaluate(np.arange(F)[:, None], np.full((4, 3), 1 / 3)).shape == (F, 4, 2)


def test_jacobian_is_the_derivative(cap):
    face, b, h = 7, np.array([0.2, 0.3, 0.5]), 1e-6
    corners = cap.nodes[cap.cells[face, :3]]
    J = cap.jacobian(face, b)
    for step in (np.array([1, 0, -1]), np.array([0, 1, -1])):
        image = (cap.evaluate(face, b + h * step) - cap.evaluate(face, b - h * step)) / (2 * h)
        x = corners[0] - corners[2]
        x = x / np.linalg.norm(x)
        normal = np.cross(corners[0] - corners[2], corners[1] - corners[2])
        y = np.cross(normal, x) / np.linalg.norm(normal)
        tangent = step @ corners
        assert np.allclose(J @ [tangent @ x, tangent @ y], image, atol=1e-8)
    assert (np.linalg.det(cap.jacobian(np.arange(len(cap.faces)), b)) > 0).all()


@pytest.mark.parametrize('call, message', [
    (lambda r: r.evaluate(-1, [0.2, 0.3, 0.5]), 'face is not in 0 .. '),
    (lambda r: r.evaluate(10**6, [0.2, 0.3, 0.5]), 'face is not in 0 .. '),
    (lambda r: r.evaluate(0.5, [0.2, 0.3, 0.5]), 'not integers'),
    (lambda r: r.evaluate(0, [0.5, 0.5]), 'the last side must be 3'),
    (lambda r: r.evaluate(0, [0.5, 0.5, 0.5]), 'does not add to 1'),
    (lambda r: r.jacobian([0, 1], np.full((3, 3), 1 / 3)), 'do not fit'),
])
def test_invalid_places_are_refused(cap, call, message):
    with pytest.raises(majorant.UsageError, match=message):
        call(cap)


def test_pickles_are_the_same_map(cap, tmp_path):
    for other in (pickle.loads(pickle.dumps(cap)), copy.deepcopy(cap)):
        assert np.array_equal(other.control_points, cap.control_points)
        assert other.report == cap.report and other.status == cap.status
        assert np.array_equal(other.evaluate(3, [0.1, 0.2, 0.7]), cap.evaluate(3, [0.1, 0.2, 0.7]))
        other.save(tmp_path / 'other.vtu')
        cap.save(tmp_path / 'cap.vtu')
        assert (tmp_path / 'other.vtu').read_bytes() == (tmp_path / 'cap.vtu').read_bytes()


@pytest.mark.parametrize('name, words, options', [
    ('cap', ['--degree', '1'], {'degree': 1}),
    ('cap', ['--degree', '3'], {}),
    ('creature', ['--degree', '2', '--energy', 'arap + 0.1*mips'], {'degree': 2, 'energy': 'arap + 0.1*mips'}),
    ('wavy_disk', ['--degree', '2', '--bijective'], {'degree': 2, 'bijective': True}),
])
def test_the_bits_of_the_command(tmp_path, name, words, options):
    helpers.command('parametrize', helpers.MESHES / f'{name}.obj', '-o', tmp_path / 'command.vtu', *words, '--quiet')
    ours = majorant.parametrize(*helpers.mesh(name), **options)
    theirs = majorant.read(tmp_path / 'command.vtu')
    assert np.array_equal(ours.control_points, theirs.control_points)
    assert np.array_equal(ours.cells, theirs.cells)


def write_obj(path, V, F):
    path.write_text(''.join('v %r %r %r\n' % tuple(v) for v in V.tolist())
                    + ''.join('f %d %d %d\n' % tuple(f) for f in (F + 1).tolist()))
    return path


def test_the_bits_of_the_command_for_seamless_and_unwrap(tmp_path):
    V, F = helpers.octahedron()
    path = write_obj(tmp_path / 'octahedron.obj', V, F)
    for verb, solver, words in (('seamless', majorant.seamless, ['--degree', '2']),
                                ('unwrap', majorant.unwrap, ['--degree', '2', '--normalize'])):
        helpers.command(verb, path, '-o', tmp_path / 'command.vtu', '--quiet', *words)
        ours = solver(V, F, degree=2, **({'normalize': True} if verb == 'unwrap' else {}))
        assert np.array_equal(ours.control_points, majorant.read(tmp_path / 'command.vtu').control_points), verb


BOTH = """
import sys, majorant
r = majorant.parametrize(*majorant.read_mesh(sys.argv[1]), degree=3, energy='arap', bijective=True)
r.save(sys.argv[2])
print(majorant.kernels()['openblas'])
"""


@pytest.mark.parametrize('kernel', ['Haswell', 'Prescott'])
def test_the_bits_of_the_command_on_other_kernels(tmp_path, monkeypatch, kernel):
    monkeypatch.setenv('OPENBLAS_CORETYPE', kernel)
    mesh = helpers.MESHES / 'wavy_disk.obj'
    helpers.command('parametrize', mesh, '-o', tmp_path / 'command.vtu', '--degree', 3, '--energy', 'arap', '--bijective',
                    '--quiet')
    printed = subprocess.run([sys.executable, '-c', BOTH, mesh, tmp_path / 'python.vtu'], env=helpers.environment(),
                          capture_output=True, text=True, check=True).stdout.split()
    assert printed in ([kernel], [])      # empty if no OpenBLAS is loaded
    ours, theirs = (majorant.read(tmp_path / f'{name}.vtu') for name in ('python', 'command'))
    assert np.array_equal(ours.control_points, theirs.control_points)


def test_the_bits_of_the_command_for_deform(tmp_path):
    V, F = helpers.grid(4, bump=0)
    path = write_obj(tmp_path / 'sheet.obj', V, F)
    moved = {0: (-0.25, -0.125), 24: (1.5, 1.25)}
    (tmp_path / 'h.json').write_text(json.dumps({'handles': [{'vertex': v, 'target': p} for v, p in moved.items()]}))
    helpers.command('deform', path, '--handles', tmp_path / 'h.json', '--degree', 2, '-o', tmp_path / 'command.vtu',
                    '--quiet')
    ours = majorant.deform(V, F, degree=2, handles=moved)
    assert np.array_equal(ours.control_points, majorant.read(tmp_path / 'command.vtu').control_points)


def test_pins_and_handles_are_those_of_the_command(tmp_path):
    pins = {'handles': [{'vertex': 0, 'target': 'initial'}, {'vertex': 5, 'target': [0.4, 0.1]}]}
    (tmp_path / 'pins.json').write_text(json.dumps(pins))
    helpers.command('parametrize', helpers.MESHES / 'cap.obj', '-o', tmp_path / 'c.vtu', '--degree', 1, '--handles',
                    tmp_path / 'pins.json', '--soft', 10, '--quiet')
    ours = majorant.parametrize(*helpers.mesh('cap'), degree=1, handles={0: None, 5: (0.4, 0.1)}, soft=10)
    assert np.array_equal(ours.control_points, majorant.read(tmp_path / 'c.vtu').control_points)


def test_pins_hold_exactly():
    V, F = helpers.grid(4)
    uv = majorant.flatten(V, F)
    pinned = majorant.flatten(V, F, pins={3: uv[3], 20: uv[20]})
    assert np.array_equal(pinned[[3, 20]], uv[[3, 20]])


def test_seamless_maps_know_their_cones():
    r = majorant.seamless(*helpers.octahedron(), degree=1)
    assert sum(4 - turns for turns in r.cones.values()) == 8      # Gauss and Bonnet
    with pytest.raises(majorant.UnsupportedError, match='corner_uv'):
        r.uv
    cones = {v: 2 for v in (0, 1, 2, 3)}
    assert majorant.seamless(*helpers.octahedron(), degree=1, cones=cones).cones == cones


def test_maps_report_overlaps(tmp_path):
    free = majorant.parametrize(*helpers.grid(4), degree=1)
    assert free.globally_injective is True
    assert free.report['result']['overlaps'] == 'no overlaps'
    assert free.report['linear_solver'] == {'requested': 'direct', 'used': 'direct'}
    free.save(tmp_path / 'free.vtu')
    assert majorant.read(tmp_path / 'free.vtu').globally_injective is None
    seamless = majorant.seamless(*helpers.mesh('buckle'), degree=1)
    assert seamless.globally_injective is False
    assert 'it overlaps itself near (' in seamless.report['result']['overlaps']


def test_objects_have_layouts_of_their_own(tmp_path):
    V, F = helpers.octahedron()
    V, F, numbers = np.vstack([V, V + 5]), np.vstack([F, F + 6]), np.repeat([7, 3], len(F))
    r = majorant.unwrap(V, F, objects=numbers)
    assert [o['name'] for o in r.report['objects']] == ['7', '3']
    alone = majorant.unwrap(V[:6], F[:8])
    assert np.array_equal(r.corner_uv[r.input_faces < 8], alone.corner_uv)
    assert len(np.unique(r.charts[r.input_faces >= 8])) == r.report['objects'][1]['result']['charts']
    strided = np.column_stack([numbers, numbers + 1]).astype(np.uint8)[:, 0]
    for same in (strided, numbers[::-1].copy()[::-1], list(numbers)):
        assert np.array_equal(majorant.unwrap(V, F, objects=same).corner_uv, r.corner_uv)
    r.save(tmp_path / 'a.vtu')
    pickle.loads(pickle.dumps(r)).save(tmp_path / 'a.obj')
    assert [line for line in (tmp_path / 'a.obj').read_text().splitlines() if line.startswith('o ')] == ['o 7', 'o 3']
    for name in ('a.vtu', 'a.obj'):
        assert not majorant.check(tmp_path / name, certify=True)    # the objects lie on each other
    with pytest.raises(majorant.UsageError, match='.obj or .vtu'):
        r.save(tmp_path / 'a.ply')
    for wrong, says in (({'objects': numbers[1:]}, 'objects'), ({'objects': numbers, 'scale': 'model'}, 'unit square'),
                        ({'objects': numbers, 'pins': {0: (0, 0)}}, 'pins'),
                        ({'objects': numbers, 'weld': 0.1}, 'weld')):
        with pytest.raises(majorant.UsageError, match=says):
            majorant.unwrap(V, F, **wrong)


def test_the_status_of_objects_is_the_worst():
    """A disk that converges, and one with a limit of steps, in any order."""
    disk, bumpy = helpers.grid(1, bump=0), helpers.grid(12, bump=2)
    for (V, F), (W, G) in ((disk, bumpy), (bumpy, disk)):
        V, F, numbers = np.vstack([V, W + 50]), np.vstack([F, G + len(V)]), np.repeat([0, 1], [len(F), len(G)])
        r = majorant.unwrap(V, F, objects=numbers, max_iterations=1)
        ends = [o['status'] for o in r.report['objects']]
        assert sorted(ends) == ['converged', 'max_iterations']
        assert r.status == r.report['status'] == 'max_iterations' and r.message == r.report['message']


def test_unwrap_has_the_options_of_the_command(tmp_path):
    V, F = helpers.octahedron()
    V, F = np.vstack([V, V + [5, 0, 0], 0.5 * V + [9, 0, 0]]), np.vstack([F, F + 6, F + 12])
    path = write_obj(tmp_path / 'three.obj', V, F)
    for words, options in ((['--udim', '3'], {'udim': 3}), (['--texel-density', '40'], {'texel_density': 40}),
                           (['--stack', 'equal'], {'stack': 'equal'}), (['--stack', 'mirrored'], {'stack': 'mirrored'}),
                           (['--upright', 'z'], {'upright': 'z'}), (['--preset', 'lightmap'], {'preset': 'lightmap'}),
                           (['--preset', 'game', '--padding', '2'], {'preset': 'game', 'padding': 2}),
                           (['--preset', 'single'], {'preset': 'single'}), (['--groups'], {'groups': True})):
        helpers.command('unwrap', path, '-o', tmp_path / 'command.obj', '-o', tmp_path / 'command.vtu', '--quiet',
                        '--force', *words)
        ours = majorant.unwrap(V, F, **options)
        assert np.array_equal(ours.control_points, majorant.read(tmp_path / 'command.vtu').control_points), words
        ours.save(tmp_path / 'ours.obj')
        lines = [[line for line in (tmp_path / name).read_text().splitlines() if line.startswith(('g ', 'usemtl '))]
                 for name in ('ours.obj', 'command.obj')]
        assert lines[0] == lines[1], words
    assert len(set(majorant.unwrap(V, F, texel_density=np.repeat([20.0, 40.0, 20.0], len(F) // 3)).charts)) >= 3
    square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]])
    uv = 0.1 * square[:, :2] * [1, 2]
    kept = majorant.unwrap(square, [[0, 1, 2], [0, 2, 3]], seams='uv', uv=uv, keep_shape=True).corner_uv
    sides = np.ptp(kept.reshape(-1, 2), axis=0)
    assert sides.max() / sides.min() == pytest.approx(2)


@pytest.mark.parametrize('options', [
    {'udim': 0}, {'udim': 101}, {'udim': 2.5}, {'texel_density': 0}, {'texel_density': float('inf')},
    {'texel_density': [1.0]}, {'stack': 'all'}, {'upright': 'w'}, {'preset': 'film'}, {'keep_shape': True},
    {'udim': 2, 'pack': False}, {'udim': 2, 'scale': 'model'}, {'udim': 2, 'fill': 0.5}, {'stack': 'equal', 'degree': 2},
    {'texel_density': 9, 'objects': [0] * 8}, {'padding': 600}, {'resolution': float('inf')}, {'groups': 'yes'}])
def test_options_of_unwrap_that_are_refused(options):
    with pytest.raises(majorant.UsageError):
        majorant.unwrap(*helpers.octahedron(), **options)


def test_unwrap_fills_half_of_the_square_for_little_seam():
    xy = np.linspace(0, 1, 11)
    V = np.array([(x, y, 0) for y in xy for x in xy])
    k = np.array([11 * j + i for j in range(10) for i in range(10) if min(i, j) < 2])
    F = np.column_stack([k, k + 1, k + 12, k + 11])
    whole, parts = majorant.unwrap(V, F, fill=0), majorant.unwrap(V, F)
    assert whole.report['result']['charts'] == 1 and whole.report['result']['fill'] < 0.4
    assert parts.report['result']['charts'] > 1 and parts.report['result']['fill'] >= 0.5
    assert majorant.unwrap(V, F, preset='paint').report['result']['charts'] == 1


def test_unwrap_fits_the_unit_square():
    V, F = helpers.octahedron()
    r = majorant.unwrap(V, F)
    border = 4 / 1024
    assert r.corner_uv.min() >= border - 1e-12 and r.corner_uv.max() <= 1 - border + 1e-12
    assert (areas(r.corner_uv) > 0).all()
    assert np.array_equal(majorant.unwrap(V, F, normalize=True).corner_uv, r.corner_uv)
    model = majorant.unwrap(V, F, scale='model')
    scale = r.report['result']['layout_scale']
    assert model.report['result']['layout_scale'] == 1
    assert areas(model.corner_uv).sum() * scale ** 2 == pytest.approx(areas(r.corner_uv).sum())
    assert r.report['result']['value'] == pytest.approx(model.report['result']['value'])
    two = majorant.unwrap(np.vstack([V, V + 5]), np.vstack([F, F + 6]), fill=0)
    assert set(two.charts) == {0, 1}
    cut = majorant.unwrap(V, F, seams=[[0, 2], [2, 1], [1, 3]])
    assert cut.report['result']['seam_edges'] == 3


def test_deform_moves_the_handles():
    V, F = helpers.grid(6, bump=0)
    r = majorant.deform(V[:, :2], F, degree=1, handles={0: (-0.2, -0.1), 48: (1, 1)}, soft=1e5)
    assert np.allclose(r.uv[0], (-0.2, -0.1), atol=0.02)
    with pytest.raises(majorant.UsageError, match='nothing to do'):
        majorant.deform(V, F)


def test_start_from_uv_and_seams_from_uv():
    V, F = helpers.grid(4)
    uv = majorant.flatten(V, F)
    again = majorant.parametrize(V, F, degree=1, uv=uv, init='input')
    assert again.report['result']['start'] == 'input'
    assert again.report['result']['initial_value'] == pytest.approx(again.report['result']['value'], rel=1e-5)
    closed = majorant.unwrap(*helpers.octahedron())
    islands = majorant.unwrap(*helpers.octahedron(), uv=closed.corner_uv, seams='uv')
    assert islands.report['result']['seam_edges'] == closed.report['result']['seam_edges']
    with pytest.raises(majorant.UsageError, match='needs uv'):
        majorant.parametrize(V, F, init='input')


def test_polygons_stay(tmp_path):
    V = [[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0], [1, 1, 0.2], [2, 1, 0]]
    r = majorant.parametrize(V, [[0, 1, 4, 3], [1, 2, 5, 4]], degree=1)
    assert list(r.input_faces) == [0, 0, 1, 1]
    r.save(tmp_path / 'quads.obj')
    assert [len(f) for f in majorant.read_mesh(tmp_path / 'quads.obj')[1]] == [4, 4]
    mixed = majorant.parametrize(V, [[0, 1, 4, 3], [1, 2, 5], [1, 5, 4]], degree=1)
    assert list(mixed.input_faces) == [0, 0, 1, 2]


@pytest.mark.parametrize('extension', ['.vtu', '.obj', '.ply', '.msh', '.svg', '.png', '.html'])
def test_saved_files_pass_check(cap, tmp_path, extension):
    path = tmp_path / f'cap{extension}'
    cap.save(path)
    assert path.stat().st_size > 1000
    if extension in ('.vtu', '.obj', '.ply'):
        helpers.command('check', path, '--surface', helpers.MESHES / 'cap.obj', '--quiet')


def test_invalid_maps_are_not_written(cap, tmp_path):
    for path, message in ((tmp_path / 'cap.stl', 'ends in one of'), (tmp_path / 'none' / 'cap.vtu', 'cannot write'),
                          (tmp_path / 'cap', 'ends in one of')):
        with pytest.raises(majorant.UsageError, match=message):
            cap.save(path)
    assert list(tmp_path.iterdir()) == []


def damaged(r, face):
    """Returns the map with a face turned over."""
    state = list(r._file.__getstate__())
    uv = np.array(state[2])
    corners = r.cells[face, :3]
    uv[corners[[0, 1]]] = uv[corners[[1, 0]]]
    state[2] = uv
    out = copy.copy(r)
    out._file = r._file.__class__.__new__(r._file.__class__)
    out._file.__setstate__(tuple(state))
    return out


def test_written_maps_are_certified(cap, tmp_path):
    wrong = damaged(cap, 5)
    (tmp_path / 'wrong.vtu').write_text('as it was')
    with pytest.raises(majorant.InvalidError, match='positive') as raised:
        wrong.save(tmp_path / 'wrong.vtu')
    assert raised.value.exit_code == 5
    assert (tmp_path / 'wrong.vtu').read_text() == 'as it was'
    verdict = majorant.check(wrong)
    assert not verdict and verdict.status == 'invalid' and 'positive' in verdict.findings[0]


def test_check_agrees_with_the_command(cap, tmp_path):
    V, F = helpers.mesh('cap')
    cap.save(tmp_path / 'cap.vtu')
    for certify in (False, True):
        helpers.command('check', tmp_path / 'cap.vtu', '--surface', helpers.MESHES / 'cap.obj', '--quiet',
                        '--report', tmp_path / 'r.json', *(['--certify'] if certify else []))
        theirs = json.loads((tmp_path / 'r.json').read_text())
        ours = majorant.check(tmp_path / 'cap.vtu', V, F, certify=certify)
        own = {'options', 'seconds', 'peak_memory_bytes'}    # differ between command and package
        assert ours and {key: value for key, value in ours.report.items() if key not in own} == {
            key: value for key, value in theirs.items() if key not in own}
        assert majorant.check(cap, V, F, certify=certify).proofs == theirs['result']['proofs']
    other = majorant.check(cap, *helpers.grid(3))
    assert other.status == 'invalid' and other.proofs['surface']['answer'] == 'violated'
    assert majorant.check(cap, time_limit=0).status == 'undecided'
    with pytest.raises(majorant.UsageError, match='go together'):
        majorant.check(cap, V)


def test_stacks_of_files(tmp_path):
    """A surface, its mirror image and a copy: read, proven and written again."""
    V, F = helpers.grid(3)
    positions = np.concatenate([V, V * [-1, 1, 1] + [5, 0, 0], V + [9, 0, 0]])
    faces = np.concatenate([F, F[:, ::-1] + len(V), F + 2 * len(V)])
    mesh, path = tmp_path / 'three.obj', tmp_path / 'stacked.vtu'
    mesh.write_text(''.join(f'v {x!r} {y!r} {z!r}\n' for x, y, z in positions.tolist())
                    + ''.join(f'f {a} {b} {c}\n' for a, b, c in (faces + 1).tolist()))
    helpers.command('unwrap', mesh, '--stack', 'mirrored', '-o', path, '--quiet')
    r = majorant.read(path)
    r.save(tmp_path / 'again.vtu')
    r.save(tmp_path / 'again.obj')
    verdict = majorant.check(tmp_path / 'again.vtu', positions, faces, certify=True)
    assert verdict and verdict.report['result']['stacks'] == {'stacks': 1, 'charts': 3, 'mirrored': 1}
    assert not majorant.check(tmp_path / 'again.obj', certify=True)
    assert majorant.check(tmp_path / 'again.obj', positions, faces, certify=True, stacked=True)


def test_read_returns_the_saved_map(cap, tmp_path):
    cap.save(tmp_path / 'cap.vtu')
    r = majorant.read(tmp_path / 'cap.vtu')
    assert r.status == 'read' and np.array_equal(r.control_points, cap.control_points)
    assert r.report is None and '(read' not in repr(r)
    r.save(tmp_path / 'again.obj')
    helpers.command('check', tmp_path / 'again.obj', '--surface', helpers.MESHES / 'cap.obj', '--quiet')
    with pytest.raises(majorant.ReadError) as raised:
        majorant.read(tmp_path / 'none.vtu')
    assert raised.value.exit_code == 2
    (tmp_path / 'broken.obj').write_text('v 0 0\nf 1 2 3\n')
    with pytest.raises(majorant.ReadError, match='broken.obj:1'):
        majorant.read_mesh(tmp_path / 'broken.obj')


def test_data_omitted_by_readers_are_a_warning(tmp_path):
    square = 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn x\n'
    mesh = tmp_path / 'a.obj'
    mesh.write_text(square + 'f 1/1 2/2 3/3 4/4\n')
    for reader in (majorant.read_mesh, majorant.read):
        with pytest.warns(UserWarning, match="a.obj:9: normal component 'x' is not a number: left out") as caught:
            reader(mesh)
        assert len(caught) == 1 and caught[0].filename == __file__
    mesh.write_text(square + 'f 1/1 2/2 3/3 4/9\n')
    with pytest.raises(majorant.ReadError, match='a.obj:10: vt index 9 out of range, the file has 4'):
        majorant.read(mesh)


def test_notebooks_see_the_layout(cap):
    html = cap._repr_html_()
    assert html.count('<svg') == 1 and '&lt;majorant.Map' in html
    parts = sum(path.count('M') + path.count('m') for path in re.findall(' d="([^"]*)"', html))
    assert parts >= len(cap.faces)
    assert cap.svg().startswith('<?xml') and cap.svg() == cap.svg('density')
    assert len({cap.svg(quantity) for quantity in ('density', 'area', 'angle', 'sigma-max', 'sigma-min')}) == 5
    with pytest.raises(majorant.UsageError, match="quantity='heat' is none of"):
        cap.svg('heat')


def test_energies_and_formats_are_listed():
    assert 'symmetric-dirichlet' in majorant.energies() and all(majorant.energies().values())
    assert majorant.kernels()['vector_instructions'] in ('AVX-512', 'AVX2', 'baseline')
    assert helpers.command('--version').stdout.split()[1] == majorant.__version__


def test_help_teaches():
    for name in majorant.__all__:
        assert (getattr(majorant, name).__doc__ or '').strip(), name
    for name in ('flatten', 'parametrize', 'seamless', 'unwrap', 'deform', 'check'):
        assert f'majorant.{name}(' in getattr(majorant, name).__doc__, name


if __name__ == '__main__':
    helpers.main(__file__)
