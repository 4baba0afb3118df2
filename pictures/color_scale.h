// Colour scales: the colour of a number is the same in every picture of every map, so that pictures
// can be compared.
//
//   const ColorScale area = color_scale(Quantity::Area, {});
//   const std::string twice = area.color(2.0).hex();            // the same in every picture
//   const ColorScale density = color_scale(Quantity::Density, {{symmetric_dirichlet(), 1.0}});
//   for (const ColorScale::Tick& tick : density.ticks()) std::cout << tick.label << ' ';
//
// A value v has a position t in [0, 1], and a position a colour. Isometry (the neutral value v0)
// has the neutral colour, a pale grey, and equal steps of t are equal distances in OKLab [Ottosson
// 2020], so that what looks twice as different is.
//
//     * Sequential, of what is least at isometry (density, angle), with s = 1 + (v - v0) / w: t =
//       log(s(v) / s(low)) / log(s(high) / s(low)), from grey over orange to dark red. w = 1 for
//       the angle, so that s = v; of a density, what a stretch to twice the length in one direction
//       adds to it.
//     * Diverging, of area distortion and singular values: t = 1/2 (1 - log v / log low) below v0 =
//       1 and 1/2 (1 + log v / log high) above, from dark blue over grey to the same dark red.
//
// The fixed ranges: singular values 1/4 to 4, area 1/8 to 8, angle 1 to 8, density v0 to v0 + 16 w
// (symmetric Dirichlet: 4 to 40). What is beyond has the colour of that end; legends mark ends that
// values are beyond. Lightness falls from the neutral colour outwards along all arms, and arms
// differ in blue against red: both are seen by colour-blind readers.
//
// Not for what has no isometry to compare with, like chart numbers, nor for a scale fitted to one
// map: with_range() is there for close looks, and legends say the range.
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

// The colour of cells that are turned over, or have no area: no scale has it.
inline constexpr Color kFlippedColor{214, 0, 190};

class ColorScale {
 public:
  enum class Shape { Sequential, Diverging };
  static constexpr int kColors = 256;

  // As in the formulas above: low >= neutral < high and unit > 0 where sequential; low < neutral =
  // 1 < high where diverging (unit does not matter). Throws Error(Usage) for others.
  ColorScale(std::string label, Shape shape, double low, double neutral, double high, double unit);
  // The same with other ends. Throws likewise, naming the isometry's value.
  ColorScale with_range(double low, double high) const;

  const std::string& label() const { return label_; }  // what is shown, ASCII
  Shape shape() const { return shape_; }
  double low() const { return low_; }
  double high() const { return high_; }
  double neutral() const { return neutral_; }  // at isometry
  double unit() const { return unit_; }        // w

  // Monotone; 0 and 1 beyond the range. NaN, which no valid map has, is as bad as can be: 1.
  double position(double value) const;
  double value(double position) const;  // its inverse on [0, 1]
  // colors()[k], k = position * 255 rounded to nearest: what pages look up, too.
  Color color(double value) const { return color_at(position(value)); }
  Color color_at(double position) const;
  std::span<const Color, kColors> colors() const;

  struct Tick {
    double value;
    std::string label;  // "1/4", "6"
    double position;
  };
  // Both ends and some numbers between them, about evenly spread; isometry, where it is inside.
  std::vector<Tick> ticks() const;

 private:
  double stretched(double value) const;  // log s, or log v

  std::string label_;
  Shape shape_;
  double low_, high_, neutral_, unit_;
};

// The fixed scale of a quantity. energy: of the density, whose value at isometry and unit come from
// evaluating it; not looked at for other quantities. Throws Error(Usage) for a density without
// energy.
ColorScale color_scale(Quantity quantity, const EnergySum& energy);

// Lightness 0 to 1, then green to red and blue to yellow, about -0.4 to 0.4.
using Oklab = Eigen::Vector3d;

// Linear light (red, green, blue), inside 0 to 1 where a screen can show it.
Eigen::Vector3d to_linear(const Oklab& lab);
// Rounded, and clamped to what a screen can show.
Color to_srgb(const Oklab& lab);
Oklab to_oklab(Color color);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
