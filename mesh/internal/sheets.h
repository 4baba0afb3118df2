// Turns triangles in any state into sheets: surfaces that are edge- and vertex-manifold and
// oriented. Edges that cannot be glued stay open, by the rules of repair.h.
#pragma once

#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/internal/given_triangles.h"
#include "majorant/mesh/repair.h"

namespace majorant {

struct Sheets {
  Cells faces;                  // #F by 3 vertices of the sheets; turned ones have corners 0, 2, 1
  std::vector<Index> vertex;    // the given vertex of each: first those in use, ascending, then
                                // copies
  std::vector<char> is_turned;  // #F
  // Half-edges and faces of the given triangles; one half-edge for an edge.
  std::vector<Index> repeated, duplicates, turned;  // faces
  std::vector<Index> split_edges, cut_edges;        // half-edges
  Index one_sided = 0;                              // components that were cut because they have
                                                    // one side
  // The given vertices, ascending, where sheets merely touch, without those copied because of an
  // edge or a face above.
  std::vector<Index> split_vertices;
  Index pieces_given = 0;  // connected across edges between the same vertices
};

// Throws Stopped.
Sheets make_sheets(const GivenTriangles& triangles, Orientation orientation,
                   CrowdedEdges crowded_edges, const StopCheck& stop);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
