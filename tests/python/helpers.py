# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Shared code of the tests of the Python package: the package of the build tree, and meshes.

A test file runs under pytest, from ctest or by itself:

    if __name__ == '__main__':
        helpers.main(__file__)
"""
import os
import subprocess
import sys
from pathlib import Path

SOURCE = Path(os.environ['MAJORANT_SOURCE_DIR'])
BUILD = Path(os.environ['MAJORANT_BUILD_DIR'])
BINARY = os.environ['MAJORANT_BINARY']
PACKAGE = BUILD / 'python'
MESHES = SOURCE / 'examples/meshes'


def main(file):
    import pytest
    sys.exit(pytest.main(['-q', '-p', 'no:cacheprovider', '--tb=short', *sys.argv[1:], file]))


if not list(PACKAGE.glob('majorant/_core*.so')):
    print('skipped: the Python package is not built; the configuration said what it misses')
    sys.exit(77)
sys.path.insert(0, str(PACKAGE))
sys.dont_write_bytecode = True
HAS_GPL_PARTS = 'MAJORANT_GPL:BOOL=ON' in (BUILD / 'CMakeCache.txt').read_text()


def of_ceres(*methods):
    """Returns parameters of a test for these methods, which are skipped in a build without Ceres."""
    import pytest
    without = pytest.mark.skipif(not HAS_GPL_PARTS, reason='no Ceres, which is under the GPL, in this build')
    return [pytest.param(method, marks=without) for method in methods]


def environment():
    """Returns the environment of a new interpreter that finds the package."""
    return {**os.environ, 'PYTHONPATH': str(PACKAGE), 'PYTHONDONTWRITEBYTECODE': '1'}


def command(*words, code=0):
    done = subprocess.run([BINARY, *map(str, words)], capture_output=True, text=True)
    assert done.returncode == code, done.stderr
    return done


def mesh(name):
    import majorant
    return majorant.read_mesh(MESHES / f'{name}.obj')


def grid(n, bump=0.3):
    """Returns a bumpy square of 2 n^2 triangles."""
    import numpy as np
    x, y = np.meshgrid(np.linspace(0, 1, n + 1), np.linspace(0, 1, n + 1))
    V = np.column_stack([x.ravel(), y.ravel(), bump * np.sin(3 * x.ravel()) * np.cos(4 * y.ravel())])
    k = np.arange((n + 1) ** 2).reshape(n + 1, n + 1)
    a, b, c, d = k[:-1, :-1].ravel(), k[:-1, 1:].ravel(), k[1:, 1:].ravel(), k[1:, :-1].ravel()
    return V, np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])])


def torus(n=6):
    """Returns a torus of n by n quadrangles of two triangles each."""
    import numpy as np
    i, j = (k.ravel() for k in np.meshgrid(np.arange(n), np.arange(n), indexing='ij'))
    a, b = 2 * np.pi * i / n, 2 * np.pi * j / n
    V = np.column_stack([(3 + np.cos(b)) * np.cos(a), (3 + np.cos(b)) * np.sin(a), np.sin(b)])
    p, q, r, s = i * n + j, (i + 1) % n * n + j, (i + 1) % n * n + (j + 1) % n, i * n + (j + 1) % n
    return V, np.stack([np.column_stack([p, q, r]), np.column_stack([p, r, s])], axis=1).reshape(-1, 3)


def octahedron():
    import numpy as np
    V = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], float)
    F = np.array([[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]])
    return V, F
