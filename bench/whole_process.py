#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""What a run costs from file to file, of one binary beside another, on one thread and on two.

`majorant parametrize IN OUT.obj` (degree 1), each so often, the runs of all binaries in turn; printed are the least
seconds and the least CPU seconds. Meshes of other sizes come from bench/subdivide.py. Needs a machine that is idle.

Sample runs:
  bench/whole_process.py --binary old/majorant --binary build/release/apps/majorant spot_10000.obj spot_160k.obj
"""
import argparse
import sys
import tempfile
from pathlib import Path

import common
import load

HEADER = ['mesh', 'binary', '1 thread, s', '2 threads, s', '1 thread, CPU s', '2 threads, CPU s']


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('meshes', nargs='+', type=Path)
    parser.add_argument('--binary', action='append', type=Path, required=True)
    parser.add_argument('--rounds', type=int, default=3)
    options = parser.parse_args()
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for mesh in options.meshes:
            runs = {}
            for _ in range(options.rounds):
                for binary in options.binary:
                    for threads in (1, 2):
                        command = [binary.resolve(), 'parametrize', mesh, Path(folder) / 'out.obj', '--quiet',
                                   '--threads', str(threads)]
                        runs.setdefault((binary, threads), []).append(load.measure(command))
            for binary in options.binary:
                least = [[min(run[which] for run in runs[binary, threads]) for threads in (1, 2)] for which in (1, 0)]
                rows.append([mesh.stem, str(binary)] + ['%.3g' % value for row in least for value in row])
    print('\n'.join(common.markdown_table(HEADER, rows)))


if __name__ == '__main__':
    sys.exit(main())
