#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Compares VTK's evaluation of our files with the Bernstein polynomials.

    vtk_evaluation.py FILE.vtu...

Reads every file with VTK and evaluates the surface and the map of every cell at points of a lattice with
VTK's own Bezier triangle. The reference are Bernstein polynomials with the documented order of control
points (3 corners, edges 01 12 20, interior recursively). The claims must be readable as JSON, and no array
may be lost. Exits with 1 and a message at the first difference, and with 77 without VTK.
"""
import json
import sys
from math import factorial

try:
    import numpy as np
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError as error:
    print("VTK for Python is not installed:", error)
    sys.exit(77)


def multi_indices(n):
    if n < 0:
        return []
    if n == 0:
        return [(0, 0, 0)]
    edges = [(n - s, s, 0) for s in range(1, n)]
    edges += [(0, n - s, s) for s in range(1, n)]
    edges += [(s, 0, n - s) for s in range(1, n)]
    inner = [(i + 1, j + 1, k + 1) for i, j, k in multi_indices(n - 3)]
    return [(n, 0, 0), (0, n, 0), (0, 0, n)] + edges + inner


def bernstein(n, barycentric):
    return np.array([factorial(n) / np.prod([factorial(i) for i in index]) *
                     np.prod([x**i for x, i in zip(barycentric, index)])
                     for index in multi_indices(n)])


def check(path):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    grid = reader.GetOutput()
    assert grid.GetNumberOfCells() > 0, "no cells"
    points = vtk_to_numpy(grid.GetPoints().GetData())
    uv = vtk_to_numpy(grid.GetPointData().GetArray("uv"))
    assert uv.shape == (len(points), 2), "uv has shape %s" % (uv.shape,)
    for name in ("distortion", "min_det", "input_face"):
        assert grid.GetCellData().GetArray(name) is not None, name + " is missing"
    assert grid.GetPointData().GetArray("input_vertex") is not None, "input_vertex is missing"
    claims = bytes(vtk_to_numpy(grid.GetFieldData().GetArray("majorant_claims"))).decode()
    assert isinstance(json.loads(claims), dict), "claims are no JSON object"

    # The map as a surface of its own: VTK then evaluates it like any other.
    plane = vtk.vtkUnstructuredGrid()
    plane.DeepCopy(grid)
    flat = vtk.vtkPoints()
    flat.SetDataTypeToDouble()
    for u, v in uv:
        flat.InsertNextPoint(u, v, 0.0)
    plane.SetPoints(flat)

    worst = 0.0
    for c in range(grid.GetNumberOfCells()):
        for mesh, control in ((grid, points), (plane, np.column_stack([uv, np.zeros(len(uv))]))):
            cell = mesh.GetCell(c)
            ids = [cell.GetPointId(k) for k in range(cell.GetNumberOfPoints())]
            n = next(d for d in range(1, 33) if (d + 1) * (d + 2) // 2 == len(ids))
            assert cell.GetCellType() == (5 if n == 1 else 76), "cell type"
            for a in range(6):
                for b in range(6 - a):
                    r, s = a / 5, b / 5
                    sub_id, x, weights = vtk.reference(0), [0.0] * 3, [0.0] * len(ids)
                    cell.EvaluateLocation(sub_id, [r, s, 0.0], x, weights)
                    ours = bernstein(n, (1 - r - s, r, s)) @ control[ids]
                    worst = max(worst, np.abs(ours - x).max())
    assert worst <= 1e-12, "VTK and Bernstein differ by %g" % worst
    print("%s: degree %d, %d cells, largest difference %.2g"
          % (path, n, grid.GetNumberOfCells(), worst))


for name in sys.argv[1:]:
    try:
        check(name)
    except AssertionError as error:
        print("%s: %s" % (name, error))
        sys.exit(1)
if len(sys.argv) < 2:
    print(__doc__)
    sys.exit(2)
