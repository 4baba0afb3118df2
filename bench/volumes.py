#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Measures `majorant mesh optimize` on volume meshes and planar meshes: steps, factorizations, time, quality.

Meshes: public ones of shared/data; cubes of six tetrahedra whose inner vertices are moved at random (made here, with
the seeds in their names); and, if python3-gmsh is installed, models of tests/campaigns/gmsh_models.py in degrees 2
and 3, compared with gmsh's HighOrderElastic.

  bench/volumes.py                        the program of build/release
  bench/volumes.py --before OLD           each number as "before -> now"; OLD is another program

A row has: elements and degree; the status; Newton steps of untangling; Newton steps and factorizations after it; CPU
seconds on one thread (the least of --runs); seconds on two threads relative to those on one; scaled Jacobians, least
and mean; CPU seconds of HighOrderElastic. The last line is the largest ratio of times of the cubes tangled_o2_n8_400
and tangled_o2_n6_120. Exit code 1 if files of one and two threads differ, or a written mesh is not valid.
"""
import json
import os
import random
import resource
import subprocess
import sys
import tempfile
import time

import common

sys.path.insert(0, str(common.ROOT / 'tests/campaigns'))

PUBLIC = ('generated/tangled_o2_n4_25.msh', 'generated/tangled_o2_n6_120.msh', 'generated/tangled_o2_n8_400.msh',
          'generated/tets_o2_n4.msh', 'mfem/escher-p2.mesh', 'mfem/escher-p3.mesh', 'mfem/square-disc-p2.mesh',
          'mfem/square-disc-p3.mesh', 'mfem/jagged.mesh', 'mfem/blade.mesh', 'mfem/icf.mesh', 'mfem/cube-tet.mesh',
          'mfem/stretched2D.mesh', 'mfem/beam-tet.mesh', 'mfem/fichera-mixed-p2.mesh', 'polyfem/sphere_p2.msh',
          'polyfem/sphere_p3.msh', 'polyfem/circle_p3.msh')
CUBES = ((3, 0.6, 1), (4, 0.9, 2), (6, 0.6, 3), (8, 0.45, 4))  # cells per side, largest shift, seed
MODELS = ('ball', 'box_and_rod', 'cone', 'one_hole', 'tube', 'two_balls')
MOST_ELEMENTS = 1200  # upper bound on the elements of a model
ORDERS = ((0, 1, 2), (1, 2, 0), (2, 0, 1), (1, 0, 2), (2, 1, 0), (0, 2, 1))


def cube(count, shift, seed):
    """Returns a Medit mesh of count^3 unit cubes of six tetrahedra each."""
    chance = random.Random(seed)
    steps = range(count + 1)

    def place(i, j, k):
        is_inside = 0 < min(i, j, k) and max(i, j, k) < count
        return [x + (chance.uniform(-shift, shift) if is_inside else 0.0) for x in (i, j, k)]
    points = [place(i, j, k) for k in steps for j in steps for i in steps]
    cells = []
    for k in range(count):
        for j in range(count):
            for i in range(count):
                for t, order in enumerate(ORDERS):
                    at, corners = [i, j, k], []
                    for axis in (None, *order):
                        if axis is not None:
                            at[axis] += 1
                        corners.append(1 + at[0] + (count + 1) * (at[1] + (count + 1) * at[2]))
                    if t >= 3:
                        corners[1], corners[2] = corners[2], corners[1]
                    cells.append(corners)
    return ('MeshVersionFormatted 2\nDimension 3\nVertices %d\n' % len(points) +
            ''.join('%r %r %r 0\n' % tuple(p) for p in points) + 'Tetrahedra %d\n' % len(cells) +
            ''.join('%d %d %d %d 1\n' % tuple(c) for c in cells) + 'End\n')


def make_model(name, folder):
    """Writes a model of gmsh_models.py in degrees 2 and 3. Yields each with the CPU seconds of HighOrderElastic."""
    import gmsh_models
    for order in (2, 3):
        gmsh = gmsh_models.start_gmsh()
        gmsh_models.MODELS[name]()
        gmsh.model.occ.synchronize()
        low, high = (gmsh.model.getBoundingBox(-1, -1)[k:k + 3] for k in (0, 3))
        size = sum((b - a) ** 2 for a, b in zip(low, high)) ** 0.5 / 4
        best = None
        while gmsh_models.mesh_of_size(gmsh, size) <= MOST_ELEMENTS:
            best = size if gmsh_models.elements(gmsh) > 0 else best
            size *= 0.82
        gmsh_models.mesh_of_size(gmsh, best)
        gmsh.model.mesh.setOrder(order)
        path = os.path.join(folder, '%s_o%d.msh' % (name, order))
        gmsh.write(path)
        before = time.process_time()
        gmsh.model.mesh.optimize('HighOrderElastic')
        yield path, time.process_time() - before
        gmsh.finalize()


class Runs:
    def __init__(self, binary, folder, runs, words):
        self.binary, self.folder, self.runs, self.words, self.faults = str(binary), folder, runs, words, 0

    def once(self, path, threads):
        out, report = (os.path.join(self.folder, name) for name in ('out' + os.path.splitext(path)[1], 'r.json'))
        if os.path.exists(out):
            os.remove(out)
        used, began = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
        subprocess.run([self.binary, 'mesh', 'optimize', path, '-o', out, '-q', '--threads', str(threads), '--report',
                        report, *self.words], capture_output=True)
        seconds, after = time.monotonic() - began, resource.getrusage(resource.RUSAGE_CHILDREN)
        cpu = after.ru_utime - used.ru_utime
        with open(report) as file:
            summary = json.load(file)
        content = b''
        if os.path.exists(out):
            with open(out, 'rb') as file:
                content = file.read()
            if subprocess.run([self.binary, 'mesh', 'check', out, '-q'], capture_output=True).returncode != 0:
                self.faults += 1
        return summary, cpu, seconds, content

    def row(self, path):
        one = [self.once(path, 1) for _ in range(self.runs)]
        two = [self.once(path, 2) for _ in range(self.runs)]
        self.faults += one[0][3] != two[0][3]
        summary = one[0][0]
        steps = summary.get('iterations', [])
        mesh = summary['result']['mesh']
        return {'elements': mesh['checked'], 'degree': max(mesh['orders']), 'status': summary['status'],
                'untangling': summary['result']['untangling_iterations'], 'steps': len(steps),
                'factorizations': sum(step['factorizations'] for step in steps),
                'cpu': min(run[1] for run in one),
                'two': min(run[2] for run in two) / min(run[2] for run in one),
                'least': mesh['min_scaled_jacobian'], 'mean': mesh['mean_scaled_jacobian']}


COLUMNS = (('ended', '%(status)s'), ('untangling', '%(untangling)d'), ('steps', '%(steps)d'),
           ('factorizations', '%(factorizations)d'), ('CPU s', '%(cpu).2f'), ('2 threads', '%(two).2f'),
           ('least J', '%(least).3f'), ('mean J', '%(mean).3f'))


def main():
    parser = common.parser(__doc__)
    parser.add_argument('--before', help='another program, whose numbers come first')
    parser.add_argument('--runs', type=int, default=3)
    parser.add_argument('--flags', default='', help='of mesh optimize')
    options = parser.parse_args()
    common.require_idle(options)
    with tempfile.TemporaryDirectory() as folder:
        programs = [Runs(binary, folder, options.runs, options.flags.split())
                    for binary in (options.before, options.binary) if binary]
        table = common.Table('Meshes of volumes, mesh optimize %s' % options.flags, 'mesh', 'elements', 'degree',
                             *(name for name, _ in COLUMNS), "Elastic's CPU s")
        seconds = {}

        def add(path, elastic='-'):
            rows = [program.row(path) for program in programs]
            name = os.path.basename(path)
            seconds[name] = rows[-1]['cpu']
            cells = []
            for _, pattern in COLUMNS:
                texts = [pattern % row for row in rows]
                cells.append(texts[0] if len(set(texts)) == 1 else ' -> '.join(texts))
            table.row(name, rows[-1]['elements'], rows[-1]['degree'], *cells, elastic)

        for name in PUBLIC:
            add(str(options.shared / 'data/public/volumes' / name))
        for count, shift, seed in CUBES:
            path = os.path.join(folder, 'cube_%d_%g_seed_%d.mesh' % (count, shift, seed))
            with open(path, 'w') as file:
                file.write(cube(count, shift, seed))
            add(path)
        try:
            import gmsh  # noqa: F401
        except ImportError:
            print('\npython3-gmsh is not there: no models')
        else:
            for name in MODELS:
                for path, elastic in make_model(name, folder):
                    add(path, '%.2f' % elastic)
        print('\ntangled_o2_n8_400 takes %.1f times the CPU seconds of tangled_o2_n6_120.' %
              (seconds['tangled_o2_n8_400.msh'] / seconds['tangled_o2_n6_120.msh']))
        return 1 if any(program.faults for program in programs) else 0


if __name__ == '__main__':
    sys.exit(main())
