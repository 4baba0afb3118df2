#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that energies do not depend on units, rotations and numbering, and files not on the number of threads.

Scales each mesh by 1e-6 and 1e6, rotates it, permutes its vertices and rotates the corners of its
faces: the report's value may change by less than 1e-9. Then writes VTU, OBJ and SVG with one thread
and with two: they must be equal byte by byte. Exit code 0 exactly if both hold everywhere.

Sample runs:
  bench/invariance.py
  bench/invariance.py --degrees 3 ../shared/data/public/disks/plane_500.obj
"""
import sys
import tempfile
from pathlib import Path

import common

DEFAULT_MESHES = ('spot_500', 'koala_500', 'nefertiti_2500')
LIMIT = 1e-9                                      # bound on the relative change of the value
SEED = 7
FORMATS = ('vtu', 'obj', 'svg')


# ------------------------------------------------------------------ variants of a surface
def scaled(factor):
    return lambda vertices, faces, random: (factor * vertices, faces)


def rotated(vertices, faces, random):
    import numpy as np
    rotation = np.linalg.qr(random.standard_normal((3, 3)))[0]
    rotation *= np.sign(np.linalg.det(rotation))
    return vertices @ rotation.T, faces


def permuted(vertices, faces, random):
    import numpy as np
    order = random.permutation(len(vertices))
    place = np.empty(len(vertices), int)
    place[order] = np.arange(len(vertices))
    return vertices[order], place[faces]


def turned_corners(vertices, faces, random):
    import numpy as np
    shift = random.integers(1, 3, len(faces))[:, None]
    return vertices, np.take_along_axis(faces, (np.arange(3) + shift) % 3, axis=1)


def unchanged(vertices, faces, random):
    return vertices, faces


VARIANTS = {'none': unchanged, 'scale 1e-6': scaled(1e-6), 'scale 1e6': scaled(1e6), 'rotate': rotated,
            'permute vertices': permuted, 'turn corners': turned_corners}


# ------------------------------------------------------------------ runs
def value_of(options, mesh, degree, folder):
    """Returns (value, None) or (None, error)."""
    report_path = folder / 'report.json'
    report_path.unlink(missing_ok=True)
    done = common.parametrize(options, mesh, [folder / 'out.vtu'], '--degree', degree,
                              '--report', report_path, '--threads', 1)
    report, problem = common.load_report(report_path)
    if done.code != 0 or problem:
        return None, 'exit %s %s' % (done.code, problem or done.stderr.strip())
    return report['result']['value'], None


def compare_variants(options, path, degree, folder):
    """Returns rows (mesh, degree, variant, value, change, holds)."""
    import numpy as np
    vertices, faces = common.read_obj(path)
    rows, base = [], None
    for name, change in VARIANTS.items():
        mesh = folder / 'variant.obj'
        common.write_obj(mesh, *change(vertices, faces, np.random.default_rng(SEED)))
        value, problem = value_of(options, mesh, degree, folder)
        base = value if name == 'none' else base
        known = value is not None and base is not None
        relative = abs(value / base - 1) if known else None
        holds = known and relative < LIMIT
        rows.append([path.stem, degree, name, common.cell(value, '%.12g'),
                     problem or common.cell(relative, '%.1e'), 'ok' if holds else 'NO'])
    return rows


def written(options, path, degree, threads, folder):
    """Returns (bytes of each format, problem) of a run with so many threads."""
    place = folder / str(threads)
    place.mkdir()
    outputs = [place / ('out.' + form) for form in FORMATS]
    done = common.parametrize(options, path, outputs, '--degree', degree, '--threads', threads)
    missing = [output.name for output in outputs if not output.exists()]
    if done.code != 0 or missing:
        return {}, 'exit %s, missing %s' % (done.code, missing)
    return {form: output.read_bytes() for form, output in zip(FORMATS, outputs)}, None


def compare_threads(options, path, degree, folder):
    """Returns rows (mesh, degree, format, bytes, difference, holds)."""
    one, first = written(options, path, degree, 1, folder)
    two, second = written(options, path, degree, 2, folder)
    rows = []
    for form in FORMATS:
        same = form in one and one[form] == two.get(form)
        rows.append([path.stem, degree, form + ', threads 1 and 2', '%d bytes' % len(one.get(form, b'')),
                     first or second or ('identical' if same else 'differs'), 'ok' if same else 'NO'])
    return rows


def parse_arguments():
    parser = common.parser(__doc__)
    parser.add_argument('meshes', nargs='*', type=Path, help='triangle OBJ files of disks')
    parser.add_argument('--degrees', default='1,3', help='comma separated')
    return parser.parse_args()


def main():
    options = parse_arguments()
    common.require_files(options)
    folder = options.shared / 'data/public/disks'
    meshes = options.meshes or [folder / (name + '.obj') for name in DEFAULT_MESHES]
    rows = []
    for path in meshes:
        for degree in map(int, options.degrees.split(',')):
            with tempfile.TemporaryDirectory(prefix='majorant_invariance_') as place:
                rows += compare_variants(options, path, degree, Path(place))
                rows += compare_threads(options, path, degree, Path(place))
    print('\n'.join(common.markdown_table(['mesh', 'degree', 'variant', 'value', 'change', 'holds'], rows)))
    bad = sum(row[-1] != 'ok' for row in rows)
    print('\n%d of %d comparisons hold' % (len(rows) - bad, len(rows)))
    return 1 if bad else 0


if __name__ == '__main__':
    sys.exit(main())
