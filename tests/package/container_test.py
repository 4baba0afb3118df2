#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests the steps of Containerfile. With MAJORANT_DEBIAN_ROOT=DIR its stages are new Debians made by
mmdebstrap beside DIR (needs root, a network, 2 GB and minutes of two cores), and the installed command
flattens a mesh."""
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
# Tools that only a build requires.
TOOLS = ('gcc', 'g++', 'cmake', 'make', 'ninja', 'dpkg-dev')


def steps(text):
    """Returns (instruction, words) of the lines that are no comments."""
    return [tuple(line.split(maxsplit=1)) for line in text.replace('\\\n', '').splitlines()
            if line and not line.startswith('#')]


STEPS = steps((SOURCE / 'Containerfile').read_text())
IGNORED = (SOURCE / '.dockerignore').read_text().split()


def why_not():
    """Returns the first missing requirement of the steps, or None."""
    for missing, why in ((not ROOT, 'no MAJORANT_DEBIAN_ROOT'), (os.geteuid() != 0, 'no root'),
                         (not shutil.which('mmdebstrap'), 'no mmdebstrap')):
        if missing:
            return why
    return None


class Steps(unittest.TestCase):
    def test_only_supported_steps_are_used(self):
        self.assertEqual([words for name, words in STEPS if name == 'FROM'],
                         ['debian:bookworm-slim AS build', 'debian:bookworm-slim'])
        self.assertEqual({name for name, _ in STEPS}, {'FROM', 'RUN', 'COPY', 'WORKDIR', 'ENTRYPOINT'})

    def test_the_last_stage_builds_nothing(self):
        """The last stage copies from the first one, and has none of the sources."""
        last = max(k for k, (name, _) in enumerate(STEPS) if name == 'FROM')
        words = [words for name, words in STEPS[last:] if name in ('COPY', 'RUN')]
        self.assertEqual(words[0], '--from=build /packages /packages')
        self.assertNotRegex(' '.join(words), r'\bmake\b|g\+\+|cmake|-dev')

    def test_commands_are_there(self):
        targets = re.findall(r'^([\w-]+):', (SOURCE / 'Makefile').read_text(), re.M)
        for name, words in STEPS:
            if name == 'RUN':
                self.assertEqual(subprocess.run(['sh', '-n', '-c', words]).returncode, 0, words)
                for target in re.findall(r'\bmake ([a-z-]+)', words.split('apt-get')[0]):
                    self.assertIn(target, targets)

    def test_files_ignored_by_git_are_not_copied(self):
        """docker reads .dockerignore, as does podman without a .containerignore."""
        self.assertFalse((SOURCE / '.containerignore').exists())
        ignored = [line.strip('/') for line in (SOURCE / '.gitignore').read_text().splitlines() if line.endswith('/')]
        self.assertLessEqual({'build', 'out', 'dist'} & set(ignored), set(IGNORED))
        self.assertIn('.git', IGNORED)


class Stage:
    """A Debian and the working folder of its steps."""

    def __init__(self, path):
        self.path, self.folder = path, '/'
        made = subprocess.run(['mmdebstrap', '--variant=minbase', 'bookworm', str(path)], text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.why_not = made.stdout.splitlines()[-1] if made.returncode else None
        self.root = try_packages.Root(path)

    def inside(self, name):
        return self.path / name.strip('/')

    def take(self, name, words, stages):
        if name == 'RUN':
            self.root.run('sh', '-c', 'cd %s && %s' % (self.folder, words))
        elif name == 'COPY':
            *start, source, target = words.split()
            if start:
                shutil.copytree(stages[start[0].split('=')[1]].inside(source), self.inside(target), symlinks=True)
                return
            shutil.copytree(SOURCE / source, self.inside(target), symlinks=True, ignore=lambda where, names: [
                one for one in names if Path(where) == SOURCE / source and any(
                    fnmatch.fnmatch(one, pattern) for pattern in IGNORED)])
        elif name == 'WORKDIR':
            self.folder = words
            self.inside(words).mkdir(parents=True, exist_ok=True)


@unittest.skipIf(why_not(), why_not())
class InNewDebians(unittest.TestCase):
    def test_the_steps_succeed(self):
        with tempfile.TemporaryDirectory(prefix='container_', dir=Path(ROOT).resolve().parent) as folder:
            stages, last = {}, None
            for name, words in STEPS:
                if name == 'FROM':
                    key = words.split(' AS ')[-1]
                    last = stages[key] = Stage(Path(folder) / ('root_%d' % len(stages)))
                    if last.why_not:
                        self.skipTest('no Debian: ' + last.why_not)
                elif name == 'ENTRYPOINT':
                    program = json.loads(words)
                else:
                    last.take(name, words, stages)
            for tool in TOOLS:
                self.assertIsNone(shutil.which(tool, path=str(last.inside('usr/bin'))), tool)
            shutil.copy(SOURCE / 'examples/meshes/creature.obj', last.inside(last.folder) / 'in.obj')
            for arguments in ('in.obj out.obj', 'check out.obj --surface in.obj --certify'):
                last.root.run('sh', '-c', 'cd %s && exec "$@"' % last.folder, '-', *program, *arguments.split())
            for key, stage in stages.items():
                size = sum(path.lstat().st_size for path in stage.path.rglob('*') if path.is_file() and not path.is_symlink())
                print(f'stage {key}: {size / 1e6:.0f} MB')


if __name__ == '__main__':
    unittest.main()
