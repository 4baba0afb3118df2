// Continuous piecewise polynomial maps: a Bezier triangle of degree n on every face of a mesh.
//
// Control points are shared by the faces around a vertex or an edge, so every assignment of
// positions is a C0 map; cuts are edges of the mesh that faces do not share. Nodes are numbered:
// vertices, then edges (n-1 each, from the smaller to the larger vertex), then faces. [MC20]
// Sec. 4.
#pragma once

#include "majorant/elements/bernstein_space.h"

namespace majorant {

using LatticeNumbering = NodeNumbering;
// Shared numbering of the points (i,j,k)/n of every face: vertices keep their numbers, then edges,
// then face interiors; local order is VTK's. Any n >= 1. Throws InvalidArgument when an edge
// has more than two faces.
LatticeNumbering number_lattice(const Cells& faces, Index vertex_count, int n);

class BezierTriangleSpace final : public BernsteinSpace {
 public:
  // Of all maps; chosen, not tuned.
  static constexpr int kMaxDegree = 8;

  // faces: #F by 3 vertex numbers, counterclockwise, consistently oriented and edge-manifold;
  // vertices 0..vertex_count-1. Throws InvalidArgument when degree is not 1..8, for other
  // vertex numbers, or when an edge has more than two faces.
  BezierTriangleSpace(const Cells& faces, Index vertex_count, int degree);

  // Faces whose nodes the caller has numbered (#F by (n+1)(n+2)/2, the corners first): part of a
  // larger numbering, say that of a map and the space around it. Its vertices are not the first
  // nodes: not for what says "vertex" of a space. Throws InvalidArgument for another number
  // of columns.
  BezierTriangleSpace(NodeNumbering numbering, int degree);

  const Cells& faces() const { return faces_; }

  // Control points of the same map in `higher`, a space of degree + 1 over the same faces.
  // x: 2 numbers per node.
  Vec elevate(VecIn x, const BezierTriangleSpace& higher) const;

 private:
  Cells faces_;
};

// Nodes of the space along a half-edge, from its start to its end: degree + 1 of them. Half-edge
// 3 f + k runs from corner k of face f to its corner k + 1 (mod 3), as in mesh/surface_mesh.h.
std::vector<Index> edge_nodes(const BezierTriangleSpace& space, Index half_edge);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
