#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests cmake/scripts/include_graph.py: it accepts the repository, and finds every kind of fault."""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ['MAJORANT_SOURCE_DIR'])
sys.path.insert(0, str(SOURCE / 'cmake/scripts'))
import include_graph  # noqa: E402


def run(root):
    return subprocess.run([sys.executable, SOURCE / 'cmake/scripts/include_graph.py', '--root', root],
                          capture_output=True, text=True)


# certify/ proves det J > 0 on the written digits: of moved layouts in moved_layout.cpp, of files in
# map_proof.cpp. Bounds in reports are measured on the map of the solve; Triangles::Flipped restores single
# faces.
PROOF = re.compile(r'\bexact_determinant_of_triangle\(|\blower_bounds\(|ProofDepth::kFinal')
MAY_BOUND = {'maps/measure.cpp', 'parametrization/scaffold/improve_mesh.cpp',
             'apps/compare/benchmark_problem.cpp'}


def proofs_outside(root):
    """Returns sources outside of certify/ and its dependencies that prove det J > 0 of a result."""
    found = []
    for module in sorted(include_graph.LAYER, key=str):
        for path in (p for pattern in ('*.cpp', 'internal/*.cpp') for p in sorted((root / module).glob(pattern))):
            name = str(path.relative_to(root))
            code = re.sub(r'//[^\n]*', '', path.read_text())
            if module not in ('certify', 'constraints', 'elements') and name not in MAY_BOUND and PROOF.search(code):
                found.append(name)
    return found


class TheTree(unittest.TestCase):
    def test_there_is_one_proof(self):
        self.assertEqual(proofs_outside(SOURCE), [])
        self.assertGreater(len(PROOF.findall((SOURCE / 'certify/moved_layout.cpp').read_text())), 2)

    def test_every_include_goes_down(self):
        done = run(SOURCE)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn('every include goes down', done.stdout)


class PlantedFaults(unittest.TestCase):
    """Faults in a copy of the sources; the script must fail and name each."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = Path(self.folder.name)
        for top in {module.split('/')[0] for module in include_graph.LAYER}:
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
        self.append('mesh/seams.cpp', '#include "majorant/parametrization/solve/parametrize.h"\n')
        self.assert_found('does not go down: mesh/seams.cpp -> parametrization/solve/parametrize.h', 'a circle: ')

    def test_a_circle_of_folders_where_every_include_goes_down(self):
        self.append('certify/certify.h', '#include "majorant/pictures/images/raster.h"\n')
        self.assert_found('a circle of folders: ', 'certify/certify.h -> pictures/images/raster.h')
        done = run(self.root)
        self.assertNotIn('does not go down', done.stdout)
        self.assertNotIn('a circle: ', done.stdout)

    def test_an_adapter_is_of_its_folder(self):
        self.append('parametrization/adapters/eigen.h', '#include "majorant/pictures/pictures.h"\n')
        self.assert_found('a circle of folders: ', 'parametrization/adapters/eigen.h -> pictures/pictures.h')

    def test_an_include_of_the_same_layer(self):
        self.append('elements/quadrature.cpp', '#include "majorant/mesh/seams.h"\n')
        self.assert_found('does not go down: elements/quadrature.cpp -> mesh/seams.h')

    def test_the_command_in_the_library(self):
        self.append('io/read_obj.cpp', '#include "apps/outputs.h"\n')
        self.assert_found('does not go down: io/read_obj.cpp -> apps/outputs.h')

    def test_a_module_without_a_layer(self):
        self.append('parametrization/attic/box.h', '#pragma once\n')
        self.assert_found('parametrization/attic: no layer')

    def test_a_module_that_is_gone(self):
        shutil.rmtree(self.root / 'mesh')
        self.assert_found('no module mesh')

    def test_an_internal_header_of_another_module(self):
        self.append('apps/jobs/report.cpp', '#include "majorant/io/internal/line_cursor.h"\n')
        self.append('mesh/seams.cpp', '#include "majorant/framework/internal/multifrontal.h"\n')
        self.assert_found('io/internal/line_cursor.h is internal: apps/jobs/report.cpp -> ',
                          'framework/internal/multifrontal.h is internal: mesh/seams.cpp -> ')

    def test_a_second_proof(self):
        self.assertEqual(proofs_outside(self.root), [])
        for line in 'if (exact_determinant_of_triangle(points).positive', 'bool ok = checker.lower_bounds(x)', 'ProofDepth::kFinal':
            self.append('parametrization/atlas/unwrap.cpp', '// %s\n' % line)
            self.assertEqual(proofs_outside(self.root), [])  # a comment is no proof
            self.append('parametrization/atlas/unwrap.cpp', '  %s;\n' % line)
            self.assertIn('parametrization/atlas/unwrap.cpp', proofs_outside(self.root))
            shutil.copy(SOURCE / 'parametrization/atlas/unwrap.cpp', self.root / 'parametrization/atlas/unwrap.cpp')


if __name__ == '__main__':
    unittest.main()
