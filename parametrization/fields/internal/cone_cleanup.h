// Fewer and feasible cones, by integer changes of the matching of a cross field.
//
// The smoothest field on a coarse mesh has cones that only reflect its triangles: adjacent pairs of
// opposite index, and vertices with more quarter turns than their faces can hold. A move passes one
// quarter turn along an edge (quarter_turn_graph.h). Moves are made while they lower
//     sum |turns - regular turns|,
// then until every node is within its bounds.
#pragma once

#include <vector>

#include "majorant/parametrization/fields/internal/aligned_edges.h"
#include "majorant/parametrization/fields/internal/field_connection.h"

namespace majorant {

// Cancels cones of opposite sign on adjacent vertices, and moves cones next to the boundary into
// it. Then moves quarter turns away from vertices with too few of them, or with a mean angle of
// triangles above 120 degrees. Sectors get the turns of the surface's angles if that removes cones,
// and at least one.
//
// The matching changes but the angles stay, so the field must be relaxed afterwards. Arguments are
// those of QuarterTurnGraph. Throws Error(Infeasible) if no vertex can take a quarter turn.
void optimize_cones(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                    const std::vector<char>& is_fixed, AlignedSectors sectors, int least_turns,
                    FieldConnection& field);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
