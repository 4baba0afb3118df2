#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""What edge flips do for scaffolds: `--bijective` with and without `--no-flips`.

  bench/scaffold_quality.py [--binary build/release/apps/majorant] [MODEL ...]

Energy, iterations, and the smallest angle of every scaffold triangle (between its corners) at the
end: median, and the part below 5 degrees. Markdown on stdout. Needs ../shared/tools/vtu.py.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

from common import DEFAULT_BINARY, DEFAULT_SHARED, steps_taken

sys.path.insert(0, str(DEFAULT_SHARED / 'tools'))
import vtu  # noqa: E402

TINY = 5  # degrees


def smallest_angles(path):
    data = vtu.read_vtu(str(path))
    corners = data['uv'][data['cells'][:, :3]]
    angles = []
    for k in range(3):
        a, b = corners[:, (k + 1) % 3] - corners[:, k], corners[:, (k + 2) % 3] - corners[:, k]
        cross = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
        angles.append(np.degrees(np.abs(np.arctan2(cross, (a * b).sum(1)))))
    return np.min(angles, axis=0)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--binary', default=str(DEFAULT_BINARY))
    parser.add_argument('models', nargs='*', default=['helix_500', 'scorpion_500', 'skull_500'])
    args = parser.parse_args()
    print('| mesh | degree | flips | energy | iterations | triangles | median angle | below 5 | status |')
    print('|---|---|---|---|---|---|---|---|---|')
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        for model in args.models:
            mesh = DEFAULT_SHARED / 'data/public/disks' / (model + '.obj')
            for degree in (1, 2):
                for flags in ([], ['--no-flips']):
                    for old in folder.iterdir():
                        old.unlink()
                    subprocess.run([args.binary, 'parametrize', str(mesh), '--bijective', '--quiet',
                                    '--degree', str(degree), '--threads', '1', '-o',
                                    str(folder / 'map.vtu'), '--report', str(folder / 'map.json'),
                                    '--write-scaffold', str(folder / 'scaffold.vtu'), *flags],
                                   check=False)
                    report = json.loads((folder / 'map.json').read_text())
                    angles = smallest_angles(folder / 'scaffold.vtu')
                    print(f"| {model} | {degree} | {'omitted' if flags else 'done'} "
                          f"| {report['result']['value']:.5f} | {len(steps_taken(report))} "
                          f"| {len(angles)} | {np.median(angles):.1f} "
                          f"| {100 * (angles < TINY).mean():.1f} % "
                          f"| {report['status']} |", flush=True)


if __name__ == '__main__':
    main()
