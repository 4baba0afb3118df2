// The layout of a map as a vector drawing: what to look at, and to put into a paper.
#pragma once

#include <optional>
#include <string>

#include "majorant/io/map_file.h"

namespace majorant {

struct SvgOptions {
  // Grid lines at integer multiples of this in u and v (uv units of the file); 0: a 32nd of the
  // layout's larger side; none: no grid.
  std::optional<double> grid;
  // The space around the map (to_map_file of a BezierMesh), of its degree: drawn pale behind it, as
  // far as the drawing reaches.
  std::optional<MapFile> scaffold = std::nullopt;
};

// One <path> per cell along its curved boundary: lines for degree 1, quadratic and cubic Bezier
// curves for 2 and 3, exactly; higher degrees as four Hermite cubics an edge. The v axis points up.
// The drawing is 1000 wide and fits the control points (a layout more than 4 times as tall as wide
// is 4000 high instead); coordinates have 6 digits of the drawing's size.
//
// Cells are filled by `distortion`, light yellow to dark red in even steps of perceived lightness
// (OKLab), from the smallest value to the 98 % quantile (a few extreme cells do not wash out the
// rest); the legend says both numbers. Without distortion the cells are grey, or in pale colours by
// chart. The output depends on nothing but the map.
//
// Over the cells: grid lines if asked for, cut off at the layout's boundary; where the map has
// several charts, thin outlines in one colour a chart; where it has seams, thick lines along both
// sides of them in one colour a chain, and dots on the cones, blue for index > 0 and green for
// index < 0; a second legend.
// Throws Error(Invalid) if the map is inconsistent or not finite, Error(Usage) if the file cannot
// be written or the grid cannot be drawn.
void write_svg(const std::string& path, const MapFile& map, const SvgOptions& options = {});

}  // namespace majorant
