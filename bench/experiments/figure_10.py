#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Figure 10: the conformal energy gains more.

Claim ([MC20] Fig. 10, Sec. 8.1, Appendix B): with the boundary fixed to a circle, higher degrees
lower the conformal energy E_ASAP, commonly by much more than the symmetric Dirichlet energy.

Here: the 13 public disks with 500 and 2,500 faces, both energies, boundary fixed where Tutte's map
has it, quadrature and stopping rule of the paper. E_ASAP has no barrier: where the conformal map is
not injective, a run ends at the limit of injectivity, at a value that depends on the way there.

Time: about a minute and a quarter of one core.

Sample run:
  bench/experiments/figure_10.py --out build/experiments
"""
import sys

import experiment
import gains

CONFORMAL, ISOMETRIC = 'asap', 'symmetric-dirichlet'
SETTINGS = ('fixed',)


def measure(options):
    jobs = [(path, 'fixed', degree, energy) for energy in (CONFORMAL, ISOMETRIC)
            for faces in experiment.resolutions(options, 500, 2500)
            for path in experiment.disks(options, faces) for degree in gains.DEGREES]
    return experiment.together(options, lambda job: gains.energy_of(options, job), jobs)


def draw(rows):
    figure = gains.draw(rows, SETTINGS, CONFORMAL)
    figure.suptitle('E_ASAP')
    return figure


def table(rows):
    header, lines = ['energy'], []
    for energy in (CONFORMAL, ISOMETRIC):
        more, found = gains.table(experiment.where(rows, objective=energy), SETTINGS, energy)
        lines += [[energy, *line] for line in found]
    return header + more, lines


def higher(rows):
    """Returns runs whose E_ASAP is not below that of degree 1, and how they ended."""
    conformal = experiment.where(rows, objective=CONFORMAL)
    linear = {(r['model'], r['faces']): r['energy'] for r in conformal if r['degree'] == 1}
    return ['%s_%d, degree %d, %s' % (r['model'], r['faces'], r['degree'], r['status'])
            for r in conformal if r['degree'] > 1 and r['energy'] >= linear[r['model'], r['faces']]]


def judge(rows):
    parts = {(energy, degree): gains.relative(rows, degree, objective=energy)
             for energy in (CONFORMAL, ISOMETRIC) for degree in (2, 3)}
    lower = [part < 1 for degree in (2, 3) for part in parts[CONFORMAL, degree].values()]
    larger = [parts[CONFORMAL, degree][key] < parts[ISOMETRIC, degree][key]
              for degree in (2, 3) for key in parts[CONFORMAL, degree]]
    less = sorted({'%s_%d' % key[:2] for degree in (2, 3) for key in parts[CONFORMAL, degree]
                   if parts[CONFORMAL, degree][key] >= parts[ISOMETRIC, degree][key]})
    medians = [100 - 100 * experiment.median(parts[energy, 3].values()) for energy in (CONFORMAL, ISOMETRIC)]
    return [
        experiment.Criterion('every quadratic and cubic map has a lower E_ASAP than the linear one',
                             experiment.count(lower), all(lower),
                             'The others: %s.' % ', '.join(higher(rows))),
        experiment.Criterion('the gain is larger than that of the symmetric Dirichlet energy, in two thirds '
                             'of the cases', experiment.count(larger), sum(larger) > 2 * len(larger) / 3,
                             'It is not on %s: faces with all three corners on the circle make the linear '
                             'isometric maps bad (figure 9), the conformal ones less so.' % ', '.join(less)),
        experiment.Criterion('the median gain of cubic maps is larger',
                             '%.1f %% against %.1f %%' % tuple(medians), medians[0] > medians[1])]


if __name__ == '__main__':
    sys.exit(experiment.main(sys.modules[__name__]))
