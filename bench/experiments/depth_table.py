#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""The depth table of Sec. 5.2: how often proofs of injectivity need bisection.

Claim ([MC20] Sec. 5.2): of the injectivity tests while cubic maps are optimized, nearly all are
decided without bisection: 1,142,164 of 1,142,272, 563,482 of 564,070 and 294,618 of 294,848.

Here: degree 3 with the paper's settings on the 13 public disks with 500 and 2,500 faces, free
boundary; elements that were certified after 0, 1, 2, ... bisections (`injectivity_tests.depth`; one
that is not certified is not counted). A run that is held back goes deeper than the paper's 5.

Time: about seven seconds of one core.

Sample run:
  bench/experiments/depth_table.py --out build/experiments
"""
import sys

import experiment

PAPER_LEAST = 563482 / 564070
DEEPEST = 5


def count_depths(options, path):
    report = experiment.majorant(options, 'parametrize', path, *experiment.PAPER, '--degree', 3,
                                 '--quadrature', experiment.POINTS[3])
    depth = report['injectivity_tests']['depth'] + [0] * (DEEPEST + 1)
    counts = depth[:DEEPEST] + [sum(depth[DEEPEST:])]
    name, faces = path.stem.rsplit('_', 1)
    return {'model': name, 'faces': int(faces), **{'depth_%d' % k: n for k, n in enumerate(counts)}}


def measure(options):
    paths = [path for faces in experiment.resolutions(options, 500, 2500)
             for path in experiment.disks(options, faces)]
    return experiment.together(options, lambda path: count_depths(options, path), paths)


def counts(row):
    return [row['depth_%d' % k] for k in range(DEEPEST + 1)]


def draw(rows):
    figure, axes = experiment.panels(1, 1, 5.5, 2.6)
    for degree, faces in zip((2, 3), experiment.values(rows, 'faces')):
        found = experiment.where(rows, faces=faces)
        axes[0][0].plot([r['model'] for r in found],
                        [100 * (1 - r['depth_0'] / sum(counts(r))) + 1e-5 for r in found], 'o',
                        color=experiment.COLOURS[degree], label='%d faces' % faces)
    axes[0][0].axhline(100 * (1 - PAPER_LEAST), color=experiment.GREY, linewidth=0.6)
    axes[0][0].set(yscale='log', ylabel='tests that need bisection, %',
                   title='line: the most of the paper\'s three models')
    axes[0][0].tick_params(axis='x', rotation=90)
    axes[0][0].legend()
    return figure


def table(rows):
    header = ['model', 'faces', *('depth %d' % k for k in range(DEEPEST)), '%d and more' % DEEPEST,
              'without bisection']
    return header, [[r['model'], r['faces'], *('{:,}'.format(n) for n in counts(r)),
                     '%.3f %%' % (100 * r['depth_0'] / sum(counts(r)))] for r in rows]


def judge(rows):
    parts = [r['depth_0'] / sum(counts(r)) for r in rows]
    whole = sum(r['depth_0'] for r in rows) / sum(sum(counts(r)) for r in rows)
    enough = [part >= PAPER_LEAST for part in parts]
    return [experiment.Criterion('of all tests together as many need no bisection as of the paper\'s '
                                 'least favourable model, 99.896 %', '%.3f %%' % (100 * whole),
                                 whole >= PAPER_LEAST),
            experiment.Criterion('as many on the median model', '%.3f %%' % (100 * experiment.median(parts)),
                                 experiment.median(parts) >= PAPER_LEAST),
            experiment.Criterion('as many on every model', experiment.count(enough), all(enough),
                                 'Those below are: %s.' % ', '.join(
                                     '%s_%d (%.2f %%)' % (r['model'], r['faces'], 100 * part)
                                     for r, part in zip(rows, parts) if part < PAPER_LEAST))]


if __name__ == '__main__':
    sys.exit(experiment.main(sys.modules[__name__]))
