# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Reads gmsh meshes (.msh, version 4.1, ascii): triangles of one degree, values at lattice points.

A mesh with views `u` and `v` (NodeData) is a map of itself. A mesh without them must lie in the plane z = 0,
and is the image of the triangles between its corners. Points and lines are skipped; other elements are
refused.
"""
from vtu_file import LARGEST, Unreadable

DEGREES = {2: 1, 9: 2, 21: 3, 23: 4, 25: 5, 42: 6, 43: 7, 44: 8}
PASSED_OVER = {15: 1, 1: 2, 8: 3, 26: 4, 27: 5, 28: 6, 62: 7, 63: 8, 64: 9}  # element type: number of nodes


class MshFile:
    """The content of a file. positions, uv: one tuple of doubles per node; cells: lists of nodes in VTK's
    order, which is gmsh's; degree; is_image."""

    def __init__(self, data):
        try:
            self._read(_sections(data.decode('ascii').splitlines()))
        except (ValueError, IndexError, KeyError, StopIteration) as error:
            raise Unreadable('%s: %s' % (type(error).__name__, error))

    def _read(self, sections):
        if sections['MeshFormat'][0][0].split()[:2] != ['4.1', '0']:
            raise Unreadable('not version 4.1, ascii')
        nodes = _nodes(sections['Nodes'][0])
        cells, self.degree = _triangles(sections['Elements'][0])
        views = dict([_view(lines) for lines in sections.get('NodeData', [])])
        number = {tag: p for p, tag in enumerate(nodes)}
        self.cells = [[number[tag] for tag in cell] for cell in cells]
        self.positions = list(nodes.values())
        self.is_image = not {'u', 'v'} <= set(views)
        if self.is_image and any(z != 0 for _, _, z in self.positions):
            raise Unreadable('neither views u and v, nor nodes in the plane')
        self.uv = [p[:2] for p in self.positions] if self.is_image else \
            [(views['u'][tag], views['v'][tag]) for tag in nodes]
        if not all(abs(x) <= LARGEST for row in self.positions + self.uv for x in row):
            raise Unreadable('a coordinate is not finite, or beyond %g' % LARGEST)


def _sections(lines):
    """Returns the lines of every section, by name, in order."""
    sections, name = {}, None
    for line in lines:
        if line.startswith('$End'):
            name = None
        elif line.startswith('$'):
            name = line[1:].strip()
            sections.setdefault(name, []).append([])
        elif name:
            sections[name][-1].append(line)
    return sections


def _nodes(lines):
    """Returns {tag: (x, y, z)} in the order of the file."""
    rest = iter(lines)
    blocks, count = map(int, next(rest).split()[:2])
    nodes = {}
    for _ in range(blocks):
        size = int(next(rest).split()[3])
        tags = [int(next(rest)) for _ in range(size)]
        for tag in tags:
            if tag in nodes:
                raise Unreadable('node %d twice' % tag)
            x, y, z = map(float, next(rest).split()[:3])
            nodes[tag] = x, y, z
    if len(nodes) != count:
        raise Unreadable('%d nodes, not %d' % (len(nodes), count))
    return nodes


def _triangles(lines):
    rest = iter(lines)
    blocks = int(next(rest).split()[0])
    cells, degrees = [], set()
    for _ in range(blocks):
        _, _, kind, size = map(int, next(rest).split())
        if kind not in DEGREES and kind not in PASSED_OVER:
            raise Unreadable('elements of type %d' % kind)
        for _ in range(size):
            tags = list(map(int, next(rest).split()))[1:]
            if kind in PASSED_OVER:
                continue
            degrees.add(DEGREES[kind])
            if len(tags) != (DEGREES[kind] + 1) * (DEGREES[kind] + 2) // 2:
                raise Unreadable('an element with %d nodes' % len(tags))
            cells.append(tags)
    if len(degrees) != 1:
        raise Unreadable('no triangles, or of several degrees')
    return cells, degrees.pop()


def _view(lines):
    """Returns (name, {tag: value}) of a scalar view."""
    rest = iter(lines)
    names, _, numbers = ([next(rest) for _ in range(int(next(rest)))] for _ in range(3))
    if int(numbers[1]) != 1:
        return names[0].strip().strip('"'), {}
    rows = [next(rest).split() for _ in range(int(numbers[2]))]
    return names[0].strip().strip('"'), {int(tag): float(value) for tag, value in rows}
