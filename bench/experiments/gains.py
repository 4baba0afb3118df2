# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Final energies over degrees, for figures 9 and 10: runs, pictures, tables."""
import tempfile

import experiment

DEGREES = (1, 2, 3)


def flags_of(folder, path, setting, degree):
    """Returns the flags of the paper's settings with the boundary free or fixed, or with five random points held,
    for which it writes a file."""
    flags = [*experiment.PAPER, '--degree', degree, '--quadrature', experiment.POINTS[degree]]
    if setting == 'fixed':
        flags += ['--boundary', 'fixed']
    if setting == 'pins':
        flags += ['--pins', experiment.pins_file(folder, experiment.random_vertices(path))]
    return flags


def energy_of(options, job):
    """Returns the row of one run: (path, setting, degree, energy)."""
    path, setting, degree, energy = job
    with tempfile.TemporaryDirectory(prefix='majorant_experiment_') as folder:
        flags = flags_of(folder, path, setting, degree)
        report = experiment.majorant(options, 'parametrize', path, '--energy', energy, *flags)
    name, faces = path.stem.rsplit('_', 1)
    return {'model': name, 'faces': int(faces), 'setting': setting, 'objective': energy,
            'degree': degree, 'energy': report['result']['value'], 'status': report['status'],
            'iterations': len(experiment.common.steps_taken(report))}


def relative(rows, degree, **conditions):
    """Returns the energies of a degree relative to those of degree 1, by model."""
    chosen = experiment.where(rows, **conditions)
    linear = {(r['model'], r['faces'], r['setting'], r['objective']): r['energy']
              for r in chosen if r['degree'] == 1}
    return {key[:3]: r['energy'] / linear[key] for r in chosen if r['degree'] == degree
            for key in [(r['model'], r['faces'], r['setting'], r['objective'])]}


def draw(rows, settings, objective):
    """Draws a panel for each resolution and setting, with energies in percent of the linear one."""
    sizes = experiment.values(rows, 'faces')
    figure, axes = experiment.panels(len(settings), len(sizes), 2.5, 1.2 + 1.2 / len(settings),
                                     sharex=True, sharey='row')
    for i, setting in enumerate(settings):
        for j, faces in enumerate(sizes):
            axis = axes[i][j]
            for degree in DEGREES:
                found = relative(rows, degree, setting=setting, faces=faces, objective=objective)
                axis.plot([key[0] for key in found], [100 * part for part in found.values()], 'o',
                          color=experiment.COLOURS[degree], label=experiment.NAMES[degree])
            axis.set_title('%s, %d faces' % (setting, faces))
            axis.tick_params(axis='x', rotation=90)
    for line in axes:
        line[0].set_ylabel('E, % of linear')
    axes[0][len(sizes) // 2].legend(loc='lower center', bbox_to_anchor=(0.5, 1.12), ncols=3,
                                    columnspacing=0.8, handletextpad=0)
    return figure


def table(rows, settings, objective):
    """Returns a table of medians over the models."""
    header = ['setting', 'faces', 'models', 'E quadratic, % of linear: median', 'lowest',
              'cubic: median', 'lowest', 'not converged']
    lines = []
    for setting in settings:
        for faces in experiment.values(rows, 'faces'):
            parts = [list(relative(rows, degree, setting=setting, faces=faces, objective=objective).values())
                     for degree in (2, 3)]
            runs = experiment.where(rows, setting=setting, faces=faces, objective=objective)
            figures = [100 * f(part) for part in parts for f in (experiment.median, min)]
            lines.append([setting, faces, len(parts[0]), *('%.1f' % figure for figure in figures),
                          '%d of %d' % (sum(r['status'] != 'converged' for r in runs), len(runs))])
    return header, lines
