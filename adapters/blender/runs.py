# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: GPL-3.0-or-later
"""A computation of majorant on a thread, and the operator that waits for it.

majorant lets Python's other threads run, so Blender draws while it computes. Escape sets `stop`; the run ends at its
next callback. Where that takes longer than PATIENCE the thread is left to itself, and what it finds is dropped.
"""
import threading
import time

import bpy

from . import layouts, library

PATIENCE = 0.5  # seconds after Escape
POLL = 0.1      # seconds between looks at the thread

current = None  # the run that the panel shows


class Run(threading.Thread):
    """work(callback) on a thread. Afterwards `result` or `error` is set."""

    def __init__(self, title, work):
        super().__init__(daemon=True)
        self.title, self.work = title, work
        self.stop = threading.Event()
        self.steps, self.energy = 0, None
        self.result = self.error = None
        self.begun = time.monotonic()

    def run(self):
        try:
            self.result = self.work(self.callback)
        except BaseException as error:
            self.error = error

    def callback(self, step):
        self.steps += 1
        self.energy = step.energy
        return self.stop.is_set()

    def text(self):
        seconds = time.monotonic() - self.begun
        steps = f', step {self.steps}' if self.steps else ''
        energy = f', energy {self.energy:.4f}' if self.energy is not None and abs(self.energy) < 1e6 else ''
        return f'{self.title}: {seconds:.0f} s{steps}{energy}'


class Computing:
    """A mixin of operators whose work takes a while.

    prepare(context, majorant) returns a function of a callback, which touches nothing of Blender; finish(context, result)
    writes what it returned and returns {'FINISHED'} or {'CANCELLED'}. Called by a menu or a button an operator waits in a
    timer, and Escape cancels it; in the background, by a script with EXEC_DEFAULT, and from the redo panel it computes at
    once.
    """

    def execute(self, context):
        work = self._prepared(context)
        if work is None:
            return {'CANCELLED'}
        try:
            result = work(None)
        except Exception as error:
            return self._failed(error)
        return self.finish(context, result)

    def invoke(self, context, event):
        global current
        if bpy.app.background:
            return self.execute(context)
        if current is not None:
            self.report({'WARNING'}, 'majorant is computing already; Escape cancels that')
            return {'CANCELLED'}
        work = self._prepared(context)
        if work is None:
            return {'CANCELLED'}
        self._run = current = Run(self.bl_label, work)
        self._stopped = None
        self._timer = context.window_manager.event_timer_add(POLL, window=context.window)
        self._run.start()
        context.window_manager.modal_handler_add(self)
        self._show(context)
        return {'RUNNING_MODAL'}

    def modal(self, context, event):
        if event.type == 'ESC' and event.value == 'PRESS' or self._run.stop.is_set():
            self._run.stop.set()
            self._stopped = self._stopped or time.monotonic()
        if self._run.is_alive():
            if self._stopped and time.monotonic() > self._stopped + PATIENCE:
                return self._cancelled(context)
            if event.type == 'TIMER':
                self._show(context)
            is_view = event.type in {'MIDDLEMOUSE', 'WHEELUPMOUSE', 'WHEELDOWNMOUSE', 'MOUSEMOVE', 'TIMER'}
            return {'PASS_THROUGH'} if is_view else {'RUNNING_MODAL'}
        if self._stopped:
            return self._cancelled(context)
        self._close(context)
        if self._run.error is not None:
            return self._failed(self._run.error)
        if not self.is_current(context):
            self.report({'ERROR'}, 'the mesh was changed meanwhile; nothing is written')
            return {'CANCELLED'}
        return self.finish(context, self._run.result)

    def cancel(self, context):
        """Blender ends, or the window closes."""
        self._run.stop.set()
        self._close(context)

    def is_current(self, context):
        return True

    def _prepared(self, context):
        try:
            return self.prepare(context, library.load())
        except (library.Missing, layouts.Refusal) as error:
            self.report({'ERROR'}, str(error))
            return None

    def _failed(self, error):
        import majorant
        if isinstance(error, (layouts.Refusal, majorant.Error)):
            self.report({'ERROR'}, str(error))
            return {'CANCELLED'}
        raise error

    def _cancelled(self, context):
        self._close(context)
        self.report({'INFO'}, f'{self.bl_label}: cancelled; nothing is changed')
        return {'CANCELLED'}

    def _show(self, context):
        context.workspace.status_text_set(self._run.text() + '   |   Esc: cancel')
        redraw(context)

    def _close(self, context):
        global current
        current = None
        context.window_manager.event_timer_remove(self._timer)
        if context.workspace is not None:
            context.workspace.status_text_set(None)
        redraw(context)


def redraw(context):
    """Draws the sidebars anew, where the panel is; not the views, which may be slow to draw."""
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type in {'VIEW_3D', 'IMAGE_EDITOR'}:
                for region in area.regions:
                    if region.type == 'UI':
                        region.tag_redraw()
