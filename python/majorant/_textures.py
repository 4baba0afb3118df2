# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Textures in .glb files."""
from __future__ import annotations

import json
import os
import struct
from typing import Any, Callable

import numpy as np

from ._atlas_images import png_bytes
from ._errors import UsageError

_MAGIC, _JSON, _BINARY = 0x46546C67, 0x4E4F534A, 0x004E4942


def pixels(texture: Any) -> Any:
    image = np.asarray(texture)
    if image.ndim != 3 or image.shape[2] not in (3, 4) or not image.size or image.dtype != np.uint8:
        raise UsageError(f'texture is {image.dtype} of shape {image.shape}; (height, width, 3 or 4) of uint8 is needed')
    return image


def save_textured(path: str, write: Callable[[str], None], texture: Any) -> None:
    """Writes a .glb to a temporary file beside the path, adds the texture, and renames the file."""
    import tempfile
    image = pixels(texture)
    try:
        with tempfile.TemporaryDirectory(dir=os.path.dirname(os.path.abspath(path))) as folder:
            plain, textured = os.path.join(folder, 'plain.glb'), os.path.join(folder, 'textured.glb')
            write(plain)
            with open(plain, 'rb') as source, open(textured, 'wb') as target:
                target.write(with_texture(source.read(), image))
            os.replace(textured, path)
    except OSError as error:
        raise UsageError(f'{path}: {error.strerror}') from None


def with_texture(file: bytes, texture: Any) -> bytes:
    """Returns the .glb file with this texture on its meshes, (height, width, 3 or 4), row 0 at v = 0."""
    size = struct.unpack('<I', file[12:16])[0]
    content = json.loads(file[20:20 + size])
    binary = file[28 + size:]
    image = png_bytes(pixels(texture)[::-1])
    content['bufferViews'].append({'buffer': 0, 'byteOffset': len(binary), 'byteLength': len(image)})
    content['images'] = [{'bufferView': len(content['bufferViews']) - 1, 'mimeType': 'image/png'}]
    content['textures'] = [{'source': 0}]
    content['materials'] = [{'pbrMetallicRoughness': {'baseColorTexture': {'index': 0}, 'metallicFactor': 0}}]
    for mesh in content['meshes']:
        for primitive in mesh['primitives']:
            primitive['material'] = 0
    binary += image + bytes(-len(image) % 4)
    content['buffers'][0]['byteLength'] = len(binary)
    text = json.dumps(content, separators=(',', ':')).encode()
    text += b' ' * (-len(text) % 4)
    return (struct.pack('<III', _MAGIC, 2, 28 + len(text) + len(binary)) + struct.pack('<II', len(text), _JSON) + text
            + struct.pack('<II', len(binary), _BINARY) + binary)
