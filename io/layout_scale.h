// Units of the surface per unit of uv of a file.
//
//   const MapFile file = read_map("bunny.vtu");
//   const double scale = layout_scale(file);
//   if (has_assumed_scale(file)) { /* say so where numbers or colours depend on it */ }
//
// Distortion compares lengths in the plane with lengths on the surface, so a layout that was moved
// into the unit square is measured at the scale it was made in, which its claims tell. Files that
// claim nothing are by other programs, whose uv have no scale: theirs is that at which layout and
// surface have the same area.
#pragma once

#include "majorant/maps/map_file.h"

namespace majorant {

// The factor of uv before it is compared with the surface: that of the claims (claimed_scale());
// sqrt(area of the surface / area of the layout) for files without claims, the areas of inverted
// cells counted as positive, and 1 where that is not finite. Throws Error(Unreadable) for claims
// that `check` refuses.
double layout_scale(const MapFile& file);

// Returns whether layout_scale() is that of equal areas.
bool has_assumed_scale(const MapFile& file);

// Area of the image of cell c, uv units squared, exact but for rounding; negative where it is
// inverted.
double image_area(const MapFile& file, Index c);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
