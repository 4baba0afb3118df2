#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that cited items exist: sections and labels of docs/method.md, and files that the documentation
names."""
import os
import pathlib
import re
import unittest

SOURCE = pathlib.Path(os.environ['MAJORANT_SOURCE_DIR'])
PAGES = [*sorted((SOURCE / 'docs').glob('*.md')),
         *(SOURCE / name for name in ('README.md', 'CONTRIBUTING.md', 'examples/README.md'))]


def sources():
    for pattern in '*/*', '*/*/*', '*/*/*/*':
        for path in SOURCE.glob(pattern):
            if path.suffix in ('.h', '.cpp', '.py') and path.relative_to(SOURCE).parts[0] != 'build':
                yield path


class Method(unittest.TestCase):
    def test_citations(self):
        """Citations such as `method.md N4` and `method.md section 8` name a label or a heading of that page."""
        text = (SOURCE / 'docs/method.md').read_text()
        known = set(re.findall(r'^\| ([EN]\d+) \|', text, re.M))
        known |= {'section ' + number for number in re.findall(r'^## (\d+)\.', text, re.M)}
        cited = [(path, label) for path in [*sources(), *PAGES] if path != pathlib.Path(__file__)
                 for label in re.findall(r'method\.md,?\s(?://\s|#\s)?((?:section \d+|[EN]\d+)\b)',
                                         path.read_text())]
        self.assertGreaterEqual(len(cited), 30)
        for path, label in cited:
            self.assertIn(label, known, path.relative_to(SOURCE))

    def test_labels_in_the_text_are_in_its_tables(self):
        text = (SOURCE / 'docs/method.md').read_text()
        body, tables = text.split('\n## 12.')
        known = set(re.findall(r'^\| ([EN]\d+) \|', tables, re.M))
        self.assertGreaterEqual(len(known), 20)
        for label in re.findall(r'\b([EN]\d+)\b', body):
            self.assertIn(label, known)


class Files(unittest.TestCase):
    def test_named_files_exist(self):
        names = {path.name for path in sources()}
        checked = 0
        for page in PAGES:
            prose = re.sub(r'^```.*?^```', '', page.read_text(), flags=re.S | re.M)
            for name in re.findall(r'`((?:\w+/)*\w+\.(?:h|cpp|py))`', prose):
                if re.search(r'[A-Z]{3}', name):  # apps/VERB_command.cpp
                    continue
                name = name.removeprefix('majorant/')  # the path in an include
                found = (SOURCE / name).exists() or ('/' not in name and name in names)
                self.assertTrue(found or name in FOREIGN, '%s names %s' % (page.name, name))
                checked += 1
        self.assertGreaterEqual(checked, 150)


class MainPath(unittest.TestCase):
    """The table of docs/architecture.md from main() to the factorization."""
    def setUp(self):
        text = (SOURCE / 'docs/architecture.md').read_text()
        section = text.split('\n## The main path')[1].split('\n## ')[0]
        rows = re.findall(r'^\| `([^`]+)` \| (`.*?`) \| ', section, re.M)
        self.rows = [((SOURCE / file), re.findall(r'`(\w+)`', functions)) for file, functions in rows]
        self.assertGreaterEqual(len(self.rows), 20)

    def test_functions_are_in_their_files(self):
        for path, functions in self.rows:
            for function in functions:
                self.assertRegex(path.read_text(), r'\b%s(\(|\b.*\{$)' % function, path.name)

    def test_each_file_is_called_by_one_above_it(self):
        for k, (path, functions) in enumerate(self.rows[1:], 1):
            above = [other.name for other, _ in self.rows[:k]
                     if re.search(r'\b%s\b' % functions[0], self.code_of(other))]
            self.assertTrue(above, '%s: %s' % (path.name, functions[0]))

    def test_it_leads_from_main_to_the_kernels_of_the_factorization(self):
        self.assertEqual(self.rows[0][0].name, 'main.cpp')
        self.assertEqual(self.rows[-1][0].name, 'front_kernels.cpp')

    @staticmethod
    def code_of(path):
        """Returns the code without comments, together with the header of the same name, which has members and
        defaults."""
        header = path.with_suffix('.h')
        text = path.read_text() + (header.read_text() if header != path and header.exists() else '')
        return re.sub(r'//.*', '', text)


# Files of the shared data, and files that a reader is instructed to write.
FOREIGN = {'tools/verify.py', 'verify.py', 'layout.py', 'energies/densities/dirichlet_area.h',
           'textured.py'}

if __name__ == '__main__':
    unittest.main()
