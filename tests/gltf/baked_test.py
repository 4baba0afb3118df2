# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""unwrap --bake of glTF: the same base colours at the same triangles, by TEXCOORD_0 and one image; all other textures
are unchanged. bake --from a GLB: the model's own textures."""
import io

import numpy as np
from PIL import Image

from gltf_helpers import *

SIDE = 256


def gradient(swap=False):
    x, y = np.meshgrid(np.arange(SIDE), np.arange(SIDE))
    red, green = (y, x) if swap else (x, y)
    return np.stack([red, green, 255 - (x + y) // 2], -1).astype(np.uint8)


def encoded(array, kind='png'):
    out = io.BytesIO()
    Image.fromarray(array).save(out, kind, **({'quality': 98, 'subsampling': 0} if kind == 'jpeg' else {}))
    return out.getvalue()


def textured(images, others=None, shape=None):
    """A mesh with a primitive for each image (an entry of `images`, or None), its base colour. others: more keys of
    the materials, by primitive."""
    model = Model()
    primitives = []
    for k, image in enumerate(images):
        rows, faces = shape or ball(5)
        attributes = {'POSITION': model.accessor([[p[0] + 3 * k, p[1], p[2]] for p, _, _ in rows], bounds=True),
                      'NORMAL': model.accessor([n for _, n, _ in rows]),
                      'TEXCOORD_0': model.accessor([t for _, _, t in rows])}
        material = {'name': 'm%d' % k, **((others or {}).get(k, {}))}
        if image is not None:
            source = model.add('images', image(model) if callable(image) else image)
            texture = model.add('textures', {'source': source})
            material['pbrMetallicRoughness'] = {'baseColorTexture': {'index': texture}}
        primitives.append({'attributes': attributes, 'material': model.add('materials', material),
                           'indices': model.accessor([[v] for f in faces for v in f], USHORT, INDICES)})
    mesh = model.add('meshes', {'primitives': primitives})
    model.add('scenes', {'nodes': [model.add('nodes', {'mesh': mesh})]})
    model.json['scene'] = 0
    return model


def embedded(array, kind='png'):
    return lambda model: {'bufferView': model.view(encoded(array, kind)), 'mimeType': 'image/' + kind}


def as_data(array):
    return {'uri': 'data:image/png;base64,' + base64.b64encode(encoded(array)).decode()}


class Baked(CommandTest):
    def reader(self, name):
        return Reader(self.read(name))

    def image_of(self, reader, material):
        """Pixels of a base colour, and the set of coordinates."""
        reference = material['pbrMetallicRoughness']['baseColorTexture']
        image = reader.json['images'][reader.json['textures'][reference['index']]['source']]
        if 'bufferView' in image:
            content = bytes(reader.view(image['bufferView'])[0])
        elif image['uri'].startswith('data:'):
            content = base64.b64decode(image['uri'].split(',', 1)[1])
        else:
            content = self.read(image['uri'])
        return np.asarray(Image.open(io.BytesIO(content)).convert('RGB')).astype(float), reference.get('texCoord', 0)

    def colors(self, reader, p):
        """Returns the colours at the centres of the triangles of a primitive."""
        primitive = reader.primitive(0, p)
        pixels, number = self.image_of(reader, reader.json['materials'][primitive['material']])
        uv = np.array(reader.attribute(0, p, 'TEXCOORD_%d' % number))[np.array(reader.triangles(0, p))].mean(1)
        height, width = pixels.shape[:2]
        return pixels[np.clip((uv[:, 1] * height).astype(int), 0, height - 1),
                      np.clip((uv[:, 0] * width).astype(int), 0, width - 1)]

    def bake(self, model, out='out.glb', **method):
        source = self.write('in.glb', model.glb())
        self.run_ok('unwrap', source, '-o', self.path(out), '--bake', '--resolution', SIDE, **method)
        self.run_ok('check', self.path(out), '--surface', source, '--certify')
        return self.reader('in.glb'), self.reader(out)

    def test_images_wherever_they_are_become_one(self):
        self.write('beside.png', encoded(gradient()))
        os.mkdir(self.path('other'))
        for out in ('out.glb', 'other/out.gltf'):
            old, new = self.bake(textured([embedded(gradient()), embedded(gradient(True), 'jpeg'), as_data(gradient(True)),
                                           {'uri': 'beside.png'}, None]), out)
            self.assertEqual([len(new.json[name]) for name in ('images', 'textures')], [1, 1])
            self.assertEqual(new.json['images'][0]['mimeType'], 'image/png')
            self.assertEqual([m['name'] for m in new.json['materials']], ['m0', 'm1', 'm2', 'm3', 'm4'])
            self.assertNotIn('pbrMetallicRoughness', new.json['materials'][4])
            for p in range(4):
                difference = np.abs(self.colors(old, p) - self.colors(new, p))
                self.assertLess(difference.max(), 16)
                self.assertLess(difference.mean(), 4)
                self.assertNotIn('TEXCOORD_1', new.primitive(0, p)['attributes'])
        for issues in validated([self.path('out.glb')], self.path('.')):
            self.assertEqual([i for i in issues if i['severity'] < 2], [])

    def test_other_textures_keep_the_old_coordinates(self):
        others = {0: {'normalTexture': {'index': 0}}, 1: {'emissiveTexture': {'index': 1}}}
        old, new = self.bake(textured([embedded(gradient()), embedded(gradient(True))], others))
        for p, key in enumerate(('normalTexture', 'emissiveTexture')):
            material = new.json['materials'][new.primitive(0, p)['material']]
            self.assertEqual(material[key]['texCoord'], 1)
            self.assertNotIn('texCoord', material['pbrMetallicRoughness']['baseColorTexture'])
            self.assertEqual(len(new.attribute(0, p, 'TEXCOORD_1')), len(new.attribute(0, p, 'TEXCOORD_0')))
            self.assertLess(np.abs(self.colors(old, p) - self.colors(new, p)).mean(), 4)
        self.assertEqual(len(new.json['images']), 3)

    def test_images_beyond_their_square(self):
        """Texture coordinates from -1 to 2, repeated, clamped or mirrored, separately in each direction."""
        n, x = 12, np.arange(SIDE)
        rows = [((i / n, j / n, 0), (0, 0, 1), (3 * i / n - 1, 3 * j / n - 1)) for j in range(n + 1) for i in range(n + 1)]
        faces = [f for j in range(n) for i in range(n) for a in [j * (n + 1) + i]
                 for f in ((a, a + 1, a + n + 2), (a, a + n + 2, a + n + 1))]
        shown = {33071: lambda t: np.clip(t, 0, 1), 33648: lambda t: 1 - np.abs(t % 2 - 1), 10497: lambda t: t % 1}
        ramp = np.stack([np.broadcast_to(x, (SIDE, SIDE)), np.broadcast_to(x[:, None], (SIDE, SIDE)), 0 * gradient()[..., 0]],
                        -1).astype(np.uint8)
        t = 3 * (np.arange(SIDE) + 0.5) / SIDE - 1
        smooth = np.abs(t - np.round(t)) > 0.03
        new = self.write('new.obj', ''.join('v %g %g 0\nvt %g %g\n' % (u, 1 - v, u, v)
                                            for u, v in ((0, 1), (1, 1), (1, 0), (0, 0))) + 'f 4/4 3/3 2/2 1/1\n')
        for u_wrap, v_wrap in ((33071, 33648), (33648, 10497), (10497, 33071)):
            model = textured([embedded(ramp)], shape=(rows, faces))
            model.add('samplers', {'wrapS': u_wrap, 'wrapT': v_wrap})
            model.json['textures'][0]['sampler'] = 0
            source = self.write('in.glb', model.glb())
            self.run_ok('bake', new, '--from', source, '-o', self.path('o.png'), '--size', SIDE, '--force')
            found = np.asarray(Image.open(self.path('o.png'))).astype(float)
            for channel, wrap, axis in ((0, u_wrap, 1), (1, v_wrap, 0)):
                row = found[SIDE // 2, :, channel] if axis else found[:, SIDE // 2, channel]
                self.assertLess(np.abs(row - np.clip(SIDE * shown[wrap](t) - 0.5, 0, 255))[smooth].max(), 3)
            old, out = self.bake(model)
            for p in (0,):
                colors = self.colors(out, p)
                uv = np.array(old.attribute(0, p, 'TEXCOORD_0'))[np.array(old.triangles(0, p))].mean(1)
                right = np.stack([SIDE * shown[w](uv[:, k]) - 0.5 for k, w in enumerate((u_wrap, v_wrap))], -1)
                self.assertLess(np.median(np.abs(colors[:, :2] - np.clip(right, 0, 255))), 4)

    def test_from_an_obj(self):
        """The GLB has the texture by the new coordinates, and so have the image files of an OBJ."""
        n, text = 6, 'mtllib m.mtl\nusemtl a\n'
        for j in range(n + 1):
            for i in range(n + 1):
                text += 'v %g %g %g\nvt %g %g\n' % (i, j, 0.1 * i * j, i / n, j / n)
        for j in range(n):
            for i in range(n):
                a = j * (n + 1) + i + 1
                text += 'f ' + ' '.join('%d/%d' % (v, v) for v in (a, a + 1, a + n + 2, a + n + 1)) + '\n'
        source = self.write('in.obj', text)
        self.write('m.mtl', 'newmtl a\nmap_Kd t.png\n')
        self.write('t.png', encoded(gradient()))
        self.run_ok('unwrap', source, '-o', self.path('out.glb'), '-o', self.path('out.obj'), '--bake')
        self.assertEqual(sorted(f for f in self.files() if f.startswith('out')),
                         ['out.glb', 'out.mtl', 'out.obj', 'out.png'])
        self.run_ok('check', self.path('out.glb'), '--surface', source, '--certify')
        reader = self.reader('out.glb')
        self.assertEqual(reader.json['materials'][0]['name'], 'a')
        self.assertNotIn('TEXCOORD_1', reader.primitive(0, 0)['attributes'])
        self.assertEqual(len(reader.json['images']), 1)
        place = np.array(reader.attribute(0, 0, 'POSITION'))[np.array(reader.triangles(0, 0))].mean(1)
        u, v = place[:, 0] / n, place[:, 1] / n
        right = np.stack([SIDE * u, SIDE * (1 - v), 255 - SIDE * (u + 1 - v) / 2], -1)
        self.assertLess(np.abs(self.colors(reader, 0) - right).max(), 5)
        self.assertEqual([i for i in validated([self.path('out.glb')], self.path('.'))[0] if i['severity'] < 2], [])

    def test_the_size_of_the_image(self):
        """--resolution, or that of a preset; otherwise the sum of the pixels of all images."""
        source = self.write('in.glb', textured([embedded(gradient()), embedded(gradient(True)), None]).glb())
        for flags, side in (([], 363), (['--resolution', 100], 100), (['--preset', 'game'], 2048)):
            self.run_ok('unwrap', source, '-o', self.path('out.glb'), '--bake', *flags)
            reader = self.reader('out.glb')
            pixels, _ = self.image_of(reader, reader.json['materials'][0])
            self.assertEqual(pixels.shape[:2], (side, side))

    def test_random_files(self):
        baked = []
        for seed in range(40):
            source = self.write('%d.glb' % seed, random_model(seed).glb())
            out = self.path('%d_out.glb' % seed)
            run = majorant('unwrap', source, '-o', out, '--bake')
            self.assertIn(run.code, (OK, UNSUPPORTED), run.err)
            if run.code == OK:
                self.run_ok('check', out, '--surface', source)
                baked.append(out)
        self.assertGreater(len(baked), 10)
        for path, issues in zip(baked, validated(baked, self.path('.'))):
            self.assertEqual([i for i in issues if i['severity'] < 2], [], path)

    def test_bake_from_a_model(self):
        """A model's texture baked onto the model is unchanged inside the triangles."""
        source = self.write('in.glb', textured([embedded(gradient())], shape=patch(4, random.Random(1))).glb())
        self.run_ok('bake', source, '--from', source, '-o', self.path('out.png'))
        pixels = np.asarray(Image.open(self.path('out.png')))
        self.assertLess(np.abs(pixels[2:-2, 2:-2].astype(int) - gradient()[2:-2, 2:-2]).max(), 2)

    def test_a_limit_that_comes_before_the_texture(self):
        source = self.write('in.glb', textured([embedded(gradient())]).glb())
        for before in (None, b'as it was'):
            if before:
                self.write('out.glb', before)
            run = majorant('unwrap', source, '-o', self.path('out.glb'), '--bake', '--time-limit', 0, '--force')
            self.assertEqual(run.code, INVALID, run.err)
            self.assertIn('while baking', run.err)
            self.assertEqual(self.read('out.glb') if os.path.exists(self.path('out.glb')) else None, before)
        self.assertEqual(sorted(self.files()), ['in.glb', 'out.glb'])

    def test_refusals(self):
        out = self.path('out.glb')

        def refuse(code, model, says):
            source = self.write('in.glb', model.glb())
            self.refused(code, 'unwrap', source, '-o', out, '--bake', says=says)
            self.assertFalse(os.path.exists(out))
        refuse(UNSUPPORTED, textured([None]), 'has no texture to bake')
        moved = textured([embedded(gradient())])
        reference = moved.json['materials'][0]['pbrMetallicRoughness']['baseColorTexture']
        reference['extensions'] = {'KHR_texture_transform': {'scale': [2, 2]}}
        refuse(UNSUPPORTED, moved, 'KHR_texture_transform')
        del reference['extensions']
        reference['texCoord'] = 1
        refuse(UNSUPPORTED, moved, 'TEXCOORD_0')
        refuse(UNREADABLE, textured([{'uri': 'nowhere.png'}]), 'nowhere.png')
        refuse(UNREADABLE, textured([lambda model: {'bufferView': model.view(encoded(gradient())[:500])}]), 'image 0')
        refuse(UNREADABLE, textured([lambda model: {'bufferView': model.view(b'GIF89a' + bytes(50))}]), 'PNG')
        refuse(UNSUPPORTED, textured([lambda model: {'bufferView': model.view(b'RIFF    WEBP' + bytes(50))}]), 'WebP')
        source = self.write('in.glb', textured([embedded(gradient())]).glb())
        self.refused(USAGE, 'unwrap', source, '-o', self.path('out.obj'), '--bake', says='OUT.glb')
        self.refused(USAGE, 'unwrap', source, '-o', out, '-o', self.path('out.gltf'), '--bake', says='one OBJ and one glTF model')
        self.refused(USAGE, 'bake', source, '--from', self.write('a.stl', b'solid\n'), '-o', self.path('a.png'),
                     says='--image')


if __name__ == '__main__':
    unittest.main()
