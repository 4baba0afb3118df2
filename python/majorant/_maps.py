# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Results of the solvers."""
from __future__ import annotations

import json
import math
import os
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import _arrays, _core, _options
from ._cells import cell, layout_picture, picture
from ._errors import UnsupportedError, UsageError
from ._textures import save_textured
from ._types import Doubles, Integers

# Upper bound on faces that notebooks draw one by one.
_MOST_DRAWN = 20000


class Map:
    """A piecewise polynomial map of a surface onto the plane, proven to be locally injective.

    Every face is a Bezier triangle of degree n: its image is a polynomial of the barycentric
    coordinates b = (b0, b1, b2) of its corners,

        uv(b) = sum over |alpha| = n of  n! / alpha!  b^alpha  control_points[cells[face]][alpha].

    Arrays are float64 and int32 in C order, shared with the library and read-only: copy them to change
    them. One unit of uv is one unit of V. Maps can be pickled.
    """

    def __init__(self, file: _core.MapFile, mesh: _core.Mesh, request: _core.ProofRequest, input: bool, status: str,
                 message: str, report: str, solved: _core.SolvedMap | None = None):
        self._file, self._mesh, self._request, self._input = file, mesh, request, input
        self._report = report
        self._solved = solved  # for derivatives; None unless parametrize() or deform() of this process made the map
        self._sensitivities: dict[tuple[int, int] | None, _core.MapSensitivity] = {}
        self.status = status  #: 'converged', or the limit that ended the run
        self.message = message  #: the reason of the end, one line

    # ---- arrays ----------------------------------------------------------------------------------
    @property
    def degree(self) -> int:
        """The degree n of the Bezier triangles, 1 .. 8."""
        return self._file.degree

    @property
    def control_points(self) -> Doubles:
        """(#N, 2): the control points of all faces in the plane; neighbours share those of their edge."""
        return self._file.uv

    @property
    def cells(self) -> Integers:
        """(#F, (n+1)(n+2)/2): the nodes of every face in VTK's order: corners, then the inner nodes of edges 01,
        12, 20, then the inside as a triangle of degree n - 3, and so on."""
        return self._file.cells

    @property
    def nodes(self) -> Doubles:
        """(#N, 3): the nodes on the surface, whose faces are flat."""
        return self._file.points

    @property
    def input_vertices(self) -> Integers:
        """(#N,): the row of V of every node; -1 for nodes inside of edges and faces."""
        return self._file.input_vertex

    @property
    def _lattice(self) -> Doubles:
        """Returns the barycentric coordinates of the nodes of a face, in their order."""
        return _core.multi_indices(self.degree) / self.degree

    @property
    def faces(self) -> Integers:
        """(#F, 3): rows of V at the corners of every face. Triangles of F are unchanged, polygons are triangulated."""
        return self._file.input_vertex[self._file.cells[:, :3]]

    @property
    def input_faces(self) -> Integers:
        """(#F,): the row of F of every face."""
        return self._file.input_face

    @property
    def corner_uv(self) -> Doubles:
        """(#F, 3, 2): texture coordinates, the image of every corner of every face. On a cut the two sides differ."""
        return self._file.uv[self._file.cells[:, :3]]

    @property
    def uv(self) -> Doubles:
        """(#V, 2): the image of every row of V. Rows that no face uses (those not in `np.unique(F)`) lie at the first
        corner of the first face, so that no number is NaN and the layout does not grow. Maps with cuts raise
        UnsupportedError; use `corner_uv`."""
        out = np.tile(self.corner_uv[0, 0], (len(self._mesh.positions), 1))
        corners = self.faces
        out[corners] = self.corner_uv
        differs = (out[corners] != self.corner_uv).any(axis=(1, 2))
        if differs.any():
            vertex = corners[differs][0][0]
            raise UnsupportedError(f'the map is cut: vertex {vertex} and others of face '
                                   f'{int(differs.argmax())} have several images; take corner_uv')
        return out

    @property
    def charts(self) -> Integers:
        """(#F,): the chart of every face, from 0."""
        found = self._file.chart
        return found if len(found) else np.zeros(len(self.cells), dtype=np.int32)

    @property
    def distortion(self) -> Doubles:
        """(#F,): the mean of the energy's density on every face. Empty if it was not measured, and for an energy
        without a name (a `Density`), since no other program could check it."""
        return self._file.distortion

    @property
    def cones(self) -> dict[int, int]:
        """The cones of a seamless map: {vertex: quarter turns around it}, without vertices of four."""
        found = self._file.cone
        points = np.flatnonzero(found)
        return {int(self._file.input_vertex[p]): int(found[p]) for p in points}

    @property
    def report(self) -> dict[str, Any] | None:
        """The report of `majorant --report` (docs/interface.md), a new dictionary on each access; None for maps from
        files."""
        return json.loads(self._report)

    @property
    def globally_injective(self) -> bool | None:
        """True if no two points of the surface have the same image, False if some have, both proven. None if the
        question is undecided, and for maps from files (use `check`). A map that only has to be locally injective may
        overlap itself; `report['result']['overlaps']` has the place."""
        return ((self.report or {}).get('result') or {}).get('globally_injective')

    # ---- points ----------------------------------------------------------------------------------
    def evaluate(self, face: ArrayLike, bary: ArrayLike) -> Doubles:
        """Returns uv at barycentric coordinates.

        face: indices of faces, of any shape S. bary: S + (3,), or broadcastable to it; each sums to 1 and may lie
        outside the triangle. Returns S + (2,).

            r.evaluate(12, [0.2, 0.3, 0.5])                    # (2,)
            r.evaluate(np.arange(len(r.faces)), [1/3] * 3)     # centres of all faces: (#F, 2)
        """
        face, bary = self._places(face, bary)
        basis = _bernstein(self.degree, bary)
        return np.einsum('...k,...kd->...d', basis, self.control_points[self.cells[face]])

    def jacobian(self, face: ArrayLike, bary: ArrayLike) -> Doubles:
        """Returns the derivative of the map, from an orthonormal frame of the face to the plane.

        Arguments as for `evaluate`. Returns S + (2, 2). The first axis of the frame points from corner 2 to
        corner 0. Singular values, determinants and energies do not depend on the frame.
        """
        face, bary = self._places(face, bary)
        lower = _core.multi_indices(self.degree - 1) if self.degree > 1 else np.zeros((1, 3), int)
        number = {tuple(a): k for k, a in enumerate(_core.multi_indices(self.degree))}
        raised = [[number[tuple(a + unit)] for a in lower] for unit in np.eye(3, dtype=int)]
        points = self.control_points[self.cells[face]]
        basis = self.degree * _bernstein(self.degree - 1, bary)
        by_bary = [np.einsum('...k,...kd->...d', basis, points[..., rows, :]) for rows in raised]
        along = np.stack([by_bary[0] - by_bary[2], by_bary[1] - by_bary[2]], axis=-1)
        corners = self.nodes[self.cells[face][..., :3]]
        first, second = corners[..., 0, :] - corners[..., 2, :], corners[..., 1, :] - corners[..., 2, :]
        length = np.linalg.norm(first, axis=-1)
        x = (first * second).sum(-1) / length
        height = np.linalg.norm(np.cross(first, second), axis=-1) / length
        frame = np.zeros(along.shape)  # inverse of the matrix with the tangents as columns
        frame[..., 0, 0], frame[..., 0, 1], frame[..., 1, 1] = 1 / length, -x / (length * height), 1 / height
        return along @ frame

    def _places(self, face: Any, bary: Any) -> tuple[Integers, Doubles]:
        face, bary = np.asarray(face), np.asarray(bary, dtype=float)
        if face.dtype.kind not in 'iu':
            raise UsageError(f'face holds {face.dtype}, not integers')
        if bary.ndim == 0 or bary.shape[-1] != 3:
            raise UsageError(f'bary has shape {bary.shape}; the last side must be 3')
        if not np.allclose(bary.sum(-1), 1):
            raise UsageError('bary does not add to 1')
        if face.size and not (0 <= face.min() and face.max() < len(self.cells)):
            raise UsageError(f'face is not in 0 .. {len(self.cells) - 1}')
        try:
            shape = np.broadcast_shapes(face.shape, bary.shape[:-1])
        except ValueError:
            raise UsageError(f'face of shape {face.shape} and bary of shape {bary.shape} do not fit') from None
        return np.broadcast_to(face, shape), np.broadcast_to(bary, (*shape, 3))

    # ---- derivatives -----------------------------------------------------------------------------
    def forward(self, *, pins: ArrayLike | None = None, handles: ArrayLike | None = None,
                weights: ArrayLike | None = None, soft: float = 0.0, rest: ArrayLike | None = None,
                gauge: tuple[int, int] | None = None) -> Doubles:
        """Returns the change of `control_points`, (#N, 2), for changes of the data of the map:

            pins, handles   of their targets, (#, 2) each, in the order of the arguments
            weights         of the summands of the energy, one number each
            soft            of the weight of handles
            rest            of V, (#V, 3), at degree 1

        For maps of `parametrize` and `deform`. Exact Newton steps reach the minimum first, and the implicit
        function theorem gives the derivative. A free map is unique only up to motions, and its derivative is
        the one of least norm. A gauge of two vertices fixes the motion: the first vertex stays, and so does the
        direction to the second one. Raises UnsupportedError, with the reason, for seamless maps; for maps of `unwrap`,
        with `improve_mesh`, from files or pickles; for bijective maps whose scaffold is active, and maps that the
        injectivity bound holds; and for rest above degree 1.
        """
        core = self._derivatives(gauge)
        rows = np.zeros((0, 3))
        if rest is not None:
            rows = _arrays.floats('rest', rest, (len(self._mesh.positions), 3))[core.input_vertices]
        empty = np.zeros((0, 2))
        assert self._solved is not None
        return core.forward(
            empty if pins is None else _arrays.floats('pins', pins, (self._solved.pin_count, 2)),
            empty if handles is None else _arrays.floats('handles', handles, (self._solved.handle_count, 2)),
            np.zeros(0) if weights is None else _arrays.floats('weights', weights, (self._solved.energy_count,)),
            _options.number('soft', soft, -_options.LARGEST, _options.LARGEST, zero=True), rows)

    def adjoint(self, dL_duv: ArrayLike, *, gauge: tuple[int, int] | None = None) -> 'MapAdjoint':
        """Returns the derivative of a function L of the map, given dL/d(control_points), (#N, 2), by the data of the
        map: `pins`, `handles`, `weights`, `soft`, and `rest` (None above degree 1). Raises as `forward`."""
        core = self._derivatives(gauge)
        slope = _arrays.floats('dL_duv', dL_duv, (len(self.control_points), 2))
        pins, handles, weights, soft, positions = core.adjoint(slope)
        rest = None
        if positions is not None:
            rest = np.zeros((len(self._mesh.positions), 3))
            rest[core.input_vertices] = positions
        return MapAdjoint(pins, handles, weights, soft, rest, core.error, core.motions)

    def _derivatives(self, gauge: tuple[int, int] | None) -> _core.MapSensitivity:
        if self._solved is None:
            raise UnsupportedError('derivatives are those of maps of parametrize() and deform(), in the process that '
                                   'made them; this one was made by unwrap(), read or unpickled')
        key = None
        if gauge is not None:
            pair = _arrays.integers('gauge', gauge, (2,), len(self._mesh.positions), 'vertices')
            key = (int(pair[0]), int(pair[1]))
        if key not in self._sensitivities:
            self._sensitivities[key] = _core.MapSensitivity(self._solved, key)
        return self._sensitivities[key]

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, '_solved': None, '_sensitivities': {}}

    # ---- files -----------------------------------------------------------------------------------
    def save(self, path: str | os.PathLike, *, refine: int = 1, vtu: str = 'bezier', msh: str = 'image',
             texture: ArrayLike | None = None) -> None:
        """Writes the map in the format of the extension. Every data file is certified.

        .vtu holds everything, losslessly. .obj, .ply, .glb and .gltf are V and F with texture coordinates: curved
        faces are cut into as many straight ones as valid ones need, at least refine * refine per face. .msh is for
        gmsh (msh='image' or 'surface'). .svg, .png and .html are pictures. vtu='lagrange' writes cells that more
        programs read. texture: the texture of a .glb, (height, width, 3 or 4) of uint8, row 0 at v = 0, for maps in the
        unit square.

        Files with a map are read back before they get their name, and are proven to be locally injective, on the
        surface, continuous except on cuts, and without overlaps if that was requested. Raises InvalidError if a proof
        fails, UsageError if the file cannot be written. In both cases nothing is written, and an older file of that
        name stays.
        """
        from ._options import choice, integer
        name = _arrays.path(path)
        extension = os.fsdecode(os.path.splitext(name)[1]).lower()
        if extension not in _core.map_formats():
            raise UsageError(f'{os.fsdecode(name)}: no file can be written of this name; it ends in one of '
                             + ' '.join(_core.map_formats()))
        cells, content = choice('vtu', vtu, ('bezier', 'lagrange')), choice('msh', msh, ('image', 'surface'))
        write = (self._file, self._mesh, self._request, self._input, integer('refine', refine, 1, 20),
                 cells == 'lagrange', content == 'surface')
        if texture is None:
            _core.save_map(name, *write)
            return
        if extension != '.glb':
            raise UsageError(f'{os.fsdecode(name)}: a texture is written into .glb')
        save_textured(os.fsdecode(name), lambda plain: _core.save_map(plain, *write), texture)

    def to_meshio(self, names: str = 'gmsh') -> Any:
        """Returns a meshio.Mesh: triangles of the map's degree with Lagrange nodes on the surface; point data 'uv'
        (#N, 3), whose last column is 0, since gmsh and VTK have no vectors of two entries; cell data 'input_face',
        'chart' and, if any, 'distortion'. It is not certified, unlike files of `save`.

        names: the cell names for degree 3 or more. meshio has two, each for its own files: 'gmsh', 'triangle10'
        and so on; 'vtk', 'VTK_LAGRANGE_TRIANGLE', for .vtu and .vtk.

            r.to_meshio().write('a.msh', file_format='gmsh')
            r.to_meshio('vtk').write('a.vtu')
        """
        from ._exchange import to_meshio
        from ._options import choice
        return to_meshio(self, choice('names', names, ('gmsh', 'vtk')))

    def to_trimesh(self) -> Any:
        """Returns a trimesh.Trimesh with texture coordinates, for a map of degree 1. Vertices on cuts are repeated
        for each side; `input_vertices` has their rows of V."""
        from ._exchange import to_trimesh
        return to_trimesh(self)

    def _in_floats(self) -> tuple[Map, str]:
        """Returns the map of degree 1 with coordinates rounded to floats of single precision, and its first unproven
        property; empty if all are proven."""
        file, defect = _core.float_layout(self._file, self._mesh, self._request)
        return Map(file, self._mesh, self._request, self._input, self.status, self.message, self._report), defect

    # ---- pictures --------------------------------------------------------------------------------
    def svg(self, quantity: str | None = None) -> str:
        """Returns an SVG drawing of the layout, coloured by the distortion of its faces.

        quantity: 'density' of the energy, 'area', 'angle', 'sigma-max' or 'sigma-min'; None: the density if
        `distortion` is not empty, else 'area'.
        """
        from ._options import QUANTITIES, choice
        if quantity is None:
            quantity = 'density' if len(self.distortion) else 'area'
        return _core.svg_text(self._file, choice('quantity', quantity, QUANTITIES))

    def plot(self, ax: Any = None, values: ArrayLike | str | None = None, *, cmap: Any = None, vmin: float | None = None,
             vmax: float | None = None, linewidth: float | None = None, edges: bool = True, align: bool = False) -> Any:
        """Draws the layout with matplotlib: curved faces, the boundary in black, seams in red. Returns the axes.

            ax = r.plot(plt.subplot(), 'area')
            plt.colorbar(ax.collections[0], extend='max')

            ax              axes; None: the current ones
            values          (#F,) numbers that colour the faces, or 'density', 'area', 'angle', 'sigma-max',
                            'sigma-min' or 'charts'; None: the charts if there are several, else the density
            cmap, vmin, vmax
                            as of matplotlib; None: measures have the colours of svg(), other values 'viridis'
                            and their range
            linewidth       of all lines, points; None: 0.3 for edges, 1 for the boundary and seams
            edges           whether inner edges are drawn
            align           whether the layout is turned so that its longer side is horizontal

        Curves are drawn as short straight pieces. Faces that are turned over are magenta, above all others, and have a
        label for legends.
        """
        from ._plots import plot
        return plot(self, ax, values, cmap, vmin, vmax, linewidth, edges, align)

    def _repr_html_(self) -> str:
        """Returns the layout for notebooks: a drawing, or, for many faces, an image of its charts."""
        if len(self.cells) > _MOST_DRAWN:
            return cell(repr(self), picture(layout_picture(self.corner_uv, self.charts)))
        drawing = self.svg()
        return cell(repr(self), drawing[drawing.index('<svg'):])

    def __repr__(self) -> str:
        result = (self.report or {}).get('result') or {}
        value = result.get('value')
        energy = f', {result["energy"] or "energy"} {value:.6f}' if value is not None else ''
        return f'<majorant.Map: {len(self.cells)} faces, degree {self.degree}{energy}, {self.status}>'


class MapAdjoint:
    """The derivatives of a function L by the data of a map: see `Map.adjoint`.

    error: an estimate of |uv - uv*| / |uv| after the exact Newton steps. motions: the number of motions that the data
    leave free; then derivatives are of least norm, or in the given gauge."""

    def __init__(self, pins: Doubles, handles: Doubles, weights: Doubles, soft: float, rest: Doubles | None,
                 error: float, motions: int):
        self.pins, self.handles, self.weights, self.soft, self.rest = pins, handles, weights, soft, rest
        self.error, self.motions = error, motions


def _bernstein(degree: int, bary: Doubles) -> Doubles:
    """Returns the Bernstein polynomials at bary, S + (3,), in VTK's order: S + (#,)."""
    if degree == 0:
        return np.ones(bary.shape[:-1] + (1,))
    alpha = _core.multi_indices(degree)
    factor = [math.factorial(degree) / math.prod(map(math.factorial, map(int, a))) for a in alpha]
    return np.array(factor) * np.prod(bary[..., None, :] ** alpha, axis=-1)

