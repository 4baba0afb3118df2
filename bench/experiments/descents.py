# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Energy over time of the paper's method, for figures 18 to 20. The unit of time is fe of degree 1."""
import experiment

MODELS = ('spot', 'goathead', 'nefertiti')


REPEAT = 3


def fastest(options, path, *flags):
    """Runs the paper's method several times and returns the result of the fastest run."""
    found = [experiment.paper_method(options, path, *flags) for _ in range(1 if options.quick else REPEAT)]
    return min(found, key=lambda run: run['rows'][-1]['seconds'] / run['unit_seconds'])


def descend(options, path, way, *flags):
    """Returns rows of a run of the paper's method."""
    found = fastest(options, path, *flags)
    return [{'model': path.stem, 'way': way, 'iteration': row['iteration'], 'degree': row['degree'],
             'energy': row['energy'], 'fe': row['seconds'] / found['unit_seconds']} for row in found['rows']]


def runs(rows):
    """Returns {(model, way): rows in order}."""
    found = {}
    for row in rows:
        found.setdefault((row['model'], row['way']), []).append(row)
    return found


def cost(run):
    """Returns fe per iteration."""
    return run[-1]['fe'] / run[-1]['iteration']


def time_to(run, energy):
    """Returns fe until the energy is at most this value, or None."""
    return next((row['fe'] for row in run if row['energy'] <= energy), None)


def energy_at(run, fe):
    return [row['energy'] for row in run if row['fe'] <= fe][-1]


def draw_runs(axis, found, model, styles):
    """Draws the runs of a model. styles: {way: (colour, line, name)}."""
    for way, (colour, line, name) in styles.items():
        run = found[model, way]
        axis.plot([row['fe'] for row in run], [row['energy'] for row in run], line, color=colour, label=name)
    axis.set(xlabel='time, fe of degree 1', ylabel='energy', yscale='log')
