#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Acceptance of seamless maps: `parametrize --seamless` and `seamless` on the public meshes.

texture  SHARED/data/public/seamless, degrees 1 to 4, the seams of the files' texture coordinates
         held: same cuts, rotations and cones as the input, energies at most 0.2 % above
         SHARED/reference/results.json and not increasing with the degree, cube_4 an isometry.
closed   SHARED/data/public/closed, degrees 1 to 3, maps from the plain meshes.
disks    SHARED/data/public/disks likewise (with --disks). verify.py welds the two sides of a slit
         and then finds them neither continuous nor seamless, as they need not be: `--cuts free`.

Everywhere: exit 0, no violation by verify.py, seams that fit to 1e-12 of the layout's diagonal.
Prints Markdown tables; exit code 0 exactly if all of that holds. E is verify.py's energy (5050
points), `own` the program's own, which is compared between degrees.

Sample runs:
  bench/seamless.py
  bench/seamless.py --binary build/release/apps/majorant --disks --json /tmp/seamless.json
  bench/seamless.py --meshes 'cube_4|spot' --degrees 1,3
"""
import argparse
import json
import re
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import common
from public_disks import comma_list

SEAMS = 1e-12            # bound on the mismatch along seams, relative to the diagonal of the layout
EXCESS = 2e-3            # bound on the relative energy above the reference
GROWTH = 1e-6            # bound on the relative growth of the program's energy with the degree, by rounding and stopping
ISOMETRY = {'cube_4': 1e-9}
DEGREES = {'texture': (1, 2, 3, 4), 'closed': (1, 2, 3), 'disks': (1, 2, 3)}
FOLDER = {'texture': 'seamless', 'closed': 'closed', 'disks': 'disks'}


# ------------------------------------------------------------------ one run
def verify_flags(part, mesh):
    if part == 'texture':
        return None, ['--cuts', 'auto', '--same-cuts', mesh]
    return mesh, ['--cuts', 'auto' if part == 'closed' else 'free']


def cones_of(checked):
    """Returns "12 x 3, 4 x 5": the number of cones by quarter turns."""
    cones = checked.get('angles', {}).get('cones', {})
    return ', '.join('%d x %s' % (cones[k], k) for k in sorted(cones, key=int)) or 'none'


def examine(entry, checked):
    """Adds the results of verify.py to the entry. Returns the complaints."""
    problems = ['verify: ' + name for name in common.failed_checks(checked)]
    energy = checked.get('energy', {}).get('E_SD')
    seams = checked.get('seamlessness', {}).get('max_residual_relative_to_bbox', 0.0)
    entry.update(E=energy if isinstance(energy, float) else None, cones=cones_of(checked),
                 seams=seams, cut_edges=checked.get('continuity', {}).get('cut_edges'))
    if entry['part'] != 'disks' and seams > SEAMS:
        problems.append('seams off by %.1e of the diagonal' % seams)
    return problems


def execute(options, job):
    part, mesh, degree = job
    path = options.shared / 'data/public' / FOLDER[part] / (mesh + '.obj')
    with tempfile.TemporaryDirectory(prefix='majorant_seamless_') as folder:
        result, report_path = Path(folder) / 'out.vtu', Path(folder) / 'report.json'
        flags = ['--degree', degree, '--threads', 1, '--report', report_path]
        if part == 'texture':
            done = common.parametrize(options, path, [result], '--seamless', *flags)
        else:
            done = common.parametrize(options, path, [result], *flags, verb='seamless')
        report, problem = common.load_report(report_path)
        start, seconds = report.get('seam_start', {}), report.get('seconds', {})
        entry = {'part': part, 'mesh': mesh, 'degree': degree, 'exit': done.code,
                 'status': report.get('status'), 'own': report.get('result', {}).get('value'),
                 'start': report.get('options', {}).get('init'), 'inverted': start.get('inverted'),
                 'iterations': len(common.steps_taken(report)),
                 'initialize': seconds.get('initialize'), 'optimize': seconds.get('optimize'),
                 'message': (done.stderr.strip().splitlines() or [''])[-1]}
        problems = ['exit %s' % done.code] if done.code != 0 else []
        problems += [problem] if problem and done.code == 0 else []
        if result.exists():
            mesh_path, check = verify_flags(part, path)
            problems += examine(entry, common.verify(options, result, mesh_path, None, *check))
    entry['problems'] = problems
    return entry


# ------------------------------------------------------------------ rules over several runs
def compare(entries, reference):
    """Adds the problems that follow from the reference or other degrees of a mesh."""
    last = {}
    for e in entries:
        key, value = (e['part'], e['mesh']), e['own']
        target = reference.get(e['mesh'], {}).get('targets', {}).get('SD/seamless/%d' % e['degree'])
        if e['part'] == 'texture' and target:
            e['reference'] = target['E']
            if e.get('E') and e['E'] > (1 + EXCESS) * target['E']:
                e['problems'].append('above the reference')
        if e['part'] == 'texture' and e['mesh'] in ISOMETRY and value is not None:
            if not abs(value - 4) <= ISOMETRY[e['mesh']]:
                e['problems'].append('no isometry')
        if value is None:
            continue
        if value > (1 + GROWTH) * last.get(key, value):
            e['problems'].append('above the lower degree')
        last[key] = value


# ------------------------------------------------------------------ tables
def seconds(e):
    return common.cell(e['initialize'], '%.2f') + ' + ' + common.cell(e['optimize'], '%.2f')


def texture_rows(entries):
    for e in entries:
        excess = 100 * (e['E'] / e['reference'] - 1) if e.get('E') and e.get('reference') else None
        yield [e['mesh'], e['degree'], e['exit'], common.cell(e.get('E'), '%.7g'),
               common.cell(e['own'], '%.10g'), common.cell(e.get('reference'), '%.7g'),
               common.cell(excess, '%+.3f'), e.get('cones', '-'),
               common.cell(e.get('seams'), '%.1e'), e['iterations'], '; '.join(e['problems']) or 'ok']


def made_rows(entries):
    for e in entries:
        yield [e['mesh'], e['degree'], e['exit'], common.cell(e.get('E'), '%.6g'),
               e.get('cones', '-'), common.cell(e.get('cut_edges')),
               common.cell(e.get('seams') if e['part'] == 'closed' else None, '%.1e'),
               common.cell(e['start']), common.cell(e['inverted']), e['iterations'], seconds(e),
               '; '.join(e['problems']) or 'ok']


def gain_rows(entries):
    """Returns rows that compare E(3) with E(1)."""
    own = {(e['mesh'], e['degree']): e['own'] for e in entries}
    for mesh in dict.fromkeys(e['mesh'] for e in entries):
        first, third = own.get((mesh, 1)), own.get((mesh, 3))
        if first and third:
            yield [mesh, '%.6g' % first, '%.6g' % third, '%.2f' % (100 * (1 - third / first))]


def show(entries):
    parts = {part: [e for e in entries if e['part'] == part] for part in DEGREES}
    if parts['texture']:
        print('## Seams of texture coordinates (`parametrize --seamless`)\n')
        print('\n'.join(common.markdown_table(
            ['mesh', 'degree', 'exit', 'E', 'own', 'reference', '%', 'cones (number x quarter turns)',
             'seams', 'iterations', 'checks'], texture_rows(parts['texture']))))
    for part, title in ('closed', 'Plain meshes'), ('disks', 'Disks'):
        if not parts[part]:
            continue
        print('\n## %s (`seamless`)\n' % title)
        print('\n'.join(common.markdown_table(
            ['mesh', 'degree', 'exit', 'E', 'cones (number x quarter turns)', 'cut edges', 'seams',
             'start', 'inverted at first', 'iterations', 'seconds: start + optimize', 'checks'],
            made_rows(parts[part]))))
        print('\n### What curved triangles gain\n')
        print('\n'.join(common.markdown_table(['mesh', 'own E(1)', 'own E(3)', 'less, %'],
                                              gain_rows(parts[part]))))
    bad = [e for e in entries if e['problems']]
    print('\n%d of %d runs hold all rules' % (len(entries) - len(bad), len(entries)))
    for e in bad:
        print('* %s %s, degree %d: %s (%s)' % (e['part'], e['mesh'], e['degree'],
                                               '; '.join(e['problems']), e['message']))
    return 1 if bad or not entries else 0


# ------------------------------------------------------------------ all runs
def plan(options):
    for part in options.parts:
        paths = (options.shared / 'data/public' / FOLDER[part]).glob('*.obj')
        for mesh in sorted(path.stem for path in paths if re.search(options.meshes, path.stem)):
            for degree in DEGREES[part]:
                if degree in options.degrees:
                    yield part, mesh, degree


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    common.add_options(parser)
    parser.add_argument('--meshes', default='', metavar='REGEX', help='searched in the names')
    parser.add_argument('--degrees', type=comma_list(int, range(1, 9)), default=[1, 2, 3, 4])
    parser.add_argument('--parts', type=comma_list(str, DEGREES), default=['texture', 'closed'])
    parser.add_argument('--disks', action='store_true', help='also the disks')
    parser.add_argument('--jobs', type=int, default=1, help='runs at the same time, one thread each')
    parser.add_argument('--json', type=Path, help='results file')
    parser.add_argument('--render', type=Path, metavar='FILE.json', help='only print a results file')
    options = parser.parse_args()
    if options.disks and 'disks' not in options.parts:
        options.parts.append('disks')
    return options


def main():
    options = parse_arguments()
    if options.render:
        return show(common.load_strict(options.render))
    common.require_files(options)
    reference = common.load_strict(options.shared / 'reference/results.json')
    entries = []
    with ThreadPoolExecutor(options.jobs) as pool:
        for e in pool.map(lambda job: execute(options, job), plan(options)):
            entries.append(e)
            sys.stderr.write('%s %s %d: exit %s, E %s %s\n' % (
                e['part'], e['mesh'], e['degree'], e['exit'], common.cell(e.get('E'), '%.6g'),
                '; '.join(e['problems'])))
    compare(entries, reference)
    if options.json:
        options.json.write_text(json.dumps(entries, indent=1) + '\n')
    return show(entries)


if __name__ == '__main__':
    sys.exit(main())
