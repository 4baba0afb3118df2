// Removes the edges of a mesh that have no length.
#pragma once

#include <array>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/index_lists.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

// The mesh without these edges, and the origin of its parts in the input. All members are empty if
// there are no such edges.
struct CollapsedEdges {
  std::vector<std::array<Index, 2>> edges;  // merged pairs of vertices, ascending
  PolygonMesh mesh;
  std::vector<Index> vertex;   // by vertex of the input: the first vertex merged with it
  std::vector<Index> polygon;  // by remaining polygon: its number in the input
  IndexLists corners;          // the numbers of its corners in the input
};

// Collapses edges as ShortEdges::Collapsed (repair.h) says. Throws Stopped.
CollapsedEdges collapse_short_edges(const PolygonMesh& input, const StopCheck& stop);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
