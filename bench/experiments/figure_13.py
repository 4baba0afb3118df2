#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Figure 13: deformation by soft points, linear and quadratic.

Claim ([MC20] Fig. 13, Sec. 8.2): in a planar deformation by soft point constraints, visible
artifacts of the piecewise linear map vanish in the quadratic one.

Here: bar, star and gingerbread with their handles, `deform` at degrees 1 and 2. The artifacts are
kinks: the angle by which a straight line turns in the image where it crosses an edge, root mean
square over inner edges by their length; "elsewhere": without the edges between triangles that a
handle pulls at. Drawn: a square grid on the shape, where the linear map has its largest kink away
from them.

Time: about three seconds of one core.

Sample run:
  bench/experiments/figure_13.py --out build/experiments
"""
import sys
import tempfile
from pathlib import Path

import numpy as np

import curved
import experiment

MODELS = ('bar', 'star', 'gingerbread')
CURVES, SHARPEST = {}, {}                          # by (model, degree): for the picture
CELLS, PART = 60, 0.3                              # cells of the grid along the shape, and the fraction of the grid that is drawn


def bend(options, job):
    model, degree = job
    folder = options.meshes / 'deform2d'
    with tempfile.TemporaryDirectory(prefix='majorant_experiment_') as place:
        output = Path(place) / 'map.vtu'
        report = experiment.majorant(options, 'deform', folder / (model + '.obj'), '--handles',
                                     folder / (model + '.json'), '--degree', degree, output=output)
        CURVES[model, degree] = image = curved.read(output)
    angles, lengths = curved.kinks(image)
    vertices, _ = experiment.common.read_obj(folder / (model + '.obj'))
    handles = experiment.common.load_strict(folder / (model + '.json'))['handles']
    away = ~curved.touching(image, {tuple(vertices[handle['vertex']]) for handle in handles})
    SHARPEST[model, degree] = largest_kink(image, np.where(away, angles, 0))
    return {'model': model, 'degree': degree, 'energy': report['result']['value'],
            'kink_rms_degrees': curved.root_mean_square(angles, lengths),
            'elsewhere_degrees': curved.root_mean_square(angles[away], lengths[away]),
            'handle_distance': report['result']['handle_distance'], 'status': report['status']}


def largest_kink(image, angles):
    """Returns the place of the largest kink in the image."""
    (face, side), _ = curved.inner_edges(image)[int(np.argmax(angles))]
    return image.uv[face, [side, (side + 1) % 3]].mean(0)


def measure(options):
    models = MODELS[:1] if options.quick else MODELS
    return experiment.together(options, lambda job: bend(options, job),
                               [(model, degree) for model in models for degree in (1, 2)])


def draw(rows):
    models = experiment.values(rows, 'model')
    figure, axes = experiment.panels(2, len(models), 2.4, 2.4)
    for j, model in enumerate(models):
        for i, degree in enumerate((1, 2)):
            image, centre = CURVES[model, degree], SHARPEST[model, 1]
            size = np.ptp(image.points.reshape(-1, 3), axis=0).max()
            half = PART * size / 2
            lines = curved.grid_lines(image, size / CELLS)
            near = lines[(abs(lines - centre) < half).all((1, 2))]
            axes[i][j].plot(*curved.joined(near), color=experiment.COLOURS[degree], linewidth=0.8)
            axes[i][j].set(aspect='equal', xlim=centre[0] + [-half, half], ylim=centre[1] + [-half, half],
                           title='%s, %s' % (model, experiment.NAMES[degree]))
            axes[i][j].set_axis_off()
    return figure


def table(rows):
    return (['model', 'degree', 'energy', 'kinks, degrees: root mean square', 'elsewhere', 'status'],
            [[r['model'], r['degree'], '%.5f' % r['energy'], '%.2f' % r['kink_rms_degrees'],
              '%.2f' % r['elsewhere_degrees'], r['status']] for r in rows])


def judge(rows):
    one, two = (experiment.where(rows, degree=degree) for degree in (1, 2))
    parts = {key: [b[key] / a[key] for a, b in zip(one, two)]
             for key in ('kink_rms_degrees', 'elsewhere_degrees')}
    energies = [b['energy'] < a['energy'] for a, b in zip(one, two)]
    return [experiment.Criterion('kinks of the quadratic map are at most half of the linear one\'s',
                                 experiment.percents(parts['kink_rms_degrees']),
                                 max(parts['kink_rms_degrees']) <= 0.5,
                                 'Kinks shrink but do not vanish; the largest stay where points are '
                                 'pulled.'),
            experiment.Criterion('away from the handles kinks are at most a quarter',
                                 experiment.percents(parts['elsewhere_degrees']),
                                 max(parts['elsewhere_degrees']) <= 0.25),
            experiment.Criterion('its energy is lower', experiment.count(energies), all(energies))]


if __name__ == '__main__':
    sys.exit(experiment.main(sys.modules[__name__]))
