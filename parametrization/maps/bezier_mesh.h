// A mesh of Bezier triangles in the plane that may change its triangulation: what edge flips and
// scaffolds work on.
//
// Every face keeps all its control points; points on an edge are kept by both of its faces and are
// equal, so the mesh is continuous. Problems are made from it by numbering shared points once
// (BezierTriangleSpace); this is the form for the time in between.
#pragma once

#include <vector>

#include "majorant/elements/bernstein_space.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

struct BezierMesh {
  int degree = 1;
  Cells faces;                  // #F by 3 vertices, counterclockwise
  std::vector<Index> opposite;  // 3 #F, as opposite_half_edges() has it
  RowMatrix
      points;  // #F by (n+1)(n+2): u, v of the control points in VTK's order (TriangleIndices)

  Index face_count() const { return static_cast<Index>(faces.rows()); }
  Vector2 point(Index face, int local) const { return points.row(face).segment<2>(2 * local); }
  Index from_vertex(Index half_edge) const { return majorant::from_vertex(faces, half_edge); }
  Index to_vertex(Index half_edge) const { return majorant::to_vertex(faces, half_edge); }
};

// faces: #F by 3, consistently oriented; cells: #F by nodes of a face, x: 2 numbers per node.
// Throws InvalidArgument when an edge has more than two faces.
BezierMesh bezier_mesh(int degree, const Cells& faces, const Cells& cells, VecIn x);

// Flips of edges that a criterion asked for, each time it was tried, and those that were done.
struct FlipCounts {
  long intended = 0, performed = 0;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
