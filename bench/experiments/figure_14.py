#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Figure 14: seamless maps with cones.

Claim ([MC20] Fig. 14, Sec. 7, 8.2): a linear seamless map can be optimized at degree 1 and at
degree 4 with its seams kept by hard constraints; the differences are obvious near cones.

Here: the seamless texture coordinates of three closed public surfaces as the start, `parametrize
--seamless` at degrees 1 and 4; spot is drawn, with lines of constant u and v. Kinks as in figure
13, over all edges and over those at cones, seams included.

Time: about a quarter of a minute of one core.

Sample run:
  bench/experiments/figure_14.py --out build/experiments
"""
import math
import sys
import tempfile
from pathlib import Path

import numpy as np

import curved
import experiment

MODELS = ('spot_3000', 'cubesphere_1728', 'lshape_1872')
QUICK = ('cube_4',)
DEGREES = (1, 4)
IMAGES = {}                                        # degree: Map of the first model; 0: the start
SEAMS_KEPT = 64                                    # bound on the mismatch of seams, units in the last place of the layout's size


def solve(options, job):
    model, degree = job
    mesh = options.meshes / 'seamless' / (model + '.obj')
    flags = ['--max-iterations', 1] if degree == 0 else ['--curvature', 'paper-majorizer']
    with tempfile.TemporaryDirectory(prefix='majorant_experiment_') as folder:
        output = Path(folder) / 'map.vtu'
        report = experiment.majorant(options, 'parametrize', mesh, '--seamless', '--degree', degree or 1,
                                     *flags, output=output)
        image = curved.read(output) if degree else curved.read(mesh)
    IMAGES[model, degree] = image
    result = report['result']
    angles, lengths = curved.kinks(image)
    vertices, _ = experiment.common.read_obj(mesh)
    near = curved.touching(image, {tuple(vertices[cone['vertex']]) for cone in result['cones']})
    return {'model': model, 'degree': degree,
            'energy': result['value'] if degree else result['initial_value'],
            'kink_rms_degrees': curved.root_mean_square(angles, lengths),
            'kink_rms_degrees_at_cones': curved.root_mean_square(angles[near], lengths[near]),
            'seam_residual_ulp': result['seam_residual_ulp'] if degree else 0.0,
            'cones': len(result['cones']), 'status': report['status'] if degree else 'start'}


def measure(options):
    models = QUICK if options.quick else MODELS
    return experiment.together(options, lambda job: solve(options, job),
                               [(model, degree) for model in models for degree in (0, *DEGREES)])


def draw(rows):
    turn, tilt = math.radians(215), math.radians(12)
    around = np.array([[math.cos(turn), 0, math.sin(turn)], [0, 1, 0], [-math.sin(turn), 0, math.cos(turn)]])
    over = np.array([[1, 0, 0], [0, math.cos(tilt), -math.sin(tilt)], [0, math.sin(tilt), math.cos(tilt)]])
    figure, axes = experiment.panels(1, 3, 2.8, 3)
    model = rows[0]['model']
    spacing = math.sqrt(IMAGES[model, 1].area.sum()) / 32
    for axis, degree in zip(axes[0], (0, *DEGREES)):
        image = IMAGES[model, degree]
        scale = 1 if degree else math.sqrt(area_of_layout(image) / image.area.sum())
        axis.imshow(curved.picture(image, over @ around, spacing * scale, 230))
        axis.set_title({0: 'start', 1: 'linear', 4: 'quartic'}[degree])
        axis.set_axis_off()
    return figure


def area_of_layout(image):
    a, b = image.uv[:, 1] - image.uv[:, 0], image.uv[:, 2] - image.uv[:, 0]
    return abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum() / 2


def table(rows):
    return (['model', 'cones', 'map', 'energy', 'kinks, degrees: root mean square', 'at cones',
             'seams, units in the last place', 'status'],
            [[r['model'], r['cones'], {0: 'start', 1: 'degree 1', 4: 'degree 4'}[r['degree']],
              '%.5f' % r['energy'], '%.2f' % r['kink_rms_degrees'], '%.2f' % r['kink_rms_degrees_at_cones'],
              '%.3g' % r['seam_residual_ulp'], r['status']] for r in rows])


def judge(rows):
    one, four = (experiment.where(rows, degree=degree) for degree in DEGREES)
    seams = max(r['seam_residual_ulp'] for r in rows)
    lower = [b['energy'] < a['energy'] for a, b in zip(one, four)]
    fall = [a['kink_rms_degrees_at_cones'] - b['kink_rms_degrees_at_cones'] for a, b in zip(one, four)]
    all_edges = [a['kink_rms_degrees'] - b['kink_rms_degrees'] for a, b in zip(one, four)]
    more = [near > far for near, far in zip(fall, all_edges)]
    return [experiment.Criterion('seams are kept to %d units in the last place' % SEAMS_KEPT,
                                 '%.3g' % seams, seams <= SEAMS_KEPT),
            experiment.Criterion('the quartic energy is below the linear one', experiment.count(lower),
                                 all(lower)),
            experiment.Criterion('kinks fall by more degrees at cones than elsewhere',
                                 ', '.join('%.2f against %.2f' % pair for pair in zip(fall, all_edges)),
                                 all(more))]


if __name__ == '__main__':
    sys.exit(experiment.main(sys.modules[__name__]))
