// Places the charts of a set in one square or in tiles: packed, or stacked on their copies.
//
//   UnwrapOptions stacked;
//   stacked.stacking = Stacking::Equal;
//   UnwrapRun run(*mesh, stacked, record);
//   ChartSet set = solve(charts_along(choose_cuts(*mesh, {}), run), run);
//   set = place(std::move(set), run);
//   std::cout << set.packing->fill << "\n";
//
// pack.h packs; this file adds stacked and pinned charts.
#pragma once

#include "majorant/parametrization/atlas/internal/chart_set.h"

namespace majorant {

// Returns the set with its packing by UnwrapOptions::packing and stacking. All charts have maps. If
// the run is to end before that, boxes are arranged quickly and `packed` says so. Throws
// Error(Infeasible) if pins put charts on top of each other; Error as pack().
ChartSet place(ChartSet set, UnwrapRun& run);

// Returns the set packed into the smallest square. Throws Stopped; the set is then lost.
ChartSet place_smallest(ChartSet set, UnwrapRun& run);

// Returns the map `under`, or its reflection at u = 0, with the faces of `map`.
BezierMap map_on(const BezierMap& under, const BezierMap& map, const StackPlace& place);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
