#include "majorant/certify/stacked_charts.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "majorant/certify/cut_map.h"
#include "majorant/maps/bezier_cell.h"
#include "majorant/mesh/exact_predicates.h"
#include "majorant/mesh/union_find.h"

namespace majorant {
namespace {

using Point = std::pair<double, double>;

// A side of a polygon: its control points including ends, and whether the chart continues beyond
// it.
using PolygonSide = std::pair<std::vector<Point>, bool>;
using PolygonSides = std::vector<PolygonSide>;
using Outline = std::vector<PolygonSides>;

Vector2 corner(const MapFile& file, Index cell, Index k) {
  return file.uv.row(file.cells(cell, k));
}

double doubled_area(const MapFile& file, Index cell) {
  const Vector2 origin = corner(file, cell, 0);
  return cross(Vector2(corner(file, cell, 1) - origin), Vector2(corner(file, cell, 2) - origin));
}

// Returns the least of all rotations.
PolygonSides turned_to_least(PolygonSides cycle) {
  const std::size_t count = cycle.size();
  std::size_t first = 0, other = 1, alike = 0;  // two candidates, and the number of sides in which
                                                // they agree
  while (std::max(first, other) < count && alike < count) {
    const PolygonSide& a = cycle[(first + alike) % count];
    const PolygonSide& b = cycle[(other + alike) % count];
    if (a == b) {
      ++alike;
      continue;
    }
    (b < a ? first : other) += alike + 1;  // no candidate among these sides is least
    if (first == other) ++other;
    alike = 0;
  }
  const auto least = static_cast<std::ptrdiff_t>(std::min(first, other));
  std::rotate(cycle.begin(), cycle.begin() + least, cycle.end());
  return cycle;
}

// Returns a form that is equal for cycles with different starts and senses.
PolygonSides canonical(const PolygonSides& cycle) {
  PolygonSides reversed(cycle.rbegin(), cycle.rend());
  for (auto& [points, goes_on] : reversed) std::reverse(points.begin(), points.end());
  return std::min(turned_to_least(cycle), turned_to_least(std::move(reversed)));
}

class Charts {
 public:
  Charts(const MapFile& file, const std::string& name) : file_(file), cut_(file, name) {
    UnionFind pieces(cells());
    for (Index h = 0; h < surface().half_edge_count(); ++h) {
      goes_on_.push_back(is_inside_of_chart(h));
      if (goes_on_.back()) pieces.join(face_of(h), face_of(surface().opposite(h)));
    }
    join_split(pieces);
    std::vector<Index> number(to_size(cells()), -1);
    for (Index c = 0; c < cells(); ++c) {
      Index& known = number[to_size(pieces.find(c))];
      if (known < 0) known = count_++;
      chart_.push_back(known);
    }
    find_polygons();
  }

  Index count() const { return count_; }
  const std::vector<Index>& of_cells() const { return chart_; }

  // Returns the polygons of each chart in a canonical order.
  std::vector<Outline> outlines() const {
    std::vector<Outline> list(to_size(count_));
    std::vector<char> is_done(is_in_polygon_);
    for (Index first = 0; first < surface().half_edge_count(); ++first) {
      if (is_done[first]) continue;
      PolygonSides cycle;
      Index h = first;
      do {
        is_done[h] = 1;
        cycle.push_back(side(h));
        for (h = next(h); is_in_polygon_[h];) h = next(surface().opposite(h));
      } while (h != first);
      list[to_size(chart_[face_of(first)])].push_back(canonical(cycle));
    }
    for (Outline& outline : list) std::sort(outline.begin(), outline.end());
    return list;
  }

 private:
  const SurfaceMesh& surface() const { return cut_.surface(); }
  Index cells() const { return static_cast<Index>(file_.cells.rows()); }

  // The sides of a fold agree, but one of its faces is turned over.
  bool is_inside_of_chart(Index h) const {
    const Index other = surface().opposite(h);
    return other >= 0 && !cut_.differs(h) && side_of(face_of(h)) * side_of(face_of(other)) >= 0;
  }

  int side_of(Index cell) const {
    return orientation(corner(file_, cell, 0), corner(file_, cell, 1), corner(file_, cell, 2));
  }

  PolygonSide side(Index h) const {
    PolygonSide side{{}, goes_on_[h] != 0};
    for (const int local : bezier_edge_points(file_.degree, corner_of(h))) {
      const Index p = file_.cells(face_of(h), local);
      side.first.emplace_back(file_.uv(p, 0), file_.uv(p, 1));
    }
    return side;
  }

  // Joins pieces into one chart that meet in an edge whose ends the file holds twice, at equal
  // places with equal uv, if no third edge lies there. A chart covers what its polygons cover,
  // however they are joined.
  void join_split(UnionFind& pieces) const {
    using End = std::array<double, 5>;
    const auto end = [&](Index h, Index k) {
      const Index p = file_.cells(face_of(h), (corner_of(h) + k) % 3);
      return End{file_.points(p, 0), file_.points(p, 1), file_.points(p, 2), file_.uv(p, 0),
                 file_.uv(p, 1)};
    };
    std::map<std::pair<End, End>, std::vector<Index>> border;
    for (Index h = 0; h < surface().half_edge_count(); ++h)
      if (surface().opposite(h) < 0) border[{end(h, 0), end(h, 1)}].push_back(h);
    for (const auto& [ends, sides] : border) {
      const auto other = border.find({ends.second, ends.first});
      if (other == border.end() || sides.size() > 1 || other->second.size() > 1) continue;
      const Index cell = face_of(sides[0]), beyond = face_of(other->second[0]);
      if (side_of(cell) * side_of(beyond) >= 0) pieces.join(cell, beyond);
    }
  }

  // Finds polygons. Cells connected like a tree form a disk without inner vertices, whatever their
  // labels.
  void find_polygons() {
    is_in_polygon_.assign(goes_on_.size(), 0);
    if (file_.input_face.size() == 0) return;
    UnionFind polygons(cells());
    std::vector<Index> closing;  // half-edges between cells that were already connected
    for (Index h = 0; h < surface().half_edge_count(); ++h) {
      if (!goes_on_[h]) continue;
      const Index opposite = surface().opposite(h), cell = face_of(h), other = face_of(opposite);
      is_in_polygon_[h] = file_.input_face[cell] == file_.input_face[other];
      if (h < opposite && is_in_polygon_[h] && !polygons.join(cell, other)) closing.push_back(h);
    }
    std::vector<char> is_tree(to_size(cells()), 1);  // by the first cell of the polygon
    for (const Index h : closing) is_tree[polygons.find(face_of(h))] = 0;
    for (Index h = 0; h < surface().half_edge_count(); ++h)
      if (!is_tree[polygons.find(face_of(h))]) is_in_polygon_[h] = 0;
  }

  const MapFile& file_;
  CutMap cut_;
  std::vector<Index> chart_;
  std::vector<char> goes_on_;        // flags of half-edges beyond which the chart continues
  std::vector<char> is_in_polygon_;  // flags of half-edges inside a polygon
  Index count_ = 0;
};

}  // namespace

std::vector<Index> charts_of_cells(const MapFile& file, const std::string& name) {
  return Charts(file, name).of_cells();
}

StackedCharts find_stacks(const MapFile& file, const std::string& name) {
  const Charts charts(file, name);
  StackedCharts out;
  out.chart = charts.of_cells();
  const auto count = to_size(charts.count());
  out.stack.assign(count, -1);
  out.is_first.assign(count, 1);
  out.is_mirrored.assign(count, 0);
  std::vector<double> area(count, 0);
  for (Index c = 0; c < file.cells.rows(); ++c)
    area[to_size(out.chart[to_size(c)])] += doubled_area(file, c);
  std::map<Outline, std::vector<std::size_t>> alike;
  std::vector<Outline> outlines = charts.outlines();
  for (std::size_t k = 0; k < count; ++k) alike[std::move(outlines[k])].push_back(k);
  std::vector<const std::vector<std::size_t>*> stacks;
  for (const auto& [outline, list] : alike)
    if (list.size() > 1) stacks.push_back(&list);
  std::sort(stacks.begin(), stacks.end(),
            [](const auto* a, const auto* b) { return a->front() < b->front(); });
  for (const std::vector<std::size_t>* const list : stacks) {
    const bool has_upper =
        std::any_of(list->begin(), list->end(), [&](std::size_t k) { return area[k] > 0; });
    bool has_first = false;
    for (const std::size_t k : *list) {
      out.stack[k] = out.stacks;
      out.is_mirrored[k] = has_upper && area[k] < 0;
      out.is_first[k] = !has_first && !out.is_mirrored[k];
      has_first = has_first || out.is_first[k];
      out.mirrored += out.is_mirrored[k];
    }
    out.stacked += static_cast<Index>(list->size());
    ++out.stacks;
  }
  return out;
}

MapFile turned_back(const MapFile& file, const StackedCharts& stacks) {
  if (stacks.mirrored == 0) return file;
  MapFile turned = file;
  const auto is_mirrored = [&](Index cell) {
    return stacks.is_mirrored[to_size(stacks.chart[to_size(cell)])] != 0;
  };
  std::vector<char> is_kept(static_cast<std::size_t>(file.points.rows()),
                            0);  // of charts that are not mirrored
  for (Index c = 0; c < file.cells.rows(); ++c)
    for (Index l = 0; l < file.cells.cols() && !is_mirrored(c); ++l) is_kept[file.cells(c, l)] = 1;
  std::map<std::pair<Index, Index>, Index> copies;  // by chart and point
  std::vector<Index> source(static_cast<std::size_t>(file.points.rows()));
  std::iota(source.begin(), source.end(), 0);
  std::vector<char> is_turned(source.size(), 0);
  for (Index c = 0; c < file.cells.rows(); ++c) {
    if (!is_mirrored(c)) continue;
    for (Index l = 0; l < file.cells.cols(); ++l) {
      const Index p = file.cells(c, l);
      const auto [copy, is_new] = copies.try_emplace({stacks.chart[to_size(c)], p}, p);
      if (is_new && is_kept[p]) {
        copy->second = static_cast<Index>(source.size());
        source.push_back(p);
        is_turned.push_back(1);
      }
      is_kept[p] = 1;  // the next chart takes a copy
      is_turned[to_size(copy->second)] = 1;
      turned.cells(c, l) = copy->second;
    }
  }
  const auto take = [&](auto& rows) {
    if (rows.rows() > 0) rows = std::decay_t<decltype(rows)>(rows(source, Eigen::all));
  };
  take(turned.points);
  take(turned.uv);
  take(turned.uv_rounding);
  take(turned.input_vertex);
  take(turned.cone);
  for (std::size_t p = 0; p < source.size(); ++p)
    if (is_turned[p]) turned.uv(static_cast<Index>(p), 0) *= -1;
  return turned;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
