# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Small files that expand to large ones, with little memory: exit code 3 and a line, not a killed process.

The memory is limited by a control group if this machine lets a test make one, else by MAJORANT_READING_BYTES, which
kills no process."""
import base64
import gzip
import os
import struct
import subprocess
import zlib

from command_helpers import *

MIB = 1 << 20
MEMORY = 200 * MIB


def control_group():
    """Returns the folder of a control group with so much memory; None if tests may not make one."""
    with open('/proc/self/cgroup') as f:
        groups = [line.rstrip('\n').split(':', 2) for line in f]
    for _, controllers, name in groups:
        roots = {'memory': ('/sys/fs/cgroup/memory', 'memory.limit_in_bytes', 'memory.memsw.limit_in_bytes'),
                 '': ('/sys/fs/cgroup', 'memory.max', 'memory.swap.max')}
        if controllers not in roots:
            continue
        root, limit, swap = roots[controllers]
        for parent in (root + name, root):
            folder = os.path.join(parent, 'majorant_test_%d' % os.getpid())
            try:
                os.mkdir(folder)
            except OSError:
                continue
            try:
                with open(os.path.join(folder, limit), 'w') as f:
                    f.write(str(MEMORY))
                return folder
            except OSError:
                os.rmdir(folder)
    return None


class Bombs(CommandTest):
    @classmethod
    def setUpClass(cls):
        cls.group = control_group()

    @classmethod
    def tearDownClass(cls):
        if cls.group:
            os.rmdir(cls.group)

    def run_within(self, *args):
        environment = dict(os.environ)
        if not self.group:
            environment['MAJORANT_READING_BYTES'] = str(MEMORY)

        def enter():
            if self.group:
                with open(os.path.join(self.group, 'cgroup.procs'), 'w') as f:
                    f.write(str(os.getpid()))
        return Outcome(subprocess.run([BINARY] + [str(a) for a in args], stdin=subprocess.DEVNULL, text=True,
                                      stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=environment,
                                      preexec_fn=enter, timeout=120))

    def check_refused(self, file, says='', verbs=('info', 'parametrize', 'unwrap', 'check', 'convert')):
        outputs = {'info': (), 'check': ()}
        for verb in verbs:
            with self.subTest(verb=verb, file=os.path.basename(file)):
                words = outputs.get(verb, ('-o', self.path('out.vtu')))
                done = self.run_within(verb, file, *words)
                self.assertEqual(done.code, UNSUPPORTED, done.err)
                self.assertEqual(done.err.count('\n'), 1, done.err)
                self.assertIn(file, done.err)
                self.assertIn(says, done.err)
                self.assertFalse(os.path.exists(self.path('out.vtu')))

    def gz(self, name, pieces):
        with gzip.open(self.path(name), 'wb', compresslevel=9) as f:
            for piece in pieces:
                f.write(piece)
        self.assertLess(os.path.getsize(self.path(name)), 8 * MIB)
        return self.path(name)

    def test_a_compressed_mesh(self):
        self.check_refused(self.gz('bomb.obj.gz', [b'\n' * MIB] * 1000), 'MB')

    def test_a_compressed_result(self):
        self.check_refused(self.gz('bomb.vtu.gz', [b' ' * MIB] * 500), 'MB', ('check', 'convert', 'info'))

    def test_files_that_fit_as_text_but_not_as_a_mesh(self):
        self.check_refused(self.gz('bomb.obj.gz', [b'v 0 0 0\n' * (MIB // 8)] * 80))

    def test_a_mesh_as_large_as_it_says(self):
        with open(self.path('large.stl'), 'wb') as f:
            f.truncate(400 * MIB)
        self.check_refused(self.path('large.stl'), 'MB', ('info',))

    def test_lists_of_a_ply(self):
        """Lists without entries take one byte each in the file, and far more in memory."""
        header = ('ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n'
                  'property float z\nelement face %d\nproperty list uchar uchar vertex_indices\nend_header\n')
        faces = b'\3\0\1\2' * (MIB // 4)
        path = self.path('lists.ply')
        with open(path, 'wb') as f:
            f.write((header % (30 * MIB // 4)).encode() + struct.pack('<9f', 0, 0, 0, 1, 0, 0, 0, 1, 0))
            for _ in range(30):
                f.write(faces)
        self.check_refused(path, verbs=('info',))

    def test_arrays_of_a_vtu(self):
        """The sizes of zlib blocks, base64 and raw arrays, and their memory as numbers."""
        self.run_ok('parametrize', generated('cap'), '-o', self.path('a.vtu'), '--degree', '1')
        text = self.read('a.vtu').decode()
        block = zlib.compress(b'\5' * (32 * MIB), 9)
        packed = struct.pack('<3Q', 4, 32 * MIB, 0) + struct.pack('<4Q', *[len(block)] * 4)
        encoded = base64.b64encode(packed).decode() + base64.b64encode(block * 4).decode()
        text = text.replace('header_type', 'compressor="vtkZLibDataCompressor" header_type', 1)
        bomb = re.sub(r'(Name="types"[^>]*>\n)[^<]*', lambda m: m.group(1) + encoded + '\n', text)
        for array in ('Points', 'connectivity', 'offsets', 'uv'):
            bomb = re.sub(r'(<DataArray[^>]*Name="%s"[^>]*>\n)[^<]*' % array,
                          lambda m: m.group(1) + encoded + '\n', bomb)
        self.assertLess(len(bomb), 8 * MIB)
        self.check_refused(self.write('bomb.vtu', bomb), verbs=('check', 'convert', 'info'))

    def test_files_that_fit_are_read(self):
        with open(generated('creature'), 'rb') as f:
            mesh = self.gz('mesh.obj.gz', [f.read()])
        self.assertEqual(self.run_within('info', mesh).code, OK)


if __name__ == '__main__':
    main()
