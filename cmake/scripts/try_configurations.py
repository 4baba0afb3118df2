#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests shared libraries, a build without GPL parts, and a build inside another project.

    cmake -S . -B build/shared -G Ninja -DBUILD_SHARED_LIBS=ON -DMAJORANT_BUILD_TESTS=OFF
    ninja -C build/shared majorant_command
    cmake/scripts/try_configurations.py --shared build/shared

    cmake -S . -B build/gplfree -G Ninja -DMAJORANT_GPL=OFF
    ninja -C build/gplfree majorant_command
    cmake/scripts/try_configurations.py --gpl-free build/gplfree --default build/release

    cmake/scripts/try_configurations.py --parent build/parent

--shared tests names and symbols of the libraries, the command before and after install, consumers by CMake
and by pkg-config with the libraries they link, and that every public name links. --gpl-free tests the loaded
libraries, the packages of all compiled headers, and that verbs run; with --default DIR also that maps,
layouts of many charts and quads have the bits of that build. --parent configures and builds a project with
majorant in a subfolder, and runs its programs.
"""
import argparse
import functools
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
CONSUMERS = SOURCE / 'tests/package'
sys.path.insert(0, str(CONSUMERS))
import public_names  # noqa: E402

MESH = SOURCE / 'examples/meshes/cap.obj'
ALWAYS = {'libstdc++', 'libm', 'libgcc_s', 'libc', 'linux-vdso', 'ld-linux-x86-64'}
# Libraries of cairo (MPL-1.1 among its licences) and those that it loads, under MIT, BSD or FreeType's
# licence.
CAIRO_LIBRARIES = {'libcairo', 'libpixman-1', 'libfontconfig', 'libfreetype', 'libexpat', 'libbrotlidec',
                   'libbrotlicommon', 'libX11', 'libXext', 'libXrender', 'libXau', 'libXdmcp', 'libxcb', 'libxcb-shm',
                   'libxcb-render', 'libuuid', 'libbsd', 'libmd'}
# Libraries of images and compressed glTF (BSD, MIT, Apache, IJG), each used if its package was installed.
IMAGE_LIBRARIES = {'libjpeg', 'libOpenEXR-3_1', 'libIex-3_1', 'libIlmThread-3_1', 'libImath-3_1', 'libdraco',
                   'libmeshoptimizer'}
FREE_LIBRARIES = ALWAYS | CAIRO_LIBRARIES | IMAGE_LIBRARIES | {
    'libamd', 'libcamd', 'libsuitesparseconfig', 'libmetis', 'libfmt', 'libpng16', 'libz'}
# Debian packages whose headers a binary under BSD-3-Clause may use: BSD, MIT, Apache, BSL, MPL; those of GCC
# and the C library by their exceptions.
FREE_PACKAGES = {'libeigen3-dev', 'libxsimd-dev', 'libfmt-dev', 'nlohmann-json3-dev', 'libcli11-dev', 'zlib1g-dev',
                 'libpng-dev', 'libcairo2-dev', 'libmetis-dev', 'libjpeg62-turbo-dev', 'libopenexr-dev', 'libimath-dev',
                 'libdraco-dev', 'libmeshoptimizer-dev', 'libc6-dev', 'linux-libc-dev', 'libcrypt-dev'}
FREE_PATTERN = re.compile(r'lib(boost1\.\d+|stdc\+\+-\d+|gcc-\d+)-dev$')
# Headers under BSD in packages that also have other licences.
FREE_HEADERS = {'/usr/include/suitesparse/amd.h', '/usr/include/suitesparse/camd.h',
                '/usr/include/suitesparse/SuiteSparse_config.h'}


def run(*command, **options):
    options.setdefault('stdout', subprocess.PIPE)
    done = subprocess.run([str(word) for word in command], text=True, stderr=subprocess.STDOUT, **options)
    assert done.returncode == 0, '%s: exit %d\n%s' % (command, done.returncode, done.stdout)
    return done.stdout


def loaded(program):
    return {Path(line.split()[0]).name.split('.so')[0]: line.split() for line in run('ldd', program).splitlines()}


def dynamic(file, tag):
    return re.findall(r'\(%s\).*\[(.*)\]' % tag, run('readelf', '-dW', file))


def version():
    return re.search(r'project\(majorant VERSION (\S+)', (SOURCE / 'CMakeLists.txt').read_text())[1]


def soversion():
    major, minor, _ = version().split('.')
    return '0.' + minor if major == '0' else major


def check_library(build, name):
    library = build / 'lib' / ('lib%s.so' % name)
    assert dynamic(library, 'SONAME') == ['lib%s.so.%s' % (name, soversion())], library
    assert (library.parent / ('lib%s.so.%s' % (name, version()))).is_file()
    symbols = run('nm', '-D', '--defined-only', '--format=posix', library).splitlines()
    others = [line for line in symbols if not re.match(r'_Z\w*?8majorant', line)]
    assert not others, others[:10]
    total = len(run('nm', '--defined-only', '--extern-only', '--format=posix', *build.glob('libmajorant_*.a'))
                .splitlines())
    print('%s: %d symbols are visible, of %d in the archives' % (library.name, len(symbols), total))


def check_command(program):
    with tempfile.TemporaryDirectory() as folder:
        run(program, 'parametrize', '--quiet', MESH, '-o', Path(folder) / 'out.obj')
        run(program, 'check', Path(folder) / 'out.obj', '--surface', MESH)


def check_framework_consumer(program, environment=None):
    assert abs(float(run(program, env=environment)) - 73.5) < 1e-9
    assert set(dynamic(program, 'NEEDED')) <= {'libmajorant_framework.so.' + soversion(), 'libstdc++.so.6',
                                               'libm.so.6', 'libgcc_s.so.1', 'libc.so.6'}, program
    names = set(loaded(program)) if environment is None else set()
    assert names <= ALWAYS | {'libmajorant_framework', 'libamd', 'libcamd', 'libmetis', 'libfmt',
                              'libsuitesparseconfig'}, names


def try_shared(build):
    for name in ('majorant_framework', 'majorant'):
        check_library(build, name)
    check_command(build / 'apps/majorant')
    with tempfile.TemporaryDirectory(prefix='majorant_shared_') as folder:
        prefix = Path(folder) / 'prefix'
        for component in ('command', 'libraries', 'development'):
            run('cmake', '--install', build, '--prefix', prefix, '--component', component)
        assert not list(prefix.rglob('*.a'))
        check_command(prefix / 'bin/majorant')
        assert str(prefix) in loaded(prefix / 'bin/majorant')['libmajorant'][2]
        moved = Path(folder) / 'moved'  # found relative to the command, not by the prefix of the installation
        prefix.rename(moved)
        check_command(moved / 'bin/majorant')
        for name in ('consumer', 'framework_consumer'):
            run('cmake', '-S', CONSUMERS / name, '-B', Path(folder) / name, '-DCMAKE_BUILD_TYPE=Release',
                '-DCMAKE_PREFIX_PATH=%s' % moved,
                *('-DCMAKE_DISABLE_FIND_PACKAGE_%s=ON' % other
                  for other in ('nlohmann_json', 'Ceres', 'PNG', 'ZLIB', 'fmt', 'Nest2D', 'Orderings')))
            run('cmake', '--build', Path(folder) / name)
        program = Path(folder) / 'consumer/consumer'
        print('the consumer says', run(program, MESH).strip(), 'of cap.obj')
        assert 'libmajorant.so.' + soversion() in dynamic(program, 'NEEDED')
        check_framework_consumer(Path(folder) / 'framework_consumer/framework_consumer')
        pkg_config(moved, Path(folder))
        for package in (public_names.Package(moved), public_names.framework(moved)):
            package.link_by_cmake(Path(folder) / (package.module + '_names'))
            package.link_by_pkg_config(Path(folder) / (package.module + '_names_by_pkg_config'))
            print('%s: %d public symbols, all linked' % (package.module, len(package.required)))


def pkg_config(prefix, folder):
    libdir = next(prefix.rglob('majorant.pc')).parent
    environment = dict(os.environ, PKG_CONFIG_PATH=str(libdir), LD_LIBRARY_PATH=str(libdir.parent))
    flags = run('pkg-config', '--cflags', '--libs', 'majorant-framework', env=environment).split()
    assert [flag for flag in flags if flag.startswith('-l')] == ['-lmajorant_framework'], flags
    assert '-lmetis' in run('pkg-config', '--static', '--libs', 'majorant-framework', env=environment)
    flags = run('pkg-config', '--cflags', '--libs', 'majorant', env=environment).split()
    assert [f for f in flags if f.startswith('-l')] == ['-lmajorant', '-lmajorant_framework'], flags
    program = folder / 'by_pkg_config'
    run('c++', '-std=c++20', '-O1', CONSUMERS / 'framework_consumer/main.cpp', '-o', program,
        *(f for f in flags if f != '-lmajorant'), env=environment)
    check_framework_consumer(program, environment)


@functools.lru_cache(None)
def owners():
    """Returns for every file of /usr/include and /usr/lib/gcc its Debian package."""
    owned = {}
    for path in Path('/var/lib/dpkg/info').glob('*.list'):
        for name in path.read_text().splitlines():
            if name.startswith(('/usr/include/', '/usr/lib/gcc/')):
                owned[name] = path.stem.split(':')[0]
    return owned


def package_of(header):
    return owners().get(header) or owners().get(os.path.realpath(header), 'no package')


def headers_of(build):
    """Returns the headers of every object of the command, as listed by the compiler (-MD)."""
    objects = {line.strip() for line in run('ninja', '-C', build, '-t', 'inputs', 'apps/majorant').splitlines()
               if line.strip().endswith('.o')}
    found, current = set(), None
    for line in run('ninja', '-C', build, '-t', 'deps').splitlines():
        if line and not line.startswith(' '):
            current = line.split(':')[0]
        elif line.strip() and current in objects:
            found.add(os.path.normpath(os.path.join(build, line.strip())))
    sources = {name for name in found if name.startswith(str(SOURCE) + '/') and name.endswith('.cpp')}
    assert len(sources) > 150 and len(found) > 500, (len(sources), len(found))
    return {name for name in found if not name.startswith((str(SOURCE) + '/', str(build) + '/'))}


def check_headers(build):
    by_package = {}
    for header in sorted(headers_of(build)):
        by_package.setdefault(package_of(header), []).append(header)
    for package, headers in sorted(by_package.items()):
        print('%5d headers of %s' % (len(headers), package))
        if package not in FREE_PACKAGES and not FREE_PATTERN.match(package):
            assert set(headers) <= FREE_HEADERS, '%s: %s' % (package, headers[:5])
        # Eigen's list of code that is not under the MPL ends in this file.
        assert not any(name.endswith('/NonMPL2.h') for name in headers)


def try_gpl_free(build, default):
    program = build / 'apps/majorant'
    libraries = set(loaded(program))
    print('loaded:', ' '.join(sorted(libraries)))
    assert libraries <= FREE_LIBRARIES | {'libpthread'}, libraries - FREE_LIBRARIES
    check_headers(build)
    listed = run(program, '--licenses')
    assert listed.startswith('As a whole: BSD-3-Clause') and 'CGAL' not in listed, listed
    with tempfile.TemporaryDirectory() as folder:
        meshes = SOURCE / 'examples/meshes'
        runs = [(name, verb, options) for name in ('cap', 'creature', 'tube')
                for verb, options in (('parametrize', ('--degree', '3')), ('unwrap', ()))]
        runs += [('cap', 'parametrize', ('--bijective',)), ('creature', 'unwrap', ('--charts', '60')),
                 ('buckle', 'seamless', ()), ('buckle', 'quads', ())]
        for name, verb, options in runs:
            files, mesh = [], meshes / (name + '.obj')
            for who in [program] + ([default / 'apps/majorant'] if default else []):
                files.append(Path(folder) / ('%s_%s_%d.%s' % (name, verb, len(files), 'obj' if verb == 'quads' else 'vtu')))
                run(who, verb, '--quiet', mesh, '-o', files[-1], *options)
                run(who, 'check', files[-1], *(() if verb == 'quads' else ('--surface', mesh)))
            # The packing of few charts may differ, since libnest2d is under the LGPL.
            if verb != 'unwrap' or options:
                assert len({file.read_bytes() for file in files}) == 1, '%s %s: other bits' % (verb, name)
    print('maps are the same bits' if default else 'maps are made and proven')


def try_parent(build):
    run('cmake', '-S', CONSUMERS / 'parent', '-B', build, '-G', 'Ninja', '-DMAJORANT_SOURCE_DIR=%s' % SOURCE)
    run('ninja', '-C', build, 'parent', 'framework_user')
    value = float(run(build / 'parent', MESH))
    print('the parent says', value, 'of cap.obj')
    assert 4 < value < 6 and abs(float(run(build / 'framework_user')) - 73.5) < 1e-9
    assert not {'libcholmod', 'libceres', 'libopenblas', 'libgmp'} & set(loaded(build / 'framework_user'))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--shared', type=Path)
    parser.add_argument('--gpl-free', type=Path)
    parser.add_argument('--default', type=Path)
    parser.add_argument('--parent', type=Path)
    arguments = parser.parse_args()
    if arguments.shared:
        try_shared(arguments.shared.resolve())
    if arguments.gpl_free:
        try_gpl_free(arguments.gpl_free.resolve(), arguments.default and arguments.default.resolve())
    if arguments.parent:
        try_parent(arguments.parent.resolve())


if __name__ == '__main__':
    main()
