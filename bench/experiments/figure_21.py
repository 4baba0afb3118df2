#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Figure 21: maps without overlaps, and the flips of the scaffold.

Claim ([MC20] Fig. 21, Sec. 6, 8.6): quadratic maps are kept globally injective by a curved scaffold
whose edges are flipped: of 1396, 1141 and 469 intended flips 1389, 1127 and 460 could be done (98.1
% and more). Flips matter for the scaffold's quality; without the scaffold, the same maps overlap.

Here: helix and scorpion with free boundary, gingerbread with its handles, degree 2, with
`--bijective`, also with `--no-flips`, and without. Global injectivity is proven or disproven by
`check --certify`.

Time: about four seconds of one core.

Sample run:
  bench/experiments/figure_21.py --out build/experiments
"""
import sys
import tempfile
from pathlib import Path

import curved
import experiment

MODELS = ('helix', 'scorpion', 'gingerbread')
WAYS = {'bijective': ['--bijective'], 'no flips': ['--bijective', '--no-flips'], 'local only': []}
LIKELY = 0.98                                      # lower bound on the fraction of possible flips, as in the paper
IMAGES = {}                                        # (model, way): (Map, Map of the scaffold or None)


def solve(options, job):
    model, way = job
    verb, mesh, flags = 'parametrize', options.meshes / 'disks' / (model + '_500.obj'), []
    if model == 'gingerbread':
        folder = options.meshes / 'deform2d'
        verb, mesh = 'deform', folder / 'gingerbread.obj'
        flags = ['--handles', folder / 'gingerbread.json']
    with tempfile.TemporaryDirectory(prefix='majorant_experiment_') as place:
        output, scaffold = Path(place) / 'map.vtu', Path(place) / 'scaffold.vtu'
        around = ['--write-scaffold', scaffold] if WAYS[way] else []
        report = experiment.majorant(options, verb, mesh, '--degree', 2, *flags, *WAYS[way], *around,
                                     output=output)
        checked = experiment.majorant(options, 'check', output, '--certify')
        IMAGES[model, way] = curved.read(output), curved.read(scaffold) if around else None
    flips = report['flips']
    return {'model': model, 'way': way, 'energy': report['result']['value'],
            'iterations': len(experiment.common.steps_taken(report)), 'status': report['status'],
            'globally_injective': checked['result']['globally_injective'],
            'flips_intended': flips['intended'], 'flips_performed': flips['performed']}


def measure(options):
    models = MODELS[:1] if options.quick else MODELS
    return experiment.together(options, lambda job: solve(options, job),
                               [(model, way) for model in models for way in WAYS])


def draw(rows):
    models = experiment.values(rows, 'model')
    figure, axes = experiment.panels(len(models), len(WAYS), 2.4, 2.4)
    for line, model in zip(axes, models):
        for axis, way in zip(line, WAYS):
            image, scaffold = IMAGES[model, way]
            curved.draw_layout(axis, image, experiment.COLOURS[2], 0.5)
            box = axis.axis()
            if scaffold:
                curved.draw_layout(axis, scaffold, experiment.GREY, 0.3, box)
                axis.axis(box)
            axis.set_title('%s, %s' % (model, way))
    return figure


def table(rows):
    return (['model', 'way', 'energy', 'iterations', 'globally injective', 'flips done / intended', 'status'],
            [[r['model'], r['way'], '%.5f' % r['energy'], r['iterations'],
              {True: 'proven', False: 'disproven', None: 'undecided'}[r['globally_injective']],
              '%d / %d' % (r['flips_performed'], r['flips_intended']) if r['flips_intended'] else '-',
              r['status']] for r in rows])


def judge(rows):
    held, stiff, free = (experiment.where(rows, way=way) for way in WAYS)
    proven = [r['globally_injective'] is True for r in held]
    overlap = [r['globally_injective'] is False for r in free]
    parts = [r['flips_performed'] / max(1, r['flips_intended']) for r in held]
    worse = ['%s' % ('%+.3g %%' % (100 * (b['energy'] / a['energy'] - 1))) for a, b in zip(held, stiff)]
    return [experiment.Criterion('with the scaffold no map overlaps', experiment.count(proven), all(proven)),
            experiment.Criterion('without it every one does', experiment.count(overlap), all(overlap)),
            experiment.Criterion('at least 98 % of the intended flips are done',
                                 ', '.join('%.1f %%' % (100 * part) for part in parts), min(parts) >= LIKELY),
            experiment.Criterion('without flips every energy ends higher', ', '.join(worse),
                                 all(b['energy'] > a['energy'] for a, b in zip(held, stiff)),
                                 'Flips are worth most where the image moves far through its '
                                 'surroundings.')]


if __name__ == '__main__':
    sys.exit(experiment.main(sys.modules[__name__]))
