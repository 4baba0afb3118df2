# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""The valid files that mutate.py damages: small meshes and maps in every format, and their JSON files.

Meshes are made from formulas, maps come from the program and from tests/data/maps. All are small, so that
many damaged files can be tried.

Sample runs:
  /usr/bin/python3 -c 'import mutation_seeds; print(mutation_seeds.patch(2))'     (imported, not run)
"""
import base64
import json
import math
import re
import struct
import sys
from collections import namedtuple
from pathlib import Path

from PIL import Image

sys.path.append(str(Path(__file__).resolve().parents[2] / 'bench'))
import common  # noqa: E402

MAPS = common.ROOT / 'tests/data/maps'
JSON_KINDS = {'pins': 'pins JSON', 'handles': 'handles JSON', 'cones': 'cones JSON'}

# A valid file. name: that of the file; kind: the kind of damage; surface: path of the mesh of a map, or None;
# beside: names of files that must be in its folder
Seed = namedtuple('Seed', 'name kind content surface beside', defaults=[()])


# ------------------------------------------------------------------ meshes
def patch(n, height=0.2):
    """Returns a bumpy square of n x n quads, each in two triangles."""
    points = [(i / n, j / n, height * math.sin(3 * i / n) * math.cos(2 * j / n))
              for j in range(n + 1) for i in range(n + 1)]
    faces = []
    for j in range(n):
        for i in range(n):
            a = j * (n + 1) + i
            faces += [(a, a + 1, a + n + 2), (a, a + n + 2, a + n + 1)]
    return points, faces


def octahedron():
    points = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    faces = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    return points, faces


def annulus():
    """Returns two rings of six vertices with the quads between them, in the plane."""
    points = [(r * math.cos(k * math.pi / 3), r * math.sin(k * math.pi / 3), 0.0) for r in (1, 2) for k in range(6)]
    faces = []
    for k in range(6):
        a, b = k, (k + 1) % 6
        faces += [(a, a + 6, b + 6), (a, b + 6, b)]
    return points, faces


def obj(points, faces):
    lines = ['v %r %r %r' % p for p in points] + ['vt %r %r' % p[:2] for p in points]
    return '\n'.join(lines + ['f ' + ' '.join('%d/%d' % (v + 1, v + 1) for v in f) for f in faces]) + '\n'


def off(points, faces):
    rows = ['%r %r %r' % p for p in points] + [' '.join(map(str, (len(f),) + f)) for f in faces]
    return '\n'.join(['OFF', '%d %d 0' % (len(points), len(faces))] + rows) + '\n'


def ply_header(points, faces, form):
    return '\n'.join(['ply', 'format %s 1.0' % form, 'comment made by mutate.py', 'element vertex %d' % len(points)]
                     + ['property double ' + c for c in 'xyz']
                     + ['element face %d' % len(faces), 'property list uchar int vertex_indices', 'end_header', ''])


def ply_ascii(points, faces):
    rows = ['%r %r %r' % p for p in points] + [' '.join(map(str, (len(f),) + f)) for f in faces]
    return ply_header(points, faces, 'ascii') + '\n'.join(rows) + '\n'


def ply_binary(points, faces, order):
    form = 'binary_%s_endian' % ('little' if order == '<' else 'big')
    return ply_header(points, faces, form).encode() + b''.join(struct.pack(order + '3d', *p) for p in points) \
        + b''.join(struct.pack(order + 'B3i', 3, *f) for f in faces)


def stl_ascii(points, faces):
    lines = ['solid a']
    for f in faces:
        lines += ['facet normal 0 0 1', 'outer loop'] + ['vertex %r %r %r' % points[v] for v in f]
        lines += ['endloop', 'endfacet']
    return '\n'.join(lines + ['endsolid']) + '\n'


def stl_binary(points, faces):
    return bytes(80) + struct.pack('<I', len(faces)) \
        + b''.join(struct.pack('<12fH', 0, 0, 1, *(c for v in f for c in points[v]), 0) for f in faces)


# An OBJ with quads and a pentagon, negative indices, groups, materials, normals, a comment and CRLF.
RICH_OBJ = """mtllib a.mtl
v 0 0 0\r
v 1.0 0.0 0.0 # corner
v 1.0 1.0 0.25
v 0.0 1.0 0.0
v 2.0 0.0 0.0
v 2.0 1.0 0.125
v 0.5 2.0 0.0
vt 0.0 0.0
vt 1.0 0.0
vt 1.0 1.0
vt 0.0 1.0
vn 0.0 0.0 1.0
g left
usemtl red
f 1/1/1 2/2/1 3/3/1 4/4/1
g right
usemtl blue
f 2/1/1 5/2/1 6/3/1 3/4/1
o top
s 1
f -5/-4/1 -2/-3/-1 -1/-2/-1 -4/-1/-1
"""


def mesh_seeds():
    shapes = {'patch': patch(3), 'flat': patch(3, 0.0), 'closed': octahedron(), 'annulus': annulus()}
    for name, (points, faces) in shapes.items():
        yield Seed(name + '.obj', 'OBJ', obj(points, faces).encode(), None)
        yield Seed(name + '.off', 'OFF', off(points, faces).encode(), None)
        yield Seed(name + '.ply', 'PLY ascii', ply_ascii(points, faces).encode(), None)
        yield Seed(name + '_binary.ply', 'PLY binary', ply_binary(points, faces, '<'), None)
        yield Seed(name + '.stl', 'STL ascii', stl_ascii(points, faces).encode(), None)
        yield Seed(name + '_binary.stl', 'STL binary', stl_binary(points, faces), None)
    yield Seed('patch_big.ply', 'PLY binary', ply_binary(*shapes['patch'], '>'), None)
    yield Seed('rich.obj', 'OBJ', RICH_OBJ.encode(), None)


# ------------------------------------------------------------------ vertices and faces
def list_seeds():
    """Yields pins, handles, cones and weights for patch.obj and closed.obj."""
    far = [{'vertex': 0, 'target': 'initial'}, {'vertex': 15, 'target': [1.0625, 0.9375]}]
    from_one = {'index_base': 1, 'comment': 'none', 'handles': [{'vertex': 1, 'target': [0.0, 0.0]},
                                                                {'vertex': 16, 'target': 'initial'}]}
    cones = [{'vertex': v, 'quarter_turns': 3} for v in range(4)] \
        + [{'vertex': 4, 'index': 0.5}, {'vertex': 5, 'index': 0.5}]
    for stem, document in (('pins', {'handles': far[:1]}), ('pins_from_one', from_one), ('handles', {'handles': far}),
                           ('cones', {'cones': cones})):
        yield Seed(stem + '.json', JSON_KINDS[stem.split('_')[0]], json.dumps(document).encode(), None)
    text = '# weights\n' + '\n'.join(str(1 + k % 3) + '.5' for k in range(18)) + '\n'
    yield Seed('weights.txt', 'weights', text.encode(), None)


# ------------------------------------------------------------------ volumes
CORNERS = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
# those of a cube
TETRAHEDRA = [(0, 1, 3, 7), (0, 3, 2, 7), (0, 2, 6, 7), (0, 6, 4, 7), (0, 4, 5, 7), (0, 5, 1, 7)]
# The nodes of a tetrahedron of degree 2 in gmsh's order.
QUADRATIC = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (0.5, 0, 0), (0.5, 0.5, 0), (0, 0.5, 0), (0, 0, 0.5),
             (0, 0.5, 0.5), (0.5, 0, 0.625)]


def msh_2(points, cells, kind):
    """Returns gmsh 2.2. kind: 4 for tetrahedra, 11 for those of degree 2, 5 for hexahedra."""
    rows = ['%d %r %r %r' % (k + 1, *p) for k, p in enumerate(points)]
    elements = ['%d %d 2 1 1 %s' % (k + 1, kind, ' '.join(str(v + 1) for v in c)) for k, c in enumerate(cells)]
    return '\n'.join(['$MeshFormat', '2.2 0 8', '$EndMeshFormat', '$Nodes', str(len(rows)), *rows, '$EndNodes',
                      '$Elements', str(len(elements)), *elements, '$EndElements', ''])


def msh_2_binary(points, cells, kind):
    nodes = b''.join(struct.pack('<i3d', k + 1, *p) for k, p in enumerate(points))
    elements = b''.join(struct.pack('<%di' % (3 + len(c)), k + 1, 1, 1, *(v + 1 for v in c))
                        for k, c in enumerate(cells))
    return b'$MeshFormat\n2.2 1 8\n' + struct.pack('<i', 1) + b'\n$EndMeshFormat\n$Nodes\n%d\n' % len(points) + nodes \
        + b'\n$EndNodes\n$Elements\n%d\n' % len(cells) + struct.pack('<3i', kind, len(cells), 2) + elements \
        + b'\n$EndElements\n'


def msh_4(points, cells, kind):
    rows = [str(k + 1) for k in range(len(points))] + ['%r %r %r' % tuple(p) for p in points]
    elements = ['%d %s' % (k + 1, ' '.join(str(v + 1) for v in c)) for k, c in enumerate(cells)]
    n, m = len(points), len(cells)
    return '\n'.join(['$MeshFormat', '4.1 0 8', '$EndMeshFormat', '$Nodes', '1 %d 1 %d' % (n, n), '3 1 0 %d' % n, *rows,
                      '$EndNodes', '$Elements', '1 %d 1 %d' % (m, m), '3 1 %d %d' % (kind, m), *elements,
                      '$EndElements', ''])


def mfem(points, cells, version='1.0'):
    lines = ['MFEM mesh v' + version, '', 'dimension', '3', '', 'elements', str(len(cells)),
             *('1 4 ' + ' '.join(map(str, c)) for c in cells), '']
    lines += ['attribute_sets', '2', '"the base" 1', '1', 'all 1', '1', ''] if version == '1.3' else []
    lines += ['boundary', '0', '']
    lines += ['bdr_attribute_sets', '0', ''] if version == '1.3' else []
    lines += ['vertices', str(len(points)), '3', *('%r %r %r' % tuple(p) for p in points), '']
    return '\n'.join(lines + ['mfem_mesh_end', ''] * (version != '1.0'))


def mfem_curved(collection):
    """Returns a tetrahedron whose nodes are in a collection of degree 2."""
    return '\n'.join(['MFEM mesh v1.0', '', 'dimension', '3', '', 'elements', '1', '1 4 0 1 2 3', '', 'boundary', '0',
                      '', 'vertices', '4', '', 'nodes', 'FiniteElementSpace', 'FiniteElementCollection: ' + collection,
                      'VDim: 3', 'Ordering: 1', '', *('%r %r %r' % p for p in QUADRATIC), ''])


def volume_vtu(kind, points):
    """Returns one cell of a VTK type."""
    array = lambda of, name, words, more='': '<DataArray type="%s" Name="%s" %sformat="ascii">\n%s\n</DataArray>\n' % (
        of, name, more, words)
    return ('<VTKFile type="UnstructuredGrid" version="2.2" byte_order="LittleEndian">\n<UnstructuredGrid>\n'
            '<Piece NumberOfPoints="%d" NumberOfCells="1">\n<Points>\n%s</Points>\n<Cells>\n%s%s%s</Cells>\n</Piece>\n'
            '</UnstructuredGrid>\n</VTKFile>\n' % (
                len(points), array('Float64', 'Points', ' '.join('%r %r %r' % tuple(p) for p in points),
                                   'NumberOfComponents="3" '),
                array('Int64', 'connectivity', ' '.join(map(str, range(len(points))))),
                array('Int64', 'offsets', len(points)), array('UInt8', 'types', kind)))


def medit(points, cells):
    return '\n'.join(['MeshVersionFormatted 2', 'Dimension 3', 'Vertices', str(len(points)),
                      *('%r %r %r 0' % tuple(p) for p in points), 'Tetrahedra', str(len(cells)),
                      *(' '.join(str(v + 1) for v in c) + ' 1' for c in cells), 'End', ''])


def volume_seeds():
    hexahedron = [(0, 1, 3, 2, 4, 5, 7, 6)]
    curved = [tuple(range(10))]
    for name, kind, content in (
            ('cube_2.msh', 'volume MSH', msh_2(CORNERS, TETRAHEDRA, 4)),
            ('cube_4.msh', 'volume MSH', msh_4(CORNERS, TETRAHEDRA, 4)),
            ('hexahedron.msh', 'volume MSH', msh_4(CORNERS, hexahedron, 5)),
            ('curved.msh', 'volume MSH', msh_2(QUADRATIC, curved, 11)),
            ('cube_binary.msh', 'volume MSH binary', msh_2_binary(CORNERS, TETRAHEDRA, 4)),
            ('curved_binary.msh', 'volume MSH binary', msh_2_binary(QUADRATIC, curved, 11)),
            ('cube_mfem.mesh', 'volume MFEM', mfem(CORNERS, TETRAHEDRA)),
            ('cube_mfem_2.mesh', 'volume MFEM', mfem(CORNERS, TETRAHEDRA, '1.2')),
            ('cube_mfem_3.mesh', 'volume MFEM', mfem(CORNERS, TETRAHEDRA, '1.3')),
            ('curved_mfem.mesh', 'volume MFEM', mfem_curved('H1_3D_P2')),
            ('control_mfem.mesh', 'volume MFEM', mfem_curved('L2_T2_3D_P2')),
            ('curved_cell.vtu', 'volume VTU ascii', volume_vtu(24, QUADRATIC)),
            ('lagrange_cell.vtu', 'volume VTU ascii', volume_vtu(71, QUADRATIC)),
            ('hexahedron_cell.vtu', 'volume VTU ascii', volume_vtu(12, [CORNERS[k] for k in (0, 1, 3, 2, 4, 5, 7, 6)])),
            ('cube_medit.mesh', 'volume Medit', medit(CORNERS, TETRAHEDRA))):
        yield Seed(name, kind, content if isinstance(content, bytes) else content.encode(), None)


# ------------------------------------------------------------------ materials, tables, pieces
MTL = 'newmtl red\nKd 0.5 0.25 1\nmap_Kd -clamp on red.png\nmap_Ks red.png\nnewmtl blue\nKd 1 0 0\nmap_d red.png\n'
PVTU = '<VTKFile type="PUnstructuredGrid" version="1.0">\n<PUnstructuredGrid GhostLevel="0">\n' \
    '<Piece Source="map1.vtu"/>\n</PUnstructuredGrid>\n</VTKFile>\n'


def beside_seeds(folder):
    """Yields files that refer to each other: materials of an OBJ, rows of a table, pieces of a map."""
    Image.new('RGB', (5, 4), (200, 100, 50)).save(folder / 'red.png')
    (folder / 'a.mtl').write_text(MTL)
    yield Seed('painted.obj', 'OBJ with materials', RICH_OBJ.encode(), None, ('a.mtl', 'red.png'))
    yield Seed('a.mtl', 'MTL', MTL.encode(), None, ('painted.obj', 'red.png'))
    header = b"{'descr': '<f8', 'fortran_order': False, 'shape': (18, 2), }"
    header += b' ' * (-(11 + len(header)) % 64) + b'\n'
    rows = struct.pack('<36d', *(0.5 * k for k in range(36)))
    yield Seed('rows.npy', 'NPY binary', b'\x93NUMPY\x01\x00' + struct.pack('<H', len(header)) + header + rows, None)
    yield Seed('map1.pvtu', 'PVTU', PVTU.encode(), folder / 'patch.obj', ('map1.vtu',))


# ------------------------------------------------------------------ scenes and images
def made_scenes(options, folder):
    """Makes seeds from the meshes in `folder` with the program: scenes, MSH maps, images."""
    def made(name, kind, *words):
        done = common.run([options.binary.resolve(), *map(str, words), '--quiet', '--force'], 60)
        if done.code not in (0, 4):
            sys.exit('cannot make %s: %s' % (name, done.stderr))
        return Seed(name, kind, (folder / name).read_bytes(), None)

    textured = folder / 'textured.obj'
    yield made('textured.obj', 'OBJ', 'unwrap', folder / 'rich.obj', '-o', textured)
    for mesh in ('patch', 'closed'):
        yield made(mesh + '.glb', 'GLB binary', 'unwrap', folder / (mesh + '.obj'), '-o', folder / (mesh + '.glb'))
        yield made(mesh + '.gltf', 'glTF JSON', 'unwrap', folder / (mesh + '.obj'), '-o', folder / (mesh + '.gltf'))
    yield made('cube_4_binary.msh', 'volume MSH binary', 'mesh', 'optimize', folder / 'cube_4.msh', '--binary', '-o',
               folder / 'cube_4_binary.msh')
    for content in ('image', 'surface'):
        yield made(content + '.msh', 'MSH map', 'convert', folder / 'map2.vtu', '-o', folder / (content + '.msh'),
                   '--msh', content)
    png = made('layout.png', 'PNG binary', 'convert', folder / 'map2.vtu', '-o', folder / 'layout.png', '--size', '64,64')
    yield png
    Image.open(folder / 'layout.png').convert('RGB').save(folder / 'layout.jpg')
    yield Seed('layout.jpg', 'JPEG binary', (folder / 'layout.jpg').read_bytes(), None)
    yield made('colors.exr', 'EXR binary', 'bake', textured, '--from', textured, '--image', folder / 'layout.png', '-o',
               folder / 'colors.exr', '--size', '16,16')


# ------------------------------------------------------------------ maps
def in_ascii(vtu):
    """Returns the file with text arrays."""
    def numbers(match):
        kind, rest, payload = match.groups()
        code = {'Float64': 'd', 'Int32': 'i', 'Int64': 'q', 'UInt8': 'B'}[kind]
        data = base64.b64decode(payload)[8:]
        values = struct.unpack('<%d%s' % (len(data) // struct.calcsize(code), code), data)
        return '<DataArray type="%s"%sformat="ascii">\n%s\n<' % (kind, rest, ' '.join(map(repr, values)))
    return re.sub(r'<DataArray type="(\w+)"([^>]*)format="binary">\n(.*?)\n<', numbers, vtu, flags=re.S)


def without(vtu, *names):
    """Returns the file without some arrays, which a reader must not require."""
    for name in names:
        vtu = re.sub(r'<DataArray [^>]*Name="%s".*?</DataArray>\n' % name, '', vtu, flags=re.S)
    return vtu


def made_maps(options, folder):
    """Yields the program's maps of the meshes in `folder`."""
    runs = [('map%d.vtu' % n, 'parametrize', 'patch.obj', ['--degree', n]) for n in (1, 2, 3, 4)]
    runs += [('pinned.vtu', 'parametrize', 'patch.obj', ['--degree', 2, '--pins', folder / 'pins.json']),
             ('bijective.vtu', 'parametrize', 'patch.obj', ['--degree', 1, '--bijective', '--boundary', 'fixed']),
             ('normalized.vtu', 'parametrize', 'patch.obj', ['--degree', 2, '--init', 'input', '--normalize']),
             ('seams1.vtu', 'seamless', 'closed.obj', ['--degree', 1]),
             ('seams3.vtu', 'seamless', 'closed.obj', ['--degree', 3, '--cones', folder / 'cones.json'])]
    for name, verb, mesh, flags in runs:
        done = common.parametrize(options, folder / mesh, [folder / name], '--max-iterations', 20, *flags, verb=verb)
        if done.code not in (0, 4):
            sys.exit('cannot make %s: %s' % (name, done.stderr))
        content = (folder / name).read_bytes()
        yield Seed(name, 'VTU', content, folder / mesh)
        if name in ('map2.vtu', 'seams1.vtu'):
            text = content.decode()
            bare = without(text, 'input_vertex', 'input_face', 'distortion', 'min_det')
            yield Seed('ascii_' + name, 'VTU ascii', in_ascii(text).encode(), folder / mesh)
            yield Seed('unnumbered_' + name, 'VTU', without(text, 'input_vertex').encode(), folder / mesh)
            yield Seed('bare_' + name, 'VTU', bare.encode(), folder / mesh)


def committed_maps():
    """Yields the small maps of the tests, including broken ones."""
    for path, entry in json.loads((MAPS / 'index.json').read_text()).items():
        surface = entry['surface'] and MAPS / 'surfaces' / (entry['surface'] + '.obj')
        content = (MAPS / path).read_bytes()
        kind = 'small map OBJ' if path.endswith('.obj') else 'small map VTU'
        yield Seed(path.replace('/', '_'), 'VTU appended' if 'appended' in path else kind, content, surface or None)


def more_scenes(options):
    """Yields the GLB files of the folder --more, for example compressed ones, which need other programs."""
    for path in sorted(options.more.glob('*.glb')) if options.more else []:
        yield Seed(path.name, 'more GLB binary', path.read_bytes(), None)


def seeds(options, folder):
    """Returns {kind: [Seed]}, and writes all files to `folder`."""
    plain = list(mesh_seeds()) + list(list_seeds()) + list(volume_seeds()) + list(beside_seeds(folder))
    for seed in plain:
        (folder / seed.name).write_bytes(seed.content)
    kinds = {}
    for seed in plain + list(made_maps(options, folder)) + list(made_scenes(options, folder)) \
            + list(committed_maps()) + list(more_scenes(options)):
        (folder / seed.name).write_bytes(seed.content)
        kinds.setdefault(seed.kind, []).append(seed)
    return kinds
