// The rectangle of least area around points of the plane: what a layout is turned by to lie along
// the axes, and what a chart is packed as.
//
//   const Vector2 direction = layout_direction(file.uv, file.cells);
#pragma once

#include <vector>

#include "majorant/framework/types.h"

namespace majorant {

// Corners of the convex hull, counterclockwise, collinear ones left out.
std::vector<Vector2> convex_hull(std::vector<Vector2> points);

struct SmallestRectangle {
  Vector2 side = Vector2(1, 0);  // of length 1, along a side of it
  double along = 0, across = 0;  // its extents that way and perpendicular to it
};

// The smallest rectangle, by rotating calipers: one of its sides holds an edge of the hull [FS75].
// The box along the axes where that is as small but for a part in a million. Areas must not
// overflow or underflow.
SmallestRectangle smallest_rectangle(const std::vector<Vector2>& points);

// The unit vector along the longer side of the smallest rectangle around the control points of the
// cells, to the right (upwards where it is vertical); (1, 0) where no side is longer. uv: #N by 2,
// finite, of any size; cells: #F by k, rows of uv.
Vector2 layout_direction(const Points2& uv, const Cells& cells);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
