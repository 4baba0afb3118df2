# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel in the sidebars of the 3D viewport and the UV editor."""
import bpy
from bpy.props import EnumProperty, FloatProperty, IntProperty, PointerProperty, StringProperty

from . import operators, runs


class MajorantSettings(operators.Unwrapping, bpy.types.PropertyGroup):
    """Options that the buttons of the panel pass to the operators."""
    quad_count: IntProperty(name='Quads', min=1, soft_max=100000, default=2000)
    features: EnumProperty(name='Features', items=operators.FEATURES, default='ANGLE')
    feature_angle: FloatProperty(name='Angle', min=1, max=179, default=35)
    bake_source: EnumProperty(name='Bake', items=operators.BAKED, default='COLOUR')
    bake_size: IntProperty(name='Size', min=16, max=16384, default=1024)
    verdict: StringProperty()


PACKING = tuple(operators.Packing.__annotations__)
UNWRAPPING = PACKING + tuple(operators.Unwrapping.__annotations__)


def _button(layout, settings, idname, names, icon):
    button = layout.operator(idname, icon=icon)
    for name in names:
        setattr(button, name, getattr(settings, name))
    return button


class Sidebar:
    bl_region_type = 'UI'
    bl_category = 'majorant'
    bl_label = 'majorant'

    def draw(self, context):
        layout, settings = self.layout, context.scene.majorant
        layout.use_property_split = True
        layout.use_property_decorate = False
        if runs.current is not None:
            layout.label(text=runs.current.text(), icon='TIME')
            layout.label(text='Esc: cancel')
        column = layout.column()
        column.enabled = runs.current is None
        box = column.box()
        operators.draw_unwrap(box, settings)
        row = column.row(align=True)
        _button(row, settings, 'majorant.unwrap', UNWRAPPING, 'UV')
        _button(row, settings, 'majorant.pack', PACKING, 'PACKAGE')
        row = column.row(align=True)
        _button(row, settings, 'majorant.check', ('together', 'scale', 'time_limit'), 'CHECKMARK')
        if settings.verdict:
            row.label(text=settings.verdict)
        box = column.box()
        box.prop(settings, 'quad_count')
        box.prop(settings, 'features')
        if settings.features == 'ANGLE':
            box.prop(settings, 'feature_angle')
        quads = _button(box, settings, 'majorant.quads', ('features', 'feature_angle', 'scale', 'time_limit'), 'MESH_GRID')
        quads.count = settings.quad_count
        box = column.box()
        box.prop(settings, 'bake_source')
        box.prop(settings, 'bake_size')
        bake = _button(box, settings, 'majorant.bake', ('time_limit',), 'TEXTURE')
        bake.source, bake.size = settings.bake_source, settings.bake_size


class MAJORANT_PT_viewport(Sidebar, bpy.types.Panel):
    bl_space_type = 'VIEW_3D'


class MAJORANT_PT_uv_editor(Sidebar, bpy.types.Panel):
    bl_space_type = 'IMAGE_EDITOR'


CLASSES = [MajorantSettings, MAJORANT_PT_viewport, MAJORANT_PT_uv_editor]


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.Scene.majorant = PointerProperty(type=MajorantSettings)


def unregister():
    del bpy.types.Scene.majorant
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
