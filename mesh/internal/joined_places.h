// Joins open sides between the same positions, unless a third side competes.
#pragma once

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/internal/given_triangles.h"

namespace majorant {

// Joins sides as Welding::EqualPlaces (repair.h) says; does nothing without first_at_place. layer:
// by triangle; negative layers are left out, and different layers are not joined. crowded: the
// sides of edges of more than two faces, which stay open.
void join_places(const GivenTriangles& triangles, const std::vector<Index>& layer,
                 const IndexLists& crowded, GluedSides& glued, const StopCheck& stop);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
