// One chart of a connected surface, opened where that saves distortion.
#pragma once

#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

struct AutomaticCut {
  std::vector<char> is_cut;  // 3 #F, both sides: one planar piece
  double strain = 0;         // flattening_strain.h
  std::vector<Index> ends;   // vertices inside the surface where it ends
};

// The rule is that of docs/atlas.md, "Where to cut". edge_cost: 3 #F; is_whole: #V, where
// it is not led on purpose; max_stretch: above 1. Stopped.
AutomaticCut automatic_cut(const SurfaceMesh& mesh, const Vec& edge_cost,
                           const std::vector<char>& is_whole, double max_stretch,
                           const StopCheck& stop);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
