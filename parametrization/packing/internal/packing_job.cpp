#include "majorant/parametrization/packing/internal/packing_job.h"

#include <cmath>
#include <limits>

#include "majorant/certify/moved_layout.h"

namespace majorant {
namespace {

// Curves are followed by polygons this close, as a part of the square root of the charts' area.
// A twentieth of 4 pixels in 1024.
constexpr double kReach = 2e-4;

}  // namespace

PackingJob packing_job(const std::vector<BezierMap>& charts,
                       const std::vector<AllowedRotations>& freedom, double gap,
                       const StopCheck& stop) {
  PackingJob job;
  job.stop = stop;
  job.gap = gap;
  job.unit = layout_unit(charts);
  for (const BezierMap& chart : charts) job.area += chart_area(chart, job.unit);
  const double reach = kReach * std::sqrt(job.area);
  Vector2 corner = Vector2::Constant(std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < charts.size(); ++k) {
    stop.poll();
    job.charts.push_back(
        chart_outline(charts[k], job.unit, reach,
                      freedom[k] == AllowedRotations::Any ? Turn::Tightest : Turn::None));
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
