#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Derivatives of maps of parametrize() and deform() by their data, compared with differences of whole runs."""
import pickle

import helpers
import numpy as np
import pytest

import majorant

N = 5
Y, X = np.divmod(np.arange(N * N), N)
V = np.stack([X / 4, Y / 4, 0.2 * np.sin(X) * np.cos(Y)], 1)
A = np.arange(N * N).reshape(N, N)[:-1, :-1].ravel()
F = np.concatenate([np.stack([A, A + 1, A + N + 1], 1), np.stack([A, A + N + 1, A + N], 1)])
PINS = {0: np.array([0, 0]), 4: np.array([1.1, 0.1]), 24: np.array([1.0, 1.2])}


def pinned(pins=PINS, V=V, degree=1, energy=(1.0, 0.1)):
    return majorant.parametrize(V, F, degree=degree, pins={v: tuple(p) for v, p in pins.items()}, tolerance=1e-14,
                                energy=[('symmetric-dirichlet', energy[0]), ('asap', energy[1])])


def extrapolated(at, h=4e-3):
    d1, d2, d3 = ((at(t) - at(-t)) / (2 * t) for t in (h, h / 2, h / 4))
    return (16 * (4 * d3 - d2) - (4 * d2 - d1)) / 45


@pytest.mark.parametrize('degree', [1, 2])
def test_forward_and_adjoint_are_those_of_whole_runs(degree):
    rng = np.random.default_rng(degree)
    dp, dw, dV = rng.normal(size=(3, 2)), np.array([0.3, 0.2]), 0.3 * rng.normal(size=V.shape) * (degree == 1)

    def at(t):
        moved = {v: p + t * d for (v, p), d in zip(PINS.items(), dp)}
        return pinned(moved, V + t * dV, degree, np.array([1.0, 0.1]) + t * dw).control_points

    r = pinned(degree=degree)
    rest = {'rest': dV} if degree == 1 else {}
    dx, expected = r.forward(pins=dp, weights=dw, **rest), extrapolated(at)
    assert np.linalg.norm(dx - expected) < 1e-5 * np.linalg.norm(expected)     # the accuracy is limited by the tolerance of runs
    slope = rng.normal(size=dx.shape)
    d = r.adjoint(slope)
    product = (d.pins * dp).sum() + d.weights @ dw + ((d.rest * dV).sum() if degree == 1 else 0)
    assert product == pytest.approx((slope * dx).sum(), rel=1e-8)
    assert d.motions == 0 and d.error < 1e-9 and (d.rest is None) == (degree == 2)


def test_handles_of_deformations():
    flat, targets = V[:, :2], {0: (0, 0), 4: (1.2, 0.1), 24: (1, 1.3)}
    dh, dsoft = np.array([[0.1, 0.2], [-0.3, 0.1], [0.2, 0.2]]), 3.0

    def run(t):
        handles = {v: tuple(np.add(p, t * d)) for (v, p), d in zip(targets.items(), dh)}
        return majorant.deform(flat, F, handles=handles, degree=1, soft=20 + t * dsoft, tolerance=1e-14)

    r = run(0)
    dx, expected = r.forward(handles=dh, soft=dsoft), extrapolated(lambda t: run(t).control_points)
    assert np.linalg.norm(dx - expected) < 1e-5 * np.linalg.norm(expected)
    d = r.adjoint(np.ones_like(dx))
    assert (d.handles * dh).sum() + d.soft * dsoft == pytest.approx(dx.sum(), rel=1e-8)


def test_free_maps_have_derivatives_of_least_norm_or_in_a_gauge():
    r = majorant.parametrize(V, F, degree=1, energy='symmetric-dirichlet + 0.1*asap', tolerance=1e-13)
    dx, held = r.forward(weights=[0, 1]), r.forward(weights=[0, 1], gauge=(3, 20))
    x, y = r.control_points.T
    for motion in (np.stack([0 * x + 1, 0 * y], 1), np.stack([0 * x, 0 * y + 1], 1), np.stack([-y, x], 1)):
        assert abs((motion * dx).sum()) < 1e-8 * np.linalg.norm(motion) * np.linalg.norm(dx)
    assert np.allclose(held[3], 0, atol=1e-14)
    along = r.control_points[20] - r.control_points[3]
    assert abs(np.cross(along, held[20])) < 1e-9 * np.linalg.norm(held)
    assert r.adjoint(np.ones_like(dx)).motions == 3
    assert np.linalg.norm(r.forward(weights=[1, 0.1])) < 1e-6      # scaling both weights does not change the map


def free(**options):
    return majorant.parametrize(V, F, degree=1, **options)


ROUND = majorant.read_mesh(helpers.MESHES / 'helix.obj')
CLOSED = majorant.read_mesh(helpers.MESHES / 'buckle.obj')


@pytest.mark.parametrize('call, kind, message', [
    (lambda: pinned().forward(pins=[[1, 0]]), majorant.UsageError, 'pins'),
    (lambda: pinned().forward(pins=np.full((3, 2), np.nan)), majorant.UsageError, 'pins'),
    (lambda: pinned().forward(handles=[[1, 0]]), majorant.UsageError, 'handles'),
    (lambda: pinned().forward(weights=[1.0]), majorant.UsageError, 'weights'),
    (lambda: pinned().forward(soft=1.0), majorant.UsageError, 'no handles'),
    (lambda: pinned().forward(soft=np.nan), majorant.UsageError, 'soft'),
    (lambda: pinned().forward(rest=V[:3]), majorant.UsageError, 'rest'),
    (lambda: pinned(degree=2).forward(rest=V), majorant.UnsupportedError, 'degree 2'),
    (lambda: pinned().adjoint(np.ones(50)), majorant.UsageError, 'dL_duv'),
    (lambda: pinned().adjoint(np.full((25, 2), np.inf)), majorant.UsageError, 'dL_duv'),
    (lambda: pinned().forward(gauge=(0, 1)), majorant.UsageError, 'gauge'),
    (lambda: free().forward(gauge=(0, 99)), majorant.UsageError, 'gauge'),
    (lambda: free().forward(gauge=(2, 2)), majorant.UsageError, 'twice'),
    (lambda: free(improve_mesh=True).forward(), majorant.UnsupportedError, 'flipped'),
    (lambda: majorant.unwrap(V, F).adjoint(V[:, :2]), majorant.UnsupportedError, 'unwrap'),
    (lambda: pickle.loads(pickle.dumps(free())).forward(), majorant.UnsupportedError, 'unpickled'),
    (lambda: majorant.parametrize(*ROUND, degree=1, bijective=True).forward(), majorant.UnsupportedError, 'scaffold'),
    (lambda: majorant.seamless(*CLOSED, degree=1).forward(), majorant.UnsupportedError, 'seamless'),
])
def test_wrong_calls(call, kind, message):
    with pytest.raises(kind, match=message):
        call()


if __name__ == '__main__':
    helpers.main(__file__)
