#include "majorant/parametrization/atlas/internal/division.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "majorant/parametrization/atlas/internal/chart_cutting.h"
#include "majorant/parametrization/atlas/internal/stretch_limit.h"

namespace majorant {
namespace {

// The cost of the square that holds all charts, per area of the surface. With kChartCost, a chart
// that fills a twentieth of its box is worth a short cut. A chart that fills half of it is worth
// none, unless it is so long that the square is mostly empty.
constexpr double kFillCost = 0.1;
// Charts longer than this fraction of the longest one are divided together with it, since its
// halves are shorter.
constexpr double kLongChartRatio = 0.7;

// Returns the decrease of the layout's cost by the division, in square roots of the surface's area.
double gain_of(const Division& division, double area) {
  return kFillCost * division.saved_area / area - division.cost / std::sqrt(area) - kChartCost;
}
// Returns an upper bound on gain_of(): the parts fill their boxes and the cut has no length.
double gain_at_most(const ChartPiece& piece, double area) {
  const double box = area_of(box_of(piece));
  return kFillCost * (box - piece.chart.stretch.image_area) / area - kChartCost;
}

Division best_division(const ChartPiece& piece, const StopCheck& stop) {
  const SurfaceMesh& mesh = *piece.mesh;
  Division division;
  division.cut = cut_across(mesh, piece.preferences, PathsAcross::BetweenEnds, stop);
  if (!is_any(division.cut)) return division;
  // Lengths count, not weights: weights steer seams but do not say how long they may be.
  division.cost = cost_of_cuts(mesh, {piece.preferences.creases, {}}, division.cut);
  division.saved_area = area_of(box_of(piece));
  double smallest = std::numeric_limits<double>::infinity();
  std::vector<Index> uncut_vertex;
  for (const SurfacePiece& part : mesh.cut_along(division.cut, &uncut_vertex).split()) {
    std::vector<Index> vertices;
    for (const Index v : part.vertex) vertices.push_back(uncut_vertex[v]);
    const SmallestRectangle box = box_of(piece, vertices);
    division.saved_area -= area_of(box);
    division.longest = std::max({division.longest, box.along, box.across});
    smallest = std::min(smallest, part.mesh->area());
  }
  division.price = division.cost / smallest;
  return division;
}

// Returns all charts that are nearly as long as the longest one, if the square that holds it is
// larger than the boxes need and dividing them lowers the cost of the layout. Throws Stopped.
std::vector<std::size_t> long_charts(ChartSet& set, const UnwrapRun& run) {
  std::vector<double> length;
  double boxes = 0;
  for (const ChartPiece& piece : set.pieces) {
    const SmallestRectangle box = box_of(piece);
    boxes += area_of(box);
    length.push_back(std::max(box.along, box.across));
  }
  const double longest = *std::max_element(length.begin(), length.end());
  const double square = std::max(boxes, longest * longest), area = run.surface.area();
  if (!(kFillCost * (square - boxes) / area > kChartCost)) return {};
  std::vector<std::size_t> next;
  double longest_after = 0, cost = 0;
  for (std::size_t k = 0; k < set.pieces.size(); ++k) {
    if (!(length[k] > kLongChartRatio * longest)) {
      longest_after = std::max(longest_after, length[k]);
      continue;
    }
    const Division* const division =
        may_be_divided(set.pieces[k]) ? division_of(set, k, run) : nullptr;
    if (!division) return {};
    longest_after = std::max(longest_after, division->longest);
    boxes -= division->saved_area;
    cost += division->cost / std::sqrt(area) + kChartCost;
    next.push_back(k);
  }
  const double saved = square - std::max(boxes, longest_after * longest_after);
  return kFillCost * saved / area > cost ? next : std::vector<std::size_t>();
}

// Returns the charts whose divisions cost least per area: as many as are missing, at most half of
// all. Throws Stopped.
std::vector<std::size_t> cheapest_charts(ChartSet& set, std::size_t lacking, const UnwrapRun& run) {
  std::vector<std::pair<double, std::size_t>> by_price;
  for (std::size_t k = 0; k < set.pieces.size(); ++k)
    if (may_be_divided(set.pieces[k]))
      if (const Division* const division = division_of(set, k, run))
        by_price.emplace_back(division->price, k);
  std::sort(by_price.begin(), by_price.end());
  const std::size_t half = std::max<std::size_t>(1, set.pieces.size() / 2);
  by_price.resize(std::min({by_price.size(), lacking, half}));
  std::vector<std::size_t> next;
  for (const auto& [unused, k] : by_price) next.push_back(k);
  return next;
}

// Returns the charts whose divisions lower the cost of the layout. Throws Stopped.
std::vector<std::size_t> costly_charts(ChartSet& set, const UnwrapRun& run) {
  const double area = run.surface.area();
  std::vector<std::size_t> next;
  for (std::size_t k = 0; k < set.pieces.size(); ++k) {
    const ChartPiece& piece = set.pieces[k];
    if (!may_be_divided(piece) || !(gain_at_most(piece, area) > 0)) continue;
    const Division* const division = division_of(set, k, run);
    if (division && gain_of(*division, area) > 0) next.push_back(k);
  }
  return next.empty() && has_one_scale(run.options) ? long_charts(set, run) : next;
}

// Returns the charts with more area than UnwrapOptions::max_chart_area. Throws Stopped.
std::vector<std::size_t> large_charts(ChartSet& set, const UnwrapRun& run) {
  std::vector<std::size_t> next;
  for (std::size_t k = 0; k < set.pieces.size(); ++k)
    if (set.pieces[k].mesh->area() > run.options.max_chart_area && may_be_divided(set.pieces[k]) &&
        division_of(set, k, run))
      next.push_back(k);
  return next;
}

// Returns the charts to divide next. Throws Stopped.
std::vector<std::size_t> charts_to_divide(ChartSet& set, const UnwrapRun& run) {
  if (!may_cut(run.options)) return {};
  if (std::vector<std::size_t> large = large_charts(set, run); !large.empty()) return large;
  const auto count = static_cast<std::size_t>(std::max<Index>(run.options.least_charts, 0));
  if (count > set.pieces.size()) return cheapest_charts(set, count - set.pieces.size(), run);
  const bool is_counted = run.options.least_charts > 0;
  return is_counted || !run.options.packing ? std::vector<std::size_t>() : costly_charts(set, run);
}

}  // namespace

ChartSet divide(ChartSet set, UnwrapRun& run) {
  try {
    for (;;) {
      const std::vector<std::size_t> next = charts_to_divide(set, run);
      if (next.empty()) return set;
      Divided divided = divide_charts(std::move(set), next, run);
      set = std::move(divided.set);
      if (!divided.is_complete) break;
    }
    set.division = run.end();
  } catch (const Stopped& stop) {  // during the choice of charts: the set is unchanged
    set.division = stopped_status(stop.why());
  }
  return set;
}

Divided divide_charts(ChartSet set, const std::vector<std::size_t>& which, UnwrapRun& run) {
  if (!run.may_continue()) return {std::move(set), false};
  // The limit of stretch may cut any chart, and a stop may leave any of those without a map.
  // Therefore the whole set is kept.
  ChartSet before = set;
  const auto choose = [&](const ChartSet& charts, const StopCheck&) {
    return cut_alike(charts, which, run.options.stacking,
                     [](const ChartPiece& piece) { return piece.division->cut; });
  };
  Recut recut = cut_and_solve(std::move(set), which, choose, run);
  set = limit_stretch(std::move(recut.set), run);
  if (run.record.start_stop()() == Directive::Continue) return {std::move(set), recut.is_complete};
  return {lacks_maps(set) ? std::move(before) : std::move(set), false};
}

const Division* division_of(ChartSet& set, std::size_t k, const UnwrapRun& run) {
  ChartPiece& piece = set.pieces[k];
  if (!piece.division) {
    run.record.stop().poll();
    run.record.announce(fmt::format("where chart {} of {} divides best", k + 1, set.pieces.size()));
    piece.division = best_division(piece, run.record.stop());
  }
  return is_any(piece.division->cut) ? &*piece.division : nullptr;
}

bool may_be_divided(const ChartPiece& piece) {
  return has_room_to_divide(piece) && piece.chart.status != Status::Failed;
}

SmallestRectangle box_of(const ChartPiece& piece) {
  std::vector<Index> all(to_size(piece.mesh->vertex_count()));
  std::iota(all.begin(), all.end(), 0);
  return box_of(piece, all);
}

SmallestRectangle box_of(const ChartPiece& piece, const std::vector<Index>& vertices) {
  std::vector<Vector2> points;
  for (const Index v : vertices)
    points.emplace_back(piece.chart.map->control_points().segment<2>(2 * v));
  return smallest_rectangle(points);
}

double area_of(const SmallestRectangle& box) { return box.along * box.across; }

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
