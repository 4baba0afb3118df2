// The motorcycle graph of a seamless map [EGKT08]: every motorcycle drives straight at unit speed
// from its cone or corner, and ends where the trail of another one, a border or a feature is in its
// way.
//
//   for (const Motorcycle& motorcycle : motorcycle_graph(lattice, stop))
//     std::cout << motorcycle.length << "\n";
//
// A line has the equation u = c or v = c in each chart, c an integer of the lattice, so all
// comparisons are exact.
#pragma once

#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/quads/internal/motorcycle_starts.h"

namespace majorant {

// Returns all lines, each ended. Throws VertexInTheWay; Error(Infeasible) where a line does not
// end; Stopped.
std::vector<Motorcycle> motorcycle_graph(const SeamlessLattice& lattice, const StopCheck& stop);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
