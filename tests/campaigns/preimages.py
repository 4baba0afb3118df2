#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests `majorant.InverseMap` on maps of public meshes with a million random points per row: every point of a
layout must be found exactly once, and no point outside. Needs the Python package (PYTHONPATH).

Inside: images of random points of faces. Misses have no preimage, doubles several; an "other" point is found
in another face although it is 1e-9 inside its own. Beside: random points of the layout's box are compared
with the winding number of the boundary, cut into short chords; points nearer to the boundary than the sagitta
do not count. A sample is judged in rational numbers without the library. For straight faces, exactly one face
must contain the point, at the coordinates found. For curved faces, Kantorovich's theorem must prove a
preimage within 2 eta of the point found, and no other one in its neighbourhood; the proof of the layout
excludes others elsewhere.

Prints a Markdown table; exit code 0 exactly if no number of misses, doubles, others and wrong ones is above
0.

Sample runs:
  PYTHONPATH=build/release/python tests/campaigns/preimages.py --shared ../shared
  PYTHONPATH=build/release/python tests/campaigns/preimages.py --points 20000 --models hand,spot
"""
import argparse
import sys
import time
from fractions import Fraction
from math import factorial
from pathlib import Path

import numpy as np

import majorant

MODELS = ['blub', 'demosthenes', 'goathead', 'hand', 'helix', 'koala', 'mountain', 'nefertiti', 'penguin', 'plane',
          'scorpion', 'skull', 'spot']
CLOSED = ['spot_1654', 'blub_1886', 'torus_g1_4608']
CHORDS = 64                                       # chords of an edge
BESIDE = 20000                                    # points of the box for each map
INNER = 1e-9                                      # margin in barycentric coordinates
RESIDUAL = 1e-12                                  # relative to the layout's diagonal


def exact(values):
    return [Fraction(float(x)) for x in values]


def random_points(r, count, random):
    face = random.integers(0, len(r.faces), count)
    bary = random.dirichlet((1, 1, 1), count)
    return face, bary, r.evaluate(face, bary)


def border(r):
    """Returns the boundary in short chords, (#, 2, 2), and the largest distance of a curve from its chord."""
    cells, n = r.cells, r.degree
    corners = [cells[:, k] for k in range(3)]
    sides = [np.column_stack([corners[k], corners[(k + 1) % 3]]) for k in range(3)]
    # Both cells of a shared edge list its nodes, so the edges that occur once are the boundary.
    all_sides = np.concatenate(sides)
    where = np.concatenate([np.column_stack([np.arange(len(cells)), np.full(len(cells), k)]) for k in range(3)])
    _, place, times = np.unique(np.sort(all_sides, 1), axis=0, return_index=True, return_counts=True)
    face, k = where[place[times == 1]].T
    t = np.linspace(0, 1, CHORDS + 1)
    bary = np.zeros((len(face), CHORDS + 1, 3))
    bary[np.arange(len(face))[:, None], np.arange(CHORDS + 1), k[:, None]] = 1 - t
    bary[np.arange(len(face))[:, None], np.arange(CHORDS + 1), (k[:, None] + 1) % 3] = t
    line = r.evaluate(np.repeat(face[:, None], CHORDS + 1, 1), bary)
    bend = np.abs(np.diff(line, 2, axis=1)).max() if n > 1 else 0.0
    return np.stack([line[:, :-1], line[:, 1:]], 2).reshape(-1, 2, 2), bend


def windings(chords, points):
    """Returns the winding number of the border around each point, and a lower bound of its distance to the
    border."""
    turns, distance = np.zeros(len(points), int), np.full(len(points), np.inf)
    for a, b in chords:
        side = (b[0] - a[0]) * (points[:, 1] - a[1]) - (b[1] - a[1]) * (points[:, 0] - a[0])
        turns += (a[1] <= points[:, 1]) & (points[:, 1] < b[1]) & (side > 0)
        turns -= (b[1] <= points[:, 1]) & (points[:, 1] < a[1]) & (side < 0)
        d = b - a
        t = np.clip((points - a) @ d / max(d @ d, 1e-300), 0, 1)
        distance = np.minimum(distance, np.linalg.norm(points - a - t[:, None] * d, axis=1))
    return turns, distance


def beside(r, inverse, random):
    """Tests random points of the box. Returns how many were judged, and how many wrongly."""
    chords, bend = border(r)
    low, high = r.control_points.min(0), r.control_points.max(0)
    points = random.uniform(low, high, (BESIDE, 2))
    turns, distance = windings(chords, points)
    clear = distance > max(bend, 1e-12 * np.linalg.norm(high - low))
    found = np.bincount(inverse.preimages(points).point, minlength=BESIDE)
    return int(clear.sum()), int((found != turns)[clear].sum())


def cross(a, b):
    return a[0] * b[1] - a[1] * b[0]


def wrong_straight(r, uv, face, bary):
    """Returns True unless exactly this face contains the point, at these coordinates."""
    corner = r.corner_uv
    near = np.flatnonzero((corner.min(1) <= uv).all(1) & (uv <= corner.max(1)).all(1))
    p, owners = exact(uv), []
    for f in near:
        c = [exact(x) for x in corner[f]]
        weights = [cross([c[(k + 1) % 3][i] - p[i] for i in (0, 1)], [c[(k + 2) % 3][i] - p[i] for i in (0, 1)])
                   for k in range(3)]
        if min(weights) >= 0:
            owners.append((f, [w / sum(weights) for w in weights]))
    if [f for f, _ in owners] != [face]:
        return True
    return any(abs(a - b) > Fraction(RESIDUAL) for a, b in zip(owners[0][1], exact(bary)))


def bezier(points, n, b):
    """Evaluates Bernstein polynomials exactly. points: {(i, j, k): [u, v]}."""
    value = [Fraction(0), Fraction(0)]
    for (i, j, k), p in points.items():
        w = Fraction(factorial(n), factorial(i) * factorial(j) * factorial(k)) * b[0] ** i * b[1] ** j * b[2] ** k
        value = [value[0] + w * p[0], value[1] + w * p[1]]
    return value


def differences(points, first, second):
    """Returns differences of neighbours along two corners, which times n are the control points of a
    derivative."""
    out = {}
    for key, p in points.items():
        if key[second] == 0:
            continue
        lower = list(key)
        lower[second] -= 1
        other = list(lower)
        other[first] += 1
        q = points[tuple(other)]
        out[tuple(lower)] = [q[0] - p[0], q[1] - p[1]]
    return out


def wrong_curved(r, uv, face, bary, size, indices):
    """Returns True if Kantorovich's theorem proves no preimage at these coordinates."""
    n = r.degree
    points = {tuple(map(int, a)): exact(r.control_points[node]) for a, node in zip(indices, r.cells[face])}
    b = exact(bary)
    b[2] = 1 - b[0] - b[1]
    at, target = bezier(points, n, b), exact(uv)
    residual = [at[0] - target[0], at[1] - target[1]]
    if residual[0] ** 2 + residual[1] ** 2 > (Fraction(RESIDUAL) * Fraction(size)) ** 2:
        return True
    by = [differences(points, k, 2) for k in (0, 1)]
    J = [[n * x for x in bezier(d, n - 1, b)] for d in by]  # columns of the Jacobian
    det = cross(J[0], J[1])
    if det <= 0:
        return True
    inverse = [[J[1][1] / det, -J[1][0] / det], [-J[0][1] / det, J[0][0] / det]]
    eta = sum(abs(row[0] * residual[0] + row[1] * residual[1]) for row in inverse)
    beta = sum(abs(x) for row in inverse for x in row)
    gamma = sum(n * (n - 1) * max(abs(x) for p in differences(d, k, 2).values() for x in p) for d in by for k in (0, 1))
    return 2 * beta * gamma * eta * 2 > 1 or min(b) <= 4 * eta


class Row:
    """The counters over all maps of a row."""

    def __init__(self):
        self.maps = self.points = self.misses = self.doubles = self.other = self.undecided = 0
        self.beside = self.wrong_beside = self.samples = self.wrong = 0
        self.residual = self.seconds = 0.0

    def add(self, r, count, samples, random):
        inverse = majorant.InverseMap(r)
        face, bary, uv = random_points(r, count, random)
        start = time.process_time()
        found = inverse.locate(uv, threads=1)
        self.seconds += time.process_time() - start
        times = np.bincount(inverse.preimages(uv).point, minlength=count)
        size = float(np.linalg.norm(np.ptp(r.control_points, axis=0)))
        is_found = found.face >= 0
        inner = is_found & (bary.min(1) > INNER)
        self.maps += 1
        self.points += count
        self.misses += int((times == 0).sum() + (~is_found).sum())
        self.doubles += int((times > 1).sum())
        self.other += int((found.face != face)[inner].sum())
        self.undecided += int(found.undecided.sum())
        at = r.evaluate(found.face[is_found], found.bary[is_found])
        self.residual = max(self.residual, float(np.abs(at - uv[is_found]).max()) / size)
        judged, wrong = beside(r, inverse, random)
        self.beside += judged
        self.wrong_beside += wrong
        indices = majorant._core.multi_indices(r.degree)
        for k in np.flatnonzero(inner)[:samples]:
            self.samples += 1
            if r.degree == 1:
                self.wrong += wrong_straight(r, uv[k], found.face[k], found.bary[k])
            else:
                self.wrong += wrong_curved(r, uv[k], found.face[k], found.bary[k], size, indices)

    def is_right(self):
        return not (self.misses or self.doubles or self.other or self.wrong_beside or self.wrong)

    def cells(self):
        return [self.maps, self.points, self.misses, self.doubles, self.other, self.undecided, '%.1e' % self.residual,
                self.beside, self.wrong_beside, self.samples, self.wrong, '%.2f' % (self.points / self.seconds / 1e6)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--shared', type=Path, default=Path(__file__).resolve().parents[2].parent / 'shared')
    parser.add_argument('--models', default=','.join(MODELS), help='public disks of 500 faces')
    parser.add_argument('--degrees', default='1,2,3,4')
    parser.add_argument('--points', type=int, default=1000000, help='points per row')
    parser.add_argument('--samples', type=int, default=50, help='points per map that are judged in rational numbers')
    options = parser.parse_args()
    public = options.shared / 'data/public'
    models = options.models.split(',')
    print('| maps | | points | misses | doubles | other | undecided | residual, of the layout | beside | wrong | '
          'rational | wrong | M points/s |')
    print('|---' + '|--:' * 12 + '|')
    is_right = True

    def print_row(name, meshes, solve):
        nonlocal is_right
        row, random = Row(), np.random.default_rng(34)
        for path in meshes:
            row.add(solve(*majorant.read_mesh(path)), options.points // len(meshes) + 1, options.samples, random)
        print('| ' + ' | '.join(map(str, [name, *row.cells()])) + ' |', flush=True)
        is_right = is_right and row.is_right()

    for degree in map(int, options.degrees.split(',')):
        print_row('disks, degree %d' % degree, [public / 'disks' / ('%s_500.obj' % m) for m in models],
                  lambda V, F: majorant.parametrize(V, F, degree=degree, bijective=True))
    print_row('atlases', [public / 'closed' / (name + '.obj') for name in CLOSED], majorant.unwrap)
    return 0 if is_right else 1


if __name__ == '__main__':
    sys.exit(main())
