#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""InverseMap and SurfaceTree: evaluated points are found again, for all degrees, charts, and maps that cover the plane
twice; nearest points compared with all triangles; invalid arguments."""
import concurrent.futures

import helpers
import numpy as np
import pytest

import majorant


def random_places(r, count, seed=1):
    random = np.random.default_rng(seed)
    return random.integers(0, len(r.faces), count), random.dirichlet((1, 1, 1), count)


@pytest.mark.parametrize('degree', [1, 2, 3, 4])
def test_points_that_were_evaluated(degree):
    V, F = helpers.grid(5)
    r = majorant.parametrize(V, F, degree=degree, bijective=True)
    inverse = majorant.InverseMap(r)
    face, bary = random_places(r, 5000)
    uv = r.evaluate(face, bary)
    found = inverse.locate(uv)
    assert found.face.dtype == np.int32 and found.bary.dtype == np.float64 and found.undecided.dtype == bool
    assert not found.undecided.any() and (found.face >= 0).all() and (found.bary >= 0).all()
    size = np.linalg.norm(np.ptp(r.control_points, axis=0))
    assert np.abs(r.evaluate(found.face, found.bary) - uv).max() <= 1e-12 * size
    inner = bary.min(1) > 1e-6
    assert (found.face[inner] == face[inner]).all()
    assert np.abs(found.bary[inner] - bary[inner]).max() < 1e-9
    every = inverse.preimages(uv)
    assert (every.point == np.arange(len(uv))).all() and (every.face == found.face).all()
    outside = r.control_points.max(0) + [[1, 0], [0, 1]]
    assert (inverse.locate(outside).face == -1).all() and len(inverse.preimages(outside).point) == 0


def test_charts_and_shapes():
    V, F = helpers.torus()
    r = majorant.unwrap(V, F)
    inverse = majorant.InverseMap(r)
    face, bary = random_places(r, 600)
    uv = r.evaluate(face, bary).reshape(20, 30, 2)
    found = inverse.locate(uv)
    assert found.face.shape == (20, 30) and found.bary.shape == (20, 30, 3) and found.undecided.shape == (20, 30)
    assert (found.face.ravel() == face).all()
    points = (V[r.faces[found.face]] * found.bary[..., None]).sum(-2).reshape(-1, 3)
    assert np.allclose(points, (V[r.faces[face]] * bary[:, :, None]).sum(1), atol=1e-9)
    one = inverse.locate(uv[3, 4].tolist())
    assert one.face.shape == () and one.face == face[3 * 30 + 4]
    assert (inverse.preimages(uv).point == np.arange(600)).all()
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        for again in pool.map(lambda threads: inverse.locate(uv, threads=threads), (1, 2)):
            assert (again.face == found.face).all() and (again.bary == found.bary).all()


def test_a_map_that_covers_the_plane_twice(tmp_path):
    """A strip that winds around a ring one and a half times."""
    n = 48
    angle = np.repeat(np.linspace(0, 3 * np.pi, n + 1), 2)
    radius = np.tile([1.0, 2.0], n + 1)
    V = np.column_stack([angle, radius, 0 * angle])
    k = 2 * np.arange(n)
    F = np.concatenate([np.column_stack([k + 1, k, k + 2]), np.column_stack([k + 1, k + 2, k + 3])])
    uv = np.column_stack([radius * np.cos(angle), -radius * np.sin(angle)])
    path = tmp_path / 'ring.obj'
    path.write_text(''.join('v %.17g %.17g %.17g\n' % tuple(p) for p in V) +
                    ''.join('vt %.17g %.17g\n' % tuple(p) for p in uv) +
                    ''.join('f ' + ' '.join(f'{v + 1}/{v + 1}' for v in f) + '\n' for f in F))
    every = majorant.InverseMap(majorant.read(path)).preimages([[0.1, -1.5], [0.1, 1.5], [0, 0]])
    assert np.bincount(every.point, minlength=3).tolist() == [2, 1, 0]


def distance_to(a, b, c, p):
    """Returns the distance from one triangle, by its edges and its plane."""
    normal = np.cross(b - a, c - a)
    inside = [np.dot(normal, np.cross(r - q, p - q)) for q, r in ((a, b), (b, c), (c, a))]
    found = [abs(np.dot(normal, p - a)) / np.linalg.norm(normal)] if min(inside) >= 0 else []
    for q, r in ((a, b), (b, c), (c, a)):
        t = np.clip(np.dot(p - q, r - q) / np.dot(r - q, r - q), 0, 1)
        found.append(np.linalg.norm(q + t * (r - q) - p))
    return min(found)


def test_nearest_points():
    V, F = helpers.torus()
    tree = majorant.SurfaceTree(V, F)
    points = np.random.default_rng(2).uniform(-6, 6, (10, 20, 3))
    face, bary, distance = tree.nearest(points)
    assert face.shape == distance.shape == (10, 20) and bary.shape == (10, 20, 3)
    assert (bary >= 0).all() and np.allclose(bary.sum(-1), 1)
    assert np.allclose(np.linalg.norm((V[F[face]] * bary[..., None]).sum(-2) - points, axis=-1), distance)
    for p, d in zip(points.reshape(-1, 3), distance.ravel()):
        assert np.isclose(min(distance_to(*V[f], p) for f in F), d, rtol=1e-12)
    assert (tree.nearest(points, threads=1).distance == distance).all()


@pytest.mark.parametrize('wrong, message', [
    (lambda inverse, tree: majorant.InverseMap('a.vtu'), 'str is no Map'),
    (lambda inverse, tree: inverse.locate([1, 2, 3]), 'uv has shape (3,); the last side must be 2'),
    (lambda inverse, tree: inverse.locate(0.5), 'uv has shape (); the last side must be 2'),
    (lambda inverse, tree: inverse.locate([[0, np.nan]]), 'uv[0, 1] is nan'),
    (lambda inverse, tree: inverse.preimages([['a', 'b']]), 'uv holds text'),
    (lambda inverse, tree: inverse.preimages([[0, 0]], threads=-1), 'threads=-1 is no integer'),
    (lambda inverse, tree: tree.nearest([[0, 0]]), 'points has shape (1, 2); the last side must be 3'),
    (lambda inverse, tree: majorant.SurfaceTree([[0, 0, 0]], [[0, 0, 1]]), 'F[0, 2] is 1, but there are 1 vertices'),
    (lambda inverse, tree: majorant.SurfaceTree([[0, 0, 0]], np.zeros((0, 3), int)), 'F is empty'),
])
def test_wrong_arguments(wrong, message):
    V, F = helpers.grid(2)
    inverse, tree = majorant.InverseMap(majorant.parametrize(V, F, degree=1)), majorant.SurfaceTree(V, F)
    with pytest.raises(majorant.UsageError) as raised:
        wrong(inverse, tree)
    assert message in str(raised.value)
    assert inverse.locate(np.zeros((0, 2))).face.shape == (0,)


if __name__ == '__main__':
    helpers.main(__file__)
