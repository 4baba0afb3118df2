# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Measures of distortion compared with sums over many points of the maps in the files. The library is not used."""
import csv
import math

import numpy as np

from command_helpers import *

NAMES = ['sigma_1', 'sigma_2', 'area_distortion', 'angle_distortion', 'stretch_l2', 'stretch_linf']
PERCENTILES = [1, 5, 25, 50, 75, 95, 99]


def multi_indices(n):
    """Returns VTK's order of the control points of a triangle."""
    found, shift = [], 0
    while n >= 0:
        ring = [(n, 0, 0), (0, n, 0), (0, 0, n)][:3 if n else 1]
        ring += [(n - s, s, 0) for s in range(1, n)] + [(0, n - s, s) for s in range(1, n)]
        ring += [(s, 0, n - s) for s in range(1, n)]
        found += [tuple(i + shift for i in t) for t in ring]
        n, shift = n - 3, shift + 1
    return found


def gradients(n, points):
    """Returns derivatives of the Bernstein polynomials by xi0 and xi1: 2 arrays, points by functions."""
    def power(x, k):
        return x ** k if k >= 0 else np.zeros_like(x)

    def value(t):
        if min(t) < 0:
            return np.zeros(len(points))
        factor = math.factorial(sum(t)) / math.prod(map(math.factorial, t))
        return factor * math.prod(power(points[:, k], t[k]) for k in range(3))
    columns = [[], []]
    for i, j, k in multi_indices(n):
        last = value((i, j, k - 1))
        columns[0].append(n * (value((i - 1, j, k)) - last))
        columns[1].append(n * (value((i, j - 1, k)) - last))
    return [np.array(c).T for c in columns]


def inner_points(m):
    """Returns centroids of the m^2 triangles of a subdivision, which have equal weights."""
    points = [(3 * i + 1, 3 * j + 1) for i in range(m) for j in range(m - i)]
    points += [(3 * i + 2, 3 * j + 2) for i in range(m) for j in range(m - 1 - i)]
    return np.array([(a, b, 3 * m - a - b) for a, b in points]) / (3 * m)


class Measured:
    """Singular values at many points of each cell (points by cells), and areas on the surface."""

    def __init__(self, points, uv, cells, degree, scale, pieces=24):
        corners = points[cells[:, :3]]
        e0, e1 = corners[:, 0] - corners[:, 2], corners[:, 1] - corners[:, 2]
        length = np.linalg.norm(e0, axis=1)
        along = np.einsum('fk,fk->f', e0, e1) / length
        self.area = np.linalg.norm(np.cross(e0, e1), axis=1) / 2
        height = 2 * self.area / length
        sample = inner_points(1 if degree == 1 else pieces)
        d0, d1 = (np.einsum('pk,fkd->pfd', g, scale * uv[cells]) for g in gradients(degree, sample))
        first = d0 / length[:, None]
        second = (d1 - along[:, None] * first) / height[:, None]
        J = np.stack([first, second], axis=-1)
        sigma = np.linalg.svd(J, compute_uv=False)
        self.s1 = sigma[..., 0]
        self.s2 = sigma[..., 1] * np.sign(np.linalg.det(J))

    def faces(self):
        square = (self.s1 ** -2 + self.s2 ** -2) / 2
        return np.array([self.s1.mean(0), self.s2.mean(0), (self.s1 * self.s2).mean(0),
                         (self.s1 / self.s2).mean(0), np.sqrt(square.mean(0)),
                         (1 / self.s2).max(0)]).T

    def percentiles(self, values):
        weight = np.broadcast_to(self.area / len(values), values.shape).ravel()
        order = np.argsort(values, axis=None)
        sums = np.cumsum(weight[order])
        return [values.ravel()[order][np.searchsorted(sums, p / 100 * sums[-1])]
                for p in PERCENTILES]


def measured(vtu, **more):
    size = len(vtu.cells()[0])
    degree = next(n for n in range(1, 9) if (n + 1) * (n + 2) // 2 == size)
    scale = (vtu.claims.get('normalized') or {'size': 1})['size']
    return Measured(np.array(vtu.rows('Points')), np.array(vtu.rows('uv')), np.array(vtu.cells()),
                    degree, scale, **more)


class Distortion(CommandTest):
    def table(self, name):
        """Returns the numbers and the first three columns, and tests that the shares of the area add to 1."""
        with open(self.path(name)) as f:
            lines = list(csv.reader(f))
        self.assertEqual(lines[0], ['input_face', 'face', 'chart', *NAMES, 'area_share'])
        self.shares = np.array([float(line[-1]) for line in lines[1:]])
        self.assertAlmostEqual(self.shares.sum(), 1, delta=1e-12)
        return (np.array([[float(x) for x in line[3:-1]] for line in lines[1:]]),
                [tuple(map(int, line[:3])) for line in lines[1:]])

    def report(self, name='r.json'):
        with open(self.path(name)) as f:
            return json.load(f)

    def agrees(self, numbers, expected, linf=0.1):
        ratio = numbers / expected
        self.assertLess(np.abs(ratio[:, :5] - 1).max(), 2e-3)
        self.assertGreater(ratio[:, 5].min(), 0.99)  # also sampled at corners
        self.assertLess(ratio[:, 5].max(), 1 + linf)

    def summary_agrees(self, section, found, tolerance):
        faces = found.faces()
        square = (faces[:, 4] ** 2 * found.area).sum() / found.area.sum()
        self.assertAlmostEqual(section['stretch_l2'], math.sqrt(square), delta=tolerance)
        for key, values, column in (('sigma_1', found.s1, 0), ('sigma_2', found.s2, 1),
                                    ('area', found.s1 * found.s2, 2),
                                    ('angle', found.s1 / found.s2, 3)):
            mean = (faces[:, column] * found.area).sum() / found.area.sum()
            self.assertAlmostEqual(section[key]['mean'] / mean, 1, delta=tolerance)
            for p, value in zip(PERCENTILES, found.percentiles(values)):
                self.assertAlmostEqual(section[key]['p%d' % p] / value, 1, delta=30 * tolerance)

    def run_of(self, *args):
        self.run_ok(*args, '--quiet', '--force', '--report', self.path('r.json'), '--distortion',
                    self.path('d.csv'))
        return self.report()

    def test_curved_maps(self):
        for degree, more in ((2, ()), (3, ('--normalize',))):
            with self.subTest(degree):
                result = self.run_of('parametrize', generated('creature'), self.path('a.vtu'),
                                     '--degree', degree, '--tolerance', '1e-3', *more)['result']
                vtu = Vtu(self.path('a.vtu'))
                found = measured(vtu)
                numbers, places = self.table('d.csv')
                self.agrees(numbers, found.faces())
                self.assertLess(np.abs(self.shares / found.area * found.area.sum() - 1).max(), 1e-9)
                self.assertEqual(places, [(f, k, 0) for k, f in
                                          enumerate(vtu.arrays['input_face'])])
                for column, name in enumerate(NAMES):
                    self.assertEqual(vtu.arrays[name], numbers[:, column].tolist(), name)
                section = result['distortion']
                self.summary_agrees(section, found, 1e-3)
                self.assertEqual(section['stretch_linf'], numbers[:, 5].max())
                self.assertAlmostEqual(section['stretch_linf'] * result['sigma_min'], 1, delta=1e-3)
                self.assertEqual(section['scale'], vtu.claims['normalized']['size'] if more else 1)

    def test_charts(self):
        result = self.run_of('unwrap', generated('buckle'), self.path('a.vtu'), '--normalize')
        vtu = Vtu(self.path('a.vtu'))
        found = measured(vtu)
        numbers, places = self.table('d.csv')
        self.assertLess(np.abs(numbers / found.faces() - 1).max(), 1e-8)
        self.assertEqual([place[2] for place in places], vtu.arrays['chart'])
        self.assertEqual([place[0] for place in places], vtu.arrays['input_face'])
        section = result['result']['distortion']
        self.summary_agrees(section, found, 1e-8)
        equal_areas = section['stretch_l2'] * math.sqrt(section['area']['mean'])
        self.assertAlmostEqual(equal_areas, result['result']['stretch_l2'], delta=1e-9)

    def test_check_and_convert_measure_anew(self):
        self.run_of('parametrize', generated('cap'), self.path('a.vtu'), '--degree', '3',
                    '--normalize')
        first, _ = self.table('d.csv')
        before = self.report()['result']['distortion']
        after = self.run_of('check', self.path('a.vtu'))['result']['distortion']
        self.assertFalse(after.pop('scale_is_assumed'))
        self.assertAlmostEqual(after['stretch_l2'], before['stretch_l2'], delta=1e-9)
        self.assertLess(np.abs(self.table('d.csv')[0] / first - 1).max(), 1e-9)
        vtu = Vtu(self.path('a.vtu'))
        vtu.arrays['stretch_l2'][7] *= 1.5
        self.found(vtu.write(self.path('b.vtu')), says=['cell 7', 'stretch_l2'])
        self.run_ok('convert', self.path('b.vtu'), '-o', self.path('c.vtu'), '--distortion',
                    self.path('c.csv'))
        self.assertLess(np.abs(self.table('c.csv')[0] / first - 1).max(), 1e-9)
        self.run_ok('check', self.path('c.vtu'))

    def test_files_of_older_versions(self):
        self.run_ok('parametrize', generated('cap'), self.path('a.vtu'), '--degree', '2', '--quiet')
        text = self.read('a.vtu').decode()
        for name in NAMES:
            text = re.sub(r'<DataArray type="Float64" Name="%s".*?</DataArray>\n' % name, '', text,
                          flags=re.S)
        old = self.write('old.vtu', text)
        self.assertNotIn('stretch', text)
        self.run_ok('check', old)
        self.run_ok('convert', old, '-o', self.path('new.vtu'))
        self.assertIn('stretch_l2', Vtu(self.path('new.vtu')).arrays)

    def test_layouts_by_other_programs(self):
        """A square, shrunk to a third and turned over at one corner, without a claimed scale."""
        points, faces = grid(4, lambda x, y: 0)
        uv = [(x / 3, y / 3) for x, y, _ in points]
        path = self.write('a.obj', obj_text(points, faces, uv))
        section = self.run_of('check', path)['result']['distortion']
        self.assertTrue(section['scale_is_assumed'])
        for key in ('scale', 'stretch_l2', 'stretch_linf'):
            self.assertAlmostEqual(section[key], 3 if key == 'scale' else 1, delta=1e-12)
        printed = self.run_ok('convert', path, '--distortion', self.path('c.csv')).err
        self.assertIn('uv times 3', printed)
        self.assertLess(np.abs(self.table('c.csv')[0] - 1).max(), 1e-12)
        self.run_ok('convert', path, '-o', self.path('c.vtu'), '--quiet')
        self.assertNotIn('stretch_l2', self.read('c.vtu').decode())
        uv[0] = (0.3, 0.3)
        path = self.write('b.obj', obj_text(points, faces, uv))
        self.found(path, '--distortion', self.path('d.csv'))
        numbers, _ = self.table('d.csv')
        self.assertEqual(np.isinf(numbers).any(1).tolist(), (numbers[:, 2] < 0).tolist())
        self.assertTrue(np.isinf(numbers).any())

    def test_a_limit_leaves_the_table(self):
        self.run_ok('parametrize', generated('creature'), self.path('a.vtu'), '--degree', '3',
                    '--time-limit', '0', '--report', self.path('r.json'), '--distortion',
                    self.path('d.csv'), code=LIMIT)
        self.assertNotIn('distortion', self.report()['result'])
        self.agrees(self.table('d.csv')[0], measured(Vtu(self.path('a.vtu'))).faces(), 1)

    def test_names_of_the_table(self):
        mesh, out = generated('cap'), self.path('a.vtu')
        self.refused(USAGE, 'parametrize', mesh, out, '--distortion', self.path('d.txt'),
                     says='.csv')
        self.refused(USAGE, 'unwrap', mesh, out, '--distortion', '/nowhere/d.csv', says='nowhere')


if __name__ == '__main__':
    main()
