#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Damages files of every format and runs the command on them: it must refuse them or succeed, and never
crash.

Small meshes, maps and JSON files (mutation_seeds.py) are damaged in one way or more (damage.py), chosen with
a fixed seed; each damaged file is passed to one verb with options and small limits. A run is good if it ends
in time with an exit code 0 to 5, and no sanitizer reports an error. A sample (--judged) of the runs with exit
codes 0 and 4 is judged by tests/checker: their map files must be valid. Prints a Markdown table; exit code 0
exactly if no run was bad.

Sample runs:
  tests/campaigns/mutate.py --count 2000 --jobs 2
  tests/campaigns/mutate.py --binary build/asan/apps/majorant --keep findings
  tests/campaigns/mutate.py --first 1234 --count 1 --keep findings      (repeats one run)
"""
import argparse
import collections
import json
import os
import random
import re
import shutil
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[2] / 'bench'))
import common  # noqa: E402
import mutation_seeds  # noqa: E402
from damage import damage  # noqa: E402

FINDING = re.compile(r'Sanitizer|runtime error:')
CHECKER = common.ROOT / 'tests/checker/check_map.py'
# Relative numbers of damaged files of each kind.
SHARES = {'OBJ': 3, 'OFF': 1, 'PLY ascii': 2, 'PLY binary': 2, 'STL ascii': 1, 'STL binary': 1, 'VTU': 6,
          'VTU ascii': 2, 'VTU appended': 1, 'small map VTU': 5, 'small map OBJ': 2, 'pins JSON': 1,
          'handles JSON': 1, 'cones JSON': 1, 'weights': 1, 'GLB binary': 3, 'glTF JSON': 3, 'MSH map': 2,
          'volume MSH': 2, 'volume MSH binary': 2, 'volume MFEM': 3, 'volume Medit': 1, 'volume VTU ascii': 2,
          'OBJ with materials': 2, 'MTL': 1, 'NPY binary': 1, 'PVTU': 1, 'PNG binary': 1, 'JPEG binary': 1,
          'EXR binary': 1}
MORE = 4                                          # relative number of all files of --more
WITHOUT_MAPS = ('mesh', 'quads')                   # verbs whose VTU and OBJ files hold no map
LISTS = ('pins JSON', 'handles JSON', 'cones JSON', 'weights')
ENERGIES = ['symmetric-dirichlet', 'asap', 'mips', 'arap', 'symmetric-arap', 'log-isometric', 'authalic',
            'amips-exponential', 'symmetric-dirichlet + 0.1*asap']
CURVATURES = ['projected', 'majorizer', 'paper-majorizer', 'exact', 'reweighted']
# Limits of memory and threads; a failed allocation is an error of the program, as without a sanitizer.
SANITIZER = 'allocator_may_return_null=1:hard_rss_limit_mb=3000:detect_leaks=1'
ENVIRONMENT = dict(os.environ, OPENBLAS_NUM_THREADS='1', OMP_WAIT_POLICY='passive', ASAN_OPTIONS=SANITIZER,
                   UBSAN_OPTIONS='print_stacktrace=1')

# verdict: that of the checker, or None; bad: the defect, or ''
Outcome = collections.namedtuple('Outcome', 'kind verb code verdict bad')


# ------------------------------------------------------------------ runs
def some(rng, chance, words):
    return words if rng.random() < chance else []


def limits(rng):
    return ['--time-limit', '0.3', '--max-iterations', rng.choice('033339')]


def map_options(rng):
    """Returns options of the verbs that solve, and of compare."""
    return ['--degree', str(rng.choice((1, 1, 2, 3, 4)))] + some(rng, 0.4, ['--energy', rng.choice(ENERGIES)]) \
        + some(rng, 0.05, ['--quadrature', str(rng.choice((1, 3, 10)))]) + some(rng, 0.05, ['--boundary-angles']) \
        + some(rng, 0.1, ['--threads', '2'])


def solve_options(rng):
    """Returns options of the verbs that solve, including outputs."""
    words = map_options(rng) + limits(rng) + ['-o', 'OUT.' + rng.choice(('vtu', 'vtu', 'obj'))]
    words += some(rng, 0.1, ['-o', 'OUT2.obj']) + some(rng, 0.1, ['-o', 'OUT.svg'])
    words += some(rng, 0.1, ['-o', 'OUT.csv']) + some(rng, 0.3, ['--report', 'OUT.json'])
    words += some(rng, 0.1, ['--curvature', rng.choice(CURVATURES)]) + some(rng, 0.1, ['--elevation', 'direct'])
    words += with_format(words, '.obj', some(rng, 0.1, ['--refine', '3']))
    words += with_format(words, '.svg', some(rng, 0.3, ['--grid']))
    words += some(rng, 0.8, ['--quiet'])
    if rng.random() < 0.25:
        words += ['--bijective'] + some(rng, 0.2, ['--no-flips']) + some(rng, 0.2, ['--write-scaffold', 'OUT_s.vtu'])
    return words


def with_format(words, extension, option):
    """Returns an option for files of one format if there is such a file, since it would be refused otherwise."""
    return option if any(word.endswith(extension) for word in words) else []


def free_options(rng, words):
    """Returns options that do not combine with --write-scaffold, pins, handles or weights."""
    return [] if '--write-scaffold' in words else some(rng, 0.25, ['--normalize']) + some(rng, 0.15, ['--improve-mesh'])


def parametrize(rng, mesh):
    words = ['parametrize', mesh] + solve_options(rng) + some(rng, 0.2, ['--boundary', 'fixed'])
    words += some(rng, 0.4, ['--init', 'input'])
    return words + some(rng, 0.3 if 'input' in words else 0, ['--seamless'])


def seamless(rng, mesh):
    start = rng.choice(('automatic', 'field', 'scaled-field', 'conformal'))
    return ['seamless', mesh] + solve_options(rng) + some(rng, 0.3, ['--start', start]) \
        + some(rng, 0.1, ['--curvature-alignment', '10'])


def compare(rng, mesh):
    methods = rng.choice(('newton,lbfgs', 'newton-exact', 'ceres-lbfgs,gradient-flow'))
    return ['compare', mesh, '--methods', methods, '-o', 'OUT.' + rng.choice(('csv', 'html', 'json'))] \
        + map_options(rng) + limits(rng) + some(rng, 0.3, ['--init', 'input'])


def unwrap(rng, mesh):
    outputs = ['OUT.' + rng.choice(('obj', 'vtu', 'ply', 'glb', 'gltf'))] + some(rng, 0.2, ['OUT.png'])
    return ['unwrap', mesh] + limits(rng) + [word for path in outputs for word in ('-o', path)] \
        + some(rng, 0.2, ['--degree', '2']) + some(rng, 0.3, ['--seams', rng.choice(('sharp', 'uv'))]) \
        + some(rng, 0.2, ['--weld', 'no']) + some(rng, 0.1, ['--no-pack']) + some(rng, 0.3, ['--report', 'OUT.json'])


def unwrap_with_texture(rng, mesh):
    return ['unwrap', mesh, '--bake', '--resolution', '32', '-o', 'OUT.' + rng.choice(('obj', 'glb'))] + limits(rng)


def quads(rng, mesh):
    return ['quads', mesh, '-o', 'OUT.' + rng.choice(('obj', 'ply')), '--count', rng.choice(('6', '30')),
            '--time-limit', '0.3'] + some(rng, 0.3, ['--features', rng.choice(('none', '10', '170'))])


def bake(rng, layout, surface, image=None, rows=None):
    """Returns the words of a bake of an image, a table of numbers (rows) or an attribute of the surface."""
    attribute = rows or rng.choice(('position', 'normal', 'face', 'color', 'distortion', ''))
    what = ['--image', image] if image else ['--attribute', attribute] if attribute else []
    out = 'OUT.png' if image or not what else 'OUT.npy'
    return ['bake', layout, '--from', surface, *what, '-o', out, '--size', '16,16'] \
        + some(rng, 0.3, ['--method', rng.choice(('same', 'nearest'))]) + some(rng, 0.3, ['--report', 'OUT.json'])


def check(rng, result, surface):
    words = ['check', result, '--time-limit', '2'] + some(rng, 0.3, ['--certify']) + some(rng, 0.2, ['--seamless'])
    if surface and rng.random() < 0.6:
        words += ['--surface', surface] + some(rng, 0.4, ['--cuts', rng.choice(('auto', 'none', 'free'))])
    return words + some(rng, 0.5, ['--report', 'OUT.json'])


def convert(rng, result, _=None):
    outputs = rng.choice((['OUT.vtu'], ['OUT.obj'], ['OUT.svg'], ['OUT.vtu', 'OUT2.obj', 'OUT.svg']))
    spacing = some(rng, 0.5, [rng.choice(('0.25', '1e-3', '1e-9', '1e9'))])
    return ['convert', result] + [word for path in outputs for word in ('-o', path)] \
        + with_format(outputs, '.obj', some(rng, 0.4, ['--refine', '2'])) \
        + with_format(outputs, '.svg', some(rng, 0.4, ['--grid'] + spacing))


def with_list(rng, kind, good):
    """Returns a verb that reads a damaged file of pins, handles, cones or weights, with a valid mesh."""
    mesh = str(good / 'patch.obj')
    if kind == 'cones JSON':
        return ['seamless', str(good / 'closed.obj'), '--cones', '{}'] + solve_options(rng)
    option = {'pins JSON': '--pins', 'handles JSON': '--handles', 'weights': '--weights'}[kind]
    if kind != 'weights' and rng.random() < 0.3:
        return ['deform', str(good / 'flat.obj'), option, '{}'] + solve_options(rng)
    if rng.random() < 0.1:
        return compare(rng, mesh) + [option, '{}']
    soft = some(rng, 0.4, ['--soft', rng.choice(('1e-3', '1e9'))]) if option == '--handles' else []
    return parametrize(rng, mesh) + [option, '{}'] + soft


def on_map(rng, seed, good):
    """Returns a verb for a damaged map, or for a valid map of a damaged surface."""
    if 'map' not in seed.kind and 'VTU' not in seed.kind:
        return check(rng, str(good / 'map2.vtu'), '{}')
    surface = rng.choice((seed.surface and str(seed.surface), '{}'))
    return rng.choice((check, check, convert))(rng, '{}', surface)


def command(rng, seed, good):
    """Returns the possible runs with a file, as lists of words; {} is the file, OUT the start of an output's
    name."""
    if seed.kind in LISTS:
        return with_list(rng, seed.kind, good)
    textured = str(good / 'textured.obj')
    if seed.name.endswith(('.png', '.jpg', '.exr')):
        return bake(rng, textured, textured, '{}')
    if seed.kind == 'NPY binary':
        return bake(rng, textured, str(good / 'patch.obj'), rows='{}')
    if seed.kind == 'MTL':
        return rng.choice((unwrap_with_texture, lambda rng, mesh: bake(rng, textured, mesh)))(rng, 'BESIDE.obj')
    if seed.kind.startswith('volume') and rng.random() < 0.3:
        return ['mesh', 'optimize', '{}', '-o', 'OUT' + rng.choice(('.msh', Path(seed.name).suffix))] + limits(rng)
    if seed.kind.startswith('volume'):
        return ['mesh', 'check', '{}'] + some(rng, 0.3, ['--report', 'OUT.json'])
    is_map, is_closed = 'map' in seed.kind or 'VTU' in seed.kind, seed.name.startswith(('closed', 'annulus', 'seams'))
    verbs = {'map': 60 if is_map else 15, 'parametrize': 10 if is_closed else 45, 'seamless': 30 if is_closed else 15,
             'deform': 30 if seed.name.startswith('flat') else 1, 'info': 8, 'compare': 5,
             'convert': 10 if seed.name.endswith(('.obj', '.glb', '.gltf')) else 0, 'unwrap': 0 if is_map else 30,
             'bake': 10, 'quads': 0 if is_map else 10,
             'texture': 60 if 'materials' in seed.kind else 5 if 'GLB' in seed.kind else 0}
    verb = rng.choices(list(verbs), verbs.values())[0]
    if verb == 'map':
        return on_map(rng, seed, good)
    if verb == 'deform':
        return ['deform', '{}', '--handles', str(good / 'handles.json')] + solve_options(rng)
    if verb == 'info':
        return ['info', '{}'] + some(rng, 0.5, ['--report', 'OUT.json'])
    if verb == 'quads':
        return quads(rng, '{}')
    if verb == 'texture':
        return unwrap_with_texture(rng, '{}')
    if verb == 'bake':
        return bake(rng, *rng.choice((('{}', textured), (textured, '{}'), ('{}', '{}'))))
    words = {'parametrize': parametrize, 'seamless': seamless, 'compare': compare, 'convert': convert,
             'unwrap': unwrap}[verb](rng, '{}')
    return words + (free_options(rng, words) if verb in ('parametrize', 'seamless') else [])


# ------------------------------------------------------------------ judging
def checker_flags(words):
    """Returns the options of the checker for the map files of a run."""
    if words[0] == 'convert':                     # with the cuts of the converted map
        return ['--cuts', 'free']
    if words[0] == 'unwrap':
        return ['--cuts', 'free'] + ([] if '--no-pack' in words else ['--overlap', '--may-touch'])
    flags = ['--seamless'] if words[0] == 'seamless' or '--seamless' in words else []
    return flags + (['--overlap', '--may-touch'] if '--bijective' in words else [])


def judge(options, words, written):
    """Returns (verdict, defect) of the map files that a run wrote. Converted and unwrapped files keep the
    defects of their surfaces; for them only the map is judged."""
    verdict = None
    words_that_count = {'convert': {'positivity', 'continuity'},
                        'unwrap': {'positivity', 'continuity', 'overlap'}}.get(words[0])
    for path in written:
        done = common.run([common.PYTHON, CHECKER, path, '--json'] + checker_flags(words), options.timeout)
        text, _, last = done.stdout.strip().rpartition('\n')
        verdict = last.split()[0] if last else 'none'
        violations = {'unreadable': last or done.stderr[-200:]}
        if text.startswith('{'):
            violations = json.loads(text)['violations']
        if words_that_count:
            violations = {word: found for word, found in violations.items() if word in words_that_count}
        if violations:
            return verdict, '%s: %s' % (path.name, last)
    return verdict, ''


def keep(options, index, path, words, done, bad):
    """Keeps the files of a finding: the damaged file, the command and its output."""
    options.keep.mkdir(parents=True, exist_ok=True)
    shutil.copy(path, options.keep)
    (options.keep / ('%d.txt' % index)).write_text('%s\n%s\n%s\n%s' % (bad, ' '.join(words), done.stdout, done.stderr))


def one(options, kinds, index, work, good):
    """Damages one file and runs one verb. Returns the outcome."""
    rng = random.Random('%d %d' % (options.seed, index))
    shares = dict(SHARES, **{kind: MORE for kind in kinds if kind.startswith('more')})
    kind = rng.choices(list(shares), shares.values())[0]
    seed = rng.choice(kinds[kind])
    content, method = damage(seed.content, kind, rng)
    words = command(rng, seed, good)
    judged = rng.random() < options.judged
    folder = work / str(index)
    folder.mkdir()
    path = folder / ('%d_%s' % (index, seed.name))
    path.write_bytes(content)
    for name in seed.beside:
        shutil.copy(good / name, folder)
    if seed.kind == 'MTL':                        # by the name that the OBJ refers to
        path = path.rename(folder / seed.name)
    places = {'{}': str(path), 'BESIDE.obj': str(folder / 'painted.obj')}
    words = [places.get(w, str(folder / w) if w.startswith('OUT') else w) for w in words]
    done = common.run([options.binary.resolve()] + words, options.timeout, ENVIRONMENT)
    verdict, bad = None, ''
    if done.code not in range(6):
        bad = 'exit %s' % done.code
    elif FINDING.search(done.stderr):
        bad = 'sanitizer'
    elif judged and done.code in (0, 4) and words[0] not in WITHOUT_MAPS:
        verdict, bad = judge(options, words, sorted(p for p in folder.glob('OUT*') if p.suffix in ('.vtu', '.obj')
                                                    and not p.stem.endswith('_s')))
    if bad:
        if options.keep:
            keep(options, index, path, words, done, bad)
        print('%s: %d: %s (%s): %s\n  %s' % (bad, index, seed.name, ', '.join(method), ' '.join(words),
                                             done.stderr.strip()[:400]), flush=True)
    shutil.rmtree(folder)
    return Outcome(kind, words[0], done.code, verdict, bad)


# ------------------------------------------------------------------ table
def table(outcomes, key, header):
    """Returns rows by outcome.key: number of runs, and how they ended."""
    codes = sorted({o.code for o in outcomes}, key=str)
    count = collections.Counter()
    for o in outcomes:
        name = getattr(o, key)
        for column in [o.code, 'all'] + ['judged'] * bool(o.verdict) + ['bad'] * bool(o.bad):
            count[name, column] += 1
            count['all', column] += 1
    names = sorted({getattr(o, key) for o in outcomes}) + ['all']
    columns = ['all'] + codes + ['judged', 'bad']
    heads = [header, 'files'] + ['exit %s' % c for c in codes] + ['judged', 'bad']
    return common.markdown_table(heads, [[name] + [count[name, c] for c in columns] for name in names])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--binary', type=Path, default=common.DEFAULT_BINARY, help='the majorant program')
    parser.add_argument('--timeout', type=float, default=20, help='seconds a single process may take')
    parser.add_argument('--count', type=int, default=20000, help='damaged files')
    parser.add_argument('--first', type=int, default=0, help='number of the first one')
    parser.add_argument('--jobs', type=int, default=2, help='processes at a time')
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--judged', type=float, default=0.05, help='share of the written maps that are judged')
    parser.add_argument('--more', type=Path, help='folder of additional GLB files, for example compressed ones')
    parser.add_argument('--keep', type=Path, help='folder for the files of bad runs')
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix='majorant_mutate_') as name:
        good, work = Path(name) / 'good', Path(name) / 'work'
        good.mkdir()
        work.mkdir()
        kinds = mutation_seeds.seeds(options, good)
        numbers = range(options.first, options.first + options.count)
        with ThreadPoolExecutor(options.jobs) as pool:
            outcomes = list(pool.map(lambda k: one(options, kinds, k, work, good), numbers))
    print('\n'.join([''] + table(outcomes, 'kind', 'kind of file') + [''] + table(outcomes, 'verb', 'verb')))
    verdicts = collections.Counter(o.verdict for o in outcomes if o.verdict)
    print('\njudged: ' + (', '.join('%d %s' % (n, v) for v, n in sorted(verdicts.items())) or 'none'))
    sys.exit(any(o.bad for o in outcomes))


if __name__ == '__main__':
    main()
