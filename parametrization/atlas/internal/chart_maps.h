// Gives the charts of a set their maps: solved, kept as the file has them, or scaled.
//
//   const UnwrapOptions defaults;
//   UnwrapRun run(*mesh, defaults, record);
//   ChartSet set = solve(charts_along(choose_cuts(*mesh, {}), run), run);
//   if (lacks_maps(set)) set = limit_stretch(std::move(set), run);
//
// Maps are independent of each other and of the number of threads.
#pragma once

#include "majorant/parametrization/atlas/internal/chart_set.h"

namespace majorant {

// Maps the charts with these numbers, or all. If the run is stopped, some charts remain without a
// map; that throws no error.
ChartSet solve(ChartSet set, std::vector<std::size_t> which, UnwrapRun& run);
ChartSet solve(ChartSet set, UnwrapRun& run);

// Gives every chart the map of Islands::Kept. Throws the errors of kept_islands().
ChartSet keep_islands(ChartSet set, UnwrapRun& run);

// Scales the maps by UnwrapOptions::face_scale. Throws InvalidArgument if the factor differs within
// a chart.
ChartSet scaled(ChartSet set, const UnwrapRun& run);

// Gives the piece this map and measures it.
void set_map(ChartPiece& piece, BezierMap map, const UnwrapRun& run);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
