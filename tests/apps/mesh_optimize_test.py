#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""`majorant mesh optimize`: outputs are valid by `mesh check` and by gmsh, in the format of the input, and held
points keep their bits; exit codes, limits, signals, a full disk."""
import json
import os
import resource
import signal
import subprocess
import time
import unittest

import command_helpers as helpers
from command_helpers import INVALID, LIMIT, OK, UNREADABLE, UNSUPPORTED, USAGE, CommandTest, majorant, without_mark

try:
    import gmsh
except ImportError:
    gmsh = None

FOLDER = os.path.join(helpers.SHARED, 'data', 'public', 'volumes')


def medit(count, moved):
    """Returns a cube of count^3 cubes of six tetrahedra. moved: the position of the vertex (i, j, k)."""
    def vertex(at):
        return 1 + at[0] + (count + 1) * (at[1] + (count + 1) * at[2])
    steps = range(count + 1)
    points = [moved(i, j, k) for k in steps for j in steps for i in steps]
    cells = []
    for k in range(count):
        for j in range(count):
            for i in range(count):
                for t, order in enumerate(((0, 1, 2), (1, 2, 0), (2, 0, 1), (1, 0, 2), (2, 1, 0), (0, 2, 1))):
                    at = [i, j, k]
                    corners = [vertex(at)]
                    for axis in order:
                        at[axis] += 1
                        corners.append(vertex(at))
                    if t >= 3:
                        corners[1], corners[2] = corners[2], corners[1]
                    cells.append(corners)
    return ('MeshVersionFormatted 2\nDimension 3\nVertices {}\n'.format(len(points)) +
            ''.join('{!r} {!r} {!r} 7\n'.format(*p) for p in points) +
            'Tetrahedra {}\n'.format(len(cells)) +
            ''.join('{} {} {} {} 3\n'.format(*c) for c in cells) + 'End\n')


def tangled(count=3):
    def moved(i, j, k):
        inside = 0 < min(i, j, k) and max(i, j, k) < count
        return (i + 1.3 * (i % 2), j - 0.8, k + 0.1) if inside else (float(i), float(j), float(k))
    return medit(count, moved)


class Optimized(CommandTest):
    def test_written_files_and_reports(self):
        path = self.write('a.mesh', tangled())
        self.run_ok('mesh', 'check', path, code=INVALID)
        done = self.run_ok('mesh', 'optimize', path, '-o', self.path('b.mesh'), '--report', self.path('r.json'))
        self.assertRegex(done.err, r'a\.mesh: converged: 162 tetrahedra of degree 1; \d+ were not valid, none is left; ')
        self.assertEqual(done.out, '')
        self.run_ok('mesh', 'check', self.path('b.mesh'))
        before, after = (without_mark(self.read(name)).splitlines() for name in ('a.mesh', 'b.mesh'))
        self.assertEqual(len(before), len(after))
        self.assertEqual(sum(a != b for a, b in zip(before, after)), 8)  # the inner vertices
        with open(self.path('r.json')) as f:
            report = json.load(f)
        self.assertEqual((report['command'], report['status'], report['result']['mesh']['invalid']),
                         ('mesh optimize', 'converged', 0))
        self.assertEqual((report['result']['mesh']['moved_nodes'], report['result']['mesh']['impossible']), (8, []))
        self.assertLessEqual(report['result']['value'], report['result']['initial_value'])

    def test_the_same_on_any_number_of_threads(self):
        path = self.write('a.mesh', tangled())
        texts = set()
        for threads in (1, 2, 3):
            self.run_ok('mesh', 'optimize', path, '-o', self.path('b.mesh'), '--threads', threads)
            texts.add(self.read('b.mesh'))
        self.assertEqual(len(texts), 1)

    def test_targets_and_energies(self):
        path = self.write('a.mesh', tangled())
        sizes = self.write('sizes.txt', '1\n' * 162)
        for words in (('--target', 'initial'), ('--target', 'size=' + sizes), ('--energy', 'mips'),
                      ('--energy', 'symmetric-dirichlet + 0.1*mips'), ('--boundary', 'slide'), ('--boundary', 'free')):
            with self.subTest(words=words):
                self.run_ok('mesh', 'optimize', path, '-o', self.path('b.mesh'), *words)
                self.run_ok('mesh', 'check', self.path('b.mesh'))

    def test_a_worse_worst_element_is_reported(self):
        """An element that its neighbours cannot improve: the line names it and the reason."""
        path = self.write('a.mesh', medit(4, lambda i, j, k: (0.7 * i + 0.1, j + 0.1, k + 0.25 * i + 0.1)))
        words = ('mesh', 'optimize', path, '-o', self.path('b.mesh'), '--boundary', 'slide')
        ideal = self.run_ok(*words, '--report', self.path('r.json'))
        with open(self.path('r.json')) as f:
            report = json.load(f)
        self.assertLess(report['result']['mesh']['min_scaled_jacobian'], report['input']['min_scaled_jacobian'])
        self.assertIn('; the least one fell, --energy amips-exponential weighs the worst elements most, --target initial',
                      ideal.err)
        initial = self.run_ok(*words, '--target', 'initial')
        self.assertNotIn('fell', initial.err)

    def test_worst_elements_weigh_more(self):
        """Energies are means. The mean energy of this graded box lowers the least scaled Jacobian from 0.174 to
        0.106."""
        path = self.write('a.mesh', medit(5, lambda i, j, k: (0.25 * i * i, float(j), float(k))))
        self.run_ok('mesh', 'optimize', path, '-o', self.path('b.mesh'), '--report', self.path('r.json'))
        with open(self.path('r.json')) as f:
            report = json.load(f)
        self.assertGreater(report['result']['mesh']['min_scaled_jacobian'], 0.145)

    def test_impossible_elements(self):
        """A boundary corner that is pulled through its cell: there is no file, and elements are named."""
        path = self.write('a.mesh', medit(2, lambda i, j, k: (1.4, 0.8, 0.2) if (i, j, k) == (2, 0, 0) else
                                          (float(i), float(j), float(k))))
        done = majorant('mesh', 'optimize', path, '-o', self.path('b.mesh'), '--report', self.path('r.json'))
        self.assertEqual(done.code, INVALID, done.err)
        self.assertIn('cannot be valid whatever moves', done.err)
        self.assertIn('; no mesh is written; --boundary free moves these nodes, too\n', done.err)
        self.assertRegex(done.err, r'\n  element \d+ \(tetrahedra, region 3\): impossible')
        self.assertFalse(os.path.exists(self.path('b.mesh')))
        with open(self.path('r.json')) as f:
            report = json.load(f)
        self.assertEqual(report['status'], 'infeasible')
        self.assertTrue(report['result']['mesh']['impossible'])
        # With a free boundary the element can be repaired, and the boundary moves no more than necessary.
        self.run_ok('mesh', 'optimize', path, '-o', self.path('c.mesh'), '--boundary', 'free', '--max-iterations', 0,
                    code=LIMIT)
        self.run_ok('mesh', 'check', self.path('c.mesh'))
        lines = [without_mark(self.read(name)).decode().splitlines() for name in ('a.mesh', 'c.mesh')]
        first, cells = lines[0].index('Vertices 27'), lines[0].index('Tetrahedra 48')
        let_go = {14} | {int(v) for number in report['result']['mesh']['impossible'] for v in lines[0][cells + number].split()[:4]}
        moved = {k - first for k, (a, b) in enumerate(zip(*lines)) if a != b}
        self.assertTrue(moved and moved <= let_go, (moved, let_go))
        self.assertLess(len(let_go), 27)
        self.run_ok('mesh', 'optimize', path, '-o', self.path('b.mesh'), '--boundary', 'free')

    def test_turned_elements(self):
        """Elements listed clockwise: two of nine quads, and a mirrored cube. They are turned first, counted, and
        written so."""
        quads = [(i + 4 * j + 1, i + 4 * j + 2, i + 4 * j + 6, i + 4 * j + 5) for j in range(3) for i in range(3)]
        for k in (4, 7):
            quads[k] = quads[k][::-1]
        path = self.write('a.msh', '$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n16\n' +
                          ''.join('%d %d %d 0\n' % (1 + i + 4 * j, i, j) for j in range(4) for i in range(4)) +
                          '$EndNodes\n$Elements\n9\n' +
                          ''.join('%d 3 2 1 1 %d %d %d %d\n' % (k + 1, *quad) for k, quad in enumerate(quads)) +
                          '$EndElements\n')
        mirrored = self.write('m.mesh', medit(2, lambda i, j, k: (-float(i), float(j), float(k))))
        for source, count, out in ((path, 2, 'b.msh'), (mirrored, 48, 'b.mesh')):
            with self.subTest(source=source):
                self.run_ok('mesh', 'check', source, code=INVALID)
                done = majorant('mesh', 'optimize', source, '-o', self.path(out), '--report', self.path('r.json'))
                self.assertEqual(done.code, OK, done.err)
                self.assertIn('; %d were turned around, their nodes are now listed in the opposite order' % count, done.err)
                with open(self.path('r.json')) as f:
                    report = json.load(f)
                self.assertEqual((report['input']['turned'], report['input']['invalid']), (count, 0))
                self.run_ok('mesh', 'check', self.path(out))

    def test_the_largest_displacement(self):
        path = self.write('a.mesh', tangled())
        done = majorant('mesh', 'optimize', path, '-o', self.path('b.mesh'), '--report', self.path('r.json'))
        with open(self.path('r.json')) as f:
            way = json.load(f)['result']['mesh']['largest_displacement']
        points = [[[float(x) for x in line.split()[:3]] for line in
                   without_mark(self.read(name)).decode().splitlines()[3:67]] for name in ('a.mesh', 'b.mesh')]
        largest = max(sum((a - b) ** 2 for a, b in zip(p, q)) ** 0.5 for p, q in zip(*points))
        self.assertAlmostEqual(way, largest, 9)
        self.assertIn(' nodes moved, by %.4g at most' % way, done.err)

    def test_refusals(self):
        path = self.write('a.mesh', tangled())
        out = ('-o', self.path('b.mesh'))
        surface = self.write('s.mesh', 'MeshVersionFormatted 2\nDimension 3\nVertices 4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n'
                                       '1 1 1 0\nTriangles 2\n1 2 3 0\n2 4 3 0\nEnd\n')
        twice = self.write('t.mesh', 'MeshVersionFormatted 2\nDimension 2\nVertices 3\n0 0 0\n1 0 0\n0 1 0\n'
                                     'Triangles 2\n1 2 3 0\n2 3 1 0\nEnd\n')
        triangle = self.write('q.msh', '$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n'
                                     '$EndNodes\n$Elements\n1\n1 2 2 0 1 1 2 3\n$EndElements\n')
        few = self.write('few.txt', '1 2 3')
        wrong = self.write('wrong.txt', '1 -2')
        for code, words, says in (
                (USAGE, (path,), '--output'),
                (USAGE, (triangle, *out), '.msh or .vtu'),
                (USAGE, (path, '-o', path), '--force'),
                (USAGE, (path, *out, '--energy', 'mipps'), "did you mean 'mips'"),
                (USAGE, (path, *out, '--energy', 'asap'), 'asap'),
                (USAGE, (path, '-o', self.path('b.vtu'), '--msh-version', '2.2'), 'apply to .msh'),
                (USAGE, (path, *out, '--target', 'idal'), "did you mean 'ideal'"),
                (USAGE, (path, *out, '--target', 'size='), 'size=FILE'),
                (USAGE, (path, *out, '--boundary', 'slid'), "did you mean 'slide'"),
                (USAGE, (path, *out, '--binary'), '.msh'),
                (UNREADABLE, (path, *out, '--target', 'size=' + few), '3 edge lengths for 162'),
                (UNREADABLE, (path, *out, '--target', 'size=' + wrong), 'positive'),
                (UNREADABLE, (self.write('c.mesh', tangled()[:300]), *out), 'c.mesh'),
                (UNSUPPORTED, (surface, *out), 'surface in space'),
                (UNSUPPORTED, (twice, *out), 'do not fit together')):
            with self.subTest(says=says):
                done = majorant('mesh', 'optimize', *words)
                self.assertEqual(done.code, code, done.err)
                self.assertEqual(done.err.count('\n'), 1, done.err)
                self.assertIn(says, done.err)
                self.assertFalse(os.path.exists(self.path('b.mesh')))

    def test_limits(self):
        path = self.write('a.mesh', tangled(4))
        self.run_ok('mesh', 'optimize', path, '-o', self.path('b.mesh'), '--max-iterations', 1, code=LIMIT)
        self.run_ok('mesh', 'check', self.path('b.mesh'))
        os.remove(self.path('b.mesh'))
        done = majorant('mesh', 'optimize', path, '-o', self.path('b.mesh'), '--time-limit', 0)
        self.assertEqual(done.code, INVALID, done.err)  # no valid mesh yet
        self.assertFalse(os.path.exists(self.path('b.mesh')))

    def test_a_full_disk(self):
        path = self.write('a.mesh', tangled(4))
        done = subprocess.run([helpers.BINARY, 'mesh', 'optimize', path, '-o', self.path('b.mesh')], text=True,
                              stderr=subprocess.PIPE, timeout=300,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000)))
        self.assertEqual(done.returncode, USAGE, done.stderr)
        self.assertIn('b.mesh', done.stderr)
        self.assertEqual(sorted(os.listdir(os.path.dirname(path))), ['a.mesh'])

    def test_killed(self):
        """Exit code 4 with a valid mesh, 5 without one; after the first step there always is one."""
        path = self.write('a.mesh', tangled(13))
        for line, codes in (('reading', (INVALID, LIMIT)), ('degree', (LIMIT, OK))):
            with self.subTest(line=line):
                run = subprocess.Popen([helpers.BINARY, 'mesh', 'optimize', path, '-o', self.path('b.mesh')],
                                       stderr=subprocess.PIPE, text=True)
                while not (printed := run.stderr.readline()).startswith(line):
                    self.assertTrue(printed, 'it ended before')
                run.send_signal(signal.SIGINT)
                err = run.stderr.read()
                run.stderr.close()
                self.assertIn(run.wait(timeout=120), codes, err)
                written = [] if run.returncode == INVALID else ['b.mesh']
                self.assertEqual(sorted(os.listdir(os.path.dirname(path))), ['a.mesh'] + written)
                if written:
                    self.run_ok('mesh', 'check', self.path('b.mesh'))
                    os.remove(self.path('b.mesh'))

    def test_an_interrupt_while_sizes_are_read(self):
        path = self.write('a.mesh', tangled())
        os.mkfifo(self.path('sizes'))
        run = subprocess.Popen([helpers.BINARY, 'mesh', 'optimize', path, '-o', self.path('b.mesh'), '--target',
                                'size=' + self.path('sizes')], stderr=subprocess.PIPE, text=True)
        time.sleep(0.5)
        run.send_signal(signal.SIGINT)
        err = run.communicate(timeout=120)[1]
        self.assertEqual(run.returncode, INVALID, err)
        self.assertIn('interrupted while reading ' + self.path('sizes'), err)


@unittest.skipIf(gmsh is None, 'no python3-gmsh')
class OfGmsh(CommandTest):
    """Curved meshes of every kind, in every version and encoding: gmsh opens them with the same tags."""

    def setUp(self):
        super().setUp()
        gmsh.initialize()
        self.addCleanup(gmsh.finalize)
        gmsh.option.setNumber('General.Terminal', 0)

    def ball(self, degree):
        gmsh.clear()
        for name in ('Mesh.MeshSizeMin', 'Mesh.MeshSizeMax'):
            gmsh.option.setNumber(name, 0.6)
        gmsh.model.occ.addSphere(0, 0, 0, 1)
        gmsh.model.occ.synchronize()
        gmsh.model.addPhysicalGroup(3, [1], 77)
        gmsh.model.setPhysicalName(3, 77, 'ball')
        gmsh.model.addPhysicalGroup(2, [1], 5)
        gmsh.model.mesh.generate(3)
        gmsh.model.mesh.setOrder(degree)

    def contents(self, path):
        gmsh.clear()
        gmsh.open(path)
        nodes = gmsh.model.mesh.getNodes()[0]
        elements = gmsh.model.mesh.getElements()
        groups = sorted((tuple(g), gmsh.model.getPhysicalName(*g),
                         tuple(gmsh.model.getEntitiesForPhysicalGroup(*g))) for g in gmsh.model.getPhysicalGroups())
        by_tag = {t: tuple(elements[2][k][i * len(elements[2][k]) // len(tags):
                                         (i + 1) * len(elements[2][k]) // len(tags)])
                  for k, tags in enumerate(elements[1]) for i, t in enumerate(tags)}
        return sorted(nodes), by_tag, groups

    def test_versions_and_encodings(self):
        self.ball(2)
        for version in (2.2, 4.1):
            for binary in (0, 1):
                gmsh.option.setNumber('Mesh.MshFileVersion', version)
                gmsh.option.setNumber('Mesh.Binary', binary)
                gmsh.option.setNumber('Mesh.SaveAll', 1)
                gmsh.write(self.path('in_{}_{}.msh'.format(version, binary)))
        for version in (2.2, 4.1):
            for binary in (0, 1):
                path = self.path('in_{}_{}.msh'.format(version, binary))
                before = self.contents(path)
                for words in ((), ('--msh-version', '2.2'), ('--msh-version', '4.1'), ('--binary',),
                              ('--msh-version', '2.2', '--binary'), ('--msh-version', '4.1', '--binary')):
                    with self.subTest(version=version, binary=binary, words=words):
                        out = self.path('out.msh')
                        self.run_ok('mesh', 'optimize', path, '-o', out, '--max-iterations', 3, '-q', '--force', *words,
                                    code=LIMIT)
                        self.run_ok('mesh', 'check', out)
                        after = self.contents(out)
                        self.assertEqual(after, before)
                        with open(out, 'rb') as f:
                            head = f.read(40)
                        requested = words[1] if '--msh-version' in words else str(version)
                        bits = 1 if '--binary' in words or binary else 0
                        self.assertIn('{} {} 8'.format(requested, bits).encode(), head)

    def test_serendipity_elements_are_named(self):
        gmsh.option.setNumber('Mesh.SecondOrderIncomplete', 1)
        gmsh.model.occ.addRectangle(0, 0, 0, 1, 1)
        gmsh.model.occ.extrude([(2, 1)], 0, 0, 1, [2], [1], recombine=True)
        gmsh.model.occ.synchronize()
        gmsh.model.mesh.setTransfiniteSurface(1)
        gmsh.model.mesh.setRecombine(2, 1)
        gmsh.model.mesh.generate(3)
        gmsh.model.mesh.setOrder(2)
        gmsh.write(self.path('a.msh'))
        first = gmsh.model.mesh.getElements(3)[1][0]
        done = majorant('mesh', 'optimize', self.path('a.msh'), '-o', self.path('b.msh'))
        self.assertEqual(done.code, UNSUPPORTED, done.err)
        self.assertIn('a.msh: {} hexahedra of degree 2 (serendipity), the first of them element {}, are checked, not '
                      'optimized; '.format(len(first), first[0]), done.err)

    def test_degrees(self):
        for degree in (1, 2, 3, 4):
            with self.subTest(degree=degree):
                self.ball(degree)
                gmsh.write(self.path('a.msh'))
                self.run_ok('mesh', 'optimize', self.path('a.msh'), '-o', self.path('b.msh'), '--report',
                            self.path('r.json'))
                with open(self.path('r.json')) as f:
                    report = json.load(f)
                self.assertEqual((report['status'], report['result']['mesh']['invalid']), ('converged', 0))
                self.assertLessEqual(report['result']['value'], report['result']['initial_value'])
                gmsh.clear()
                gmsh.open(self.path('b.msh'))
                gmsh.plugin.setNumber('AnalyseMeshQuality', 'JacobianDeterminant', 1)
                gmsh.plugin.setNumber('AnalyseMeshQuality', 'CreateView', 1)
                gmsh.plugin.setNumber('AnalyseMeshQuality', 'Recompute', 1)
                gmsh.plugin.run('AnalyseMeshQuality')
                least = min(gmsh.view.getModelData(gmsh.view.getTags()[-1], 0)[2])[0]
                self.assertGreater(least, 0)


class Public(CommandTest):
    @helpers.where(FOLDER)
    def test_tangled_ones(self):
        for name in ('generated/tangled_o2_n4_25.msh', 'generated/tangled_o2_n6_120.msh'):
            with self.subTest(name=name):
                path = os.path.join(FOLDER, name)
                out = self.path('b' + os.path.splitext(name)[1])
                self.run_ok('mesh', 'optimize', path, '-o', out)
                self.run_ok('mesh', 'check', out)
                self.run_ok('mesh', 'optimize', path, '-o', out, '--boundary', 'free', '--force', '--report',
                            self.path('r.json'))
                self.run_ok('mesh', 'check', out)
                with open(self.path('r.json')) as f:
                    self.assertLess(json.load(f)['result']['untangling_iterations'], 40)


if __name__ == '__main__':
    helpers.main()
