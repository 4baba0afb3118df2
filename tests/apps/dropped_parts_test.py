# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Broken parts of a mesh that do not belong to its shape are left out with a warning that names file and line. They are
refused with --strict and if they are required, and are not in outputs."""
import json
import math

from command_helpers import *

POINTS, FACES = grid(4)
UV = [(x, y) for x, y, _ in POINTS]


def obj(corner='{0}/{0}/1', colour='', uv=UV, normals='vn 0 0 1\n', end=''):
    """Returns an OBJ of POINTS and FACES. corner: the text of a corner with this number."""
    lines = ['v %r %r %r%s' % (*p, colour if k == 6 else '') for k, p in enumerate(POINTS)]
    lines += ['vt %s %s' % t for t in uv]
    faces = ['f ' + ' '.join(corner.format(v + 1) for v in face) for face in FACES]
    return '\n'.join(lines) + '\n' + normals + '\n'.join(faces) + '\n' + end


def ply(names=('s', 't'), bad='0.25', end=''):
    """Returns a PLY. The third vertex has `bad` as its second texture coordinate."""
    rows = ['%r %r %r %s %s' % (*p, t[0], bad if k == 2 else t[1]) for k, (p, t) in enumerate(zip(POINTS, UV))]
    header = ('ply\nformat ascii 1.0\nelement vertex %d\n' % len(rows) +
              ''.join('property double %s\n' % n for n in ('x', 'y', 'z', *names)) +
              'element face %d\nproperty list uchar int vertex_indices\nend_header\n' % len(FACES))
    return header + '\n'.join(rows + ['3 %d %d %d' % f for f in FACES]) + '\n' + end


def off(face='', end=''):
    rows = ['%r %r %r' % p for p in POINTS] + ['3 %d %d %d%s' % (*f, face) for f in FACES]
    return 'OFF\n%d %d 0\n' % (len(POINTS), len(FACES)) + '\n'.join(rows) + '\n' + end


V, VT = len(POINTS), len(UV)
NAN_UV = [('nan', 0)] + UV[1:]
# name, text, line of the first defect, its message, whether it concerns texture coordinates
CASES = [
    ('nancolor.obj', obj(colour=' nan 0 1'), 7, "colour 'nan' is not finite: left out", False),
    ('word.obj', obj(colour=' red'), 7, "colour 'red' is not a number: left out", False),
    ('jacked.obj', obj('{0}/{0}/'), V + VT + 2, "'1/1/' ends with a slash: read without it, as are 95 more", False),
    ('normals.obj', obj('{0}//1', normals='', uv=[]), V + 1,
     'vn index 1 out of range, the file has 0: the face is read without normals, as are 31 more', False),
    ('normal.obj', obj(normals='vn 0 0 inf\n'), V + VT + 1, "normal component 'inf' is not finite", False),
    ('cubevt.obj', obj('{0}/{0}', uv=[], normals=''), V + 1,
     'vt index 1 out of range, the file has 0: the face is read without texture coordinates, as are 31 more', True),
    ('zero.obj', obj('{0}/0/1'), V + VT + 2, 'vt index 0, OBJ counts from 1', True),
    ('nan_vt.obj', obj(uv=NAN_UV), V + 1, "texture coordinate 'nan' is not finite: left out", True),
    ('line.obj', obj(end='l 1 99\n'), V + VT + 2 + len(FACES), 'v index 99 out of range, the file has 25: left out',
     False),
    ('cube.off', off(end='3 0 1 2\n'), 3 + V + len(FACES), 'one line more than 25 vertices and 32 faces: left out',
     False),
    ('colour.off', off(face=' 1 0 x'), 3 + V, "face colour 'x' is not a number: left out, as are 31 more", False),
    ('more.ply', ply(end='3 0 1 2\n'), 12 + V + len(FACES), 'one line more than the header announces', False),
    ('st.ply', ply(bad='nan'), 14, 'a texture coordinate is no finite number: left out', True),
    ('names.ply', ply(('texcoord_u', 'texcoord_v'), bad='nan'), 14, 'a texture coordinate is no finite', True),
]

class DroppedParts(CommandTest):
    def test_left_out_with_a_warning(self):
        for name, text, line, says, _ in CASES:
            path, out = self.write(name, text), self.path('out.obj')
            for verb in ('unwrap', 'parametrize'):
                with self.subTest(name=name, verb=verb):
                    outcome = self.run_ok(verb, path, '-o', out, '--quiet', '--report', self.path('r.json'))
                    warned = [w for w in outcome.err.splitlines() if 'warning' in w]
                    self.assertIn('majorant: warning: %s:%d: %s' % (path, line, says), warned[0])
                    with open(self.path('r.json')) as f:
                        report = json.load(f)
                    self.assertEqual(['majorant: warning: ' + w for w in report['warnings']], warned)
                    self.assertEqual(report['warnings'], report['input']['warnings'])
                    self.judge_output(out)
                    self.run_ok('check', out, '--surface', path, '--cuts', 'free', '--quiet')
            self.assertIn('warning: %s:%d: %s' % (path, line, says), self.run_ok('info', path).out)

    def judge_output(self, out):
        """Tests that every number is finite and every index valid."""
        counts, kinds = dict.fromkeys(('v', 'vt', 'vn'), 0), ('v', 'vt', 'vn')
        for words in (line.split() for line in self.read(out.split('/')[-1]).decode().splitlines()):
            if words[0] in counts:
                counts[words[0]] += 1
                self.assertTrue(all(math.isfinite(float(w)) for w in words[1:]), words)
            if words[0] == 'f':
                for corner in words[1:]:
                    for kind, index in zip(kinds, corner.split('/')):
                        if index:
                            self.assertTrue(1 <= int(index) <= counts[kind], (kind, corner))
            if words[0] == 'l':
                self.assertTrue(all(1 <= int(w) <= counts['v'] for w in words[1:]))

    def test_refused_with_strict(self):
        for name, text, line, says, _ in CASES:
            path, out = self.write(name, text), self.path('out.vtu')
            problem = says.split(': ')[0]
            for run in (['unwrap', path, '-o', out], ['parametrize', path, '-o', out], ['info', path],
                        ['seamless', path, '-o', out], ['compare', path, '--methods', 'newton']):
                with self.subTest(name=name, run=run[0]):
                    self.refused(UNREADABLE, *run, '--strict', '--quiet',
                                 says=('%s:%d: %s' % (path, line, problem), 'correct the file'))
            self.assertNotIn('out.vtu', self.files())
        for verb in ('unwrap', 'parametrize'):
            self.run_ok(verb, self.write('good.obj', obj()), '-o', self.path('out.vtu'), '--quiet', '--strict')

    def test_refused_if_the_dropped_part_is_needed(self):
        for name, text, line, says, of_uv in CASES:
            path, out = self.write(name, text), self.path('out.vtu')
            for run in (['unwrap', path, '--seams', 'uv'], ['parametrize', path, '--init', 'input'],
                        ['parametrize', path, '--seamless'], ['parametrize', path, '--seams', 'uv'],
                        ['compare', path, '--init', 'input', '--methods', 'newton']):
                with self.subTest(name=name, run=run):
                    outputs = ['-o', out] if run[0] != 'compare' else ['-o', self.path('out.csv')]
                    if of_uv:
                        self.refused(UNREADABLE, *run, *outputs, '--quiet', says='%s:%d: ' % (path, line))
                    else:
                        self.assertNotEqual(majorant(*run, *outputs, '--quiet').code, UNREADABLE)

    def test_results_need_their_texture_coordinates(self):
        for name, text, line, says, of_uv in CASES:
            path = self.write(name, text)
            if of_uv:
                self.refused(UNREADABLE, 'check', path, says='%s:%d: ' % (path, line))
                self.refused(UNREADABLE, 'convert', path, '-o', self.path('o.vtu'), says='%s:%d: ' % (path, line))
        bad = self.write('normal.obj', obj(normals='vn 0 0 inf\n'))
        self.run_ok('check', bad, '--quiet', '--report', self.path('r.json'))
        with open(self.path('r.json')) as f:
            self.assertEqual(len(json.load(f)['warnings']), 2)
        for verb in (['check', bad], ['convert', bad, '-o', self.path('o.vtu')],
                     ['check', self.write('good.obj', obj()), '--surface', bad]):
            self.refused(UNREADABLE, *verb, '--quiet', '--strict', says='%s:' % bad)

    def test_shapes_stay_strict(self):
        for text in [obj('{0}x/{0}'), obj('{0}/{0}/1/2'), obj().replace('v 0.25 ', 'v nan '),
                     obj(end='f 1 2 99\n'), obj(end='f 1 2\n'), obj(normals='vn 0 0 v 1 1 1\n'),
                     obj(colour=' v 1 0 0'), obj(normals='vn 0 0 f 1 2 3\n')]:
            self.refused(UNREADABLE, 'unwrap', self.write('bad.obj', text), '-o', self.path('o.obj'), '--quiet',
                         says='bad.obj:')
        for text in [off(end='3 0 1 2\n3 0 1 2\n'), off().replace('3 0 1 6', '3 0 1 99')]:
            self.refused(UNREADABLE, 'unwrap', self.write('bad.off', text), '-o', self.path('o.obj'), '--quiet',
                         says='bad.off:')
        for text in [ply(end='3 0 1 2\n3 0 1 2\n'), ply().replace('\n3 0 1 6', '\n3 0 1 x')]:
            self.refused(UNREADABLE, 'unwrap', self.write('bad.ply', text), '-o', self.path('o.obj'), '--quiet',
                         says='bad.ply:')

    def test_texture_coordinates_of_other_faces_stay(self):
        """One face has no coordinates: --seams uv is refused; otherwise the other faces are cut along theirs."""
        path = self.write('a.obj', obj(uv=UV[:-1]))
        outcome = self.run_ok('parametrize', path, '-o', self.path('o.obj'), '--quiet')
        self.assertIn('a.obj:%d: vt index 25 out of range, the file has 24' % (V + VT + 1 + 30), outcome.err)

    def test_handles_with_weights(self):
        mesh = generated('cap')
        path = self.write('h.json', '{"handles": [{"vertex": 0, "target": [0, 0], "weight": 5, "name": "tip"}]}')
        self.refused(UNREADABLE, 'parametrize', mesh, '-o', self.path('o.vtu'), '--handles', path,
                     says=['h.json', 'weight'])


if __name__ == '__main__':
    main()
