// Makes a cut graph shorter, one path at a time.
#pragma once

#include <vector>

#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// is_cut: 3 #F flags that cut the surface to a disk; is_terminal: #V, vertices that stay on the
// cut. A chain is a path of the cut between terminals, boundary vertices and vertices where three
// or more cuts meet. Glued along one chain the disk becomes an annulus, and any path between its
// two boundaries makes a disk of it again: the chain is replaced by the shortest one, as long as
// that costs less (edge_cost: 3 #F, positive). Where cuts and boundaries have more than 30,000
// half-edges, only paths count that begin within the chain's own cost of it. Ends where no chain
// can be replaced, or after a fixed number of sweeps. Throws Stopped.
void shorten_cut(const SurfaceMesh& mesh, const std::vector<char>& is_terminal,
                 const Vec& edge_cost, std::vector<char>& is_cut, const StopCheck& stop);

// Removes cuts that end neither at a terminal nor at the boundary.
void prune_cut(const SurfaceMesh& mesh, const std::vector<char>& is_terminal,
               std::vector<char>& is_cut);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
