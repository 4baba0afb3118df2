// The layout of a map as a vector drawing: what to look at, and to put into a paper.
#pragma once

#include <optional>
#include <string>

#include "majorant/parametrization/maps/map_file.h"
#include "majorant/pictures/picture_options.h"

namespace majorant {

struct SvgOptions {
  // Grid lines at integer multiples of this in u and v (uv units of the file); 0: a 32nd of the
  // layout's larger side; none: no grid.
  std::optional<double> grid = std::nullopt;
  // The space around the map (to_map_file of a BezierMesh), of its degree: drawn pale behind it, as
  // far as the drawing reaches.
  std::optional<MapFile> scaffold = std::nullopt;
  // What the triangles' colours show, the mean over each; none: the density, where the map has it
  // and names its energy.
  std::optional<Quantity> quantity = std::nullopt;
  // None: the fixed range of the quantity's scale.
  std::optional<ColorRange> color_range = std::nullopt;
  Alignment alignment = Alignment::Automatic;
};

// One <path> per cell along its curved boundary: lines for degree 1, quadratic and cubic Bezier
// curves for 2 and 3, exactly; higher degrees as four Hermite cubics an edge. The v axis points up.
// The drawing is 1000 wide and fits the control points (a layout more than 4 times as tall as wide
// is 4000 high instead); coordinates have 6 digits of the drawing's size.
//
// Cells are filled by `distortion`, the mean density of the energy that the map's claims name, on
// the fixed scale of that energy (color_scale.h): pictures of different maps can be compared. The
// legend names energy, degree and isometry, the smallest and the largest value on the map (not of
// the means that are drawn; as MapMeasures::max_density), and how many means are beyond the scale.
// Without
// either the cells are grey, or in pale colours by chart. The paper is white, whatever page it lies
// on. The output depends on nothing but the map and the options.
//
// Over the cells: grid lines if asked for, cut off at the layout's boundary; where the map has
// several charts, thin outlines in one colour a chart, and its number where there is room; where it
// has seams, thick lines along both sides of them in one colour a chain, and dots on the cones,
// blue for index > 0 and green for index < 0; a second legend. Throws Error(Invalid) if the map is
// inconsistent or not finite, Error(Usage) if the file cannot be written, the grid cannot be drawn
// or the range of colours leaves out the isometry.
void write_svg(const std::string& path, const MapFile& map, const SvgOptions& options = {});
// The drawing as text, for who has a place for it already. Throws Error(Invalid) likewise.
std::string svg_text(const MapFile& map, const SvgOptions& options = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
