# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Piecewise polynomial maps in numpy: derivatives, distortion, kinks, and pictures.

  image = curved.read('map.vtu')
  density, area = curved.symmetric_dirichlet(image, 12)

Files are read by the reader of tests/checker, which shares no code with the library. Polynomials are evaluated by
their definition, also independently.

Sample run:
  /usr/bin/python3 -c 'import curved; print(curved.read("map.vtu").degree)'     (imported, not run)
"""
import sys
from collections import defaultdict
from math import factorial

import numpy as np

import experiment

sys.path.append(str(experiment.ROOT / 'tests/checker'))
import bernstein  # noqa: E402
import result_map  # noqa: E402


class Map:
    """A map. degree; points: corners of the triangles in space (#F by 3 by 3); uv: control points (#F by #P by 2)
    in VTK's order; frame: derivatives of barycentric coordinates in each triangle's plane (#F by 3 by 2); area: #F."""

    def __init__(self, degree, points, uv):
        self.degree, self.points, self.uv = degree, points, uv
        a, b = points[:, 1] - points[:, 0], points[:, 2] - points[:, 0]
        x = a / np.linalg.norm(a, axis=1)[:, None]
        normal = np.cross(a, b)
        self.area = np.linalg.norm(normal, axis=1) / 2
        y = np.cross(normal, x) / (2 * self.area)[:, None]
        self.axes = np.stack([x, y], 1)
        edges = np.stack([np.einsum('fkx,fx->fk', self.axes, e) for e in (a, b)], 2)
        inverse = np.linalg.inv(edges)
        self.frame = np.stack([-inverse.sum(1), inverse[:, 0], inverse[:, 1]], 1)

    def values(self, points):
        """Returns uv (#F by #points by 2) at barycentric points (#points by 3)."""
        return np.einsum('lp,fpc->flc', basis(self.degree, points), self.uv)

    def jacobians(self, points):
        """Returns Jacobians (#F by #points by 2 by 2), with rows u and v and the triangle's axes as columns."""
        slopes = np.stack([basis_slopes(self.degree, points, corner) for corner in range(3)], 2)
        return np.einsum('lpk,fpc,fkx->flcx', slopes, self.uv, self.frame)


def basis(degree, points):
    """Returns Bernstein polynomials (#points by #P), in VTK's order."""
    exponents = np.array(bernstein.vtk_order(degree))
    factor = [factorial(degree) / np.prod([factorial(e) for e in row]) for row in exponents]
    return np.prod(points[:, None, :] ** exponents[None], 2) * factor


def basis_slopes(degree, points, corner):
    """Returns the derivatives of the Bernstein polynomials by one barycentric coordinate."""
    lower = {tuple(e): k for k, e in enumerate(bernstein.vtk_order(degree - 1))}
    below, out = basis(degree - 1, points), np.zeros((len(points), len(bernstein.vtk_order(degree))))
    for k, exponents in enumerate(bernstein.vtk_order(degree)):
        if exponents[corner] > 0:
            less = tuple(e - (c == corner) for c, e in enumerate(exponents))
            out[:, k] = degree * below[:, lower[less]]
    return out


def read(path):
    found = result_map.read_result(str(path))
    positions = np.array(found.positions)
    return Map(found.degree, positions[np.array([cell.corners for cell in found.cells])],
               np.array([cell.uv for cell in found.cells]))


def lattice(m):
    """Returns the centroids of the upright triangles of the m-fold subdivision."""
    corners = [(a, b, m - 1 - a - b) for a in range(m) for b in range(m - a)]
    return (np.array(corners) + 1 / 3) / m


def symmetric_dirichlet(image, m):
    """Returns (density, fraction of the surface's area) at all lattice points of all triangles."""
    jacobians = image.jacobians(lattice(m))
    squares = (jacobians ** 2).sum((2, 3))
    density = squares * (1 + 1 / np.linalg.det(jacobians) ** 2)
    share = np.repeat(image.area / image.area.sum(), density.shape[1]) / density.shape[1]
    return density.ravel(), share


# ------------------------------------------------------------------ edges
def inner_edges(image):
    """Returns pairs ((triangle, side), (triangle, side)); side s runs from corner s to the next. Sides are matched
    by position, also across seams."""
    sides = defaultdict(list)
    for f, corners in enumerate(image.points.tolist()):
        for s in range(3):
            sides[tuple(sorted([tuple(corners[s]), tuple(corners[(s + 1) % 3])]))].append((f, s))
    return [pair for pair in sides.values() if len(pair) == 2]


def kinks(image):
    """Returns (degrees, lengths): the angle by which the image of a straight line turns where it crosses an inner
    edge at a right angle at its midpoint. Both sides are measured against the edge, whose image has one direction up
    to the rotation of a seam."""
    turned, lengths = [], []
    for (f, s), (g, t) in inner_edges(image):
        turned.append(abs(np.degrees(crossing(image, f, s) - crossing(image, g, t))))
        lengths.append(np.linalg.norm(image.points[f, s] - image.points[f, (s + 1) % 3]))
    return np.array(turned), np.array(lengths)


def touching(image, places):
    """Returns flags of inner edges both of whose triangles have a corner at one of these positions (tuples)."""
    touched = [any(tuple(corner) in places for corner in corners) for corners in image.points.tolist()]
    return np.array([touched[f] and touched[g] for (f, _), (g, _) in inner_edges(image)])


def crossing(image, face, side):
    """Returns the angle in the image from the side to the inward line through its midpoint."""
    middle = np.zeros((1, 3))
    middle[0, [side, (side + 1) % 3]] = 0.5
    slopes = np.stack([basis_slopes(image.degree, middle, corner) for corner in range(3)], 2)
    jacobian = np.einsum('lpk,pc,kx->cx', slopes, image.uv[face], image.frame[face])
    along = image.axes[face] @ (image.points[face, (side + 1) % 3] - image.points[face, side])
    across = np.array([-along[1], along[0]])
    a, b = jacobian @ along, jacobian @ across
    return np.arctan2(a[0] * b[1] - a[1] * b[0], a @ b)


def root_mean_square(degrees, lengths):
    return float(np.sqrt((degrees ** 2 * lengths).sum() / lengths.sum()))


# ------------------------------------------------------------------ pictures
def outlines(image, pieces, box):
    """Returns all edges that touch the box (u from, to, v from, to; None: all) as one polyline with gaps."""
    s = np.linspace(0, 1, (pieces if image.degree > 1 else 1) + 1)
    lines, seen = [], set()
    for side in range(3):
        points = np.zeros((len(s), 3))
        points[:, side], points[:, (side + 1) % 3] = 1 - s, s
        for line in image.values(points):
            ends = tuple(sorted(map(tuple, line[[0, -1]].tolist())))
            if ends not in seen and touches(line, box):
                seen.add(ends)
                lines.append(line)
    return joined(lines)


def grid_lines(image, spacing, pieces=8):
    """Returns the images of the lines x = const and y = const of a planar mesh, by triangle (#L by #P by 2)."""
    ends = []                                      # (triangle, barycentric ends)
    for f, corners in enumerate(image.points[:, :, :2] / spacing):
        for axis in (0, 1):
            heights = corners[:, axis]
            for level in range(int(np.ceil(heights.min())), int(np.floor(heights.max())) + 1):
                cuts = [cut(heights, side, level) for side in range(3)]
                cuts = [c for c in cuts if c is not None]
                if len(cuts) == 2:
                    ends.append((f, cuts))
    faces = np.array([f for f, _ in ends])
    cuts = np.array([cuts for _, cuts in ends])
    s = np.linspace(0, 1, pieces + 1)[None, :, None]
    points = (1 - s) * cuts[:, :1] + s * cuts[:, 1:]
    weights = basis(image.degree, points.reshape(-1, 3)).reshape(*points.shape[:2], -1)
    return np.einsum('lkp,lpc->lkc', weights, image.uv[faces])


def cut(heights, side, level):
    """Returns barycentric coordinates of the point of this height on a side, or None."""
    a, b = heights[side], heights[(side + 1) % 3]
    if (a < level) == (b < level):
        return None
    point = np.zeros(3)
    point[side], point[(side + 1) % 3] = (b - level) / (b - a), (level - a) / (b - a)
    return point


def joined(lines):
    """Returns the polylines as one, with gaps."""
    gap = np.full((1, 2), np.nan)
    return np.concatenate([part for line in lines for part in (line, gap)]).T


def touches(line, box):
    return box is None or (line.min(0) <= [box[1], box[3]]).all() and (line.max(0) >= [box[0], box[2]]).all()


def draw_layout(axis, image, colour, width=0.4, box=None, pieces=3):
    axis.plot(*outlines(image, pieces, box), color=colour, linewidth=width, solid_joinstyle='round')
    axis.set_aspect('equal')
    axis.set_axis_off()


def picture(image, rotation, spacing, size):
    """Returns a picture of the surface with lines of constant u and v, seen from z = +inf after a rotation (3 by 3): an
    array (size by size by 3) of 0 to 1."""
    wide = 2 * size
    points = image.points @ rotation.T
    low, high = points.reshape(-1, 3).min(0), points.reshape(-1, 3).max(0)
    scale = 0.96 * wide / (high - low)[:2].max()
    screen = (points - (low + high) / 2) * scale + [wide / 2, wide / 2, 0]
    colours, depth = np.ones((wide, wide, 3)), np.full((wide, wide), -np.inf)
    for f, corners in enumerate(screen):
        normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
        x0, y0 = np.floor(corners[:, :2].min(0)).astype(int)
        x1, y1 = np.ceil(corners[:, :2].max(0)).astype(int) + 1
        if normal[2] <= 0:
            continue
        x, y = np.meshgrid(np.arange(x0, x1) + 0.5, np.arange(y0, y1) + 0.5)
        weights = np.stack([((corners[i - 2, 0] - x) * (corners[i - 1, 1] - y) -
                             (corners[i - 2, 1] - y) * (corners[i - 1, 0] - x)) / normal[2]
                            for i in range(3)], -1)
        z = weights @ corners[:, 2]
        seen = (weights >= 0).all(-1) & (z > depth[y0:y1, x0:x1])
        depth[y0:y1, x0:x1][seen] = z[seen]
        uv = basis(image.degree, weights[seen]) @ image.uv[f] / spacing
        line = (abs(uv - np.rint(uv)) < 0.08).any(1)
        light = 0.45 + 0.55 * normal[2] / np.linalg.norm(normal)
        colours[y0:y1, x0:x1][seen] = np.where(line[:, None], (0.10, 0.25, 0.45), (0.93, 0.92, 0.88)) * light
    return colours[::-1].reshape(size, 2, size, 2, 3).mean((1, 3))
