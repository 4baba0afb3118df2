# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Malformed claims: `check` exits with 2, naming the file and the claim."""
import re

from command_helpers import *

POINT = [0.0, 0.0]
# Contents of majorant_claims, and the expected messages.
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

    def test_damaged_claims_are_refused(self):
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


def ascii_vtu(points, uv, faces, charts, claims, input_face=()):
    def array(kind, name, values, components=1, more=''):
        return '<DataArray type="%s" Name="%s" NumberOfComponents="%d"%s format="ascii">\n%s\n</DataArray>\n' % (
            kind, name, components, more, ' '.join(map(repr, values)))
    flat = [v for face in faces for v in face]
    text = json.dumps(claims).encode()
    printed = ''.join(['<FieldData>\n<DataArray type="UInt8" Name="majorant_claims" NumberOfTuples="%d" format="ascii">\n' %
                    len(text), ' '.join(map(str, text)), '\n</DataArray>\n</FieldData>\n'])
    cell_data = array('Int32', 'input_face', input_face or range(len(faces)))
    if charts:
        cell_data += array('Int32', 'chart', charts)
    return ''.join([
        '<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="2.2" byte_order="LittleEndian" '
        'header_type="UInt64">\n<UnstructuredGrid>\n', printed,
        '<Piece NumberOfPoints="%d" NumberOfCells="%d">\n<PointData TCoords="uv">\n' % (len(points), len(faces)),
        array('Float64', 'uv', [float(x) for p in uv for x in p], 2),
        array('Int32', 'input_vertex', range(len(points))), '</PointData>\n<CellData>\n', cell_data,
        '</CellData>\n<Points>\n', array('Float64', 'Points', [float(x) for p in points for x in p], 3),
        '</Points>\n<Cells>\n', array('Int64', 'connectivity', flat),
        array('Int64', 'offsets', [3 * k + 3 for k in range(len(faces))]), array('UInt8', 'types', [5] * len(faces)),
        '</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n'])


class FalseClaims(CommandTest):
    """Each array and claim is proven, or is a violation."""
    # Two separate squares of two triangles each.
    POINTS = [(x + 3 * k, y, 0) for k in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
    FACES = [(0, 1, 2), (0, 2, 3), (4, 5, 6), (4, 6, 7)]

    def vtu(self, charts=(0, 0, 1, 1), **claims):
        uv = [p[:2] for p in self.POINTS]
        return self.write('claims.vtu', ascii_vtu(self.POINTS, uv, self.FACES, charts, {'version': '0.1.0', **claims}))

    def surface(self, names):
        lines = ['v %r %r %r' % p for p in self.POINTS]
        for name, faces in zip(names, (self.FACES[:2], self.FACES[2:])):
            lines += ['o ' + name] * bool(name) + ['f ' + ' '.join(str(v + 1) for v in f) for f in faces]
        return self.write('surface.obj', '\n'.join(lines) + '\n')

    @staticmethod
    def objects(*charts):
        return [{'name': 'o%d' % k, 'charts': n} for k, n in enumerate(charts)]

    def test_true_ones(self):
        for charts in ((0, 0, 1, 1), (1, 1, 0, 0), ()):
            self.run_ok('check', self.vtu(charts), '--certify')
        self.run_ok('check', self.vtu(objects=self.objects(1, 1), cuts=[]), '--certify', '--objects', 'separate',
                    '--surface', self.surface(['o0', 'o1']))
        self.run_ok('check', self.vtu(objects=self.objects(2)), '--surface', self.surface(['o0', '']))

    def test_charts_that_continuity_does_not_make(self):
        self.found(self.vtu((0, 1, 2, 2)), says='cell 1 is said to be of chart 1, and is of chart 0: no cut')
        self.found(self.vtu((0, 0, 0, 0)), says='chart 0 is in several pieces')
        self.found(self.vtu((0, 1, 2, 2), objects=self.objects(1, 2)), '--certify', '--objects', 'separate',
                   says='no cut divides them')

    def test_objects(self):
        for charts in ((1, 1, 1), (1,), (0, 1)):
            self.found(self.vtu(objects=self.objects(*charts)), says='objects are claimed to have %d chart' % sum(charts))
        claimed = self.vtu(objects=self.objects(1, 1))
        self.found(claimed, '--surface', self.surface(['o0', '']), says='surface has 1')
        self.found(claimed, '--surface', self.surface(['o0', 'other']), says="of object 'o1', and is of 'other'")
        self.found(claimed, '--surface', self.surface(['o1', 'o0']), says="of object 'o0', and is of 'o1'")

    def test_cuts(self):
        for edge in ((0, 2), (0, 1), (1, 4), (0, 77)):  # inner edges, a border edge, no edge
            self.found(self.vtu(cuts=[edge]), says='edge (%d, %d) is claimed to be cut, and is not' % edge)

    def test_other_triangles(self):
        points = self.POINTS[:4]
        flat = points + [(2, 0, 0), (2, 1, 0)]
        faces = [(0, 1, 3), (1, 2, 3), (1, 4, 5), (1, 5, 2)]
        mesh = self.write('surface.obj', obj_text(flat, [(0, 1, 2), (0, 2, 3), (1, 4, 5), (1, 5, 2)]))
        for printed, code in ((True, OK), (False, INVALID)):
            path = self.write('claims.vtu', ascii_vtu(flat, [p[:2] for p in flat], faces, (),
                                                      {'version': '0.1.0', 'other_triangles': printed}))
            self.run_ok('check', path, '--surface', mesh, code=code)

    def test_other_triangles_that_are_the_surfaces(self):
        names = ['', '']
        for printed in (True, False):
            self.run_ok('check', self.vtu(other_triangles=printed), '--surface', self.surface(names),
                        code=INVALID if printed else OK)
        self.found(self.vtu(other_triangles=True), '--surface', self.surface(names), says='and none is')
        # The triangles of a polygon are not its own.
        squares = self.write('squares.obj', obj_text(self.POINTS, [(0, 1, 2, 3), (4, 5, 6, 7)]))
        cells = ascii_vtu(self.POINTS, [p[:2] for p in self.POINTS], self.FACES, (),
                          {'version': '0.1.0', 'other_triangles': True}, (0, 0, 1, 1))
        self.run_ok('check', self.write('cells.vtu', cells), '--surface', squares)

    def test_missing_faces(self):
        whole = self.surface(['', ''])
        self.found(self.vtu(complete=False), '--surface', whole, says='all of the surface')
        half = ascii_vtu(self.POINTS[:4], [p[:2] for p in self.POINTS[:4]], self.FACES[:2], (),
                         {'version': '0.1.0', 'complete': False})
        self.run_ok('check', self.write('half.vtu', half), '--surface', whole)
        self.run_ok('check', self.vtu(complete=False))  # without the surface


if __name__ == '__main__':
    main()
