#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Ends runs in every way at random moments and checks the files that are left.

Each run has two outputs of any formats, one of which exists before, and a report. It is ended by a signal or
a failed write: a limit on the size of files, a full device, a missing folder, stderr closed or full.
Afterwards an old output must hold its old bytes or a complete, valid result. A run that was stopped (exit
code 4) or succeeded (0) must have written every possible output, valid by `check`. Only SIGKILL may leave
temporary files. Runs alternate between parametrize and convert. Moments are random fractions of the
undisturbed time, from a fixed seed.

Prints a Markdown table of the ways by what happened; exit code 0 exactly if all conditions hold.

Sample runs:
  tests/campaigns/kill_runs.py
  tests/campaigns/kill_runs.py --count 30 --ways SIGKILL,full --seed 2
"""
import argparse
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[2] / 'bench'))
import common  # noqa: E402

SIGNALS = ('SIGINT', 'SIGTERM', 'SIGHUP', 'SIGKILL')
WRITES = ('file size', 'full device', 'unwritable')
STREAMS = ('stderr closed', 'stderr full')
WAYS = SIGNALS + WRITES + STREAMS
OLD = b'old bytes'
OUTPUTS = ('a.vtu', 'b.vtu', 'c.obj', 'd.ply', 'e.msh', 'f.svg', 'g.png', 'h.html')
DATA = ('.vtu', '.obj', '.ply', '.msh')            # formats that `check` can judge
MOST_BYTES = 1 << 21                              # no file of these runs is larger


class Trial:
    """One run in a folder of its own."""

    def __init__(self, options, way, rng, prepared, folder):
        self.options, self.way, self.rng, self.folder = options, way, rng, folder
        self.verb = rng.choice(('parametrize', 'convert'))
        self.source, self.duration = prepared[self.verb]
        self.outputs = [folder / name for name in rng.sample(OUTPUTS, 2)]
        self.blocked = None                       # an output that cannot be written, or None
        self.outputs[0].write_bytes(OLD)
        self.cells = rng.choice(('bezier', 'lagrange'))  # cells of VTU
        if way == 'full device':
            self.blocked = rng.choice(self.outputs)
            self.blocked.unlink(missing_ok=True)
            self.blocked.symlink_to('/dev/full')
        elif way == 'unwritable':
            self.blocked = rng.choice(self.outputs)
            self.blocked.unlink(missing_ok=True)
            self.blocked.mkdir()

    def command(self):
        words = [self.options.binary.resolve(), self.verb, self.source]
        for path in self.outputs:
            words += ['-o', path]
        words += ['--report', self.folder / 'report.json']
        if any(str(path).endswith('.vtu') for path in self.outputs):
            words += ['--vtu', self.cells]
        return [str(w) for w in words] + (job_flags() if self.verb == 'parametrize' else [])

    def limits(self):
        if self.way == 'file size':
            limit = int(MOST_BYTES ** self.rng.random())
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
        if self.way == 'stderr closed':
            os.close(2)

    def run(self):
        """Returns the exit code, negative for a signal; None if the run had to be killed."""
        with open('/dev/full' if self.way == 'stderr full' else '/dev/null', 'w') as messages:
            process = subprocess.Popen(self.command(), stdin=subprocess.DEVNULL,
                                       stdout=subprocess.DEVNULL, stderr=messages,
                                       preexec_fn=self.limits)
        try:
            if self.way in SIGNALS:
                time.sleep(1.1 * self.duration * self.rng.random())
                process.send_signal(getattr(signal, self.way))
            return process.wait(self.options.timeout)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
            return None

    def is_valid(self, path):
        if path.suffix not in DATA:
            return path.stat().st_size > len(OLD)
        words = [self.options.binary.resolve(), 'check', path, '--quiet']
        return common.run(words, self.options.timeout).code == 0

    def allowed_codes(self):
        ended = [] if self.way not in SIGNALS else [-getattr(signal, self.way)]
        return {'unwritable': [1], 'full device': [1], 'file size': [0, 1]}.get(self.way, [0, 4] + ended)

    def problems(self, code):
        found = [] if code in self.allowed_codes() else ['exit %s' % code]
        for number, path in enumerate(self.outputs):
            if path == self.blocked or path.is_symlink():
                continue
            if not path.exists():
                if number == 0:
                    found.append('old file lost')
                elif code in (0, 4) or self.way == 'full device':
                    found.append('not written')
            elif number == 0 and path.read_bytes() == OLD:
                if code in (0, 4) or self.way == 'full device':
                    found.append('not replaced')
            elif not self.is_valid(path):
                found.append('invalid')
        known = {path.name for path in self.outputs} | {'report.json'}
        if code in (0, 4) and common.load_report(self.folder / 'report.json')[1]:
            found.append('no report')
        left = [item for item in os.listdir(self.folder) if item not in known]
        if left and self.way != 'SIGKILL':
            found.append('left: ' + ' '.join(left))
        return found


def job_flags():
    """Returns options for a run of about a second, with temporary files large enough to be caught."""
    return ['--degree', '4', '--threads', '1']


def prepare(options, folder):
    """Returns for each verb its input and the seconds of a run."""
    mesh, result = common.ROOT / 'examples/meshes/creature.obj', folder / 'result.vtu'
    done = common.parametrize(options, mesh, [result, folder / 'b.vtu'], *job_flags())
    if done.code not in (0, 4):
        sys.exit('the undisturbed run ends with %s: %s' % (done.code, done.stderr))
    command = [options.binary.resolve(), 'convert', result, '-o', folder / 'a.vtu', '-o', folder / 'b.vtu']
    return {'parametrize': (mesh, done.seconds),
            'convert': (result, common.run(command, options.timeout).seconds)}


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    common.add_options(parser, timeout=120)
    parser.add_argument('--count', type=int, default=200, help='runs, evenly divided among the ways')
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--ways', default=','.join(WAYS), help='comma separated')
    return parser.parse_args()


def main():
    options = parse_arguments()
    ways, rng = options.ways.split(','), random.Random(options.seed)
    codes, problems = {way: Counter() for way in ways}, {way: [] for way in ways}
    with tempfile.TemporaryDirectory(prefix='majorant_kill_') as place:
        prepared = prepare(options, Path(place))
        for k in range(options.count):
            way, folder = ways[k % len(ways)], Path(place) / str(k)
            folder.mkdir()
            trial = Trial(options, way, rng, prepared, folder)
            code = trial.run()
            codes[way][code] += 1
            problems[way] += ['run %d (%s): %s' % (k, trial.verb, p) for p in trial.problems(code)]
            shutil.rmtree(folder)
    rows = [[way, sum(codes[way].values()),
             ', '.join('%s: %d' % (code, n) for code, n in sorted(codes[way].items(), key=str)),
             '; '.join(problems[way]) or 'none'] for way in ways]
    print('\n'.join(common.markdown_table(['way', 'runs', 'exit codes', 'problems'], rows)))
    return 1 if any(problems.values()) else 0


if __name__ == '__main__':
    sys.exit(main())
