// Divides charts in two: first until none is larger than UnwrapOptions::max_chart_area, then until
// there are UnwrapOptions::least_charts, or as long as that lowers the cost of the layout
// (docs/atlas.md, "One chart or many").
//
//   const UnwrapOptions three{.least_charts = 3};
//   UnwrapRun run(*mesh, three, record);
//   ChartSet set = solve(charts_along(choose_cuts(*mesh, {}), run), run);
//   set = divide(std::move(set), run);
//   if (set.division != Status::Converged) std::cerr << status_name(set.division);
#pragma once

#include "majorant/maps/smallest_rectangle.h"
#include "majorant/parametrization/atlas/internal/chart_set.h"

namespace majorant {

// Returns the divided set, whose `division` says why it has no more charts. All charts have maps.
ChartSet divide(ChartSet set, UnwrapRun& run);

struct Divided {
  ChartSet set;
  bool is_complete = false;  // no limit of the run was reached
};
// Divides these charts along their ChartPiece::division, maps the parts and keeps the limit of
// stretch. If a limit of the run leaves a chart without a map, returns the old set.
Divided divide_charts(ChartSet set, const std::vector<std::size_t>& which, UnwrapRun& run);

// Returns the best division of chart k, or null if there is none. It is computed once and kept in
// the set. Throws Stopped.
const Division* division_of(ChartSet& set, std::size_t k, const UnwrapRun& run);
// Returns whether the chart has a map and may be divided for the sake of the layout.
bool may_be_divided(const ChartPiece& piece);

// Returns the smallest rectangle around the chart, or around these of its vertices.
SmallestRectangle box_of(const ChartPiece& piece);
SmallestRectangle box_of(const ChartPiece& piece, const std::vector<Index>& vertices);
double area_of(const SmallestRectangle& box);

// The cost of one chart of a layout, in square roots of the surface's area. The other costs are the
// length of seams, a quarter of it along creases, and the square that holds the charts.
inline constexpr double kChartCost = 0.1;

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
