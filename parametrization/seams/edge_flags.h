// Edges that users name by their vertices, as flags of a surface.
//
//   const std::vector<char> is_cut = flags_of_edges(*mesh, {{12, 13}, {13, 40}}, "seams.json");
#pragma once

#include <array>
#include <string>
#include <vector>

#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// 3 #F flags, both sides, of the edges between these vertices of the file (from 0); all copies of
// an edge where the surface has several. Edges of the boundary are left out. source: for messages,
// may be empty. Throws Error(Usage) naming a pair that is no edge of the file, or that runs inside
// one of its polygons.
std::vector<char> flags_of_edges(const SurfaceMesh& mesh,
                                 const std::vector<std::array<Index, 2>>& edges,
                                 const std::string& source);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
