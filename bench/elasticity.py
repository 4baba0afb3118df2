#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""The public elasticity suite (bench/elasticity/README.md): makes its starts and prints the tables.

Random starts equal those of the suite: they use the generator of numpy with the same seeds.

Sample runs:
  bench/elasticity.py
  bench/elasticity.py --only disks,folds
  bench/elasticity.py --boxes 12                     # without the large ones
"""
import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.dont_write_bytecode = True
BENCH = Path(__file__).resolve().parent
DISKS = [(6, 0), (6, 2), (8, 0), (8, 1), (8, 3), (10, 0)]     # squares per side, seed
FOLDED_SQUARES = 12


def grid(n):
    """Returns the vertices of the unit square, row by row from below, and flags of those on its border."""
    axis = np.linspace(0, 1, n + 1)
    x, y = np.meshgrid(axis, axis)
    points = np.column_stack((x.ravel(), y.ravel()))
    return points, ((points < 1e-9) | (points > 1 - 1e-9)).any(axis=1)


def is_injective(points, n):
    """Returns whether both triangles of every square, cut along its diagonal from lower left, are positive."""
    p = points.reshape(n + 1, n + 1, 2)
    a, b, c, d = p[:-1, :-1], p[:-1, 1:], p[1:, 1:], p[1:, :-1]

    def doubled_area(u, v, w):
        s, t = v - u, w - u
        return s[..., 0] * t[..., 1] - s[..., 1] * t[..., 0]
    return (doubled_area(a, b, c) > 0).all() and (doubled_area(a, c, d) > 0).all()


def disk(n, seed, size=0.35):
    """Returns a grid whose inner vertices are moved by normal random numbers, in units of `size` squares, which
    shrinks until no triangle is inverted."""
    points, border = grid(n)
    random = np.random.default_rng(seed)
    size /= n
    while True:
        shift = random.standard_normal(points.shape)
        shift[border] = 0
        if is_injective(points + size * shift, n):
            return points + size * shift
        size *= 0.8


def folded(warp, strength, seed):
    """Returns a sheared square whose part to the right of a line near the middle is mirrored in it."""
    points, border = grid(FOLDED_SQUARES)
    random = np.random.default_rng(seed)
    target = points.copy()
    target[:, 0] += warp * np.sin(np.pi * points[:, 1])
    line = 0.5 + 0.05 * random.standard_normal()
    start = target.copy()
    mirrored = ~border & (points[:, 0] > line)
    start[mirrored, 0] = line - strength * (target[mirrored, 0] - line)
    start[~border] += 0.01 * random.standard_normal((int((~border).sum()), 2))
    return start


def write_starts(path):
    starts = {'disk-%d-%d' % d: disk(*d) for d in DISKS}
    for n in (6, 8, 10, 12):
        for seed in range(5):
            for size in (0.25, 0.35):
                starts['set-%d-%d-%g' % (n, seed, size)] = disk(n, 1000 * seed + n, size)
    for warp in (0.0, 0.3):
        for strength in (1.0, 2.0):
            for seed in (0, 1):
                starts['fold-%g-%g-%d' % (warp, strength, seed)] = folded(warp, strength, seed)
    with open(path, 'w') as file:
        for name, points in starts.items():
            file.write('%s %d %s\n' % (name, len(points), ' '.join(repr(float(v)) for v in points.ravel())))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--program', type=Path, default=BENCH.parent / 'build/release/bench/elasticity')
    parser.add_argument('--only', default='', help='of disks, sets, folds, ring, plane, space, boxes')
    parser.add_argument('--boxes', default='28', help='cubes a side of the largest box, elements across the ring')
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix='majorant_elasticity_') as folder:
        starts = Path(folder) / 'starts.txt'
        write_starts(starts)
        only = ['--only', options.only] if options.only else []
        return subprocess.run([options.program, '--starts', starts, '--boxes', options.boxes, *only]).returncode


if __name__ == '__main__':
    sys.exit(main())
