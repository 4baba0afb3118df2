// The division of a chart into two connected parts.
//
//   const Vec cost = cut_costs(*mesh, {});
//   is_cut = border_of_two_parts(*mesh, cost, PartsAround::Planes, {});
#pragma once

#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/parametrization/seams/choose_cuts.h"

namespace majorant {

// Returns 3 #F flags, both sides, of the edges between the parts. cost: 3 #F, of edges. Stopped.
std::vector<char> border_of_two_parts(const SurfaceMesh& chart, const Vec& cost,
                                      PartsAround centres, const StopCheck& stop);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
