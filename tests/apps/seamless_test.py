"""Maps of cut surfaces: parametrize --seamless, check, and what files say of seams and cones."""
import json
import os
import subprocess

from command_helpers import *

SIDES = [((0, 0, 1), (1, 0, 0), (0, 1, 0)), ((0, 0, 0), (0, 1, 0), (1, 0, 0)),
         ((0, 0, 0), (1, 0, 0), (0, 0, 1)), ((0, 1, 0), (0, 0, 1), (1, 0, 0)),
         ((0, 0, 0), (0, 0, 1), (0, 1, 0)), ((1, 0, 0), (0, 1, 0), (0, 0, 1))]


def cube(n, sides=6, round_off=0.5):
    """A rounded box of n x n quads a side, each side a chart of its own: seams along all its edges.
    v, quads of v, vt, quads of vt; corners of the box are vertices with three quads."""
    numbers, points, faces, texture, charts = {}, [], [], [], []

    def vertex(p):
        if p not in numbers:
            numbers[p] = len(points)
            q = [2 * c / n - 1 for c in p]
            length = math.sqrt(sum(c * c for c in q))
            points.append(tuple(c * (1 - round_off + round_off * 1.3 / length) for c in q))
        return numbers[p]

    for s, (origin, e, f) in enumerate(SIDES[:sides]):
        base = len(texture)
        texture += [((i + s * (n + 2)) * 2 / n, j * 2 / n) for j in range(n + 1)
                    for i in range(n + 1)]
        for j in range(n):
            for i in range(n):
                square = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                faces.append(tuple(vertex(tuple(n * o + a * x + b * y for o, x, y in
                                                zip(origin, e, f))) for a, b in square))
                charts.append(tuple(base + b * (n + 1) + a for a, b in square))
    return points, faces, texture, charts


def torus_map(m, n):
    """A torus cut along two loops, unrolled; translations only, no cones."""
    points, faces = torus(m, n, 0)
    texture = [(12 * i / m, 6 * j / n) for j in range(n + 1) for i in range(m + 1)]
    charts = []
    for q in range(m * n):
        a = q // m * (m + 1) + q % m
        charts += [(a, a + 1, a + m + 2), (a, a + m + 2, a + m + 1)]
    return points, faces, texture, charts


def triangles(mesh):
    points, faces, texture, charts = mesh
    split = [[(q[0], q[1], q[2]), (q[0], q[2], q[3])] for q in faces]
    split_charts = [[(q[0], q[1], q[2]), (q[0], q[2], q[3])] for q in charts]
    return points, sum(split, []), texture, sum(split_charts, [])


def textured_obj(points, faces, texture, charts, groups=()):
    lines = ['v %r %r %r' % tuple(p) for p in points] + ['vt %r %r' % tuple(t) for t in texture]
    for k, (face, chart) in enumerate(zip(faces, charts)):
        lines += ['g ' + name for at, name in groups if at == k]
        lines.append('f ' + ' '.join('%d/%d' % (v + 1, t + 1) for v, t in zip(face, chart)))
    return '\n'.join(lines) + '\n'


class Seamless(CommandTest):
    @classmethod
    def setUpClass(cls):
        cls.shared = tempfile.mkdtemp(prefix='majorant_seamless_')
        cls.addClassCleanup(shutil.rmtree, cls.shared)
        cls.meshes = {}
        for name, mesh in {'cube': triangles(cube(4)), 'quads': cube(3), 'torus': torus_map(16, 8),
                           'open': triangles(cube(4, sides=5))}.items():
            cls.meshes[name] = os.path.join(cls.shared, name + '.obj')
            with open(cls.meshes[name], 'w') as f:
                f.write(textured_obj(*mesh))
        cls.results = {}
        for name, mesh, degree, options in [('cube1', 'cube', 1, []), ('cube2', 'cube', 2, []),
                                            ('cube4', 'cube', 4, []), ('torus3', 'torus', 3, []),
                                            ('open3', 'open', 3, []),
                                            ('fixed1', 'open', 1, ['--boundary', 'fixed']),
                                            ('fixed3', 'open', 3, ['--boundary', 'fixed'])]:
            path = os.path.join(cls.shared, name)
            cls.results[name] = path + '.vtu'
            outcome = majorant('parametrize', cls.meshes[mesh], '--seamless', '--degree', degree,
                               '-o', path + '.vtu', '-o', path + '.obj', '--report', path + '.json',
                               *options)
            assert outcome.code == OK, outcome.err
            assert 'cones, seams fit to' in outcome.err, outcome.err

    def mesh_of(self, result):
        return self.meshes[{'c': 'cube', 't': 'torus', 'o': 'open', 'f': 'open'}[result[0]]]

    def report(self, name):
        with open(os.path.join(self.shared, name + '.json')) as f:
            return json.load(f)

    def test_results_pass(self):
        for name, path in self.results.items():
            with self.subTest(name):
                report = self.path('report.json')
                outcome = self.run_ok('check', path, '--surface', self.mesh_of(name), '--report',
                                      report)
                self.assertIn('cones', outcome.err)
                with open(report) as f:
                    found = json.load(f)['result']
                said = self.report(name)['result']
                self.assertEqual(found['cones'], said['cones'])
                self.assertTrue(found['locally_injective'])
                for result in (found, said):
                    self.assertLess(result['seam_residual_ulp'], 100)
                    self.assertGreaterEqual(result['seam_residual'], 0)

    def test_cones(self):
        points = cube(4)[0]
        corners = [v for v, p in enumerate(points) if min(map(abs, p)) > 0.85]
        self.assertEqual(len(corners), 8)
        for name in ('cube1', 'cube2', 'cube4'):
            cones = self.report(name)['result']['cones']
            self.assertEqual(sorted(c['vertex'] for c in cones), corners)
            self.assertEqual({c['quarter_turns'] for c in cones}, {3})
            self.assertEqual(sum(c['index'] for c in cones), 2)  # Euler characteristic
            vtu = Vtu(self.results[name])
            self.assertIs(vtu.claims['seams'], True)
            self.assertEqual(vtu.claims['cones'], cones)
            marked = {v for v, c in zip(vtu.arrays['input_vertex'], vtu.arrays['cone']) if c}
            self.assertEqual(sorted(marked), corners)
            self.assertEqual(set(vtu.arrays['cone']), {0, 3})
        self.assertEqual(self.report('torus3')['result']['cones'], [])

    def test_the_start(self):
        start = self.report('cube1')['seam_start']
        self.assertEqual((start['chains'], start['seam_edges']), (12, 48))
        self.assertLess(start['residual'], 1e-12)
        self.assertLess(start['moved'], 1e-12)
        self.assertNotIn('seam_start', json.loads(self.plain_report()))

    def plain_report(self):
        self.run_ok('parametrize', '--quiet', generated('cap'), '-o', self.path('r.json'), '--degree',
                    '1')
        return self.read('r.json')

    def test_marks_of_seams(self):
        for name in ('cube1', 'cube4'):
            vtu = Vtu(self.results[name])
            self.assertEqual(vtu.components['seam_edges'], 3)
            # Both cells of an edge say the same; on a seam they share no point of it.
            sides = {}
            for cell, marks in zip(vtu.cells(), vtu.rows('seam_edges')):
                for k in range(3):
                    points = {cell[k], cell[(k + 1) % 3]}
                    ends = frozenset(vtu.arrays['input_vertex'][p] for p in points)
                    sides.setdefault(ends, []).append((marks[k], points))
            for (mark, points), (same, others) in sides.values():
                self.assertEqual(mark, same)
                self.assertEqual(mark > 0, points.isdisjoint(others))
                for p in points if mark else ():
                    self.assertGreater(vtu.arrays['seam'][p], 0)
            self.assertEqual({m for row in vtu.rows('seam_edges') for m in row}, set(range(13)))

    # ---------------------------------------------------------------- tampering
    def tampered(self, name, change, *says, surface=()):
        vtu = Vtu(self.results[name])
        change(vtu)
        path = vtu.write(self.path(name + '_tampered.vtu'))
        self.refused(INVALID, 'check', path, *surface, says=[path, 'invalid', *says])

    def seam_point(self, vtu):
        cell, k = next((c, k) for c, row in enumerate(vtu.rows('seam_edges')) for k in range(3) if row[k])
        return cell, k, vtu.cells()[cell]

    def test_a_moved_point_on_a_seam(self):
        for name in ('cube1', 'cube2', 'cube4', 'torus3', 'open3'):
            for amount in (1e-6, 1e-3):
                def move(vtu):
                    _, k, cell = self.seam_point(vtu)
                    n = vtu.claims['degree']
                    vtu.arrays['uv'][2 * cell[3 + k * (n - 1) if n > 1 else k]] += amount
                self.tampered(name, move, 'seam', 'edge (')

    def test_a_torn_seam(self):
        def move(vtu):
            _, k, cell = self.seam_point(vtu)
            vtu.arrays['uv'][2 * cell[k]] += 0.05
        self.tampered('cube1', move, 'not seamless at edge (')

    def test_a_duplicated_point(self):
        def duplicate(vtu, cell, local):
            size = len(vtu.cells()[0])
            point = vtu.cells()[cell][local]
            for array in ('uv', 'Points', 'input_vertex', 'cone', 'seam'):
                k = vtu.components[array]
                vtu.arrays[array] += vtu.arrays[array][k * point:k * (point + 1)]
            vtu.arrays['connectivity'][cell * size + local] = len(vtu.rows('uv')) - 1
        for name, says in (('cube1', 'not marked as a seam'), ('cube2', 'share some'),
                           ('cube4', 'share some')):
            vtu = Vtu(self.results[name])
            cell, k, _ = self.seam_point(vtu)
            duplicate(vtu, cell, k)
            path = vtu.write(self.path('duplicated.vtu'))
            self.refused(INVALID, 'check', path, says=[path, says, 'cell', 'edge ('])

    def test_lies_about_cones(self):
        def drop(vtu):
            vtu.claims['cones'].pop()
        def add(vtu):
            vtu.claims['cones'].append({'vertex': 1, 'quarter_turns': 5, 'index': -0.25})
        def change(vtu):
            vtu.claims['cones'][0]['quarter_turns'] = 2
        for lie in (drop, add, change):
            self.tampered('cube2', lie, 'quarter turns', 'vertex')
        def mark(vtu):
            point = vtu.arrays['cone'].index(0)
            vtu.arrays['cone'][point] = 5
        self.tampered('cube1', mark, 'marked as a cone')

    def test_no_seams_to_claim(self):
        path = self.path('plain.vtu')
        self.run_ok('parametrize', '--quiet', generated('cap'), '-o', path, '--degree', '1')
        self.refused(INVALID, 'check', path, '--seamless', says='no seams')
        vtu = Vtu(self.results['cube1'])
        vtu.claims['seams'] = False
        denied = vtu.write(self.path('denied.vtu'))
        self.refused(INVALID, 'check', denied, says='component')  # it falls into its charts

    def test_another_cut(self):
        points, faces, texture, charts = triangles(cube(4))
        # One chart turned by 90 degrees: the same cuts, other turns.
        turned = list(texture)
        for t in range(25):
            turned[t] = (-texture[t][1], texture[t][0])
        other = self.write('turned.obj', textured_obj(points, faces, turned, charts))
        for result in (self.results['cube2'], self.results['cube1'].replace('.vtu', '.obj')):
            flags = ['--seamless'] if result.endswith('.obj') else []
            self.run_ok('check', result, '--surface', self.meshes['cube'], *flags)
            self.refused(INVALID, 'check', result, '--surface', other, *flags,
                         says=['quarter turns', 'edge ('])
        other = self.write('torus.obj', textured_obj(*torus_map(16, 8)[:2], *[
            [(x + 1, y) for x, y in torus_map(16, 8)[2]], torus_map(16, 8)[3]]))
        self.run_ok('check', self.results['torus3'], '--surface', other)  # only moved

    def test_a_surface_without_texture(self):
        points, faces, _, _ = triangles(cube(4))
        plain = self.write('plain.obj', obj_text(points, faces))
        self.run_ok('check', self.results['cube2'], '--surface', plain)
        self.refused(UNSUPPORTED, 'parametrize', plain, '--seamless', '-o', self.path('o.vtu'),
                     says='texture')

    # ---------------------------------------------------------------- pins and boundaries
    def test_pins_on_seams(self):
        vertex = self.report('cube1')['result']['cones'][0]['vertex']
        pins = self.write('pins.json', json.dumps(
            {'handles': [{'vertex': v, 'target': 'initial'} for v in (vertex, 1)]}))
        for n in (1, 2):
            out = self.path('pinned.vtu')
            self.run_ok('parametrize', '--quiet', self.meshes['cube'], '--seamless', '--degree', n,
                        '--pins', pins, '-o', out)
            claims = Vtu(out).claims['pins']
            self.assertEqual(len([p for p in claims if p['vertex'] == vertex]), 3)
            self.run_ok('check', out, '--surface', self.meshes['cube'])
            for lie in (lambda pins: pins[0]['target'].__setitem__(0, 17.0), lambda pins: pins.pop(0)):
                vtu = Vtu(out)
                lie(vtu.claims['pins'])
                path = vtu.write(self.path('moved.vtu'))
                self.refused(INVALID, 'check', path, says='the pin of vertex')

    def test_a_fixed_boundary(self):
        for name in ('fixed1', 'fixed3'):
            self.refused(INVALID, 'check', self.results[name], says='--surface')
            vtu = Vtu(self.results[name])
            cells, marks, n = vtu.cells(), vtu.rows('seam_edges'), vtu.claims['degree']
            edges = {}
            for cell, row in zip(cells, marks):
                for k in range(3):
                    if row[k] == 0:
                        inner = cell[3 + k * (n - 1)] if n > 1 else cell[k]
                        ends = sorted((cell[k], cell[(k + 1) % 3]))
                        edges.setdefault(tuple(ends), []).append(inner)
            on_seams = {cell[k] for cell, row in zip(cells, marks) for k in range(3)
                        if row[k] or row[(k + 2) % 3]}
            point = next(e[0] for e in edges.values() if len(e) == 1 and e[0] not in on_seams)
            vtu.arrays['uv'][2 * point + 1] += 1e-6
            path = vtu.write(self.path('moved.vtu'))
            self.refused(INVALID, 'check', path, '--surface', self.meshes['open'], says='boundary')

    # ---------------------------------------------------------------- other formats
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
        text = self.read('out.obj').decode()
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
            self.run_ok('convert', path, '-o', self.path('again.vtu'), '-o', self.path('a.svg'), '-o',
                        self.path('a.obj'))
            with open(path, 'rb') as f:
                self.assertEqual(self.read('again.vtu'), f.read())
            self.assertEqual(b'<circle' in self.read('a.svg'), name != 'torus3')
            self.assertIn(b'chains)', self.read('a.svg'))
            self.assertEqual(b'# cone vertex' in self.read('a.obj'), name != 'torus3')
        # An OBJ does not mark its seams; what its points share says where they are.
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
            match = re.search(r'clip-path="url\(#layout\)"[^>]* d="([^"]*)"', text)
            lines[name] = match.group(1).count('M') if match else 0
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
            texture = json.load(f)['texture']
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

    # ---------------------------------------------------------------- the independent checker
    @unittest.skipUnless(os.path.exists(VERIFY), 'no ' + VERIFY)
    def test_verify(self):
        for name, path in self.results.items():
            mesh = self.mesh_of(name)
            process = subprocess.run(['/usr/bin/python3', VERIFY, path, '--mesh', mesh, '--cuts',
                                      'auto', '--same-cuts', mesh, '--max-cut-fraction', '0.6',
                                      '--no-energy'], text=True, stdout=subprocess.PIPE,
                                     stderr=subprocess.PIPE, timeout=300)
            self.assertEqual(process.returncode, 0, name + process.stdout[-2000:] + process.stderr)
            self.assertTrue(json.loads(process.stdout)['ok']['same_cuts'])

    @unittest.skipUnless(os.path.isdir(os.path.join(SHARED, 'data', 'public', 'seamless')),
                         'no public seamless meshes')
    def test_public_meshes(self):
        folder = os.path.join(SHARED, 'data', 'public', 'seamless')
        for name in sorted(os.listdir(folder)):
            mesh = os.path.join(folder, name)
            for n in (1, 2):
                out = self.path('out.vtu')
                self.run_ok('parametrize', '--quiet', mesh, '--seamless', '--degree', n, '-o', out)
                self.run_ok('check', out, '--surface', mesh)


if __name__ == '__main__':
    main()
