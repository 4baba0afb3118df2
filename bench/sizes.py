#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Seconds and memory of whole runs, from 10,000 to 10 million faces: parametrize a disk, unwrap a closed surface.

Every edge of a mesh is cut into equal parts to make larger ones. Runs use all cores, from file to file with the proof.
Needs an idle machine; the largest mesh needs 24 GB.

Sample runs:
  bench/sizes.py
  bench/sizes.py --cuts 1 3 10
"""
import sys
import tempfile
from pathlib import Path

import common

RUNS = (('parametrize', 'disks/spot_10000.obj', ('--degree', '1')), ('unwrap', 'closed/koala_7116.obj', ()))
HEADER = ['run', 'faces', 'seconds', 'peak memory, MB', 'exit']


def main():
    parser = common.parser(__doc__, timeout=3600)
    parser.add_argument('--cuts', type=int, nargs='+', default=[1, 3, 10, 32], help='parts that every edge is cut into')
    parser.add_argument('--unwrap-cuts', type=int, nargs='+', default=[1, 3, 10], help='the same for unwrap')
    options = parser.parse_args()
    common.require_files(options)
    common.require_idle(options)
    table = common.Table('', *HEADER)
    for verb, name, flags in RUNS:
        vertices, faces = common.read_obj(options.shared / 'data/public' / name)
        for cuts in options.unwrap_cuts if verb == 'unwrap' else options.cuts:
            with tempfile.TemporaryDirectory(prefix='majorant_sizes_') as folder:
                mesh, report = Path(folder) / 'in.obj', Path(folder) / 'report.json'
                common.write_obj(mesh, *common.subdivided(vertices, faces, cuts))
                done = common.parametrize(options, mesh, [Path(folder) / 'out.obj'], *flags, '--report', report, verb=verb)
                found, problem = common.load_report(report)
                table.row(verb, format(len(faces) * cuts ** 2, ','), '%.3g' % done.seconds,
                          problem or '%.0f' % (found['peak_memory_bytes'] / 1e6), done.code)
    return 0


if __name__ == '__main__':
    sys.exit(main())
