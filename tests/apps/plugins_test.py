#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Libraries that the command loads on demand from its own folder, and in no other run: CHOLMOD for --linear-solver
cholmod, Ceres for compare."""
import glob
import json
import os
import shutil
import subprocess
import sys
import unittest

from command_helpers import *

HEAVY = ('libopenblas', 'libblas', 'liblapack', 'libcholmod', 'libglog', 'libgfortran', 'libpetsc', 'libmpi')
PLUGINS = {name: os.path.join(os.path.dirname(BINARY), 'libmajorant_%s.so' % name) for name in ('cholmod', 'ceres')}


def built(name):
    return unittest.skipUnless(os.path.exists(PLUGINS[name]), 'no libmajorant_%s.so' % name)


class Loaded(CommandTest):
    def loaded(self, *words):
        """Returns the names of all libraries that a run loads."""
        log = self.path('loaded')
        done = subprocess.run([BINARY, *map(str, words)], text=True, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              env=dict(os.environ, LD_DEBUG='files', LD_DEBUG_OUTPUT=log))
        self.assertEqual(done.returncode, OK, done.stderr)
        names = set()
        logs = glob.glob(log + '.*')
        self.assertEqual(len(logs), 1, 'one process')
        with open(logs[0]) as f:
            starts = 0
            for line in f:
                starts += 'transferring control' in line
                if 'generating link map' in line:
                    names.add(os.path.basename(re.search(r'file=(\S+)', line)[1]))
        self.assertEqual(starts, 1, 'the program starts once')
        os.remove(logs[0])
        return names

    def heavy(self, names):
        return sorted(name for name in names if name.startswith(HEAVY))

    def test_runs_without_plugins(self):
        cap = generated('cap')
        for words in (('unwrap', cap, '-o', self.path('a.obj'), '-o', self.path('a.html')),
                      ('parametrize', cap, self.path('a.vtu'), '--bijective'), ('check', self.path('a.vtu')),
                      ('info', cap), ('compare', cap, '--methods', 'newton,lbfgs', '--degree', '1', '--quiet'),
                      ('seamless', generated('buckle'), self.path('b.vtu'), '--linear-solver', 'direct')):
            with self.subTest(words[0]):
                names = self.loaded(*words)
                self.assertGreater(len(names), 5)
                self.assertEqual(self.heavy(names), [])

    @built('cholmod')
    def test_cholmod(self):
        names = self.loaded('parametrize', generated('cap'), self.path('a.vtu'), '--linear-solver', 'cholmod')
        self.assertIn('libmajorant_cholmod.so', names)
        self.assertTrue(any(name.startswith('libcholmod') for name in names))
        self.assertFalse(any(name.startswith('libglog') for name in names))

    @built('ceres')
    def test_ceres(self):
        names = self.loaded('compare', generated('cap'), '--methods', 'ceres-lbfgs', '--degree', '1', '--quiet')
        self.assertIn('libmajorant_ceres.so', names)
        self.assertTrue(any(name.startswith('libglog') for name in names))


@built('cholmod')
class Cholmod(CommandTest):
    def report(self, *words):
        self.run_ok(*words, '-o', self.path('a.vtu'), '--report', self.path('a.json'), '--quiet')
        with open(self.path('a.json')) as f:
            return json.load(f)

    def same(self, *words):
        own, report = self.report(*words), self.report(*words, '--linear-solver', 'cholmod')
        self.assertEqual(report['linear_solver'], {'requested': 'cholmod', 'used': 'cholmod'})
        self.assertEqual(report['status'], own['status'])
        self.assertLess(abs(report['result']['value'] / own['result']['value'] - 1), 1e-9)

    def test_the_same_maps(self):
        for degree in (1, 2, 3):
            self.same('parametrize', generated('cap'), '--degree', degree)
        self.same('parametrize', generated('cap'), '--degree', 2, '--boundary', 'fixed')
        self.same('parametrize', generated('tube'), '--degree', 1, '--bijective')
        self.same('seamless', generated('buckle'), '--degree', 2)
        flat = self.write('flat.obj', obj_text(*grid(6, lambda x, y: 0)))
        pull = self.write('pull.json', '{"handles": [{"vertex": 0, "target": [-0.2, 0.3]},'
                                       '{"vertex": 48, "target": [1.1, 1]}]}')
        self.same('deform', flat, '--degree', 2, '--handles', pull)

    def test_unwrap_refuses(self):
        self.refused(USAGE, 'unwrap', generated('buckle'), self.path('a.obj'), '--linear-solver', 'cholmod',
                     says=['--linear-solver cholmod', 'unwrap', 'leave it out'])


class Elsewhere(CommandTest):
    """The program in another folder, without its plugins or with invalid ones."""

    def setUp(self):
        super().setUp()
        os.makedirs(self.path('bin'))
        shutil.copy(BINARY, self.path('bin/majorant'))

    def run_there(self, *words):
        return Outcome(subprocess.run([self.path('bin/majorant'), *map(str, words)], cwd=self.folder, text=True,
                                      stdout=subprocess.PIPE, stderr=subprocess.PIPE))

    def cholmod(self):
        return self.run_there('parametrize', generated('cap'), self.path('a.vtu'), '--linear-solver', 'cholmod')

    def test_missing(self):
        # Libraries in the current directory are not loaded.
        self.write('libmajorant_cholmod.so', 'nothing')
        done = self.cholmod()
        self.assertEqual(done.code, UNSUPPORTED, done.err)
        self.assertEqual(done.err.count('\n'), 1)
        for part in ('--linear-solver cholmod', 'there is no libmajorant_cholmod.so in ' + self.path('bin'),
                     'libsuitesparse-dev', 'leave the option out'):
            self.assertIn(part, done.err)
        self.assertFalse(os.path.exists(self.path('a.vtu')))

    def test_broken(self):
        self.write('bin/libmajorant_cholmod.so', 'nothing')
        done = self.cholmod()
        self.assertEqual(done.code, UNSUPPORTED, done.err)
        self.assertIn('cannot be loaded', done.err)
        self.assertIn('libcholmod3', done.err)

    @built('ceres')
    def test_another_plugin(self):
        """A library that is not ours, or is another one of ours under this name."""
        os.symlink('/lib/x86_64-linux-gnu/libz.so.1', self.path('bin/libmajorant_cholmod.so'))
        if not os.path.exists(self.path('bin/libmajorant_cholmod.so')):
            self.skipTest('no zlib there')
        done = self.cholmod()
        self.assertEqual(done.code, UNSUPPORTED, done.err)
        self.assertIn('has version ?', done.err)

    @built('ceres')
    def test_compare_without_ceres(self):
        words = ('compare', generated('cap'), '--degree', 1, '--max-iterations', 3)
        named = self.run_there(*words, '--methods', 'newton,ceres-lm')
        self.assertEqual(named.code, UNREADABLE, named.err)
        for part in ('method ceres-lm', 'libmajorant_ceres.so', 'libceres-dev'):
            self.assertIn(part, named.err)
        all_of_them = self.run_there(*words)
        self.assertEqual(all_of_them.code, OK, all_of_them.err)
        self.assertIn('libmajorant_ceres.so', all_of_them.err)
        self.assertIn('newton-eigen', all_of_them.out)
        self.assertNotIn('ceres', all_of_them.out)

    @built('cholmod')
    def test_installed(self):
        subprocess.run(['cmake', '--install', os.environ['MAJORANT_BUILD_DIR'], '--prefix', self.path('tree'),
                        '--component', 'command'], check=True, stdout=subprocess.DEVNULL)
        for words in (('parametrize', generated('cap'), self.path('a.vtu'), '--linear-solver', 'cholmod'),
                      ('compare', generated('cap'), '--degree', '1', '--methods', 'ceres-lbfgs')):
            done = Outcome(subprocess.run([self.path('tree/bin/majorant'), *words, '--quiet'], text=True,
                                          stdout=subprocess.PIPE, stderr=subprocess.PIPE))
            self.assertEqual(done.code, OK, done.err)
            self.assertEqual(done.err, '')


if __name__ == '__main__':
    main()
