#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""How well textures survive a bake: an atlas -> another atlas -> back, in dB, and from a mesh to a coarser copy.

    bench/baking.py MAJORANT [--size 2048] [--folder DIR] MESH.obj...

A mesh is unwrapped twice, with other charts. On the first atlas a texture is drawn by a formula of the position:
waves, 127.5 + 110 sin(2 pi 16 x / D + phase) in red, green and blue, D the diagonal; and a checkerboard of 64 cells
along D. It is baked to the second atlas and back, one sample a texel, and compared at the texels whose centres lie
in a chart. Prints a table.
"""
import argparse
import json
import os
import subprocess
import tempfile
import time

import numpy as np
from PIL import Image

PHASES = (0, 2, 4)
WAVES, CELLS = 16, 64


def waves(position, diagonal):
    along = 2 * np.pi * WAVES * position / diagonal
    return 127.5 + 110 * np.sin(along + np.array(PHASES))


def checkerboard(position, diagonal):
    cell = np.floor(CELLS * position / diagonal).sum(-1) % 2
    return np.repeat(255 * cell[..., None], 3, axis=-1)


class Bench:
    def __init__(self, binary, folder, size):
        self.binary, self.folder, self.size = binary, folder, size

    def path(self, name):
        return os.path.join(self.folder, name)

    def run(self, *args):
        subprocess.run([self.binary, *map(str, args), '--quiet', '--force'], check=True)

    def bake(self, new, old, out, *args):
        report = self.path('report.json')
        start = time.time()
        self.run('bake', self.path(new), '--from', self.path(old), '-o', self.path(out), '--size', self.size,
                 '--report', report, *args)
        with open(report) as f:
            return json.load(f)['bake'], time.time() - start

    def image(self, name):
        return np.asarray(Image.open(self.path(name))).astype(float)

    def round_trip(self, mesh):
        """Rows of the table."""
        self.run('unwrap', mesh, '-o', self.path('old.obj'), '--normalize')
        self.run('unwrap', mesh, '-o', self.path('new.obj'), '--normalize', '--max-stretch', 1.002)
        self.bake('old.obj', 'old.obj', 'inside.npy', '--attribute', 'position', '--padding', 0)
        inside = ~np.isnan(np.load(self.path('inside.npy'))[..., 0])
        self.bake('old.obj', 'old.obj', 'all.npy', '--attribute', 'position', '--padding', 64)
        position = np.load(self.path('all.npy')).astype(float)
        known = position[inside]
        diagonal = np.linalg.norm(known.max(0) - known.min(0))
        for name, formula in (('waves', waves), ('checkerboard', checkerboard)):
            texture = np.nan_to_num(np.rint(formula(position, diagonal))).astype(np.uint8)
            Image.fromarray(texture).save(self.path('old.png'))
            there, seconds = self.bake('new.obj', 'old.obj', 'new.png', '--image', self.path('old.png'))
            self.bake('old.obj', 'new.obj', 'back.png', '--image', self.path('new.png'))
            error = (self.image('back.png') - self.image('old.png'))[inside]
            psnr = 10 * np.log10(255 ** 2 / np.mean(error ** 2))
            yield (os.path.basename(mesh), name, there['charts'], there['charts_without_texels'],
                   there['doubly_covered'], there['misses'], '%.1f' % psnr, '%.2f' % seconds)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split('\n')[0])
    parser.add_argument('majorant')
    parser.add_argument('meshes', nargs='+')
    parser.add_argument('--size', type=int, default=2048)
    parser.add_argument('--folder')
    options = parser.parse_args()
    print('| mesh | texture | charts | without texels | double | misses | PSNR, dB | s |')
    print('|---|---|--:|--:|--:|--:|--:|--:|')
    with tempfile.TemporaryDirectory(dir=options.folder) as folder:
        bench = Bench(options.majorant, folder, options.size)
        for mesh in options.meshes:
            for row in bench.round_trip(mesh):
                print('| ' + ' | '.join(map(str, row)) + ' |', flush=True)


if __name__ == '__main__':
    main()
