# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Outputs: tested before the work, written one by one; names of all kinds; inputs do not change."""
import os
import resource
import stat
import subprocess

from command_helpers import *

DISK = ['--degree', '1', '--quiet']


def limited(limit, *args):
    """Runs the command with a limit on file sizes."""
    def lower():
        resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
    return Outcome(subprocess.run([BINARY] + [str(a) for a in args], stdin=subprocess.DEVNULL,
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                  preexec_fn=lower, timeout=300))


class BeforeTheWork(CommandTest):
    """The input does not exist: refusals here come before any file is read."""

    def refused_early(self, path, *says, flags=()):
        path = str(path)
        none = self.path('none.obj')
        before = self.files()
        for args in (['parametrize', none, '-o', path], ['convert', self.path('none.vtu'), '-o', path],
                     ['parametrize', none, '-o', self.path('fine.obj'), '-o', path]):
            self.refused(USAGE, *args, *flags, says=[os.path.basename(path)[:40], *says])
            self.assertEqual(self.files(), before)

    def test_a_directory(self):
        os.mkdir(self.path('dir.vtu'))
        self.refused_early(self.path('dir.vtu'), 'Is a directory')

    def test_names(self):
        self.refused_early(self.path('x' * 252 + '.vtu'), 'too long')
        self.refused_early('/'.join(['.'] * 2500) + '/a.vtu', 'too long')
        self.refused_early(self.path('no/a.vtu'), 'directory does not exist')
        self.refused_early('/proc/a.vtu')

    def test_a_loop_of_links(self):
        os.symlink('b.vtu', self.path('a.vtu'))
        os.symlink('a.vtu', self.path('b.vtu'))
        self.refused_early(self.path('a.vtu'), 'symbolic links')

    @unittest.skipIf(os.geteuid() == 0, 'no user but root, to whom everything is permitted')
    def test_permission(self):
        os.mkdir(self.path('closed'), 0o500)
        self.refused_early(self.path('closed/a.vtu'), 'Permission denied')
        os.chmod(self.write('kept.vtu', 'x'), 0o400)
        self.refused_early(self.path('kept.vtu'), 'Permission denied')

    def test_all_kinds_of_outputs(self):
        os.mkdir(self.path('d.json'))
        os.mkdir(self.path('d.vtu'))
        none, good = self.path('none.obj'), self.path('good.vtu')
        report = ['--report', self.path('d.json')]
        for args in (['parametrize', none, '-o', good, *report], ['seamless', none, '-o', good, *report],
                     ['info', none, *report], ['check', self.path('none.vtu'), *report],
                     ['compare', none, *report], ['compare', none, '-o', self.path('d.json')],
                     ['convert', self.path('none.vtu'), '-o', good, *report],
                     ['parametrize', none, '-o', good, '--bijective', '--write-scaffold',
                      self.path('d.vtu')]):
            self.refused(USAGE, *args, says=['d.', 'Is a directory'])
        self.assertEqual(self.files(), ['d.json', 'd.vtu'])

    def test_one_file_under_two_names(self):
        none = self.path('none.obj')
        self.write('old.vtu', 'old')
        os.symlink('old.vtu', self.path('link.vtu'))
        os.symlink('new.vtu', self.path('dangling.vtu'))
        for a, b in (('a.vtu', 'a.vtu'), ('a.vtu', './a.vtu'), ('old.vtu', 'link.vtu'),
                     ('new.vtu', 'dangling.vtu')):
            self.refused(USAGE, 'parametrize', none, '-o', self.path(a), '-o',
                         self.folder + '/' + b, says=['same file', a])
        self.refused(USAGE, 'parametrize', none, '-o', self.path('a.json'), '--report',
                     self.path('a.json'), says='same file')
        self.assertEqual(self.read('old.vtu'), b'old')


class Inputs(CommandTest):
    def setUp(self):
        super().setUp()
        self.mesh = self.write('mesh.obj', self.text())
        self.pins = self.write('pins.json', '{"handles": [{"vertex": 5, "target": "initial"}]}')

    def text(self):
        return obj_text(*grid(3))

    def test_are_not_replaced(self):
        os.symlink('mesh.obj', self.path('link.obj'))
        os.link(self.mesh, self.path('hard.obj'))
        before = self.files()
        for out in ('mesh.obj', 'link.obj', 'hard.obj', './mesh.obj'):
            self.refused(USAGE, 'parametrize', self.mesh, self.folder + '/' + out, *DISK,
                         says=['--force', out])
        self.refused(USAGE, 'parametrize', self.path('link.obj'), self.mesh, *DISK, says='--force')
        for option in ('--pins', '--handles', '--weights'):
            self.refused(USAGE, 'parametrize', self.mesh, '-o', self.path('a.vtu'), option, self.pins,
                         '--report', self.pins, *DISK, says=['--force', 'pins.json'])
        self.refused(USAGE, 'seamless', self.mesh, '-o', self.path('a.vtu'), '--cones', self.pins,
                     '--report', self.pins, says='--force')
        self.assertEqual(self.files(), before)
        self.assertEqual(self.read('mesh.obj').decode(), self.text())

    def test_force(self):
        self.run_ok('parametrize', self.mesh, self.mesh, '--force', *DISK)
        self.assertIn(b'vt ', self.read('mesh.obj'))
        self.run_ok('check', self.mesh)
        self.run_ok('convert', self.mesh, self.mesh, '--force')
        self.assertEqual(self.files(), ['mesh.obj', 'pins.json'])


class EachOnItsOwn(CommandTest):
    def test_too_large_for_the_disk(self):
        """The largest of three files fails: no part of it remains, and the old file stays."""
        out, small, report = self.write('big.vtu', 'old'), self.path('a.svg'), self.path('r.json')
        job = ('parametrize', generated('cap'), '-o', out, '-o', small, '--report', report,
               '--degree', '8', '--max-iterations', '2', '--force')
        limit = 400000
        outcome = limited(limit, *job)
        self.assertEqual(outcome.code, USAGE, outcome.err)
        last = outcome.err.splitlines()[-1]
        for part in ('cannot write ' + out, 'File too large', 'written: %s, %s' % (small, report)):
            self.assertIn(part, last)
        self.assertEqual(self.files(), ['a.svg', 'big.vtu', 'r.json'])
        self.assertEqual(self.read('big.vtu'), b'old')
        with open(report) as f:
            outputs = json.load(f)['outputs']
        self.assertEqual([(o['file'], o['written']) for o in outputs], [(out, False), (small, True)])

    def test_a_full_device(self):
        os.symlink('/dev/full', self.path('full.vtu'))
        for order in (('full.vtu', 'ok.obj'), ('ok.obj', 'full.vtu')):
            outputs = [a for name in order for a in ('-o', self.path(name))]
            outcome = self.run_ok('parametrize', generated('cap'), *outputs, *DISK, code=USAGE)
            self.assertIn('No space left', outcome.err)
            self.assertIn('written: ' + self.path('ok.obj'), outcome.err)
            self.run_ok('check', self.path('ok.obj'))
            os.unlink(self.path('ok.obj'))
            outcome = self.run_ok('convert', generated_map(self), *outputs, code=USAGE)
            self.assertIn('written: ' + self.path('ok.obj'), outcome.err)
            os.unlink(self.path('ok.obj'))
        self.assertEqual(self.files(), ['full.vtu', 'map.vtu'])

    def test_reports_of_compare(self):
        os.symlink('/dev/full', self.path('full.csv'))
        outcome = self.run_ok('compare', generated('cap'), '--degree', '1', '--methods', 'newton',
                              '--max-iterations', '2', '--quiet', '-o', self.path('full.csv'), '-o',
                              self.path('ok.html'), '--report', self.path('ok.json'), code=USAGE)
        self.assertIn('full.csv', outcome.err)
        self.assertEqual(self.files(), ['full.csv', 'ok.html', 'ok.json'])


def generated_map(test):
    test.run_ok('parametrize', generated('cap'), '-o', test.path('map.vtu'), *DISK)
    return test.path('map.vtu')


class Names(CommandTest):
    def test_as_long_as_names_may_be(self):
        for extension in ('.vtu', '.obj', '.svg', '.json', '.csv'):
            name = 'x' * (255 - len(extension)) + extension
            self.run_ok('parametrize', generated('cap'), '-o', self.path(name), *DISK)
            self.assertEqual(self.files(), [name])
            os.unlink(self.path(name))

    def test_a_dangling_link_is_followed(self):
        os.mkdir(self.path('there'))
        os.symlink('there/target.obj', self.path('link.obj'))
        self.run_ok('parametrize', generated('cap'), self.path('link.obj'), *DISK)
        self.assertTrue(os.path.islink(self.path('link.obj')))
        self.assertEqual(os.listdir(self.path('there')), ['target.obj'])

    def test_permissions_stay(self):
        os.chmod(self.write('a.obj', ''), 0o666)
        self.run_ok('parametrize', generated('cap'), self.path('a.obj'), *DISK)
        self.assertEqual(stat.S_IMODE(os.stat(self.path('a.obj')).st_mode), 0o666)

    def byte_path(self, name):
        return os.fsencode(self.folder) + b'/' + name

    def test_bytes_that_are_not_utf8(self):
        """Every file of a run has such a name, also in claims, reports and messages."""
        mesh, pins, weights = (self.byte_path(n) for n in (b'm\xe9.obj', b'p\xe9.json', b'w\xe9.txt'))
        points, faces = grid(3)
        for path, text in ((mesh, obj_text(points, faces)), (weights, '1\n' * len(faces)),
                           (pins, '{"handles": [{"vertex": 5, "target": "initial"}]}')):
            with open(path, 'w') as f:
                f.write(text)
        out, report = self.byte_path(b'o\xe9.vtu'), self.byte_path(b'r\xe9.json')

        def run(code, *args):
            done = subprocess.run([BINARY] + list(args), stdin=subprocess.DEVNULL,
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=300)
            self.assertEqual(done.returncode, code, done.stderr)
            return done

        def message():
            with open(report, encoding='utf-8') as f:
                return json.load(f)

        for option, path in (('--pins', pins), ('--handles', pins), ('--weights', weights)):
            run(OK, 'parametrize', mesh, '-o', out, option, path, '--report', report, '--degree', '1')
            data = message()
            self.assertTrue(data['input']['file'].endswith('m\ufffd.obj'))
            self.assertIn('\ufffd', data['options'][option[2:]])
            run(OK, 'check', out, '--surface', mesh, '--report', report)
        run(OK, 'info', mesh, '--report', report)
        run(OK, 'convert', out, '-o', self.byte_path(b'c\xe9.obj'), '--report', report)
        run(OK, 'compare', mesh, '--degree', '1', '--methods', 'newton', '--max-iterations', '2',
            '-o', self.byte_path(b'h\xe9.html'), '--report', report)
        self.assertIn('\ufffd', message()['result']['title'])
        self.assertIn(b'x\xe9.obj', run(UNREADABLE, 'info', self.byte_path(b'x\xe9.obj')).stderr)


class Infeasible(CommandTest):
    def test_no_map_is_written(self):
        """A very distant handle makes every energy infinite, so that there is no feasible start."""
        far = '{"handles": [{"vertex": 5, "target": [1e300, 0]}]}'
        handles = self.write('far.json', far)
        self.write('old.vtu', 'old')
        before = self.files()
        for flags in (['--quiet'], []):
            outcome = majorant('parametrize', generated('wavy_disk'), '-o', self.path('old.vtu'), '-o',
                               self.path('new.obj'), '-o', self.path('t.csv'), '--handles', handles,
                               '--degree', '2', '--force', *flags)
            self.assertEqual(outcome.code, UNSUPPORTED, outcome.err)
            self.assertEqual(len(outcome.err.splitlines()), 1, outcome.err)
            self.assertEqual(self.files(), before)
        self.assertEqual(self.read('old.vtu'), b'old')


if __name__ == '__main__':
    main()
