#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Counts how often `majorant seamless` finds a valid map for cones at random vertices.

Each set has as many cones of index 1/4 (or -1/4) as a closed surface needs, or one of each on other surfaces,
and --pairs pairs of index 1/4 and -1/4. Vertices are random, and not on the boundary. Runs `seamless --degree
1 --max-iterations 0` with every --start; a set counts when a map is written (exit 4) and verify.py finds no
violation. Prints a Markdown table. Exit code 0 exactly if verify.py accepts every map and each other run ends
with exit code 5, or with 1 for conformal starts on surfaces other than spheres and disks.

Sample runs:
  tests/campaigns/random_cones.py --sets 10 --pairs 6
  tests/campaigns/random_cones.py --meshes spot_1654,torus_g1_4608 --starts field,scaled-field
"""
import argparse
import collections
import json
import random
import sys
import tempfile
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[2] / 'bench'))
import common  # noqa: E402

MESHES = ['buckle', 'spot_1654', 'blub_1886', 'torus_g1_4608', 'skull_g2_10312']
STARTS = ['field', 'scaled-field', 'conformal', 'automatic']
REFUSED = 1                                       # the conformal start is refused


def find_mesh(options, name):
    own = common.ROOT / 'examples/meshes' / (name + '.obj')
    return own if own.exists() else options.shared / 'data/public/closed' / (name + '.obj')


def read_faces(path):
    return common.read_obj(path)[1].tolist()


def interior_vertices(faces):
    """Returns (vertices that are not on the boundary, 4 times the Euler characteristic, or 0 with a
    boundary)."""
    directed = {(f[i], f[(i + 1) % 3]) for f in faces for i in range(3)}
    boundary = {v for a, b in directed if (b, a) not in directed for v in (a, b)}
    vertices = {v for f in faces for v in f}
    euler = len(vertices) - len({(min(e), max(e)) for e in directed}) + len(faces)
    return sorted(vertices - boundary), 0 if boundary else 4 * euler


def random_cones(faces, pairs, seed):
    interior, sum_of_turns = interior_vertices(faces)
    turns = [3] * max(sum_of_turns, 0) + [5] * max(-sum_of_turns, 0) + [3, 5] * pairs
    places = random.Random(seed).sample(interior, len(turns))
    return [{'vertex': v, 'quarter_turns': q} for v, q in zip(places, turns)]


def attempt(options, path, start, cone_file, result):
    """Returns 'valid', 'none' (exit 5), 'refused', or the defect."""
    result.unlink(missing_ok=True)
    done = common.parametrize(options, path, [result], '--degree', 1, '--max-iterations', 0, '--cones',
                              cone_file, '--start', start, '--threads', 1, verb='seamless')
    if done.code in (0, 4) and result.exists():
        checked = common.verify(options, result, path, None, '--cuts', 'auto', '--no-energy',
                                '--max-cut-fraction', '1')
        problems = common.failed_checks(checked)
        return 'verify: ' + ', '.join(problems) if problems else 'valid'
    if done.code == REFUSED and start == 'conformal':
        return 'refused'
    return 'none' if done.code == 5 and not result.exists() else 'exit %s' % done.code


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    common.add_options(parser)
    words = lambda text: text.split(',')
    parser.add_argument('--meshes', type=words, default=MESHES)
    parser.add_argument('--starts', type=words, default=STARTS)
    parser.add_argument('--sets', type=int, default=10)
    parser.add_argument('--pairs', type=int, default=6)
    options = parser.parse_args()
    common.require_files(options)
    rows, wrong = [], []
    with tempfile.TemporaryDirectory(prefix='majorant_cones_') as folder:
        cone_file, result = Path(folder) / 'cones.json', Path(folder) / 'out.vtu'
        for name in options.meshes:
            path = find_mesh(options, name)
            faces = read_faces(path)
            found = collections.defaultdict(list)
            for seed in range(options.sets):
                cones = random_cones(faces, options.pairs, seed)
                cone_file.write_text(json.dumps({'cones': cones}))
                for start in options.starts:
                    outcome = attempt(options, path, start, cone_file, result)
                    found[start].append(outcome)
                    if outcome not in ('valid', 'none', 'refused'):
                        wrong.append('%s, seed %d, %s: %s' % (name, seed, start, outcome))
            row = [name, len(cones)]
            for start in options.starts:
                refused = found[start].count('refused') == options.sets
                row.append('-' if refused else found[start].count('valid'))
            rows.append(row)
            sys.stderr.write(' '.join(map(str, row)) + '\n')
    header = ['mesh', 'cones'] + ['`%s`, of %d' % (s, options.sets) for s in options.starts]
    print('\n'.join(common.markdown_table(header, rows)))
    for line in wrong:
        print('* ' + line)
    return 1 if wrong else 0


if __name__ == '__main__':
    sys.exit(main())
