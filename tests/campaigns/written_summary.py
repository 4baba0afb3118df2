#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Prints the table of the results of written_files.py, and checks rules.

The rules: no judge objects to a file; a run that ends with exit code 0 or 4 has all its outputs; OBJ files of
all public disks at degree 3 have at most 1.2 times the faces of the input in the median and at most 4 times
for all but three; a missing file counts as infinitely many. Refusals (exit codes 1, 2, 3, 5) break no other
rule, and are listed by message.

Sample runs:
  tests/campaigns/written_summary.py /tmp/written.jsonl
"""
import json
import math
import re
import statistics
import sys
from collections import Counter
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[2] / 'bench'))
import common  # noqa: E402

PROMISED = (0, 4)
CUT_DEGREE = 3                                    # the degree whose OBJ faces are limited,
DISKS = 39                                        # if all of the public disks are there
MEDIAN_RATIO, LARGEST_RATIO, ABOVE_ALLOWED = 1.2, 4, 3
FILES = {'out.vtu': 'VTU', 'out.obj': 'OBJ', 'out.ply': 'PLY', 'out.msh': 'MSH',
         'lagrange.vtu': 'Lagrange', 'surface.msh': 'MSH of the surface'}
HEADER = ('meshes', 'degree', 'mode', 'runs', 'exit 0', 'exit 4', 'refused',
          *(name + ' clean' for name in FILES.values()), 'OBJ faces / input: median', 'largest')


def load(path):
    """Returns the entries of a results file; none without a file."""
    path = Path(path)
    if not path.exists():
        return []
    return [json.loads(line) for line in path.read_text(encoding='utf-8').splitlines()]


def name_of(entry):
    words = [entry['mesh'], 'degree %d' % entry['degree'], entry['mode'], entry['setting']]
    return ' '.join(filter(None, words))


# ------------------------------------------------------------------ table
def group_of(entry):
    """Returns (family with its size, degree, mode), which groups disks of one size."""
    size = int(entry['mesh'].rsplit('_', 1)[1])
    family = '%s %d' % (entry['family'], size) if entry['family'] == 'disks' else entry['family']
    return (('disks', 'closed', 'tubes').index(entry['family']),
            size if entry['family'] == 'disks' else 0, entry['degree'], entry['mode'], family)


def clean_cell(entries, name):
    """Returns 'clean/written' files of a format."""
    written = [entry for entry in entries if name in entry['written']]
    return '%d/%d' % (sum(not entry['problems'][name] for entry in written), len(written))


def ratio(entry):
    """Returns OBJ faces over input faces; infinite without an OBJ."""
    return entry['faces_out'] / entry['faces_in'] if entry['faces_out'] else math.inf


def row(group, entries):
    exits = Counter(entry['exit'] for entry in entries)
    ratios = [ratio(entry) for entry in entries if entry['faces_out']]
    return [group[-1], group[2], group[3], len(entries), exits[0], exits[4],
            sum(entry['exit'] not in PROMISED for entry in entries),
            *(clean_cell(entries, name) for name in FILES),
            common.cell(statistics.median(ratios) if ratios else None, '%.2f'),
            common.cell(max(ratios) if ratios else None, '%.2f')]


def table(entries):
    groups = {}
    for entry in entries:
        groups.setdefault(group_of(entry), []).append(entry)
    return common.markdown_table(HEADER, [row(group, groups[group]) for group in sorted(groups)])


# ------------------------------------------------------------------ rules
def cut_maps(entries):
    """Returns {mode: entries of disks at CUT_DEGREE}."""
    modes = {}
    for entry in entries:
        if entry['family'] == 'disks' and entry['degree'] == CUT_DEGREE:
            modes.setdefault(entry['mode'], []).append(entry)
    return modes


def above(entries):
    return sorted((entry for entry in entries if ratio(entry) > LARGEST_RATIO), key=ratio, reverse=True)


def face_rules(entries):
    """Returns the broken rules about faces of OBJ files."""
    broken = []
    for mode, group in cut_maps(entries).items():
        if len(group) < DISKS:
            continue
        median = statistics.median(map(ratio, group))
        if median > MEDIAN_RATIO:
            broken.append('%s: OBJ files have %.2f times the faces in the median' % (mode, median))
        if len(above(group)) > ABOVE_ALLOWED:
            broken.append('%s: %d OBJ files have more than %g times the faces' % (
                mode, len(above(group)), LARGEST_RATIO))
    return broken


def violations(entries):
    found = ['%s: %s' % (name_of(entry), '; '.join(sum(entry['problems'].values(), [])))
             for entry in entries if any(entry['problems'].values())]
    return found + face_rules(entries)


# ------------------------------------------------------------------ summary
def listing(title, lines):
    return ['', '%s: %d' % (title, len(lines))] + ['* ' + line for line in lines]


def factor(entry):
    return '%.1f' % ratio(entry) if entry['faces_out'] else '(no OBJ)'


def face_lines(entries):
    lines = []
    for mode, group in sorted(cut_maps(entries).items()):
        largest = ', '.join('%s %s' % (entry['mesh'], factor(entry)) for entry in above(group))
        lines.append('%s, %d disks: median %.3f; above %g: %s' % (
            mode, len(group), statistics.median(map(ratio, group)), LARGEST_RATIO, largest or 'none'))
    return lines


def refusals(entries):
    """Returns a line for each message: its count, exit code, files written nevertheless, and runs."""
    groups = {}
    for entry in entries:
        if entry['exit'] not in PROMISED:
            message = re.sub(r'^majorant: \S+\.obj: ', '', entry['message'])
            key = (entry['exit'], ' '.join(entry['written']) or 'nothing', message)
            groups.setdefault(key, []).append(name_of(entry))
    return ['%d with exit %s, written: %s; "%s": %s' % (len(names), *key, ', '.join(names))
            for key, names in groups.items()]


def show(entries):
    """Prints everything. Returns the exit code."""
    broken = violations(entries)
    files = sum(len(entry['written']) for entry in entries)
    lines = table(entries)
    lines += listing('OBJ faces over input faces at degree %d' % CUT_DEGREE, face_lines(entries))
    lines += listing('Refusals, by message', refusals(entries)) + listing('Violations', broken)
    lines += ['', '%d runs, %d files, %.0f s of majorant' % (
        len(entries), files, sum(entry['seconds'] for entry in entries))]
    print('\n'.join(lines))
    return 0 if entries and not broken else 1


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    return show(load(sys.argv[1]))


if __name__ == '__main__':
    sys.exit(main())
