#include "majorant/parametrization/atlas/internal/fill.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "majorant/framework/error.h"
#include "majorant/parametrization/atlas/internal/chart_cutting.h"
#include "majorant/parametrization/atlas/internal/division.h"
#include "majorant/parametrization/atlas/internal/placement.h"

namespace majorant {
namespace {

// Upper bounds on packings on the way to a fill, with and without UnwrapOptions::least_fill. Each
// packing takes as long as the first one.
constexpr int kMaxPackings = 16, kMaxUsualPackings = 6;
// The number of charts examined in a layout on the way to kUsualFill: those that leave most of
// their boxes empty.
constexpr std::size_t kMaxCandidates = 4;
// The weight of the squared longer sides of boxes, beside that of the square that holds all.
// Without it, dividing one of two charts that are as long as the square would gain nothing.
constexpr double kLongBoxWeight = 0.05;
// A layout below kUsualFill is kept if the relative growth of its fill is at least this many times
// that of its seams.
constexpr double kFillPerSeam = 2;

// Returns as many charts as fill the square if the packing shrinks as its boxes do, those first
// that save most area for their cost. If no division makes boxes smaller, returns the chart that
// costs least per area of its smaller part, since smaller charts leave smaller gaps. Throws
// Stopped.
std::vector<std::size_t> charts_for_fill(ChartSet& set, double least_fill, const UnwrapRun& run) {
  std::vector<std::pair<double, std::size_t>> by_saving, by_price;
  const double area = run.surface.area();
  double boxes = 0;
  for (std::size_t k = 0; k < set.pieces.size(); ++k) {
    boxes += area_of(box_of(set.pieces[k]));
    const Division* const division =
        may_be_divided(set.pieces[k]) ? division_of(set, k, run) : nullptr;
    if (!division) continue;
    by_price.emplace_back(division->price, k);
    const double cost = division->cost * std::sqrt(area) + kChartCost * area;
    if (division->saved_area > 0) by_saving.emplace_back(-division->saved_area / cost, k);
  }
  if (by_saving.empty() && !by_price.empty())
    return {std::min_element(by_price.begin(), by_price.end())->second};
  std::sort(by_saving.begin(), by_saving.end());
  const double target = boxes * set.packing->fill / least_fill;
  std::vector<std::size_t> next;
  for (const auto& [unused, k] : by_saving) {
    if (boxes <= target) break;
    boxes -= set.pieces[k].division->saved_area;
    next.push_back(k);
  }
  return next;
}

// Divides charts, those first that save most area for their cost, until the fill is reached or no
// area is saved any more. Layouts on the way may be emptier than earlier ones, so a copy of the
// fullest one is kept.
ChartSet fill_at_any_cost(ChartSet set, double least_fill, UnwrapRun& run) {
  ChartSet best = set;
  try {
    for (int packings = 0; set.packing->fill < least_fill; ++packings) {
      if (packings == kMaxPackings) {
        best.division = Status::MaxIterations;
        break;
      }
      const std::vector<std::size_t> next = charts_for_fill(set, least_fill, run);
      if (next.empty()) break;
      Divided divided = divide_charts(std::move(set), next, run);
      if (!divided.is_complete) {
        best.division = run.end();
        break;
      }
      set = place_smallest(std::move(divided.set), run);
      if (set.packing->fill > best.packing->fill) best = set;
    }
  } catch (const Stopped& stop) {
    best.division = stopped_status(stop.why());
  }
  return best;
}

// A path across a chart, and the layout of boxes if it is cut there.
struct Attempt {
  std::size_t chart = 0;
  PathAcross path;
  double side = 0;   // of the square
  double gain = 0;   // decrease of size_of() per length of the path
  double price = 0;  // length of the path per area of the smaller part
};

// Returns whether attempt a is better than b. Of two that make the square small enough the shorter
// is better, else the one that gains most, or the cheaper one if neither gains anything.
bool is_better(const Attempt& a, const Attempt& b, double target_side) {
  const bool suffices = a.side <= target_side, other_suffices = b.side <= target_side;
  if (suffices != other_suffices) return suffices;
  if (suffices) return a.path.length < b.path.length;
  return std::max(a.gain, b.gain) > 0 ? a.gain > b.gain : a.price < b.price;
}

Vector2 sides_of(const SmallestRectangle& box) {
  return {std::max(box.along, box.across), std::min(box.along, box.across)};
}

double size_of(const std::vector<Vector2>& boxes, double side) {
  double size = side * side;
  for (const Vector2& box : boxes) size += kLongBoxWeight * box.x() * box.x();
  return size;
}

// Returns u, v of the vertices of a chart.
Vec corners_of(const ChartPiece& piece) {
  return piece.chart.map->control_points().head(2 * piece.mesh->vertex_count());
}

// Returns the charts that leave most of their boxes empty.
std::vector<std::size_t> emptiest_charts(const ChartSet& set) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t k = 0; k < set.pieces.size(); ++k) {
    const ChartPiece& piece = set.pieces[k];
    const double empty = area_of(box_of(piece)) - piece.chart.stretch.image_area;
    if (may_be_divided(piece)) order.emplace_back(-empty, k);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::size_t> emptiest;
  for (std::size_t i = 0; i < std::min(order.size(), kMaxCandidates); ++i)
    emptiest.push_back(order[i].second);
  return emptiest;
}

// Returns the best path of at most this length across one of the emptiest charts, or none. Throws
// Stopped.
std::optional<Attempt> best_attempt(const ChartSet& set, double max_length, const UnwrapRun& run) {
  const PackOptions& packing = *run.options.packing;
  std::vector<Vector2> boxes;
  for (const ChartPiece& piece : set.pieces) boxes.push_back(sides_of(box_of(piece)));
  const double side = side_of_shelves(boxes, packing), size = size_of(boxes, side);
  // Outlines leave smaller gaps than boxes, by the same factor before and after a division.
  const double target_side = side * std::sqrt(set.packing->fill / kUsualFill);
  std::optional<Attempt> best;
  for (const std::size_t k : emptiest_charts(set)) {
    run.record.announce(fmt::format("where chart {} of {} divides best", k + 1, set.pieces.size()));
    const ChartPiece& piece = set.pieces[k];
    for (PathAcross& path :
         paths_across(*piece.mesh, piece.preferences, corners_of(piece), run.record.stop())) {
      if (path.length > max_length) continue;
      Attempt attempt{k, std::move(path)};
      std::vector<Vector2> after = boxes;
      after[k] = sides_of(box_of(piece, attempt.path.outlines[0]));
      after.push_back(sides_of(box_of(piece, attempt.path.outlines[1])));
      attempt.side = side_of_shelves(after, packing);
      if (!std::isfinite(attempt.side)) continue;
      attempt.gain = (size - size_of(after, attempt.side)) / attempt.path.length;
      attempt.price = attempt.path.length / attempt.path.smaller_area;
      if (!best || is_better(attempt, *best, target_side)) best = std::move(attempt);
    }
  }
  return best;
}

// Returns the total length of all charts' borders on the surface.
double border_length(const ChartSet& set) {
  double length = 0;
  for (const ChartPiece& piece : set.pieces)
    for (Index h = 0; h < piece.mesh->half_edge_count(); ++h)
      if (piece.mesh->opposite(h) < 0) length += piece.mesh->edge_length(h);
  return length;
}

// Divides charts one by one until they fill kUsualFill of the square, or until the added seams
// exceed the bound of kLittleSeam or kMoreSeam. Layouts on the way may be emptier or not worth
// their seams, so a copy of the best one is kept.
ChartSet fill_for_little_seam(ChartSet set, UnwrapRun& run) {
  ChartSet best = set;
  const double fill = set.packing->fill, seams = border_length(set) / 2, cuts = set.cuts.length;
  const double allowed = (fill < kLowFill ? kMoreSeam : kLittleSeam) * seams;
  const auto added = [&](const ChartSet& charts) { return charts.cuts.length - cuts; };
  try {
    for (int k = 0; k < kMaxUsualPackings && set.packing->fill < kUsualFill; ++k) {
      const std::optional<Attempt> next = best_attempt(set, allowed - added(set), run);
      if (!next) break;
      ChartPiece& piece = set.pieces[next->chart];
      piece.division = Division{
          .cut = cut_along_path(*piece.mesh, piece.preferences, next->path, run.record.stop())};
      Divided divided = divide_charts(std::move(set), {next->chart}, run);
      if (!divided.is_complete || added(divided.set) > allowed) break;
      set = place_smallest(std::move(divided.set), run);
      const double least = std::min(kUsualFill, fill * (1 + kFillPerSeam * added(set) / seams));
      if (set.packing->fill > best.packing->fill && set.packing->fill >= least) best = set;
    }
  } catch (const Stopped&) {
  } catch (const Error& e) {  // the padding of more charts does not fit
    if (e.kind() != ErrorKind::Unsupported) throw;
  }
  return best;
}

// Returns whether no option fixes the number of charts or the size of the square, and no chart has
// pins, handles or unmet limits.
bool is_filled_as_usual(const ChartSet& set, const UnwrapOptions& options) {
  const bool has_fixed =
      std::any_of(set.pieces.begin(), set.pieces.end(),
                  [](const ChartPiece& piece) { return !piece.chart.pins.empty(); });
  const Status status = set.status();
  return options.least_charts == 0 && !options.packing->side && !has_fixed &&
         (status == Status::Converged || status == Status::Stalled);
}

}  // namespace

ChartSet fill(ChartSet set, UnwrapRun& run) {
  if (const std::optional<double> least = run.options.least_fill)
    return fill_at_any_cost(std::move(set), *least, run);
  if (is_filled_as_usual(set, run.options) && set.packing->fill < kUsualFill)
    return fill_for_little_seam(std::move(set), run);
  return set;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
