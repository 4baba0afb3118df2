#include "majorant/pictures/internal/rasterizer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "majorant/framework/parallel.h"

namespace majorant {
namespace {

constexpr int kBand = 16;           // rows of pixels in a task
constexpr double kOutside = -1e-9;  // barycentric tolerance: no cracks between neighbours

// The samples of rows first to first + kBand.
class Band {
 public:
  Band(int first, PixelSize size)
      : first_(first * kSamplesPerSide),
        rows_(std::min(kBand, size.height - first) * kSamplesPerSide),
        width_(size.width * kSamplesPerSide),
        fragments_(static_cast<std::size_t>(rows_) * to_size(width_)),
        depth_(fragments_.size(), -std::numeric_limits<double>::infinity()) {}

  void draw(const RasterTriangle& t) {
    std::array<Vector2, 3> p;
    for (std::size_t k = 0; k < 3; ++k)
      p[k] = kSamplesPerSide * t.corners[k] - Vector2(0.5, 0.5 + first_);
    const double area = cross(p[1] - p[0], p[2] - p[0]);
    if (area == 0 || !std::isfinite(area)) return;
    const auto [x0, x1] = range(p, 0, width_);
    const auto [y0, y1] = range(p, 1, rows_);
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) {
        const Vector2 s(x, y);
        const Barycentric w = Barycentric(cross(p[1] - s, p[2] - s), cross(p[2] - s, p[0] - s),
                                          cross(p[0] - s, p[1] - s)) /
                              area;
        if (w.minCoeff() < kOutside) continue;
        const double depth = w[0] * t.depth[0] + w[1] * t.depth[1] + w[2] * t.depth[2];
        const std::size_t k = place(x, y);
        if (!(depth > depth_[k])) continue;
        if (t.is_line && fragments_[k].cell < 0) continue;  // outside of the surface's outline
        depth_[k] = depth;
        fragments_[k] = {t.cell, w[0] * t.xi[0] + w[1] * t.xi[1] + w[2] * t.xi[2], t.is_line};
      }
  }

  // Returns the samples of a row of pixels, counted from the band's first one.
  std::vector<Fragment> row(int y) const {
    std::vector<Fragment> samples;
    for (int x = 0; x < width_; x += kSamplesPerSide)
      for (int k = 0; k < kSamplesPerPixel; ++k)
        samples.push_back(
            fragments_[place(x + k % kSamplesPerSide, y * kSamplesPerSide + k / kSamplesPerSide)]);
    return samples;
  }

 private:
  std::size_t place(int x, int y) const { return to_size(y) * to_size(width_) + to_size(x); }
  static std::pair<int, int> range(const std::array<Vector2, 3>& p, int axis, int count) {
    const auto [low, high] = std::minmax({p[0][axis], p[1][axis], p[2][axis]});
    const double end = count - 1;
    return {static_cast<int>(std::clamp(std::ceil(low - 1e-6), 0.0, end + 1)),
            static_cast<int>(std::clamp(std::floor(high + 1e-6), -1.0, end))};
  }

  int first_, rows_, width_;
  std::vector<Fragment> fragments_;
  std::vector<double> depth_;
};

// Returns for every band the triangles that reach it, in order.
std::vector<std::vector<Index>> by_band(const std::vector<RasterTriangle>& triangles,
                                        PixelSize size) {
  std::vector<std::vector<Index>> bands(to_size((size.height + kBand - 1) / kBand));
  const double last = static_cast<double>(bands.size()) - 1;
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    const auto& p = triangles[k].corners;
    const auto [low, high] = std::minmax({p[0].y(), p[1].y(), p[2].y()});
    if (!(high >= 0) || !(low <= size.height)) continue;
    const double from = std::clamp(std::floor(low / kBand), 0.0, last);
    const double to = std::clamp(std::floor(high / kBand), 0.0, last);
    for (auto b = static_cast<std::size_t>(from); b <= static_cast<std::size_t>(to); ++b)
      bands[b].push_back(static_cast<Index>(k));
  }
  return bands;
}

}  // namespace

void rasterize(const std::vector<RasterTriangle>& triangles, PixelSize size,
               const std::function<void(int, std::span<const Fragment>)>& paint) {
  const auto bands = by_band(triangles, size);
  parallel_for(static_cast<Index>(bands.size()), 1, [&](Index b) {
    Band band(b * kBand, size);
    for (const Index k : bands[b]) band.draw(triangles[k]);
    for (int y = 0; y < std::min(kBand, size.height - b * kBand); ++y)
      paint(b * kBand + y, band.row(y));
  });
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
