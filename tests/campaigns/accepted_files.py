#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that the program accepts its own files. Each verb writes each format and degree, and `majorant check
FILE --surface IN` judges the file (`check FILE` for an image in the plane, which has no surface). Each file
is then converted to each format, and the result is checked.

Disks by parametrize, closed and messy meshes by unwrap, closed ones by seamless, plane ones by deform, from
SHARED/data/public and examples/meshes/; and small meshes made by this script (family `small`): soups,
bow-ties, slits, one-sided bands, edges with three faces, duplicate faces, quads. --random N adds N random
combinations of these. Exit codes 0 and 4 promise valid files. Refused runs (other exit codes) are counted,
and are no problem. A conversion may be refused if it rounds values (.msh, Lagrange cells) or the format
cannot hold a cone; other refusals are problems. Prints each problem and a table; exit code 0 exactly if there
are none.

Sample runs:
  tests/campaigns/accepted_files.py --families small
  tests/campaigns/accepted_files.py --families disks,closed --meshes '_500$|_1654$' --degrees 1,3
  tests/campaigns/accepted_files.py --families small --random 100 --degrees 1,2,3,4
"""
import argparse
import collections
import json
import random
import re
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[2] / 'bench'))
import common  # noqa: E402

sys.path.append(str(common.ROOT / 'tests/apps'))
from command_helpers import grid, obj_text, quads, torus  # noqa: E402
from unwrap_helpers import both, cube, moebius, soup, sphere, triangles  # noqa: E402

PROMISED = (0, 4)                                 # exit codes after which all outputs exist
INVALID = 5
# file name: flags of the verb that writes it. An image has no surface to be compared with.
FORMATS = {'bezier.vtu': [], 'lagrange.vtu': ['--vtu', 'lagrange'], 'out.obj': [], 'out.ply': [],
           'image.msh': [], 'surface.msh': ['--msh', 'surface']}
IMAGE = 'image.msh'
ROUNDED = ('lagrange.vtu', 'image.msh', 'surface.msh')   # formats with values instead of control points
# formats with the input's vertices and faces, of any degree
KNOWS_THE_INPUT = ('bezier.vtu', 'lagrange.vtu', 'surface.msh')
FAMILIES = {'small': None, 'meshes': 'parametrize', 'disks': 'parametrize', 'closed': 'unwrap',
            'messy': 'unwrap', 'seamless': 'seamless', 'deform2d': 'deform'}
FOLDERS = {'seamless': 'closed', 'messy': 'messy/derived'}

Job = collections.namedtuple('Job', 'name mesh verb degree flags')


# ------------------------------------------------------------------ small meshes
def slit(n):
    """Returns a sheet that is cut open along half of its middle row; both sides are at the same positions."""
    points, faces = grid(2 * n)
    row = range(n * (2 * n + 1), n * (2 * n + 1) + n)
    copy = {v: len(points) + k for k, v in enumerate(row)}
    below = 2 * 2 * n * n
    return points + [points[v] for v in row], \
        faces[:below] + [tuple(copy.get(v, v) for v in f) for f in faces[below:]]


def bow_tie():
    """Returns two triangles that meet in a vertex."""
    return [(0, 0, 0), (1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, -1, 0)], [(0, 1, 2), (0, 3, 4)]


def loose_bow_tie():
    """Returns the bow tie with a separate vertex for each triangle, at one position."""
    points, faces = bow_tie()
    return points + [points[0]], [faces[0], (5,) + faces[1][1:]]


def fin(n):
    """Returns a sheet with a third face on one of its inner edges."""
    points, faces = grid(n)
    a, b, _ = faces[len(faces) // 2]
    return points + [(0.5, 0.5, 2)], faces + [(a, b, len(points))]


def doubled(n, count=1):
    """Returns a sheet with duplicates of some faces, the last one flipped."""
    points, faces = grid(n)
    return points, faces + faces[:count] + [faces[-1][::-1]]


def some_turned(n):
    points, faces = quads(n)
    return points, [f[::-1] if k % 5 == 3 else f for k, f in enumerate(faces)]


OCTAHEDRON = ([(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)],
              [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)])
SMALL = {                                         # name: (verb, points and faces)
    'two_of_a_soup': ('unwrap', soup(*grid(1))),
    'soup': ('unwrap', soup(*grid(3))),
    'soup_sphere': ('unwrap', soup(*sphere(2))),
    'bow_tie': ('unwrap', bow_tie()),
    'loose_bow_tie': ('unwrap', loose_bow_tie()),
    'moebius': ('unwrap', moebius(8)),
    'fin': ('unwrap', fin(3)),
    'doubled': ('unwrap', doubled(3)),
    'some_turned': ('unwrap', some_turned(3)),
    'slit': ('parametrize', slit(2)),
    'slit_atlas': ('unwrap', slit(2)),
    'octahedron': ('unwrap', OCTAHEDRON),
    'cube': ('unwrap', cube(2)),
    'torus': ('seamless', torus(8, 6, 0)),
    'quads': ('parametrize', quads(3)),
}


def thinned(mesh, chance):
    """Returns the mesh without some of its faces."""
    points, faces = mesh
    left = [f for f in faces if chance.random() < 0.85]
    return points, left or faces


def random_mesh(chance):
    """Returns one or two of the small meshes, with faces removed, flipped, duplicated or separated."""
    kinds = [lambda: grid(chance.randint(1, 4)), lambda: quads(chance.randint(1, 3)),
             lambda: moebius(chance.randint(5, 9)), lambda: cube(chance.randint(1, 3)),
             lambda: sphere(2), bow_tie, loose_bow_tie, lambda: slit(chance.randint(1, 2)),
             lambda: fin(chance.randint(2, 3)), lambda: doubled(2, chance.randint(1, 3)),
             lambda: some_turned(3), lambda: OCTAHEDRON, lambda: torus(6, 4, chance.choice((0, 2)))]
    mesh = chance.choice(kinds)()
    if chance.random() < 0.4:
        mesh = thinned(mesh, chance)
    if chance.random() < 0.3:
        mesh = both(mesh, chance.choice(kinds)(), chance.choice(((5, 0, 0), (0, 0, 0))))
    if chance.random() < 0.3:
        mesh = (mesh[0], [f[::-1] if chance.random() < 0.2 else f for f in mesh[1]])
    if chance.random() < 0.2:
        mesh = (mesh[0], triangles(mesh[1]))
    if chance.random() < 0.2:
        mesh = soup(mesh[0], triangles(mesh[1]))
    return mesh


# ------------------------------------------------------------------ what to run
def small_meshes(count, seed):
    """Yields (name, verb, points and faces)."""
    for name, (verb, mesh) in SMALL.items():
        yield name, verb, mesh
    for k in range(count):
        yield 'random_%d' % k, 'unwrap', random_mesh(random.Random('%d %d' % (seed, k)))


def public_meshes(options, family):
    """Yields (name, path, flags)."""
    folder = common.ROOT / 'examples/meshes' if family == 'meshes' else \
        options.shared / 'data/public' / FOLDERS.get(family, family)
    for path in sorted(folder.glob('*.obj')):
        handles = path.with_suffix('.json')
        yield path.stem, path.resolve(), ['--handles', handles] if family == 'deform2d' else []


def plan(options, folder):
    jobs = []
    for family in options.families:
        if family == 'small':
            for name, verb, mesh in small_meshes(options.random, options.seed):
                path = folder / (name + '.obj')
                path.write_text(obj_text(*mesh))
                jobs += [Job(name, path, verb, degree, []) for degree in options.degrees]
            continue
        for name, path, flags in public_meshes(options, family):
            jobs += [Job(name, path, FAMILIES[family], degree, flags) for degree in options.degrees]
    return [job for job in jobs if re.search(options.meshes, job.name)]


# ------------------------------------------------------------------ one run
def last_line(done):
    return (done.stdout.strip() or done.stderr.strip() or 'exit %s' % done.code).splitlines()[-1]


class Case:
    """A job in a folder of its own."""

    def __init__(self, binary, job, folder, timeout=600):
        self.binary, self.job, self.folder, self.timeout = binary, job, folder, timeout
        self.problems, self.counts = [], collections.Counter()

    def run(self, *words):
        return common.run([self.binary, *words, '--threads', 1, '--quiet'], self.timeout)

    def write(self):
        """Runs the verb and returns its files; each format is written by a run with other flags."""
        written = []
        for flags in ([], ['--vtu', 'lagrange', '--msh', 'surface']):
            names = [n for n, own in FORMATS.items() if bool(own) == bool(flags)]
            outputs = [word for n in names for word in ('-o', self.folder / n)]
            done = self.run(self.job.verb, self.job.mesh, '--degree', self.job.degree, *self.job.flags,
                            *outputs, *flags)
            there = [n for n in names if (self.folder / n).exists()]
            self.counts['runs'] += 1
            self.counts['refused runs'] += done.code not in PROMISED
            if done.code not in PROMISED and done.code != INVALID and there:
                self.problems.append('exit %s, and files are written' % done.code)
            if done.code in PROMISED and there != names:
                self.problems.append('exit %s without all outputs' % done.code)
            if done.code == INVALID or done.code not in range(6):
                self.refused_outputs(done, names, there)
            written += there
        return written

    def refused_outputs(self, done, names, there):
        """Notes refused outputs as problems, except formats whose rounding may invert a map."""
        for name in set(names) - set(there):
            if there and name not in ROUNDED and 'cone' not in done.stderr:
                self.problems.append('%s: %s' % (name, last_line(done)))

    def check(self, name, has_surface):
        path = self.folder / name
        surface = ['--surface', self.job.mesh] if has_surface else []
        done = self.run('check', path, *surface)
        self.counts['checks'] += 1
        if done.code != 0:
            self.problems.append('check %s%s: %s' % (name, ' --surface' if has_surface else '',
                                                     last_line(done)))

    def convert(self, name):
        for target, flags in FORMATS.items():
            result = '%s_as_%s' % (name.replace('.', '_'), target)
            done = self.run('convert', self.folder / name, '-o', self.folder / result, *flags)
            self.counts['conversions'] += 1
            if done.code == 0:
                knows = name in KNOWS_THE_INPUT or self.job.degree == 1
                self.check(result, knows and IMAGE not in (name, target))
            elif done.code == INVALID and (target in ROUNDED or 'cone' in done.stderr):
                self.counts['refused by rounding'] += 1
            else:
                self.problems.append('convert %s to %s: exit %s: %s' % (name, target, done.code,
                                                                        last_line(done)))

    def examine(self, converts=True):
        for name in self.write():
            self.check(name, name != IMAGE)
            if converts:
                self.convert(name)
        return self


def examine(options, job):
    with tempfile.TemporaryDirectory(prefix='majorant_accepted_') as folder:
        case = Case(options.binary.resolve(), job, Path(folder), options.timeout)
        return case.examine(options.convert)


# ------------------------------------------------------------------ all runs
def numbers(text):
    return [int(word) for word in text.split(',')]


def names_of(known):
    """Returns an argparse type: comma-separated names out of `known`."""
    def parse(text):
        if not set(text.split(',')) <= set(known):
            raise argparse.ArgumentTypeError('choose from %s' % ','.join(known))
        return text.split(',')
    return parse


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    common.add_options(parser)
    parser.add_argument('--families', type=names_of(FAMILIES), default=list(FAMILIES))
    parser.add_argument('--meshes', default='', metavar='REGEX', help='searched in the names, e.g. "_500$"')
    parser.add_argument('--degrees', type=numbers, default=[1, 2, 3])
    parser.add_argument('--random', type=int, default=0, metavar='N', help='number of random small meshes')
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--no-convert', dest='convert', action='store_false', help='check only written files')
    parser.add_argument('--jobs', type=int, default=1, help='parallel runs of one thread each')
    parser.add_argument('--results', type=Path, help='JSON lines, one per run, appended')
    return parser.parse_args()


def announce(options, job, case):
    name = '%s %s degree %d' % (job.verb, job.name, job.degree)
    for problem in case.problems:
        print('%s: %s' % (name, problem), flush=True)
    if options.results:
        with open(options.results, 'a', encoding='utf-8') as file:
            file.write(json.dumps({'job': name, 'problems': case.problems, **case.counts}) + '\n')


def main():
    options = parse_arguments()
    totals = collections.defaultdict(collections.Counter)
    with tempfile.TemporaryDirectory(prefix='majorant_accepted_') as folder:
        jobs = plan(options, Path(folder))
        with ThreadPoolExecutor(options.jobs) as pool:
            for job, case in zip(jobs, pool.map(lambda job: examine(options, job), jobs)):
                announce(options, job, case)
                totals[job.verb] += case.counts + collections.Counter(problems=len(case.problems))
    columns = ['runs', 'refused runs', 'checks', 'conversions', 'refused by rounding', 'problems']
    rows = [[verb] + [count[c] for c in columns] for verb, count in totals.items()]
    print('\n'.join(common.markdown_table(['verb'] + columns, rows)))
    return int(any(count['problems'] for count in totals.values()))


if __name__ == '__main__':
    sys.exit(main())
