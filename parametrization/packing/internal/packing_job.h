// The input of every packer: the outlines of the charts, in units.
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

// The rotations that a chart allows. QuarterTurns: they need no rounding. None: the chart stays
// where it is.
enum class AllowedRotations { Any, QuarterTurns, None };

// The options of PackOptions that concern where charts go.
struct PackingGoal {
  int tiles = 1;
  std::optional<Vector3> up = {};  // of charts with any rotation
  bool quarter_turns = true;
};

struct PackingJob {
  std::vector<ChartOutline> charts;
  // The lower left corners of fixed charts, relative to that of the square.
  std::vector<std::optional<Vector2>> fixed;
  int tiles = 1;    // that charts may be spread over
  double gap = 0;   // of any two charts, relative to the square's side
  double unit = 1;  // layout_unit() of the charts, by which all lengths here are divided
  Vector2 corner = Vector2::Zero();  // of the square, if some charts are fixed
  double area = 0;                   // of all charts
  StopCheck stop;
};

PackingJob packing_job(const std::vector<BezierMap>& charts,
                       const std::vector<AllowedRotations>& freedom, double gap,
                       const PackingGoal& goal = {}, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
