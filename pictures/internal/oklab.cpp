#include "majorant/pictures/internal/oklab.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace majorant {
namespace {

// Linear light -> responses of the eye -> OKLab.
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
