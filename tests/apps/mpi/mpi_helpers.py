# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Shared code of the tests of majorant-mpi: running it on several ranks of this machine."""
import json
import os
import resource
import signal
import subprocess
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(__file__), '..'))
from command_helpers import *  # noqa: E402,F403

MPI_BINARY = os.environ.get('MAJORANT_MPI_BINARY', '')
DATA = os.environ.get('MAJORANT_SHARED_DATA', '')

BUNDLED = {'nefertiti_500': 'cap', 'helix_500': 'wavy_disk', 'plane_500': 'creature', 'hand_2500': 'creature',
           'scorpion_2500': 'creature'}

# Allows more ranks than cores, as root in a container, with one thread each.
ENVIRONMENT = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT='1', OMPI_ALLOW_RUN_AS_ROOT_CONFIRM='1',
                   OMPI_MCA_rmaps_base_oversubscribe='1', OMPI_MCA_hwloc_base_binding_policy='none',
                   OMPI_MCA_btl_vader_single_copy_mechanism='none',
                   OMP_NUM_THREADS='1', OPENBLAS_NUM_THREADS='1')


def need_mpi():
    """Ends the program as skipped if majorant-mpi was not built."""
    if not MPI_BINARY or not os.path.exists(MPI_BINARY):
        print('skipped: no majorant-mpi (cmake/scripts/packages_mpi.txt)')
        sys.exit(77)


def mpirun(ranks, *args, cwd=None):
    words = ['mpirun', '-n', str(ranks), MPI_BINARY] + [str(a) for a in args]
    return Outcome(subprocess.run(words, cwd=cwd, text=True, env=ENVIRONMENT,  # noqa: F405
                                  stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, timeout=300))


def start(ranks, *args):
    """Starts such a run without waiting for it."""
    words = ['mpirun', '-n', str(ranks), MPI_BINARY] + [str(a) for a in args]
    return subprocess.Popen(words, env=ENVIRONMENT, text=True, stdin=subprocess.DEVNULL,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE)


def processes_of(run, ranks):
    """Returns the process of each rank of a run, as soon as all exist."""
    for _ in range(1000):
        found = subprocess.run(['pgrep', '-P', str(run.pid), '-x', 'majorant-mpi'], stdout=subprocess.PIPE,
                               text=True).stdout.split()
        if len(found) == ranks:
            return [int(pid) for pid in found]
        if run.poll() is not None:
            return []
        time.sleep(0.01)
    return []


def wait_for(run, word):
    """Waits until a verbose run prints the word."""
    for line in run.stderr:
        if word in line:
            return


def ended(run):
    """Returns the exit code and the last output; None if mpirun hangs in a lock of its own after all ranks are gone, as
    OpenMPI 4.1 sometimes does after a rank was killed (PMIx_server_finalize)."""
    for _ in range(12):
        try:
            _, printed = run.communicate(timeout=10)
            return run.returncode, printed
        except subprocess.TimeoutExpired:
            if not living(run):
                run.kill()
                return None, run.communicate()[1]
    raise AssertionError('%s does not end' % run.args)


def living(run):
    """Returns whether a rank of the run is alive, and not a zombie."""
    states = subprocess.run(['ps', '-o', 'stat=', '--ppid', str(run.pid)], stdout=subprocess.PIPE, text=True).stdout
    return any(not state.startswith('Z') for state in states.split())


def disk(name):
    """Returns a public mesh, or a bundled one if there are none."""
    path = os.path.join(DATA, 'disks', name + '.obj')
    return path if DATA and os.path.exists(path) else os.path.join(SOURCE, 'examples/meshes', BUNDLED[name] + '.obj')


def face_count(mesh):
    with open(mesh) as f:
        return sum(line.startswith('f ') for line in f)


class MpiTest(CommandTest):  # noqa: F405
    def solve(self, ranks, mesh, *args, out='all', code=0):
        """Returns the report of a run on so many ranks."""
        report = self.path(out + '.json')
        done = mpirun(ranks, 'parametrize', mesh, '-o', self.path(out + '.pvtu'), '--report', report, *args)
        self.assertEqual(done.code, code, done.err)
        self.printed = done.err
        return self.report(report)

    def report(self, name):
        with open(self.path(name)) as f:
            return json.load(f)

    def serial(self, mesh, *args):
        report = self.path('serial.json')
        self.run_ok('parametrize', mesh, '-o', self.path('serial.vtu'), '--report', report, '--init', 'tutte',
                    *args)
        with open(report) as f:
            return json.load(f)
