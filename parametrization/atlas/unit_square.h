// An atlas moved into the unit square: for textures, whose coordinates lie between 0 and 1.
//
//   Atlas atlas = unwrap(mesh, {}, record);
//   const std::optional<AtlasSquare> square = into_unit_square(atlas);
//   if (square) atlas.charts.front().map;   // uv = (uv of before - square->origin) / square->size
#pragma once

#include <optional>

#include "majorant/framework/stop_check.h"
#include "majorant/parametrization/atlas/unwrap.h"

namespace majorant {

struct AtlasSquare {
  Vector2 origin;
  double size = 1;
};

// Moves the maps of all charts at one scale: the packing's square becomes the unit square, without
// a packing the common box of the charts, its larger side 1. Division rounds; where that turns a
// triangle over, lets charts touch or come closer than the packing promises, the next power of two
// is the size instead, which rounds nothing but the shift. None, and the atlas as it was, where
// that does not help. Measures stay those in model units.
std::optional<AtlasSquare> into_unit_square(Atlas& atlas, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
