#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Invalid arguments, each with its message."""
import helpers
import numpy as np
import pytest

import majorant

V, F = helpers.grid(2)
NAN, FAR = V.copy(), F.copy()
NAN[4, 1] = np.nan
FAR[3, 2] = 9


def flat(v=V, f=F, **options):
    return majorant.flatten(v, f, **options)


def with_vertex(value):
    out = V.copy()
    out[2, 0] = value
    return out


WRONG = [
    # V
    (lambda: flat(V[:, :1]), 'V has shape (9, 1), not (n, 3)'),
    (lambda: flat(V.ravel()), 'V has shape (27,), not (n, 3)'),
    (lambda: flat(V[None]), 'V has shape (1, 9, 3), not (n, 3)'),
    (lambda: flat(np.zeros((9, 4))), 'V has shape (9, 4), not (n, 3)'),
    (lambda: flat(V[:0]), 'V is empty'),
    (lambda: flat(NAN), 'V[4, 1] is nan; all numbers must be finite'),
    (lambda: flat(with_vertex(np.inf)), 'V[2, 0] is inf; all numbers must be finite'),
    (lambda: flat(V.astype(complex)), 'V holds complex numbers, not numbers'),
    (lambda: flat(V.astype(str)), 'V holds text, not numbers'),
    (lambda: flat(V > 0), 'V holds truth values, not numbers'),
    (lambda: flat(V.astype(object)), 'V holds Python objects'),
    (lambda: flat([[0, 0, 0], [1, 0]]), 'V is no array: its rows have different lengths'),
    (lambda: flat(None), 'V holds Python objects'),
    # F
    (lambda: flat(f=F.astype(float)), 'F holds floating-point numbers, not integers'),
    (lambda: flat(f=F > 0), 'F holds truth values, not integers'),
    (lambda: flat(f=F.ravel()), 'F has shape (24,), not (n, 3)'),
    (lambda: flat(f=F[:, :2]), 'F has shape (8, 2): faces need at least three corners'),
    (lambda: flat(f=F[:0]), 'F is empty'),
    (lambda: flat(f=FAR), 'F[3, 2] is 9, but there are 9 vertices, from 0'),
    (lambda: flat(f=F - 1), 'F[0, 0] is -1, but there are 9 vertices, from 0'),
    (lambda: flat(f=F.astype(np.int64) + 2**33), 'but there are 9 vertices, from 0'),
    (lambda: flat(f=[[0, 1, 4], [0, 4]]), 'F[1] has 2 corners: faces need at least three'),
    (lambda: flat(f=[[0, 1, 4], [0, 4, 3, 9]]), 'F[1][3] is 9, but there are 9 vertices, from 0'),
    (lambda: flat(f=F.astype(str)), 'F holds text, not integers'),
    # uv
    (lambda: flat(uv=V), 'uv has shape (9, 3), not (9, 2)'),
    (lambda: flat(uv=V[:4, :2]), 'uv has shape (4, 2), not (9, 2)'),
    (lambda: flat(uv=NAN[:, :2]), 'uv[4, 1] is nan'),
    (lambda: flat(uv=np.zeros((7, 3, 2))), 'uv has shape (7, 3, 2), not (8, 3, 2)'),
    (lambda: flat(uv=V[:, :2]), "uv is for init='input' or seamless=True; say one of them"),
    (lambda: flat(uv=V[:, :2], init='tutte'), "uv is for init='input' or seamless=True"),
    (lambda: majorant.parametrize(V, F, uv=V[:, :2], seamless=True, init='tutte'), "leave out init='tutte'"),
    (lambda: majorant.unwrap(V, F, uv=V[:, :2]), "uv is for seams='uv' and keep_seams"),
    (lambda: majorant.unwrap(V, F, keep_seams=True), 'keep_seams cuts along the seams of uv'),
    (lambda: majorant.unwrap(V, F, weld='now'), "weld='now' is no number"),
    # arguments without effect
    (lambda: flat(soft=3.0), 'soft is the weight of handles; give handles'),
    (lambda: majorant.unwrap(V, F, pack=False, padding=3), 'padding and resolution are for packing'),
    (lambda: majorant.unwrap(V, F, pack=False, resolution=256), 'padding and resolution are for packing'),
    (lambda: majorant.unwrap(V, F, fill=0.5, charts=3), 'fill and charts both say how far'),
    (lambda: majorant.unwrap(V, F, seams=[[0, 1]], max_stretch=2), "max_stretch is of seams 'auto' and 'sharp'"),
    (lambda: majorant.seamless(V, F, cones={0: 3}, curvature_alignment=5), 'leave out cones or it'),
    # points
    (lambda: flat(pins=[3]), 'pins is no dictionary {vertex: (u, v)}'),
    (lambda: flat(pins={9: (0, 0)}), 'pins[0] is 9, but there are 9 vertices, from 0'),
    (lambda: flat(pins={'a': (0, 0)}), 'pins holds text, not integers'),
    (lambda: flat(pins={3: (0, 0, 0)}), 'pins[3] has shape (3,), not (2,)'),
    (lambda: flat(pins={3: (0, np.inf)}), 'pins[3][1] is inf'),
    (lambda: flat(handles={3: 'here'}), 'handles[3] holds text, not numbers'),
    (lambda: flat(weights=np.ones(7)), 'weights has shape (7,), not (8,)'),
    (lambda: flat(weights=-np.ones(8)), 'weights are no positive numbers'),
    (lambda: flat(weights=np.full(8, np.nan)), 'weights[0] is nan'),
    (lambda: flat(weights=['1'] * 8), 'weights holds text, not numbers'),
    (lambda: flat(weights=np.ones((8, 1))), 'weights has shape (8, 1), not (8,)'),
    (lambda: flat(handles={4: np.ones((1, 2))}), 'handles[4] has shape (1, 2), not (2,)'),
    (lambda: flat(handles={2.5: (0, 0)}), 'handles holds floating-point numbers, not integers'),
    (lambda: flat(uv=V[:, :2] > 0), 'uv holds truth values, not numbers'),
    # names and numbers
    (lambda: flat(energy='arp'), "no energy is called 'arp'; did you mean 'arap'?"),
    (lambda: flat(energy='-1*arap'), "weight of 'arap'='-1' is no number from 1e-30"),
    (lambda: flat(energy=3), 'energy=3 is neither a name, a Density nor a list'),
    (lambda: flat(energy=[]), 'energy is an empty list'),
    (lambda: flat(boundary='open'), "boundary='open' is none of 'free', 'fixed'"),
    (lambda: flat(init='random'), "init='random' is none of 'auto'"),
    (lambda: majorant.parametrize(V, F, degree=9), 'degree=9 is no integer from 1 to 8'),
    (lambda: majorant.parametrize(V, F, degree=2.0), 'degree=2.0 is no integer from 1 to 8'),
    (lambda: flat(tolerance=0), 'tolerance=0 is no number above 0'),
    (lambda: flat(time_limit=-1), 'time_limit=-1 is no number from 0'),
    (lambda: flat(max_iterations=-1), 'max_iterations=-1 is no integer from 0'),
    (lambda: flat(threads=-1), 'threads=-1 is no integer from 0 to 1024'),
    (lambda: flat(bijective='yes'), "bijective='yes' is neither True nor False"),
    (lambda: flat(callback=3), 'callback=3 cannot be called'),
    (lambda: flat(improve_mesh=True, weights=np.ones(8)), 'improve_mesh changes the faces'),
    (lambda: majorant.unwrap(V, F, seams=[[0, 1, 2]]), 'seams has shape (1, 3), not (n, 2)'),
    (lambda: majorant.unwrap(V, F, seams=[[0, 9]]), 'seams[0, 1] is 9'),
    (lambda: majorant.unwrap(V, F, seams='sharp=200'), "seams='200' is no number above 0 to 180"),
    (lambda: majorant.unwrap(V, F, max_stretch=1), 'max_stretch=1 is no number above 1'),
    (lambda: majorant.unwrap(V, F, fill=1), 'fill=1 is not a number of at least 0 and below 1'),
    (lambda: majorant.unwrap(V, F, normalize=True, pins={0: (0, 0)}), 'normalize moves pins'),
    (lambda: majorant.unwrap(V, F, scale='unit', pins={0: (0, 0)}), "scale='unit' moves pins"),
    (lambda: majorant.unwrap(V, F, scale='model', normalize=True), "normalize is scale='unit'"),
    (lambda: majorant.unwrap(V, F, scale='mm'), "scale='mm' is none of 'unit', 'model'"),
    (lambda: majorant.seamless(V, F, cones=[3]), 'cones is no dictionary'),
    (lambda: majorant.seamless(V, F, cones={3: 0}), 'cones[3]=0 is no integer from 1'),
]


@pytest.mark.parametrize('call, message', WRONG, ids=[message for _, message in WRONG])
def test_errors_name_the_defect(call, message):
    with pytest.raises(majorant.UsageError) as raised:
        call()
    assert message in str(raised.value)
    assert raised.value.exit_code == 1 and isinstance(raised.value, (majorant.Error, ValueError))


@pytest.mark.parametrize('name', ['a\0b.vtu', '\0.vtu', b'a\0b.vtu', 'a.vtu\0'])
def test_names_with_a_null_character(name, tmp_path, monkeypatch):
    """The system would cut these names."""
    monkeypatch.chdir(tmp_path)
    result = majorant.parametrize(V, F)
    for call in (result.save, majorant.read, majorant.read_mesh, majorant.check):
        with pytest.raises(ValueError, match='null character'):
            call(name)
    assert list(tmp_path.iterdir()) == []


MESHES = [
    ([[0, 1, 2], [1, 0, 3], [0, 1, 4]], majorant.UnsupportedError),     # an edge with three faces
    ([[0, 1, 1], [0, 1, 2]], majorant.UnsupportedError),                # a vertex twice
    ([[0, 1, 4], [0, 1, 4]], majorant.UnsupportedError),                # a face twice
    ([[0, 1, 4], [0, 3, 4]], majorant.UnsupportedError),                # orientations that disagree
    ([[0, 1, 4], [5, 8, 7]], majorant.UnsupportedError),                # two pieces
    ([[0, 1, 2]], majorant.UnsupportedError),                           # no area: on a line
]


@pytest.mark.parametrize('faces, kind', MESHES)
def test_meshes_of_other_kinds(faces, kind):
    line = np.array(V)
    line[:3, 1:] = 0
    with pytest.raises(kind) as raised:
        majorant.flatten(line, faces)
    assert raised.value.exit_code == 3 and '\n' not in str(raised.value)


@pytest.mark.parametrize('convert', [
    lambda v, f: (v.tolist(), f.tolist()), lambda v, f: (np.asfortranarray(v), np.asfortranarray(f)),
    lambda v, f: (v, f.astype(np.uint8)), lambda v, f: (v, f.astype(np.int64)),
    lambda v, f: (v[::-1][::-1], f[:, ::-1][:, ::-1]), lambda v, f: (v.astype('>f8'), f.astype('>i4')),
])
def test_any_layout_of_the_same_numbers(convert):
    assert np.array_equal(flat(*convert(V, F)), flat())


def test_classes_of_errors():
    codes = {majorant.UsageError: 1, majorant.ReadError: 2, majorant.UnsupportedError: 3,
             majorant.InfeasibleError: 3, majorant.StoppedError: 5, majorant.InvalidError: 5,
             majorant.InternalError: 6}
    assert set(codes) | {majorant.Error} == {
        getattr(majorant, name) for name in majorant.__all__ if name.endswith('Error')}
    for kind, code in codes.items():
        assert issubclass(kind, majorant.Error) and kind.exit_code == code and kind.__doc__
    with pytest.raises(majorant.InternalError, match='optional'):     # arguments of users do not cause this
        majorant._core.mesh_of_arrays(V, (F.astype(np.int32).ravel(), 3 * np.arange(9, dtype=np.int32)), V[:, :2].copy())
    with pytest.raises(majorant.InfeasibleError):     # pins that no injective map meets
        uv = flat()
        majorant.flatten(V, F, boundary='fixed', pins={4: uv[0] - 5})


if __name__ == '__main__':
    helpers.main(__file__)
