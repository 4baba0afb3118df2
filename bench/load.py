#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Measures runs on a busy machine: CPU seconds and wall seconds, idle and beside spinning processes.

Each run is repeated --rounds times, idle and loaded in turn. The output has the medians, the ratio of CPU seconds
loaded to idle, and the ratio of seconds to the fair share: for example, of a process that gets 2 / (spinners + 2) of
two cores. Needs an otherwise idle machine.

Sample runs:
  bench/load.py
  bench/load.py --spinners 6 --rounds 5 --binary build/release/apps/majorant
"""
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import common

RUNS = {
    'parametrize, degree 1': ('parametrize', 'disks/spot_10000.obj', '--degree', '1'),
    'parametrize, degree 3': ('parametrize', 'disks/spot_2500.obj', '--degree', '3'),
    'bijective': ('parametrize', 'disks/spot_2500.obj', '--degree', '2', '--bijective'),
    'unwrap': ('unwrap', 'closed/koala_7116.obj'),
    'seamless': ('seamless', 'closed/koala_7116.obj', '--degree', '1'),
}
HEADER = ['run', 'CPU s, idle', 'loaded', 'loaded / idle', 's, idle', 'loaded', 'loaded / fair share']


def measure(command):
    """Returns CPU seconds and wall seconds of a command, with its children."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    done = subprocess.run(command, capture_output=True, text=True)
    seconds, after = time.monotonic() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode not in (0, 4):
        sys.exit('%s: exit %s, %s' % (' '.join(map(str, command)), done.returncode, done.stderr.strip()))
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, seconds


class Spinners:
    def __init__(self, count):
        self.count = count

    def __enter__(self):
        self.processes = [subprocess.Popen([sys.executable, '-c', 'while True: pass']) for _ in range(self.count)]
        time.sleep(0.5)

    def __exit__(self, *_):
        for process in self.processes:
            process.kill()
            process.wait()


def main():
    parser = common.parser(__doc__)
    parser.add_argument('--spinners', type=int, default=6, help='processes that spin')
    parser.add_argument('--rounds', type=int, default=3)
    options = parser.parse_args()
    common.require_idle(options)
    cores = len(os.sched_getaffinity(0))
    table = common.Table('', *HEADER)
    for name, (verb, mesh, *flags) in RUNS.items():
        idle, loaded = [], []
        with tempfile.TemporaryDirectory() as folder:
            command = [options.binary.resolve(), verb, options.shared / 'data/public' / mesh, '-o',
                       Path(folder) / 'out.obj', '--quiet', '--force', *flags]
            for _ in range(options.rounds):
                idle.append(measure(command))
                with Spinners(options.spinners):
                    loaded.append(measure(command))
        cpu, seconds, loaded_cpu, loaded_seconds = (statistics.median(one) for one in (
            [i[0] for i in idle], [i[1] for i in idle], [i[0] for i in loaded], [i[1] for i in loaded]))
        # The fair share of one core is 1 / (spinners on that core + 1).
        fair = loaded_cpu * (options.spinners / cores + 1) / min(cores, max(1.0, cpu / seconds))
        table.row(name, *('%.3g' % x for x in (cpu, loaded_cpu, loaded_cpu / cpu, seconds, loaded_seconds,
                                               loaded_seconds / fair)))
    return 0


if __name__ == '__main__':
    sys.exit(main())
