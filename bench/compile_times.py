#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Measures a clean build: CPU seconds of every compiler and linker call, slowest first.

Configures an empty folder and builds with the compiler cache off. Each call is started by this script,
which records its CPU seconds (user and system). These depend little on other processes and on --jobs.
--touch FILE... lists what a change of FILE rebuilds. --suite runs the tests and prints the row of docs/architecture.md.
--formulas builds nothing. It compiles files with one energy of a user, with the flags of the examples but
without precompiled headers, and one that only includes majorant.h; the least time of --runs.

Sample runs:
  bench/compile_times.py
  bench/compile_times.py --cxx clang++
  bench/compile_times.py --touch energies/densities/arap.h
  bench/compile_times.py --suite
  bench/compile_times.py --options=-DCMAKE_UNITY_BUILD=OFF      (every file by itself)
  bench/compile_times.py --formulas
"""
import argparse
import json
import os
import re
import resource
import shlex
import shutil
import subprocess
import sys
import time
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / 'cmake/scripts'))
import include_graph  # noqa: E402

LOG = 'MAJORANT_CALL_TIMES'  # file that records the calls; if set, this process starts one call
ANISOTROPIC = 'J.squaredNorm() + J.inverse().squaredNorm()'
FORMULAS = [  # content of the file besides #include "majorant/majorant.h" and main
    ('no energy', ''),
    ('`spectral`', 'spectral("mine", [](auto S, auto s) { return S * S + s * s + 2.0 / (S * s); })'),
    ('`density<2, 2>`', f'density<2, 2>("mine", [](const auto& J) {{ return {ANISOTROPIC}; }})'),
    ('`density<2, 2>` with data', 'density<2, 2>("mine", [](const auto& J, double k) '
                                  f'{{ return k * ({ANISOTROPIC}); }}, Vec(Vec::Ones(9)))'),
    ('`density<3, 3>`', f'density<3, 3>("mine", [](const auto& J) {{ return {ANISOTROPIC}; }})'),
    ('`make_term<4, 3>`', 'Index, const auto& z'),
    ('`make_term<4, 3>`, for eight elements at a time', 'const auto& z'),
    ('`spectral`, `vectorized`', ''),
]
TERM = '''#include "majorant/framework/terms/local_term.h"
using namespace majorant;
std::shared_ptr<const EnergyTerm> mine() {
  return make_term<4, 3>("mine", Cells(1, 4), [](%s) {
    const auto J = (z.template rightCols<3>().colwise() - z.col(0)).eval();
    return J.squaredNorm() + J.inverse().squaredNorm();
  });
}
'''
VECTORIZED = '''#include "majorant/energies/vectorized.h"
using namespace majorant;
EnergyFactory mine() {
  auto f = spectral("mine", [](auto S, auto s) { return S * S + s * s + 2.0 / (S * s); });
  return energy_factory(f, vectorized(f));
}
'''


def seconds_of_children():
    """Returns user and system seconds of finished child processes."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def timed_call(log, command):
    """Runs one compiler or linker call and appends its seconds and its output's name."""
    status = subprocess.call(command)
    seconds = seconds_of_children()
    output = command[command.index('-o') + 1] if '-o' in command else '?'
    kind = 'compile' if '-c' in command or '-x' in command else 'link'
    with open(log, 'a') as file:
        file.write(f'{seconds:.3f}\t{kind}\t{output}\n')
    return status


def build(folder, log, jobs):
    """Builds all in `folder`. Returns the calls as [(seconds, kind, output)], slowest first."""
    log.write_text('')
    command = ['cmake', '--build', str(folder), '-j', str(jobs)]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL,
                   env=dict(os.environ, CCACHE_DISABLE='1', **{LOG: str(log)}))
    calls = (line.split('\t') for line in log.read_text().splitlines())
    return sorted(((float(s), kind, output) for s, kind, output in calls), reverse=True)


def short(output):
    """Shortens tests/CMakeFiles/x.dir/a/b.cpp.o to x: a/b.cpp."""
    match = re.search(r'([^/]+)\.dir/(.*)\.(?:o|gch|pch)$', output)
    return f'{match[1]}: {match[2]}' if match else output


def part(output):
    """Returns the purpose of the call: tests, the library, the command or the programs beside it."""
    if 'cmake_pch' in output:
        return 'precompiled headers'
    for name, key in (('tests', 'tests/'), ('examples', 'examples/'), ('bench', 'bench/'),
                      ('Python', 'python/'), ('majorant-mpi', 'apps/mpi/'), ('library', 'majorant_results.dir/'),
                      ('kernels', '_kernels_'), ('command', 'apps/')):
        if key in output:
            return name
    return 'library'


def print_calls(calls, count):
    parts = defaultdict(lambda: [0, 0.0])
    for seconds, kind, output in calls:
        key = part(output) if kind == 'compile' else 'links'
        parts[key][0] += 1
        parts[key][1] += seconds
    print('| part | calls | CPU s |\n|---|---|---|')
    for name, (number, seconds) in sorted(parts.items(), key=lambda entry: -entry[1][1]):
        print(f'| {name} | {number} | {seconds:.1f} |')
    print(f'| all | {len(calls)} | {sum(call[0] for call in calls):.1f} |')
    print('\n| slowest | CPU s |\n|---|---|')
    for seconds, _, output in calls[:count]:
        print(f'| {short(output)} | {seconds:.1f} |')


def sizes(source):
    """Returns the numbers of files, lines and public headers of the library and its commands."""
    modules = [source, *(source / module / part for module in include_graph.LAYER
                       for part in ('', 'internal', 'detail', 'densities', 'kernels'))]
    files = {path for module in modules for path in module.glob('*') if path.suffix in ('.h', '.cpp')}
    lines = sum(len(path.read_text().splitlines()) for path in files)
    public = (source / 'cmake/public_headers.txt').read_text().splitlines()
    return [len(files), lines, sum(not line.startswith('#') for line in public)]


def suite(folder, jobs):
    """Runs all tests as `make test` does. Returns CPU seconds, seconds, and whether all have passed."""
    before, begin = seconds_of_children(), time.monotonic()
    runs = [subprocess.run(['ctest', '--test-dir', str(folder), '--no-tests=error', *which],
                           stdout=subprocess.DEVNULL).returncode
            for which in (['-j', str(jobs), '-LE', 'mpi'], ['-L', 'mpi'])]
    return seconds_of_children() - before, time.monotonic() - begin, not any(runs)


def print_row(source, folder, compiled, jobs):
    used, elapsed, passed = suite(folder, jobs)
    print('\n| files | lines | public headers | build, CPU s | tests, CPU s | '
          'tests, s |\n|---|---|---|---|---|---|')
    print('| %s |' % ' | '.join(f'{x:,.0f}' for x in [*sizes(source), compiled, used, elapsed]))
    if not passed:
        sys.exit('tests have failed: ctest --test-dir %s --rerun-failed' % folder)


def formula_source(name, formula):
    text = '#include "majorant/majorant.h"\n'
    if 'make_term' in name:
        text += TERM % formula
    elif formula:
        text += ('using namespace majorant;\n'
                 f'EnergyFactory mine() {{ return energy_factory({formula}); }}\n')
    return text + (VECTORIZED if 'vectorized' in name else '') + 'int main() { return 0; }\n'


def example_command(folder):
    """Returns the compiler command of an example, without the names of its source and output."""
    entries = json.loads((folder / 'compile_commands.json').read_text())
    entry = next(e for e in entries if e['file'].endswith('examples/custom_energy.cpp'))
    words = shlex.split(entry['command'])
    return words[next(k for k, w in enumerate(words) if w.endswith('++')):words.index('-o')]


def print_formulas(folder, runs):
    command = example_command(folder)
    least = {}
    for name, formula in FORMULAS:
        source = folder / 'formula.cpp'
        source.write_text(formula_source(name, formula))
        for _ in range(runs):
            before = seconds_of_children()
            subprocess.run([*command, '-o', folder / 'formula.o', '-c', source], check=True, cwd=folder)
            seconds = seconds_of_children() - before
            least[name] = min(seconds, least.get(name, seconds))
    print('| the file has | CPU s | ratio |\n|---|---|---|')
    for name, seconds in least.items():
        print(f"| {name} | {seconds:.1f} | {seconds / least['no energy']:.2f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument('--source', type=Path, default=ROOT)
    parser.add_argument('--folder', type=Path, default=ROOT / 'build' / 'compile_times')
    parser.add_argument('--cxx', default='g++')
    parser.add_argument('--jobs', type=int, default=2)
    parser.add_argument('--slowest', type=int, default=15)
    parser.add_argument('--touch', nargs='*', default=[],
                        help='then touch each file and build again')
    parser.add_argument('--suite', action='store_true', help='then run the tests')
    parser.add_argument('--options', nargs='*', default=[], help='of cmake')
    parser.add_argument('--formulas', action='store_true', help='compile files of a user instead')
    parser.add_argument('--runs', type=int, default=3, help='of each file of --formulas')
    args = parser.parse_args()
    folder = args.folder.resolve()
    shutil.rmtree(folder, ignore_errors=True)
    launcher = Path(__file__).resolve()
    subprocess.run(['cmake', '--preset', 'release', '-S', args.source.resolve(), '-B', folder,
                    f'-DCMAKE_CXX_COMPILER={args.cxx}', f'-DCMAKE_CXX_COMPILER_LAUNCHER={launcher}',
                    f'-DCMAKE_CXX_LINKER_LAUNCHER={launcher}', '-DCMAKE_EXPORT_COMPILE_COMMANDS=ON',
                    *(['-DMAJORANT_PRECOMPILED_HEADERS=OFF'] if args.formulas else []), *args.options],
                   check=True, stdout=subprocess.DEVNULL, cwd=args.source)
    if args.formulas:
        return print_formulas(folder, args.runs)
    log = folder / 'calls.txt'
    calls = build(folder, log, args.jobs)
    print_calls(calls, args.slowest)
    for name in args.touch:
        (args.source / name).touch()
        again = build(folder, log, args.jobs)
        compiled = [short(output) for _, kind, output in again if kind == 'compile']
        print(f'\n{name}: {len(compiled)} compiled, {len(again) - len(compiled)} linked, '
              f'{sum(call[0] for call in again):.1f} s\n  ' + '\n  '.join(compiled))
    if args.suite:
        print_row(args.source, folder, sum(call[0] for call in calls), args.jobs)


if __name__ == '__main__':
    if LOG in os.environ:
        sys.exit(timed_call(os.environ[LOG], sys.argv[1:]))
    main()
