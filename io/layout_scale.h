// The units of the surface per unit of uv of a file.
//
//   const MapFile file = read_map("bunny.vtu");
//   const double scale = layout_scale(file);
//   if (has_assumed_scale(file)) { /* tell the user that it is assumed */ }
//
// Distortion compares lengths in the plane with lengths on the surface. A layout in the unit square
// is therefore measured at the scale in its claims. Files without claims are by other programs,
// whose uv have no scale: they are scaled so that layout and surface have the same area.
#pragma once

#include "majorant/maps/map_file.h"

namespace majorant {

// Returns the factor of uv for comparisons with the surface. It is the claimed one
// (claimed_scale()). For files without claims it is sqrt(area of the surface / area of the layout),
// with areas of inverted cells counted as positive, or 1 if that is not finite. Throws
// Error(Unreadable) for claims that `check` refuses.
double layout_scale(const MapFile& file);

// Returns whether layout_scale() assumes equal areas.
bool has_assumed_scale(const MapFile& file);

// Returns the area of the image of cell c, in uv units squared, exact up to rounding; negative if
// it is inverted.
double image_area(const MapFile& file, Index c);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
