# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Shared code of the tests of the command: runs, small meshes, reading and changing VTU files."""
import base64
import json
import math
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

BINARY = os.environ.get('MAJORANT_BINARY', '')
SOURCE = os.environ.get('MAJORANT_SOURCE_DIR', '')
SHARED = os.environ.get('MAJORANT_SHARED_DIR', '')
VERIFY = os.path.join(SHARED, 'tools', 'verify.py')
CHECKER = os.path.join(SOURCE, 'tests', 'checker', 'check_map.py')

# Waiting threads do not spin, which makes many short runs on a busy machine much faster.
os.environ.setdefault('OMP_WAIT_POLICY', 'passive')

OK, USAGE, UNREADABLE, UNSUPPORTED, LIMIT, INVALID, INTERNAL = range(7)


def where(path):
    """Skips tests that need `path`, which is not part of the repository, if it is missing."""
    name = path.replace(SHARED, '../shared', 1) if SHARED else path
    return unittest.skipUnless(os.path.exists(path), 'no ' + name)


def has_gpl_parts():
    """Returns whether the build has CGAL, Ceres and CHOLMOD."""
    with open(os.path.join(os.environ['MAJORANT_BUILD_DIR'], 'CMakeCache.txt')) as cache:
        return 'MAJORANT_GPL:BOOL=OFF' not in cache.read()


def generated(name):
    return os.path.join(SOURCE, 'examples/meshes', name + '.obj')


class Outcome:
    def __init__(self, process):
        self.code, self.out, self.err = process.returncode, process.stdout, process.stderr

    def printed(self):
        """Returns the lines of stderr without those on progress and time, followed by the verdict of `check`."""
        lines = [line for line in self.err.splitlines() if not re.fullmatch(r'\w+ +\d+\.\d\d s', line)]
        return lines + [line for line in self.out.splitlines() if re.search(': (valid, |invalid: |undecided: )', line)]


def majorant(*args, cwd=None):
    return Outcome(subprocess.run([BINARY] + [str(a) for a in args], cwd=cwd, text=True,
                                  stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, timeout=300))


def without_mark(data):
    """Returns the bytes of a mesh file without majorant's mark."""
    return re.sub(rb'(# |comment |<!-- )majorant [\d.]+( -->)?\n|\$Comments\nmajorant [\d.]+\n\$EndComments\n', b'',
                  data, count=1)


def verb_names():
    """Returns the verbs that help lists, two-word verbs as one: `mesh check`."""
    def listed(*words):
        verbs = majorant(*words, '--help').out.split('Verbs:\n')
        return re.findall(r'^  (\w+) ', verbs[1].split('\n\n')[0], re.MULTILINE) if len(verbs) > 1 else []
    return [' '.join([verb] + inner) for verb in listed()
            for inner in ([[word] for word in listed(verb)] or [[]])]


def read_png(data):
    """Returns (width, height, rows of RGB bytes) of a PNG by the program: 8-bit RGB."""
    assert data[:8] == b'\x89PNG\r\n\x1a\n'
    at, pixels = 8, b''
    while at < len(data):
        size, kind = struct.unpack('>I4s', data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        if kind == b'IHDR':
            width, height, depth, color = struct.unpack('>IIBB', body[:10])
            assert (depth, color) == (8, 2)
        if kind == b'IDAT':
            pixels += body
        at += 12 + size
    raw, rows, before = zlib.decompress(pixels), [], bytes(3 * width)
    for y in range(height):
        start = y * (3 * width + 1)
        kind, line = raw[start], raw[start + 1:start + 1 + 3 * width]
        row = bytearray(line)
        for i in range(3 * width):
            left = row[i - 3] if i >= 3 else 0
            up, corner = before[i], before[i - 3] if i >= 3 else 0
            guess = left + up - corner
            nearest = min((left, up, corner), key=lambda x: (abs(guess - x)))
            row[i] = (line[i] + (0, left, up, (left + up) // 2, nearest)[kind]) % 256
        rows.append(bytes(row))
        before = row
    return width, height, rows


class CommandTest(unittest.TestCase):
    """Tests with a fresh folder each, and checks that hold for every refusal."""

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix='majorant_apps_')
        self.addCleanup(shutil.rmtree, self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        with open(self.path(name), 'w' if isinstance(text, str) else 'wb') as f:
            f.write(text)
        return self.path(name)

    def read(self, name):
        with open(self.path(name), 'rb') as f:
            return f.read()

    def files(self):
        return sorted(os.listdir(self.folder))

    def run_ok(self, *args, code=OK):
        outcome = majorant(*args)
        self.assertEqual(outcome.code, code, '%s\n%s' % (args, outcome.err))
        return outcome

    def refused(self, code, *args, says=()):
        """Requires this exit code, one line on stderr that contains `says`, and nothing on stdout."""
        outcome = majorant(*args)
        self.assertEqual(outcome.code, code, '%s\n%s' % (args, outcome.err))
        self.assertEqual(outcome.out, '')
        self.assertEqual(outcome.err.count('\n'), 1, outcome.err)
        self.assertTrue(outcome.err.endswith('\n'))
        for part in [says] if isinstance(says, str) else says:
            self.assertIn(part, outcome.err)
        return outcome

    def found(self, *args, says=()):
        """Runs `check` on an invalid map: exit code 5, and one line on stdout that contains `says`."""
        outcome = majorant('check', *args)
        self.assertEqual(outcome.code, INVALID, '%s\n%s%s' % (args, outcome.out, outcome.err))
        self.assertEqual(outcome.out.count('\n'), 1, outcome.out)
        for part in [says] if isinstance(says, str) else says:
            self.assertIn(part, outcome.out)
        return outcome

    def judge(self, result, mesh, *options, code=0):
        """Runs tests/checker, which shares no code with the library, on a map of a surface."""
        process = subprocess.run(['/usr/bin/python3', CHECKER, result, '--surface', mesh, *options],
                                 text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                 timeout=300)
        self.assertEqual(process.returncode, code, process.stdout[-2000:])


# ------------------------------------------------------------------ meshes
def bumpy(x, y):
    return 0.4 * math.sin(2.5 * x + 0.3) * math.cos(2 * y)


def grid(n, height=bumpy):
    """Returns (n+1)^2 vertices row by row and 2 n^2 triangles (0-based)."""
    points = [(i / n, j / n, height(i / n, j / n)) for j in range(n + 1) for i in range(n + 1)]
    faces = []
    for j in range(n):
        for i in range(n):
            a = j * (n + 1) + i
            b, c, d = a + 1, a + n + 1, a + n + 2
            faces += [(a, b, d), (a, d, c)]
    return points, faces


def quads(n, height=bumpy):
    points, _ = grid(n, height)
    faces = [(j * (n + 1) + i, j * (n + 1) + i + 1, (j + 1) * (n + 1) + i + 1, (j + 1) * (n + 1) + i)
             for j in range(n) for i in range(n)]
    return points, faces


def ramp(turns, steps=36):
    """Returns a strip that climbs slowly around an axis: without distortion its layout overlaps itself."""
    points = []
    for i in range(steps + 1):
        t = turns * i / steps
        for r in (1, 1.25, 1.5):
            points.append((r * math.cos(2 * math.pi * t), r * math.sin(2 * math.pi * t), 0.3 * t))
    faces = []
    for i in range(steps):
        for a in (3 * i, 3 * i + 1):
            faces += [(a, a + 1, a + 4), (a, a + 4, a + 3)]
    return points, faces


def torus(m, n, holes):
    points, faces = [], []
    for j in range(n):
        for i in range(m):
            s, t = 2 * math.pi * i / m, 2 * math.pi * j / n
            points.append(((2 + math.cos(t)) * math.cos(s), (2 + math.cos(t)) * math.sin(s),
                           math.sin(t)))
    for q in range(holes, m * n):
        i, j = q % m, q // m
        a, b = j * m + i, j * m + (i + 1) % m
        c, d = (j + 1) % n * m + (i + 1) % m, (j + 1) % n * m + i
        faces += [(a, b, c), (a, c, d)]
    return points, faces


def obj_text(points, faces, uv=None):
    lines = ['v %r %r %r' % tuple(p) for p in points]
    lines += ['vt %r %r' % tuple(t) for t in uv or []]
    corner = '%d/%d' if uv else '%d'
    for face in faces:
        lines.append('f ' + ' '.join(corner % ((v + 1, v + 1) if uv else (v + 1,)) for v in face))
    return '\n'.join(lines) + '\n'


def read_obj(path):
    """Returns v, vt, faces of v numbers, faces of vt numbers; 0-based."""
    v, vt, faces, texture = [], [], [], []
    with open(path) as f:
        for line in f:
            words = line.split()
            if not words:
                continue
            if words[0] == 'v':
                v.append(tuple(map(float, words[1:4])))
            elif words[0] == 'vt':
                vt.append(tuple(map(float, words[1:3])))
            elif words[0] == 'f':
                corners = [w.split('/') for w in words[1:]]
                faces.append(tuple(int(c[0]) - 1 for c in corners))
                texture.append(tuple(int(c[1]) - 1 for c in corners if len(c) > 1 and c[1]))
    return v, vt, faces, texture


# ------------------------------------------------------------------ VTU as majorant writes it
_FORMATS = {'Float64': 'd', 'Int32': 'i', 'Int64': 'q', 'UInt8': 'B'}


class Vtu:
    """The arrays of a file by name, as flat lists, which can be changed and written again."""

    def __init__(self, path):
        with open(path) as f:
            self.text = f.read()
        self.types, self.components, self.arrays = {}, {}, {}
        for match in re.finditer(r'<DataArray type="(\w+)" Name="(\w+)" NumberOfComponents="(\d+)" '
                                 r'format="binary">\n(.*?)\n</DataArray>', self.text, re.S):
            kind, name, components, payload = match.groups()
            raw = base64.b64decode(payload)
            size = struct.unpack('<Q', raw[:8])[0]
            assert size == len(raw) - 8
            count = size // struct.calcsize(_FORMATS[kind])
            self.types[name], self.components[name] = kind, int(components)
            self.arrays[name] = list(struct.unpack('<%d%s' % (count, _FORMATS[kind]), raw[8:]))
        found = re.search(r'Name="majorant_claims"[^>]*>\n(.*?)\n</DataArray>', self.text, re.S)
        self.claims = json.loads(bytes(map(int, found.group(1).split())).decode()) if found else None

    def rows(self, name):
        a, k = self.arrays[name], self.components[name]
        return [tuple(a[i:i + k]) for i in range(0, len(a), k)]

    def cells(self):
        ends = [0] + self.arrays['offsets']
        return [self.arrays['connectivity'][a:b] for a, b in zip(ends, ends[1:])]

    def write(self, path):
        text = self.text
        for name, values in self.arrays.items():
            data = struct.pack('<%d%s' % (len(values), _FORMATS[self.types[name]]), *values)
            payload = base64.b64encode(struct.pack('<Q', len(data)) + data).decode()
            text = re.sub(r'(Name="%s" NumberOfComponents="\d+" format="binary">\n).*?(\n</DataArray>)'
                          % name, lambda m: m.group(1) + payload + m.group(2), text, flags=re.S)
        claims = ' '.join(map(str, json.dumps(self.claims).encode()))
        text = re.sub(r'(Name="majorant_claims"[^>]*>\n).*?(\n</DataArray>)',
                      lambda m: m.group(1) + claims + m.group(2), text, flags=re.S)
        text = re.sub(r'NumberOfPoints="\d+"', 'NumberOfPoints="%d"' % len(self.rows('uv')), text)
        with open(path, 'w') as f:
            f.write(text)
        return path


def main():
    if not os.path.exists(BINARY):
        sys.exit('set MAJORANT_BINARY to the majorant command (have %r)' % BINARY)
    unittest.main()
