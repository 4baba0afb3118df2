# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Damages files: text, bytes, JSON, and the arrays, claims and attributes of VTU files.

A damage is a function (bytes, random.Random) -> bytes. Most of them keep the structure of the file, since
readers refuse other files by their first lines. `damages(kind)` returns those for a kind of file.

Sample runs:
  /usr/bin/python3 -c 'import damage; print(damage.damages("PLY binary"))'     (imported, not run)
"""
import base64
import json
import math
import re
import struct

NUMBERS = ['nan', 'inf', '-inf', '1e308', '-1e308', '1e-308', '1e400', '0', '-0', '-1', '0.5', '1e9', '2147483647',
           '2147483648', '-2147483648', '4294967296', '9223372036854775808', '1e20', '1e150', '']
VALUES = [None, True, False, 'text', '', [], {}, [[]], -1, 0, 1.5, 1e20, 1e308, 2**31, 2**63, 2**64, [0], [0, 'x'],
          {'vertex': -1}, {'vertex': 0, 'target': [0, 0]}, {'origin': [0, 0], 'size': 0}]
# values that replace a number
FITTING = [False, True, 0, 1, 2, 3, 5, 15, 16, 2**31 - 1, 0.25, 1e-300, 1e300, -1.5]
CLAIMS = ['version', 'degree', 'energy', 'value', 'boundary', 'init', 'seams', 'bijective', 'normalized', 'pins',
          'other_triangles', 'cones', 'options']
DOUBLES = [math.nan, math.inf, -math.inf, 0.0, -0.0, 5e-324, 1e-308, -1e308, 1e308, 1e150, 1e-150, 1.0, -1.0, 2.0**53]
INTEGERS = [-2**63, -2**31, -1, 0, 1, 2, 3, 5, 69, 76, 2**31 - 1, 2**31, 2**32, 2**62, 2**63 - 1]
CODES = {'Float64': 'd', 'Float32': 'f', 'Int64': 'q', 'Int32': 'i', 'UInt8': 'B'}
ADDED = ['RationalWeights', 'HigherOrderDegrees', 'cone', 'seam_edges', 'min_det', 'distortion', 'input_vertex',
         'input_face', 'uv', 'other']
NUMBER = re.compile(rb'(?<![A-Za-z\d])[-+]?\d[-+.\deE]*')
ARRAY = re.compile(rb'(<DataArray type="(\w+)"[^>]*format="binary"[^>]*>\s*)([A-Za-z0-9+/=]+)(\s*</)')
SECTION = re.compile(rb'<(PointData|CellData|Points|Cells)[^>]*>\n')


# ------------------------------------------------------------------ text
def change_number(content, rng):
    places = list(NUMBER.finditer(content))
    if not places:
        return change_bytes(content, rng)
    at = rng.choice(places)
    return content[:at.start()] + rng.choice(NUMBERS).encode() + content[at.end():]


def copy_number(content, rng):
    """Replaces a number by another one of the file, which changes neighbours, positions or counts."""
    places = list(NUMBER.finditer(content))
    if not places:
        return change_bytes(content, rng)
    at, other = rng.choice(places), rng.choice(places)
    return content[:at.start()] + other.group() + content[at.end():]


def nudge_number(content, rng):
    """Changes a number by its last digit or by a few per cent."""
    places = list(NUMBER.finditer(content))
    if not places:
        return change_bytes(content, rng)
    at = rng.choice(places)
    word = at.group().decode()
    if word.lstrip('+-').isdigit():
        word = str(int(word) + rng.choice((-1, 1)))
    else:
        try:
            word = repr(float(word) * (1 + rng.choice((-1, 1)) * 2.0**-rng.randrange(1, 53)))
        except ValueError:                        # an earlier damage
            word += '0'
    return content[:at.start()] + word.encode() + content[at.end():]


def scale_numbers(content, rng):
    """Scales all decimal numbers up to or beyond the range of doubles, or down to a few digits."""
    if rng.random() < 0.3:
        return re.sub(rb'(\.\d)\d+', rb'\1', content)
    power = rng.choice((-320, -300, -160, -100, -20, 20, 100, 150, 160, 300, 308))
    return re.sub(rb'(?<!\d)\d+\.\d+(?![\de])', lambda m: m.group() + b'e%d' % power, content)


def change_lines(content, rng):
    lines = content.split(b'\n')
    at, other = rng.randrange(len(lines)), rng.randrange(len(lines))
    kind = rng.randrange(5)
    if kind == 0:
        del lines[at]
    elif kind == 1:
        lines.insert(other, lines[at])
    elif kind == 2:
        lines[at], lines[other] = lines[other], lines[at]
    elif kind == 3:
        lines[at] = lines[at] + b' ' + lines[other]
    else:
        words = lines[at].split(b' ')
        rng.shuffle(words)
        lines[at] = b' '.join(words)
    return b'\n'.join(lines)


# ------------------------------------------------------------------ bytes
def change_bytes(content, rng):
    data = bytearray(content)
    for _ in range(rng.choice((1, 1, 2, 8, 64)) if data else 0):
        data[rng.randrange(len(data))] = rng.randrange(256)
    return bytes(data)


def truncate(content, rng):
    return content[:rng.randrange(len(content) + 1)]


def repeat(content, rng):
    a, b = sorted(rng.randrange(len(content) + 1) for _ in range(2))
    return content[:b] + content[a:b] * rng.choice((1, 3, 100)) + content[b:]


def nest(content, rng):
    at = rng.randrange(len(content) + 1)
    return content[:at] + rng.choice((b'[', b'{"a":', b'<a>', b'(', b'- ')) * 100000 + content[at:]


def change_binary_number(content, rng):
    """Overwrites some aligned or unaligned bytes by an extreme float, double or integer."""
    code = rng.choice('fdi')
    size = struct.calcsize(code)
    if len(content) < size:
        return content
    at = rng.randrange(len(content) - size + 1)
    return content[:at] + struct.pack('<' + code, fitting(rng.choice(INTEGERS if code == 'i' else DOUBLES), code)) \
        + content[at + size:]


def fitting(value, code):
    """Returns a value that struct can pack with this code."""
    if code == 'd':
        return float(value)
    if code == 'f':
        return float(value) if abs(value) < 1e38 or not math.isfinite(value) else math.copysign(3e38, value)
    bits = 8 * struct.calcsize(code)
    value = int(value) if math.isfinite(value) else -1
    low = 0 if code == 'B' else -2**(bits - 1)
    return (value - low) % 2**bits + low


# ------------------------------------------------------------------ JSON
def change_document(document, rng):
    """Changes a value or a key of a JSON document."""
    root = {'': document}
    node, key = root, ''
    while isinstance(node[key], (dict, list)) and node[key] and rng.random() < 0.8:
        node = node[key]
        key = rng.choice(list(node) if isinstance(node, dict) else range(len(node)))
    if isinstance(node, dict) and node is not root and rng.random() < 0.1:
        node[str(key) + '_'] = node.pop(key)
    elif isinstance(node[key], (int, float)) and rng.random() < 0.6:
        node[key] = rng.choice(FITTING)
    else:
        node[key] = rng.choice(VALUES)
    return root['']


def change_json(content, rng):
    try:
        return json.dumps(change_document(json.loads(content), rng)).encode()
    except (ValueError, RecursionError):          # an earlier damage
        return change_bytes(content, rng)


def change_glb_json(content, rng):
    """Changes values of the JSON of a GLB; the lengths of chunks stay consistent."""
    try:
        size, = struct.unpack_from('<I', content, 12)
        document = json.loads(content[20:20 + size])
    except (ValueError, RecursionError, struct.error):
        return change_binary_number(content, rng)
    for _ in range(rng.choice((1, 1, 1, 2, 4))):
        document = change_document(document, rng)
    text = json.dumps(document).encode()
    text += b' ' * (-len(text) % 4)
    rest = content[20 + size:]
    return content[:8] + struct.pack('<III', 20 + len(text) + len(rest), len(text), 0x4E4F534A) + text + rest


# ------------------------------------------------------------------ VTU
def change_claims(content, rng):
    """Changes the claims, or adds some; the arrays stay valid."""
    pattern = re.compile(rb'(Name="majorant_claims"[^>]*>\n)([\d ]*)(\n</)')
    found = pattern.search(content)
    try:
        claims = json.loads(bytes(map(int, found.group(2).split())).rstrip(b'\0')) if found else {}
    except (ValueError, RecursionError):
        claims = {}
    if isinstance(claims, dict) and rng.random() < 0.4:
        claims[rng.choice(CLAIMS)] = rng.choice(VALUES)
    else:
        claims = change_document(claims, rng)
    text = json.dumps(claims).encode()
    if rng.random() < 0.05:
        text = nest(text, rng)
    codes = ' '.join(map(str, text)).encode()
    if found:
        return content[:found.start(2)] + codes + content[found.end(2):]
    field = b'<FieldData>\n<DataArray type="UInt8" Name="majorant_claims" format="ascii">\n' + codes \
        + b'\n</DataArray>\n</FieldData>\n<Piece'
    return content.replace(b'<Piece', field, 1)


def header_code(content):
    return '<Q' if b'header_type="UInt64"' in content else '<I'


def decoded(content, payload):
    """Returns the bytes of a base64 array and its header; empty if it is no base64."""
    try:
        data = base64.b64decode(payload)
    except ValueError:
        return b'', b''
    size = struct.calcsize(header_code(content))
    return data[:size], data[size:]


def with_array(content, at, header, data):
    return content[:at.start(3)] + base64.b64encode(header + data) + content[at.end(3):]


def some_array(content, rng):
    """Returns a match of ARRAY and the code of its numbers, or None."""
    arrays = [m for m in ARRAY.finditer(content) if m.group(2).decode() in CODES]
    required = rng.choice((b'Float', b'Float', b'Float', b'Int32', b''))   # points are more likely than cells
    arrays = [m for m in arrays if m.group(2).startswith(required)]
    at = rng.choice(arrays) if arrays else None
    return at, at and CODES[at.group(2).decode()]


def change_array_bytes(content, rng):
    """Changes bytes of one base64 array, its size included; the array stays base64."""
    at, _ = some_array(content, rng)
    header, data = decoded(content, at.group(3)) if at else (b'', b'')
    if not data:
        return change_number(content, rng)
    data = bytearray(header + data)
    for _ in range(rng.choice((1, 4, 32))):
        data[rng.randrange(len(data))] = rng.choice((0, 1, 0x7f, 0x80, 0xf0, 0xff, rng.randrange(256)))
    return with_array(content, at, b'', bytes(data))


def change_value(values, rng, code):
    """Replaces one value by its neighbour, another one of the array or an extreme one; or scales all."""
    kind, k = rng.randrange(6), rng.randrange(len(values))
    real = code in 'df'
    if kind == 0:
        values[k] = rng.choice(values)
    elif kind == 1:
        values[k] = values[k] * (1 + 2.0**-rng.randrange(1, 53)) if real else values[k] + rng.choice((-1, 1))
    elif kind == 2 and real:
        factor = rng.choice((-1, 0, 1e-300, 1e-20, 1e20, 1e150, 1e300))
        values[:] = [factor * v for v in values]
    elif kind == 3:
        j = rng.randrange(len(values))
        values[k], values[j] = values[j], values[k]
    elif kind == 4:
        values[k] = -values[k]
    else:
        values[k] = rng.choice(DOUBLES if real else INTEGERS)


def change_array_values(content, rng):
    """Changes values of one array, whose form stays valid."""
    at, code = some_array(content, rng)
    header, data = decoded(content, at.group(3)) if at else (b'', b'')
    size = struct.calcsize(code) if at else 1
    if len(data) < size or len(data) % size:
        return change_number(content, rng)
    values = list(struct.unpack('<%d%s' % (len(data) // size, code), data))
    for _ in range(rng.choice((1, 1, 2, 5))):
        change_value(values, rng, code)
    return with_array(content, at, header, struct.pack('<%d%s' % (len(values), code),
                                                       *(fitting(v, code) for v in values)))


def change_array_length(content, rng):
    """Makes one array shorter or longer, with the right size in its header."""
    at, code = some_array(content, rng)
    header, data = decoded(content, at.group(3)) if at else (b'', b'')
    if not data:
        return change_number(content, rng)
    size = struct.calcsize(code)
    cut = rng.randrange(len(data) // size + 1) * size
    data = data[:cut] if rng.random() < 0.5 else data + data[:cut]
    return with_array(content, at, struct.pack(header_code(content), len(data)), data)


def add_array(content, rng):
    """Adds an array of a known name with any numbers; readers may take the last one of a name."""
    sections = list(SECTION.finditer(content))
    counts = re.search(rb'NumberOfPoints="(\d+)" NumberOfCells="(\d+)"', content)
    if not sections or not counts:
        return change_number(content, rng)
    at, kind, width = rng.choice(sections), rng.choice(list(CODES)), rng.choice((1, 1, 2, 3))
    name = rng.choice(ADDED)
    count = int(counts.group(1 if at.group(1) == b'PointData' else 2))
    length = width * min(count, 1000) + rng.choice((0, 0, 0, -1, 1))
    pool = rng.choice(([1], [1], [0, 1, 2, 3], INTEGERS, DOUBLES if kind.startswith('Float') else INTEGERS))
    values = [fitting(rng.choice(pool), CODES[kind]) for _ in range(length)]
    text = '<DataArray type="%s" Name="%s" NumberOfComponents="%d" format="ascii">\n%s\n</DataArray>\n' \
        % (kind, name, width, ' '.join(map(repr, values)))
    role = b''
    if rng.random() < 0.2:                        # the section refers to the array
        role = b' %s="%s"' % (rng.choice((b'RationalWeights', b'HigherOrderDegrees', b'Scalars')), name.encode())
    opening = at.group().replace(b'>', role + b'>')
    return content[:at.start()] + opening + text.encode() + content[at.end():]


def change_attribute(content, rng):
    """Removes one attribute, or replaces its value by another's."""
    places = list(re.finditer(rb' (\w+)="([^"]*)"', content))
    if not places:
        return change_bytes(content, rng)
    at, other = rng.choice(places), rng.choice(places)
    new = rng.choice((b'', other.group(), b' %s="%s"' % (at.group(1), other.group(2)),
                      b' %s="%s"' % (at.group(1), rng.choice(NUMBERS).encode()),
                      b' %s="%s"' % (other.group(1), at.group(2))))
    return content[:at.start()] + new + content[at.end():]


def change_element(content, rng):
    """Removes an XML element, duplicates it, or moves it to the place of another."""
    places = list(re.finditer(rb'<(DataArray|PointData|CellData|Points|Cells|Piece)\b.*?</\1>\n', content, re.S))
    if not places:
        return change_bytes(content, rng)
    at, other = rng.choice(places), rng.choice(places)
    return content[:at.start()] + rng.choice((b'', 2 * at.group(), other.group())) + content[at.end():]


# ------------------------------------------------------------------ which fit
ANY = [change_bytes, truncate, repeat, nest]
TEXT = 2 * [change_number] + 6 * [copy_number, nudge_number] + 3 * [scale_numbers] + 2 * [change_lines]
VTU = 3 * [change_claims, add_array] + 8 * [change_array_values] \
    + [change_attribute, change_array_bytes, change_array_length, change_element, change_number, copy_number]


def damages(kind):
    """Returns the damages for a kind of file, some of them several times."""
    if 'GLB' in kind:
        return [change_bytes, truncate, repeat] + 2 * [change_binary_number] + 8 * [change_glb_json]
    if kind == 'PVTU':
        return ANY + 4 * [change_attribute, change_element]
    if 'VTU' in kind:
        return ANY + (VTU if 'ascii' not in kind else VTU + 6 * [nudge_number, copy_number])
    if 'binary' in kind:
        return [change_bytes, truncate, repeat] + 4 * [change_binary_number] \
            + (2 * [change_number, change_lines] if 'PLY' in kind else [])
    if 'JSON' in kind:
        return ANY + 8 * [change_json] + 2 * [change_number] + 4 * [copy_number, nudge_number]
    return ANY + TEXT


def damage(content, kind, rng):
    """Returns (damaged bytes, names of the damages): usually one damage."""
    names = []
    for _ in range(rng.choice((1, 1, 1, 1, 2, 3))):
        chosen = rng.choice(damages(kind))
        content = chosen(content, rng)
        names.append(chosen.__name__)
        if len(content) > 2**20:                  # large enough already
            break
    return content, names
