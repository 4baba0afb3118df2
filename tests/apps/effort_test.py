# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""parametrize --effort high: several paths to a minimum, of which the lowest end counts."""
import json
import os
import sys
import unittest

from command_helpers import *  # noqa: F403

sys.path.insert(0, os.path.join(SOURCE, 'bench'))  # noqa: F405
import common  # noqa: E402
import tolerance  # noqa: E402


class Effort(CommandTest):  # noqa: F405
    def report(self, mesh, *args, code=OK):  # noqa: F405
        self.run_ok('parametrize', mesh, self.path('a.vtu'), '--force', '--report', self.path('a.json'), *args,
                    code=code)
        with open(self.path('a.json')) as file:
            return json.load(file)

    def test_never_higher(self):
        for name in ('creature', 'wavy_disk'):
            for words in (['--degree', 1], ['--degree', 3], ['--degree', 1, '--bijective']):
                with self.subTest(name=name, words=words):
                    normal = self.report(generated(name), *words)  # noqa: F405
                    high = self.report(generated(name), *words, '--effort', 'high')  # noqa: F405
                    self.assertEqual([normal['options']['effort'], high['options']['effort']], ['normal', 'high'])
                    self.assertEqual(high['status'], 'converged')
                    self.assertLess(high['result']['value'], normal['result']['value'] * (1 + 1e-6))
                    # Scaffolds, whose unknowns count, differ.
                    for key in ('degree', 'initial_value') if '--bijective' in words else (
                            'degree', 'initial_value', 'variables'):
                        self.assertEqual(high['result'][key], normal['result'][key])
                    self.run_ok('check', self.path('a.vtu'), '--surface', generated(name), '--certify')  # noqa: F405

    def test_lower_minima(self):
        """Of two minima of a saddle of small triangles, the direct path ends in the one that is 1 % higher."""
        _, _, vertices, faces = tolerance.mesh_of(11)
        common.write_obj(self.path('fan.obj'), vertices, faces)
        values = [self.report(self.path('fan.obj'), '--degree', 1, '--effort', effort)['result']['value']
                  for effort in ('normal', 'high')]
        self.assertLess(values[1], values[0] * 0.995)

    def test_limits(self):
        """Each path has the limit of iterations; the result is the lowest end so far."""
        whole = self.report(generated('creature'), '--degree', 2)  # noqa: F405
        for steps in (0, 1, 3):
            cut = self.report(generated('creature'), '--degree', 2, '--effort', 'high', '--max-iterations',  # noqa: F405
                              steps, code=LIMIT)  # noqa: F405
            self.assertEqual(cut['status'], 'max_iterations')
            self.assertGreater(cut['result']['value'], whole['result']['value'])
            self.run_ok('check', self.path('a.vtu'), '--surface', generated('creature'))  # noqa: F405

    def test_other_verbs(self):
        self.refused(USAGE, 'unwrap', generated('tube'), self.path('b.obj'), '--effort', 'high', says=['--effort'])  # noqa: F405


if __name__ == '__main__':
    unittest.main()
