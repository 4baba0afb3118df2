// A simple polygon with few corners around another one.
//
//   const std::vector<Vector2> notched{{0, 0}, {2, 0}, {2, 1}, {1, 0.9}, {0, 1}};
//   const std::vector<Vector2> around = outer_polygon(notched, 4);    // a rectangle
#pragma once

#include <vector>

#include "majorant/framework/types.h"

namespace majorant {

// Contains the simple, counterclockwise polygon, up to the rounding of new corners, and is simple
// and counterclockwise. Bays are bridged and short sides extended away, whatever adds the least
// area, until `corners` (>= 3) are left or nothing can be done without crossing another side.
// O(#points^2).
std::vector<Vector2> outer_polygon(std::vector<Vector2> points, std::size_t corners);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
