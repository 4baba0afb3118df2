#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that the list of results is the one that bench/measurements.py makes, and that their commands exist."""
import os
import re
import sys
import unittest
from pathlib import Path

SOURCE = Path(os.environ['MAJORANT_SOURCE_DIR'])
sys.path.insert(0, str(SOURCE / 'bench'))
sys.dont_write_bytecode = True
import measurements  # noqa: E402


class Results(unittest.TestCase):
    def test_the_list_is_generated_from_the_results(self):
        self.assertEqual(measurements.LIST.read_text(), measurements.contents(), 'run bench/measurements.py')

    def test_the_page_shows_every_table(self):
        page = measurements.page()
        for m in measurements.MEASUREMENTS:
            self.assertIn('\n## %s\n' % m.title, page)
            self.assertIn(measurements.read_result(m.name)[1].strip().splitlines()[-1], page)

    def test_every_result_is_shown(self):
        names = sorted(path.stem for path in measurements.RESULTS.glob('*.txt'))
        self.assertEqual(names, sorted(['contents', *(m.name for m in measurements.MEASUREMENTS)]))

    def test_commands_exist(self):
        programs = (SOURCE / 'bench/CMakeLists.txt').read_text()
        for m in measurements.MEASUREMENTS:
            values = measurements.read_result(m.name)[0]
            self.assertRegex(values['date'], r'^\d{4}-\d\d-\d\d$', m.name)
            self.assertRegex(values['commit'], r'^[0-9a-f]{7,}$', m.name)
            program = values['command'].split()[0]
            if program.startswith('build/'):
                self.assertIn('add_executable(%s ' % Path(program).name, programs, m.name)
            else:
                self.assertTrue((SOURCE / program).exists(), program)
                self.assertRegex(program, re.compile('^(bench|tests/campaigns)/'))


if __name__ == '__main__':
    unittest.main()
