#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Measures the quality of baked textures and of their seams, and the cost of large images and thin charts.

  bench/baking.py MAJORANT [--size 2048] [--large 8192] [--folder DIR] [--blender PROGRAM]
                  [--copy SCAN.obj COPY.obj]... [MESH.obj...]

Textures are drawn by formulas of the position: waves, 127.5 + 110 sin(2 pi 16 x / D + phase) in red, green and blue,
where D is the diagonal; and a checkerboard of 64 cells along D. Texels have one sample unless stated otherwise.

* Round trips: a mesh is unwrapped twice, with different charts. The texture of the first atlas is baked to the second
  and back, and compared at the texels whose centres lie in a chart. Seams: at 16 points of each cut edge of the second
  layout, the difference of the bilinearly filtered values on both sides, minus that of the first texture there,
which is 0 where the first layout is not cut. The unit is 1/255; the second atlas is of floats, so that there is no
rounding. Points are crowded if another part of the surface, or the other side of the cut, lies within reach of the
filter in one of the layouts. No baker can be right there; crowded points are counted and left out.
* Copies: from a mesh with a texture of four times the width to a coarser one. With --blender PROGRAM (3.4 of Debian 12)
  Cycles bakes, too; it finds points along normals (selected to active, rays from 2 % of the diagonal outside). The
  reference is the formula at the point found for the texel's centre, or with 16 samples its mean over 16 points of the
  texel, each at the place that the program found. PSNR thus measures the mixing, not the search for points. There are
  two kinds: numbers (--linear; Non-Color), which both programs mix as they are, and colours. majorant mixes colours as
  light, like graphics hardware; Cycles filters the codes of a texture and decodes the result: halfway between black and
  white it reads code 128, not 188. PSNR of colours is therefore given in codes and in light. Texels are compared if
both programs find a point, and the scan's texture is not crowded there: neither program differs by more than 3 codes in
  the waves.
* Charts: thousands of them, and strips of a fifth of a texel.
* Large images of the last mesh: seconds and memory.
"""
import argparse
import json
import os
import subprocess
import sys
import tempfile
import time

import numpy as np

PHASES = (0, 2, 4)
WAVES, CELLS = 16, 64
POINTS_OF_EDGE = 16
CHARTS = 4740
# Width and distance of the strips in the second table of charts, texels.
STRIP, APART = 0.2, 1.7
OFF = 3  # codes; a larger difference makes a texel crowded
APART_AT_LEAST = 3  # least distance of the two sides of a cut, texels; filters read two texels each way
FAR = 1.5  # distance in texels above which filtered texels show another part of the surface; sqrt 2 within one part
OUTSIDE = 0.02  # distance from the surface at which Blender's rays begin, relative to the diagonal
ALONG = 4  # samples along a side of a texel; width of the scan's texture relative to the copy's


def waves(position, diagonal):
    along = 2 * np.pi * WAVES * position / diagonal
    return 127.5 + 110 * np.sin(along + np.array(PHASES))


def checkerboard(position, diagonal):
    cell = np.floor(CELLS * position / diagonal).sum(-1) % 2
    return np.repeat(255 * cell[..., None], 3, axis=-1)


def read_obj(path):
    """Returns positions, texture coordinates, and the indices of both for each triangle."""
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
    """Returns {(v, w), v < w: [(corner of v, corner of w) of each face]}, corners as indices of texture coordinates."""
    edges = {}
    for face in faces:
        for k in range(3):
            (v, a), (w, b) = face[k], face[(k + 1) % 3]
            edges.setdefault((min(v, w), max(v, w)), []).append((a, b) if v < w else (b, a))
    return {edge: sides for edge, sides in edges.items() if len(sides) == 2}


def light(codes):
    codes = np.asarray(codes) / 255
    return np.where(codes <= 0.04045, codes / 12.92, ((np.maximum(codes, 0) + 0.055) / 1.055) ** 2.4)


def codes_of(linear):
    linear = np.maximum(linear, 0)
    return 255 * np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def filtered(image, uv):
    """Returns the codes of a bilinear filter in linear light."""
    height, width = image.shape[:2]
    x, y = uv[..., 0] * width - 0.5, (1 - uv[..., 1]) * height - 0.5
    left, top = np.floor(x).astype(int), np.floor(y).astype(int)
    s, t = (x - left)[..., None], (y - top)[..., None]

    def at(column, row):
        return light(image[np.clip(row, 0, height - 1), np.clip(column, 0, width - 1)])

    above = (1 - s) * at(left, top) + s * at(left + 1, top)
    below = (1 - s) * at(left, top + 1) + s * at(left + 1, top + 1)
    return codes_of((1 - t) * above + t * below)


class Seams:
    """Points along the cut edges of a layout. layout, old: of read_obj. shown: the positions that texels in charts
    and next to them show; NaN elsewhere."""

    def __init__(self, layout, old, shown):
        of_layout, of_old = edges_of(layout[2]), edges_of(old[2])
        cut = [edge for edge, (a, b) in of_layout.items() if (layout[1][list(a)] != layout[1][list(b)]).any()]
        self.uv = self.points_of(layout[1][np.array([of_layout[edge] for edge in cut])])
        self.old_uv = self.points_of(old[1][np.array([of_old[edge] for edge in cut])])
        ends = layout[0][np.array(cut)]
        self.has_room = np.linalg.norm(self.uv[0] - self.uv[1], axis=1) * len(shown) > APART_AT_LEAST
        for side in (0, 1):
            ends_of = self.uv[side].reshape(len(cut), POINTS_OF_EDGE, 2)[:, [0, -1]]  # first and last sample point, which are not the ends of the edge
            length = np.linalg.norm(np.diff(ends_of, axis=1)[:, 0], axis=1) * POINTS_OF_EDGE / (POINTS_OF_EDGE - 1)
            texel = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1) / np.maximum(length * len(shown), 1e-9)
            self.has_room &= self.finds_room(shown, self.uv[side], self.points_of(ends[:, None])[0],
                                             np.repeat(texel, POINTS_OF_EDGE))

    @staticmethod
    def points_of(ends):
        """Returns #P points for each side. ends: by edge, side, end and coordinate."""
        along = ((np.arange(POINTS_OF_EDGE) + 0.5) / POINTS_OF_EDGE)[None, None, :, None]
        points = (1 - along) * ends[:, :, None, 0] + along * ends[:, :, None, 1]
        return points.swapaxes(0, 1).reshape(ends.shape[1], -1, ends.shape[3])

    @staticmethod
    def finds_room(shown, uv, position, texel):
        """Returns whether all four filtered texels show the part of the surface at that point."""
        height, width = shown.shape[:2]
        left = np.floor(uv[:, 0] * width - 0.5).astype(int)
        top = np.floor((1 - uv[:, 1]) * height - 0.5).astype(int)
        has_room = np.ones(len(uv), bool)
        for column in (left, left + 1):
            for row in (top, top + 1):
                there = shown[np.clip(row, 0, height - 1), np.clip(column, 0, width - 1)]
                has_room &= ~(np.linalg.norm(there - position, axis=1) > FAR * texel)
        return has_room

    def steps(self, image, old_image):
        """Returns by how much the jump of filtered values across the cut exceeds that of the old layout: #P codes."""
        def step(image, sides):
            return np.abs(filtered(image, sides[0]) - filtered(image, sides[1])).max(-1)
        return step(image, self.uv) - step(old_image, self.old_uv)


def psnr(error):
    return 10 * np.log10(255 ** 2 / np.mean(error ** 2))


class Bench:
    def __init__(self, binary, folder, size, blender=None):
        self.binary, self.folder, self.size, self.blender = binary, folder, size, blender

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
        from PIL import Image
        return np.asarray(Image.open(self.path(name))).astype(float)

    def codes_without_rounding(self, name):
        """Returns the sRGB codes of an array of linear light."""
        return codes_of(np.load(self.path(name)).astype(float))

    def positions(self, new, old, *args, size=None):
        self.bake(new, old, 'position.npy', '--attribute', 'position', *args, size=size)
        return np.load(self.path('position.npy')).astype(float)

    def draw(self, formula, diagonal, layout, image, size=None):
        """Draws the texture of a layout with padding, and saves it as `image`."""
        position = self.positions(layout, layout, '--padding', 64, size=size)
        from PIL import Image
        texture = np.nan_to_num(np.rint(formula(position, diagonal))).astype(np.uint8)
        Image.fromarray(texture).save(self.path(image))

    def round_trip(self, mesh):
        self.run('unwrap', mesh, '-o', self.path('old.obj'), '--normalize')
        self.run('unwrap', mesh, '-o', self.path('new.obj'), '--normalize', '--max-stretch', 1.002)
        old, new = read_obj(self.path('old.obj')), read_obj(self.path('new.obj'))
        diagonal = np.linalg.norm(old[0].max(0) - old[0].min(0))
        inside = ~np.isnan(self.positions('old.obj', 'old.obj', '--padding', 0)[..., 0])
        shown = self.positions('new.obj', 'new.obj', '--padding', 1)
        seams = None
        for name, formula in (('waves', waves), ('checkerboard', checkerboard)):
            self.draw(formula, diagonal, 'old.obj', 'old.png')
            report = self.bake('new.obj', 'old.obj', 'new.png', '--image', self.path('old.png'))
            self.bake('old.obj', 'new.obj', 'back.png', '--image', self.path('new.png'))
            error = (self.image('back.png') - self.image('old.png'))[inside]
            self.bake('new.obj', 'old.obj', 'new.npy', '--image', self.path('old.png'), '--padding', 2)
            codes = self.codes_without_rounding('new.npy')
            if seams is None:  # waves: texels that are off in the first atlas are crowded
                shown[np.abs(codes - formula(shown, diagonal)).max(-1) > OFF] = np.inf
                seams = Seams(new, old, shown)
            steps, rounded = (seams.steps(image, self.image('old.png'))[seams.has_room]
                              for image in (codes, self.image('new.png')))
            there = report['result']['bake']
            yield (os.path.basename(mesh), name, there['charts'], there['charts_without_texels'],
                   there['doubly_covered'], there['misses'], '%.1f' % psnr(error), len(seams.has_room),
                   int((~seams.has_room).sum()), *('%.2f' % max(0, np.percentile(steps, p)) for p in (50, 99, 100)),
                   '%.2f' % max(0, rounded.max()), '%.2f' % report['seconds']['total'])

    def copy(self, scan, copy):
        self.run('unwrap', scan, '-o', self.path('scan.obj'), '--normalize')
        self.run('unwrap', copy, '-o', self.path('copy.obj'), '--normalize')
        points = read_obj(self.path('scan.obj'))[0]
        self.diagonal = np.linalg.norm(points.max(0) - points.min(0))
        programs = {'majorant': self.baked}
        if self.blender:
            programs['Blender'] = self.baked_in_blender
        places = {(by, 1): bake('positions', 1) for by, bake in programs.items()}
        for by, bake in programs.items():  # several samples per texel are texels of a wider image
            fine = bake('positions', 1, self.size * ALONG)
            places[by, ALONG] = fine.reshape(self.size, ALONG, self.size, ALONG, 3).swapaxes(1, 2)
            places[by, ALONG] = places[by, ALONG].reshape(self.size, self.size, ALONG ** 2, 3)
        is_inside = ~np.isnan(places['majorant', 1][..., 0])
        misses = {by: int((is_inside & np.isnan(places[by, 1][..., 0])).sum()) for by in programs}
        compared = np.logical_and.reduce([~np.isnan(p).any(-1).reshape(self.size, self.size, -1).any(-1)
                                          for p in places.values()])
        crowded = None
        for name, formula in (('waves', waves), ('checkerboard', checkerboard)):
            self.draw(formula, self.diagonal, 'scan.obj', 'scan.png', self.size * ALONG)
            for what in ('numbers', 'colours'):
                decoded = light if what == 'colours' else lambda codes: codes / 255
                encoded = codes_of if what == 'colours' else lambda value: 255 * value
                for along in (1, ALONG):
                    values, images = {}, {}
                    for by, bake in programs.items():
                        values[by] = decoded(formula(places[by, along], self.diagonal))
                        if along > 1:
                            values[by] = values[by].mean(2)
                        images[by] = bake(what, along)
                    if crowded is None:
                        crowded = {by: np.abs(images[by] - 255 * values[by]).max(-1) > OFF for by in programs}
                        left_out = {by: int((compared & crowded[by]).sum()) for by in programs}
                        compared &= ~np.logical_or.reduce(list(crowded.values()))
                    for by in programs:
                        of_codes = psnr((images[by] - encoded(values[by]))[compared])
                        of_light = psnr(255 * (decoded(images[by]) - values[by])[compared])
                        yield (os.path.basename(scan), os.path.basename(copy), name, what, along ** 2, by,
                               int(is_inside.sum()), misses[by], left_out[by], '%.2f' % of_codes,
                               '%.2f' % of_light if what == 'colours' else '')

    def baked(self, what, along, size=None):
        """Returns the copy's image of codes; for 'positions', NaN without a point."""
        if what == 'positions':
            return self.positions('copy.obj', 'scan.obj', '--padding', 0, size=size)
        self.bake('copy.obj', 'scan.obj', 'copy.png', '--image', self.path('scan.png'), '--samples', along,
                  *(['--linear'] if what == 'numbers' else []))
        return self.image('copy.png')

    def baked_in_blender(self, what, along, size=None):
        size = size or self.size
        subprocess.run([self.blender, '-b', '--factory-startup', '--python-exit-code', '1', '--python',
                        os.path.abspath(__file__), '--', self.folder, str(size), str(OUTSIDE * self.diagonal),
                        str(along ** 2), what], check=True, stdout=subprocess.DEVNULL)
        if what != 'positions':
            return self.image('blender.png')[..., :3]
        found = np.load(self.path('found.npy')).astype(float)
        # Blender writes 0 if a ray finds nothing, and sometimes an alpha of 1.
        is_found = (found[..., 3] == 1) & (found[..., :3] != 0).any(-1)
        return np.where(is_found[..., None], found[..., :3], np.nan)

    def many_charts(self):
        """Yields the names and layouts of two tests: triangles in a grid of square cells, each a chart, and thin
        strips."""
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
            there = report['result']['bake']
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
    print('|' + '|'.join('---' if name in ('mesh', 'copy', 'texture', 'of', 'by', 'layout', 'size', 'format') else '--:'
                         for name in head) + '|')
    for row in rows:
        print('| ' + ' | '.join(map(str, row)) + ' |', flush=True)
    print()


def main():
    parser = argparse.ArgumentParser(description=__doc__.split('\n')[0])
    parser.add_argument('majorant')
    parser.add_argument('meshes', nargs='*')
    parser.add_argument('--size', type=int, default=2048)
    parser.add_argument('--large', type=int, default=0)
    parser.add_argument('--copy', nargs=2, action='append', default=[])
    parser.add_argument('--blender', help='the program, for copies')
    parser.add_argument('--folder')
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(dir=options.folder) as folder:
        bench = Bench(options.majorant, folder, options.size, options.blender)
        if options.meshes:
            print_table(('mesh', 'texture', 'charts', 'without texels', 'double', 'misses', 'PSNR, dB', 'points of seams', 'crowded',
                         'median', '99 %', 'largest step', 'of 8 bits', 's'), (row for mesh in options.meshes for row in bench.round_trip(mesh)))
        if options.copy:
            print_table(('mesh', 'copy', 'texture', 'of', 'samples', 'by', 'texels', 'misses', 'crowded', 'PSNR, dB', 'of light'),
                        (row for pair in options.copy for row in bench.copy(*pair)))
        print_table(('layout', 'charts', 'without texels', 'centres', 'partly', 'double', 's'), bench.charts())
        if options.large and options.meshes:
            print_table(('mesh', 'size', 'format', 'memory, GB', 's'), bench.large(options.meshes[-1], options.large))


# ------------------------------------------------------------------ inside of Blender
def material_of(shown, target):
    """Makes `shown` the emission of the material, and the target the active image to bake to."""
    import bpy
    material = bpy.data.materials.new('m')
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    emission, output = nodes.new('ShaderNodeEmission'), nodes.new('ShaderNodeOutputMaterial')
    links.new(emission.outputs['Emission'], output.inputs['Surface'])
    if shown:
        links.new(shown(nodes), emission.inputs['Color'])
    if target:
        nodes.active = nodes.new('ShaderNodeTexImage')
        nodes.active.image = target
    return material


def bake_in_blender(folder, size, outside, samples, what):
    """Bakes scan.obj with scan.png to copy.obj: blender.png; for 'positions' found.npy, whose last channel is 1
    where there is a point."""
    import bpy
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = 'CYCLES'
    scene.cycles.samples, scene.cycles.use_denoising = samples, False
    things = []
    for name in ('scan', 'copy'):
        bpy.ops.wm.obj_import(filepath=os.path.join(folder, name + '.obj'), forward_axis='Y', up_axis='Z')
        things.append(bpy.context.selected_objects[0])
    scan, copy = things
    scan.select_set(True)
    bpy.context.view_layer.objects.active = copy

    def textured(nodes):
        node = nodes.new('ShaderNodeTexImage')
        node.image = bpy.data.images.load(os.path.join(folder, 'scan.png'))
        if what == 'numbers':
            node.image.colorspace_settings.name = 'Non-Color'
        return node.outputs['Color']

    def placed(nodes):
        return nodes.new('ShaderNodeNewGeometry').outputs['Position']

    has_places = what == 'positions'
    image = bpy.data.images.new('baked', size, size, alpha=True, float_buffer=has_places, is_data=what != 'colours')
    for thing, material in ((scan, material_of(placed if has_places else textured, None)),
                            (copy, material_of(None, image))):
        thing.data.materials.clear()
        thing.data.materials.append(material)
    bpy.ops.object.bake(type='EMIT', use_selected_to_active=True, cage_extrusion=outside, max_ray_distance=2 * outside,
                        margin=0, use_clear=True)
    if has_places:
        found = np.empty(4 * size * size, np.float32)
        image.pixels.foreach_get(found)
        np.save(os.path.join(folder, 'found.npy'), found.reshape(size, size, 4)[::-1])
    else:
        image.filepath_raw, image.file_format = os.path.join(folder, 'blender.png'), 'PNG'
        image.save()


if __name__ == '__main__':
    if 'bpy' in sys.modules:
        folder, size, outside, samples, what = sys.argv[sys.argv.index('--') + 1:]
        bake_in_blender(folder, int(size), float(outside), int(samples), what)
    else:
        main()
