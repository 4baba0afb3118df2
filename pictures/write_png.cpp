#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/io/atomic_file.h"
#include "majorant/io/claims.h"
#include "majorant/io/layout_scale.h"
#include "majorant/io/map_check.h"
#include "majorant/pictures/internal/alignment.h"
#include "majorant/pictures/internal/bezier_image.h"
#include "majorant/pictures/internal/claimed_energy.h"
#include "majorant/pictures/internal/density_probe.h"
#include "majorant/pictures/internal/legend.h"
#include "majorant/pictures/internal/pixel_font.h"
#include "majorant/pictures/internal/raster_scene.h"
#include "majorant/pictures/internal/rasterizer.h"
#include "majorant/pictures/pictures.h"
#include "majorant/pictures/png_file.h"

namespace majorant {
namespace {

// The legend of a picture of pixels.

constexpr Color kInk{51, 51, 51};
constexpr int kWideEnough = 900;  // for letters of twice the size
// In dots of letters.
constexpr int kLegendMargin = 6, kPixelBarHeight = 8, kPixelPoint = 5, kTick = 2, kLine = 12,
              kHeight = 52;

int zoom_of(int width) { return width >= kWideEnough ? 2 : 1; }

void fill_column(PixelImage& image, int x, int top, int bottom, Color color) {
  for (int y = top; y < bottom; ++y)
    if (x >= 0 && x < image.width && y >= 0 && y < image.height) image.at(x, y) = color;
}

// Narrower from one column to the next.
void draw_point(PixelImage& image, int x, int way, int top, int height, int length, Color color) {
  for (int k = 0; k < length; ++k) {
    const int cut = height * (k + 1) / (2 * (length + 1));
    fill_column(image, x + way * k, top + cut, top + height - cut, color);
  }
}

// As much of a line as there is room for.
std::string cut_off(const std::string& text, int room) {
  return text.substr(0, static_cast<std::size_t>(std::max(0, room)));
}

// Rows that a legend takes at the bottom of a picture of this width.
int png_legend_height(int width) { return kHeight * zoom_of(width); }

// Into those rows: as add_color_legend() of write_svg.cpp, the lines of text below the bar.
void draw_legend(PixelImage& image, const Legend& legend) {
  const int zoom = zoom_of(image.width);
  const int left = (kLegendMargin + kPixelPoint) * zoom;
  const int width = std::max(1, std::min(image.width / 2, 400 * zoom) - 2 * left);
  const int top = image.height - (kHeight - 4) * zoom, height = kPixelBarHeight * zoom;
  for (int x = 0; x < width; ++x)
    fill_column(image, left + x, top, top + height, legend.scale.color_at((x + 0.5) / width));
  if (legend.goes_below)
    draw_point(image, left - 1, -1, top, height, kPixelPoint * zoom, legend.scale.colors().front());
  if (legend.goes_above)
    draw_point(image, left + width, 1, top, height, kPixelPoint * zoom,
               legend.scale.colors().back());
  const int ticks = top + height;
  int free = 0;  // labels that would overlap the one before are left out
  for (const ColorScale::Tick& tick : legend.scale.ticks()) {
    const int x = left + static_cast<int>(std::lround(tick.position * (width - 1)));
    fill_column(image, x, ticks, ticks + kTick * zoom, kInk);
    const int wide = static_cast<int>(tick.label.size()) * kGlyphAdvance * zoom;
    if (x - wide / 2 < free) continue;
    draw_text(image, x - wide / 2, ticks + (kTick + 2) * zoom, zoom, kInk, tick.label);
    free = x - wide / 2 + wide + kGlyphAdvance * zoom / 2;
  }
  const int room = (image.width - 2 * kLegendMargin * zoom) / (kGlyphAdvance * zoom);
  const int text = ticks + (kTick + 3 + kGlyphHeight) * zoom;
  draw_text(image, kLegendMargin * zoom, text, zoom, kInk, cut_off(legend.title, room));
  draw_text(image, kLegendMargin * zoom, text + (kLine - 1) * zoom, zoom, kInk,
            cut_off(legend.note, room));
}

// The painters of a picture of pixels.

using FloatColor = Eigen::Vector3d;  // sRGB, 0 to 255

// Gives colours to fragments; by several threads at a time.
class Painter {
 public:
  virtual ~Painter() = default;
  // One colour a sample, where there is a cell; adds what legends say.
  virtual void paint(std::span<const Fragment> samples, std::span<FloatColor> colors,
                     ValueSummary& values) const = 0;
};

constexpr double kSquares = 40.0;  // at most, along the layout
const FloatColor kDark(79, 107, 135), kLight(242, 240, 232), kPlain(219, 219, 219);

FloatColor as_float(Color c) {
  return {static_cast<double>(c.red), static_cast<double>(c.green), static_cast<double>(c.blue)};
}

// A square in the plane.
struct Square {
  Vector2 middle;
  double side;
};

// Around the layout, with its larger side.
Square square_around(const MapFile& map) {
  const Vector2 low = map.uv.colwise().minCoeff(), high = map.uv.colwise().maxCoeff();
  const double side = (high - low).maxCoeff();
  return {0.5 * low + 0.5 * high, side > 0 ? side : 1};
}

// The square that a texture lies on: the unit square of layouts that were made for one, the square
// around others.
Square texture_square(const MapFile& map) {
  if (readable_claims(map.claims).normalized || has_assumed_scale(map)) return {{0.5, 0.5}, 1};
  return square_around(map);
}

class PlainPainter final : public Painter {
 public:
  void paint(std::span<const Fragment>, std::span<FloatColor> colors,
             ValueSummary&) const override {
    std::fill(colors.begin(), colors.end(), kPlain);
  }
};

// Paints what depends on uv alone.
class TexturePainter : public Painter {
 public:
  explicit TexturePainter(const MapFile& map) : image_(map, 1) {}
  void paint(std::span<const Fragment> samples, std::span<FloatColor> colors,
             ValueSummary&) const final {
    for (std::size_t k = 0; k < samples.size(); ++k)
      if (samples[k].cell >= 0) colors[k] = color(image_.uv(samples[k].cell, samples[k].xi));
  }

 private:
  virtual FloatColor color(const Vector2& uv) const = 0;
  BezierImage image_;
};

class CheckerPainter final : public TexturePainter {
 public:
  explicit CheckerPainter(const MapFile& map) : TexturePainter(map) {
    const double wanted = square_around(map).side / kSquares;
    const double power = std::pow(10.0, std::floor(std::log10(wanted)));
    width_ = 10 * power;
    for (const double digit : {5.0, 2.0, 1.0})
      if (digit * power >= wanted) width_ = digit * power;
  }

 private:
  FloatColor color(const Vector2& uv) const override {
    const double number = std::floor(uv[0] / width_) + std::floor(uv[1] / width_);
    return std::fmod(number, 2.0) == 0 ? kLight : kDark;
  }
  double width_;
};

class ImagePainter final : public TexturePainter {
 public:
  ImagePainter(const MapFile& map, PixelImage image)
      : TexturePainter(map), square_(texture_square(map)), texture_(std::move(image)) {}

 private:
  FloatColor color(const Vector2& uv) const override {
    const Vector2 t = (uv - square_.middle) / square_.side;
    const double x = (t[0] + 0.5) * texture_.width - 0.5;
    const double y = (0.5 - t[1]) * texture_.height - 0.5;
    const double left = std::floor(x), top = std::floor(y);
    const double right = x - left, below = y - top;
    return (1 - below) * ((1 - right) * pixel(left, top) + right * pixel(left + 1, top)) +
           below * ((1 - right) * pixel(left, top + 1) + right * pixel(left + 1, top + 1));
  }
  FloatColor pixel(double x, double y) const {
    const auto repeated = [](double place, int count) {
      const double rest = place - count * std::floor(place / count);
      return static_cast<int>(std::clamp(rest, 0.0, count - 1.0));
    };
    return as_float(texture_.at(repeated(x, texture_.width), repeated(y, texture_.height)));
  }
  Square square_;
  PixelImage texture_;
};

class HeatPainter final : public Painter {
 public:
  HeatPainter(const MapFile& map, Quantity quantity, const EnergySum& energy, ColorScale scale)
      : image_(map, layout_scale(map)),
        quantity_(quantity),
        density_(energy),
        scale_(std::move(scale)) {}

  void paint(std::span<const Fragment> samples, std::span<FloatColor> colors,
             ValueSummary& values) const override {
    std::vector<Vector2> sigma(samples.size(), Vector2::Ones());
    for (std::size_t k = 0; k < samples.size(); ++k) {
      if (samples[k].cell < 0) continue;
      const PointDistortion d = image_.at(samples[k].cell, samples[k].xi).distortion;
      sigma[k] = {d.sigma_1, d.sigma_2};
    }
    std::vector<double> value(samples.size());
    evaluate(quantity_, density_, sigma, value);
    for (std::size_t k = 0; k < samples.size(); ++k) {
      if (samples[k].cell < 0) continue;
      const bool is_flipped = !(sigma[k][1] > 0);
      if (!is_flipped) values.add(scale_, value[k]);
      colors[k] = as_float(is_flipped ? kFlippedColor : scale_.color(value[k]));
    }
  }

 private:
  BezierImage image_;
  Quantity quantity_;
  DensityProbe density_;
  ColorScale scale_;
};

std::unique_ptr<Painter> plain_painter() { return std::make_unique<PlainPainter>(); }

std::unique_ptr<Painter> checker_painter(const MapFile& map) {
  return std::make_unique<CheckerPainter>(map);
}

// write_png.h says where the image lies.
std::unique_ptr<Painter> image_painter(const MapFile& map, PixelImage image) {
  return std::make_unique<ImagePainter>(map, std::move(image));
}

// energy: of the density. Of cells whose surface triangle has no area: kFlippedColor.
std::unique_ptr<Painter> heat_painter(const MapFile& map, Quantity quantity,
                                      const EnergySum& energy, const ColorScale& scale) {
  return std::make_unique<HeatPainter>(map, quantity, energy, scale);
}

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

// The quantity that is shown as a heat map: what was asked for, or the density on a layout that has
// one.
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
