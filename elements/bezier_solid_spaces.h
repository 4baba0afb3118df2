// Spaces of Bezier hexahedra and wedges: products of segments, and of a triangle and a segment.
//
//   Cells cells(1, 8);
//   cells << 0, 1, 3, 2, 4, 5, 7, 6;
//   RowMatrix vertices(8, 3);
//   for (Index v = 0; v < 8; ++v) vertices.row(v) << v % 2, v / 2 % 2, v / 4;
//   const BezierHexahedronSpace space(cells, 8, 2);                     // of degree 2
//   const RowMatrix start = space.node_positions(vertices);             // trilinear, a row a node
//
// Nodes are numbered: vertices, edges, faces, interiors. Tetrahedra, and cells of the plane:
// bernstein_space.h.
#pragma once

#include "majorant/elements/bernstein_space.h"

namespace majorant {

// Bernstein polynomials of degree n in each of r, s, t in [0, 1] on every hexahedron. det J has
// degree 3n-1 in each.
class BezierHexahedronSpace final : public BernsteinSpace {
 public:
  // det J has 1728 coefficients then; chosen, not tuned.
  static constexpr int kMaxDegree = 4;

  // cells: #E by 8 vertex numbers: (r,s,t) = (0,0,0), (1,0,0), (1,1,0), (0,1,0), then the same at
  // t = 1. Nodes of a cell are in VTK's order (of 9.1 and later); quadrature points are (r, s, t),
  // which are the reference coordinates. Throws InvalidArgument when degree is not 1..4, for
  // vertex numbers outside 0..vertex_count-1 and when a face has more than two cells.
  BezierHexahedronSpace(const Cells& cells, Index vertex_count, int degree);
};

// Bernstein polynomials of degree n on the triangle times those of degree n in t in [0, 1], on
// every wedge. det J has degree 3n-2 on the triangle and 3n-1 in t.
class BezierWedgeSpace final : public BernsteinSpace {
 public:
  static constexpr int kMaxDegree = BezierHexahedronSpace::kMaxDegree;

  // cells: #E by 6 vertex numbers: corners 0, 1, 2 of the triangle at t = 0, then at t = 1;
  // det(p1 - p0, p2 - p0, p3 - p0) > 0, also the reference coordinates. Nodes of a cell are in
  // VTK's order; quadrature points are the barycentric ones of the triangle, then t. Throws
  // InvalidArgument when degree is not 1..4, for vertex numbers outside 0..vertex_count-1 and when
  // a face has more than two cells.
  BezierWedgeSpace(const Cells& cells, Index vertex_count, int degree);
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
