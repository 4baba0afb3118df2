// What is drawn over the cells of a layout: grid lines, seams and cones.
#pragma once

#include "majorant/io/internal/svg_layout.h"

namespace majorant {

// Lines u, v = integer multiples of `spacing` (uv units), clipped to the layout: inside its
// boundary, as winding numbers tell, so overlaps do no harm. Throws Error(Usage) for a spacing that
// is not positive or gives more than some thousand lines.
void add_grid(SvgLayout& layout, double spacing);

// Both sides of every seam edge, one colour a chain.
void add_seams(SvgLayout& layout);
// A dot on every copy of a cone: blue for index > 0 (angle < 360 degrees), green for index < 0.
void add_cones(SvgLayout& layout);

// A line that says what these are, from this height on.
void add_marks_legend(SvgLayout& layout, double y, double grid_spacing);

}  // namespace majorant
