// Islands of a file's texture coordinates as charts that keep their shapes, for packing alone.
//
//   const std::vector<BezierMap> charts = kept_islands({mesh});
//
// Islands that overlap themselves or are inverted, in part or as a whole, are refused: no motion of
// the plane repairs them.
#pragma once

#include <memory>
#include <vector>

#include "majorant/maps/bezier_map.h"

namespace majorant {

// Returns the coordinates of islands, pieces of one surface that is cut where its texture
// coordinates are. They are scaled so that together they have the area of the surface. If that
// scale rounds a face to zero area, a power of two near it is used. Throws Error(Unsupported)
// naming a face of the file that has no texture coordinates or no area or is inverted, or the place
// where an island overlaps.
std::vector<BezierMap> kept_islands(const std::vector<std::shared_ptr<const SurfaceMesh>>& islands);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
