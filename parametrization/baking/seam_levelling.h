// Texels around charts, set so that a bilinear filter reads at the borders of the charts what the
// surface has there: then both sides of a cut look alike, also where it runs along a fold, as in
// [Liu, Ferguson, Jacobson and Gingold, Seamless: Seam erasure and seam-aware decoupling of shape
// from mesh resolution, 2017], but for texels in charts, which keep what they show.
//
//   Raster image(64, 64, 3, PixelDepth::Eight);
//   FilterReading reading;
//   if (reading_at(image, {0.25, 0.5}, reading))
//     level_seams(image, Transfer::Srgb, {12, 13}, {reading}, RowMatrix::Constant(1, 3, 0.5));
//
// The least sum of length (reading - value)^2 over the readings and kLeast (texel - what it was)^2
// over the texels that are free, by one factorization for all channels, in linear light.
#pragma once

#include <array>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/framework/types.h"
#include "majorant/parametrization/baking/raster.h"

namespace majorant {

// What a bilinear filter mixes at one point.
struct FilterReading {
  std::array<std::size_t, 4> texels{};  // row after row from the top
  std::array<double, 4> weights{};      // sum 1
  double length = 1;                    // of the border that the point stands for, in texels
};

// The filter at uv, as sample() has it; false where it reaches beyond the image.
bool reading_at(const Raster& raster, const Vector2& uv, FilterReading& reading);

// free: ascending numbers of texels. values: #readings by #channels, in linear light. Readings
// whose value is far from all of their texels, which is not of a filter's making, do not count.
// What is set stays in the range of values and texels. Polls `stop`: Stopped. The same on any
// number of threads.
void level_seams(Raster& raster, Transfer transfer, const std::vector<std::size_t>& free,
                 const std::vector<FilterReading>& readings, const RowMatrix& values,
                 const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
