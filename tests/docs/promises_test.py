#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests statements of the documentation about the sources: sizes, tables of names, references."""
import os
import pathlib
import re
import subprocess
import sys
import unittest

SOURCE = pathlib.Path(os.environ['MAJORANT_SOURCE_DIR'])
sys.path.insert(0, str(SOURCE / 'cmake/scripts'))
import include_graph  # noqa: E402


def line_count(path):
    return len(path.read_text().splitlines())


def table_rows(page, heading):
    """Returns the cells of the table below a heading, without its two header lines."""
    text = (SOURCE / page).read_text().split('\n## ' + heading + '\n', 1)[1].split('\n## ')[0]
    rows = [line.replace('\\|', '¦').strip('|').split('|') for line in text.splitlines()
            if line.startswith('|')]
    return [[cell.strip().replace('¦', '|') for cell in row] for row in rows[2:]]


class Sizes(unittest.TestCase):
    def test_custom_energy_is_short(self):
        self.assertLessEqual(line_count(SOURCE / 'examples/custom_energy.cpp'), 40)

    def test_readme_shows_the_custom_energy_in_ten_lines(self):
        shown = re.search(r'<!-- from: examples/custom_energy.cpp -->\n```cpp\n(.*?)```',
                          (SOURCE / 'README.md').read_text(), re.S)
        self.assertIsNotNone(shown)
        lines = [line for line in shown[1].splitlines()
                 if line and not line.startswith(('#include', 'using '))]
        self.assertLessEqual(len(lines), 10)
        self.assertIn('spectral(', shown[1])

    def test_builtin_energies_are_short(self):
        files = sorted((SOURCE / 'energies/densities').glob('*.h'))
        self.assertGreaterEqual(len(files), 8)
        for path in files:
            self.assertLessEqual(line_count(path), 25, path.name)

    def test_elements_are_short(self):
        for name in 'bezier_quad_space', 'bezier_tetrahedron_space':
            count = sum(line_count(path) for path in (SOURCE / 'elements').glob(name + '.*'))
            self.assertLessEqual(count, 150, name)
            self.assertGreater(count, 0, name)


class Names(unittest.TestCase):
    def test_methods_of_compare_are_in_the_table(self):
        help_text = subprocess.run([os.environ['MAJORANT_BINARY'], 'compare', '--help'], check=True,
                                   capture_output=True, text=True).stdout
        names = set(re.findall(r'^  ([a-z][\w-]+) {2,}', help_text.split('Methods:\n')[1], re.M))
        self.assertGreater(len(names), 15)
        rows = table_rows('docs/choosing_a_solver.md', 'What there is')
        of_command = [row[0] for row in rows if 'in programs only' not in row[0]]
        self.assertEqual({name for row in of_command for name in re.findall(r'`([\w-]+)`', row)}, names)
        # The other rows of the table are methods of compare().
        others = {name for row in rows for name in re.findall(r'`([\w-]+)`', row[0])} - names
        self.assertEqual(others, {'levenberg-marquardt', 'ceres-dogleg'})

    def test_every_key_is_in_the_references(self):
        known = re.findall(r'^\| (\[\w+\])', (SOURCE / 'docs/references.md').read_text(), re.M)
        self.assertEqual(len(known), len(set(known)))
        used = {}
        tops = {module.split('/')[0] for module in include_graph.LAYER} | {'bench', 'examples', 'python'}
        files = [path for top in tops for path in (SOURCE / top).rglob('*') if path.suffix in ('.h', '.cpp', '.py')]
        for path in files + list((SOURCE / 'docs').glob('*.md')):
            for key in re.findall(r'\[[A-Z][A-Za-z]+\d\d\](?!\()', path.read_text()):
                used.setdefault(key, path.relative_to(SOURCE))
        for key, path in used.items():
            self.assertIn(key, known, path)
        self.assertGreaterEqual(len(used), 15)

    def test_examples_are_listed(self):
        listed = re.findall(r'\[(\w+)\.cpp\]\(\1\.cpp\)',
                            (SOURCE / 'examples/README.md').read_text())
        self.assertEqual(sorted(listed),
                         sorted(path.stem for path in (SOURCE / 'examples').glob('*.cpp')))


if __name__ == '__main__':
    unittest.main()
