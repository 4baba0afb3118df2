#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Counts violations of the rules for plain English (CONTRIBUTING.md) in comments, docstrings and pages.

    english.py [FOLDER OR FILE...]            a table of counts by folder
    english.py --list [FOLDER OR FILE...]     every finding as path:line: kind: text
    english.py --exceptions                   every finding as tests/docs/english_exceptions.txt lists it

The kinds of findings:
  subject   the first sentence of a comment opens with a word that stands for a missing subject: "Of what
            is packed.", "The same for faces.", "As above.", "Where both sides meet.", "What it returns."
  long      a sentence of more than 40 words
  name      an identifier made of a verb where a noun of the field belongs: `asked`, `how`, `wanted`, `told`

A comment is a block of `//` or `#` lines, or a docstring. Code and formulas in comments (three spaces or more
after the mark) do not count, nor do tables, headings and code of a page.
"""
import ast
import io
import pathlib
import re
import subprocess
import sys
import tokenize

MAX_WORDS = 40

# Words that open a sentence without a subject, whatever follows.
NEVER = re.compile(r'(What|Whether|Same|That of|Those of|Or|Nor)\b')
# Words after which a main verb may follow.
NEEDS_VERB = re.compile(r'(The same|Those)\b')
# Words that may open a clause before the main clause, which follows after a comma.
NEEDS_COMMA = re.compile(r'(Of|As|Where|Whose)\b')
VERB = re.compile(r"\b(is|are|was|were|be|has|have|had|does|do|did|can|cannot|may|must|will|would|should|holds?|"
                  r"makes?|gives?|takes?|needs?|stays?|goes|go|comes?|counts?|follows?|applies|apply|returns?|"
                  r"gets?|keeps?|ends?|fails?|works?|remains?|serves?|means?|depends?|decides?|throws?)\b")
NAMES = {'asked', 'how', 'wanted', 'told', 'said'}
CPP = {'.h', '.cpp', '.in'}
SUFFIXES = CPP | {'.py', '.md'}


class Finding:
    def __init__(self, path, line, kind, text):
        self.path, self.line, self.kind, self.text = path, line, kind, text

    def __str__(self):
        return '%s:%d: %s: %s' % (self.path, self.line, self.kind, self.text)


def comment_blocks(text, suffix):
    """Yields (line number, lines without their marks) of every comment and docstring of a source file."""
    if suffix == '.py':
        yield from python_blocks(text)
        return
    block, start, column, after_code = [], 0, -1, False
    for number, line in enumerate(text.split('\n'), 1):
        code, mark, comment = split_comment(line)
        here = len(code)
        # A comment after code continues in lines with nothing but a comment in the same column.
        continues = mark and block and not code.strip() and (here == column or not after_code and here == column)
        if not continues and block:
            yield start, block
            block = []
        if mark:
            if not block:
                start, column, after_code = number, here, bool(code.strip())
            block.append(comment)
    if block:
        yield start, block


def split_comment(line):
    """Splits a line of C++ at the `//` outside of strings. Returns (code, mark, comment)."""
    quote, position = '', 0
    while position < len(line):
        character = line[position]
        if quote:
            if character == '\\':
                position += 1
            elif character == quote:
                quote = ''
        elif character == '"' or character == "'" and not line[position - 1:position].isalnum():
            quote = character
        elif line.startswith('//', position):
            return line[:position], '//', re.sub(r'^//+!?<?', '', line[position:])
        position += 1
    return line, '', ''


def python_blocks(text):
    try:
        tokens = list(tokenize.generate_tokens(io.StringIO(text).readline))
        tree = ast.parse(text)
    except (SyntaxError, tokenize.TokenError):
        return
    block, start, column = [], 0, -1
    last = -1
    for token in tokens:
        if token.type != tokenize.COMMENT or token.string.startswith('#!'):
            continue
        row, here = token.start
        alone = not token.line[:here].strip()  # no code before it
        if block and row == last + 1 and here == column and alone:
            block.append(token.string.lstrip('#'))
        else:
            if block:
                yield start, block
            block, start, column = [token.string.lstrip('#')], row, here
        last = row
    if block:
        yield start, block
    for node in ast.walk(tree):
        if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef)) and ast.get_docstring(node, False):
            lines = ast.get_docstring(node, True).split('\n')
            yield node.body[0].lineno, [' ' + line for line in lines]


def sentences_of_comment(lines):
    """Yields (offset of its line, sentence) of a comment's prose."""
    if any('SPDX-' in line for line in lines):
        return
    paragraph, start = [], 0
    for offset, line in enumerate([*lines, '']):
        stripped = line.strip()
        code = re.match(r'\s{3,}', line) or re.match(r'[-=~*/]{3,}$', stripped) or stripped.startswith('>>>') \
            or re.match(r'(clang-format|NOLINT|IWYU|noqa|pylint)', stripped)
        item = re.match(r'([*-]|\d+[.)]|\([a-z0-9]\))\s', stripped)
        if not stripped or code or item:
            yield from split_sentences(paragraph, start)
            paragraph = []
        if stripped and not code:
            if not paragraph:
                start = offset
            paragraph.append(re.sub(r'^([*-]|\d+[.)]|\([a-z0-9]\))\s+', '', stripped))


def split_sentences(paragraph, start):
    """Sentences end at . ! ? or ; unless the word before is an abbreviation."""
    text = ' '.join(paragraph)
    if text:
        for sentence in re.split(r'(?<!\b[a-z]\.[a-z]\.)(?<![( ](?:Sec|Eqs|Fig|App)\.)(?<![( ](?:Eq|cf|vs|al|pp)\.)'
                                 r'(?<=[.!?;])[)"`*]*\s+', text):
            yield start, sentence


def sentences_of_page(text):
    fenced, paragraph, start = False, [], 0
    for offset, line in enumerate([*text.split('\n'), '']):
        stripped = line.strip()
        if stripped.startswith('```'):
            fenced = not fenced
        ends = fenced or not stripped or stripped.startswith(('```', '|', '#', '<', ':::', '![', '[!')) or line.startswith('    ')
        item = re.match(r'([*-]|\d+\.)\s', stripped)
        if line.startswith('    ') and paragraph and not fenced and stripped:
            ends = False  # the list item continues
        if ends or item:
            for _, sentence in split_sentences(paragraph, start):
                yield start + 1, sentence
            paragraph = []
        if not ends:
            if not paragraph:
                start = offset
            paragraph.append(re.sub(r'^([*-]|\d+\.)\s+', '', stripped))


def word_count(sentence):
    sentence = re.sub(r'\]\([^)]*\)', ']', sentence)
    return sum(bool(re.search(r'[A-Za-z]', word)) for word in sentence.split())


def lacks_subject(sentence):
    if NEVER.match(sentence):
        return not sentence.endswith('?')
    if NEEDS_COMMA.match(sentence):
        return not re.search(r', \S+ \S+', sentence)
    return bool(NEEDS_VERB.match(sentence)) and not VERB.search(sentence)


def identifiers(text, suffix):
    """Returns the identifiers of a source file: {name: line of its first occurrence}."""
    names = {}
    if suffix == '.py':
        try:
            for token in tokenize.generate_tokens(io.StringIO(text).readline):
                if token.type == tokenize.NAME:
                    names.setdefault(token.string, token.start[0])
        except (SyntaxError, tokenize.TokenError):
            pass
        return names
    for number, line in enumerate(text.split('\n'), 1):
        if re.match(r'(TYPED_)?TEST(_F|_P)?\(', line):
            continue
        code = re.sub(r'"(\\.|[^"\\])*"', '""', split_comment(line)[0])
        for name in re.findall(r'[A-Za-z_]\w*', code):
            names.setdefault(name, number)
    return names


def words_of(name):
    return re.findall(r'[A-Z]?[a-z]+|[A-Z]+(?![a-z])', name)


def findings_of(path, text):
    suffix = pathlib.Path(path).suffix
    found = []
    if suffix == '.md':
        for line, sentence in sentences_of_page(text):
            if word_count(sentence) > MAX_WORDS:
                found.append(Finding(path, line, 'long', sentence[:100]))
        return found
    for line, lines in comment_blocks(text, suffix):
        for index, (offset, sentence) in enumerate(sentences_of_comment(lines)):
            if index == 0 and lacks_subject(sentence):
                found.append(Finding(path, line + offset, 'subject', sentence[:100]))
            if word_count(sentence) > MAX_WORDS:
                found.append(Finding(path, line + offset, 'long', sentence[:100]))
    for name, line in identifiers(text, suffix).items():
        words = [word.lower() for word in words_of(name)]
        if NAMES & set(words) and not name.startswith('test_') and len(words) < 5:  # names of tests are sentences
            found.append(Finding(path, line, 'name', name))
    return found


def files_of(root, places):
    """Returns the project's own files below `places`, as known to git, or present in a tree without git."""
    done = subprocess.run(['git', '-C', root, 'ls-files', '-z', '--', *places], capture_output=True, text=True)
    if done.returncode == 0:
        names = [name for name in done.stdout.split('\0') if name]
    else:
        names = [str(path.relative_to(root)) for path in pathlib.Path(root).rglob('*')
                 if path.is_file() and path.relative_to(root).parts[0] != 'build']
        names = [name for name in names if not places or any(name.startswith(str(place)) for place in places)]
    return [name for name in names if pathlib.Path(name).suffix in SUFFIXES and (pathlib.Path(root) / name).exists()]


def exceptions(root):
    """Yields the findings of the repository without line numbers, in the order of paths."""
    for name in files_of(root, []):
        for finding in findings_of(name, (pathlib.Path(root) / name).read_text(encoding='utf-8', errors='replace')):
            yield '%s: %s: %s' % (name, finding.kind, finding.text)


def main(arguments):
    root = pathlib.Path(__file__).resolve().parents[2]
    if '--exceptions' in arguments:
        print('# What tests/docs/english_test.py accepts: path: kind: text.')
        print('\n'.join(sorted(set(exceptions(root)))))
        return
    places = [argument for argument in arguments if not argument.startswith('-')]
    total, blocks = {}, 0
    for name in files_of(root, places):
        text = (root / name).read_text(encoding='utf-8', errors='replace')
        if not name.endswith('.md'):
            blocks += sum(1 for _ in comment_blocks(text, pathlib.Path(name).suffix))
        for finding in findings_of(name, text):
            if '--list' in arguments:
                print(finding)
            row = total.setdefault(name.split('/')[0], {})
            row[finding.kind] = row.get(finding.kind, 0) + 1
    if '--list' not in arguments:
        kinds = ('subject', 'long', 'name')
        print('%-20s %8s %8s %8s' % ('folder', *kinds))
        for folder in sorted(total):
            print('%-20s %8d %8d %8d' % (folder, *(total[folder].get(kind, 0) for kind in kinds)))
        print('%-20s %8d %8d %8d' % ('sum', *(sum(row.get(kind, 0) for row in total.values()) for kind in kinds)))
        print('%d comments' % blocks)


if __name__ == '__main__':
    main(sys.argv[1:])
