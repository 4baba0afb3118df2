// The input of every packer: the charts as charts, in units.
//
//   const std::vector<BezierMap> charts{map, map};
//   const std::vector<AllowedRotations> freedom(charts.size(), AllowedRotations::Any);
//   const PackingJob job = packing_job(charts, freedom, 4.0 / 1024);
#pragma once

#include <optional>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/parametrization/packing/internal/chart_outline.h"

namespace majorant {

// None: stays where it is. QuarterTurns, because these round nothing.
enum class AllowedRotations { Any, QuarterTurns, None };

// PackOptions, of where charts go.
struct PackingGoal {
  int tiles = 1;
  std::optional<Vector3> up = {};  // of charts with any rotation
  bool quarter_turns = true;
};

struct PackingJob {
  std::vector<ChartOutline> charts;
  // Lower left corners of those that stay where they are, relative to that of the square.
  std::vector<std::optional<Vector2>> fixed;
  int tiles = 1;    // that charts may be spread over
  double gap = 0;   // of any two, as a part of the square's side
  double unit = 1;  // layout_unit() of the charts: what everything here is divided by
  Vector2 corner = Vector2::Zero();  // of the square, where some stay
  double area = 0;                   // of all charts
  StopCheck stop;
};

PackingJob packing_job(const std::vector<BezierMap>& charts,
                       const std::vector<AllowedRotations>& freedom, double gap,
                       const PackingGoal& goal = {}, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
