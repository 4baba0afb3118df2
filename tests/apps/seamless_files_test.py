# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Seams and cones in files: OBJ, SVG, conversions, info."""
import json

from seamless_helpers import *


class SeamlessFiles(SeamlessTest):
    def test_obj_keeps_the_mesh(self):
        groups = [(0, 'top'), (9, 'rest')]
        mesh = cube(3)
        path = self.write('grouped.obj', textured_obj(*mesh, groups=groups))
        out = self.path('out.obj')
        self.run_ok('parametrize', '--quiet', path, '--seamless', '--degree', '1', '-o', out)
        v, vt, faces, texture = read_obj(out)
        self.assertEqual(v, mesh[0])
        self.assertEqual(faces, mesh[1])
        self.assertEqual(len(vt), 6 * 16)
        text = without_mark(self.read('out.obj')).decode()
        self.assertIn('g top', text)
        comments = [line for line in text.splitlines() if line.startswith('# cone vertex')]
        self.assertEqual(len(comments), 8)
        self.assertEqual({c.split(' quarter_turns ')[1] for c in comments}, {'3'})
        self.assertTrue(text.startswith('# cone'))
        self.run_ok('parametrize', '--quiet', path, '--seamless', '--degree', '2', '-o', out)
        v, vt, faces, texture = read_obj(out)
        self.assertEqual(v[:len(mesh[0])], mesh[0])
        edges = {}
        for face in faces:
            for a, b in zip(face, face[1:] + face[:1]):
                edges[(a, b)] = edges.get((a, b), 0) + 1
        self.assertTrue(all(count == 1 and (b, a) in edges for (a, b), count in edges.items()))
        self.assertEqual(self.read('out.obj').decode().count('\ng '), 2)
        self.run_ok('check', out, '--seamless')

    def test_convert_keeps_seams(self):
        for name, path in self.results.items():
            self.run_ok('convert', path, '-o', self.path('again.vtu'), '-o', self.path('a.svg'),
                        '-o', self.path('a.obj'))
            with open(path, 'rb') as f:
                self.assertEqual(self.read('again.vtu'), f.read())
            self.assertEqual(b'<circle' in self.read('a.svg'), name != 'torus3')
            self.assertIn(b'chains)', self.read('a.svg'))
            self.assertEqual(b'# cone vertex' in self.read('a.obj'), name != 'torus3')
        # An OBJ does not mark its seams; they are found from shared texture coordinates.
        self.run_ok('convert', self.results['cube1'].replace('.vtu', '.obj'), '-o',
                    self.path('b.vtu'), '-o', self.path('b.svg'))
        self.run_ok('check', self.path('b.vtu'), '--seamless')
        self.assertIn(b'Name="seam_edges"', self.read('b.vtu'))
        self.assertIn(b'8 cones, index &gt; 0', self.read('b.svg'))
        self.assertIn(b'seams (12 chains)', self.read('b.svg'))

    def test_grid(self):
        result = self.results['cube2']
        lines = {}
        for name, grid in (('none', []), ('auto', ['--grid']), ('one', ['--grid', '1']),
                           ('half', ['--grid', '0.5'])):
            svg = self.path(name + '.svg')
            self.run_ok('convert', result, '-o', svg, *grid)
            text = self.read(name + '.svg').decode()
            match = re.search(r'clip-path="url\(#layout\)">\s*<path[^>]* d="([^"]*)"', text)
            lines[name] = len(re.findall('[mM]', match.group(1))) if match else 0
            self.assertEqual('>grid ' in text, name != 'none')
        uv = Vtu(result).rows('uv')
        for name, spacing in (('one', 1), ('half', 0.5)):
            expected = sum(math.floor(max(c) / spacing) - math.ceil(min(c) / spacing) + 1
                           for c in zip(*uv))
            self.assertEqual(lines[name], expected)
        self.assertEqual(lines['none'], 0)
        self.assertGreaterEqual(lines['auto'], 32)
        for wrong in ('0', '-1', 'nan', 'inf', 'x.svg'):
            self.refused(USAGE, 'convert', result, '-o', self.path('x.svg'), '--grid=' + wrong,
                         says='--grid')
        self.refused(USAGE, 'convert', result, '-o', self.path('x.svg'), '--grid', '1e-9',
                     says='spacing')

    def test_info(self):
        report = self.path('info.json')
        out = self.run_ok('info', self.meshes['cube'], '--report', report).out
        self.assertIn('texture: seamless, 8 cones, 12 chains of 48 seam edges', out)
        self.assertIn('parametrize --seamless can run', out)
        with open(report) as f:
            texture = json.load(f)['result']['texture']
        self.assertTrue(texture['seamless'])
        self.assertEqual(len(texture['cones']), 8)
        points, faces, coordinates, charts = triangles(cube(4))
        coordinates[7] = (coordinates[7][0] + 0.01, coordinates[7][1])
        coordinates[1] = (coordinates[1][0] + 0.01, coordinates[1][1])
        path = self.write('bad.obj', textured_obj(points, faces, coordinates, charts))
        out = self.run_ok('info', path).out
        self.assertIn('texture: not seamless: ', out)
        self.refused(UNSUPPORTED, 'parametrize', path, '--seamless', '-o', self.path('o.vtu'),
                     says='edge (')


if __name__ == '__main__':
    main()
