# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators: unwrap, pack, check, quads, bake. Each is one step of undo."""
import bpy
import numpy as np
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty

from . import layouts, meshes, runs, textures

SEAMS = (
    ('AUTO', 'Automatic', 'majorant chooses the seams: few, short and hidden ones'),
    ('MARKED', 'Marked', 'The edges that are marked as seams, and no others unless a piece is closed'),
    ('SHARP', 'Sharp edges', 'Edges where two faces meet at an angle'),
    ('UV', 'UV map', 'The borders of the islands of the active UV map'),
)
PRESETS = (
    ('NONE', 'None', 'The numbers below'),
    ('PAINT', 'Paint', 'Few seams, little stretch: to paint by hand'),
    ('LIGHTMAP', 'Lightmap', 'Every texel counts: baked light'),
    ('GAME', 'Game', 'A fuller square: textures of models in games'),
    ('SINGLE', 'Single', 'One chart for each piece'),
)
FEATURES = (
    ('ANGLE', 'Angle', 'Edges where two faces meet at an angle'),
    ('SHARP', 'Marked sharp', 'Edges that are marked as sharp'),
    ('NONE', 'None', 'Borders of the surface only'),
)
BAKED = (
    ('COLOUR', 'Base colour', 'The images at the base colour of the materials'),
    ('NORMAL', 'Normal', 'Normals of the flat faces, in object space'),
    ('POSITION', 'Position', 'Places on the surface'),
)


class Packing:
    """Options of all layouts."""
    padding: FloatProperty(name='Padding', min=0, max=256, default=4, description='Least distance of two charts, in pixels')
    resolution: IntProperty(name='Resolution', min=16, max=16384, default=1024,
                            description='Side of the texture that the padding is counted in, in pixels')
    scale: BoolProperty(name='Object scale', default=True,
                        description='Measure surfaces as they are in the scene, with the scale of their objects')
    together: BoolProperty(name='One square', default=True,
                           description='All objects share the unit square; else each has it for itself')
    hold_pins: BoolProperty(name='Hold pins', default=True, description='Pinned UVs stay where they are')
    only_selected: BoolProperty(name='Selection', default=True,
                                description='In Edit Mode: faces that are not selected keep their UVs')
    time_limit: FloatProperty(name='Time limit', min=0, soft_max=600, default=0, subtype='TIME', unit='TIME_ABSOLUTE',
                              description='Seconds after which the best layout so far is taken; 0: none')


class Unwrapping(Packing):
    """Options of `unwrap`."""
    seams: EnumProperty(name='Seams', items=SEAMS, default='AUTO')
    sharp_angle: FloatProperty(name='Angle', min=1, max=179, default=40, description='Degrees, for sharp edges')
    keep_marked: BoolProperty(name='Marked too', default=True,
                              description='Edges that are marked as seams are cut, beside those that are chosen')
    join: BoolProperty(name='Join edges', default=True,
                       description='Edges that lie at the same place are one edge for the layout; where seams are marked or '
                                   'UVs pinned, nothing is joined')
    preset: EnumProperty(name='Preset', items=PRESETS, default='NONE')
    max_stretch: FloatProperty(name='Stretch', min=0, soft_max=1.2, default=0, precision=3,
                               description='Root mean square stretch that no chart exceeds; 0: 1.015')
    charts: IntProperty(name='Charts', min=0, soft_max=100, default=0, description='Least number of charts; 0: any')
    new_map: BoolProperty(name='New UV map', default=False, description='Write a new UV map; the active one stays')


def options_of(operator):
    """The layouts.Options that an operator's properties say."""
    names = layouts.Options.__dataclass_fields__
    return layouts.Options(**{name: getattr(operator, name) for name in names if hasattr(operator, name)})


class Layouting(runs.Computing):
    """Shared code of the operators on UV maps."""

    @classmethod
    def poll(cls, context):
        return context.mode in {'OBJECT', 'EDIT_MESH'} and context.object is not None and context.object.type == 'MESH'

    def _parts(self, context):
        parts, skipped = meshes.chosen_parts(context, self.only_selected)
        for name, reason in skipped:
            self.report({'WARNING'}, f'{name}: {reason}; it is left out')
        if not parts:
            raise layouts.Refusal('there is nothing to work on: select an object with faces'
                                  + (', and faces of it' if context.mode == 'EDIT_MESH' else ''))
        self._chosen = parts
        return parts

    def is_current(self, context):
        return all(meshes.is_unchanged(part) for part in self._chosen)

    def _say(self, lines):
        for line in lines:
            self.report({'WARNING'}, line)


class MAJORANT_OT_unwrap(Layouting, Unwrapping, bpy.types.Operator):
    """Lay the surface out in the unit square: little stretch, no overlaps, proven"""
    bl_idname = 'majorant.unwrap'
    bl_label = 'Unwrap'
    bl_options = {'REGISTER', 'UNDO'}

    def prepare(self, context, majorant):
        parts, options = self._parts(context), options_of(self)
        if options.seams == 'UV' and any(part.uv is None for part in parts):
            raise layouts.Refusal('an object has no UV map whose borders could be seams; choose other seams')
        return lambda callback: layouts.unwrap(majorant, parts, options, callback)

    def finish(self, context, layout):
        for part, uv in zip(self._chosen, layout.uvs):
            if meshes.write_uv(part, uv, 'majorant' if self.new_map else '') is None:
                self.report({'ERROR'}, f'{part.name}: has {meshes.MOST_LAYERS} UV maps already; remove one')
        self._say(layout.warnings)
        self.report({'INFO'}, f'{layout.charts} charts, stretch {layout.stretch:.4f}')
        return {'FINISHED'}

    def draw(self, context):
        draw_unwrap(self.layout, self)


class MAJORANT_OT_pack(Layouting, Packing, bpy.types.Operator):
    """Move and turn the islands of the active UV map into the unit square; their shapes stay"""
    bl_idname = 'majorant.pack'
    bl_label = 'Pack'
    bl_options = {'REGISTER', 'UNDO'}

    def prepare(self, context, majorant):
        parts, options = self._parts(context), options_of(self)
        return lambda callback: layouts.pack(majorant, parts, options, callback)

    def finish(self, context, layout):
        for part, uv in zip(self._chosen, layout.uvs):
            meshes.write_uv(part, uv)
        self._say(layout.warnings)
        self.report({'INFO'}, f'{layout.charts} islands packed')
        return {'FINISHED'}

    def draw(self, context):
        draw_packing(self.layout, self)


class MAJORANT_OT_check(Layouting, bpy.types.Operator):
    """Prove the active UV maps, or select the faces that are turned over, have no area or overlap"""
    bl_idname = 'majorant.check'
    bl_label = 'Check'
    bl_options = {'REGISTER', 'UNDO'}

    together: BoolProperty(name='One square', default=True,
                           description='Layouts of several objects must not overlap each other either')
    scale: BoolProperty(name='Object scale', default=True, description='Measure stretch with the scale of the objects')
    only_selected: BoolProperty(name='Selection', default=False, description='In Edit Mode: look at selected faces only')
    select: BoolProperty(name='Select bad faces', default=True, description='Select the faces that are wrong')
    time_limit: FloatProperty(name='Time limit', min=0, default=0, subtype='TIME', unit='TIME_ABSOLUTE',
                              description='Seconds after which what is not decided stays so; 0: none')

    def prepare(self, context, majorant):
        parts, options = self._parts(context), options_of(self)
        return lambda callback: layouts.check(majorant, parts, options, callback)

    def finish(self, context, verdict):
        settings = context.scene.majorant
        settings.verdict = verdict.status
        if self.select and any(bad.any() for bad in verdict.bad):
            for part, bad in zip(self._chosen, verdict.bad):
                meshes.select_faces(part, bad)
        if verdict.status == 'valid':
            self.report({'INFO'}, f'valid: {verdict.charts} charts, stretch {verdict.stretch:.4f}, no overlaps, proven')
        else:
            self.report({'WARNING'}, f'{verdict.status}: ' + '; '.join(verdict.lines))
        if verdict.status == 'valid':
            self._say(verdict.lines)
        return {'FINISHED'}


class MAJORANT_OT_quads(Layouting, bpy.types.Operator):
    """Make a mesh of quads of the active object, as a new object"""
    bl_idname = 'majorant.quads'
    bl_label = 'Quads'
    bl_options = {'REGISTER', 'UNDO'}

    count: IntProperty(name='Quads', min=1, soft_max=100000, default=2000, description='Number of quads')
    features: EnumProperty(name='Features', items=FEATURES, default='ANGLE')
    feature_angle: FloatProperty(name='Angle', min=1, max=179, default=35, description='Degrees, for features by angle')
    scale: BoolProperty(name='Object scale', default=True, description='Quads are square as the object is seen')
    hide_original: BoolProperty(name='Hide original', default=True, description='Hide the object that the quads are made of')
    time_limit: FloatProperty(name='Time limit', min=0, default=0, subtype='TIME', unit='TIME_ABSOLUTE',
                              description='Seconds; 0: none')

    @classmethod
    def poll(cls, context):
        return context.mode == 'OBJECT' and context.object is not None and context.object.type == 'MESH'

    def prepare(self, context, majorant):
        part = meshes.part_of(context.object, False)
        if not len(part.faces):
            raise layouts.Refusal(f'{part.name}: has no face')
        self._chosen, self._object = [part], context.object
        options = options_of(self)
        arguments = (self.count, self.features, self.feature_angle)
        return lambda callback: layouts.quads(majorant, part, options, *arguments, callback)

    def finish(self, context, made):
        old, part = self._object, self._chosen[0]
        mesh = bpy.data.meshes.new(f'{old.data.name}_quads')
        mesh.from_pydata(made.V.tolist(), [], made.Q.tolist())
        for material in old.data.materials:
            mesh.materials.append(material)
        materials = np.empty(len(old.data.polygons), np.int32)
        old.data.polygons.foreach_get('material_index', materials)
        mesh.polygons.foreach_set('material_index', np.ascontiguousarray(materials[part.faces[made.faces]]))
        mesh.update()
        new = old.copy()  # with its place, parent and constraints
        new.name, new.data = f'{old.name}_quads', mesh
        new.modifiers.clear()
        new.vertex_groups.clear()
        for collection in old.users_collection:
            collection.objects.link(new)
        old.select_set(False)
        new.select_set(True)
        context.view_layer.objects.active = new
        if self.hide_original:
            old.hide_set(True)
        self._say(made.warnings)
        self.report({'INFO'}, f'{len(made.Q)} quads, {made.irregular} irregular vertices')
        return {'FINISHED'}


class MAJORANT_OT_bake(Layouting, bpy.types.Operator):
    """Move textures to the active UV map of the active object: from another UV map, or from the other selected object"""
    bl_idname = 'majorant.bake'
    bl_label = 'Bake'
    bl_options = {'REGISTER', 'UNDO'}

    source: EnumProperty(name='Bake', items=BAKED, default='COLOUR')
    from_map: StringProperty(name='From UV map', description='The map that the images belong to; empty: the first one that '
                                                             'is not active')
    size: IntProperty(name='Size', min=16, max=16384, default=1024, description='Side of the new image, in pixels')
    padding: IntProperty(name='Padding', min=0, max=256, default=16, description='Pixels around charts that are filled')
    distance: FloatProperty(name='Distance', min=0, default=0, subtype='DISTANCE',
                            description='The farthest place on the other object; 0: 2 % of its size')
    image_name: StringProperty(name='Image', description='Name of the new image; empty: that of the object')
    time_limit: FloatProperty(name='Time limit', min=0, default=0, subtype='TIME', unit='TIME_ABSOLUTE',
                              description='Seconds; 0: none')

    def prepare(self, context, majorant):
        target = meshes.part_of(context.object, False)
        others = [thing for thing in context.selected_objects if thing.type == 'MESH' and thing != context.object]
        if len(others) > 1:
            raise layouts.Refusal('several other objects are selected; select one to bake from, or none')
        carrier = others[0] if others else context.object
        part = meshes.part_of(carrier, False) if others else target
        for each in (target, part):
            if not len(each.faces):
                raise layouts.Refusal(f'{each.name}: has no face')
        self._chosen = [target, part]
        source = self._source(carrier, part, bool(others))
        numbers = (self.size, self.padding, self.distance, self.time_limit)
        return lambda callback: layouts.bake(majorant, target, source, *numbers)

    def _source(self, carrier, part, is_other):
        if self.source != 'COLOUR':
            return layouts.Source(part, attribute=self.source.lower())
        maps = carrier.data.uv_layers
        layer = maps.get(self.from_map) if self.from_map else next(
            (each for each in maps if is_other or each != maps.active), None)
        if layer is None:
            raise layouts.Refusal(f'{carrier.name}: has no UV map {self.from_map or "beside the active one"} that images could '
                                  'belong to; unwrap into a new UV map')
        uv, _ = meshes.layer_of(carrier.data, layer, part.loops)
        images, number = textures.of_object(carrier)
        return layouts.Source(part, uv, images, number)

    def finish(self, context, made):
        pixels, misses = made
        image = textures.new_image(self.image_name or f'{context.object.name}_baked', pixels)
        if misses:
            self.report({'WARNING'}, f'{misses} texels have nothing near enough; raise the distance')
        self.report({'INFO'}, f'{image.name}: {image.size[0]} x {image.size[1]}')
        return {'FINISHED'}


# ---- how options are shown -----------------------------------------------------------------------
def draw_packing(layout, options):
    column = layout.column(align=True)
    column.prop(options, 'padding')
    column.prop(options, 'resolution')
    column = layout.column()
    for name in ('together', 'hold_pins', 'only_selected', 'scale'):
        column.prop(options, name)
    column.prop(options, 'time_limit')


def draw_unwrap(layout, options):
    column = layout.column()
    column.prop(options, 'seams')
    if options.seams == 'SHARP':
        column.prop(options, 'sharp_angle')
    if options.seams in {'AUTO', 'SHARP'}:
        column.prop(options, 'keep_marked')
        column.prop(options, 'preset')
        column = layout.column(align=True)
        column.prop(options, 'max_stretch')
        column.prop(options, 'charts')
    column = layout.column()
    column.prop(options, 'join')
    column.prop(options, 'new_map')
    draw_packing(layout, options)


CLASSES = [MAJORANT_OT_unwrap, MAJORANT_OT_pack, MAJORANT_OT_check, MAJORANT_OT_quads, MAJORANT_OT_bake]


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
