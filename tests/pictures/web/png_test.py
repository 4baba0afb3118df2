# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Compares -o x.png --view with the page of the same map from the same direction, at the same size.

Fewer than 2 % of all pixels may differ by more than 24 of 255 in a channel. The page is shown without lines,
whose colours differ from the PNG's; the few pixels of cuts in the PNG do not count. The page is first moved
and zoomed to the same silhouette.
"""
import base64
import io
import os
import sys

import numpy as np
from PIL import Image

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..', 'apps'))
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import browser
from command_helpers import CommandTest, grid, main, obj_text, torus

SIZE = 420, 400
FAR = 24
CUT = 194, 24, 91  # the lightest possible colour of cuts


def rgb(data):
    return np.asarray(Image.open(io.BytesIO(data)).convert('RGB')).astype(float)


def is_cut(picture):
    """Returns pixels that contain the hue of cuts; paper and squares have more green than blue or red."""
    return picture[..., 1] < 0.85 * np.minimum(picture[..., 0], picture[..., 2])


class SameView(CommandTest):
    def compare(self, verb, mesh, eye, *args, image=None, has_cuts=False):
        flags = ['--image', image] if image else []
        self.run_ok(verb, '--quiet', mesh, '-o', self.path('a.html'), '-o', self.path('a.png'),
                    '--view', ','.join(map(str, eye)), '--size', '%d,%d' % SIZE, *flags, *args)
        found = browser.run('same_view.mjs', self.path('a.html'), {
            'picture': base64.b64encode(self.read('a.png')).decode(), 'eye': eye, 'image': image,
            'width': SIZE[0], 'height': SIZE[1]})
        self.assertEqual([found['surprises'], found['requests']], [[], []])
        page = rgb(base64.b64decode(found['result']['picture'].split(',')[1]))
        picture = rgb(self.read('a.png'))
        self.assertEqual(page.shape, picture.shape)
        cut = is_cut(picture) & has_cuts
        self.assertLess(np.mean(cut), 0.05)
        surface = picture.min(axis=2) < 250
        self.assertGreater(np.mean(surface), 0.2)
        self.assertGreater(np.std(picture[surface]), 20)  # the surface has a texture
        far = np.abs(page - picture).max(axis=2)[~cut] > FAR
        self.assertLess(np.mean(far), 0.02, (verb, args, image))
        # Except at edges of squares, pixels agree up to rounding.
        self.assertLess(np.median(np.abs(page - picture)[surface & ~cut]), 3)

    def bumpy(self):
        return self.write('bumpy.obj', obj_text(*grid(8)))

    def test_linear_disk(self):
        self.compare('parametrize', self.bumpy(), [0.3, -0.5, 1], '--degree', 1)

    def test_cubic_disk(self):
        self.compare('parametrize', self.bumpy(), [-0.6, 0.2, 1], '--degree', 3)

    def test_image_on_a_cubic_disk(self):
        colors = np.random.default_rng(1).integers(0, 255, (8, 8, 3), np.uint8)
        Image.fromarray(np.kron(colors, np.ones((16, 16, 1), np.uint8))).save(self.path('i.png'))
        self.compare('parametrize', self.bumpy(), [0.1, 0.2, 1], '--degree', 3,
                     image=self.path('i.png'))

    def test_closed_seamless_map(self):
        self.compare('seamless', self.write('torus.obj', obj_text(*torus(14, 9, 0))), [0.4, 0.5, 1],
                     '--degree', 3, has_cuts=True)


if __name__ == '__main__':
    browser.require_npm()
    browser.require_chromium()
    main()
