// How straight cuts run.
//
//   const CutTurning turning = turning_of_cuts(*mesh, is_cut);
//   smooth_cuts(*mesh, {}, Vec::Ones(mesh->half_edge_count()), is_cut);
//
// A path runs from one place where cuts meet or end, or that is far from flat, to the next.
#pragma once

#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// The sum of the angles between successive edges over the length, in degrees per mean edge of the
// surface: of the cuts, and of the shortest path of edges beside each of their paths.
struct CutTurning {
  double cuts = 0, shortest = 0;
};
CutTurning turning_of_cuts(const SurfaceMesh& mesh, const std::vector<char>& is_cut);

// Replaces paths by ones nearby between the same ends, of which these vertices are some, that turn
// less and cost hardly more. cost: 3 #F, positive; is_cut: 3 #F flags, both sides. Where cuts end
// near others the pieces may be other ones. Stopped.
void smooth_cuts(const SurfaceMesh& mesh, const std::vector<Index>& through, const Vec& cost,
                 std::vector<char>& is_cut, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
