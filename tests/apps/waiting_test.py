# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Pipes that are read or written slowly or not at all; lists and images in pipes (others: every_verb_test)."""
import fcntl
import os
import select
import signal
import subprocess
import time

from command_helpers import *

SOON = 20  # upper bound on the seconds until a waiting run ends, on a busy machine


class Waiting(CommandTest):
    def start(self, *args, **streams):
        streams = {'stdin': subprocess.DEVNULL, 'stdout': subprocess.PIPE, 'stderr': subprocess.PIPE, **streams}
        process = subprocess.Popen([BINARY] + [str(a) for a in args], **streams)
        self.addCleanup(process.kill)
        return process

    def job(self, *outputs):
        words = ['parametrize', generated('cap'), '--degree', '1', '--quiet']
        return words + [word for name in outputs for word in ('-o', self.path(name))]

    def wait_for(self, name, process):
        while name not in self.files():
            self.assertIsNone(process.poll())
            time.sleep(0.01)

    def ended(self, process):
        try:
            out, err = process.communicate(timeout=SOON)
        except subprocess.TimeoutExpired:
            self.fail('it waits for ever')
        return process.returncode, err.decode()

    def full_pipe(self):
        """Returns a full pipe without a reader."""
        reader, writer = os.pipe()
        os.write(writer, bytes(fcntl.fcntl(writer, fcntl.F_SETPIPE_SZ, 4096)))
        for end in (reader, writer):
            self.addCleanup(os.close, end)
        return writer

    def check_message(self, outcome, name, written):
        code, err = outcome
        self.assertEqual(code, USAGE, err)
        self.assertEqual(err.count('\n'), 1, err)
        for part in (name, 'nobody reads it', 'written: ' + written if written else 'nothing was written'):
            self.assertIn(part, err)

    def test_a_fifo_whose_reader_stops_reading(self):
        os.mkfifo(self.path('fifo.vtu'))
        process = self.start('parametrize', generated('creature'), '-o', self.path('fifo.vtu'), '--degree', '3',
                             '--max-iterations', '0', '--quiet')
        reader = os.open(self.path('fifo.vtu'), os.O_RDONLY)  # waits for the writer
        self.addCleanup(os.close, reader)
        select.select([reader], [], [])
        process.send_signal(signal.SIGTERM)
        self.check_message(self.ended(process), 'fifo.vtu', None)

    def test_a_slow_reader_gets_all(self):
        """A reader takes pieces at intervals, also after the limit."""
        self.run_ok(*self.job('whole.vtu'))
        os.mkfifo(self.path('fifo.vtu'))
        reader = os.open(self.path('fifo.vtu'), os.O_RDONLY | os.O_NONBLOCK)
        self.addCleanup(os.close, reader)
        fcntl.fcntl(reader, fcntl.F_SETPIPE_SZ, 4096)
        process = self.start(*self.job('fifo.vtu'), '--time-limit', '1')
        select.select([reader], [], [])
        os.set_blocking(reader, True)
        received, begun = b'', time.monotonic()
        while piece := os.read(reader, 1 << 12):
            received += piece
            if time.monotonic() - begun < 4:
                time.sleep(0.5)
        self.assertEqual(received, self.read('whole.vtu'))
        self.assertEqual(self.ended(process)[0], OK)

    def test_standard_output(self):
        self.write('a.json', '')
        process = self.start(*self.job('done.vtu'), '--report', '-', stdout=self.full_pipe())
        self.wait_for('done.vtu', process)
        process.send_signal(signal.SIGTERM)
        code, err = self.ended(process)
        self.assertEqual(code, USAGE, err)
        self.assertIn('standard output', err)

    def test_messages_that_nobody_reads(self):
        process = self.start('parametrize', generated('creature'), '-o', self.path('done.vtu'), '--degree', '5',
                             '--tolerance', '1e-13', '--verbose', '--time-limit', '2', stderr=self.full_pipe())
        code = process.wait(SOON + 20)
        self.assertEqual(code, LIMIT)
        self.run_ok('check', self.path('done.vtu'))

    def test_lists_and_images_that_nobody_writes(self):
        os.mkfifo(self.path('list'))
        for option in ('--pins', '--handles', '--weights', '--seams', '--image'):
            process = self.start(*self.job('out.vtu', 'out.png'), option, self.path('list'))
            time.sleep(1)
            self.assertIsNone(process.poll())
            process.send_signal(signal.SIGTERM)
            code, err = self.ended(process)
            self.assertEqual(code, INVALID, err)
            self.assertIn('interrupted while reading ' + self.path('list'), err)
            self.assertEqual(self.files(), ['list'])

    def test_an_image_that_somebody_writes(self):
        self.run_ok('parametrize', generated('cap'), self.path('old.png'), '--size', '64')
        os.mkfifo(self.path('fifo'))
        process = self.start(*self.job('out.png'), '--image', self.path('fifo'))
        with open(self.path('fifo'), 'wb') as fifo:
            fifo.write(self.read('old.png'))
        code, err = self.ended(process)
        self.assertEqual(code, OK, err)

    def test_an_input_that_somebody_writes(self):
        os.mkfifo(self.path('in.obj'))
        process = self.start('info', self.path('in.obj'))
        with open(generated('cap'), 'rb') as mesh, open(self.path('in.obj'), 'wb') as fifo:
            text = mesh.read()
            fifo.write(text[:1000])
            fifo.flush()
            time.sleep(0.3)
            fifo.write(text[1000:])
        out, _ = process.communicate(timeout=SOON)
        self.assertEqual(process.returncode, OK)
        self.assertIn(b'polygons', out)


if __name__ == '__main__':
    main()
