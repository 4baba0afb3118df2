// A mesh without the edges that have no length.
#pragma once

#include <array>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/index_lists.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

// The mesh, and where its parts are in the one that had the edges. Without such edges all is empty.
struct CollapsedEdges {
  std::vector<std::array<Index, 2>> edges;  // pairs of vertices that are one now, ascending
  PolygonMesh mesh;
  std::vector<Index> vertex;   // by vertex of the input: the first of those that it is one with
  std::vector<Index> polygon;  // by polygon that is left: its number in the input
  IndexLists corners;          // and the numbers of its corners there
};

// Collapses edges as ShortEdges::Collapsed (repair.h) says. Throws Stopped.
CollapsedEdges collapse_short_edges(const PolygonMesh& input, const StopCheck& stop);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
