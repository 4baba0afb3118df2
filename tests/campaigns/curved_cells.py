#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Compares the bounds of `majorant mesh check` on random curved cells with the values of gmsh, VTK and MFEM.

Cells are of every type and degree of tests/data/node_positions.txt that has two dimensions or three: .msh and
Medit's .mesh, .vtu (quadratic, Lagrange, Bezier), MFEM's collections. Nodes are those of the straight cell,
moved at random by up to 0.7 of their distance, under a random affine map, so that many cells are not valid.

gmsh reads .msh and .mesh, and evaluates det J at 2,000 points of each cell (getJacobians). It does not
evaluate prisms of degrees 3 and 4 and Medit's prisms; their node positions come from the table. VTK reads
.vtu and evaluates the positions of lattice points (EvaluateLocation), which determine the cell's polynomial.
MFEM is not in Debian: for its files the polynomial interpolates the table's node positions, or has the
table's control points, which are from MFEM. numpy samples det J of the polynomial on a lattice of 16 steps,
with refinement around its least and largest values.

A cell is wrong if a sample is below the lower bound of the least det J that is reported, or above the upper
bound of the largest one; if the search ends above the upper bound of the least one, or below the lower bound
of the largest; if a valid cell has det J <= 0 somewhere, or an invalid one has it nowhere. Prints a Markdown
table; exit code 0 exactly if no cell is wrong. Needs python3-gmsh and python3-vtk9.

Sample runs:
  tests/campaigns/curved_cells.py --count 2000
  tests/campaigns/curved_cells.py --count 2000 --seed 7 --keep findings
"""
import argparse
import collections
import json
import math
import shutil
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.append(str(Path(__file__).resolve().parents[2] / 'bench'))
import common  # noqa: E402

TABLE = common.ROOT / 'tests/data/node_positions.txt'
STEPS = 16                                        # steps of the lattice of samples along an edge
ZOOMS = 14                                        # halvings of the search
GMSH_POINTS = 2000
ROUNDING = 1e-9                                   # relative to the largest det J of a cell
SHARES = {'msh': 0.35, 'mesh': 0.05, 'vtu': 0.35, 'mfem': 0.25}   # fractions of the cells; mesh: Medit's
MEDIT_TYPES = {'TrianglesP2': 9, 'TetrahedraP2': 11, 'Quadrilaterals': 3, 'Hexahedra': 5}
# Number of leading coordinates whose sum is at most 1.
SIMPLEX = {'triangle': 2, 'tetrahedron': 3, 'wedge': 2, 'quad': 0, 'hexahedron': 0}

Row = collections.namedtuple('Row', 'format name shape degree places')


def rows_of_table():
    """Returns the rows of cells in two or three dimensions with variable det J, and the shapes of MFEM's meshes."""
    rows, shapes = [], {}
    for line in TABLE.read_text().splitlines():
        words = line.split()
        if not words or words[0] == '#':
            continue
        if words[0] == 'shape':
            shapes[words[1]] = words[2:]
        if words[0] == 'shape' or words[2] not in SIMPLEX:
            continue
        degree = int(words[3])
        if degree == 1 and words[2] in ('triangle', 'tetrahedron'):
            continue
        places = np.array([[int(d) for d in word] for word in words[4:]])
        for name in words[1].split(','):
            rows.append(Row(words[0], name, words[2], degree, places))
    return rows, shapes


# ------------------------------------------------------------------ polynomials
def lattice(shape, degree):
    """Returns the exponents of a full cell, which are also the points of a lattice."""
    dim = 2 if shape in ('triangle', 'quad') else 3
    grid = np.stack(np.meshgrid(*[np.arange(degree + 1)] * dim, indexing='ij'), -1).reshape(-1, dim)
    return grid[grid[:, :SIMPLEX[shape]].sum(1) <= degree]


def powers(points, exponents):
    return np.prod(points[:, None, :] ** exponents[None, :, :], axis=2)


class Polynomial:
    """A map of the reference cell: coefficients of monomials."""

    def __init__(self, shape, degree, points, values):
        self.exponents = lattice(shape, degree)
        self.coefficients = np.linalg.lstsq(powers(points, self.exponents), values, rcond=None)[0]

    def at(self, points):
        return powers(points, self.exponents) @ self.coefficients

    def det(self, points):
        dim = points.shape[1]
        columns = []
        for c in range(dim):
            lower = self.exponents.copy()
            lower[:, c] = np.maximum(lower[:, c] - 1, 0)
            columns.append((self.exponents[:, c] * powers(points, lower)) @ self.coefficients[:, :dim])
        return np.linalg.det(np.stack(columns, -1))


def clipped(points, shape):
    """Clips points to the reference cell."""
    points = np.clip(points, 0, 1)
    k = SIMPLEX[shape]
    if k:
        sums = points[:, :k].sum(1)
        points[:, :k] /= np.maximum(sums, 1)[:, None]
    return points


def least(det, shape, samples, values):
    """Returns the least value in a search that starts at the ten best samples."""
    dim = samples.shape[1]
    offsets = np.stack(np.meshgrid(*[np.linspace(-1, 1, 5)] * dim, indexing='ij'), -1).reshape(-1, dim)
    starts, best = samples[np.argsort(values)[:10]].copy(), values.min()
    for zoom in range(ZOOMS):
        tries = clipped((starts[:, None, :] + offsets / STEPS * 0.6 ** zoom).reshape(-1, dim), shape)
        found = det(tries)
        best = min(best, found.min())
        nearest = found.reshape(len(starts), -1).argmin(1)
        starts = tries.reshape(len(starts), -1, dim)[np.arange(len(starts)), nearest]
    return best


# ------------------------------------------------------------------ reference places
def gauss_lobatto(places, degree, shape):
    """Returns MFEM's node positions for degrees 3 and 4: those of a segment, scaled on simplices to a sum of
    1."""
    first = {3: 0.5 - math.sqrt(0.05), 4: 0.5 - math.sqrt(3 / 28)}.get(degree)
    nodes = {3: [0, first, 1 - (first or 0), 1], 4: [0, first, 0.5, 1 - (first or 0), 1]}.get(
        degree, np.arange(degree + 1) / degree)
    at = np.array(nodes)[places].astype(float)
    k = SIMPLEX[shape]
    if k:
        rest = np.array(nodes)[degree - places[:, :k].sum(1)]
        at[:, :k] /= (rest + at[:, :k].sum(1))[:, None]
    return at


def bernstein(places, degree, shape, points):
    """Returns the values at points of the Bernstein polynomials that belong to the places."""
    def segment(i, t):
        return math.comb(degree, i) * t ** i * (1 - t) ** (degree - i)
    columns = []
    for place in places:
        value, k = np.ones(len(points)), SIMPLEX[shape]
        if k:
            rest = degree - place[:k].sum()
            value = value * (math.factorial(degree) / math.factorial(rest)) * np.maximum(
                1 - points[:, :k].sum(1), 0) ** rest
            for c in range(k):
                value = value * points[:, c] ** place[c] / math.factorial(place[c])
        for c in range(k, len(place)):
            value = value * segment(place[c], points[:, c])
        columns.append(value)
    return np.stack(columns, -1)


# ------------------------------------------------------------------ cells and files
def random_cells(random, row, count, gap):
    """Returns the nodes of random cells, side by side: the reference positions, moved, under an affine map."""
    dim = row.places.shape[1]
    out = []
    for k in range(count):
        moved = row.places / row.degree + random.uniform(-1, 1, row.places.shape) * random.choice(
            [0.05, 0.15, 0.3, 0.45, 0.7]) / row.degree
        matrix = np.eye(dim) + random.uniform(-0.3, 0.3, (dim, dim))
        nodes = moved @ matrix.T
        nodes[:, 0] += gap * k
        out.append(np.concatenate([nodes, np.zeros((len(nodes), 3 - dim))], 1))
    return out


def text(points, dim=3):
    return '\n'.join(' '.join('%.17g' % x for x in p[:dim]) for p in points)


def numbers(cells, base):
    n = len(cells[0])
    return [' '.join(str(k * n + i + base) for i in range(n)) for k in range(len(cells))]


def msh_file(row, cells):
    points = np.concatenate(cells)
    nodes = '\n'.join('%d %s' % (k + 1, line) for k, line in enumerate(text(points).split('\n')))
    elements = '\n'.join('%d %s 2 1 1 %s' % (k + 1, row.name, line) for k, line in enumerate(numbers(cells, 1)))
    return '$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n%d\n%s\n$EndNodes\n$Elements\n%d\n%s\n$EndElements\n' % (
        len(points), nodes, len(cells), elements)


def medit_file(row, cells):
    points = np.concatenate(cells)
    return 'MeshVersionFormatted 2\nDimension\n3\nVertices\n%d\n%s\n%s\n%d\n%s\nEnd\n' % (
        len(points), '\n'.join(line + ' 0' for line in text(points).split('\n')), row.name, len(cells),
        '\n'.join(line + ' 1' for line in numbers(cells, 1)))


def vtu_file(row, cells):
    points, n = np.concatenate(cells), len(cells[0])
    array = lambda kind, name, words, more='': '<DataArray type="%s" Name="%s" %sformat="ascii">\n%s\n</DataArray>\n' % (
        kind, name, more, words)
    return ('<VTKFile type="UnstructuredGrid" version="2.2" byte_order="LittleEndian">\n<UnstructuredGrid>\n'
            '<Piece NumberOfPoints="%d" NumberOfCells="%d">\n<Points>\n%s</Points>\n<Cells>\n%s%s%s</Cells>\n</Piece>\n'
            '</UnstructuredGrid>\n</VTKFile>\n' % (
                len(points), len(cells), array('Float64', 'Points', text(points), 'NumberOfComponents="3" '),
                array('Int64', 'connectivity', '\n'.join(numbers(cells, 0))),
                array('Int64', 'offsets', ' '.join(str((k + 1) * n) for k in range(len(cells)))),
                array('UInt8', 'types', ' '.join([row.name] * len(cells)))))


def mfem_file(row, cells, shapes):
    """Returns a file with one cell."""
    dim, words = int(shapes[row.shape][0]), shapes[row.shape][1:]
    element = next(w for w in words if ':' in w).replace(':', ' ').replace(',', ' ')
    vertices = sum(':' not in w for w in words)
    return ('MFEM mesh v1.0\n\ndimension\n%d\n\nelements\n1\n1 %s\n\nboundary\n0\n\nvertices\n%d\n\nnodes\n'
            'FiniteElementSpace\nFiniteElementCollection: %s\nVDim: %d\nOrdering: 1\n\n%s\n' % (
                dim, element, vertices, row.name, dim, text(cells[0], dim)))


# ------------------------------------------------------------------ other programs
def by_gmsh(row, path, samples):
    """Returns (polynomials, det J at many points) of each cell, from gmsh."""
    import gmsh
    # gmsh says "FaceClosureFull not implemented for prisms of order 3", and skips sections Prisms.
    if row.name == 'Prisms' or (row.shape == 'wedge' and row.degree > 2):
        return None
    kind = int(row.name) if row.format == 'msh' else MEDIT_TYPES[row.name]
    gmsh.clear()
    gmsh.open(str(path))
    ends = {'quad': 2, 'hexahedron': 3, 'wedge': 1}.get(row.shape, 0)   # gmsh's coordinates are in [-1, 1]
    def at_gmsh(points):
        own = np.zeros((len(points), 3))
        own[:, :points.shape[1]] = points
        if ends:
            columns = slice(points.shape[1] - ends, points.shape[1])
            own[:, columns] = 2 * own[:, columns] - 1
        _, det, places = gmsh.model.mesh.getJacobians(kind, own.ravel())
        return det.reshape(-1, len(points)) * 2.0 ** ends, places.reshape(-1, len(points), 3)
    grid = lattice(row.shape, row.degree) / row.degree
    _, places = at_gmsh(grid)
    det, _ = at_gmsh(samples)
    return [Polynomial(row.shape, row.degree, grid, p) for p in places], det


def by_vtk(row, path, samples):
    import vtk
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    output, grid, found = reader.GetOutput(), lattice(row.shape, row.degree) / row.degree, []
    for k in range(output.GetNumberOfCells()):
        cell = output.GetCell(k)
        weights = [0.0] * cell.GetNumberOfPoints()
        places = []
        for point in grid:
            own, x = [0.0] * 3, [0.0] * 3
            own[:len(point)] = point
            cell.EvaluateLocation(vtk.reference(0), own, x, weights)
            places.append(x)
        found.append(Polynomial(row.shape, row.degree, grid, np.array(places)))
    return found, np.array([p.det(samples) for p in found])


def by_table(row, cells, samples):
    """Returns the polynomials by the table's node positions: on a lattice, MFEM's at Gauss-Lobatto points, or
    control points."""
    found = []
    for nodes in cells:
        grid = lattice(row.shape, row.degree) / row.degree
        if 'Pos' in row.name or row.name.startswith('L2_T2') or '@P' in row.name:
            values = bernstein(row.places, row.degree, row.shape, grid) @ nodes
            found.append(Polynomial(row.shape, row.degree, grid, values))
            continue
        uniform = row.format != 'mfem' or row.name in ('Linear', 'Quadratic', 'Cubic') or '@U' in row.name \
            or row.name.startswith('L2_T4')
        at = row.places / row.degree if uniform else gauss_lobatto(row.places, row.degree, row.shape)
        found.append(Polynomial(row.shape, row.degree, at, nodes))
    return found, np.array([p.det(samples) for p in found])


# ------------------------------------------------------------------ judging
def judge(polynomial, det, reported, shape):
    """Returns the defects of a cell's bounds as text."""
    scale, samples = ROUNDING * np.abs(det).max(), lattice(shape, STEPS) / STEPS
    low = min(det.min(), least(polynomial.det, shape, samples, polynomial.det(samples)))
    high = max(det.max(), -least(lambda p: -polynomial.det(p), shape, samples, -polynomial.det(samples)))
    (a, b), (c, d) = reported['min_det'], reported['max_det']
    bad = []
    if low < a - scale:
        bad.append('det J is %.12g, below the bound %.12g' % (low, a))
    if high > d + scale:
        bad.append('det J is %.12g, above the bound %.12g' % (high, d))
    if low > b + scale:
        bad.append('the least det J found is %.12g, the bound is %.12g' % (low, b))
    if high < c - scale:
        bad.append('the largest det J found is %.12g, the bound is %.12g' % (high, c))
    if reported['verdict'] == 'valid' and low <= -scale:
        bad.append('valid, with det J = %.12g' % low)
    if reported['verdict'] == 'invalid' and low > scale:
        bad.append('invalid, with det J at least %.12g' % low)
    return bad


def one_file(options, random, row, shapes, folder):
    """Returns (number of cells, number of valid ones, defects)."""
    count = 1 if row.format == 'mfem' else options.cells
    cells = random_cells(random, row, count, 5)
    maker = {'msh': msh_file, 'mesh': medit_file, 'vtu': vtu_file}.get(row.format)
    path = folder / ('cells.' + {'msh': 'msh', 'vtu': 'vtu'}.get(row.format, 'mesh'))
    path.write_text(maker(row, cells) if maker else mfem_file(row, cells, shapes))
    done = common.run([options.binary, 'mesh', 'check', path, '--list', 10 * count, '--report', folder / 'r.json'],
                      options.timeout)
    if done.code not in (0, 5):
        return count, 0, ['exit %s: %s' % (done.code, done.stderr.strip()[:200])]
    reported = json.loads((folder / 'r.json').read_text())['result']['mesh']['worst']
    if len(reported) != count:
        return count, 0, ['%d cells listed, %d written' % (len(reported), count)]
    reported.sort(key=lambda entry: entry['element'])
    samples = lattice(row.shape, STEPS) / STEPS
    if len(samples) > GMSH_POINTS:
        samples = samples[random.permutation(len(samples))[:GMSH_POINTS]]
    evaluate = {'msh': by_gmsh, 'mesh': by_gmsh, 'vtu': by_vtk}.get(row.format)
    polynomials, dets = (evaluate and evaluate(row, path, samples)) or by_table(row, cells, samples)
    bad = []
    for k in range(count):
        for text_ in judge(polynomials[k], dets[k], reported[k], row.shape):
            bad.append('cell %d: %s' % (k, text_))
    return count, sum(entry['verdict'] == 'valid' for entry in reported), bad


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--binary', type=Path, default=common.DEFAULT_BINARY, help='the majorant program')
    parser.add_argument('--timeout', type=float, default=120, help='seconds a run may take')
    parser.add_argument('--count', type=int, default=2000, help='least number of cells')
    parser.add_argument('--cells', type=int, default=20, help='cells per file')
    parser.add_argument('--formats', nargs='+', choices=list(SHARES), default=list(SHARES))
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--keep', type=Path, help='folder for the files with wrong cells')
    options = parser.parse_args()
    options.binary = options.binary.resolve()
    import gmsh
    gmsh.initialize()
    gmsh.option.setNumber('General.Verbosity', 1)
    table, shapes = rows_of_table()
    found, done, round_number = collections.defaultdict(collections.Counter), 0, 0
    for kind in options.formats:
        share = SHARES[kind]
        mine, round_number = [row for row in table if row.format == kind], 0
        while found_count(found, kind) < share * options.count:
            for row in mine:
                random = np.random.default_rng([options.seed, round_number, mine.index(row)])
                with tempfile.TemporaryDirectory(prefix='majorant_cells_') as name:
                    cells, valid, bad = one_file(options, random, row, shapes, Path(name))
                    for text_ in bad:
                        print('%s %s (%s of degree %d), round %d: %s' % (
                            kind, row.name, row.shape, row.degree, round_number, text_), flush=True)
                    if bad and options.keep:
                        place = '%s_%s_%d' % (kind, row.name, round_number)
                        shutil.copytree(name, options.keep / place, dirs_exist_ok=True)
                key = kind, row.shape
                found[key].update(cells=cells, valid=valid, wrong=len({t.split(':')[0] for t in bad}))
            round_number += 1
    print('| file | evaluated by | cell | cells | valid | wrong |\n|---|---|---|---|---|---|')
    judges = {'msh': 'gmsh', 'mesh': 'gmsh', 'vtu': 'VTK', 'mfem': 'table of MFEM'}
    names = {'msh': '.msh', 'mesh': '.mesh (Medit)', 'vtu': '.vtu', 'mfem': '.mesh (MFEM)'}
    for (kind, shape), n in sorted(found.items()):
        print('| %s | %s | %s | %d | %d | %d |' % (names[kind], judges[kind], shape, n['cells'], n['valid'], n['wrong']))
    total = sum(found.values(), collections.Counter())
    print('| all | | | %d | %d | %d |' % (total['cells'], total['valid'], total['wrong']))
    return 1 if total['wrong'] else 0


def found_count(found, kind):
    return sum(n['cells'] for (k, _), n in found.items() if k == kind)


if __name__ == '__main__':
    sys.exit(main())
