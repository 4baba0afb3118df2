#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the list and the page of all measurements from the results in bench/results.

A result is the output of a command, with the command, the commit of the program, the machine and the date:
bench/results/NAME.txt has a head of `key: value` lines, an empty line, and the output. --run measures again and
replaces these files; otherwise nothing is measured. contents.txt describes each table, and README.md of that
folder is made from it. The site has all tables on one page (cmake/scripts/make_site.py).

Sample runs:
  bench/measurements.py                          # writes bench/results/README.md
  bench/measurements.py --run disks random_cones # measures these two, then writes the list
  bench/measurements.py --list
"""
import argparse
import datetime
import re
import subprocess
import sys
from collections import namedtuple
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
RESULTS = ROOT / 'bench/results'
LIST = RESULTS / 'README.md'
KEYS = ('command', 'commit', 'machine', 'date')
INTRODUCTION = '''\
# Measurements

All tables of figures of this documentation: files of `bench/results`, which `bench/measurements.py --run NAME`
measures again; `make site` shows them as one page. Each table names its command, the commit of the program,
the machine and the date. Unless stated otherwise, E is the symmetric Dirichlet energy, a mean over the surface (4 for
an isometry). Most commands need the public meshes (`--shared`).

The unit of time **fe** is one factorization and solve of the same matrix by CHOLMOD (the cheapest of AMD and METIS,
supernodal and simplicial, with settings that never change, `bench/unit_fe.h`), measured in the same process.
Seconds are those of the processor and say little beyond their run; iterations and factorizations are the same on
every run and are held by `tests/apps/counts_test.py`.
'''
Measurement = namedtuple('Measurement', 'name title about')


def listed(text):
    """Returns the entries of `== name: title` lines, each with the description of its table."""
    for part in text.split('\n== ')[1:]:
        head, _, about = part.partition('\n')
        name, _, title = head.partition(': ')
        yield Measurement(name, title, about.strip())


MEASUREMENTS = list(listed((ROOT / 'bench/results/contents.txt').read_text()))


def read_result(name):
    """Returns the head of a result, and its output."""
    head, _, output = (RESULTS / (name + '.txt')).read_text().partition('\n\n')
    values = dict(line.split(': ', 1) for line in head.splitlines())
    if tuple(values) != KEYS or not output.strip():
        sys.exit('%s/%s.txt: a head of %s, an empty line and an output are needed' % (
            RESULTS, name, ', '.join(KEYS)))
    return values, output


def machine():
    names = re.findall(r'^model name\s*: (.*)$', Path('/proc/cpuinfo').read_text(), re.M)
    return '%s, %d cores' % (names[0] if names else 'unknown processor', len(names))


def run(name):
    """Measures again with the command of the present result."""
    command = read_result(name)[0]['command']
    done = subprocess.run(command, shell=True, cwd=ROOT, stdout=subprocess.PIPE, text=True)
    if not done.stdout.strip():
        sys.exit('%s: exit code %d, and no output' % (command, done.returncode))
    commit = subprocess.run(['git', 'rev-parse', '--short', 'HEAD'], cwd=ROOT, check=True, text=True,
                            stdout=subprocess.PIPE).stdout.strip()
    head = zip(KEYS, (command, commit, machine(), datetime.date.today().isoformat()))
    text = '\n'.join('%s: %s' % entry for entry in head) + '\n\n' + done.stdout.strip() + '\n'
    (RESULTS / (name + '.txt')).write_text(text)


def section(measurement):
    values, output = read_result(measurement.name)
    if '|---' not in output:
        output = '```text\n%s\n```' % output.strip()
    output = re.sub(r'^#+ (.*)$', r'**\1**', output.strip(), flags=re.M)
    output = re.sub(r'(?<=\S)\n(?=\|.*\n\|---)', '\n\n', output)   # an empty line before each table
    return '## %s\n\n%s\n\n`%s`, commit %s, %s, %s\n\n%s\n' % (
        measurement.title, measurement.about, values['command'], values['commit'], values['machine'],
        values['date'], output)


def anchor(name):
    """Returns the anchor of a result's section in page(), by GitHub's rules."""
    title = next(m.title for m in MEASUREMENTS if m.name == name)
    return re.sub(r'[^\w -]', '', title.lower()).replace(' ', '-')


def page():
    return '\n'.join([INTRODUCTION, *(section(m) for m in MEASUREMENTS)])


def contents():
    rows = ('| [%s](%s.txt) | %s |' % (m.title, m.name, read_result(m.name)[0]['date']) for m in MEASUREMENTS)
    return '\n'.join([INTRODUCTION, '| table | measured |', '|---|---|', *rows, ''])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--run', nargs='+', default=[], choices=[m.name for m in MEASUREMENTS], metavar='NAME')
    parser.add_argument('--list', action='store_true', help='names, commands and dates')
    options = parser.parse_args()
    if options.list:
        for m in MEASUREMENTS:
            print('%-20s %s  %s' % (m.name, read_result(m.name)[0]['date'], read_result(m.name)[0]['command']))
        return 0
    for name in options.run:
        run(name)
    LIST.write_text(contents())
    return 0


if __name__ == '__main__':
    sys.exit(main())
