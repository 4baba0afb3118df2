#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""The problems of TinyAD's examples (bench/tinyad), compared with TinyAD: lines, minima, seconds.

TinyAD's figures are those of --peer-figures, measured by programs outside this repository. With --peer they are
measured again, alternating with ours. The peer command is called with the name of a problem and the folder with its
arrays (`tinyad --write`). It prints a line of CSV: the problem, its final energy, steps, CPU seconds until that
energy was reached, and CPU seconds in total. --native and --native-peer are the same programs, compiled with
-march=native.

Our seconds run until the energy is at most TinyAD's final energy. A row may solve another problem, exact where the
example has a penalty, and then need not reach that energy. The seconds of any row that does not are those until its own
minimum, in parentheses.

Lines: those of the problem alone, without reading, printing and viewing. They are the larger of two numbers: statements
(semicolons, and heads of loops and branches), and characters / 98, with indentation counted as one space.

Sample runs:
  bench/tinyad.py --data ../TinyAD-Examples/data
  bench/tinyad.py --data ../TinyAD-Examples/data --peer ../peer --native-peer ../peer_native --csv figures.csv
  bench/tinyad.py --count ../TinyAD-Examples/apps/basic.cc:21-23
"""
import argparse
import csv
import math
import re
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))
from common import ROOT, markdown_table  # noqa: E402

SOURCES = ROOT / 'bench/tinyad'
FIGURES = SOURCES / '4b48d1a.csv'
MARK = re.compile(r'^\s*// (lines: (?P<tag>.*)|(?P<end>end)|(?P<off>not counted)|(?P<on>counted))$')
EXACT = ('hard pins', 'equality')                  # rows that solve another problem
WIDTH = 98


# ------------------------------------------------------------------ lines
def without_heads(text):
    """Returns the text without the parentheses of `for`, in which semicolons end no statement."""
    out, at = '', 0
    for head in re.finditer(r'\bfor\s*\(', text):
        if head.start() < at:
            continue
        depth, end = 1, head.end()
        while depth:
            depth += {'(': 1, ')': -1}.get(text[end], 0)
            end += 1
        out += text[at:head.start()] + 'for '
        at = end
    return out + text[at:]


def count(text):
    text = re.sub(r'//[^\n]*|/\*.*?\*/', '', text, flags=re.S)
    lines = [re.sub(r'\s+', ' ', line).strip() for line in text.splitlines()]
    characters = sum(len(line) + 1 for line in lines if line)
    heads = re.findall(r'\b(?:for|while|if|else)\b', text)
    statements = without_heads(text).count(';') + len(heads)
    return max(statements, math.ceil(characters / WIDTH))


def own_lines():
    """Returns {(first word of the problem, row or ''): lines}; '' stands for all its rows."""
    texts = {}
    for path in sorted(SOURCES.glob('*.cpp')):
        tags, counted = [], True
        for line in path.read_text().splitlines():
            mark = MARK.match(line)
            if mark and mark['tag']:
                problem, *rows = mark['tag'].split(', ')
                tags = [(problem, row) for row in rows or ['']]
            elif mark:
                counted = not mark['off']
                tags = [] if mark['end'] else tags
            elif counted:
                for tag in tags:
                    texts[tag] = texts.get(tag, '') + line + '\n'
    return {tag: count(text) for tag, text in texts.items()}


def count_of(place):
    """Counts the lines of FILE or FILE:FIRST-LAST[,FIRST-LAST...]."""
    path, _, parts = place.partition(':')
    lines = Path(path).read_text().splitlines()
    ranges = [part.split('-') for part in parts.split(',')] if parts else [(1, len(lines))]
    return count('\n'.join(line for first, last in ranges for line in lines[int(first) - 1:int(last)]))


# ------------------------------------------------------------------ runs
def output(command):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    if done.returncode:
        sys.exit('%s: exit code %d\n%s' % (' '.join(map(str, command)), done.returncode, done.stderr))
    return done.stdout


def rows_of(program, options, *more):
    data = ['--data', options.data] if options.data else []
    return list(csv.DictReader(output([program, *data, *more]).splitlines()))


def peer_of(command, problem, arrays):
    _, energy, steps, to_end, seconds = output([*command.split(), problem, arrays]).strip().split(',')
    return {'energy': float(energy), 'steps': int(steps), 'seconds': float(to_end), 'whole': float(seconds)}


def alternating(options, name, peer, rows, arrays, target):
    """Returns median seconds of the peer and of each row, by compiler flags."""
    seconds = {}
    for program, command, key in ((options.program, options.peer, 'seconds'),
                                  (options.native, options.native_peer, 'native')):
        if not program:
            continue
        theirs, ours = [], {row: [] for row in rows}
        for _ in range(options.runs):
            if command:
                theirs.append(peer_of(command, name, arrays)['seconds'])
            for row in rows:
                if row in EXACT and key == 'native':
                    continue
                more = ['--only', name, '--row', row, '--target', repr(target)]
                ours[row].append(rows_of(program, options, *more)[0])
        if theirs:
            peer[key] = statistics.median(theirs)
        for row, runs in ours.items():
            if not runs:
                continue
            reached = runs[0]['seconds_to_target'] != '-'
            taken = statistics.median(float(r['seconds_to_target' if reached else 'seconds']) for r in runs)
            seconds[row, key] = (taken, reached, runs[0]['steps_to_target' if reached else 'steps'])
    return seconds


def read_figures(path):
    with open(path, newline='') as file:
        return {row['problem']: {key: float(value) if value else math.nan for key, value in row.items()
                                 if key != 'problem'} for row in csv.DictReader(file)}


def write_figures(path, figures):
    with open(path, 'w', newline='') as file:
        out = csv.DictWriter(file, ['problem', *next(iter(figures.values()))], lineterminator='\n')
        out.writeheader()
        for name, figure in figures.items():
            out.writerow({'problem': name, **{key: '' if math.isnan(value) else '%.12g' % value
                                              for key, value in figure.items()}})


# ------------------------------------------------------------------ tables
def shown(seconds, peer):
    taken, reached, _ = seconds
    ratio = '%.1f' % (peer / taken) if reached and not math.isnan(peer) else '-'
    text = ('%.3g' if reached else '(%.3g)') % taken
    return text, ratio


def line_table(figures):
    own, rows, sums = own_lines(), [], [0, 0]
    families = {}
    for name, figure in figures.items():
        families.setdefault(name.split()[0], figure['lines'])
    for family, theirs in families.items():
        shared = own.get((family, ''), 0)
        ours = {row: shared + lines for (problem, row), lines in own.items() if problem == family and row}
        best = min(lines for row, lines in ours.items() if row not in EXACT)
        sums = [sums[0] + theirs, sums[1] + best]
        rows.append([family, '%d' % theirs, ', '.join('%s %d' % pair for pair in ours.items()),
                     '%.2f' % (best / theirs)])
    rows.append(['sum, the shorter row of the same problem', '%d' % sums[0], '%d' % sums[1],
                 '%.2f' % (sums[1] / sums[0])])
    return markdown_table(['example', 'TinyAD', 'here', 'ratio'], rows)


HEADER = ('problem', 'row', 'E, TinyAD at its end', 'E*, TinyAD', 'E* here', 'steps, TinyAD', 'steps here', 's, TinyAD',
          's here', 'times as fast', 's, TinyAD, native', 's here, native', 'times as fast, native')
AIM = 5                                            # requested speed relative to TinyAD's


def shortfalls(table):
    """Returns a line for each set of flags: the problems whose fastest row is below the requested speed, the slowest
    first."""
    lines = []
    for column, flags in ((9, 'without -march'), (12, '-march=native')):
        fastest = {}
        for row in table:
            fastest.setdefault(row[0], 0)
            if row[column] != '-':
                fastest[row[0]] = max(fastest[row[0]], float(row[column]))
        short = sorted((ratio, name) for name, ratio in fastest.items() if 0 < ratio < AIM)
        lines.append('* %s, less than %d times as fast by the faster row: %s' % (
            flags, AIM, ', '.join('%s %.1f' % (name, ratio) for ratio, name in short) or 'none'))
    missed = ['%s, %s' % (row[0], row[1]) for row in table if row[8].startswith('(') and row[1] not in EXACT]
    return lines + ['* rows that do not get to the energy where TinyAD ends: %s' % ('; '.join(missed) or 'none'), '']


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--program', type=Path, default=ROOT / 'build/release/bench/tinyad')
    parser.add_argument('--native', type=Path, help='the same, compiled with -march=native')
    parser.add_argument('--data', type=Path, help="the folder `data` of TinyAD's examples")
    parser.add_argument('--only', help='problems, separated by commas')
    parser.add_argument('--peer', help='a command, see above')
    parser.add_argument('--native-peer', help='the same, compiled with -march=native')
    parser.add_argument('--peer-figures', type=Path, default=FIGURES, metavar='CSV')
    parser.add_argument('--csv', type=Path, help="where TinyAD's figures are written, measured anew with --peer")
    parser.add_argument('--runs', type=int, default=3)
    parser.add_argument('--count', metavar='FILE[:FIRST-LAST,...]', help='counts the lines of another file')
    options = parser.parse_args()
    if options.count:
        print(count_of(options.count))
        return 0
    figures = read_figures(options.peer_figures)
    ends = rows_of(options.program, options, '--rounding', *(['--only', options.only] if options.only else []))
    names = list(dict.fromkeys(end['problem'] for end in ends))
    table = []
    with tempfile.TemporaryDirectory(prefix='majorant_tinyad_') as arrays:
        output([options.program, *(['--data', options.data] if options.data else []), '--write', arrays])
        for name in names:
            peer = figures[name]
            if options.peer:
                peer.update({key: value for key, value in peer_of(options.peer, name, arrays).items()
                             if key in peer and key != 'seconds'})
            rows = [end['row'] for end in ends if end['problem'] == name]
            target = peer['energy'] + 1e-12 * abs(peer['energy'])
            seconds = alternating(options, name, peer, rows, arrays, target)
            for row in rows:
                end = next(e for e in ends if (e['problem'], e['row']) == (name, row))
                base, ratio = shown(seconds[row, 'seconds'], peer['seconds'])
                native, native_ratio = '-', '-'
                if (row, 'native') in seconds:
                    native, native_ratio = shown(seconds[row, 'native'], peer['native'])
                table.append([name, row, '%.10g' % peer['energy'], '%.10g' % peer['minimum'],
                              '%.10g' % float(end['energy']), '%d' % peer['steps'], seconds[row, 'seconds'][2],
                              '%.3g' % peer['seconds'], base, ratio, '%.3g' % peer['native'], native, native_ratio])
    if options.csv:
        write_figures(options.csv, figures)
    print('\n'.join(shortfalls(table)))
    print('\n'.join(line_table(figures)))
    print()
    print('\n'.join(markdown_table(HEADER, table)))
    return 0


if __name__ == '__main__':
    sys.exit(main())
