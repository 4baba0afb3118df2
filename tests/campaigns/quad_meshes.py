# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Runs majorant quads on surfaces with and without borders; check and tests/checker/quad_judge.py judge every
result.

    python3 tests/campaigns/quad_meshes.py build/release/apps/majorant [--meshes FOLDER] [--counts 500 2500]

The surfaces: plates with 1 to 50 round holes; uneven sheets that lose random squares, some of which touch;
spheres that lose random caps; a tube, a comb, a triangle, a needle, a star; with inner features (--only
features: only these) blocks, one with creases that end inside, cylinders, stepped shafts, an L with a fillet,
gears; and closed/ and disks/ of FOLDER (data/public).
Prints a line for each: exit code, number of quads and the requested number, the least possible count,
irregular vertices, border loops, the least and the mean scaled Jacobian, the deviation of angles, feature
lines covered and requested, CPU seconds; or the reason of a refusal. The last lines count the meshes that
were made, those with a count within 5 %, and those with all features. Exit code 1 if a written mesh is not
valid, or a run without a mesh ends with another exit code than 3 or 5.
"""
import argparse
import glob
import json
import math
import os
import random
import resource
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'checker'))
from quad_judge import judge, read_obj  # noqa: E402

JUDGED = 3000  # largest number of quads, since the judge searches nearest faces one by one


class Faces:
    """Collects triangles of quads of points; equal points become one vertex."""

    def __init__(self):
        self.points, self.faces, self.number = [], [], {}

    def vertex(self, p):
        key = tuple(round(x * 1e9) for x in p)
        if key not in self.number:
            self.number[key] = len(self.points)
            self.points.append(p)
        return self.number[key]

    def quad(self, corners):
        a, b, c, d = [self.vertex(p) for p in corners]
        self.faces += [(a, b, c), (a, c, d)]


def sheet(n, m, place, is_hole=lambda i, j: False):
    out = Faces()
    for i in range(n):
        for j in range(m):
            if not is_hole(i, j):
                out.quad([place(x, y) for x, y in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))])
    return out


def plate(nx, ny, holes, m=6, rings=3, radius=0.3):
    """Returns nx by ny tiles; those with holes are squares around circles."""
    out = Faces()
    for i in range(nx):
        for j in range(ny):
            if (i, j) not in holes:
                for a in range(m):
                    for b in range(m):
                        out.quad([(i + (a + s) / m, j + (b + t) / m, 0.0) for s, t in ((0, 0), (1, 0), (1, 1), (0, 1))])
                continue
            square = [(s / m, 0) for s in range(m)] + [(1, s / m) for s in range(m)]
            square += [(1 - x, 1 - y) for x, y in square]

            def point(k, t):
                x, y = square[k % len(square)]
                angle = -3 * math.pi / 4 + 2 * math.pi * (k % len(square)) / len(square)
                return (i + (1 - t) * x + t * (0.5 + radius * math.cos(angle)),
                        j + (1 - t) * y + t * (0.5 + radius * math.sin(angle)), 0.0)
            for k in range(len(square)):
                for t in range(rings):
                    out.quad([point(k, t / rings), point(k + 1, t / rings), point(k + 1, (t + 1) / rings),
                              point(k, (t + 1) / rings)])
    return out


def triangle(a, b, c, n):
    """Returns a triangle divided into n^2."""
    out = Faces()

    def at(i, j):
        return out.vertex(tuple(p + (q - p) * i / n + (r - p) * j / n for p, q, r in zip(a, b, c)))
    for i in range(n):
        for j in range(n - i):
            out.faces.append((at(i, j), at(i + 1, j), at(i, j + 1)))
            if i + j + 1 < n:
                out.faces.append((at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)))
    return out


def sphere_without(caps, around=30, rings=15):
    def place(i, j):
        polar = math.pi * (j + 1) / (rings + 1)
        a = 2 * math.pi * (i % around) / around
        return math.sin(polar) * math.cos(a), math.sin(polar) * math.sin(a), math.cos(polar)

    def is_hole(i, j):
        middle = place(i + 0.5 if i + 0.5 < around else 0.5, j + 0.5)
        return any(math.dist(middle, place(*cap)) < 0.35 for cap in caps)
    out = sheet(around, rings - 1, lambda i, j: place(i, j), is_hole)
    out.faces = [face[::-1] for face in out.faces]
    return out


def revolved(profile, around):
    """Returns a profile (radius, height), from axis to axis, revolved around the axis."""
    out = Faces()

    def at(k, i):
        r, z = profile[k]
        return (r * math.cos(2 * math.pi * i / around), r * math.sin(2 * math.pi * i / around), z)
    for k in range(len(profile) - 1):
        for i in range(around):
            a, b, c, d = [out.vertex(at(*p)) for p in ((k, i), (k, (i + 1) % around), (k + 1, (i + 1) % around), (k + 1, i))]
            out.faces += [face for face in ((a, b, c), (a, c, d)) if len(set(face)) == 3]
    return out


def polyline(corners, step):
    points = [corners[0]]
    for a, b in zip(corners, corners[1:]):
        n = max(1, round(math.dist(a, b) / step))
        points += [tuple(x + (y - x) * k / n for x, y in zip(a, b)) for k in range(1, n + 1)]
    return points


def extruded(contour, centre, rings, height, layers):
    """Returns a body with a contour (x, y) as its side; the contour is counterclockwise and star-shaped
    around its centre."""
    out, n = Faces(), len(contour)

    def place(i, ring, z):
        x, y = contour[i % n]
        return (centre[0] + (x - centre[0]) * ring / rings, centre[1] + (y - centre[1]) * ring / rings, z)

    def add(corners):
        a, b, c, d = [out.vertex(p) for p in corners]
        out.faces += [face for face in ((a, b, c), (a, c, d)) if len(set(face)) == 3]
    for i in range(n):
        for ring in range(rings):
            add([place(i, ring, height), place(i, ring + 1, height), place(i + 1, ring + 1, height), place(i + 1, ring, height)])
            add([place(i, ring, 0.0), place(i + 1, ring, 0.0), place(i + 1, ring + 1, 0.0), place(i, ring + 1, 0.0)])
        for k in range(layers):
            add([place(i, rings, height * k / layers), place(i + 1, rings, height * k / layers),
                 place(i + 1, rings, height * (k + 1) / layers), place(i, rings, height * (k + 1) / layers)])
    return out


def block(nx, ny, nz, top=lambda x, y: 0.0):
    """Returns a block of nx by ny by nz cubes, its top raised by top(x, y) in 0 .. 1."""
    out = Faces()

    def at(i, j, k):
        return (i, j, k + k / nz * top(i / nx, j / ny))
    for i in range(nx):
        for j in range(ny):
            out.quad([at(i, j, 0), at(i, j + 1, 0), at(i + 1, j + 1, 0), at(i + 1, j, 0)])
            out.quad([at(i, j, nz), at(i + 1, j, nz), at(i + 1, j + 1, nz), at(i, j + 1, nz)])
    for k in range(nz):
        for i in range(nx):
            out.quad([at(i, 0, k), at(i + 1, 0, k), at(i + 1, 0, k + 1), at(i, 0, k + 1)])
            out.quad([at(i, ny, k), at(i, ny, k + 1), at(i + 1, ny, k + 1), at(i + 1, ny, k)])
        for j in range(ny):
            out.quad([at(0, j, k), at(0, j, k + 1), at(0, j + 1, k + 1), at(0, j + 1, k)])
            out.quad([at(nx, j, k), at(nx, j + 1, k), at(nx, j + 1, k + 1), at(nx, j, k + 1)])
    return out


def creases(x, y):
    """Three ridges that begin at one side and end inside."""
    return sum(3 * max(0.0, 0.7 - x) * max(0.0, 1 - abs(y - middle) / 0.12) for middle in (0.2, 0.5, 0.8))


def gear_contour(teeth):
    return polyline([(r * math.cos(2 * math.pi * (k + at) / teeth), r * math.sin(2 * math.pi * (k + at) / teeth))
                     for k in range(teeth) for at, r in ((0, 1), (0.4, 1), (0.5, 1.2), (0.9, 1.2))] + [(1.0, 0.0)], 0.06)[:-1]


def featured():
    yield 'block 4', block(4, 4, 4)
    yield 'block flat', block(12, 9, 2)
    yield 'block creases', block(20, 20, 6, creases)
    yield 'cylinder', revolved(polyline([(0, 0), (1, 0), (1, 2), (0, 2)], 0.2), 32)
    yield 'cylinder coarse', revolved(polyline([(0, 0), (1, 0), (1, 2), (0, 2)], 0.5), 12)
    yield 'shaft', revolved(polyline([(0, 0), (2, 0), (2, 1), (1, 1), (1, 3), (1.5, 3), (1.5, 4), (0, 4)], 0.25), 40)
    yield 'shaft chamfered', revolved(polyline([(0, 0), (1.8, 0), (2, 0.2), (2, 1), (1, 1), (1, 3), (0.9, 3.1), (0, 3.1)],
                                               0.2), 40)
    fillet = [(1.4 - 0.4 * math.sin(math.pi * k / 16), 1.4 - 0.4 * math.cos(math.pi * k / 16)) for k in range(9)]
    contour = polyline([(0.0, 0.0), (2.0, 0.0), (2.0, 1.0)] + fillet + [(1.0, 2.0), (0.0, 2.0), (0.0, 0.0)], 0.1)[:-1]
    yield 'L fillet', extruded(contour, (0.5, 0.5), 8, 1.0, 8)
    for teeth in (6, 16):
        yield 'gear %d' % teeth, extruded(gear_contour(teeth), (0.0, 0.0), 8, 0.4, 4)


def family():
    for holes, (nx, ny, where) in {
            1: (1, 1, lambda i, j: True), 2: (3, 2, lambda i, j: (i, j) in ((0, 0), (2, 1))),
            6: (4, 3, lambda i, j: (i + j) % 2 == 0), 12: (6, 4, lambda i, j: (i + j) % 2),
            50: (10, 10, lambda i, j: (i + j) % 2)}.items():
        yield 'plate %d' % holes, plate(nx, ny, {(i, j) for i in range(nx) for j in range(ny) if where(i, j)})
    for seed in range(12):
        rng = random.Random(seed)
        gone = {(rng.randrange(1, 14), rng.randrange(1, 14)) for _ in range(12)}
        yield 'sheet %d' % seed, sheet(
            15, 15, lambda i, j: (i / 15 + 0.02 * math.sin(4 * j / 3), j / 15, 0.1 * math.sin(7 * i * j / 225)),
            lambda i, j: (i, j) in gone)
    for seed in range(12):
        rng = random.Random(seed)
        yield 'sphere %d' % seed, sphere_without([(rng.randrange(30), rng.randrange(14)) for _ in range(3)])
    yield 'tube', sheet(24, 12, lambda i, j: (math.cos(math.pi * (i % 24) / 12), math.sin(math.pi * (i % 24) / 12), j / 4))
    yield 'comb', sheet(36, 16, lambda i, j: (i / 12, j / 12, 0.0), lambda i, j: j > 5 and i // 3 % 2)
    yield 'triangle', triangle((0, 0, 0), (2, 0, 0), (0, 0.6, 0), 20)
    yield 'needle', triangle((0, 0, 0), (3, 0, 0), (0, 0.3, 0), 24)
    star = Faces()
    for k in range(10):
        tips = [(r * math.cos(math.pi * j / 5), r * math.sin(math.pi * j / 5), 0.0)
                for j, r in ((k, 1 - 0.6 * (k % 2)), (k + 1, 0.4 + 0.6 * (k % 2)))]
        part = triangle((0, 0, 0), *tips, 8)
        star.faces += [tuple(star.vertex(part.points[v]) for v in face) for face in part.faces]
    yield 'star', star


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('binary')
    parser.add_argument('--meshes')
    parser.add_argument('--counts', type=int, nargs='+', default=[500, 2500])
    parser.add_argument('--only', choices=['borders', 'features'])
    requested = parser.parse_args()
    made = close = tried = wrong = whole = 0
    with tempfile.TemporaryDirectory() as folder:
        sources = []
        generated = list(family() if requested.only != 'features' else ())
        generated += featured() if requested.only != 'borders' else ()
        for name, mesh in generated:
            path = os.path.join(folder, name.replace(' ', '_') + '.obj')
            with open(path, 'w') as file:
                file.writelines('v %r %r %r\n' % p for p in mesh.points)
                file.writelines('f %d %d %d\n' % tuple(v + 1 for v in face) for face in mesh.faces)
            sources.append((name, path))
        for kind in ('closed', 'disks') if requested.meshes else ():
            sources += [(os.path.basename(path)[:-4], path)
                        for path in sorted(glob.glob(os.path.join(requested.meshes, kind, '*.obj')))]
        quads, report = os.path.join(folder, 'q.obj'), os.path.join(folder, 'q.json')
        for name, path in sources:
            for count in requested.counts:
                tried += 1
                before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
                run = subprocess.run([requested.binary, 'quads', path, '-o', quads, '--force', '--count', str(count),
                                      '--report', report, '--quiet'], capture_output=True, text=True)
                seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
                line = '%-18s %5d  exit %d  %5.2f s  ' % (name, count, run.returncode, seconds)
                if run.returncode not in (0, 4):
                    wrong += run.returncode not in (3, 5)
                    print(line + run.stderr.strip().split('\n')[-1][:200], flush=True)
                    continue
                with open(report) as file:
                    q = json.load(file)['result']['quads']
                features = q['features']
                is_whole = features['relaxed'] == 0
                check = subprocess.run([requested.binary, 'check', quads, '--surface', path, '--max-distance', '1'] +
                                       (['--features', '35'] if is_whole else []), capture_output=True, text=True)
                found = set()
                is_plain = check.returncode == 0 and q['count'] <= JUDGED and 'repair' not in check.stdout
                if is_plain and name.split()[0] in ('plate', 'tube', 'comb', 'triangle', 'needle', 'star', 'block', 'cylinder',
                                                    'shaft', 'L', 'gear'):
                    found = judge(read_obj(quads), read_obj(path), 35 if is_whole else None, near=1)
                made += 1
                whole += is_whole
                close += abs(q['count'] - count) <= 0.05 * count
                wrong += check.returncode != 0 or bool(found)
                print(line + '%d quads, least %s, %d irregular, %d borders, J %.2f %.3f, %.1f degrees, %d/%d features%s%s' % (
                    q['count'], q['least_count'], q['irregular'], q['boundary_loops'], q['scaled_jacobian']['min'],
                    q['scaled_jacobian']['mean'], q['angle_deviation'], features['covered'], features['requested'],
                    '' if check.returncode == 0 else ' CHECK ' + check.stdout.strip(), ' JUDGE %s' % found if found else ''),
                    flush=True)
    print('%d of %d made, %d with a count within 5 %%, %d with all features, %d wrong' % (made, tried, close, whole, wrong))
    return 1 if wrong else 0


if __name__ == '__main__':
    sys.exit(main())
