# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Shared code of the tests of glTF: the command's helpers, and Khronos' validator, installed once into the build
folder by npm."""
import json
import os
import shutil
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
for folder in ('apps', 'pictures/web'):
    sys.path.insert(0, os.path.join(os.path.dirname(HERE), folder))

from browser import BUILD, npm_ci  # noqa: E402
from command_helpers import *  # noqa: E402,F401,F403
from gltf_files import *  # noqa: E402,F401,F403


def validated(paths, folder):
    """Returns the validator's messages on each file: lists of {code, pointer, severity, message}."""
    home = os.path.join(BUILD, 'gltf_tests')
    npm_ci(HERE, home, 'gltf-validator')
    shutil.copy(os.path.join(HERE, 'validate.mjs'), home)
    names = os.path.join(folder, 'names.json')
    with open(names, 'w') as f:
        json.dump(list(paths), f)
    done = subprocess.run(['node', os.path.join(home, 'validate.mjs'), names], text=True, cwd=home,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=300)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)
