#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Measures how fast pages draw without a graphics card: frames per second of Chromium's software renderer.

The page has 10,082 cubic triangles and a canvas of 800 x 600. A frame is a key press that turns the surface
or moves the layout, the drawing, and a pixel read back. The CPU time of a frame is given, too. It depends less
on other processes; pages are compared by it, in alternation.

Sample runs:
  bench/frame_rate.py
  bench/frame_rate.py --pages old.html new.html --rounds 3
Requires the packages of the page tests.
"""
import argparse
import os
import statistics
import sys
import tempfile
from pathlib import Path

import common

TESTS = common.ROOT / 'tests'
sys.path[:0] = [str(TESTS / 'apps'), str(TESTS / 'pictures/web')]
SIDE = 71                                         # cells on a side of the grid, which has 2 * 71^2 triangles
SHOWN = [(show, view) for show in ('texture', 'density') for view in ('surface', 'layout')]


def make_page(options, folder):
    from command_helpers import grid
    mesh, page = folder / 'grid.obj', folder / 'grid.html'
    points, faces = grid(SIDE)
    common.write_obj(mesh, points, faces)
    done = common.run([options.binary.resolve(), 'parametrize', mesh, '--degree', '3', '-o', page],
                      options.timeout)
    if done.code != 0:
        sys.exit(done.stderr)
    return page


def measure(pages, options):
    os.environ['MAJORANT_BUILD_DIR'] = str(options.binary.resolve().parent.parent)
    import browser
    width, height = map(int, options.size.split(','))
    return browser.run('frame_rate.mjs', [str(page.resolve()) for page in pages],
                       {'seconds': options.seconds, 'rounds': options.rounds, 'width': width,
                        'height': height}, timeout=options.timeout)


def table(pages, runs):
    rows = []
    for page in pages:
        for show, view in SHOWN:
            some = [r for r in runs if (r['page'], r['show'], r['view']) ==
                    (str(page.resolve()), show, view)]
            rate = statistics.median(r['frames'] / r['seconds'] for r in some)
            cost = statistics.median(1000 * r['cpu'] / r['frames'] for r in some)
            rows.append([page.name, show, view, '%.1f' % rate, '%.0f' % cost])
    return common.markdown_table(['page', 'shown', 'moved', 'frames / s', 'processor ms / frame'], rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    common.add_options(parser, timeout=3600)
    parser.add_argument('--pages', nargs='+', type=Path, help='instead of that of the grid')
    parser.add_argument('--seconds', type=float, default=4, help='for each number')
    parser.add_argument('--rounds', type=int, default=1)
    parser.add_argument('--size', default='800,600', help='of the canvas')
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix='majorant_frames_') as folder:
        pages = options.pages or [make_page(options, Path(folder))]
        print('\n'.join(table(pages, measure(pages, options))))


if __name__ == '__main__':
    main()
