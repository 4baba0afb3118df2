// Enforces the limit of stretch: charts that exceed it, or have no map, are cut and mapped again.
//
//   UnwrapOptions strict;
//   strict.cuts.max_stretch = 1.005;
//   UnwrapRun run(*mesh, strict, record);
//   ChartSet set = solve(charts_along(choose_cuts(*mesh, {}), run), run);
//   set = limit_stretch(std::move(set), run);
//   for (const ChartPiece& piece : set.pieces)
//     if (exceeds_stretch(strict, piece.chart)) std::cerr << why_stretched(strict, piece.chart);
//
// A chart is first cut as one piece, at most twice, then parted in two. Charts of unfolded panels
// that overlap are cut across. If the two sides of one of their cuts coincide once unfolded, that
// cut is closed instead.
#pragma once

#include "majorant/parametrization/atlas/internal/chart_set.h"

namespace majorant {

// Returns the set in order, with all charts within the limit except charts of one face, held ones
// and those that a limit of the run leaves. Within the time that a start may take, charts without a
// map are still cut and mapped after that limit. Charts that exceed the stretch get the status of
// the run's end.
ChartSet limit_stretch(ChartSet set, UnwrapRun& run);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
