#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Unwraps files of other authors, and counts how many of those that a plain reader accepts are written.

    tests/campaigns/real_files.py build/release/apps/majorant FOLDER [--every K] [--judge FACES]

FOLDER holds meshes of any repositories, in a folder for each: .obj, .off, .ply, .stl, .glb, .gltf. A file
counts if the reader of this script accepts it, which shares no code with the program: at least one face, all
indices in range, all positions finite, and no unknown required extension. Every file is unwrapped with
default options, glTF to .glb and .obj, the others to .obj. Layouts of up to FACES (3,000) faces are judged
exactly by SHARED's layout.py (turned triangles, overlaps). Prints one row per kind. Exit code 1 if more than
0.5 % of the files do not end with 0, a layout is bad, or a chart is above the stretch limit.
"""
import argparse
import json
import math
import os
import statistics
import struct
import subprocess
import sys
import tempfile
from collections import defaultdict
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[2] / 'bench'))
import common  # noqa: E402

KINDS = ('.obj', '.off', '.ply', '.stl', '.glb', '.gltf')
# Extensions of glTF that do not affect positions and faces.
HARMLESS = ('KHR_materials', 'KHR_texture', 'KHR_lights', 'EXT_texture', 'KHR_animation', 'KHR_mesh_quantization')
LIMIT = 1.015
LONGEST = 300  # CPU seconds


# ------------------------------------------------------------------ a plain reader
def is_sound(points, faces):
    """Returns whether the mesh has faces, and all of their vertices exist and are finite."""
    used = [v for face in faces for v in face]
    return bool(used) and 0 <= min(used) and max(used) < len(points) and all(
        math.isfinite(x) for p in points for x in p)


def read_obj(data):
    points, faces = [], []
    for line in data.decode(errors='replace').splitlines():
        words = line.split()
        if words[:1] == ['v']:
            points.append(tuple(map(float, words[1:4])))
        elif words[:1] == ['f'] and len(words) > 3:
            numbers = [int(word.split('/')[0]) for word in words[1:]]
            faces.append([n - 1 if n > 0 else len(points) + n for n in numbers])
    return points, faces


def read_off(data):
    lines = [line.split('#')[0].split() for line in data.decode(errors='replace').splitlines()]
    lines = [words for words in lines if words]
    if lines[0][0] != 'OFF':
        raise ValueError('no OFF')
    lines[0] = lines[0][1:]
    rows = [words for words in lines if words]
    vertices, faces = map(int, rows[0][:2])
    points = [tuple(map(float, words[:3])) for words in rows[1:1 + vertices]]
    cells = [list(map(int, words[1:1 + int(words[0])])) for words in rows[1 + vertices:1 + vertices + faces]]
    if len(cells) < faces:
        raise ValueError('truncated')
    return points, cells


SIZES = {name: code for names, code in (('char int8', 'b'), ('uchar uint8', 'B'), ('short int16', 'h'),
                                        ('ushort uint16', 'H'), ('int int32', 'i'), ('uint uint32', 'I'),
                                        ('float float32', 'f'), ('double float64', 'd')) for name in names.split()}


def read_ply(data):
    end = data.index(b'end_header')
    header, body = data[:end].decode().splitlines(), data[data.index(b'\n', end) + 1:]
    elements, form = [], 'ascii'
    for line in header:
        words = line.split()
        if words[:1] == ['format']:
            form = words[1]
        elif words[:1] == ['element']:
            elements.append((words[1], int(words[2]), []))
        elif words[:1] == ['property']:
            elements[-1][2].append(words[1:])
    if form == 'ascii':
        words = iter(body.split())

        def take(kind):
            word = float(next(words))
            return word if kind[0] in 'fd' else int(word)
    else:
        order, at = '<' if 'little' in form else '>', [0]

        def take(kind):
            code = order + SIZES[kind]
            value, = struct.unpack_from(code, body, at[0])
            at[0] += struct.calcsize(code)
            return value
    points, faces = [], []
    for name, count, properties in elements:
        for _ in range(count):
            row = {}
            for p in properties:
                row[p[-1]] = [take(p[2]) for _ in range(take(p[1]))] if p[0] == 'list' else take(p[0])
            if name == 'vertex':
                points.append((row['x'], row['y'], row['z']))
            elif name == 'face':
                faces.append(next(v for k, v in row.items() if k.startswith('vertex_ind')))
    return points, faces


def read_stl(data):
    if len(data) >= 84 and len(data) == 84 + 50 * struct.unpack_from('<I', data, 80)[0]:
        corners = [struct.unpack_from('<9f', data, 96 + 50 * k) for k in range((len(data) - 84) // 50)]
        points = [c[i:i + 3] for c in corners for i in (0, 3, 6)]
    else:
        words = [line.split() for line in data.decode(errors='replace').splitlines()]
        points = [tuple(map(float, w[1:4])) for w in words if w[:1] == ['vertex']]
    return points, [(k, k + 1, k + 2) for k in range(0, len(points) - 2, 3)]


def read_gltf(path, data):
    binary = b''
    if data[:4] == b'glTF':
        length, = struct.unpack_from('<I', data, 12)
        binary = data[20 + length + 8:]
        data = data[20:20 + length]
    model = json.loads(data)
    if any(not name.startswith(HARMLESS) for name in model.get('extensionsRequired', [])):
        raise ValueError('extension')
    for b in model.get('buffers', []):
        uri = b.get('uri', 'data:').replace('%20', ' ')
        if not uri.startswith('data:') and not (path.parent / uri).exists():
            raise ValueError('buffer')
    if 'meshes' not in model or not model.get('scenes'):
        raise ValueError('no mesh is shown')
    shown = [p for mesh in model['meshes'] for p in mesh['primitives'] if p.get('mode', 4) in (4, 5, 6)]
    count = sum(model['accessors'][p['attributes']['POSITION']]['count'] for p in shown)
    if count < 3 or len(binary) < (3 if data[:4] == b'glTF' else 0):
        raise ValueError('no faces')


def is_accepted(path):
    """Returns whether the plain reader accepts the file."""
    data = path.read_bytes()
    try:
        if path.suffix.lower() in ('.glb', '.gltf'):
            read_gltf(path, data)
            return True
        read = {'.obj': read_obj, '.off': read_off, '.ply': read_ply, '.stl': read_stl}[path.suffix.lower()]
        return is_sound(*read(data))
    except (ValueError, KeyError, IndexError, StopIteration, RuntimeError, struct.error):
        return False


# ------------------------------------------------------------------ one run
def run(binary, path, folder, options):
    """Returns the entry of a file: exit code, defects, and figures of the report."""
    outputs = [Path(folder, 'out.obj')]
    if path.suffix.lower() in ('.glb', '.gltf'):
        outputs.append(Path(folder, 'out.glb'))
    for old in Path(folder).iterdir():
        old.unlink()
    words = [word for out in outputs for word in ('-o', out)]
    process = subprocess.Popen(['sh', '-c', 'ulimit -t %d; exec "$@"' % LONGEST, 'sh', binary, 'unwrap', path, *words,
                                '--report', Path(folder, 'r.json'), '--threads', '1', '--quiet'],
                               stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                               errors='replace')
    printed = process.stderr.read()
    _, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    entry = {'exit': process.returncode, 'seconds': used.ru_utime + used.ru_stime, 'bad': '',
             'said': printed.strip()[-300:]}
    if entry['exit'] not in (0, 4):
        return entry
    report = json.loads(Path(folder, 'r.json').read_text())
    result = report['result']
    worst = max(c['stretch_l2'] for c in report['charts'])
    entry.update(charts=result['charts'], fill=result['fill'], seam=result['seam_length_relative'],
                 l2=result['stretch_l2'], faces=report['input']['faces'], worst=worst)
    if entry['faces'] <= options.judge:
        layout = common.run([common.PYTHON, options.shared / 'tools/layout.py', outputs[0], '--overlap', '--unit'], 600)
        last = (layout.stdout.strip() or 'no answer').splitlines()[-1]
        entry['judged'] = True
        if not last.startswith('ok'):
            entry['bad'] = last
    return entry


# ------------------------------------------------------------------ all of them
HEADER = ('kind', 'files', 'accepted', 'exit 0', '4', 'others', 'judged', 'bad', 'above the limit', 'fill >= 0.4',
          'fill', 'charts', 'seam', 'L2', 's, median / sum')


def row(name, files, entries):
    done = [e for e in entries if e['exit'] in (0, 4)]

    def median(key):
        return statistics.median(e[key] for e in done) if done else math.nan
    others = defaultdict(int)
    for e in entries:
        if e['exit'] not in (0, 4):
            others[e['exit']] += 1
    filled = sum(e['fill'] >= 0.4 for e in done)
    return [name, files, len(entries), sum(e['exit'] == 0 for e in entries), sum(e['exit'] == 4 for e in entries),
            ', '.join('%d: %d' % pair for pair in sorted(others.items())) or '-', sum('judged' in e for e in done),
            sum(bool(e['bad']) for e in done), sum(e['worst'] > LIMIT for e in done),
            '%.1f %%' % (100 * filled / max(1, len(done))), '%.2f' % median('fill'), '%g' % median('charts'),
            '%.2f' % median('seam'), '%.4f' % median('l2'),
            '%.2f / %.0f' % (statistics.median(e['seconds'] for e in entries), sum(e['seconds'] for e in entries))]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('binary')
    parser.add_argument('folder', type=Path)
    parser.add_argument('--every', type=int, default=1)
    parser.add_argument('--judge', type=int, default=3000, help='largest number of faces of layouts that are judged')
    parser.add_argument('--json', type=Path, help='results, written after every run; files with a result are not run again')
    parser.add_argument('--shared', type=Path, default=Path(__file__).resolve().parents[3] / 'shared',
                        help='folder with tools/')
    options = parser.parse_args()
    files = sorted(p for p in options.folder.rglob('*') if p.suffix.lower() in KINDS)[::options.every]
    accepted = [p for p in files if is_accepted(p)]
    results = json.loads(options.json.read_text()) if options.json and options.json.exists() else {}
    with tempfile.TemporaryDirectory(prefix='majorant_real_') as folder:
        for path in accepted:
            name = str(path.relative_to(options.folder))
            if name not in results:
                results[name] = run(options.binary, path, folder, options)
                e = results[name]
                sys.stderr.write('%s: exit %d, %.1f s %s\n' % (name, e['exit'], e['seconds'],
                                                              e['bad'] or (e['said'] if e['exit'] else '')))
                if options.json:
                    options.json.write_text(json.dumps(results, indent=1) + '\n')
    entries = [results[str(p.relative_to(options.folder))] for p in accepted]
    rows = []
    for kind in KINDS:
        of_kind = [results[str(p.relative_to(options.folder))] for p in accepted if p.suffix.lower() == kind]
        if of_kind:
            rows.append(row(kind, sum(p.suffix.lower() == kind for p in files), of_kind))
    rows.append(row('all', len(files), entries))
    print('\n'.join(common.markdown_table(HEADER, rows)))
    folders = {p.relative_to(options.folder).parts[0] for p in accepted}
    lost = sum(e['exit'] != 0 for e in entries)
    print('\n%d files of %d folders; %d lost.' % (len(entries), len(folders), lost))
    return int(200 * lost > len(entries) or any(e['bad'] or e.get('worst', 0) > LIMIT for e in entries))


if __name__ == '__main__':
    sys.exit(main())
