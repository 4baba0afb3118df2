#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that the manual page and the completions have every verb and every flag of the program."""
import gzip
import os
import re
import shutil
import subprocess
import tempfile
import unittest

BINARY = os.environ['MAJORANT_BINARY']
FOLDER = os.path.dirname(BINARY)


def ask(*words):
    return subprocess.run([BINARY, *words], check=True, text=True, stdout=subprocess.PIPE).stdout


def flags(text):
    return set(re.findall(r'^  (?:-\w, )?(--[a-z-]+)', text, re.M)) | set(re.findall(r'^  (-\w),', text, re.M))


def listed(text):
    return re.findall(r'^  (\w+) ', text.partition('Verbs:\n')[2].partition('\n\n')[0], re.M)


def verbs():
    """Returns the first words of verbs."""
    return listed(ask('--help'))


def whole_verbs(first):
    return ['%s %s' % (first, second) for second in listed(ask(first, '--help'))] or [first]


def all_verbs():
    return [verb for first in verbs() for verb in whole_verbs(first)]


def flags_of(verb):
    return flags(ask(*verb.split(), '--help'))


def groups():
    """Returns {'mesh': ['check', 'optimize']}."""
    return {first: [verb.split()[1] for verb in whole_verbs(first)] for first in verbs()
            if whole_verbs(first) != [first]}


class ManualPage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with gzip.open(os.path.join(FOLDER, 'majorant.1.gz'), 'rt') as f:
            cls.source = f.read()

    def sections(self):
        parts = re.split(r'^\.SS "majorant (\w+(?: \w+)?)"$', self.source.replace('\\-', '-'), flags=re.M)
        return dict(zip(parts[1::2], (part.split('\n.SH ')[0] for part in parts[2::2])))

    def test_every_verb_and_flag(self):
        sections = self.sections()
        whole = [verb for first in verbs() for verb in whole_verbs(first)]
        self.assertEqual(sorted(sections), sorted(whole))
        for verb in whole:
            with self.subTest(verb):
                text = ask(*verb.split(), '--help')
                self.assertGreaterEqual(len(flags(text)), 6)
                bold = set(re.findall(r'\\fB(-[^\\]+)\\fR', sections[verb]))
                self.assertEqual(bold, flags(text))

    def test_exit_codes(self):
        text = self.source.split('.SH EXIT STATUS')[1]
        self.assertEqual(re.findall(r'^\d$', text, re.M), list('0123456'))

    @unittest.skipUnless(shutil.which('man'), 'no man')
    def test_man_prints_no_warnings(self):
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
        with tempfile.TemporaryDirectory() as empty:  # no file names are offered in an empty folder
            out = subprocess.run(['bash', '-c', script, '-', os.path.abspath(os.path.join(FOLDER, 'majorant.bash'))],
                                 check=True, text=True, stdout=subprocess.PIPE, cwd=empty).stdout
        return out.split()

    def test_verbs_and_flags(self):
        self.assertEqual(self.complete('majorant '), [*verbs(), 'help', 'version'])
        self.assertEqual(self.complete('majorant help '), verbs())
        self.assertEqual(self.complete('majorant par'), ['parametrize'])
        self.assertIn('--licenses', self.complete('majorant --'))
        for verb in [*all_verbs(), *groups()]:
            self.assertEqual(set(self.complete('majorant %s -' % verb)), flags_of(verb), verb)
        self.assertEqual(list(groups()), ['mesh'])
        for group, inner in groups().items():
            for words in ('majorant ' + group, 'majorant help ' + group):
                self.assertEqual(self.complete(words + ' '), inner)
                self.assertEqual(self.complete(words + ' c'), ['check'])
        self.assertEqual(self.complete('majorant mesh check part.msh --ta'), [])
        # `unwrap` is the default verb
        self.assertEqual(self.complete('majorant in.obj --pad'), ['--padding'])

    def test_choices(self):
        self.assertEqual(self.complete('majorant unwrap in.obj --seams s'), ['sharp', 'sharp='])
        self.assertEqual(self.complete('majorant in.obj --seams u'), ['uv'])
        self.assertEqual(self.complete('majorant parametrize --energy sym'), ['symmetric-dirichlet', 'symmetric-arap'])
        self.assertEqual(self.complete('majorant mesh optimize --target s'), ['size='])
        self.assertEqual(self.complete('majorant mesh optimize --energy mi'), ['mips'])
        self.assertEqual(self.complete('majorant compare --methods newton-e'), ['newton-exact', 'newton-eigen'])
        self.assertEqual(self.complete('majorant bake --attribute n'), ['normal'])
        self.assertEqual(self.complete('majorant unwrap --weld '), ['auto', 'no'])
        self.assertEqual(self.complete('majorant unwrap --size '), [])  # the value is N or W,H

    def test_every_list_of_words(self):
        """Values in the help, such as `--edges yes|no`, are completed."""
        count = 0
        for verb in all_verbs():
            for flag, values in re.findall(r'^  (?:-\w, )?(--[a-z-]+) \[?([a-z0-9.|-]+\|[a-z0-9.|-]+)\]?(?: |$)',
                                           ask(*verb.split(), '--help'), re.M):
                self.assertEqual(self.complete('majorant %s %s ' % (verb, flag)), values.split('|'))
                count += 1
        self.assertGreater(count, 50)

    def test_choices_of_check(self):
        self.assertEqual(self.complete('majorant parametrize in.obj --boundary '), ['free', 'fixed'])
        self.assertEqual(self.complete('majorant check --cuts f'), ['free'])

    def test_files_are_left_to_bash(self):
        self.assertEqual(self.complete('majorant parametrize in'), [])


class OtherShells(unittest.TestCase):
    @unittest.skipUnless(shutil.which('fish'), 'no fish')
    def test_fish(self):
        empty = tempfile.mkdtemp()  # no file names are offered in an empty folder
        self.addCleanup(os.rmdir, empty)

        def complete(line):
            out = subprocess.run(['fish', '--no-config', '-c', 'source $argv[1]; complete -C $argv[2]',
                                  os.path.join(FOLDER, 'majorant.fish'), line], check=True, text=True,
                                 stdout=subprocess.PIPE, cwd=empty).stdout
            return [word.split('\t')[0] for word in out.splitlines()]
        self.assertEqual(complete('majorant param'), ['parametrize'])
        self.assertLessEqual({*verbs(), 'help', 'version'}, set(complete('majorant ')))
        self.assertEqual(set(complete('majorant help ')), set(verbs()))
        self.assertEqual(complete('majorant parametrize in.obj --boundary f'), ['fixed', 'free'])
        self.assertEqual(complete('majorant in.obj --seams s'), ['sharp', 'sharp='])
        for verb in [*all_verbs(), *groups()]:
            self.assertEqual({flag for flag in complete('majorant %s --' % verb)},
                             {flag for flag in flags_of(verb) if flag.startswith('--')}, verb)
        for group, inner in groups().items():
            self.assertEqual(complete('majorant %s ' % group), inner)
            self.assertEqual(complete('majorant help %s ' % group), inner)

    @unittest.skipUnless(shutil.which('zsh'), 'no zsh')
    def test_zsh(self):
        path = os.path.join(FOLDER, '_majorant')
        subprocess.run(['zsh', '-f', '-n', path], check=True)
        # These functions print the arguments of _arguments and _describe.
        script = ('_arguments() { print -rl -- "$@" }; _describe() { print -rl -- "${(@P)2}" }; _files() { : }; '
                  'words=(majorant ${=2}); CURRENT=$#words; source $1')
        def notified(line):
            return subprocess.run(['zsh', '-f', '-c', script, '-', path, line], check=True, text=True,
                                  stdout=subprocess.PIPE).stdout.splitlines()
        self.assertEqual([word.split(':')[0] for word in notified('p')], [*verbs(), 'help', 'version'])
        self.assertEqual([word.split(':')[0] for word in notified('help p')], verbs())
        for verb in all_verbs():
            names = [re.match(r'\*(-[\w-]+)\[', word) for word in notified(verb + ' x')]
            self.assertEqual({name[1] for name in names if name}, flags_of(verb), verb)
        self.assertEqual(notified('x.obj x'), notified('unwrap x'))
        for group, inner in groups().items():
            for words in (group + ' x', 'help %s x' % group):
                self.assertEqual([word.split(':')[0] for word in notified(words)], inner)
            names = [re.match(r'\*(-[\w-]+)\[', word) for word in notified(group + ' -')]
            self.assertEqual({name[1] for name in names if name}, flags_of(group))
        self.assertIn(':free fixed:(free fixed)', '\n'.join(notified('parametrize x')))


if __name__ == '__main__':
    unittest.main()
