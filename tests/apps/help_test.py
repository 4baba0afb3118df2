#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Texts of the program about itself: without arguments, in its help, in the lines at the end of a run."""
import json
import os
import re
import subprocess
import unittest

import command_helpers as helpers
from command_helpers import INVALID, CommandTest, generated, grid, majorant, obj_text

VERBS = helpers.verb_names()
GROUPS = ['Input and output', 'Map', 'Constraints', 'Charts', 'Solver', 'Pictures', 'General']


def help_of(*words, columns=None):
    environment = {k: v for k, v in os.environ.items() if k != 'COLUMNS'}
    if columns:
        environment['COLUMNS'] = str(columns)
    return subprocess.run([helpers.BINARY, *words, '--help'], check=True, text=True, env=environment,
                          stdout=subprocess.PIPE).stdout


def options_in(text):
    return re.findall(r'(?m)^  (?:-\w, )?(--[a-z][a-z-]*)', text)


class Help(CommandTest):
    def test_without_words(self):
        done = self.run_ok()
        self.assertEqual(done.err, '')
        self.assertEqual(len(VERBS), 12)
        for verb in VERBS:
            self.assertRegex(done.out, r'(?m)^  %s ' % verb.split()[0])
        self.assertEqual(len(re.findall(r'(?m)^  majorant ', done.out)), 3)
        self.assertIn('majorant VERB --help', done.out)

    def test_lines_fit(self):
        for columns, widest in ((None, 80), (60, 60), (100, 100)):
            for words in [[]] + [verb.split() for verb in VERBS]:
                options = help_of(*words, columns=columns).split('General:')[0]
                for line in options.splitlines():
                    if line[26:28] == '  ':  # the first column is not wrapped
                        self.assertLessEqual(len(line), widest, line)

    def test_groups_in_their_order(self):
        for verb in VERBS:
            text = help_of(*verb.split())
            found = [g for g in re.findall(r'(?m)^([A-Z][a-z ]+):$', text) if g != 'Energies']
            found = [g for g in found if g not in ('Methods', 'Examples')]
            self.assertEqual(found, [g for g in GROUPS if g in found], verb)
            self.assertEqual((found[0], found[-1]), (GROUPS[0], GROUPS[-1]))
        self.assertLess(len(help_of('info').split('\n')), 30)
        self.assertIn('Constraints:\n  --pins FILE ', help_of('parametrize'))

    def test_short_help(self):
        """-h of a verb with many options lists ten of them and names --help, which lists all."""
        short = 0
        for verb in VERBS:
            text, all_options = self.run_ok(*verb.split(), '-h').out, help_of(*verb.split())
            if text == all_options:
                self.assertLessEqual(len(options_in(text)), 18, verb)
                continue
            short += 1
            self.assertEqual(len(options_in(text)), 10, verb)
            self.assertLess(len(text.split('\n')), 50)
            self.assertLess(set(options_in(text)), set(options_in(all_options)))
            self.assertIn('`majorant %s --help` lists all %d options.' % (verb, len(options_in(all_options))), text)
            self.assertIn('Example: majorant ' + verb, text)
        self.assertGreaterEqual(short, 8)

    def test_types_of_the_parser_are_hidden(self):
        for verb in VERBS:
            options = help_of(*verb.split()).split('General:')[0]
            self.assertNotRegex(options, r'INT|FLOAT|TEXT:|Excludes|Needs|REQUIRED|\[\]|2147483647', verb)
        self.assertIn('--boundary free|fixed ', help_of('parametrize'))
        self.assertIn('--view [X,Y,Z] ', help_of('parametrize'))
        self.assertRegex(help_of('parametrize'), r'--bijective  +keep')
        self.assertIn('Usage: majorant check result [OPTIONS]\n', help_of('check'))

    def test_a_reader_that_leaves(self):
        """Closed readers of help texts are no error; tests/apps/streams_test.py tests data."""
        for words in (['--help'], [], ['unwrap', '--help'], ['--version'], ['help'], ['version'], ['--licenses']):
            reader, writer = os.pipe()
            os.close(reader)
            done = subprocess.run([helpers.BINARY, *words], stdout=writer, stderr=subprocess.PIPE, text=True)
            os.close(writer)
            self.assertEqual((done.returncode, done.stderr), (0, ''), words)

    def test_short_flags(self):
        version = self.run_ok('--version').out
        self.assertEqual(self.run_ok('-V').out, version)
        self.assertEqual(self.run_ok('info', '-V').out, version)
        mesh = generated('cap')
        self.assertEqual(self.run_ok('parametrize', mesh, self.path('a.vtu'), '-q').err, '')
        self.assertIn('iteration   2', self.run_ok('parametrize', mesh, self.path('b.vtu'), '-v').err)


class Verdicts(CommandTest):
    """Verdicts of `check`, which are data on stdout."""

    def setUp(self):
        super().setUp()
        points, faces = grid(2)
        flat = [p[:2] for p in points]
        self.good = self.write('good.obj', obj_text(points, faces, flat))
        self.bad = self.write('bad.obj', obj_text(points, faces, [*flat[:4], (9, 9), *flat[5:]]))

    def test_on_stdout(self):
        good = self.run_ok('check', self.good)
        self.assertRegex(good.out, r'\A%s: valid, .*\n\Z' % re.escape(self.good))
        bad = self.found(self.bad)
        self.assertTrue(bad.out.startswith(self.bad + ': invalid: '), bad.out)
        for done in good, bad:
            self.assertNotIn('valid', done.err)

    def test_quiet(self):
        self.assertEqual(self.run_ok('check', self.good, '--quiet').out, '')
        done = self.found(self.bad, '--quiet')
        self.assertEqual((done.out.count('\n'), done.err), (1, ''))

    def test_beside_a_report_on_stdout(self):
        for path, code, word in ((self.good, 0, ': valid, '), (self.bad, INVALID, ': invalid: ')):
            done = self.run_ok('check', path, '--report', '-', code=code)
            self.assertEqual(done.out[0], '{')
            self.assertNotIn(word, done.out)
            self.assertIn(word, done.err)


class LastLines(CommandTest):
    def test_the_last_lines_name_files_and_extent_of_the_layout(self):
        out, picture = self.path('a.vtu'), self.path('a.svg')
        err = self.run_ok('parametrize', generated('cap'), '-o', out, '-o', picture, '--degree', 1).err
        self.assertRegex(err, r'layout \(-?[\d.e+-]+, -?[\d.e+-]+\) to \(-?[\d.e+-]+, -?[\d.e+-]+\)')
        wrote = re.search(r'(?m)^wrote (.*)$', err)[1]
        self.assertEqual(re.findall(r'(\S+) \(([\d.]+) (kB|MB|bytes)\)', wrote),
                         [self.size_of(out), self.size_of(picture)])
        self.assertIn('wrote ' + self.path('b.obj'), self.run_ok('unwrap', generated('cap'), self.path('b.obj')).err)
        self.assertIn('wrote ' + self.path('c.obj'), self.run_ok('convert', out, self.path('c.obj')).err)

    @staticmethod
    def size_of(path):
        size = os.path.getsize(path)
        assert 1000 <= size < 999500
        return path, '%.3g' % (size / 1000), 'kB'


class Mesh(CommandTest):
    """Sizes in the output of `info`."""

    def test_sizes(self):
        points = [(0, 0, 0), (2, 0, 0), (2, 1, 0), (0, 1, 0), (3, 0, 0), (3, 1, 5)]
        text = ''.join('v %g %g %g\n' % p for p in points)
        text += ''.join('vt %g %g\n' % t for t in [(0, 0), (2, 0), (2, 1), (0, 1), (4, 0), (5, 0), (5, 7), (4, 7)])
        text += 'f 1/1 2/2 3/3 4/4\nf 2/5 5/6 6/7\nf 2/5 6/7 3/8\n'
        path = self.write('two.obj', text)
        report = self.report_of(path)
        self.assertEqual(report['result']['polygons'], {'3': 2, '4': 1})
        self.assertEqual(report['result']['bounding_box'], [[0, 0, 0], [3, 1, 5]])
        self.assertEqual((report['result']['edge_length']['min'], report['result']['texture_islands']), (1, 2))
        self.assertEqual(report['result']['texture_range'], [[0, 0], [5, 7]])
        out = self.run_ok('info', path).out
        for line in ('polygons: 3 (2 triangles, 1 quad)\n', 'bounding box: (0, 0, 0) to (3, 1, 5)\n',
                     'texture coordinates: 8, from (0, 0) to (5, 7), 2 islands\n', 'edge lengths: 1 to 5.1'):
            self.assertIn(line, out)

    def report_of(self, path):
        return json.loads(self.run_ok('info', path, '--report', '-').out)


if __name__ == '__main__':
    helpers.main()
