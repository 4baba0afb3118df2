# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Builds the module majorant._core with CMake: pip install --no-build-isolation ."""
import os
import re
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent


class CMakeBuild(build_ext):
    """Builds the target majorant_python in a build tree below setuptools' own, and puts the module where the
    wheel expects it. CMAKE_ARGS adds to the configuration. MAJORANT_BUILD_TREE names a tree that already has
    the module for the same Python: nothing is compiled then."""

    def build_extension(self, extension):
        given = os.environ.get('MAJORANT_BUILD_TREE')
        tree = Path(given or self.build_temp).resolve()
        if not given:
            self.build_tree(tree)
        destination = Path(self.get_ext_fullpath(extension.name)).resolve().parent
        destination.mkdir(parents=True, exist_ok=True)
        modules = list((tree / 'python/majorant').glob('_core*.so'))
        if len(modules) != 1:
            raise RuntimeError(f'no module in {tree}: are pybind11, numpy and the headers of Python there?')
        parts = [path for path in (tree / 'python/majorant').glob('_*.so') if path not in modules]
        for path in modules + parts:
            self.copy_file(str(path), str(destination / path.name))

    def build_tree(self, tree):
        tree.mkdir(parents=True, exist_ok=True)
        others = ['APPS', 'TESTS', 'BENCH', 'EXAMPLES']
        subprocess.check_call(
            ['cmake', '-S', ROOT, '-B', tree, '-DCMAKE_BUILD_TYPE=Release', f'-DPython_EXECUTABLE={sys.executable}',
             '-DBUILD_SHARED_LIBS=OFF', '-DMAJORANT_BUILD_PYTHON=ON',
             *(f'-DMAJORANT_BUILD_{name}=OFF' for name in others),
             *os.environ.get('CMAKE_ARGS', '').split()])
        subprocess.check_call(['cmake', '--build', tree, '--parallel', str(self.parallel or os.cpu_count()),
                               '--target', 'majorant_python'])


setup(version=re.search(r'project\(majorant VERSION (\S+)', (ROOT / 'CMakeLists.txt').read_text())[1],
      ext_modules=[Extension('majorant._core', [])], cmdclass={'build_ext': CMakeBuild})
