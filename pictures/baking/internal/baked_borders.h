// Borders and cuts of baked charts: texels around charts are levelled, so that a bilinear filter
// reads at borders what is there, and texels at cuts closed, so that it reads the same on both
// sides (seam_levelling.h has the least squares).
#pragma once

#include <vector>

#include "majorant/pictures/baking/bake.h"
#include "majorant/pictures/baking/internal/layout_values.h"
#include "majorant/pictures/baking/seam_levelling.h"

namespace majorant {

// Where the surface lies that a texel around a chart shows.
struct AroundTexel {
  std::size_t texel;
  Vector3 position;
};

// Texels that have values.
struct BakedTexels {
  TexelGrid grid;
  Transfer transfer;  // of the image
  Transfer seen;      // of a picture: in what differences are seen
  std::vector<Texel> texels;
  std::vector<std::vector<AroundTexel>> around;  // by band, ascending
  Raster image;
};

// Sets what is shown around charts so that a filter reads at their borders what is there.
void level_borders(const LayoutValues& values, const StopCheck& stop, BakedTexels& baked);

// Moves what is shown at cuts so that a filter reads the same on both sides.
void close_cuts(const LayoutValues& values, const StopCheck& stop, BakedTexels& baked);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
