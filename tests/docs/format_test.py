#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that clang-format 14 changes no source file, nor code and formulas in comments.

Other versions format differently: without version 14 the exit code is 77, which ctest reports as skipped.
"""
import os
import pathlib
import shutil
import subprocess
import sys
import unittest

SOURCE = pathlib.Path(os.environ['MAJORANT_SOURCE_DIR'])
VERSION = '14'
sys.path.insert(0, str(SOURCE / 'cmake/scripts'))
import include_graph  # noqa: E402

# A formatter that reflows comments as prose would join these lines.
COMMENT = '''\
// What comes after this line are two statements and a formula.
//
//   auto energy = make_energy(space, rest, [](const auto& J) { return J.squaredNorm(); }, {rule, finer});
//   builder.add(energy, 1.0 / area);                    // a trailing comment that makes it longer
//   builder.build();
// Prose goes on.
//     E(x) = int_T h(Sigma, sigma) dA,    the formula of a line that is longer than a hundred columns
//     h(Sigma, sigma) = Sigma^2 + sigma^2 + Sigma^-2 + sigma^-2
#pragma once
'''


def find_clang_format():
    for name in 'clang-format-' + VERSION, 'clang-format':
        if shutil.which(name):
            printed = subprocess.run([name, '--version'], capture_output=True, text=True).stdout
            if ' version %s.' % VERSION in printed:
                return name
    return None


class Format(unittest.TestCase):
    def test_every_file(self):
        tops = {module.split('/')[0] for module in include_graph.LAYER}
        files = [path for top in (*tops, 'bench', 'examples', 'tests')
                 for suffix in ('h', 'cpp') for path in (SOURCE / top).rglob('*.' + suffix)]
        self.assertGreaterEqual(len(files), 400)
        done = subprocess.run([CLANG_FORMAT, '--dry-run', '--Werror', *files],
                              capture_output=True, text=True, cwd=SOURCE)
        self.assertEqual(done.returncode, 0, done.stderr[:3000])

    def test_examples_in_comments(self):
        done = subprocess.run([CLANG_FORMAT, '--assume-filename', SOURCE / 'framework/planted.h'],
                              input=COMMENT, capture_output=True, text=True, check=True)
        self.assertEqual(done.stdout, COMMENT)


CLANG_FORMAT = find_clang_format()
if __name__ == '__main__':
    if not CLANG_FORMAT:
        print('skipped: no clang-format-%s' % VERSION)
        sys.exit(77)
    unittest.main()
