// The layout as a picture shows it.
#pragma once

#include "majorant/maps/map_file.h"
#include "majorant/pictures/pictures.h"

namespace majorant {

// The direction that is to be horizontal: that of the longer side, or (1, 0) where the layout stays
// as it is.
Vector2 picture_direction(const MapFile& map, Alignment alignment);
// The map with `direction` in the plane made horizontal.
MapFile turned(const MapFile& map, const Vector2& direction);
Vector2 turned(const Vector2& uv, const Vector2& direction);

// Returns whether the layout was made for the unit square: claimed to be normalized, or of those
// who know no other layouts, which make no claims.
bool is_for_unit_square(const MapFile& map);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
