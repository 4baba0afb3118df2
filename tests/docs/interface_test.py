#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Compares docs/interface.md with the program (flags of --help, exit codes, statuses), and reports with their
schema.

The test fails with the name of a flag, a status or a key that is only in the program, or only in the page or
the schema. Reports come from a few small runs: a key that none of them writes needs another run here.
"""
import glob
import json
import math
import os
import re
import subprocess
import sys
import unittest

SOURCE = os.environ['MAJORANT_SOURCE_DIR']
sys.path.insert(0, os.path.join(SOURCE, 'tests', 'apps'))
sys.path.insert(0, os.path.join(SOURCE, 'cmake/scripts'))
import command_helpers as helpers  # noqa: E402
import report_schema  # noqa: E402
import report_table  # noqa: E402
from command_helpers import INVALID, LIMIT, UNREADABLE, UNSUPPORTED, USAGE, CommandTest, majorant  # noqa: E402

MPI_BINARY = os.environ.get('MAJORANT_MPI_BINARY', '')


def alone(*words):
    """Runs majorant-mpi on one rank."""
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT='1', OMPI_ALLOW_RUN_AS_ROOT_CONFIRM='1')
    return helpers.Outcome(subprocess.run([MPI_BINARY, *words], env=environment, text=True, stdin=subprocess.DEVNULL,
                                          stdout=subprocess.PIPE, stderr=subprocess.PIPE))


VERBS = ['parametrize', 'unwrap', 'seamless', 'deform', 'check', 'compare', 'convert', 'bake', 'quads', 'info', 'mesh check',
         'mesh optimize']


def page():
    with open(os.path.join(SOURCE, 'docs', 'interface.md')) as f:
        return f.read()


def section(heading):
    return page().split('\n## ' + heading + '\n', 1)[1].split('\n## ')[0]


def rows(text):
    """Returns the cells of table lines, without header lines."""
    found, previous = [], ''
    for line in text.splitlines():
        is_rule = re.fullmatch(r'[|-]+', line)
        if line.startswith('|') and not is_rule and previous.startswith('|'):
            cells = line.replace('\\|', '¦').strip('|').split('|')
            found.append([cell.strip().replace('¦', '|') for cell in cells])
        previous = line
    return found


class Flags(unittest.TestCase):
    def documented(self):
        """Returns {long flag: verbs}. Rows of a verb's own section have no column of verbs; `all` is every
        verb."""
        flags = {}
        for part in section('Flags').split('\n### ')[1:]:
            heading = part.split('\n', 1)[0]
            for names, *cells in rows(part):
                verbs = cells[0] if len(cells) == 2 else heading
                for flag in re.findall(r'--[a-z][a-z-]*', names):
                    self.assertNotIn(flag, flags, 'twice in docs/interface.md')
                    flags[flag] = set(VERBS if verbs == 'all' else verbs.split(', '))
                    self.assertLessEqual(flags[flag], set(VERBS), flag)
        return flags

    def test_every_long_flag(self):
        documented = self.documented()
        self.assertGreaterEqual(len(documented), 35)
        for verb in VERBS:
            text = majorant(*verb.split(), '--help').out
            flags = set(re.findall(r'^  (?:-\w, )?(--[a-z][a-z-]*)', text, re.M))
            self.assertGreaterEqual(len(flags), 7)
            for flag in flags:
                self.assertIn(verb, documented.get(flag, ()), 'docs/interface.md lacks ' + flag)
            for flag, verbs in documented.items():
                if verb in verbs:
                    self.assertIn(flag, flags, '%s has no %s' % (verb, flag))

    def test_every_long_flag_of_majorant_mpi(self):
        """Flags of majorant-mpi, if it is built: common ones, its own, and those that it refuses by name."""
        if not os.path.exists(MPI_BINARY):
            self.skipTest('no majorant-mpi')
        listed, refused = {}, []
        for names, kind, _ in rows(section('Flags of majorant-mpi')):
            for name, value in re.findall(r'`(--[a-z-]+)( \w+)?`', names):
                self.assertNotIn(name, listed)
                listed[name] = kind
                if kind == 'refused':
                    refused.append([name] + {' FILE': ['a.vtu'], ' K': ['1'], '': []}[value])
        self.assertEqual(set(listed.values()), {'the same', 'its own', 'refused'})
        text = alone('parametrize', '--help')
        flags = set(re.findall(r'^  (?:-\w, )?(--[a-z][a-z-]*)', text.out, re.M))
        self.assertEqual(flags, set(listed))
        documented = self.documented()
        for flag, kind in listed.items():
            if kind == 'the same':
                self.assertIn('parametrize', documented[flag], flag)
        for words in refused:
            done = alone('parametrize', 'none.obj', '-o', 'a.pvtu', *words)
            self.assertEqual(done.code, helpers.USAGE, done.err)
            self.assertIn(words[0], done.err)
            self.assertIn('majorant parametrize', done.err)

    def test_every_verb(self):
        self.assertEqual(helpers.verb_names(), VERBS)
        named = [re.match('`(.*?) [A-Z]', row[0])[1] for row in rows(section('Verbs'))]
        self.assertEqual(named, VERBS)


class Codes(unittest.TestCase):
    def test_exit_codes(self):
        with open(os.path.join(SOURCE, 'apps', 'failure.h')) as f:
            codes = re.search(r'enum ExitCode.*? \{(.*?)\}', f.read(), re.S)[1]
        self.assertEqual([row[0] for row in rows(section('Exit codes')) if row[0].isdigit()],
                         re.findall(r'= (\d+)', codes))

    def test_statuses(self):
        """Compares the page with the names of status_name() (framework/run_record.cpp)."""
        names = set()
        for name in sorted(glob.glob(os.path.join(SOURCE, 'framework', '*.cpp'))):
            with open(name) as f:
                names |= set(re.findall(r'case Status::\w+:\s+return "(\w+)";', f.read()))
        self.assertGreaterEqual(len(names), 7)
        listed = [row[0].strip('`') for row in rows(section('Exit codes'))
                  if not row[0].isdigit()]
        self.assertEqual(set(listed), names)


class Reports(CommandTest):
    def report(self, verb, *args, code=0):
        """Judges the report of a run with this exit code, and records its keys of the schema."""
        report = self.path('report.json')
        self.run_ok(*verb.split(), *args, '--report', report, '--quiet', '--force', code=code)
        self.judged(verb, report)
        self.codes.add(code)

    def judged(self, verb, path):
        with open(path) as f:
            report = json.load(f)
        os.remove(path)
        faults, seen = report_schema.validated(report)
        self.assertFalse(faults, '%s: a report that apps/jobs/report.schema.json does not allow' % verb)
        self.assertEqual(report['command'], verb)
        self.seen |= seen
        self.statuses.setdefault(report['status'], set()).add(verb)
        return report

    def run_all(self):
        """Runs every verb so that all keys of reports occur."""
        points, faces = helpers.grid(4)
        plane = [p[:2] for p in points]
        disk = self.write('disk.obj', helpers.obj_text(points, faces))
        flat = self.write('flat.obj', helpers.obj_text(*helpers.grid(4, lambda x, y: 0)))
        pins = self.write('pins.json', '{"handles": [{"vertex": 0, "target": "initial"}]}')
        with_uv = self.write('uv.obj', helpers.obj_text(points, faces, plane))
        inverted = self.write('inverted.obj', helpers.obj_text(
            points, faces, [*plane[:6], (3, 3), *plane[7:]]))
        overlapping = self.write('ribbon.obj', ribbon_of_more_than_a_turn())
        result, cut = self.path('result.vtu'), self.path('cut.vtu')
        self.report('parametrize', disk, result, '--degree', 2, '--pins', pins)
        self.report('parametrize', disk, self.path('b.vtu'), '--time-limit', 0, code=LIMIT)
        self.report('parametrize', disk, self.path('b.html'), '--snapshots', 2)
        self.report('unwrap', helpers.generated('buckle'), self.path('b.obj'), '--normalize')
        self.report('unwrap', disk, self.path('b.obj'), '--time-limit', 0, code=LIMIT)
        self.report('unwrap', self.write('flipped.obj', helpers.obj_text(
            points, [faces[0][::-1], *faces[1:]])), self.path('b.obj'), '--no-pack')
        self.report('unwrap', self.write('soup.obj', helpers.obj_text(
            [points[v] for face in faces for v in face],
            [(3 * k, 3 * k + 1, 3 * k + 2) for k in range(len(faces))])), self.path('b.obj'))
        fewer = self.write('fewer.off', 'OFF\n4 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n')
        for verb in ('parametrize', 'unwrap'):
            self.report(verb, fewer, self.path('b.obj'))
        self.report('info', fewer)
        self.report('seamless', helpers.generated('buckle'), cut, '--degree', 1)
        self.report('parametrize', cut, self.path('b.vtu'), '--seamless', '--degree', 1)
        self.report('parametrize', overlapping, self.path('b.vtu'), '--init', 'input',
                    '--degree', 1, '--max-iterations', 0, code=LIMIT)
        self.report('deform', overlapping, self.path('b.vtu'), '--degree', 1, '--handles', pins)
        self.report('deform', flat, self.path('b.vtu'), '--degree', 2, '--handles', self.write(
            'pull.json', '{"handles": [{"vertex": 0, "target": [-0.1, 0.1]}]}'), '--pins',
            self.write('pin.json', '{"handles": [{"vertex": 24, "target": "initial"}]}'))
        self.report('check', result, '--surface', disk)
        self.report('check', cut, '--seamless')
        self.report('check', overlapping, '--certify', code=INVALID)
        self.report('check', self.write('flat.obj', helpers.obj_text(
            [(0, 0, 0), (1, 0, 0), (2, 0, 0), (1, 1, 0)], [(0, 1, 2), (0, 2, 3)],
            [(0, 0), (1, -0.1), (2, 0), (1, 1)])))  # a face without area
        self.report('compare', disk, '--degree', 1, '--methods', 'newton,lbfgs')
        self.report('compare', disk, '--degree', 1, '--linear-solvers', 'direct,eigen')
        self.report('convert', result, self.path('c.obj'))
        self.report('convert', result, self.path('image.msh'))
        self.report('parametrize', helpers.generated('buckle'), self.path('b.vtu'), '--seams', 'auto',
                    '--degree', 1)
        self.report('bake', with_uv, '--from', disk, '--attribute', 'position', '-o', self.path('b.npy'))
        self.report('quads', helpers.generated('buckle'), self.path('quads.obj'), '--count', 600)
        self.report('check', self.path('quads.obj'), '--surface', helpers.generated('buckle'))
        self.report('info', disk)
        self.report('info', disk, '--plan')
        self.report('info', self.write('small.obj', helpers.obj_text(
            [tuple(1e-200 * x for x in p) for p in points], faces)), '--plan')
        self.report('info', self.write('twice.obj', helpers.obj_text(points, faces + faces[:1])))
        self.report('info', cut)
        self.report('info', self.path('image.msh'))
        self.report('info', inverted)
        self.report('mesh check', self.write('two.mesh', TWO_TETRAHEDRA))
        self.report('mesh optimize', self.path('two.mesh'), '-o', self.path('one.mesh'), '--boundary', 'free')
        self.report('unwrap', self.write('objects.obj', two_objects(points, faces)), self.path('b.obj'), '--objects',
                    'separate')
        self.has_petsc = os.path.exists(os.path.join(os.path.dirname(helpers.BINARY), 'libmajorant_petsc.so'))
        if self.has_petsc:
            self.report('parametrize', disk, self.path('b.vtu'), '--degree', 1, '--linear-solver', 'mumps')

    def run_without_result(self):
        """Runs every verb without its input, with an unsupported input, and with outputs that cannot be
        written."""
        none, mesh = self.path('none.obj'), helpers.generated('cap')
        more = {'bake': ['--from', none, '-o', self.path('n.png')], 'compare': ['--degree', 1], 'info': [], 'check': [],
                'deform': ['--handles', none, '-o', self.path('n.obj')], 'mesh check': [],
                'mesh optimize': ['-o', self.path('n.msh')]}
        for verb in VERBS:
            inputs = [self.path('none.msh') if verb.startswith('mesh') else none]
            self.report(verb, *inputs, *more.get(verb, ['-o', self.path('n.obj')]), code=UNREADABLE)
        self.report('parametrize', self.write('torus.obj', helpers.obj_text(*helpers.torus(8, 8, 0))),
                    self.path('n.obj'), code=UNSUPPORTED)
        os.symlink('/dev/full', self.path('full.obj'))
        self.report('unwrap', mesh, self.path('full.obj'), code=USAGE)

    def run_parts(self):
        """Runs majorant-mpi on one rank."""
        mesh, report, kept = helpers.generated('cap'), self.path('mpi.json'), self.path('kept.ckpt')
        for words in (['--checkpoint', kept, '--every', '1'], ['--resume', kept]):
            done = alone('parametrize', mesh, '-o', self.path('parts.pvtu'), '--degree', '2', '--force', '--quiet',
                         *words, '--report', report)
            self.assertEqual(done.code, 0, done.err)
            self.judged('parametrize', report)

    def test_every_key(self):
        """Every report fits the schema, and every key of the schema occurs in a report."""
        self.seen, self.codes, self.statuses = set(), set(), {}
        self.run_all()
        self.run_without_result()
        has_parts = os.path.exists(MPI_BINARY)
        if has_parts:
            self.run_parts()
        self.assertEqual(self.codes, {0, USAGE, UNREADABLE, UNSUPPORTED, LIMIT, INVALID})
        without = set(VERBS) - self.statuses['unreadable']
        self.assertFalse(without, 'verbs of which no run without an input was judged')
        missing = [key for key in report_schema.keys_of(report_schema.SCHEMA) if key not in self.seen]
        if not has_parts:
            missing = [key for key in missing if 'parts/' not in key]
        if not self.has_petsc:
            missing = [key for key in missing if '/petsc_method/' not in key and '/linear_solver/' not in key]
        self.assertFalse(missing, 'keys of apps/jobs/report.schema.json that no report has')

    def test_deviations_from_the_schema_are_found(self):
        """An additional key, a missing one and a value of another type are found at every level."""
        report = self.path('report.json')
        self.run_ok('parametrize', helpers.generated('cap'), '--degree', 1, '-o', report, '--quiet')
        with open(report) as f:
            known = json.load(f)
        known['result'].pop('split_faces')  # reports of majorant-mpi do not have this key
        text = json.dumps(known)
        for path in ([], ['result'], ['result', 'distortion', 'area'], ['iterations', 0], ['options'], ['input']):
            for change in (lambda part: part.update(another=1), lambda part: part.popitem(),
                           lambda part: part.update({next(iter(part)): {}})):
                changed = json.loads(text)
                part = changed
                for key in path:
                    part = part[key]
                change(part)
                self.assertTrue(report_schema.validated(changed)[0], path)

    def test_the_tables_of_the_page_are_generated(self):
        """The tables are those of cmake/scripts/report_table.py."""
        is_now, should_be = report_table.page()
        self.assertEqual(is_now, should_be, 'run cmake/scripts/report_table.py --write')

    def test_statuses(self):
        """The statuses of the schema are those with an exit code, and internal_error, whose exit code is the
        last one."""
        with open(os.path.join(SOURCE, 'apps', 'failure.cpp')) as f:
            table = re.search(r'kCodes\{\{(.*?)\}\};', f.read(), re.S)[1]
        self.assertEqual(set(report_schema.SCHEMA['properties']['status']['enum']),
                         set(re.findall(r'"(\w+)"', table)) | {'internal_error'})


TWO_TETRAHEDRA = '''MeshVersionFormatted 2
Dimension 3
Vertices 5
0 0 0 0
1 0 0 0
0 1 0 0
0 0 1 0
1 1 1 0
Tetrahedra 2
1 2 3 4 7
2 3 4 5 7
End
'''


def two_objects(points, faces):
    """Returns an OBJ with two copies of a surface side by side."""
    moved = [(x + 2, y, z) for x, y, z in points]
    vertices = ''.join('v %r %r %r\n' % tuple(p) for p in points + moved)
    groups = [''.join('f %s\n' % ' '.join(str(v + first) for v in face) for face in faces)
              for first in (1, 1 + len(points))]
    return vertices + 'o left\n' + groups[0] + 'o right\n' + groups[1]


def ribbon_of_more_than_a_turn():
    """Returns an OBJ of a flat strip whose texture coordinates turn 1.2 times around the origin."""
    count, points, uv, faces = 40, [], [], []
    for i in range(count + 1):
        angle = 2 * math.pi * 1.2 * i / count
        for radius in (1, 2):
            points.append((-i / 4, radius, 0))
            uv.append((radius * math.cos(angle), radius * math.sin(angle)))
    for a in range(0, 2 * count, 2):
        faces += [(a, a + 1, a + 3), (a, a + 3, a + 2)]
    return helpers.obj_text(points, faces, uv)


if __name__ == '__main__':
    helpers.main()
