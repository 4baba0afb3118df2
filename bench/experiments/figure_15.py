#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Figure 15: how many quadrature points, at the final degree from the start.

Claim ([MC20] Fig. 15, Sec. 8.3): without elevation, too few quadrature points lead to bad local
minima; 36 for quadratic and 78 for cubic maps are enough. Schemes made for polynomials (79 and 175
points) are worse than uniform points and often get stuck.

Here: `majorant_paper_method --direct --exclude` on five public disks with 500 faces, free and fixed
boundary, degrees 2 and 3, 3 to 120 uniform points; instead of the schemes of the paper, which the
library does not have, 196 Gauss points of a square collapsed to the triangle, exact to degree 26.
Energies are integrated adaptively at the end.

Time: about twenty seconds of one core.

Sample run:
  bench/experiments/figure_15.py --out build/experiments
"""
import sys

import experiment
import quadrature
from quadrature import draw, table  # noqa: F401

FEW = 10


def measure(options):
    return quadrature.measure(options, ['--direct', '--exclude'])


def judge(rows):
    few = [part > quadrature.WITHIN for points in experiment.values(rows, 'points') if points <= FEW
           for part in quadrature.excess(rows, points=points)]
    enough, worse = quadrature.enough(rows), quadrature.gauss_is_worse(rows)
    return [experiment.Criterion('up to %d points end more than 1 %% above the best more often than not'
                                 % FEW, experiment.count(few), sum(few) > len(few) / 2),
            experiment.Criterion('36 and 78 points end within 1 % of the best', experiment.count(enough),
                                 all(enough), 'The others are held at the limit of injectivity.'),
            experiment.Criterion('Gauss points end higher than 36 and 78 uniform ones, more often than not',
                                 experiment.count(worse), sum(worse) > len(worse) / 2,
                                 'On maps that do not get stuck a rule of higher order integrates better '
                                 'than a lattice, which is exact for linear functions alone.')]


if __name__ == '__main__':
    sys.exit(experiment.main(sys.modules[__name__]))
