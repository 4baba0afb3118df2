// The smoothest cross field with given cones [CDS10], on surfaces with any handles and boundaries.
#pragma once

#include "majorant/parametrization/fields/internal/field_connection.h"

namespace majorant {

// Returns the field of least sum weight rotation^2, in which face 0 has angle 0. quarter_turns: #V,
// 0 at the boundary; 4 - quarter_turns adds up to 4 chi on closed surfaces.
FieldConnection trivial_connection(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                                   const std::vector<int>& quarter_turns);

// Relaxes a field, then changes its turning around handles and boundary loops by multiples of 90
// degrees as long as sum weight rotation^2 falls. Cones stay.
void relax_and_round_turning(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                             FieldConnection& field);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
