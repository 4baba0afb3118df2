# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""-o OUT.html of every verb that makes or reads a map, and --snapshots: the content of pages."""
import base64
import json
import re
import struct

from command_helpers import (INVALID, LIMIT, OK, USAGE, CommandTest, Vtu, grid, main,
                             obj_text, torus)


class Pages(CommandTest):
    def data(self, name):
        text = self.read(name).decode()
        return json.loads(re.search(r'id="data">(.*?)</script>', text, re.S).group(1))

    def doubles(self, text):
        raw = base64.b64decode(text)
        return struct.unpack('<%dd' % (len(raw) // 8), raw)

    def bumpy(self, n=3):
        return self.write('bumpy.obj', obj_text(*grid(n)))

    # ---------------------------------------------------------------- every verb
    def test_pages_of_parametrize_hold_map_and_report(self):
        self.run_ok('parametrize', self.bumpy(), '-o', self.path('a.html'), '-o', self.path('a.vtu'),
                    '--degree', 2, '--report', self.path('a.json'))
        data, report = self.data('a.html'), json.loads(self.read('a.json'))
        self.assertEqual(data['title'], 'bumpy.obj')
        self.assertEqual((data['degree'], data['faces']), (2, 18))
        self.assertEqual(sorted(self.doubles(data['uv'])),
                         sorted(x for row in Vtu(self.path('a.vtu')).rows('uv') for x in row[:2]))
        facts = data['facts']
        self.assertEqual(facts['command'], 'parametrize')
        report['input']['file'] = 'bumpy.obj'
        for key in ('status', 'result', 'options', 'input'):
            self.assertEqual(facts[key], report[key])
        self.assertEqual([o['written'] for o in report['outputs']], [True, True])

    def test_no_folders_of_the_author(self):
        """Pages name files without their folders."""
        mesh = self.write('flat.obj', obj_text(*grid(3, lambda x, y: 0)))
        pins = self.write('p.json', '{"handles": [{"vertex": 15, "target": "initial"}]}')
        handles = self.write('h.json', '{"handles": [{"vertex": 0, "target": [-0.25, -0.125]}]}')
        page, result = self.path('a.html'), self.path('a.vtu')
        for words in (['parametrize', mesh, '-o', page, '-o', result, '--degree', 1, '--pins', pins],
                      ['deform', mesh, '-o', page, '-o', result, '--handles', handles, '--pins', pins],
                      ['unwrap', mesh, '-o', page, '-o', result, '--pins', pins],
                      ['check', result, '--surface', mesh, '-o', page],
                      ['convert', result, '-o', page],
                      ['compare', mesh, '-o', page, '--methods', 'newton', '--degree', 1]):
            self.run_ok(*words, '--force')
            self.assertNotIn(self.folder, self.read('a.html').decode(), words)
            if result in words[3:]:
                self.assertEqual(Vtu(result).claims['options']['pins'], 'p.json')
        bad = Vtu(result)
        bad.arrays['uv'][0] += 100
        bad.write(result)
        self.run_ok('check', result, '--surface', mesh, '-o', page, '--force', code=INVALID)
        self.assertNotIn(self.folder, self.read('a.html').decode())

    def test_color_range(self):
        """Pages take it, too: the scale of the quantity that is shown first."""
        mesh, page = self.bumpy(), self.path('a.html')

        def scales(*flags):
            self.run_ok('parametrize', mesh, '-o', page, '--force', *flags)
            data = self.data('a.html')
            return data['show'], {s['name']: (s['low'], s['high']) for s in data['scales']}
        shown, fixed = scales()
        self.assertIsNone(shown)
        self.assertEqual(fixed['density'], (4, 40))
        shown, ranged = scales('--color-range', '4,4.5')
        self.assertEqual(shown, 'density')
        self.assertEqual(ranged, {**fixed, 'density': (4, 4.5)})
        shown, ranged = scales('--color-range', '0.5,2', '--color-by', 'area')
        self.assertEqual(shown, 'area')
        self.assertEqual(ranged, {**fixed, 'area': (0.5, 2)})
        self.assertEqual(scales('--color-by', 'angle'), ('angle', fixed))
        outcome = self.run_ok('parametrize', mesh, '-o', page, '--force', '--color-range', '3,5', code=USAGE)
        self.assertIn('4 at isometry', outcome.err)

    def test_pins_and_handles(self):
        mesh = self.write('flat.obj', obj_text(*grid(3, lambda x, y: 0)))
        points = {'handles': [{'vertex': 0, 'target': [-0.25, -0.125]}]}
        held = {'handles': [{'vertex': 15, 'target': 'initial'}]}
        self.run_ok('deform', mesh, '-o', self.path('a.html'), '--degree', 1,
                    '--handles', self.write('h.json', json.dumps(points)),
                    '--pins', self.write('p.json', json.dumps(held)))
        points = {p['vertex']: p for p in self.data('a.html')['points']}
        self.assertEqual((points[0]['hold'], points[0]['target']), ('handle', [-0.25, -0.125]))
        self.assertEqual((points[15]['hold'], points[15]['target']), ('pin', [1, 1]))

    def test_scaffold_and_seams(self):
        self.run_ok('parametrize', self.bumpy(), '-o', self.path('a.html'), '--bijective',
                    '--write-scaffold', self.path('s.vtu'), '--degree', 2)
        self.assertEqual(self.data('a.html')['scaffold']['degree'], 2)
        closed = self.write('torus.obj', obj_text(*torus(8, 5, 0)))
        self.run_ok('seamless', closed, '-o', self.path('s.html'), '--degree', 1)
        self.assertTrue(self.data('s.html')['seam_edges'])
        self.assertEqual(self.data('s.html')['snapshots'], [])

    def test_unwrap_has_charts(self):
        closed = self.write('torus.obj', obj_text(*torus(8, 5, 0)))
        self.run_ok('unwrap', closed, '-o', self.path('a.html'), '--report', self.path('a.json'))
        data = self.data('a.html')
        self.assertEqual(data['facts']['charts'], json.loads(self.read('a.json'))['charts'])
        self.assertTrue(data['chart'])

    def test_convert(self):
        self.run_ok('parametrize', self.bumpy(), '-o', self.path('a.vtu'), '-o',
                    self.path('a.html'), '--degree', 2)
        self.run_ok('convert', self.path('a.vtu'), '-o', self.path('b.html'))
        a, b = self.data('a.html'), self.data('b.html')
        self.assertEqual((a['uv'], a['cells']), (b['uv'], b['cells']))
        self.assertEqual((b['title'], b['facts']['command'], b['facts']['status']), ('a.vtu', 'convert', 'valid'))
        self.assertEqual((b['facts']['result']['overlaps'], b['faults']), ('no overlaps', []))

    def test_converted_files_name_their_defects(self):
        """A face is turned over, as in files by other programs: the page has the finding of `check`."""
        points, faces = grid(4)
        uv = [(x + 0.6 * (k == 6), y) for k, (x, y, _) in enumerate(points)]
        self.run_ok('convert', self.write('own.obj', obj_text(points, faces, uv)), '-o', self.path('own.html'))
        data = self.data('own.html')
        self.assertEqual((data['facts']['command'], data['facts']['status']), ('convert', 'invalid'))
        self.assertTrue(data['faults'])
        self.assertTrue(data['facts']['result']['overlaps'].startswith('not decided: the map is not locally'),
                        data['facts']['result']['overlaps'])

    def test_check_shows_defects(self):
        self.run_ok('parametrize', self.bumpy(), '-o', self.path('a.vtu'), '--degree', 2)
        self.run_ok('check', self.path('a.vtu'), '-o', self.path('good.html'))
        good = self.data('good.html')
        self.assertEqual((good['facts']['status'], good['faults']), ('valid', []))
        vtu = Vtu(self.path('a.vtu'))
        vtu.arrays['uv'][vtu.components['uv'] * 5] += 10  # vertex 5 of the grid
        vtu.write(self.path('bad.vtu'))
        self.run_ok('check', self.path('bad.vtu'), '-o', self.path('bad.html'), code=INVALID)
        bad = self.data('bad.html')
        self.assertEqual(bad['facts']['status'], 'invalid')
        self.assertIn('positive', bad['facts']['result']['findings'][0])
        self.assertTrue(bad['faults'])
        self.assertTrue(any(fault['text'].startswith('turned over: det J is -')
                            for fault in bad['faults']), bad['faults'])

    # ---------------------------------------------------------------- files and refusals
    def test_hostile_names(self):
        name = '<script>alert(1)</script> & "x\'.obj'.replace('/', '_')
        mesh = self.write(name, obj_text(*grid(2)))
        self.run_ok('parametrize', mesh, '-o', self.path('a.html'), '--degree', 1)
        self.assertEqual(self.data('a.html')['title'], name)
        self.assertNotIn(b'<script>alert', self.read('a.html'))
        self.assertIn(b'&lt;script&gt;alert', self.read('a.html'))

    def test_whole_or_not_at_all(self):
        self.refused(USAGE, 'parametrize', self.bumpy(), '-o', self.path('no/a.html'),
                     says='no/a.html')
        self.write('a.html', 'old')
        invalid = self.write('closed.obj', obj_text(*torus(8, 5, 0)))
        self.refused(3, 'parametrize', invalid, '-o', self.path('a.html'))
        self.assertEqual(self.read('a.html'), b'old')

    def test_refusals_name_all_formats(self):
        for verb in ('parametrize', 'unwrap', 'convert'):
            self.refused(USAGE, verb, self.bumpy(), '-o', self.path('a.doc'), says=['.vtu', '.svg', '.html'])

    # ---------------------------------------------------------------- snapshots
    def test_runs_are_the_same_with_snapshots(self):
        mesh = self.bumpy(5)
        common = ('parametrize', mesh, '--degree', 3, '--bijective')
        self.run_ok(*common, '-o', self.path('a.vtu'), '--report', self.path('a.json'))
        self.run_ok(*common, '-o', self.path('b.vtu'), '-o', self.path('b.html'), '--snapshots', 1,
                    '--report', self.path('b.json'))
        a, b = Vtu(self.path('a.vtu')), Vtu(self.path('b.vtu'))
        self.assertEqual(a.arrays, b.arrays)
        a, b = (json.loads(self.read(name))['iterations'] for name in ('a.json', 'b.json'))
        self.assertEqual([row['energy'] for row in a], [row['energy'] for row in b])

    def test_frames(self):
        self.run_ok('parametrize', self.bumpy(5), '--degree', 3, '-o', self.path('a.html'),
                    '--snapshots', 2, '--report', self.path('a.json'))
        data, report = self.data('a.html'), json.loads(self.read('a.json'))
        rows = {row['iteration']: row for row in report['iterations']}
        frames = data['snapshots']
        last = max(rows)
        self.assertEqual([f['iteration'] for f in frames],
                         [*range(0, last, 2), last])
        self.assertEqual(frames[0]['energy'], report['result']['initial_value'])
        for frame in frames[1:-1]:
            self.assertEqual(frame['energy'], rows[frame['iteration']]['energy'])
            self.assertEqual(frame['degree'], rows[frame['iteration']]['degree'])
        self.assertEqual({frame['degree'] for frame in frames}, {1, 2, 3})
        raw = [base64.b64decode(frame['uv']) for frame in frames]
        count = len(self.doubles(data['uv']))
        self.assertEqual({len(r) for r in raw}, {4 * count})
        result = struct.pack('<%df' % count, *self.doubles(data['uv']))
        self.assertEqual(raw[-1], result)
        self.assertNotEqual(raw[0], result)
        self.assertEqual(report['snapshots'], {'every': 2, 'frames': len(frames)})

    def test_frames_in_the_unit_square(self):
        self.run_ok('parametrize', self.bumpy(5), '--degree', 1, '-o', self.path('a.html'),
                    '--snapshots', 1, '--normalize')
        frames = self.data('a.html')['snapshots']
        values = [struct.unpack('<%df' % (len(raw) // 4), raw) for raw in
                  (base64.b64decode(frame['uv']) for frame in frames)]
        moved = max(abs(x - y) for x, y in zip(values[-1], values[-2]))
        self.assertLess(moved, 0.05)  # the movement of the last step, without the normalization

    def test_a_limit_ends_the_film(self):
        flat = self.write('flat.obj', obj_text(*grid(4, lambda x, y: 0)))
        self.run_ok('deform', flat,
                    '-o', self.path('a.html'), '--handles', self.write('h.json', json.dumps(
                        {'handles': [{'vertex': 0, 'target': [-1, -1]}]})), '--snapshots', 1,
                    '--max-iterations', 3, '--degree', 1, code=LIMIT)
        self.assertGreater(len(self.data('a.html')['snapshots']), 2)

    def test_memory_is_bounded(self):
        """At most 16 MB of control points, here of 37,249; beyond that, every second frame is dropped."""
        points = [(0, [2, 2.5]), (300, [0.1, 0.9]), (624, [1, 1])]
        self.run_ok('deform', self.write('flat.obj', obj_text(*grid(24, lambda x, y: 0))),
                    '--handles', self.write('h.json', json.dumps({'handles': [
                        {'vertex': v, 'target': t} for v, t in points]})),
                    '--degree', 8, '--max-iterations', 70, '--snapshots', 1,
                    '-o', self.path('a.html'), '--report', self.path('a.json'), code=LIMIT)
        self.assertEqual(json.loads(self.read('a.json'))['snapshots'], {'every': 2, 'frames': 36})
        frames = self.data('a.html')['snapshots']
        self.assertEqual([f['iteration'] for f in frames], list(range(0, 71, 2)))
        self.assertLessEqual(sum(len(base64.b64decode(f['uv'])) for f in frames), 1 << 24)

    def test_snapshots_are_refused(self):
        mesh = self.bumpy()
        self.refused(USAGE, 'parametrize', mesh, '-o', self.path('a.vtu'), '--snapshots', 2,
                     says=['--snapshots', '.html'])
        self.refused(USAGE, 'parametrize', mesh, '-o', self.path('a.html'), '--snapshots', 2,
                     '--improve-mesh', says=['--improve-mesh', '--snapshots'])
        self.refused(USAGE, 'parametrize', mesh, '-o', self.path('a.html'), '--snapshots', 0,
                     says='--snapshots')
        self.refused(USAGE, 'unwrap', mesh, '-o', self.path('a.html'), '--snapshots', 2,
                     says='--snapshots')


if __name__ == '__main__':
    main()
