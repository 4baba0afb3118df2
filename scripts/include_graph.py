#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Prints the rooms of the house, floor by floor, with their sizes and the rooms they include from.

Fails (exit 1) on an include that does not go down, on rooms that include each other in a circle, on
a room without a floor, and on an include of what is internal to one of the closed rooms. CMake
already keeps a room from seeing headers it does not name; this keeps the list of names itself in
order.

Sample runs:
  scripts/include_graph.py
  scripts/include_graph.py --arrows parametrization/drive      (the single includes of a room)
"""
import argparse
import re
import sys
from collections import defaultdict
from pathlib import Path

# A room may include from its own folder and from rooms below.
FLOORS = [
    ['framework'],
    ['terms', 'elements', 'mesh'],
    ['energies', 'constraints', 'parametrization/fields'],
    ['parametrization/maps', 'parametrization/cuts'],
    ['certify', 'parametrization/starts', 'parametrization/scaffold'],
    ['parametrization/packing', 'parametrization/drive', 'parametrization/tessellation'],
    ['parametrization/atlas', 'io'],
    ['pictures'],
    ['results'],
    ['apps/arguments', 'apps/plugins'],
    ['apps'],
    ['apps/compare', 'apps/check', 'distributed'],
]
COMMANDS = {'apps', 'distributed'}     # on top of the library
# ROOM/internal/ of these is theirs alone; the others are open until nobody looks into them.
CLOSED = {'certify', 'io', 'pictures', 'parametrization/packing', 'parametrization/atlas',
          'parametrization/tessellation'}
LIST = 'densities'                       # one small file a named energy: counted for itself
FLOOR = {room: floor for floor, rooms in enumerate(FLOORS) for room in rooms}
INCLUDE = re.compile(r'^#include "(?:majorant/)?([^"]+)"', re.MULTILINE)


def room_of(path):
    """The room of a source file: its folder, or the nearest one above that has a floor."""
    folder = Path(path).parent
    while str(folder) not in FLOOR and folder != folder.parent:
        folder = folder.parent
    return str(folder) if str(folder) in FLOOR else str(Path(path).parent)


class House:
    """The sources under `root`: lines and units of each room, arrows between them."""

    def __init__(self, root):
        self.lines, self.units = defaultdict(int), defaultdict(set)
        self.arrows = defaultdict(list)  # (from, to) -> "file -> header"
        tops = sorted({room.split('/')[0] for room in FLOOR})
        for path in sorted(p for top in tops for p in (root / top).rglob('*') if p.suffix in ('.h', '.cpp')):
            self._read(path, path.relative_to(root))

    def _read(self, path, name):
        text, room = path.read_text(), room_of(name)
        lines = text.count('\n')
        self.lines[room] += lines
        unit = name.with_name(name.stem.removeprefix('no_'))
        self.units[room + '/' + LIST if LIST in name.parts else room].add(unit)
        for header in INCLUDE.findall(text):
            other = room_of(header)
            if '/' in header and not header.startswith('embedded/') and other != room:
                self.arrows[room, other].append('%s -> %s' % (name, header))

    def library_lines(self):
        return sum(n for room, n in self.lines.items() if room.split('/')[0] not in COMMANDS)

    def circle(self):
        """Rooms that include each other in a circle, or an empty list."""
        below = defaultdict(set)
        for room, other in self.arrows:
            below[room].add(other)
        done = set()

        def visit(room, path):
            if room in path:
                return path[path.index(room):] + [room]
            if room in done:
                return []
            found = next(filter(None, (visit(o, path + [room]) for o in sorted(below[room]))), [])
            done.add(room)
            return found

        return next(filter(None, (visit(room, []) for room in sorted(below))), [])

    def faults(self):
        found = ['%s: no floor (FLOORS in this script)' % room for room in sorted(self.lines) if room not in FLOOR]
        found += ['no room %s' % room for room in FLOOR if room not in self.lines]
        for (room, other), files in sorted(self.arrows.items()):
            if other not in FLOOR:
                found.append('%s: not a room of this house' % files[0])
            elif FLOOR.get(room, -1) <= FLOOR[other]:
                found += ['an include that does not go down: ' + file for file in files]
        if self.circle():
            found.append('a circle: ' + ' -> '.join(self.circle()))
        found += ['%s is internal: %s' % (file.split(' -> ')[1], file) for room in sorted(CLOSED)
                  for file in self.into_internal(room)]
        return found

    def into_internal(self, room):
        """Includes of what is internal to a room from other rooms."""
        return [file for (_, other), files in sorted(self.arrows.items()) if other == room
                for file in files if ' -> %s/internal/' % room in file]

    def print(self):
        print('floor  room                            lines  share  units  includes from')
        for floor, rooms in reversed(list(enumerate(FLOORS, 1))):
            for room in rooms:
                below = [o for r, o in sorted(self.arrows) if r == room]
                print('%5d  %-30s %6d %5.1f %% %6d  %s' % (
                    floor, room, self.lines[room], 100 * self.lines[room] / self.library_lines(),
                    len(self.units[room]), ' '.join(o.split('/')[-1] if o != 'apps/compare' else o for o in below)))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument('--arrows', metavar='ROOM', help='print the includes of this room from others')
    parser.add_argument('--root', type=Path, default=Path(__file__).resolve().parent.parent)
    options = parser.parse_args()
    house = House(options.root)
    faults = house.faults()
    house.print()
    for (room, _), files in sorted(house.arrows.items()):
        if room == options.arrows:
            print('\n'.join(files))
    print('includes of internal headers of other rooms: %d' %
          sum(len(house.into_internal(room)) for room in FLOOR))
    print('\n'.join(faults) if faults else 'every include goes down')
    sys.exit(bool(faults))


if __name__ == '__main__':
    main()
