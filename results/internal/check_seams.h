// What `check` demands of the claims of maps with seams: cones, marks and cuts are those that were
// claimed or given. That the seams fit is proven elsewhere (certify/map_proof.h).
#pragma once

#include "majorant/results/internal/check_claims.h"

namespace majorant {

// Whether the cut of the map should be that of the texture coordinates of the surface: results of
// `parametrize --seamless`, and files that do not say where they come from. Those of `seamless`
// name the method that made their start as `init`.
bool keeps_texture_cuts(const CheckedMap& checked);

// Cones; where there are seams, marks, and the cut, if the surface has texture coordinates.
void check_seams(const CheckedMap& checked, Findings& findings);

// The boundary of the uncut surface is where the texture of the surface has it; nothing without
// one.
void check_fixed_texture_boundary(const CheckedMap& checked, Findings& findings);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
