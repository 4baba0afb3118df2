# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Shared code of the tests of seamless maps: boxes and tori with seamless texture coordinates, and results of
parametrize --seamless on them."""
import json

from command_helpers import *

SIDES = [((0, 0, 1), (1, 0, 0), (0, 1, 0)), ((0, 0, 0), (0, 1, 0), (1, 0, 0)),
         ((0, 0, 0), (1, 0, 0), (0, 0, 1)), ((0, 1, 0), (0, 0, 1), (1, 0, 0)),
         ((0, 0, 0), (0, 0, 1), (0, 1, 0)), ((1, 0, 0), (0, 1, 0), (0, 0, 1))]


def cube(n, sides=6, round_off=0.5):
    """Returns a rounded box of n x n quads per side, each side a chart, with seams along all its edges: v, quads of
    v, vt, quads of vt. Corners of the box are vertices with three quads."""
    numbers, points, faces, texture, charts = {}, [], [], [], []

    def vertex(p):
        if p not in numbers:
            numbers[p] = len(points)
            q = [2 * c / n - 1 for c in p]
            length = math.sqrt(sum(c * c for c in q))
            points.append(tuple(c * (1 - round_off + round_off * 1.3 / length) for c in q))
        return numbers[p]

    for s, (origin, e, f) in enumerate(SIDES[:sides]):
        base = len(texture)
        texture += [((i + s * (n + 2)) * 2 / n, j * 2 / n) for j in range(n + 1)
                    for i in range(n + 1)]
        for j in range(n):
            for i in range(n):
                square = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                faces.append(tuple(vertex(tuple(n * o + a * x + b * y for o, x, y in
                                                zip(origin, e, f))) for a, b in square))
                charts.append(tuple(base + b * (n + 1) + a for a, b in square))
    return points, faces, texture, charts


def torus_map(m, n):
    """Returns a torus cut along two loops and unrolled, with translations only and no cones."""
    points, faces = torus(m, n, 0)
    texture = [(12 * i / m, 6 * j / n) for j in range(n + 1) for i in range(m + 1)]
    charts = []
    for q in range(m * n):
        a = q // m * (m + 1) + q % m
        charts += [(a, a + 1, a + m + 2), (a, a + m + 2, a + m + 1)]
    return points, faces, texture, charts


def triangles(mesh):
    points, faces, texture, charts = mesh
    split = [[(q[0], q[1], q[2]), (q[0], q[2], q[3])] for q in faces]
    split_charts = [[(q[0], q[1], q[2]), (q[0], q[2], q[3])] for q in charts]
    return points, sum(split, []), texture, sum(split_charts, [])


def textured_obj(points, faces, texture, charts, groups=()):
    lines = ['v %r %r %r' % tuple(p) for p in points] + ['vt %r %r' % tuple(t) for t in texture]
    for k, (face, chart) in enumerate(zip(faces, charts)):
        lines += ['g ' + name for at, name in groups if at == k]
        lines.append('f ' + ' '.join('%d/%d' % (v + 1, t + 1) for v, t in zip(face, chart)))
    return '\n'.join(lines) + '\n'


class SeamlessTest(CommandTest):
    @classmethod
    def setUpClass(cls):
        cls.shared = tempfile.mkdtemp(prefix='majorant_seamless_')
        cls.addClassCleanup(shutil.rmtree, cls.shared)
        cls.meshes = {}
        for name, mesh in {'cube': triangles(cube(4)), 'quads': cube(3), 'torus': torus_map(16, 8),
                           'open': triangles(cube(4, sides=5))}.items():
            cls.meshes[name] = os.path.join(cls.shared, name + '.obj')
            with open(cls.meshes[name], 'w') as f:
                f.write(textured_obj(*mesh))
        cls.results = {}
        for name, mesh, degree, options in [('cube1', 'cube', 1, []), ('cube2', 'cube', 2, []),
                                            ('cube4', 'cube', 4, []), ('torus3', 'torus', 3, []),
                                            ('open3', 'open', 3, []),
                                            ('fixed1', 'open', 1, ['--boundary', 'fixed']),
                                            ('fixed3', 'open', 3, ['--boundary', 'fixed'])]:
            path = os.path.join(cls.shared, name)
            cls.results[name] = path + '.vtu'
            outcome = majorant('parametrize', cls.meshes[mesh], '--seamless', '--degree', degree,
                               '-o', path + '.vtu', '-o', path + '.obj', '--report', path + '.json',
                               *options)
            assert outcome.code == OK, outcome.err
            assert 'cones, seams fit to' in outcome.err, outcome.err

    def mesh_of(self, result):
        return self.meshes[{'c': 'cube', 't': 'torus', 'o': 'open', 'f': 'open'}[result[0]]]

    def report(self, name):
        with open(os.path.join(self.shared, name + '.json')) as f:
            return json.load(f)
