# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: GPL-3.0-or-later
"""Base colours of materials as images, and images back."""
import bpy
import numpy as np

from . import layouts

WHITE = np.full((1, 1, 3), 255, np.uint8)


def of_object(thing):
    """The images of an object's materials, (height, width, 3 or 4) with rows from the top, and for each polygon the number
    of its image. Materials without an image are one pixel of their colour."""
    materials = list(thing.data.materials) or [None]
    pictures, number_of = [], {}
    numbers = []
    for material in materials:
        source = image_of(material) if material is not None else None
        if source not in number_of or source is None:
            pictures.append(pixels_of(source) if source is not None else colour_of(material))
            number_of[source] = len(pictures) - 1
        numbers.append(number_of[source])
    polygons = np.empty(len(thing.data.polygons), np.int32)
    thing.data.polygons.foreach_get('material_index', polygons)
    return pictures, np.array(numbers)[np.minimum(polygons, len(numbers) - 1)]


def image_of(material):
    """The image at the base colour of a material, or None."""
    node = _principled(material)
    if node is None:
        return None
    links = node.inputs['Base Color'].links
    source = links[0].from_node if links else None
    if source is None:
        return None
    if source.type != 'TEX_IMAGE' or source.image is None:
        raise layouts.Refusal(f'{material.name}: its base colour is no plain image; bake it by Cycles')
    return source.image


def colour_of(material):
    """One pixel of the colour of a material, as codes of sRGB."""
    if material is None:
        return WHITE
    node = _principled(material)
    linear = np.array((node.inputs['Base Color'].default_value if node is not None else material.diffuse_color)[:3])
    code = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * np.maximum(linear, 1e-9) ** (1 / 2.4) - 0.055)
    return np.round(255 * np.clip(code, 0, 1)).astype(np.uint8).reshape(1, 1, 3)


def pixels_of(image):
    width, height = image.size
    values = np.empty(width * height * image.channels, np.float32)
    if not len(values):
        raise layouts.Refusal(f'{image.name}: the image cannot be read; look for its file')
    image.pixels.foreach_get(values)
    values = values.reshape(height, width, image.channels)[::-1]
    if values.shape[2] == 2:
        values = values[:, :, :1]
    elif values.shape[2] == 4 and (values[:, :, 3] == 1).all():
        values = values[:, :, :3]
    if image.is_float:
        return np.ascontiguousarray(values)
    return np.round(255 * values).astype(np.uint8)


def new_image(name, pixels):
    """A new image of Blender, packed into the file."""
    height, width, channels = pixels.shape
    is_bytes = pixels.dtype == np.uint8
    image = bpy.data.images.new(name, width, height, alpha=channels == 4, float_buffer=not is_bytes)
    values = np.ones((height, width, 4), np.float32)
    colours = pixels[::-1].astype(np.float32) / (255 if is_bytes else 1)
    if channels < 3:
        values[:, :, :3] = colours[:, :, :1]
    else:
        values[:, :, :channels] = colours
    image.pixels.foreach_set(values.ravel())
    image.update()
    image.pack()
    return image


def _principled(material):
    if not material.use_nodes or material.node_tree is None:
        return None
    return next((node for node in material.node_tree.nodes if node.type == 'BSDF_PRINCIPLED'), None)
