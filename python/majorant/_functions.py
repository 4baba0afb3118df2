# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Functions from meshes to maps."""
from __future__ import annotations

import json
import os
import warnings
from typing import Any, Callable, Mapping

import numpy as np
from numpy.typing import ArrayLike

from . import _arrays, _core, _options
from ._cells import cell, table
from ._errors import UsageError
from ._maps import Map
from ._types import Callback, Doubles, Energy, Faces, Points



def flatten(V: ArrayLike, F: Faces, **options: Any) -> Doubles:
    """Flattens a surface with little distortion. Returns uv of every row of V, (#V, 2).

        uv = majorant.flatten(V, F)

    V: (#V, 3) vertices, or (#V, 2). F: (#F, 3) triangles, or polygons; counterclockwise. The surface
    is one piece with at least one boundary loop and no handles; it may have holes. It is proven that no
    triangle is turned over. Rows of V that no face uses lie at the first corner of the first face.
    options: those of `parametrize` except for the degree, which is 1.

    Not for closed surfaces, handles, several pieces or defects: they raise UnsupportedError; use `unwrap`,
    which cuts them into charts. For the map itself use `parametrize`.
    """
    if 'degree' in options and options['degree'] != 1:
        raise UsageError('flatten has degree 1; parametrize makes curved maps')
    options['degree'] = 1
    return parametrize(V, F, **options).uv


def parametrize(V: ArrayLike, F: Faces, *, degree: int = 3, energy: Energy = 'symmetric-dirichlet',
                bijective: bool = False, boundary: str = 'free', pins: Points | None = None,
                handles: Points | None = None, soft: float = _options.SOFT, weights: ArrayLike | None = None,
                init: str = 'auto', uv: ArrayLike | None = None, seamless: bool = False,
                boundary_angles: bool = False, improve_mesh: bool = False,
                curvature: str = 'projected', elevation: str = 'incremental', effort: str = 'normal',
                quadrature: int = 0, tolerance: float = _options.TOLERANCE,
                max_iterations: int = _options.MAX_ITERATIONS, time_limit: float | None = None, threads: int = 0,
                callback: Callback | None = None) -> Map:
    """Maps a disk, with or without holes, onto the plane with locally minimal distortion. Returns a `Map`.

        r = majorant.parametrize(V, F, degree=3, energy='arap', bijective=True)
        r.evaluate(12, [0.2, 0.3, 0.5])
        r.save('bunny.vtu')

    Problem:
      V, F            as for `flatten`
      degree          of the polynomial on every face, 1 .. 8
      energy          a name (`energies()`), a sum such as 'symmetric-dirichlet + 0.1*asap', a `Density`,
                      or a list of (energy, weight)
      bijective       whether overlaps are excluded, too
      boundary        'free', or 'fixed' at its positions in the start
      pins            {vertex: (u, v)}, held exactly; None for (u, v): the position in the start
      handles, soft   {vertex: (u, v)}, pulled by the term soft * sum |uv - target|^2 / area
      weights         (#F,) positive factors of the energy
      boundary_angles whether the sum of angles at each boundary vertex is at most 360 degrees
    Start:
      init            'auto', 'tutte', 'multiresolution', or 'input': from uv
      uv              (#V, 2), or (#F, 3, 2) by corner; only for init='input' and seamless
      seamless        whether the seams of uv are kept, up to quarter turns; for any surface
    Method:
      curvature, elevation, effort, quadrature, improve_mesh
                      as the flags of the command, see docs/interface.md
      threads         0: all. Results do not depend on it
    Limits:
      tolerance       fraction of the energy that may remain above the minimum (docs/interface.md, Tolerance)
      max_iterations, time_limit (seconds)
                      limits at which the best map so far is returned; `status` tells which
      callback        called with a `Step` after every step; a true return value ends the run like an
                      interruption, and an exception is raised again

    Raises UnsupportedError for other meshes, InfeasibleError if there is no valid start or no injective way
    to the pins, InvalidError if the result cannot be proven, KeyboardInterrupt on Ctrl-C.
    """
    arguments = {k: v for k, v in locals().items() if k not in ('V', 'F')}
    mesh = _arrays.mesh(V, F, uv)
    if (init == 'input' or seamless is True) and uv is None:
        raise UsageError(f'{"seamless" if seamless else "init=" + repr(init)} needs uv')
    if uv is not None and init != 'input' and seamless is not True:
        raise UsageError("uv is for init='input' or seamless=True; say one of them, or leave it out")
    if seamless is True and init not in ('auto', 'input'):
        raise UsageError(f'seamless starts from uv; leave out init={init!r}')
    return _solve(_core.parametrize, mesh, arguments)


def seamless(V: ArrayLike, F: Faces, *, degree: int = 3, energy: Energy = 'symmetric-dirichlet',
             cones: Mapping[int, int] | None = None, start: str = 'automatic',
             curvature_alignment: float = 0, bijective: bool = False, pins: Points | None = None,
             handles: Points | None = None, soft: float = _options.SOFT, weights: ArrayLike | None = None,
             curvature: str = 'projected', elevation: str = 'incremental', quadrature: int = 0,
             tolerance: float = _options.TOLERANCE, max_iterations: int = _options.MAX_ITERATIONS,
             time_limit: float | None = None, threads: int = 0, callback: Callback | None = None) -> Map:
    """Computes a seamless map with cones of any connected surface, for quadrangulation and fields.

        r = majorant.seamless(V, F, degree=1)
        r.cones                              # {vertex: quarter turns}

    The surface is cut open. Across the cut the two images agree up to a quarter turn and a translation, to
    the last bits. cones: {vertex: quarter turns around it}; None: those of a smooth cross field. start
    ('automatic', 'field', 'scaled-field', 'conformal') and curvature_alignment: as the flags of the command.
    Other arguments as for `parametrize`.
    """
    arguments = {k: v for k, v in locals().items() if k not in ('V', 'F')}
    mesh = _arrays.mesh(V, F)
    if cones is not None and curvature_alignment:
        raise UsageError('curvature_alignment is of the field that finds cones; leave out cones or it')
    extra = {
        'cones': None if cones is None else _options.cones(cones, len(mesh.positions)),
        'start': _options.choice('start', start, ('automatic', 'field', 'scaled-field', 'conformal')),
        'curvature_alignment': _options.number('curvature_alignment', curvature_alignment, 0,
                                               _options.LARGEST, zero=True),
    }
    arguments['seamless'] = True
    return _solve(_core.seamless, mesh, arguments, extra)


def unwrap(V: ArrayLike, F: Faces, *, seams: str | ArrayLike = 'auto', max_stretch: float | None = None,
           degree: int = 1, energy: Energy = 'symmetric-dirichlet', uv: ArrayLike | None = None, pack: bool = True,
           padding: float | None = None, resolution: float | None = None,
           scale: str | None = None, normalize: bool = False,
           weld: str | float = 'auto', keep_seams: bool = False, charts: str | int | None = None,
           fill: float | None = None, hide_from: ArrayLike | None = None, objects: ArrayLike | None = None,
           preset: str | None = None, upright: str = 'no', udim: int | None = None,
           texel_density: float | ArrayLike | None = None, stack: str = 'no', keep_shape: bool = False,
           groups: bool = False, strict: bool = False, max_chart_area: float | None = None, quarter_turns: bool = True,
           pins: Points | None = None,
           handles: Points | None = None, soft: float = _options.SOFT, weights: ArrayLike | None = None,
           curvature: str = 'projected', elevation: str = 'incremental', quadrature: int = 0,
           tolerance: float = _options.TOLERANCE, max_iterations: int = _options.MAX_ITERATIONS,
           time_limit: float | None = None, threads: int = 0, callback: Callback | None = None) -> Map:
    """Unwraps any mesh - closed, with handles, in pieces, with defects - into charts that do not overlap.

        r = majorant.unwrap(V, F, padding=8)
        r.corner_uv                          # (#F, 3, 2), in the unit square
        r.charts                             # (#F,)

    Cuts:
      seams           'auto', chosen by the distortion that they save; 'uv', around the islands of uv; 'sharp' or
                      'sharp=40', along edges of at least so many degrees; or (#E, 2) vertices of edges
      uv              texture coordinates for seams='uv' and keep_seams, (#V, 2) or (#F, corners, 2)
      keep_seams      whether the surface is also cut along the borders of the islands of uv
      max_stretch     L2 stretch that no chart of 'auto' and 'sharp' exceeds; with charts='one': the estimated
                      stretch up to which a surface is not cut
      charts          a number of charts, or 'one'; with seams 'auto' and 'sharp'
      fill            charts are divided until they fill this fraction of the square, or nothing is gained; None:
                      0.5 if that takes little seam; 0: none are divided. With seams 'auto' and 'sharp'
      max_chart_area  surface area from which on charts of 'auto' and 'sharp' are divided
      hide_from       direction (3,) to a viewer that seams are hidden from
      weld            'auto', joins edges at equal positions (with seams 'uv' and edges only if no face shares a
                      vertex); 'no'; or a distance within which vertices become one
      strict          whether meshes that need repair are refused (UnsupportedError)
      objects         (#F,) numbers of objects, each of which is unwrapped alone into the unit square; saved as
                      .obj, with an `o` for each, or .vtu; `report` then has a list `objects`
    Placement:
      pack            whether charts are packed into one square
      padding         least distance of charts and of the border, pixels; None: 4
      resolution      pixels on a side of the square; None: 1024
      preset          'paint', 'lightmap', 'game' or 'single': defaults of max_stretch, charts, fill, padding and
                      resolution
      upright         axis of the mesh, 'x', 'y' or 'z', that points upwards in every chart; 'no'
      udim            upper bound on the number of tiles, which have one density
      texel_density   pixels per unit of V: a number, or (#F,) numbers, between which the surface is cut
      stack           'equal': charts of congruent surfaces share a place; 'mirrored': those of mirror images, too;
                      `check(..., stacked=True)` proves it
      keep_shape      whether the islands of uv are only moved and turned; with seams='uv'
      quarter_turns   whether straight charts may be turned by quarters to fit
      groups          whether a saved .obj has a group for each chart
      scale           'unit', the default: the square is the unit square, and energies are those at the size of V;
                      'model', the default with pins or handles: uv has the units of V
      normalize       True is scale='unit'

    callback is called after every step of charts with some thousand faces. Smaller charts are solved in parallel,
    and it is called after the last of them. If it ends the run before the charts are packed, StoppedError is raised.
    Other arguments as for `parametrize`.
    """
    arguments = {k: v for k, v in locals().items() if k not in ('V', 'F')}
    mesh = _arrays.mesh(V, F, uv)
    if normalize is True and (pins or handles):
        raise UsageError('normalize moves pins and handles; leave one of the two out')
    if normalize is True and scale == 'model':
        raise UsageError("normalize is scale='unit'; leave one of the two out")
    if scale == 'unit' and (pins or handles):
        raise UsageError("scale='unit' moves pins and handles; leave one of the two out")
    _options.truth('normalize', normalize)
    if scale is None:
        scale = 'model' if pins or handles else 'unit'
    by_uv = isinstance(seams, str) and seams == 'uv'
    if uv is not None and not _options.truth('keep_seams', keep_seams) and not by_uv:
        raise UsageError("uv is for seams='uv' and keep_seams; say one of them, or leave it out")
    if keep_seams and (uv is None or by_uv):
        raise UsageError("keep_seams cuts along the seams of uv, as seams='uv' does; give uv, and other seams")
    if pack is False and not (padding is None and resolution is None):
        raise UsageError('padding and resolution are for packing; leave them out, or pack=False')
    if max_stretch is not None and not isinstance(seams, str):
        raise UsageError("max_stretch is of seams 'auto' and 'sharp'; leave it or the edges out")
    if objects is not None:
        _require_objects(arguments, seams, weld, scale)
    has_charts, has_fill = charts is not None, fill is not None
    divides = isinstance(seams, str) and not by_uv
    _require_placeable(arguments, by_uv)
    if preset is not None:
        defaults = _core.presets[_options.choice('preset', preset, tuple(_core.presets))]
        padding = defaults['padding'] if padding is None and pack is not False else padding
        resolution = defaults['resolution'] if resolution is None and pack is not False else resolution
        if divides:
            max_stretch = defaults['max_stretch'] if max_stretch is None else max_stretch
            charts = defaults['charts'] if not has_charts else charts
            if not has_fill and charts == 'auto' and pack is not False and not _has_own_sizes(arguments):
                fill = defaults['fill']
    charts = 'auto' if charts is None else charts
    padding = _options.PADDING if padding is None else padding
    resolution = _options.RESOLUTION if resolution is None else resolution
    counted = isinstance(charts, int) and not isinstance(charts, bool)
    if (counted or fill is not None or hide_from is not None) and (by_uv or not isinstance(seams, str)):
        raise UsageError("numbers of charts, fill and hide_from are of seams 'auto' and 'sharp'; leave them or the "
                         'seams out')
    if max_chart_area is not None and (by_uv or not isinstance(seams, str)):
        raise UsageError("max_chart_area is of seams 'auto' and 'sharp'; leave it or the seams out")
    if quarter_turns is not True and pack is False:
        raise UsageError('quarter_turns is for packing; leave it out, or pack=False')
    if fill is not None and (charts == 'one' or pack is False):
        raise UsageError("fill divides charts that are packed; leave it out, or charts='one' and pack=False")
    if fill is not None and counted:
        raise UsageError('fill and charts both say how far charts are divided; leave one of the two out')
    padding = _options.number('padding', padding, 0, zero=True)
    resolution = _options.number('resolution', resolution, 0)
    if pack is not False and 2 * padding >= resolution:
        raise UsageError(f'padding={padding:g} is too large: twice this leaves nothing of the {resolution:g} pixels of resolution; '
                         'lower the one or raise the other')
    arguments.update(max_stretch=max_stretch, charts=charts, fill=fill, padding=padding, resolution=resolution)
    # The command lacks these options. Reports and files name them only if they differ from their defaults.
    for name, usual in (('max_chart_area', None), ('quarter_turns', True)):
        if arguments[name] is usual:
            del arguments[name]
    extra = {
        **_cuts(seams, uv, len(mesh.positions)),
        'max_stretch': None if max_stretch is None else _options.number('max_stretch', max_stretch, 1),
        'pack': _options.truth('pack', pack),
        'padding': padding,
        'resolution': resolution,
        'upright': _options.choice('upright', upright, ('no', 'x', 'y', 'z')),
        'udim': 0 if udim is None else _options.integer('udim', udim, 1, _core.most_tiles),
        'texel_density': None if texel_density is None else _densities(texel_density, len(mesh.polygons[1]) - 1),
        'stack': _options.choice('stack', stack, ('no', 'equal', 'mirrored')),
        'keep_shape': keep_shape,
        'groups': _options.truth('groups', groups),
        'max_chart_area': None if max_chart_area is None else _options.number('max_chart_area', max_chart_area, 0),
        'quarter_turns': _options.truth('quarter_turns', quarter_turns),
        'scale': _options.choice('scale', scale, ('unit', 'model')),
        'weld_distance': None if weld in ('auto', 'no') else _options.number('weld', weld, 0, zero=True),
        'welds_nothing': weld == 'no',
        'keep_seams': keep_seams,
        'one_chart': not counted and _options.choice('charts', charts, ('auto', 'one')) == 'one',
        'least_charts': _options.integer('charts', charts, 1, 2**31 - 1) if counted else 0,
        'hide_from': None if hide_from is None else _direction(hide_from),
        'least_fill': None if fill is None else _fill(fill),
        'strict': _options.truth('strict', strict),
        'objects': None if objects is None else _arrays.integers(
            'objects', objects, (len(mesh.polygons[1]) - 1,), 2**31 - 1, 'numbers of objects').tolist(),
    }
    return _solve(_core.unwrap, mesh, arguments, extra)


def _require_objects(arguments: dict[str, Any], seams: Any, weld: Any, scale: str) -> None:
    """Raises UsageError for options that refer to rows of V and F or to one square."""
    for name in ('pins', 'handles', 'weights'):
        if arguments[name] is not None and len(arguments[name]) > 0:
            raise UsageError(f'objects are unwrapped one by one: not with {name}; leave one of the two out')
    if not isinstance(seams, str) or weld not in ('auto', 'no'):
        raise UsageError('objects are unwrapped one by one: not with edges as seams, or a distance of weld')
    if arguments['degree'] != 1 or arguments['pack'] is False or scale != 'unit':
        raise UsageError("objects fill the unit square each: not with degree above 1, pack=False or scale='model'")


def _has_own_sizes(arguments: dict[str, Any]) -> bool:
    return arguments['udim'] is not None or arguments['texel_density'] is not None or arguments['stack'] != 'no'


def _require_placeable(arguments: dict[str, Any], by_uv: bool) -> None:
    """Raises UsageError for combinations of chart options that the command refuses, too."""
    held = bool(arguments['pins']) or bool(arguments['handles'])
    tiled = next((name for name in ('udim', 'texel_density') if arguments[name] is not None), None)
    placed = [name for name in ('udim', 'texel_density') if arguments[name] is not None]
    placed += [name for name in ('stack', 'upright') if arguments[name] != 'no']
    keeps = _options.truth('keep_shape', arguments['keep_shape'])
    placed += ['keep_shape'] if keeps else []
    if placed and arguments['pack'] is False:
        raise UsageError(f'{placed[0]} is for packing; leave it out, or pack=False')
    if tiled and (arguments['scale'] == 'model' or held):
        raise UsageError(f"{tiled} says how large the layout is, as scale='model', pins and handles do; leave one of "
                         'the two out')
    if arguments['objects'] is not None and (tiled or arguments['stack'] != 'no'):
        raise UsageError(f'objects have the unit square each: not with {tiled or "stack"}; leave one of the two out')
    if arguments['objects'] is not None and arguments['groups'] is True:
        raise UsageError('groups are of one layout; leave out objects or groups')
    if arguments['fill'] is not None and _has_own_sizes(arguments):
        raise UsageError('fill divides charts of one scale on one square: not with udim, texel_density and stack; leave '
                         'one of the two out')
    if arguments['stack'] != 'no' and (held or arguments['degree'] != 1 or keeps):
        raise UsageError('stack moves straight charts onto others: not with pins, handles, degree or keep_shape; leave '
                         'one of the two out')
    if keeps and not by_uv:
        raise UsageError("keep_shape is of the islands of uv; give uv and seams='uv'")
    if keeps and (held or arguments['degree'] != 1 or np.ndim(arguments['texel_density']) > 0):
        raise UsageError('keep_shape maps nothing anew, at one scale: leave out pins, handles, degree and densities of '
                         'faces')


def _densities(density: Any, faces: int) -> list[float]:
    if np.ndim(density) == 0:
        return [_options.number('texel_density', density, 0)] * faces
    array = _arrays.floats('texel_density', density, (faces,))
    if not (array > 0).all():
        raise UsageError('texel_density has numbers that are not positive')
    return array.tolist()


def _fill(fill: float) -> float:
    part = _options.number('fill', fill, 0, 1, zero=True)
    if part == 1:
        raise UsageError(f'fill={fill!r} is not a number of at least 0 and below 1')
    return part


def _direction(hide_from: ArrayLike) -> list[float]:
    direction = _arrays.floats('hide_from', hide_from, (3,))
    if not direction.any():
        raise UsageError('hide_from is no direction: 0, 0, 0')
    return [float(x) for x in direction]


def deform(V: ArrayLike, F: Faces, *, handles: Points | None = None, pins: Points | None = None,
           degree: int = 3, energy: Energy = 'symmetric-dirichlet', bijective: bool = False,
           soft: float = _options.SOFT, weights: ArrayLike | None = None, curvature: str = 'projected',
           elevation: str = 'incremental', quadrature: int = 0, tolerance: float = _options.TOLERANCE,
           max_iterations: int = _options.MAX_ITERATIONS, time_limit: float | None = None, threads: int = 0,
           callback: Callback | None = None) -> Map:
    """Deforms a planar mesh by moving some of its points, with locally minimal distortion. Returns a `Map`.

        r = majorant.deform(V, F, handles={0: (0, 0), 30: (1, 1)}, bijective=True)

    V: (#V, 2), or (#V, 3) in a plane z = const. handles are pulled, pins are held. Other arguments as for
    `parametrize`.
    """
    arguments = {k: v for k, v in locals().items() if k not in ('V', 'F')}
    if not handles and not pins:
        raise UsageError('nothing to do: give handles (soft) or pins (hard)')
    return _solve(_core.deform, _arrays.mesh(V, F), arguments)


class Verdict:
    """The result of `check`. It is true if the map is valid.

    status: 'valid', 'invalid' or 'undecided'. findings: sentences, empty if the map is valid. proofs: {question:
    {'answer', 'detail'}}. report: the report of `majorant check --report`.
    """

    def __init__(self, report: dict[str, Any]):
        self.report = report
        self.status: str = report['status']
        self.findings: list[str] = report['result']['findings']
        self.proofs: dict[str, dict[str, str]] = report['result'].get('proofs', {})

    def __bool__(self) -> bool:
        return self.status == 'valid'

    def _repr_html_(self) -> str:
        """Returns the findings and a row for each proof, for notebooks."""
        rows = [(question, proof['answer'], proof['detail']) for question, proof in self.proofs.items()]
        return cell(repr(self), table(('question', 'answer', 'detail'), rows) if rows else '')

    def __repr__(self) -> str:
        return f'<majorant.Verdict: {"; ".join([self.status, *self.findings])}>'


def check(result: Map | str | os.PathLike, V: ArrayLike | None = None, F: Faces | None = None, *, cuts: str = 'auto',
          certify: bool = False, seamless: bool = False, stacked: bool = False,
          time_limit: float | None = None) -> Verdict:
    """Judges a map from its control points alone, as `majorant check` does.

        verdict = majorant.check('bunny.vtu', V, F, certify=True)
        if not verdict: print(verdict.findings)

    result: a Map, or a file. V, F: the mesh that the map must belong to. cuts: 'none', inner edges whose sides
    differ are violations; 'free', they are counted; 'auto', they are violations unless the file claims cuts, and
    counted if it claims nothing. certify: whether to prove that nothing overlaps, too. seamless: whether the map
    must be seamless; its seams are not cuts. stacked: whether charts may lie exactly on others, corner by corner,
    also mirrored; implied if the file claims `stacks`. time_limit: seconds after which open questions are
    'undecided'.
    """
    if (V is None) != (F is None):
        raise UsageError('V and F go together')
    surface = None if V is None else _arrays.mesh(V, F)
    name: str | bytes
    if isinstance(result, Map):
        name, file = 'map.vtu', result._file
    else:
        name = _arrays.path(result)
        file = _core.read_map(name)[0]
    arguments = _options.choice('cuts', cuts, ('auto', 'none', 'free'))
    limit = float('inf') if time_limit is None else _options.number('time_limit', time_limit, 0, zero=True, infinite=True)
    return Verdict(json.loads(_core.check_map(name, file, surface, arguments, _options.truth('certify', certify),
                                              _options.truth('seamless', seamless),
                                              _options.truth('stacked', stacked), limit)))


def read(path: str | os.PathLike) -> Map:
    """Reads a map from .vtu, .msh, or from .obj, .ply, .glb and .gltf with texture coordinates.

    Claims of the file are not tested; use `check`. Raises ReadError naming the place.
    """
    file, mesh, request = _core.read_map(_arrays.path(path))
    _warn(file.warnings)
    return Map(file, mesh, request, False, 'read', f'read from {os.fspath(path)}', 'null')


def read_mesh(path: str | os.PathLike) -> tuple[Doubles, Any]:
    """Reads V and F of a mesh from .obj .off .ply .stl .glb .gltf .vtu .msh, also .gz.

    F is an array if all faces have equally many corners, otherwise a list of arrays. Defects of other data, such as
    texture coordinates, normals, colours or a surplus line, only leave these out, with a UserWarning. Defects of
    positions or faces raise ReadError.
    """
    mesh = _core.read_mesh(_arrays.path(path))
    _warn(mesh.warnings)
    corners, starts = mesh.polygons
    sizes = np.diff(starts)
    if len(sizes) and (sizes == sizes[0]).all():
        return mesh.positions, corners.reshape(-1, sizes[0])
    return mesh.positions, np.split(corners, starts[1:-1])


def _warn(sentences: list[str]) -> None:
    for sentence in sentences:
        warnings.warn(sentence, stacklevel=3)


def energies() -> dict[str, str]:
    """Returns the named energies with their descriptions."""
    return dict(_core.energies())


def kernels() -> dict[str, str]:
    """Returns the vector instructions of the kernels, and the kernels of OpenBLAS if it is loaded
    ('' otherwise; OPENBLAS_CORETYPE chooses them). Runs repeat bit for bit if both are equal."""
    return {'vector_instructions': _core.vector_instructions(), 'openblas': _core.blas_kernels()}


def _solve(solver: Callable[..., tuple], mesh: _core.Mesh, arguments: dict[str, Any],
           extra: dict[str, Any] | None = None) -> Map:
    callback = _options.callback(arguments.pop('callback'))
    return Map(*solver(mesh, {**_options.keywords(mesh, arguments), **(extra or {})}, callback))


def _cuts(seams: Any, uv: Any, vertices: int) -> dict[str, Any]:
    if not isinstance(seams, str):
        edges = _arrays.integers('seams', seams, (None, 2), vertices, 'vertices')
        return {'cut_method': 'edges', 'cut_edges': edges.tolist()}
    word, equals, angle = seams.partition('=')
    if word == 'sharp':
        degrees = _options.number('seams', angle, 0, 180) if equals else None
        return {'cut_method': 'sharp', 'sharp_angle': degrees}
    _options.choice('seams', seams, ('auto', 'uv', 'sharp', 'sharp=DEGREES'))
    if seams == 'uv' and uv is None:
        raise UsageError("seams='uv' needs uv")
    return {'cut_method': seams}
