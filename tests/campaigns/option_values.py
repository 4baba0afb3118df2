#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Runs every numeric option of every verb with extreme values.

The options come from the help of each verb (N, X, K, W,H, X,Y,Z ...), so that new ones are included. Every
option gets every value of VALUES on a small mesh; then random sets of two to four options follow. A run must
end with exit code 0 to 5, within its time limit and ten seconds, and below 4 GB; a refusal is one line with
its reason.

Prints a Markdown table and each bad run; exit code 0 exactly if there is none.

Sample runs:
  tests/campaigns/option_values.py --sets 500
  tests/campaigns/option_values.py --verbs unwrap quads --sets 0
"""
import argparse
import collections
import json
import random
import re
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[2] / 'bench'))
import common  # noqa: E402

VALUES = ['0', '-1', '1', '3', '0.5', '1e-9', '1e9', '1e12', '1e300', '-1e300', '1e-300', 'nan', 'inf', '2147483648',
          '9223372036854775807', '1e19']
PLAUSIBLE = ['1', '2', '4', '16', '0.5', '100']
LIMIT, PATIENCE, MEMORY = 4, 10, 4 * 2**30        # seconds, seconds, bytes
OPTION = re.compile(r'^  (?:-\w, )?(--[\w-]+)[ =](\S+)', re.M)
NO_NUMBERS = ('FILE', 'EXT', 'SUM', 'OLD', 'TEXT', 'NAME', 'LIST')
# Other options without which an option has no effect.
BESIDE = {'--soft': ['--handles', 'handles.json'], '--grid': ['-o', 'o.svg'], '--snapshots': ['-o', 'o.html'],
          '--squares': ['--view', '0,0,1', '-o', 'o.png'], '--view': ['-o', 'o.png'], '--color-range': ['-o', 'o.svg'],
          '--size': ['-o', 'o.png'], '--refine': ['-o', 'o2.obj'], '--curvature-alignment': ['--start', 'field']}
BASES = {'parametrize': ['parametrize', 'patch.obj', '-o', 'o.vtu'], 'unwrap': ['unwrap', 'cube.obj', '-o', 'o.obj'],
         'seamless': ['seamless', 'cube.obj', '-o', 'o.vtu'],
         'deform': ['deform', 'patch.obj', '--handles', 'handles.json', '-o', 'o.vtu'],
         'check': ['check', 'patch.obj'], 'compare': ['compare', 'patch.obj', '-o', 'o.csv', '--methods', 'newton'],
         'convert': ['convert', 'patch.obj', '-o', 'o.vtu'],
         'bake': ['bake', 'patch.obj', '--from', 'patch.obj', '--attribute', 'position', '-o', 'o.npy'],
         'quads': ['quads', 'cube.obj', '-o', 'o.obj'], 'info': ['info', 'cube.obj'],
         'mesh check': ['mesh', 'check', 'cells.msh'],
         'mesh optimize': ['mesh', 'optimize', 'cells.msh', '-o', 'o.msh']}
Run = collections.namedtuple('Run', 'verb option code bad')


# ------------------------------------------------------------------ files
def write_files(folder):
    n = 4
    points = [(0.1 + 0.8 * i / n, 0.1 + 0.8 * j / n) for j in range(n + 1) for i in range(n + 1)]
    faces = [f for j in range(n) for i in range(n) for a in [j * (n + 1) + i]
             for f in ((a, a + 1, a + n + 2), (a, a + n + 2, a + n + 1))]
    lines = ['v %r %r 0' % p for p in points] + ['vt %r %r' % p for p in points]
    lines += ['f ' + ' '.join('%d/%d' % (v + 1, v + 1) for v in f) for f in faces]
    (folder / 'patch.obj').write_text('\n'.join(lines) + '\n')
    corners = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
    sides = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    (folder / 'cube.obj').write_text('usemtl a\n' + ''.join('v %d %d %d\n' % c for c in corners) + ''.join(
        'f %s\n' % ' '.join(str(v + 1) for v in s) for s in sides))
    (folder / 'handles.json').write_text(json.dumps({'handles': [{'vertex': 0, 'target': [0, 0]},
                                                                 {'vertex': 24, 'target': [1.2, 0.9]}]}))
    tetrahedra = [(0, 1, 3, 7), (0, 3, 2, 7), (0, 2, 6, 7), (0, 6, 4, 7), (0, 4, 5, 7), (0, 5, 1, 7)]
    msh = '$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n8\n%s$EndNodes\n$Elements\n6\n%s$EndElements\n'
    (folder / 'cells.msh').write_text(msh % (
        ''.join('%d %d %d %d\n' % (k + 1, *c) for k, c in enumerate(corners)),
        ''.join('%d 4 2 1 1 %s\n' % (k + 1, ' '.join(str(v + 1) for v in t)) for k, t in enumerate(tetrahedra))))


# ------------------------------------------------------------------ options
def help_of(binary, *words):
    return subprocess.run([binary, *words, '--help'], capture_output=True, text=True).stdout


def verbs(binary):
    """Returns the verbs in the help, with those of a group."""
    def listed(*words):
        parts = help_of(binary, *words).split('Verbs:\n')
        return re.findall(r'^  (\w+) ', parts[1].split('\n\n')[0], re.M) if len(parts) > 1 else []
    return [' '.join([verb, *inner]) for verb in listed() for inner in ([[w] for w in listed(verb)] or [[]])]


def numeric_options(binary, verb):
    """Returns [(option, template of its value with {} for each number)]."""
    found = []
    for option, kind in OPTION.findall(help_of(binary, *verb.split())):
        for choice in kind.strip('[]').split('|'):
            numbers = re.sub(r'\[(=.*)\]', r'\1', choice)
            word = re.fullmatch(r'(?:\w+=)?([A-Z]+)(?:,[A-Z])*', numbers)
            if word and word[1] not in NO_NUMBERS:
                found.append((option, re.sub(r'\b[A-Z]+\b', '{}', numbers)))
    return sorted(set(found))


# ------------------------------------------------------------------ runs
def limited():
    resource.setrlimit(resource.RLIMIT_DATA, (MEMORY, MEMORY))


def run(binary, words, folder, limit):
    """Returns (exit code or 'timeout', defect)."""
    for path in folder.glob('o*'):
        path.unlink()
    start = time.monotonic()
    try:
        done = subprocess.run([binary, *words], cwd=folder, capture_output=True, text=True, errors='replace',
                              timeout=8 * (limit + PATIENCE), stdin=subprocess.DEVNULL, preexec_fn=limited)
    except subprocess.TimeoutExpired:
        return 'timeout', 'no end within %d s' % (8 * (limit + PATIENCE))
    if done.returncode not in range(6):
        return done.returncode, 'exit %s: %s' % (done.returncode, done.stderr.strip()[-200:])
    lines = [line for line in done.stderr.splitlines() if line.startswith('majorant: ')]
    if done.returncode in (1, 2, 3) and len([line for line in lines if ' warning: ' not in line]) != 1:
        return done.returncode, 'no line says why: %s' % done.stderr.strip()[:200]
    return done.returncode, ''


def command(verb, chosen):
    """Returns the words of a command. chosen: [(option, value)]."""
    words, files = list(BASES[verb]), set()
    for option, value in chosen:
        words.append('%s=%s' % (option, value))
        words += [w for w in BESIDE.get(option, [])]
    if verb not in ('info', 'convert') and not any(o == '--time-limit' for o, _ in chosen):
        words += ['--time-limit', str(LIMIT)]
    # Duplicate outputs, and outputs of verbs without any, are left out.
    kept, k = [], 0
    while k < len(words):
        if words[k] in ('-o', '--handles', '--start') and words[k + 1] in files:
            k += 2
            continue
        if words[k] in ('-o', '--handles', '--start'):
            files.add(words[k + 1])
        kept.append(words[k])
        k += 1
    if verb == 'bake' and kept.count('-o') > 1:    # bake has one output
        at = kept.index('-o')
        del kept[at:at + 2]
        kept[kept.index('position')] = 'normal'
    return kept


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--binary', type=Path, default=common.DEFAULT_BINARY, help='the majorant program')
    parser.add_argument('--verbs', nargs='*', help='only these')
    parser.add_argument('--sets', type=int, default=300, help='random sets of options')
    parser.add_argument('--seed', type=int, default=1)
    options = parser.parse_args()
    binary, chance = options.binary.resolve(), random.Random(options.seed)
    known = {verb: numeric_options(binary, verb) for verb in verbs(binary)
             if not options.verbs or verb in options.verbs}
    missing = [verb for verb in known if verb not in BASES]
    if missing:
        sys.exit('no command for: %s' % ', '.join(missing))
    runs = []
    with tempfile.TemporaryDirectory(prefix='majorant_options_') as name:
        folder = Path(name)
        write_files(folder)
        todo = [(verb, [(option, form.replace('{}', value))]) for verb, found in known.items() for option, form in found
                for value in VALUES]
        todo += [(verb, [(option, form.replace('{}', value, 1).replace('{}', '1'))]) for verb, found in known.items()
                 for option, form in found if form.count('{}') > 1 for value in VALUES]
        for _ in range(options.sets):
            verb = chance.choice([v for v in known if known[v]] + ['unwrap'] * ('unwrap' in known) * 5)
            chosen = chance.sample(known[verb], min(len(known[verb]), chance.randint(2, 4)))
            todo.append((verb, [(o, re.sub(r'\{\}', lambda _: chance.choice(VALUES + 4 * PLAUSIBLE), form))
                                for o, form in chosen]))
        for verb, chosen in todo:
            words = command(verb, chosen)
            code, bad = run(binary, words, folder, LIMIT)
            runs.append(Run(verb, ' '.join(o for o, _ in chosen), code, bad))
            if bad:
                print('%s: %s' % (' '.join(words), bad), flush=True)
    codes = sorted({r.code for r in runs}, key=str)
    lines = common.markdown_table(['verb', 'options', 'runs', *('exit %s' % c for c in codes), 'bad'], [
        [verb, len({o for o, _ in known[verb]}), len(own), *(sum(r.code == c for r in own) for c in codes),
         sum(bool(r.bad) for r in own)]
        for verb in known for own in [[r for r in runs if r.verb == verb]]])
    print('\n'.join(lines))
    return 1 if any(r.bad for r in runs) else 0


if __name__ == '__main__':
    sys.exit(main())
