#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Measures what --effort high finds: energies of degree 1 and processor seconds, beside a normal run.

The disks are the public ones, and generated ones that are the same on every machine (bench/tolerance.py;
the number is the seed). Rows whose energies agree to 1e-6 are counted, not listed. Exit code 1 if a run has
no map or ends higher than the normal one by more than 1e-6.

Sample runs:
  bench/effort.py                      # 39 public and 21 generated disks
  bench/effort.py --generated 200 --public none
"""
import resource
import sys
import tempfile
from pathlib import Path

import common
import tolerance

SAME = 1e-6  # of the energy


def processor_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def solve(options, mesh, folder, effort):
    """Returns (energy, processor seconds)."""
    before = processor_seconds()
    report_path = folder / 'report.json'
    report_path.unlink(missing_ok=True)
    common.parametrize(options, mesh, [folder / 'map.vtu'], '--degree', 1, '--effort', effort, '--force',
                       '--report', report_path)
    seconds = processor_seconds() - before
    report, problem = common.load_report(report_path)
    if problem or not report['result']:
        sys.exit('%s, --effort %s: %s' % (mesh, effort, problem or report['message']))
    return report['result']['value_quadrature'], seconds


def meshes(options, folder):
    if options.public != 'none':
        yield from sorted((options.shared / 'data/public/disks').glob(options.public + '.obj'))
    for number in range(options.generated):
        name, _, vertices, faces = tolerance.mesh_of(number)
        path = folder / (name + '.obj')
        common.write_obj(path, vertices, faces)
        yield path


def main():
    parser = common.parser(__doc__)
    parser.add_argument('--public', default='*_*', metavar='PATTERN', help='names of public disks, or none')
    parser.add_argument('--generated', type=int, default=21, metavar='N')
    options = parser.parse_args()
    rows, higher, same = [], 0, 0
    sums = [0.0, 0.0]
    with tempfile.TemporaryDirectory(prefix='majorant_effort_') as name:
        folder = Path(name)
        for mesh in meshes(options, folder):
            (normal, first), (high, second) = (solve(options, mesh, folder, e) for e in ('normal', 'high'))
            sums = [sums[0] + first, sums[1] + second]
            change = high / normal - 1
            higher += change > SAME
            if abs(change) <= SAME:
                same += 1
            else:
                rows.append([mesh.stem, '%.8g' % normal, '%.8g' % high, '%.1e' % change, '%.1f' % (second / first)])
    print('\n'.join(common.markdown_table(['disk', 'energy, normal', 'high', 'change', 'seconds, times'], rows)))
    print('\nthe same to %g: %d; seconds of all: %.1f, %.1f' % (SAME, same, *sums))
    return 1 if higher else 0


if __name__ == '__main__':
    sys.exit(main())
