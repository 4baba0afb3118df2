# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: GPL-3.0-or-later
"""UV layouts, proofs, quads and textures of majorant, in Blender.

The add-on of Blender 3.4 to 4.1 (bl_info) and the extension of 4.2 (blender_manifest.toml) are one folder; its zip
(`make blender-addon`) has a wheel of the module majorant inside.

    meshes.py      meshes of Blender as arrays, and arrays back
    layouts.py     arrays to layouts, by majorant; knows nothing of Blender
    textures.py    base colours of materials as images, and images back
    runs.py        a computation on a thread, and the operator that waits for it
    operators.py   unwrap, pack, check, quads, bake
    panels.py      the panel in the sidebars, and its settings
    library.py     where the module majorant is found
"""
bl_info = {
    'name': 'majorant',
    'author': 'the majorant developers',
    'version': (0, 1, 0),
    'blender': (3, 4, 0),
    'location': '3D Viewport and UV Editor > Sidebar > majorant',
    'description': 'UV layouts without overlaps, proven; packing, checks, quad meshes and texture transfer',
    'category': 'UV',
}

if 'operators' in locals():
    import importlib

    for module in (library, meshes, layouts, textures, runs, operators, panels):  # noqa: F821
        importlib.reload(module)

from . import library, meshes, layouts, textures, runs, operators, panels  # noqa: E402, F401


def register():
    operators.register()
    panels.register()


def unregister():
    panels.unregister()
    operators.unregister()
