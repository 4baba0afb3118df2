# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Plots of layouts in matplotlib, which only this file needs."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._errors import UsageError
from ._options import QUANTITIES, choice
from ._types import Doubles

if TYPE_CHECKING:
    from ._maps import Map

# Straight pieces of a curved edge, enough for smooth edges of degree 8 on a page.
_PIECES = 12
_EDGES, _OUTLINE = 0.3, 1.0  # widths of lines, points
_CHART_COLORS = 'Set3'
_TURNED_OVER = '#d600be'  # kFlippedColor of pictures/color_scale.h


def edge_curves(map: 'Map') -> Doubles:
    """Returns points on edges 01, 12, 20 of all faces in the layout, (#F, 3, pieces + 1, 2)."""
    t = np.linspace(0, 1, 2 if map.degree == 1 else _PIECES + 1)
    unit = np.eye(3)
    bary = np.stack([(1 - t)[:, None] * unit[i] + t[:, None] * unit[(i + 1) % 3] for i in range(3)])
    return map.evaluate(np.arange(len(map.cells))[:, None, None], bary)


def outer_edges(map: 'Map') -> tuple[np.ndarray, np.ndarray]:
    """Returns two (#F, 3) flags: edges on the boundary of the surface, and edges where the map is cut."""
    def counts(corners: np.ndarray) -> np.ndarray:
        ends = np.sort(np.stack([corners, np.roll(corners, -1, axis=1)], axis=-1), axis=-1)
        _, number, count = np.unique(ends.reshape(-1, 2), axis=0, return_inverse=True, return_counts=True)
        return count[number.ravel()].reshape(-1, 3)

    is_outer, is_boundary = counts(map.cells[:, :3]) == 1, counts(map.faces) == 1
    return is_boundary, is_outer & ~is_boundary


def joined(curves: Doubles, ends: np.ndarray) -> list[Doubles]:
    """Joins consecutive curves, (#E, #, 2), to longer ones, open ones first. ends: (#E, 2), the points from which
    and to which each curve runs."""
    leaving: dict[int, list[int]] = {}
    for edge, (start, _) in enumerate(ends.tolist()):
        leaving.setdefault(start, []).append(edge)
    arrived = set(ends[:, 1].tolist())
    paths: list[Doubles] = []
    for first in sorted(leaving, key=lambda start: start in arrived):
        while leaving[first]:
            parts: list[Doubles] = []
            at = first
            while leaving.get(at):
                edge = leaving[at].pop()
                parts.append(curves[edge] if not parts else curves[edge][1:])
                at = int(ends[edge, 1])
            paths.append(np.concatenate(parts))
    return paths


def density_norm(scale: Any, low: float, high: float) -> Any:
    """Returns the norm of densities (pictures/color_scale.h), from 0 at low to 1 at high."""
    from matplotlib.colors import FuncNorm
    neutral, unit = scale[1], scale[3]
    # There are no densities below isometry; the logarithm is continued by its tangent.
    def forward(v: Any) -> Any:
        x = (np.asarray(v, dtype=float) - neutral) / unit
        return np.where(x < 0, x, np.log1p(np.maximum(x, 0)))

    def inverse(t: Any) -> Any:
        t = np.asarray(t, dtype=float)
        return neutral + unit * np.where(t < 0, t, np.expm1(np.maximum(t, 0)))
    return FuncNorm((forward, inverse), vmin=low, vmax=high)


def diverging_norm(low: float, high: float, vmin: float, vmax: float) -> Any:
    """Returns the norm of values on both sides of 1, from 0 at low to 1 at high, with 0.5 at 1."""
    from matplotlib.colors import FuncNorm

    def forward(v: Any) -> Any:
        x = np.log(np.maximum(np.asarray(v, dtype=float), np.finfo(float).tiny))
        return np.where(x < 0, -x / np.log(low), x / np.log(high))

    def inverse(t: Any) -> Any:
        t = np.asarray(t, dtype=float)
        return np.exp(np.where(t < 0, -t * np.log(low), t * np.log(high)))
    return FuncNorm((forward, inverse), vmin=vmin, vmax=vmax)


def _values_of(map: 'Map', values: Any) -> tuple[Any, Any]:
    """Returns the numbers that colour the faces, None for charts or no colours; and their scale, None for the range
    of the numbers."""
    if values is None:
        values = 'charts' if map.charts.any() or not len(map.distortion) else 'density'
    elif not isinstance(values, str):
        numbers = np.asarray(values, dtype=float)
        if numbers.shape != (len(map.cells),):
            raise UsageError(f'values has shape {numbers.shape}, not ({len(map.cells)},)')
        is_density = np.array_equal(numbers, map.distortion)
        return numbers, _core.quantity_scale(map._file, 'density') if is_density else None
    if choice('values', values, ('charts', *QUANTITIES)) == 'charts':
        return None, None
    if values != 'density':
        return _core.mean_quantity(map._file, values), _core.quantity_scale(map._file, values)
    if not len(map.distortion):
        raise UsageError("values='density': no density was measured, since the energy has no name; 'area' always is")
    return np.asarray(map.distortion, dtype=float), _core.quantity_scale(map._file, 'density')


def _turned(curves: Doubles, direction: tuple[float, float]) -> Doubles:
    c, s = direction
    return curves @ np.array([[c, -s], [s, c]])


def plot(map: 'Map', ax: Any, values: Any, cmap: Any, vmin: float | None, vmax: float | None, linewidth: float | None,
         edges: bool, align: bool) -> Any:
    try:
        import matplotlib.pyplot as plt
        from matplotlib.collections import LineCollection, PolyCollection
        from matplotlib.colors import ListedColormap
    except ImportError:
        raise UsageError('plot needs matplotlib; svg() and save("map.svg") do not') from None
    ax = plt.gca() if ax is None else ax
    curves = edge_curves(map)
    if align:
        curves = _turned(curves, _core.layout_direction(map._file))
    outlines = curves[:, :, :-1].reshape(len(curves), -1, 2)
    # Without edges, lines in the colour of the face close gaps between faces.
    look = {'edgecolors': '0.35' if edges else 'face', 'linewidths': _EDGES if linewidth is None else linewidth}
    faces = PolyCollection(outlines, **look)
    over = _core.turned_over_cells(map._file)
    numbers, scale = _values_of(map, values)
    if numbers is None and map.charts.any():
        faces.set_facecolor(plt.get_cmap(_CHART_COLORS)(map.charts % plt.get_cmap(_CHART_COLORS).N))
    elif numbers is None:
        faces.set_facecolor('0.9')
    else:
        is_over = np.zeros(len(curves), dtype=bool)
        is_over[over] = True
        faces.set_array(np.ma.masked_array(numbers, is_over | ~np.isfinite(numbers)))
        if scale is None or cmap is not None:
            faces.set_cmap(cmap or 'viridis')
            faces.set_clim(vmin, vmax)
        else:
            low, high = scale[0] if vmin is None else vmin, scale[2] if vmax is None else vmax
            faces.set_cmap(ListedColormap(scale[4], name='majorant'))
            faces.set_norm(diverging_norm(scale[0], scale[2], low, high) if scale[5] else density_norm(scale, low, high))
    ax.add_collection(faces)
    if len(over):
        label = f'{len(over)} triangle{"" if len(over) == 1 else "s"} turned over'
        ax.add_collection(PolyCollection(outlines[over], facecolors=_TURNED_OVER, label=label, **look))
    ends = np.stack([map.cells[:, :3], np.roll(map.cells[:, :3], -1, axis=1)], axis=-1)
    for label, chosen, color in zip(('boundary', 'seams'), outer_edges(map), ('black', 'tab:red')):
        if chosen.any():
            ax.add_collection(LineCollection(joined(curves[chosen], ends[chosen]), colors=color,
                                             linewidths=_OUTLINE if linewidth is None else linewidth,
                                             capstyle='round', joinstyle='round', label=label))
    ax.set_aspect('equal')
    ax.autoscale_view()
    return ax
