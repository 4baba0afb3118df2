# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""check --cuts: the edges whose sides may differ, in every format, down to the last bit."""
from command_helpers import *
from unwrap_helpers import cube, moebius, soup, sphere

SETTINGS = ('auto', 'none', 'free')


def moved(value, by):
    """Moves a value. by: a distance, or None for the next double."""
    return math.nextafter(value, math.inf) if by is None else value + by


def last_corner(cells):
    """Returns (cell, corner, neighbour): at this corner the cell has a boundary edge and one inner edge, to the corner
    `neighbour`."""
    sides = {(c[k], c[(k + 1) % 3]) for c in cells for k in range(3)}
    for number, c in enumerate(cells):
        for k in range(3):
            a, b, before = c[k], c[(k + 1) % 3], c[k - 1]
            if (b, a) not in sides and (a, before) in sides:
                return number, k, before
    raise ValueError('no cell at the boundary with a neighbour')


def tear_vtu(source, target, by, chosen=None):
    """Writes a copy in which a cell has its own points and differs from its neighbour along one inner edge, at its
    end on the boundary. chosen: the cells to choose from."""
    vtu = Vtu(source)
    cells = vtu.cells()
    chosen = range(len(cells)) if chosen is None else chosen
    found, k, _ = last_corner([cells[c][:3] for c in chosen])
    cell = list(chosen)[found]
    uv, places = vtu.rows('uv'), vtu.rows('Points')
    begin = ([0] + vtu.arrays['offsets'])[cell]
    for i, point in enumerate(cells[cell]):
        vtu.arrays['uv'] += [moved(uv[point][0], by) if i == k else uv[point][0], *uv[point][1:]]
        vtu.arrays['Points'] += places[point]
        vtu.arrays['input_vertex'].append(vtu.arrays['input_vertex'][point])
        vtu.arrays['connectivity'][begin + i] = len(uv) + i
    vtu.claims['bijective'] = False  # the tear may overlap
    if 'min_det' in vtu.arrays:
        vtu.arrays['min_det'][cell] /= 2
    return vtu.write(target)


def ply_text(points, uv, number, faces):
    """number: the vertex of every point."""
    head = ['ply', 'format ascii 1.0', 'element vertex %d' % len(points)]
    head += ['property double ' + name for name in ('x', 'y', 'z', 's', 't')]
    head += ['property int input_vertex', 'element face %d' % len(faces),
             'property list uchar int vertex_indices', 'end_header']
    rows = ['%r %r %r %r %r %d' % (*p, *t, n) for p, t, n in zip(points, uv, number)]
    return '\n'.join(head + rows + ['3 %d %d %d' % f for f in faces]) + '\n'


def msh_text(points, uv, faces):
    """Returns a surface with u and v as views of gmsh."""
    n, box = len(points), [f(p[k] for p in points) for f in (min, max) for k in range(3)]
    lines = ['$MeshFormat', '4.1 0 8', '$EndMeshFormat', '$Entities', '0 0 1 0',
             '1 %r %r %r %r %r %r 0 0' % tuple(box), '$EndEntities', '$Nodes', '1 %d 1 %d' % (n, n),
             '2 1 0 %d' % n, *map(str, range(1, n + 1)), *('%r %r %r' % tuple(p) for p in points),
             '$EndNodes', '$Elements', '1 %d 1 %d' % (len(faces), len(faces)), '2 1 2 %d' % len(faces)]
    lines += ['%d %d %d %d' % (i + 1, *(v + 1 for v in f)) for i, f in enumerate(faces)]
    lines.append('$EndElements')
    for k, name in enumerate('uv'):
        lines += ['$NodeData', '1', '"%s"' % name, '1', '0', '3', '0', '1', str(n)]
        lines += ['%d %r' % (i + 1, t[k]) for i, t in enumerate(uv)] + ['$EndNodeData']
    return '\n'.join(lines) + '\n'


class OneTear(CommandTest):
    """A disk that is torn along one inner edge, by a millionth and by the last bit."""

    def setUp(self):
        super().setUp()
        self.surface = self.write('in.obj', obj_text(*grid(3)))

    def verdicts(self, path, auto, surfaces=True):
        """Tests the verdicts with all settings, with and without the surface."""
        for more in ([], ['--surface', self.surface]) if surfaces else ([],):
            for setting in SETTINGS:
                with self.subTest(path=os.path.basename(path), setting=setting, more=more):
                    is_torn = setting == 'none' or (setting == 'auto' and auto == INVALID)
                    done = self.run_ok('check', path, '--cuts', setting, *more,
                                       code=INVALID if is_torn else OK)
                    self.assertEqual('not continuous' in done.out, is_torn, done.out)
                    self.assertEqual(', which may be tears' in done.out,
                                     setting == 'auto' and not is_torn, done.out)
            self.assertEqual(self.run_ok('check', path, *more, code=auto).printed()[-1],
                             self.run_ok('check', path, *more, '--cuts', 'auto', code=auto).printed()[-1])

    def test_files_that_claim(self):
        for name, flags in (('1.vtu', ['--degree', '1']), ('3.vtu', ['--degree', '3']),
                            ('l.vtu', ['--degree', '1', '--vtu', 'lagrange'])):
            self.run_ok('parametrize', '--quiet', self.surface, '-o', self.path(name), *flags)
            self.assertEqual(Vtu(self.path(name)).claims['cuts'], [])
            self.run_ok('check', self.path(name), '--surface', self.surface)
            for by in (1e-6, None):
                self.verdicts(tear_vtu(self.path(name), self.path('torn_' + name), by), INVALID)

    def test_values_of_curved_lagrange_cells(self):
        self.run_ok('parametrize', '--quiet', self.surface, '-o', self.path('l.vtu'), '--degree', '2',
                    '--vtu', 'lagrange')
        for by in (1e-6, None):
            self.verdicts(tear_vtu(self.path('l.vtu'), self.path('torn.vtu'), by), INVALID)

    def test_pieces_of_several_processes(self):
        self.run_ok('parametrize', '--quiet', self.surface, '-o', self.path('a.vtu'), '--degree', '1')
        pieces = ('<VTKFile type="PUnstructuredGrid"><PUnstructuredGrid>\n<Piece Source="%s"/>\n'
                  '</PUnstructuredGrid></VTKFile>\n')
        self.run_ok('check', self.write('a.pvtu', pieces % 'a.vtu'), '--surface', self.surface)
        for by in (1e-6, None):  # points of one vertex are one point, so that no cut is possible
            tear_vtu(self.path('a.vtu'), self.path('t.vtu'), by)
            torn = self.write('t.pvtu', pieces % 't.vtu')
            for setting in SETTINGS:
                self.refused(UNREADABLE, 'check', torn, '--cuts', setting, says='elsewhere')

    def torn_arrays(self, by):
        points, faces = grid(3)
        uv = [[p[0], p[1]] for p in points]
        cell, k, _ = last_corner(faces)
        copy = faces[cell][k]
        faces = [list(f) for f in faces]
        faces[cell][k] = len(points)
        uv.append([moved(uv[copy][0], by), uv[copy][1]])
        return points, faces, uv, copy

    def test_files_that_claim_nothing(self):
        for by in (1e-6, None):
            points, faces, uv, copy = self.torn_arrays(by)
            n = len(points)
            text = ['v %r %r %r' % p for p in points] + ['vt %r %r' % tuple(t) for t in uv]
            text += ['f ' + ' '.join('%d/%d' % (copy + 1 if v == n else v + 1, v + 1) for v in f)
                     for f in faces]
            self.verdicts(self.write('torn.obj', '\n'.join(text) + '\n'), OK)
            all_points = points + [points[copy]]
            flat = [tuple(f) for f in faces]
            self.verdicts(self.write('torn.ply', ply_text(all_points, uv, [*range(n), copy], flat)), OK)
            self.verdicts(self.write('torn.msh', msh_text(all_points, uv, flat)), OK)

    def test_the_verdict_counts_cut_edges(self):
        _, _, neighbour = last_corner(grid(3)[1])
        points, faces, uv, copy = self.torn_arrays(1e-6)
        length = math.dist(points[copy], points[neighbour])
        path = self.write('torn.msh', msh_text(points + [points[copy]], uv, faces))
        self.assertIn(', 1 chart (1 cut edge, length %.4g, which may be tears)' % length,
                      self.run_ok('check', path).out)
        report = self.path('report.json')
        for setting, notified in (('auto', False), ('free', True)):
            self.run_ok('check', path, '--cuts', setting, '--report', report)
            with open(report) as f:
                self.assertEqual(json.load(f)['result']['cuts']['told_from_tears'], notified)


class Claimed(CommandTest):
    def atlas(self, mesh, *flags):
        self.run_ok('unwrap', '--quiet', mesh, '-o', self.path('a.vtu'), *flags)
        return Vtu(self.path('a.vtu'))

    def test_cuts_are_those_of_the_run(self):
        points, faces = cube(2)
        mesh = self.write('cube.obj', obj_text(points, faces))
        report = self.path('report.json')
        cuts = self.atlas(mesh, '--seams', 'sharp', '--report', report).claims['cuts']
        with open(report) as f:
            self.assertEqual(len(cuts), json.load(f)['result']['seam_edges'])
        self.assertEqual(len({frozenset(edge) for edge in cuts}), len(cuts))
        sides = {frozenset((f[k], f[(k + 1) % 4])) for f in faces for k in range(4)}
        for edge in cuts:  # edges of the cube: two coordinates are equal at both ends, 0 or 1
            self.assertIn(frozenset(edge), sides)
            on = [k for k in range(3) if points[edge[0]][k] == points[edge[1]][k] in (0, 1)]
            self.assertEqual(len(on), 2)

    def test_a_tear_beside_cuts_that_are_claimed(self):
        mesh = self.write('sphere.obj', obj_text(*sphere(6)))
        vtu = self.atlas(mesh)
        self.assertGreater(len(vtu.claims['cuts']), 0)
        self.run_ok('check', self.path('a.vtu'), '--surface', mesh)
        for by in (1e-6, None):
            torn = tear_vtu(self.path('a.vtu'), self.path('torn.vtu'), by)
            self.found(torn, says=['not continuous', 'the sides of 1 inner edge',
                                                       'where it is not said to be cut'])
            self.run_ok('check', torn, '--cuts', 'free', '--surface', mesh)
            # The sides of claimed cuts may differ.
            vtu = Vtu(torn)
            more = self.run_ok('check', torn, code=INVALID).out.split('edge (')[1].split(')')[0]
            vtu.claims['cuts'].append(list(map(int, more.split(', ')))[::-1])
            self.run_ok('check', vtu.write(torn))

    def test_no_claim_excuses_anything_else(self):
        points, faces = cube(2)
        mesh = self.write('cube.obj', obj_text(points, faces))
        vtu = self.atlas(mesh)
        cells = vtu.cells()
        vertex = vtu.arrays['input_vertex']
        good = vtu.write(self.path('good.vtu'))
        self.run_ok('check', good, '--surface', mesh)
        folded = Vtu(good)
        folded.arrays['uv'] = [-x if k % 2 == 0 else x for k, x in enumerate(folded.arrays['uv'])]
        self.found(folded.write(self.path('bad.vtu')), says='positive: ')
        over = Vtu(good)  # the last cell, with its own points, on top of another one
        first, last = [over.rows('uv')[p] for p in cells[0]], cells[-1]
        middle = [sum(p[k] for p in first) / 3 for k in range(2)]
        count = len(over.rows('uv'))
        size = 0.1 * math.dist(first[0], first[1])
        for k, p in enumerate(last):
            place = over.rows('uv')[p]
            over.arrays['uv'] += [middle[0] + size * (place[0] - over.rows('uv')[last[0]][0]),
                                  middle[1] + size * (place[1] - over.rows('uv')[last[0]][1])]
            over.arrays['Points'] += over.rows('Points')[p]
            over.arrays['input_vertex'].append(vertex[p])
            over.arrays['connectivity'][3 * (len(cells) - 1) + k] = count + k
        known = {frozenset(edge) for edge in over.claims['cuts']}
        sides = [[vertex[last[k]], vertex[last[(k + 1) % 3]]] for k in range(3)]
        over.claims['cuts'] += [side for side in sides if frozenset(side) not in known]
        for name in ('distortion', 'min_det', 'sigma_1', 'sigma_2', 'area_distortion',
                     'angle_distortion', 'stretch_l2', 'stretch_linf'):
            over.arrays.pop(name, None)
        self.found(over.write(self.path('over.vtu')), '--certify',
                     says='not globally injective')
        less = self.write('less.obj', obj_text(points, faces[:-1]))
        self.found(good, '--surface', less, says='surface: ')

    def test_an_edge_that_several_sheets_have(self):
        """The edge may differ as often as it is listed."""
        points, faces = grid(2, lambda x, y: 0)
        mesh = self.write('double.obj', obj_text(points, faces + faces))
        vtu = self.atlas(mesh)
        self.assertEqual(vtu.claims['cuts'], [])
        self.run_ok('check', self.path('a.vtu'), '--surface', mesh)
        torn = tear_vtu(self.path('a.vtu'), self.path('torn.vtu'), 1e-6)
        text = self.run_ok('check', torn, code=INVALID).out.split('edge (')[1].split(')')[0]
        edge = list(map(int, text.split(', ')))
        chart = vtu.arrays['chart']
        sheets = [[c for c in range(len(chart)) if chart[c] == number] for number in (0, 1)]
        self.assertEqual(len(sheets[0]), len(sheets[1]))
        for sheet in sheets:
            both = Vtu(tear_vtu(self.path('a.vtu') if sheet is sheets[0] else self.path('both.vtu'),
                                self.path('both.vtu'), 1e-6, sheet))
        both.claims['cuts'] = [edge]
        self.found(both.write(self.path('both.vtu')), says='the sides of 1 inner')
        both.claims['cuts'] = [edge, edge[::-1]]
        self.run_ok('check', both.write(self.path('both.vtu')))

    def test_files_of_older_versions(self):
        """Files without the claim: for an atlas, cuts are unknown; a map in one piece is not cut."""
        mesh = self.write('sphere.obj', obj_text(*sphere(4)))
        vtu = self.atlas(mesh)
        del vtu.claims['cuts']
        self.assertIn(', which may be tears', self.run_ok('check', vtu.write(self.path('old.vtu'))).out)
        disk = self.write('in.obj', obj_text(*grid(3)))
        self.run_ok('parametrize', '--quiet', disk, '-o', self.path('p.vtu'), '--degree', '1')
        vtu = Vtu(tear_vtu(self.path('p.vtu'), self.path('torn.vtu'), None))
        del vtu.claims['cuts']
        self.found(vtu.write(self.path('torn.vtu')), says='not continuous')

    def test_claims_that_are_no_edges(self):
        self.atlas(self.write('in.obj', obj_text(*grid(1))))
        for cuts in (3, [3], [[1]], [[1, 2, 3]], [[1, -2]], [[1, 'a']], {'edges': []}):
            vtu = Vtu(self.path('a.vtu'))
            vtu.claims['cuts'] = cuts
            self.refused(UNREADABLE, 'check', vtu.write(self.path('b.vtu')), says='majorant_claims.cuts')

    def test_seams_are_cuts_that_fit(self):
        mesh = self.write('sphere.obj', obj_text(*sphere(4)))
        self.run_ok('seamless', '--quiet', mesh, '-o', self.path('s.vtu'), '--degree', '1')
        vtu = Vtu(self.path('s.vtu'))
        self.assertTrue(vtu.claims['seams'])
        marked = sum(map(bool, vtu.arrays['seam_edges'])) // 2
        self.assertEqual(len(vtu.claims['cuts']), marked)
        self.run_ok('check', self.path('s.vtu'), '--surface', mesh)
        vtu.claims['cuts'] = vtu.claims['cuts'][1:]
        self.found(vtu.write(self.path('t.vtu')), says='not said to be cut')


class FreshAtlases(CommandTest):
    """Files written with exit code 0 are valid by check, in every format, with the surface and without."""

    def test_every_format(self):
        shifted = [(x + 9, y, z) for x, y, z in cube(1)[0]]
        count = len(shifted)
        faces = [tuple(v for v in f) for f in cube(1)[1]]
        meshes = {'sphere': sphere(5), 'cube': cube(2), 'quads': quads(3), 'moebius': moebius(12),
                  'soup': soup(*grid(2)),
                  'two': (cube(1)[0] + shifted, faces + [tuple(v + count for v in f) for f in faces]),
                  'three_at_an_edge': ([(0, 0, 0), (1, 0, 0), (0.5, 1, 0), (0.5, -1, 0), (0.5, 0, 1)],
                                       [(0, 1, 2), (1, 0, 3), (0, 1, 4)])}
        for name, (points, faces) in meshes.items():
            mesh = self.write(name + '.obj', obj_text(points, faces))
            for degree in ('1',) if name == 'soup' else ('1', '2'):
                outputs = [name + degree + end for end in ('.vtu', '_l.vtu', '.obj', '.ply', '.msh')]
                with self.subTest(mesh=name, degree=degree):
                    run = ['unwrap', '--quiet', mesh, '--degree', degree, '--threads', '1']
                    self.run_ok(*run, '--msh', 'surface',
                                *(w for o in outputs if '_l' not in o for w in ('-o', self.path(o))))
                    self.run_ok(*run, '-o', self.path(outputs[1]), '--vtu', 'lagrange')
                    for out in outputs:
                        self.run_ok('check', self.path(out), '--certify')
                        if not (name == 'soup' and out.endswith('.msh')):
                            self.run_ok('check', self.path(out), '--certify', '--surface', mesh)


if __name__ == '__main__':
    main()
