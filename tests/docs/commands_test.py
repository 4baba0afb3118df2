#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that every ```sh block of README.md and docs/*.md runs unchanged, line by line, with exit code 0.

The blocks of a page run in order, in a folder that is made for the page and has the contents of the
repository and a finished build; `majorant` is on the PATH. A block that no test can run (it installs, builds,
takes hours, needs other machines) is marked in the line before it,

    <!-- not run: REASON -->

Such a block must still be valid shell, and refer to existing files of the repository.
"""
import concurrent.futures
import os
import re
import shutil
import signal
import subprocess
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ['MAJORANT_SOURCE_DIR'])
BUILD = Path(os.environ['MAJORANT_BUILD_DIR'])
BINARY = Path(os.environ['MAJORANT_BINARY'])
PAGES = [SOURCE / 'README.md', *sorted((SOURCE / 'docs').glob('*.md'))]
MARK = '<!-- not run: '
# First words of command lines; a block with such a line must be fenced as ```sh.
COMMAND = re.compile(r'(majorant|build/release|make|cmake|cpack|ninja|ctest|pip|python3|/usr/bin/python3|sudo|mpirun|'
                     r'cmake/scripts/\S+|bench/\S+|apt|apt-get)(-mpi)? ')
OWN_PATH = re.compile(r'(?<![\w./~-])(?:cmake|bench|tests|examples|docs)/[\w./]+')
SECONDS = 400  # limit for one block on a busy machine


class Block:
    def __init__(self, page, text, match):
        self.mark, self.language, self.code = match.groups()
        line = text[:match.start(2)].count('\n') + 1
        self.where = '%s:%d' % (page, line)


def blocks(page, text):
    return [Block(page, text, match)
            for match in re.finditer(r'^(?:(<!-- [^\n]* -->)\n)?```([^\n]*)\n(.*?)^```$', text, re.S | re.M)]


def reason(block):
    """Returns the reason why a block is not run, or None."""
    if 'build/release/bench/' in block.code and not (BUILD / 'bench/majorant_tune').exists():
        return 'no benchmarks'
    return block.mark[len(MARK):-len(' -->')] if block.mark and block.mark.startswith(MARK) else None


def failure(block, folder):
    """Returns the output of the first command that fails, or None."""
    environment = {**os.environ, 'PATH': '%s:%s' % (BINARY.parent, os.environ['PATH']), 'HOME': str(folder / 'home')}
    process = subprocess.Popen(['sh', '-eux', '-c', block.code], cwd=folder, env=environment, text=True,
                               stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                               start_new_session=True)
    try:
        printed = process.communicate(timeout=SECONDS)[0]
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)  # together with the processes of the shell
        process.communicate()
        return '%s: not done after %d s; mark it, or make it smaller' % (block.where, SECONDS)
    if process.returncode:
        return '%s: exit code %d\n%s' % (block.where, process.returncode, printed[-1500:])
    return None


def failures(page, text):
    with tempfile.TemporaryDirectory(prefix='majorant_commands_') as name:
        folder = Path(name)
        (folder / 'home').mkdir()
        shutil.copytree(SOURCE / 'examples', folder / 'examples')  # a command may write there
        (folder / 'build').mkdir()
        (folder / 'build/release').symlink_to(BUILD)
        for other in ('bench', 'cmake', 'docs', 'tests'):
            (folder / other).symlink_to(SOURCE / other)
        return [failed for block in blocks(page, text) if block.language == 'sh' and reason(block) is None
                for failed in [failure(block, folder)] if failed]


def complaints(page, text):
    """Yields the defects of the page's blocks that are visible without running them."""
    outside = re.sub(r'^```.*?^```$', lambda match: '\n' * match[0].count('\n'), text, flags=re.S | re.M)
    for number, line in enumerate(outside.splitlines(), 1):
        if line.startswith('    ') and COMMAND.match(line[4:]):
            yield '%s:%d: a command; fence it as ```sh' % (page, number)
    for block in blocks(page, text):
        if block.language != 'sh':
            if block.language in ('', 'bash', 'console', 'text') and any(map(COMMAND.match, block.code.splitlines())):
                yield block.where + ': commands; fence them as ```sh'
            if reason(block) is not None:
                yield block.where + ': not shell, so it is not run anyway'
            continue
        if subprocess.run(['sh', '-n', '-c', block.code], stderr=subprocess.DEVNULL).returncode:
            yield block.where + ': no shell'
        if reason(block) is not None and len(reason(block).split()) < 2:
            yield block.where + ': not run, why?'
        for name in OWN_PATH.findall(block.code + (reason(block) or '')):
            if not (SOURCE / name.rstrip('.')).exists():
                yield '%s: there is no %s' % (block.where, name)
    if text.count(MARK) != sum(reason(block) is not None for block in blocks(page, text)):
        yield '%s: a mark that is not in the line before a block' % page


class Pages(unittest.TestCase):
    def test_commands_run(self):
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            wrong = pool.map(lambda page: failures(page.name, page.read_text()), PAGES)
            for page, found in zip(PAGES, wrong):
                with self.subTest(page.name):
                    self.assertEqual(found, [], '\n'.join(found))

    def test_blocks_have_no_visible_defects(self):
        for page in PAGES:
            with self.subTest(page.name):
                self.assertEqual(list(complaints(page.name, page.read_text())), [])

    def test_at_least_40_lines_run(self):
        shell = [block for page in PAGES for block in blocks(page.name, page.read_text()) if block.language == 'sh']
        lines = [line for block in shell if reason(block) is None for line in block.code.splitlines()]
        self.assertGreaterEqual(len(lines), 40)


class ThisTest(unittest.TestCase):
    """Planted faults, which the test must find."""

    def test_commands_that_fail(self):
        for command in ('majorant parametrize helix.obj -o helix.svg', 'majorat --version', 'false; true',
                        'examples/meshes/cap.obj', 'echo "$UNSET_VARIABLE"'):
            found = failures('x.md', 'text\n\n```sh\ntrue\n%s\n```\n' % command)
            self.assertEqual(len(found), 1, command)
            self.assertTrue(found[0].startswith('x.md:3: exit code'), found)
        self.assertEqual(failures('x.md', '```sh\nmajorant --version\n```\n'), [])
        self.assertEqual(failures('x.md', '%swould fail -->\n```sh\nfalse\n```\n' % MARK), [])

    def test_blocks_that_are_wrong(self):
        for text, printed in (('```\nmajorant info x.obj\n```\n', 'fence them'),
                           ('```sh\nif\n```\n', 'no shell'),
                           (MARK + ' -->\n```sh\ntrue\n```\n', 'why?'),
                           (MARK + 'tests/none.py does -->\n```sh\ntrue\n```\n', 'there is no tests/none.py'),
                           (MARK + 'takes hours -->\n```sh\nbench/none.py\n```\n', 'there is no bench/none.py'),
                           (MARK + 'takes hours -->\n\n```sh\ntrue\n```\n', 'not in the line before'),
                           (MARK + 'takes hours -->\n```cpp\n```\n', 'not shell'),
                           ('text\n\n    majorant info x.obj\n', 'x.md:3: a command')):
            found = list(complaints('x.md', text))
            self.assertEqual(len(found), 1, (text, found))
            self.assertIn(printed, found[0])


if __name__ == '__main__':
    unittest.main()
