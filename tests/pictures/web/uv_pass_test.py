# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Compares the uv of fragments, read back from the page, with numpy's values of the map in the .vtu.

For every degree there are 1,000 fragments at random views of the surface. The position of a fragment on its
face is also read back, and compared with the ray through its pixel.
"""
import math
import os
import sys
import unittest

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..', 'apps'))
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import browser
from command_helpers import CommandTest, Vtu, grid, main, obj_text

LEVEL = 1 / 255


def multi_indices(n):
    """Returns the multi-indices in VTK's order: corners, edges, then the interior, recursively."""
    if n == 0:
        return [(0, 0, 0)]
    corners = [(n, 0, 0), (0, n, 0), (0, 0, n)]
    edges = [tuple(((n - s) * a + s * b) // n for a, b in zip(corners[e], corners[(e + 1) % 3]))
             for e in range(3) for s in range(1, n)]
    inner = [tuple(i + 1 for i in m) for m in multi_indices(n - 3)] if n >= 3 else []
    return corners + edges + inner


def evaluate(degree, control, xi):
    """Returns the sum over |i| = n of n! / i! xi^i c_i; control: #N by 2."""
    weights = [math.factorial(degree) / math.prod(map(math.factorial, m)) *
               math.prod(x ** i for x, i in zip(xi, m)) for m in multi_indices(degree)]
    return np.array(weights) @ control


class UvPass(CommandTest):
    def test_every_degree(self):
        mesh = self.write('bumpy.obj', obj_text(*grid(6)))
        pages = []
        for degree in range(1, 9):
            pages.append(self.path('%d.html' % degree))
            self.run_ok('parametrize', '--quiet', mesh, '-o', self.path('%d.vtu' % degree),
                        '-o', pages[-1], '--degree', degree)
        for degree, answer in enumerate(browser.run('uv_pass.mjs', pages, 1000), 1):
            self.assertEqual([answer['surprises'], answer['requests']], [[], []])
            with self.subTest(degree=degree):
                self.compare(degree, Vtu(self.path('%d.vtu' % degree)), answer['result'])

    def compare(self, degree, vtu, read):
        cells, uv, points = vtu.cells(), np.array(vtu.rows('uv')), np.array(vtu.rows('Points'))
        center, size = np.array(read['uvFrame']['center']), read['uvFrame']['size']
        middle, radius = np.array(read['surfaceFrame']['center']), read['surfaceFrame']['radius']
        self.assertEqual(len(read['fragments']), 1000)
        self.assertGreater(len({f['face'] for f in read['fragments']}), 20)
        far = off = 0
        for fragment in read['fragments']:
            cell = cells[fragment['face']]
            xi = [*fragment['xi'], 1 - sum(fragment['xi'])]
            expected = (evaluate(degree, uv[cell][:, :2], xi) - center) / size + 0.5
            far = max(far, np.abs(expected - fragment['uv']).max())
            place = (evaluate(degree, points[cell], xi) - middle) / radius
            seen = np.array(fragment['camera']).reshape(4, 4).T @ [*place, 1]
            off = max(off, np.abs(seen[:2] - fragment['device']).max())
        self.assertLess(far, LEVEL)
        self.assertLess(far, 1e-3)   # the error of two roundings to 16 bits
        self.assertLess(off, 2e-3)   # pixels are 5e-3 wide


if __name__ == '__main__':
    browser.require_npm()
    browser.require_chromium()
    main()
