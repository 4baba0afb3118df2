# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Exit code 4: a limit or Ctrl-C ends the run, and the result so far is valid and written."""
import json
import signal
import subprocess
import time
import unittest

from command_helpers import *


class Limits(CommandTest):
    def stops(self, status, *args):
        out, report = self.path('out.vtu'), self.path('report.json')
        outcome = self.run_ok('parametrize', generated('tube'), '-o', out, '--report', report, *args,
                              code=LIMIT)
        self.assertIn(status, outcome.err)
        with open(report) as f:
            data = json.load(f)
        self.assertEqual(data['status'], status)
        self.assertTrue(data['result']['locally_injective'])
        self.run_ok('check', out, '--surface', generated('tube'))
        return data

    def test_max_iterations(self):
        for limit in (0, 1, 5):
            data = self.stops('max_iterations', '--max-iterations', limit, '--degree', '3')
            self.assertEqual(len(data['iterations']), limit)
            self.assertEqual(data['result']['degree'], 3)
            self.assertEqual(Vtu(self.path('out.vtu')).claims['degree'], 3)

    def test_tolerance_is_heard(self):
        counts = []
        for tolerance in ('1e-1', '1e-9'):
            report = self.path('report.json')
            self.run_ok('parametrize', generated('tube'), '-o', self.path('out.vtu'), '--report',
                        report, '--tolerance', tolerance, '--degree', 1)
            with open(report) as f:
                counts.append(len(json.load(f)['iterations']))
        self.assertLess(counts[0], counts[1])

    def test_time_limit(self):
        for degree in (1, 3):
            data = self.stops('time_limit', '--time-limit', '0', '--degree', degree)
            self.assertLessEqual(len(data['iterations']), 1)
            self.assertEqual(data['result']['degree'], degree)

    def test_layouts_moved_after_the_limit_are_proven(self):
        for flag in ('--normalize', '--align'):
            data = self.stops('time_limit', '--time-limit', '0', '--degree', '2', flag)
            self.assertEqual(data['result']['degree'], 2)

    def test_fixed_boundary_and_pins_hold_at_a_limit(self):
        pins = self.write('pins.json', '{"handles": [{"vertex": 100, "target": "initial"}]}')
        for n in (1, 4):
            self.stops('max_iterations', '--max-iterations', 2, '--degree', n, '--boundary', 'fixed',
                       '--pins', pins)
            claims = Vtu(self.path('out.vtu')).claims
            self.assertEqual(claims['boundary'], 'fixed')
            self.assertEqual([p['vertex'] for p in claims['pins']], [100])

    def interrupted(self, ready, number):
        """Runs the creature at degree 8, waits for `ready` on stderr, and interrupts."""
        out, report = self.path('out.vtu'), self.path('report.json')
        process = subprocess.Popen(
            [BINARY, 'parametrize', generated('creature'), '-o', out, '--degree', '8', '--tolerance',
             '1e-13', '--verbose', '--report', report],
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        try:
            for line in process.stderr:
                if ready in line:
                    break
            else:
                self.fail('the run ended by itself: %s' % process.wait())
            self.assertEqual(self.files(), [], 'files before the end of the run')
            start = time.monotonic()
            process.send_signal(number)
            rest = process.stderr.read()
            code = process.wait(30)
            self.assertLess(time.monotonic() - start, 10)
        finally:
            process.kill()
            process.stdout.close()
            process.stderr.close()
        self.assertEqual(code, LIMIT, rest)
        self.assertIn('interrupted', rest)
        self.assertEqual(self.files(), ['out.vtu', 'report.json'])
        with open(report) as f:
            data = json.load(f)
        self.assertEqual(data['status'], 'interrupted')
        self.assertEqual(data['result']['degree'], 8)
        self.assertTrue(data['result']['locally_injective'])
        self.run_ok('check', out, '--surface', generated('creature'))

    def test_ctrl_c_below_the_degree(self):
        self.interrupted('degree 1 ', signal.SIGINT)

    def test_terminated_on_the_way(self):
        self.interrupted('degree 5 ', signal.SIGTERM)


if __name__ == '__main__':
    main()
