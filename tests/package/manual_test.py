#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""The manual page and the completion have every verb and every flag that the program has."""
import gzip
import os
import re
import shutil
import subprocess
import unittest

BINARY = os.environ['MAJORANT_BINARY']
FOLDER = os.path.dirname(BINARY)


def ask(*words):
    return subprocess.run([BINARY, *words], check=True, text=True, stdout=subprocess.PIPE).stdout


def flags(text):
    return set(re.findall(r'^  (?:-\w,)?(--[a-z-]+)', text, re.M)) | set(re.findall(r'^  (-\w),', text, re.M))


def verbs():
    listed = ask('--help').partition('Subcommands:\n')[2].partition('\n\n')[0]
    return [line.split()[0] for line in listed.splitlines()]


class ManualPage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with gzip.open(os.path.join(FOLDER, 'majorant.1.gz'), 'rt') as f:
            cls.source = f.read()

    def sections(self):
        parts = re.split(r'^\.SS "majorant (\w+)"$', self.source.replace('\\-', '-'), flags=re.M)
        return dict(zip(parts[1::2], (part.split('\n.SH ')[0] for part in parts[2::2])))

    def test_every_verb_and_flag(self):
        sections = self.sections()
        self.assertEqual(sorted(sections), sorted(verbs()))
        for verb in verbs():
            with self.subTest(verb):
                text = ask(verb, '--help')
                self.assertGreaterEqual(len(flags(text)), 6)
                bold = set(re.findall(r'\\fB(-[^\\]+)\\fR', sections[verb]))
                self.assertEqual(bold, flags(text))

    def test_exit_codes(self):
        text = self.source.split('.SH EXIT STATUS')[1]
        self.assertEqual(re.findall(r'^\d$', text, re.M), list('0123456'))

    @unittest.skipUnless(shutil.which('man'), 'no man')
    def test_man_has_nothing_to_say_of_it(self):
        done = subprocess.run(['man', '--warnings', '-l', os.path.join(FOLDER, 'majorant.1.gz')],
                              text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              env=dict(os.environ, MANWIDTH='100', LC_ALL='C.UTF-8'))
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        self.assertIn('--bijective', done.stdout)


class Completion(unittest.TestCase):
    def complete(self, line):
        words = line.split(' ')
        quoted = ' '.join("'%s'" % word for word in words)
        script = ('source "$1"; COMP_WORDS=(%s); COMP_CWORD=%d; _majorant; printf "%%s\\n" "${COMPREPLY[@]}"'
                  % (quoted, len(words) - 1))
        out = subprocess.run(['bash', '-c', script, '-', os.path.join(FOLDER, 'majorant.bash')], check=True,
                             text=True, stdout=subprocess.PIPE).stdout
        return out.split()

    def test_verbs_and_flags(self):
        self.assertEqual(self.complete('majorant '), verbs())
        self.assertEqual(self.complete('majorant par'), ['parametrize'])
        self.assertIn('--licenses', self.complete('majorant --'))
        for verb in verbs():
            self.assertEqual(set(self.complete('majorant %s -' % verb)), flags(ask(verb, '--help')), verb)

    def test_choices(self):
        self.assertEqual(self.complete('majorant parametrize in.obj --boundary '), ['free', 'fixed'])
        self.assertEqual(self.complete('majorant check --cuts f'), ['free'])

    def test_files_are_left_to_bash(self):
        self.assertEqual(self.complete('majorant parametrize in'), [])


if __name__ == '__main__':
    unittest.main()
