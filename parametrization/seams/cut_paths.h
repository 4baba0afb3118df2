// Straightness of cuts, and a function that makes them straighter.
//
//   const CutTurning turning = turning_of_cuts(*mesh, is_cut);
//   smooth_cuts(*mesh, {}, Vec::Ones(mesh->half_edge_count()), is_cut);
//
// A path runs between two nodes: places where cuts meet or end, or whose angle defect is large.
#pragma once

#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// The sum of the angles between successive edges over the length, in degrees per mean edge of the
// surface: of the cuts, and of the shortest edge path next to each path.
struct CutTurning {
  double cuts = 0, shortest = 0;
};
CutTurning turning_of_cuts(const SurfaceMesh& mesh, const std::vector<char>& is_cut);

// Replaces paths by nearby ones between the same ends that turn less and cost hardly more. The
// vertices `through` are ends too. cost: 3 #F, positive. is_cut: 3 #F flags, both sides. The pieces
// may change where cuts end near others. Stopped.
void smooth_cuts(const SurfaceMesh& mesh, const std::vector<Index>& through, const Vec& cost,
                 std::vector<char>& is_cut, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
