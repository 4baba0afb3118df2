// Divides the charts of a packed set until they fill more of the square.
//
//   UnwrapOptions full;
//   full.least_fill = 0.7;
//   UnwrapRun run(*mesh, full, record);
//   ChartSet set = solve(charts_along(choose_cuts(*mesh, {}), run), run);
//   set = fill(place(std::move(set), run), run);
//   std::cout << set.packing->fill << "\n";
#pragma once

#include "majorant/parametrization/atlas/internal/chart_set.h"

namespace majorant {

// Returns the fullest layout found on the way to UnwrapOptions::least_fill. Without that option,
// returns a layout whose fill is worth its seams (kUsualFill, kLittleSeam, kMoreSeam). set: packed,
// all charts with maps. The result's `division` says why least_fill is not reached.
ChartSet fill(ChartSet set, UnwrapRun& run);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
