#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Installs the Debian packages of a build in a minimal Debian, and maps a mesh there.

    cmake/scripts/try_packages.py build/release                    majorant and libmajorant-dev, by cpack
    cmake/scripts/try_packages.py build/release --install          `cmake --install` instead, its libraries by apt
    cmake/scripts/try_packages.py build/release --root DIR         in this root, which is made if it does not exist

Needs root, dpkg-dev and file, mmdebstrap or debootstrap, a mirror (--mirror), and temporarily 300 MB in
--root; without one of them it prints a message and ends with 77. A root that is given keeps the installed
packages.
"""
import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
SKIPPED = 77


def run(*command, **options):
    print('+', ' '.join(str(word) for word in command), flush=True)
    return subprocess.run([str(word) for word in command], check=True, text=True, **options)


def skip(why):
    print('skipped: ' + why)
    sys.exit(SKIPPED)


def make_root(root, mirror):
    tool = shutil.which('mmdebstrap') or shutil.which('debootstrap')
    if not tool:
        skip('no mmdebstrap, no debootstrap')
    try:
        run(tool, '--variant=minbase', 'bookworm', root, mirror)
    except subprocess.CalledProcessError:
        skip('no Debian root could be made; is there a network?')


INSIDE = 'srv'  # the folder of the new root for copied files


class Root:
    """A root folder; a command in it sees only its files."""

    def __init__(self, path):
        self.path = path

    def run(self, *command, **options):
        environment = {'PATH': '/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin', 'HOME': '/root', 'LC_ALL': 'C.UTF-8',
                       'DEBIAN_FRONTEND': 'noninteractive'}
        return run('chroot', self.path, *command, env=environment, **options)

    def copy(self, source, name):
        (self.path / INSIDE).mkdir(exist_ok=True)
        shutil.copy(source, self.path / INSIDE / name)


def missing_tools():
    """Returns the missing tools among those that packing needs."""
    return [tool for tool in ('cpack', 'dpkg-deb', 'dpkg-shlibdeps', 'file') if not shutil.which(tool)]


def packages_of(build, folder):
    """Returns the .deb files of a build by package name."""
    run('cpack', '-G', 'DEB', '-B', folder, cwd=build, stdout=subprocess.DEVNULL)
    return {path.name.split('_')[0]: path for path in sorted(Path(folder).glob('*.deb'))}


def check_contents(name, path):
    listing = run('dpkg-deb', '--contents', path, stdout=subprocess.PIPE).stdout
    fields = run('dpkg-deb', '--field', path, stdout=subprocess.PIPE).stdout
    control = run('dpkg-deb', '--info', path, stdout=subprocess.PIPE).stdout
    required = ['./usr/share/doc/%s/copyright' % name]
    if name == 'majorant':
        required += ['./usr/bin/majorant', './usr/share/man/man1/majorant.1.gz',
                   './usr/share/majorant/report.schema.json',
                   './usr/share/bash-completion/completions/majorant',
                   './usr/share/zsh/vendor-completions/_majorant',
                   './usr/share/fish/vendor_completions.d/majorant.fish']
    for file in required:
        assert re.search(r' %s$' % re.escape(file), listing, re.M), '%s: no %s' % (path, file)
    assert 'md5sums' in control, '%s: no md5sums' % path
    if name == 'majorant':
        assert re.search(r'^Depends: .*libc6 \(>=', fields, re.M), fields
    print(fields)


def first_commands(root):
    """Runs first commands on a mesh of the project, and proves the written files there."""
    root.copy(SOURCE / 'examples/meshes/creature.obj', 'in.obj')

    def in_work(*words):
        return root.run('sh', '-c', 'cd /%s && "$@"' % INSIDE, '-', 'majorant', *words)
    in_work('--version')
    in_work('in.obj', 'out.obj')
    in_work('parametrize', 'in.obj', '-o', 'out.vtu', '-o', 'out.svg', '--degree', '3', '--report', 'run.json')
    in_work('check', 'out.vtu', '--surface', 'in.obj')
    in_work('check', 'out.obj', '--certify')


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('build', type=Path)
    parser.add_argument('--install', action='store_true')
    parser.add_argument('--root', type=Path)
    parser.add_argument('--mirror', default='http://deb.debian.org/debian')
    arguments = parser.parse_args()
    if os.geteuid() != 0:
        skip('not root: a chroot cannot be entered')
    if missing_tools():
        skip('no ' + ', '.join(missing_tools()))
    with tempfile.TemporaryDirectory(prefix='majorant_root_') as folder:
        packages = packages_of(arguments.build.resolve(), folder)
        for name, path in packages.items():
            check_contents(name, path)
        root = Root(arguments.root or Path(folder) / 'root')
        if not (root.path / 'usr').exists():
            make_root(root.path, arguments.mirror)
        run_in(root, packages, arguments)
    print('first commands run in a Debian that has nothing else')


def run_in(root, packages, arguments):
    root.run('apt-get', 'update', '-qq')
    if arguments.install:
        depends = run('dpkg-deb', '--field', packages['majorant'], 'Depends', stdout=subprocess.PIPE).stdout
        names = [re.sub(r'\s*\(.*', '', part.split('|')[0]).strip() for part in depends.split(',')]
        root.run('apt-get', 'install', '-qq', '-y', '--no-install-recommends',
                 *(name for name in names if not name.startswith('libmajorant')))
        run('cmake', '--install', arguments.build, '--prefix', root.path / 'usr/local',
            stdout=subprocess.DEVNULL)
        root.run('ldconfig')
    else:
        debs = [path for name, path in packages.items() if not name.endswith('-dev')]
        for path in debs:
            root.copy(path, path.name)
        root.run('apt-get', 'install', '-qq', '-y', '--no-install-recommends',
                 *('/%s/%s' % (INSIDE, path.name) for path in debs))
        root.run('dpkg', '--verify', 'majorant')
    first_commands(root)


if __name__ == '__main__':
    main()
