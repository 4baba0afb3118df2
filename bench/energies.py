#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Other energies against the independent implementation: MIPS (free boundary), ASAP (fixed).

Runs `majorant parametrize` for every mesh and degree with such a target in SHARED/reference/results.json,
then verify.py, whose energy (5050 points) is compared. Prints a Markdown table. Exit
code 0 exactly if verify.py finds no violation and no energy exceeds the reference by more than its
tolerance.

Sample runs:
  bench/energies.py
  bench/energies.py --meshes spot --energies MIPS
"""
import argparse
import re
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import common
import public_disks

NAMES = {'MIPS': 'mips', 'ASAP': 'asap'}


def jobs_of(reference, options):
    for mesh, entry in sorted(reference.items()):
        if mesh.startswith('_') or not re.search(options.meshes, mesh):
            continue
        if not (options.shared / 'data/public/disks' / (mesh + '.obj')).exists():
            continue
        for key, target in sorted(entry.get('targets', {}).items()):
            energy, boundary, degree = key.split('/')
            if energy in options.energies:
                yield mesh, energy, boundary, int(degree), target


def execute(options, job):
    mesh, energy, boundary, degree, target = job
    path = options.shared / 'data/public/disks' / (mesh + '.obj')
    with tempfile.TemporaryDirectory(prefix='majorant_energies_') as folder:
        stem = Path(folder) / mesh
        result, report_path = Path(str(stem) + '.vtu'), Path(str(stem) + '.json')
        flags, check = public_disks.constrain(path, boundary, [], stem)
        done = common.parametrize(options, path, [result], '--degree', degree, '--energy',
                                  NAMES[energy], *flags, '--report', report_path, '--threads', 1)
        report, problem = common.load_report(report_path)
        if not result.exists():
            return job, done, report, {}, [problem or 'no result']
        checked = common.verify(options, result, path, check)
        return job, done, report, checked, common.failed_checks(checked)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    common.add_options(parser)
    parser.add_argument('--meshes', default='', metavar='REGEX')
    parser.add_argument('--energies', type=lambda t: t.split(','), default=list(NAMES))
    parser.add_argument('--jobs', type=int, default=2)
    options = parser.parse_args()
    common.require_files(options)
    reference = common.load_strict(options.shared / 'reference/results.json')
    bad = 0
    print('| mesh | energy | degree | status | iterations | E (verify.py) | reference | difference |')
    print('|---|---|---|---|---|---|---|---|')
    with ThreadPoolExecutor(options.jobs) as pool:
        for job, done, report, checked, problems in pool.map(
                lambda job: execute(options, job), jobs_of(reference, options)):
            mesh, energy, boundary, degree, target = job
            value = checked.get('energy', {}).get('E_' + energy)
            excess = value / target['E'] - 1 if isinstance(value, float) else float('inf')
            worse = excess > target['tolerance']
            bad += bool(problems) or worse
            print('| %s | %s %s | %d | %s | %d | %s | %.6g%s | %+.2g %%%s |' % (
                mesh, NAMES[energy], boundary, degree, report.get('status', done.code),
                len(report.get('iterations', [])), common.cell(value, '%.6g'), target['E'],
                ' (path dependent)' if target['path_dependent'] else '', 100 * excess,
                ' **worse**' if worse else '') + ''.join(' ' + p for p in problems), flush=True)
    print('\n%d runs violate verify.py or exceed the reference' % bad)
    return 1 if bad else 0


if __name__ == '__main__':
    sys.exit(main())
