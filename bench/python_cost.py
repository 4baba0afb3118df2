#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""What Python costs: a call against the command, and a density in numpy against the kernel.

Of processor time on one thread, what is compared in alternation: the least of several rounds, and their ratio. The
module and the command are those of one build, so they have the same kernels, which are printed.

  call     the command from its start to its end, parametrize IN.obj -o OUT.vtu --degree 3, against
           parametrize(*read_mesh(IN), degree=3).save(OUT) in an interpreter that runs already: both read, solve, prove
           and write; once more with a callback. What starting that interpreter costs is a line of its own.
  density  symmetric Dirichlet of docs/python.md, example 4, against the kernel that has this name

Sample run:
  bench/python_cost.py --build build/release
"""
import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

SOURCE = Path(__file__).resolve().parents[1]


def grid(n):
    """A bumpy square of 2 n^2 triangles."""
    x, y = np.meshgrid(np.linspace(0, 1, n + 1), np.linspace(0, 1, n + 1))
    V = np.column_stack([x.ravel(), y.ravel(), 0.3 * np.sin(3 * x.ravel()) * np.cos(4 * y.ravel())])
    k = np.arange((n + 1) ** 2).reshape(n + 1, n + 1)
    a, b, c, d = k[:-1, :-1].ravel(), k[:-1, 1:].ravel(), k[1:, 1:].ravel(), k[1:, :-1].ravel()
    return V, np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])])


def processor_seconds(who):
    used = resource.getrusage(who)
    return used.ru_utime + used.ru_stime


def seconds(call, who=resource.RUSAGE_SELF):
    before = processor_seconds(who)
    call()
    return processor_seconds(who) - before


def dirichlet():
    """Symmetric Dirichlet as one would write it (docs/python.md)."""
    text = (SOURCE / 'docs/python.md').read_text()
    block = next(b for b in text.split('```python\n')[1:] if 'def derivatives' in b).split('```')[0]
    scope = {}
    exec(block[:block.index('mine.check_derivatives')], scope)
    return scope['mine']


def call_against_command(majorant, binary, faces, rounds):
    V, F = grid(round((faces / 2) ** 0.5))
    with tempfile.TemporaryDirectory() as folder:
        mesh, out = f'{folder}/mesh.obj', f'{folder}/out.vtu'
        with open(mesh, 'w') as file:
            file.writelines('v %r %r %r\n' % tuple(v) for v in V.tolist())
            file.writelines('f %d %d %d\n' % tuple(f) for f in (F + 1).tolist())

        def command():
            subprocess.run([binary, 'parametrize', mesh, '-o', out, '--degree', '3', '--threads', '1', '--quiet',
                            '--report', f'{folder}/r.json'], check=True)

        def call(**options):
            majorant.parametrize(*majorant.read_mesh(mesh), degree=3, threads=1, **options).save(out)

        def start():
            subprocess.run([sys.executable, '-c', 'import majorant'], check=True, env={
                **os.environ, 'PYTHONPATH': str(Path(majorant.__file__).parents[1])})

        times = [(seconds(command, resource.RUSAGE_CHILDREN), seconds(call),
                  seconds(lambda: call(callback=lambda step: None)), seconds(start, resource.RUSAGE_CHILDREN))
                 for _ in range(rounds)]
    return [min(column) for column in zip(*times)], len(F)


def density_against_kernel(majorant, faces, rounds):
    V, F = grid(round((faces / 2) ** 0.5))
    space = majorant.Space(V, F, 3)
    x = space.tutte()
    problems = []
    for energy in ('symmetric-dirichlet', dirichlet()):
        problems.append(majorant.Problem(space.size).add(space.energy(energy, quadrature=36)))
        problems[-1].value(x)
    works = {'value': lambda p: p.value(x), 'projected Hessian': lambda p: p._core.linearize(x, 'projected'),
             'exact Hessian': lambda p: p._core.linearize(x, 'exact')}
    times = {name: [[seconds(lambda: work(p)) for p in problems] for _ in range(rounds)] for name, work in works.items()}
    return {name: [min(column) for column in zip(*pairs)] for name, pairs in times.items()}, len(F)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--build', default=SOURCE / 'build/release', type=Path)
    parser.add_argument('--faces', default=10000, type=int)
    parser.add_argument('--rounds', default=5, type=int)
    parser.add_argument('--json', help='write the figures here, too')
    options = parser.parse_args()
    os.environ['OMP_NUM_THREADS'] = '1'
    sys.path.insert(0, str(options.build.resolve() / 'python'))
    import majorant

    print('kernels:', majorant.kernels())
    (command, call, watched, start), faces = call_against_command(
        majorant, options.build.resolve() / 'apps/majorant', options.faces, options.rounds)
    print(f'{faces} faces, degree 3, read, solved, written: command {command:.3f} s, Python {call:.3f} s: '
          f'{call / command:.3f}, with a callback {watched:.3f} s: {watched / command:.3f}')
    print(f'an interpreter that imports majorant: {start:.3f} s')
    costs, faces = density_against_kernel(majorant, options.faces, options.rounds)
    for name, (kernel, density) in costs.items():
        print(f'{faces} faces, 36 points, degree 3, {name}: kernel {1e3 * kernel:.1f} ms, numpy '
              f'{1e3 * density:.1f} ms: {density / kernel:.1f}')
    if options.json:
        Path(options.json).write_text(json.dumps({'kernels': majorant.kernels(), 'command': command, 'call': call,
                                                  'watched': watched, 'start': start, 'costs': costs}, indent=1))


if __name__ == '__main__':
    main()
