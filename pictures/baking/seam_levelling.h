// Texels around charts, set so that a bilinear filter reads at the borders of the charts what the
// surface has there: then both sides of a cut look alike, also where it runs along a fold, as in
// [Liu, Ferguson, Jacobson and Gingold, Seamless: Seam erasure and seam-aware decoupling of shape
// from mesh resolution, 2017]. Texels in charts keep what they show, or nearly so.
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

// What a bilinear filter mixes at one point.
struct FilterReading {
  std::array<std::size_t, 4> texels{};  // row after row from the top
  std::array<double, 4> weights{};      // sum 1
  double length = 1;                    // of the border that the point stands for, in texels
};

// The two sides of a cut at one point of the surface.
struct SeamReading {
  std::array<FilterReading, 2> sides;
  double length = 1;  // of the cut that the point stands for, in texels
};

// The filter at uv, as sample() has it; false where it reaches beyond the image.
bool reading_at(const Raster& raster, const Vector2& uv, FilterReading& reading);

// The least sum of length (reading - value)^2 over the readings and kLeast (texel - what it was)^2
// over the texels that are free, by one factorization for all channels, in linear light. free:
// ascending numbers of texels. values: #readings by #channels, in linear light. Readings whose
// value is far from all of their texels, which is not of a filter's making, do not count. What is
// set stays in the range of values and texels. Polls `stop`: Stopped. The same on any number of
// threads.
void level_seams(Raster& raster, Transfer transfer, const std::vector<std::size_t>& free,
                 const std::vector<FilterReading>& readings, const RowMatrix& values,
                 const StopCheck& stop = {});

// Moves texels as little as it takes for what is read on the two sides of a cut to differ by no
// more than kMostApart codes more or less than the surface does, here - there: where folds inside
// of charts end at the border, and where rounding to codes adds up. The least sum of length max(0,
// |difference| - kMostApart)^2 over the seams and kStay (moved)^2 over the texels, in codes, found
// texel by texel; in whole codes where the raster has them. kept: ascending numbers of texels that
// are moved by kMostMoved at most. here, there: #seams by #channels, in linear light. Seams that
// are more than kClosable apart do not count. seen: how what is read is shown, in 255 codes; of
// floats that are no colours, of the range of the values. Polls `stop`: Stopped. The same on any
// number of threads.
void close_seams(Raster& raster, Transfer transfer, Transfer seen,
                 const std::vector<std::size_t>& kept, const std::vector<SeamReading>& seams,
                 const RowMatrix& here, const RowMatrix& there, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
