#!/usr/bin/python3
"""The C++ snippets of README.md, put together into one program, compile against the headers."""
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ['MAJORANT_SOURCE_DIR'])
BUILD = pathlib.Path(os.environ['MAJORANT_BUILD_DIR'])


class Readme(unittest.TestCase):
    def test_snippets_compile(self):
        blocks = re.findall(r'```cpp\n(.*?)```', (SOURCE / 'README.md').read_text(), re.S)
        self.assertEqual(len(blocks), 2)
        lines = '\n'.join(blocks).splitlines()
        top = [line for line in lines if line.startswith(('#include', 'using namespace'))]
        body = [line for line in lines if line not in top]
        program = '\n'.join(['#include "majorant/energies/make_energy.h"', *top,
                             'int main() {', *body, 'return uv.allFinite() ? 0 : 1; }'])
        layers = 'framework elements energies constraints parametrization io'.split()
        includes = ['-I%s' % (BUILD / 'include' / layer) for layer in layers]
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / 'readme.cpp'
            path.write_text(program)
            done = subprocess.run(['c++', '-std=c++20', '-fsyntax-only', '-Wall', *includes,
                                   '-isystem', '/usr/include/eigen3', str(path)],
                                  capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == '__main__':
    unittest.main()
