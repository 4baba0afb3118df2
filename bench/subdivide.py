#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Large meshes from small ones: every triangle of an OBJ cut into k x k flat ones.

Sample run:
    bench/subdivide.py 10 ../shared/data/public/disks/spot_10000.obj /tmp/spot_1000000.obj

The surface stays the same, so its maps get better by what finer triangles allow and no more.
Plain triangles only; texture coordinates are left out.
"""
import sys


def read(path):
    positions, faces = [], []
    with open(path) as f:
        for line in f:
            words = line.split()
            if words[:1] == ['v']:
                positions.append([float(w) for w in words[1:4]])
            elif words[:1] == ['f']:
                faces.append([int(w.split('/')[0]) - 1 for w in words[1:]])
    return positions, faces


def point(positions, weights):
    return tuple(sum(w * positions[v][c] for v, w in weights) for c in range(3))


def subdivide(positions, faces, k):
    """Points (i a + j b + (k - i - j) c) / k of every face, those on edges and corners shared."""
    points, number = list(map(tuple, positions)), {}
    cells = []

    def vertex(corners):
        key = tuple(sorted((v, n) for v, n in corners if n > 0))
        if len(key) == 1:
            return key[0][0]
        if key not in number:
            number[key] = len(points)
            points.append(point(positions, [(v, n / k) for v, n in key]))
        return number[key]

    for a, b, c in faces:
        at = {(i, j): vertex(((a, k - i - j), (b, i), (c, j)))
              for i in range(k + 1) for j in range(k + 1 - i)}
        for i in range(k):
            for j in range(k - i):
                cells.append((at[i, j], at[i + 1, j], at[i, j + 1]))
                if i + j < k - 1:
                    cells.append((at[i + 1, j], at[i + 1, j + 1], at[i, j + 1]))
    return points, cells


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    points, cells = subdivide(*read(sys.argv[2]), int(sys.argv[1]))
    with open(sys.argv[3], 'w') as f:
        for p in points:
            f.write('v %.17g %.17g %.17g\n' % p)
        for cell in cells:
            f.write('f %d %d %d\n' % tuple(v + 1 for v in cell))


if __name__ == '__main__':
    main()
