#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""majorant-mpi against one process: energies, iterations, memory per rank; every result checked.

Sample runs:
  bench/distributed.py ../shared/data/public/disks/*_2500.obj --ranks 1 2 4 --degrees 1 2 3
  bench/distributed.py big.obj --ranks 1 2 4 --degrees 1 --solver cg-hypre --no-serial

Prints a line per run: mesh, degree, ranks, energy, its difference from one process, iterations (conjugate
gradients in all and at most), indefinite matrices, failures of PETSc's methods, memory of the
largest rank, seconds. All runs start from Tutte's map. With more ranks than cores, seconds do not show the
speed on a cluster.
"""
import argparse
import json
import os
import subprocess
import sys
import tempfile

BUILD = os.path.join(os.path.dirname(__file__), '..', 'build', 'release')
SERIAL = os.path.join(BUILD, 'apps', 'majorant')
MPI = os.path.join(BUILD, 'apps', 'majorant-mpi')
ENVIRONMENT = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT='1', OMPI_ALLOW_RUN_AS_ROOT_CONFIRM='1',
                   OMPI_MCA_rmaps_base_oversubscribe='1', OMPI_MCA_hwloc_base_binding_policy='none',
                   OMPI_MCA_btl_vader_single_copy_mechanism='none',
                   OMP_NUM_THREADS='1', OPENBLAS_NUM_THREADS='1')


def report_of(words, folder):
    path = os.path.join(folder, 'report.json')
    if os.path.exists(path):
        os.remove(path)
    done = subprocess.run(words + ['--report', path, '--quiet'], env=ENVIRONMENT, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    if not os.path.exists(path):
        return {'failure': 'exit %d: %s' % (done.returncode, done.stderr.strip()[:200])}
    with open(path) as f:
        return json.load(f)


def measure(mesh, degree, ranks, serial, args, folder):
    out = os.path.join(folder, 'all.pvtu')
    words = ['mpirun', '-n', str(ranks), MPI, 'parametrize', mesh, '-o', out, '--degree', str(degree),
             '--linear-solver', args.solver]
    report = report_of(words, folder)
    name = '%-18s %d %2d  ' % (os.path.basename(mesh)[:-4], degree, ranks)
    if 'failure' in report:
        return name + report['failure']
    checked = subprocess.run([SERIAL, 'check', out, '--surface', mesh, '--quiet'], stdout=subprocess.PIPE,
                             stderr=subprocess.PIPE)
    value = report['result']['value']
    methods = [use for use in report['linear_solver'].values() if isinstance(use, dict)]
    difference = '%9.1e' % (value / serial - 1) if serial else '        -'
    return name + '%.10f %s %4d  cg %5d %3d  indefinite %2d  falls %2d  %4d MB  %6.1f s  %s%s' % (
        value, difference, len(report['iterations']), sum(u['iterations'] for u in methods),
        max(u['most_iterations'] for u in methods), report['linear_solver']['indefinite'],
        sum(u['falls'] for u in methods), max(r['peak_memory_bytes'] for r in report['ranks']) >> 20,
        report['seconds']['total'], report['status'], '' if checked.returncode == 0 else ', CHECK FAILS')


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('meshes', nargs='+')
    parser.add_argument('--ranks', type=int, nargs='+', default=[1, 2, 4])
    parser.add_argument('--degrees', type=int, nargs='+', default=[1, 2, 3])
    parser.add_argument('--solver', default='auto')
    parser.add_argument('--no-serial', action='store_true')
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        for mesh in args.meshes:
            for degree in args.degrees:
                serial = None
                if not args.no_serial:
                    words = [SERIAL, 'parametrize', mesh, '-o', os.path.join(folder, 'one.vtu'), '--init',
                             'tutte', '--degree', str(degree)]
                    serial = report_of(words, folder)['result']['value']
                for ranks in args.ranks:
                    print(measure(mesh, degree, ranks, serial, args, folder), flush=True)


if __name__ == '__main__':
    sys.exit(main())
