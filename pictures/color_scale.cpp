#include "majorant/pictures/color_scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/pictures/internal/density_probe.h"

namespace majorant {
namespace {

using Table = std::array<Color, ColorScale::kColors>;

constexpr double kLargestSigma = 4.0;
constexpr double kLargestArea = 8.0;
constexpr double kLargestAngle = 8.0;
constexpr double kDensityUnits = 16.0;  // of the range above isometry
constexpr int kCurveSteps = 4096;
constexpr int kTickGaps = 5;  // between ticks that are not powers of 2
constexpr double kMaxDoubled = 128.0;
constexpr double kLeastTickGap = 0.07;

// Control points of parabolas of equal length, from the neutral colour outwards.
const std::array<Oklab, 3> kWarm{Oklab(0.93, 0.0, 0.004), Oklab(0.80, 0.075, 0.165),
                                 Oklab(0.37, 0.130, 0.068)};
const std::array<Oklab, 3> kCool{kWarm[0], Oklab(0.76, -0.077, -0.125), Oklab(0.37, 0.004, -0.180)};

Oklab point_at(const std::array<Oklab, 3>& curve, double s) {
  return (1 - s) * (1 - s) * curve[0] + 2 * s * (1 - s) * curve[1] + s * s * curve[2];
}

// A curve of colours by its length: equal steps are equal distances.
class Arm {
 public:
  explicit Arm(const std::array<Oklab, 3>& curve) : curve_(curve), length_(kCurveSteps + 1, 0.0) {
    for (int k = 1; k <= kCurveSteps; ++k)
      length_[k] = length_[k - 1] + (point(k) - point(k - 1)).norm();
  }

  // Returns the colour at this part of the length, 0 to 1.
  Color color(double part) const {
    const double target = part * length_.back();
    const auto above = std::lower_bound(length_.begin(), length_.end() - 1, target);
    if (above == length_.begin()) return to_srgb(curve_[0]);
    const double below = *(above - 1);
    const auto k = static_cast<double>(above - length_.begin());
    return to_srgb(point_at(curve_, (k - 1 + (target - below) / (*above - below)) / kCurveSteps));
  }

 private:
  Oklab point(int k) const { return point_at(curve_, static_cast<double>(k) / kCurveSteps); }

  std::array<Oklab, 3> curve_;
  std::vector<double> length_;  // from the start
};

// Returns colors[k] at the position k / 255.
template <class ColorAt>
Table tabulate(const ColorAt& color_at) {
  Table colors;
  for (std::size_t k = 0; k < colors.size(); ++k)
    colors[k] = color_at(static_cast<double>(k) / (ColorScale::kColors - 1));
  return colors;
}

const Table& sequential_colors() {
  static const Table colors = tabulate([warm = Arm(kWarm)](double t) { return warm.color(t); });
  return colors;
}

const Table& diverging_colors() {
  static const Table colors = tabulate([warm = Arm(kWarm), cool = Arm(kCool)](double t) {
    return t < 0.5 ? cool.color(1 - 2 * t) : warm.color(2 * t - 1);
  });
  return colors;
}

// Returns the number with one or two digits nearest to a positive ratio.
double nice_number(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  double best = power;
  for (const double digits : {1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0})
    if (std::abs(std::log(digits * power / value)) < std::abs(std::log(best / value)))
      best = digits * power;
  return best;
}

bool is_power_of_two(double value) {
  int exponent = 0;
  return value > 0 && std::frexp(value, &exponent) == 0.5;
}

std::string tick_label(double value) {
  if (value < 1 && is_power_of_two(value)) return fmt::format("1/{:.6g}", 1 / value);
  return fmt::format("{:.6g}", value);
}

}  // namespace

std::string_view quantity_name(Quantity quantity) {
  constexpr std::array kNames{"density", "area", "angle", "sigma-max", "sigma-min"};
  return kNames[static_cast<std::size_t>(quantity)];
}

ColorScale::ColorScale(std::string label, Shape shape, double low, double neutral, double high,
                       double unit)
    : label_(std::move(label)),
      shape_(shape),
      low_(low),
      high_(high),
      neutral_(neutral),
      unit_(unit) {
  if (!std::isfinite(low) || !std::isfinite(high) || !(low < high))
    throw Error(ErrorKind::Usage, fmt::format("a range of colours from {:g} to {:g}: give two "
                                              "numbers, the smaller one first",
                                              low, high));
  if (shape == Shape::Sequential && !(low >= neutral))
    throw Error(ErrorKind::Usage,
                fmt::format("a range of colours from {:g}: {} is {:g} at isometry and never "
                            "below; start there",
                            low, label_, neutral));
  if (shape == Shape::Diverging && !(0 < low && low < neutral && neutral < high))
    throw Error(ErrorKind::Usage,
                fmt::format("a range of colours from {:g} to {:g}: {} is {:g} at isometry, which "
                            "has to be inside",
                            low, high, label_, neutral));
}

ColorScale ColorScale::with_range(double low, double high) const {
  return {label_, shape_, low, neutral_, high, unit_};
}

double ColorScale::stretched(double value) const {
  const double ratio =
      shape_ == Shape::Sequential ? 1 + (value - neutral_) / unit_ : value / neutral_;
  return std::log(std::max(ratio, std::numeric_limits<double>::min()));
}

double ColorScale::position(double value) const {
  if (std::isnan(value)) return 1;
  double t = 0;
  if (shape_ == Shape::Sequential)
    t = (stretched(value) - stretched(low_)) / (stretched(high_) - stretched(low_));
  else if (value < neutral_)
    t = 0.5 - 0.5 * stretched(value) / stretched(low_);
  else
    t = 0.5 + 0.5 * stretched(value) / stretched(high_);
  return std::clamp(t, 0.0, 1.0);
}

double ColorScale::value(double position) const {
  const double t = std::clamp(position, 0.0, 1.0);
  if (t == 0) return low_;
  if (t == 1) return high_;
  if (shape_ == Shape::Sequential)
    return neutral_ +
           unit_ * std::expm1(stretched(low_) + t * (stretched(high_) - stretched(low_)));
  return neutral_ *
         std::exp(t < 0.5 ? (1 - 2 * t) * stretched(low_) : (2 * t - 1) * stretched(high_));
}

Color ColorScale::color_at(double position) const {
  const auto k = std::lround(std::clamp(position, 0.0, 1.0) * (kColors - 1));
  return colors()[static_cast<std::size_t>(k)];
}

std::span<const Color, ColorScale::kColors> ColorScale::colors() const {
  return shape_ == Shape::Sequential ? sequential_colors() : diverging_colors();
}

std::vector<ColorScale::Tick> ColorScale::ticks() const {
  std::vector<double> inner;
  if (neutral_ == unit_ && is_power_of_two(low_) && is_power_of_two(high_) &&
      high_ / low_ <= kMaxDoubled) {
    for (double v = 2 * low_; v < high_; v *= 2) inner.push_back(v);
  } else {
    const double from = low_ > 0 && high_ > 2 * low_ ? 0 : low_;  // of the rounded end
    for (int k = 1; k < kTickGaps; ++k)
      inner.push_back(from + nice_number(value(static_cast<double>(k) / kTickGaps) - from));
    if (shape_ == Shape::Diverging) {
      std::erase_if(inner, [&](double v) { return std::abs(position(v) - 0.5) < kLeastTickGap; });
      inner.insert(std::lower_bound(inner.begin(), inner.end(), neutral_), neutral_);
    }
  }
  std::vector<Tick> ticks;
  const auto add = [&](double v) { ticks.push_back({v, tick_label(v), position(v)}); };
  add(low_);
  for (const double v : inner)
    if (std::min(position(v) - ticks.back().position, 1 - position(v)) > kLeastTickGap) add(v);
  add(high_);
  return ticks;
}

ColorScale color_scale(Quantity quantity, const EnergySum& energy) {
  using Shape = ColorScale::Shape;
  switch (quantity) {
    case Quantity::Area:
      return {"area distortion", Shape::Diverging, 1 / kLargestArea, 1, kLargestArea, 1};
    case Quantity::Angle:
      return {"angle distortion", Shape::Sequential, 1, 1, kLargestAngle, 1};
    case Quantity::SigmaMax:
      return {"sigma_1", Shape::Diverging, 1 / kLargestSigma, 1, kLargestSigma, 1};
    case Quantity::SigmaMin:
      return {"sigma_2", Shape::Diverging, 1 / kLargestSigma, 1, kLargestSigma, 1};
    case Quantity::Density:
      break;
  }
  if (energy.empty())
    throw Error(ErrorKind::Usage, "the density has no scale without an energy; take the area");
  const DensityProbe probe(energy);
  const double neutral = probe.at(1, 1), unit = probe.at(2, 1) - neutral;
  return {"density", Shape::Sequential, neutral, neutral, neutral + kDensityUnits * unit, unit};
}

namespace {

// Matrices from linear light to responses of the eye, and on to OKLab.
const Eigen::Matrix3d kToCones{{0.4122214708, 0.5363325363, 0.0514459929},
                               {0.2119034982, 0.6806995451, 0.1073969566},
                               {0.0883024619, 0.2817188376, 0.6299787005}};
const Eigen::Matrix3d kToLab{{0.2104542553, 0.7936177850, -0.0040720468},
                             {1.9779984951, -2.4285922050, 0.4505937099},
                             {0.0259040371, 0.7827717662, -0.8086757660}};

std::uint8_t encoded(double linear) {
  linear = std::clamp(linear, 0.0, 1.0);
  const double value =
      linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255.0 * value));
}

double decoded(std::uint8_t channel) {
  const double value = channel / 255.0;
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

}  // namespace

Eigen::Vector3d to_linear(const Oklab& lab) {
  const Eigen::Vector3d roots = kToLab.inverse() * lab;
  return kToCones.inverse() * roots.array().cube().matrix();
}

Color to_srgb(const Oklab& lab) {
  const Eigen::Vector3d linear = to_linear(lab);
  return {encoded(linear[0]), encoded(linear[1]), encoded(linear[2])};
}

Oklab to_oklab(Color color) {
  const Eigen::Vector3d linear(decoded(color.red), decoded(color.green), decoded(color.blue));
  return kToLab * (kToCones * linear).array().pow(1.0 / 3.0).matrix();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
