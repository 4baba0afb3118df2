// A chart as the packers see it: turned until its smallest box lies straight, its boundary as
// polygons.
//
//   const ChartOutline chart = chart_outline(map, layout_unit({map}), 1e-3);
//   chart.size;                     // of its box, at the origin
//   const auto& loop = chart.outline.loops[0];   // points on the boundary, in order
//
// A chart is where the chart goes when its turn is applied, its control points are divided by the
// unit, and `chart.low` is subtracted.
#pragma once

#include <optional>
#include <vector>

#include "majorant/maps/bezier_map.h"

namespace majorant {

// Contains the chart: no point of the image is farther than `reach` from what the polygons enclose.
struct Outline {
  std::vector<std::vector<Vector2>> loops;  // closed, the surface on their left; holes as well
  double reach = 0;                         // 0: the chart is bounded by lines
};

struct ChartOutline {
  double cosine = 1, sine = 0;  // of its turn
  Vector2 low;                  // of the turned chart's box
  Vector2 size;                 // of the box, which contains the outline and all control points
  Outline outline;              // relative to `low`
  double area = 0;              // of the image
  int quarter_turns = 4;        // how many of the turns by 0, 1, ... quarters may be tried
};

enum class Turn { Tightest, None };

// Cosine and sine of the turn after which `up`, a direction on the surface, points upwards in the
// chart, in the mean over its area; none where it has no direction there.
std::optional<Vector2> upright_turn(const BezierMap& chart, const Vector3& up);

// unit: layout_unit(). reach: curves are cut until that is enough, in units.
ChartOutline chart_outline(const BezierMap& chart, double unit, double reach,
                           Turn turn = Turn::Tightest);
// After this turn, and as it is then: no quarter turns.
ChartOutline upright_outline(const BezierMap& chart, double unit, double reach,
                             const Vector2& turn);

// The area of the image, in units squared.
double chart_area(const BezierMap& chart, double unit);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
