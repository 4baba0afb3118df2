// Whole numbers for the arcs of a T-mesh, so that opposite sides of every patch have the same sum:
// how many edges of quads lie along each of them.
//
//   SeamlessLattice lattice(*mesh, map);
//   const TMesh t_mesh = trace_t_mesh(lattice);
//   const std::vector<double> wanted(t_mesh.arcs.size(), 2.4);   // edges on each arc
//   const std::vector<Index> n = quantize(t_mesh, wanted, std::vector<Index>(wanted.size(), 1));
//
// Rounded, then brought to agree along shortest paths from patch to patch, then improved by closed
// paths that lower sum (n - wanted)^2 / max(wanted, 1), in rounds over all arcs until one lowers
// nothing, 20 at most. Each arc lies between two patches, so a change by one goes on through a
// patch, to its opposite side or back on its own: a bi-directed flow [HWB23], which arcs of the
// border, of one patch, may start and end. Not a proven minimum.
#pragma once

#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/quads/internal/t_mesh.h"

namespace majorant {

// wanted: >= 0, least: >= 0, by arc. Throws Error(Infeasible) where no numbers were found; Stopped.
std::vector<Index> quantize(const TMesh& mesh, const std::vector<double>& wanted,
                            const std::vector<Index>& least, const StopCheck& stop = {});

// The number of quads.
long quad_count(const TMesh& mesh, const std::vector<Index>& edges);
// Of half-arcs.
Index sum_of(const std::vector<Index>& half_arcs, const std::vector<Index>& edges);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
