// Outlines on a grid: every chart at the lowest place where its cells and those around it, as far
// as the gap reaches, are free; bays and holes of others included. Quarter turns are tried.
//
//   const PackingJob job = packing_job({map, map}, {AllowedRotations::Any, AllowedRotations::Any}, 0.01);
//   const std::optional<Strip> strip = raster_strip(job, 2048, 2.5);    // 2.5 units wide
//
// Large charts first. A cell belongs to a chart if the outline may meet it; the chart that is
// placed is tested with all cells that its outline, grown by the gap, may meet: so the distance
// holds for the outlines, not only for their cells. Cost: #charts * cells of their boxes, and once
// #cells of the grid for each size of charts, 64 cells at a time.
#pragma once

#include "majorant/parametrization/packing/internal/placements.h"

namespace majorant {

// cells: of the strip's width, the others being as large.
std::optional<Strip> raster_strip(const PackingJob& job, int cells, double width);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
