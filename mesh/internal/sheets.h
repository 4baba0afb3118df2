// Triangles in any state -> sheets: surfaces that are edge- and vertex-manifold and oriented. What
// cannot be glued is left open; repair.h has the rules.
#pragma once

#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/internal/given_triangles.h"
#include "majorant/mesh/repair.h"

namespace majorant {

struct Sheets {
  Cells faces;                  // #F by 3 vertices of the sheets; turned ones have corners 0, 2, 1
  std::vector<Index> vertex;    // the given vertex of each: those in use, ascending, then copies
  std::vector<char> is_turned;  // #F
  // Half-edges and faces of the triangles as they were given; one half-edge for an edge.
  std::vector<Index> repeated, duplicates, turned;  // faces
  std::vector<Index> split_edges, cut_edges;        // half-edges
  Index one_sided = 0;                              // components that were cut for that
  // Given vertices, ascending, where sheets merely touch: not those that have copies because of an
  // edge or a face above.
  std::vector<Index> split_vertices;
  Index pieces_given = 0;  // that hang together across edges between the same vertices
};

// Throws Stopped.
Sheets make_sheets(const GivenTriangles& triangles, Orientation orientation,
                   CrowdedEdges crowded_edges, const StopCheck& stop);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
