// Lengths and counts of the cuts of a surface.
#pragma once

#include <vector>

#include "majorant/mesh/surface_mesh.h"
#include "majorant/parametrization/seams/choose_cuts.h"

namespace majorant {

// Sets the lengths, edges and pieces of cuts from their flags. requested: 3 #F flags of the cuts
// that a rule names; the others count as added. components: the faces of each.
void add_totals(const SurfaceMesh& mesh, const std::vector<char>& requested,
                const std::vector<std::vector<Index>>& components, SurfaceCuts& cuts);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
