#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Would condensing the unknowns inside of elements pay, in `majorant mesh optimize`? A Markdown table.

Balls of tetrahedra, cylinders of wedges and boxes of hexahedra by python3-gmsh, --boundary fixed, one thread. Of the
time of all of Newton's steps: assembly, factorization and solve, proofs and line search. Condensed would be the
unknowns of nodes inside of one element. At most all that factorization and solve take could be gained, by condensed
systems that cost nothing; the estimate is the part of the unknowns that goes, of that.

Sample runs:
  bench/volume_steps.py
  bench/volume_steps.py --binary build/release/apps/majorant --degrees 2 3 4
"""
import argparse
import json
import math
import os
import subprocess
import sys
import tempfile

import gmsh

# Nodes inside of an element of degree n.
INSIDE = {
    'tetrahedra': lambda n: math.comb(n - 1, 3),
    'wedges': lambda n: (n - 1) * math.comb(n - 1, 2),
    'hexahedra': lambda n: (n - 1) ** 3,
}
SIZES = {'tetrahedra': 0.35, 'wedges': 0.35, 'hexahedra': 0.2}


def make(kind, degree, path):
    gmsh.clear()
    occ, mesh = gmsh.model.occ, gmsh.model.mesh
    for name in ('Mesh.MeshSizeMin', 'Mesh.MeshSizeMax'):
        gmsh.option.setNumber(name, SIZES[kind])
    if kind == 'tetrahedra':
        occ.addSphere(0, 0, 0, 1)
    else:
        face = occ.addDisk(0, 0, 0, 1, 1) if kind == 'wedges' else occ.addRectangle(0, 0, 0, 1, 1)
        occ.extrude([(2, face)], 0, 0, 1, [math.ceil(1 / SIZES[kind])], recombine=True)
    occ.synchronize()
    if kind == 'hexahedra':
        mesh.setTransfiniteSurface(1)
        mesh.setRecombine(2, 1)
    mesh.generate(3)
    mesh.setOrder(degree)
    gmsh.write(path)
    return len(mesh.getElements(3)[1][0])


def measure(binary, kind, degree, folder):
    source, report = os.path.join(folder, 'a.msh'), os.path.join(folder, 'r.json')
    count = make(kind, degree, source)
    run = subprocess.run([binary, 'mesh', 'optimize', source, '-o', os.path.join(folder, 'b.msh'), '--threads', '1',
                          '-q', '--energy', 'mips', '--force', '--report', report], capture_output=True, text=True)
    if run.returncode not in (0, 4):
        sys.exit(run.stderr)
    with open(report) as file:
        data = json.load(file)
    steps = [row['seconds'] for row in data['iterations']]
    parts = {key: sum(row[key] for row in steps) for key in ('assemble', 'factorize', 'solve', 'line_search')}
    return count, data['result']['variables'], len(steps), parts


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--binary', default='build/release/apps/majorant')
    parser.add_argument('--degrees', type=int, nargs='+', default=[3, 4])
    asked = parser.parse_args()
    gmsh.initialize()
    gmsh.option.setNumber('General.Terminal', 0)
    print('| elements | degree | unknowns | of these inside | steps | assembly | factorization, solve | '
          'proofs, line search | gain, at most | estimate |')
    print('|---|---|---|---|---|---|---|---|---|---|')
    with tempfile.TemporaryDirectory() as folder:
        for kind, inside in INSIDE.items():
            for degree in asked.degrees:
                count, unknowns, steps, parts = measure(asked.binary, kind, degree, folder)
                whole = sum(parts.values())
                system = parts['factorize'] + parts['solve']
                share = 3 * count * inside(degree) / unknowns
                percent = [100 * x / whole for x in (parts['assemble'], system, parts['line_search'], system,
                                                     share * system)]
                print('| %d %s | %d | %d | %.0f %% | %d | %.0f %% | %.1f %% | %.0f %% | %.1f %% | %.1f %% |' % (
                    count, kind, degree, unknowns, 100 * share, steps, *percent), flush=True)
    gmsh.finalize()
    return 0


if __name__ == '__main__':
    sys.exit(main())
