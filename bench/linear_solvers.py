#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""The linear solvers of one process: conjugate gradients per step, seconds, memory, and the memory estimate.

Sample runs (bench/common.py makes larger meshes):
  bench/linear_solvers.py ../shared/data/public/disks/*_10000.obj --counts
  bench/linear_solvers.py nefertiti_40000.obj nefertiti_160000.obj --max-iterations 6
  bench/linear_solvers.py nefertiti_10000.obj nefertiti_160000.obj --table
  bench/linear_solvers.py nefertiti_1000000.obj nefertiti_4000000.obj --solvers direct cg-hypre --init auto

Prints a line per run, on one thread. With --counts, majorant-mpi as one process solves every system to a residual of
1e-2 at least: conjugate gradients up to that residual, mean and maximum. With --table, `majorant compare
--linear-solvers` measures the parts of the first system of a run: CPU seconds (medians), memory, residual. Otherwise:
seconds of a step by parts, means over all but the first; the peak of memory, in all and per face; the memory of process
and factor estimated after the analysis, relative to that peak.
"""
import json
import os
import re
import subprocess
import sys
import tempfile

import common

BUILD = os.path.join(os.path.dirname(__file__), '..', 'build', 'release')
MPI = os.path.join(BUILD, 'apps', 'majorant-mpi')
ENVIRONMENT = dict(os.environ, OMP_NUM_THREADS='1', OPENBLAS_NUM_THREADS='1')


def report_of(words, folder):
    path = os.path.join(folder, 'report.json')
    if os.path.exists(path):
        os.remove(path)
    done = subprocess.run(words + ['--report', path, '--quiet'], env=ENVIRONMENT, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if not os.path.exists(path):
        sys.exit('%s: exit %d: %s' % (' '.join(words), done.returncode, done.stdout.strip()[-300:]))
    with open(path) as f:
        return json.load(f), done.stdout


def run_options(mesh, args):
    return [mesh, '--degree', str(args.degree), '--init', args.init, '--max-iterations',
            str(args.max_iterations)]


def solves(text):
    """Returns the residuals of each solve in the output of a monitor of PETSc."""
    found = []
    for k, residual in re.findall(r'(\d+) KSP Residual norm ([\d.e+-]+)', text):
        if k == '0':
            found.append([])
        found[-1].append(float(residual))
    return found


def counts(mesh, args, folder):
    words = [MPI, 'parametrize', *run_options(mesh, args), '-o', os.path.join(folder, 'a.pvtu'),
             '--linear-solver', 'cg-hypre', '--petsc-options',
             '-majorant_hypre_ksp_rtol 1e-2 -majorant_hypre_ksp_monitor ' + args.petsc_options]
    report, output = report_of(words, folder)
    taken, other = [], 0
    for residuals in solves(output)[1:]:  # the first solve is that of the start
        small = [k for k, r in enumerate(residuals) if r <= 1e-2 * residuals[0]]
        if small:
            taken.append(small[0])
        else:
            other += 1
    return '%4d steps  %3d solves, cg mean %5.1f most %3d  %d indefinite or given up  energy %.8f' % (
        len(report['iterations']), len(taken), sum(taken) / max(1, len(taken)), max(taken, default=0), other,
        report['result']['value'])


def cost(mesh, solver, args, folder):
    words = [str(args.binary), 'parametrize', *run_options(mesh, args), '-o', os.path.join(folder, 'a.vtu'),
             '--linear-solver', solver, '--threads', '1']
    report, _ = report_of(words, folder)
    rows = [r for r in report['iterations'] if r['degree'] == args.degree and r['level'] == 0][1:]
    part = {key: sum(r['seconds'][key] for r in rows) / max(1, len(rows))
            for key in ('assemble', 'factorize', 'solve', 'line_search')}
    peak, faces, memory = report['peak_memory_bytes'], report['input']['faces'], report.get('memory')
    foretold = (memory['process_bytes'] + memory['factor_bytes']) / peak if memory else 0
    gradients = [r['solver_iterations'] for r in rows]
    return ('%3d steps  assemble %.3f factorize %.3f solve %.3f line search %.3f  a step %.3f s  cg %5.1f  '
            'peak %5d MB, %4.2f KB a face  foretold %.2f  %s' % (
                len(report['iterations']), *part.values(), sum(part.values()),
                sum(gradients) / max(1, len(gradients)), peak >> 20, peak / faces / 1000, foretold,
                report['status']))


def table(mesh, args, folder):
    """Prints a line per solver."""
    report, _ = report_of([str(args.binary), 'compare', mesh, '--degree', str(args.degree), '--max-iterations', '0',
                           '--linear-solvers', ','.join(args.solvers)], folder)
    unknowns = re.search(r'(\d+) unknowns', report['result']['title'])[1]
    for row in report['result']['linear_solvers']:
        yield '%8s unknowns  %-9s' % (unknowns, row['name']) + (
            row['message'] or 'analyze %8.4f factorize %8.4f solve %8.4f s  memory %6.0f MB  residual %.0e  %s' % (
                row['analyze_seconds'], row['factorize_seconds'], row['solve_seconds'], row['memory_bytes'] / 1e6,
                row['residual'], row['description']))


def main():
    parser = common.parser(__doc__)
    parser.add_argument('meshes', nargs='+')
    parser.add_argument('--solvers', nargs='+', default=['direct', 'cholmod', 'mumps', 'cg-hypre'],
                        help='with --table also eigen, and all')
    parser.add_argument('--degree', type=int, default=1)
    parser.add_argument('--init', default='tutte')
    parser.add_argument('--max-iterations', type=int, default=1000)
    parser.add_argument('--counts', action='store_true')
    parser.add_argument('--table', action='store_true')
    parser.add_argument('--petsc-options', default='', help='with --counts: more of them')
    args = parser.parse_args()
    if not args.counts:
        common.require_idle(args)
    with tempfile.TemporaryDirectory() as folder:
        for mesh in args.meshes:
            name = '%-20s %d ' % (os.path.basename(mesh)[:-4], args.degree)
            if args.counts:
                print(name + counts(mesh, args, folder), flush=True)
                continue
            if args.table:
                for line in table(mesh, args, folder):
                    print(name + line, flush=True)
                continue
            for solver in args.solvers:
                print(name + '%-9s' % solver + cost(mesh, solver, args, folder), flush=True)


if __name__ == '__main__':
    sys.exit(main())
