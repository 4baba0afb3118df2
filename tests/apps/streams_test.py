# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Streams that cannot be written: lost progress is no error, lost data on stdout is one."""
import os
import pty
import subprocess

from command_helpers import *


def shell(script, *args):
    """Runs a shell script in which "$@" is the command."""
    return Outcome(subprocess.run(['/bin/bash', '-c', script, 'bash', BINARY] +
                                  [str(a) for a in args], stdin=subprocess.DEVNULL,
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                  timeout=300))


class Progress(CommandTest):
    def job(self, name, *flags):
        return ('parametrize', generated('cap'), '-o', self.path(name), '--degree', '2') + flags

    def setUp(self):
        super().setUp()
        self.run_ok(*self.job('expected.vtu'))

    def survives(self, script):
        for flags in ((), ('--verbose',)):
            with self.subTest(script=script, flags=flags):
                outcome = shell(script, *self.job('out.vtu', *flags))
                self.assertEqual(outcome.code, OK, outcome.err)
                self.assertEqual(self.read('out.vtu'), self.read('expected.vtu'))
                os.unlink(self.path('out.vtu'))
                self.assertEqual(self.files(), ['expected.vtu'])

    def test_full(self):
        self.survives('"$@" 2>/dev/full')

    def test_closed(self):
        self.survives('"$@" 2>&-')
        self.survives('"$@" <&- >&- 2>&-')

    def test_reader_gone(self):
        for trap in ("trap '' PIPE; ", ''):
            self.survives(trap + '"$@" 2> >(exec true) ; exit $?')
            self.survives(trap + 'set -o pipefail; "$@" 2>&1 | true')

    def test_terminal_lost(self):
        outer, inner = pty.openpty()
        process = subprocess.Popen([BINARY] + list(map(str, self.job('out.vtu'))), stderr=inner,
                                   stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
        os.close(inner)
        os.close(outer)  # closed before the first line
        self.assertEqual(process.wait(60), OK)
        self.assertEqual(self.read('out.vtu'), self.read('expected.vtu'))

    def test_refusals_keep_their_code(self):
        for redirection in ('2>/dev/full', '2>&-'):
            for code, args in ((UNREADABLE, ('info', self.path('none.obj'))),
                               (USAGE, ('parametrize', '--frobnicate')),
                               (UNREADABLE, ('check', self.path('none.vtu')))):
                self.assertEqual(shell('"$@" ' + redirection, *args).code, code, args)


class Data(CommandTest):
    def lost(self, script, *args):
        outcome = shell(script, *args)
        self.assertEqual(outcome.code, USAGE, (script, args, outcome.err))
        self.assertIn('standard output', outcome.err)
        self.assertEqual(len(outcome.err.splitlines()), 1, outcome.err)

    def test_help_and_version(self):
        for script in ('"$@" >/dev/full', '"$@" >&-'):
            for args in (['--help'], ['--version'], ['check', '--help'], ['info', '--version']):
                self.lost(script, *args)

    def test_quiet_runs_succeed_without_stdout(self):
        outcome = shell('"$@" >&-', 'parametrize', generated('cap'), '-o', self.path('a.vtu'),
                        '--degree', '1', '--quiet')
        self.assertEqual((outcome.code, outcome.err), (OK, ''))


class Names(CommandTest):
    """Names and contents of files cannot control a terminal or forge a line."""

    NAMES = ('\x1b]0;title\x07.obj', 'a\nmajorant: b.obj: valid.obj', '\x9b31m.obj', 'bell\x07\r.obj', '\x7f.obj')

    def check_text(self, text, lines=None):
        self.assertEqual([c for c in text if (ord(c) < 32 and c != '\n') or 0x7f <= ord(c) < 0xa0], [], repr(text))
        if lines is not None:
            self.assertEqual(text.count('\n'), lines, repr(text))

    def test_messages(self):
        for name in self.NAMES:
            with self.subTest(name=name):
                for content in ('v 0 0 0\nf 1 2 3\n', 'v 0 \x1b[31m 0\n', None):
                    if content:
                        self.write(name, content)
                    for verb in ('info', 'parametrize', 'unwrap', 'check', 'convert'):
                        done = majorant(verb, self.path(name), *(() if verb in ('info', 'check') else ('out.obj',)))
                        self.assertEqual(done.code, UNREADABLE, done.err)
                        self.check_text(done.err, 1)
                    if content:
                        os.unlink(self.path(name))

    def test_messages_of_successful_runs(self):
        with open(generated('cap')) as f:
            mesh = f.read()
        for name in self.NAMES:
            with self.subTest(name=name):
                self.write(name, 'mtllib \t\xa0\n' + mesh)
                out = self.path('out ' + name)
                self.check_text(majorant('info', self.path(name)).out)
                self.check_text(self.run_ok('parametrize', self.path(name), '-o', out).err)
                done = self.run_ok('check', out)
                self.check_text(done.err)
                self.assertEqual(len(done.printed()), 1, done.err)
                os.unlink(out)
                os.unlink(self.path(name))


if __name__ == '__main__':
    main()
