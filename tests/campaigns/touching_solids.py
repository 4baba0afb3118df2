#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Makes quads of solids that touch or are nested: `majorant quads`, then `check --quads --surface`.

Boxes that share a face, an edge or a vertex; nested spheres; balls in hollow balls; thin plates; stacks of
boxes. Kind, sizes and number of quads follow from the number of the mesh on every machine. Exit code 0 if
every written file passes, and every run ends with 0, 3 or 4; runs with 3 are printed with their reason.

Sample runs:
  tests/campaigns/touching_solids.py build/release/apps/majorant               # 500 meshes
  tests/campaigns/touching_solids.py build/release/apps/majorant --first 40 --count 20
"""
import argparse
import math
import random
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

SIDES = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
OK, UNSUPPORTED, LIMIT = 0, 3, 4


class Solids:
    def __init__(self):
        self.points, self.faces = [], []

    def add(self, points, faces):
        first = len(self.points)
        self.points += points
        self.faces += [tuple(first + v for v in face) for face in faces]

    def box(self, low, size):
        self.add([tuple(l + s * (k >> axis & 1) for axis, (l, s) in enumerate(zip(low, size))) for k in range(8)],
                 [half for a, b, c, d in SIDES for half in ((a, b, c), (a, c, d))])

    def sphere(self, radius, centre=(0, 0, 0), is_inside_out=False, around=20, rings=9):
        points = [(0, 0, 1)] + [(math.sin(t) * math.cos(a), math.sin(t) * math.sin(a), math.cos(t))
                                for t in (math.pi * (j + 1) / (rings + 1) for j in range(rings))
                                for a in (2 * math.pi * i / around for i in range(around))] + [(0, 0, -1)]
        faces = []
        for i in range(around):
            j, last = (i + 1) % around, 1 + (rings - 1) * around
            faces += [(0, 1 + i, 1 + j), (last + i, len(points) - 1, last + j)]
            for ring in range(rings - 1):
                a, b = 1 + ring * around + i, 1 + ring * around + j
                faces += [(a, a + around, b + around), (a, b + around, b)]
        self.add([tuple(c + radius * x for c, x in zip(centre, p)) for p in points],
                 [face[::-1] for face in faces] if is_inside_out else faces)

    def welded(self):
        number = {}
        for p in self.points:
            number.setdefault(p, len(number))
        names = [number[p] for p in self.points]
        self.points, self.faces = list(number), [tuple(names[v] for v in face) for face in self.faces]


def made(seed):
    """Returns (kind, solids, number of quads)."""
    chance = random.Random(seed)
    kind = ('face', 'edge', 'vertex', 'nested', 'eye', 'plate', 'stack')[seed % 7]
    solids, size = Solids(), [chance.uniform(0.5, 2) for _ in range(3)]
    if kind in ('face', 'edge', 'vertex'):
        solids.box((0, 0, 0), size)
        touching = {'face': 1, 'edge': 2, 'vertex': 3}[kind]
        solids.box([s if axis < touching else 0.0 for axis, s in enumerate(size)], size)
        if chance.random() < 0.5:
            solids.welded()
    elif kind == 'nested':
        solids.sphere(1)
        solids.sphere(chance.uniform(0.5, 0.99), is_inside_out=True)
    elif kind == 'eye':
        hollow = chance.uniform(0.5, 0.95)
        solids.sphere(1)
        solids.sphere(hollow, is_inside_out=True)
        solids.sphere(hollow * chance.uniform(0.7, 0.99))
    elif kind == 'plate':
        solids.box((0, 0, 0), [2.0, chance.uniform(0.5, 2), chance.uniform(0.005, 0.1)])
        if chance.random() < 0.5:
            solids.box((0, 0, 0.2), [2.0, 1.0, chance.uniform(0.005, 0.1)])
    else:
        low = 0.0
        for level in range(chance.randrange(2, 5)):
            height, width = chance.uniform(0.2, 0.8), 2 * 0.8 ** level
            solids.box((-width / 2, -width / 2, low), (width, width, height))
            low += height
    return kind, solids, chance.choice([60, 150, 400, 1000])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split('\n')[0])
    parser.add_argument('binary')
    parser.add_argument('--first', type=int, default=0)
    parser.add_argument('--count', type=int, default=500)
    parser.add_argument('--only', type=int)
    requested = parser.parse_args()
    exits, wrong = Counter(), 0
    with tempfile.TemporaryDirectory() as folder:
        source, quads = Path(folder, 'solids.obj'), Path(folder, 'quads.obj')
        for seed in [requested.only] if requested.only is not None else range(requested.first, requested.first + requested.count):
            kind, solids, count = made(seed)
            source.write_text(''.join('v %r %r %r\n' % p for p in solids.points) +
                              ''.join('f %d %d %d\n' % tuple(v + 1 for v in face) for face in solids.faces))
            run = subprocess.run([requested.binary, 'quads', source, '-o', quads, '--force', '--count', str(count), '--quiet'],
                                 capture_output=True, text=True)
            exits[kind, run.returncode] += 1
            printed = '' if run.returncode in (OK, LIMIT) else run.stderr.strip()
            wrong += run.returncode not in (OK, UNSUPPORTED, LIMIT)
            if run.returncode in (OK, LIMIT):
                check = subprocess.run([requested.binary, 'check', quads, '--quads', '--surface', source, '--max-distance', '1'],
                                       capture_output=True, text=True)
                if check.returncode != OK:
                    wrong += 1
                    printed = 'CHECK ' + (check.stdout + check.stderr).strip()
            if printed:
                print('%d %s, %d quads: exit %d: %s' % (seed, kind, count, run.returncode, printed), flush=True)
    for (kind, code), number in sorted(exits.items()):
        print('%-7s exit %d: %d' % (kind, code, number))
    print('%d wrong' % wrong)
    return 1 if wrong else 0


if __name__ == '__main__':
    sys.exit(main())
