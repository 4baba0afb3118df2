// The triangles of a file in any state, and the gluing of their sides.
#pragma once

#include <vector>

#include "majorant/mesh/connectivity.h"
#include "majorant/mesh/index_lists.h"

namespace majorant {

// The triangles as the file has them; half-edges are those of surface_mesh.h. All references must
// outlive it.
struct GivenTriangles {
  const Cells& faces;  // #F by 3 vertices
  const std::vector<Vector3>& positions;
  const std::vector<Index>& polygon;  // by triangle
  const IndexLists& polygons;         // vertices of each
  // By vertex, the first vertex at its position: edges between equal positions may be joined.
  // Empty: vertices are compared by number alone.
  const std::vector<Index>& first_at_place;

  Index face_count() const { return static_cast<Index>(faces.rows()); }
  Index half_edge_count() const { return 3 * face_count(); }
  Index from(Index h) const { return from_vertex(faces, h); }
  Index to(Index h) const { return to_vertex(faces, h); }
  Index place(Index v) const { return first_at_place.empty() ? v : first_at_place[v]; }
  double length(Index h) const { return (positions[to(h)] - positions[from(h)]).norm(); }
  // Returns whether the two sides of an edge run in opposite directions.
  bool agree(Index h, Index o) const {
    return from(h) == to(o) || (from(h) != from(o) && place(from(h)) == place(to(o)));
  }
};

// The glued pairs of sides.
struct GluedSides {
  std::vector<Index> opposite;  // by half-edge, in either direction; -1: open
  std::vector<Index> joined;    // a side of each edge that was joined by position

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
