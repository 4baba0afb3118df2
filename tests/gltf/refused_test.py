# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""glTF files that are damaged, malicious or of unsupported features: one line, exit code 2 or 3, in little time."""
from gltf_helpers import *


def simple():
    model = Model()
    model.add('meshes', {'primitives': [{
        'attributes': {'POSITION': model.accessor([(0, 0, 0), (1, 0, 0), (0, 1, 0)], bounds=True)},
        'indices': model.accessor([[0], [1], [2]], USHORT, INDICES)}]})
    return model


def chain(numbers):
    """Returns nodes, each of which is the child of the previous one."""
    return [{'children': [k]} for k in numbers]


class Refused(CommandTest):
    def refuses(self, code, change, says=()):
        model = simple()
        change(model)
        self.write('a.glb', model.glb())
        return self.refused(code, 'unwrap', self.path('a.glb'), self.path('b.glb'), says=says)

    def test_the_unchanged_file_is_accepted(self):
        self.write('a.glb', simple().glb())
        self.run_ok('unwrap', self.path('a.glb'), self.path('b.glb'))

    def test_compressed_geometry_and_images(self):
        parts = self.run_ok('--licenses').out  # of this build
        for extension, name, library in [('KHR_draco_mesh_compression', 'Draco', '\nDraco:'),
                                         ('EXT_meshopt_compression', 'meshopt', '\nmeshoptimizer:'),
                                         ('KHR_meshopt_compression', 'meshopt', None),
                                         ('KHR_texture_basisu', 'KTX2', None)]:
            for key in ('extensionsUsed', 'extensionsRequired'):
                with self.subTest(extension=extension, key=key):
                    def named(m):
                        m.json.update({key: [extension]})
                    if library and library in parts:  # nothing is compressed
                        model = simple()
                        named(model)
                        self.write('a.glb', model.glb())
                        self.run_ok('unwrap', self.path('a.glb'), self.path('b.glb'), '--force')
                        self.assertNotIn(extension.encode(), self.read('b.glb'))
                    else:
                        self.refuses(UNSUPPORTED, named, [name, extension])
        self.refuses(UNSUPPORTED, lambda m: m.add('images', {'bufferView': 0, 'mimeType': 'image/ktx2'}), 'KTX2')
        self.refuses(UNSUPPORTED, lambda m: m.json.update(extensionsRequired=['ACME_shape']), 'ACME_shape')

    def test_other_versions(self):
        self.refuses(UNSUPPORTED, lambda m: m.json.update(asset={'version': '1.0'}), "'1.0'")
        self.write('a.glb', b'glTF' + struct.pack('<II', 1, 20) + b' ' * 8)
        self.refused(UNSUPPORTED, 'info', self.path('a.glb'), says='version 1')

    def test_files_elsewhere(self):
        os.mkdir(self.path('below'))
        self.write('secret.bin', b'0' * 100)
        os.symlink(self.path('secret.bin'), self.path('below/link.bin'))
        model = simple()
        for uri in ('../secret.bin', 'x/../../secret.bin', '%2e%2e/secret.bin', self.path('secret.bin'),
                    'file:' + self.path('secret.bin'), 'http://localhost/a.bin', 'C:\\a.bin', '..\\secret.bin',
                    'link.bin', 'a%00.bin'):
            with self.subTest(uri):
                self.write('below/a.gltf', model.gltf(uri))
                self.refused(UNSUPPORTED, 'info', self.path('below/a.gltf'), says='folder')
                self.refuses(UNSUPPORTED, lambda m: m.add('images', {'uri': uri}) if uri != 'link.bin' else
                             m.add('images', {'uri': '../a'}), 'folder')
        self.write('below/a.gltf', model.gltf('b.bin'))
        self.refused(UNREADABLE, 'info', self.path('below/a.gltf'), says='b.bin')
        self.write('below/b.bin', bytes(model.binary))
        self.run_ok('info', self.path('below/a.gltf'))

    def test_nodes_that_are_no_tree(self):
        for nodes in (chain([0]), chain([1, 0]), chain([1, 2, 0]), [{'children': [1, 1]}, {}],
                      [{'children': [2]}, {'children': [2]}, {}], [{'children': [7]}], [{'children': [-1]}],
                      [{'children': 3}], [{'mesh': 5}], [{'matrix': [1, 2]}], [{'scale': ['a', 1, 1]}]):
            with self.subTest(nodes):
                self.refuses(UNREADABLE, lambda m: m.json.update(nodes=nodes), 'node')

    def test_many_nodes_in_a_row(self):
        model = simple()
        count = 200000
        model.json['nodes'] = chain(range(1, count)) + [{'mesh': 0, 'translation': [0, 0, 1]}]
        self.write('a.glb', model.glb())
        self.run_ok('info', self.path('a.glb'))

    def test_counts_beyond_the_file(self):
        def set_in(name, k, **changes):
            return lambda m: m.json[name][k].update(changes)
        cases = [set_in('accessors', 0, count=4), set_in('accessors', 1, count=10 ** 15),
                 set_in('accessors', 1, count=0), set_in('accessors', 1, count=-3),
                 set_in('accessors', 1, count=2 ** 64), set_in('accessors', 0, count='3'),
                 set_in('accessors', 0, byteOffset=30), set_in('accessors', 0, byteOffset=2 ** 63),
                 set_in('accessors', 0, componentType=1), set_in('accessors', 0, type='VEC9'),
                 set_in('accessors', 0, bufferView=9), set_in('bufferViews', 0, byteLength=10 ** 9),
                 set_in('bufferViews', 0, byteOffset=10 ** 9), set_in('bufferViews', 0, buffer=3),
                 set_in('bufferViews', 0, byteStride=10 ** 9),
                 lambda m: m.json['meshes'][0]['primitives'][0].update(indices=8),
                 lambda m: m.json['meshes'][0]['primitives'][0]['attributes'].update(POSITION=8),
                 lambda m: m.json['meshes'][0]['primitives'][0].update(material=8),
                 lambda m: m.json['meshes'][0]['primitives'][0].update(mode=9),
                 lambda m: m.json['meshes'][0]['primitives'][0].update(targets=3),
                 lambda m: m.json['meshes'][0].update(primitives=3),
                 lambda m: m.json.update(meshes=3), lambda m: m.json.update(accessors=[3]),
                 lambda m: m.json.update(meshes=[])]
        for k, change in enumerate(cases):
            with self.subTest(k):
                self.refuses(UNREADABLE, change)

    def test_sparse_places_beyond_the_accessor(self):
        def forge(m):
            m.json['accessors'][0]['sparse'] = {
                'count': 1, 'indices': {'bufferView': m.view(pack(USHORT, [3])), 'componentType': USHORT},
                'values': {'bufferView': m.view(pack(FLOAT, [1, 2, 3]))}}
        self.refuses(UNREADABLE, forge, 'sparse')

    def test_small_files_with_huge_counts(self):
        """Accessors of zeros without bytes, and one accessor that is read many times."""
        def zeros(m):
            del m.json['accessors'][0]['bufferView']
            m.json['accessors'][0]['count'] = 2 ** 31
        self.refuses(UNREADABLE, zeros, 'elements')

        def again(m):
            places = m.accessor([(k, k % 7, 0) for k in range(30000)], bounds=True)
            m.json['meshes'][0]['primitives'] = [
                {'attributes': {'POSITION': places}, 'extras': k} for k in range(3)] * 3000
        self.refuses(UNREADABLE, again, 'elements')

    def test_values_that_are_not_finite(self):
        for bad in (float('nan'), float('inf')):
            model = simple()
            data = bytearray(model.binary)
            data[0:4] = struct.pack('<f', bad)
            model.binary = data
            self.write('a.glb', model.glb())
            self.refused(UNREADABLE, 'info', self.path('a.glb'), says='not finite')

        def index(m):
            m.json['meshes'][0]['primitives'][0]['indices'] = m.accessor([[0], [1], [3]], USHORT, INDICES)
        self.refuses(UNREADABLE, index, 'index 3 out of range')

    def test_truncated_at_every_byte(self):
        content = simple().glb()
        step = 7
        for size in range(0, len(content) - 1, step):
            self.write('a.glb', content[:size])
            self.refused(UNREADABLE, 'info', self.path('a.glb'))

    def test_files_that_are_no_gltf(self):
        for name, content in (('a.glb', b'PK\3\4 a zip file'), ('a.gltf', b'{}'), ('a.gltf', b'[1]'),
                              ('a.gltf', b'{"asset": {"version": "2.0"}'), ('a.gltf', b''),
                              ('a.gltf', b'[' * 100000), ('a.gltf', b'{"asset": 2}')):
            with self.subTest(content[:20]):
                self.write(name, content)
                self.refused(UNREADABLE, 'info', self.path(name))

    def test_damaged_json(self):
        """Numbers, lists and names of wrong type or value: never more than one line."""
        r = random.Random(5)
        values = [None, -1, 0, 3, 10 ** 12, 0.5, 'a', [], {}, [0], True, [[]], {'a': 1}]
        for seed in range(120):
            model = random_model(seed % 20)
            place, key = model.json, None
            for _ in range(r.randint(1, 7)):
                if isinstance(place, dict) and place:
                    parent, key = place, r.choice(sorted(place))
                elif isinstance(place, list) and place:
                    parent, key = place, r.randrange(len(place))
                else:
                    break
                place = parent[key]
            parent[key] = r.choice(values)
            self.write('a.glb', model.glb())
            outcome = majorant('unwrap', self.path('a.glb'), '-o', self.path('b.glb'))
            with self.subTest(seed):
                self.assertIn(outcome.code, (OK, UNREADABLE, UNSUPPORTED, LIMIT), outcome.err)


if __name__ == '__main__':
    unittest.main()
