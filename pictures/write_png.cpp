#include "majorant/pictures/write_png.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "majorant/framework/error.h"
#include "majorant/io/atomic_file.h"
#include "majorant/io/map_check.h"
#include "majorant/pictures/internal/alignment.h"
#include "majorant/pictures/internal/claimed_energy.h"
#include "majorant/pictures/internal/png_legend.h"
#include "majorant/pictures/internal/png_painter.h"
#include "majorant/pictures/internal/raster_scene.h"

namespace majorant {
namespace {

constexpr double kDarkest = 0.72;  // of what is seen edge-on
const FloatColor kPaper(255, 255, 255), kCut(194, 24, 91);
constexpr double kCutWidth = 0.9;  // pixels, on either side of a cut

void require_usable(const PngOptions& options) {
  for (const int side : {options.width, options.height})
    if (side < PngOptions::kSmallest || side > PngOptions::kLargest)
      throw Error(ErrorKind::Usage,
                  fmt::format("a picture of {} x {} pixels: sides are {} to {}", options.width,
                              options.height, PngOptions::kSmallest, PngOptions::kLargest));
  const Vector3 view = options.view.value_or(Vector3::UnitZ());
  if (!view.allFinite() || view.isZero(0))
    throw Error(ErrorKind::Usage,
                fmt::format("a view from ({:g}, {:g}, {:g}) is from nowhere; give the direction to "
                            "the eye",
                            view.x(), view.y(), view.z()));
  if (options.image && options.quantity)
    throw Error(ErrorKind::Usage, "an image and a heat map lie on top of each other; choose one");
}

// What is shown as a heat map: what was asked for, or the density on a layout that has one.
std::optional<Quantity> heat_of(const MapFile& map, const PngOptions& options) {
  if (options.quantity || options.view || options.image) return options.quantity;
  if (claimed_energy(map).name.empty()) return {};
  return Quantity::Density;
}

// Light, and lines along cuts, on the surface.
class SurfaceShade {
 public:
  SurfaceShade(const MapFile& map, const Vector3& view,
               const std::vector<RasterTriangle>& triangles)
      : normals_(map), eye_(view.stableNormalized()), cut_(cut_edges(map)) {
    for (const RasterTriangle& t : triangles) {
      const auto& p = t.corners;
      const double area = std::abs(cross(p[1] - p[0], p[2] - p[0]));
      height_.push_back(
          {area / (p[2] - p[1]).norm(), area / (p[0] - p[2]).norm(), area / (p[1] - p[0]).norm()});
    }
  }

  FloatColor operator()(const Fragment& sample, const FloatColor& color) const {
    FloatColor shown = color;
    for (Index k = 0; k < 3; ++k)
      if (cut_[sample.cell][k] && sample.xi[k] * height_[sample.cell][k] < kCutWidth) shown = kCut;
    const double light = std::abs(normals_.at(sample.cell, sample.xi).dot(eye_));
    return (kDarkest + (1 - kDarkest) * light) * shown;
  }

 private:
  SmoothNormals normals_;
  Vector3 eye_;
  std::vector<std::array<bool, 3>> cut_;
  std::vector<Vector3> height_;  // of cells on the screen, above the edge across from each corner
};

// One row of pixels: the mean of the colours of their samples.
void average(std::span<const FloatColor> colors, PixelImage& image, int y) {
  for (int x = 0; x < image.width; ++x) {
    FloatColor sum = FloatColor::Zero();
    for (const FloatColor& c : colors.subspan(to_size(x * kSamplesPerPixel), kSamplesPerPixel))
      sum += c;
    const auto channel = [&](Index k) {
      return static_cast<std::uint8_t>(std::lround(sum[k] / kSamplesPerPixel));
    };
    image.at(x, y) = {channel(0), channel(1), channel(2)};
  }
}

// Into the upper rows of the image; what legends say of the samples.
ValueSummary draw_map(const MapFile& map, const PngOptions& options, const Painter& painter,
                      PixelSize size, PixelImage& image) {
  const auto triangles =
      options.view ? surface_triangles(map, *options.view, size) : layout_triangles(map, size);
  std::optional<SurfaceShade> shade;
  if (options.view) shade.emplace(map, *options.view, triangles);
  std::vector<ValueSummary> rows(to_size(size.height));
  rasterize(triangles, size, [&](int y, std::span<const Fragment> samples) {
    std::vector<FloatColor> colors(samples.size(), kPaper);
    painter.paint(samples, colors, rows[y]);
    for (std::size_t k = 0; k < samples.size(); ++k) {
      if (samples[k].cell < 0)
        colors[k] = kPaper;
      else if (shade)
        colors[k] = (*shade)(samples[k], colors[k]);
    }
    average(colors, image, y);
  });
  ValueSummary all;
  for (const ValueSummary& row : rows) all.add(row);
  return all;
}

PixelImage draw(const MapFile& map, const PngOptions& options) {
  const std::optional<Quantity> heat = heat_of(map, options);
  PixelImage image{options.width, options.height, {}};
  image.pixels.assign(to_size(image.width) * to_size(image.height), Color{255, 255, 255});
  PixelSize size{options.width, options.height};
  if (!heat) {
    const auto painter = options.image  ? image_painter(map, read_png(*options.image))
                         : options.view ? checker_painter(map)
                                        : plain_painter();
    draw_map(map, options, *painter, size, image);
    return image;
  }
  const ColorScale scale = picture_scale(map, *heat, options.color_range);
  const auto painter = heat_painter(map, *heat, claimed_energy(map).sum, scale);
  size.height = std::max(1, size.height - png_legend_height(size.width));
  const ValueSummary values = draw_map(map, options, *painter, size, image);
  draw_legend(image, make_legend(map, *heat, scale, values, "samples"));
  return image;
}

}  // namespace

void write_png(const std::string& path, const MapFile& map, const PngOptions& options) {
  require_usable(options);
  require_sound(path, map);
  // On the surface nothing is turned: images and squares lie as the file has them.
  const Vector2 direction =
      options.view ? Vector2(1, 0) : picture_direction(map, options.alignment);
  write_file_atomically(path, encode_png(draw(turned(map, direction), options)));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
