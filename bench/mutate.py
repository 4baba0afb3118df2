#!/usr/bin/python3
"""Damages files of every format and runs the command on them: it must refuse or work, never break.

Small meshes are written in every format the command reads (OBJ, OFF, PLY ascii and binary, STL ascii
and binary, VTU of the command's own and with ascii arrays), with files of pins, handles, cones and
weights. Each run damages one of them in one way, chosen with a fixed seed, and gives it to one verb
with --time-limit 2. Good: exit codes 0 to 5 in time. Bad: 6, a signal, a finding of a sanitizer, a
run that does not end. Prints a Markdown table; exit code 0 exactly if nothing was bad.

Sample runs:
  bench/mutate.py --count 2000 --jobs 2
  bench/mutate.py --binary build/asan/apps/majorant --keep findings
"""
import argparse
import base64
import collections
import json
import math
import random
import re
import struct
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import common

NUMBERS = ['nan', 'inf', '-inf', '1e308', '-1e308', '1e-308', '1e400', '0', '-0', '-1', '0.5', '1e9', '2147483647',
           '2147483648', '-2147483648', '4294967296', '9223372036854775808', '1e20', '1e150', '']
VALUES = [None, True, False, 'text', '', [], {}, [[]], -1, 0, 1.5, 1e20, 1e308, 2**31, 2**63, 2**64, [0], [0, 'x'],
          {'vertex': -1}, {'vertex': 0, 'target': [0, 0]}, {'origin': [0, 0], 'size': 0}]
FINDING = re.compile(r'Sanitizer|runtime error:')
LIMIT = ['--time-limit', '2']
BINARY = {'.stlb', '.plyb'}                       # kept apart here; the command sees .stl and .ply


# ------------------------------------------------------------------ good files
def patch(n):
    """A bumpy square of n x n quads, each in two triangles."""
    points = [(i / n, j / n, 0.2 * math.sin(3 * i / n) * math.cos(2 * j / n))
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


def mesh_files(name, points, faces):
    """{file name: bytes} of one mesh in every format."""
    rows = ['%r %r %r' % p for p in points]
    obj = ['v ' + r for r in rows] + ['vt %r %r' % p[:2] for p in points]
    obj += ['f ' + ' '.join('%d/%d' % (v + 1, v + 1) for v in f) for f in faces]
    off = ['OFF', '%d %d 0' % (len(points), len(faces))] + rows + ['3 %d %d %d' % f for f in faces]
    header = ['ply', 'format %s 1.0', 'element vertex %d' % len(points)]
    header += ['property double ' + c for c in 'xyz']
    header += ['element face %d' % len(faces), 'property list uchar int vertex_indices', 'end_header', '']
    header = '\n'.join(header)
    stl = ['solid a']
    for f in faces:
        stl += ['facet normal 0 0 1', 'outer loop'] + ['vertex ' + rows[v] for v in f] + ['endloop', 'endfacet']
    binary = b''.join(struct.pack('<12fH', 0, 0, 1, *(c for v in f for c in points[v]), 0) for f in faces)
    ply = b''.join(struct.pack('<3d', *p) for p in points) + b''.join(struct.pack('<B3i', 3, *f) for f in faces)
    text = {'.obj': '\n'.join(obj) + '\n', '.off': '\n'.join(off) + '\n',
            '.ply': header % 'ascii' + '\n'.join(rows + ['3 %d %d %d' % f for f in faces]) + '\n',
            '.stl': '\n'.join(stl + ['endsolid']) + '\n'}
    files = {name + extension: content.encode() for extension, content in text.items()}
    files[name + '.plyb'] = (header % 'binary_little_endian').encode() + ply
    files[name + '.stlb'] = bytes(80) + struct.pack('<I', len(faces)) + binary
    return files


def in_ascii(vtu):
    """The same file with ascii arrays."""
    def numbers(match):
        kind, rest, payload = match.groups()
        code = {'Float64': 'd', 'Int32': 'i', 'Int64': 'q', 'UInt8': 'B'}[kind]
        data = base64.b64decode(payload)[8:]
        values = struct.unpack('<%d%s' % (len(data) // struct.calcsize(code), code), data)
        return '<DataArray type="%s"%sformat="ascii">\n%s\n<' % (kind, rest, ' '.join(map(repr, values)))
    return re.sub(r'<DataArray type="(\w+)"([^>]*)format="binary">\n(.*?)\n<', numbers, vtu, flags=re.S)


def good_files(options, folder):
    """{name: bytes}; the command makes the VTU files."""
    files = mesh_files('patch', *patch(4))
    files.update(mesh_files('closed', *octahedron()))
    for name, content in files.items():
        (folder / seen_as(name)).write_bytes(content)
    for name, verb, mesh, degree in (('map1.vtu', 'parametrize', 'patch.obj', 1),
                                     ('map3.vtu', 'parametrize', 'patch.obj', 3),
                                     ('cut.vtu', 'seamless', 'closed.obj', 1)):
        done = common.parametrize(options, folder / mesh, [folder / name], '--degree', degree, verb=verb)
        if done.code != 0:
            sys.exit('cannot make %s: %s' % (name, done.stderr))
        files[name] = (folder / name).read_bytes()
    files['ascii.vtu'] = in_ascii(files['map3.vtu'].decode()).encode()
    handles = [{'vertex': 0, 'target': 'initial'}, {'vertex': 24, 'target': [0.4, 0.3]}]
    files['handles.json'] = json.dumps({'handles': handles}).encode()
    files['pins.json'] = json.dumps({'handles': handles[:1], 'index_base': 0}).encode()
    files['cones.json'] = json.dumps({'cones': [{'vertex': v, 'quarter_turns': 3} for v in range(4)]
                                      + [{'vertex': 4, 'index': 0.5}, {'vertex': 5, 'index': 0.5}]}).encode()
    files['weights.txt'] = ('# weights\n' + '\n'.join(str(1 + k % 3) for k in range(32)) + '\n').encode()
    for name, content in files.items():
        (folder / seen_as(name)).write_bytes(content)
    return files


def seen_as(name):
    """The name a file has for the command."""
    return name[:-1].replace('.', '_b.') if Path(name).suffix in BINARY else name


# ------------------------------------------------------------------ damage
def change_number(content, rng):
    places = list(re.finditer(rb'[-+]?\d[-+.\deE]*', content))
    at = rng.choice(places)
    return content[:at.start()] + rng.choice(NUMBERS).encode() + content[at.end():]


def change_lines(content, rng):
    lines = content.split(b'\n')
    at, other = rng.randrange(len(lines)), rng.randrange(len(lines))
    kind = rng.randrange(4)
    if kind == 0:
        del lines[at]
    elif kind == 1:
        lines.insert(other, lines[at])
    elif kind == 2:
        lines[at], lines[other] = lines[other], lines[at]
    else:
        lines[at] = lines[at] + b' ' + lines[other]
    return b'\n'.join(lines)


def change_bytes(content, rng):
    data = bytearray(content)
    for _ in range(rng.choice((1, 1, 2, 8, 64))):
        data[rng.randrange(len(data))] = rng.randrange(256)
    return bytes(data)


def truncate(content, rng):
    return content[:rng.randrange(len(content))]


def repeat(content, rng):
    a, b = sorted(rng.randrange(len(content)) for _ in range(2))
    return content[:b] + content[a:b] * rng.choice((1, 3, 100)) + content[b:]


def nest(content, rng):
    at = rng.randrange(len(content))
    return content[:at] + rng.choice((b'[', b'{"a":', b'<a>', b'(', b'- ')) * 100000 + content[at:]


def change_document(document, rng):
    """Some value of a JSON document becomes another, or its key does."""
    node, key = {'': document}, ''
    while isinstance(node[key], (dict, list)) and node[key] and rng.random() < 0.8:
        node = node[key]
        key = rng.choice(list(node) if isinstance(node, dict) else range(len(node)))
    if isinstance(node, dict) and key and rng.random() < 0.1:
        node[str(key) + '_'] = node.pop(key)
    else:
        node[key] = rng.choice(VALUES)
    return node[''] if '' in node and node is not document else document


def change_json(content, rng):
    return json.dumps(change_document(json.loads(content), rng)).encode()


def change_claims(content, rng):
    """The same for the claims of a VTU file; its arrays of numbers stay good."""
    pattern = re.compile(rb'(Name="majorant_claims"[^>]*>\n)(.*?)(\n</)', re.S)
    claims = json.loads(bytes(map(int, pattern.search(content).group(2).split()))[:-1])
    text = json.dumps(change_document(claims, rng)).encode()
    if rng.random() < 0.1:
        text = nest(text, rng)
    codes = ' '.join(map(str, text)).encode() + b' 0'
    return pattern.sub(lambda m: m.group(1) + codes + m.group(3), content)


def change_array(content, rng):
    """Bytes of one base64 array of a VTU file, which stays base64."""
    arrays = list(re.finditer(rb'format="binary">\n(.*?)\n<', content, re.S))
    if not arrays:
        return change_number(content, rng)
    at = rng.choice(arrays)
    data = bytearray(base64.b64decode(at.group(1)))
    for _ in range(rng.choice((1, 4, 32))):
        data[rng.randrange(len(data))] = rng.choice((0, 1, 0x7f, 0x80, 0xf0, 0xff, rng.randrange(256)))
    return content[:at.start(1)] + base64.b64encode(bytes(data)) + content[at.end(1):]


def damages(name):
    extension = Path(name).suffix
    common_ones = [change_bytes, truncate, repeat, nest]
    if extension in BINARY:
        return common_ones[:3]
    if extension == '.vtu':
        return common_ones + [change_claims] * 3 + [change_array] * 3 + [change_number]
    if extension == '.json':
        return common_ones + [change_json] * 4 + [change_number] * 2
    return common_ones + [change_number] * 4 + [change_lines] * 3


# ------------------------------------------------------------------ runs
def commands(name, good):
    """What may be done with a file, as words; {} is the file, OUT a name for the output."""
    degree = ['--degree', '2']
    mesh = str(good / 'patch.obj')
    out = ['-o', 'OUT.vtu', '--report', 'OUT.json']
    if name == 'handles.json':
        return [['parametrize', mesh, '--handles', '{}'] + out + LIMIT, ['deform', mesh, '--handles', '{}'] + out + LIMIT]
    if name == 'pins.json':
        return [['parametrize', mesh, '--pins', '{}'] + degree + out + LIMIT]
    if name == 'cones.json':
        return [['seamless', str(good / 'closed.obj'), '--cones', '{}', '--degree', '1'] + out + LIMIT]
    if name == 'weights.txt':
        return [['parametrize', mesh, '--weights', '{}'] + degree + out + LIMIT]
    any_mesh = [['parametrize', '{}'] + degree + out + LIMIT, ['info', '{}', '--report', 'OUT.json'],
                ['parametrize', '{}', '--bijective', '--degree', '1'] + out + LIMIT,
                ['parametrize', '{}', '--init', 'input', '-o', 'OUT.obj'] + LIMIT,
                ['seamless', '{}', '--degree', '1'] + out + LIMIT]
    result = [['check', '{}'], ['check', '{}', '--certify', '--surface', mesh, '--report', 'OUT.json'],
              ['check', '{}', '--seamless'], ['convert', '{}', '-o', 'OUT.svg', '-o', 'OUT.obj', '-o', 'OUT.vtu']]
    if name.endswith('.vtu'):
        return 3 * result + any_mesh
    return any_mesh + (result if name.endswith('.obj') else [])


def one(options, good, files, index, folder):
    """Damages one file and runs one verb: (file name, damage, exit code, what was bad)."""
    rng = random.Random('%d %d' % (options.seed, index))
    name = rng.choice(sorted(files))
    damage = rng.choice(damages(name))
    path = folder / ('%d_%s' % (index, seen_as(name)))
    path.write_bytes(damage(files[name], rng))
    out = str(folder / ('%d_out' % index))
    words = [w.replace('{}', str(path)).replace('OUT', out) if w == '{}' or w.startswith('OUT') else w
             for w in rng.choice(commands(name, good))]
    done = common.run([options.binary.resolve()] + words, options.timeout)
    bad = ''
    if done.code not in range(6):
        bad = 'exit %s' % done.code
    elif FINDING.search(done.stderr):
        bad = 'sanitizer'
    if bad and options.keep:
        options.keep.mkdir(parents=True, exist_ok=True)
        (options.keep / path.name).write_bytes(path.read_bytes())
    for left in [path] + list(folder.glob('%d_out*' % index)):
        left.unlink()
    if bad:
        print('%s: %s: %s\n  %s' % (bad, path.name, ' '.join(words), done.stderr.strip()[:400]), flush=True)
    return name, damage.__name__, done.code, bad


def table(rows):
    codes = sorted({code for _, _, code, _ in rows}, key=str)
    count = collections.Counter()
    for name, _, code, bad in rows:
        kind = Path(name).suffix if name.endswith(('.vtu', '.obj', '.off', '.ply', '.stl', '.plyb', '.stlb')) else name
        count[kind, code] += 1
        count[kind, 'bad'] += bool(bad)
    kinds = sorted({kind for kind, _ in count})
    print('\n| format | files | %s | bad |' % ' | '.join('exit %s' % c for c in codes))
    print('|---|' + '---|' * (len(codes) + 2))
    for kind in kinds:
        each = [count[kind, c] for c in codes]
        print('| %s | %d | %s | %d |' % (kind, sum(each), ' | '.join(map(str, each)), count[kind, 'bad']))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--binary', type=Path, default=common.DEFAULT_BINARY, help='the majorant program')
    parser.add_argument('--timeout', type=float, default=60, help='seconds a single process may take')
    parser.add_argument('--count', type=int, default=20000, help='damaged files')
    parser.add_argument('--jobs', type=int, default=2, help='processes at a time')
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--keep', type=Path, help='folder for the files that something bad happened with')
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix='majorant_mutate_') as name:
        good, work = Path(name) / 'good', Path(name) / 'work'
        good.mkdir()
        work.mkdir()
        files = good_files(options, good)
        with ThreadPoolExecutor(options.jobs) as pool:
            rows = list(pool.map(lambda k: one(options, good, files, k, work), range(options.count)))
    table(rows)
    sys.exit(any(bad for _, _, _, bad in rows))


if __name__ == '__main__':
    main()
