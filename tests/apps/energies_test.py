# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Energies on the command line: names and sums, soft handles, face weights, and their judgement by check."""
import json
import math
import os

from command_helpers import *

NAMES = ('symmetric-dirichlet', 'asap', 'mips', 'arap', 'symmetric-arap', 'log-isometric', 'authalic',
         'amips-exponential')


def needs(name):
    return ['--boundary', 'fixed'] if name == 'asap' else []


def numbers(node, path=''):
    """Yields every number of a JSON document with its path."""
    if isinstance(node, dict):
        for key, value in node.items():
            yield from numbers(value, path + '/' + key)
    elif isinstance(node, list):
        for k, value in enumerate(node):
            yield from numbers(value, '%s/%d' % (path, k))
    elif isinstance(node, (int, float)) and not isinstance(node, bool):
        yield path, node


class EnergyTest(CommandTest):
    mesh = generated('cap')

    def report(self, *options, degree=1, code=OK, mesh=None):
        """Parametrizes and returns the report, read strictly (without NaN and Infinity)."""
        self.run_ok('parametrize', '--quiet', mesh or self.mesh, '-o', self.path('out.vtu'), '--degree',
                    degree, '--report', self.path('report.json'), *options, code=code)
        def refuse(text):
            self.fail('%s in the report' % text)
        with open(self.path('report.json')) as f:
            return json.load(f, parse_constant=refuse)

    def value(self, *options, **kw):
        return self.report(*options, **kw)['result']['value']

    def uv(self):
        vtu = Vtu(self.path('out.vtu'))
        rows = vtu.rows('uv')
        return {v: rows[p] for p, v in enumerate(vtu.arrays['input_vertex']) if v >= 0}

    def refuse(self, code, *options, says=()):
        outcome = self.refused(code, 'parametrize', self.mesh, '-o', self.path('out.vtu'), '--degree',
                               '1', *options, says=says)
        self.assertNotIn('out.vtu', self.files())
        return outcome


class Names(EnergyTest):
    def test_every_energy_and_its_result(self):
        for name in NAMES:
            for degree in (1, 2):
                with self.subTest(energy=name, degree=degree):
                    report = self.report('--energy', name, *needs(name), degree=degree)
                    self.assertEqual(report['status'], 'converged')
                    self.assertEqual(report['options']['energy'], name)
                    self.assertEqual(report['result']['energy'], name)
                    found = list(numbers(report))
                    self.assertGreater(len(found), 50)
                    for place, number in found:
                        self.assertTrue(math.isfinite(number), place)
                    self.assertLess(report['result']['value'], report['result']['initial_value'])
                    self.run_ok('check', '--quiet', self.path('out.vtu'), '--surface', self.mesh)

    def test_a_false_value_is_found(self):
        for name in NAMES:
            with self.subTest(energy=name):
                self.run_ok('parametrize', '--quiet', self.mesh, '-o', self.path('out.vtu'), '--degree',
                            '1', '--energy', name, *needs(name))
                for factor in (1.001, 0.999, 0):
                    vtu = Vtu(self.path('out.vtu'))
                    vtu.claims['value'] *= factor
                    bad = vtu.write(self.path('bad.vtu'))
                    self.found(bad, says=['bad.vtu', 'energy'])
                vtu = Vtu(self.path('out.vtu'))  # the value of another energy
                vtu.claims['energy'] = 'mips' if name != 'mips' else 'arap'
                self.found(vtu.write(self.path('bad.vtu')), says='energy')

    def test_a_claimed_energy_that_does_not_exist(self):
        self.run_ok('parametrize', '--quiet', self.mesh, '-o', self.path('out.vtu'), '--degree', '1')
        # Values that are no strings are malformed. null claims nothing: the energy is symmetric Dirichlet.
        for claim, code in [('no-such-energy', INVALID), ('', INVALID), ('-1*asap', INVALID),
                            (None, OK), (7, UNREADABLE), (['asap'], UNREADABLE)]:
            vtu = Vtu(self.path('out.vtu'))
            vtu.claims['energy'] = claim
            with self.subTest(claim=claim):
                outcome = majorant('check', vtu.write(self.path('bad.vtu')))
                self.assertEqual(outcome.code, code, outcome.err)
                self.assertEqual(len(outcome.printed()), 1, outcome.err)

    def test_help_lists_every_name(self):
        text = majorant('parametrize', '--help').out
        for name in NAMES:
            self.assertIn('\n  %s ' % name, text)

    def test_unknown_energies_are_refused(self):
        for bad in ('dirichlet', 'asap+', '+asap', 'mips++asap', 'Mips', 'mips,asap',
                    '2*', 'asap-mips', '2*3*mips', 'mips + nothing'):
            with self.subTest(energy=bad):
                outcome = self.refuse(USAGE, '--energy', bad, says="'%s'" % bad)
                for name in NAMES:
                    self.assertIn(name, outcome.err)

    def test_invalid_weights_are_refused(self):
        for bad in ('*asap', '-1*asap', '0*asap', 'nan*asap', 'inf*asap', '1e400*asap', 'asap*2',
                    'x*asap', '1..2*asap', '0x10*asap', 'mips + -1*asap', '1e-400*mips'):
            with self.subTest(energy=bad):
                self.refuse(USAGE, '--energy', bad, says=["'%s'" % bad, 'positive number'])

    def test_unknown_energies_are_refused_before_the_mesh_is_read(self):
        self.refused(USAGE, 'parametrize', self.path('none.obj'), '-o', self.path('out.vtu'),
                     '--energy', 'nothing', says='nothing')


class Sums(EnergyTest):
    def test_spelling_does_not_matter(self):
        values = [self.value('--energy', text)
                  for text in ('symmetric-dirichlet+0.1*asap', 'symmetric-dirichlet + 0.1*asap',
                               ' symmetric-dirichlet  +  0.1 * asap ', '1*symmetric-dirichlet+1e-1*asap',
                               '0.1E+0*asap+symmetric-dirichlet')]
        for value in values:
            self.assertAlmostEqual(value, values[0], delta=1e-7 * values[0])
        self.assertGreater(values[0], self.value() + 1e-4)

    def test_exponents(self):
        plain = self.value('--energy', 'symmetric-dirichlet')
        small = self.value('--energy', 'symmetric-dirichlet+1e-3*asap')
        large = self.value('--energy', 'symmetric-dirichlet + 1e+1*asap')
        self.assertLess(plain, small)
        self.assertLess(small, plain * 1.01)
        self.assertLess(small, large)

    def test_the_value_is_the_sum(self):
        # A multiple of an energy has the same minimizer.
        plain, twice = self.value('--energy', 'mips'), self.value('--energy', '2*mips')
        self.assertAlmostEqual(twice, 2 * plain, delta=1e-5 * twice)
        both = self.value('--energy', 'mips+mips')
        self.assertAlmostEqual(both, twice, delta=1e-5 * twice)

    def test_check_knows_sums(self):
        self.report('--energy', 'arap + 0.5*mips', degree=2)
        self.run_ok('check', self.path('out.vtu'), '--surface', self.mesh)
        vtu = Vtu(self.path('out.vtu'))
        vtu.claims['energy'] = 'arap + 0.6*mips'
        self.found(vtu.write(self.path('bad.vtu')), says='energy')


class Scale(EnergyTest):
    def pins(self, *vertices):
        return self.write('pins.json', json.dumps(
            {'handles': [{'vertex': v, 'target': 'initial'} for v in vertices]}))

    def test_collapse_is_refused_with_a_remedy(self):
        for energy in ('asap', '2*asap', 'asap + mips', 'mips+1e-3*asap', 'asap+asap'):
            for hold in ([], ['--pins', self.pins(100)], ['--handles', self.pins(100)]):
                with self.subTest(energy=energy, hold=hold):
                    self.refuse(USAGE, '--energy', energy, *hold,
                                says=['--boundary fixed', 'two pins'])

    def test_two_points_at_one_place_hold_nothing(self):
        handles = self.write('handles.json', json.dumps(
            {'handles': [{'vertex': v, 'target': [1, 2]} for v in (100, 150)]}))
        self.refuse(USAGE, '--energy', 'asap', '--handles', handles, says=['two pins'])

    def test_a_closed_surface_has_no_boundary_to_fix(self):
        torus_file = self.write('torus.obj', obj_text(*torus(8, 6, 0)))
        self.run_ok('seamless', '--quiet', torus_file, '-o', self.path('map.obj'), '--degree', '1')
        self.refused(USAGE, 'parametrize', self.path('map.obj'), '-o', self.path('out.vtu'),
                     '--seamless', '--boundary', 'fixed', '--energy', 'asap', says='shrunk')

    def test_a_boundary_or_two_points_fix_the_scale(self):
        for hold in (['--boundary', 'fixed'], ['--pins', self.pins(100, 150)],
                     ['--handles', self.pins(100, 150)]):
            with self.subTest(hold=hold):
                report = self.report('--energy', 'asap', *hold)
                self.assertEqual(report['status'], 'converged')
                self.assertTrue(report['result']['locally_injective'])
                self.run_ok('check', '--quiet', self.path('out.vtu'), '--surface', self.mesh)
        self.report('--energy', 'asap+0.01*arap')  # another energy determines the scale
        self.report('--energy', 'mips')            # does not determine the scale, but does not collapse

    def test_curvatures(self):
        offered = {'majorizer': {'symmetric-dirichlet', 'asap', 'mips', 'arap', 'symmetric-arap'},
                   'paper-majorizer': {'symmetric-dirichlet', 'asap', 'arap', 'symmetric-arap'},
                   'reweighted': {'symmetric-dirichlet', 'arap', 'symmetric-arap', 'log-isometric'},
                   'exact': set(NAMES)}
        for curvature, names in offered.items():
            for name in NAMES:
                with self.subTest(curvature=curvature, energy=name):
                    options = ['--energy', name, '--curvature', curvature, *needs(name)]
                    if name in names:
                        self.report(*options)
                        os.remove(self.path('out.vtu'))
                    else:
                        self.refuse(USAGE, *options, says=[name, curvature, 'projected'])
        # One summand without the model suffices.
        self.refuse(USAGE, '--energy', 'arap+mips', '--curvature', 'reweighted', says='mips')


class Handles(EnergyTest):
    def handles(self, *targets, name='handles.json'):
        return self.write(name, json.dumps(
            {'handles': [{'vertex': v, 'target': t} for v, t in targets]}))

    def test_the_distance_is_reported(self):
        self.report()
        start = self.uv()
        targets = [(v, [start[v][0] + dx, start[v][1] + dy])
                   for v, dx, dy in ((100, 0.1, 0), (150, 0, -0.2))]
        distances = []
        for weight in ('1e2', '1e4', '1e6'):
            report = self.report('--handles', self.handles(*targets), '--soft', weight)
            moved = self.uv()
            distance = max(math.dist(moved[v], t) for v, t in targets)
            self.assertAlmostEqual(report['result']['handle_distance'], distance, delta=1e-12)
            self.assertEqual(report['options']['soft'], float(weight))
            distances.append(distance)
            self.run_ok('check', '--quiet', self.path('out.vtu'), '--surface', self.mesh)
        self.assertLess(distances[1], 0.2 * distances[0])
        self.assertAlmostEqual(distances[2] / distances[1], 0.01, delta=0.002)

    def test_the_default_weight(self):
        self.report()
        u, v = self.uv()[100]
        handles = self.handles((100, [u + 0.1, v]), (150, 'initial'))
        default = self.report('--handles', handles)['result']['handle_distance']
        self.assertEqual(self.report('--handles', handles, '--soft', '1000')['result']['handle_distance'],
                         default)
        self.assertNotEqual(self.report('--handles', handles, '--soft', '10')['result']
                            ['handle_distance'], default)

    def test_no_handles_no_distance(self):
        self.assertEqual(self.report()['result']['handle_distance'], 0)

    def test_initial_targets(self):
        # One handle at the start only fixes the position; the energy does not change.
        free = self.value()
        report = self.report('--handles', self.handles((100, 'initial')))
        self.assertAlmostEqual(report['result']['value'], free, delta=1e-5 * free)
        self.assertLess(report['result']['handle_distance'], 1e-6)

    def test_pins_and_handles(self):
        pins = self.handles((100, 'initial'), name='pins.json')
        self.refuse(UNSUPPORTED, '--pins', pins, '--handles', self.handles((100, 'initial')),
                    says=['vertex 100', 'pin', 'handle'])
        report = self.report('--pins', pins, '--handles', self.handles((150, [0, 0])))
        self.assertGreater(report['result']['handle_distance'], 0)

    def test_bad_handles(self):
        for name, text in {'text.json': 'handles', 'range.json':
                           '{"handles": [{"vertex": 100000, "target": "initial"}]}',
                           'one.json': '{"handles": [{"vertex": 1, "target": [1]}]}'}.items():
            self.refuse(UNREADABLE, '--handles', self.write(name, text), says=name)
        self.refuse(UNREADABLE, '--handles', self.path('missing.json'), says='missing.json')
        for weight in ('0', '-1', 'nan', 'inf', 'heavy'):
            with self.subTest(soft=weight):
                self.refuse(USAGE, '--handles', self.handles((100, 'initial')), '--soft', weight)
        self.refuse(USAGE, '--handles', self.handles((100, 'initial')), '--normalize')


class Weights(EnergyTest):
    faces = 486

    def weights(self, *values):
        return self.write('weights.txt', '\n'.join(map(str, values)) + '\n')

    def test_weights_of_one_change_nothing(self):
        plain = self.report(degree=2)
        before = Vtu(self.path('out.vtu')).rows('uv')
        ones = self.report('--weights', self.weights(*[1] * self.faces), degree=2)
        self.assertEqual(ones['result']['value'], plain['result']['value'])
        self.assertEqual(Vtu(self.path('out.vtu')).rows('uv'), before)
        spaced = self.write('spaced.txt', ' '.join(['1'] * self.faces))
        self.assertEqual(self.value('--weights', spaced, degree=2), plain['result']['value'])

    def test_heavy_faces_are_less_distorted(self):
        def mean(values):
            return sum(values) / len(values)
        heavy = range(200, 260)
        self.report()
        before = Vtu(self.path('out.vtu'))
        self.report('--weights', self.weights(*[200 if k in heavy else 1 for k in range(self.faces)]))
        after = Vtu(self.path('out.vtu'))
        faces = [k for k, f in enumerate(before.arrays['input_face']) if f in heavy]
        self.assertEqual(len(faces), 60)
        self.assertLess(mean([after.arrays['distortion'][k] for k in faces]) - 4,
                        0.9 * (mean([before.arrays['distortion'][k] for k in faces]) - 4))
        self.run_ok('check', '--quiet', self.path('out.vtu'), '--surface', self.mesh)

    def test_polygons_keep_their_weight(self):
        # There is one number for each polygon of the file, not for its triangles.
        quad = self.write('quads.obj', obj_text(*quads(4)))
        self.report('--weights', self.weights(*range(1, 17)), mesh=quad)
        self.refused(UNREADABLE, 'parametrize', quad, '-o', self.path('other.vtu'), '--weights',
                     self.weights(*range(1, 33)), says='16')

    def test_bad_files(self):
        good = ['1'] * self.faces
        cases = {'few.txt': (good[:-1], ['485', '486']), 'many.txt': (good + ['1'], [':487:', '486']),
                 'empty.txt': ([], ['486'])}
        for bad in ('-1', '0', 'one', 'nan', 'inf', '1e400', '1,5', ''):
            lines = list(good)
            lines[41] = bad
            expected = ['485'] if bad == '' else [':42:']
            cases['bad%d.txt' % len(cases)] = (lines, expected)
        for name, (lines, expected) in cases.items():
            path = self.write(name, '\n'.join(lines) + '\n')
            with self.subTest(file=name, line42=lines[41] if len(lines) > 41 else None):
                self.refuse(UNREADABLE, '--weights', path, says=[name] + expected)
        self.refuse(UNREADABLE, '--weights', self.path('missing.txt'), says='missing.txt')
        self.refuse(UNREADABLE, '--weights', self.write('binary.txt', bytes(range(256))),
                    says='binary.txt')


if __name__ == '__main__':
    main()
