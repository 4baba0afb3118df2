# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""glTF files for tests: written, read and compared without the library.

    model = random_model(7)            # random meshes, nodes, skins, ... of seed 7
    open('a.glb', 'wb').write(model.glb())
    back = Reader(open('a.glb', 'rb').read())
    back.triangles(0, 0)               # of mesh 0, primitive 0: numbers of vertices
"""
import base64
import json
import math
import random
import struct
import zlib

BYTE, UBYTE, SHORT, USHORT, UINT, FLOAT = 5120, 5121, 5122, 5123, 5125, 5126
FORMATS = {BYTE: 'b', UBYTE: 'B', SHORT: 'h', USHORT: 'H', UINT: 'I', FLOAT: 'f'}
LARGEST = {BYTE: 127, UBYTE: 255, SHORT: 32767, USHORT: 65535}
WIDTHS = {'SCALAR': 1, 'VEC2': 2, 'VEC3': 3, 'VEC4': 4, 'MAT4': 16}
TYPES = {1: 'SCALAR', 2: 'VEC2', 3: 'VEC3', 4: 'VEC4', 16: 'MAT4'}
VERTICES, INDICES = 34962, 34963
POINTS, LINES, TRIANGLES, STRIP, FAN = 0, 1, 4, 5, 6


def pack(component, values):
    return struct.pack('<%d%s' % (len(values), FORMATS[component]), *values)


def as_float(x):
    return struct.unpack('<f', struct.pack('<f', x))[0]


def png(side=2):
    """Returns a PNG of side * side grey pixels."""
    def chunk(kind, data):
        return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))
    rows = b''.join(b'\0' + bytes([128] * side) for _ in range(side))
    return (b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', struct.pack('>IIBBBBB', side, side, 8, 0, 0, 0, 0)) +
            chunk(b'IDAT', zlib.compress(rows)) + chunk(b'IEND', b''))


class Model:
    """A glTF document: JSON and one buffer."""

    def __init__(self):
        self.json = {'asset': {'version': '2.0', 'extras': {'made': 'for a test'}}}
        self.binary = bytearray()

    def add(self, name, entry):
        self.json.setdefault(name, []).append(entry)
        return len(self.json[name]) - 1

    def view(self, data, target=None, stride=None):
        self.binary += b'\0' * (-len(self.binary) % 4)
        entry = {'buffer': 0, 'byteOffset': len(self.binary), 'byteLength': len(data)}
        if target:
            entry['target'] = target
        if stride:
            entry['byteStride'] = stride
        self.binary += data
        return self.add('bufferViews', entry)

    def accessor(self, rows, component=FLOAT, target=VERTICES, normalized=False, sparse=None, bounds=False):
        """rows: lists of components. sparse: {row: components} on top, of zeros where rows is a number."""
        width = len(sparse[min(sparse)]) if isinstance(rows, int) else len(rows[0])
        count = rows if isinstance(rows, int) else len(rows)
        size = struct.calcsize(FORMATS[component]) * width
        entry = {'componentType': component, 'type': TYPES[width], 'count': count}
        if normalized:
            entry['normalized'] = True
        if not isinstance(rows, int):
            stride = -(-size // 4) * 4 if target == VERTICES else size
            data = b''.join(pack(component, row).ljust(stride, b'\0') for row in rows)
            entry['bufferView'] = self.view(data, target, stride if stride != size else None)
        final = [[0] * width for _ in range(count)] if isinstance(rows, int) else [list(r) for r in rows]
        if sparse:
            places = sorted(sparse)
            for place in places:
                final[place] = list(sparse[place])
            entry['sparse'] = {
                'count': len(places),
                'indices': {'bufferView': self.view(pack(USHORT, places)), 'componentType': USHORT},
                'values': {'bufferView': self.view(b''.join(pack(component, sparse[p]) for p in places))}}
        if bounds:
            columns = list(zip(*final))
            if component == FLOAT:
                columns = [[as_float(x) for x in column] for column in columns]
            entry['min'], entry['max'] = [min(c) for c in columns], [max(c) for c in columns]
        return self.add('accessors', entry)

    def finished(self, uri=None):
        out = json.loads(json.dumps(self.json))
        if self.binary:
            out['buffers'] = [{'byteLength': len(self.binary), 'extras': {'of': 'the buffer'}}]
            if uri:
                out['buffers'][0]['uri'] = uri
        return out

    def glb(self):
        text = json.dumps(self.finished()).encode()
        text += b' ' * (-len(text) % 4)
        binary = bytes(self.binary) + b'\0' * (-len(self.binary) % 4)
        chunks = struct.pack('<II', len(text), 0x4E4F534A) + text
        if binary:
            chunks += struct.pack('<II', len(binary), 0x004E4942) + binary
        return b'glTF' + struct.pack('<II', 2, 12 + len(chunks)) + chunks

    def gltf(self, uri=None):
        """Returns the JSON, with its buffer embedded or in a file of that name."""
        data = 'data:application/octet-stream;base64,' + base64.b64encode(self.binary).decode()
        return json.dumps(self.finished(uri or data)).encode()


class Reader:
    """A file that was read: accessors as lists of rows."""

    def __init__(self, content, buffers=()):
        self.binary = list(buffers)
        if content[:4] == b'glTF':
            size, = struct.unpack_from('<I', content, 12)
            self.json = json.loads(content[20:20 + size])
            if len(content) > 20 + size:
                self.binary = [content[20 + size + 8:]]
        else:
            self.json = json.loads(content)
            for k, entry in enumerate(self.json.get('buffers', [])):
                if entry.get('uri', '').startswith('data:'):
                    self.binary.append(base64.b64decode(entry['uri'].split(',', 1)[1]))

    def view(self, k):
        view = self.json['bufferViews'][k]
        start = view.get('byteOffset', 0)
        return self.binary[view['buffer']][start:start + view['byteLength']], view.get('byteStride')

    def rows(self, k, raw=False):
        entry = self.json['accessors'][k]
        component, width, count = entry['componentType'], WIDTHS[entry['type']], entry['count']
        code = '<%d%s' % (width, FORMATS[component])
        size = struct.calcsize(code)
        if 'bufferView' in entry:
            data, stride = self.view(entry['bufferView'])
            at = entry.get('byteOffset', 0)
            rows = [struct.unpack_from(code, data, at + i * (stride or size)) for i in range(count)]
        else:
            rows = [(0,) * width] * count
        if 'sparse' in entry:
            sparse = entry['sparse']
            places = self.view(sparse['indices']['bufferView'])[0]
            values = self.view(sparse['values']['bufferView'])[0]
            kind = FORMATS[sparse['indices']['componentType']]
            for i in range(sparse['count']):
                place, = struct.unpack_from('<' + kind, places, i * struct.calcsize(kind))
                rows[place] = struct.unpack_from(code, values, i * size)
        if entry.get('normalized') and not raw:
            rows = [tuple(max(x / LARGEST[component], -1) for x in row) for row in rows]
        return rows

    def primitive(self, mesh, p):
        return self.json['meshes'][mesh]['primitives'][p]

    def attribute(self, mesh, p, name):
        return self.rows(self.primitive(mesh, p)['attributes'][name])

    def triangles(self, mesh, p):
        primitive = self.primitive(mesh, p)
        mode = primitive.get('mode', TRIANGLES)
        if 'indices' in primitive:
            corners = [row[0] for row in self.rows(primitive['indices'])]
        else:
            corners = list(range(self.json['accessors'][primitive['attributes']['POSITION']]['count']))
        if mode == TRIANGLES:
            return [tuple(corners[k:k + 3]) for k in range(0, len(corners), 3)]
        if mode == STRIP:
            faces = [(corners[k], corners[k + 1 + k % 2], corners[k + 2 - k % 2]) for k in range(len(corners) - 2)]
            return [f for f in faces if len(set(f)) == 3]
        if mode == FAN:
            return [(corners[0], corners[k], corners[k + 1]) for k in range(1, len(corners) - 1)]
        return []


# ---- shapes: positions, normals, texture coordinates by vertex, triangles ---------------------------------
def patch(n, random):
    """Returns a bumpy square of n * n quads."""
    a, b = random.uniform(0.5, 2), random.uniform(0.5, 2)
    rows, faces = [], []
    for j in range(n + 1):
        for i in range(n + 1):
            x, y = i / n, j / n
            z = 0.2 * math.sin(a * 3 * x) * math.cos(b * 3 * y)
            normal = (-0.6 * a * math.cos(a * 3 * x) * math.cos(b * 3 * y),
                      0.6 * b * math.sin(a * 3 * x) * math.sin(b * 3 * y), 1.0)
            length = math.sqrt(sum(c * c for c in normal))
            rows.append(((x, y, z), tuple(c / length for c in normal), (x, 1 - y)))
    for j in range(n):
        for i in range(n):
            k = j * (n + 1) + i
            faces += [(k, k + 1, k + n + 2), (k, k + n + 2, k + n + 1)]
    return rows, faces


def box(size=(1, 1, 1)):
    """Returns a box with hard edges: 24 vertices."""
    rows, faces = [], []
    for axis in range(3):
        for sign in (-1, 1):
            u, v = (axis + 1) % 3, (axis + 2) % 3
            first = len(rows)
            for s, t in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                p, n = [0, 0, 0], [0, 0, 0]
                p[axis], p[u], p[v] = sign, s * sign, t
                n[axis] = sign
                rows.append((tuple(0.5 * size[k] * p[k] for k in range(3)), tuple(n), ((s + 1) / 2, (t + 1) / 2)))
            faces += [(first, first + 1, first + 2), (first, first + 2, first + 3)]
    return rows, faces


def ball(n):
    """Returns a sphere with a seam in texture coordinates and one vertex per pole."""
    rows, faces = [], []
    for j in range(1, n):
        for i in range(2 * n + 1):
            theta, phi = math.pi * j / n, math.pi * (i % (2 * n)) / n
            p = (math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi), math.cos(theta))
            rows.append((p, p, (i / (2 * n), j / n)))
    top, bottom = len(rows), len(rows) + 1
    rows += [((0, 0, 1), (0, 0, 1), (0.5, 0)), ((0, 0, -1), (0, 0, -1), (0.5, 1))]
    ring = 2 * n + 1
    for i in range(2 * n):
        faces += [(top, i, i + 1), (bottom, (n - 2) * ring + i + 1, (n - 2) * ring + i)]
        for j in range(n - 2):
            a = j * ring + i
            faces += [(a, a + ring, a + ring + 1), (a, a + ring + 1, a + 1)]
    return rows, faces


def strip_of(n):
    """Returns a band of n quads and the order of a triangle strip."""
    rows = []
    for k in range(n + 1):
        for side in (0, 1):
            rows.append(((k / n, side * 0.3, 0.1 * math.sin(4 * k / n)), (0, 0, 1), (k / n, side)))
    return rows, [k for k in range(2 * n + 2)]


# ---- random files --------------------------------------------------------------------------------------
class Maker:
    """Makes models whose parts are random."""

    def __init__(self, seed):
        self.random = random.Random(seed)
        self.model = Model()
        self.used = set()

    def chance(self, p):
        return self.random.random() < p

    def make(self):
        r, model = self.random, self.model
        self.materials = [self.material(k) for k in range(r.randint(0, 3))]
        meshes = [self.mesh(k) for k in range(r.randint(1, 3))]
        nodes = [self.node(mesh) for mesh in meshes]
        if self.chance(0.5):  # an instance
            nodes.append(self.node(r.choice(meshes)))
        for k in range(len(nodes)):
            if model.json['nodes'][nodes[k]].get('skin') is None and self.chance(0.3):
                nodes[k] = model.add('nodes', dict(self.transform(), children=[nodes[k]], name='above'))
        if self.chance(0.3):
            model.add('cameras', {'type': 'perspective', 'perspective': {'yfov': 0.7, 'znear': 0.1}})
            nodes.append(model.add('nodes', {'camera': 0, 'extras': {'a': [1, 2.5]}}))
        if self.chance(0.4):
            self.animation(nodes[0])
        joints = [k for k, node in enumerate(model.json['nodes']) if node.get('name', '').startswith('joint root')]
        model.add('scenes', {'nodes': nodes + joints, 'name': 'all'})
        model.json['scene'] = 0
        if self.used:
            model.json['extensionsUsed'] = sorted(self.used)
            if 'KHR_mesh_quantization' in self.used:
                model.json['extensionsRequired'] = ['KHR_mesh_quantization']
        return model

    def texture(self):
        if 'textures' not in self.model.json:
            image = self.model.add('images', {'bufferView': self.model.view(png()), 'mimeType': 'image/png'})
            self.model.add('samplers', {})
            self.model.add('textures', {'source': image, 'sampler': 0})
        return {'index': 0}

    def material(self, k):
        entry = {'name': 'material %d' % k, 'extras': {'k': k}}
        if self.chance(0.7):
            entry['pbrMetallicRoughness'] = {'baseColorTexture': self.texture()}
            if self.chance(0.3):
                self.used.add('KHR_texture_transform')
                entry['pbrMetallicRoughness']['baseColorTexture']['extensions'] = {
                    'KHR_texture_transform': {'scale': [2, 2]}}
        if self.chance(0.3):
            entry['emissiveTexture'] = self.texture()
        if self.chance(0.2):
            self.used.add('KHR_materials_clearcoat')
            entry['extensions'] = {'KHR_materials_clearcoat': {'clearcoatFactor': 1, 'clearcoatTexture': self.texture()}}
        return self.model.add('materials', entry)

    def shape(self):
        kind = self.random.choice(['patch', 'box', 'ball', 'big'])
        if kind == 'patch':
            return patch(self.random.randint(2, 6), self.random)
        if kind == 'box':
            return box([self.random.uniform(0.3, 2) for _ in range(3)])
        return ball(self.random.randint(3, 5)) if kind == 'ball' else patch(17, self.random)

    def mesh(self, k):
        r, model = self.random, self.model
        rows, faces = self.shape()
        joints = self.chance(0.3)
        targets = r.choice([0, 0, 1, 2])
        attributes = self.attributes(rows, joints)
        morphs = [self.target(rows) for _ in range(targets)]
        primitives = []
        parts = [faces]
        if self.chance(0.4) and len(faces) > 6:  # several primitives on the same vertices
            cut = r.randint(1, len(faces) - 1)
            parts = [faces[:cut], faces[cut:]]
        for part in parts:
            primitive = {'attributes': dict(attributes), 'indices': self.indices(part, len(rows))}
            self.finish(primitive, morphs)
            primitives.append(primitive)
        if self.chance(0.3):
            primitives.append(self.ribbon(joints, targets))
        if self.chance(0.2):
            primitives.append(self.loose_triangles(joints, targets))
        if self.chance(0.2):
            primitive = {'attributes': dict(attributes), 'mode': r.choice([POINTS, LINES])}
            primitive['indices'] = model.accessor([[i] for i in range(4)], USHORT, INDICES)
            self.finish(primitive, morphs)
            primitives.append(primitive)
        if self.materials and self.chance(0.2):
            self.variants(primitives)
        entry = {'primitives': primitives, 'name': 'mesh %d \u00e9' % k}
        if targets:
            entry['weights'] = [0.5] * targets
            entry['extras'] = {'targetNames': ['t%d' % t for t in range(targets)]}
        mesh = model.add('meshes', entry)
        if joints:
            self.skins = getattr(self, 'skins', {})
            self.skins[mesh] = self.skin()
        return mesh

    def finish(self, primitive, morphs):
        if morphs:
            primitive['targets'] = morphs
        if self.materials and self.chance(0.8):
            primitive['material'] = self.random.choice(self.materials)
        if self.chance(0.3):
            primitive['extras'] = {'seed': self.random.randint(0, 9)}

    def variants(self, primitives):
        self.used.add('KHR_materials_variants')
        self.model.json.setdefault('extensions', {})['KHR_materials_variants'] = {'variants': [{'name': 'a'}]}
        primitives[0].setdefault('extensions', {})['KHR_materials_variants'] = {
            'mappings': [{'material': self.random.choice(self.materials), 'variants': [0]}]}

    def attributes(self, rows, joints):
        r, model = self.random, self.model
        out = {}
        positions = [row[0] for row in rows]
        if self.chance(0.15):
            self.used.add('KHR_mesh_quantization')
            out['POSITION'] = model.accessor([[round(3000 * c) for c in p] for p in positions], SHORT, bounds=True)
        else:
            sparse = {0: [c - 0.01 for c in positions[0]]} if self.chance(0.2) else None
            out['POSITION'] = model.accessor(positions, sparse=sparse, bounds=True)
        if self.chance(0.8):
            out['NORMAL'] = model.accessor([row[1] for row in rows])
        if self.materials or self.chance(0.6):
            kind = r.choice([FLOAT, UBYTE, USHORT])
            uv = [row[2] for row in rows]
            if kind == FLOAT:
                out['TEXCOORD_0'] = model.accessor(uv)
            else:
                out['TEXCOORD_0'] = model.accessor([[round(LARGEST[kind] * c) for c in t] for t in uv], kind,
                                                   normalized=True)
            if self.chance(0.4):
                out['TEXCOORD_1'] = model.accessor([[t[1] / 2, t[0]] for t in uv])
        if self.chance(0.3):
            out['COLOR_0'] = model.accessor([[r.randint(0, 255) for _ in range(4)] for _ in rows], UBYTE,
                                            normalized=True)
        if self.chance(0.2) and 'NORMAL' in out:
            out['TANGENT'] = model.accessor([tangent(row[1]) for row in rows])
        if self.chance(0.2):
            out['_LAYER'] = model.accessor([[k % 7] for k in range(len(rows))], r.choice([UBYTE, FLOAT]))
        if joints:
            out['JOINTS_0'] = model.accessor([[0, 1, 0, 0] for _ in rows], r.choice([UBYTE, USHORT]))
            out['WEIGHTS_0'] = model.accessor([self.weights(row[0]) for row in rows])
        return out

    @staticmethod
    def weights(p):
        w = as_float(min(max(p[0], 0.25), 0.75))
        return [w, as_float(1 - w), 0, 0]

    def target(self, rows):
        model = self.model
        if self.chance(0.4):  # few vertices move
            moved = {k: [0.0, 0.0, as_float(0.1 * k)] for k in range(1, min(4, len(rows)))}
            return {'POSITION': model.accessor(len(rows), sparse=moved, bounds=True)}
        moves = [[0, 0, as_float(0.1 * row[0][0])] for row in rows]
        return {'POSITION': model.accessor(moves, bounds=True)}

    def indices(self, faces, count):
        kinds = [k for k, most in ((UBYTE, 255), (USHORT, 65535), (UINT, 1 << 32)) if count < most]
        return self.model.accessor([[v] for face in faces for v in face], self.random.choice(kinds), INDICES)

    def ribbon(self, joints, targets):
        rows, order = strip_of(self.random.randint(2, 8))
        rows = [((p[0] + 3, p[1], p[2]), n, t) for p, n, t in rows]
        primitive = {'attributes': self.attributes(rows, joints), 'mode': STRIP}
        if self.chance(0.5):
            primitive['indices'] = self.model.accessor([[k] for k in order], USHORT, INDICES)
        self.finish(primitive, [self.target(rows) for _ in range(targets)])
        return primitive

    def loose_triangles(self, joints, targets):
        """Adds triangles without indices, or a fan."""
        mode = self.random.choice([TRIANGLES, FAN])
        n = 6
        rows = [((-3, 0, 0), (0, 0, 1), (0.5, 0.5))]
        rows += [((math.cos(k) - 3, math.sin(k), 0), (0, 0, 1), (math.cos(k) / 2 + 0.5, math.sin(k) / 2 + 0.5))
                 for k in range(n)]
        if mode == TRIANGLES:
            rows = [rows[v] for k in range(1, n) for v in (0, k, k + 1)]
        primitive = {'attributes': self.attributes(rows, joints), 'mode': mode}
        self.finish(primitive, [self.target(rows) for _ in range(targets)])
        return primitive

    def skin(self):
        model = self.model
        tip = model.add('nodes', {'name': 'joint', 'translation': [0, 0, 0.5]})
        root = model.add('nodes', {'name': 'joint root', 'children': [tip]})
        unit = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
        return model.add('skins', {'joints': [root, tip],
                                   'inverseBindMatrices': model.accessor([unit, unit], target=None)})

    def transform(self):
        r = self.random
        kind = r.choice(['none', 'matrix', 'parts', 'mirror'])
        if kind == 'matrix':
            return {'matrix': [2, 0, 0, 0, 0, 0, 2, 0, 0, -2, 0, 0, 1, 2, 3, 1]}
        if kind == 'parts':
            return {'translation': [r.uniform(-2, 2) for _ in range(3)], 'rotation': [0, 0, 0.6, 0.8],
                    'scale': [1, 2, 0.5]}
        return {'scale': [-1, 1, 1]} if kind == 'mirror' else {}

    def node(self, mesh):
        entry = dict(mesh=mesh, name='node')
        if mesh in getattr(self, 'skins', {}):
            entry['skin'] = self.skins[mesh]
        else:
            entry.update(self.transform())
        return self.model.add('nodes', entry)

    def animation(self, node):
        model = self.model
        times = model.accessor([[0], [1]], target=None, bounds=True)
        moves = model.accessor([[0, 0, 0], [1, 0, 0]], target=None)
        while 'children' in model.json['nodes'][node] and 'matrix' in model.json['nodes'][node]:
            node = model.json['nodes'][node]['children'][0]
        if 'matrix' in model.json['nodes'][node] or 'skin' in model.json['nodes'][node]:
            return model.add('nodes', {'name': 'joint root moved'}) and None
        model.add('animations', {'channels': [{'sampler': 0, 'target': {'node': node, 'path': 'translation'}}],
                                 'samplers': [{'input': times, 'output': moves}]})


def tangent(normal):
    x, y, z = normal
    other = (0, 0, 1) if abs(z) < 0.9 else (1, 0, 0)
    t = (y * other[2] - z * other[1], z * other[0] - x * other[2], x * other[1] - y * other[0])
    length = math.sqrt(sum(c * c for c in t))
    return [c / length for c in t] + [1]


def random_model(seed):
    return Maker(seed).make()
