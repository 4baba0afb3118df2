#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Acceptance of maps without overlaps: `parametrize --bijective` and `deform` on the public meshes.

  disks   SHARED/data/public/disks with --faces faces, degrees 1 to 3, with and without --bijective.
  deform  SHARED/data/public/deform2d: handles soft and hard, with and without --bijective.
  cost    seconds per iteration with a scaffold and without, on meshes of 10000 faces, degrees 1 and 3.

verify.py judges every result, with --require-global if the map must be injective. The program and verify.py must
agree on injectivity. Prints Markdown tables. Exit code 0 exactly if all of that holds, soft handles end within 1 %
of the mesh's size, and an iteration with a scaffold costs at most twice as much.

Sample runs:
  bench/bijective.py --json /tmp/bijective.json
  bench/bijective.py --parts disks --faces 2500 --meshes 'hand|plane' --degrees 1,3
  bench/bijective.py --parts deform,cost
  bench/bijective.py --render /tmp/bijective.json
"""
import argparse
import json
import re
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import common
from public_disks import comma_list, status_problems

PARTS = ('disks', 'deform', 'cost')
FLAGS = {'plain': [], 'bijective': ['--bijective']}
SOFT = 1e-2              # bound on the distance of soft handles, relative to the diagonal of the mesh
HARD = 1e-9              # bound on the distance of hard handles
COST = 2.0               # bound on the seconds of an iteration, relative to one without scaffold
COST_ITERATIONS = 12
COST_RUNS = 3            # repetitions, of which the fastest counts


# ------------------------------------------------------------------ one run
def summarize(done, report):
    """Returns the fields of an entry from the process and its report."""
    result = report.get('result') or {}
    lines = done.stderr.strip().splitlines()
    iterations = len(common.steps_taken(report))
    optimize = report.get('seconds', {}).get('optimize')
    flips = report.get('flips', {})
    return {'exit': done.code, 'status': report.get('status'), 'message': lines[-1] if lines else '',
            'value': result.get('value'), 'iterations': iterations, 'optimize': optimize,
            'total': report.get('seconds', {}).get('total'),
            'per_iteration': optimize / iterations if optimize and iterations else None,
            'intended': flips.get('intended'), 'performed': flips.get('performed'),
            'decrement': result.get('newton_decrement'),
            'own_injective': result.get('globally_injective')}


def examine(entry, checked, must_be_injective):
    """Adds the results of verify.py to the entry. Returns the complaints."""
    problems = ['verify: ' + name for name in common.failed_checks(checked)]
    whole = checked.get('global_injectivity', {})
    energy = checked.get('energy', {}).get('E_SD')
    injective = whole.get('globally_injective')
    entry.update(E=energy if isinstance(energy, float) else None, injective=injective,
                 crossings=whole.get('crossing_pairs'), contacts=whole.get('contact_pairs'),
                 off=checked.get('constraints', {}).get('max_residual'))
    if injective != entry['own_injective']:
        problems.append('globally injective: %s by verify.py, %s by the program'
                        % (injective, entry['own_injective']))
    if must_be_injective and injective is not True:
        problems.append('overlaps')
    return problems


def execute(options, verb, mesh, flags, fields, check=None):
    """Runs once and returns the entry with `problems`. check: constraints file and flags for verify.py; None if only
    the time is measured."""
    with tempfile.TemporaryDirectory(prefix='majorant_bijective_') as folder:
        result, report_path = Path(folder) / 'out.vtu', Path(folder) / 'report.json'
        done = common.parametrize(options, mesh, [result], *flags, '--report', report_path,
                                  '--threads', 1, verb=verb)
        report, problem = common.load_report(report_path)
        entry = {**fields, **summarize(done, report)}
        problems = [problem] if problem else []
        problems += status_problems(done.code, report.get('status'), result.exists())
        if check is not None and result.exists():
            constraints, words = check
            checked = common.verify(options, result, mesh, constraints, *words)
            problems += examine(entry, checked, fields['how'] == 'bijective')
        entry['problems'] = problems
    sys.stderr.write('%s %s %s %s: exit %s (%s), E %s, %s iterations, %s s, %s\n' % (
        fields['part'], fields['mesh'], fields['how'], fields['degree'], entry['exit'],
        entry['status'], common.cell(entry.get('E'), '%.6g'), entry['iterations'],
        common.cell(entry['total'], '%.1f'), '; '.join(entry['problems']) or 'ok'))
    return entry


# ------------------------------------------------------------------ disks and cost
def disk_meshes(options, faces):
    folder = options.shared / 'data/public/disks'
    return sorted(path for path in folder.glob('*_%d.obj' % faces)
                  if re.search(options.meshes, path.stem))


def run_disk(options, mesh, degree, method):
    # Boundary angles are required only of injective maps.
    words = ['--boundary-angles', '--require-global'] if method == 'bijective' else []
    fields = {'part': 'disks', 'mesh': mesh.stem, 'degree': degree, 'how': method}
    entry = execute(options, 'parametrize', mesh, ['--degree', degree, *FLAGS[method]], fields,
                    (None, words))
    if entry['exit'] not in (0, 4):
        entry['problems'].append('exit %s' % entry['exit'])
    return entry


def run_cost(options, mesh, degree, method):
    fields = {'part': 'cost', 'mesh': mesh.stem, 'degree': degree, 'how': method}
    # With incremental elevation, iterations would have different degrees.
    flags = ['--degree', degree, '--elevation', 'direct', '--max-iterations', COST_ITERATIONS]
    runs = [execute(options, 'parametrize', mesh, [*flags, *FLAGS[method]], fields)
            for _ in range(COST_RUNS)]
    return min(runs, key=lambda e: e['per_iteration'] or 0)


# ------------------------------------------------------------------ deformations
def diagonal(mesh):
    import numpy as np
    return float(np.linalg.norm(np.ptp(common.read_obj(mesh)[0], axis=0)))


def run_deform(options, mesh, degree, kind, method):
    file = mesh.with_suffix('.json')
    fields = {'part': 'deform', 'mesh': mesh.stem, 'degree': degree, 'kind': kind, 'how': method}
    with tempfile.TemporaryDirectory(prefix='majorant_targets_') as folder:
        targets = Path(folder) / 'targets.json'
        points = [{'vertex': h['vertex'], 'uv': h['target']}
                  for h in common.load_strict(file)['handles']]
        targets.write_text(json.dumps({'points': points}))
        words = ['--require-global'] if method == 'bijective' else []
        entry = execute(options, 'deform', mesh,
                        ['--handles' if kind == 'soft' else '--pins', file, '--degree', degree,
                         *FLAGS[method]], fields, (targets, words))
    off = entry.get('off')
    entry['off'] = off = off / diagonal(mesh) if off is not None else None
    if kind == 'soft':  # verify.py expects every point to be held exactly
        entry['problems'] = [p for p in entry['problems'] if p != 'verify: point_constraints']
    if off is not None and off > (SOFT if kind == 'soft' else HARD):
        entry['problems'].append('handles off by %.1e' % off)
    if entry['exit'] not in (0, 4):
        entry['problems'].append('exit %s' % entry['exit'])
    return entry


# ------------------------------------------------------------------ tables
def pairs(entries, *keys):
    """Yields the entries without and with --bijective for every combination of `keys`."""
    found = {}
    for e in entries:
        found.setdefault(tuple(e[k] for k in keys), {})[e['how']] = e
    return [(key, both['plain'], both['bijective']) for key, both in found.items() if len(both) == 2]


def ratio(a, b, form='%.2f'):
    return form % (b / a) if a and b else '-'


def answer(e):
    """Returns whether the result is injective: the answer of verify.py, or the program's if they disagree."""
    words = {True: 'yes', False: 'no', None: '-'}
    own, other = words[e['own_injective']], words[e.get('injective')]
    return other if own == other else '%s (program: %s)' % (other, own)


def outcome(e):
    return '%s' % e['exit'] if e['exit'] != 4 else '4 (%s)' % e['status']


def show_disks(entries):
    rows = []
    for (mesh, degree), plain, held in pairs(entries, 'mesh', 'degree'):
        more = 100 * (held['E'] / plain['E'] - 1) if held.get('E') and plain.get('E') else None
        rows.append([mesh, degree, answer(plain), common.cell(plain.get('E'), '%.6g'), outcome(held),
                     answer(held), common.cell(held.get('E'), '%.6g'), common.cell(more, '%+.3f'),
                     '%d / %d' % (plain['iterations'], held['iterations']),
                     '%s / %s' % (held['performed'], held['intended']),
                     ratio(plain['per_iteration'], held['per_iteration']),
                     '; '.join(plain['problems'] + held['problems']) or 'ok'])
    print('## Disks (`parametrize`), without and with `--bijective`\n')
    print('\n'.join(common.markdown_table(
        ['mesh', 'degree', 'injective without', 'E without', 'exit', 'injective', 'E', 'more, %',
         'iterations', 'flips', 'time per iteration, times', 'checks'], rows)) + '\n')


def show_deform(entries):
    rows = [[e['mesh'], e['kind'], e['how'], e['degree'], outcome(e), common.cell(e.get('E'), '%.6g'),
             common.cell(e.get('off'), '%.1e'), answer(e), e['iterations'],
             '%s / %s' % (e['performed'], e['intended']), common.cell(e['total'], '%.2f'),
             '; '.join(e['problems']) or 'ok'] for e in entries]
    print('## Deformations (`deform`)\n')
    print('\n'.join(common.markdown_table(
        ['mesh', 'handles', 'map', 'degree', 'exit', 'E', 'handles off, of the size', 'injective',
         'iterations', 'flips', 'seconds', 'checks'], rows)) + '\n')


def show_cost(entries):
    rows = []
    for (mesh, degree), plain, held in pairs(entries, 'mesh', 'degree'):
        rows.append([mesh, degree, '%d / %d' % (plain['iterations'], held['iterations']),
                     common.cell(plain['per_iteration'], '%.3f'),
                     common.cell(held['per_iteration'], '%.3f'),
                     ratio(plain['per_iteration'], held['per_iteration'])])
        if plain['per_iteration'] and held['per_iteration']:
            if held['per_iteration'] > COST * plain['per_iteration']:
                held['problems'].append('costs more than %g times as much' % COST)
    print('## Seconds per iteration, %d iterations, fastest of %d runs\n'
          % (COST_ITERATIONS, COST_RUNS))
    print('\n'.join(common.markdown_table(
        ['mesh', 'degree', 'iterations', 'without', 'with', 'times'], rows)) + '\n')


def show(entries):
    for part, render in zip(PARTS, (show_disks, show_deform, show_cost)):
        if chosen := [e for e in entries if e['part'] == part]:
            render(chosen)
    bad = [e for e in entries if e['problems']]
    print('%d of %d runs hold all rules' % (len(entries) - len(bad), len(entries)))
    for e in bad:
        print('* %s %s %s %s, degree %d: %s (%s)' % (
            e['part'], e['mesh'], e.get('kind', ''), e['how'], e['degree'], '; '.join(e['problems']),
            e['message']))
    return 1 if bad or not entries else 0


# ------------------------------------------------------------------ all runs
def plan(options):
    """Returns the runs as (function, its arguments after options)."""
    if 'disks' in options.parts:
        for mesh in disk_meshes(options, options.faces):
            for degree in options.degrees:
                for method in FLAGS:
                    yield run_disk, (mesh, degree, method)
    if 'deform' in options.parts:
        for mesh in sorted((options.shared / 'data/public/deform2d').glob('*.obj')):
            for kind in ('soft', 'hard') if re.search(options.meshes, mesh.stem) else ():
                for method in FLAGS:
                    for degree in options.degrees:
                        yield run_deform, (mesh, degree, kind, method)
    if 'cost' in options.parts:
        for mesh in disk_meshes(options, 10000):
            for degree in {1, 3} & set(options.degrees):
                for method in FLAGS:
                    yield run_cost, (mesh, degree, method)


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    common.add_options(parser)
    parser.add_argument('--parts', type=comma_list(str, PARTS), default=list(PARTS))
    parser.add_argument('--faces', type=int, choices=(500, 2500, 10000), default=500, help='of the disks')
    parser.add_argument('--meshes', default='', metavar='REGEX', help='searched in the names')
    parser.add_argument('--degrees', type=comma_list(int, range(1, 9)), default=[1, 2, 3])
    parser.add_argument('--jobs', type=int, default=1, help='runs at the same time, one thread each')
    parser.add_argument('--json', type=Path, help='results file, written after every run')
    parser.add_argument('--render', type=Path, metavar='FILE.json', help='only print a results file')
    return parser.parse_args()


def main():
    options = parse_arguments()
    if options.render:
        return show(common.load_strict(options.render))
    common.require_files(options)
    entries = []
    with ThreadPoolExecutor(options.jobs) as pool:
        for e in pool.map(lambda job: job[0](options, *job[1]), plan(options)):
            entries.append(e)
            if options.json:
                options.json.write_text(json.dumps(entries, indent=1) + '\n')
    return show(entries)


if __name__ == '__main__':
    sys.exit(main())
