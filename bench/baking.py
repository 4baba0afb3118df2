#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""How well textures survive a bake, how their seams look, and what large images and thin charts cost.

    bench/baking.py MAJORANT [--size 2048] [--large 8192] [--folder DIR] [--copy SCAN.obj COPY.obj]... MESH.obj...

A texture is drawn by a formula of the position: waves, 127.5 + 110 sin(2 pi 16 x / D + phase) in red, green and blue,
D the diagonal; and a checkerboard of 64 cells along D. One sample a texel. Four tables:

* Round trips: a mesh is unwrapped twice, with other charts; the texture of the first atlas is baked to the second and
  back, and compared at the texels whose centres lie in a chart. Seams: at 16 points of each edge along which the
  second layout is cut, the difference of what a bilinear filter reads on the two sides, less that of the first
  texture there, which is 0 where the first layout is not cut; codes of 1/255, the largest.
* Copies: from a mesh to a coarser one; compared with the formula at the points of the mesh that the copy shows.
* Charts: thousands of them, and strips of a fifth of a texel.
* Large images of the last mesh: seconds and memory.
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
POINTS_OF_EDGE = 16
CHARTS = 4740
# Strips of the second table of charts: in texels, their width and the distance of two.
STRIP, APART = 0.2, 1.7


def waves(position, diagonal):
    along = 2 * np.pi * WAVES * position / diagonal
    return 127.5 + 110 * np.sin(along + np.array(PHASES))


def checkerboard(position, diagonal):
    cell = np.floor(CELLS * position / diagonal).sum(-1) % 2
    return np.repeat(255 * cell[..., None], 3, axis=-1)


def read_obj(path):
    """Positions, texture coordinates, and of each triangle the numbers of both."""
    points, texcoords, faces = [], [], []
    with open(path) as f:
        for line in f:
            words = line.split()
            if words[:1] == ['v']:
                points.append([float(x) for x in words[1:4]])
            elif words[:1] == ['vt']:
                texcoords.append([float(x) for x in words[1:3]])
            elif words[:1] == ['f']:
                faces.append([[int(n) - 1 for n in corner.split('/')[:2]] for corner in words[1:]])
    return np.array(points), np.array(texcoords), np.array(faces)


def write_obj(path, points, texcoords, faces):
    with open(path, 'w') as f:
        for p in points:
            f.write('v %.17g %.17g %.17g\n' % tuple(p))
        for t in texcoords:
            f.write('vt %.17g %.17g\n' % tuple(t))
        for face in faces:
            f.write('f ' + ' '.join('%d/%d' % (n + 1, n + 1) for n in face) + '\n')


def edges_of(faces):
    """{(v, w), v < w: [(corner of v, corner of w) of each face]} as numbers of texture coordinates."""
    edges = {}
    for face in faces:
        for k in range(3):
            (v, a), (w, b) = face[k], face[(k + 1) % 3]
            edges.setdefault((min(v, w), max(v, w)), []).append((a, b) if v < w else (b, a))
    return {edge: sides for edge, sides in edges.items() if len(sides) == 2}


def filtered(image, uv):
    """Codes that a bilinear filter in linear light reads."""
    height, width = image.shape[:2]
    x, y = uv[..., 0] * width - 0.5, (1 - uv[..., 1]) * height - 0.5
    left, top = np.floor(x).astype(int), np.floor(y).astype(int)
    s, t = (x - left)[..., None], (y - top)[..., None]

    def at(column, row):
        code = image[np.clip(row, 0, height - 1), np.clip(column, 0, width - 1)] / 255
        return np.where(code <= 0.04045, code / 12.92, ((code + 0.055) / 1.055) ** 2.4)

    above = (1 - s) * at(left, top) + s * at(left + 1, top)
    below = (1 - s) * at(left, top + 1) + s * at(left + 1, top + 1)
    linear = (1 - t) * above + t * below
    return 255 * np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def seam_steps(new, new_image, old, old_image):
    """By how much the step at points of the seams of `new` exceeds that of `old` there: (#P,), codes."""
    along = ((np.arange(POINTS_OF_EDGE) + 0.5) / POINTS_OF_EDGE)[None, :, None]

    def steps(texcoords, sides, image):
        uv = texcoords[np.array(sides)]  # edge, side, end
        found = [filtered(image, (1 - along) * uv[:, s, None, 0] + along * uv[:, s, None, 1]) for s in (0, 1)]
        return np.abs(found[0] - found[1]).max(-1).ravel()

    of_new, of_old = edges_of(new[2]), edges_of(old[2])
    cut = [edge for edge, (a, b) in of_new.items() if (new[1][list(a)] != new[1][list(b)]).any()]
    if not cut:
        return np.zeros(1)
    return (steps(new[1], [of_new[edge] for edge in cut], new_image) -
            steps(old[1], [of_old[edge] for edge in cut], old_image))


def psnr(error):
    return 10 * np.log10(255 ** 2 / np.mean(error ** 2))


class Bench:
    def __init__(self, binary, folder, size):
        self.binary, self.folder, self.size = binary, folder, size

    def path(self, name):
        return os.path.join(self.folder, name)

    def run(self, *args):
        subprocess.run([self.binary, *map(str, args), '--quiet', '--force'], check=True)

    def bake(self, new, old, out, *args, size=None):
        report = self.path('report.json')
        self.run('bake', self.path(new), '--from', self.path(old), '-o', self.path(out), '--size', size or self.size,
                 '--report', report, *args)
        with open(report) as f:
            return json.load(f)

    def image(self, name):
        return np.asarray(Image.open(self.path(name))).astype(float)

    def positions(self, new, old, *args):
        self.bake(new, old, 'position.npy', '--attribute', 'position', *args)
        return np.load(self.path('position.npy')).astype(float)

    def draw(self, formula, diagonal, layout, image):
        """The texture of a layout, with padding."""
        position = self.positions(layout, layout, '--padding', 64)
        texture = np.nan_to_num(np.rint(formula(position, diagonal))).astype(np.uint8)
        Image.fromarray(texture).save(self.path(image))

    def round_trip(self, mesh):
        self.run('unwrap', mesh, '-o', self.path('old.obj'), '--normalize')
        self.run('unwrap', mesh, '-o', self.path('new.obj'), '--normalize', '--max-stretch', 1.002)
        old, new = read_obj(self.path('old.obj')), read_obj(self.path('new.obj'))
        diagonal = np.linalg.norm(old[0].max(0) - old[0].min(0))
        inside = ~np.isnan(self.positions('old.obj', 'old.obj', '--padding', 0)[..., 0])
        for name, formula in (('waves', waves), ('checkerboard', checkerboard)):
            self.draw(formula, diagonal, 'old.obj', 'old.png')
            report = self.bake('new.obj', 'old.obj', 'new.png', '--image', self.path('old.png'))
            self.bake('old.obj', 'new.obj', 'back.png', '--image', self.path('new.png'))
            error = (self.image('back.png') - self.image('old.png'))[inside]
            steps = seam_steps(new, self.image('new.png'), old, self.image('old.png'))
            there = report['bake']
            yield (os.path.basename(mesh), name, there['charts'], there['charts_without_texels'],
                   there['doubly_covered'], there['misses'], '%.1f' % psnr(error), len(steps), '%.2f' % max(0, steps.max()),
                   '%.2f' % report['seconds']['total'])

    def copy(self, scan, copy):
        self.run('unwrap', scan, '-o', self.path('scan.obj'), '--normalize')
        self.run('unwrap', copy, '-o', self.path('copy.obj'), '--normalize')
        points = read_obj(self.path('scan.obj'))[0]
        diagonal = np.linalg.norm(points.max(0) - points.min(0))
        position = self.positions('copy.obj', 'scan.obj', '--padding', 0)
        inside = ~np.isnan(position[..., 0])
        for name, formula in (('waves', waves), ('checkerboard', checkerboard)):
            self.draw(formula, diagonal, 'scan.obj', 'scan.png')
            report = self.bake('copy.obj', 'scan.obj', 'copy.png', '--image', self.path('scan.png'))
            error = self.image('copy.png')[inside] - formula(position[inside], diagonal)
            there = report['bake']
            yield (os.path.basename(scan), os.path.basename(copy), name, there['covered'], there['misses'],
                   '%.1f' % psnr(error), '%.2f' % report['seconds']['total'])

    def many_charts(self):
        """A square of triangles, each of them a chart of its own, in a square of cells."""
        side = int(np.ceil(np.sqrt(CHARTS)))
        cell = np.array([[k % side, k // side] for k in range(CHARTS)])[:, None]
        corner = np.array([[0.1, 0.1], [0.9, 0.1], [0.1, 0.9]])
        uv = ((cell + corner) / side).reshape(-1, 2)
        yield 'triangles', uv, np.arange(3 * CHARTS).reshape(-1, 3)
        count = int((self.size - 2) / APART)
        left = (1 + APART * np.arange(count)) / self.size
        ends = np.stack([left, left, left + STRIP / self.size], -1)
        up = np.tile([0.01, 0.99, 0.5], (count, 1))
        yield 'strips', np.stack([ends, up], -1).reshape(-1, 2), np.arange(3 * count).reshape(-1, 3)[:, [0, 2, 1]]

    def charts(self):
        for name, uv, faces in self.many_charts():
            points = np.concatenate([uv, np.zeros((len(uv), 1))], 1)
            write_obj(self.path('charts.obj'), points, uv, faces)
            report = self.bake('charts.obj', 'charts.obj', 'charts.npy', '--attribute', 'position')
            there = report['bake']
            yield (name, there['charts'], there['charts_without_texels'], there['covered'], there['partly_covered'],
                   there['doubly_covered'], '%.2f' % report['seconds']['total'])

    def large(self, mesh, size):
        self.run('unwrap', mesh, '-o', self.path('old.obj'), '--normalize')
        points = read_obj(self.path('old.obj'))[0]
        self.draw(waves, np.linalg.norm(points.max(0) - points.min(0)), 'old.obj', 'old.png')
        for out, what in (('large.png', ['--image', self.path('old.png')]),
                          ('large.png', ['--image', self.path('old.png'), '--depth', '16']),
                          ('large.npy', ['--attribute', 'position']),
                          ('large.exr', ['--attribute', 'position'])):
            report = self.bake('old.obj', 'old.obj', out, *what, size=size)
            yield (os.path.basename(mesh), '%d x %d' % (size, size),
                   out[-3:] + (' of 16 bits' if '16' in what else ''), '%.2f' % (report['peak_memory_bytes'] / 1e9),
                   '%.1f' % report['seconds']['total'])


def print_table(head, rows):
    print('| ' + ' | '.join(head) + ' |')
    print('|' + '|'.join('---' if name in ('mesh', 'copy', 'texture', 'layout', 'size', 'format') else '--:'
                         for name in head) + '|')
    for row in rows:
        print('| ' + ' | '.join(map(str, row)) + ' |', flush=True)
    print()


def main():
    parser = argparse.ArgumentParser(description=__doc__.split('\n')[0])
    parser.add_argument('majorant')
    parser.add_argument('meshes', nargs='+')
    parser.add_argument('--size', type=int, default=2048)
    parser.add_argument('--large', type=int, default=0)
    parser.add_argument('--copy', nargs=2, action='append', default=[])
    parser.add_argument('--folder')
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(dir=options.folder) as folder:
        bench = Bench(options.majorant, folder, options.size)
        print_table(('mesh', 'texture', 'charts', 'without texels', 'double', 'misses', 'PSNR, dB', 'points of seams',
                     'step beyond, codes', 's'), (row for mesh in options.meshes for row in bench.round_trip(mesh)))
        if options.copy:
            print_table(('mesh', 'copy', 'texture', 'texels', 'misses', 'PSNR, dB', 's'),
                        (row for pair in options.copy for row in bench.copy(*pair)))
        print_table(('layout', 'charts', 'without texels', 'centres', 'partly', 'double', 's'), bench.charts())
        if options.large:
            print_table(('mesh', 'size', 'format', 'memory, GB', 's'), bench.large(options.meshes[-1], options.large))


if __name__ == '__main__':
    main()
