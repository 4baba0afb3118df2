// A chart as input of the packers: rotated until its smallest bounding box is axis-aligned, its
// boundary as polygons.
//
//   const ChartOutline chart = chart_outline(map, layout_unit({map}), 1e-3);
//   chart.size;                     // of its box, at the origin
//   const auto& loop = chart.outline.loops[0];   // points on the boundary, in order
//
// The outline's coordinates are those of the chart after rotation, division of its control points
// by the unit, and subtraction of `chart.low`.
#pragma once

#include <optional>
#include <vector>

#include "majorant/maps/bezier_map.h"

namespace majorant {

// Polygons that approximate the boundary of a chart: no point of the image is farther than `reach`
// from the region that they enclose.
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

// Returns cosine and sine of the rotation after which `up`, a direction on the surface, points
// upwards in the mean over the chart's area; none if the chart lies across it.
std::optional<Vector2> upright_turn(const BezierMap& chart, const Vector3& up);

// Returns the outline. unit: layout_unit(). reach: the accuracy to which curves are subdivided, in
// units.
ChartOutline chart_outline(const BezierMap& chart, double unit, double reach,
                           Turn turn = Turn::Tightest);
// Returns the outline after this rotation, without quarter turns.
ChartOutline upright_outline(const BezierMap& chart, double unit, double reach,
                             const Vector2& turn);

// Returns the area of the image, in squared units.
double chart_area(const BezierMap& chart, double unit);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
