// Flags of edges that users name by their vertices.
//
//   const std::vector<char> is_cut = flags_of_edges(*mesh, {{12, 13}, {13, 40}}, "seams.json");
#pragma once

#include <array>
#include <string>
#include <vector>

#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// Returns 3 #F flags, both sides, of the edges between these vertices of the file (from 0), with
// all copies of an edge that the surface has. Boundary edges are left out. source: for messages,
// may be empty. Throws Error(Usage) naming a pair that is no edge of the file, or that lies inside
// one of its polygons.
std::vector<char> flags_of_edges(const SurfaceMesh& mesh,
                                 const std::vector<std::array<Index, 2>>& edges,
                                 const std::string& source);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
