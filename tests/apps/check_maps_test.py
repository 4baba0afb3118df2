# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""check gives every small map of tests/data/maps the verdict in its table.

The table is made with the maps and judged by tests/checker, without the library. check reads the same
digits; it also tests claims, which that checker ignores.
"""
import json

from command_helpers import *

MAPS = os.path.join(SOURCE, 'tests', 'data', 'maps')
# Good maps with false claims.
FALSE_CLAIMS = {'good/wrong_claims_1.vtu'}


class SmallMaps(CommandTest):
    def arguments(self, path, case):
        options = ['--certify' if o == '--overlap' else o for o in case['options']]
        if case['surface']:
            name = case['surface'] if case['surface'].endswith('.obj') else case['surface'] + '.obj'
            options += ['--surface', os.path.join(MAPS, 'surfaces', name)]
        if '--cuts' not in options:  # the meaning of the table
            options += ['--cuts', 'none' if case['surface'] else 'auto']
        return ['check', os.path.join(MAPS, path)] + options

    def test_every_map(self):
        with open(os.path.join(MAPS, 'index.json')) as f:
            index = json.load(f)
        self.assertGreater(len(index), 90)
        for path, case in sorted(index.items()):
            with self.subTest(path=path, why=case['why']):
                report = self.path('report.json')
                outcome = majorant(*self.arguments(path, case), '--report', report)
                good = path.startswith('good') and path not in FALSE_CLAIMS
                self.assertIn(outcome.code, (OK,) if good else (UNREADABLE, INVALID), outcome.err)
                self.assertEqual(len(outcome.printed()), 1, outcome.err)
                if outcome.code == UNREADABLE:
                    self.assertEqual(case['reason'], 'unreadable')
                    continue
                with open(report) as f:
                    data = json.load(f)
                self.assertIn(data['status'], ('valid',) if good else ('invalid', 'undecided'))
                os.remove(report)


class Claims(CommandTest):
    """False claims about properties that the file cannot show by itself."""

    def check(self, claims, *args, code=INVALID, says=''):
        self.run_ok('parametrize', '--quiet', generated('cap'), '-o', self.path('a.vtu'), '--degree',
                    '1')
        vtu = Vtu(self.path('a.vtu'))
        vtu.claims.update(claims)
        outcome = self.run_ok('check', vtu.write(self.path('b.vtu')), *args, code=code)
        self.assertIn(says, outcome.out)

    def test_cones_without_seams(self):
        self.check({'cones': [{'vertex': 40, 'quarter_turns': 3}]}, says='vertex 40')

    def test_marks_of_seams_that_are_not_there(self):
        self.run_ok('parametrize', '--quiet', generated('cap'), '-o', self.path('a.vtu'), '--degree',
                    '1')
        vtu = Vtu(self.path('a.vtu'))
        array = ('<DataArray type="Int32" Name="cone" NumberOfComponents="1" format="ascii">\n%s\n'
                 '</DataArray>\n</PointData>' % ' '.join('3' for _ in vtu.rows('uv')))
        for without in (False, True):
            text = vtu.text.replace('</PointData>', array)
            if without:  # without vertex numbers to name them
                text = re.sub(r'<DataArray type="Int32" Name="input_vertex".*?</DataArray>\n', '',
                              text, flags=re.S)
            self.found(self.write('marks.vtu', text), says='marked as a cone')

    def test_an_energy_that_overflows(self):
        self.check({'value': 1e300, 'normalized': {'origin': [0, 0], 'size': 1e300}},
                   says='inf is found')

    def test_the_boundary_of_texture_that_is_not_there(self):
        claims = {'boundary': 'fixed', 'init': 'input'}
        self.check(claims, '--surface', generated('cap'), says='a fixed boundary is claimed')
        self.check(claims, code=OK)  # no surface to compare with


class Cuts(CommandTest):
    """A fan of six triangles in the form of a C, with and without a surface, cuts allowed or not."""

    def setUp(self):
        super().setUp()
        rim = [(math.cos(a), math.sin(a)) for a in (math.pi * k / 3 for k in range(6))]
        v = [(0, 0, 0)] + [(x, y, 0.1) for x, y in rim]
        faces = [(0, k + 1, (k + 1) % 6 + 1) for k in range(6)]
        self.surface = self.write('fan.obj', obj_text(v, faces))
        vt = [(0, 0)] + [(x, y) for x, y in rim] + [(rim[0][0] + 0.1, rim[0][1] - 0.3)]
        lines = ['v %r %r %r' % p for p in v] + ['vt %r %r' % t for t in vt]
        for a, b, c in faces:
            last = 8 if c == 1 else c + 1  # the last triangle does not close the fan
            lines.append('f %d/%d %d/%d %d/%d' % (a + 1, a + 1, b + 1, b + 1, c + 1, last))
        self.torn = self.write('torn.obj', '\n'.join(lines) + '\n')

    def report(self, *args, code=OK):
        path = self.path('report.json')
        self.run_ok('check', self.torn, *args, '--report', path, code=code)
        with open(path) as f:
            return json.load(f)

    def test_none_is_for_maps_in_one_piece(self):
        for options in ([], ['--surface', self.surface], ['--surface', self.surface, '--certify']):
            self.found(self.torn, '--cuts', 'none', *options,
                         says=['not continuous', 'edge (0, 1)', '--cuts free'])
            line = self.run_ok('check', self.torn, *options).out
            self.assertIn(', 1 chart (1 cut edge, length 1.005, which may be tears)', line)

    def test_free_counts_and_lists(self):
        data = self.report('--surface', self.surface, '--cuts', 'free')
        self.assertEqual(data['result']['cuts']['other_edges'], 1)
        self.assertEqual(data['result']['cuts']['charts'], 1)
        self.assertAlmostEqual(data['result']['cuts']['length'], math.hypot(1, 0.1))
        line = self.run_ok('check', self.torn, '--surface', self.surface, '--cuts', 'free').out
        self.assertIn(', 1 chart (1 cut edge, length 1.005)', line)

    def test_the_summary_names_options_that_were_not_used(self):
        line = self.run_ok('check', self.torn).out
        self.assertIn('not tested: surface (add --surface); ', line)

    def test_proofs_are_in_the_report(self):
        data = self.report('--surface', self.surface, '--cuts', 'free', '--certify')
        self.assertEqual({q: p['answer'] for q, p in data['result']['proofs'].items()},
                         {'surface': 'proven', 'flat': 'proven', 'positive': 'proven', 'continuous': 'proven',
                          'angles': 'proven', 'injective': 'proven'})

    def test_a_limit_leaves_it_undecided(self):
        path = self.path('report.json')
        mesh = self.path('big.vtu')
        self.run_ok('parametrize', '--quiet', generated('creature'), '-o', mesh, '--degree', '2',
                    '--max-iterations', '0', code=LIMIT)
        outcome = majorant('check', mesh, '--certify', '--time-limit', '0', '--report', path)
        self.assertEqual(outcome.code, INVALID, outcome.err)
        self.assertTrue('undecided' in outcome.err or 'time limit' in outcome.err, outcome.err)


if __name__ == '__main__':
    main()
