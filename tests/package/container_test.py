#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""The steps of Containerfile: with MAJORANT_DEBIAN_ROOT=DIR they are done in a new Debian that mmdebstrap makes
beside DIR (as root, with a network, 1 GB and minutes of two cores), and what they installed flattens a mesh."""
import fnmatch
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ['MAJORANT_SOURCE_DIR'])
sys.path.insert(0, str(SOURCE / 'cmake/scripts'))
import try_packages  # noqa: E402

ROOT = os.environ.get('MAJORANT_DEBIAN_ROOT')


def steps(text):
    """(instruction, words) of the lines that are no comments."""
    return [tuple(line.split(maxsplit=1)) for line in text.replace('\\\n', '').splitlines()
            if line and not line.startswith('#')]


STEPS = steps((SOURCE / 'Containerfile').read_text())
IGNORED = (SOURCE / '.containerignore').read_text().split()


def why_not():
    """The first thing that is missing to do the steps, or None."""
    for missing, why in ((not ROOT, 'no MAJORANT_DEBIAN_ROOT'), (os.geteuid() != 0, 'no root'),
                         (not shutil.which('mmdebstrap'), 'no mmdebstrap')):
        if missing:
            return why
    return None


class Steps(unittest.TestCase):
    def test_they_are_those_that_can_be_done_here(self):
        self.assertEqual(STEPS[0], ('FROM', 'debian:bookworm-slim'))
        self.assertEqual({name for name, _ in STEPS}, {'FROM', 'RUN', 'COPY', 'WORKDIR', 'ENTRYPOINT'})

    def test_commands_are_there(self):
        targets = re.findall(r'^([\w-]+):', (SOURCE / 'Makefile').read_text(), re.M)
        for name, words in STEPS:
            if name == 'RUN':
                self.assertEqual(subprocess.run(['sh', '-n', '-c', words]).returncode, 0, words)
                for target in re.findall(r'\bmake ([a-z-]+)', words.split('apt-get')[0]):
                    self.assertIn(target, targets)

    def test_what_git_ignores_is_not_copied(self):
        ignored = [line.strip('/') for line in (SOURCE / '.gitignore').read_text().splitlines() if line.endswith('/')]
        self.assertLessEqual({'build', 'out'} & set(ignored), set(IGNORED))


@unittest.skipIf(why_not(), why_not())
class InANewDebian(unittest.TestCase):
    def test_they_end_well(self):
        with tempfile.TemporaryDirectory(prefix='container_', dir=Path(ROOT).resolve().parent) as name:
            path = Path(name) / 'root'
            made = subprocess.run(['mmdebstrap', '--variant=minbase', 'bookworm', str(path)], text=True,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            if made.returncode:
                self.skipTest('no Debian: ' + made.stdout.splitlines()[-1])
            root, folder = try_packages.Root(path), '/'
            for name, words in STEPS[1:]:
                if name == 'RUN':
                    root.run('sh', '-c', 'cd %s && %s' % (folder, words))
                elif name == 'COPY':
                    source, target = words.split()
                    shutil.copytree(SOURCE / source, path / target.strip('/'), symlinks=True, ignore=lambda where, names: [
                        name for name in names if Path(where) == SOURCE / source and any(
                            fnmatch.fnmatch(name, pattern) for pattern in IGNORED)])
                elif name == 'WORKDIR':
                    folder = words
                    (path / folder.strip('/')).mkdir(parents=True, exist_ok=True)
                elif name == 'ENTRYPOINT':
                    program = json.loads(words)
            shutil.copy(SOURCE / 'examples/meshes/creature.obj', path / folder.strip('/') / 'in.obj')
            for arguments in ('in.obj out.obj', 'check out.obj --surface in.obj --certify'):
                root.run('sh', '-c', 'cd %s && exec "$@"' % folder, '-', *program, *arguments.split())


if __name__ == '__main__':
    unittest.main()
