# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""What a run says it is doing: a line each in logs, one live line on a terminal."""
import os
import pty
import select
import subprocess

from command_helpers import *

CLEAR = '\r\x1b[K'


def logged(text):
    """Names of the activities that have a line of their own."""
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
        self.assertEqual(self.phases('parametrize', cap, out, '--degree', '1', '--bijective'),
                         ['reading', 'start', 'scaffold', 'solving', 'measuring', 'proving', 'writing'])
        self.assertEqual(self.phases('seamless', generated('buckle'), out, '--degree', '1',
                                     '--normalize'),
                         ['reading', 'start', 'solving', 'measuring', 'measuring', 'proving', 'writing'])
        self.assertEqual(self.phases('unwrap', generated('buckle'), self.path('a.obj')),
                         ['reading', 'cutting', 'solving', 'packing', 'proving', 'writing'])

    def test_steps_stand_between(self):
        lines = self.run_ok('parametrize', generated('cap'), self.path('a.vtu'), '--degree', '2',
                            '--verbose').err.splitlines()
        solving = next(k for k, line in enumerate(lines) if logged(line) == ['solving'])
        self.assertTrue(all(re.search('iteration', line) for line in lines[2:solving]), lines)
        self.assertGreater(solving, 2)
        self.assertIn('converged', lines[-1])

    def test_what_is_cut_again(self):
        """A second map of the same surface does not begin without a word."""
        points, faces = torus(12, 8, 0)
        mesh = self.write('torus.obj', obj_text(points, faces))
        lines = self.run_ok('unwrap', mesh, self.path('a.obj'), '--max-stretch', '1.0001').err.splitlines()
        again = [k for k, line in enumerate(lines) if re.fullmatch(r'cutting again: \d+ of \d+ charts?', line)]
        self.assertTrue(again, lines)
        self.assertEqual(logged(lines[again[0] - 1]), ['solving'])
        self.assertEqual(logged(lines[again[0] + 1]), ['cutting'])

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
    def start(self, *args):
        outer, inner = pty.openpty()
        self.addCleanup(os.close, outer)
        process = subprocess.Popen([BINARY, *map(str, args)], stderr=inner,
                                   stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
        os.close(inner)
        return process, outer

    def more(self, outer):
        """What has arrived; empty when the other end is closed."""
        self.assertTrue(select.select([outer], [], [], 120)[0], 'nothing is said any more')
        try:
            return os.read(outer, 1 << 16).decode()
        except OSError:
            return ''

    def said(self, *args, code=OK):
        process, outer = self.start(*args)
        text = ''.join(iter(lambda: self.more(outer), ''))
        self.assertEqual(process.wait(60), code, text)
        return text

    def test_the_live_line(self):
        for verb, phases in ((['parametrize', '--degree', '2'],
                              ['reading', 'start', 'solving', 'measuring', 'proving', 'writing']),
                             (['parametrize', '--bijective', '--degree', '1'],
                              ['reading', 'start', 'scaffold', 'solving', 'measuring', 'proving',
                               'writing']),
                             (['unwrap'], ['reading', 'cutting', 'solving', 'packing', 'proving', 'writing'])):
            text = self.said(*verb, generated('cap'), self.path('a.vtu'))
            *live, last = text.split(CLEAR)
            shown = [re.fullmatch(r'\[(#+)(\.*)\] (\d) of (\d) (\w+) \d+\.\d s  '
                                  r'(degree .*|(chart 1 of 1  )?iteration .*|raising the degree to 2|'
                                  r'chart 1 of 1)?', line) for line in live]
            names = [line[5] for line in shown]
            self.assertTrue(all((len(line[1]), len(line[1] + line[2])) == (int(line[3]), int(line[4]))
                                for line in shown), live)
            self.assertEqual([phases[int(line[3]) - 1] for line in shown], names)
            self.assertEqual({int(line[4]) for line in shown}, {len(phases)})
            self.assertEqual(list(dict.fromkeys(names)), phases)
            self.assertLess(max(map(len, live)), 80)
            self.assertEqual(any('raising the degree to 2' in line for line in live), '2' in verb)
            self.assertEqual(any('chart 1 of 1' in line for line in live), verb == ['unwrap'])
            self.assertEqual(logged(text), [])
            self.assertIn('converged', last)  # the line is taken away before
            self.assertTrue(last.endswith('\n'))
            self.assertNotIn('\x1b', last)
        self.assertTrue(any('iteration' in line for line in live) or verb == ['unwrap'])

    def test_the_chart_of_a_step(self):
        """Charts of 5,000 faces and more are solved one by one: their steps say which one it is."""
        points, faces = grid(52)
        moved = [(x + 9, y, z) for x, y, z in points]
        twice = faces + [tuple(v + len(points) for v in face) for face in faces]
        mesh = self.write('two.obj', obj_text(points + moved, twice))
        live = self.said('unwrap', mesh, self.path('a.obj')).split(CLEAR)
        steps = [line for line in live if 'iteration' in line]
        self.assertEqual({line.split('s  ')[1].split('  iteration')[0] for line in steps},
                         {'chart 1 of 2', 'chart 2 of 2'})
        self.assertTrue(all(re.search(r'energy \d+\.\d{3}', line) for line in steps), steps)  # 80 columns

    def test_check(self):
        self.run_ok('parametrize', generated('cap'), self.path('a.vtu'), '--degree', '2', '--quiet')
        *live, last = self.said('check', self.path('a.vtu')).split(CLEAR)
        self.assertEqual(list(dict.fromkeys(line.split()[4] for line in live)),
                         ['reading', 'proving', 'measuring'])
        self.assertEqual(last, '')  # the verdict is on stdout

    def test_it_goes_on_while_nothing_happens(self):
        """Reading from a pipe lasts as long as nobody writes: the line is shown again and again."""
        pipe = self.path('slow.obj')
        os.mkfifo(pipe)
        process, outer = self.start('parametrize', pipe, self.path('a.vtu'), '--degree', '1')
        text = ''
        while text.count('reading') < 4:
            arrived = self.more(outer)
            self.assertTrue(arrived, text)
            text += arrived
        self.assertEqual(len(set(text.split(CLEAR)[:4])), 4, text)  # the time goes on
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
        text = self.said('parametrize', closed, self.path('a.vtu'), code=UNSUPPORTED)
        self.assertEqual(text.split(CLEAR)[-1].count('\n'), 1)
        self.assertIn('majorant: ', text.split(CLEAR)[-1])

    def test_quiet(self):
        self.assertEqual(self.said('parametrize', generated('cap'), self.path('a.vtu'), '--quiet'),
                         '')


if __name__ == '__main__':
    main()
