#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Figure 17: setting up and solving at degree 1, over the number of faces.

Claim ([MC20] Fig. 17, Sec. 8.4): an implementation for any degree, set to degree 1, needs hardly
more time for Jacobian, Hessian and solve of an iteration than CompMajor, which is for degree 1
alone.

Here: CompMajor is no part of this project, so its curve is not drawn. Instead the parts of an
iteration in fe, CHOLMOD's factorization and solve of the same matrix: a Newton code that solves
with CHOLMOD needs 1 fe an iteration, and its own assembly on top. `solver_cost --no-runs` on the 13
public disks with 500, 2,500 and 10,000 faces; medians of five, processor time.

Time: about ten seconds of one core.

Sample run:
  bench/experiments/figure_17.py --out build/experiments
"""
import sys

import experiment


def measure(options):
    paths = [path for faces in experiment.resolutions(options, 500, 2500, 10000)
             for path in experiment.disks(options, faces)]
    rows = experiment.json_of(options, 'solver_cost', '--json', '--no-runs', *paths)
    return [{'model': path.stem, 'faces': int(path.stem.rsplit('_', 1)[1]), 'unit_ms': row['unit_ms'],
             'assembly_fe': row['assembly_fe'], 'factorization_fe': row['factorization_fe'],
             'solve_fe': row['solve_fe']} for path, row in zip(paths, rows)]


def draw(rows):
    figure, axes = experiment.panels(1, 1, 4.5, 2.6)
    for key, colour, name in (('assembly_fe', experiment.COLOURS[1], 'gradient and Hessian'),
                              ('factorization_fe', experiment.COLOURS[2], 'factorization'),
                              ('solve_fe', experiment.COLOURS[3], 'solve')):
        axes[0][0].plot([r['faces'] for r in rows], [r[key] for r in rows], 'o', color=colour, label=name,
                        markersize=3)
    axes[0][0].set(xscale='log', yscale='log', xlabel='faces', ylabel='fe')
    axes[0][0].set_xticks(sizes := experiment.values(rows, 'faces'), list(map(str, sizes)))
    axes[0][0].set_yticks([0.03, 0.1, 0.3, 1], ['0.03', '0.1', '0.3', '1'])
    axes[0][0].minorticks_off()
    axes[0][0].legend(loc='upper left', bbox_to_anchor=(1, 1))
    return figure


def table(rows):
    lines = []
    for faces in experiment.values(rows, 'faces'):
        found = experiment.where(rows, faces=faces)
        lines.append([faces, *('%.3g' % experiment.median([r[key] for r in found])
                               for key in ('unit_ms', 'assembly_fe', 'factorization_fe', 'solve_fe'))])
    return ['faces (medians of the models)', '1 fe, ms', 'gradient and Hessian, fe', 'factorization, fe',
            'solve, fe'], lines


def judge(rows):
    parts = [r['assembly_fe'] + r['factorization_fe'] + r['solve_fe'] for r in rows]
    less = [part < 1 for part in parts]
    return [experiment.Criterion('setting up and solving takes hardly more time than CompMajor', '-', None,
                                 'CompMajor itself is not here to be measured.'),
            experiment.Criterion('it takes less than 1 fe on nine meshes of ten',
                                 '%s, median %.2f fe' % (experiment.count(less), experiment.median(parts)),
                                 sum(less) >= 0.9 * len(less))]


if __name__ == '__main__':
    sys.exit(experiment.main(sys.modules[__name__]))
