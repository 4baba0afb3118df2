#include "majorant/parametrization/packing/internal/nesting.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <libnest2d/common.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include "majorant/maps/smallest_rectangle.h"
#include "majorant/parametrization/packing/internal/outer_polygon.h"

// libnest2d is C++11 and compares angles by operators that are ambiguous in C++20.
namespace libnest2d {
inline bool operator!=(const Radians& a, const Radians& b) {
  return static_cast<double>(a) != static_cast<double>(b);
}
}  // namespace libnest2d

#include <libnest2d/libnest2d.hpp>

namespace majorant {
namespace {

// Upper bound on the corners of nested polygons. A no-fit polygon costs the product of the numbers
// of corners.
constexpr std::size_t kCorners = 24;
// Integers along the square. Clipper multiplies in 64 bits for coordinates below 2^30, and items
// start outside the square.
constexpr double kIntegers = 0x1p26;
// The margin added to the gap, in those integers. Every corner is rounded once when it is scaled
// and once when it is offset, and so is that of the other polygon.
constexpr int kRounding = 4;

// Upper bound on calls of the stop condition per item, several times what n items take. The
// condition is called before every item and every square that libnest2d opens for one. Without the
// bound an item that fits into no square would make it open squares without end.
constexpr std::size_t kQuestionsPerItem = 16;

libnest2d::Item item_of(const ChartOutline& chart, double scale) {
  std::vector<Vector2> points;
  for (const std::vector<Vector2>& loop : chart.outline.loops)
    points.insert(points.end(), loop.begin(), loop.end());
  ClipperLib::Path path;
  for (const Vector2& p : outer_polygon(convex_hull(std::move(points)), kCorners))
    path.emplace_back(std::llround(p.x() * scale), std::llround(p.y() * scale));
  std::reverse(path.begin(), path.end());
  path.push_back(path.front());
  return libnest2d::Item(std::move(path));
}

// Returns the lower left corner of the chart's box after the rotation about the origin.
Vector2 turned_corner(const Vector2& size, int quarters) {
  return {quarters == 1   ? -size.y()
          : quarters == 2 ? -size.x()
                          : 0.0,
          quarters == 2   ? -size.y()
          : quarters == 3 ? -size.x()
                          : 0.0};
}

}  // namespace

std::optional<Strip> nested_strip(const PackingJob& job, double width) {
  if (job.tiles > 1) return {};
  const double scale = kIntegers / width;
  double reach = 0;
  std::vector<libnest2d::Item> items;
  for (std::size_t k = 0; k < job.charts.size(); ++k) {
    if (job.fixed[k]) return {};
    reach = std::max(reach, job.charts[k].outline.reach);
    items.push_back(item_of(job.charts[k], scale));
  }
  const auto gap =
      static_cast<libnest2d::Coord>(std::ceil((job.gap * width + 2 * reach) * scale) + kRounding);
  const auto side = static_cast<libnest2d::Coord>(kIntegers) + gap;
  libnest2d::NfpPlacer::Config config;
  config.parallel = false;
  if (std::any_of(job.charts.begin(), job.charts.end(),
                  [](const ChartOutline& chart) { return chart.quarter_turns == 1; }))
    config.rotations = {libnest2d::Radians(0)};
  const libnest2d::NestConfig<> nesting(config);
  std::size_t questions = 0;
  const libnest2d::NestControl control([&] {
    return ++questions > kQuestionsPerItem * items.size() || job.stop() != Directive::Continue ||
           std::any_of(items.begin(), items.end(), [](const auto& i) { return i.binId() > 0; });
  });
  try {
    libnest2d::nest(items, libnest2d::Box(libnest2d::Point(0, 0), libnest2d::Point(side, side)),
                    gap, nesting, control);
  } catch (const std::exception&) {  // polygons that it rejects; the next size may work
    return {};
  }
  job.stop.poll();

  Strip strip;
  Vector2 low = Vector2::Constant(width), high = -low;
  for (std::size_t k = 0; k < items.size(); ++k) {
    if (items[k].binId() != 0) return {};
    const double turns = static_cast<double>(items[k].rotation()) * 2 / std::numbers::pi;
    const int quarters = static_cast<int>(std::lround(turns)) & 3;
    const Vector2 moved(static_cast<double>(items[k].translation().X),
                        static_cast<double>(items[k].translation().Y));
    const ChartOutline& chart = job.charts[k];
    strip.poses.push_back({quarters, moved / scale + turned_corner(chart.size, quarters)});
    low = low.cwiseMin(strip.poses[k].low);
    high = high.cwiseMax(strip.poses[k].low + size_after(chart, quarters));
  }
  for (Pose& pose : strip.poses) pose.low -= low;
  if ((high - low).x() > width) return {};
  strip.height = (high - low).y();
  return strip;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
