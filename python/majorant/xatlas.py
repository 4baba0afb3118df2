# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""The interface of the Python package xatlas, with layouts of majorant.

    import majorant.xatlas as xatlas

    vmapping, indices, uvs = xatlas.parametrize(V, F)
    xatlas.export('out.obj', V[vmapping], indices, uvs)

vmapping: (#N,) uint32, the row of V of each new vertex. indices: (#F, 3) uint32, the faces of F in their order, so that
vmapping[indices] is F. uvs: (#N, 2) float32 in the unit square. These floats are proven to be free of overlaps. If the
proof fails, as for soups of faces that are turned against each other at the same places, there is a warning, and
`Atlas.proven` is False. Arguments, results and exceptions are those of xatlas 0.0.11; callbacks, `save` and `proven`
are added. `Atlas.add_uv_mesh` packs existing islands. Every mesh that xatlas accepts is accepted: faces without an area
get the uvs of their vertices, and sheets that share an edge are separated. Ctrl-C ends a run; other threads go on
during it.

Options with an effect: of PackOptions `padding`, `bilinear`, `resolution`, `texels_per_unit`, `rotate_charts` and
`create_image`; of ChartOptions `max_chart_area` and `max_cost` (2 is the usual limit of stretch, less is stricter).
`fix_winding` and `bruteForce` are always on. The other options weight the chart growth of xatlas; for a value that is
not the default, there is one warning that it has no effect. For maps of higher degree, seams, or reports use
`majorant.unwrap`.
"""
from __future__ import annotations

import dataclasses
import enum
import math
import os
import warnings
from typing import Any, Callable, Iterator

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._atlas_images import chart_image as _chart_image
from ._errors import UnsupportedError, UsageError
from ._functions import unwrap
from ._maps import Map
from ._types import Callback

Indices = NDArray[np.uint32]
Floats = NDArray[np.float32]
MeshResult = tuple[Indices, Indices, Floats]

__all__ = ['Atlas', 'Chart', 'ChartOptions', 'ChartType', 'PackOptions', 'export', 'parametrize']
__version__ = _core.version

_USUAL_COST = 2.0
# Typical stretch of layouts of xatlas (bench/generator_surfaces.py).
_USUAL_STRETCH = 1.005
_USUAL_SIDE = 1024
# Costs at least this large allow any stretch: the limit would be 1 + 2500.
_ANY_COST = 1e6
# Upper bounds on the fraction of an atlas that one chart may cover, tried in this order for several atlases.
_CHART_SHARES = (0.4, 0.15, 0.05)
_NO_CHART = np.uint32(0xFFFFFFFF)


class ChartType(enum.Enum):
    """How a chart was mapped. Charts of majorant are LSCM, not mapped by planes; charts without area are Invalid."""
    Planar = 0
    Ortho = 1
    LSCM = 2
    Piecewise = 3
    Invalid = 4


class _Checked:
    """Fields with the ranges of xatlas: unsigned integers of 32 bits, numbers and booleans."""

    def __setattr__(self, name: str, value: Any) -> None:
        fields: dict[str, Any] = getattr(type(self), '__dataclass_fields__')
        kind = fields[name].type if name in fields else None
        text = f'{type(self).__name__}.{name}'
        if kind is None:
            raise AttributeError(f'{text} does not exist')
        if kind == 'bool' and not isinstance(value, (bool, np.bool_)):
            raise TypeError(f'{text} is {value!r}: True or False is needed')
        if kind == 'int' and not (isinstance(value, (int, np.integer)) and 0 <= value < 2 ** 32):
            raise TypeError(f'{text} is {value!r}: an integer from 0 to 4294967295 is needed')
        if kind == 'float' and not isinstance(value, (int, float, np.integer, np.floating)):
            raise TypeError(f'{text} is {value!r}: a number is needed')
        object.__setattr__(self, name, value)


@dataclasses.dataclass
class ChartOptions(_Checked):
    """Options of charts. max_chart_area: surface area in units of V; 0: unlimited. max_cost: 2 is the usual limit of
    stretch, less is stricter; NaN: any stretch. fix_winding is always on."""
    max_chart_area: float = 0.0
    max_boundary_length: float = 0.0
    normal_deviation_weight: float = 2.0
    roundness_weight: float = 0.01
    straightness_weight: float = 6.0
    normal_seam_weight: float = 4.0
    texture_seam_weight: float = 0.5
    max_cost: float = _USUAL_COST
    max_iterations: int = 1
    use_input_mesh_uvs: bool = False
    fix_winding: bool = False


@dataclasses.dataclass
class PackOptions(_Checked):
    """Options of packing. padding: least distance of charts, in texels; bilinear adds one. resolution: of the atlas, in
    texels; 0: about 1024, or as texels_per_unit requires. With both, there are as many atlases of that size as
    necessary. rotate_charts: whether charts may be turned by quarters to fit."""
    max_chart_size: int = 0
    padding: int = 0
    texels_per_unit: float = 0.0
    resolution: int = 0
    bilinear: bool = True
    blockAlign: bool = False
    bruteForce: bool = False
    create_image: bool = False
    rotate_charts_to_axis: bool = True
    rotate_charts: bool = True


_WITHOUT_EFFECT = {
    ChartOptions: ('max_boundary_length', 'normal_deviation_weight', 'roundness_weight', 'straightness_weight',
                   'normal_seam_weight', 'texture_seam_weight', 'max_iterations', 'use_input_mesh_uvs'),
    PackOptions: ('max_chart_size', 'blockAlign', 'rotate_charts_to_axis'),
}
_warned: set[str] = set()


class Chart:
    """A chart of a mesh. faces: (#,) uint32, faces of the mesh. material: of its faces in a mesh of uvs, else 0."""

    def __init__(self, faces: Indices, atlas_index: int, material: int = 0):
        self.faces, self.atlas_index, self.material = faces, atlas_index, material
        self.type = ChartType.LSCM


@dataclasses.dataclass
class _Input:
    """A mesh to unwrap or pack. For a mesh of uvs: rows, the caller's rows by face and corner; turned, flags of
    faces whose corners are in another order than the caller's; materials of faces."""
    positions: NDArray[np.float64]
    faces: NDArray[np.int64]
    rows: NDArray[np.int64] | None = None
    turned: NDArray[np.bool_] | None = None
    materials: NDArray[np.uint32] | None = None


@dataclasses.dataclass
class _Output:
    """A mesh of a generated atlas. By vertex: mapping, uvs, chart and atlas (_NO_CHART: none). charts: the faces and
    the atlas of each chart."""
    mapping: Indices
    indices: Indices
    uvs: Floats
    atlas_of_vertex: Indices
    chart_of_vertex: Indices
    charts: list[Chart]


class Atlas:
    """The charts of several meshes in one layout.

        atlas = xatlas.Atlas()
        atlas.add_mesh(V, F)
        atlas.generate(pack_options=options)
        vmapping, indices, uvs = atlas[0]

    mesh_count, chart_count, atlas_count, width, height (texels), texels_per_unit, utilization (of the first atlas):
    0 before generate(), and if no face has an area. proven: whether the floats are proven to be injective,
    without overlaps; `defect` names the first property that is not proven.
    """

    def __init__(self) -> None:
        self._inputs: list[_Input] = []
        self._clear()

    def _clear(self) -> None:
        self._outputs: list[_Output] = []
        self._map: Map | None = None
        self._utilization: list[float] = []
        self._has_image = False
        self.width = self.height = self.chart_count = self.atlas_count = 0
        self.texels_per_unit = 0.0
        self.proven, self.defect = True, ''

    # ---- input -----------------------------------------------------------------------------------
    def add_mesh(self, positions: ArrayLike, indices: ArrayLike, normals: ArrayLike | None = None,
                 uvs: ArrayLike | None = None) -> None:
        """Adds a mesh of triangles. Normals and uvs are checked and ignored, since the options of xatlas that use
        them have no effect."""
        V = _rows('Position', positions, np.float64, 3)
        F = _rows('Index', indices, np.int64, 3)
        if normals is not None:
            _rows('Normal', normals, np.float64, 3, len(V))
        if uvs is not None:
            _rows('Texture coordinate', uvs, np.float64, 2, len(V))
        self._add(F, len(V), lambda: _Input(V, F))

    def add_uv_mesh(self, uvs: ArrayLike, indices: ArrayLike, face_materials: ArrayLike | None = None) -> None:
        """Adds a mesh with existing uvs (#V, 2). Its islands, which end where materials (#F,) differ, are moved and
        turned until they do not overlap, at one scale; texels_per_unit refers to units of these uvs. Islands that
        overlap themselves are divided, with a warning. All meshes of an atlas have uvs, or none has."""
        uv = _rows('Texture coordinate', uvs, np.float64, 2)
        F = _rows('Index', indices, np.int64, 3)
        if face_materials is None:
            materials = np.zeros(len(F), np.uint32)
        else:
            given = np.asarray(face_materials)
            column = given[:, None] if given.ndim == 1 else given
            materials = _rows('Face material ID', column, np.int64, 1, len(F)).ravel().astype(np.uint32)
        self._add(F, len(uv), lambda: _islands(uv, F, materials))

    def _add(self, F: NDArray[np.int64], rows: int, make: Callable[[], _Input]) -> None:
        if F.size and not (0 <= F.min() and F.max() < rows):
            raise RuntimeError('Adding mesh failed: index out of range')
        mesh = make()
        if self._inputs and (mesh.rows is None) != (self._inputs[0].rows is None):
            raise RuntimeError('Adding mesh failed: an atlas has meshes or UV meshes, not both')
        self._inputs.append(mesh)

    # ---- work ------------------------------------------------------------------------------------
    def generate(self, chart_options: ChartOptions | None = None, pack_options: PackOptions | None = None,
                 verbose: bool = False, callback: Callback | None = None) -> None:
        """Makes the charts of all meshes and packs them. callback: as of `majorant.unwrap`; a return value of True
        ends the run."""
        cuts, packs = chart_options or ChartOptions(), pack_options or PackOptions()
        _warn_of_what_has_no_effect(cuts, packs)
        self._clear()
        kept = [_faces_with_sides(mesh) for mesh in self._inputs]
        V, F = _side_by_side(self._inputs, kept)
        is_packed = bool(self._inputs) and self._inputs[0].rows is not None
        if not len(F):
            self._outputs = [_output_of(mesh, is_kept, None) for mesh, is_kept in zip(self._inputs, kept)]
            return
        self._map = (_packed if is_packed else _unwrapped)(V, F, cuts, packs, callback)
        self._measure(packs)
        self._take(kept)
        if verbose:
            print('--- Generated Atlas ---', f'Utilization: {100 * self.utilization:f}%', f'Charts: {self.chart_count}',
                  f'Size: {self.width}x{self.height}', '', sep='\n')

    def _measure(self, packs: PackOptions) -> None:
        assert self._map is not None
        result = (self._map.report or {})['result']
        density, resolution = result['texel_density'], (self._map.report or {})['options']['resolution']
        side = float(packs.resolution or _USUAL_SIDE)
        if _density(packs) > 0 and not packs.resolution:
            side = resolution * _density(packs) / density
        self.width = self.height = math.ceil(side)
        self.texels_per_unit = density * side / resolution
        self._map, self.defect = self._map._in_floats()
        self.proven = not self.defect
        if self.defect:
            warnings.warn('the layout is not proven to be valid in floats: ' + self.defect, stacklevel=3)
        self._has_image = packs.create_image

    def _take(self, kept: list[NDArray[np.bool_]]) -> None:
        assert self._map is not None
        report, file = self._map.report or {}, self._map._file
        tile_of_chart = np.array([chart['tile'] for chart in report['charts']]) - 1001
        tiles, atlas_of_chart = np.unique(tile_of_chart, return_inverse=True)
        self.atlas_count, self.chart_count = len(tiles), len(tile_of_chart)
        chart_of_cell = self._map.charts
        uv = file.uv.copy()
        tile_of_point = np.zeros(len(uv), dtype=int)
        tile_of_point[file.cells.ravel()] = np.repeat(tile_of_chart[chart_of_cell], 3)
        uv -= np.stack([tile_of_point % 10, tile_of_point // 10], 1)
        corner = uv[file.cells]
        a, b = corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]
        areas = np.bincount(atlas_of_chart[chart_of_cell], a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0], self.atlas_count)
        self._utilization = [float(area) / 2 for area in areas]
        first_vertex = first_face = 0
        for mesh, is_kept in zip(self._inputs, kept):
            layout = _Layout(file, uv, chart_of_cell, atlas_of_chart, first_vertex, first_face)
            self._outputs.append(_output_of(mesh, is_kept, layout))
            first_vertex += len(mesh.positions)
            first_face += int(is_kept.sum())

    # ---- results ---------------------------------------------------------------------------------
    def get_mesh(self, mesh_index: int) -> MeshResult:
        """Returns vmapping, indices and uvs of a mesh, as `parametrize` does."""
        mesh = self._outputs[_index('Mesh', mesh_index, len(self._outputs))]
        return mesh.mapping.copy(), mesh.indices.copy(), mesh.uvs.copy()

    def get_mesh_vertex_assignment(self, mesh_index: int) -> tuple[Indices, Indices]:
        """Returns the atlas and the chart of every new vertex; 2^32 - 1 for none."""
        mesh = self._outputs[_index('Mesh', mesh_index, len(self._outputs))]
        return mesh.atlas_of_vertex.copy(), mesh.chart_of_vertex.copy()

    def get_mesh_chart_count(self, mesh_index: int) -> int:
        return len(self._outputs[_index('Mesh', mesh_index, len(self._outputs))].charts)

    def get_mesh_chart(self, mesh_index: int, chart_index: int) -> Chart:
        charts = self._outputs[_index('Mesh', mesh_index, len(self._outputs))].charts
        return charts[_index('Chart', chart_index, len(charts))]

    def get_utilization(self, atlas_index: int) -> float:
        """Returns the fraction of an atlas that charts cover."""
        return self._utilization[_index('Atlas', atlas_index, self.atlas_count)]

    def get_chart_image(self, atlas_index: int) -> NDArray[np.uint8]:
        """Returns (height, width, 3): charts in colours, row 0 at v = 0. Requires PackOptions.create_image."""
        _index('Atlas', atlas_index, self.atlas_count)
        if not self._has_image:
            raise RuntimeError('The atlas has no image: set create_image of PackOptions.')
        parts, numbers, first = [], [], 0
        for mesh in self._outputs:
            chart = np.append(mesh.chart_of_vertex, _NO_CHART)[mesh.indices[:, 0]]
            shown = np.append(mesh.atlas_of_vertex, _NO_CHART)[mesh.indices[:, 0]] == atlas_index
            parts.append(mesh.uvs[mesh.indices[shown]])
            numbers.append(first + chart[shown].astype(np.int64))
            first += len(mesh.charts)
        return _chart_image(np.concatenate(parts), np.concatenate(numbers), self.width, self.height)

    @property
    def mesh_count(self) -> int:
        return len(self._outputs)

    @property
    def utilization(self) -> float:
        return self.get_utilization(0)

    @property
    def chart_image(self) -> NDArray[np.uint8]:
        return self.get_chart_image(0)

    def __len__(self) -> int:
        return self.mesh_count

    def __getitem__(self, mesh_index: int) -> MeshResult:
        return self.get_mesh(mesh_index)

    def save(self, path: str | os.PathLike) -> None:
        """Writes an atlas of one mesh as `Map.save` does, which proves the file; several meshes, and meshes of uvs,
        as objects of an .obj."""
        if len(self._outputs) == 1 and self._map is not None and self._inputs[0].rows is None:
            return self._map.save(path)
        if os.path.splitext(os.fsdecode(path))[1].lower() != '.obj':
            raise UsageError(f'{os.fsdecode(path)}: several meshes, and meshes of uvs, are written as .obj')
        lines: list[str] = []
        first = 1
        for number, (mesh, output) in enumerate(zip(self._inputs, self._outputs)):
            lines.append(f'o mesh_{number}')
            lines += _obj_lines(_placed(mesh, output), output.indices, output.uvs, None, first)
            first += len(output.mapping)
        with open(path, 'w') as file:
            file.write('\n'.join(lines) + '\n')


def parametrize(positions: ArrayLike, indices: ArrayLike, normals: ArrayLike | None = None,
                uvs: ArrayLike | None = None, callback: Callback | None = None) -> MeshResult:
    """Returns vmapping (#N,), indices (#F, 3) and uvs (#N, 2) of a mesh of triangles, with default options."""
    atlas = Atlas()
    atlas.add_mesh(positions, indices, normals, uvs)
    atlas.generate(callback=callback)
    return atlas.get_mesh(0)


def export(path: str | os.PathLike, positions: ArrayLike, indices: ArrayLike | None = None,
           uvs: ArrayLike | None = None, normals: ArrayLike | None = None) -> None:
    """Writes an OBJ with a row of uvs and of normals for each vertex."""
    V = _rows('Position', positions, np.float64, 3)
    F = None if indices is None else _rows('Index', indices, np.int64, 3)
    uv = None if uvs is None else _rows('Texture coordinates', uvs, np.float64, 2, len(V))
    N = None if normals is None else _rows('Normal', normals, np.float64, 3, len(V))
    try:
        with open(path, 'w') as file:
            file.write('\n'.join(_obj_lines(V, F, uv, N, 1)) + '\n')
    except OSError as error:
        raise ValueError(f'Cannot open path {os.fsdecode(path)}: {error.strerror}') from None


def _obj_lines(V: Any, F: Any, uv: Any, normals: Any, first: int) -> list[str]:
    lines = ['v %.9g %.9g %.9g' % tuple(row) for row in V.tolist()]
    lines += ['vn %.9g %.9g %.9g' % tuple(row) for row in ([] if normals is None else normals.tolist())]
    lines += ['vt %.9g %.9g' % tuple(row) for row in ([] if uv is None else uv.tolist())]
    corner = '{0}/{0}/{0}' if normals is not None and uv is not None else (
        '{0}//{0}' if normals is not None else '{0}/{0}' if uv is not None else '{0}')
    for row in [] if F is None else (np.asarray(F) + first).tolist():
        lines.append('f ' + ' '.join(corner.format(v) for v in row))
    return lines


# ---- arguments -----------------------------------------------------------------------------------
def _rows(name: str, value: ArrayLike, dtype: Any, columns: int, count: int | None = None) -> Any:
    array = np.asarray(value)
    if array.ndim != 2 or array.shape[1] != columns:
        raise ValueError(f'{name} array expected to be Nx{columns}.')
    if count is not None and len(array) != count:
        raise ValueError(f'{name} array has invalid number of elements in the first dimension (expected {count}, got '
                         f'{len(array)})')
    if dtype is np.int64 and array.dtype.kind not in 'iub':
        array = array.astype(np.float64)
        array = np.where(np.isfinite(array), array, -1)
    return np.ascontiguousarray(array.astype(dtype))


def _index(name: str, index: int, count: int) -> int:
    if not 0 <= index < count:
        raise IndexError(f'{name} index {index} out of bounds for {count}.')
    return index


def _warn_of_what_has_no_effect(*options: Any) -> None:
    for given in options:
        usual = type(given)()
        for name in _WITHOUT_EFFECT[type(given)]:
            if getattr(given, name) != getattr(usual, name) and name not in _warned:
                _warned.add(name)
                warnings.warn(f'{type(given).__name__}.{name} has no effect in majorant', stacklevel=4)


# ---- meshes in and out ---------------------------------------------------------------------------
def _faces_with_sides(mesh: _Input) -> NDArray[np.bool_]:
    """Returns flags of faces whose corners are finite and at three different places. The others have no image."""
    p = mesh.positions[mesh.faces]
    with np.errstate(over='ignore', invalid='ignore'):
        apart = [(p[:, k] != p[:, k - 1]).any(1) for k in range(3)]
        is_kept = np.isfinite(p).all((1, 2)) & apart[0] & apart[1] & apart[2]
        if mesh.rows is not None:  # faces without an area belong to no island
            a, b = p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]
            is_kept &= a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0] > 0
    return is_kept


# ---- meshes of uvs -------------------------------------------------------------------------------
def _islands(uv: NDArray[np.float64], F: NDArray[np.int64], materials: NDArray[np.uint32]) -> _Input:
    """Returns the islands as surfaces in parallel planes, with counterclockwise faces. Faces of one material are
    connected by a shared edge, or by edges at equal places if exactly one edge of each face is there."""
    p = uv[F]
    with np.errstate(over='ignore', invalid='ignore'):
        a, b = p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]
        turned = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0] < 0
    rows = np.where(turned[:, None], F[:, [0, 2, 1]], F)
    finite = np.nan_to_num(uv) + 0.0  # turns -0 into 0
    place = np.unique(finite[:, 0] + 1j * finite[:, 1], return_inverse=True)[1].reshape(-1)
    # Half-edge 3 f + c leads from corner c of face f to its next corner, `ahead`.
    corner = np.arange(3 * len(F))
    ahead = corner - corner % 3 + (corner % 3 + 1) % 3
    material = np.unique(materials, return_inverse=True)[1].reshape(-1)[corner // 3]
    pairs = _opposite(rows.ravel(), rows.ravel()[ahead], material, corner, False)
    alone = np.setdiff1d(corner, pairs)
    pairs = np.concatenate([pairs, _opposite(place[rows.ravel()], place[rows.ravel()[ahead]], material, alone, True)])
    faces = _components(len(F), pairs // 3)
    ends = np.concatenate([np.stack([pairs[:, 0], ahead[pairs[:, 1]]], 1), np.stack([ahead[pairs[:, 0]], pairs[:, 1]], 1)])
    first, vertex = np.unique(_components(len(corner), ends), return_index=True, return_inverse=True)[1:]
    size = np.ptp(uv[np.isfinite(uv).all(1)], axis=0).max(initial=0) if len(uv) else 0
    height = np.unique(faces, return_inverse=True)[1].reshape(-1)[first // 3] * (2.0 * size or 1.0)
    positions = np.column_stack([uv[rows.ravel()[first]], height])
    return _Input(positions, vertex.reshape(-1, 3), F, turned, materials)


def _opposite(tail: Any, head: Any, material: Any, chosen: Any, is_unique: bool) -> NDArray[np.int64]:
    """Returns pairs (#, 2) of chosen half-edges that run in opposite directions along each other. is_unique: whether
    only pairs without a third half-edge count."""
    low, high = np.minimum(tail, head)[chosen], np.maximum(tail, head)[chosen]
    runs_up = (tail < head)[chosen]
    if not len(chosen):
        return np.zeros((0, 2), np.int64)
    edge = np.unique(low * (high.max() + 1) + high, return_inverse=True)[1].reshape(-1)
    first, edge, count = np.unique(edge * (material.max() + 1) + material[chosen], return_index=True, return_inverse=True,
                                   return_counts=True)[1:]
    ups, downs = (np.bincount(edge[way], minlength=len(count)) for way in (runs_up, ~runs_up))
    is_shared = (ups > 0) & (downs > 0) & (low != high)[first]
    if is_unique:
        is_shared &= (ups == 1) & (downs == 1)
    one = np.full(len(count), -1)
    one[edge[runs_up]] = chosen[runs_up]
    other = np.full(len(count), -1)
    other[edge[~runs_up]] = chosen[~runs_up]
    all_pairs = [np.stack([chosen[runs_up], other[edge[runs_up]]], 1)[is_shared[edge[runs_up]]],
                 np.stack([one[edge[~runs_up]], chosen[~runs_up]], 1)[is_shared[edge[~runs_up]]]]
    return np.unique(np.concatenate(all_pairs), axis=0)


def _components(count: int, pairs: NDArray[np.int64]) -> NDArray[np.int64]:
    """Returns for each of `count` nodes the least index in its connected component."""
    label = np.arange(count)
    while len(pairs):
        a, b = label[pairs[:, 0]], label[pairs[:, 1]]
        if (a == b).all():
            break
        np.minimum.at(label, np.maximum(a, b), np.minimum(a, b))
        while (label[label] != label).any():
            label = label[label]
    return label


def _placed(mesh: _Input, output: _Output) -> Any:
    """Returns positions of new vertices; for meshes of uvs the uvs."""
    if mesh.rows is None or mesh.turned is None:
        return mesh.positions[output.mapping]
    positions = np.zeros((len(output.mapping), 3))
    corners = np.where(mesh.turned[:, None], mesh.faces[:, [0, 2, 1]], mesh.faces)
    positions[output.indices, :2] = mesh.positions[corners, :2]
    return positions


def _side_by_side(meshes: list[_Input], kept: list[NDArray[np.bool_]]) -> tuple[Any, Any]:
    """Returns one mesh of the kept faces. Several meshes are moved apart, since edges at equal places would be
    joined."""
    all_V, all_F, first, place = [], [], 0, 0.0
    for mesh, is_kept in zip(meshes, kept):
        F = mesh.faces[is_kept]
        V = np.zeros_like(mesh.positions)
        used = np.unique(F)
        V[used] = mesh.positions[used]
        if len(used):
            low, high = V[used].min(0), V[used].max(0)
            if len(meshes) > 1:
                V[used] -= low
                V[used, 0] += place
                place += 2.0 ** math.ceil(math.log2(2 * max((high - low).max(), np.finfo(np.float32).tiny)))
            V[np.setdiff1d(np.arange(len(V)), used)] = V[used[0]]
        all_V.append(V)
        all_F.append(F + first)
        first += len(V)
    if not meshes:
        return np.zeros((0, 3)), np.zeros((0, 3), int)
    return np.concatenate(all_V), np.concatenate(all_F)


def _unwrapped(V: Any, F: Any, cuts: ChartOptions, packs: PackOptions, callback: Callback | None) -> Map:
    most = cuts.max_chart_area if cuts.max_chart_area > 0 else math.inf
    cost = cuts.max_cost if cuts.max_cost < _ANY_COST else _ANY_COST  # NaN allows any stretch
    stretch = 1 + (_USUAL_STRETCH - 1) * max(cost, 1e-3) / _USUAL_COST

    def make(attempt: _Attempt, side: float, tiles: dict[str, Any]) -> Map:
        largest = min(most, attempt.share * (side / attempt.density) ** 2) if tiles else most
        return unwrap(V, F, max_stretch=stretch, max_chart_area=largest if largest < math.inf else None,
                      quarter_turns=packs.rotate_charts, resolution=side, padding=attempt.padding, callback=callback,
                      **tiles)
    return _fitted(V, F, packs, make)


def _packed(V: Any, F: Any, cuts: ChartOptions, packs: PackOptions, callback: Callback | None) -> Map:
    """Packs the islands. If some overlap themselves, all are unwrapped as flat surfaces, which cuts them."""
    is_kept = True

    def make(attempt: _Attempt, side: float, tiles: dict[str, Any]) -> Map:
        nonlocal is_kept
        options: dict[str, Any] = {'quarter_turns': packs.rotate_charts, 'resolution': side, 'padding': attempt.padding,
                                   'callback': callback, **tiles}
        if is_kept:
            try:
                return unwrap(V, F, seams='uv', uv=V[:, :2], keep_shape=True, weld='no', **options)
            except UnsupportedError as error:
                if 'packing' in str(error):
                    raise
            is_kept = False
            warnings.warn('islands overlap themselves: they are divided', stacklevel=6)
        fill: dict[str, Any] = {} if tiles else {'fill': 0}
        return unwrap(V, F, weld='no', **options, **fill)
    return _fitted(V, F, packs, make)


def _density(packs: PackOptions) -> float:
    """Returns the requested texels per unit; 0: none."""
    return float(packs.texels_per_unit) if 0 < packs.texels_per_unit < math.inf else 0.0


def _fitted(V: Any, F: Any, packs: PackOptions, make: Callable[[_Attempt, float, dict[str, Any]], Map]) -> Map:
    """Returns the result of the first attempt whose charts fit."""
    density = _density(packs)
    side = float(packs.resolution or _USUAL_SIDE)
    if density > 0 and not packs.resolution:
        side = max(density * math.sqrt(_area(V, F)), 1.0)  # an atlas has at least one texel
    padding = packs.padding + (1.0 if packs.bilinear else 0.0)
    for attempt in _attempts(padding, side, density if packs.resolution else 0.0):
        tiles: dict[str, Any] = {}
        if attempt.density > 0:
            tiles = {'udim': _core.most_tiles, 'texel_density': attempt.density}
        try:
            made = make(attempt, side, tiles)
        except UnsupportedError as error:
            if 'packing' not in str(error):
                raise
            continue
        if attempt.padding < padding:
            warnings.warn(f'charts do not fit with padding: it is {attempt.padding:g} texels', stacklevel=5)
        if tiles and attempt.density < density:
            warnings.warn(f'charts do not fit: there are {attempt.density:g} texels per unit', stacklevel=5)
        return made
    raise UnsupportedError(f'no atlas of {side:g} texels holds the charts of {len(F)} faces')


@dataclasses.dataclass
class _Attempt:
    """Parameters of a packing attempt. share: upper bound on the fraction of one of several atlases for a chart."""
    padding: float
    density: float
    share: float


def _attempts(padding: float, side: float, density: float) -> Iterator[_Attempt]:
    """Yields the requested options. If charts do not fit, yields smaller charts in several atlases, then less
    padding, then a lower density."""
    padding = min(padding, 0.45 * side)
    for share in _CHART_SHARES if density > 0 else (1.0,):
        yield _Attempt(padding, density, share)
    while padding > 0:
        padding = padding / 2 if padding > 0.1 else 0.0
        yield _Attempt(padding, density, _CHART_SHARES[-1])
    while density > 0:
        density = density / 2
        yield _Attempt(0, density, _CHART_SHARES[-1])


def _area(V: Any, F: Any) -> float:
    p = V[F]
    return float(np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1).sum()) / 2


@dataclasses.dataclass
class _Layout:
    """The layout of all meshes. The rows of V and faces of a mesh begin at first_vertex and first_face."""
    file: _core.MapFile
    uv: NDArray[np.float64]
    chart_of_cell: NDArray[np.int32]
    atlas_of_chart: NDArray[np.intp]
    first_vertex: int
    first_face: int


def _output_of(mesh: _Input, is_kept: NDArray[np.bool_], layout: _Layout | None) -> _Output:
    kept = np.flatnonzero(is_kept)
    out = _Output(np.zeros(0, np.uint32), np.zeros(mesh.faces.shape, np.uint32), np.zeros((0, 2), np.float32),
                  np.zeros(0, np.uint32), np.zeros(0, np.uint32), [])
    has_cell = np.zeros(len(mesh.faces), bool)
    if layout is not None and len(kept):
        file = layout.file
        cells = np.flatnonzero((layout.first_face <= file.input_face)
                               & (file.input_face < layout.first_face + len(kept)))
        face = kept[file.input_face[cells] - layout.first_face]
        has_cell[face] = True
        points = _by_corner(file, cells, mesh.faces[face] + layout.first_vertex)
        rows = mesh.faces[face]
        if mesh.rows is not None and mesh.turned is not None:
            points[mesh.turned[face]] = points[mesh.turned[face]][:, [0, 2, 1]]
            rows = mesh.rows[face]
        span = rows.max() + 1
        keys, flat = np.unique(points * span + rows, return_inverse=True)
        out.indices[face] = flat.reshape(-1, 3)
        points = keys // span
        out.mapping = (keys % span).astype(np.uint32)
        out.uvs = layout.uv[points].astype(np.float32)
        charts, chart_of_cell = np.unique(layout.chart_of_cell[cells], return_inverse=True)
        out.chart_of_vertex = np.zeros(len(points), np.uint32)
        out.chart_of_vertex[out.indices[face]] = chart_of_cell[:, None]
        out.atlas_of_vertex = layout.atlas_of_chart[charts][out.chart_of_vertex].astype(np.uint32)
        order = np.argsort(chart_of_cell, kind='stable')
        parts = np.split(face[order], np.flatnonzero(np.diff(chart_of_cell[order])) + 1)
        materials = np.zeros(len(mesh.faces), np.uint32) if mesh.materials is None else mesh.materials
        out.charts = [Chart(np.sort(part).astype(np.uint32), int(layout.atlas_of_chart[chart]), int(materials[part[0]]))
                      for part, chart in zip(parts, charts)]
    _add_faces_without_image(mesh, np.flatnonzero(~has_cell), out)
    return out


def _by_corner(file: _core.MapFile, cells: Any, faces: Any) -> Any:
    """Returns points of cells in the order of their faces' corners: cells of turned faces have the other order."""
    points = file.cells[cells]
    same = (file.input_vertex[points] == faces).all(1)
    points[~same] = points[~same][:, [0, 2, 1]]
    if not (file.input_vertex[points] == faces).all():
        raise AssertionError('a cell has other vertices than its face')
    return points


def _add_faces_without_image(mesh: _Input, faces: Any, out: _Output) -> None:
    """Adds faces without image. Their corners get the uvs of their vertices, of another corner, or the origin."""
    if not len(faces):
        return
    corners = (mesh.faces if mesh.rows is None else mesh.rows)[faces]
    place = np.full(max(len(mesh.positions), corners.max() + 1, out.mapping.max(initial=0) + 1), -1, np.int64)
    place[out.mapping[::-1]] = np.arange(len(out.mapping))[::-1]
    missing, first = np.unique(corners[place[corners] < 0], return_index=True)
    beside = place[corners].max(1)[np.nonzero(place[corners] < 0)[0][first]]
    place[missing] = len(out.mapping) + np.arange(len(missing))
    out.indices[faces] = place[corners]
    out.mapping = np.concatenate([out.mapping, missing.astype(np.uint32)])
    origin = np.concatenate([out.uvs, np.zeros((1, 2), np.float32)])
    out.uvs = np.concatenate([out.uvs, origin[beside]])
    none = np.full(len(missing), _NO_CHART, np.uint32)
    out.chart_of_vertex = np.concatenate([out.chart_of_vertex, none])
    out.atlas_of_vertex = np.concatenate([out.atlas_of_vertex, none])
