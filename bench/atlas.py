#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""majorant unwrap on the public meshes: one row a file, judged by programs that share no code with it.

Each run is `majorant unwrap IN -o OUT.obj --report`, one thread. Then `layout.py --overlap` of SHARED judges OUT.obj
(with --same-faces if no face was turned, else with as many faces), and `majorant check OUT.obj --certify`. Charts and
components are counted here, too, from the indices of the written file. Seconds are CPU seconds. A file that is
refused as unreadable (exit 2) has no more columns. Exit code 0 exactly if every file ends with 0, 2 or 4, every
layout is judged good and, without --flags, all LIMITS are kept.

Sample runs:
  bench/atlas.py --json /tmp/atlas.json                                # everything, two at a time
  bench/atlas.py --json /tmp/atlas.json --resume                       # only what the file lacks
  bench/atlas.py 'closed/*' 'messy/real/*uv*' --flags='--seams uv'      # other files, other options
  bench/atlas.py --render /tmp/atlas.json                              # only the tables
"""
import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
import threading
from collections import Counter, defaultdict
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path

import common

PATTERNS = ('messy/derived/*.*', 'messy/real/*.*', 'closed/*', 'disks/*_500.obj', 'disks/*_2500.obj',
            'bad/*')
MESHES = ('.obj', '.off', '.ply', '.stl', '.vtu', '.gz')
HEADER = ('file', 'exit', 'repairs', 'charts', 'seam', 'added', 'E', 'stretch', 'fill', 'packed by',
          's', 'judged')
LIMITS = 'at most 2 + faces / 200 charts a component, no chart of one face in a larger one'


# ------------------------------------------------------------------ counts from the written file
class Sets:
    """Disjoint sets with union and find."""

    def __init__(self, count):
        self.parent = list(range(count))

    def find(self, a):
        while self.parent[a] != a:
            self.parent[a] = a = self.parent[self.parent[a]]
        return a

    def join(self, a, b):
        self.parent[self.find(a)] = self.find(b)


def read_faces(path):
    """Returns (places, faces): the position of each v, and faces as lists of (v, vt), 0-based."""
    places, faces = [], []
    with open(path, errors='replace') as f:
        for line in f:
            words = line.split()
            if words[:1] == ['v']:
                places.append(tuple(words[1:4]))
            elif words[:1] == ['f']:
                faces.append([tuple(int(i) - 1 for i in w.split('/')[:2]) for w in words[1:]])
    return places, faces


def joined_faces(ends_of_faces, most=None):
    """Returns the set of every face. Faces are joined across ends that at most `most` faces have."""
    sets, sharing = Sets(len(ends_of_faces)), defaultdict(list)
    for k, ends in enumerate(ends_of_faces):
        for end in ends:
            sharing[end].append(k)
    for faces in sharing.values():
        if most is None or len(faces) <= most:
            for k in faces[1:]:
                sets.join(faces[0], k)
    return [sets.find(k) for k in range(len(ends_of_faces))]


def sides(corners):
    return [tuple(sorted((corners[i - 1], corners[i]))) for i in range(len(corners))]


def count_charts(path):
    """Returns (charts, [charts of every component], one-face charts in larger components).

    Components are connected across edges of two faces. If no face of a file shares a vertex, edges are
    compared by position.
    """
    places, faces = read_faces(path)
    corners = [[v for v, _ in face] for face in faces]
    if max(Counter(v for face in corners for v in set(face)).values()) == 1:
        corners = [[places[v] for v in face] for face in corners]
    component = joined_faces([sides(face) for face in corners], most=2)
    chart = joined_faces([{vt for _, vt in face} for face in faces])
    sizes, large = Counter(chart), Counter(component)
    in_component = defaultdict(set)
    for k in range(len(faces)):
        in_component[component[k]].add(chart[k])
    alone = sum(sizes[chart[k]] == 1 and large[component[k]] > 1 for k in range(len(faces)))
    too_many = sum(len(charts) > 2 + large[c] / 200 for c, charts in in_component.items())
    return {'charts': len(sizes), 'median_charts': statistics.median(map(len, in_component.values())),
            'single_faces': alone, 'too_many_charts': too_many}


# ------------------------------------------------------------------ one run
def run_measured(command, timeout):
    """Runs a command like common.run, but .seconds are CPU seconds, since other programs may be running."""
    with tempfile.TemporaryFile('w+', errors='replace') as err:
        process = subprocess.Popen([str(word) for word in command], stdin=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, stderr=err)
        killer = threading.Timer(timeout, process.kill)
        killer.start()
        _, status, used = os.wait4(process.pid, 0)
        killer.cancel()
        process.returncode = os.waitstatus_to_exitcode(status)
        err.seek(0)
        return common.Finished(process.returncode, '', err.read(), used.ru_utime + used.ru_stime)


def judge(options, mesh, out, turned):
    """Returns the defects that independent judges find in the written file."""
    flags = ['--overlap']
    if mesh.suffix == '.obj':
        flags += ['--input', mesh] + ([] if turned else ['--same-faces'])
    layout = common.run([common.PYTHON, options.shared / 'tools/layout.py', out, *flags],
                        options.timeout)
    last = (layout.stdout.strip() or layout.stderr.strip() or 'layout.py: no answer').splitlines()[-1]
    problems = [] if last.startswith('ok') else [last]
    check = common.run([options.binary, 'check', out, '--certify', '--quiet'],
                       options.timeout)
    if check.code:
        problems.append('check: exit %s %s' % (check.code, check.stderr.strip()[:200]))
    return problems


def execute(options, mesh, folder):
    """Runs and judges one file. Returns its entry of the results file."""
    name = str(mesh.relative_to(options.shared / 'data/public'))
    stem = Path(folder) / name.replace('/', '_')
    out, report_path = Path('%s.out.obj' % stem), Path('%s.json' % stem)
    for old in (out, report_path):
        old.unlink(missing_ok=True)
    done = run_measured([options.binary, 'unwrap', mesh, '-o', out, '--report', report_path,
                         '--threads', '1', '--quiet', *options.flags.split()], options.timeout)
    entry = {'file': name, 'exit': done.code, 'seconds': done.seconds, 'problems': []}
    if done.code not in (0, 2, 4):
        entry['problems'].append('exit %s: %s' % (done.code, done.stderr.strip()[-300:]))
    if done.code not in (0, 4):
        return {**entry, 'message': done.stderr.strip()}
    report, problem = common.load_report(report_path)
    entry['problems'] += [problem] if problem else []
    entry['repairs'] = {r['kind']: r['count'] for r in report.get('repairs', [])}
    entry['result'] = report.get('result')
    entry['not_converged'] = [c['status'] for c in report.get('charts', ()) if c['status'] != 'converged']
    if out.exists():
        turned = 'turned_face' in entry['repairs']
        entry['problems'] += judge(options, mesh, out, turned)
        entry.update(count_charts(out))
        if not options.flags:  # --flags may set --seams
            entry['problems'] += limits_passed(entry, len(read_faces(out)[1]), mesh)
    return entry


def limits_passed(entry, faces, mesh):
    problems = []
    if entry['charts'] != entry['result']['charts']:
        problems.append('%d charts in the file' % entry['charts'])
    if entry['too_many_charts']:
        problems.append('%d components of too many charts' % entry['too_many_charts'])
    if entry['single_faces']:
        problems.append('%d charts of one face' % entry['single_faces'])
    if mesh.suffix == '.obj' and len(read_faces(mesh)[1]) != faces:
        problems.append('%d faces' % faces)
    return problems


# ------------------------------------------------------------------ all runs
def run_all(options, meshes, entries):
    with tempfile.TemporaryDirectory(prefix='majorant_atlas_') as temporary:
        folder = options.out or temporary
        os.makedirs(folder, exist_ok=True)
        pool = ThreadPoolExecutor(options.jobs)
        waiting = [pool.submit(execute, options, mesh, folder) for mesh in meshes]
        try:
            for done in as_completed(waiting):
                entry = done.result()
                entries[entry['file']] = entry
                sys.stderr.write('%s: exit %s, %.1f s, %s\n' % (
                    entry['file'], entry['exit'], entry['seconds'],
                    '; '.join(entry['problems']) or 'ok'))
                if options.json:
                    options.json.write_text(json.dumps(entries, indent=1) + '\n')
        finally:
            pool.shutdown(cancel_futures=True)


def row(entry):
    result = entry.get('result') or {}
    cells = [entry['file'].rsplit('/', 1)[1], entry['exit']]
    if not result:
        return cells + ['-'] * 8 + ['%.1f' % entry['seconds'], '; '.join(entry['problems']) or '-']
    repairs = ', '.join('%s %d' % (kind.replace('_', ' '), n) for kind, n in entry['repairs'].items())
    return cells + [repairs or '-', result['charts'], '%.2f' % result['seam_length_relative'],
                    result['added_seam_edges'] or '-', '%.4f' % result['value'],
                    '%.3f' % result['stretch_l2'], common.cell(result.get('fill'), '%.2f'),
                    result.get('packing', '-'), '%.1f' % entry['seconds'],
                    '; '.join(entry['problems']) or 'ok']


def show(entries):
    """Prints a table for each folder and a summary. Returns the exit code."""
    folders = defaultdict(list)
    for name in sorted(entries):
        folders[name.rsplit('/', 1)[0]].append(entries[name])
    for folder, rows in folders.items():
        print('\n**%s**\n' % folder)
        print('\n'.join(common.markdown_table(HEADER, map(row, rows))))
    mapped = [e for e in entries.values() if e.get('result')]
    bad = [e for e in entries.values() if e['problems']]
    print('\n%d files: %d mapped, %d of them with a chart that did not converge; %d unreadable; '
          '%d with problems.' % (len(entries), len(mapped), sum(bool(e['not_converged']) for e in mapped),
                                 sum(e['exit'] == 2 for e in entries.values()), len(bad)))
    print('Charts a component, median over files: %g. Limits: %s; passed by %d files.' % (
        statistics.median(e['median_charts'] for e in mapped), LIMITS,
        sum(bool(e['too_many_charts'] or e['single_faces']) for e in mapped)))
    closed = [e['result']['value'] for e in mapped if e['file'].startswith('closed/')]
    if closed:
        print('Energy over closed/, median: %.4f.' % statistics.median(closed))
    return 1 if bad else 0


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    common.add_options(parser)
    parser.add_argument('patterns', nargs='*', default=list(PATTERNS), help='below SHARED/data/public')
    parser.add_argument('--flags', default='', help='more options of unwrap, in one word')
    parser.add_argument('--jobs', type=int, default=2, help='runs at the same time, one thread each')
    parser.add_argument('--out', type=Path, help='keep all files in this folder')
    parser.add_argument('--json', type=Path, help='results file, written after every run')
    parser.add_argument('--resume', action='store_true', help='skip what the results file has')
    parser.add_argument('--render', type=Path, metavar='FILE.json', help='only print a results file')
    return parser.parse_args()


def main():
    options = parse_arguments()
    if options.render:
        return show(common.load_strict(options.render))
    common.require_files(options)
    entries = common.load_strict(options.json) if options.resume and options.json.exists() else {}
    public = options.shared / 'data/public'
    meshes = [path for pattern in options.patterns for path in sorted(public.glob(pattern))
              if path.suffix in MESHES and str(path.relative_to(public)) not in entries]
    try:
        run_all(options, meshes, entries)
    except KeyboardInterrupt:
        sys.exit('interrupted')
    return show(entries)


if __name__ == '__main__':
    sys.exit(main())
