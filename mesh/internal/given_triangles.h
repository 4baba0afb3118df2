// The triangles of a file in any state, and which of their sides are glued to each other.
#pragma once

#include <vector>

#include "majorant/mesh/connectivity.h"
#include "majorant/mesh/index_lists.h"

namespace majorant {

// Triangles as the file has them; half-edges are those of surface_mesh.h. What it refers to
// outlives it.
struct GivenTriangles {
  const Cells& faces;  // #F by 3 vertices
  const std::vector<Vector3>& positions;
  const std::vector<Index>& polygon;  // by triangle
  const IndexLists& polygons;         // vertices of each
  // By vertex, the first vertex where it is: edges between equal places may be joined. Empty: every
  // vertex is a place of its own.
  const std::vector<Index>& first_at_place;

  Index face_count() const { return static_cast<Index>(faces.rows()); }
  Index half_edge_count() const { return 3 * face_count(); }
  Index from(Index h) const { return from_vertex(faces, h); }
  Index to(Index h) const { return to_vertex(faces, h); }
  Index place(Index v) const { return first_at_place.empty() ? v : first_at_place[v]; }
  double length(Index h) const { return (positions[to(h)] - positions[from(h)]).norm(); }
  // Returns whether the two sides of an edge run against each other.
  bool agree(Index h, Index o) const {
    return from(h) == to(o) || (from(h) != from(o) && place(from(h)) == place(to(o)));
  }
};

// The pairs of sides that are glued.
struct GluedSides {
  std::vector<Index> opposite;  // by half-edge, whichever way both run; -1: open
  std::vector<Index> joined;    // a side of each edge that was joined by more than its vertices

  void join(Index h, Index o) {
    opposite[h] = o;
    opposite[o] = h;
    joined.push_back(h);
  }
  void open(Index h) {
    if (opposite[h] >= 0) opposite[opposite[h]] = -1;
    opposite[h] = -1;
  }
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
