# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Runs pages in Chromium by playwright-core, which is installed once into the build folder.

    result = run('uv_pass.mjs', page)      # the answer of the script

Without npm or Chromium the test is skipped.
"""
import fcntl
import json
import os
import shutil
import subprocess
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
BUILD = os.environ.get('MAJORANT_BUILD_DIR', '')


def skip(why):
    raise unittest.SkipTest(why)


def require_npm():
    for program in ('node', 'npm'):
        if not shutil.which(program):
            skip('no ' + program)


def require_chromium():
    path = shutil.which('chromium')
    if not path:
        skip('no chromium')
    return path


def read(path):
    with open(path) as f:
        return f.read()


def npm_ci(source, folder, needed):
    """Runs npm ci of the package of `source` in `folder`, unless it is installed there."""
    require_npm()
    os.makedirs(folder, exist_ok=True)
    with open(folder + '.lock', 'w') as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        names = ('package.json', 'package-lock.json')
        required = json.dumps([read(os.path.join(source, name)) for name in names])
        mark = os.path.join(folder, 'installed.json')
        if os.path.exists(mark) and read(mark) == required:
            return
        for name in names:
            shutil.copy(os.path.join(source, name), folder)
        done = subprocess.run(['npm', 'ci', '--ignore-scripts', '--no-audit', '--no-fund'],
                              cwd=folder, text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, timeout=300)
        if done.returncode != 0 or not os.path.isdir(os.path.join(folder, 'node_modules', needed)):
            print(done.stdout)
            skip('no %s from npm' % needed)
        with open(mark, 'w') as f:
            f.write(required)


def run(script, *arguments, timeout=900):
    """Returns the answer of tests/pictures/web/SCRIPT to the arguments, each a JSON value."""
    chromium = require_chromium()
    folder = os.path.join(BUILD, 'page_tests')
    npm_ci(HERE, folder, 'playwright-core')
    for name in os.listdir(HERE):  # beside node_modules, where scripts find it
        if name.endswith('.mjs'):
            target = os.path.join(folder, name)
            temporary = '%s.%d' % (target, os.getpid())
            shutil.copy(os.path.join(HERE, name), temporary)
            os.replace(temporary, target)
    done = subprocess.run(['node', os.path.join(folder, script),
                           *[json.dumps(a) for a in arguments]], text=True, cwd=folder,
                          env=dict(os.environ, MAJORANT_CHROMIUM=chromium), timeout=timeout,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)
