#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Counts iterations of `--bijective` at degree 1 by the usual measures for SCAF.

bench/scaffold_iterations.py [--binary build/release/apps/majorant] [--faces 500] [MODEL ...]

For every disk: iterations until the energy is within 1 % and 0.1 % of the optimum; how far the
end is above the free optimum; iterations and seconds in all. The optimum is the free (locally
injective) one if it is embedded, else the end of the bijective run. Markdown on stdout.
"""
import argparse
import json
import pathlib
import subprocess
import tempfile

from common import DEFAULT_BINARY, DEFAULT_SHARED, steps_taken

MODELS = ['helix', 'plane', 'scorpion', 'skull', 'koala', 'spot', 'blub', 'goathead', 'nefertiti',
          'hand', 'mountain', 'demosthenes', 'penguin']


def run(binary, mesh, folder, *flags):
    report = pathlib.Path(folder) / 'report.json'
    report.unlink(missing_ok=True)
    subprocess.run([binary, 'parametrize', mesh, '--degree', '1', '--quiet', '--threads', '1',
                    '-o', str(pathlib.Path(folder) / 'out.vtu'), '--report', str(report), *flags],
                   check=False)
    return json.loads(report.read_text())


def first_below(trace, bound):
    for entry in trace:
        if entry['energy'] <= bound:
            return str(entry['iteration'])
    return '-'


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--binary', default=str(DEFAULT_BINARY))
    parser.add_argument('--faces', type=int, default=500)
    parser.add_argument('models', nargs='*', default=MODELS)
    args = parser.parse_args()
    folder = DEFAULT_SHARED / 'data/public/disks'
    print('| mesh | to 1 % | to 0.1 % | iterations | end | above free optimum | free embedded | s |')
    print('|---|---|---|---|---|---|---|---|')
    with tempfile.TemporaryDirectory() as scratch:
        for model in args.models:
            mesh = min(folder.glob(model + '_*.obj'),
                       key=lambda p: abs(int(p.stem.split('_')[1]) - args.faces))
            free = run(args.binary, str(mesh), scratch)
            held = run(args.binary, str(mesh), scratch, '--bijective')
            trace, end = steps_taken(held), held['result']['value']
            optimum = free['result']['value']
            embedded = free['result']['globally_injective']
            target = optimum if embedded else end
            print(f"| {mesh.stem} | {first_below(trace, 1.01 * target)} "
                  f"| {first_below(trace, 1.001 * target)} | {len(trace)} "
                  f"| {held['status']}, {end:.5f} | {100 * (end / optimum - 1):.3f} % "
                  f"| {'yes' if embedded else 'no'} | {held['seconds']['total']:.2f} |", flush=True)


if __name__ == '__main__':
    main()
