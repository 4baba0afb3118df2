// Rest triangles of faces without area and of needles: repair.h says which, and why.
#pragma once

#include <vector>

#include "majorant/mesh/repair.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// Of faces #F by 3 over positions #V by 3, ordered by face; nothing for others. Numerics::AsGiven:
// only of those that from_polygons() calls faces without an area.
std::vector<RestTriangle> regularized_faces(const Points3& positions, const Cells& faces,
                                            Numerics numerics);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
