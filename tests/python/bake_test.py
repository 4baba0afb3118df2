#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""majorant.bake: textures and attributes of arrays, compared with the command and with exact values."""
import helpers
import numpy as np
import pytest

import majorant

V, F = helpers.grid(6)
OLD = np.clip(V[:, :2], 0, 1)


def ramp(side, dtype):
    """Returns a picture of its coordinates: red is u, green is v."""
    v, u = np.meshgrid(1 - (np.arange(side) + 0.5) / side, (np.arange(side) + 0.5) / side, indexing='ij')
    image = np.stack([u, v, 0 * u], -1)
    return np.round(255 * image).astype(np.uint8) if dtype == np.uint8 else image.astype(dtype)


def places(image, uv):
    """Returns the values of an image at uv."""
    height, width = image.shape[:2]
    return image[np.minimum(((1 - uv[:, 1]) * height).astype(int), height - 1), np.minimum((uv[:, 0] * width).astype(int), width - 1)]


@pytest.mark.parametrize('dtype, allowed', [(np.float32, 0.02), (np.uint8, 0.02)])
def test_a_picture_moves_to_the_new_layout(dtype, allowed):
    new = majorant.unwrap(V, F)
    baked = majorant.bake(V, new.faces, new.corner_uv, from_uv=OLD, images=[ramp(256, dtype)], size=256, linear=True)
    assert baked.image.shape == (256, 256, 3) and baked.image.dtype == dtype
    centres = new.corner_uv.mean(1)
    shown = places(baked.image, centres)[:, :2].astype(float) / (255 if dtype == np.uint8 else 1)
    assert np.abs(shown - OLD[new.faces].mean(1)).max() < allowed
    assert baked.report['result']['bake']['misses'] == 0


def test_the_image_of_each_face():
    one, two = np.full((1, 1, 3), 10, np.uint8), np.full((1, 1, 3), 200, np.uint8)
    number = (np.arange(len(F)) % 2).astype(int)
    baked = majorant.bake(V, F, OLD, from_uv=OLD, images=[one, two], image_of_face=number, size=128, linear=True)
    shown = places(baked.image, OLD[F].mean(1))[:, 0]
    assert (shown == np.where(number == 0, 10, 200)).mean() > 0.95


def test_positions_of_another_surface():
    near = majorant.bake(V + [0, 0, 0.001], F, OLD, from_V=V, from_F=F, attribute='position', size=64)
    assert near.image.dtype == np.float32
    assert np.abs(places(near.image, OLD[F].mean(1)) - V[F].mean(1)).max() < 0.03
    with pytest.raises(majorant.InvalidError, match='raise distance'):
        majorant.bake(V + [0, 0, 9], F, OLD, from_V=V, from_F=F, attribute='position', size=64)


def test_refusals():
    picture = ramp(8, np.uint8)
    with pytest.raises(majorant.InvalidError, match='two places'):
        majorant.bake(V, F, np.abs(OLD - 0.5), attribute='face', size=64)  # folded twice
    with pytest.raises(majorant.UnsupportedError, match='leaves'):
        majorant.bake(V, F, 2 * OLD, attribute='face', size=64)
    for words, message in ((dict(), 'either images'), (dict(images=[picture]), 'from_uv'),
                           (dict(images=[picture, picture], from_uv=OLD), 'image_of_face'),
                           (dict(attribute='tangent'), 'none of'), (dict(attribute='face', size=0), 'size'),
                           (dict(images=[picture.astype(int)], from_uv=OLD), 'neither uint8'),
                           (dict(images=[picture[0, 0]], from_uv=OLD), 'shape'), (dict(attribute='face', from_V=V), 'go together')):
        with pytest.raises(majorant.UsageError, match=message):
            majorant.bake(V, F, OLD, **words)


if __name__ == '__main__':
    helpers.main(__file__)
