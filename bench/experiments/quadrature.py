# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Final energies over numbers of quadrature points, for figures 15 and 16."""
import experiment

MODELS = ('spot', 'goathead', 'koala', 'skull', 'scorpion')
SETTINGS = {'free': [], 'fixed': ['--fixed']}
POINTS = (3, 6, 10, 15, 21, 36, 55, 78, 120)
ENOUGH = {2: 36, 3: 78}                            # quadrature points by degree that [MC20] suggests
GAUSS = 196                                        # 14^2; the largest scheme in [MC20] has 175
WITHIN = 1.01


def energy_of(options, job):
    path, setting, degree, points, rule, way = job
    found = experiment.paper_method(options, path, '--degree', degree, '--points', points, '--rule', rule,
                                    *SETTINGS[setting], *way)
    return {'model': path.stem, 'setting': setting, 'degree': degree, 'points': points, 'rule': rule,
            'energy': found['energy'], 'iterations': len(found['rows']) - 1, 'held': found['stuck']}


def measure(options, way):
    counts = (36, 78) if options.quick else POINTS
    jobs = [(path, setting, degree, points, rule, way) for path in experiment.disks(options, 500, MODELS)
            for setting in SETTINGS for degree in (2, 3)
            for rule, points in [*(('lattice', n) for n in counts), ('gauss', GAUSS)]]
    return experiment.together(options, lambda job: energy_of(options, job), jobs)


def best(rows):
    """Returns the lowest energy of all rules, by model, setting and degree."""
    found = {}
    for r in rows:
        key = r['model'], r['setting'], r['degree']
        found[key] = min(found.get(key, r['energy']), r['energy'])
    return found


def excess(rows, **conditions):
    """Returns energies relative to the best of the same model, setting and degree."""
    least = best(rows)
    return [r['energy'] / least[r['model'], r['setting'], r['degree']]
            for r in experiment.where(rows, **conditions)]


def draw(rows):
    figure, axes = experiment.panels(1, 2, 3.4, 2.6, sharey=True)
    least = best(rows)
    for axis, degree in zip(axes[0], (2, 3)):
        for model, setting, n in least:
            if n != degree:
                continue
            lattice = experiment.where(rows, model=model, setting=setting, degree=n, rule='lattice')
            gauss = experiment.where(rows, model=model, setting=setting, degree=n, rule='gauss')
            ratio = [r['energy'] / least[model, setting, n] - 1 + 1e-6 for r in lattice]
            axis.plot([r['points'] for r in lattice], ratio, '-' if setting == 'free' else '--',
                      color=experiment.COLOURS[n], linewidth=0.8)
            axis.plot([r['points'] for r in gauss], [r['energy'] / least[model, setting, n] - 1 + 1e-6
                                                     for r in gauss], 'o', color=experiment.COLOURS[n],
                      fillstyle='none')
        axis.axvline(ENOUGH[degree], color=experiment.GREY, linewidth=0.6, linestyle='--')
        axis.set(xscale='log', yscale='log', xlabel='quadrature points',
                 title='%s; circles: Gauss; dashed: boundary fixed' % experiment.NAMES[degree])
        axis.set_xticks([3, 10, 36, 78, 196], ['3', '10', '36', '78', '196'])
        axis.minorticks_off()
    axes[0][0].set_ylabel('energy over the best, less 1')
    return figure


def table(rows):
    header = ['degree', 'points', 'rule', 'energy over the best: median', 'worst', 'held at the limit']
    lines = []
    for degree in (2, 3):
        for rule in ('lattice', 'gauss'):
            for points in experiment.values(experiment.where(rows, rule=rule), 'points'):
                key = {'degree': degree, 'rule': rule, 'points': points}
                parts, runs = excess(rows, **key), experiment.where(rows, **key)
                lines.append([degree, points, rule, '%.4f' % experiment.median(parts),
                              '%.4g' % max(parts), '%d of %d' % (sum(r['held'] for r in runs), len(runs))])
    return header, lines


def enough(rows):
    """Returns for each run whether the suggested number of points ends within WITHIN of the best."""
    return [part <= WITHIN for degree, points in ENOUGH.items()
            for part in excess(rows, degree=degree, points=points, rule='lattice')]


def gauss_is_worse(rows):
    """Returns for each run whether Gauss points are worse than the suggested lattice."""
    lattice = {(r['model'], r['setting'], r['degree']): r['energy']
               for r in experiment.where(rows, rule='lattice') if r['points'] == ENOUGH[r['degree']]}
    return [r['energy'] > lattice[r['model'], r['setting'], r['degree']]
            for r in experiment.where(rows, rule='gauss') if lattice]
