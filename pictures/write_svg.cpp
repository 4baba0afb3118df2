#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/io/atomic_file.h"
#include "majorant/io/io.h"
#include "majorant/io/map_check.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/pictures/internal/alignment.h"
#include "majorant/pictures/internal/claimed_energy.h"
#include "majorant/pictures/internal/legend.h"
#include "majorant/pictures/internal/svg_layout.h"
#include "majorant/pictures/pictures.h"

namespace majorant {
namespace {

// The legend of a vector drawing.

constexpr double kSvgLegendHeight = 130.0;

constexpr double kBarLeft = 26.0;
constexpr double kBarWidth = SvgLayout::kWidth - 2 * kBarLeft;
constexpr double kBarHeight = 20.0;
constexpr double kPoint = 14.0;                          // of an end that values are beyond
constexpr double kLetters = 24.0, kSmallLetters = 20.0;  // to be read at a quarter of the size
constexpr int kSteps = 72;

void add_rect(SvgLayout& layout, const Vector2& corner, const Vector2& size,
              const std::string& fill) {
  layout.add("<rect x=\"");
  layout.add_number(corner[0]);
  layout.add("\" y=\"");
  layout.add_number(corner[1]);
  layout.add("\" width=\"{:.3g}\" height=\"{:.3g}\" fill=\"{}\"/>\n", size[0], size[1], fill);
}

void add_end(SvgLayout& layout, double x, double y, double way, const Color& color) {
  layout.add("<polygon fill=\"{}\" points=\"", color.hex());
  layout.add_point(' ', {x, y});
  layout.add_point(' ', {x + way * kPoint, y + kBarHeight / 2});
  layout.add_point(' ', {x, y + kBarHeight});
  layout.add("\"/>\n");
}

void add_text(SvgLayout& layout, const char* anchor, double x, double y, const std::string& text) {
  layout.add("<text text-anchor=\"{}\" x=\"", anchor);
  layout.add_number(x);
  layout.add("\" y=\"");
  layout.add_number(y);
  layout.add("\">{}</text>\n", text);
}

// From this height on: the title, the bar with its ticks, pointed at ends that values are beyond,
// and the note, in letters for drawings that are shown small.
void add_color_legend(SvgLayout& layout, const Legend& legend, double top) {
  const double y = top + 12.0 + kLetters, below = y + kBarHeight;
  layout.add("<g font-family=\"sans-serif\" font-size=\"{}\" fill=\"#333\">\n", kLetters);
  add_text(layout, "start", SvgLayout::kMargin, y - 12.0, legend.title);
  for (int k = 0; k < kSteps; ++k) {  // each to the end of the bar: no hairlines between them
    const double from = k * kBarWidth / kSteps;
    add_rect(layout, {kBarLeft + from, y}, {kBarWidth - from, kBarHeight},
             legend.scale.color_at((k + 0.5) / kSteps).hex());
  }
  if (legend.goes_below) add_end(layout, kBarLeft, y, -1, legend.scale.colors().front());
  if (legend.goes_above) add_end(layout, kBarLeft + kBarWidth, y, 1, legend.scale.colors().back());
  for (const ColorScale::Tick& tick : legend.scale.ticks()) {
    const double x = kBarLeft + tick.position * kBarWidth;
    add_rect(layout, {x - 1.0, below}, {2.0, 5.0}, "#333");
    add_text(layout, "middle", x, below + 5.0 + kLetters, tick.label);
  }
  layout.add("</g>\n<g font-family=\"sans-serif\" font-size=\"{}\" fill=\"#333\">\n",
             kSmallLetters);
  add_text(layout, "start", SvgLayout::kMargin, below + 16.0 + kLetters + kSmallLetters,
           legend.note);
  layout.add("</g>\n");
}

// Marks over the cells of a layout: grid lines, charts, seams and cones.

constexpr double kMostLines = 4000;  // in each direction; nothing could be seen of more
constexpr const char* kGridColor = "#14327a";
constexpr double kOutlineWidth = 1.5;
constexpr double kSeamWidth = 2.5;
constexpr double kConeRadius = 5.0;
constexpr double kNameShare = 0.3;  // of the side of a square as large as the chart
constexpr double kSmallestName = 8.0;
constexpr double kLargestName = 22.0;
// Far apart in hue from their neighbours, dark enough to be seen on the cells' colours.
constexpr const char* kColors[] = {"#7b2fbe", "#008b8b", "#c2185b", "#2e7d32", "#1565c0",
                                   "#5d4037", "#d81bff", "#00a4d6", "#556b2f", "#3f3f9f"};

const char* cone_color(int quarter_turns) { return quarter_turns < 4 ? "#1a5fd0" : "#0b8a3a"; }

struct CellEdge {
  Index cell;
  int edge;
};

// f(edge, cell beyond it or -1) for every edge between points. Files may hold cells that are no
// surface, which opposite_half_edges() refuses; where several cells are beyond, it is the last.
template <class F>
void for_each_edge(const MapFile& map, const F& f) {
  std::map<std::pair<Index, Index>, Index> cell_of;
  for (Index c = 0; c < map.cells.rows(); ++c)
    for (int k = 0; k < 3; ++k) cell_of[{map.cells(c, k), map.cells(c, next(k))}] = c;
  for (Index c = 0; c < map.cells.rows(); ++c)
    for (int k = 0; k < 3; ++k) {
      const auto other = cell_of.find({map.cells(c, next(k)), map.cells(c, k)});
      f(CellEdge{c, k}, other == cell_of.end() ? -1 : other->second);
    }
}

// Edges between points without a neighbour, by the point they start at.
std::multimap<Index, CellEdge> boundary_edges(const MapFile& map) {
  std::multimap<Index, CellEdge> boundary;
  for_each_edge(map, [&](const CellEdge& edge, Index other) {
    if (other < 0) boundary.emplace(map.cells(edge.cell, edge.edge), edge);
  });
  return boundary;
}

// One path along all of them, each a stroke of its own.
void add_edges(SvgLayout& layout, const std::vector<CellEdge>& edges, const char* color) {
  layout.add("<path stroke=\"{}\" d=\"", color);
  for (const CellEdge& at : edges) {
    layout.add_point('M', layout.place(layout.map().cells(at.cell, at.edge)));
    layout.add_edge(at.cell, at.edge);
  }
  layout.add("\"/>\n");
}

void add_boundary_path(SvgLayout& layout) {
  const MapFile& map = layout.map();
  std::multimap<Index, CellEdge> boundary = boundary_edges(map);
  while (!boundary.empty()) {
    auto leaving = boundary.begin();
    layout.add_point('M', layout.place(leaving->first));
    while (leaving != boundary.end()) {
      const CellEdge at = leaving->second;
      boundary.erase(leaving);
      layout.add_edge(at.cell, at.edge);
      leaving = boundary.find(map.cells(at.cell, next(at.edge)));
    }
    layout.add("Z");
  }
}

// Cones of positive and of negative index; copies count once.
std::pair<std::size_t, std::size_t> count_cones(const MapFile& map) {
  std::set<Index> positive, negative;
  for (Index p = 0; p < map.cone.size(); ++p) {
    if (map.cone[p] == 0) continue;
    const Index vertex = map.input_vertex.size() > 0 ? map.input_vertex[p] : p;
    (map.cone[p] < 4 ? positive : negative).insert(vertex);
  }
  return {positive.size(), negative.size()};
}

// The place of a chart's name: the middle of the cell that is closest to the chart's.
struct ChartRoom {
  double area = 0;  // drawing units squared
  Vector2 middle = Vector2::Zero(), place = Vector2::Zero();
  double distance = std::numeric_limits<double>::infinity();
};

std::map<Index, ChartRoom> rooms_of_charts(const SvgLayout& layout) {
  const MapFile& map = layout.map();
  std::map<Index, ChartRoom> rooms;
  const auto corner = [&](Index c, Index k) { return layout.place(map.cells(c, k)); };
  const auto middle = [&](Index c) {
    return Vector2((corner(c, 0) + corner(c, 1) + corner(c, 2)) / 3);
  };
  for (Index c = 0; c < map.cells.rows(); ++c) {
    ChartRoom& room = rooms[map.chart[c]];
    const double area =
        0.5 * std::abs(cross(corner(c, 1) - corner(c, 0), corner(c, 2) - corner(c, 0)));
    room.area += area;
    room.middle += area * middle(c);
  }
  for (Index c = 0; c < map.cells.rows(); ++c) {
    ChartRoom& room = rooms[map.chart[c]];
    const double distance = (middle(c) - room.middle / room.area).norm();
    if (!(distance < room.distance)) continue;
    room.distance = distance;
    room.place = middle(c);
  }
  return rooms;
}

void add_dot(SvgLayout& layout, const Vector2& center, int quarter_turns) {
  layout.add("<circle cx=\"");
  layout.add_number(center[0]);
  layout.add("\" cy=\"");
  layout.add_number(center[1]);
  layout.add("\" r=\"{}\" fill=\"{}\"/>\n", kConeRadius, cone_color(quarter_turns));
}

// Returns whether the map is an atlas: has pieces of different numbers in `chart`.
bool has_charts(const MapFile& map) {
  return map.chart.size() > 0 && map.chart.minCoeff() != map.chart.maxCoeff();
}

// One of ten colours, dark enough to be seen on those of cells.
const char* chart_color(Index chart) { return kColors[to_size(chart) % std::size(kColors)]; }

// The outline of every chart, in its colour.
void add_chart_outlines(SvgLayout& layout) {
  const MapFile& map = layout.map();
  if (!has_charts(map)) return;
  std::map<Index, std::vector<CellEdge>> outlines;
  for_each_edge(map, [&](const CellEdge& edge, Index other) {
    const Index chart = map.chart[edge.cell];
    if (other < 0 || map.chart[other] != chart) outlines[chart].push_back(edge);
  });
  layout.add("<g fill=\"none\" stroke-width=\"{}\" stroke-linecap=\"round\">\n", kOutlineWidth);
  for (const auto& [chart, edges] : outlines) add_edges(layout, edges, chart_color(chart));
  layout.add("</g>\n");
}

// The number of every chart, as MapFile::chart has it, inside it; none where it would be too small
// to read.
void add_chart_names(SvgLayout& layout) {
  const MapFile& map = layout.map();
  if (!has_charts(map)) return;
  layout.add(
      "<g font-family=\"sans-serif\" text-anchor=\"middle\" fill=\"#222\" stroke=\"#fff\" "
      "stroke-width=\"3\" paint-order=\"stroke\">\n");
  for (const auto& [chart, room] : rooms_of_charts(layout)) {
    const double size = std::min(kLargestName, kNameShare * std::sqrt(room.area));
    if (size < kSmallestName) continue;
    layout.add("<text font-size=\"{:.3g}\" x=\"", size);
    layout.add_number(room.place[0]);
    layout.add("\" y=\"");
    layout.add_number(room.place[1] + 0.35 * size);
    layout.add("\">{}</text>\n", chart);
  }
  layout.add("</g>\n");
}

// Lines u, v = integer multiples of `spacing` (uv units), clipped to the layout: inside its
// boundary, as winding numbers tell, so overlaps do no harm. u and v are those before `direction`,
// of length 1, was turned to (1, 0). Throws Error(Usage) for a spacing that
// is not positive or gives more than some thousand lines.
void add_grid(SvgLayout& layout, double spacing, const Vector2& direction) {
  // The axes of the file's u and v in the turned layout: the unit vectors along which they grow,
  // and the values they have over the box.
  Eigen::Matrix2d axes;
  axes << direction.x(), direction.y(), -direction.y(), direction.x();
  Eigen::Matrix<double, 2, 4> corners;
  corners << layout.low().x(), layout.high().x(), layout.low().x(), layout.high().x(),
      layout.low().y(), layout.low().y(), layout.high().y(), layout.high().y();
  const Eigen::Matrix<double, 2, 4> uv = axes.transpose() * corners / spacing;
  const Vector2 low = uv.rowwise().minCoeff(), high = uv.rowwise().maxCoeff();
  if (!(spacing > 0) || !((high - low).maxCoeff() <= kMostLines))
    throw Error(ErrorKind::Usage,
                fmt::format("a grid of spacing {:g} on a layout of size {:g} cannot be drawn; take "
                            "a spacing between them",
                            spacing, 2 * layout.half_size()));
  layout.add("<clipPath id=\"layout\"><path d=\"");
  add_boundary_path(layout);
  layout.add(
      "\"/></clipPath>\n<path clip-path=\"url(#layout)\" fill=\"none\" stroke=\"{}\" "
      "stroke-width=\"{:.3g}\" d=\"",
      kGridColor, std::max(1.0, 2 * layout.stroke_width()));
  for (int axis = 0; axis < 2; ++axis) {
    const double first = std::ceil(low[axis]), count = std::floor(high[axis]) - first;
    for (double k = 0; k <= count; ++k) {  // far from the origin, first + 1 may be first
      Vector2 from = low * spacing, to = high * spacing;
      from[axis] = to[axis] = (first + k) * spacing;
      layout.add_point('M', layout.place(axes * from));
      layout.add_point('L', layout.place(axes * to));
    }
  }
  layout.add("\"/>\n");
}

// Both sides of every seam edge, one colour a chain.
void add_seams(SvgLayout& layout) {
  const MapFile& map = layout.map();
  std::map<Index, std::vector<CellEdge>> chains;
  for (Index f = 0; f < map.seam_edges.rows(); ++f)
    for (int k = 0; k < 3; ++k)
      if (map.seam_edges(f, k) > 0) chains[map.seam_edges(f, k) - 1].push_back({f, k});
  if (chains.empty()) return;
  layout.add("<g fill=\"none\" stroke-width=\"{}\" stroke-linecap=\"round\">\n", kSeamWidth);
  for (const auto& [chain, edges] : chains) add_edges(layout, edges, chart_color(chain));
  layout.add("</g>\n");
}

// A dot on every copy of a cone: blue for index > 0 (angle < 360 degrees), green for index < 0.
void add_cones(SvgLayout& layout) {
  const MapFile& map = layout.map();
  if (map.cone.size() == 0 || map.cone.maxCoeff() <= 0) return;
  layout.add("<g stroke=\"#fff\" stroke-width=\"1.5\">\n");
  for (Index p = 0; p < map.cone.size(); ++p)
    if (map.cone[p] > 0) add_dot(layout, layout.place(p), map.cone[p]);
  layout.add("</g>\n");
}

// A line that says what these are, from this height on.
void add_marks_legend(SvgLayout& layout, double y, double grid_spacing) {
  constexpr double kColumn = 245.0, kText = 18.0, kBase = 7.0;
  const MapFile& map = layout.map();
  double x = SvgLayout::kMargin;
  const auto label = [&](const std::string& text) {
    layout.add("<text x=\"{}\" y=\"", x + kText);
    layout.add_number(y + kBase);
    layout.add("\">{}</text>\n", text);
    x += kColumn;
  };
  const auto line = [&](const char* color) {
    layout.add("<path fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" d=\"", color, kSeamWidth);
    layout.add_point('M', {x, y});
    layout.add_point('L', {x + kText - 4.0, y});
    layout.add("\"/>\n");
  };
  layout.add("<g font-family=\"sans-serif\" font-size=\"20\" fill=\"#333\">\n");
  const auto [positive, negative] = count_cones(map);
  for (const auto& [count, turns, text] :
       {std::tuple{positive, 3, "index &gt; 0"}, std::tuple{negative, 5, "index &lt; 0"}}) {
    if (count == 0) continue;
    add_dot(layout, {x + kConeRadius, y}, turns);
    label(fmt::format("{} cone{}, {}", count, count == 1 ? "" : "s", text));
  }
  if (map.seam_edges.size() > 0 && map.seam_edges.maxCoeff() > 0) {
    line(chart_color(0));
    label(fmt::format("seams ({} chains)", map.seam_edges.maxCoeff()));
  }
  if (grid_spacing > 0) {
    line(kGridColor);
    label(fmt::format("grid {:.6g}", grid_spacing));
  }
  layout.add("</g>\n");
}

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

// The heat map that was asked for; else the density, where the cells have one and something says of
// which energy.
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
