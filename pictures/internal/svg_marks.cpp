#include "majorant/pictures/internal/svg_marks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "majorant/framework/error.h"
#include "majorant/mesh/half_edge.h"

namespace majorant {
namespace {

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

// Where the name of a chart goes: the middle of the cell that is closest to the chart's.
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

}  // namespace

bool has_charts(const MapFile& map) {
  return map.chart.size() > 0 && map.chart.minCoeff() != map.chart.maxCoeff();
}

const char* chart_color(Index chart) { return kColors[to_size(chart) % std::size(kColors)]; }

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

void add_grid(SvgLayout& layout, double spacing, const Vector2& direction) {
  // Of the file's u and v, in the turned layout: the unit vectors along which they grow, and the
  // values they have over the box.
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

void add_cones(SvgLayout& layout) {
  const MapFile& map = layout.map();
  if (map.cone.size() == 0 || map.cone.maxCoeff() <= 0) return;
  layout.add("<g stroke=\"#fff\" stroke-width=\"1.5\">\n");
  for (Index p = 0; p < map.cone.size(); ++p)
    if (map.cone[p] > 0) add_dot(layout, layout.place(p), map.cone[p]);
  layout.add("</g>\n");
}

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

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
