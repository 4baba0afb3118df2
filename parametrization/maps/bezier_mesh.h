// A mesh of Bezier triangles in the plane that may change its triangulation: what edge flips and
// scaffolds work on.
//
// Every face keeps all its control points; points on an edge are kept by both of its faces and are
// equal, so the mesh is continuous. Problems are made from it by numbering shared points once
// (BezierTriangleSpace); this is the form for the time in between.
#pragma once

#include <vector>

#include "majorant/elements/bernstein_basis.h"

namespace majorant {

struct BezierMesh {
  int degree = 1;
  Cells faces;                  // #F by 3 vertices, counterclockwise
  std::vector<Index> opposite;  // 3 #F: half-edge 3 f + k runs from corner k to k + 1; -1: boundary
  RowMatrix
      points;  // #F by (n+1)(n+2): u, v of the control points in VTK's order (TriangleIndices)

  Index face_count() const { return static_cast<Index>(faces.rows()); }
  Vector2 point(Index face, int local) const { return points.row(face).segment<2>(2 * local); }
  Index from_vertex(Index half_edge) const { return faces(half_edge / 3, half_edge % 3); }
  Index to_vertex(Index half_edge) const { return faces(half_edge / 3, (half_edge + 1) % 3); }
};

// faces: #F by 3, consistently oriented; cells: #F by nodes of a face, x: 2 numbers per node.
// Throws std::invalid_argument when an edge has more than two faces.
BezierMesh bezier_mesh(int degree, const Cells& faces, const Cells& cells, VecIn x);

// Opposite half-edges of oriented faces, -1 at the boundary. Throws std::invalid_argument when an
// edge has more than two faces or two that run the same way.
std::vector<Index> opposite_half_edges(const Cells& faces);

}  // namespace majorant
