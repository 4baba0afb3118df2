# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Shared code of the tests of unwrap: closed and broken meshes, and a layout judged in integers.

Layouts are judged by tests/checker, by `majorant check` with the command that the run printed, and by this
file on the written digits: positive triangles, overlaps, distances of charts.
"""
import json
import math
import re
import shlex
import subprocess
from fractions import Fraction

from command_helpers import *


# ------------------------------------------------------------------ meshes
def cube(n):
    """Returns a closed cube with n x n quads per side, seen from outside."""
    number, faces = {}, []

    def vertex(p):
        return number.setdefault(p, len(number))
    for axis in range(3):
        for side in (0, n):
            for i in range(n):
                for j in range(n):
                    square = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                    corners = []
                    for a, b in square if side else reversed(square):
                        p = [0, 0, 0]
                        p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3] = side, a, b
                        corners.append(vertex(tuple(p)))
                    faces.append(tuple(corners))
    points = [tuple(x / n for x in p) for p in number]
    return points, faces


def triangles(faces):
    return [(f[0], f[i], f[i + 1]) for f in faces for i in range(1, len(f) - 1)]


def sphere(n):
    points, faces = cube(n)
    centred = [tuple(x - 0.5 for x in p) for p in points]
    return [tuple(x / math.dist(p, (0, 0, 0)) for x in p) for p in centred], triangles(faces)


def moebius(n):
    """Returns a band of 2 n triangles with a half twist."""
    points = []
    for i in range(n):
        a = 2 * math.pi * i / n
        for s in (-0.4, 0.4):
            r = 1 + s * math.cos(a / 2)
            points.append((r * math.cos(a), r * math.sin(a), s * math.sin(a / 2)))
    faces = []
    for i in range(n):
        a, b = 2 * i, 2 * i + 1
        c, d = (2 * i + 2, 2 * i + 3) if i + 1 < n else (1, 0)
        faces += [(a, c, b), (c, d, b)]
    return points, faces


def both(one, other, shift=(5, 0, 0)):
    """Returns two meshes as one, the second moved."""
    points = one[0] + [tuple(x + d for x, d in zip(p, shift)) for p in other[0]]
    return points, one[1] + [tuple(v + len(one[0]) for v in f) for f in other[1]]


def soup(points, faces):
    return [points[v] for f in faces for v in f], [tuple(range(3 * k, 3 * k + 3))
                                                   for k in range(len(faces))]


# ------------------------------------------------------------------ a layout, exactly
class Layout:
    """An OBJ with vt; texture coordinates are integers over one power of ten."""

    def __init__(self, path):
        self.v, _, self.faces, self.texture = read_obj(path)
        with open(path) as f:
            self.text = f.read()
        uv = [tuple(map(Fraction, line.split()[1:3])) for line in self.text.splitlines()
              if line.startswith('vt ')]
        scale = math.lcm(1, *(x.denominator for p in uv for x in p))
        self.scale, self.uv = scale, [tuple(int(x * scale) for x in p) for p in uv]
        self.charts = self.split()

    def split(self):
        """Returns lists of faces that are connected by shared texture coordinates."""
        parent = list(range(len(self.uv)))

        def find(a):
            while parent[a] != a:
                a = parent[a]
            return a
        for face in self.texture:
            for t in face:
                parent[find(t)] = find(face[0])
        charts = {}
        for k, face in enumerate(self.texture):
            charts.setdefault(find(face[0]), []).append(k)
        return list(charts.values())

    def area(self, face):
        """Returns twice the area of a polygon or triangle."""
        p = [self.uv[t] for t in self.texture[face]]
        return sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(p, p[1:] + p[:1]))

    def side(self):
        """Returns the side of the square around all points, in integers."""
        return max(max(p[k] for p in self.uv) - min(p[k] for p in self.uv) for k in (0, 1))

    def outline(self, chart):
        """Returns the edges of the chart with one face."""
        uses = {}
        for k in chart:
            face = self.texture[k]
            for a, b in zip(face, face[1:] + face[:1]):
                uses.setdefault(frozenset((a, b)), []).append((self.uv[a], self.uv[b]))
        return [edges[0] for edges in uses.values() if len(edges) == 1]

    def overlapping(self):
        """Returns pairs of triangles whose interiors meet. The layout must have triangles only."""
        found, boxes = [], [box([self.uv[t] for t in face]) for face in self.texture]
        corners = [[self.uv[t] for t in face] for face in self.texture]
        for i, a in enumerate(boxes):
            for j in range(i):
                b = boxes[j]
                if a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3] and not is_apart(
                        corners[i], corners[j]) and not is_apart(corners[j], corners[i]):
                    found.append((j, i))
        return found

    def nearest_charts(self):
        """Returns the squared distance of the two nearest charts, from all pairs of edges."""
        outlines = [self.outline(chart) for chart in self.charts]
        return min((square_distance(a, b) for i, one in enumerate(outlines)
                    for other in outlines[:i] for a in one for b in other), default=math.inf)


def box(points):
    return (min(p[0] for p in points), min(p[1] for p in points),
            max(p[0] for p in points), max(p[1] for p in points))


def turn(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def is_apart(one, other):
    """Returns whether an edge of `one`, a positive triangle, separates it from `other`."""
    return any(all(turn(one[i - 1], one[i], p) <= 0 for p in other) for i in range(3))


def square_distance(e, f):
    (a, b), (c, d) = e, f
    signs = [(turn(*t) > 0) - (turn(*t) < 0) for t in ((a, b, c), (a, b, d), (c, d, a), (c, d, b))]
    if signs[0] * signs[1] < 0 and signs[2] * signs[3] < 0:
        return 0
    return min(from_edge(c, a, b), from_edge(d, a, b), from_edge(a, c, d), from_edge(b, c, d))


def from_edge(p, a, b):
    length = (b[0] - a[0]) ** 2 + (b[1] - a[1]) ** 2
    along = (p[0] - a[0]) * (b[0] - a[0]) + (p[1] - a[1]) * (b[1] - a[1])
    if 0 < along < length:
        return Fraction(turn(a, b, p) ** 2, length)
    return min((p[0] - q[0]) ** 2 + (p[1] - q[1]) ** 2 for q in (a, b))


class UnwrapTest(CommandTest):
    def mesh(self, points, faces, uv=None, name='mesh.obj'):
        return self.write(name, obj_text(points, faces, uv))

    def unwrap(self, mesh, *flags, code=OK, out='out.obj'):
        """Runs unwrap, and then proves the file with the command that it prints. Returns (layout, report)."""
        outcome = self.run_ok('unwrap', mesh, '-o', self.path(out), '--report',
                              self.path('report.json'), *flags, code=code)
        with open(self.path('report.json')) as f:
            report = json.load(f)
        commands = re.findall(r'^proof: majorant (.*)$', outcome.err, re.M)
        self.assertEqual(len(commands), 1, outcome.err)
        expected = ['check', self.path(out)]
        self.assertEqual(shlex.split(commands[0]),
                         expected + ([] if '--no-pack' in flags else ['--certify']))
        self.run_ok(*shlex.split(commands[0]))
        layout = Layout(self.path(out))
        self.assertEqual(len(layout.charts), report['result']['charts'])
        self.assertEqual(len(layout.charts), len(report['charts']))
        return layout, report

    def clean(self, mesh, *flags, **method):
        """Calls unwrap(), and tests that the layout has the input's faces, all positive, without overlaps, and
        apart."""
        layout, report = self.unwrap(mesh, *flags, **method)
        if mesh.endswith('.obj'):
            self.assertEqual(layout.faces, read_obj(mesh)[2])
        self.assertTrue(all(layout.area(k) > 0 for k in range(len(layout.faces))))
        if all(len(face) == 3 for face in layout.faces):
            self.assertEqual(layout.overlapping(), [])
        self.apart(layout, 4, 1024)
        return layout, report

    def apart(self, layout, padding, resolution):
        least = Fraction(padding) / Fraction(resolution) * layout.side()
        self.assertGreaterEqual(layout.nearest_charts(), least ** 2)

    def judged(self, out='out.obj'):
        self.judge_alone(self.path(out), '--cuts', 'free', '--overlap')

    def judge_alone(self, *args):
        done = subprocess.run(['/usr/bin/python3', CHECKER, *args], text=True, timeout=300,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.assertEqual(done.returncode, 0, done.stdout[-2000:])

    def repaired(self, report):
        return {r['kind']: r['count'] for r in report['repairs']}
