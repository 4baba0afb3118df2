#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Compares whole runs of two binaries, from file to file, on one thread and on two.

`majorant parametrize IN OUT.obj` (degree 1) runs several times, all binaries in turn. Prints the least
seconds and the least CPU seconds. bench/common.py makes meshes of other sizes (subdivided()). Needs an idle machine.

Sample runs:
  bench/whole_process.py --beside old/majorant spot_10000.obj spot_160k.obj
"""
import sys
import tempfile
from pathlib import Path

import common
import load

HEADER = ['mesh', 'binary', '1 thread, s', '2 threads, s', '1 thread, CPU s', '2 threads, CPU s']


def main():
    parser = common.parser(__doc__)
    parser.add_argument('meshes', nargs='+', type=Path)
    parser.add_argument('--beside', action='append', type=Path, default=[], help='programs to measure before --binary')
    parser.add_argument('--rounds', type=int, default=3)
    options = parser.parse_args()
    common.require_idle(options)
    programs = [*options.beside, options.binary]
    table = common.Table('', *HEADER)
    with tempfile.TemporaryDirectory() as folder:
        for mesh in options.meshes:
            runs = {}
            for _ in range(options.rounds):
                for binary in programs:
                    for threads in (1, 2):
                        command = [binary.resolve(), 'parametrize', mesh, Path(folder) / 'out.obj', '--quiet',
                                   '--threads', str(threads)]
                        runs.setdefault((binary, threads), []).append(load.measure(command))
            for binary in programs:
                least = [[min(run[which] for run in runs[binary, threads]) for threads in (1, 2)] for which in (1, 0)]
                table.row(mesh.stem, binary, *('%.3g' % value for row in least for value in row))


if __name__ == '__main__':
    sys.exit(main())
