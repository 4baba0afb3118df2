# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""majorant bake: values of texels compared with a formula; the direction of v; hostile images; refusals."""
import io
import json
import math
import os
import resource
import struct
import subprocess
import unittest
import zlib

import numpy as np
from PIL import Image

from command_helpers import *
import command_helpers as helpers

HAS_EXR = '.exr' in majorant('bake', '--help').out


def chunk(kind, data):
    return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))


def png_header(width, height, depth=8, color=2):
    return b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', struct.pack('>IIBBBBB', width, height, depth, color, 0, 0, 0))


def image_bytes(array, kind='png', **mode):
    out = io.BytesIO()
    Image.fromarray(array).save(out, kind, **mode)
    return out.getvalue()


class BakeTest(CommandTest):
    def setUp(self):
        super().setUp()
        points, faces = grid(8)
        self.points, self.faces = points, faces
        self.plane = [(p[0], p[1]) for p in points]
        turned = [(0.9 - 0.8 * p[1], 0.1 + 0.8 * p[0]) for p in points]
        self.old = self.write('old.obj', obj_text(points, faces, self.plane))
        self.new = self.write('new.obj', obj_text(points, faces, turned))
        self.bare = self.write('bare.obj', obj_text(points, faces))

    def array(self, name):
        return np.asarray(Image.open(self.path(name)))

    def report(self, *args, code=OK):
        self.run_ok('bake', *args, '--report', self.path('report.json'), '--force', code=code)
        return json.loads(self.read('report.json'))['result']['bake']


class Values(BakeTest):
    def test_positions(self):
        bake = self.report(self.new, '--from', self.bare, '--attribute', 'position', '-o', self.path('a.npy'),
                           '--size', '40,30')
        self.assertEqual((bake['texels'], bake['doubly_covered'], bake['misses'], bake['method']), (1200, 0, 0, 'same'))
        self.assertEqual((bake['charts'], bake['charts_without_texels']), (1, 0))
        found, printed = np.load(self.path('a.npy')), json.loads(self.read('a.npy.json'))
        self.assertEqual(found.shape, (30, 40, 3))
        count = 0
        for y in range(30):
            for x in range(40):
                u = printed['origin'][0] + x * printed['step'][0]
                v = printed['origin'][1] + y * printed['step'][1]
                self.assertAlmostEqual(v, 1 - (y + 0.5) / 30)
                expected = ((v - 0.1) / 0.8, (0.9 - u) / 0.8)
                if not all(0 <= e <= 1 for e in expected):
                    continue
                count += 1
                np.testing.assert_allclose(found[y, x, :2], expected, atol=1e-6)
        self.assertEqual(bake['covered'], count)
        self.assertTrue(np.isnan(found[0, 0]).all())

    def test_v_is_up_and_rows_are_from_the_top(self):
        """The texture is red at large v: the upper rows of the file. A bake onto itself keeps them."""
        colors = np.zeros((2, 2, 3), np.uint8)
        colors[0, :] = (255, 0, 0)
        colors[:, 1, 2] = 255
        image = self.write('old.png', image_bytes(colors))
        self.run_ok('bake', self.old, '--from', self.old, '--image', image, '-o', self.path('a.png'),
                    '--filter', 'nearest')
        np.testing.assert_array_equal(self.array('a.png'), colors)
        self.run_ok('bake', self.new, '--from', self.old, '--image', image, '-o', self.path('b.png'), '--size', '64',
                    '--filter', 'nearest')
        found = self.array('b.png')  # turned left by 90 degrees: up becomes left, right becomes up
        self.assertEqual(tuple(found[32, 8]), (255, 0, 0 if found[32, 8][2] == 0 else 255))
        self.assertEqual(found[8, 32][2], 255)
        self.assertEqual(found[56, 32][2], 0)
        self.assertEqual(found[32, 56][0], 0)

    def test_methods_agree(self):
        for method in ('same', 'nearest'):
            self.report(self.new, '--from', self.old, '--attribute', 'position', '--method', method, '--size', '50',
                        '-o', self.path(method + '.npy'))
        same, nearest = np.load(self.path('same.npy')), np.load(self.path('nearest.npy'))
        np.testing.assert_array_equal(np.isnan(same), np.isnan(nearest))
        np.testing.assert_allclose(same, nearest, atol=1e-6)

    def test_colors_are_mixed_in_linear_light(self):
        image = self.write('old.png', image_bytes(np.array([[[0] * 3, [255] * 3]], np.uint8)))
        for flags, gray in (([], 188), (['--linear'], 128)):
            self.run_ok('bake', self.old, '--from', self.old, '--image', image, '--size', '1', '-o', self.path('a.png'),
                        '--force', *flags)
            self.assertAlmostEqual(self.array('a.png')[0, 0, 0], gray, delta=1)

    def test_sixteen_bits_and_jpeg(self):
        ramp = (np.arange(256, dtype=np.uint16) * 257).reshape(16, 16)
        image = self.write('old.png', image_bytes(ramp))
        self.run_ok('bake', self.old, '--from', self.old, '--image', image, '--filter', 'nearest', '-o',
                    self.path('a.png'))
        np.testing.assert_array_equal(self.array('a.png'), ramp)
        self.run_ok('bake', self.old, '--from', self.old, '--image', image, '--filter', 'nearest', '--depth', '8', '-o',
                    self.path('b.png'))
        np.testing.assert_array_equal(self.array('b.png'), ramp // 257)
        flat = np.full((8, 8, 3), (200, 100, 50), np.uint8)
        for quality in ({'progressive': True}, {}):
            jpeg = self.write('old.jpg', image_bytes(flat, 'jpeg', quality=95, **quality))
            self.run_ok('bake', self.old, '--from', self.old, '--image', jpeg, '-o', self.path('c.png'), '--force')
            self.assertLess(np.abs(self.array('c.png').astype(int) - flat).max(), 4)

    @unittest.skipUnless(HAS_EXR, 'no OpenEXR in this build')
    def test_exr_holds_linear_light(self):
        image = self.write('old.png', image_bytes(np.full((4, 4, 3), (255, 188, 0), np.uint8)))
        self.run_ok('bake', self.old, '--from', self.old, '--image', image, '-o', self.path('a.exr'))
        self.run_ok('bake', self.old, '--from', self.old, '--image', self.path('a.exr'), '-o', self.path('a.npy'))
        np.testing.assert_allclose(np.load(self.path('a.npy'))[2, 2], (1, 0.5029, 0), atol=1e-3)
        self.run_ok('bake', self.old, '--from', self.old, '--image', self.path('a.exr'), '-o', self.path('b.png'),
                    '--depth', 8)
        np.testing.assert_array_equal(self.array('b.png'), self.array('old.png'))
        cut = self.write('cut.exr', self.read('a.exr')[:-40])
        self.refused(UNREADABLE, 'bake', self.old, '--from', self.old, '--image', cut, '-o', self.path('c.png'),
                     says=cut)

    def test_the_textures_that_a_model_shows(self):
        """Textures of the materials of an OBJ: each face has the colour of its image."""
        for name, gray in (('a', 40), ('b', 200)):
            self.write(name + '.png', image_bytes(np.full((16, 32, 3), gray, np.uint8)))
        self.write('old.mtl', 'newmtl a\nmap_Kd a.png\nnewmtl b\nmap_Kd b.png\n')
        lines = self.read('old.obj').decode().splitlines()
        first = next(k for k, line in enumerate(lines) if line.startswith('f '))
        lines[first:first] = ['mtllib old.mtl', 'usemtl a']
        lines.insert(first + 2 + len(self.faces) // 2, 'usemtl b')  # the upper half of the grid
        model = self.write('model.obj', '\n'.join(lines) + '\n')
        self.refused(USAGE, 'bake', self.old, '--from', model, '-o', self.path('a.png'), says=['a.png', '--force'])
        self.run_ok('bake', self.old, '--from', model, '-o', self.path('c.png'))
        found = self.array('c.png')
        self.assertEqual(found.shape, (16, 32, 3))
        self.assertTrue((found[1:7] == 200).all() and (found[9:15] == 40).all())

    def test_normals_faces_and_tables(self):
        points, faces = grid(4, lambda x, y: 0)
        flat = self.write('flat.obj', obj_text(points, faces, [p[:2] for p in points]))
        self.run_ok('bake', flat, '--from', flat, '--attribute', 'normal', '--size', '8', '-o', self.path('n.png'))
        self.run_ok('bake', flat, '--from', flat, '--attribute', 'normal', '--size', '8', '-o', self.path('n.npy'))
        np.testing.assert_allclose(np.load(self.path('n.npy')), np.broadcast_to((0, 0, 1), (8, 8, 3)))
        self.run_ok('bake', flat, '--from', flat, '--attribute', 'face', '--size', '8', '-o', self.path('f.npy'))
        numbers = np.load(self.path('f.npy'))
        self.assertEqual(set(numbers.ravel().astype(int)), set(range(32)))
        np.save(self.path('rows.npy'), np.array([p[0] for p in points]))
        self.run_ok('bake', flat, '--from', flat, '--attribute', self.path('rows.npy'), '--size', '8', '-o',
                    self.path('t.npy'))
        np.testing.assert_allclose(np.load(self.path('t.npy'))[3], (np.arange(8) + 0.5) / 8, atol=1e-6)
        np.save(self.path('columns.npy'), np.asfortranarray([(p[0], 2 - p[1], 3) for p in points]))
        self.run_ok('bake', flat, '--from', flat, '--attribute', self.path('columns.npy'), '--size', '8', '-o',
                    self.path('k.npy'))
        middle = (np.arange(8) + 0.5) / 8
        np.testing.assert_allclose(np.load(self.path('k.npy'))[2, 5], (middle[5], 1 + middle[2], 3), atol=1e-6)
        self.run_ok('bake', flat, '--from', flat, '--attribute', 'distortion', '--size', '8', '-o', self.path('d.npy'))
        np.testing.assert_allclose(np.load(self.path('d.npy')), 1, atol=1e-5)

    def test_the_description_of_an_array_is_an_output(self):
        """A report does not replace the .json that describes a .npy."""
        self.refused(USAGE, 'bake', self.new, '--from', self.bare, '--attribute', 'position', '--size', '16', '-o',
                     self.path('p.npy'), '--report', self.path('p.npy.json'), says='same file')
        self.assertNotIn('p.npy.json', self.files())

    def test_padding_and_misses(self):
        points, faces = grid(8)
        half = self.write('half.obj', obj_text(points, [f for f in faces if max(points[v][0] for v in f) <= 0.5]))
        args = (self.new, '--from', half, '--attribute', 'position', '--size', '64', '--distance', '0.01')
        bake = self.report(*args, '-o', self.path('a.npy'))
        self.assertGreater(bake['misses'], 500)
        self.assertLess(bake['misses'], bake['covered'])
        self.assertEqual(bake['method'], 'nearest')
        before = self.read('a.npy')
        self.report(*args, '--strict', '-o', self.path('a.npy'), code=INVALID)
        self.assertEqual(self.read('a.npy'), before)
        bake = self.report(self.new, '--from', self.bare, '--attribute', 'face', '--size', '64', '--padding', '64',
                           '-o', self.path('b.npy'))
        self.assertEqual((np.load(self.path('b.npy')) < 0).sum(), 0)

    def test_curved_layouts(self):
        self.run_ok('parametrize', self.bare, '-o', self.path('curved.vtu'), '--degree', 3, '--normalize')
        bake = self.report(self.path('curved.vtu'), '--from', self.old, '--attribute', 'position', '--size', '64', '-o',
                           self.path('a.npy'))
        self.assertEqual((bake['doubly_covered'], bake['undecided'], bake['method']), (0, 0, 'same'))
        found = np.load(self.path('a.npy')).reshape(-1, 3)
        found = found[~np.isnan(found[:, 0])]
        self.assertGreater(len(found), 1000)
        heights = np.array([bumpy(x, y) for x, y, _ in found])
        self.assertLess(np.abs(heights - found[:, 2]).max(), 0.02)


class Refusals(BakeTest):
    def image(self, name, content, code=UNREADABLE, says=()):
        path = self.write(name, content)
        self.refused(code, 'bake', self.old, '--from', self.old, '--image', path, '-o', self.path('out.png'),
                     says=[path, *([says] if isinstance(says, str) else says)])
        self.assertFalse(os.path.exists(self.path('out.png')))

    def test_hostile_images(self):
        good = image_bytes(np.arange(48, dtype=np.uint8).reshape(4, 4, 3))
        self.image('a.png', good[:-20])
        self.image('b.png', good[:20])
        self.image('c.png', b'')
        self.image('d.png', good[:40] + b'x' + good[41:])
        rows = zlib.compress(b'\0' * 1000)
        end = chunk(b'IDAT', rows) + chunk(b'IEND', b'')
        for size in ((2 ** 31 - 1, 2 ** 31 - 1), (0, 5), (20000, 1), (16384, 16384)):
            self.image('e.png', png_header(*size) + end)
        jpeg = image_bytes(np.full((64, 64, 3), 90, np.uint8), 'jpeg')
        self.image('a.jpg', jpeg[:len(jpeg) // 2])
        self.image('b.jpg', good)
        at = jpeg.index(b'\xff\xc0') + 5
        self.image('c.jpg', jpeg[:at] + struct.pack('>HH', 65000, 65000) + jpeg[at + 4:])
        if HAS_EXR:
            self.image('a.exr', b'')
            self.image('b.exr', b'v/1\x01' + os.urandom(500))
        for name in ('a.ktx2', 'a.webp'):
            self.image(name, b'x', UNSUPPORTED, 'PNG')
        self.image('a.tiff', b'x')
        out = io.BytesIO()
        Image.new('CMYK', (4, 4)).save(out, 'jpeg')
        self.image('d.jpg', out.getvalue(), UNSUPPORTED, 'CMYK')

    def test_files_without_a_layout_are_refused(self):
        out = self.path('out.npy')
        args = ['--attribute', 'position', '-o', out]
        self.refused(UNSUPPORTED, 'bake', self.bare, '--from', self.old, *args, says='majorant unwrap')
        far = self.write('far.obj', obj_text(self.points, self.faces, [(3 * u, v) for u, v in self.plane]))
        self.refused(UNSUPPORTED, 'bake', far, '--from', self.old, *args, says='--normalize')
        image = self.write('i.png', image_bytes(np.zeros((2, 2, 3), np.uint8)))
        self.refused(UNSUPPORTED, 'bake', self.old, '--from', self.bare, '--image', image, '-o', self.path('o.png'),
                     says='texture coordinates')
        other = self.write('other.obj', obj_text(*grid(5)))
        self.refused(UNSUPPORTED, 'bake', self.old, '--from', other, '--method', 'same', *args, says='nearest points')
        twice = self.write('twice.obj', obj_text(self.points, self.faces, [(abs(u - 0.5), v) for u, v in self.plane]))
        outcome = majorant('bake', twice, '--from', self.old, *args, '--size', 32)
        self.assertEqual(outcome.code, INVALID)
        self.assertIn('two places', outcome.printed()[-1])
        self.assertFalse(os.path.exists(out))

    def test_usage(self):
        out, args = self.path('out.png'), ['bake', self.old, '--from', self.old]
        self.refused(USAGE, 'bake', self.old, '--from', self.path('none.vtu'), '-o', out, says='--image')
        self.refused(UNSUPPORTED, *args, '-o', out, says='map_Kd')  # the target has no texture itself
        self.refused(USAGE, *args, '--attribute', 'position', '-o', out, says='.npy')
        none = ['bake', self.path('none.obj'), '--from', self.path('none.obj'), '-o', out, '--attribute']
        for wrong, right in (('normals', 'normal'), ('Position', 'position'), ('faces', 'face')):  # before any file is read
            self.refused(USAGE, *none, wrong, says="there is no file '%s' (did you mean '%s'?)" % (wrong, right))
        self.refused(UNREADABLE, *args, '--attribute', 'hue', '-o', out, says='hue: No such file')
        self.refused(UNSUPPORTED, *args, '--attribute', 'tangent-normal', '-o', out, says='tangent')
        self.refused(USAGE, *args, '--attribute', 'normal', '-o', self.path('a.obj'), says='.png')
        self.refused(USAGE, *args, '--attribute', 'normal', '-o', out, '--size', '0', says='--size')
        self.refused(USAGE, *args, '--attribute', 'normal', '-o', self.path('a.npy'), '--depth', 8, says='--depth')
        self.refused(UNREADABLE, *args, '--attribute', self.path('none.npy'), '-o', self.path('a.npy'))
        wrong = self.path('wrong.npy')
        np.save(wrong, np.zeros(7))
        self.refused(UNREADABLE, *args, '--attribute', wrong, '-o', self.path('a.npy'), says='7 rows')
        self.write('wrong.npy', self.read('wrong.npy')[:-3])
        self.refused(UNREADABLE, *args, '--attribute', wrong, '-o', self.path('a.npy'))

    def test_a_full_disk_and_a_limit_leave_the_old_image(self):
        out = self.write('out.png', b'old')
        args = [helpers.BINARY, 'bake', self.old, '--from', self.old, '--attribute', 'normal', '-o', out,
                '--size', '200']
        full = subprocess.run(args, capture_output=True, text=True,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000)))
        self.assertEqual(full.returncode, USAGE, full.stderr)
        late = subprocess.run([*args, '--time-limit', '0'], capture_output=True, text=True)
        self.assertEqual((late.returncode, late.stderr.count('\n')), (INVALID, 1), late.stderr)
        self.assertEqual(self.read('out.png'), b'old')
        self.assertEqual([f for f in self.files() if 'tmp' in f], [])


def polygon_plane(seed, n=4):
    """Returns points and polygons of a square of the plane, cut into triangles, quads and hexagons. Vertices are
    shaken, and polygons begin at random corners."""
    random = np.random.default_rng(seed)
    points = np.array([(i / n, j / n) for j in range(n + 1) for i in range(n + 1)], float)
    inner = ((points > 0.01) & (points < 0.99)).all(1)
    points[inner] += random.uniform(-0.15, 0.15, (inner.sum(), 2)) / n
    polygons = []
    for j in range(n):
        i = 0
        while i < n:
            a, b = j * (n + 1) + i, (j + 1) * (n + 1) + i
            kind = random.integers(3)
            if kind == 0 and i + 1 < n:  # two cells at once
                polygons.append([a, a + 1, a + 2, b + 2, b + 1, b])
                i += 2
                continue
            polygons += [[a, a + 1, b + 1, b]] if kind else [[a, a + 1, b + 1], [a, b + 1, b]]
            i += 1
    return points, [list(np.roll(p, random.integers(len(p)))) for p in polygons]


def polygon_at(points, polygons, place, margin):
    """Returns the number of the polygon that contains the place at this distance from its edges; -1: none."""
    for k, polygon in enumerate(polygons):
        corners = points[polygon]
        edges = np.roll(corners, -1, 0) - corners
        normals = np.stack([-edges[:, 1], edges[:, 0]], -1) / np.linalg.norm(edges, axis=1)[:, None]
        if (((place - corners) * normals).sum(1) > margin).all():
            return k
    return -1


class Polygons(CommandTest):
    """Compares data of triangles, quads and hexagons in one file with the polygon that contains a texel's centre:
    with and without texture coordinates per polygon, with and without normals, by numbers and by nearest points."""
    SIZE = 48

    def setUp(self):
        super().setUp()
        self.points, self.polygons = polygon_plane(int(self.id().encode().hex(), 16) % 1000)
        random = np.random.default_rng(7)
        self.normals = random.normal(size=(len(self.polygons), 3))
        self.normals /= np.linalg.norm(self.normals, axis=1)[:, None]
        self.islands = random.uniform(0.2, 0.8, (len(self.polygons), 2))  # of texture coordinates, one per polygon
        self.scales = random.uniform(0.1, 0.2, len(self.polygons))
        self.material_of = random.integers(0, 3, len(self.polygons))
        self.new = self.write('new.obj', self.obj(vt=self.points, vt_of=self.polygons))
        self.texels = [(x, y) for y in range(self.SIZE) for x in range(self.SIZE)]
        centers = [((x + 0.5) / self.SIZE, 1 - (y + 0.5) / self.SIZE) for x, y in self.texels]
        self.polygon_of = [polygon_at(self.points, self.polygons, np.array(c), 0.03) for c in centers]
        self.inside = [(t, c, p) for t, c, p in zip(self.texels, centers, self.polygon_of) if p >= 0]
        self.assertGreater(len(self.inside), 500)

    def obj(self, vt=(), vt_of=None, vn=False, materials=False, colors=None):
        lines = ['mtllib m.mtl'] if materials else []
        for k, (x, y) in enumerate(self.points):
            lines.append('v %.17g %.17g 0' % (x, y) + (' %.17g %.17g %.17g' % tuple(colors[k]) if colors is not None else ''))
        lines += ['vt %.17g %.17g' % tuple(t) for t in vt]
        lines += ['vn %.17g %.17g %.17g' % tuple(n) for n in self.normals] if vn else []
        for p, polygon in enumerate(self.polygons):
            if materials:
                lines.append('usemtl m%d' % self.material_of[p])
            lines.append('f ' + ' '.join(
                '%d' % (v + 1) + ('/' if vt_of or vn else '') + ('%d' % (vt_of[p][k] + 1) if vt_of else '') +
                ('/%d' % (p + 1) if vn else '') for k, v in enumerate(polygon)))
        return '\n'.join(lines) + '\n'

    def island_coordinates(self):
        """Returns texture coordinates: polygon p is a shrunk copy of itself around islands[p]."""
        vt, vt_of = [], []
        for p, polygon in enumerate(self.polygons):
            vt_of.append([len(vt) + k for k in range(len(polygon))])
            middle = self.points[polygon].mean(0)
            vt += [self.islands[p] + self.scales[p] * (self.points[v] - middle) for v in polygon]
        return vt, vt_of

    def carriers(self, **mode):
        """Yields files with texture coordinates, as OBJ, PLY and VTU, and without, as OBJ and PLY."""
        vt, vt_of = self.island_coordinates()
        yield self.write('vt.obj', self.obj(vt, vt_of, **mode))
        yield self.write('bare.obj', self.obj(**mode))
        if not mode:
            faces = ['%d %s %d %s' % (len(p), ' '.join(map(str, p)), 2 * len(t),
                                      ' '.join('%.17g %.17g' % tuple(vt[k]) for k in t))
                     for p, t in zip(self.polygons, vt_of)]
            head = 'ply\nformat ascii 1.0\nelement vertex %d\nproperty double x\nproperty double y\nproperty double z\n' \
                   'element face %d\nproperty list uchar int vertex_indices\n%send_header\n'
            vertices = ''.join('%.17g %.17g 0\n' % tuple(p) for p in self.points)
            counts = len(self.points), len(self.polygons)
            yield self.write('vt.ply', head % (*counts, 'property list uchar double texcoord\n') + vertices
                             + '\n'.join(faces) + '\n')
            yield self.write('bare.ply', head % (*counts, '') + vertices
                             + ''.join('%d %s\n' % (len(p), ' '.join(map(str, p))) for p in self.polygons))
            self.run_ok('convert', self.path('vt.obj'), '-o', self.path('vt.vtu'), '--force')
            yield self.path('vt.vtu')

    def baked(self, carrier, attribute, method='auto'):
        out = self.path('out.npy')
        self.run_ok('bake', self.new, '--from', carrier, '--attribute', attribute, '-o', out, '--size', self.SIZE,
                    '--force', '--method', method)
        return np.load(out)

    def compare(self, carrier, attribute, expected, tolerance=1e-6, methods=('auto', 'nearest')):
        """Compares a bake with expected(place, polygon)."""
        for method in methods:
            with self.subTest(carrier=os.path.basename(carrier), attribute=attribute, method=method):
                found = self.baked(carrier, attribute, method)
                found = np.array([np.atleast_1d(found[y, x]) for (x, y), _, _ in self.inside]).reshape(
                    len(self.inside), -1)
                right = np.array([np.atleast_1d(expected(c, p)) for _, c, p in self.inside], float)
                self.assertLess(np.abs(found - right).max(), tolerance)

    def test_faces_and_positions(self):
        for carrier in self.carriers():
            self.compare(carrier, 'face', lambda c, p: p)
            self.compare(carrier, 'position', lambda c, p: (*c, 0))

    def test_rows_of_faces_vertices_and_corners(self):
        random = np.random.default_rng(3)
        by_face = random.uniform(-1, 1, (len(self.polygons), 2))
        np.save(self.path('faces.npy'), by_face)
        np.save(self.path('vertices.npy'), self.points @ [2, -3] + 1)
        slopes = random.uniform(-1, 1, (len(self.polygons), 3))
        np.save(self.path('corners.npy'),
                np.concatenate([self.points[polygon] @ slopes[p, :2] + slopes[p, 2]
                                for p, polygon in enumerate(self.polygons)]))
        for carrier in self.carriers():
            self.compare(carrier, self.path('faces.npy'), lambda c, p: by_face[p])
            self.compare(carrier, self.path('vertices.npy'), lambda c, p: 2 * c[0] - 3 * c[1] + 1)
            if not carrier.endswith('.vtu'):  # a .vtu numbers cells, not polygons
                self.compare(carrier, self.path('corners.npy'), lambda c, p: slopes[p, :2] @ c + slopes[p, 2])

    def test_normals(self):
        for carrier in self.carriers(vn=True):
            self.compare(carrier, 'normal', lambda c, p: self.normals[p])
        for carrier in self.carriers():
            self.compare(carrier, 'normal', lambda c, p: (0, 0, 1))

    def test_textures_of_several_materials(self):
        """Ramps along u in three images, in an OBJ and in a GLB made of it."""
        x = np.arange(256)
        for k in range(3):
            ramp = np.stack([x, 255 - x, 0 * x + 80 * k], -1).astype(np.uint8)
            self.write('m%d.png' % k, image_bytes(np.broadcast_to(ramp, (8, 256, 3)).copy()))
        self.write('m.mtl', ''.join('newmtl m%d\nmap_Kd m%d.png\n' % (k, k) for k in range(3)))
        model = self.write('model.obj', self.obj(*self.island_coordinates(), materials=True))
        self.run_ok('convert', model, '-o', self.path('model.glb'))
        for carrier in (model, self.path('model.glb')):
            with self.subTest(carrier):
                self.run_ok('bake', self.new, '--from', carrier, '-o', self.path('out.png'), '--size', self.SIZE,
                            '--force')
                found = np.asarray(Image.open(self.path('out.png'))).astype(int)
                for (x, y), c, p in self.inside:
                    u = self.islands[p][0] + self.scales[p] * (c[0] - self.points[self.polygons[p]].mean(0)[0])
                    code = 256 * u - 0.5
                    self.assertLess(np.abs(found[y, x] - (code, 255 - code, 80 * self.material_of[p])).max(), 4)

    def test_unwrap_bake(self):
        """Each polygon keeps the colour of its material, in an OBJ and in a GLB."""
        grays = (40, 120, 200)
        for k, gray in enumerate(grays):
            self.write('m%d.png' % k, image_bytes(np.full((64, 64, 3), gray, np.uint8)))
        self.write('m.mtl', ''.join('newmtl m%d\nmap_Kd m%d.png\n' % (k, k) for k in range(3)))
        model = self.write('model.obj', self.obj(*self.island_coordinates(), materials=True))
        self.run_ok('unwrap', model, '-o', self.path('out.obj'), '--bake', '--resolution', 256)
        pixels = np.asarray(Image.open(self.path('out.png')))
        self.assertEqual(pixels.shape, (256, 256, 3))
        _, vt, faces, texture = read_obj(self.path('out.obj'))
        self.assertEqual([len(f) for f in faces], [len(p) for p in self.polygons])
        for p, corners in enumerate(texture):
            u, v = np.mean([vt[t] for t in corners], axis=0)
            self.assertLessEqual(abs(int(pixels[int((1 - v) * 256), int(u * 256), 0]) - grays[self.material_of[p]]), 2)

    def test_colors_of_vertices(self):
        """They are the default without a texture. OBJ and PLY have codes of sRGB, glTF linear light."""
        colors = np.stack([0.2 + 0.6 * self.points[:, 0], 0.7 - 0.5 * self.points[:, 1], 0 * self.points[:, 0] + 0.5], -1)
        obj = self.write('color.obj', self.obj(colors=colors))
        self.run_ok('unwrap', obj, '-o', self.path('color.glb'), '-o', self.path('color.ply'))
        for carrier, flags in ((obj, ['--linear']), (obj, []), (self.path('color.glb'), []), (self.path('color.ply'), [])):
            for printed in ([], ['--attribute', 'color']):
                with self.subTest(carrier, flags=flags, printed=printed):
                    self.run_ok('bake', self.new, '--from', carrier, '-o', self.path('out.png'), '--size', self.SIZE,
                                '--force', *flags, *printed)
                    found = np.asarray(Image.open(self.path('out.png'))).astype(int)
                    tolerance = 1 if flags else 4  # colours are interpolated between distant vertices
                    for (x, y), (u, v), _ in self.inside:
                        right = 255 * np.array([0.2 + 0.6 * u, 0.7 - 0.5 * v, 0.5])
                        self.assertLess(np.abs(found[y, x] - right).max(), tolerance)
        self.refused(UNSUPPORTED, 'bake', self.new, '--from', self.write('no.obj', self.obj()), '--attribute', 'color', '-o',
                     self.path('no.png'), says='colours')
        self.refused(UNSUPPORTED, 'bake', self.new, '--from', self.path('no.obj'), '-o', self.path('no.png'),
                     says=['map_Kd', 'colours'])


class ThinParts(CommandTest):
    """A slab with a red upper and a blue lower side, and a coarse copy: each texel shows its own side."""

    def slab(self, n, thickness, shrink=0.0):
        """Returns points, faces and flags of upper faces of two sheets that are joined at the rim."""
        index, points, faces, is_upper = {}, [], [], []
        for side in (0, 1):
            for j in range(n + 1):
                for i in range(n + 1):
                    x, y = i / n, j / n
                    bump = math.sin(math.pi * x) * math.sin(math.pi * y)
                    index[side, i, j] = len(points)
                    points.append((x, y, (2 * side - 1) * thickness * (0.5 + bump - shrink)))
        for side in (0, 1):
            for j in range(n):
                for i in range(n):
                    quad = [index[side, i, j], index[side, i + 1, j], index[side, i + 1, j + 1], index[side, i, j + 1]]
                    faces.append(quad if side else quad[::-1])
                    is_upper.append(side)
        rim = [(i, 0) for i in range(n)] + [(n, j) for j in range(n)] + [(n - i, n) for i in range(n)] + \
              [(0, n - j) for j in range(n)]
        for a, b in zip(rim, rim[1:] + rim[:1]):
            faces.append([index[0, *a], index[0, *b], index[1, *b], index[1, *a]])
            is_upper.append(2)
        return points, faces, is_upper

    def files(self, thickness=0.004):
        points, faces, _ = self.slab(30, thickness)
        half = len(points) // 2
        old = ''.join('v %.9g %.9g %.9g %d 0 %d\n' % (*p, k >= half, k < half) for k, p in enumerate(points))
        old += ''.join('f %d %d %d %d\n' % tuple(v + 1 for v in f) for f in faces)
        points, faces, is_upper = self.slab(5, thickness, 0.2)
        new = ''.join('v %.9g %.9g %.9g\n' % p for p in points)
        lines = []
        for f, upper in zip(faces, is_upper):
            if upper == 2:
                continue
            for v in f:
                x, y, _ = points[v]
                new += 'vt %.9g %.9g\n' % ((0.02 + 0.45 * x, 0.3 + 0.45 * y) if upper else (0.98 - 0.45 * x, 0.3 + 0.45 * y))
            at = 4 * len(lines)
            lines.append('f ' + ' '.join('%d/%d' % (v + 1, at + k + 1) for k, v in enumerate(f)))
        return self.write('old.obj', old), self.write('new.obj', new + '\n'.join(lines) + '\n')

    def bake(self, old, new):
        done = self.run_ok('bake', new, '--from', old, '-o', self.path('out.png'), '--size', 128, '--padding', 0, '--force',
                           '--report', self.path('r.json'))
        pixels = np.asarray(Image.open(self.path('out.png'))).astype(int)
        return done, pixels[:, :64], pixels[:, 64:], json.loads(self.read('r.json'))['result']['bake']

    def test_each_side_has_its_own_color(self):
        done, upper, lower, bake = self.bake(*self.files())
        self.assertEqual((bake['misses'], bake['opposed'], bake['method']), (0, 0, 'nearest'))
        for side, own, other in ((upper, 0, 2), (lower, 2, 0)):
            shown = side.max(-1) > 100
            self.assertGreater(shown.sum(), 2500)
            self.assertEqual((shown & (side[..., other] > side[..., own])).sum(), 0)

    def test_sheets_with_one_side_are_reported(self):
        """A sheet with an upper side only: the lower half of the layout shows it, opposed."""
        old, new = self.files()
        lines = self.read('old.obj').decode().splitlines()
        faces = [line for line in lines if line.startswith('f ')]
        self.write('old.obj', '\n'.join([line for line in lines if line.startswith('v ')] + faces[900:1800]) + '\n')
        done, upper, lower, bake = self.bake(old, new)
        self.assertEqual(bake['misses'], 0)
        self.assertAlmostEqual(bake['opposed'], 0.5, delta=0.02)
        self.assertRegex(done.err, r'(49|5[01])(\.\d+)? % of its texels show places of .* whose normals point the other way')
        self.assertTrue((lower[..., 0] > 100).any())

    def test_a_surface_that_is_turned_inside_out(self):
        old, new = self.files()
        lines = [line if line.startswith('v') else 'f ' + ' '.join(line.split()[:0:-1])
                 for line in self.read('old.obj').decode().splitlines()]
        self.write('old.obj', '\n'.join(lines) + '\n')
        done, upper, lower, bake = self.bake(old, new)
        self.assertIn('oriented the other way', done.err)
        self.assertEqual(bake['opposed'], 0)
        self.assertEqual((upper[..., 2] > upper[..., 0]).sum() + (lower[..., 0] > lower[..., 2]).sum(), 0)

    def test_other_units(self):
        """Nothing is near: there is no image, and the message has the distance."""
        old, new = self.files()
        lines = ['v %s' % ' '.join(repr(1000 * float(x)) for x in line.split()[1:4]) if line.startswith('v ') else line
                 for line in self.read('old.obj').decode().splitlines()]
        old = self.write('mm.obj', '\n'.join(lines).replace('v 0.0 0.0 ', 'v -900.0 -900.0 ') + '\n')
        lines = ['v %s' % ' '.join(repr(float(x) - 5000) for x in line.split()[1:4]) if line.startswith('v ') else line
                 for line in self.read('new.obj').decode().splitlines()]
        new = self.write('away.obj', '\n'.join(lines) + '\n')
        done = majorant('bake', new, '--from', old, '--attribute', 'normal', '-o', self.path('x.png'))
        self.assertEqual(done.code, INVALID, done.err)
        self.assertRegex(done.err, r'all of its \d+ covered texels miss: .*mm\.obj is \d+ away.*units')
        self.assertFalse(os.path.exists(self.path('x.png')))


class Wrapping(CommandTest):
    """Textures beyond their square, repeated or clamped; -mm; missing materials."""

    def model(self, options, materials=('a', 'a')):
        """Writes a model with texture coordinates from -1 to 2 along u."""
        ramp = np.broadcast_to(np.stack([np.arange(256)] * 3, -1).astype(np.uint8), (8, 256, 3)).copy()
        self.write('t.png', image_bytes(ramp))
        self.write('m.mtl', 'newmtl %s\nmap_Kd %s t.png\n' % (materials[0], options))
        text = 'mtllib m.mtl\nusemtl %s\n' % materials[1]
        text += ''.join('v %g %g 0\nvt %g %g\n' % (x, y, 3 * x - 1, 0.5) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)))
        self.write('new.obj', ''.join('v %g %g 0\nvt %g %g\n' % (x, y, x, y) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)))
                   + 'f 1/1 2/2 3/3 4/4\n')
        return self.write('old.obj', text + 'f 1/1 2/2 3/3 4/4\n')

    def row(self, *options, **mode):
        done = self.run_ok('bake', self.path('new.obj'), '--from', self.model(*options, **mode), '-o', self.path('o.png'),
                           '--size', '96,4', '--force')
        return done, np.asarray(Image.open(self.path('o.png'))).astype(float)[2, :, 0]

    def test_clamped_and_repeated(self):
        u = 3 * (np.arange(96) + 0.5) / 96 - 1
        np.testing.assert_allclose(self.row('-clamp on')[1], np.clip(256 * u - 0.5, 0, 255), atol=1.5)
        inside = np.abs(u - np.round(u)) > 0.02
        for options in ('', '-clamp off', '-blendu on -boost 2'):
            np.testing.assert_allclose(self.row(options)[1][inside], (256 * (u % 1) - 0.5)[inside], atol=1.5)

    def test_base_and_gain(self):
        u = 3 * (np.arange(96) + 0.5) / 96 - 1
        np.testing.assert_allclose(self.row('-clamp on -mm 0.25 0.5')[1],
                                   0.25 * 255 + 0.5 * np.clip(256 * u - 0.5, 0, 255), atol=1.5)

    def test_options_that_are_refused(self):
        for option in ('-s 2 2 2', '-o 1 0', '-imfchan r', '-new 1'):
            self.refused(UNSUPPORTED, 'bake', self.path('new.obj'), '--from', self.model(option), '-o', self.path('o.png'),
                         says=option.split()[0])

    def test_a_material_that_no_library_has(self):
        done, row = self.row('', materials=('A', 'a'))
        self.assertIn("no mtllib has the material 'a' (it has 'A')", done.err)
        self.assertTrue((row == 255).all())


class Unwrap(CommandTest):
    """unwrap --bake: faces keep their colours, by the new texture coordinates in the new image."""

    def colors(self, obj, image):
        """Returns the colours at the centres of the faces."""
        _, vt, _, texture = read_obj(self.path(obj))
        pixels = np.asarray(Image.open(self.path(image))).astype(float)
        height, width = pixels.shape[:2]
        uv = np.array([np.mean([vt[t] for t in face], axis=0) for face in texture])
        return pixels[np.clip((1 - uv[:, 1]) * height, 0, height - 1).astype(int),
                      np.clip(uv[:, 0] * width, 0, width - 1).astype(int)]

    def model(self, materials='newmtl a\nKd 1 1 1\nmap_Kd -clamp on old.png\nmap_Bump b.png\n', between=''):
        points, faces = grid(6)
        x, y = np.meshgrid(np.arange(256), np.arange(256))
        self.write('old.png', image_bytes(np.stack([x, y, 255 - x], -1).astype(np.uint8)))
        self.write('old.mtl', materials)
        text = obj_text(points, faces, [(p[0], p[1]) for p in points]).replace('f ', 'mtllib old.mtl\nusemtl a\nf ', 1)
        at = text.index('f ', len(text) * 4 // 5)
        return self.write('old.obj', text[:at] + between + text[at:])

    def test_a_texture_moves(self):
        os.mkdir(self.path('out'))
        done = self.run_ok('unwrap', self.model(), '-o', self.path('out/new.obj'), '--bake', '--report',
                           self.path('r.json'))
        self.assertIn('map_Bump', done.err)
        text = self.read('out/new.obj').decode()
        self.assertEqual([line for line in text.splitlines() if line.startswith(('mtllib', 'usemtl'))],
                         ['mtllib new.mtl', 'usemtl a'])
        self.assertRegex(self.read('out/new.mtl').decode(),
                         r'^# majorant [0-9.]+\nnewmtl a\nKd 1 1 1\nmap_Kd new.png\n$')
        old, new = self.colors('old.obj', 'old.png'), self.colors('out/new.obj', 'out/new.png')
        self.assertEqual(np.asarray(Image.open(self.path('out/new.png'))).shape, (256, 256, 3))
        self.assertLess(np.abs(old - new).max(), 4)
        self.assertEqual([(f['file'], f['written']) for f in json.loads(self.read('r.json'))['outputs']],
                         [(self.path('out/new.' + kind), True) for kind in ('obj', 'png', 'mtl')])
        self.assertEqual(self.run_ok('check', self.path('out/new.obj'), '--certify').code, OK)

    def test_a_limit_that_comes_before_the_texture(self):
        new = self.path('new.obj')
        done = majorant('unwrap', self.model(), '-o', new, '--bake', '--time-limit', 0, '--quiet')
        self.assertEqual(done.code, INVALID, done.err)
        self.assertRegex(done.err, 'the time limit was reached while baking .*' + re.escape(new)
                         + '; nothing was written')
        self.assertEqual([name for name in self.files() if name.startswith(('new', '.'))], [])

    def test_other_maps_move(self):
        """Maps of colours and numbers are moved; maps of directions and unreadable ones are left out and named."""
        x, y = np.meshgrid(np.arange(256), np.arange(256))
        self.write('s.png', image_bytes(np.stack([y, x, x], -1).astype(np.uint8)))
        self.write('ns.png', image_bytes((257 * x).astype(np.uint16)))
        self.write('bump.png', image_bytes(x.astype(np.uint8)))
        self.write('norm.png', image_bytes(np.full((4, 4, 3), (128, 128, 255), np.uint8)))
        path = self.model('newmtl a\nmap_Kd old.png\nmap_Ks s.png\nmap_Ns ns.png\nbump -bm 0.5 bump.png\n'
                          'norm norm.png\nmap_Bump norm.png\nmap_Ke gone.png\n')
        done = self.run_ok('unwrap', path, '-o', self.path('new.obj'), '--bake', '--report', self.path('r.json'))
        for word, why in (('norm', 'layout'), ('map_Bump', 'directions'), ('map_Ke', 'gone.png')):
            self.assertRegex(done.err, r'%s is not moved to the new layout, and left out: .*%s' % (word, why))
        self.assertEqual(self.read('new.mtl').decode().splitlines()[1:],
                         ['newmtl a', 'map_Kd new.png', 'map_Ks new_map_Ks.png', 'map_Ns new_map_Ns.png',
                          'bump -bm 0.5 new_bump.png'])
        self.assertEqual([os.path.basename(f['file']) for f in json.loads(self.read('r.json'))['outputs']],
                         ['new.obj', 'new.png', 'new.mtl', 'new_bump.png', 'new_map_Ks.png', 'new_map_Ns.png'])
        for old, new in (('s', 'map_Ks'), ('ns', 'map_Ns'), ('bump', 'bump')):
            scale = 257 if old == 'ns' else 1
            before, after = (self.colors(*pair) for pair in (('old.obj', old + '.png'), ('new.obj', 'new_%s.png' % new)))
            self.assertLess(np.abs(before - after).max(), 4 * scale)
        source = self.model('newmtl a\nmap_Kd old.png\nmap_Ks out_map_Ks.png\n')
        self.write('out_map_Ks.png', self.read('s.png'))
        done = majorant('unwrap', source, '-o', self.path('out.obj'), '--bake')
        self.assertEqual(done.code, USAGE, done.err)
        self.assertIn('out_map_Ks.png', done.err)
        self.assertEqual(self.read('out_map_Ks.png'), self.read('s.png'))
        self.assertFalse(os.path.exists(self.path('out.obj')))

    def test_a_picture_that_fits_the_old_layout(self):
        model = self.model()
        for verb in ('unwrap', 'parametrize'):
            done = self.run_ok(verb, model, '-o', self.path(verb + '.obj'))
            self.assertRegex(done.err, r'its picture .*old\.png fits the old layout.*--bake')
            self.assertNotIn('fits the old', self.run_ok(verb, model, '-o', self.path(verb + '.ply')).err)
        report = self.run_ok('unwrap', model, '-o', self.path('unwrap.obj'), '--report', '-', '-q').out
        self.assertRegex(json.loads(report)['warnings'][0], 'fits the old layout')

    def test_the_size_of_the_image(self):
        for flags, side in (([], 256), (['--resolution', 100], 100), (['--preset', 'lightmap'], 512)):
            self.run_ok('unwrap', self.model(), '-o', self.path('new.obj'), '--bake', *flags)
            self.assertEqual(Image.open(self.path('new.png')).size, (side, side))
        self.refused(USAGE, 'unwrap', self.model(), '-o', self.path('new.obj'), '--bake', '--resolution', 20000,
                     says='--resolution')

    def test_several_materials_become_one_image(self):
        self.write('gray.png', image_bytes(np.full((32, 32), 77, np.uint8)))
        path = self.model('newmtl a\nmap_Kd old.png\nnewmtl b\nmap_Kd gray.png\nnewmtl c\nKd 1 0 0\n', 'usemtl b\n')
        with open(path, 'a') as f:
            f.write('usemtl c\nf 1/1 2/2 9/9\n')
        self.run_ok('unwrap', path, '-o', self.path('new.obj'), '--bake')
        colors = self.colors('new.obj', 'new.png')
        self.assertEqual(tuple(colors[-1]), (255, 0, 0))
        self.assertEqual(tuple(colors[-3]), (77, 77, 77))
        self.assertLess(np.abs(colors[:20] - self.colors('old.obj', 'old.png')[:20]).max(), 4)

    def test_refusals(self):
        out = self.path('new.obj')
        self.refused(UNSUPPORTED, 'unwrap', generated('buckle'), '-o', out, '--bake', says='map_Kd')
        self.refused(USAGE, 'unwrap', self.model(), '-o', self.path('new.vtu'), '--bake', says='OUT.obj')
        self.refused(USAGE, 'unwrap', self.model(), '-o', out, '-o', self.path('two.obj'), '--bake', says='one OBJ and one glTF model')
        self.refused(UNSUPPORTED, 'unwrap', self.model('newmtl a\nmap_Kd -s 2 2 2 old.png\n'), '-o', out, '--bake',
                     says='-s')
        path = self.model()
        os.remove(self.path('old.png'))
        self.refused(UNREADABLE, 'unwrap', path, '-o', out, '--bake', says='old.png')
        self.assertFalse(os.path.exists(out))


if __name__ == '__main__':
    helpers.main()
