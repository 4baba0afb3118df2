#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""The commands of docs/python.md that install the package, with the module of the build tree; and examples with the
installed package, in another folder."""
import os
import re
import shutil
import subprocess

import helpers
import pytest

PYTHON = '/usr/bin/python3'
README = (helpers.SOURCE / 'README.md').read_text()
PAGE = (helpers.SOURCE / 'docs/python.md').read_text()
EXAMPLES = [*re.findall(r'^```python\n(.*?)^```', README, re.S | re.M),
            *re.findall(r'^```python\n(.*?)^```', PAGE, re.S | re.M)[:2]]


def lines_of(page):
    """Returns the blocks that use pip in the package's own environment."""
    return [block for block in re.findall(r'^```sh\n(.*?)^```', page, re.S | re.M) if 'majorant-python/bin/pip' in block]


def run_lines(blocks, folder):
    """Runs them in a copy of the necessary files, with a separate HOME. Returns the environment."""
    home, source, stubs = folder / 'home', folder / 'source', folder / 'bin'
    for made in (home, source, stubs, source / 'build'):
        made.mkdir()
    for name in ('setup.py', 'pyproject.toml', 'CMakeLists.txt', 'LICENSE', 'README.md'):
        shutil.copy(helpers.SOURCE / name, source)
    for name in ('python', 'cmake'):
        shutil.copytree(helpers.SOURCE / name, source / name, ignore=shutil.ignore_patterns('__pycache__'))
    (source / 'build/release').symlink_to(helpers.BUILD)
    for name in ('apt-get', 'sudo'):  # tests install and download no packages
        (stubs / name).write_text('#!/bin/sh\nexit 1\n')
        (stubs / name).chmod(0o755)
    environment = {**helpers.environment(), 'HOME': str(home), 'PATH': '%s:%s' % (stubs, os.environ['PATH']),
                   'MAJORANT_BUILD_TREE': str(helpers.BUILD), 'PIP_NO_INDEX': '1', 'PIP_DISABLE_PIP_VERSION_CHECK': '1'}
    del environment['PYTHONPATH']
    for block in blocks:
        done = subprocess.run(['sh', '-eux', '-c', block], cwd=source, env=environment, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True)
        if done.returncode and 'As an administrator' in done.stdout:
            pytest.skip('no ' + done.stdout.split('--no-install-recommends ')[1].splitlines()[0])
        assert done.returncode == 0, done.stdout
    shutil.rmtree(source)
    return home / 'majorant-python'


@pytest.fixture(scope='module')
def environment(tmp_path_factory):
    return run_lines(lines_of(PAGE)[:1], tmp_path_factory.mktemp('install'))


@pytest.fixture
def installed(environment):
    return next(environment.glob('lib/python3*/site-packages'))


def run(text, environment, folder):
    done = subprocess.run([environment / 'bin/python', '-c', text], cwd=folder, capture_output=True, text=True,
                          env={**helpers.environment(), 'PYTHONPATH': ''})
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_the_lines_of_the_page(tmp_path):
    blocks = lines_of(PAGE)
    assert len(blocks) == 2
    assert [PYTHON in block for block in blocks] == [True, True]
    run_lines(blocks, tmp_path)


def test_installed_files(installed):
    import majorant
    names = {path.name for path in (installed / 'majorant').iterdir()} - {'__pycache__'}
    assert names == {path.name for path in (helpers.PACKAGE / 'majorant').iterdir()} - {'__pycache__'}
    assert not any(path.is_symlink() for path in (installed / 'majorant').iterdir())
    metadata = (installed / f'majorant-{majorant.__version__}.dist-info/METADATA').read_text()
    assert 'Requires-Dist: numpy' in metadata and 'License: GPL-3.0-or-later' in metadata


@pytest.mark.parametrize('text', EXAMPLES)
def test_examples_run_elsewhere(environment, installed, tmp_path, text):
    (tmp_path / 'examples').symlink_to(helpers.SOURCE / 'examples')
    printed = run(text + '\nprint(majorant.__file__)', environment, tmp_path)
    assert printed.splitlines()[-1] == str(installed / 'majorant/__init__.py')


if __name__ == '__main__':
    helpers.main(__file__)
