#include "majorant/pictures/write_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "majorant/io/internal/atomic_file.h"
#include "majorant/io/internal/map_check.h"
#include "majorant/pictures/internal/heat_color.h"
#include "majorant/pictures/internal/svg_layout.h"
#include "majorant/pictures/internal/svg_marks.h"

namespace majorant {
namespace {

constexpr double kLegendHeight = 50.0;
constexpr double kMarksHeight = 30.0;  // of the legend of grid, seams and cones
constexpr double kGridLines = 32.0;    // along the larger side, unless said otherwise
constexpr int kLegendSteps = 24;
constexpr double kTint = 0.25;  // how much of a chart's colour its cells have

struct ValueRange {
  double low = 0.0;
  double high = 0.0;

  double fraction(double value) const { return high > low ? (value - low) / (high - low) : 0.0; }
};

// The smallest value and the 98 % quantile.
ValueRange range_of(const Vec& values) {
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const double position = 0.98 * static_cast<double>(sorted.size() - 1);
  return {sorted.front(), sorted[static_cast<std::size_t>(std::ceil(position))]};
}

void add_cells(SvgLayout& layout, const ValueRange& range) {
  const MapFile& map = layout.map();
  const bool shows_charts = map.distortion.size() == 0 && has_charts(map);
  layout.add("<g stroke=\"#333\" stroke-width=\"{:.3g}\" stroke-linejoin=\"round\"{}>\n",
             layout.stroke_width(),
             shows_charts ? fmt::format(" fill-opacity=\"{}\"", kTint) : std::string());
  const auto fill_of = [&](Index cell) -> std::string {
    if (shows_charts) return chart_color(map.chart[cell]);
    if (map.distortion.size() == 0) return "#dddddd";
    return heat_color(range.fraction(map.distortion[cell]));
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

void add_distortion_legend(SvgLayout& layout, const ValueRange& range) {
  constexpr double kBarWidth = 240.0;
  constexpr double kBarHeight = 12.0;
  const double y = layout.height() + 8.0;
  const double step = kBarWidth / kLegendSteps;
  layout.add("<g font-family=\"sans-serif\" font-size=\"14\" fill=\"#333\">\n");
  for (int i = 0; i < kLegendSteps; ++i) {
    layout.add("<rect x=\"{}\" y=\"", SvgLayout::kMargin + i * step);
    layout.add_number(y);
    layout.add("\" width=\"{}\" height=\"{}\" fill=\"{}\"/>\n", step, kBarHeight,
               heat_color((i + 0.5) / kLegendSteps));
  }
  for (const auto& [anchor, x, label] :
       {std::tuple{"start", SvgLayout::kMargin, fmt::format("{:.5g}", range.low)},
        std::tuple{"end", SvgLayout::kMargin + kBarWidth, fmt::format("{:.5g}", range.high)}}) {
    layout.add("<text text-anchor=\"{}\" x=\"{}\" y=\"", anchor, x);
    layout.add_number(y + kBarHeight + 16.0);
    layout.add("\">{}</text>\n", label);
  }
  layout.add("<text x=\"{}\" y=\"", SvgLayout::kMargin + kBarWidth + 12.0);
  layout.add_number(y + kBarHeight - 1.0);
  layout.add("\">distortion (largest {:.5g})</text>\n</g>\n", layout.map().distortion.maxCoeff());
}

// 0 for none, also on a layout that is a single point.
double grid_spacing(const SvgLayout& layout, const SvgOptions& options) {
  if (!options.grid) return 0;
  return *options.grid != 0 ? *options.grid : layout.half_size() / (kGridLines / 2);
}

std::string draw(const MapFile& map, const SvgOptions& options) {
  SvgLayout layout(map);
  const double spacing = grid_spacing(layout, options);
  const bool has_distortion = map.distortion.size() > 0;
  const bool has_marks = spacing != 0 || map.seam_edges.size() > 0 || map.cone.size() > 0;
  const double legend_top = layout.height() + (has_distortion ? kLegendHeight : 0.0);
  layout.add(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
      "viewBox=\"0 0 {0} {1}\">\n",
      SvgLayout::kWidth, std::ceil(legend_top + (has_marks ? kMarksHeight : 0.0)));
  const ValueRange range = has_distortion ? range_of(map.distortion) : ValueRange{};
  if (options.scaffold) add_scaffold(layout, *options.scaffold);
  add_cells(layout, range);
  if (spacing != 0) add_grid(layout, spacing);
  add_chart_outlines(layout);
  add_seams(layout);
  add_cones(layout);
  if (has_distortion) add_distortion_legend(layout, range);
  if (has_marks) add_marks_legend(layout, legend_top + kMarksHeight / 2, spacing);
  layout.add("</svg>\n");
  return layout.text();
}

}  // namespace

void write_svg(const std::string& path, const MapFile& map, const SvgOptions& options) {
  require_sound(path, map);
  if (options.scaffold) require_sound(path, *options.scaffold);
  write_file_atomically(path, draw(map, options));
}

}  // namespace majorant
