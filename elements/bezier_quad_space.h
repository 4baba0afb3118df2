// Continuous piecewise polynomial maps of tensor-product patches: Bernstein polynomials of degree n
// in each of s, t in [0, 1] on every quadrilateral.
//
//   Cells cells(1, 4);
//   cells << 0, 1, 2, 3;
//   RowMatrix vertices(4, 2);
//   vertices << 0, 0, 1, 0, 0, 1, 1, 1;
//   BezierQuadSpace space(cells, 4, 1);                   // bilinear
//   RestShapes rest = curved_shapes(space, space.node_positions(vertices), tensor_gauss_rule(3));
//
// Nodes are numbered: vertices, edges, interiors. det J has degree 2n-1 in s and in t.
#pragma once

#include "majorant/elements/bezier_triangle_space.h"

namespace majorant {

class BezierQuadSpace final : public BernsteinSpace {
 public:
  static constexpr int kMaxDegree = BezierTriangleSpace::kMaxDegree;

  // cells: #E by 4 vertex numbers, counterclockwise: (s,t) = (0,0), (1,0), (1,1), (0,1). Nodes of a
  // cell are in VTK's order; quadrature points are (s, t), which are the reference coordinates.
  // Throws InvalidArgument when degree is not 1..8, for vertex numbers outside
  // 0..vertex_count-1 and when an edge has more than two cells.
  BezierQuadSpace(const Cells& cells, Index vertex_count, int degree);
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
