#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Acceptance of hard pins: random targets at a distance from the positions in a map without pins.

Disks of SHARED/data/public/disks, degrees 1 and 3, sets of 1, 2, 3 and 5 pins in turn. Vertices are
drawn without replacement. Each target is uniform in a circle around the vertex's position in the map
without pins, whose radius is half the diameter of that layout.

A set is reached if the run ends with 0 or 4, `check` accepts the file, and every pin is in the
file with exactly the digits of its target. A set may be refused (exit 3, no file) if this script
finds the reason itself: two pins at one target, or three pins of a face whose targets turn it over.
Prints a Markdown table. Exit code 0 exactly if the share --share is reached and every refusal is
confirmed.

Sample runs:
  bench/pins.py
  bench/pins.py --sets 20 --meshes 'hand|spot|penguin' --flags=--bijective
  bench/pins.py --verb seamless --meshes hand
"""
import json
import math
import random
import re
import sys
import tempfile
from fractions import Fraction
from pathlib import Path

import common

sys.path.append(str(common.ROOT / 'tests/checker'))
from vtu_file import VtuFile  # noqa: E402

COUNTS = (1, 2, 3, 5)
DEGREES = (1, 3)


def places(path):
    """Returns the points (u, v) of each vertex of the mesh in a result; a vertex on a seam has several."""
    vtu = VtuFile(Path(path).read_bytes())
    found = {}
    for vertex, uv in zip(vtu.input_vertex, vtu.uv):
        if vertex >= 0:
            found.setdefault(vertex, set()).add(tuple(uv))
    return found


def faces_of(mesh):
    """Returns the triangles of an OBJ, with vertices from 0."""
    return [tuple(int(word.split('/')[0]) - 1 for word in line.split()[1:])
            for line in Path(mesh).read_text().splitlines() if line.startswith('f ')]


def contradiction(pins, faces):
    """Returns why no map can meet the pins ({vertex: target}), or None."""
    if len(set(pins.values())) < len(pins):
        return 'two pins at one target'
    for face in faces:
        if all(v in pins for v in face):
            a, b, c = ([Fraction(x) for x in pins[v]] for v in face)
            if (b[0] - a[0]) * (c[1] - a[1]) <= (b[1] - a[1]) * (c[0] - a[0]):
                return 'a face is turned over'
    return None


def draw(free, count, rng):
    """Draws pins {vertex: target}."""
    corners = [p for points in free.values() for p in points]
    width, height = (max(p[k] for p in corners) - min(p[k] for p in corners) for k in (0, 1))
    radius = math.hypot(width, height) / 2
    pins = {}
    for vertex in rng.sample(sorted(v for v in free if len(free[v]) == 1), count):
        (u, v), = free[vertex]
        angle, r = rng.uniform(0, 2 * math.pi), radius * math.sqrt(rng.random())
        pins[vertex] = (u + r * math.cos(angle), v + r * math.sin(angle))
    return pins


def attempt(options, mesh, degree, pins, folder):
    """Returns (whether the set is reached, what was found)."""
    result, file = folder / 'pinned.vtu', folder / 'pins.json'
    result.unlink(missing_ok=True)
    file.write_text(json.dumps({'handles': [{'vertex': v, 'target': list(t)} for v, t in pins.items()]}))
    report = folder / 'pinned.json'
    report.unlink(missing_ok=True)
    done = common.parametrize(options, mesh, [result], '--degree', degree, '--pins', file, '--report',
                              report, *options.flags, verb=options.verb)
    message = (done.stderr.strip().splitlines() or ['exit %s' % done.code])[-1]
    if done.code not in (0, 4):
        return False, {'exit': done.code, 'message': message, 'file': result.exists(),
                       'seconds': done.seconds}
    checked = common.run([options.binary, 'check', result, '--quiet'], options.timeout)
    found = places(result)
    off = max(max(math.dist(p, t) for p in found[v]) for v, t in pins.items())
    data = json.loads(report.read_text())
    return off == 0 and checked.code == 0, {
        'exit': done.code, 'check': checked.code, 'off': off, 'value': data['result']['value'],
        'status': data['status'], 'seconds': done.seconds, 'message': message}


def main():
    parser = common.parser(__doc__, timeout=120)
    parser.add_argument('--meshes', default='hand|penguin|spot', help='regular expression of names')
    parser.add_argument('--faces', type=int, default=500)
    parser.add_argument('--sets', type=int, default=100, help='of pins, over all meshes and degrees')
    parser.add_argument('--share', type=float, default=0.95, help='part that must be reached')
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--verb', default='parametrize', choices=('parametrize', 'seamless'))
    parser.add_argument('--flags', default='', type=str.split, help='of the verb, too')
    parser.add_argument('--json', type=Path, help='every set, with what came of it')
    options = parser.parse_args()
    common.require_files(options)
    meshes = [m for m in sorted((options.shared / 'data/public/disks').glob('*_%d.obj' % options.faces))
              if re.fullmatch(options.meshes, m.stem.rsplit('_', 1)[0])]
    cases = [(m, d, c) for c in COUNTS for m in meshes for d in DEGREES]
    rng, rows, free = random.Random(options.seed), [], {}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for k in range(options.sets):
            mesh, degree, count = cases[k % len(cases)]
            if (mesh, degree) not in free:
                result = folder / ('%s_%d.vtu' % (mesh.stem, degree))
                common.parametrize(options, mesh, [result], '--degree', degree, *options.flags,
                                   verb=options.verb)
                free[mesh, degree] = places(result)
            pins = draw(free[mesh, degree], count, rng)
            reached, found = attempt(options, mesh, degree, pins, folder)
            reason = None if reached else contradiction(pins, faces_of(mesh))
            rows.append({'mesh': mesh.stem, 'degree': degree, 'pins': count, 'reached': reached,
                         'reason': reason, 'targets': pins, **found})
            if not reached:
                print('%s, degree %d, %d pins: %s' % (mesh.stem, degree, count, found), file=sys.stderr)
    if options.json:
        options.json.write_text(json.dumps(rows, indent=1))
    print('| pins | sets | reached exactly | refused, confirmed | others | exit 4 | seconds, most |')
    print('|---|---|---|---|---|---|---|')
    for count in COUNTS:
        some = [r for r in rows if r['pins'] == count]
        if some:
            print('| %d | %d | %d | %d | %d | %d | %.1f |' % (
                count, len(some), sum(r['reached'] for r in some), sum(bool(r['reason']) for r in some),
                sum(not r['reached'] and not r['reason'] for r in some),
                sum(r['exit'] == 4 for r in some), max(r['seconds'] for r in some)))
    reached = sum(r['reached'] for r in rows)
    confirmed = all(r['reached'] or (r['reason'] and r['exit'] == 3 and not r['file']) for r in rows)
    print('\n%d of %d sets reached exactly' % (reached, len(rows)))
    return 0 if reached >= options.share * len(rows) and confirmed else 1


if __name__ == '__main__':
    sys.exit(main())
