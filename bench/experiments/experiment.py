# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Shared code of the experiments: options, runs, and the results as CSV, SVG and a section of a page.

An experiment is a script with a docstring whose paragraphs begin with `Claim`, `Here` and `Time`, and

  measure(options) -> rows      dictionaries with the same keys, in a fixed order
  draw(rows) -> figure          of matplotlib, made by panels()
  table(rows) -> (header, lines)
  judge(rows) -> criteria       the claim as statements about the rows

Its last line is `sys.exit(experiment.main(sys.modules[__name__]))`, which writes NAME.csv, NAME.svg and
NAME.md into --out. Rows do not depend on the machine, except for columns in fe: CPU time relative to a
factorization in the same process.

Sample run:
  /usr/bin/python3 -c 'import experiment; print(experiment.PAPER)'     (imported, not run)
"""
import argparse
import csv
import random
import re
import statistics
import sys
import tempfile
import textwrap
from collections import namedtuple
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.dont_write_bytecode = True
BENCH = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(BENCH))
import common  # noqa: E402

ROOT = common.ROOT
POINTS = {1: 1, 2: 36, 3: 78, 4: 105}              # quadrature points by degree: [MC20] Sec. 8.3
# Tutte's map, the majorizer and the stopping rule of [MC20] Sec. 4, 8 and Fig. 20.
PAPER = ['--init', 'tutte', '--curvature', 'paper-majorizer', '--tolerance', '1e-5']
PINNED = 5                                         # number of held points, Fig. 9
COLOURS = {1: '#4477aa', 2: '#ee7733', 3: '#228833', 4: '#aa3377'}
NAMES = {1: 'linear', 2: 'quadratic', 3: 'cubic', 4: 'quartic'}
GREY = '#777777'
WIDTH = 108                                        # characters in a line of the page

# holds: True, False, or None if it was not tested. why: the reason if it does not hold.
Criterion = namedtuple('Criterion', 'statement measured holds why', defaults=('',))


class Failed(Exception):
    """A run without a result."""


# ------------------------------------------------------------------ options
def add_options(parser):
    """Adds the options of every experiment and of all.py."""
    parser.add_argument('--out', type=Path, default=ROOT / 'build/experiments', metavar='FOLDER')
    parser.add_argument('--meshes', type=Path, default=common.DEFAULT_SHARED / 'data/public',
                        metavar='FOLDER', help='with disks/, deform2d/ and seamless/')
    parser.add_argument('--build', type=Path, default=ROOT / 'build/release', metavar='FOLDER')
    parser.add_argument('--quick', action='store_true', help='tiny meshes: does the script still work?')
    parser.add_argument('--jobs', type=int, default=2, help='runs at a time, one thread each')
    parser.add_argument('--timeout', type=float, default=600, help='seconds a single run may take')


def parse_arguments(module):
    parser = argparse.ArgumentParser(description=module.__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    add_options(parser)
    return parser.parse_args()


def disks(options, faces, names=None):
    """Returns the paths of the public disks with these names (default: all) and about so many faces."""
    folder = options.meshes / 'disks'
    found = [folder / ('%s_%d.obj' % (name, faces)) for name in names or all_disks(options)]
    if options.quick:
        found = found[:1]
    missing = [path for path in found if not path.exists()]
    if missing or not found:
        sys.exit('%s: no such mesh (see --meshes)' % (missing or [folder])[0])
    return found


def all_disks(options):
    return sorted({path.stem.split('_')[0] for path in (options.meshes / 'disks').glob('*_500.obj')})


def resolutions(options, *faces):
    """Returns these numbers of faces; with --quick only the coarsest."""
    return faces[:1] if options.quick else faces


def random_vertices(path):
    """Returns PINNED vertices that are not on the boundary, the same ones in every run."""
    _, faces = common.read_obj(path)
    inner = sorted(set(faces.ravel().tolist()) - set(common.boundary_loop(faces)))
    return sorted(random.Random(path.stem).sample(inner, PINNED))


# ------------------------------------------------------------------ runs
def together(options, function, jobs):
    """Returns [function(job) for job in jobs], computed in parallel."""
    with ThreadPoolExecutor(options.jobs) as pool:
        return list(pool.map(function, jobs))


def majorant(options, verb, mesh, *flags, output=None):
    """Runs the command and returns its report. output: a file for the map."""
    with tempfile.TemporaryDirectory(prefix='majorant_experiment_') as folder:
        report = Path(folder) / 'report.json'
        outputs = ['--report', report] if verb == 'check' else ['-o', report]
        outputs += ['-o', output] if output else []
        command = [options.build / 'apps/majorant', verb, mesh, *outputs, '--threads', 1, '--quiet', *flags]
        done = common.run(command, options.timeout)
        found, problem = common.load_report(report)
    if problem or not found.get('result'):
        raise Failed('%s: exit %s, %s' % (' '.join(map(str, command)), done.code,
                                          done.stderr.strip() or problem))
    return found


def json_of(options, program, *arguments):
    """Runs a program of bench/ and returns its output."""
    done = common.run([options.build / 'bench' / program, *arguments], options.timeout)
    if done.code != 0:
        raise Failed('%s %s: exit %s, %s' % (program, ' '.join(map(str, arguments)), done.code,
                                             done.stderr.strip()))
    return common.json.loads(done.stdout)


def paper_method(options, mesh, *flags):
    """Runs the method of the paper, without additions, on a mesh (paper_method.cpp)."""
    return json_of(options, 'majorant_paper_method', mesh, *flags)


def pins_file(folder, vertices):
    path = Path(folder) / 'pins.json'
    handles = [{'vertex': vertex, 'target': 'initial'} for vertex in vertices]
    path.write_text(common.json.dumps({'handles': handles}))
    return path


# ------------------------------------------------------------------ results
def panels(rows, columns, width, height, **more):
    """Returns (figure, axes as an array of arrays) with this many inches per panel."""
    import matplotlib
    matplotlib.use('svg')
    matplotlib.rcParams.update({
        'svg.fonttype': 'none', 'svg.hashsalt': 'majorant', 'font.size': 8, 'font.family': 'sans-serif',
        'axes.spines.top': False, 'axes.spines.right': False, 'axes.linewidth': 0.6,
        'lines.linewidth': 1.2, 'lines.markersize': 4, 'legend.frameon': False,
        'axes.titlesize': 8, 'image.interpolation': 'none'})
    from matplotlib import pyplot
    return pyplot.subplots(rows, columns, figsize=(columns * width, rows * height), squeeze=False,
                           layout='constrained', **more)


def write_svg(figure, path):
    figure.savefig(path, format='svg', facecolor='white', metadata={'Date': None})
    text = re.sub(r'(\d\.\d)\d{2,}', r'\1', path.read_text())  # precision 0.1 pt
    path.write_text(re.sub(r' +\n', '\n', text))


def write_csv(rows, path):
    with open(path, 'w', newline='') as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator='\n')
        writer.writeheader()
        writer.writerows(rows)


def answer(criteria):
    held = [c.holds for c in criteria]
    return 'yes' if all(held) else 'partly' if any(held) else 'no'


def paragraph(module, word):
    found = [text for text in module.__doc__.split('\n\n') if text.startswith(word)]
    return ' '.join(found[0].split()) if found else sys.exit('%s: no paragraph %s' % (module.__file__, word))


def wrapped(text):
    return textwrap.fill(text, WIDTH, break_long_words=False, break_on_hyphens=False)


def section(module, rows):
    """Returns the experiment's section in Markdown, from which all.py makes a row of docs/experiments.md."""
    name, criteria = Path(module.__file__).stem, module.judge(rows)
    lines = ['## ' + module.__doc__.splitlines()[0].rstrip('.'), '',
             wrapped(paragraph(module, 'Claim')), '',
             wrapped(paragraph(module, 'Here') + ' ' + paragraph(module, 'Time')), '',
             '    bench/experiments/%s.py' % name, '',
             '![%s](experiments/%s.svg)' % (name.replace('_', ' '), name), '']
    lines += common.markdown_table(*module.table(rows)) + ['', '**Seen: %s.**' % answer(criteria), '']
    word = {True: 'yes', False: '**no**', None: 'not tried'}
    lines += common.markdown_table(['criterion', 'measured', 'holds'],
                                   [[c.statement, c.measured, word[c.holds]] for c in criteria])
    reasons = [c.why for c in criteria if not c.holds and c.why]
    return '\n'.join(lines + (['', wrapped(' '.join(reasons))] if reasons else [])) + '\n'


def main(module):
    options = parse_arguments(module)
    options.out.mkdir(parents=True, exist_ok=True)
    stem = options.out / Path(module.__file__).stem
    try:
        rows = module.measure(options)
    except Failed as failure:
        sys.exit(str(failure))
    write_csv(rows, stem.with_suffix('.csv'))
    write_svg(module.draw(rows), stem.with_suffix('.svg'))
    stem.with_suffix('.md').write_text(section(module, rows))
    print('%s: %s' % (stem.name, answer(module.judge(rows))))
    return 0


# ------------------------------------------------------------------ rows
def where(rows, **conditions):
    return [row for row in rows if all(row[key] == value for key, value in conditions.items())]


def values(rows, key):
    """Returns the different values of a key in the order in which they appear."""
    return list(dict.fromkeys(row[key] for row in rows))


def count(holds):
    """Returns '3 of 4' for a list of booleans."""
    return '%d of %d' % (sum(map(bool, holds)), len(holds))


def percents(parts):
    return ', '.join('%.0f %%' % (100 * part) for part in parts)


median = statistics.median
