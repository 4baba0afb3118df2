#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Figure 22: a deformation without overlaps.

Claim ([MC20] Fig. 22, Sec. 8.6): the quadratic deformation of figure 13 is locally, but not
globally injective; with the scaffold it is globally injective.

Here: gingerbread with its handles, `deform --degree 2` with and without `--bijective`; places where
the boundary meets itself as `check --certify` finds them, red.

Time: about one second of one core.

Sample run:
  bench/experiments/figure_22.py --out build/experiments
"""
import sys
import tempfile
from pathlib import Path

import curved
import experiment

WAYS = {'globally injective': ['--bijective'], 'locally injective': []}
PICTURES = {}                                      # way: (Map, contacts)


def solve(options, way):
    folder = options.meshes / 'deform2d'
    with tempfile.TemporaryDirectory(prefix='majorant_experiment_') as place:
        output = Path(place) / 'map.vtu'
        report = experiment.majorant(options, 'deform', folder / 'gingerbread.obj', '--handles',
                                     folder / 'gingerbread.json', '--degree', 2, *WAYS[way], output=output)
        result = experiment.majorant(options, 'check', output, '--certify')['result']
        contacts = result['boundary'].get('contacts', [])
        PICTURES[way] = curved.read(output), [contact['uv'] for contact in contacts]
    return {'way': way, 'energy': report['result']['value'], 'status': report['status'],
            'locally_injective': result['locally_injective'],
            'globally_injective': result['globally_injective'], 'contacts': len(contacts)}


def measure(options):
    return experiment.together(options, lambda way: solve(options, way), list(WAYS))


def draw(rows):
    figure, axes = experiment.panels(1, 2, 3.2, 3)
    for axis, way in zip(axes[0], WAYS):
        image, contacts = PICTURES[way]
        curved.draw_layout(axis, image, experiment.COLOURS[2], 0.5)
        axis.plot(*zip(*contacts) if contacts else ([], []), 'o', color='#cc0000', markersize=6,
                  fillstyle='none')
        axis.set_title(way)
    return figure


def table(rows):
    words = {True: 'proven', False: 'disproven', None: 'undecided'}
    return (['way', 'energy', 'locally injective', 'globally injective', 'contacts found', 'status'],
            [[r['way'], '%.5f' % r['energy'], words[r['locally_injective']], words[r['globally_injective']],
              r['contacts'], r['status']] for r in rows])


def judge(rows):
    held, free = rows
    return [experiment.Criterion('both maps are locally injective',
                                 experiment.count([r['locally_injective'] for r in rows]),
                                 all(r['locally_injective'] for r in rows)),
            experiment.Criterion('with the scaffold the map is globally injective',
                                 held['globally_injective'], held['globally_injective'] is True),
            experiment.Criterion('without it the map is not', free['globally_injective'],
                                 free['globally_injective'] is False)]


if __name__ == '__main__':
    sys.exit(experiment.main(sys.modules[__name__]))
