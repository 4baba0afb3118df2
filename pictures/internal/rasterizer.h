// Triangles to pixels: which of them is in front at every sample of a picture.
//
//   std::vector<RasterTriangle> triangles;                    // in pixels, y down
//   rasterize(triangles, {800, 600}, [&](int, std::span<const Fragment>) {});
//
// Rows of pixels are done side by side by the threads of the caller; what a pixel gets depends on
// the triangles alone, so that pictures are the same for any number of threads.
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
  bool is_line = false;  // along an edge of the cell, not a part of it: shown on those before it
};

struct Fragment {
  Index cell = -1;  // none: the paper
  Barycentric xi;
  bool is_line = false;  // as of its triangle
};

// The samples of a pixel, at the middles of as many squares.
inline constexpr int kSamplesPerSide = 3, kSamplesPerPixel = kSamplesPerSide * kSamplesPerSide;

// Calls paint for every row of pixels, from several threads, with the samples of its pixels, one
// after the other. Where two triangles are equally near, the first one counts.
void rasterize(const std::vector<RasterTriangle>& triangles, PixelSize size,
               const std::function<void(int y, std::span<const Fragment>)>& paint);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
