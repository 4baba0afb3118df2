#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the experiments one after the other, and writes their results into docs/experiments.md.

--write puts the section that each script left in --out between its marks in the page, its picture into the
folder experiments/ beside the page, and a table of all of them on top. Exit code 0 if every script ended
with 0.

Sample runs:
  bench/experiments/all.py --write docs/experiments.md
  bench/experiments/all.py figure_5 figure_9 --out build/experiments
  bench/experiments/all.py --quick --out /tmp/quick
"""
import argparse
import re
import resource
import shutil
import subprocess
import sys
from pathlib import Path

import experiment
from experiment import common

HERE = Path(__file__).resolve().parent


def scripts():
    """Names, in the order of the page."""
    figures = sorted(HERE.glob('figure_*.py'), key=lambda path: int(path.stem.split('_')[1]))
    return [path.stem for path in figures] + ['depth_table']


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('names', nargs='*', metavar='NAME', help='default: all')
    experiment.add_options(parser)
    parser.add_argument('--write', type=Path, metavar='PAGE.md')
    options = parser.parse_args()
    unknown = sorted(set(options.names) - set(scripts()))
    if unknown:
        parser.error('%s: no such experiment' % unknown[0])
    return options


def processor_seconds():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def run(name, options):
    """Whether it ended well; prints how long it took."""
    before = processor_seconds()
    command = [common.PYTHON, HERE / (name + '.py'), '--out', options.out, '--meshes', options.meshes,
               '--build', options.build, '--jobs', options.jobs, '--timeout', options.timeout]
    done = subprocess.run([str(word) for word in command] + ['--quick'] * options.quick)
    print('%s: %.0f processor seconds' % (name, processor_seconds() - before), flush=True)
    return done.returncode == 0


def summary(sections):
    rows = []
    for name, text in sections.items():
        title = re.match(r'## (.*)', text).group(1)
        seen = re.search(r'^\*\*Seen: (\w+)\.\*\*$', text, re.M).group(1)
        open_ones = re.findall(r'^\| (.*?) \| .* \| (?:\*\*no\*\*|not tried) \|$', text, re.M)
        rows.append(['[%s](#%s)' % (title, anchor(title)), seen, '; '.join(open_ones)])
    return '\n'.join(common.markdown_table(['experiment', 'seen', 'what is not'], rows)) + '\n'


def anchor(title):
    """Of a heading, as GitHub makes them."""
    return re.sub(r'[^\w -]', '', title.lower()).replace(' ', '-')


def write_page(page, out):
    """Every section that is in `out`; the others stay."""
    pictures = page.parent / 'experiments'
    pictures.mkdir(exist_ok=True)
    text = page.read_text()
    for name in scripts():
        section = out / (name + '.md')
        if section.exists():
            text = replaced(text, name + '.py', section.read_text())
            shutil.copyfile(out / (name + '.svg'), pictures / (name + '.svg'))
    sections = {name: between(text, name + '.py') for name in scripts()}
    page.write_text(replaced(text, 'all.py', summary(sections)))


def marks(name):
    return '<!-- %s -->\n' % name, '<!-- end of %s -->' % name


def between(text, name):
    begin, end = marks(name)
    return text.split(begin)[1].split(end)[0]


def replaced(text, name, inside):
    begin, end = marks(name)
    head, rest = text.split(begin)
    return head + begin + inside + end + rest.split(end)[1]


def main():
    options = parse_arguments()
    good = [run(name, options) for name in options.names or scripts()]
    if options.write:
        write_page(options.write, options.out)
    return 0 if all(good) else 1


if __name__ == '__main__':
    sys.exit(main())
