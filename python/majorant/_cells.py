# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Views of results in notebook cells: a line of text and a picture, at most 40 em wide."""
from __future__ import annotations

import base64
from typing import Any, Sequence

import numpy as np

from ._atlas_images import chart_image, png_bytes

# Width and height of pictures, pixels.
_SIDE = 480
# Direction from the object to the viewer.
_EYE = np.array([0.5, 0.35, 0.8])
_SURFACE, _EDGE = np.array([168, 190, 214]), np.array([40, 48, 64])
# Upper bound on the samples of a picture of a solid; they take some 100 MB.
_MOST_SAMPLES = 4_000_000


def escaped(text: str) -> str:
    return text.replace('&', '&amp;').replace('<', '&lt;').replace('>', '&gt;')


def cell(text: str, content: str) -> str:
    return f'<p>{escaped(text)}</p><div style="max-width:40em">{content}</div>'


def table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    def line(tag: str, words: Sequence[str]) -> str:
        return '<tr>' + ''.join(f'<{tag} style="text-align:left">{escaped(word)}</{tag}>' for word in words) + '</tr>'
    return '<table>' + line('th', head) + ''.join(line('td', row) for row in rows) + '</table>'


def picture(image: Any) -> str:
    """Returns an HTML element with these pixels, (height, width, 3) of bytes."""
    data, width = png_bytes(image), image.shape[1]
    return (f'<img style="width:100%;max-width:{width}px" alt="" '
            f'src="data:image/png;base64,{base64.b64encode(data).decode()}"/>')


def layout_picture(corner_uv: Any, chart: Any) -> Any:
    """Returns a picture of the layout with one colour per chart."""
    low = corner_uv.min((0, 1))
    size = (corner_uv - low).max() or 1.0
    image = chart_image(((corner_uv - low) / size).astype(np.float32), np.asarray(chart, np.int64), _SIDE, _SIDE)
    image[(image == 0).all(2)] = 255
    return image[::-1]


def solid_picture(points: Any, polygons: Any) -> Any:
    """Returns a picture of polygons (#, k) in space with their edges, with hidden surfaces removed."""
    forward = _EYE / np.linalg.norm(_EYE)
    right = np.cross([0.0, 1.0, 0.0], forward)
    right /= np.linalg.norm(right)
    seen = np.asarray(points, float) @ np.stack([right, np.cross(forward, right), forward], 1)
    image = np.full((_SIDE, _SIDE, 3), 255, np.uint8)
    if not len(polygons):
        return image
    used = seen[np.unique(polygons)]
    middle, size = (used.max(0) + used.min(0)) / 2, np.ptp(used, axis=0)[:2].max() or 1.0
    p = (seen - middle) * (0.94 * _SIDE / size) + [_SIDE / 2, _SIDE / 2, 0]
    corner = p[polygons]
    normal = np.cross(corner[:, 1] - corner[:, 0], corner[:, -1] - corner[:, 0])
    light = 0.45 + 0.55 * np.abs(normal[:, 2]) / np.maximum(np.linalg.norm(normal, axis=1), 1e-300)
    count = polygons.shape[1]
    length = np.linalg.norm(corner - np.roll(corner, -1, axis=1), axis=2).max()
    samples = int(np.clip(1.5 * length, 2, max(2, (_MOST_SAMPLES / (count * len(polygons))) ** 0.5)))
    t = np.linspace(0, 1, samples)
    b = np.stack(np.meshgrid(t, t), -1).reshape(-1, 2)
    b = np.stack([1 - b.sum(1), b[:, 0], b[:, 1]], 1)[b.sum(1) <= 1 + 1e-12]
    places, colors = [], []
    for k in range(1, count - 1):  # a fan
        places.append((b @ corner[:, [0, k, k + 1]]).reshape(-1, 3))
        colors.append(np.repeat(light[:, None] * _SURFACE, len(b), 0))
    if length > 3:  # below that, only edges would be visible
        for k in range(count):
            a, c = corner[:, k], corner[:, (k + 1) % count]
            edge = a[:, None] + t[None, :, None] * (c - a)[:, None]
            places.append(edge.reshape(-1, 3) + [0, 0, 1])
            colors.append(np.broadcast_to(_EDGE, (edge.shape[0] * edge.shape[1], 3)))
    place, color = np.concatenate(places), np.concatenate(colors)
    order = np.argsort(place[:, 2], kind='stable')
    column, row = (np.clip(place[order, k].astype(int), 0, _SIDE - 1) for k in range(2))
    image[_SIDE - 1 - row, column] = color[order].astype(np.uint8)  # the last sample of a pixel is the nearest
    return image
