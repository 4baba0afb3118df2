#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that the files of examples/meshes/ are those of its README.md and generate_shapes.cpp, up to the last
digits of sin and cos. (The creature's generator is left out: it takes half a minute to compile.)"""
import json
import math
import os
import re
import subprocess
import tempfile
import unittest
from collections import Counter
from pathlib import Path

MESHES = Path(os.environ['MAJORANT_SOURCE_DIR']) / 'examples/meshes'
README = (MESHES / 'README.md').read_text()


def read(path):
    lines = [line.split() for line in path.read_text().splitlines()]
    return ([[float(x) for x in words[1:]] for words in lines if words[:1] == ['v']],
            [[int(k) - 1 for k in words[1:]] for words in lines if words[:1] == ['f']])


def smallest_angle(positions, faces):
    """Returns the smallest angle in degrees."""
    angles = []
    for face in faces:
        for k in range(3):
            a, b, c = (positions[face[(k + j) % 3]] for j in range(3))
            u, v = [y - x for x, y in zip(a, b)], [y - x for x, y in zip(a, c)]
            cosine = sum(x * y for x, y in zip(u, v)) / math.hypot(*u) / math.hypot(*v)
            angles.append(math.degrees(math.acos(max(-1, min(1, cosine)))))
    return min(angles)


class Meshes(unittest.TestCase):
    def test_the_table(self):
        rows = re.findall(r'^\| `(\w+\.obj)` \| (\d+) \| (\d+) \| (\d+) \| ([\d.]+) \|', README, re.M)
        self.assertEqual(sorted(row[0] for row in rows), sorted(path.name for path in MESHES.glob('*.obj')))
        for name, *numbers in rows:
            positions, faces = read(MESHES / name)
            edges = Counter(frozenset((face[k], face[k - 1])) for face in faces for k in range(3))
            once = {edge for edge, count in edges.items() if count == 1}
            rim = {vertex for edge in once for vertex in edge}
            with self.subTest(name):
                self.assertEqual([len(positions), len(faces), len(once)], [int(x) for x in numbers[:3]])
                self.assertAlmostEqual(smallest_angle(positions, faces), float(numbers[3]), delta=0.051)
                self.assertFalse([edge for edge in edges.keys() - once if edge <= rim])  # as the page states

    def test_the_files_are_generated(self):
        commands = re.findall(r'^    (.*generate_shapes.*)$', README, re.M)
        self.assertEqual(len(commands), 2)
        with tempfile.TemporaryDirectory(prefix='majorant_meshes_') as name:
            made = Path(name) / 'made'
            made.mkdir()
            for command in commands:  # the commands of the page, with other output folders
                command = command.replace('/tmp/', name + '/')
                subprocess.run(command.replace(' .', ' made') if command.endswith(' .') else command, shell=True,
                               check=True, cwd=name if command.endswith(' .') else MESHES, stdout=subprocess.DEVNULL)
            self.assertEqual(len(list(made.iterdir())), 8)
            for path in made.glob('*.obj'):
                with self.subTest(path.name):
                    (positions, faces), (ours, our_faces) = read(path), read(MESHES / path.name)
                    self.assertEqual(faces, our_faces)
                    self.assertLess(max(abs(x - y) for p, q in zip(positions, ours) for x, y in zip(p, q)), 1e-7)
            self.assertEqual(json.loads((made / 'bar.json').read_text()),
                             json.loads((MESHES / 'bar.json').read_text()))


if __name__ == '__main__':
    unittest.main()
