#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""How much there is to read: a Markdown table of lines, files and types, of one or more commits.

Counted from what git holds, not from the working tree. Library: C++ that is installed or linked into
it; newer modules: folders of it that the first commit does not have, nor under another name; command:
apps/ (results/, in older commits); public headers: those that are installed, but for detail/; types: classes, structs,
enums and unions defined at the beginning of a line or inside a class. --command PATH: the binary of the
last commit, its size and the libraries that it names and that are loaded with it.

Sample runs:
  bench/repository_size.py
  bench/repository_size.py 072bb2e0 HEAD --command build/release/apps/majorant
"""
import argparse
import os
import re
import subprocess
from pathlib import PurePath

ROOT = PurePath(__file__).parent.parent
COMMAND = ('apps', 'results')
NEWER = ('adapters', 'parametrization/adapters', 'parametrization/baking', 'pictures/baking', 'quads', 'volumes')
PARALLEL = ('distributed/', 'apps/mpi/')
NOT_LIBRARY = COMMAND + ('tests', 'bench', 'examples', 'python', 'web', 'docs', 'scripts', 'cmake', 'distributed')
TYPE = re.compile(r'^\s*(?:template\s*<.*>\s*)?(?:class|struct|union|enum(?:\s+class)?)\s+(?:\[\[.*?\]\]\s*)?'
                  r'[\w:]+(?:\s*final)?(?:\s*:[^;{]*)?\s*\{', re.M)
CASE = re.compile(r'^\s*(?:TYPED_)?TEST(?:_F|_P)?\(', re.M)
FUNCTION = re.compile(r'^\s*def test_', re.M)


def git(*words):
    return subprocess.run(['git', '-C', str(ROOT), *words], capture_output=True, check=True).stdout


def read(commit):
    """path -> text of every text file of the commit."""
    names = [n for n in git('ls-tree', '-r', '--name-only', commit).decode().split('\n')
             if PurePath(n).suffix in ('.h', '.cpp', '.py', '.md', '.txt', '.cmake') or n == 'Makefile']
    feed = '\n'.join('%s:%s' % (commit, n) for n in names).encode()
    out = subprocess.run(['git', '-C', str(ROOT), 'cat-file', '--batch'], input=feed, capture_output=True,
                         check=True).stdout
    texts, at = {}, 0
    for name in names:
        end = out.index(b'\n', at)
        size = int(out[at:end].split()[-1])
        texts[name] = out[end + 1:end + 1 + size].decode('utf-8', 'replace')
        at = end + size + 2
    return texts


def measure(commit):
    texts = read(commit)
    code = {n: t for n, t in texts.items() if n.endswith(('.h', '.cpp'))}
    library = {n: t for n, t in code.items() if n.split('/')[0] not in NOT_LIBRARY}
    newer = {n: t for n, t in library.items() if n.startswith(tuple(folder + '/' for folder in NEWER))}
    parallel = {n: t for n, t in code.items() if n.startswith(PARALLEL)}
    command = {n: t for n, t in code.items() if n.split('/')[0] in COMMAND and n not in parallel}
    listed = texts.get('cmake/public_headers.txt') or texts['tests/package/public_headers.txt']
    headers = {n: texts[n] for n in (line.removeprefix('majorant/') for line in listed.splitlines())
               if n in texts and '/detail/' not in n}
    docs = {n: t for n, t in texts.items() if n.endswith('.md') and n != 'CHANGELOG.md'}

    def lines(of):
        return sum(t.count('\n') for t in of.values())

    def types(of):
        return sum(len(TYPE.findall(t)) for t in of.values())

    def under(folder, suffix):
        return {n: t for n, t in texts.items() if n.startswith(folder + '/') and n.endswith(suffix)}
    shown = [('library, lines', lines(library)), ('library, files', len(library)),
             ('library, lines a file', round(lines(library) / len(library))),
             ('library, types', types(library)),
             ('of it newer modules, lines', lines(newer)), ('newer modules, files', len(newer)),
             ('newer modules, types', types(newer)),
             ('command (apps, results), lines', lines(command)),
             ('command, files', len(command)), ('command, types', types(command)),
             ('majorant-mpi, lines', lines(parallel)), ('majorant-mpi, files', len(parallel)),
             ('public headers', len(headers)), ('public headers, lines', lines(headers)),
             ('pages of docs', len(docs)), ('docs, lines', lines(docs)),
             ('README.md, lines', docs['README.md'].count('\n')),
             ('C++ tests, lines', lines(under('tests', ('.h', '.cpp')))),
             ('C++ tests, cases', sum(len(CASE.findall(t)) for t in under('tests', '.cpp').values())),
             ('Python tests, lines', lines(under('tests', '.py'))),
             ('Python tests, functions', sum(len(FUNCTION.findall(t)) for t in under('tests', '.py').values())),
             ('bench, lines', lines(under('bench', ('.h', '.cpp', '.py'))))]
    return dict(shown)


def measure_command(path):
    def run(*words):
        return subprocess.run(words, capture_output=True, check=True, text=True).stdout
    return {'command, MB': '%.1f' % (os.path.getsize(path) / 1e6),
            'libraries it names': str(run('readelf', '-d', path).count('(NEEDED)')),
            'libraries loaded with it': str(run('ldd', path).count('=> /'))}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('commits', nargs='*', default=['HEAD'])
    parser.add_argument('--command')
    asked = parser.parse_args()
    commits = asked.commits
    columns = [measure(c) for c in commits]
    print('| | %s |' % ' | '.join(git('rev-parse', '--short', c).decode().strip() for c in commits))
    print('|---|%s' % ('---|' * len(commits)))
    for name in columns[0]:
        print('| %s | %s |' % (name, ' | '.join('{:,}'.format(c[name]) for c in columns)))
    if asked.command:
        for name, value in measure_command(asked.command).items():
            print('| %s |%s %s |' % (name, ' |' * (len(commits) - 1), value))


if __name__ == '__main__':
    main()
