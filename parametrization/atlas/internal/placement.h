// Places the charts of a set in one square, or in tiles: packed, or on top of their copies.
//
//   UnwrapOptions stacked;
//   stacked.stacking = Stacking::Equal;
//   UnwrapRun run(*mesh, stacked, record);
//   ChartSet set = solve(charts_along(choose_cuts(*mesh, {}), run), run);
//   set = place(std::move(set), run);
//   std::cout << set.packing->fill << "\n";
//
// pack.h packs; here is what charts that are stacked or pinned add to that.
#pragma once

#include "majorant/parametrization/atlas/internal/chart_set.h"

namespace majorant {

// Returns the set with its packing as UnwrapOptions::packing and stacking say; charts have maps.
// Where the run is to end before that, boxes are arranged quickly and `packed` says so. Throws
// Error(Infeasible) if pins put charts on top of each other; Error as pack().
ChartSet place(ChartSet set, UnwrapRun& run);

// Returns the set with a packing of the smallest square. Throws Stopped, and the set is lost.
ChartSet place_smallest(ChartSet set, UnwrapRun& run);

// Returns the map of the same faces as `map` that lies on `under`, or mirrored at u = 0.
BezierMap map_on(const BezierMap& under, const BezierMap& map, const StackPlace& place);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
