# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Numbers beyond the range of doubles, or not numbers: they are refused with exit code 1 on the command line and 2
or 3 in files, with a line that names the place and without an output."""
import math

from command_helpers import *

MESH = generated('wavy_disk')
POSITIVE = {'--soft', '--tolerance'}
OPTIONS = {
    'parametrize': ['--soft', '--tolerance', '--time-limit', '--max-iterations', '--degree', '--quadrature',
                    '--threads', '--refine', '--grid'],
    'seamless': ['--soft', '--tolerance', '--time-limit', '--max-iterations', '--curvature-alignment', '--degree'],
    'deform': ['--soft', '--tolerance', '--time-limit', '--max-iterations', '--degree', '--grid'],
    'compare': ['--soft', '--tolerance', '--time-limit', '--max-iterations', '--degree', '--quadrature'],
    'convert': ['--refine', '--grid'],
}


class Numbers(CommandTest):
    def test_options(self):
        for verb, options in OPTIONS.items():
            for option in options:
                bad = ['nan', '-nan', 'inf', '-inf', '1e999', '-1', 'one'] + ['0'] * (option in POSITIVE)
                for value in bad:
                    with self.subTest(verb=verb, option=option, value=value):
                        self.refused(USAGE, verb, MESH, '-o', self.path('out.svg' if verb != 'compare' else 'o.csv'),
                                     option + '=' + value, says=option)
        self.assertEqual(self.files(), [])

    def test_weights_of_energies(self):
        for weight in ('1e308', '1e31', '1e-31', '1e-308', 'nan', 'inf', '0', '-1'):
            for energy in (weight + '*mips', 'symmetric-dirichlet + %s*asap' % weight):
                self.refused(USAGE, 'parametrize', MESH, '-o', self.path('out.vtu'), '--energy', energy,
                             says=['--energy', weight])
        for option, value in (('--soft', '1e31'), ('--curvature-alignment', '1e200')):
            self.refused(USAGE, 'seamless', MESH, '-o', self.path('out.vtu'), option, value, says=option)
        self.assertEqual(self.files(), [])

    def test_weights_of_faces(self):
        faces = 486
        for weight in ('1e308', '1e292', '1e-300', '1e31'):
            lines = ['1'] * faces
            lines[7] = weight
            path = self.write('weights.txt', '\n'.join(lines) + '\n')
            self.refused(UNREADABLE, 'parametrize', MESH, '-o', self.path('out.vtu'), '--weights', path,
                         says=['weights.txt:8:'])
        self.assertEqual(self.files(), ['weights.txt'])

    def targets(self, value):
        return self.write('points.json', json.dumps(
            {'handles': [{'vertex': 0, 'target': [value, 0]}, {'vertex': 9, 'target': 'initial'}]}))

    def test_targets(self):
        for value in (1e300, -1e300, 1e160, 1e31):
            for option in ('--handles', '--pins'):
                self.refused(UNSUPPORTED, 'parametrize', MESH, '-o', self.path('out.vtu'), option,
                             self.targets(value), says=['vertex 0', MESH])
        self.assertEqual(self.files(), ['points.json'])

    def test_large_numbers_within_the_range(self):
        report = self.path('report.json')
        weights = self.write('weights.txt', '\n'.join(['1e30', '1e-30'] * 243) + '\n')
        for options in (['--handles', self.targets(1e6)], ['--weights', weights], ['--energy', '1e30*mips'],
                        ['--energy', '1e-30*mips + 1e30*arap', '--weights', weights]):
            with self.subTest(options=options):
                self.run_ok('parametrize', MESH, '-o', self.path('out.vtu'), '--degree', '1', '--max-iterations',
                            '3', '--report', report, *options, code=LIMIT)
                with open(report) as f:
                    result = json.load(f)['result']
                for key in ('value', 'initial_value', 'value_quadrature', 'newton_decrement', 'handle_distance'):
                    self.assertTrue(math.isfinite(result[key]), key)
                self.run_ok('check', self.path('out.vtu'))

    def test_files_that_nest_without_end(self):
        for text in ('[' * 200000, '{"handles": ' + '[' * 100000 + ']' * 100000 + '}', '{"a":' * 100000):
            path = self.write('deep.json', text)
            for verb, option in (('parametrize', '--pins'), ('parametrize', '--handles'), ('seamless', '--cones')):
                self.refused(UNREADABLE, verb, MESH, '-o', self.path('out.vtu'), option, path,
                             says=['deep.json', 'nested too deeply'])


if __name__ == '__main__':
    main()
