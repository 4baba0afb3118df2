#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the broken and good files of tests/data/maps, and their table.

    make_broken_files.py [FOLDER]     (default: tests/data/maps of this repository)

FOLDER/broken and FOLDER/good hold the files, FOLDER/surfaces their meshes, FOLDER/index.json the word of the
finding, the surface and the options of each file, and FOLDER/README.md the same as a table. The bytes are the
same on every machine.
"""
import json
import os
import sys

import broken_obj
import broken_vtu
import good_files
import value_files
from small_maps import cube, fan, obj_bytes, plate, square_grid, straight

DEFAULT = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'data', 'maps')

INTRODUCTION = '''# Small maps, broken and good

Made by `tests/checker/make_broken_files.py`; do not edit. `check_map.py` in the same folder refuses
every broken file for the reason named (the file may have others, too) and accepts every good one;
so must any other checker, with the same meaning of its options. `index.json` holds this table.

| file | reason | what it is | surface | options |
|---|---|---|---|---|
'''


def surfaces():
    meshes = {'fan': fan().surface, 'grid': square_grid().surface,
              'quad': square_grid(1, straight, 1, polygons=True).surface,
              'octagon': broken_vtu.octagon(), 'cube': cube().surface, 'plate': plate()[0]}
    return {name: obj_bytes(*mesh) for name, mesh in meshes.items()}


def all_cases():
    """Yields (folder, case) of every file."""
    for module in (broken_vtu, broken_obj):
        for case in module.cases():
            yield 'broken', case
    for case in value_files.broken_cases():
        yield 'broken', case
    for cases in (good_files.cases, value_files.good_cases):
        for case in cases():
            yield 'good', case


def files():
    """Returns all files as {path within the folder: bytes}."""
    made = {'surfaces/%s.obj' % name: data for name, data in surfaces().items()}
    index, rows = {}, ''
    for folder, case in all_cases():
        path = '%s/%s' % (folder, case.name)
        assert path not in made
        made[path] = case.data
        index[path] = {'reason': case.word, 'why': case.why, 'surface': case.surface,
                       'options': case.options}
        rows += '| %s | %s | %s | %s | %s |\n' % (path, case.word, case.why, case.surface,
                                                 ' '.join(case.options))
    made['index.json'] = (json.dumps(index, indent=1) + '\n').encode()
    made['README.md'] = (INTRODUCTION + rows).encode()
    made['.gitattributes'] = b'* -text\n'
    return made


def main(folder):
    for path, data in files().items():
        path = os.path.join(folder, path)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, 'wb') as file:
            file.write(data)


if __name__ == '__main__':
    if len(sys.argv) > 2 or sys.argv[-1].startswith('-'):
        sys.exit(__doc__)
    main(sys.argv[1] if len(sys.argv) > 1 else DEFAULT)
