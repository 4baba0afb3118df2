#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""`pip install .` of the module that the build tree has, and examples with what was installed, elsewhere."""
import re
import shutil
import subprocess
import sys

import helpers
import pytest

README = (helpers.SOURCE / 'README.md').read_text()
PAGE = (helpers.SOURCE / 'docs/python.md').read_text()
EXAMPLES = [*re.findall(r'^```python\n(.*?)^```', README, re.S | re.M),
            *re.findall(r'^```python\n(.*?)^```', PAGE, re.S | re.M)[:2]]


@pytest.fixture(scope='module')
def installed(tmp_path_factory):
    folder = tmp_path_factory.mktemp('install')
    source = folder / 'source'      # pip leaves a folder build/ where it runs
    source.mkdir()
    for name in ('setup.py', 'pyproject.toml', 'CMakeLists.txt', 'LICENSE', 'README.md'):
        shutil.copy(helpers.SOURCE / name, source)
    shutil.copytree(helpers.SOURCE / 'python', source / 'python', ignore=shutil.ignore_patterns('__pycache__'))
    environment = {**helpers.environment(), 'MAJORANT_BUILD_TREE': str(helpers.BUILD), 'PYTHONPATH': ''}
    done = subprocess.run([sys.executable, '-m', 'pip', 'install', '--no-build-isolation', '--no-index', '--no-deps',
                           '--disable-pip-version-check', '--target', folder / 'packages', '.'],
                          cwd=source, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    shutil.rmtree(source)
    return folder / 'packages'


def run(text, installed, folder):
    done = subprocess.run([sys.executable, '-c', text], cwd=folder, capture_output=True, text=True,
                          env={**helpers.environment(), 'PYTHONPATH': str(installed)})
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_what_is_installed(installed):
    import majorant
    names = {path.name for path in (installed / 'majorant').iterdir()} - {'__pycache__'}
    assert names == {path.name for path in (helpers.PACKAGE / 'majorant').iterdir()} - {'__pycache__'}
    assert not any(path.is_symlink() for path in (installed / 'majorant').iterdir())
    metadata = (installed / f'majorant-{majorant.__version__}.dist-info/METADATA').read_text()
    assert 'Requires-Dist: numpy' in metadata and 'License: BSD-3-Clause' in metadata


@pytest.mark.parametrize('text', EXAMPLES)
def test_examples_run_elsewhere(installed, tmp_path, text):
    (tmp_path / 'meshes').symlink_to(helpers.MESHES)
    said = run(text + '\nprint(majorant.__file__)', installed, tmp_path)
    assert said.splitlines()[-1] == str(installed / 'majorant/__init__.py')


if __name__ == '__main__':
    helpers.main(__file__)
