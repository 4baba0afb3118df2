# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""glTF through the command: new coordinates are TEXCOORD_0 and everything else is unchanged, by an independent reader
and by Khronos' validator."""
from gltf_helpers import *

COUNT = 60
SETS = ('TEXCOORD_1', 'TEXCOORD_2', 'TEXCOORD_3')


def corners(reader, mesh, p, attributes):
    """Returns the values of these attributes by triangle and corner, in the order of the file."""
    rows = {name: reader.rows(accessor, raw=True) for name, accessor in attributes.items()}
    return [[{name: rows[name][v] for name in rows} for v in face] for face in reader.triangles(mesh, p)]


def target_corners(reader, mesh, p):
    return [corners(reader, mesh, p, target) for target in reader.primitive(mesh, p).get('targets', [])]


def area(uv):
    (a, b), (c, d), (e, f) = uv
    return (c - a) * (f - b) - (e - a) * (d - b)


def textures(material):
    """Returns key and texture coordinate set of each texture of a material; a texture transform may replace the set."""
    found = []

    def visit(value, path):
        if isinstance(value, dict):
            for key, member in value.items():
                if key == 'extras':
                    continue
                if isinstance(member, dict) and 'index' in member:
                    transform = member.get('extensions', {}).get('KHR_texture_transform', {})
                    found.append((path + key, transform.get('texCoord', member.get('texCoord', 0))))
                visit(member, path + key + '/')
    visit(material, '')
    return sorted(found)


class Written(CommandTest):
    @classmethod
    def setUpClass(cls):
        cls.home = tempfile.mkdtemp(prefix='majorant_gltf_')
        cls.addClassCleanup(shutil.rmtree, cls.home)
        cls.names = []
        for k in range(COUNT):
            content = random_model(k).glb()
            before, after = (os.path.join(cls.home, '%d_%s.glb' % (k, s)) for s in ('in', 'out'))
            with open(before, 'wb') as f:
                f.write(content)
            run = majorant('unwrap', before, '-o', after)
            cls.names.append((before, after, run))

    def pairs(self):
        for k, (before, after, run) in enumerate(self.names):
            with self.subTest(k):
                self.assertEqual(run.code, OK, run.err)
                with open(before, 'rb') as f, open(after, 'rb') as g:
                    yield Reader(f.read()), Reader(g.read())

    def primitives(self):
        for old, new in self.pairs():
            self.assertEqual(len(old.json['meshes']), len(new.json['meshes']))
            for m, mesh in enumerate(old.json['meshes']):
                self.assertEqual(len(mesh['primitives']), len(new.json['meshes'][m]['primitives']))
                for p in range(len(mesh['primitives'])):
                    yield old, new, m, p

    def test_files_are_valid_and_maps_of_their_surface(self):
        for before, after, run in self.names:
            with self.subTest(before):
                self.assertEqual(run.code, OK, run.err)
                self.run_ok('check', after, '--surface', before, '--certify')

    def test_coordinates_are_positive_where_v_points_downwards(self):
        turned = 0
        for old, new, m, p in self.primitives():
            if old.primitive(m, p).get('mode', TRIANGLES) < TRIANGLES:
                continue
            mirrored = self.is_mirrored(old, m)
            uv = new.attribute(m, p, 'TEXCOORD_0')
            for face in new.triangles(m, p):
                a = area([uv[v] for v in face])
                self.assertNotEqual(a, 0)
                self.assertEqual(a > 0, mirrored)
                turned += mirrored
        self.assertGreater(turned, 0)

    @staticmethod
    def is_mirrored(reader, mesh):
        """Returns True if the first node of the scene that uses the mesh is a reflection."""
        def sign(node):
            return -1 if node.get('scale', [1])[0] < 0 else 1

        def visit(k, s):
            node = reader.json['nodes'][k]
            s *= sign(node)
            if node.get('mesh') == mesh:
                return s if 'skin' not in node else 1
            return next((t for t in (visit(c, s) for c in node.get('children', [])) if t), None)
        return next(s for s in (visit(k, 1) for k in reader.json['scenes'][0]['nodes']) if s) < 0

    def test_attributes_are_kept(self):
        moved = tangents = 0
        for old, new, m, p in self.primitives():
            names = dict(old.primitive(m, p)['attributes'])
            now = dict(new.primitive(m, p)['attributes'])
            is_surface = old.primitive(m, p).get('mode', TRIANGLES) >= TRIANGLES
            sets = [s for s in SETS if s in now and s not in names]
            if sets:  # the old first set
                moved += 1
                self.assertEqual(sets, ['TEXCOORD_%d' % sum(s.startswith('TEXCOORD') for s in names)])
                now['TEXCOORD_0'] = now.pop(sets[0])
            elif is_surface:
                names.pop('TEXCOORD_0', None)
                now.pop('TEXCOORD_0')
            tangents += is_surface and 'TANGENT' in names
            self.assertEqual(sorted(names), sorted(now))
            if not is_surface:
                for name in names:
                    self.assertEqual(old.rows(names[name], raw=True), new.rows(now[name], raw=True))
                continue
            self.assertEqual(corners(old, m, p, names), corners(new, m, p, now))
            self.assertEqual(target_corners(old, m, p), target_corners(new, m, p))
        self.assertGreater(moved, 10)
        self.assertGreater(tangents, 3)

    def test_textures_are_shown_as_before(self):
        """Compares the values of the coordinates that each texture of a primitive uses."""
        for old, new, m, p in self.primitives():
            before, after = old.primitive(m, p), new.primitive(m, p)
            pairs = [(before, after)]
            for key in ('extensions',):
                variants = [x.get(key, {}).get('KHR_materials_variants', {}).get('mappings', [])
                            for x in (before, after)]
                pairs += list(zip(*variants))
            for a, b in pairs:
                if 'material' not in a:
                    continue
                shown = [textures(reader.json['materials'][x['material']]) for reader, x in ((old, a), (new, b))]
                self.assertEqual([key for key, _ in shown[0]], [key for key, _ in shown[1]])
                for (_, s), (_, t) in zip(*shown):
                    if 'TEXCOORD_%d' % s not in before['attributes']:
                        continue
                    if before.get('mode', TRIANGLES) < TRIANGLES:
                        rows = [r.rows(x['attributes']['TEXCOORD_%d' % k], raw=True)
                                for r, x, k in ((old, before, s), (new, after, t))]
                        self.assertEqual(*rows)
                        continue
                    uv = [corners(r, m, p, {'uv': x['attributes']['TEXCOORD_%d' % k]})
                          for r, x, k in ((old, before, s), (new, after, t))]
                    self.assertEqual(*uv)

    def test_everything_else_is_kept(self):
        for old, new in self.pairs():
            for key in old.json:
                if key in ('accessors', 'bufferViews', 'buffers', 'meshes', 'materials', 'images', 'skins',
                           'animations'):
                    continue
                before = old.json[key]
                if key == 'asset' and 'generator' not in before:
                    before = dict(before, generator=new.json[key].get('generator', ''))  # ours: the mark
                    self.assertTrue(before['generator'].startswith('majorant '))
                self.assertEqual(before, new.json[key], key)
            for mesh, now in zip(old.json['meshes'], new.json['meshes']):
                for key in mesh:
                    if key != 'primitives':
                        self.assertEqual(mesh[key], now[key])
                for p, q in zip(mesh['primitives'], now['primitives']):
                    self.assertEqual(p.get('extras'), q.get('extras'))
            for image, now in zip(old.json.get('images', []), new.json.get('images', [])):
                self.assertEqual(old.view(image['bufferView']), new.view(now['bufferView']))
            for skin, now in zip(old.json.get('skins', []), new.json.get('skins', [])):
                self.assertEqual(skin['joints'], now['joints'])
                self.assertEqual(*[r.rows(s['inverseBindMatrices']) for r, s in ((old, skin), (new, now))])
            for before, now in zip(old.json.get('animations', []), new.json.get('animations', [])):
                self.assertEqual(before['channels'], now['channels'])
                for s, t in zip(before['samplers'], now['samplers']):
                    for end in ('input', 'output'):
                        self.assertEqual(old.rows(s[end]), new.rows(t[end]))

    def test_the_validator_finds_nothing_new(self):
        """Except that no material uses the new coordinates."""
        files = [name for before, after, _ in self.names for name in (before, after)]
        printed = validated(files, self.home)
        for k in range(COUNT):
            with self.subTest(k):
                old, new = ([m['code'] for m in messages if not self.is_of_new_set(m)]
                            for messages in (printed[2 * k], printed[2 * k + 1]))
                self.assertEqual([c for c in set(new) if new.count(c) > old.count(c)], [])

    @staticmethod
    def is_of_new_set(message):
        return message['code'] == 'UNUSED_OBJECT' and '/attributes/TEXCOORD_' in message['pointer']


class Details(CommandTest):
    def model(self, seed=3):
        return random_model(seed)

    def test_text_with_a_buffer_in_it_or_beside_it(self):
        model = self.model()
        self.write('a.gltf', model.gltf())
        os.mkdir(self.path('below'))
        self.write('b.gltf', model.gltf('below/a%20b.bin'))
        self.write('below/a b.bin', bytes(model.binary))
        self.write('c.glb', model.glb())
        outputs = []
        for name in ('a.gltf', 'b.gltf', 'c.glb'):
            self.run_ok('unwrap', self.path(name), '-o', self.path('out.glb'), '-o', self.path('out.gltf'))
            outputs.append((self.read('out.glb'), self.read('out.gltf')))
        self.assertEqual(outputs[0], outputs[1])
        self.assertEqual(outputs[0], outputs[2])
        self.run_ok('check', self.path('out.gltf'), '--surface', self.path('a.gltf'), '--certify')

    def test_images_go_along_into_other_folders(self):
        model = Model()
        rows, faces = box()
        model.add('images', {'uri': 'a.png'})
        model.add('meshes', {'primitives': [{'attributes': {
            'POSITION': model.accessor([r[0] for r in rows], bounds=True)},
            'indices': model.accessor([[v] for f in faces for v in f], USHORT, INDICES)}]})
        self.write('a.png', png())
        self.write('in.glb', model.glb())
        os.mkdir(self.path('out'))
        self.run_ok('unwrap', self.path('in.glb'), '-o', self.path('same.glb'), '-o', self.path('out/other.glb'))
        self.assertEqual(Reader(self.read('same.glb')).json['images'], [{'uri': 'a.png'}])
        other = Reader(self.read('out/other.glb'))
        image, = other.json['images']
        self.assertEqual(image['mimeType'], 'image/png')
        self.assertEqual(bytes(other.view(image['bufferView'])[0]), png())

    def test_other_formats_become_one_mesh(self):
        for mesh in (generated('creature'), generated('helix')):
            self.run_ok('unwrap', mesh, '-o', self.path('a.glb'), '-o', self.path('a.obj'))
            self.run_ok('check', self.path('a.glb'), '--surface', mesh, '--certify')
            reader = Reader(self.read('a.glb'))
            self.assertEqual([len(m['primitives']) for m in reader.json['meshes']], [1])

    def test_quads_colours_and_normals_of_an_obj(self):
        text = ''
        for k, (x, y) in enumerate([(0, 0), (1, 0), (2, 0), (0, 1), (1, 1), (2, 1), (5, 5)]):
            text += 'v %d %d %g 0.%d 0 1\n' % (x, y, 0.3 * x * y, k)
        text += 'vn 0 0 1\nf 1//1 2//1 5//1 4//1\nf 2//1 3//1 6//1 5//1\n'
        mesh = self.write('a.obj', text)
        self.run_ok('unwrap', mesh, '-o', self.path('a.glb'))
        self.run_ok('check', self.path('a.glb'), '--surface', mesh)
        reader = Reader(self.read('a.glb'))
        self.assertEqual(len(reader.triangles(0, 0)), 4)
        self.assertEqual(set(reader.attribute(0, 0, 'NORMAL')), {(0, 0, 1)})
        numbers = [a + 65536 * b for a, b in reader.attribute(0, 0, '_INPUT_VERTEX')]
        self.assertEqual(numbers, list(range(7)))
        light = [x / 12.92 if x <= 0.04045 else ((x + 0.055) / 1.055) ** 2.4 for x in (k / 10 for k in range(7))]
        for color, right in zip(reader.attribute(0, 0, 'COLOR_0'), light):  # codes of sRGB in an OBJ, light in glTF
            self.assertAlmostEqual(color[0], right, places=6)
        self.assertEqual([m for m in validated([self.path('a.glb')], self.folder)[0] if m['severity'] < 2], [])

    def test_the_set_that_the_layout_becomes(self):
        """Materials, textures and the first set stay as they are; check and the next run read the second one."""
        for seed in range(12):
            with self.subTest(seed):
                source = self.write('in.glb', random_model(seed).glb())
                for flags in (['--uv-set', 1], ['--preset', 'lightmap']):
                    self.run_ok('unwrap', source, '-o', self.path('out.glb'), *flags)
                    self.run_ok('check', self.path('out.glb'), '--surface', source)
                    old, new = Reader(self.read('in.glb')), Reader(self.read('out.glb'))
                    for m, mesh in enumerate(old.json['meshes']):
                        for p, primitive in enumerate(mesh['primitives']):
                            now = new.primitive(m, p)
                            if primitive.get('mode', TRIANGLES) < TRIANGLES:
                                continue
                            before = {name: k for name, k in primitive['attributes'].items()
                                      if name != 'TEXCOORD_1'}
                            after = {name: now['attributes'][name] for name in before}
                            self.assertEqual(corners(old, m, p, before), corners(new, m, p, after))
                            self.assertIn('TEXCOORD_0', now['attributes'])
                            for face in new.triangles(m, p):
                                uv = [new.attribute(m, p, 'TEXCOORD_1')[v] for v in face]
                                self.assertTrue(all(0 <= x <= 1 for place in uv for x in place))
                found = [m for m in validated([self.path('out.glb')], self.folder)[0] if m['severity'] < 2]
                self.assertEqual([m for m in found if 'TEXCOORD' in m['pointer']], [])
        self.run_ok('unwrap', self.path('out.glb'), '-o', self.path('again.glb'))
        self.assertNotIn('majorant_uv_set', Reader(self.read('again.glb')).json['asset'].get('extras', {}))
        self.refused(USAGE, 'unwrap', source, '-o', self.path('o.obj'), '--uv-set', 1, says='--uv-set')
        self.refused(USAGE, 'unwrap', source, '-o', self.path('o.glb'), '--uv-set', 1, '--bake', says='--bake')

    def test_materials_of_an_obj(self):
        """Materials in another order use the old coordinates, or the new ones where these are equal."""
        text = 'mtllib m.mtl\n' + ''.join('v %d %d %g\nvt %g %g\n' % (i, j, 0.2 * i * j, i / 6, j / 6)
                                          for j in range(3) for i in range(4))
        names = ('plain', 'wood', 'nowhere', 'wood', 'plain', 'wood')
        for f, name in enumerate(names):
            a = f + f // 3 + 1
            text += 'usemtl %s\nf ' % name + ' '.join('%d/%d' % (v, v) for v in (a, a + 1, a + 5, a + 4)) + '\n'
        mesh = self.write('a.obj', text)
        self.write('m.mtl', 'newmtl wood\nKd 0.5 0.5 0.5\nmap_Kd -clamp on w.png\nmap_Ks s.png\n'
                            'newmtl plain\nKd 1 0.5 0\nd 0.25\n')
        self.write('w.png', png())
        for verb, set_ in (('unwrap', 1), ('convert', 0)):
            done = self.run_ok(verb, mesh, '-o', self.path(verb + '.glb'))
            self.assertIn("map_Ks of material 'wood'", done.err)
            self.assertIn("'nowhere'", done.err)
            self.run_ok('check', self.path(verb + '.glb'), '--surface', mesh)
            reader = Reader(self.read(verb + '.glb'))
            self.assertEqual([m['name'] for m in reader.json['materials']], ['plain', 'wood', 'nowhere'])
            plain, wood, nowhere = reader.json['materials']
            factor = plain['pbrMetallicRoughness']['baseColorFactor']
            for x, right in zip(factor, (1, 0.2140411, 0, 0.25)):
                self.assertAlmostEqual(x, right, places=6)
            self.assertEqual(plain['alphaMode'], 'BLEND')
            self.assertEqual(wood['pbrMetallicRoughness']['baseColorTexture'].get('texCoord', 0), set_)
            self.assertEqual(bytes(reader.view(reader.json['images'][0]['bufferView'])[0]), png())
            self.assertEqual(reader.json['samplers'], [{'wrapS': 33071, 'wrapT': 33071}])
            places = {name: set() for name in names}
            for p, primitive in enumerate(reader.json['meshes'][0]['primitives']):
                positions = reader.attribute(0, p, 'POSITION')
                uv = reader.attribute(0, p, 'TEXCOORD_%d' % set_)
                for face in reader.triangles(0, p):
                    x, y = (sum(positions[v][k] for v in face) / 3 for k in (0, 1))
                    places[reader.json['materials'][primitive['material']]['name']].add((int(x), int(y)))
                    for v in face:
                        self.assertAlmostEqual(uv[v][0], positions[v][0] / 6, places=6)
                        self.assertAlmostEqual(1 - uv[v][1], positions[v][1] / 6, places=6)
            for name in places:
                self.assertEqual(places[name], {(f % 3, f // 3) for f in range(6) if names[f] == name})
            self.assertEqual([m for m in validated([self.path(verb + '.glb')], self.folder)[0] if m['severity'] < 2], [])
        os.remove(self.path('w.png'))
        done = self.run_ok('unwrap', mesh, '-o', self.path('unwrap.glb'))
        self.assertIn("the image of material 'wood'", done.err)

    def converted(self, corners, code):
        """Converts a square with a triangle of size 1e-9 in its middle to an OBJ and a GLB."""
        faces = [(4, 5, 6), (0, 1, 5), (0, 5, 4), (1, 2, 5), (2, 6, 5), (2, 3, 6), (3, 0, 4), (3, 4, 6)]
        mesh = self.write('a.obj', obj_text([(x, y, 0) for x, y in corners], faces, corners))
        self.run_ok('check', mesh)
        return self.run_ok('convert', mesh, '-o', self.path('b.obj'), '-o', self.path('b.glb'), code=code)

    def test_triangles_inverted_by_rounding_get_room(self):
        e = 1e-9
        self.converted([(0, 0), (1, 0), (1, 1), (0, 1), (0.3, 0.3), (0.3 + e, 0.3), (0.3, 0.3 + e)], OK)
        self.run_ok('check', self.path('b.glb'), '--surface', self.path('b.obj'))

    def test_maps_inverted_in_floats_are_not_written(self):
        """Far from the origin the spacing of floats exceeds the width of the square."""
        far, e = 2 ** 20, 2 ** -8
        square = [(0, 0), (4, 0), (4, 4), (0, 4), (1, 1), (2, 1), (1, 2)]
        outcome = self.converted([(far + e * x, far + e * y) for x, y in square], INVALID)
        self.assertIn('b.glb is not written, since what it says would not be valid', outcome.err)
        self.assertEqual(self.files(), ['a.obj', 'b.obj'])

    def test_curves_become_straight_pieces(self):
        for seed in (0, 4, 9):
            with self.subTest(seed):
                self.write('in.glb', random_model(seed).glb())
                self.run_ok('unwrap', self.path('in.glb'), '-o', self.path('out.glb'), '--degree', 2,
                            '--refine', 2)
                self.run_ok('check', self.path('out.glb'), '--surface', self.path('in.glb'), '--certify')
                old, new = (Reader(self.read(name)) for name in ('in.glb', 'out.glb'))
                for m, mesh in enumerate(old.json['meshes']):
                    for p, primitive in enumerate(mesh['primitives']):
                        if primitive.get('mode', TRIANGLES) >= TRIANGLES:
                            self.assertEqual(len(new.triangles(m, p)), 4 * len(old.triangles(m, p)))
                bad = [m for m in validated([self.path('out.glb')], self.folder)[0] if m['severity'] < 2]
                self.assertEqual(bad, [])

    def test_tangents_stay_with_the_normal_texture(self):
        """A clear coat's normal texture has one set of coordinates only; also on copies and between corners."""
        model = Model()
        rows, faces = ball(5)
        accessors = {'POSITION': model.accessor([r[0] for r in rows], bounds=True),
                     'NORMAL': model.accessor([r[1] for r in rows]),
                     'TANGENT': model.accessor([[*tangent(r[1])[:3], -1] for r in rows]),
                     'TEXCOORD_0': model.accessor([r[2] for r in rows])}
        model.add('images', {'bufferView': model.view(png()), 'mimeType': 'image/png'})
        model.add('textures', {'source': 0})
        model.add('materials', {'extensions': {'KHR_materials_clearcoat': {
            'clearcoatFactor': 1, 'clearcoatNormalTexture': {'index': 0}}}})
        model.json['extensionsUsed'] = ['KHR_materials_clearcoat']
        model.add('meshes', {'primitives': [{'attributes': accessors, 'material': 0, 'indices': model.accessor(
            [[v] for f in faces for v in f], USHORT, INDICES)}]})
        model.add('scenes', {'nodes': [model.add('nodes', {'mesh': 0})]})
        self.write('in.glb', model.glb())
        for flags in ([], ['--degree', 2, '--refine', 2]):
            run = self.run_ok('unwrap', self.path('in.glb'), '-o', self.path('out.glb'), *flags)
            self.assertNotIn('tangents', run.err)
            old, new = (Reader(self.read(name)) for name in ('in.glb', 'out.glb'))
            found = new.attribute(0, 0, 'TANGENT')
            self.assertGreater(len(found), len(rows))
            self.assertEqual(found[:len(rows)], old.attribute(0, 0, 'TANGENT'))
            for x, y, z, side in found:
                self.assertAlmostEqual(x * x + y * y + z * z, 1, places=5)
                self.assertEqual(side, -1)
            self.assertEqual(textures(new.json['materials'][0])[0][1], 1)
            printed = [m for m in validated([self.path('out.glb')], self.folder)[0] if m['severity'] < 2]
            self.assertEqual(printed, [])

    def test_vertices_that_a_morph_target_separates_stay_separate(self):
        """Two squares that touch along an edge, which a morph target opens."""
        for opens in (0.0, 0.5):
            model = Model()
            places = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (1, 0, 0), (2, 0, 0), (2, 1, 0), (1, 1, 0)]
            moves = [(0, 0, 0)] * 4 + [(opens, 0, 0)] * 4
            model.add('meshes', {'primitives': [{
                'attributes': {'POSITION': model.accessor(places, bounds=True)},
                'targets': [{'POSITION': model.accessor(moves, bounds=True)}],
                'indices': model.accessor([[v] for f in ((0, 1, 2), (0, 2, 3), (4, 5, 6), (4, 6, 7)) for v in f],
                                          USHORT, INDICES)}]})
            self.write('a.glb', model.glb())
            self.run_ok('unwrap', self.path('a.glb'), '-o', self.path('b.glb'), '--report', self.path('r.json'),
                        '--weld', 'no')
            report = json.loads(self.read('r.json'))
            self.assertEqual(report['result']['charts'], 2 if opens else 1)
            self.assertEqual(report['input']['vertices'], 8 if opens else 6)

    def test_faces_without_area_get_room(self):
        """A face with a repeated vertex, a needle and a sliver beside a square: floats near 1 have spacing 6e-8."""
        square = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)]
        for more, face in (([(0.01, 0, 0)], (0, 4, 4)), ([(1 + 1e-4, 1, 0), (1 + 5e-5, 1 + 1e-7, 0)], (3, 4, 5)),
                           ([(0.25, 0, 0), (0.5, 0, 0)], (4, 5, 1))):
            with self.subTest(face=face):
                model = Model()
                model.add('meshes', {'primitives': [{
                    'attributes': {'POSITION': model.accessor(square + more, bounds=True)},
                    'indices': model.accessor([[v] for f in ((0, 1, 2), (1, 3, 2), face) for v in f], USHORT,
                                              INDICES)}]})
                self.write('a.glb', model.glb())
                self.run_ok('unwrap', self.path('a.glb'), '-o', self.path('b.glb'), '--force')
                self.run_ok('check', self.path('b.glb'), '--surface', self.path('a.glb'), '--certify')
                with open(self.path('b.glb'), 'rb') as f:
                    new = Reader(f.read())
                uv = new.attribute(0, 0, 'TEXCOORD_0')
                for f in new.triangles(0, 0):
                    self.assertLess(area([uv[v] for v in f]), 0)  # v points downwards

    def test_parametrize_and_convert(self):
        model = Model()
        rows, faces = patch(4, random.Random(1))
        model.add('meshes', {'primitives': [{
            'attributes': {'POSITION': model.accessor([r[0] for r in rows], bounds=True)},
            'indices': model.accessor([[v] for f in faces for v in f], USHORT, INDICES)}]})
        self.write('a.glb', model.glb())
        self.run_ok('parametrize', self.path('a.glb'), self.path('b.glb'))
        self.run_ok('check', self.path('b.glb'), '--surface', self.path('a.glb'))
        self.run_ok('convert', self.path('b.glb'), self.path('c.obj'))
        self.run_ok('convert', self.path('b.glb'), self.path('d.glb'))
        self.run_ok('check', self.path('d.glb'), '--surface', self.path('a.glb'))


if __name__ == '__main__':
    unittest.main()
