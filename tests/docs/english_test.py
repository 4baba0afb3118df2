#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that comments, docstrings, pages and names follow the rules that cmake/scripts/english.py checks.

Accepted findings are lines of english_exceptions.txt, `path: kind: text`. A finding without its line fails,
and so does a line without its finding, so that the list only becomes shorter:

    cmake/scripts/english.py --exceptions > tests/docs/english_exceptions.txt
"""
import os
import pathlib
import re
import sys
import unittest

SOURCE = pathlib.Path(os.environ['MAJORANT_SOURCE_DIR'])
sys.path.insert(0, str(SOURCE / 'cmake/scripts'))
import english  # noqa: E402

EXCEPTIONS = SOURCE / 'tests/docs/english_exceptions.txt'
# Comments, pages and names that break one rule each, with the kind of the expected finding.
PLANTED = [
    ('a.h', '// Of every face its area.\ndouble area();\n', ['subject']),
    ('a.h', '// What is left.\nint rest;\n', ['subject']),
    ('a.h', '// The same for edges.\nvoid edges();\n', ['subject']),
    ('a.h', '// As above.\nint again;\n', ['subject']),
    ('a.h', '// Whether it is closed.\nbool closed;\n', ['subject']),
    ('a.h', '// Where both sides meet.\nint place;\n', ['subject']),
    ('a.h', '// Those of the border.\nint border;\n', ['subject']),
    ('a.h', 'int count;  // Of faces.\n', ['subject']),
    ('a.cpp', '// Returns ' + 'one more word ' * 14 + '.\nint f();\n', ['long']),
    ('a.cpp', 'int asked_count = how + 1;\n', ['name', 'name']),
    ('a.py', '"""What this does."""\nsaid = 1\n', ['subject', 'name']),
    ('a.py', '# Those of faces.\nx = "asked"\n', ['subject']),
    ('a.md', 'A sentence ' + 'with many words ' * 14 + '.\n', ['long']),
]
ALLOWED = [
    ('a.h', '// Returns the area of every face.\ndouble area();\n'),
    ('a.h', '// Where both sides meet, the cut ends.\n//\n//   what(); // code\n//     Of = formula\nint cut;\n'),
    ('a.h', '// The same edge is listed once.\nint edges;\nconst char* text = "how asked";\n'),
    ('a.h', '// SPDX-' 'License-Identifier: What\n'),
    ('a.md', '| ' + 'many words in a table ' * 20 + '|\n\n```\n' + 'code ' * 60 + '\n```\n'),
    ('a.md', 'See Eq. 11 of the paper. It has ' + 'few words ' * 4 + '.\n'),
]


class English(unittest.TestCase):
    def test_planted_faults_are_found(self):
        for path, text, kinds in PLANTED:
            with self.subTest(text):
                self.assertEqual([finding.kind for finding in english.findings_of(path, text)], kinds)

    def test_good_text_passes(self):
        for path, text in ALLOWED:
            with self.subTest(text):
                self.assertEqual([str(finding) for finding in english.findings_of(path, text)], [])

    def test_the_repository(self):
        found = set(english.exceptions(SOURCE))
        listed = [line for line in EXCEPTIONS.read_text().splitlines() if line and not line.startswith('#')]
        self.assertEqual(len(listed), len(set(listed)), 'lines that are listed twice')
        self.assertEqual(sorted(found - set(listed)), [], 'new findings: cmake/scripts/english.py --list')
        self.assertEqual(sorted(set(listed) - found), [], 'lines of english_exceptions.txt that can go')

    def test_the_changelog_is_short_until_the_first_release(self):
        lines = (SOURCE / 'CHANGELOG.md').read_text().splitlines()
        self.assertLessEqual(len(lines), 60)

    def test_pages_have_one_title(self):
        for page in sorted((SOURCE / 'docs').glob('*.md')):
            prose = re.sub(r'^```.*?^```', '', page.read_text(), flags=re.S | re.M)
            self.assertEqual(len(re.findall(r'^# ', prose, re.M)), 1, page.name)


if __name__ == '__main__':
    unittest.main()
