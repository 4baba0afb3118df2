# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Bakes ambient occlusion into the layout of an unwrapped model, in Blender, and renders the model with it.

Sample run, beside a model.obj that `majorant unwrap --normalize` has written:
  blender --background --python examples/texture_in_blender.py -- model.obj
makes model_ao.png (the texture), model_view.png and model.blend.
"""
import sys
from pathlib import Path

import bpy
from mathutils import Vector

path = Path(sys.argv[sys.argv.index('--') + 1]).resolve()
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.wm.obj_import(filepath=str(path))
model = bpy.context.selected_objects[0]
bpy.context.view_layer.objects.active = model
assert model.data.uv_layers, 'no texture coordinates'

# A material that is the texture, for now empty.
material = bpy.data.materials.new('textured')
material.use_nodes = True
texture = material.node_tree.nodes.new('ShaderNodeTexImage')
texture.image = bpy.data.images.new('occlusion', 2048, 2048)
material.node_tree.nodes.active = texture
model.data.materials.clear()
model.data.materials.append(material)

# Baked up to 8 pixels beyond each chart: half of the way to the next, where --padding is 16.
scene = bpy.context.scene
scene.world = bpy.data.worlds.new('world')
scene.render.engine = 'CYCLES'
scene.cycles.samples, scene.cycles.use_denoising = 32, False
bpy.ops.object.bake(type='AO', margin=8)
texture.image.filepath_raw, texture.image.file_format = str(path.with_name(path.stem + '_ao.png')), 'PNG'
texture.image.save()
colour = material.node_tree.nodes['Principled BSDF'].inputs['Base Color']
material.node_tree.links.new(texture.outputs['Color'], colour)

# A camera and a light from the front, above.
towards = Vector((0.5, -0.8, 0.5)).normalized()
camera = bpy.data.objects.new('camera', bpy.data.cameras.new('camera'))
camera.data.type, camera.data.ortho_scale = 'ORTHO', 1.5 * max(model.dimensions)
light = bpy.data.objects.new('light', bpy.data.lights.new('light', 'SUN'))
light.data.energy = 3
middle = sum((model.matrix_world @ Vector(corner) for corner in model.bound_box), Vector()) / 8
for thing in (camera, light):
    thing.location = middle + 3 * max(model.dimensions) * towards
    thing.rotation_euler = towards.to_track_quat('Z', 'Y').to_euler()
    scene.collection.objects.link(thing)
scene.camera = camera
scene.render.resolution_x = scene.render.resolution_y = 600
scene.render.filepath = str(path.with_name(path.stem + '_view.png'))
bpy.ops.render.render(write_still=True)
bpy.ops.wm.save_as_mainfile(filepath=str(path.with_suffix('.blend')))
