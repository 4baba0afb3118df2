// The motorcycle graph of a seamless map [EGKT08]: every motorcycle drives straight at unit speed
// from its cone or corner, up to the trail of another one, a border or a feature.
//
//   for (const Motorcycle& motorcycle : motorcycle_graph(lattice, stop))
//     std::cout << motorcycle.length << "\n";
//
// A line has the equation u = c or v = c in each chart, with an integer c of the lattice, so that
// all comparisons are exact.
#pragma once

#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/quads/internal/motorcycle_starts.h"

namespace majorant {

// Returns all lines, each with its end. Throws VertexInTheWay; Error(Infeasible) if a line does not
// end; Stopped.
std::vector<Motorcycle> motorcycle_graph(const SeamlessLattice& lattice, const StopCheck& stop);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
