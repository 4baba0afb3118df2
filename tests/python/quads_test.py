#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Quad meshes as arrays, their reports and files."""
import json
import subprocess
import sys

import helpers
import numpy as np
import pytest

import majorant

sys.path.insert(0, str(helpers.SOURCE / 'tests' / 'checker'))
from quad_judge import judge, read_obj  # noqa: E402


def block(n):
    """Returns a cube of n^2 squares per side, each of two triangles."""
    number, faces = {}, []

    def vertex(p):
        return number.setdefault(tuple(p), len(number))
    for axis in range(3):
        for side in (0, n):
            for i in range(n):
                for j in range(n):
                    corners = []
                    for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
                        p = [0, 0, 0]
                        p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3] = side, i + a, j + b
                        corners.append(vertex(p))
                    a, b, c, d = corners if side else corners[::-1]
                    faces += [(a, b, c), (a, c, d)]
    return np.array(list(number), float), np.array(faces)


def test_a_cube_keeps_its_edges(tmp_path):
    V, F = block(4)
    quads = majorant.quad_mesh(V, F, count=600)
    assert quads.V.shape[1:] == (3,) and quads.Q.shape[1:] == (4,)
    assert repr(quads) == f'<majorant.QuadMesh: {len(quads.Q)} quads, 8 irregular vertices>'
    assert abs(len(quads.Q) - 600) <= 30 and quads.Q.max() == len(quads.V) - 1
    assert quads.status == 'converged' and quads.report['result']['quads']['count'] == len(quads.Q)
    assert quads.report['result']['quads']['features'] == {'requested': 12, 'covered': 12, 'relaxed': 0}
    assert judge((quads.V.tolist(), quads.Q.tolist()), (V.tolist(), F.tolist()), 35) == set()
    for name in ('q.obj', 'q.ply'):
        quads.save(tmp_path / name)
    positions, faces = read_obj(tmp_path / 'q.obj')
    assert (np.array(positions) == quads.V).all() and (np.array(faces) == quads.Q).all()
    with pytest.raises(majorant.UsageError):
        quads.save(tmp_path / 'q.png')


def test_features():
    V, F = block(4)
    plain = majorant.quad_mesh(V, F, count=200, features='none').report
    assert plain['result']['quads']['features'] == {'requested': 0, 'covered': 0, 'relaxed': 0}
    corners = [v for v, p in enumerate(V) if set(p) <= {0, 4}]
    edge = [v for v in np.argsort(V[:, 0]) if V[v, 1] == 0 and V[v, 2] == 0]
    pairs = list(zip(edge, edge[1:]))
    one = majorant.quad_mesh(V, F, count=200, features=pairs)
    assert one.report['result']['quads']['features'] == {'requested': 1, 'covered': 1, 'relaxed': 0}
    with pytest.raises(majorant.UsageError, match='no edge'):
        majorant.quad_mesh(V, F, features=[(corners[0], corners[1])])
    for wrong in ('all', 0, 181, True, [(0, 1, 2)]):
        with pytest.raises(majorant.UsageError, match='features'):
            majorant.quad_mesh(V, F, features=wrong)
    with pytest.raises(majorant.UsageError, match='edge_length'):
        majorant.quad_mesh(V, F, count=100, edge_length=1.0)


def test_the_command_makes_the_same(tmp_path):
    V, F = block(4)
    with open(tmp_path / 'in.obj', 'w') as file:
        file.writelines('v %r %r %r\n' % tuple(map(float, p)) for p in V)
        file.writelines('f %d %d %d\n' % tuple(v + 1 for v in face) for face in F)
    subprocess.run([helpers.BINARY, 'quads', tmp_path / 'in.obj', '-o', tmp_path / 'c.obj', '--count', '300', '--report',
                    tmp_path / 'c.json', '--quiet'], check=True)
    quads = majorant.quad_mesh(V, F, count=300)
    quads.save(tmp_path / 'p.obj')
    assert (tmp_path / 'p.obj').read_bytes() == (tmp_path / 'c.obj').read_bytes()
    report = json.loads((tmp_path / 'c.json').read_text())
    assert set(quads.report) == set(report)
    assert quads.report['result']['quads'] == report['result']['quads']


if __name__ == '__main__':
    helpers.main(__file__)
