// Packing of outlines on a grid: every chart is put at the lowest place where its cells, and those
// around it within the gap, are free, also in bays and holes of others. Quarter turns are tried.
//
//   const auto job = packing_job({map}, {AllowedRotations::Any}, 0.01);
//   const std::optional<Strip> strip = raster_strip(job, 2048, 2.5);    // 2.5 units wide
//
// Large charts come first, each into the first tile where it fits. A cell belongs to a chart if the
// outline may meet it. The placed chart is tested with all cells that its outline, grown by the
// gap, may meet, so the distance holds for the outlines, not only for their cells.
//
// Cost: #charts * cells of their boxes, and once #cells of the grid for each size of charts, 64
// cells at a time.
//
// cells_of() returns the cells of a grid that an outline may meet, or come closer to than a given
// distance.
//
//   const ChartOutline chart = chart_outline(map, layout_unit({map}), 1e-3);
//   const CellRuns cells = cells_of(chart, 2, {0, 0}, 0.01, 0.04);   // half turned, on a grid of
//                                                                     // 0.01, as far as 0.04
#pragma once

#include <vector>

#include "majorant/parametrization/packing/internal/chart_outline.h"
#include "majorant/parametrization/packing/internal/placements.h"

namespace majorant {

// Packs on square cells. cells: their number along the strip's width.
std::optional<Strip> raster_strip(const PackingJob& job, int cells, double width);

struct CellRun {
  int row, begin, end;  // cells [begin, end) of a row; numbers may be negative
};
using CellRuns = std::vector<CellRun>;  // by row, then by column

// Returns the cells of which a point is within `distance` of the chart, its outline's reach and
// rounding included. Cell (i, j) is [i, i + 1] x [j, j + 1] times `cell`. The chart is rotated by
// `quarters` and its box put at `low`.
CellRuns cells_of(const ChartOutline& chart, int quarters, const Vector2& low, double cell,
                  double distance);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
