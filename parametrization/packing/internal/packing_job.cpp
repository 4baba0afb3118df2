#include "majorant/parametrization/packing/internal/packing_job.h"

#include <cmath>
#include <limits>

#include "majorant/certify/moved_layout.h"

namespace majorant {
namespace {

// The accuracy of polygons that follow curves, relative to the square root of the charts' area: a
// twentieth of 4 pixels in 1024.
constexpr double kReach = 2e-4;

}  // namespace

PackingJob packing_job(const std::vector<BezierMap>& charts,
                       const std::vector<AllowedRotations>& freedom, double gap,
                       const PackingGoal& goal, const StopCheck& stop) {
  PackingJob job;
  job.tiles = goal.tiles;
  job.stop = stop;
  job.gap = gap;
  job.unit = layout_unit(charts);
  for (const BezierMap& chart : charts) job.area += chart_area(chart, job.unit);
  const double reach = kReach * std::sqrt(job.area);
  Vector2 corner = Vector2::Constant(std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < charts.size(); ++k) {
    stop.poll();
    const bool is_free = freedom[k] == AllowedRotations::Any;
    const std::optional<Vector2> upright =
        is_free && goal.up ? upright_turn(charts[k], *goal.up) : std::nullopt;
    job.charts.push_back(
        upright ? upright_outline(charts[k], job.unit, reach, *upright)
                : chart_outline(charts[k], job.unit, reach, is_free ? Turn::Tightest : Turn::None));
    if (!goal.quarter_turns || (!is_free && goal.up)) job.charts.back().quarter_turns = 1;
    if (freedom[k] == AllowedRotations::None) corner = corner.cwiseMin(job.charts[k].low);
  }
  if (corner.allFinite()) job.corner = corner;
  job.fixed.resize(charts.size());
  for (std::size_t k = 0; k < charts.size(); ++k)
    if (freedom[k] == AllowedRotations::None) job.fixed[k] = job.charts[k].low - job.corner;
  return job;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
