# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Stages of a run: a line for each in logs, one live line on a terminal."""
import fcntl
import os
import pty
import select
import signal
import struct
import subprocess
import termios
import time

from command_helpers import *

CLEAR = '\r\x1b[K'


# A progress line, live or in a log: the stage, the number of stages, the activity, percents, bytes, the
# elapsed time, the remaining time, the pass, and the current part.
WHERE = (r'(?P<stage>\d+) of (?P<stages>\d+) (?P<activity>\w+)(?: (?P<share>\d+) %)?'
         r'(?: (?P<bytes>[\d.]+ \w+(?: of [\d.]+ \w+)?))?(?:, \d+ % read back)?  (?P<clock>(?:\d+:)?\d+:\d\d)'
         r'(?:, (?P<left>about (?:\d+:)?\d+:\d\d left|stopping))?(?:  pass (?P<pass>\d+)(?: of at most \d+)?)?'
         r'(?:  (?P<part>.*))?')


def seconds(clock):
    total = 0
    for part in clock.split(':'):
        total = 60 * total + int(part)
    return total


def logged(text):
    """Returns the names of the activities with their own lines."""
    return re.findall(r'^(\w+) +\d+\.\d\d s$', text, re.M)


class Log(CommandTest):
    def phases(self, *args, code=OK):
        return logged(self.run_ok(*args, code=code).err)

    def test_verbs(self):
        cap, out = generated('cap'), self.path('a.vtu')
        runs = ['reading', 'start', 'solving', 'measuring', 'proving', 'writing']
        self.assertEqual(self.phases('parametrize', cap, out, '--degree', '2'), runs)
        self.assertEqual(self.phases('parametrize', cap, out, '--degree', '2', '--verbose'), runs)
        self.assertEqual(self.phases('parametrize', cap, out, '--degree', '1', '--report',
                                     self.path('r.json')), runs)
        self.assertEqual(self.phases('check', out), ['reading', 'proving', 'measuring'])
        self.assertEqual(self.phases('parametrize', cap, out, '--degree', '1', '--bijective'), runs)
        self.assertEqual(self.phases('parametrize', cap, out, '--degree', '1', '--bijective',
                                     '--write-scaffold', self.path('s.vtu')),
                         ['reading', 'start', 'scaffold', 'solving', 'measuring', 'proving', 'writing'])
        self.assertEqual(self.phases('seamless', generated('buckle'), out, '--degree', '1',
                                     '--normalize'),
                         ['reading', 'start', 'solving', 'measuring', 'measuring', 'proving', 'writing'])
        self.assertEqual(self.phases('unwrap', generated('buckle'), self.path('a.obj'), '--fill', '0'),
                         ['reading', 'cutting', 'solving', 'packing', 'proving', 'writing'])

    def test_steps_stand_between(self):
        lines = self.run_ok('parametrize', generated('cap'), self.path('a.vtu'), '--degree', '2',
                            '--verbose').err.splitlines()
        solving = next(k for k, line in enumerate(lines) if logged(line) == ['solving'])
        self.assertTrue(all(re.search('iteration', line) for line in lines[2:solving]), lines)
        self.assertGreater(solving, 2)
        self.assertIn('converged', lines[-1])

    def test_a_second_map_of_a_surface_is_announced(self):
        """A second map of the same surface is announced."""
        points, faces = torus(12, 8, 0)
        mesh = self.write('torus.obj', obj_text(points, faces))
        lines = self.run_ok('unwrap', mesh, self.path('a.obj'), '--max-stretch', '1.0001', '--fill', '0').err.splitlines()
        again = [k for k, line in enumerate(lines) if re.fullmatch(r'cutting again: \d+ of \d+ charts?', line)]
        self.assertTrue(again, lines)
        self.assertEqual(logged(lines[again[0] - 1]), ['solving'])
        self.assertEqual(logged(lines[again[0] + 1]), ['cutting'])

    def check_never_backwards(self, lines):
        """lines: matches of WHERE, in order."""
        for before, after in zip(lines, lines[1:]):
            self.assertLessEqual(int(before['stage']), int(after['stage']), after[0])
            self.assertLessEqual(seconds(before['clock']), seconds(after['clock']), after[0])
            self.assertLessEqual(int(before['pass'] or 1), int(after['pass'] or 1), after[0])
            if all(before[k] == after[k] for k in ('activity', 'pass')) and before['share'] and after['share']:
                self.assertLessEqual(int(before['share']), int(after['share']), after[0])

    def test_every_iteration_of_every_chart(self):
        """Charts are solved in parallel; each line names its chart."""
        points, faces = torus(24, 12, 0)
        mesh = self.write('torus.obj', obj_text(points, faces))
        requested = ('unwrap', mesh, self.path('a.obj'), '--charts', '4', '--report', self.path('r.json'))
        printed = self.run_ok(*requested, '--verbose').err.splitlines()
        shown = [re.fullmatch(r'(chart \d+ of \d+)  degree 1  iteration +(\d+)  .*', line) for line in printed]
        self.assertTrue(any(shown), printed)
        self.assertEqual([line for line in printed if 'iteration' in line], [line[0] for line in shown if line])
        with open(self.path('r.json')) as f:
            report = json.load(f)
        self.assertGreaterEqual(len([line for line in shown if line]),
                                sum(chart['iterations'] for chart in report['charts']))
        plain = [line for line in self.run_ok(*requested).err.splitlines() if 'iteration' in line]
        self.assertLess(len(plain), len([line for line in shown if line]))

    def test_a_log_is_not_silent(self):
        """A run reads from a pipe without data for long: there is a line at least every five seconds, with the time
        of the run, after the lines that were held back."""
        pipe = self.path('slow.obj')
        os.mkfifo(pipe)
        process = subprocess.Popen([BINARY, 'unwrap', pipe, self.path('a.obj')], stdin=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.kill)
        start, times, lines = time.monotonic(), [0], []
        while len(lines) < 2:
            lines.append(process.stderr.readline())
            times.append(time.monotonic() - start)
        with open(generated('cap'), 'rb') as mesh, open(pipe, 'wb') as writer:
            writer.write(mesh.read())
        rest = process.communicate(timeout=120)[1]
        self.assertEqual(process.returncode, OK, rest)
        where = [re.fullmatch(WHERE, line.rstrip('\n')) for line in lines]
        self.assertTrue(all(where), lines)
        self.assertEqual([(w['stage'], w['stages'], w['activity']) for w in where], [('1', '6', 'reading')] * 2)
        self.check_never_backwards(where)
        self.assertLess(seconds(where[0]['clock']), seconds(where[1]['clock']))
        for before, after in zip(times, times[1:]):
            self.assertLess(after - before, 5.5)  # a busy machine may delay the line
        self.assertEqual(logged(rest)[0], 'reading')

    def test_the_first_signal_is_acknowledged(self):
        """The message comes while the run waits for a reader of its output."""
        os.mkfifo(self.path('fifo.vtu'))
        process = subprocess.Popen([BINARY, 'parametrize', generated('cap'), self.path('fifo.vtu'), '--degree', '1'],
                                   stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.kill)
        while logged(process.stderr.readline()) != ['proving']:
            self.assertIsNone(process.poll())
        process.send_signal(signal.SIGINT)
        rest = process.communicate(timeout=120)[1]
        where = [m for m in (re.fullmatch(WHERE, line) for line in rest.splitlines()) if m]
        self.assertEqual([(m['activity'], m['left']) for m in where], [('writing', 'stopping')], rest)

    def test_limits(self):
        self.assertIn('writing', self.phases('parametrize', generated('cap'), self.path('a.vtu'),
                                             '--degree', '2', '--time-limit', '0', code=LIMIT))

    def test_refusals_stay_one_line(self):
        points, faces = torus(6, 4, 0)
        closed = self.write('closed.obj', obj_text(points, faces))
        self.refused(UNSUPPORTED, 'parametrize', closed, self.path('a.vtu'))
        points, faces = grid(2)
        flipped = [(0, 0)] * 4 + [(9, 9)] + [(1, 0), (0, 1), (1, 1), (2, 2)]
        self.found(self.write('bad.obj', obj_text(points, faces, flipped)))


class Terminal(CommandTest):
    def start(self, *args, columns=0):
        outer, inner = pty.openpty()
        fcntl.ioctl(inner, termios.TIOCSWINSZ, struct.pack('HHHH', 24, columns, 0, 0))
        self.addCleanup(os.close, outer)
        process = subprocess.Popen([BINARY, *map(str, args)], stderr=inner,
                                   stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
        os.close(inner)
        return process, outer

    def more(self, outer):
        """Returns the bytes that have arrived; empty if the other end is closed."""
        self.assertTrue(select.select([outer], [], [], 120)[0], 'nothing is said any more')
        try:
            return os.read(outer, 1 << 16).decode()
        except OSError:
            return ''

    def lines_of(self, live):
        """Returns matches of WHERE, and tests that the bars agree with them."""
        shown = [re.fullmatch(r'\[(?P<done>#+)(?P<rest>\.*)\] ' + WHERE, line) for line in live]
        self.assertTrue(all(shown), [line for line, match in zip(live, shown) if not match])
        for line in shown:
            self.assertEqual((len(line['done']), len(line['done'] + line['rest'])),
                             (int(line['stage']), int(line['stages'])))
        return shown

    def printed(self, *args, code=OK, **terminal):
        process, outer = self.start(*args, **terminal)
        text = ''.join(iter(lambda: self.more(outer), ''))
        self.assertEqual(process.wait(60), code, text)
        return text

    def test_the_live_line(self):
        for verb, phases in ((['parametrize', '--degree', '2'],
                              ['reading', 'start', 'solving', 'measuring', 'proving', 'writing']),
                             (['parametrize', '--bijective', '--degree', '1', '--write-scaffold',
                               self.path('s.vtu')],
                              ['reading', 'start', 'scaffold', 'solving', 'measuring', 'proving',
                               'writing']),
                             (['unwrap', '--fill', '0'],
                              ['reading', 'cutting', 'solving', 'packing', 'proving', 'writing'])):
            text = self.printed(*verb, generated('cap'), self.path('a.vtu'))
            *live, last = text.split(CLEAR)
            shown = self.lines_of(live)
            names = [line['activity'] for line in shown]
            self.assertEqual([phases[int(line['stage']) - 1] for line in shown], names)
            self.assertEqual({int(line['stages']) for line in shown}, {len(phases)})
            for line in shown:
                self.assertRegex(line['part'] or '', r'^(degree .*|(chart 1 of 1  )?iteration .*|'
                                                     r'raising the degree to 2|building the surface|chart 1 of 1|'
                                                    r'where chart 1 of 1 divides best|)$')
            self.assertEqual(list(dict.fromkeys(names)), phases)
            self.assertLess(max(map(len, live)), 80)
            self.assertEqual(any('raising the degree to 2' in line for line in live), '2' in verb)
            self.assertEqual(any('chart 1 of 1' in line for line in live), verb[0] == 'unwrap')
            self.assertEqual(logged(text), [])
            self.assertIn('converged', last)  # the live line is removed before
            self.assertTrue(last.endswith('\n'))
            self.assertNotIn('\x1b', last)
        self.assertTrue(any('iteration' in line for line in live) or verb[0] == 'unwrap')

    def test_the_chart_of_a_step(self):
        """Charts of 5,000 faces and more are solved one by one: their steps name the chart."""
        points, faces = grid(52)
        moved = [(x + 9, y, z) for x, y, z in points]
        twice = faces + [tuple(v + len(points) for v in face) for face in faces]
        mesh = self.write('two.obj', obj_text(points + moved, twice))
        live = self.printed('unwrap', mesh, self.path('a.obj')).split(CLEAR)
        steps = [line for line in live if 'iteration' in line]
        self.assertEqual({re.split(',|  iteration', line['part'])[0] for line in self.lines_of(steps)},
                         {'chart 1 of 2', 'chart 2 of 2'})
        self.assertTrue(all(re.search(r'energy \d+\.\d{3}', line) for line in steps), steps)  # the line fits into 80 columns

    def test_check(self):
        self.run_ok('parametrize', generated('cap'), self.path('a.vtu'), '--degree', '2', '--quiet')
        *live, last = self.printed('check', self.path('a.vtu')).split(CLEAR)
        self.assertEqual(list(dict.fromkeys(line.split()[4] for line in live)),
                         ['reading', 'proving', 'measuring'])
        self.assertEqual(last, '')  # the verdict is on stdout only

    def test_the_line_is_updated_while_the_run_waits(self):
        """A run reads from a pipe without data: the line is updated repeatedly."""
        pipe = self.path('slow.obj')
        os.mkfifo(pipe)
        process, outer = self.start('parametrize', pipe, self.path('a.vtu'), '--degree', '1')
        text = ''
        while text.count('reading') < 4:
            arrived = self.more(outer)
            self.assertTrue(arrived, text)
            text += arrived
        shown = self.lines_of(text.split(CLEAR)[:4])
        self.assertLess(seconds(shown[0]['clock']), seconds(shown[-1]['clock']), text)  # the elapsed time is updated
        with open(pipe, 'wb') as writer:
            writer.write(self.read_of(generated('cap')))
        text += ''.join(iter(lambda: self.more(outer), ''))
        self.assertEqual(process.wait(60), OK, text)

    def read_of(self, path):
        with open(path, 'rb') as f:
            return f.read()

    def test_refusals_leave_one_line(self):
        points, faces = torus(6, 4, 0)
        closed = self.write('closed.obj', obj_text(points, faces))
        text = self.printed('parametrize', closed, self.path('a.vtu'), code=UNSUPPORTED)
        self.assertEqual(text.split(CLEAR)[-1].count('\n'), 1)
        self.assertIn('majorant: ', text.split(CLEAR)[-1])

    def test_progress_never_decreases(self):
        """A surface that is cut again is shown as another pass at the same stage. Finished charts are shown as a
        fraction."""
        points, faces = torus(36, 24, 0)
        mesh = self.write('torus.obj', obj_text(points, faces))
        *live, _ = self.printed('unwrap', mesh, self.path('a.obj'), '--max-stretch', '1.0005', '--fill', '0').split(CLEAR)
        shown = self.lines_of(live)
        Log.check_never_backwards(self, shown)
        again = [line for line in shown if line['pass']]
        self.assertTrue(again, live)
        self.assertIn('cutting', {line['activity'] for line in again})
        self.assertGreaterEqual(min(int(line['stage']) for line in again), 3)
        self.assertTrue(any(0 < int(line['share'] or 0) for line in shown), live)

    def test_the_line_fits_a_narrow_terminal(self):
        """The line is cut off at the width of the terminal."""
        for columns in (40, 20):
            *live, _ = self.printed('unwrap', generated('cap'), self.path('a.obj'), columns=columns).split(CLEAR)
            self.assertTrue(live)
            self.assertLess(max(map(len, live)), columns)

    def test_quiet(self):
        self.assertEqual(self.printed('parametrize', generated('cap'), self.path('a.vtu'), '--quiet'),
                         '')


if __name__ == '__main__':
    main()
