#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Kills runs of majorant-mpi at random moments and resumes them on another number of ranks.

Sample runs:
  tests/campaigns/kill_and_resume.py ../shared/data/public/disks/*_2500.obj --kills 20 --seed 1
  tests/campaigns/kill_and_resume.py hand.obj --degree 1 --kills 5 --every 3

Kills go through the meshes in turn. Prints a line for each: mesh, seconds from the first checkpoint to the
kill and of the whole solve, ranks before and after, iterations in the checkpoint and after it, energy, and
its difference from an undisturbed run. The last line has the largest difference; exit code 1 if it exceeds
1e-8. Looser tolerances allow larger differences, since a resumed run takes other steps at first.
"""
import argparse
import json
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[2] / 'bench'))
from distributed import ENVIRONMENT, MPI, report_of  # noqa: E402

LIMIT = 1e-8


def words(mesh, ranks, args, folder):
    return ['mpirun', '-n', str(ranks), MPI, 'parametrize', mesh, '-o', os.path.join(folder, 'all.pvtu'),
            '--degree', str(args.degree), '--tolerance', str(args.tolerance)]


def kill(mesh, ranks, moment, victim, args, kept, folder):
    run = subprocess.Popen(words(mesh, ranks, args, folder) +
                           ['--checkpoint', kept, '--every', str(args.every), '--quiet'],
                           env=ENVIRONMENT, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                           stderr=subprocess.DEVNULL)
    pids = []
    while len(pids) < ranks and run.poll() is None:
        pids = subprocess.run(['pgrep', '-P', str(run.pid), '-x', 'majorant-mpi'], stdout=subprocess.PIPE,
                              text=True).stdout.split()
    while not os.path.exists(kept) and run.poll() is None:
        time.sleep(0.001)
    time.sleep(moment)
    if run.poll() is None:
        os.kill(int(pids[victim]), signal.SIGKILL)
    try:
        run.wait(timeout=60)
    except subprocess.TimeoutExpired:  # mpirun itself does not end: see docs/several_processes.md
        run.kill()
        run.wait()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('meshes', nargs='+')
    parser.add_argument('--degree', type=int, default=3)
    parser.add_argument('--tolerance', type=float, default=1e-9)
    parser.add_argument('--kills', type=int, default=20)
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--every', type=int, default=1)
    args = parser.parse_args()
    chance = random.Random(args.seed)
    whole, worst = {}, 0.0
    with tempfile.TemporaryDirectory() as folder:
        kept = os.path.join(folder, 'run.ckpt')
        for k in range(args.kills):
            mesh = args.meshes[k % len(args.meshes)]
            if mesh not in whole:
                report = report_of(words(mesh, 2, args, folder), folder)
                whole[mesh] = report['result']['value'], report['seconds']['optimize']
            value, seconds = whole[mesh]
            before, after = chance.sample([1, 2, 3, 4], 2)
            moment = chance.uniform(0, seconds)
            if os.path.exists(kept):
                os.remove(kept)
            kill(mesh, before, moment, chance.randrange(before), args, kept, folder)
            report = report_of(words(mesh, after, args, folder) + ['--resume', kept], folder)
            if 'failure' in report:
                sys.exit(report['failure'])
            difference = abs(report['result']['value'] / value - 1)
            worst = max(worst, difference)
            print('%-18s %5.2f of %5.2f s  %d -> %d ranks  %3d + %3d iterations  %.12f  %7.1e  %s' % (
                os.path.basename(mesh)[:-4], moment, seconds, before, after,
                report['resumed']['iterations'], len(report['iterations']),
                report['result']['value'], difference, report['status']), flush=True)
    print('largest difference %.1e' % worst)
    return 0 if worst <= LIMIT else 1


if __name__ == '__main__':
    sys.exit(main())
