#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Unwraps about four hundred meshes of every kind, and counts the results that are written and proven, and
the charts above the stretch limit, which the program excuses with a message.

    tests/campaigns/atlases.py build/release/apps/majorant [--meshes FOLDER] [--every K] [--only KIND]

Kinds: all public surfaces (refused ones, exit 2, are counted apart); the two hundred hard-surface models of
hard_surfaces.py; the closed public meshes as exporters split them (at normals, at a seam, at materials, at
all corners), whose charts must be as many as those of the whole mesh with the same materials; two-sided
cards, which stay two charts; prisms over letters. A result is written if the exit code is 0 or 4, and proven
if `check --certify` accepts it. Prints one row per kind. Exit code 1 if a file is missing or not proven, a
split export has a different number of charts, or a card does not have two charts; also if a hard-surface model
has an excused chart, or more than 1 % of all charts are excused.
"""
import argparse
import glob
import json
import math
import os
import random
import subprocess
import sys
import tempfile
from collections import defaultdict

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'apps'))
from command_helpers import obj_text, read_obj  # noqa: E402
from hard_surfaces import family  # noqa: E402

PUBLIC = ('closed/*.obj', 'disks/*.obj', 'seamless/*.obj', 'messy/derived/*.*', 'messy/real/*.*', 'bad/*.obj')
SURFACES = ('.obj', '.off', '.ply', '.stl', '.gz')
# Letters as bars on a grid of 5 by 7 cells, as on a segment display.
LETTERS = ('11111/10000/10000/11110/10000/10000/11111', '11110/10001/10001/11110/10001/10001/11110',
           '10001/10001/10001/11111/10001/10001/10001', '01110/10001/10001/10001/10001/10001/01110',
           '11111/00100/00100/00100/00100/00100/00100', '10000/10000/10000/10000/10000/10000/11111',
           '10001/11001/10101/10011/10001/10001/10001', '01110/10001/10001/11111/10001/10001/10001')
# Seconds after which a run counts as failed.
LONGEST = 1800


def split_export(points, faces, key):
    """Returns an OBJ with a vertex for each (position, key(face, corner)), and a second material on every
    third face."""
    number, lines, body = {}, [], []
    for k, face in enumerate(faces):
        corners = []
        for i, v in enumerate(face):
            if (v, key(k, i)) not in number:
                number[v, key(k, i)] = len(number) + 1
                lines.append('v %r %r %r' % tuple(map(float, points[v])))
            corners.append(number[v, key(k, i)])
        if k % 3 == 0:
            body.append('usemtl stuff%d' % (k % 2))
        body.append('f ' + ' '.join('%d//1' % c for c in corners))
    return '\n'.join(lines + ['vn 0 0 1'] + body) + '\n'


def keys(points, faces):
    def normal(k, i):
        a, b, c = (points[v] for v in faces[k][:3])
        u, w = [x - y for x, y in zip(b, a)], [x - y for x, y in zip(c, a)]
        n = (u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0])
        return tuple(round(x / (math.hypot(*n) or 1), 1) for x in n)
    return {'normals': normal, 'seam': lambda k, i: sum(points[v][0] for v in faces[k]) > 0,
            'materials': lambda k, i: k // 3 % 2, 'corners': lambda k, i: (k, i)}


def card(seed):
    """Returns a bent two-sided sheet of quads."""
    rng = random.Random(seed)
    n, m, a, b = rng.randint(1, 8), rng.randint(1, 8), rng.uniform(-0.4, 0.4), rng.uniform(-0.4, 0.4)
    points = [(x / n, y / m, a * (x / n) ** 2 + b * (y / m) ** 2) for y in range(m + 1) for x in range(n + 1)]
    front = [[y * (n + 1) + x, y * (n + 1) + x + 1, (y + 1) * (n + 1) + x + 1, (y + 1) * (n + 1) + x]
             for y in range(m) for x in range(n)]
    return points, front + [face[::-1] for face in front]


def prism(letter, height, per_cell):
    """Returns the letter as a closed solid with divided cells; sides that meet only at a corner stay
    separate."""
    rows = LETTERS[letter].split('/')[::-1]
    n = per_cell
    filled = {(x, y) for j, row in enumerate(rows) for i, c in enumerate(row) if c == '1'
              for x in range(i * n, i * n + n) for y in range(j * n, j * n + n)}
    number, points, faces = {}, [], []

    def at(x, y, z):
        if (x, y, z) not in number:
            number[x, y, z] = len(points)
            points.append((x / n, y / n, z * height))
        return number[x, y, z]
    for x, y in sorted(filled):
        ring = [(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)]
        faces.append([at(a, b, 1) for a, b in ring])
        faces.append([at(a, b, 0) for a, b in ring[::-1]])
        for (a, b), (c, d), beside in zip(ring, ring[1:] + ring[:1], [(x, y - 1), (x + 1, y), (x, y + 1), (x - 1, y)]):
            if beside not in filled:
                faces.append([at(a, b, 0), at(c, d, 0), at(c, d, 1), at(a, b, 1)])
    return points, faces


def meshes(folder):
    """Yields (kind, name, text or path, expected number of charts or the name of the mesh with the same
    number)."""
    for pattern in PUBLIC:
        for path in sorted(glob.glob(os.path.join(folder, pattern))):
            if path.endswith(SURFACES):
                yield 'public', os.path.relpath(path, folder), path, None
    for name, points, faces in family():
        yield 'hard surfaces', name, obj_text(points, faces), None
    for path in sorted(glob.glob(os.path.join(folder, 'closed', '*.obj'))):
        points, faces = read_obj(path)[0], read_obj(path)[2]
        name = os.path.basename(path)
        yield 'split exports', name, split_export(points, faces, lambda k, i: 0), None
        for split, key in keys(points, faces).items():
            yield 'split exports', name + ' at ' + split, split_export(points, faces, key), name
    for k in range(32):
        yield 'cards', 'card %d' % k, obj_text(*card(k)), 2
    for k in range(40):
        yield 'letters', 'letter %d' % k, obj_text(*prism(k % len(LETTERS), 0.3 + k / 20, 1 + k // 8)), None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('majorant')
    parser.add_argument('--meshes', default='../shared/data/public')
    parser.add_argument('--every', type=int, default=1)
    parser.add_argument('--only')
    args = parser.parse_args()
    rows, wrong, charts_of = defaultdict(lambda: defaultdict(int)), [], {}
    with tempfile.TemporaryDirectory() as folder:
        given, out, report = (os.path.join(folder, name) for name in ('given.obj', 'out.obj', 'r.json'))
        for k, (kind, name, what, expected) in enumerate(meshes(args.meshes)):
            if k % args.every or (args.only and kind != args.only):
                continue
            row, path = rows[kind], what
            if '\n' in what:
                path = given
                with open(path, 'w') as f:
                    f.write(what)
            row['files'] += 1
            if os.path.exists(out):
                os.remove(out)
            try:
                done = subprocess.run([args.majorant, 'unwrap', path, '-o', out, '--report', report, '--threads', '1',
                                       '--quiet'], text=True, stderr=subprocess.PIPE, timeout=LONGEST)
                code, says = done.returncode, done.stderr
            except subprocess.TimeoutExpired:
                code, says = -1, 'no end after %d s' % LONGEST
            if code == 2 and kind == 'public':
                row['refused'] += 1
                continue
            if code not in (0, 4):
                row['lost'] += 1
                wrong.append('%s, %s: exit %d: %s' % (kind, name, code, says.strip()[-200:]))
                continue
            row['written'] += 1
            row['proven'] += subprocess.run([args.majorant, 'check', out, '--certify', '--quiet'],
                                            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode == 0
            with open(report) as f:
                charts = len(json.load(f)['charts'])
            charts_of[name] = charts
            row['charts'] += charts
            excused = says.count('more than --max-stretch')
            row['excused'] += excused
            row['files excused'] += excused > 0
            if excused:
                print('%s, %s: %d of %d charts excused' % (kind, name, excused, charts), flush=True)
            expected = charts_of.get(expected, expected) if isinstance(expected, str) else expected
            if isinstance(expected, int) and charts != expected:
                row['other charts'] += 1
                wrong.append('%s, %s: %d charts, not %d' % (kind, name, charts, expected))
    print('\n'.join(wrong))
    columns = ('files', 'refused', 'written', 'proven', 'lost', 'charts', 'excused', 'files excused', 'other charts')
    print('| kind | %s |\n|%s' % (' | '.join(columns), '---|' * (len(columns) + 1)))
    for kind, row in rows.items():
        print('| %s | %s |' % (kind, ' | '.join(str(row[c]) for c in columns)))
    total = {c: sum(row[c] for row in rows.values()) for c in columns}
    return bool(wrong or total['written'] > total['proven'] or rows['hard surfaces']['excused'] or
                100 * total['excused'] > total['charts'])


if __name__ == '__main__':
    sys.exit(main())
