#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the experiments one after the other, and writes their results into docs/experiments.md.

--write adds a row to the page's table for each script with a section in --out, and copies its picture into
the folder experiments/ beside the page. Exit code 0 if every script ended with 0.

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
    """Returns the names of the scripts in the order of the page."""
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
    """Runs the script and prints its time. Returns whether it ended with 0."""
    before = processor_seconds()
    command = [common.PYTHON, HERE / (name + '.py'), '--out', options.out, '--meshes', options.meshes,
               '--build', options.build, '--jobs', options.jobs, '--timeout', options.timeout]
    done = subprocess.run([str(word) for word in command] + ['--quick'] * options.quick)
    print('%s: %.0f processor seconds' % (name, processor_seconds() - before), flush=True)
    return done.returncode == 0


def claim(name):
    """Returns the paper's claim from the docstring of the script."""
    return ' '.join(re.search(r'^Claim.*?: (.*?)(?=\n\n)', (HERE / (name + '.py')).read_text(), re.M | re.S)[1].split())


def row(name, section):
    """Returns the page's row of an experiment from its section."""
    title = re.match(r'## (.*)', section)[1]
    seen = re.search(r'^\*\*Seen: (\w+)\.\*\*$', section, re.M)[1]
    others = re.findall(r'^\| (.*?) \| (.*) \| (?:\*\*no\*\*|not tried) \|$', section, re.M)
    return '| [%s](experiments/%s.svg) | %s | %s | %s |' % (
        title.split(': ')[0], name, claim(name), seen, '; '.join('%s: %s' % other for other in others))


def write_page(page, out):
    """Writes the rows of all sections in `out` into the page; other rows stay."""
    text = page.read_text()
    (page.parent / 'experiments').mkdir(exist_ok=True)
    for name in scripts():
        if (out / (name + '.md')).exists():
            line = row(name, (out / (name + '.md')).read_text())
            text = re.sub(r'^\| \[.*\]\(experiments/%s\.svg\) .*$' % name, lambda _: line, text, flags=re.M)
            shutil.copyfile(out / (name + '.svg'), page.parent / 'experiments' / (name + '.svg'))
    page.write_text(text)


def main():
    options = parse_arguments()
    good = [run(name, options) for name in options.names or scripts()]
    if options.write:
        write_page(options.write, options.out)
    return 0 if all(good) else 1


if __name__ == '__main__':
    sys.exit(main())
