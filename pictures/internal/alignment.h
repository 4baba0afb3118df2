// The orientation of a layout in pictures.
#pragma once

#include "majorant/maps/map_file.h"
#include "majorant/pictures/pictures.h"

namespace majorant {

// Returns the direction that becomes horizontal: that of the longer side, or (1, 0) if the layout
// is not turned.
Vector2 picture_direction(const MapFile& map, Alignment alignment);
// Returns the map turned so that `direction` is horizontal.
MapFile turned(const MapFile& map, const Vector2& direction);
Vector2 turned(const Vector2& uv, const Vector2& direction);

// Returns whether the layout is for the unit square: it claims to be normalized, or it has no
// claims, like files of other programs, whose layouts always are.
bool is_for_unit_square(const MapFile& map);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
