// Joins the sides of edges of more than two faces, where solids meet, in pairs.
#pragma once

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/internal/given_triangles.h"

namespace majorant {

// Joins sides as CrowdedEdges::Paired (repair.h) says. crowded: the sides of each such edge, open
// in `glued`.
void pair_crowded_sides(const GivenTriangles& triangles, const IndexLists& crowded,
                        GluedSides& glued, const StopCheck& stop);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
