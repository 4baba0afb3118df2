#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Compares one problem in the framework and in Ceres: examples/cloth.cpp and bench/cloth_ceres.cpp, a sheet of 60 by 60
squares that buckles, to the same minimum.

Prints code lines (without empty lines, comments, and the mesh, which both include), CPU seconds of compiling each file
(g++ -O2, no precompiled headers), and CPU seconds of the programs of the build: medians of several runs on one thread.

Sample runs:
  bench/cloth.py
  bench/cloth.py --runs 9
"""
import argparse
import os
import re
import resource
import statistics
import subprocess
import tempfile
from pathlib import Path

from common import ROOT

PROGRAMS = (('majorant', 'examples/cloth.cpp', 'examples/example_cloth'),
            ('Ceres', 'bench/cloth_ceres.cpp', 'bench/cloth_ceres'))


def processor_seconds(command, environment):
    """Runs the command and returns its CPU seconds, children included, and its output."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True, env={**os.environ, **environment})
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime, done.stdout


def median(runs, command, environment):
    taken = [processor_seconds(command, environment) for _ in range(runs)]
    return statistics.median(seconds for seconds, _ in taken), taken[0][1]


def compiled(source, build, runs):
    folders = ['-I%s' % path for path in sorted((build / 'include').iterdir())]
    with tempfile.TemporaryDirectory(prefix='majorant_cloth_') as folder:
        command = ['g++', '-std=c++20', '-O2', '-DNDEBUG', '-DEIGEN_MAX_ALIGN_BYTES=16',
                   '-DEIGEN_MALLOC_ALREADY_ALIGNED=1', '-isystem', '/usr/include/eigen3',
                   *folders, '-c', str(ROOT / source), '-o', folder + '/x.o']
        return median(runs, command, {})[0]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--build', type=Path, default=ROOT / 'build/release')
    parser.add_argument('--runs', type=int, default=3)
    options = parser.parse_args()
    print('| | lines | to compile | steps | to run | energy |\n|---|---|---|---|---|---|')
    for name, source, program in PROGRAMS:
        lines = sum(bool(re.match(r'\s*(?!//)\S', line)) for line in (ROOT / source).read_text().splitlines())
        seconds, output = median(options.runs, [str(options.build / program)],
                               {'OMP_NUM_THREADS': '1', 'OPENBLAS_NUM_THREADS': '1'})
        steps, energy = re.search(r'converged in (\d+) steps: energy (\S+?)[,\s]', output).groups()
        print('| %s | %d | %.1f s | %s | %.2f s | %s |' % (name, lines, compiled(source, options.build, options.runs), steps,
                                                   seconds, energy))


if __name__ == '__main__':
    main()
