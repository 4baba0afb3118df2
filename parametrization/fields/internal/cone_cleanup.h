// Fewer and feasible cones, by integer changes of the matching of a cross field.
//
// The smoothest field on a coarse mesh has cones that only reflect its triangles: pairs of opposite
// index next to each other, and vertices with more quarter turns than their faces can hold. A move
// passes one quarter turn along an edge (quarter_turn_graph.h). Moves are made while they lower
//     sum |turns - regular turns|,
// then until every node is within its bounds.
#pragma once

#include <vector>

#include "majorant/parametrization/fields/internal/aligned_edges.h"
#include "majorant/parametrization/fields/internal/field_connection.h"

namespace majorant {

// Cancels cones of opposite sign on adjacent vertices, and moves cones next to the boundary into
// it; then moves quarter turns away from vertices that would have too few, or triangles with a mean
// angle above 120 degrees. Sectors are brought to the turns of the surface's angles, where that
// lets cones go, and to one at least. The matching changes, the angles stay: relax afterwards.
// Arguments are those of QuarterTurnGraph. Throws Error(Infeasible) when no place is found for a
// quarter turn.
void optimize_cones(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                    const std::vector<char>& is_fixed, AlignedSectors sectors, int least_turns,
                    FieldConnection& field);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
