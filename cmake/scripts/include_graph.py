#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Prints the modules of the library, layer by layer, with their sizes and the modules they include from.

Fails (exit code 1) on four errors: an include that does not go down; modules, or folders of the top level, that
include each other in a circle; a module without a layer; an include of an internal header of another module. CMake
already hides headers of modules that a module does not name, except for modules in its own folder.

Sample runs:
  cmake/scripts/include_graph.py
  cmake/scripts/include_graph.py --arrows parametrization/solve      (the single includes of a module)
"""
import argparse
import re
import sys
from collections import defaultdict
from pathlib import Path

# A module may include from its own folder and from modules below.
LAYERS = [
    ['framework'],
    ['framework/terms', 'elements', 'mesh', 'io/files'],
    ['framework/comparison', 'energies', 'constraints', 'parametrization/fields', 'pictures/images'],
    ['maps', 'parametrization/seams'],
    ['certify', 'parametrization/initialization', 'parametrization/scaffold', 'volumes'],
    ['pictures/baking', 'parametrization/packing', 'parametrization/solve', 'parametrization/tessellation'],
    ['parametrization/atlas', 'quads', 'io'],
    ['pictures'],
    ['apps/jobs'],
    ['apps/arguments', 'apps/plugins'],
    ['apps'],
    ['apps/compare', 'apps/check', 'apps/mpi'],
]
UMBRELLA = 'parametrization/parametrization.h'  # includes modules and belongs to none, like majorant.h
ADAPTERS = 'parametrization/adapters'    # headers for programs with other mesh libraries, above all modules
COMMANDS, JOBS = 'apps', 'apps/jobs'     # on top of the library; Python also uses apps/jobs
LIST = 'densities'                       # one small file per named energy: counted separately
LAYER = {module: layer for layer, modules in enumerate(LAYERS) for module in modules}
INCLUDE = re.compile(r'^#include "(?:majorant/)?([^"]+)"', re.MULTILINE)


def module_of(path):
    """Returns the module of a source file: its folder, or the nearest one above that has a layer."""
    folder = Path(path).parent
    while str(folder) not in LAYER and folder != folder.parent:
        folder = folder.parent
    return str(folder) if str(folder) in LAYER else str(Path(path).parent)


def is_library(module):
    return module == JOBS or module.split('/')[0] != COMMANDS


def circle_of(arrows):
    """Returns the names of a circle of arrows, or an empty list."""
    below = defaultdict(set)
    for name, other in arrows:
        below[name].add(other)
    done = set()

    def visit(name, path):
        if name in path:
            return path[path.index(name):] + [name]
        if name in done:
            return []
        found = next(filter(None, (visit(o, path + [name]) for o in sorted(below[name]))), [])
        done.add(name)
        return found

    return next(filter(None, (visit(name, []) for name in sorted(below))), [])


class Library:
    """The sources under `root`: lines and units of each module, arrows between them."""

    def __init__(self, root):
        self.lines, self.units = defaultdict(int), defaultdict(set)
        self.arrows = defaultdict(list)  # (from, to) -> "file -> header"
        self.top_arrows = defaultdict(list)  # the same for folders of the top level
        tops = sorted({module.split('/')[0] for module in LAYER})
        for path in sorted(p for top in tops for p in (root / top).rglob('*') if p.suffix in ('.h', '.cpp')):
            name = path.relative_to(root)
            self._read_tops(path, name)
            if path != root / UMBRELLA and not name.is_relative_to(ADAPTERS):
                self._read(path, name)

    def _read_tops(self, path, name):
        for header in INCLUDE.findall(path.read_text()):
            top = header.split('/')[0]
            if '/' in header and top != 'embedded' and top != name.parts[0]:
                self.top_arrows[name.parts[0], top].append('%s -> %s' % (name, header))

    def _read(self, path, name):
        text, module = path.read_text(), module_of(name)
        lines = text.count('\n')
        self.lines[module] += lines
        unit = name.with_name(name.stem.removeprefix('no_'))
        self.units[module + '/' + LIST if LIST in name.parts else module].add(unit)
        for header in INCLUDE.findall(text):
            other = module_of(header)
            if '/' in header and not header.startswith('embedded/') and other != module:
                self.arrows[module, other].append('%s -> %s' % (name, header))

    def library_lines(self):
        return sum(n for module, n in self.lines.items() if is_library(module))

    def circle(self):
        """Returns modules that include each other in a circle, or an empty list."""
        return circle_of(self.arrows)

    def circle_of_folders(self):
        """Returns folders of the top level that include each other in a circle, with an include of each; or
        two empty lists."""
        tops = circle_of(self.top_arrows)
        return tops, [self.top_arrows[pair][0] for pair in zip(tops, tops[1:])]

    def faults(self):
        found = ['%s: no layer (LAYERS in this script)' % module for module in sorted(self.lines) if module not in LAYER]
        found += ['no module %s' % module for module in LAYER if module not in self.lines]
        for (module, other), files in sorted(self.arrows.items()):
            if other not in LAYER:
                found.append('%s: not a module of this library' % files[0])
            elif LAYER.get(module, -1) <= LAYER[other]:
                found += ['an include that does not go down: ' + file for file in files]
        if self.circle():
            found.append('a circle: ' + ' -> '.join(self.circle()))
        tops, files = self.circle_of_folders()
        if tops:
            found.append('a circle of folders: %s (%s)' % (' -> '.join(tops), ', '.join(files)))
        found += ['%s is internal: %s' % (file.split(' -> ')[1], file) for module in sorted(LAYER)
                  for file in self.into_internal(module)]
        return found

    def into_internal(self, module):
        """Returns includes of a module's internal headers from other modules."""
        return [file for (_, other), files in sorted(self.arrows.items()) if other == module
                for file in files if ' -> %s/internal/' % module in file]

    def print(self):
        print('layer  module                            lines  share  units  includes from')
        for layer, modules in reversed(list(enumerate(LAYERS, 1))):
            for module in modules:
                below = [o for r, o in sorted(self.arrows) if r == module]
                print('%5d  %-30s %6d %5.1f %% %6d  %s' % (
                    layer, module, self.lines[module], 100 * self.lines[module] / self.library_lines(),
                    len(self.units[module]), ' '.join(o.split('/')[-1] if o != 'apps/compare' else o for o in below)))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument('--arrows', metavar='MODULE', help='print the includes of this module from others')
    parser.add_argument('--root', type=Path, default=Path(__file__).resolve().parents[2])
    options = parser.parse_args()
    library = Library(options.root)
    faults = library.faults()
    library.print()
    for (module, _), files in sorted(library.arrows.items()):
        if module == options.arrows:
            print('\n'.join(files))
    print('\n'.join(faults) if faults else 'every include goes down')
    sys.exit(bool(faults))


if __name__ == '__main__':
    main()
