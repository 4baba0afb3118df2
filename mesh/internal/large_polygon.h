// Triangles of plane polygons with thousands of corners, in O(n log n): the constrained Delaunay
// triangulation. For a few corners triangulate_polygon() makes better ones.
#pragma once

#include <array>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/framework/types.h"

namespace majorant {

// #n - 2 triangles of corner numbers, counterclockwise as the polygon is. Throws
// Error(Unsupported), without a place, when the polygon crosses or touches itself, which rounding
// decides where it hardly does; Stopped.
std::vector<std::array<int, 3>> triangulate_large_polygon(const std::vector<Vector2>& polygon,
                                                          const StopCheck& stop);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
