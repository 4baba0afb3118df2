#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Judges the files that the program writes: a written file must be valid as it is read back.

Public disks (500 and 2,500 faces at degrees 1 to 4, 10,000 at 1 and 3), public closed meshes by the verb
`seamless`, and long tubes made by this script, whose triangles differ in size by many orders of magnitude; as
VTU, OBJ, PLY and MSH (the image), converted to Lagrange cells and to an MSH of the surface; plain, with
--normalize, and with --bijective. Each file is judged by those of four programs that read it:
SHARED/tools/layout.py (OBJ) or verify.py (VTU), tests/checker/check_map.py, and `majorant check`. Exit codes
0 and 4 promise valid files; other exit codes are refusals, which are listed with their message; files that
they wrote are judged as well. At degree 1, a run without --degree that writes only OBJ must give the same
file. The full set takes almost an hour: cheap runs come first, --results is continued after an interruption,
and written_summary.py prints its table at any time.

Sample runs:
  tests/campaigns/written_files.py --results /tmp/written.jsonl
  tests/campaigns/written_files.py --families disks --meshes '_500$' --degrees 1,3 --modes normalize
  tests/campaigns/written_summary.py /tmp/written.jsonl
"""
import argparse
import json
import math
import re
import shutil
import sys
import tempfile
from collections import namedtuple
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[2] / 'bench'))
import common  # noqa: E402
import written_summary  # noqa: E402

sys.path.append(str(common.ROOT / 'tests/checker'))
from result_map import read_result  # noqa: E402

MODES = {'plain': [], 'normalize': ['--normalize'], 'bijective': ['--bijective']}
FAMILIES = {'disks': ('plain', 'normalize', 'bijective'), 'closed': ('plain', 'normalize'),
            'tubes': ('plain', 'normalize')}
DEGREES = (1, 2, 3, 4)
# disks with at least this many faces have LARGE_DEGREES only
LARGE = 10000
LARGE_DEGREES = (1, 3)
TUBES = ((4, 28), (4, 32), (4, 40), (5, 40), (6, 60))      # corners around, rings
TUBE_SETTINGS = {                                 # name: (degree, flags)
    'asap': (1, ['--energy', 'asap', '--boundary', 'fixed']),
    'mips': (1, ['--energy', 'mips', '--boundary', 'fixed']),
    'mips-2': (2, ['--energy', 'mips', '--boundary', 'fixed']),
    'arap': (1, ['--energy', 'arap', '--boundary', 'fixed']),
    'arap-stopped': (1, ['--energy', 'arap', '--boundary', 'fixed', '--max-iterations', '2']),
    'symmetric-dirichlet': (1, ['--boundary', 'fixed']),
    'symmetric-dirichlet-3': (3, ['--boundary', 'fixed']),
    'free': (1, [])}
PROMISED = (0, 4)                                 # exit codes after which all outputs exist
REFUSALS = (1, 2, 3, 5)
CLAIM_NOTHING = ('out.obj', 'out.ply', 'surface.msh', 'out.msh')

Job = namedtuple('Job', 'family mesh degree mode setting')


# ------------------------------------------------------------------ what to run
def size_of(mesh):
    return int(re.findall(r'\d+', mesh)[-1])


def public_jobs(options, family):
    for path in (options.shared / 'data/public' / family).glob('*.obj'):
        large = family == 'disks' and size_of(path.stem) >= LARGE
        for degree in LARGE_DEGREES if large else DEGREES:
            for mode in FAMILIES[family]:
                yield Job(family, path.stem, degree, mode, '')


def tube_jobs():
    for sides, rings in TUBES:
        for setting, (degree, _) in TUBE_SETTINGS.items():
            for mode in FAMILIES['tubes']:
                yield Job('tubes', 'tube_%d_%d' % (sides, rings), degree, mode, setting)


def cost(job):
    """Returns a key that sorts cheap runs first: large disks last, degree 4 before them."""
    large = job.family == 'disks' and size_of(job.mesh) >= LARGE
    return (large, job.degree == 4, list(FAMILIES).index(job.family), size_of(job.mesh), job)


def plan(options):
    jobs = []
    for family in options.families:
        jobs += tube_jobs() if family == 'tubes' else public_jobs(options, family)
    return sorted((job for job in jobs if re.search(options.meshes, job.mesh)
                   and job.degree in options.degrees and job.mode in options.modes), key=cost)


# ------------------------------------------------------------------ the tubes
def write_tube(path, sides, rings):
    """Writes a tube of radius 1 with closed ends; each ring is rotated by half a step against the one below."""
    lines = []
    for ring in range(rings + 1):
        for corner in range(sides):
            angle = 2 * math.pi * (corner + ring % 2 / 2) / sides
            lines.append('v %.17g %.17g %d' % (math.cos(angle), math.sin(angle), ring))
    lines.append('v 0 0 %g' % (rings + 0.3))
    for ring in range(rings):
        for corner in range(sides):
            a, b = (ring * sides + (corner + k) % sides + 1 for k in (0, 1))
            c, d = a + sides, b + sides
            pairs = ((a, b, c), (b, d, c)) if ring % 2 == 0 else ((a, d, c), (a, b, d))
            lines += ['f %d %d %d' % face for face in pairs]
    apex, last = sides * (rings + 1) + 1, sides * rings
    for corner in range(sides):
        lines.append('f %d %d %d' % (last + corner + 1, last + (corner + 1) % sides + 1, apex))
    path.write_text('\n'.join(lines) + '\n')


def mesh_of(options, job, folder):
    if job.family != 'tubes':
        return (options.shared / 'data/public' / job.family / (job.mesh + '.obj')).resolve()
    path = folder / (job.mesh + '.obj')
    write_tube(path, *map(int, job.mesh.split('_')[1:]))
    return path


# ------------------------------------------------------------------ judges
def last_line(done):
    lines = (done.stdout.strip() or done.stderr.strip() or 'exit %s' % done.code).splitlines()
    return lines[-1]


def refusal(judge, done):
    """Returns the problems that a judge reports; its exit code for good files is 0."""
    return [] if done.code == 0 else ['%s (%s): %s' % (judge, done.code, last_line(done))]


def by_layout(options, job, mesh, result):
    command = [common.PYTHON, options.shared / 'tools/layout.py', result]
    command += ['--input', mesh, '--same-faces'] if job.degree == 1 else []
    command += ['--overlap'] if job.mode == 'bijective' else []
    command += ['--unit'] if job.mode == 'normalize' else []
    return refusal('layout.py', common.run(command, options.timeout))


def by_verify(options, job, mesh, result):
    flags = ['--no-energy'] + (['--cuts', 'auto'] if job.family == 'closed' else [])
    flags += ['--require-global'] if job.mode == 'bijective' else []
    checked = common.verify(options, result, mesh, None, *flags)
    return ['verify.py: ' + name for name in common.failed_checks(checked)]


def surface_flags(mesh, result):
    """Returns the flags of the surface; an image in the plane has none."""
    return [] if result.name == 'out.msh' else ['--surface', mesh]


def by_checker(options, job, mesh, result):
    command = [common.PYTHON, common.ROOT / 'tests/checker/check_map.py', result]
    command += surface_flags(mesh, result)
    command += ['--seamless'] if job.family == 'closed' else []
    command += ['--overlap'] if job.mode == 'bijective' else []
    return refusal('check_map.py', common.run(command, options.timeout))


def by_command(options, job, mesh, result):
    command = [options.binary.resolve(), 'check', result, '--threads', 1]
    command += surface_flags(mesh, result)
    command += ['--seamless'] if job.family == 'closed' and result.name in CLAIM_NOTHING else []
    command += ['--certify'] if job.mode == 'bijective' else []
    return refusal('majorant check', common.run(command, options.timeout))


def by_box(options, job, mesh, result):
    """Checks --normalize: the control points are in the unit square, with a side of their box above 1/2. In
    formats with points on the curves these are exact up to the rounding of their computation."""
    if job.mode != 'normalize':
        return []
    points = [point for cell in read_result(str(result)).cells for point in cell.uv]
    low, high = ([pick(axis) for axis in zip(*points)] for pick in (min, max))
    slack = 0 if result.suffix in ('.vtu', '.ply') and result.name not in CONVERTED else INTERPOLATED
    fits = min(low) >= -slack and max(high) <= 1 + slack and max(b - a for a, b in zip(low, high)) > 0.5
    return [] if fits else ['unit square: control points from %s to %s' % (low, high)]


INTERPOLATED = 1e-12  # in sides of the layout: some thousand roundings
OUTPUTS = {                                       # file of the run: its judges
    'out.vtu': (by_verify, by_checker, by_command, by_box),
    'out.obj': (by_layout, by_checker, by_command),
    'out.ply': (by_checker, by_command, by_box),
    'out.msh': (by_checker, by_command, by_box)}
CONVERTED = {                                     # file made of out.vtu: flags, judges
    'lagrange.vtu': (['--vtu', 'lagrange'], (by_checker, by_command, by_box)),
    'surface.msh': (['--msh', 'surface'], (by_checker, by_command, by_box))}


def count_faces(path):
    with open(path, encoding='ascii', errors='replace') as file:
        return sum(line.startswith('f ') for line in file)


# ------------------------------------------------------------------ one run
def solve(options, job, mesh, outputs, *degree):
    verb = 'seamless' if job.family == 'closed' else 'parametrize'
    flags = TUBE_SETTINGS[job.setting][1] if job.setting else []
    return common.parametrize(options, mesh, outputs, *degree, *flags, *MODES[job.mode],
                              '--time-limit', options.time_limit, '--threads', 1, verb=verb)


def run_problems(done, outputs, folder):
    """Returns the defects of the run itself: its end, its outputs and leftover files."""
    written = [path for path in outputs if path.exists()]
    problems = []
    if done.code in PROMISED and len(written) < len(outputs):
        problems.append('exit %s without all outputs' % done.code)
    elif done.code not in PROMISED and not done.stderr.strip():
        problems.append('exit %s without a message' % done.code)
    if done.code not in PROMISED + REFUSALS or (done.code in REFUSALS and done.code != 5 and written):
        problems.append('exit %s, %d files written' % (done.code, len(written)))
    left = {path.name for path in folder.iterdir()} - {path.name for path in outputs}
    return problems + (['left behind: ' + ' '.join(sorted(left))] if left else [])


def default_problems(options, job, mesh, obj, code, folder):
    """Checks that a run of degree 1 that writes only OBJ gives the same file without --degree."""
    alone = folder / 'alone.obj'
    done = solve(options, job, mesh, [alone])
    exits = {code, done.code}
    if exits == {0} and alone.read_bytes() != obj.read_bytes():
        return ['OBJ alone differs from that of --degree 1']
    problems = [] if len(exits) == 1 or exits == {0, 4} else ['OBJ alone: exit %s' % done.code]
    return problems + (by_layout(options, job, mesh, alone) if alone.exists() else [])


def execute(options, job, mesh, folder):
    """Runs and judges one job in an empty folder. Returns its entry of the results."""
    outputs = [folder / name for name in OUTPUTS]
    done = solve(options, job, mesh, outputs, '--degree', job.degree)
    entry = {**job._asdict(), 'exit': done.code, 'seconds': round(done.seconds, 2),
             'message': ' / '.join(done.stderr.strip().splitlines()).replace(str(folder.parent), ''),
             'faces_in': count_faces(mesh), 'faces_out': None, 'problems': {},
             'written': [path.name for path in outputs if path.exists()]}
    entry['problems']['run'] = run_problems(done, outputs, folder)
    for path in (path for path in outputs if path.exists()):
        entry['problems'][path.name] = judged(options, job, mesh, path, OUTPUTS[path.name])
    if outputs[0].exists():
        convert_and_judge(options, job, mesh, outputs[0], entry)
    if outputs[1].exists():
        entry['faces_out'] = count_faces(outputs[1])
        if job.degree == 1 and job.family != 'tubes':
            entry['problems']['run'] += default_problems(options, job, mesh, outputs[1], done.code, folder)
    return entry


def judged(options, job, mesh, path, judges):
    return sum((judge(options, job, mesh, path) for judge in judges), [])


def convert_and_judge(options, job, mesh, result, entry):
    """Converts and judges a map. Rounding of values may invert a map: a refusal (5) is no problem."""
    for name, (flags, judges) in CONVERTED.items():
        path = result.with_name(name)
        done = common.run([options.binary.resolve(), 'convert', result, '-o', path, '--quiet', *flags],
                          options.timeout)
        problems = [] if (done.code == 0) == path.exists() and done.code in (0, 5) else \
            ['convert: exit %s: %s' % (done.code, last_line(done))]
        if path.exists():
            entry['written'].append(name)
            problems += judged(options, job, mesh, path, judges)
        entry['problems'][name] = problems


def execute_apart(options, job):
    """Calls execute() in a folder that is deleted afterwards, or moved to --keep if a file is bad."""
    with tempfile.TemporaryDirectory(prefix='majorant_written_') as place:
        outputs, meshes = Path(place, 'out'), Path(place, 'in')
        outputs.mkdir()
        meshes.mkdir()
        entry = execute(options, job, mesh_of(options, job, meshes), outputs)
        if options.keep and any(entry['problems'].values()):
            shutil.copytree(place, options.keep / '_'.join(filter(None, map(str, job))),
                            dirs_exist_ok=True)
        return entry


# ------------------------------------------------------------------ all runs
def announce(number, count, entry):
    found = sum(entry['problems'].values(), [])
    sys.stderr.write('[%d/%d] %s: exit %s, %.1f s, %s\n' % (
        number, count, written_summary.name_of(entry), entry['exit'], entry['seconds'],
        '; '.join(found) or 'clean'))


def run_all(options, jobs, entries):
    """Appends to entries and to the results file after every run."""
    pool = ThreadPoolExecutor(options.jobs)
    waiting = [pool.submit(execute_apart, options, job) for job in jobs]
    try:
        for number, future in enumerate(as_completed(waiting), 1):
            entries.append(future.result())
            announce(number, len(jobs), entries[-1])
            if options.results:
                with open(options.results, 'a', encoding='utf-8') as file:
                    file.write(json.dumps(entries[-1]) + '\n')
    finally:
        pool.shutdown(cancel_futures=True)


def comma_list(kind, allowed):
    """Returns an argparse type: comma-separated values out of `allowed`."""
    def parse(text):
        values = [kind(word) for word in text.split(',')]
        if not set(values) <= set(allowed):
            raise argparse.ArgumentTypeError('choose from %s' % ','.join(map(str, allowed)))
        return values
    return parse


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    common.add_options(parser)
    parser.add_argument('--families', type=comma_list(str, FAMILIES), default=list(FAMILIES))
    parser.add_argument('--meshes', default='', metavar='REGEX', help='searched in the names, e.g. "_500$"')
    parser.add_argument('--degrees', type=comma_list(int, DEGREES), default=list(DEGREES))
    parser.add_argument('--modes', type=comma_list(str, MODES), default=list(MODES))
    parser.add_argument('--time-limit', type=float, default=60, help='seconds per solve')
    parser.add_argument('--jobs', type=int, default=1, help='parallel runs of one thread each')
    parser.add_argument('--results', type=Path, help='JSON lines, one per run; continued if it exists')
    parser.add_argument('--keep', type=Path, help='folder for the files of runs with a problem')
    return parser.parse_args()


def main():
    options = parse_arguments()
    common.require_files(options)
    entries = written_summary.load(options.results) if options.results else []
    finished = {tuple(entry[field] for field in Job._fields) for entry in entries}
    jobs = [job for job in plan(options) if job not in finished]
    try:
        run_all(options, jobs, entries)
    except KeyboardInterrupt:
        sys.exit('interrupted')
    return written_summary.show(entries)


if __name__ == '__main__':
    sys.exit(main())
