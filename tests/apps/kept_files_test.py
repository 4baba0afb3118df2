# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""No existing file is lost: inputs of a run, meshes by other programs; and - for standard input and output."""
import gzip
import shutil
import struct

from command_helpers import *


class KeptFiles(CommandTest):
    def copy(self, name, to):
        shutil.copy(generated(name), self.path(to))
        return self.path(to)

    def refused_to_replace(self, output, *args):
        before = self.read(output)
        done = majorant(*args)
        self.assertEqual((done.code, done.err.count('\n')), (USAGE, 1), done.err)
        for part in (output, '--force'):
            self.assertIn(part, done.err)
        self.assertEqual(self.read(output), before)

    def test_a_glob_of_a_shell(self):
        a, b = self.copy('cap', 'a.obj'), self.copy('tube', 'b.obj')
        self.refused_to_replace('b.obj', a, b)
        self.run_ok(a, b, '--force', '--quiet')
        self.run_ok(a, b, '--quiet')  # the file now has our mark

    def test_every_format_of_meshes(self):
        mesh = self.copy('cap', 'a.obj')
        for extension in ('.obj', '.ply', '.vtu', '.msh', '.glb', '.gltf'):
            with self.subTest(extension=extension):
                output = 'out' + extension
                self.run_ok('unwrap', mesh, '-o', self.path(output), '--quiet')
                self.run_ok('unwrap', mesh, '-o', self.path(output), '--quiet')  # our own file may be replaced
                self.write(output, 'of somebody else')
                self.refused_to_replace(output, 'unwrap', mesh, '-o', self.path(output))
                self.write(output, '')  # an empty file may be replaced
                self.run_ok('unwrap', mesh, '-o', self.path(output), '--quiet')

    def test_files_that_are_no_meshes_are_replaced(self):
        mesh = self.copy('cap', 'a.obj')
        for output in ('out.svg', 'out.html', 'out.json', 'out.csv'):
            self.write(output, 'old')
            self.run_ok('parametrize', mesh, '-o', self.path(output), '-o', self.path('a.vtu'), '--degree', 1, '--quiet')
            self.assertNotEqual(self.read(output), b'old')

    def test_the_commands_of_the_readme_twice(self):
        """The commands on the bundled meshes: of `make demo`, and the second one."""
        with open(os.path.join(SOURCE, 'README.md')) as f:
            line = re.search(r'^build/release/apps/majorant (.*)$', f.read(), re.MULTILINE)[1].split()
        with open(os.path.join(SOURCE, 'Makefile')) as f:
            demo = re.search(r'@\$\(BINARY\) (.*?--report \S+)', f.read(), re.DOTALL)[1]
        demo = demo.replace('\\\n', ' ').replace('$(OUT)/', '').split()
        for words in (line, demo):
            words = [os.path.join(SOURCE, word) if word.startswith('examples/') else word for word in words]
            for _ in range(2):
                done = majorant(*words, cwd=self.folder)
                self.assertEqual(done.code, OK, done.err)

    def test_files_named_by_an_input_are_kept(self):
        """Files that an input names, by their names, through a link, and in another folder."""
        picture = self.path('skin.png')
        self.run_ok('parametrize', generated('cap'), '-o', picture, '--degree', 1, '--quiet', '--size', 64)
        mesh = self.copy('cap', 'a.obj')
        self.write('a.mtl', 'newmtl m\nmap_Kd -o 0 0 0 skin.png\n')
        with open(mesh) as f:
            text = f.read()
        self.write('a.obj', 'mtllib a.mtl\nusemtl m\n' + text)
        os.symlink(picture, self.path('link.png'))
        os.link(picture, self.path('hard.png'))
        for output in ('skin.png', 'link.png', 'hard.png', os.path.join('.', 'skin.png')):
            with self.subTest(output=output):
                self.refused_to_replace(output, 'parametrize', mesh, '-o', self.path(output), '--degree', 1)
        self.run_ok('parametrize', mesh, '-o', picture, '--degree', 1, '--force', '--quiet')


class StandardStreams(CommandTest):
    def piped(self, data, *args, code=OK):
        done = subprocess.run([BINARY, *map(str, args)], input=data, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              cwd=self.folder, timeout=300)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def mesh(self):
        with open(generated('cap'), 'rb') as f:
            return f.read()

    def test_in_and_out(self):
        self.run_ok('unwrap', generated('cap'), '-o', self.path('file.obj'), '--quiet')
        done = self.piped(self.mesh(), '-', '-', '--format', 'obj', '--quiet')
        self.assertEqual(done.stdout, self.read('file.obj'))
        self.assertEqual(done.stderr, b'')
        done = self.piped(self.mesh(), 'unwrap', '-', '-o', '-', '--format', 'obj,glb')
        self.assertEqual(struct.unpack('<4sI', done.stdout[:8]), (b'glTF', 2))
        self.assertNotIn(b'proof:', done.stderr)
        done = self.piped(gzip.compress(self.mesh()), 'info', '-', '--format', 'obj.gz')
        self.assertIn(b'/dev/stdin.obj.gz', done.stdout)
        self.assertEqual(self.files(), ['file.obj'])

    def test_wrong_calls(self):
        for words, part in ((['-', '-o', 'a.obj'], '--format obj'),
                            (['-', '-o', '-', '--report', '-', '--format', 'obj'], 'into each other'),
                            (['-', '-o', '-', '--format', 'fbx'], 'fbx'),
                            ([generated('cap'), '-o', 'a.obj', '--format', 'obj'], 'no file is -'),
                            (['bake', '-', '--from', generated('cap'), '--attribute', 'position', '-o', '-', '--format',
                              'obj,npy'], 'texture coordinates')):
            with self.subTest(words=words):
                done = subprocess.run([BINARY, *words], input=self.mesh(), stdout=subprocess.PIPE,
                                      stderr=subprocess.PIPE, cwd=self.folder, timeout=300)
                self.assertIn(done.returncode, (USAGE, UNREADABLE, UNSUPPORTED), done.stderr)
                self.assertIn(part.encode(), done.stderr)
                self.assertEqual((done.stdout, done.stderr.count(b'\n')), (b'', 1), done.stderr)
        self.assertEqual(self.files(), [])


if __name__ == '__main__':
    main()
