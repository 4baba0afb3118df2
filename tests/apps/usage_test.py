# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Exit codes 1, 2 and 3 with their messages; no file is left behind."""
import os
import re
import unittest

from command_helpers import *

# All verbs in the help of the command.
VERBS = verb_names()

VERSION = r'^majorant \d+\.\d+\.\d+ \((AVX-512|AVX2|baseline)\)\n$'


class Usage(CommandTest):
    def test_help_everywhere(self):
        self.assertGreaterEqual(len(VERBS), 7)
        for args in [['--help'], ['-h']] + [[*v.split(), '--help'] for v in VERBS] + [['mesh', '--help']]:
            outcome = self.run_ok(*args)
            self.assertRegex(outcome.out, r'Examples?:\s+majorant ', args)
            self.assertEqual(outcome.err, '')
        for verb in VERBS:
            self.assertIn('Example: majorant ' + verb, majorant(*verb.split(), '--help').out)
            self.assertIn(verb.split()[0], majorant('--help').out)

    def test_version(self):
        outcome = self.run_ok('--version')
        self.assertRegex(outcome.out, VERSION)

    def test_version_on_every_verb(self):
        for verb in VERBS:
            self.assertRegex(self.run_ok(*verb.split(), '--version').out, VERSION, verb)

    def test_flags_take_no_value(self):
        mesh, out = generated('cap'), self.path('out.obj')
        for value in ('nan', 'inf', '99999999999999999999', '-1', '0', 'false'):
            for verb, flag in (('parametrize', '--bijective'), ('unwrap', '--no-pack'), ('parametrize', '--quiet')):
                self.refused(USAGE, verb, mesh, '-o', out, flag + '=' + value, says=[flag + ': takes no value'])
        self.assertEqual(self.files(), [])

    def test_wrong_arguments(self):
        mesh, out = generated('cap'), self.path('out.vtu')
        for args in [
            ['-q'], ['frobnicate', mesh], ['parametrize'], ['parametrize', mesh], ['check'], ['convert'],
            ['convert', mesh], ['info'], ['mesh'], ['mesh', 'check'], ['mesh', 'optimize', mesh], ['mesh', 'chek', mesh],
            ['parametrize', mesh, '-o', out, '--frobnicate'],
            ['parametrize', mesh, '-o', out, '--degree', '0'],
            ['parametrize', mesh, '-o', out, '--degree', '9'],
            ['parametrize', mesh, '-o', out, '--degree', '-1'],
            ['parametrize', mesh, '-o', out, '--degree', '2.5'],
            ['parametrize', mesh, '-o', out, '--degree', 'three'],
            ['parametrize', mesh, '-o', out, '--degree'],
            ['parametrize', mesh, '-o', out, '--energy', 'dirichlet'],
            ['parametrize', mesh, '-o', out, '--boundary', 'loose'],
            ['parametrize', mesh, '-o', out, '--init', 'random'],
            ['parametrize', mesh, '-o', out, '--curvature', 'newton'],
            ['parametrize', mesh, '-o', out, '--energy', 'mips', '--curvature', 'reweighted'],
            ['parametrize', mesh, '-o', out, '--elevation', 'sideways'],
            ['parametrize', mesh, '-o', out, '--quadrature', '0'],
            ['parametrize', mesh, '-o', out, '--tolerance', '0'],
            ['parametrize', mesh, '-o', out, '--tolerance', '-1'],
            ['parametrize', mesh, '-o', out, '--tolerance', 'nan'],
            ['parametrize', mesh, '-o', out, '--max-iterations', '-1'],
            ['parametrize', mesh, '-o', out, '--time-limit', '-1'],
            ['parametrize', mesh, '-o', out, '--threads', '0'],
            ['parametrize', mesh, '-o', out, '--refine', '0'],
            ['parametrize', mesh, '-o', out, '--quiet', '--verbose'],
            ['parametrize', mesh, '-o', self.path('out.xyz')],
            ['parametrize', mesh, '-o', self.path('out')],
            ['parametrize', mesh, '-o', out, '-o', self.path('out.stl')],
            ['parametrize', mesh, '-o', self.path('missing/out.vtu')],
            ['parametrize', mesh, '-o', out, '--report', self.path('missing/report.json')],
            ['parametrize', mesh, '-o', out, '--report', self.path('report.txt')],
            ['parametrize', mesh, out, 'another'],
        ]:
            with self.subTest(args=args):
                self.refused(USAGE, *args, says='majorant')
                self.assertEqual(self.files(), [])

    def test_bad_output_is_noticed_before_the_work(self):
        # The input does not exist either: errors of outputs come first.
        self.refused(USAGE, 'parametrize', self.path('no.obj'), '-o', self.path('no/out.vtu'),
                     says=['no/out.vtu', 'directory'])

    def test_output_that_cannot_be_written(self):
        os.mkdir(self.path('folder.vtu'))
        self.refused(USAGE, 'parametrize', '--quiet', generated('cap'), '-o',
                     self.path('folder.vtu'), '--degree', '1', says='folder.vtu')
        self.assertEqual(self.files(), ['folder.vtu'])
        self.assertEqual(os.listdir(self.path('folder.vtu')), [])


class Names(CommandTest):
    """Directories, and file names without a format."""

    def setUp(self):
        super().setUp()
        os.mkdir(self.path('folder'))
        self.mesh, self.out = self.write('mesh.obj', obj_text(*grid(3))), self.path('out.obj')
        self.plain = self.write('plain', obj_text(*grid(3)))
        self.layout = self.path('layout.obj')
        self.run_ok('unwrap', self.mesh, self.layout, '-q')

    def inputs(self, name, code_of_volumes):
        """Yields (exit code, words) of runs that read the file, each in place of another kind of input."""
        bake = ['bake', self.layout, '-o', self.path('o.npy'), '--from']
        yield from [(UNREADABLE, words) for words in [
            [name, self.out], [name, '-o', self.out], ['unwrap', name, self.out], ['parametrize', name, self.out],
            ['seamless', name, self.out], ['quads', name, self.out], ['check', name], ['info', name],
            ['check', self.layout, '--surface', name], ['convert', name, self.out], ['compare', name],
            ['compare', self.layout, name, '-o', self.path('o.html')], [*bake, name, '--attribute', 'normal'],
            [*bake, self.mesh, '--image', name]]]
        yield from [(code_of_volumes, words) for words in [
            ['mesh', 'check', name], ['mesh', 'optimize', name, '-o', self.path('o.msh')]]]

    def test_directories(self):
        for name in (self.path('folder'), self.path('folder') + '/'):
            for code, words in self.inputs(name, UNREADABLE):
                self.refused(code, *words, says=name + ': is a directory; name a file')
        for flags in (['--seams'], ['--pins'], ['--weights'], ['--texel-density']):
            self.refused(UNREADABLE, 'unwrap', self.mesh, self.out, *flags, self.path('folder'), says='is a directory')

    def test_names_without_an_extension(self):
        for code, words in self.inputs(self.plain, UNSUPPORTED):
            self.refused(code, *words, says=self.plain + ': the name has no extension, which says the format; rename '
                                                         'the file to end in .')
        self.refused(UNREADABLE, 'info', self.write('plain.gz', b''), says='has no extension before .gz')
        os.rename(self.plain, self.path('plain.obj'))  # with the name that the message suggests
        self.run_ok('info', self.path('plain.obj'))

    def test_files_that_are_not_there(self):
        for code, words in self.inputs(self.path('none'), UNREADABLE):
            self.refused(code, *words, says='none: No such file or directory; check the name')

    def test_outputs(self):
        for name in ('folder', 'folder/'):
            for words in (['unwrap', self.mesh], ['parametrize', self.mesh], ['convert', self.layout],
                          ['quads', self.mesh], ['compare', self.mesh], ['mesh', 'optimize', self.layout],
                          ['bake', self.layout, '--from', self.mesh, '--attribute', 'normal'],
                          ['mesh', 'check', self.layout], ['check', self.layout]):
                self.refused(USAGE, *words, '-o', self.path(name), says=name + ': Is a directory; name a file in it')
            self.refused(USAGE, self.mesh, self.path(name), says=name + ': Is a directory; name a file in it')
            self.refused(USAGE, 'info', self.mesh, '--report', self.path(name), says='Is a directory')


class Unreadable(CommandTest):
    def cases(self):
        good = obj_text(*grid(3))
        return {
            'missing.obj': None,
            'empty.obj': '',
            'binary.obj': bytes(range(256)) * 20,
            'no_faces.obj': good.split('f ')[0],
            'truncated.obj': good[:good.rindex(' ')],
            'letters.obj': good.replace('f 1 2', 'f one 2', 1),
            'range.obj': good + 'f 1 2 17\n',
            'zero.obj': good + 'f 0 1 2\n',
            'negative_range.obj': good + 'f -1 -2 -17\n',
            'overflow.obj': good + 'f 1 2 99999999999999999999\n',
            'nan.obj': good.replace('v 0.0', 'v nan', 1),
            'inf.obj': good.replace('v 0.0', 'v inf', 1),
            'two_numbers.obj': 'v 1 2\n' + good,
            'page.obj': '<!DOCTYPE html>\n<html><body>404</body></html>\n',
            'mesh.xyz': good,
            'noise.ply': 'ply\nformat ascii 1.0\nelement vertex 3\n',
            'noise.off': 'OFF\n3 1 0\n0 0 0\n1 0 0\n',
            'noise.stl': b'\0' * 84,
            'noise.vtu': '<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid">\n',
        }

    def test_every_verb_names_the_file(self):
        for name, content in self.cases().items():
            path = self.path(name) if content is None else self.write(name, content)
            before = self.files()
            with self.subTest(file=name):
                self.refused(UNREADABLE, 'parametrize', path, '-o', self.path('out.vtu'),
                             '--report', self.path('report.json'), says=name)
                with open(self.path('report.json')) as f:
                    self.assertEqual(json.load(f)['status'], 'unreadable')
                os.remove(self.path('report.json'))
                self.refused(UNREADABLE, 'info', path, says=name)
                self.assertEqual(self.files(), before)

    def test_the_line_is_named(self):
        path = self.write('line.obj', 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 x\n')
        self.refused(UNREADABLE, 'info', path, says='line.obj:4:')

    def test_results_and_surfaces(self):
        good = self.path('good.vtu')
        self.run_ok('parametrize', '--quiet', generated('cap'), '-o', good, '--degree', '1')
        broken = self.write('broken.vtu', self.read('good.vtu')[:3000])
        self.refused(UNREADABLE, 'check', broken, says='broken.vtu')
        self.refused(UNREADABLE, 'check', self.path('missing.vtu'), says='missing.vtu')
        self.refused(UNREADABLE, 'check', good, '--surface', self.path('missing.obj'),
                     says='missing.obj')
        self.refused(UNREADABLE, 'convert', broken, '-o', self.path('out.obj'), says='broken.vtu')
        self.assertNotIn('out.obj', self.files())

    def test_pins(self):
        mesh = self.write('mesh.obj', obj_text(*grid(3)))
        for name, text in {
            'truncated.json': '{"handles": [{"vertex": 1, "target": [0, ',
            'no_list.json': '{"pins": []}',
            'range.json': '{"handles": [{"vertex": 16, "target": "initial"}]}',
            'negative.json': '{"handles": [{"vertex": -1, "target": "initial"}]}',
            'no_target.json': '{"handles": [{"vertex": 1}]}',
            'one_number.json': '{"handles": [{"vertex": 1, "target": [0]}]}',
            'twice.json': '{"handles": [{"vertex": 1, "target": [0, 0]}, '
                          '{"vertex": 1, "target": [0, 1]}]}',
        }.items():
            pins = self.write(name, text)
            with self.subTest(file=name):
                self.refused(UNREADABLE, 'parametrize', mesh, '-o', self.path('out.vtu'), '--pins',
                             pins, says=name)
                self.assertNotIn('out.vtu', self.files())
        self.refused(UNREADABLE, 'parametrize', mesh, '-o', self.path('out.vtu'), '--pins',
                     self.path('none.json'), says='none.json')


class Unsupported(CommandTest):
    def cases(self):
        points, faces = grid(4)
        flipped = list(faces)
        flipped[10] = flipped[10][::-1]
        far = [(x + 1e12, y, z) for x, y, z in points]
        flat = list(points)
        flat[7] = tuple((a + b) / 2 for a, b in zip(points[6], points[12]))
        soup = [points[v] for face in faces for v in face]
        strip = [((1 + w * math.cos(t / 2)) * math.cos(t), (1 + w * math.cos(t / 2)) * math.sin(t),
                  w * math.sin(t / 2)) for t in (2 * math.pi * k / 9 for k in range(9))
                 for w in (-0.3, 0.3)]
        turns = [(2 * k, 2 * k + 1) for k in range(9)] + [(1, 0)]
        moebius = [f for (a, b), (c, d) in zip(turns, turns[1:]) for f in ((a, c, b), (b, c, d))]
        two = points + [(x + 3, y, z) for x, y, z in points]
        tetrahedron = ([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)],
                       [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)])
        return {
            'degenerate': ((points[:12] + [points[13]] + points[13:], faces), 'zero area'),
            'collinear': ((flat, faces), 'zero area'),
            'duplicate': ((points, faces + [faces[3]]), 'face 33'),
            'repeated': ((points, faces + [(1, 1, 2)]), 'face 33'),
            'edge': ((points + [(0.5, 0.5, 3)], faces + [(6, 12, 25)]), 'edge (7, 13)'),
            'vertex': (([(0, 0, 0), (1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, -1, 0)],
                        [(0, 1, 2), (0, 3, 4)]), 'vertex 1'),
            'flipped': ((points, flipped), 'orientation'),
            'moebius': ((strip, moebius), 'not orientable'),
            'components': ((two, faces + [tuple(v + 25 for v in f) for f in faces]), '2 components'),
            'soup': ((soup, [(3 * k, 3 * k + 1, 3 * k + 2) for k in range(len(faces))]), 'soup'),
            'closed': (tetrahedron, 'closed'),
            'genus': (torus(8, 6, 1), 'genus 1'),
            'offset': ((far, faces), 'digits'),
        }

    def test_meshes(self):
        for name, (mesh, says) in self.cases().items():
            path = self.write(name + '.obj', obj_text(*mesh))
            before = self.files()
            with self.subTest(mesh=name):
                self.refused(UNSUPPORTED, 'parametrize', path, '-o', self.path('out.vtu'), '-o',
                             self.path('out.obj'), '--report', self.path('report.json'),
                             says=[name + '.obj', says])
                with open(self.path('report.json')) as f:
                    self.assertEqual(json.load(f)['status'], 'unsupported')
                os.remove(self.path('report.json'))
                self.assertEqual(self.files(), before)
                # `info` gives the same explanation and is no failure.
                outcome = self.run_ok('info', path)
                if name == 'annulus':
                    self.assertRegex(outcome.out, 'verdict: parametrize.* can run')
                else:
                    self.assertIn('would refuse', outcome.out)
                    self.assertIn(says, outcome.out)

    def test_texture_coordinates_as_a_start(self):
        points, faces = grid(3)
        uv = [(x, y) for x, y, _ in points]
        run = ['-o', self.path('out.vtu'), '--init', 'input', '--degree', '2']
        plain = self.write('plain.obj', obj_text(points, faces))
        self.refused(UNSUPPORTED, 'parametrize', plain, *run, says='texture coordinates')
        folded = list(uv)
        folded[5] = (0.95, 0.95)
        path = self.write('folded.obj', obj_text(points, faces, folded))
        self.refused(UNSUPPORTED, 'parametrize', path, *run, says=['folded.obj', 'not injective'])
        self.assertNotIn('out.vtu', self.files())
        path = self.write('good.obj', obj_text(points, faces, uv))
        self.run_ok('parametrize', path, *run)
        self.run_ok('check', self.path('out.vtu'), '--surface', path)

    def test_pins_that_contradict_each_other(self):
        mesh = self.write('mesh.obj', obj_text(*grid(4)))
        pins = self.write('pins.json', '{"handles": [{"vertex": 12, "target": [0.3, 0.2]}, '
                                       '{"vertex": 7, "target": [0.3, 0.2]}]}')
        self.refused(UNSUPPORTED, 'parametrize', mesh, '-o', self.path('out.vtu'), '--pins', pins,
                     says=['vertex 7 and vertex 12', "the pins' targets"])
        self.assertEqual(self.files(), ['mesh.obj', 'pins.json'])

    def test_a_pin_on_an_unused_vertex(self):
        points, faces = grid(3)
        mesh = self.write('mesh.obj', obj_text(points + [(9, 9, 9)], faces))
        pins = self.write('pins.json', '{"handles": [{"vertex": 16, "target": "initial"}]}')
        self.refused(UNSUPPORTED, 'parametrize', mesh, '-o', self.path('out.vtu'), '--pins', pins,
                     says=['pins.json', '16'])


class Valid(CommandTest):
    """Unusual calls that must succeed."""

    def test_meshes(self):
        points, faces = grid(4)
        text = obj_text(points, faces)
        n = len(points)
        negative = ''.join('v %r %r %r\n' % p for p in points) + ''.join(
            'f %d %d %d\n' % tuple(v - n for v in f) for f in faces)
        cases = {
            'crlf': text.replace('\n', '\r\n'),
            'negative': negative,
            'reversed': obj_text(points, [f[::-1] for f in faces]),
            'unreferenced': 'v 9 9 9\n' + ''.join('v %r %r %r\n' % p for p in points) + ''.join(
                'f %d %d %d\n' % tuple(v + 2 for v in f) for f in faces),
            'tiny': obj_text([tuple(1e-9 * c for c in p) for p in points], faces),
            'huge': obj_text([tuple(1e9 * c for c in p) for p in points], faces),
            'triangle': obj_text([(0, 0, 0), (3, 0, 0), (0, 4, 1)], [(0, 1, 2)]),
            'quads': obj_text(*quads(4)),
            'polygon': obj_text([(0, 0, 0), (3, 0, 0), (3, 1, 0), (1, 1, 0), (1, 3, 0), (0, 3, 0)],
                                [(0, 1, 2, 3, 4, 5)]),
            'no_final_newline': text[:-1],
            'comments': '# hello\no thing\ng part\n' + text.replace('f ', '\tf\t', 3) + '# end',
        }
        values = {}
        for name, content in cases.items():
            path = self.write(name + '.obj', content)
            with self.subTest(mesh=name):
                self.run_ok('parametrize', path, '-o', self.path('out.vtu'), '--degree', '2',
                            '--report', self.path('r.json'))
                self.run_ok('check', self.path('out.vtu'), '--surface', path)
                self.assertIn('parametrize can run', self.run_ok('info', path).out)
                with open(self.path('r.json')) as f:
                    values[name] = json.load(f)['result']['value']
        for name in ('crlf', 'negative', 'unreferenced', 'no_final_newline', 'comments'):
            self.assertEqual(values[name], values['crlf'], name)
        for name in ('tiny', 'huge', 'reversed'):
            self.assertAlmostEqual(values[name], values['crlf'], delta=1e-9, msg=name)

    @where(os.path.join(SHARED, 'data/public/bad'))
    def test_public_files(self):
        folder = os.path.join(SHARED, 'data/public/bad')
        valid = {'tiny_1e-9', 'negative_indices', 'crlf', 'unreferenced_vertices', 'all_reversed',
                 'single_triangle', 'syntax_zoo', 'quads_and_polygons', 'slivers_1e6', 'annulus'}
        unreadable = {'nan_coordinate', 'inf_coordinate', 'index_out_of_range', 'index_zero',
                      'index_overflow', 'empty', 'no_faces', 'truncated', 'binary_garbage',
                      'html_error_page', 'face_not_a_number', 'vertex_two_coordinates'}
        for name in sorted(os.listdir(folder)):
            base, end = os.path.splitext(name)
            if end != '.obj' or base.startswith('uv_'):
                continue
            with self.subTest(file=name):
                args = ['parametrize', os.path.join(folder, name), '-o', self.path('out.vtu'),
                        '--degree', '2']
                if base in valid:
                    self.run_ok(*args)
                    self.run_ok('check', self.path('out.vtu'))
                    os.remove(self.path('out.vtu'))
                else:
                    self.refused(UNREADABLE if base in unreadable else UNSUPPORTED, *args, says=name)
                    self.assertEqual(self.files(), [])


if __name__ == '__main__':
    main()
