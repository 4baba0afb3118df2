// Rasterizes triangles: finds the front one at every sample of a picture.
//
//   std::vector<RasterTriangle> triangles;                    // in pixels, y down
//   rasterize(triangles, {800, 600}, [&](int, std::span<const Fragment>) {});
//
// Threads of the caller process rows of pixels concurrently. The result does not depend on their
// number.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "majorant/framework/types.h"

namespace majorant {

struct PixelSize {
  int width = 0, height = 0;
};

struct RasterTriangle {
  std::array<Vector2, 3> corners;  // pixels from the upper left corner, y down
  std::array<double, 3> depth{};   // larger is nearer; linear between corners
  Index cell = 0;
  std::array<Barycentric, 3> xi;  // of the corners in the cell; linear between them
  bool is_line = false;           // along an edge of the cell; shown on cells behind it
};

struct Fragment {
  Index cell = -1;  // -1: the paper
  Barycentric xi;
  bool is_line = false;  // whether its triangle is a line
};

// The samples of a pixel, at the middles of equal squares.
inline constexpr int kSamplesPerSide = 3, kSamplesPerPixel = kSamplesPerSide * kSamplesPerSide;

// Calls paint for every row of pixels, from several threads, with the samples of its pixels in
// order. If two triangles are equally near, the first one is in front.
void rasterize(const std::vector<RasterTriangle>& triangles, PixelSize size,
               const std::function<void(int y, std::span<const Fragment>)>& paint);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
