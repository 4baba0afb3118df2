# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Images of layouts: the chart of every texel, and PNG files."""
from __future__ import annotations

import struct
import zlib
from typing import Any

import numpy as np
from numpy.typing import NDArray

# Texels of one batch, which takes some 100 MB.
_BATCH = 1 << 21


def chart_image(corners: NDArray[np.float32], chart: NDArray[np.int64], width: int, height: int) -> NDArray[np.uint8]:
    """Returns the image of a layout, (height, width, 3). A texel has the colour of the chart that covers its centre, or
    is black.

    corners: (#F, 3, 2) in the unit square; chart: (#F,) numbers."""
    image = np.zeros((height, width, 3), np.uint8)
    p = corners.astype(np.float64) * (width, height)
    low = np.clip(np.floor(p.min(1) - 0.5).astype(int), 0, None)
    high = np.minimum(np.ceil(p.max(1) + 0.5).astype(int), (width, height))
    size = np.maximum(high - low, 0)
    counts = size.prod(1)
    end = np.cumsum(counts)
    start = 0
    while start < len(p):
        done = end[start - 1] if start else 0
        stop = max(start + 1, int(np.searchsorted(end, done + _BATCH, 'right')))
        _paint(image, p[start:stop], chart[start:stop], low[start:stop], size[start:stop], counts[start:stop])
        start = stop
    return image


def _paint(image: NDArray[np.uint8], p: Any, chart: Any, low: Any, size: Any, counts: Any) -> None:
    face = np.repeat(np.arange(len(p)), counts)
    number = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    texel = low[face] + np.stack([number % np.maximum(size[face, 0], 1), number // np.maximum(size[face, 0], 1)], 1)
    center = texel + 0.5
    inside = np.ones(len(face), bool)
    for k in range(3):
        a, b = p[face, k], p[face, (k + 1) % 3]
        along, to = b - a, center - a
        inside &= along[:, 0] * to[:, 1] - along[:, 1] * to[:, 0] >= 0
    texel, chart = texel[inside], chart[face[inside]]
    image[texel[:, 1], texel[:, 0]] = _colors(chart)


def _colors(chart: Any) -> Any:
    """Returns light colours, by multiples of the golden ratio, so that consecutive charts differ."""
    hue = (chart[:, None] * 0.618033988749895 + np.array([0, 1 / 3, 2 / 3])) % 1
    return (96 + 159 * (0.5 + 0.5 * np.cos(2 * np.pi * hue))).astype(np.uint8)


def png_bytes(image: NDArray[np.uint8]) -> bytes:
    """Returns a PNG file with these pixels, (height, width, 3 or 4), from the top row on."""
    height, width, channels = image.shape

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))
    rows = np.concatenate([np.zeros((height, 1), np.uint8), image.reshape(height, -1)], 1)  # no filter
    head = struct.pack('>IIBBBBB', width, height, 8, {3: 2, 4: 6}[channels], 0, 0, 0)
    return (b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', head) + chunk(b'IDAT', zlib.compress(rows.tobytes()))
            + chunk(b'IEND', b''))
