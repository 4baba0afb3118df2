// Sets texels around charts so that a bilinear filter reads the surface's values at the borders of
// charts. Both sides of a cut then look alike, also along folds [Liu, Ferguson, Jacobson and
// Gingold, Seamless: Seam erasure and seam-aware decoupling of shape from mesh resolution, 2017].
// Texels in charts do not change, or by a few codes.
//
//   Raster image(64, 64, 3, PixelDepth::Eight);
//   SeamReading seam;
//   if (reading_at(image, {0.25, 0.5}, seam.sides[0]) &&
//       reading_at(image, {0.75, 0.5}, seam.sides[1])) {
//     const RowMatrix grey = RowMatrix::Constant(1, 3, 0.5);
//     level_seams(image, Transfer::Srgb, {12, 13}, {seam.sides[0]}, grey);
//     close_seams(image, Transfer::Srgb, Transfer::Srgb, {14, 15}, {seam}, grey, grey);
//   }
//
#pragma once

#include <array>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/framework/types.h"
#include "majorant/pictures/images/raster.h"

namespace majorant {

// The texels and weights of a bilinear filter at one point.
struct FilterReading {
  std::array<std::size_t, 4> texels{};  // numbers, row by row from the top
  std::array<double, 4> weights{};      // sum 1
  double length = 1;                    // of the border, in texels, that the point represents
};

// The two sides of a cut at one point of the surface.
struct SeamReading {
  std::array<FilterReading, 2> sides;
  double length = 1;  // of the cut, in texels, that the point represents
};

// Finds the filter of sample() at uv. Returns false if it reaches beyond the image.
bool reading_at(const Raster& raster, const Vector2& uv, FilterReading& reading);

// Minimizes the sum of length (reading - value)^2 over the readings and kLeast (texel - old
// value)^2 over the free texels, in linear light, with one factorization for all channels. free:
// ascending numbers of texels. values: #readings by #channels, in linear light. Readings whose
// value is far from all of their texels are ignored, since filtering cannot explain them. Results
// stay in the range of values and texels. Polls `stop`: Stopped. Does not depend on the number of
// threads.
void level_seams(Raster& raster, Transfer transfer, const std::vector<std::size_t>& free,
                 const std::vector<FilterReading>& readings, const RowMatrix& values,
                 const StopCheck& stop = {});

// Changes texels as little as necessary so that the readings on both sides of a cut differ by at
// most kMaxDifference codes more or less than the surface does, here - there. Such differences
// arise where folds inside of charts end at the border, and by rounding to codes. Minimizes the sum
// of length max(0, |difference| - kMaxDifference)^2 over the seams and kStay (change)^2 over the
// texels, in codes. Texels are changed one by one, in whole codes if the raster has them. kept:
// ascending numbers of texels that change by kMaxChange at most. here, there: #seams by #channels,
// in linear light. Seams with differences above kClosable are ignored. seen: the encoding in which
// readings are shown, in 255 codes; for floats that are no colours, of the range of the values.
// Polls `stop`: Stopped. Does not depend on the number of threads.
void close_seams(Raster& raster, Transfer transfer, Transfer seen,
                 const std::vector<std::size_t>& kept, const std::vector<SeamReading>& seams,
                 const RowMatrix& here, const RowMatrix& there, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
