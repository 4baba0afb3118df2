# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""unwrap --objects separate of glTF: every mesh fills the unit square, for any number of nodes that use it."""
from gltf_helpers import *


class Objects(CommandTest):
    def model(self):
        """Returns two meshes: one of two primitives, and one of one primitive that two nodes use."""
        model = Model()

        def primitive(shape):
            rows, faces = shape
            return {'attributes': {'POSITION': model.accessor([p for p, _, _ in rows], bounds=True),
                                   'NORMAL': model.accessor([n for _, n, _ in rows])},
                    'indices': model.accessor([[v] for f in faces for v in f], USHORT, INDICES)}
        room = model.add('meshes', {'name': 'room', 'primitives': [primitive(ball(5)), primitive(box((9, 2, 3)))]})
        lamp = model.add('meshes', {'name': 'lamp', 'primitives': [primitive(ball(4))]})
        nodes = [model.add('nodes', {'mesh': mesh, 'translation': at})
                 for mesh, at in ((room, [0, 0, 0]), (lamp, [5, 0, 0]), (lamp, [9, 1, 0]))]
        model.json['scene'] = model.add('scenes', {'nodes': nodes})
        return model

    def test_each_fills_the_unit_square(self):
        source, out = self.write('in.glb', self.model().glb()), self.path('out.glb')
        self.run_ok('unwrap', source, '-o', out, '--objects', 'separate', '--report', self.path('r.json'))
        self.assertEqual([o['name'] for o in json.loads(self.read('r.json'))['objects']], ['room', 'lamp'])
        reader = Reader(self.read('out.glb'))
        for mesh, primitives in ((0, 2), (1, 1)):
            uv = [p for k in range(primitives) for p in reader.attribute(mesh, k, 'TEXCOORD_0')]
            for x in range(2):
                self.assertGreaterEqual(min(p[x] for p in uv), 0)
                self.assertLessEqual(max(p[x] for p in uv), 1)
            side = max(max(p[x] for p in uv) - min(p[x] for p in uv) for x in range(2))
            self.assertGreater(side, 0.97)
        self.run_ok('check', out, '--surface', source, '--certify', '--objects', 'separate')
        self.assertEqual(majorant('check', out, '--certify').code, INVALID)
        for issues in validated([out], self.path('.')):
            self.assertEqual([i for i in issues if i['severity'] < 2], [])

    def test_random_files(self):
        """Meshes with duplicated vertices, morph targets that separate vertices, strips, skins."""
        for k in range(0, 60, 4):
            source, out = self.write('in.glb', random_model(k).glb()), self.path('out.glb')
            with self.subTest(k):
                self.run_ok('unwrap', source, '-o', out, '--objects', 'separate')
                self.run_ok('check', out, '--surface', source, '--certify', '--objects', 'separate')

    def test_names_of_an_obj_tell_objects_apart(self):
        for names, expected in ((['a', 'a'], ['a', 'a_2']), ([None, None], ['object', 'object_2']),
                                ([None, 'object'], ['object', 'object_2']), (['a_2', None], ['a_2', 'object'])):
            model = self.model()
            for mesh, name in zip(model.json['meshes'], names):
                mesh.pop('name')
                mesh.update({'name': name} if name else {})
            source, out = self.write('in.glb', model.glb()), self.path('out.obj')
            with self.subTest(names):
                self.run_ok('unwrap', source, '-o', out, '--objects', 'separate')
                self.assertEqual([line[2:] for line in self.read('out.obj').decode().splitlines()
                                  if line.startswith('o ')], expected)
                self.run_ok('check', out, '--certify', '--objects', 'separate')


if __name__ == '__main__':
    unittest.main()
