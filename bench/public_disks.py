#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""The acceptance matrix: every mesh of SHARED/data/public/disks at several degrees and boundaries.

Each run is `majorant parametrize`, followed by verify.py against the mesh and against constraints that
this script computes itself (common.tutte). Degrees 1, 2, 3 for all meshes, 4 and 5 for the smallest;
boundaries free, fixed, and pinned if SHARED/reference/results.json lists pins. Prints
Markdown tables and a summary. Exit code 0 exactly if all rules of disks_summary.py hold.

Sample runs:
  bench/public_disks.py --json /tmp/disks.json                     # everything, two runs at a time
  bench/public_disks.py --json /tmp/disks.json --resume            # only what the file lacks
  bench/public_disks.py --meshes '_500$' --degrees 1,2 --boundaries free,fixed --out /tmp/disks
  bench/public_disks.py --render /tmp/disks.json                   # only the tables
"""
import argparse
import json
import os
import re
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor, as_completed
from functools import lru_cache
from pathlib import Path

import common
import disks_summary

BOUNDARIES = ('free', 'fixed', 'pinned')
RESIDUAL = 1e-9                                   # bound on the distance of the fixed boundary, relative to its size


# ------------------------------------------------------------------ what to run
def degrees_of(mesh):
    return (1, 2, 3, 4, 5) if mesh.endswith('_500') else (1, 2, 3)


def plan(options, reference):
    """Returns the jobs (mesh, boundary, degree) that pass the filters, smallest meshes first."""
    folder = options.shared / 'data/public/disks'
    meshes = [path.stem for path in folder.glob('*.obj') if re.search(options.meshes, path.stem)]
    meshes.sort(key=lambda mesh: (int(mesh.rsplit('_', 1)[1]), mesh))
    return [(mesh, boundary, degree)
            for mesh in meshes for boundary in options.boundaries for degree in degrees_of(mesh)
            if degree in options.degrees and (boundary != 'pinned' or pins_of(reference, mesh))]


def pins_of(reference, mesh):
    return reference.get(mesh, {}).get('pins')


def target_of(reference, mesh, boundary, degree):
    return reference.get(mesh, {}).get('targets', {}).get('SD/%s/%d' % (boundary, degree))


# ------------------------------------------------------------------ one run
@lru_cache(maxsize=8)
def initial_map(path):
    """Returns (vertices, faces, uv, boundary loop) of the mesh file."""
    vertices, faces = common.read_obj(path)
    return (vertices, faces) + common.tutte(vertices, faces)


def write_json(path, value):
    """Writes the whole file or nothing."""
    part = Path(str(path) + '.part')
    part.write_text(json.dumps(value, indent=1) + '\n')
    os.replace(part, path)


def points_at(uv, vertices):
    return [{'vertex': int(v), 'uv': [float(x) for x in uv[v]]} for v in vertices]


def constrain(mesh_path, boundary, pins, stem):
    """Writes the files of a run. Returns (flags for majorant, constraints file for verify.py)."""
    if boundary == 'free':
        return [], None
    vertices, faces, uv, loop = initial_map(mesh_path)
    check = Path(str(stem) + '_constraints.json')
    if boundary == 'fixed':
        start = Path(str(stem) + '_initial.obj')
        common.write_obj(start, vertices, faces, uv)
        # verify.py finds no boundary edges along a slit; the points test them.
        write_json(check, {'points': points_at(uv, loop), 'fixed_boundary': str(start)})
        return ['--boundary', 'fixed'], check
    pin_file = Path(str(stem) + '_pins.json')
    write_json(pin_file, {'handles': [{'vertex': v, 'target': 'initial'} for v in pins]})
    write_json(check, {'points': points_at(uv, pins)})
    return ['--pins', pin_file], check


def boundary_problems(options, result, loop):
    """Returns the defects of the control points along a fixed boundary (method.md N8)."""
    curves = common.boundary_curves(options.shared, result)
    if len(curves) != len(loop):
        return ['%d boundary curves instead of %d' % (len(curves), len(loop))]
    residual = common.straightness(curves)
    return [] if residual <= RESIDUAL else ['boundary curves bent by %.1e' % residual]


def examine(options, job, mesh_path, result, check):
    """Returns (fields of the entry, problems) from verify.py."""
    checked = common.verify(options, result, mesh_path, check)
    problems = ['verify: ' + name for name in common.failed_checks(checked)]
    if 'error' not in checked and job[1] == 'fixed':
        problems += boundary_problems(options, result, initial_map(mesh_path)[3])
    whole = checked.get('global_injectivity', {})
    energy = checked.get('energy', {}).get('E_SD')
    return {'E_SD': energy if isinstance(energy, float) else None,   # verify.py writes "inf" as text
            'boundary_over_2pi': checked.get('angles', {}).get('boundary_over_2pi'),
            'crossings': whole.get('crossing_pairs'),
            'globally_injective': whole.get('globally_injective')}, problems


def status_problems(code, status, written):
    """Returns disagreements of exit code, status and output file with interface.md."""
    problems = []
    expected = {'converged': 0, 'max_iterations': 4, 'time_limit': 4, 'interrupted': 4, 'stalled': 4,
                'infeasible': 3, 'failed': 5}
    if expected.get(status) != code:
        problems.append('exit %s with status %s' % (code, status))
    if written != (code in (0, 4)):
        problems.append('exit %s %s a result file' % (code, 'with' if written else 'without'))
    return problems


def summarize_run(done, report):
    """Returns the fields of an entry from the process and its report."""
    result = report.get('result', {})
    lines = done.stderr.strip().splitlines()
    return {'exit': done.code, 'status': report.get('status'), 'stderr': lines[-1] if lines else '',
            'seconds': round(done.seconds, 3), 'iterations': len(common.steps_taken(report)),
            'value': result.get('value'), 'value_quadrature': result.get('value_quadrature')}


def execute(options, job, reference, folder):
    """Runs and checks one job. Returns its entry of the results file."""
    mesh, boundary, degree = job
    mesh_path = options.shared / 'data/public/disks' / (mesh + '.obj')
    stem = Path(folder) / ('%s_%s_%d' % job)
    result, report_path = Path(str(stem) + '.vtu'), Path(str(stem) + '.json')
    for old in (result, report_path):
        old.unlink(missing_ok=True)
    flags, check = constrain(mesh_path, boundary, pins_of(reference, mesh), stem)
    done = common.parametrize(options, mesh_path, [result], '--degree', degree, *flags,
                              '--report', report_path, '--threads', 1)
    report, problem = common.load_report(report_path)
    entry = {'mesh': mesh, 'boundary': boundary, 'degree': degree, **summarize_run(done, report)}
    problems = [problem] if problem else []
    problems += status_problems(done.code, report.get('status'), result.exists())
    if result.exists():
        fields, found = examine(options, job, mesh_path, result, check)
        entry.update(fields)
        problems += found
    return {**entry, 'reference': target_of(reference, *job), 'problems': problems}


def execute_in(options, job, reference):
    """Calls execute() in the folder of --out, or in a temporary folder."""
    if options.out:
        options.out.mkdir(parents=True, exist_ok=True)
        return execute(options, job, reference, options.out)
    with tempfile.TemporaryDirectory(prefix='majorant_disks_') as folder:
        return execute(options, job, reference, folder)


# ------------------------------------------------------------------ all runs
def key_of(job):
    return '%s/%s/%d' % job


def announce(number, count, entry):
    state = '; '.join(entry['problems']) or 'ok'
    sys.stderr.write('[%d/%d] %s %s %d: exit %s, E %s, %s iterations, %.1f s, %s\n' % (
        number, count, entry['mesh'], entry['boundary'], entry['degree'], entry['exit'],
        common.cell(entry.get('E_SD'), '%.6g'), entry['iterations'], entry['seconds'], state))


def run_all(options, jobs, reference, entries):
    """Fills entries job by job; the results file is complete after every run."""
    pool = ThreadPoolExecutor(options.jobs)
    waiting = {pool.submit(execute_in, options, job, reference): job for job in jobs}
    try:
        for number, future in enumerate(as_completed(waiting), 1):
            entries[key_of(waiting[future])] = future.result()
            announce(number, len(jobs), future.result())
            if options.json:
                write_json(options.json, entries)
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
    parser.add_argument('--meshes', default='', metavar='REGEX', help='searched in the names, e.g. "_500$"')
    parser.add_argument('--degrees', type=comma_list(int, range(1, 6)), default=[1, 2, 3, 4, 5])
    parser.add_argument('--boundaries', type=comma_list(str, BOUNDARIES), default=list(BOUNDARIES))
    parser.add_argument('--jobs', type=int, default=2, help='runs at the same time, one thread each')
    parser.add_argument('--out', type=Path, help='keep all files in this folder')
    parser.add_argument('--json', type=Path, help='results file, written after every run')
    parser.add_argument('--resume', action='store_true', help='skip what the results file has')
    parser.add_argument('--render', type=Path, metavar='FILE.json', help='only print a results file')
    options = parser.parse_args()
    if options.json and options.json.exists() and not options.resume:
        parser.error('%s exists: continue it with --resume, or remove it' % options.json)
    return options


def main():
    options = parse_arguments()
    if options.render:
        return disks_summary.show(common.load_strict(options.render))
    common.require_files(options)
    reference = common.load_strict(options.shared / 'reference/results.json')
    entries = common.load_strict(options.json) if options.json and options.json.exists() else {}
    jobs = [job for job in plan(options, reference) if key_of(job) not in entries]
    try:
        run_all(options, jobs, reference, entries)
    except KeyboardInterrupt:
        sys.exit('interrupted')
    return disks_summary.show(entries)


if __name__ == '__main__':
    sys.exit(main())
