#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""What docs/add_a_term.md promises of its examples: at most 30 lines each, at most 15 for a term."""
import os
import re
import unittest
from pathlib import Path

SOURCE = Path(os.environ['MAJORANT_SOURCE_DIR'])
PAGE = (SOURCE / 'docs/add_a_term.md').read_text()
LONGEST_PROGRAM, LONGEST_TERM = 30, 15


def code_lines(text):
    return [line for line in text.splitlines() if line.strip() and not line.strip().startswith('//')]


def terms(lines):
    """Each statement that makes a term, from its first line to the one that ends it."""
    for first, line in enumerate(lines):
        if re.search(r'\bmake_(term|least_squares)<', line):
            end = next(k for k in range(first, len(lines)) if lines[k].rstrip().endswith(');'))
            yield lines[first:end + 1]


class Examples(unittest.TestCase):
    def test_lines(self):
        table = PAGE[PAGE.index('## Whole programs'):PAGE.index('## Cost')]
        names = re.findall(r'\((\.\./examples/\w+\.cpp)\)', table)
        self.assertEqual(len(names), 5)
        for name in names:
            lines = code_lines((SOURCE / 'docs' / name).read_text())
            self.assertLessEqual(len(lines), LONGEST_PROGRAM, name)
            made = list(terms(lines))
            self.assertTrue(made, name)
            for term in made:
                self.assertLessEqual(len(term), LONGEST_TERM, '\n'.join(term))


if __name__ == '__main__':
    unittest.main()
