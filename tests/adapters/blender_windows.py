# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Runs in Blender with windows: the operators as started by buttons, with Escape and undo.

    xvfb-run blender --factory-startup --enable-event-simulate --python blender_windows.py -- FOLDER

Writes a screenshot of the panel to FOLDER/panel.png. Prints `ok CASE`.
"""
import os
import sys
import time
import traceback

import bpy

sys.dont_write_bytecode = True
sys.path[:0] = [os.environ['MAJORANT_ADDON'], os.path.dirname(os.path.abspath(__file__))]
import blender_objects as objects  # noqa: E402

FOLDER = sys.argv[sys.argv.index('--') + 1]
TAB = 168  # pixels from the top of the sidebar to the middle of its fourth tab
LIMIT = 240  # seconds for one wait


def view():
    """Returns a context of the 3D viewport."""
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == 'VIEW_3D')
    region = next(region for region in area.regions if region.type == 'WINDOW')
    return {'window': window, 'screen': window.screen, 'area': area, 'region': region}


def press(key, x=200, y=200):
    window = bpy.context.window_manager.windows[0]
    window.event_simulate(type='MOUSEMOVE', value='NOTHING', x=x, y=y)
    for value in ('PRESS', 'RELEASE'):
        window.event_simulate(type=key, value=value, x=x, y=y)


def call(operator, *words, **options):
    with bpy.context.temp_override(**view()):
        return operator(*words, **options)


def computing():
    from majorant_blender import runs
    return runs.current


def cases():
    """A generator: each `yield` returns to Blender, which handles events until the yielded condition holds."""
    area = view()['area']
    area.spaces.active.show_region_ui = True
    call(bpy.ops.mesh.primitive_monkey_add)
    thing = bpy.context.object
    call(bpy.ops.ed.undo_push, message='the monkey')
    yield
    # Started by a button, the operator runs in a timer, shows its progress, and finishes.
    before = objects.uvs(thing.data)
    assert call(bpy.ops.majorant.unwrap, 'INVOKE_DEFAULT') == {'RUNNING_MODAL'}
    assert computing() is not None and (objects.uvs(thing.data) == before).all()
    assert computing().text().startswith('Unwrap: ')
    assert call(bpy.ops.majorant.unwrap, 'INVOKE_DEFAULT') == {'CANCELLED'}, 'two at once'
    yield lambda: computing() is None
    objects.require_valid([thing.data])
    after = objects.uvs(thing.data)
    assert (after != before).any()
    print('ok finish', flush=True)

    # One undo step restores the old layout, and redo the new one.
    assert call(bpy.ops.ed.undo) == {'FINISHED'}
    yield
    thing = bpy.context.object
    assert (objects.uvs(thing.data) == before).all(), 'undo does not bring the old layout back'
    assert call(bpy.ops.ed.redo) == {'FINISHED'}
    yield
    thing = bpy.context.object
    assert (objects.uvs(thing.data) == after).all(), 'redo does not bring the new layout'
    print('ok undo', flush=True)

    # Escape ends a long run without changes.
    bpy.ops.object.mode_set(mode='EDIT')
    bpy.ops.mesh.select_all(action='SELECT')
    bpy.ops.mesh.subdivide(number_cuts=6)
    bpy.ops.object.mode_set(mode='OBJECT')
    before = objects.everything_else(thing), objects.uvs(thing.data)
    assert call(bpy.ops.majorant.unwrap, 'INVOKE_DEFAULT') == {'RUNNING_MODAL'}
    run, begun = computing(), time.monotonic()
    yield lambda: run.steps > 0 or time.monotonic() > begun + 3
    assert computing() is run, 'it was over before it could be cancelled'
    pressed, worked = time.monotonic(), time.thread_time()
    press('ESC')
    yield lambda: computing() is None
    print(f'cancelled after {time.monotonic() - pressed:.1f} s, {time.thread_time() - worked:.1f} s of the main thread',
          flush=True)
    assert (objects.uvs(thing.data) == before[1]).all() and objects.everything_else(thing) == before[0]
    yield lambda: not run.is_alive()
    assert run.stop.is_set()
    print('ok cancel', flush=True)

    # A mesh that changes during the run is not written.
    objects.clear()
    call(bpy.ops.mesh.primitive_monkey_add)
    thing = bpy.context.object
    before = objects.uvs(thing.data)
    assert call(bpy.ops.majorant.unwrap, 'INVOKE_DEFAULT') == {'RUNNING_MODAL'}
    thing.data.vertices[0].co.x += 1
    yield lambda: computing() is None
    assert (objects.uvs(thing.data) == before).all()
    print('ok changed', flush=True)

    # A screenshot of the panel beside the layout.
    thing.data.vertices[0].co.x -= 1
    call(bpy.ops.majorant.unwrap, 'EXEC_DEFAULT')
    call(bpy.ops.majorant.check)
    assert bpy.context.scene.majorant.verdict == 'valid'
    bpy.context.window_manager.windows[0].workspace = bpy.data.workspaces['UV Editing']
    yield
    yield
    where = view()
    where['area'].spaces.active.show_region_ui = True
    yield
    yield
    sidebar = next(region for region in where['area'].regions if region.type == 'UI')
    press('LEFTMOUSE', sidebar.x + sidebar.width - 10, sidebar.y + sidebar.height - TAB)
    yield
    bpy.ops.mesh.select_all(action='SELECT')
    yield
    yield
    bpy.ops.screen.screenshot(filepath=os.path.join(FOLDER, 'panel.png'))
    print('ok panel', flush=True)


def steps():
    waiting, begun = None, 0.0
    for waiting in cases():
        begun = time.monotonic()
        while waiting is not None and not waiting():
            if time.monotonic() > begun + LIMIT:
                raise AssertionError('nothing happens any more')
            yield
        yield


def main():
    import majorant_blender
    bpy.context.preferences.view.show_splash = False
    majorant_blender.register()
    sequence = steps()

    def tick():
        try:
            next(sequence)
            return 0.05
        except StopIteration:
            pass
        except Exception:
            print(f'failed windows: {traceback.format_exc()}', flush=True)
        bpy.ops.wm.quit_blender()
        return None
    bpy.app.timers.register(tick, first_interval=1)


main()
