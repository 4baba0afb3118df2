// Charts between sharp edges.
//
//   const std::vector<char> is_cut = sharp_charts(*mesh, 40);
#pragma once

#include <vector>

#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// Returns 3 #F flags, both sides, of the edges between charts: parts of the surface that are
// enclosed by edges with a dihedral angle above `angle` (degrees). Creases that end inside a chart
// enclose nothing and are not cut. Charts are joined, the smallest first, each with the neighbour
// along the longest common border, until none is a single face and a component of n faces has at
// most 2 + n / 200. They may have any topology.
std::vector<char> sharp_charts(const SurfaceMesh& mesh, double angle);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
