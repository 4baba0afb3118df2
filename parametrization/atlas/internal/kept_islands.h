// Islands of a file's texture coordinates as charts that keep their shapes: for packing alone.
//
//   const std::vector<BezierMap> charts = kept_islands({mesh});
//
// Islands that are turned over, in part or as a whole, or overlap themselves are refused: a motion
// of the plane mends neither.
#pragma once

#include <memory>
#include <vector>

#include "majorant/maps/bezier_map.h"

namespace majorant {

// islands: pieces of one surface, cut where its texture coordinates are. Their coordinates, all at
// the scale at which together they have the area of the surface, or by a power of two near that
// where the scale rounds a face away. Throws Error(Unsupported) that names a face of the file:
// without texture coordinates, turned over, of no area; or the place where an island overlaps.
std::vector<BezierMap> kept_islands(const std::vector<std::shared_ptr<const SurfaceMesh>>& islands);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
