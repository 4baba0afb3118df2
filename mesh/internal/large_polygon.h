// Triangulates plane polygons with thousands of corners in O(n log n), by the constrained Delaunay
// triangulation. For few corners triangulate_polygon() makes better triangles.
#pragma once

#include <array>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/framework/types.h"

namespace majorant {

// Returns #n - 2 triangles of corner numbers, counterclockwise as the polygon is. Throws
// Error(Unsupported), without a place, if the polygon crosses or touches itself (rounding decides
// close cases), and Stopped.
std::vector<std::array<int, 3>> triangulate_large_polygon(const std::vector<Vector2>& polygon,
                                                          const StopCheck& stop);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
