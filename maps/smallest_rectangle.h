// The rectangle of least area around points of the plane. Layouts are aligned by it, and charts
// packed as such rectangles.
//
//   const Vector2 direction = layout_direction(file.uv, file.cells);
#pragma once

#include <vector>

#include "majorant/framework/types.h"

namespace majorant {

// Returns the corners of the convex hull, counterclockwise, without collinear ones.
std::vector<Vector2> convex_hull(std::vector<Vector2> points);

struct SmallestRectangle {
  Vector2 side = Vector2(1, 0);  // of length 1, along a side of it
  double along = 0, across = 0;  // its extents along that side and perpendicular to it
};

// Returns the smallest rectangle, by rotating calipers: one of its sides holds an edge of the hull
// [FS75]. Returns the axis-aligned box if that is as small up to a millionth. Areas must not
// overflow or underflow.
SmallestRectangle smallest_rectangle(const std::vector<Vector2>& points);

// Returns the unit vector along the longer side of the smallest rectangle around the control points
// of the cells, to the right (upwards if it is vertical); (1, 0) if no side is longer. uv: #N by 2,
// finite, of any size. cells: #F by k, rows of uv.
Vector2 layout_direction(const Points2& uv, const Cells& cells);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
