# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""unwrap --objects separate: a layout for every object of the file, each proven by itself."""
import json
import re

from command_helpers import *
from unwrap_helpers import *


def room():
    """Returns the text, and polygons by object: a cube before the first `o`, a sphere, a cube in two sections of one
    name."""
    parts, text, count = [(cube(2), ''), (sphere(4), 'o ball\n'), (cube(3), 'o box\n'), (cube(1), 'o lid\n'),
                          (cube(2), 'o box\n')], '', 0
    polygons = {}
    first = 0
    for k, ((points, faces), line) in enumerate(parts):
        text += line + ''.join('v %r %r %r\n' % (p[0] + 3 * k, p[1], p[2]) for p in points)
        text += ''.join('f ' + ' '.join(str(v + 1 + count) for v in f) + '\n' for f in faces)
        polygons.setdefault(line, []).extend(range(first, first + len(faces)))
        count, first = count + len(points), first + len(faces)
    return text, list(polygons.values())


class Objects(UnwrapTest):
    def setUp(self):
        super().setUp()
        text, self.objects = room()
        self.room = self.write('room.obj', text)
        self.out = self.path('out.obj')

    def separate(self, *words, **method):
        return self.run_ok('unwrap', self.room, '-o', self.out, '--objects', 'separate', '--report',
                           self.path('r.json'), *words, **method)

    def test_each_fills_the_unit_square(self):
        printed = self.separate()
        self.assertEqual(len(re.findall(r"^.*room.obj: object .*, fill 0\.\d+, no overlaps$", printed.err, re.M)), 4)
        self.assertIn('proof: majorant check %s --certify --objects separate\n' % self.out, printed.err)
        layout, report = Layout(self.out), json.loads(self.read('r.json'))
        self.assertEqual([o['name'] for o in report['objects']], ['', 'ball', 'box', 'lid'])
        for polygons, section in zip(self.objects, report['objects']):
            points = [layout.uv[t] for k in polygons for t in layout.texture[k]]
            for x in range(2):
                self.assertGreaterEqual(min(p[x] for p in points), 0)
                self.assertLessEqual(max(p[x] for p in points), layout.scale)
            side = max(max(p[x] for p in points) - min(p[x] for p in points) for x in range(2)) / layout.scale
            self.assertAlmostEqual(side, 1 - 8 / 1024, delta=0.01)  # with borders of 4 pixels
            self.assertEqual(section['status'], 'converged')
            self.assertTrue(section['result']['globally_injective'])
            self.assertEqual(sum(c['faces'] for c in section['charts']),
                             sum(len(layout.faces[k]) - 2 for k in polygons))

    def test_each_object_has_the_layout_of_a_separate_file(self):
        self.separate()
        layout = Layout(self.out)
        alone = self.write('ball.obj', obj_text(*[[(p[0] + 3, *p[1:]) for p in sphere(4)[0]], sphere(4)[1]]))
        self.run_ok('unwrap', alone, '-o', self.path('alone.obj'))
        other = Layout(self.path('alone.obj'))
        mine = [[tuple(x / layout.scale for x in layout.uv[t]) for t in layout.texture[k]] for k in self.objects[1]]
        theirs = [[tuple(x / other.scale for x in other.uv[t]) for t in other.texture[k]] for k in range(len(mine))]
        self.assertEqual(mine, theirs)

    def test_proofs(self):
        self.separate()
        printed = self.run_ok('check', self.out, '--certify', '--objects', 'separate', '--surface', self.room)
        self.assertIn('no overlaps', printed.out)
        self.found(self.out, '--certify', says='not globally injective')
        lines = self.read('out.obj').decode().splitlines()
        renamed = [('o box' if line == 'o lid' else line) for line in lines]  # an object with two layouts
        self.found(self.write('renamed.obj', '\n'.join(renamed) + '\n'), '--certify', '--objects', 'separate',
                   says='not globally injective')
        self.found(self.write('nameless.obj', '\n'.join(l for l in lines if not l.startswith('o ')) + '\n'),
                   '--certify', '--objects', 'separate', says='not globally injective')

    def test_vtu(self):
        """The claimed objects match the charts; a chart without object, and charts of another object, are detected."""
        self.separate('-o', self.path('out.vtu'))
        vtu = self.path('out.vtu')
        printed = self.run_ok('check', vtu, '--certify', '--objects', 'separate', '--surface', self.room)
        self.assertIn('no overlaps', printed.out)
        self.found(vtu, '--certify', says='not globally injective')
        file = Vtu(vtu)
        objects = file.claims['objects']
        self.assertEqual([o['name'] for o in objects], ['', 'ball', 'box', 'lid'])
        self.assertEqual(sum(o['charts'] for o in objects), max(file.arrays['chart']) + 1)
        layout = Layout(self.out)
        self.assertEqual({tuple(p[:2]) for p in file.rows('uv')},
                         {tuple(x / layout.scale for x in p) for p in layout.uv})

        def written(changed):
            file.claims['objects'] = changed
            return file.write(self.path('changed.vtu'))
        self.run_ok('check', written([{**o, 'name': 'one'} for o in objects]), '--certify', '--objects', 'separate')
        merged = [{'name': 'all', 'charts': sum(o['charts'] for o in objects)}]
        self.found(written(merged), '--certify', '--objects', 'separate', says='not globally injective')
        # The largest possible number of charts takes no time: all belong to the first object.
        forged = [{'name': str(k), 'charts': 2**31 - 1} for k in range(8)]
        self.found(written(forged), '--certify', '--objects', 'separate', says='not globally injective')
        self.refused(UNREADABLE, 'check', written(objects[:-1]), '--objects', 'separate', says='has no chart')
        self.refused(UNREADABLE, 'check', written([{'name': 'box'}]), '--objects', 'separate', says='has no "charts"')

    def test_objects_whose_vertices_are_split(self):
        """Exporters write faces without shared vertices; they are joined to one surface."""
        text, count = '', 0
        for k, n in enumerate((2, 3)):
            points, faces = cube(n)
            corners = [points[v] for face in faces for v in face]
            text += 'o %d\n' % k + ''.join('v %r %r %r\n' % (p[0] + 5 * k, p[1], p[2]) for p in corners)
            for face in faces:
                text += 'f ' + ' '.join(str(count + i + 1) for i in range(len(face))) + '\n'
                count += len(face)
        split = self.write('split.obj', text)
        self.run_ok('unwrap', split, '-o', self.out, '-o', self.path('out.vtu'), '--objects', 'separate',
                    '--fill', 0, '--report', self.path('r.json'))
        self.assertEqual([o['result']['charts'] for o in json.loads(self.read('r.json'))['objects']], [1, 1])
        for out in (self.out, self.path('out.vtu')):
            self.run_ok('check', out, '--certify', '--objects', 'separate', '--surface', split)

    def test_options_of_layouts(self):
        self.separate('--groups', '--padding', 8, '--charts', 3)
        text = self.read('out.obj').decode()
        groups = [line for line in text.splitlines() if line.startswith('g ')]
        charts = sum(len(o['charts']) for o in json.loads(self.read('r.json'))['objects'])
        self.assertEqual({line for line in groups}, {'g chart_%d' % k for k in range(charts)})

    def test_one_object(self):
        """Objects of one file get the same digits as objects in separate files."""
        points, faces = sphere(4)
        mesh = self.mesh(points, faces)
        self.run_ok('unwrap', mesh, '-o', self.path('a.obj'), '--objects', 'separate')
        self.run_ok('unwrap', mesh, '-o', self.path('b.obj'))
        self.assertEqual(self.read('a.obj'), self.read('b.obj'))

    def test_one_that_takes_nearly_all_is_named(self):
        for size, is_named in ((1, False), (9, True)):
            points, faces = both(cube(1), ([(size * x, size * y, 0) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))],
                                           [(0, 1, 2, 3)]))
            lines = ['v %r %r %r' % tuple(p) for p in points] + ['o thing']
            for k, f in enumerate(faces):
                lines += (['o ground'] if k + 1 == len(faces) else []) + ['f %d %d %d %d' % tuple(v + 1 for v in f)]
            mesh = self.write('ground.obj', '\n'.join(lines) + '\n')
            err = self.run_ok('unwrap', mesh, '-o', self.out, '--force').err
            self.assertEqual("object 'ground' takes" in err, is_named, err)

    def test_a_limit_and_a_mesh_that_is_refused(self):
        self.separate('--time-limit', 0, code=LIMIT)
        self.run_ok('check', self.out, '--certify', '--objects', 'separate', '--surface', self.room)

    def test_repairs_are_reported_by_object(self):
        text, count = '', 0
        for name, turned in (('whole', False), ('broken', True)):
            points, faces = cube(1)
            faces[0] = faces[0][::-1] if turned else faces[0]
            text += 'o %s\n' % name + ''.join('v %d %d %d\n' % (p[0] + count, p[1], p[2]) for p in points)
            text += ''.join('f ' + ' '.join(str(v + 1 + count) for v in f) + '\n' for f in faces)
            count += len(points)
        broken = self.write('b.obj', text)
        printed = self.run_ok('unwrap', broken, '-o', self.out, '--objects', 'separate')
        lines = [line for line in printed.err.splitlines() if 'turned' in line and 'fill' not in line]
        self.assertEqual(len(lines), 1, printed.err)
        self.assertIn("object 'broken'", lines[0])
        self.run_ok('check', self.out, '--certify', '--objects', 'separate', '--surface', broken)

    def test_refusals(self):
        pins = self.write('p.json', '{"handles": [{"vertex": 0, "target": [0, 0]}]}')
        for words, says in ((['--pins', pins], '--pins'), (['--udim', 2], '--udim'), (['--no-pack'], '--no-pack'),
                            (['--texel-density', 9], '--texel-density'), (['--scale', 'model'], '--scale'),
                            (['--stack', 'equal'], '--stack'), (['--degree', 2], '--degree'), (['--bake'], '--bake'),
                            (['--seams', self.write('s.json', '{"edges": [[0, 1]]}')], '--seams'),
                            (['--weld', 1e-3], '--weld')):
            self.refused(USAGE, 'unwrap', self.room, '-o', self.path('x.obj'), '--objects', 'separate', *words, says=says)
        self.refused(USAGE, 'unwrap', self.room, '-o', self.path('x.ply'), '--objects', 'separate', says='.obj, .glb')
        self.refused(USAGE, 'unwrap', self.room, '-o', self.path('x.glb'), '--objects', 'separate', says='one mesh')
        self.separate()
        self.run_ok('convert', self.out, '-o', self.path('x.vtu'))
        self.refused(USAGE, 'check', self.path('x.vtu'), '--objects', 'separate', says='.obj, .glb')


if __name__ == '__main__':
    unittest.main()
