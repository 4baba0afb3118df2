#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that every ```cpp block of README.md and docs/*.md, and every example in a header, compiles.

**Pages.** A block that contains `int main` is a program of its own. All other blocks below a heading `# ` are
joined, in order, into one program. #include and using lines and definitions stand at top level, the rest
inside main(argc, argv). A definition runs from a line that starts with class, struct, template, inline or
namespace to the next line that starts with }. Each program is compiled with the includes of its page alone.

A block of any language after a line `<!-- from: FILE -->` must consist of lines of that file, in their order;
such excerpts are fenced as ```c++ if they are no complete program.

**Headers.** In the comments of the modules' and the command's headers, lines indented by three spaces after
// are code, as in

    //   Scaffold scaffold(space, x);
    //   if (scaffold.is_empty()) ...

and formulas, formats and tables are indented by five. Each run of such lines is the body of a function of its
own, of type int, that sees every header and namespaces majorant and app. `...` at the end of a line stands
for omitted statements. An example declares what it uses, except the few names of tests/docs/usual_names.h.
All examples are one translation unit, for the compiler's time.
"""
import concurrent.futures
import itertools
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ['MAJORANT_SOURCE_DIR'])
sys.path.insert(0, str(SOURCE / 'cmake/scripts'))
import include_graph  # noqa: E402

BUILD = pathlib.Path(os.environ['MAJORANT_BUILD_DIR'])
MODULES = sorted(path.name for path in (BUILD / 'include').iterdir())
TOP_LINE = re.compile(r'#include|using ')
FENCED = re.compile(r'^```.*?^```', re.S | re.M)
DEFINITION = re.compile(r'(class|struct|template|inline|namespace)\b')


def pages():
    return [SOURCE / 'README.md', *sorted((SOURCE / 'docs').glob('*.md'))]


class Block:
    def __init__(self, page, number, match, text):
        self.language, self.lines = match[2], match[3].splitlines()
        self.first_line = text.count('\n', 0, match.start(3)) + 1
        self.chapter = len(re.findall(r'^# ', re.sub(FENCED, '', text[:match.start()]), re.M))
        self.file = match[1]
        self.where = '%s, block %d (line %d)' % (page.relative_to(SOURCE), number, self.first_line)


def blocks(page):
    text = page.read_text()
    found = re.finditer(r'^(?:<!-- from: (\S+) -->\n)?```(\S*)\n(.*?)^```', text, re.S | re.M)
    return [Block(page, number, match, text) for number, match in enumerate(found, 1)]


def split(block):
    """Returns lines at top level and lines of main, each with its line number on the page."""
    top, body, inside = [], [], False
    for number, line in enumerate(block.lines, block.first_line):
        starts = bool(DEFINITION.match(line))
        (top if inside or starts or TOP_LINE.match(line) else body).append((number, line))
        if inside and line.startswith('}'):
            inside = False
        elif starts:
            inside = not re.search(r'[};]\s*$', line)
    return top, body


def programs(page):
    """Yields pairs: the blocks of a program, and its text, in which compilers refer to the lines of the page."""
    def numbered(lines):
        return ['#line %d "%s"\n%s' % (number, page.relative_to(SOURCE), line)
                for number, line in lines]
    joined = [b for b in blocks(page) if b.language == 'cpp']
    for block in [b for b in joined if any('int main' in line for line in b.lines)]:
        joined.remove(block)
        yield [block], '\n'.join(numbered(list(enumerate(block.lines, block.first_line)))) + '\n'
    for _, chapter in itertools.groupby(joined, key=lambda block: block.chapter):
        made_of, top, body = list(chapter), [], []
        for block in made_of:
            block_top, block_body = split(block)
            top += block_top
            body += block_body
        yield made_of, '\n'.join([*numbered(top), 'int main([[maybe_unused]] int argc, '
                                  '[[maybe_unused]] char** argv) {', *numbered(body), '}', ''])


COMPILER = [os.environ.get('CXX', 'c++'), '-std=c++20', '-Wall', '-Wextra', '-Werror',
            '-Wno-unused', '-Wno-unused-parameter',
            '-DEIGEN_MAX_ALIGN_BYTES=16', '-DEIGEN_MALLOC_ALREADY_ALIGNED=1',
            '-isystem', '/usr/include/eigen3']
# Eigen, which every header includes, is precompiled: this halves the time of a page.
EIGEN = tempfile.TemporaryDirectory()


def precompile_eigen():
    path = pathlib.Path(EIGEN.name) / 'eigen.h'
    path.write_text('#include <Eigen/Core>\n')
    subprocess.run([*COMPILER, '-x', 'c++-header', str(path)], check=True)


def compile_text(text, *flags):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / 'page.cpp'
        path.write_text('#include "eigen.h"\n' + text)
        return subprocess.run(
            [*COMPILER, '-fsyntax-only', '-I', EIGEN.name, *flags,
             *('-I%s' % (BUILD / 'include' / module) for module in MODULES), str(path)],
            capture_output=True, text=True)


def headers():
    """Returns the headers of the modules, including internal ones, and of the command."""
    folders = [SOURCE, SOURCE / 'parametrization', *(SOURCE / module / part for module in include_graph.LAYER for part in ('.', 'internal', 'detail'))]
    return sorted(path.resolve() for folder in folders for path in folder.glob('*.h'))


class Example:
    """The indented lines of a comment of a header; `lines` holds (number, code) pairs."""

    def __init__(self, header, lines):
        self.header, self.lines = header.relative_to(SOURCE), lines
        self.is_code = len(lines[0][1]) - len(lines[0][1].lstrip()) < 2
        self.where = '%s:%d' % (self.header, lines[0][0])

    def function(self, number):
        code = ['#line %d "%s"\n%s' % (line, self.header,
                                       re.sub(r'\.\.\.(?=\s*(//|$))', '{}', text))
                for line, text in self.lines]
        return '\n'.join(['int example_%d() {' % number, *code, '}', ''])


def examples(header):
    lines = []
    for number, line in enumerate([*header.read_text().splitlines(), ''], 1):
        indented = re.match(r'\s*//   (.*)', line)
        if indented:
            lines.append((number, indented[1]))
        elif lines:
            yield Example(header, lines)
            lines = []


def anchors(page):
    """Returns the anchors of the headings, as GitHub makes them."""
    return [re.sub(r'[^\w -]', '', heading.lower()).replace(' ', '-')
            for heading in re.findall(r'^#+ (.*)', page.read_text(), re.M)]


class Code(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        precompile_eigen()

    def test_blocks_compile(self):
        work = [(made_of, text) for page in pages() for made_of, text in programs(page)]
        self.assertGreaterEqual(len(work), 5)
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            done = list(pool.map(compile_text, [text for _, text in work]))
        for (made_of, _), result in zip(work, done):
            if result.returncode == 0:
                continue
            error = re.search(r'(\S+\.md):(\d+):\d*:? (?:fatal )?error', result.stderr)
            line = int(error[2]) if error else made_of[0].first_line
            blamed = [b for b in made_of if b.first_line <= line] or made_of
            with self.subTest(blamed[-1].where):
                self.fail('%s does not compile:\n%s' % (blamed[-1].where, result.stderr[:3000]))

    def test_examples_of_headers_compile(self):
        found = [example for header in headers() for example in examples(header)
                 if example.is_code]
        self.assertGreaterEqual(len(found), 60)
        result = compile_text('\n'.join([
            '#include "tests/docs/usual_names.h"',
            *('#include "%s"' % header.relative_to(SOURCE) for header in headers()),
            'namespace usual_names {', 'using namespace majorant::app;',
            *(example.function(number) for number, example in enumerate(found)), '}', '']),
            '-I%s' % SOURCE, '-Wno-return-type', '-Wno-unknown-pragmas',
            '-fmax-errors=400')
        errors = re.findall(r'^(\S+\.h):(\d+):\d+: (?:fatal )?error: (.*)', result.stderr, re.M)
        for example in found:
            wrong = ['%s:%s: %s' % (name, line, message) for name, line, message in errors
                     if name == str(example.header)
                     and example.lines[0][0] <= int(line) <= example.lines[-1][0]]
            with self.subTest(example.where):
                self.assertFalse(wrong, 'the example of %s does not compile:\n%s'
                                 % (example.where, '\n'.join(wrong)))
        self.assertEqual(result.returncode, 0, result.stderr[:3000])

    def test_usual_names_are_usual(self):
        text = (SOURCE / 'tests/docs/usual_names.h').read_text().split('namespace usual_names')[1]
        names = [name.strip() for line in re.findall(r'^extern [^;]*[> ](\w+(?:, \w+)*);', text, re.M)
                 for name in line.split(',')]
        self.assertGreaterEqual(len(names), 15)
        used = {name: {header for header in headers() for example in examples(header)
                       if example.is_code and re.search(
                           r'\b%s\b' % name, '\n'.join(line for _, line in example.lines))}
                for name in names}
        for name in names:
            self.assertGreaterEqual(len(used[name]), 2, name + ': declare it in the example')

    def test_examples_of_headers_are_not_glued(self):
        """Finds code that a formatter treated as prose: long lines cut, or lines joined."""
        for header in headers():
            for example in examples(header):
                for number, line in example.lines:
                    where = '%s:%d: ' % (example.header, number)
                    self.assertLessEqual(len('//   ' + line), 100, where + 'too long')
                    if example.is_code:
                        code = line.split('//')[0].rstrip()
                        self.assertNotRegex(code, r'^\s*\}\)*;\s+\S', where + 'two statements')

    def test_excerpts_are_in_their_files(self):
        checked = 0
        for page in pages():
            for block in blocks(page):
                if not block.file:
                    self.assertNotEqual(block.language, 'c++', block.where + ' names no file')
                    continue
                rest = iter([line.strip() for line in
                             (SOURCE / block.file).read_text().splitlines()])
                for line in filter(None, map(str.strip, block.lines)):
                    self.assertIn(line, rest, '%s: not in %s, or out of order'
                                  % (block.where, block.file))
                checked += 1
        self.assertGreaterEqual(checked, 3)

    def test_links_lead_somewhere(self):
        for page in [*pages(), SOURCE / 'CONTRIBUTING.md', SOURCE / 'CHANGELOG.md',
                     SOURCE / 'examples/README.md']:
            prose = re.sub(r'^```.*?^```', '', page.read_text(), flags=re.S | re.M)
            for target, heading in re.findall(r'\]\(([^)#:]*)(?:#([^)]*))?\)', prose):
                path = page.parent / target if target else page
                where = '%s: no %s' % (page.relative_to(SOURCE), target)
                self.assertTrue(path.exists(), where)
                if heading:
                    self.assertIn(heading, anchors(path), where)


if __name__ == '__main__':
    unittest.main()
