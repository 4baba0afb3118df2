#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Figure 5: degree elevation on the way against the highest degree from the start.

Claim ([MC20] Fig. 5, Sec. 4.3): optimized at degree 4 from the start, a map may end early in a bad
local minimum; elevated step by step, whenever the energy falls by less than 1 %, it does not, and
it converges best. Excluding the triangles in the way for a step helps where one does not elevate.

Here: the method as it is written (`majorant_paper_method`: Tutte's map, the paper's majorizer,
lattices, line search and stopping rule, without what this program adds), the 13 public disks with
500 faces, degrees 1 to 4; at degree 4 also from the start, as it is and with exclusion. "Held": the
run ends at the limit of injectivity, far from a minimum. Drawn: the model that gains most by
elevation.

Time: about ten seconds of one core.

Sample run:
  bench/experiments/figure_5.py --out build/experiments
"""
import sys

import experiment

WAYS = {'degree 1': ['--degree', 1], 'degree 2': ['--degree', 2], 'degree 3': ['--degree', 3],
        'degree 4': ['--degree', 4], 'degree 4, direct': ['--degree', 4, '--direct'],
        'degree 4, direct, excluding': ['--degree', 4, '--direct', '--exclude']}
STYLES = dict(zip(WAYS, (*[(colour, '-') for colour in experiment.COLOURS.values()],
                         (experiment.COLOURS[4], '--'), (experiment.GREY, ':'))))
SAME = 1 + 1e-4


def descend(options, job):
    path, way = job
    found = experiment.paper_method(options, path, *WAYS[way])
    return [{'model': path.stem, 'way': way, 'iteration': row['iteration'], 'degree': row['degree'],
             'energy': row['energy'], 'held': found['stuck']} for row in found['rows']]


def measure(options):
    jobs = [(path, way) for path in experiment.disks(options, 500) for way in WAYS]
    return sum(experiment.together(options, lambda job: descend(options, job), jobs), [])


def ends(rows, way):
    """Returns the last row of every model."""
    return {row['model']: row for row in rows if row['way'] == way}


def draw(rows):
    step, direct = ends(rows, 'degree 4'), ends(rows, 'degree 4, direct')
    model = max(step, key=lambda name: direct[name]['energy'] / step[name]['energy'])
    figure, axes = experiment.panels(1, 2, 3.6, 2.6)
    for way, (colour, style) in STYLES.items():
        found = experiment.where(rows, model=model, way=way)
        elevated = [b for a, b in zip(found[1:], found[2:]) if b['degree'] > a['degree']]
        for axis in axes[0]:
            axis.plot([r['iteration'] for r in found], [r['energy'] for r in found], style, color=colour,
                      label=way)
            axis.plot([r['iteration'] - 1 for r in elevated],
                      [found[r['iteration'] - 1]['energy'] for r in elevated], 'o', color=colour)
    least = step[model]['energy']
    axes[0][0].set(yscale='log', xlabel='iterations', ylabel='energy', title=model)
    axes[0][1].set(ylim=(0.995 * least, 1.35 * least), xlabel='iterations', title='close to the end')
    axes[0][0].legend()
    return figure


def table(rows):
    lines = []
    for model in experiment.values(rows, 'model'):
        found = [ends(rows, way)[model] for way in WAYS]
        lines.append([model, *('%.5g%s (%d)' % (r['energy'], ' held' * r['held'], r['iteration'])
                               for r in found)])
    return ['model: energy (iterations)', *WAYS], lines


def judge(rows):
    step, direct, excluding = (list(ends(rows, way).values()) for way in list(WAYS)[3:])
    lower = [a['energy'] <= SAME * b['energy'] for a, b in zip(step, direct)]
    caught = [b['model'] for a, b in zip(step, direct) if b['energy'] > 1.01 * a['energy']]
    order = [ends(rows, 'degree %d' % n) for n in (1, 2, 3, 4)]
    falling = [all(b[m]['energy'] <= SAME * a[m]['energy'] for a, b in zip(order, order[1:]))
               for m in order[0]]
    freed = [c['energy'] <= 1.01 * a['energy'] for a, b, c in zip(step, direct, excluding)
             if b['energy'] > 1.01 * a['energy']]
    return [experiment.Criterion('from the start, some models end more than 1 % above',
                                 ', '.join(caught) or 'none', bool(caught)),
            experiment.Criterion('elevation never ends higher (by 0.01 %)', experiment.count(lower),
                                 all(lower),
                                 'Which local minimum a run ends in is not decided by elevation alone.'),
            experiment.Criterion('with elevation each degree ends below the one before',
                                 experiment.count(falling), all(falling)),
            experiment.Criterion('excluding the triangles in the way helps where direct runs end early',
                                 experiment.count(freed), bool(freed) and all(freed),
                                 'Excluded for one step, as it is written, triangles are in the way again in '
                                 'the next one; this program excludes them for up to ten steps and has '
                                 'other remedies.')]


if __name__ == '__main__':
    sys.exit(experiment.main(sys.modules[__name__]))
