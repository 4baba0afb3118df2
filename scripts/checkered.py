#!/usr/bin/python3
"""A surface with a checkerboard laid on it by its texture coordinates, as PNG: what a texture would do.

Orthographic, light from the viewer, seams red (edges whose two sides have different coordinates), every
chart a tint of its own. Needs numpy; triangles and polygons (fans).

Sample run:
  scripts/checkered.py unwrapped.obj checkered.png --turn 30 --tilt 15 --squares 48 --size 480
"""
import argparse
import math
import struct
import zlib
from pathlib import Path

import numpy as np

TINTS = np.array([(0.35, 0.55, 0.75), (0.80, 0.55, 0.30), (0.45, 0.65, 0.40), (0.65, 0.45, 0.65),
                  (0.70, 0.65, 0.35), (0.40, 0.65, 0.65)])
SEAM = np.array((0.8, 0.1, 0.1))
SAMPLES = 3                                            # along each side of a pixel


def read(path):
    """(positions #T by 3 by 3, texture coordinates #T by 3 by 2, chart #T, seams #T by 3).

    Flag i of a triangle: its edge across from corner i is a seam.
    """
    v, vt, corners = [], [], []
    for line in Path(path).read_text().splitlines():
        words = line.split()
        if words[:1] == ['v']:
            v.append([float(x) for x in words[1:4]])
        elif words[:1] == ['vt']:
            vt.append([float(x) for x in words[1:3]])
        elif words[:1] == ['f']:
            face = [tuple(int(i) - 1 for i in word.split('/')[:2]) for word in words[1:]]
            corners += [(face[0], face[i], face[i + 1]) for i in range(1, len(face) - 1)]
    corners = np.array(corners)
    return (np.array(v)[corners[..., 0]], np.array(vt)[corners[..., 1]], *charts_and_seams(corners))


def charts_and_seams(corners):
    parent, sides = list(range(len(corners))), {}

    def find(a):
        while parent[a] != a:
            parent[a] = a = parent[parent[a]]
        return a
    for k, corner in enumerate(corners.tolist()):
        for i in range(3):
            ends = sorted((corner[i - 2], corner[i - 1]))
            sides.setdefault((ends[0][0], ends[1][0]), []).append((k, i, ends[0][1], ends[1][1]))
    seam = np.zeros((len(corners), 3), bool)
    for uses in sides.values():
        for k, i, *ends in uses[1:]:
            if ends == list(uses[0][2:]):
                parent[find(k)] = find(uses[0][0])
            else:
                seam[k, i] = seam[uses[0][0], uses[0][1]] = True
    roots = [find(k) for k in range(len(corners))]
    return np.unique(roots, return_inverse=True)[1], seam


def rotation(turn, tilt):
    """Around the vertical axis, then towards the viewer; degrees."""
    a, b = math.radians(turn), math.radians(tilt)
    around = np.array([[math.cos(a), 0, math.sin(a)], [0, 1, 0], [-math.sin(a), 0, math.cos(a)]])
    over = np.array([[1, 0, 0], [0, math.cos(b), -math.sin(b)], [0, math.sin(b), math.cos(b)]])
    return over @ around


def colour(weights, uv, tint, light, seam, heights, square):
    """Of points of one triangle, by their barycentric coordinates (#P by 3)."""
    cell = np.floor(weights @ uv / square).astype(int).sum(1) % 2
    shade = np.where(cell[:, None] == 1, tint, 0.25 * tint + 0.75)
    near = ((weights * heights < 1.6 * SAMPLES) & seam).any(1)
    return np.where(near[:, None], SEAM, shade) * (0.35 + 0.65 * light)


def render(points, uv, chart, seam, size, square):
    """Image (size by size by 3, 0 to 1) of triangles seen from z = +inf."""
    wide = size * SAMPLES
    low, high = points.reshape(-1, 3).min(0), points.reshape(-1, 3).max(0)
    scale = 0.94 * wide / (high - low)[:2].max()
    screen = (points - (low + high) / 2) * scale + [wide / 2, wide / 2, 0]
    screen[..., 1] = wide - screen[..., 1]
    image, depth = np.ones((wide, wide, 3)), np.full((wide, wide), -np.inf)
    for k, p in enumerate(screen):
        normal = np.cross(p[1] - p[0], p[2] - p[0])
        length, area = np.linalg.norm(normal), normal[2]
        x0, y0 = np.maximum(np.floor(p[:, :2].min(0)).astype(int), 0)
        x1, y1 = np.minimum(np.ceil(p[:, :2].max(0)).astype(int) + 1, wide)
        if area == 0 or x0 >= x1 or y0 >= y1:
            continue
        x, y = np.meshgrid(np.arange(x0, x1) + 0.5, np.arange(y0, y1) + 0.5)
        weights = np.stack([((p[i - 2, 0] - x) * (p[i - 1, 1] - y) - (p[i - 2, 1] - y) *
                             (p[i - 1, 0] - x)) / area for i in range(3)], -1)
        z = weights @ p[:, 2]
        box = depth[y0:y1, x0:x1]
        seen = (weights >= 0).all(-1) & (z > box)
        edges = np.array([np.linalg.norm(p[i - 2] - p[i - 1]) for i in range(3)])
        box[seen] = z[seen]
        image[y0:y1, x0:x1][seen] = colour(weights[seen], uv[k], TINTS[chart[k] % len(TINTS)],
                                           abs(area) / length, seam[k], length / edges, square)
    return image.reshape(size, SAMPLES, size, SAMPLES, 3).mean((1, 3))


def write_png(path, image):
    height, width, _ = image.shape
    rows = (np.clip(image, 0, 1) * 255 + 0.5).astype(np.uint8)
    raw = b''.join(b'\0' + row.tobytes() for row in rows)

    def chunk(kind, data):
        return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))
    header = struct.pack('>IIBBBBB', width, height, 8, 2, 0, 0, 0)
    Path(path).write_bytes(b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', header) +
                           chunk(b'IDAT', zlib.compress(raw, 9)) + chunk(b'IEND', b''))


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('mesh', help='an OBJ with vt')
    parser.add_argument('picture', help='.png')
    parser.add_argument('--turn', type=float, default=0, help='degrees around the vertical axis')
    parser.add_argument('--tilt', type=float, default=0, help='degrees towards the viewer')
    parser.add_argument('--squares', type=float, default=48, help='along the side of the layout')
    parser.add_argument('--size', type=int, default=480, help='pixels')
    options = parser.parse_args()
    points, uv, chart, seam = read(options.mesh)
    square = np.ptp(uv.reshape(-1, 2), axis=0).max() / options.squares
    turned = points @ rotation(options.turn, options.tilt).T
    write_png(options.picture, render(turned, uv, chart, seam, options.size, square))


if __name__ == '__main__':
    main()
