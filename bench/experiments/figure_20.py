#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Figure 20: quadratic and cubic maps against linear ones of refined meshes.

Claim ([MC20] Fig. 20, Sec. 8.5): for an energy as low as with one quadratic piece for each face,
sometimes 16 but often at least 64 linear pieces are necessary.

Here: three public disks with 500 faces, free boundary and five random points held. Every face cut
into 4, 16, 64 flat pieces; all runs of a model start from the same map, Tutte's of the coarse mesh.
`majorant_paper_method` at degree 1 on these, with elevation to degrees 2 and 3 on the coarse one.
Times are processor time in fe of the coarse degree-1 matrix.

Time: about half a minute of one core.

Sample run:
  bench/experiments/figure_20.py --out build/experiments
"""
import sys
import tempfile
from pathlib import Path

import numpy as np

import descents
import experiment

PIECES = (1, 2, 4, 8)                              # pieces of an edge
SETTINGS = ('free', 'pins')
ENOUGH, OFTEN = 16, 64


def cut(path, pieces, folder):
    """Returns (OBJ with the start as texture coordinates, index of each vertex of the coarse mesh in it)."""
    common = experiment.common
    vertices, faces = common.read_obj(path)
    uv, _ = common.tutte(vertices, faces)
    fine, cells = common.subdivided(np.hstack([vertices, uv]), faces, pieces)
    target = Path(folder) / ('%s_by_%d.obj' % (path.stem, pieces))
    common.write_obj(target, fine[:, :3], cells, fine[:, 3:])
    number = {tuple(point): i for i, point in enumerate(fine.tolist())}
    return target, [number[tuple(point)] for point in np.hstack([vertices, uv]).tolist()]


def measure_model(options, path, setting, folder):
    rows, unit = [], None
    pinned = experiment.random_vertices(path) if setting == 'pins' else []
    ways = [(1, pieces) for pieces in experiment.resolutions(options, *PIECES)] + [(2, 1), (3, 1)]
    for degree, pieces in ways:
        mesh, number = cut(path, pieces, folder)
        flags = ['--init', 'input', '--degree', degree]
        flags += ['--pins', ','.join(str(number[v]) for v in pinned)] if pinned else []
        found = experiment.paper_method(options, mesh, *flags)
        unit = unit or found['unit_seconds']
        rows += [{'model': path.stem, 'setting': setting, 'degree': degree, 'pieces': pieces ** 2,
                  'iteration': row['iteration'], 'energy': row['energy'], 'fe': row['seconds'] / unit}
                 for row in found['rows']]
    return rows


def measure(options):
    with tempfile.TemporaryDirectory(prefix='majorant_experiment_') as folder:
        return sum([measure_model(options, path, setting, folder)
                    for path in experiment.disks(options, 500, descents.MODELS) for setting in SETTINGS], [])


def runs(rows, model, setting):
    """Returns {(degree, pieces): rows}."""
    found = {}
    for row in experiment.where(rows, model=model, setting=setting):
        found.setdefault((row['degree'], row['pieces']), []).append(row)
    return found


def draw(rows):
    models = experiment.values(rows, 'model')
    figure, axes = experiment.panels(len(SETTINGS), len(models), 2.5, 2)
    for line, setting in zip(axes, SETTINGS):
        for axis, model in zip(line, models):
            for (degree, pieces), run in runs(rows, model, setting).items():
                axis.plot([r['fe'] for r in run], [r['energy'] for r in run],
                          color=experiment.COLOURS[degree], linewidth=0.6 + 0.2 * pieces ** 0.5,
                          label='%s, %d' % (experiment.NAMES[degree], pieces))
            least = min(r['energy'] for r in experiment.where(rows, model=model, setting=setting))
            axis.set(xscale='log', title='%s, %s' % (model, setting),
                     xlim=(3, None), ylim=(0.995 * least, 1.12 * least))
    for axis in axes[-1]:
        axis.set_xlabel('time, fe')
    for line in axes:
        line[0].set_ylabel('energy')
    axes[0][-1].legend(loc='upper left', bbox_to_anchor=(1, 1), title='pieces')
    return figure


def cases(rows):
    return experiment.values([{'case': (r['model'], r['setting'])} for r in rows], 'case')


def table(rows):
    lines = []
    for case in cases(rows):
        for (degree, pieces), run in runs(rows, *case).items():
            lines.append([*case, experiment.NAMES[degree], pieces, run[-1]['iteration'],
                          '%.0f' % run[-1]['fe'], '%.5f' % run[-1]['energy']])
    return ['model', 'setting', 'degree', 'pieces of a face', 'iterations', 'fe', 'energy'], lines


def needed(found):
    """Returns the number of linear pieces per face for the energy of the quadratic map; infinity if all tested
    numbers are too small."""
    enough = [pieces for (degree, pieces), run in found.items()
              if degree == 1 and run[-1]['energy'] <= found[2, 1][-1]['energy']]
    return min(enough, default=float('inf'))


def judge(rows):
    pieces = [needed(runs(rows, *case)) for case in cases(rows)]
    counts = ', '.join('more than %d' % PIECES[-1] ** 2 if n == float('inf') else str(n) for n in pieces)
    return [experiment.Criterion('at least %d pieces are necessary' % ENOUGH, counts, min(pieces) >= ENOUGH),
            experiment.Criterion('%d or more, more often than not' % OFTEN,
                                 experiment.count([n >= OFTEN for n in pieces]),
                                 sum(n >= OFTEN for n in pieces) > len(pieces) / 2)]


if __name__ == '__main__':
    sys.exit(experiment.main(sys.modules[__name__]))
