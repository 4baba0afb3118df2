#include "majorant/certify/stacked_charts.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "majorant/certify/cut_map.h"
#include "majorant/mesh/exact_predicates.h"
#include "majorant/parametrization/maps/bezier_cell.h"

namespace majorant {
namespace {

using Point = std::pair<double, double>;
using Edge = std::vector<Point>;  // control points, the smaller end first
using Outline = std::vector<Edge>;

Point point(const MapFile& file, Index cell, Index local) {
  const Index p = file.cells(cell, local);
  return {file.uv(p, 0), file.uv(p, 1)};
}

Vector2 corner(const MapFile& file, Index cell, Index k) {
  return file.uv.row(file.cells(cell, k));
}

double doubled_area(const MapFile& file, Index cell) {
  const Vector2 origin = corner(file, cell, 0);
  return cross(Vector2(corner(file, cell, 1) - origin), Vector2(corner(file, cell, 2) - origin));
}

// Half-edge h of the cells.
Edge edge_points(const MapFile& file, Index h) {
  Edge edge;
  for (const int local : bezier_edge_points(file.degree, corner_of(h)))
    edge.push_back(point(file, face_of(h), local));
  if (edge.back() < edge.front()) std::reverse(edge.begin(), edge.end());
  return edge;
}

class Charts {
 public:
  Charts(const MapFile& file, const std::string& name)
      : file_(file), cut_(file, name), parent_(static_cast<std::size_t>(file.cells.rows())) {
    std::iota(parent_.begin(), parent_.end(), 0);
    const SurfaceMesh& surface = cut_.surface();
    for (Index h = 0; h < surface.half_edge_count(); ++h)
      if (surface.opposite(h) > h && !divides(h)) join(face_of(h), face_of(surface.opposite(h)));
    std::vector<Index> number(parent_.size(), -1);
    for (Index c = 0; c < file.cells.rows(); ++c) {
      Index& known = number[to_size(root(c))];
      if (known < 0) known = count_++;
      chart_.push_back(known);
    }
  }

  Index count() const { return count_; }
  const std::vector<Index>& of_cells() const { return chart_; }

  // By chart: its edges that are not inside of a polygon, in an order of their own.
  std::vector<Outline> outlines() const {
    std::vector<Outline> list(to_size(count_));
    const SurfaceMesh& surface = cut_.surface();
    for (Index h = 0; h < surface.half_edge_count(); ++h) {
      const Index other = surface.opposite(h);
      const bool is_inner = other >= 0 && chart_[face_of(h)] == chart_[face_of(other)];
      if (is_inner && (other < h || is_in_polygon(h, other))) continue;
      list[to_size(chart_[face_of(h)])].push_back(edge_points(file_, h));
    }
    for (Outline& outline : list) std::sort(outline.begin(), outline.end());
    return list;
  }

 private:
  // Sides of a fold agree, and one of them has its other side up.
  bool divides(Index h) const {
    if (cut_.differs(h) || cut_.is_unshared(h)) return true;
    return side_of(face_of(h)) * side_of(face_of(cut_.surface().opposite(h))) < 0;
  }

  int side_of(Index cell) const {
    return orientation(corner(file_, cell, 0), corner(file_, cell, 1), corner(file_, cell, 2));
  }

  bool is_in_polygon(Index h, Index other) const {
    return file_.input_face.size() > 0 &&
           file_.input_face[face_of(h)] == file_.input_face[face_of(other)];
  }

  Index root(Index cell) {
    while (parent_[to_size(cell)] != cell)
      cell = parent_[to_size(cell)] = parent_[to_size(parent_[to_size(cell)])];
    return cell;
  }
  void join(Index a, Index b) {
    const Index first = root(a), second = root(b);
    parent_[to_size(std::max(first, second))] = std::min(first, second);
  }

  const MapFile& file_;
  CutMap cut_;
  std::vector<Index> parent_, chart_;
  Index count_ = 0;
};

}  // namespace

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
    for (const std::size_t k : *list) {
      out.stack[k] = out.stacks;
      out.is_first[k] = k == list->front();
      out.is_mirrored[k] = has_upper && area[k] < 0;
      out.mirrored += out.is_mirrored[k];
    }
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
