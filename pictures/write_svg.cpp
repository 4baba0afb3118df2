#include "majorant/pictures/write_svg.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/io/atomic_file.h"
#include "majorant/io/map_check.h"
#include "majorant/io/map_distortion.h"
#include "majorant/pictures/internal/alignment.h"
#include "majorant/pictures/internal/claimed_energy.h"
#include "majorant/pictures/internal/svg_layout.h"
#include "majorant/pictures/internal/svg_legend.h"
#include "majorant/pictures/internal/svg_marks.h"

namespace majorant {
namespace {

constexpr double kMarksHeight = 40.0;  // of the legend of grid, seams and cones
constexpr double kGridLines = 32.0;    // along the larger side, unless said otherwise
constexpr double kTint = 0.25;         // how much of a chart's colour its cells have

void add_cells(SvgLayout& layout, const std::vector<Color>* colors) {
  const MapFile& map = layout.map();
  const bool shows_charts = !colors && has_charts(map);
  layout.add("<g stroke=\"#333\" stroke-width=\"{:.3g}\" stroke-linejoin=\"round\"{}>\n",
             layout.stroke_width(),
             shows_charts ? fmt::format(" fill-opacity=\"{}\"", kTint) : std::string());
  const auto fill_of = [&](Index cell) -> std::string {
    if (shows_charts) return chart_color(map.chart[cell]);
    return colors ? (*colors)[cell].hex() : "#dddddd";
  };
  for (Index cell = 0; cell < map.cells.rows(); ++cell) {
    const std::string fill = fill_of(cell);
    layout.add("<path fill=\"{}\" d=\"", fill);
    layout.add_point('M', layout.place(map.cells(cell, 0)));
    for (int edge = 0; edge < 3; ++edge) layout.add_edge(cell, edge);
    layout.add("Z\"/>\n");
  }
  layout.add("</g>\n");
}

// In a drawing of its own, which cuts off what is outside the layout.
void add_scaffold(SvgLayout& layout, const MapFile& scaffold) {
  layout.add("<svg width=\"{}\" height=\"{}\">\n", SvgLayout::kWidth, layout.height());
  layout.add("<g fill=\"#f6f6f6\" stroke=\"#d0d0d0\" stroke-width=\"{:.3g}\">\n",
             layout.stroke_width());
  for (Index cell = 0; cell < scaffold.cells.rows(); ++cell) {
    layout.add("<path d=\"");
    layout.add_point('M', layout.place(Vector2(scaffold.uv.row(scaffold.cells(cell, 0)))));
    for (int edge = 0; edge < 3; ++edge) layout.add_edge(scaffold, cell, edge);
    layout.add("Z\"/>\n");
  }
  layout.add("</g>\n</svg>\n");
}

// 0 for none, also on a layout that is a single point.
double grid_spacing(const SvgLayout& layout, const SvgOptions& options) {
  if (!options.grid) return 0;
  return *options.grid != 0 ? *options.grid : layout.half_size() / (kGridLines / 2);
}

struct Heat {
  Legend legend;
  std::vector<Color> colors;  // of cells
};

// Means over the cells; NaN where they are turned over.
Vec cell_values(const MapFile& map, Quantity quantity) {
  const FaceDistortion faces =
      map.face_distortion.rows() > 0 ? map.face_distortion : measure_distortion(map).faces;
  constexpr Index kSigmaMin = 1;
  const Index column = quantity == Quantity::SigmaMax   ? 0
                       : quantity == Quantity::SigmaMin ? kSigmaMin
                       : quantity == Quantity::Area     ? 2
                                                        : 3;
  return (faces.col(kSigmaMin).array() > 0).select(faces.col(column), std::nan(""));
}

Heat heat_of(const MapFile& map, Quantity quantity, const Vec& cells, const SvgOptions& options) {
  const ColorScale scale = picture_scale(map, quantity, options.color_range);
  ValueSummary values;
  std::vector<Color> colors;
  for (const double value : cells) {
    colors.push_back(std::isnan(value) ? kFlippedColor : scale.color(value));
    if (!std::isnan(value)) values.add(scale, value);
  }
  return {make_legend(map, quantity, scale, values, "triangle means"), colors};
}

// What was asked for; else the density, where the cells have one and something says of which
// energy.
std::optional<Heat> heat_of(const MapFile& map, const SvgOptions& options) {
  if (options.quantity && options.quantity != Quantity::Density)
    return heat_of(map, *options.quantity, cell_values(map, *options.quantity), options);
  const bool is_known = map.distortion.size() > 0 && !claimed_energy(map).name.empty();
  if (is_known) return heat_of(map, Quantity::Density, map.distortion, options);
  if (options.quantity)
    throw Error(ErrorKind::Usage,
                "the map has no density: no energy is claimed that it could be of, or none was "
                "measured");
  return {};
}

// A paper of its own: what is drawn is readable on pages of any colour.
void add_background(SvgLayout& layout, double height) {
  layout.add("<rect width=\"{}\" height=\"{}\" fill=\"#ffffff\"/>\n", SvgLayout::kWidth, height);
}

// direction: what was turned to the horizontal.
std::string draw(const MapFile& map, const Vector2& direction, const SvgOptions& options) {
  SvgLayout layout(map);
  const double spacing = grid_spacing(layout, options);
  const std::optional<Heat> heat = heat_of(map, options);
  const bool has_marks = spacing != 0 || map.seam_edges.size() > 0 || map.cone.size() > 0;
  const double legend_top = layout.height() + (heat ? kSvgLegendHeight : 0.0);
  const double height = std::round(legend_top + (has_marks ? kMarksHeight : 0.0));
  layout.add(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
      "viewBox=\"0 0 {0} {1}\">\n",
      SvgLayout::kWidth, height);
  add_background(layout, height);
  if (options.scaffold) add_scaffold(layout, *options.scaffold);
  add_cells(layout, heat ? &heat->colors : nullptr);
  if (spacing != 0) add_grid(layout, spacing, direction);
  add_chart_outlines(layout);
  add_seams(layout);
  add_cones(layout);
  add_chart_names(layout);
  if (heat) add_color_legend(layout, heat->legend, layout.height());
  if (has_marks) add_marks_legend(layout, legend_top + kMarksHeight / 2, spacing);
  layout.add("</svg>\n");
  return layout.text();
}

}  // namespace

std::string svg_text(const MapFile& map, const SvgOptions& options) {
  require_sound("layout", map);
  if (options.scaffold) require_sound("scaffold", *options.scaffold);
  const Vector2 direction = picture_direction(map, options.alignment);
  SvgOptions shown = options;
  if (options.scaffold) shown.scaffold = turned(*options.scaffold, direction);
  return draw(turned(map, direction), direction, shown);
}

void write_svg(const std::string& path, const MapFile& map, const SvgOptions& options) {
  require_sound(path, map);
  write_file_atomically(path, svg_text(map, options));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
