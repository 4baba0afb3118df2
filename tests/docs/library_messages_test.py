#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that no string of the library has a flag or a verb of the command. The library attaches a Remedy to a
refusal (mesh/refusal.h), for which the command has its own words (apps/refusal_message.cpp)."""
import os
import re
import sys
import unittest
from pathlib import Path

SOURCE = Path(os.environ['MAJORANT_SOURCE_DIR'])
sys.path.insert(0, str(SOURCE / 'cmake/scripts'))
import include_graph  # noqa: E402

VERBS = sorted(path.name.removesuffix('_command.cpp') for path in (SOURCE / 'apps').rglob('*_command.cpp'))
COMMAND_LINE = re.compile(r'--[a-z]|\bmajorant (%s)\b' % '|'.join(VERBS))
TOKEN = re.compile(r'//[^\n]*|/\*.*?\*/|\'(?:\\.|[^\'\\\n])+\'|"((?:\\.|[^"\\\n])*)"', re.S)


def strings(code):
    """Returns the string literals, with adjacent ones joined."""
    found, end = [], None
    code = re.sub(r'^[ \t]*#[^\n]*', '', code, flags=re.M)
    for token in TOKEN.finditer(code):
        if token[1] is None:
            continue
        if end is not None and not code[end:token.start()].strip():
            found[-1] += token[1]
        else:
            found.append(token[1])
        end = token.end()
    return found


def faults(code):
    return [text for text in strings(code) if COMMAND_LINE.search(text)]


class Messages(unittest.TestCase):
    def test_faults_are_recognized(self):
        self.assertIn('unwrap', VERBS)
        for code in ('f("leave out --bijective");', 'f("use `majorant "\n   "unwrap`");'):
            self.assertEqual(len(faults(code)), 1, code)
        for code in ('// "--bijective"\nf("x");', 'f("a -- b", "which this majorant was built");', "g('\"', --k);",
                     'f("majorant ", g, "unwrap");'):
            self.assertEqual(faults(code), [], code)

    def test_the_library_has_no_faults(self):
        modules = filter(include_graph.is_library, include_graph.LAYER)
        files = sorted({path for module in modules for path in (SOURCE / module).rglob('*') if path.suffix in ('.h', '.cpp')})
        self.assertGreater(len(files), 300)
        found = ['%s: %s' % (path.relative_to(SOURCE), text) for path in files for text in faults(path.read_text())]
        self.assertEqual(found, [])


if __name__ == '__main__':
    unittest.main()
