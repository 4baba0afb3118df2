// Continuous piecewise polynomial maps of space: a Bezier tetrahedron of degree n on every cell.
//
//   Cells cells(1, 4);
//   cells << 0, 1, 2, 3;
//   RowMatrix vertices = RowMatrix::Random(4, 3);
//   BezierTetrahedronSpace space(cells, 4, 2);
//   RowMatrix start = space.node_positions(vertices);     // the identity, one row per node
//
// Nodes are numbered: vertices, edges, faces, interiors. det J has degree 3(n-1).
#pragma once

#include "majorant/elements/bernstein_space.h"

namespace majorant {

class BezierTetrahedronSpace final : public BernsteinSpace {
 public:
  // det J has degree 15 then, as on squares of degree 8; chosen, not tuned.
  static constexpr int kMaxDegree = 6;

  // cells: #E by 4 vertex numbers, positively oriented: det(p1 - p0, p2 - p0, p3 - p0) > 0, also
  // the reference coordinates. Nodes of a cell are in VTK's order; quadrature points barycentric.
  // Throws InvalidArgument when degree is not 1..6, for vertex numbers outside
  // 0..vertex_count-1 and when a face has more than two cells.
  BezierTetrahedronSpace(const Cells& cells, Index vertex_count, int degree);
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
