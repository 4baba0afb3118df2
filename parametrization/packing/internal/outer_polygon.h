// A simple polygon with few corners around another one.
//
//   const std::vector<Vector2> notched{{0, 0}, {2, 0}, {2, 1}, {1, 0.9}, {0, 1}};
//   const std::vector<Vector2> around = outer_polygon(notched, 4);    // a rectangle
#pragma once

#include <vector>

#include "majorant/framework/types.h"

namespace majorant {

// Returns a simple, counterclockwise polygon that contains the given one, which is simple and
// counterclockwise, up to the rounding of new corners. Bays are bridged and short sides extended
// away, each time at the least added area, until `corners` (>= 3) are left or every change would
// cross another side. O(#points^2).
std::vector<Vector2> outer_polygon(std::vector<Vector2> points, std::size_t corners);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
