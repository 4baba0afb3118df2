#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""scripts/include_graph.py: the tree as it is passes, and every fault that it names is found."""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ['MAJORANT_SOURCE_DIR'])
sys.path.insert(0, str(SOURCE / 'scripts'))
import include_graph  # noqa: E402


def run(root):
    return subprocess.run([sys.executable, SOURCE / 'scripts/include_graph.py', '--root', root],
                          capture_output=True, text=True)


class TheTree(unittest.TestCase):
    def test_every_include_goes_down(self):
        done = run(SOURCE)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn('every include goes down', done.stdout)


class PlantedFaults(unittest.TestCase):
    """Each in a copy of the sources; the script must fail and name it."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = Path(self.folder.name)
        for top in {room.split('/')[0] for room in include_graph.FLOOR}:
            shutil.copytree(SOURCE / top, self.root / top)

    def tearDown(self):
        self.folder.cleanup()

    def append(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        with open(path, 'a') as file:
            file.write(text)

    def assert_found(self, *words):
        done = run(self.root)
        self.assertEqual(done.returncode, 1, done.stdout)
        for word in words:
            self.assertIn(word, done.stdout)

    def test_an_include_upwards(self):
        self.append('mesh/seams.cpp', '#include "majorant/parametrization/drive/parametrize.h"\n')
        self.assert_found('does not go down: mesh/seams.cpp -> parametrization/drive/parametrize.h', 'a circle: ')

    def test_an_include_of_the_same_floor(self):
        self.append('elements/quadrature.cpp', '#include "majorant/mesh/seams.h"\n')
        self.assert_found('does not go down: elements/quadrature.cpp -> mesh/seams.h')

    def test_the_command_in_the_library(self):
        self.append('io/read_obj.cpp', '#include "apps/outputs.h"\n')
        self.assert_found('does not go down: io/read_obj.cpp -> apps/outputs.h')

    def test_a_room_without_a_floor(self):
        self.append('parametrization/attic/box.h', '#pragma once\n')
        self.assert_found('parametrization/attic: no floor')

    def test_a_room_that_is_gone(self):
        shutil.rmtree(self.root / 'mesh')
        self.assert_found('no room mesh')

    def test_a_room_too_large(self):
        for k in range(9):
            self.append('mesh/more_%d.h' % k, '\n' * 399)
        self.assert_found('mesh: ', '% of the library')

    def test_too_many_units(self):
        for k in range(20):
            self.append('parametrization/maps/more_%d.h' % k, '\n')
        self.assert_found('parametrization/maps: ', ' units, more than')


if __name__ == '__main__':
    unittest.main()
