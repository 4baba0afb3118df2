// Levels and closes the borders of baked charts. Texels around charts are levelled so that a
// bilinear filter reads the surface's values at borders; texels at cuts are closed so that it reads
// the same on both sides (seam_levelling.h has the least squares).
#pragma once

#include <vector>

#include "majorant/pictures/baking/bake.h"
#include "majorant/pictures/baking/internal/layout_values.h"
#include "majorant/pictures/baking/seam_levelling.h"

namespace majorant {

// A texel around a chart and the point of the surface that it shows.
struct AroundTexel {
  std::size_t texel;
  Vector3 position;
};

// Texels that have values.
struct BakedTexels {
  TexelGrid grid;
  Transfer transfer;  // of the image
  Transfer seen;      // for pictures: the encoding in which differences are visible
  std::vector<Texel> texels;
  std::vector<std::vector<AroundTexel>> around;  // by band, ascending
  Raster image;
};

// Sets texels around charts so that a filter reads the surface's values at the charts' borders.
void level_borders(const LayoutValues& values, const StopCheck& stop, BakedTexels& baked);

// Changes texels at cuts so that a filter reads the same on both sides.
void close_cuts(const LayoutValues& values, const StopCheck& stop, BakedTexels& baked);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
