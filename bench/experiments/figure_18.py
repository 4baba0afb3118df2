#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Figure 18: energy over time, without degree elevation.

Claim ([MC20] Fig. 18, Sec. 8.4): the time of an iteration is linear in the number of quadrature
points and more than linear in the degree; higher degrees reach lower energies, later.

Here: `majorant_paper_method --direct --exclude` on three public disks with 2,500 faces at degrees
1, 2, 3, with 55 points at every degree (left) and with 1, 36, 78 (right; spot); degree 3 with 55 to
406 points for the first statement. Times are processor time in fe of the degree-1 matrix, the least
of three runs; they move a little all the same.

Time: about half a minute of one core.

Sample run:
  bench/experiments/figure_18.py --out build/experiments
"""
import sys

import numpy as np

import descents
import experiment

COUNTS = (55, 105, 210, 406)                        # quadrature points at degree 3
LINEAR = 0.95                                      # lower bound on the squared correlation
WAYS = {**{'degree %d, 55 points' % n: ['--degree', n, '--points', 55] for n in (1, 2, 3)},
        **{'degree %d' % n: ['--degree', n] for n in (1, 2, 3)},
        **{'degree 3, %d points' % points: ['--degree', 3, '--points', points]
           for points in COUNTS if points != 55}}


def measure(options):
    faces, = experiment.resolutions(options, 500) if options.quick else (2500,)
    return sum([descents.descend(options, path, way, '--direct', '--exclude', *flags)
                for path in experiment.disks(options, faces, descents.MODELS)
                for way, flags in WAYS.items()], [])


def draw(rows):
    figure, axes = experiment.panels(1, 2, 3.4, 2.6, sharey=True)
    for axis, suffix in zip(axes[0], (', 55 points', '')):
        styles = {'degree %d%s' % (n, suffix): (experiment.COLOURS[n], '-', experiment.NAMES[n])
                  for n in (1, 2, 3)}
        descents.draw_runs(axis, descents.runs(rows), rows[0]['model'], styles)
        axis.set(title=suffix[2:] or '1, 36, 78 points')
        least = min(row['energy'] for row in rows if row['model'] == rows[0]['model'])
        axis.set_ylim(0.99 * least, 4 * least)
        axis.set_yticks([5, 6, 8, 10, 15], ['5', '6', '8', '10', '15'])
        axis.minorticks_off()
    axes[0][1].legend()
    axes[0][1].set_ylabel('')
    return figure


def table(rows):
    lines = [[model, way, run[-1]['iteration'], '%.1f' % run[-1]['fe'], '%.2f' % descents.cost(run),
              '%.5f' % run[-1]['energy']] for (model, way), run in descents.runs(rows).items()]
    return ['model', 'way', 'iterations', 'fe', 'fe of an iteration', 'energy'], lines


def judge(rows):
    found, models = descents.runs(rows), experiment.values(rows, 'model')
    linear, convex, later, lower = [], [], [], []
    for model in models:
        times = [descents.cost(found[model, 'degree 3, %d points' % points]) for points in COUNTS]
        linear.append(np.corrcoef(COUNTS, times)[0, 1] ** 2)
        one, two, three = (descents.cost(found[model, 'degree %d, 55 points' % n]) for n in (1, 2, 3))
        convex.append(three - two > two - one)
        ends = [found[model, 'degree %d' % n][-1] for n in (1, 2, 3)]
        later.append(ends[0]['fe'] < ends[1]['fe'] < ends[2]['fe'])
        lower.append(ends[0]['energy'] > ends[1]['energy'] > ends[2]['energy'])
    return [experiment.Criterion('time of an iteration over the number of points: squared correlation at '
                                 'least %.2f' % LINEAR, ', '.join('%.3f' % r for r in linear),
                                 min(linear) >= LINEAR),
            experiment.Criterion('with 55 points, from degree 2 to 3 it rises by more than from 1 to 2',
                                 experiment.count(convex), all(convex)),
            experiment.Criterion('each degree takes longer than the one before', experiment.count(later),
                                 all(later)),
            experiment.Criterion('and ends lower', experiment.count(lower), all(lower))]


if __name__ == '__main__':
    sys.exit(experiment.main(sys.modules[__name__]))
