// Texture coordinates as floats that leave every triangle its room: for formats whose numbers are
// floats.
//
//   const MapFile rounded = with_room_in_floats(file, StoredV::Down);    // u and 1 - v are floats
//
// Near 1 floats are 6e-8 apart. The image of a needle, or of a sliver of the model, may be thinner
// than that, and the two sides of a slit nearer to each other; rounding alone turns such triangles
// over. Their points are moved apart by a few units in the last place, a ten-thousandth of a pixel,
// before they are rounded.
//
// Not for maps whose cells are curved: writers take them to pieces first.
#pragma once

#include "majorant/maps/map_file.h"

namespace majorant {

// The coordinate that is stored beside u: v, or 1 - v, as glTF has it.
enum class StoredV { Up, Down };

// map: of degree 1, v upwards. Cells that are positive stay so where what is stored is rounded to
// floats, and borders that do not meet stay apart; points at one place stay at one place. The map
// as it is where plain rounding does so already, and where no such floats are found, which the
// proof of the file says then.
MapFile with_room_in_floats(const MapFile& map, StoredV v);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
