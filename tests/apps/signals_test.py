# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""SIGINT, SIGTERM and SIGHUP: the best map is written, a second signal ends the run, no temporary file is left."""
import contextlib
import os
import signal
import subprocess
import time

from command_helpers import *

ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


def start(*args, prefix=()):
    return subprocess.Popen(list(prefix) + [BINARY] + [str(a) for a in args],
                            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, text=True)


class Signals(CommandTest):
    def finished(self, process):
        try:
            return Outcome(subprocess.CompletedProcess([], process.wait(120), *process.communicate()))
        finally:
            process.kill()

    def run_and_signal(self, number, prefix=()):
        """Signals a long run after its first line of progress."""
        process = start('parametrize', generated('creature'), '-o', self.path('out.vtu'), '--degree',
                        '8', '--tolerance', '1e-13', '--verbose', prefix=prefix)
        self.addCleanup(process.kill)
        self.assertTrue(process.stderr.readline())
        process.send_signal(number)
        return process

    def test_every_signal_stops_a_run(self):
        for number in ENDING:
            outcome = self.finished(self.run_and_signal(number))
            self.assertEqual(outcome.code, LIMIT, (number, outcome.err))
            self.assertIn('interrupted', outcome.err)
            self.run_ok('check', self.path('out.vtu'), '--surface', generated('creature'))

    def test_nohup(self):
        process = self.run_and_signal(signal.SIGHUP, ['nohup'])
        while 'degree 2' not in process.stderr.readline():  # the run continues
            self.assertIsNone(process.poll())
        process.send_signal(signal.SIGTERM)
        outcome = self.finished(process)
        self.assertEqual(outcome.code, LIMIT, outcome.err)

    def waiting_for_a_reader(self, number):
        """Starts a run whose second output has no reader, so that writing it does not end."""
        os.mkfifo(self.path('fifo.vtu'))
        process = start('parametrize', generated('cap'), '-o', self.path('done.vtu'), '-o',
                        self.path('fifo.vtu'), '--degree', '1', '--quiet')
        self.addCleanup(process.kill)
        while 'done.vtu' not in self.files():
            self.assertIsNone(process.poll())
            time.sleep(0.01)
        process.send_signal(number)
        return process

    def test_the_second_ends(self):
        for number in ENDING:
            process = self.waiting_for_a_reader(number)
            time.sleep(0.7)  # signals within half a second count as one
            self.assertIsNone(process.poll())
            process.send_signal(number)
            self.assertEqual(self.finished(process).code, -number)
            self.assertEqual(self.files(), ['done.vtu', 'fifo.vtu'])
            for name in self.files():
                os.unlink(self.path(name))

    def signal_twice(self, number):
        """Sends a second signal right after the run has handled the first; None if that took long."""
        process = self.waiting_for_a_reader(number)
        sent = time.monotonic()
        while True:
            with open('/proc/%d/status' % process.pid) as f:
                if 'ShdPnd:\t0000000000000000' in f.read():
                    break
        process.send_signal(number)
        if time.monotonic() - sent < 0.1:
            return process
        process.kill()
        for name in self.files():
            os.unlink(self.path(name))
        return None

    def test_timeout_signals_twice_and_means_once(self):
        attempts = (self.signal_twice(signal.SIGTERM) for _ in range(20))
        process = next(p for p in attempts if p)
        reader = os.open(self.path('fifo.vtu'), os.O_RDONLY | os.O_NONBLOCK)
        self.addCleanup(os.close, reader)
        received, ended = b'', False
        while not ended:
            ended = process.poll() is not None
            with contextlib.suppress(BlockingIOError):
                while piece := os.read(reader, 1 << 16):
                    received += piece
            time.sleep(0.01)
        self.assertEqual(self.finished(process).code, OK)
        self.assertEqual(received, self.read('done.vtu'))


if __name__ == '__main__':
    main()
