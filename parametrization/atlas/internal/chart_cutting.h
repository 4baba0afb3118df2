// Cuts charts of a set and maps their parts.
//
//   const UnwrapOptions defaults;
//   UnwrapRun run(*mesh, defaults, record);
//   ChartSet set = solve(charts_along(choose_cuts(*mesh, {}), run), run);
//   const auto halves = [](const ChartSet& charts, const StopCheck& check) {
//     const ChartPiece& first = charts.pieces.front();
//     std::vector<HalfEdgeFlags> cuts;
//     cuts.push_back(cut_in_two(*first.mesh, first.preferences, PartsAround::Planes, check));
//     return cuts;
//   };
//   Recut recut = cut_and_solve(std::move(set), {0}, halves, run);
//   set = std::move(recut.set);
#pragma once

#include <functional>

#include "majorant/parametrization/atlas/internal/chart_set.h"

namespace majorant {

struct CutCharts {
  ChartSet set;
  std::vector<std::size_t> changed;  // numbers of the charts without a map
  // The charts that were cut, in the order of their numbers in `which`.
  std::vector<ChartPiece> parents;
};
// Replaces these charts by their parts. The first part takes its parent's number, the others are
// appended. cuts: flags of each chart.
CutCharts cut_charts(ChartSet set, const std::vector<std::size_t>& which,
                     const std::vector<HalfEdgeFlags>& cuts, const UnwrapRun& run);

struct Recut {
  ChartSet set;
  bool is_complete = false;  // no limit of the run was reached
};
// Returns flags for each of the charts that are to be cut; may throw Stopped.
using CutChooser =
    std::function<std::vector<HalfEdgeFlags>(const ChartSet& set, const StopCheck& stop)>;
// Replaces these charts by their parts and maps these, as another pass of the run. If a limit of
// the run is reached on the way, returns the old set, since its maps are better than the initial
// maps of the parts. Only the charts that are replaced are copied for that.
Recut cut_and_solve(ChartSet set, const std::vector<std::size_t>& which, const CutChooser& choose,
                    UnwrapRun& run);

// Returns flags for each of these charts. Charts that are to be stacked are cut like the first one
// of their kind.
std::vector<HalfEdgeFlags> cut_alike(
    const ChartSet& set, const std::vector<std::size_t>& which, Stacking stacking,
    const std::function<HalfEdgeFlags(const ChartPiece& piece)>& cut);

// Returns u, v of these vertices of a chart.
Vec uv_of_vertices(const Chart& chart, const std::vector<Index>& vertices);

bool is_any(const HalfEdgeFlags& flags);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
