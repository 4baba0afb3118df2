#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Views of results in notebook cells."""
import base64
import io
import json
import re
import xml.etree.ElementTree

import helpers
import numpy as np
import pytest

import majorant


def pixels(html):
    """Returns the pictures of a cell."""
    image = pytest.importorskip('PIL.Image')
    data = re.findall(r'src="data:image/png;base64,([^"]*)"', html)
    return [np.asarray(image.open(io.BytesIO(base64.b64decode(one)))) for one in data]


def parsed(html):
    """Returns the cell as elements, and tests that it is well-formed and not wider than a cell."""
    assert 'max-width:40em' in html
    return xml.etree.ElementTree.fromstring(f'<html>{html}</html>')


def test_a_small_map_is_a_drawing():
    r = majorant.parametrize(*helpers.grid(6), degree=2)
    cell = parsed(r._repr_html_())
    assert cell.find('p').text == repr(r)
    assert cell.find('.//{http://www.w3.org/2000/svg}path') is not None


def test_a_large_map_is_a_picture_of_its_charts():
    r = majorant.unwrap(*helpers.torus(110))
    assert len(r.cells) > 20000
    html = r._repr_html_()
    parsed(html)
    image, = pixels(html)
    assert len(html) < 200_000 and image.shape == (480, 480, 3)
    assert (image != 255).any(2).mean() > 0.4
    assert len(np.unique(image.reshape(-1, 3), axis=0)) == r.charts.max() + 2  # the colours of charts, and the background


def test_quads_are_seen_from_one_side():
    quads = majorant.quad_mesh(*helpers.torus(16), count=200)
    image, = pixels(quads._repr_html_())
    parsed(quads._repr_html_())
    shown = (image != 255).any(2)
    assert 0.2 < shown.mean() < 0.95
    assert 0.02 < (image.astype(int).sum(2) < 200)[shown].mean() < 0.5  # edges


@pytest.mark.parametrize('kind, cells, points', [
    ('tetrahedra', [[0, 1, 2, 3], [4, 5, 6, 7]], 8), ('hexahedra', [range(8), range(8, 16)], 16),
    ('wedges', [range(6), range(6, 12)], 12), ('triangles', [[0, 1, 2], [1, 2, 3]], 4)])
def test_volumes_are_cut_open(kind, cells, points):
    X = np.random.default_rng(1).normal(size=(points, 3))
    X[points // 2:, 0] += 10
    mesh = majorant.VolumeMesh(X if kind != 'triangles' else X[:, :2], {kind: np.array([list(c) for c in cells])})
    sides, = mesh._sides_behind()
    if kind != 'triangles':
        assert set(sides.ravel()) == set(range(points // 2))  # the nearer half is not shown
        assert len(sides) == {'tetrahedra': 4, 'hexahedra': 6, 'wedges': 5}[kind]
    else:
        assert len(sides) == 2
    image, = pixels(mesh._repr_html_())
    assert (image != 255).any(2).mean() > 0.02


def test_sides_between_two_cells_are_not_shown():
    X = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, 0, 0], [9, 0, 0], [9, 1, 0], [9, 0, 1], [8, 0, 0],
         [9, 1, 1], [8, 1, 1], [9, 3, 3]]
    T = [[0, 1, 2, 3], [0, 2, 4, 3], [5, 6, 7, 8], [9, 6, 7, 11]]
    sides, = majorant.VolumeMesh(X, {'tetrahedra': T})._sides_behind()
    shown = {frozenset(side) for side in sides.tolist()}
    assert len(sides) == 6 and {0, 2, 3} not in shown


def test_verdicts_are_tables():
    V, F = helpers.grid(4)
    verdict = majorant.check(majorant.unwrap(V, F), V, F, certify=True)
    rows = parsed(verdict._repr_html_()).findall('.//tr')
    assert len(rows) == 1 + len(verdict.proofs) > 1
    assert [cell.text for cell in rows[1]][:2] == [next(iter(verdict.proofs)), next(iter(verdict.proofs.values()))['answer']]
    plain = majorant.check(majorant.unwrap(V, F))
    assert parsed(plain._repr_html_()).find('p').text == repr(plain)



# ---- textures -------------------------------------------------------------------------------------
def test_a_texture_is_seen_where_it_was_painted(tmp_path):
    """The middle of each face has the colour of its texel, in a file that an independent reader reads."""
    image = pytest.importorskip('PIL.Image')
    r = majorant.unwrap(*helpers.octahedron())
    painted = np.random.default_rng(2).integers(0, 256, (64, 32, 4), dtype=np.uint8)
    r.save(tmp_path / 'a.glb', texture=painted)
    assert [path.name for path in tmp_path.iterdir()] == ['a.glb']
    assert majorant.check(tmp_path / 'a.glb', certify=True)
    data = (tmp_path / 'a.glb').read_bytes()
    assert int.from_bytes(data[8:12], 'little') == len(data)
    size = int.from_bytes(data[12:16], 'little')
    content, binary = json.loads(data[20:20 + size]), data[28 + size:]
    assert len(binary) == content['buffers'][0]['byteLength'] == int.from_bytes(data[20 + size:24 + size], 'little')

    def view(number):
        one = content['bufferViews'][number]
        return binary[one['byteOffset']:one['byteOffset'] + one['byteLength']]
    seen = np.asarray(image.open(io.BytesIO(view(content['images'][0]['bufferView']))))
    primitive = content['meshes'][0]['primitives'][0]
    uv = np.frombuffer(view(content['accessors'][primitive['attributes']['TEXCOORD_0']]['bufferView']), np.float32).reshape(-1, 2)
    corners = np.frombuffer(view(content['accessors'][primitive['indices']]['bufferView']), np.uint16).reshape(-1, 3)
    u, v = uv[corners].mean(1).T  # in glTF v runs from the top
    theirs = seen[(v * 64).astype(int), (u * 32).astype(int)]
    u, v = r.corner_uv.mean(1).T
    assert (theirs == painted[(v * 64).astype(int), (u * 32).astype(int)]).all()
    for texture, name, word in [(painted[..., :2], 'a.glb', '3 or 4'), (painted / 255, 'a.glb', 'uint8'),
                                (painted, 'a.obj', 'into .glb'), (painted, 'nowhere/a.glb', 'No such')]:
        with pytest.raises(majorant.UsageError, match=word):
            r.save(tmp_path / name, texture=texture)


# ---- plots ----------------------------------------------------------------------------------------
def test_plots_take_the_names_of_measures():
    pytest.importorskip('matplotlib').use('Agg')
    import matplotlib.pyplot as plt
    r = majorant.unwrap(*helpers.torus(8))
    sigma = np.linalg.svd(r.jacobian(np.arange(len(r.cells)), [1 / 3, 1 / 3, 1 / 3]), compute_uv=False)
    sigma = sigma / r.report['result']['layout_scale']
    for name, numbers in [('area', sigma.prod(1)), ('angle', sigma[:, 0] / sigma[:, 1]), ('sigma-max', sigma[:, 0]),
                          ('sigma-min', sigma[:, 1]), ('density', r.distortion)]:
        faces = r.plot(plt.figure().gca(), name).collections[0]
        assert np.allclose(faces.get_array(), numbers, rtol=1e-6), name
        assert faces.get_cmap().name == 'majorant'
    norm = r.plot(plt.figure().gca(), 'area').collections[0].norm
    assert norm(1) == pytest.approx(0.5) and norm(norm.vmin) == 0 and norm(norm.vmax) == 1
    assert norm(2) - 0.5 == pytest.approx(0.5 - norm(0.5))
    assert r.plot(plt.figure().gca(), 'area', vmin=0.5, vmax=2).collections[0].get_clim() == (0.5, 2)
    assert r.plot(plt.figure().gca(), 'charts').collections[0].get_array() is None
    with pytest.raises(majorant.UsageError, match="values='heat' is none of"):
        r.plot(plt.figure().gca(), 'heat')
    plt.close('all')


if __name__ == '__main__':
    helpers.main(__file__)
