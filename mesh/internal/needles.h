// Rest triangles of faces without area and of needles, by the rules of repair.h.
#pragma once

#include <vector>

#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// Returns the faces whose height over their longest edge is at most least_height times that edge,
// each with its rest triangle, in order.
std::vector<RestTriangle> needles_of(const Points3& positions, const Cells& faces,
                                     double least_height);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
