# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Transfer of textures and attributes to new layouts."""
from __future__ import annotations

import json
import math
from typing import Any, NamedTuple, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _core, _options
from ._errors import UsageError
from ._types import Faces

_LARGEST_IMAGE = 16384
_ATTRIBUTES = ('position', 'normal', 'face')


class Baked(NamedTuple):
    """An image in a layout, (height, width, channels) with rows from the top, and the report of the run."""
    image: NDArray[Any]
    report: dict[str, Any]


def bake(V: ArrayLike, F: Faces, uv: ArrayLike, *, from_uv: ArrayLike | None = None, from_V: ArrayLike | None = None,
         from_F: Faces | None = None, images: Sequence[ArrayLike] = (), image_of_face: ArrayLike | None = None,
         attribute: str | None = None, size: int | tuple[int, int] = 1024, padding: int = 16, linear: bool = False,
         distance: float | None = None, time_limit: float | None = None, threads: int = 0) -> Baked:
    """Transfers textures or attributes of a surface to another layout of it, or to the layout of another surface.

        baked = majorant.bake(V, F, r.corner_uv, from_uv=old_uv, images=[picture])
        baked.image                          # (1024, 1024, 3)

        V, F, uv        the new layout; uv is (#V, 2) or (#F, corners, 2)
        from_V, from_F  the surface that carries the values; None: V and F
        from_uv         its layout, which the images belong to
        images          arrays (height, width, channels) of uint8 or floats, rows from the top
        image_of_face   (#from_F,) the image of each face, if there are several
        attribute       in place of images: 'position', 'normal' (of flat faces) or 'face', as floats
        size            pixels of both sides, or (width, height)
        padding         width in pixels of the filled border around charts
        linear          whether uint8 images hold linear numbers; otherwise they are sRGB codes
        distance        upper bound on the distance to another surface; None: 2 % of its diagonal

    The image is of uint8 if all images are. docs/baking.md describes the method. Raises InvalidError if a texel lies in
    two places of the layout, UnsupportedError if the layout leaves the unit square.
    """
    target = _arrays.mesh(V, F, uv)
    if (from_V is None) != (from_F is None):
        raise UsageError('from_V and from_F go together')
    carrier = _arrays.mesh(V if from_V is None else from_V, F if from_F is None else from_F, from_uv)
    pixels = [_pixels(f'images[{k}]', image) for k, image in enumerate(images)]
    if bool(pixels) == (attribute is not None):
        raise UsageError('say what to bake: either images or an attribute')
    if pixels and from_uv is None:
        raise UsageError('images are of a layout; give from_uv')
    faces = len(carrier.polygons[1]) - 1
    if image_of_face is None and len(pixels) > 1:
        raise UsageError('there are several images; give image_of_face')
    numbers: list[int] = []
    if image_of_face is not None:
        numbers = _arrays.integers('image_of_face', image_of_face, (faces,), len(pixels), 'images').tolist()
    width, height = size if isinstance(size, tuple) else (size, size)
    keywords = {
        'image_of_face': numbers,
        'attribute': '' if attribute is None else _options.choice('attribute', attribute, _ATTRIBUTES),
        'width': _options.integer('size', width, 1, _LARGEST_IMAGE),
        'height': _options.integer('size', height, 1, _LARGEST_IMAGE),
        'padding': _options.integer('padding', padding, 0, _LARGEST_IMAGE),
        'linear': _options.truth('linear', linear),
        'nearest': from_V is not None,
        'bytes': bool(pixels) and all(image.dtype == np.uint8 for image in pixels),
        'distance': None if distance is None else _options.number('distance', distance, 0, zero=True),
        'time_limit': math.inf if time_limit is None else _options.number('time_limit', time_limit, 0, zero=True, infinite=True),
        'threads': _options.integer('threads', threads, 0, 1024),
    }
    image, report = _core.bake(target, carrier, pixels, keywords)
    return Baked(image, json.loads(report))


def _pixels(name: str, value: ArrayLike) -> NDArray[Any]:
    array = np.asarray(value)
    if array.ndim == 2:
        array = array[:, :, None]
    if array.ndim != 3 or not 1 <= array.shape[2] <= 4 or 0 in array.shape:
        raise UsageError(f'{name} has shape {array.shape}, not (height, width, channels)')
    if array.dtype == np.uint8:
        return np.ascontiguousarray(array)
    if array.dtype.kind != 'f':
        raise UsageError(f'{name} holds {array.dtype}, neither uint8 nor floats')
    return np.ascontiguousarray(array, dtype=np.float32)
