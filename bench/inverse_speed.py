#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Measures how many points of a layout `majorant.InverseMap` locates per second of one core; needs the Python package.

  PYTHONPATH=build/release/python bench/inverse_speed.py [--mesh MESH.obj] [--cuts 1,2,4]

Maps: one of degree 1 of the mesh with its faces cut into k x k, and one of degree 3. Random points of the layout are
located on one thread: a tenth of them, and all. Times are CPU seconds, which other processes affect by the caches only.
Building: of the tree.
"""
import argparse
import time
from pathlib import Path

import numpy as np

import majorant


def cut(V, F, k):
    """Cuts every face into k x k, in the order of rows. Points on edges are shared."""
    if k == 1:
        return V, F
    at = [(i, j) for i in range(k + 1) for j in range(k + 1 - i)]
    number = {ij: n for n, ij in enumerate(at)}
    weights = np.array([(k - i - j, i, j) for i, j in at])
    ends = np.stack([np.broadcast_to(F[:, None], (len(F), len(at), 3)), np.broadcast_to(weights, (len(F), len(at), 3))], -1)
    ends[ends[..., 1] == 0] = -1
    order = np.argsort(ends[..., 0], axis=-1)
    keys = np.take_along_axis(ends, order[..., None], 2).reshape(-1, 6)
    _, first, corner = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    points = (V[F][:, None] * (weights / k)[None, :, :, None]).sum(2).reshape(-1, 3)
    corner = corner.reshape(len(F), len(at))
    cells = [(number[i, j], number[i + 1, j], number[i, j + 1]) for i in range(k) for j in range(k - i)]
    cells += [(number[i + 1, j], number[i + 1, j + 1], number[i, j + 1]) for i in range(k) for j in range(k - i - 1)]
    return points[first], corner[:, cells].reshape(-1, 3)


def row(r, count):
    random = np.random.default_rng(34)
    start = time.process_time()
    inverse = majorant.InverseMap(r)
    building = time.process_time() - start
    face, bary = random.integers(0, len(r.faces), count), random.dirichlet((1, 1, 1), count)
    uv = r.evaluate(face, bary)
    rates = []
    for part in (uv[:count // 10], uv):
        start = time.process_time()
        found = inverse.locate(part, threads=1)
        rates.append('%.2f' % (len(part) / (time.process_time() - start) / 1e6))
        assert (found.face >= 0).all()
    print('| ' + ' | '.join(map(str, [r.degree, len(r.faces), '%.2f' % building, count, *rates])) + ' |', flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    shared = Path(__file__).resolve().parents[1].parent / 'shared/data/public/disks/nefertiti_10000.obj'
    parser.add_argument('--mesh', default=str(shared))
    parser.add_argument('--cuts', default='1,2,4')
    parser.add_argument('--points', type=int, default=1000000)
    options = parser.parse_args()
    V, F = majorant.read_mesh(options.mesh)
    uv = majorant.flatten(V, F)
    print('| degree | faces | building, s | points | M points/s of a tenth | of all |')
    print('|--:|--:|--:|--:|--:|--:|')
    for k in map(int, options.cuts.split(',')):
        fine, faces = cut(V, F, k)
        flat, again = cut(np.column_stack([uv, np.zeros(len(uv))]), F, k)
        assert np.array_equal(faces, again)
        row(majorant.parametrize(fine, faces, degree=1, uv=flat[:, :2], init='input', time_limit=0), options.points)
    row(majorant.parametrize(V, F, degree=3), options.points)


if __name__ == '__main__':
    main()
