# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Layouts in matplotlib, which is needed here alone."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ._errors import UsageError
from ._types import Doubles

if TYPE_CHECKING:
    from ._maps import Map

# Straight pieces of a curved edge: those of degree 8 still look smooth on a page.
_PIECES = 12
_CHART_COLORS = 'Set3'


def edge_curves(map: 'Map') -> Doubles:
    """(#F, 3, pieces + 1, 2): edges 01, 12, 20 of all faces, as they are in the layout."""
    t = np.linspace(0, 1, 2 if map.degree == 1 else _PIECES + 1)
    unit = np.eye(3)
    bary = np.stack([(1 - t)[:, None] * unit[i] + t[:, None] * unit[(i + 1) % 3] for i in range(3)])
    return map.evaluate(np.arange(len(map.cells))[:, None, None], bary)


def outer_edges(map: 'Map') -> tuple[np.ndarray, np.ndarray]:
    """(#F, 3) truth values: the boundary of the surface, and edges where the map is cut."""
    def counts(corners: np.ndarray) -> np.ndarray:
        ends = np.sort(np.stack([corners, np.roll(corners, -1, axis=1)], axis=-1), axis=-1)
        _, number, count = np.unique(ends.reshape(-1, 2), axis=0, return_inverse=True, return_counts=True)
        return count[number.ravel()].reshape(-1, 3)

    is_outer, is_boundary = counts(map.cells[:, :3]) == 1, counts(map.faces) == 1
    return is_boundary, is_outer & ~is_boundary


def plot(map: 'Map', ax: Any, values: Any, cmap: str) -> Any:
    try:
        import matplotlib.pyplot as plt
        from matplotlib.collections import LineCollection, PolyCollection
    except ImportError:
        raise UsageError('plot needs matplotlib; svg() and save("map.svg") do not') from None
    ax = plt.gca() if ax is None else ax
    curves = edge_curves(map)
    faces = PolyCollection(curves[:, :, :-1].reshape(len(curves), -1, 2), edgecolors='0.35', linewidths=0.3)
    if values is None and map.charts.any():
        faces.set_facecolor(plt.get_cmap(_CHART_COLORS)(map.charts % plt.get_cmap(_CHART_COLORS).N))
    elif values is None and not len(map.distortion):
        faces.set_facecolor('0.9')
    else:
        numbers = np.asarray(map.distortion if values is None else values, dtype=float)
        if numbers.shape != (len(curves),):
            raise UsageError(f'values has shape {numbers.shape}, not ({len(curves)},)')
        faces.set_array(numbers)
        faces.set_cmap(cmap)
    ax.add_collection(faces)
    for label, chosen, color in zip(('boundary', 'seams'), outer_edges(map), ('black', 'tab:red')):
        if chosen.any():
            ax.add_collection(LineCollection(list(curves[chosen]), colors=color, linewidths=1, label=label))
    ax.set_aspect('equal')
    ax.autoscale_view()
    return ax
