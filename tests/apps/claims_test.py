# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Claims that are no claims: `check` exits 2 and names the file and the claim, whatever they say."""
import re

from command_helpers import *

POINT = [0.0, 0.0]
# What stands in majorant_claims, and what the message must say of it.
WRONG = [
    ('not JSON', 'broken JSON'),
    ('[1, 2]', 'not a JSON object'),
    ('{"degree": 3', 'broken JSON'),
    ('{"value": 1e999}', 'out of the range'),
    ('[' * 200000, 'nested too deeply'),
    ('{"pins": ' * 200000 + '1' + '}' * 200000, 'nested too deeply'),
] + [('{"%s": %s}' % (key, json.dumps(value)), key) for key, value in [
    ('version', 1), ('energy', 3), ('energy', ['mips']),
    ('degree', '3'), ('degree', 0), ('degree', 2.5), ('degree', 2**31), ('degree', 2**63),
    ('degree', -2**31), ('value', 'high'), ('value', [4]), ('boundary', 7), ('boundary', 'open'),
    ('init', True), ('seams', 'no'), ('bijective', 1), ('other_triangles', 'false'),
    ('aligned', True), ('aligned', {}), ('aligned', {'direction': [0, 1, 0]}),
    ('aligned', {'direction': [0.6, 0.9]}), ('aligned', {'direction': [0, 0]}),
    ('normalized', True), ('normalized', {}), ('normalized', {'origin': POINT}),
    ('normalized', {'origin': POINT, 'size': 0}), ('normalized', {'origin': [0], 'size': 1}),
    ('normalized', {'origin': [0, 'x'], 'size': 1}), ('normalized', {'origin': POINT, 'size': -1}),
    ('pins', {}), ('pins', [3]), ('pins', [{'vertex': 0}]), ('pins', [{'target': POINT}]),
    ('pins', [{'vertex': 1e20, 'target': POINT}]), ('pins', [{'vertex': -1, 'target': POINT}]),
    ('pins', [{'vertex': 2**64 - 1, 'target': POINT}]), ('pins', [{'vertex': 0, 'target': [1]}]),
    ('pins', [{'vertex': 0, 'target': 'initial'}]), ('pins', [{'vertex': '0', 'target': POINT}]),
    ('cones', 4), ('cones', [{'vertex': 0}]), ('cones', [{'vertex': 0, 'quarter_turns': 0}]),
    ('cones', [{'vertex': 0, 'quarter_turns': 1.5}]),
    ('cones', [{'vertex': 2**31, 'quarter_turns': 3}]),
    ('options', 'none'), ('options', {'seamless': 'yes'})]]


class Claims(CommandTest):
    def setUp(self):
        super().setUp()
        self.mesh = self.write('tri.obj', obj_text([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]))
        self.run_ok('parametrize', '--quiet', self.mesh, '-o', self.path('map.vtu'), '--degree', '1')

    def with_claims(self, text):
        array = ' '.join(map(str, text.encode()))
        vtu = re.sub(r'(Name="majorant_claims"[^>]*>\n).*?(\n</DataArray>)',
                     lambda m: m.group(1) + array + m.group(2), self.read('map.vtu').decode(),
                     flags=re.S)
        return self.write('claims.vtu', vtu)

    def test_claims_that_are_none(self):
        for text, says in WRONG:
            with self.subTest(claims=text[:60]):
                path = self.with_claims(text)
                self.refused(UNREADABLE, 'check', path, says=[path, 'majorant_claims', says])
                self.refused(UNREADABLE, 'check', path, '--surface', self.mesh, says=[path, says])

    def test_claims_that_say_little(self):
        for text in ['{}', '{"comment": [[[["deep"]]]]}', '{"normalized": null}',
                     '{"pins": [], "cones": [], "options": {"new": 1}}', '{"seams": false}']:
            with self.subTest(claims=text):
                self.run_ok('check', self.with_claims(text))

    def test_pins_far_outside(self):
        path = self.with_claims('{"pins": [{"vertex": 2147483647, "target": [0, 0]}]}')
        self.found(path, says='pin of vertex 2147483647')


if __name__ == '__main__':
    main()
