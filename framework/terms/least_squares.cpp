#include "majorant/framework/terms/least_squares.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "majorant/framework/error.h"

namespace majorant {
namespace {

// The smallest slope of a loss. Slopes are the weights of reweighted least squares and must not
// underflow to 0 for distant outliers.
constexpr double kLeastSlope = std::numeric_limits<double>::min();

double squared(double width) {
  if (!(width > 0) || !std::isfinite(width))
    throw InvalidArgument("robust loss: the width must be positive");
  return width * width;
}

}  // namespace

RobustLoss huber_loss(double width) {
  return [width, b = squared(width)](double s) -> std::array<double, 3> {
    if (s <= b) return {s, 1, 0};
    const double r = std::sqrt(s), slope = std::max(kLeastSlope, width / r);
    return {2 * width * r - b, slope, -slope / (2 * s)};
  };
}

RobustLoss soft_l1_loss(double width) {
  return [b = squared(width)](double s) -> std::array<double, 3> {
    const double sum = 1 + s / b, root = std::sqrt(sum), slope = std::max(kLeastSlope, 1 / root);
    return {2 * b * (root - 1), slope, -slope / (2 * b * sum)};
  };
}

RobustLoss cauchy_loss(double width) {
  return [b = squared(width)](double s) -> std::array<double, 3> {
    const double sum = 1 + s / b, slope = std::max(kLeastSlope, 1 / sum);
    return {b * std::log(sum), slope, -slope * slope / b};
  };
}

RobustLoss arctan_loss(double width) {
  return [width, b = squared(width)](double s) -> std::array<double, 3> {
    const double slope = std::max(kLeastSlope, 1 / (1 + s * s / b));
    return {width * std::atan2(s, width), slope, -2 * s / b * slope * slope};
  };
}

RobustLoss tukey_loss(double width) {
  return [b = squared(width)](double s) -> std::array<double, 3> {
    if (s > b) return {b / 3, 0, 0};
    const double v = 1 - s / b;
    return {b / 3 * (1 - v * v * v), v * v, -2 / b * v};
  };
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
