#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Figure 9: what higher degrees gain, over models, resolutions and constraints.

Claim ([MC20] Fig. 9, Sec. 8.1): of 26 models at three resolutions, with free boundary, fixed
boundary and five random points held, quadratic and cubic maps consistently have a lower symmetric
Dirichlet energy than linear ones; the gain shrinks with the resolution, is often larger under
constraints, and cubic maps are hardly better than quadratic ones.

Here: the 13 public disks with 500, 2,500 and 10,000 faces, from Tutte's map, the paper's majorizer,
numbers of quadrature points (1, 36, 78) and stopping rule; held points stay where the start has
them. Energies are integrated adaptively, by the command (the paper: 5,050 points).

Time: about five minutes of one core.

Sample run:
  bench/experiments/figure_9.py --out build/experiments
"""
import sys

import experiment
import gains

SETTINGS = ('free', 'fixed', 'pins')
ENERGY = 'symmetric-dirichlet'
EQUAL = 1 + 1e-5                                   # ratio up to which energies count as equal


def measure(options):
    jobs = [(path, setting, degree, ENERGY) for faces in experiment.resolutions(options, 500, 2500, 10000)
            for setting in SETTINGS for path in experiment.disks(options, faces) for degree in gains.DEGREES]
    return experiment.together(options, lambda job: gains.energy_of(options, job), jobs)


def draw(rows):
    return gains.draw(rows, SETTINGS, ENERGY)


def table(rows):
    return gains.table(rows, SETTINGS, ENERGY)


def judge(rows):
    two, three = (gains.relative(rows, degree) for degree in (2, 3))
    sizes = experiment.values(rows, 'faces')
    medians = {setting: [experiment.median(gains.relative(rows, 3, setting=setting, faces=faces).values())
                         for faces in sizes] for setting in SETTINGS}
    free, pins = (gains.relative(rows, 3, setting=setting) for setting in ('free', 'pins'))
    more = [pins[name, faces, 'pins'] < free[name, faces, 'free'] for name, faces, _ in free]
    late = [(two[key] - three[key]) / (1 - three[key]) for key in three if three[key] < 1 / EQUAL]
    lower = [two[key] <= EQUAL and three[key] <= EQUAL for key in two]
    return [
        experiment.Criterion('no quadratic or cubic map has a higher energy than the linear one',
                             experiment.count(lower), all(lower)),
        experiment.Criterion('the median gain of cubic maps shrinks with the resolution, in every setting',
                             '; '.join('%s: %s %%' % (setting, ', '.join('%.1f' % (100 - 100 * part)
                                                                         for part in parts))
                                       for setting, parts in medians.items()),
                             all(parts == sorted(parts) for parts in medians.values()),
                             'With a fixed boundary those models gain most, at every resolution, that have '
                             'faces with all three corners on the circle (helix, koala, plane, scorpion, '
                             'skull): straight ones are squeezed there, curved ones are not.'),
        experiment.Criterion('held points make it larger more often than not', experiment.count(more),
                             sum(more) > len(more) / 2),
        experiment.Criterion('going from quadratic to cubic is at most a quarter of the gain, in the median',
                             '%.0f %%' % (100 * experiment.median(late)), experiment.median(late) <= 0.25)]


if __name__ == '__main__':
    sys.exit(experiment.main(sys.modules[__name__]))
