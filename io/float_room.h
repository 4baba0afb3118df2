// Rounds texture coordinates to floats such that no triangle collapses, for formats with floats.
//
//   const MapFile rounded = with_room_in_floats(file, StoredV::Down);    // u and 1 - v are floats
//
// Near 1, floats are 6e-8 apart. The image of a needle or a sliver may be thinner than that, and
// the sides of a slit closer. Plain rounding turns such triangles over. Before rounding, their
// points are moved apart by a few units in the last place, a ten-thousandth of a pixel.
//
// Not for curved cells: writers subdivide them first.
#pragma once

#include "majorant/maps/map_file.h"

namespace majorant {

// The stored second coordinate. Up: v. Down: 1 - v, as in glTF.
enum class StoredV { Up, Down };

// map: of degree 1, v upwards. In the returned map, positive cells stay positive and borders that
// do not meet stay apart after rounding to floats; equal points stay equal. Returns the map itself
// if plain rounding does this, or if no such floats are found; the proof of the file fails then.
MapFile with_room_in_floats(const MapFile& map, StoredV v);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
