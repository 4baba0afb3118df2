// Colour scales: a number has the same colour in every picture of every map, so that pictures can
// be compared.
//
//   const ColorScale area = color_scale(Quantity::Area, {});
//   const std::string twice = area.color(2.0).hex();            // the same in every picture
//   const ColorScale density = color_scale(Quantity::Density, {{symmetric_dirichlet(), 1.0}});
//   for (const ColorScale::Tick& tick : density.ticks()) std::cout << tick.label << ' ';
//
// A value v has a position t in [0, 1], and a position has a colour. Isometry (the neutral value
// v0) has the neutral colour, a pale grey. Equal steps of t are equal distances in OKLab [Ottosson
// 2020], so that equal differences look equal.
//
//     * Sequential, of what is least at isometry (density, angle), with s = 1 + (v - v0) / w: t =
//       log(s(v) / s(low)) / log(s(high) / s(low)), from grey over orange to dark red. w = 1 for
//       the angle, so that s = v; of a density, what a stretch to twice the length in one direction
//       adds to it.
//     * Diverging, of area distortion and singular values: t = 1/2 (1 - log v / log low) below v0 =
//       1 and 1/2 (1 + log v / log high) above, from dark blue over grey to the same dark red.
//
// The fixed ranges are: singular values 1/4 to 4, area 1/8 to 8, angle 1 to 8, density v0 to v0 +
// 16 w (symmetric Dirichlet: 4 to 40). Values beyond an end have its colour, and legends mark such
// ends. Lightness decreases from the neutral colour outwards along all arms, and arms differ in
// blue against red; colour-blind readers see both.
//
// Not for values without an isometry, like chart numbers. Scales do not adapt to a map;
// with_range() is for closer views, and legends show its range.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "majorant/energies/energy_factory.h"
#include "majorant/pictures/images/color.h"
#include "majorant/pictures/pictures.h"

namespace majorant {

// The colour of cells that are turned over or have no area. It is on no scale.
inline constexpr Color kFlippedColor{214, 0, 190};

class ColorScale {
 public:
  enum class Shape { Sequential, Diverging };
  static constexpr int kColors = 256;

  // Parameters of the formulas above: low >= neutral < high and unit > 0 if sequential; low <
  // neutral = 1 < high if diverging (unit is ignored). Throws Error(Usage) for others.
  ColorScale(std::string label, Shape shape, double low, double neutral, double high, double unit);
  // Returns the scale with other ends. Throws Error(Usage) likewise, with the value of isometry.
  ColorScale with_range(double low, double high) const;

  const std::string& label() const { return label_; }  // name of the quantity, ASCII
  Shape shape() const { return shape_; }
  double low() const { return low_; }
  double high() const { return high_; }
  double neutral() const { return neutral_; }  // at isometry
  double unit() const { return unit_; }        // w

  // Returns a monotone position; 0 and 1 beyond the range. NaN, which no valid map has, gives 1.
  double position(double value) const;
  double value(double position) const;  // its inverse on [0, 1]
  // Returns colors()[k], k = position * 255 rounded to nearest, which pages look up, too.
  Color color(double value) const { return color_at(position(value)); }
  Color color_at(double position) const;
  std::span<const Color, kColors> colors() const;

  struct Tick {
    double value;
    std::string label;  // "1/4", "6"
    double position;
  };
  // Returns both ends and some evenly spread numbers between them; isometry if it is inside.
  std::vector<Tick> ticks() const;

 private:
  double stretched(double value) const;  // returns log s, or log v

  std::string label_;
  Shape shape_;
  double low_, high_, neutral_, unit_;
};

// Returns the fixed scale of a quantity. energy: for the density, whose unit and value at isometry
// are evaluated; ignored for other quantities. Throws Error(Usage) for a density without energy.
ColorScale color_scale(Quantity quantity, const EnergySum& energy);

// OKLab: lightness 0 to 1, green to red and blue to yellow, both about -0.4 to 0.4.
using Oklab = Eigen::Vector3d;

// Returns linear light (red, green, blue), inside 0 to 1 for colours of screens.
Eigen::Vector3d to_linear(const Oklab& lab);
// Returns the rounded colour, clamped to those of screens.
Color to_srgb(const Oklab& lab);
Oklab to_oklab(Color color);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
