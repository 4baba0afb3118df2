# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds the module majorant: in the wheel of this folder, or installed for Blender's Python."""
import importlib
import os
import sys
import sysconfig
import tempfile
import zipfile
from pathlib import Path

WHEELS = Path(__file__).parent / 'wheels'


class Missing(Exception):
    """The module cannot be imported. The message says what to do."""


def wheel():
    """Returns the path of the wheel for this Python, or None."""
    tag = 'cp%d%d' % sys.version_info[:2]
    fitting = sorted(WHEELS.glob(f'majorant-*-{tag}-{tag}-*.whl'))
    return fitting[-1] if fitting else None


def load():
    """Returns the module majorant. Throws Missing."""
    if 'majorant' in sys.modules:
        return sys.modules['majorant']
    source = None if __package__.startswith('bl_ext.') else wheel()  # Blender 4.2 installs wheels itself
    if source is not None:
        folder = str(_unpacked(source))
        if folder not in sys.path:
            sys.path.insert(0, folder)
    try:
        return importlib.import_module('majorant')
    except ImportError as error:
        raise Missing(_remedy(source, error)) from error


def _remedy(source, error):
    version = '%d.%d' % sys.version_info[:2]
    if source is not None:
        return f'The majorant of this add-on does not load: {error}'
    others = sorted(path.name for path in WHEELS.glob('majorant-*.whl'))
    brought = f'the add-on has {others[0]}' if others else 'the add-on has no wheel of it'
    return (f'The Python module majorant is missing for Python {version} on {sysconfig.get_platform()} ({brought}). '
            'Build the add-on by `make blender-addon PYTHON=...` for this Python, or type: '
            f'{sys.executable} -m pip install majorant-....whl')


def _unpacked(source):
    """The folder with the files of the wheel, which is unpacked once: its libraries are loaded from there."""
    import bpy
    base = bpy.utils.user_resource('DATAFILES', path='majorant', create=True) or tempfile.mkdtemp(prefix='majorant_')
    stamp = source.stat()
    folder = Path(base) / f'{source.stem}-{stamp.st_size}-{stamp.st_mtime_ns}'
    if folder.is_dir():
        return folder
    new = Path(tempfile.mkdtemp(prefix='new_', dir=base))
    with zipfile.ZipFile(source) as archive:
        archive.extractall(new)
    try:
        os.rename(new, folder)
    except OSError:  # another Blender was faster
        if not folder.is_dir():
            raise
    return folder
