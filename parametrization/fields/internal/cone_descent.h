// Moves and cancels cones of a field without followed edges as long as
//     cone_energy + cone_cost * sum |quarter_turns - 4|
// falls (CrossFieldOptions; the energies: cone_potential.h), by moves of single quarter turns
// [FBC18].
#pragma once

#include "majorant/parametrization/fields/internal/field_connection.h"

namespace majorant {

// Cancels pairs of cones of opposite sign and moves cones into the boundary, however far apart, the
// best first; then moves cones along edges. Runs after optimize_cones() and keeps its bounds. Needs
// one or two solves and a vector of #V for every cone, so surfaces with more than 1000 cones are
// left unchanged. The field must be relaxed afterwards. Throws Stopped.
void lower_cone_energy(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                       const CrossFieldOptions& options, FieldConnection& field);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
