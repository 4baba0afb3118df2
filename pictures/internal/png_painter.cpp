#include "majorant/pictures/internal/png_painter.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "majorant/io/claims.h"
#include "majorant/io/layout_scale.h"

namespace majorant {
namespace {

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

// Where textures lie: the unit square of layouts that were made for one, the square around others.
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

// What depends on uv alone.
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

}  // namespace

std::unique_ptr<Painter> plain_painter() { return std::make_unique<PlainPainter>(); }

std::unique_ptr<Painter> checker_painter(const MapFile& map) {
  return std::make_unique<CheckerPainter>(map);
}

std::unique_ptr<Painter> image_painter(const MapFile& map, PixelImage image) {
  return std::make_unique<ImagePainter>(map, std::move(image));
}

std::unique_ptr<Painter> heat_painter(const MapFile& map, Quantity quantity,
                                      const EnergySum& energy, const ColorScale& scale) {
  return std::make_unique<HeatPainter>(map, quantity, energy, scale);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
