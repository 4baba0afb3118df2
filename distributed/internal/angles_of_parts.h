// Angles around the vertices of a map in parts: sums over the faces of all ranks, each told by its
// owner.
//
//     const AnglesOfParts angles = angles_of_parts(part, map);      // collective
#pragma once

#include "distributed/mesh_part.h"
#include "majorant/parametrization/maps/bezier_map.h"

namespace majorant {

struct AnglesOfParts {
  Index off = 0;             // vertices inside whose sum is not a full turn
  Index over_full_turn = 0;  // on the boundary
  double largest = 0;        // radians, on the boundary
};

AnglesOfParts angles_of_parts(const MeshPart& part, const BezierMap& map);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
