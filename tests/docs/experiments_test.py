#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests bench/experiments: every script works on tiny meshes, and docs/experiments.md has its claim, a
picture and an answer."""
import csv
import importlib.util
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

SOURCE = Path(os.environ['MAJORANT_SOURCE_DIR'])
BUILD = Path(os.environ['MAJORANT_BUILD_DIR'])
MESHES = Path(os.environ.get('MAJORANT_SHARED_DIR', '')) / 'data/public'
FOLDER = SOURCE / 'bench/experiments'
sys.path.insert(0, str(FOLDER))
sys.dont_write_bytecode = True
import all as every  # noqa: E402
import experiment  # noqa: E402


def missing():
    """Returns the missing requirements of the scripts: the public meshes, the programs of bench/, matplotlib."""
    programs = ('majorant_paper_method', 'solver_cost')
    return ([] if (MESHES / 'disks').exists() else ['../shared/data/public/disks']) + [
        'bench/' + name for name in programs if not (BUILD / 'bench' / name).exists()] + [
        'python3-matplotlib'] * (not importlib.util.find_spec('matplotlib'))


class ThePage(unittest.TestCase):
    text = (SOURCE / 'docs/experiments.md').read_text()
    rows = re.findall(r'^\| \[([^]]+)\]\(experiments/(\w+)\.svg\) \| (.*?) \| (\w+) \| (.*) \|$', text, re.M)

    def test_has_a_row_for_each_script(self):
        self.assertEqual([row[1] for row in self.rows], every.scripts())
        for _, name, claim, seen, others in self.rows:
            with self.subTest(name):
                self.assertEqual(claim, every.claim(name))
                self.assertIn(seen, ('yes', 'partly', 'no'))
                self.assertEqual(seen == 'yes', not others)

    def test_pictures_are_there_and_no_others(self):
        shown = re.findall(r'\]\(experiments/(\w+\.svg)\)', self.text)
        self.assertEqual(sorted(shown), sorted(p.name for p in (SOURCE / 'docs/experiments').iterdir()))


class TheAnswer(unittest.TestCase):
    def test_needs_all_criteria_to_be_yes(self):
        def answer(*held):
            return experiment.answer([experiment.Criterion('', '', holds) for holds in held])
        self.assertEqual(answer(True, True), 'yes')
        self.assertEqual(answer(True, False), 'partly')
        self.assertEqual(answer(True, None), 'partly')
        self.assertEqual(answer(False, None), 'no')


@unittest.skipIf(missing(), 'no ' + ', '.join(missing()))
class TheScripts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        place = tempfile.TemporaryDirectory(prefix='majorant_experiments_')
        cls.addClassCleanup(place.cleanup)
        cls.out = Path(place.name)
        cls.done = subprocess.run(['/usr/bin/python3', FOLDER / 'all.py', '--quick', '--out', cls.out,
                                   '--meshes', MESHES, '--build', BUILD], capture_output=True, text=True,
                                  timeout=500)

    def test_all_scripts_succeed(self):
        self.assertEqual(self.done.returncode, 0, self.done.stderr)
        names = sorted(path.name for path in self.out.iterdir())
        self.assertEqual(names, sorted(name + suffix for name in every.scripts()
                                       for suffix in ('.csv', '.md', '.svg')))

    def test_results_become_rows_of_the_page(self):
        page = self.out.parent / (self.out.name + '_page') / 'experiments.md'
        page.parent.mkdir()
        self.addCleanup(shutil.rmtree, page.parent)
        page.write_text(re.sub(r'\| (yes|partly|no) \|.*', '| none | |', ThePage.text))
        every.write_page(page, self.out)
        rows = [line for line in page.read_text().splitlines() if line.startswith('| [') and '](experiments/' in line]
        self.assertEqual(len(rows), len(every.scripts()))
        for name, line in zip(every.scripts(), rows):
            self.assertIn('(experiments/%s.svg)' % name, line)
            self.assertRegex(line, r'\| (yes|partly|no) \|')
        self.assertEqual(len(list((page.parent / 'experiments').iterdir())), len(rows))

    def test_result_files_have_rows_and_pictures(self):
        for name in every.scripts():
            with open(self.out / (name + '.csv'), newline='') as file:
                rows = list(csv.DictReader(file))
            self.assertGreaterEqual(len(rows), 1, name)
            self.assertNotIn('nan', {value for row in rows for value in row.values()}, name)
            picture = ElementTree.parse(self.out / (name + '.svg')).getroot()
            self.assertTrue(picture.tag.endswith('svg'), name)
            self.assertIn('**Seen: ', (self.out / (name + '.md')).read_text())


if __name__ == '__main__':
    unittest.main()
