#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests `majorant mesh check` against exact rational subdivision (volume_cells.py) on random cells of each
kind and degree, half of them with det J within 1e-12 of 0 at a node. No verdict may be wrong, and bounds must
hold.

A campaign with 2,000 cells each:
    MAJORANT_VOLUME_CELLS=2000 python3 tests/checker/volume_cells_test.py
"""
import json
import os
import random
import subprocess
import sys
import tempfile
import unittest
from fractions import Fraction

from volume_cells import LAGRANGE_TYPE, Cell, nearly_singular, random_nodes

BINARY = os.environ.get('MAJORANT_BINARY', '')
COUNT = int(os.environ.get('MAJORANT_VOLUME_CELLS', '6'))
# 0: the oracle does not decide the sign.
VERDICTS = {1: ('valid',), -1: ('invalid',), 0: ('valid', 'invalid', 'undecided')}


def array(kind, name, values, components=1):
    return '<DataArray type="%s" Name="%s" NumberOfComponents="%d" format="ascii">\n%s\n</DataArray>\n' % (
        kind, name, components, ' '.join(map(repr, values)))


def vtu_text(cell, all_nodes):
    """Returns Lagrange cells that share no points."""
    size = len(cell.nodes)
    points = [x for nodes in all_nodes for node in nodes for x in (list(node) + [0.0])[:3]]
    count = len(all_nodes)
    return ('<VTKFile type="UnstructuredGrid" version="2.2" byte_order="LittleEndian"><UnstructuredGrid>\n'
            '<Piece NumberOfPoints="%d" NumberOfCells="%d">\n<Points>\n%s</Points>\n<Cells>\n%s%s%s</Cells>\n'
            '</Piece></UnstructuredGrid></VTKFile>\n') % (
                count * size, count, array('Float64', 'Points', points, 3),
                array('Int64', 'connectivity', range(count * size)),
                array('Int64', 'offsets', range(size, count * size + 1, size)),
                array('UInt8', 'types', [LAGRANGE_TYPE[cell.kind]] * count))


class Certificates(unittest.TestCase):
    def check(self, kind, degree):
        cell, chance = Cell(kind, degree), random.Random('%s %d' % (kind, degree))
        all_nodes = []
        for k in range(COUNT):
            nodes = random_nodes(cell, chance, chance.choice((0.02, 0.1, 0.3)) / degree)
            if k % 2:
                nodes = nearly_singular(cell, nodes, chance, chance.uniform(-1, 1) * 10.0 ** -chance.choice((12, 14, 16)))
            all_nodes.append(nodes)
        with tempfile.TemporaryDirectory(prefix='majorant_cells_') as folder:
            path, report = os.path.join(folder, 'a.vtu'), os.path.join(folder, 'r.json')
            with open(path, 'w') as f:
                f.write(vtu_text(cell, all_nodes))
            done = subprocess.run([BINARY, 'mesh', 'check', path, '--report', report, '--list', str(COUNT)],
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            self.assertIn(done.returncode, (0, 5), done.stderr)
            with open(report) as f:
                found = {e['element']: e for e in json.load(f)['result']['mesh']['worst']}
        self.assertEqual(len(found), COUNT)
        tally = {1: 0, -1: 0, 0: 0}
        for k, nodes in enumerate(all_nodes):
            sign, lower, upper = cell.minimum(nodes)
            tally[sign] += 1
            self.assertIn(found[k]['verdict'], VERDICTS[sign], (kind, degree, k, nodes))
            low, high = found[k]['min_det']
            self.assertLessEqual(Fraction(low), upper, (kind, degree, k, nodes))
            self.assertGreaterEqual(Fraction(high), lower, (kind, degree, k, nodes))
        return tally

    def test_every_kind_and_degree(self):
        total = 0
        for kind, degrees in (('triangle', (1, 2, 3, 4)), ('tetrahedron', (1, 2, 3, 4)), ('quad', (1, 2, 3)),
                              ('wedge', (1, 2, 3)), ('hexahedron', (1, 2, 3))):
            for degree in degrees:
                with self.subTest(kind=kind, degree=degree):
                    tally = self.check(kind, degree)
                    total += COUNT
                    if COUNT > 100:
                        print(kind, degree, 'valid %d, invalid %d, undecided %d' % (tally[1], tally[-1], tally[0]),
                              file=sys.stderr, flush=True)
        self.assertGreaterEqual(total, 17 * COUNT)


if __name__ == '__main__':
    unittest.main()
