// Fewer and better cones, by integer changes of the matching of a cross field.
//
// A smoothest field on a coarse mesh has cones that only reflect its triangles: pairs of opposite
// index next to each other, and vertices with more quarter turns than their faces can hold.
#pragma once

#include "majorant/parametrization/fields/internal/field_connection.h"

namespace majorant {

// Cancels cones of opposite sign on adjacent vertices, and moves cones next to the boundary into
// it; then moves quarter turns away from vertices that would have none, or triangles with a mean
// angle above 120 degrees. The matching changes on the way, the angles stay: relax afterwards.
// Edges with is_fixed faces on both sides keep their matching (#F, or empty). Throws
// Error(Infeasible) when no place is found for a quarter turn.
void optimize_cones(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                    const std::vector<char>& is_fixed, FieldConnection& field);

// Lowers energy (cone_potential.h) + cone_cost * sum |quarter_turns - 4| by moves of single quarter
// turns [FBC18]: cancels pairs of cones of opposite sign, and cones into the boundary, however far
// apart, the best first; and moves cones along edges. After optimize_cones, whose bounds it keeps.
// Takes a solve and a vector of #V for every cone: surfaces with more than 1000 are left alone.
// Relax afterwards. Throws Stopped.
void lower_cone_energy(const SurfaceMesh& mesh, const FieldGeometry& geometry, double cone_cost,
                       FieldConnection& field, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
