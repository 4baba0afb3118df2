#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Figure 16: how many quadrature points, with degree elevation.

Claim ([MC20] Fig. 16, Sec. 8.3): with elevation the number of quadrature points is less critical
than without; relatively small numbers are enough in many cases.

Here: as figure 15, with elevation instead of exclusion, and beside it what figure 15 runs, to
compare. All degrees of a run have the same number of points.

Time: about half a minute of one core.

Sample run:
  bench/experiments/figure_16.py --out build/experiments
"""
import sys

import experiment
import quadrature

FEW = 21


def measure(options):
    return [{'way': way, **row} for way, flags in (('elevated', []), ('direct', ['--direct', '--exclude']))
            for row in quadrature.measure(options, flags)]


def elevated(rows):
    return experiment.where(rows, way='elevated')


def draw(rows):
    return quadrature.draw(elevated(rows))


def table(rows):
    return quadrature.table(elevated(rows))


def within(rows, points):
    """Returns for each way the runs with lattice rules that end within 1 % of the best of both ways."""
    least = quadrature.best(rows)
    return {way: [r['energy'] <= quadrature.WITHIN * least[r['model'], r['setting'], r['degree']]
                  for r in experiment.where(rows, way=way, rule='lattice') if r['points'] in points]
            for way in ('elevated', 'direct')}


def judge(rows):
    counts = experiment.values(experiment.where(rows, rule='lattice'), 'points')
    each, few = within(rows, counts), within(rows, [n for n in counts if n <= FEW])
    enough = quadrature.enough(elevated(rows))
    return [experiment.Criterion('more numbers of points than without elevation end within 1 % of the best',
                                 '%s against %s' % tuple(map(experiment.count, each.values())),
                                 sum(each['elevated']) > sum(each['direct'])),
            experiment.Criterion('up to %d points end there, more often than not' % FEW,
                                 experiment.count(few['elevated']),
                                 sum(few['elevated']) > len(few['elevated']) / 2),
            experiment.Criterion('36 and 78 points always end within 1 % of the best',
                                 experiment.count(enough), all(enough),
                                 'The others are held at the limit of injectivity.')]


if __name__ == '__main__':
    sys.exit(experiment.main(sys.modules[__name__]))
