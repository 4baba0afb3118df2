#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Figure 11: histograms of the distortion.

Claim ([MC20] Fig. 11, Sec. 8.1): for a model of average behaviour, at three resolutions and with
the three kinds of constraints of figure 9, higher degrees take away the strongly distorted parts of
the surface.

Here: goathead, settings as for figure 9, the symmetric Dirichlet density at 78 points of every
triangle, and which part of the area has how much of it. "Worst": the density that one percent of
the area exceeds.

Time: about half a minute of one core.

Sample run:
  bench/experiments/figure_11.py --out build/experiments
"""
import sys
import tempfile
from pathlib import Path

import numpy as np

import curved
import experiment
import gains

SETTINGS = ('free', 'fixed', 'pins')
BINS, POINTS = 40, 12


def histogram(options, job):
    path, setting, degree = job
    with tempfile.TemporaryDirectory(prefix='majorant_experiment_') as folder:
        output = Path(folder) / 'map.vtu'
        flags = gains.flags_of(folder, path, setting, degree)
        experiment.majorant(options, 'parametrize', path, *flags, output=output)
        density, share = curved.symmetric_dirichlet(curved.read(output), POINTS)
    order = np.argsort(density)
    worst = density[order][np.searchsorted(np.cumsum(share[order]), 0.99)]
    name, faces = path.stem.rsplit('_', 1)
    edges = np.geomspace(4, 40, BINS + 1)
    parts, _ = np.histogram(np.clip(density, edges[0], edges[-1]), edges, weights=share)
    return [{'model': name, 'faces': int(faces), 'setting': setting, 'degree': degree,
             'worst': float(worst), 'density': float(left), 'share': float(part)}
            for left, part in zip(edges, parts)]


def measure(options):
    jobs = [(path, setting, degree) for faces in experiment.resolutions(options, 500, 2500, 10000)
            for setting in SETTINGS for path in experiment.disks(options, faces, ['goathead'])
            for degree in gains.DEGREES]
    return sum(experiment.together(options, lambda job: histogram(options, job), jobs), [])


def draw(rows):
    sizes = experiment.values(rows, 'faces')
    figure, axes = experiment.panels(len(SETTINGS), len(sizes), 2.5, 1.6, sharex=True, sharey=True)
    for i, setting in enumerate(SETTINGS):
        for j, faces in enumerate(sizes):
            for degree in gains.DEGREES:
                found = experiment.where(rows, setting=setting, faces=faces, degree=degree)
                axes[i][j].step([r['density'] for r in found], [max(r['share'], 1e-6) for r in found],
                                where='post', color=experiment.COLOURS[degree],
                                label=experiment.NAMES[degree], linewidth=1)
            axes[i][j].set(xscale='log', yscale='log', ylim=(1e-5, 1),
                           title='%s, %d faces' % (setting, faces))
            axes[i][j].set_xticks([4, 6, 10, 20, 40], ['4', '6', '10', '20', '40'])
            axes[i][j].minorticks_off()
        axes[i][0].set_ylabel('part of the area')
    for axis in axes[-1]:
        axis.set_xlabel('density (isometry: 4)')
    axes[0][-1].legend()
    return figure


def worst(rows, degree):
    return {(r['setting'], r['faces']): r['worst'] for r in rows if r['degree'] == degree}


def table(rows):
    lines = [[*key, *('%.2f' % worst(rows, degree)[key] for degree in gains.DEGREES)]
             for key in worst(rows, 1)]
    return ['setting', 'faces', *('worst, %s' % experiment.NAMES[d] for d in gains.DEGREES)], lines


def judge(rows):
    linear, quadratic, cubic = (worst(rows, degree) for degree in gains.DEGREES)
    lower = [linear[key] > max(quadratic[key], cubic[key]) for key in linear]
    gained = [1 - cubic[key] / linear[key] for key in linear]
    return [experiment.Criterion('the worst density of quadratic and cubic maps is below that of linear ones',
                                 experiment.count(lower), all(lower)),
            experiment.Criterion('cubic maps lower the worst density by a tenth or more, in the median',
                                 '%.0f %%' % (100 * experiment.median(gained)),
                                 experiment.median(gained) >= 0.1,
                                 'It shrinks with the resolution, as the gain of figure 9 does.')]


if __name__ == '__main__':
    sys.exit(experiment.main(sys.modules[__name__]))
