// Vertices on the inside of boundary edges, where a neighbour was refined and its edge was not.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// Part of the edge's length: midpoints as files have them, in seven digits.
inline constexpr double kOnEdge = 1e-6;

struct TJunction {
  Index vertex, half_edge;
  bool operator<(const TJunction& j) const { return vertex < j.vertex; }
};

// One for each such vertex, ascending: boundary vertices that are kOnEdge from a boundary edge and
// farther than that from its ends. O(n log n).
std::vector<TJunction> find_t_junctions(const SurfaceMesh& mesh, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
