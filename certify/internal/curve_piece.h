// A piece of a planar Bezier curve with bounds of its rounding errors, for curve_contact.cpp. Real:
// double or __float128.
//
// Every control point has its own absolute error bound, the same for both coordinates. So pieces
// near the origin, where the curves of a pair may share an end, stay accurate relative to their
// size.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "majorant/certify/internal/curve_contact.h"
#include "majorant/framework/rounding.h"

namespace majorant::curve_piece {

// Bounds the error of products that underflow, in sums of at most 2 (degree + 1) products.
constexpr double kUnderflow = 64 * std::numeric_limits<double>::denorm_min();

template <class Real>
struct Direction {
  Real x, y;
};

template <class Real>
struct Interval {
  Real low, high;
};

template <class Real>
struct Piece {
  static constexpr Real kUnit = kUnitRoundoff<Real>;
  // The largest number of bisections of a curve. After 60 and 120, pieces are below the rounding of
  // their points, of 53 and 113 digits.
  static constexpr int kDeepest = std::is_same_v<Real, Float128> ? 120 : 60;
  int degree = 1, depth = 0;
  std::array<Real, PlanarCurve::kMaxDegree + 1> x{}, y{}, error{};

  // Makes the curve relative to `origin`.
  Piece(const PlanarCurve& curve, const Vector2& origin) : degree(curve.degree) {
    for (int k = 0; k <= degree; ++k) {
      const std::size_t i = to_size(k);
      x[i] = Real(curve.control_points[i].x()) - Real(origin.x());
      y[i] = Real(curve.control_points[i].y()) - Real(origin.y());
      error[i] = 2 * kUnit * std::max(magnitude(x[i]), magnitude(y[i]));
    }
  }

  Direction<Real> leg(int from, int to) const { return {x[to] - x[from], y[to] - y[from]}; }
  Direction<Real> chord() const { return leg(0, degree); }
  Real largest_error() const {
    return *std::max_element(error.begin(), error.begin() + degree + 1);
  }
  // Returns the longer side of the bounding box of the control points.
  Real size() const {
    const auto extent = [this](const auto& c) {
      const auto [low, high] = std::minmax_element(c.begin(), c.begin() + degree + 1);
      return *high - *low;
    };
    return std::max(extent(x), extent(y));
  }
};

// Projects the control points k in [first, last], minus control point `base` (none: -1), onto an
// exact axis. There are three roundings in a sum of two products of differences, and a fourth when
// the bound is added; the factor 1.01 covers the rounding of the bound.
template <class Real>
Interval<Real> along(const Piece<Real>& p, const Direction<Real>& axis, int first, int last,
                     int base = -1) {
  const Real length = magnitude(axis.x) + magnitude(axis.y);
  Interval<Real> range{};
  for (int k = first; k <= last; ++k) {
    const std::size_t i = to_size(k), b = to_size(std::max(base, 0));
    const Real x = axis.x * (base < 0 ? p.x[i] : p.x[i] - p.x[b]);
    const Real y = axis.y * (base < 0 ? p.y[i] : p.y[i] - p.y[b]);
    const Real input = base < 0 ? p.error[i] : p.error[i] + p.error[b];
    const Real bound =
        Real(1.01) * (length * input + 5 * Piece<Real>::kUnit * (magnitude(x) + magnitude(y))) +
        kUnderflow;
    const Real low = x + y - bound, high = x + y + bound;
    range.low = k == first ? low : std::min(range.low, low);
    range.high = k == first ? high : std::max(range.high, high);
  }
  return range;
}

template <class Real>
Interval<Real> along(const Piece<Real>& p, const Direction<Real>& axis) {
  return along(p, axis, 0, p.degree);
}

// Splits a piece by de Casteljau at a multiple of 1/32. The default is not the middle: in symmetric
// figures curves meet there, and a crossing at the end of a piece cannot be recognized.
template <class Real>
std::pair<Piece<Real>, Piece<Real>> split(const Piece<Real>& p, double where = 15.0 / 32) {
  const Real first = 1 - where, second = where;  // weights, exact
  constexpr Real kUnit = Piece<Real>::kUnit;
  Piece<Real> left = p, right = p;
  left.depth = right.depth = p.depth + 1;
  for (int level = 1; level <= p.degree; ++level) {
    // `right` holds the triangle's current row up to degree - level, and the result beyond.
    for (int k = 0; k <= p.degree - level; ++k) {
      const std::size_t i = to_size(k), j = i + 1;
      const Real size = std::max(std::max(magnitude(right.x[i]), magnitude(right.y[i])),
                                 std::max(magnitude(right.x[j]), magnitude(right.y[j])));
      right.x[i] = first * right.x[i] + second * right.x[j];
      right.y[i] = first * right.y[i] + second * right.y[j];
      // Each term has two roundings, whose sum is at most `size`; then this bound is rounded.
      right.error[i] = (first * right.error[i] + second * right.error[j]) *
                           (1 + 8 * Real(kUnitRoundoff<double>)) +
                       3 * kUnit * size + kUnderflow;
    }
    left.x[level] = right.x[0];
    left.y[level] = right.y[0];
    left.error[level] = right.error[0];
  }
  return {left, right};
}

}  // namespace majorant::curve_piece

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
