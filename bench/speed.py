#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Measures maps in fe: factorizations and solves of the same matrix.

1 fe is one factorization and solve by CHOLMOD with fixed settings, measured in the same process
(bench/unit_fe.h). Times run from the mesh in memory to the control points in memory, with the start,
without reading, writing and the final proof. Medians of --repeat, on --threads. Counts,
energies and ratios hold on any machine. Exit code 0 if every figure keeps the target beside it.

Each table is a command:
  accuracy      fe until the energy is within 1e-4 of the minimum that the run reaches;
                --pieces: on meshes whose faces are cut into PIECES^2 (4: 160K, 5: 250K, 10: 1M)
  iterations    fe per iteration from Tutte's map: whole runs divided by their iterations
  degrees       degree 3 from scratch compared with degree 1
  bijective     without overlaps compared with free, both from Tutte's map
  convergence   the energy at the default tolerance compared with --tolerance 1e-11
  memory        one large mesh by the command: valid, peak memory
  against       energies, iterations and CPU seconds compared with an --old program

Sample runs:
  bench/speed.py accuracy
  bench/speed.py accuracy --meshes '^(spot|hand)_10000$' --pieces 4 --repeat 1
  bench/speed.py convergence --meshes '_500$'
  bench/speed.py against --old /tmp/before/majorant --meshes '_500$' --degrees 1,2
"""
import json
import math
import os
import re
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import common

SOLVER_COST = common.ROOT / 'build/release/bench/solver_cost'
# Upper bounds on fe to 1e-4, by shape: at about 10000 faces, and for subdivided meshes.
WITHIN = {'plane': 16, 'hand': 16, 'scorpion': 20, 'penguin': 30}
WITHIN_EASY = 8
WITHIN_LARGE = {'hand': 10, 'scorpion': 16, 'penguin': 20}
WITHIN_LARGE_EASY = 6
ITERATION = 1.3                                   # bound on fe per iteration from Tutte's map
BIJECTIVE = {'helix': 3.0}                        # bound relative to the free run
BIJECTIVE_OTHERS = 2.0
DEGREE_3 = (3, 4)                                 # bound on degree 3: this factor times degree 1, plus this number of fe
CONVERGENCE = 1e-4
PEAK = 1.5e9                                       # bound on peak memory, bytes
ENERGY = 1e-6                                     # bound on the relative energy above the old program's
OTHER_MINIMA = {'hand': 1e-3, 'scorpion': 1e-3, 'penguin': 1e-3, 'plane': 1e-3}
SLOWER = 1.05                                     # bound on seconds relative to the old program's


# ------------------------------------------------------------------ meshes and runs
def shape(path):
    return path.stem.split('_')[0]


def meshes(options, usual):
    """Returns the files of the arguments, or those whose names contain options.meshes, or else `usual`."""
    if options.files:
        return options.files
    data, pattern = options.shared / 'data/public', options.meshes or usual
    found = [p for folder in ('disks', 'large') for p in sorted((data / folder).glob('*.obj'))
             if re.search(pattern, p.stem)]
    if not found:
        sys.exit('%s: no meshes of names like %s' % (data, pattern))
    return found


def cut(path, pieces, folder):
    """Writes the mesh with every face cut into pieces^2 to a file of the folder. Returns its path."""
    if pieces == 1:
        return path
    target = Path(folder) / ('%s_by_%d.obj' % (path.stem, pieces))
    if not target.exists():
        common.write_obj(target, *common.subdivided(*common.read_obj(path), pieces))
    return target


def cost(options, path, *flags):
    """Runs solver_cost on one mesh and returns a row for each degree."""
    command = [options.solver_cost, path, '--json', '--repeat', options.repeat,
               '--threads', options.threads, *flags]
    done = common.run(command, options.timeout)
    if done.code != 0:
        sys.exit('%s: exit %s, %s' % (' '.join(map(str, command)), done.code, done.stderr.strip()))
    return json.loads(done.stdout)


def timed(options, binary, path, degree, *flags, threads=None):
    """Returns (report, CPU seconds of start and optimization) of a run of the command."""
    with tempfile.TemporaryDirectory(prefix='majorant_speed_') as folder:
        report = Path(folder) / 'report.json'
        command = [binary.resolve(), 'parametrize', path, '-o', report, '--degree', degree,
                   '--threads', threads or options.threads, '--quiet', *flags]
        process = subprocess.Popen([str(word) for word in command], stderr=subprocess.DEVNULL)
        _, _, usage = os.wait4(process.pid, 0)
        found, problem = common.load_report(report)
    if problem:
        sys.exit('%s: %s' % (' '.join(map(str, command)), problem))
    seconds = found['seconds']
    share = (seconds['initialize'] + seconds['optimize']) / seconds['total']
    return found, share * (usage.ru_utime + usage.ru_stime)


# ------------------------------------------------------------------ the tables
def accuracy(options):
    large = options.pieces > 1
    table = common.Table('To within 1e-4 of the minimum reached, degree 1', 'mesh', 'faces', '1 fe, ms',
                  'iterations', 'factorizations', 'start, fe', 'to 1e-4, fe', 'at most', 'all, fe',
                  'reached', 'kept')
    with tempfile.TemporaryDirectory(prefix='majorant_speed_') as folder:
        for path in meshes(options, '_10000$|^nefertiti_50000$'):
            mesh = cut(path, options.pieces, folder)
            row, = cost(options, mesh, '--init', options.init)
            limits, easy = (WITHIN_LARGE, WITHIN_LARGE_EASY) if large else (WITHIN, WITHIN_EASY)
            limit, took = limits.get(shape(path), easy), row['within_fe']
            table.judged(mesh.stem, face_count(mesh), '%.2f' % row['unit_ms'],
                      common.cell(row['within_iterations']), common.cell(row['within_factorizations']),
                      '%.1f' % row['start_fe'], common.cell(took, '%.1f'), limit,
                      '%.1f' % row['total_fe'], '%.8f' % row['reached'],
                      kept=took is not None and took <= limit)
    return table.end()


def face_count(path):
    with open(path) as file:
        return sum(line.startswith('f ') for line in file)


def iterations(options):
    table = common.Table('An iteration from Tutte\'s map, degree 1', 'mesh', '1 fe, ms', 'iterations',
                  'factorizations', 'start, fe', 'set-up, fe', 'assembly, fe', 'factorization, fe',
                  'solve, fe', 'fe of an iteration', 'kept')
    for path in meshes(options, '_10000$|^nefertiti_50000$'):
        row, = cost(options, path, '--init', 'tutte')
        figures = [row[key + '_fe'] for key in ('start', 'setup', 'assembly', 'factorization', 'solve')]
        table.judged(path.stem, '%.2f' % row['unit_ms'], row['iterations'], row['factorizations'],
                  *('%.2f' % figure for figure in figures), '%.2f' % row['fe_per_iteration'],
                  kept=row['fe_per_iteration'] <= ITERATION)
    return table.end('At most %g fe an iteration.' % ITERATION)


def degrees(options):
    table = common.Table('Degree 3 from scratch', 'mesh', 'degree 1, fe of degree 1', 'ms',
                  '1 fe of degree 3, ms', 'degree 3, ms', 'over degree 1 and %d fe' % DEGREE_3[1],
                  'kept')
    ratios = []
    for path in meshes(options, '_10000$'):
        one, three = cost(options, path, '--degrees', '1,3')
        whole = [row['total_fe'] * row['unit_ms'] for row in (one, three)]
        ratios.append((whole[1] - DEGREE_3[1] * three['unit_ms']) / whole[0])
        table.judged(path.stem, '%.1f' % one['total_fe'], '%.0f' % whole[0], '%.1f' % three['unit_ms'],
                     '%.0f' % whole[1], '%.2f' % ratios[-1], kept=True)
    table.kept = statistics.median(ratios) <= DEGREE_3[0]
    return table.end('Median (degree 3 - %d fe of degree 3) / degree 1: %.2f, at most %g.'
                     % (DEGREE_3[1], statistics.median(ratios), DEGREE_3[0]))


def bijective(options):
    table = common.Table('Without overlaps against free, degree 1, from Tutte\'s map', 'mesh',
                  'free: iterations', 'fe', 'bijective: iterations', 'fe', 'ratio', 'at most', 'kept')
    for path in meshes(options, '^(hand|spot|koala|helix)_10000$'):
        free, = cost(options, path, '--init', 'tutte')
        held, = cost(options, path, '--init', 'tutte', '--bijective')
        whole = [row['total_fe'] - row['start_fe'] for row in (free, held)]
        # The ratio is of milliseconds, since each process measures its own unit.
        ratio = whole[1] * held['unit_ms'] / (whole[0] * free['unit_ms'])
        limit = BIJECTIVE.get(shape(path), BIJECTIVE_OTHERS)
        table.judged(path.stem, free['iterations'], '%.1f' % whole[0], held['iterations'],
                  '%.1f' % whole[1], '%.2f' % ratio, limit, kept=ratio <= limit)
    return table.end()


def convergence(options):
    table = common.Table('What the default tolerance leaves', 'mesh', 'degree', 'status', 'iterations',
                  'with 1e-11', 'energy', 'above that with 1e-11', 'kept')
    for path in meshes(options, '_(500|2500)$'):
        for degree in options.degrees or (1, 2, 3):
            usual, tight = (timed(options, options.binary, path, degree, *flags)[0]
                            for flags in ([], ['--tolerance', '1e-11']))
            above = usual['result']['value'] / tight['result']['value'] - 1
            table.judged(path.stem, degree, usual['status'], len(common.steps_taken(usual)),
                      len(common.steps_taken(tight)), '%.9f' % usual['result']['value'],
                      '%.1e' % above, kept=above <= CONVERGENCE)
    return table.end('At most %g.' % CONVERGENCE)


def memory(options):
    table = common.Table('A large mesh, degree 1, by the command', 'mesh', 'faces', 'threads', 'status', 'proven',
                  'iterations', 'factorizations', 'CPU s, start and optimization', 'energy',
                  'peak, MB', 'kept')
    with tempfile.TemporaryDirectory(prefix='majorant_speed_') as folder:
        for path in meshes(options, '^spot_10000$'):
            mesh = cut(path, options.pieces if options.pieces > 1 else 10, folder)
            for threads in (1, 2):
                report, seconds = timed(options, options.binary, mesh, 1, threads=threads)
                result, peak = report['result'], report['peak_memory_bytes']
                table.judged(mesh.stem, report['input']['faces'], threads, report['status'],
                          result['locally_injective'], len(common.steps_taken(report)),
                          common.factorizations(report), '%.1f' % seconds,
                          '%.9f' % result['value'], '%.0f' % (peak / 1e6),
                          kept=result['locally_injective'] and peak <= PEAK)
    return table.end('At most %.0f MB.' % (PEAK / 1e6))


def against(options):
    if not options.old:
        sys.exit('against: --old PROGRAM is needed')
    table = common.Table('Beside the program before', 'mesh', 'degree', 'energy before', 'now: part above',
                  'iterations before', 'now', 'factorizations now', 'CPU s before', 'ratio', 'kept')
    logs, ratios = [], []
    for path in meshes(options, '_(500|2500|10000)$'):
        for degree in options.degrees or (1, 2, 3):
            pairs = [[timed(options, binary, path, degree) for binary in (options.old, options.binary)]
                     for _ in range(options.repeat)]
            old, new = pairs[0][0][0], pairs[0][1][0]
            before = statistics.median(a[1] for a, _ in pairs)
            ratio = statistics.median(b[1] / a[1] for a, b in pairs)
            above = new['result']['value'] / old['result']['value'] - 1
            logs.append(math.log1p(above))
            ratios.append(math.log(ratio))
            table.judged(path.stem, degree, '%.9f' % old['result']['value'], '%+.1e' % above,
                      len(common.steps_taken(old)), len(common.steps_taken(new)),
                      common.factorizations(new), '%.2f' % before, '%.2f' % ratio,
                      kept=above <= OTHER_MINIMA.get(shape(path), ENERGY) and ratio <= SLOWER)
    return table.end('Geometric means over %d runs: energies %+.1e, seconds %.3f. Seconds of runs of '
                     'less than 0.1 s say nothing.' % (len(logs), math.expm1(statistics.mean(logs)),
                                                       math.exp(statistics.mean(ratios))))


TABLES = {f.__name__: f for f in (accuracy, iterations, degrees, bijective, convergence, memory, against)}


def parse_arguments():
    parser = common.parser(__doc__, timeout=3600)
    parser.add_argument('tables', nargs='+', choices=list(TABLES), metavar='TABLE', help=', '.join(TABLES))
    parser.add_argument('--solver-cost', type=Path, default=SOLVER_COST, help='the solver_cost program')
    parser.add_argument('--old', type=Path, help='against: the majorant program to compare with')
    parser.add_argument('--meshes', metavar='REGEX', help='searched in the names; default: by table')
    parser.add_argument('--files', type=Path, nargs='+', help='OBJ files instead')
    parser.add_argument('--pieces', type=int, default=1, help='that every edge is cut into')
    parser.add_argument('--degrees', type=lambda text: [int(word) for word in text.split(',')],
                        help='convergence, against: default 1,2,3')
    parser.add_argument('--init', choices=['auto', 'tutte'], default='auto', help='accuracy: the start')
    parser.add_argument('--repeat', type=int, default=5)
    parser.add_argument('--threads', type=int, default=1)
    return parser.parse_args()


def main():
    options = parse_arguments()
    common.require_files(options)
    common.require_idle(options)
    kept = True
    for name in options.tables:
        table = TABLES[name](options)
        kept = kept and table.kept
    return 0 if kept else 1


if __name__ == '__main__':
    sys.exit(main())
