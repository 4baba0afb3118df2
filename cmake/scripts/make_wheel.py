#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Makes a wheel of the Python package of a build tree, with the libraries that it needs.

    cmake/scripts/make_wheel.py build/release dist [--python /usr/bin/python3]     prints the path of the wheel
    cmake/scripts/make_wheel.py --check dist/*.whl                                 what is wrong with it, exit 1

Nothing is compiled: modules are those of python/majorant in the tree, stripped of symbols. Libraries that
manylinux does not promise are beside the package, in majorant.libs, where the search path of the modules
points; each with the copyright file of its Debian package. The same tree gives the same bytes.
"""
import argparse
import base64
import hashlib
import os
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
# Debian 12. manylinux_2_36 permits these libraries, which every system has, with symbols up to these
# versions.
GLIBC = (2, 36)
PLATFORM = 'manylinux_%d_%d_x86_64' % GLIBC
SYSTEM = {'libc.so.6', 'libm.so.6', 'libdl.so.2', 'librt.so.1', 'libpthread.so.0', 'libstdc++.so.6', 'libgcc_s.so.1',
          'ld-linux-x86-64.so.2', 'linux-vdso.so.1'}
NEWEST = {'GLIBC': GLIBC, 'GLIBCXX': (3, 4, 30), 'CXXABI': (1, 3, 13), 'GCC': (12, 0, 0)}
LARGEST = 25 * 10 ** 6
# loaded by address, so that no module names it
BY_ADDRESS = ('libcairo.so.2',)
# Components whose code is in the modules: headers and archives.
COMPILED_IN = ('libeigen3-dev', 'libboost1.74-dev', 'libxsimd-dev', 'nlohmann-json3-dev', 'pybind11-dev')
GPL_COMPILED_IN = ('libcgal-dev', 'libceres-dev', 'libnest2d-dev')
TEXTS = ('Apache-2.0', 'GPL-2', 'GPL-3', 'LGPL-2.1', 'LGPL-3', 'MPL-1.1', 'MPL-2.0')
# CGAL and CHOLMOD are under the GPL, which applies to the whole wheel; the other components keep their
# licences. A wheel without them has its own version, with a suffix after a plus sign.
GPL_LICENCES = ('GPL-3.0-or-later', 'GPL-2.0-or-later', 'GPL-3.0-or-later WITH GCC-exception-3.1', 'LGPL-3.0-or-later',
                'LGPL-2.1-or-later')
GPL_LIBRARIES = ('libceres', 'libcholmod', 'libnlopt', 'libpolyclipping', 'libglog', 'libgflags', 'libspqr', 'libcxsparse',
                 'libgfortran', 'libquadmath', 'libgomp', 'libgmp', 'libmpfr')
PERMISSIVE = '+permissive'
LICENCES = ('BSD-3-Clause', 'MPL-2.0', 'MPL-1.1', 'Apache-2.0', 'BSL-1.0', 'MIT', 'FTL', 'IJG', 'Zlib', 'libpng-2.0',
            'Bitstream-Vera')


def output(*words):
    return subprocess.run(words, check=True, capture_output=True, text=True).stdout


def needed(path):
    """Returns the names of needed libraries, and their paths here."""
    names = re.findall(r'\(NEEDED\).*\[(.*)\]', output('readelf', '-d', path))
    return [name for name in names if name not in SYSTEM]


def found_by_loader(paths):
    places = {}
    for path in paths:
        for name, place in re.findall(r'^\s*(\S+) => (\S+)', output('ldd', path), re.M):
            places.setdefault(name, Path(place))
    return places


def system_library(name):
    for line in output('/sbin/ldconfig', '-p').splitlines():
        if line.split()[:1] == [name] and 'x86-64' in line:
            return Path(line.split()[-1])
    raise SystemExit(f'there is no {name}')


# Returns the netlib's BLAS or LAPACK if the system has an alternative: a third of the size of OpenBLAS.
def plainest(name, place):
    plain = Path('/usr/lib/x86_64-linux-gnu') / {'libblas.so.3': 'blas', 'liblapack.so.3': 'lapack'}.get(name, '') / name
    return plain if plain.exists() else place


def package_of(path):
    names = {str(path), os.path.realpath(path)}
    names |= {re.sub('^/usr', '', name) for name in names}
    for name in sorted(names):
        done = subprocess.run(['dpkg', '-S', name], capture_output=True, text=True)
        if done.returncode == 0:
            return done.stdout.split(':')[0]
    raise SystemExit(f'{path} is of no package: its licence is not known')


def staged(tree, python, folder):
    """Copies the package and its libraries below `folder`. Returns the paths of the originals."""
    suffix = output(python, '-c', 'import sysconfig; print(sysconfig.get_config_var("EXT_SUFFIX"))').strip()
    package = folder / 'majorant'
    package.mkdir()
    for path in sorted((SOURCE / 'python/majorant').iterdir()):
        if path.suffix in ('.py', '.pyi') or path.name == 'py.typed':
            shutil.copy(path, package)
    built = tree / 'python/majorant'
    modules = [built / f'_core{suffix}', *(p for p in sorted(built.glob('_*.so')) if not p.name.startswith('_core'))]
    if not modules[0].exists():
        raise SystemExit(f'{modules[0]} is not there; first: cmake --build {tree} --target majorant_python')
    for path in modules:
        subprocess.run(['strip', '--strip-unneeded', path, '-o', package / path.name], check=True)
    libraries = folder / 'majorant.libs'
    libraries.mkdir()
    copied, places = [], found_by_loader(modules)
    queue = [name for path in modules for name in needed(path)] + list(BY_ADDRESS)
    while queue:
        name = queue.pop()
        if (libraries / name).exists():
            continue
        place = plainest(name, places.get(name) or system_library(name))
        subprocess.run(['strip', '--strip-unneeded', os.path.realpath(place), '-o', libraries / name], check=True)
        copied.append(place)
        queue += needed(place)
    return copied


def has_gpl_parts(tree):
    return 'MAJORANT_GPL:BOOL=ON' in (tree / 'CMakeCache.txt').read_text()


def metadata(version, names):
    project = (SOURCE / 'pyproject.toml').read_text()
    field = lambda name: re.search(rf'^{name} = "(.*)"$', project, re.M)[1]
    numpy = re.search(r'dependencies = \["numpy(.*)"\]', project)[1]
    return '\n'.join([
        'Metadata-Version: 2.4', 'Name: majorant', f'Version: {version}', f'Summary: {field("description")}',
        'License-Expression: ' + ' AND '.join(names), 'License-File: LICENSE', f'Requires-Python: {field("requires-python")}',
        f'Requires-Dist: numpy{numpy}', 'Requires-Dist: scipy; extra == "framework"', 'Provides-Extra: framework',
        'Description-Content-Type: text/markdown', '', (SOURCE / 'README.md').read_text()])


def licences(folder, copied, compiled_in):
    folder.mkdir(parents=True)
    shutil.copy(SOURCE / 'LICENSE', folder / 'LICENSE')
    for path in sorted((SOURCE / 'LICENSES').iterdir()):
        shutil.copy(path, folder / path.name)
    for package in sorted({package_of(path) for path in copied} | set(compiled_in)):
        shutil.copy(f'/usr/share/doc/{package}/copyright', folder / f'{package}.txt')
    for name in TEXTS:
        shutil.copy(f'/usr/share/common-licenses/{name}', folder / f'{name}.txt')


def make(tree, destination, python):
    version = re.search(r'project\(majorant VERSION (\S+)', (SOURCE / 'CMakeLists.txt').read_text())[1]
    tag = output(python, '-c', 'import sys; print("cp%d%d" % sys.version_info[:2])').strip()
    is_gpl = has_gpl_parts(tree)
    if not is_gpl:
        version += PERMISSIVE
    name = f'majorant-{version}-{tag}-{tag}-{PLATFORM}.whl'
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        copied = staged(tree, python, folder)
        info = folder / f'majorant-{version}.dist-info'
        licences(info / 'licenses', copied, COMPILED_IN + (GPL_COMPILED_IN if is_gpl else ()))
        (info / 'METADATA').write_text(metadata(version, (GPL_LICENCES if is_gpl else ()) + LICENCES))
        (info / 'WHEEL').write_text(f'Wheel-Version: 1.0\nGenerator: majorant\nRoot-Is-Purelib: false\nTag: {tag}-{tag}-{PLATFORM}\n')
        destination.mkdir(parents=True, exist_ok=True)
        write(folder, info, destination / name)
    return destination / name


def write(folder, info, wheel):
    record = []
    with zipfile.ZipFile(wheel, 'w', zipfile.ZIP_DEFLATED) as archive:
        def add(name, data, mode):
            entry = zipfile.ZipInfo(name, (2026, 1, 1, 0, 0, 0))
            entry.external_attr = (0o100000 | mode) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, data)
        for path in sorted(p for p in folder.rglob('*') if p.is_file()):
            data, name = path.read_bytes(), path.relative_to(folder).as_posix()
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b'=').decode()
            record.append(f'{name},sha256={digest},{len(data)}')
            add(name, data, 0o755 if '.so' in path.name else 0o644)
        name = f'{info.name}/RECORD'
        add(name, '\n'.join([*record, f'{name},,']) + '\n', 0o644)


def defects(wheel):
    """Yields the reasons why the wheel would fail on a system that manylinux permits."""
    if wheel.stat().st_size > LARGEST:
        yield f'{wheel.name} has {wheel.stat().st_size / 1e6:.1f} MB, more than {LARGEST / 1e6:g}'
    versions = r'Name: (%s)_(\d[\d.]*)\b' % '|'.join(NEWEST)
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        with zipfile.ZipFile(wheel) as archive:
            archive.extractall(folder)
        libraries = {path.name for path in (folder / 'majorant.libs').iterdir()}
        if PERMISSIVE in wheel.name:
            for name in sorted(libraries):
                if name.startswith(GPL_LIBRARIES):
                    yield f'{name} is under the GPL or LGPL'
            if 'GPL' in next(folder.glob('*.dist-info/METADATA')).read_text().split('Requires-Python')[0]:
                yield 'the licence names the GPL'
        used = set(BY_ADDRESS)
        for path in sorted(p for p in folder.rglob('*') if '.so' in p.name):
            dynamic = output('readelf', '-d', path)
            names = needed(path)
            used.update(names)
            for name in sorted(set(names) - libraries):
                yield f'{path.name} needs {name}, which is not there'
            search = re.findall(r'\(R(?:UN)?PATH\).*\[(.*)\]', dynamic)
            if path.parent.name == 'majorant' and search != ['$ORIGIN/../majorant.libs']:
                yield f'{path.name} looks for libraries in {search}'
            for word in search:
                if not word.startswith('$ORIGIN'):
                    yield f'{path.name} looks for libraries in {word}'
            for kind, number in set(re.findall(versions, output('readelf', '-V', path))):
                if tuple(map(int, number.split('.'))) > NEWEST[kind]:
                    yield f'{path.name} needs {kind}_{number}'
        for name in sorted(libraries - used):
            yield f'nothing needs {name}'
        texts = list(folder.glob('*.dist-info/licenses/*'))
        if len(texts) < len(COMPILED_IN) + len(TEXTS):
            yield f'{len(texts)} licences alone'


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('tree', type=Path, nargs='?')
    parser.add_argument('destination', type=Path, nargs='?')
    parser.add_argument('--python', default='/usr/bin/python3')
    parser.add_argument('--check', type=Path, metavar='WHEEL')
    options = parser.parse_args()
    if options.check:
        found = list(defects(options.check))
        print('\n'.join(found) or f'{options.check.name}: {options.check.stat().st_size / 1e6:.1f} MB')
        sys.exit(bool(found))
    if not options.destination:
        parser.error('a build tree and a folder are needed')
    print(make(options.tree.resolve(), options.destination, options.python))


if __name__ == '__main__':
    main()
