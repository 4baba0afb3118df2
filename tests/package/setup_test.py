#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests `make demo` without some packages: with root, with sudo, with neither, without ninja. apt-get, sudo,
dpkg-query and id are stubs that record their arguments."""
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ['MAJORANT_SOURCE_DIR'])
SCRIPT = SOURCE / 'cmake/scripts/install_packages.sh'
TOOLS = ('sh', 'cat', 'sed', 'dirname')


def listed(name='packages.txt'):
    """Returns the (needed, optional) packages of a list, in its order."""
    lines = re.sub('#.*', '', (SOURCE / 'cmake/scripts' / name).read_text()).split()
    return ([re.sub('/.*', '', line) for line in lines if not line.endswith('?')],
            [re.sub('[/?].*', '', line) for line in lines if line.endswith('?')])


class Folder(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix='majorant_setup_'))
        self.addCleanup(shutil.rmtree, self.folder)
        self.bin = self.folder / 'bin'
        self.bin.mkdir()

    def program(self, name, text):
        (self.bin / name).write_text('#!/bin/sh\n' + text)
        (self.bin / name).chmod(0o755)


class Packages(Folder):
    def setUp(self):
        super().setUp()
        for name in TOOLS:
            (self.bin / name).symlink_to(shutil.which(name))
        self.log = self.folder / 'log'

    def system(self, missing=(), user=1000, sudo='yes', apt='yes'):
        """Sets up a Debian without the missing packages. sudo and apt-get: yes, no (not installed), refuses."""
        self.program('dpkg-query', 'for package; do :; done\ncase " %s " in *" $package "*) exit 1 ;; esac\n'
                                   'echo "install ok installed"\n' % ' '.join(missing))
        self.program('id', 'echo %d\n' % user)
        words = {'yes': 'echo "%s $*" >> ' + str(self.log) + '\n', 'refuses': 'exit 1\n'}
        if apt != 'no':
            self.program('apt-get', words[apt] % 'apt-get' if apt == 'yes' else words[apt])
        if sudo != 'no':
            self.program('sudo', (words[sudo] % 'sudo') + '"$@"\n' if sudo == 'yes' else words[sudo])

    def install(self, *lists):
        return self.run_shell('%s %s' % (SCRIPT, ' '.join(str(SOURCE / 'cmake/scripts' / name) for name in lists)))

    def run_shell(self, command):
        done = subprocess.run(['/bin/sh', '-c', command], env={'PATH': str(self.bin)}, text=True,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        return done.returncode, done.stdout, done.stderr

    def called(self):
        return self.log.read_text().splitlines() if self.log.exists() else []

    def test_nothing_happens_if_all_packages_are_installed(self):
        self.system(sudo='refuses', apt='refuses')
        self.assertEqual(self.install('packages_test.txt', 'packages_core.txt', 'packages_python.txt'), (0, '', ''))

    def test_root_installs_missing_packages(self):
        self.system(['zlib1g-dev', 'libmetis-dev'], user=0, sudo='no')
        code, printed, _ = self.install()
        self.assertEqual((code, printed), (0, 'installing: libmetis-dev zlib1g-dev\n'))
        self.assertEqual(self.called(), ['apt-get update -qq', 'apt-get install -y -qq --no-install-recommends '
                                                               'libmetis-dev zlib1g-dev'])

    def test_others_by_sudo(self):
        self.system(['zlib1g-dev'])
        self.assertEqual(self.install()[0], 0)
        self.assertIn('sudo apt-get install -y -qq --no-install-recommends zlib1g-dev', self.called())

    def test_without_rights_the_commands_are_printed(self):
        missing = ['g++', 'zlib1g-dev', 'python3-venv']
        for sudo, apt, why in (('no', 'yes', 'no sudo'), ('refuses', 'yes', 'up to date'), ('yes', 'refuses', 'up to date'),
                               ('yes', 'no', 'no apt-get')):
            with self.subTest((sudo, apt)):
                for path in (*self.bin.glob('sudo'), *self.bin.glob('apt-get')):
                    path.unlink()
                self.system(missing, sudo=sudo, apt=apt)
                code, _, printed = self.install('packages_python.txt')
                self.assertEqual(code, 1)
                self.assertIn(why, printed.splitlines()[0])
                line = printed.splitlines()[-1]
                self.assertTrue(line.endswith(' ' + ' '.join(missing)), line)
                self.log.write_text('')
                self.system(missing, user=0)  # an administrator runs it
                self.assertEqual(self.run_shell(line)[0], 0)
                self.assertEqual(self.called(), ['apt-get update', 'apt-get install -y --no-install-recommends ' +
                                                 ' '.join(missing)])

    def test_optional_packages_are_not_required(self):
        self.assertEqual(listed()[1], ['ninja-build', 'libopenexr-dev', 'libdraco-dev', 'libmeshoptimizer-dev'])
        for package in listed()[1]:
            self.system([package], sudo='no')
            code, _, printed = self.install()
            self.assertEqual(code, 0)
            self.assertIn(package, printed)
        self.system(['ninja-build', 'g++'], sudo='no')
        self.assertEqual(self.install()[0], 1)
        self.program('ninja', '')  # called from another folder
        self.system(['ninja-build'], sudo='no')
        self.assertEqual(self.install(), (0, '', ''))

    def test_lists_name_a_package_once(self):
        names = [name for path in (SOURCE / 'cmake/scripts').glob('packages*.txt') for part in listed(path.name)
                 for name in part]
        self.assertEqual(len(names), len(set(names)))
        self.assertLessEqual({'python3-venv', 'pybind11-dev', 'python3-setuptools'}, set(listed('packages_python.txt')[0]))


class Building(Folder):
    def make(self, *words, path=None):
        return subprocess.run(['make', '-C', SOURCE, '--no-print-directory', *words], text=True,
                              env={**os.environ, 'PATH': path or os.environ['PATH']}, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT)

    def generator(self, path):
        """Returns the words of the command that `make configure` would run."""
        printed = self.make('--dry-run', 'configure', 'BUILD=%s' % (self.folder / 'build'), path=path).stdout
        return re.search(r'cmake --preset release .*-G "(.*?)"', printed)[1]

    def test_makes_own_generator_where_there_is_no_ninja(self):
        for name in ('make', 'sh', 'sed', 'nproc'):
            (self.bin / name).symlink_to(shutil.which(name))
        self.assertEqual(self.generator(str(self.bin)), 'Unix Makefiles')
        self.program('ninja', '')
        self.assertEqual(self.generator(str(self.bin)), 'Ninja')
        (self.folder / 'build').mkdir()  # an existing build folder keeps its generator
        (self.folder / 'build/CMakeCache.txt').write_text('CMAKE_GENERATOR:INTERNAL=Unix Makefiles\n')
        self.assertEqual(self.generator(str(self.bin)), 'Unix Makefiles')

    def configure(self, *options):
        return subprocess.run(['cmake', '--preset', 'release', '-B', self.folder / 'build', '-G', 'Unix Makefiles',
                               '-DMAJORANT_BUILD_TESTS=OFF', '-DMAJORANT_BUILD_BENCH=OFF', *options], cwd=SOURCE,
                              text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    def test_makes_generator_configures(self):
        done = self.configure()
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn('majorant_command', (self.folder / 'build/Makefile').read_text())

    def test_install(self):
        done = self.make('install', 'BUILD=%s' % (self.folder / 'none'))
        self.assertNotEqual(done.returncode, 0)
        self.assertIn('make command', done.stdout)
        done = self.make('install', 'BUILD=' + os.environ['MAJORANT_BUILD_DIR'], 'PREFIX=%s' % (self.folder / 'prefix'))
        self.assertEqual(done.returncode, 0, done.stdout)
        version = subprocess.run([self.folder / 'prefix/bin/majorant', '--version'], text=True, stdout=subprocess.PIPE)
        self.assertTrue(version.stdout.startswith('majorant '), version)


if __name__ == '__main__':
    unittest.main()
