// What is drawn over the cells of a layout: grid lines, charts, seams and cones.
#pragma once

#include "majorant/pictures/internal/svg_layout.h"

namespace majorant {

// Lines u, v = integer multiples of `spacing` (uv units), clipped to the layout: inside its
// boundary, as winding numbers tell, so overlaps do no harm. u and v are those before `direction`,
// of length 1, was turned to (1, 0). Throws Error(Usage) for a spacing that
// is not positive or gives more than some thousand lines.
void add_grid(SvgLayout& layout, double spacing, const Vector2& direction);

// Whether the map is an atlas: has pieces of different numbers in `chart`.
bool has_charts(const MapFile& map);
// One of ten colours, dark enough to be seen on those of cells.
const char* chart_color(Index chart);
// The outline of every chart, in its colour.
void add_chart_outlines(SvgLayout& layout);

// The number of every chart, as MapFile::chart has it, inside it; none where it would be too small
// to read.
void add_chart_names(SvgLayout& layout);

// Both sides of every seam edge, one colour a chain.
void add_seams(SvgLayout& layout);
// A dot on every copy of a cone: blue for index > 0 (angle < 360 degrees), green for index < 0.
void add_cones(SvgLayout& layout);

// A line that says what these are, from this height on.
void add_marks_legend(SvgLayout& layout, double y, double grid_spacing);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
