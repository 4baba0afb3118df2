#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Figure 19: energy over time, with degree elevation.

Claim ([MC20] Fig. 19, Sec. 8.4): with elevation all time beyond that of the linear map is at once
to the advantage of the energy; reaching the final minimum can still take several times as long.
Cubic maps get there sooner than without elevation.

Here: `majorant_paper_method` on three public disks with 2,500 faces, degrees 1, 2, 3 with
elevation, degree 3 also without (dashed), 1, 36, 78 points; spot is drawn. Times as in figure 18.

Time: about ten seconds of one core.

Sample run:
  bench/experiments/figure_19.py --out build/experiments
"""
import sys

import descents
import experiment

NEAR = 1 + 1e-3
SEVERAL = 2
WAYS = {**{'degree %d' % n: ['--degree', n] for n in (1, 2, 3)},
        'degree 3, direct': ['--degree', 3, '--direct', '--exclude']}
STYLES = {**{'degree %d' % n: (experiment.COLOURS[n], '-', experiment.NAMES[n]) for n in (1, 2, 3)},
          'degree 3, direct': (experiment.COLOURS[3], '--', 'cubic, direct')}


def measure(options):
    faces, = experiment.resolutions(options, 500) if options.quick else (2500,)
    return sum([descents.descend(options, path, way, *flags)
                for path in experiment.disks(options, faces, descents.MODELS)
                for way, flags in WAYS.items()], [])


def draw(rows):
    figure, axes = experiment.panels(1, 2, 3.4, 2.6)
    found, model = descents.runs(rows), rows[0]['model']
    for axis in axes[0]:
        descents.draw_runs(axis, found, model, STYLES)
    one, three = found[model, 'degree 1'][-1], found[model, 'degree 3'][-1]
    axes[0][1].set(xlim=(0, 4 * one['fe']), ylim=(0.998 * three['energy'], 1.04 * one['energy']),
                   yscale='linear', title='where the linear map is done', ylabel='')
    axes[0][0].set_title(model)
    axes[0][0].legend()
    return figure


def table(rows):
    found, lines = descents.runs(rows), []
    for (model, way), run in found.items():
        near = descents.time_to(run, NEAR * run[-1]['energy'])
        linear = found[model, 'degree 1'][-1]
        lines.append([model, way, run[-1]['iteration'], '%.1f' % run[-1]['fe'], '%.1f' % near,
                      '%.5f' % run[-1]['energy'], '%.5f' % descents.energy_at(run, 1.5 * linear['fe'])])
    return ['model', 'way', 'iterations', 'fe', 'fe to within 0.1 % of its end', 'energy',
            'after 1.5 times the time of the linear map'], lines


def judge(rows):
    found, models = descents.runs(rows), experiment.values(rows, 'model')
    sooner, better, longer = [], [], []
    for model in models:
        one, two, three, direct = (found[model, way] for way in WAYS)
        end = NEAR * min(three[-1]['energy'], direct[-1]['energy'])
        times = [descents.time_to(run, end) for run in (three, direct)]
        sooner.append(times[1] / times[0] if all(times) else 0)
        better += [descents.energy_at(run, 1.5 * one[-1]['fe']) < one[-1]['energy'] for run in (two, three)]
        longer += [run[-1]['fe'] / one[-1]['fe'] for run in (two, three)]
    return [experiment.Criterion('cubic maps are within 0.1 % of their end sooner than without elevation: '
                                 'times', ', '.join('%.2f' % part for part in sooner), min(sooner) > 1),
            experiment.Criterion('after 1.5 times the time of the linear map quadratic and cubic ones are '
                                 'below it', experiment.count(better), all(better),
                                 'The first quadratic step, with what has to be set up for it, takes '
                                 'longer than that.'),
            experiment.Criterion('the end takes at least %d times as long as the linear one' % SEVERAL,
                                 ', '.join('%.1f' % part for part in longer), min(longer) >= SEVERAL)]


if __name__ == '__main__':
    sys.exit(experiment.main(sys.modules[__name__]))
