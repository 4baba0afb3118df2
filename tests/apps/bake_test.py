# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""majorant bake: what texels show, against the formula; directions of v; hostile images; what is refused."""
import io
import json
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


def image_bytes(array, kind='png', **how):
    out = io.BytesIO()
    Image.fromarray(array).save(out, kind, **how)
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
        found, said = np.load(self.path('a.npy')), json.loads(self.read('a.npy.json'))
        self.assertEqual(found.shape, (30, 40, 3))
        count = 0
        for y in range(30):
            for x in range(40):
                u = said['origin'][0] + x * said['step'][0]
                v = said['origin'][1] + y * said['step'][1]
                self.assertAlmostEqual(v, 1 - (y + 0.5) / 30)
                expected = ((v - 0.1) / 0.8, (0.9 - u) / 0.8)
                if not all(0 <= e <= 1 for e in expected):
                    continue
                count += 1
                np.testing.assert_allclose(found[y, x, :2], expected, atol=1e-6)
        self.assertEqual(bake['covered'], count)
        self.assertTrue(np.isnan(found[0, 0]).all())

    def test_v_is_up_and_rows_are_from_the_top(self):
        """Red where v is large in the old texture: the upper row of the file; unchanged by a bake onto itself."""
        colors = np.zeros((2, 2, 3), np.uint8)
        colors[0, :] = (255, 0, 0)
        colors[:, 1, 2] = 255
        image = self.write('old.png', image_bytes(colors))
        self.run_ok('bake', self.old, '--from', self.old, '--image', image, '-o', self.path('a.png'),
                    '--filter', 'nearest')
        np.testing.assert_array_equal(self.array('a.png'), colors)
        self.run_ok('bake', self.new, '--from', self.old, '--image', image, '-o', self.path('b.png'), '--size', '64',
                    '--filter', 'nearest')
        found = self.array('b.png')  # turned left by 90 degrees: what was up is left, what was right is up
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
        """Of the materials of an OBJ: each face has the colour of its image."""
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
        self.run_ok('bake', flat, '--from', flat, '--attribute', 'distortion', '--size', '8', '-o', self.path('d.npy'))
        np.testing.assert_allclose(np.load(self.path('d.npy')), 1, atol=1e-5)

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

    def test_what_is_no_layout(self):
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
        self.assertIn('two places', outcome.said()[-1])
        self.assertFalse(os.path.exists(out))

    def test_usage(self):
        out, args = self.path('out.png'), ['bake', self.old, '--from', self.old]
        self.refused(USAGE, 'bake', self.old, '--from', self.path('none.vtu'), '-o', out, says='--image')
        self.refused(UNSUPPORTED, *args, '-o', out, says='map_Kd')  # has none itself
        self.refused(USAGE, *args, '--attribute', 'position', '-o', out, says='.npy')
        none = ['bake', self.path('none.obj'), '--from', self.path('none.obj'), '-o', out, '--attribute']
        for wrong, right in (('normals', 'normal'), ('Position', 'position'), ('faces', 'face')):  # before any reading
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


class Unwrap(CommandTest):
    """unwrap --bake: the same colours at the same faces, by the new texture coordinates in the new image."""

    def colors(self, obj, image):
        """Of the centres of the faces."""
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
        self.refused(USAGE, 'unwrap', self.model(), '-o', out, '-o', self.path('two.obj'), '--bake', says='one model')
        self.refused(UNSUPPORTED, 'unwrap', self.model('newmtl a\nmap_Kd -s 2 2 2 old.png\n'), '-o', out, '--bake',
                     says='-s')
        path = self.model()
        os.remove(self.path('old.png'))
        self.refused(UNREADABLE, 'unwrap', path, '-o', out, '--bake', says='old.png')
        self.assertFalse(os.path.exists(out))


if __name__ == '__main__':
    helpers.main()
