// Makes a cut graph shorter, one path at a time.
#pragma once

#include <vector>

#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// is_cut: 3 #F flags that cut the surface to a disk; is_terminal: #V, vertices that stay on the
// cut. A chain is a path of the cut between terminals, boundary vertices and vertices where three
// or more cuts meet. Gluing the disk along a chain makes an annulus, and any path between the two
// boundaries of the annulus cuts it to a disk again. So a chain is replaced by the shortest such
// path if that costs less (edge_cost: 3 #F, positive). Ends when no chain can be replaced, or after
// a fixed number of sweeps. Throws Stopped.
void shorten_cut(const SurfaceMesh& mesh, const std::vector<char>& is_terminal,
                 const Vec& edge_cost, std::vector<char>& is_cut, const StopCheck& stop);

// Removes cuts that end neither at a terminal nor at the boundary.
void prune_cut(const SurfaceMesh& mesh, const std::vector<char>& is_terminal,
               std::vector<char>& is_cut);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
