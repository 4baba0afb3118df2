// A Bezier curve in the plane, an edge of a map. curve_contact.h decides whether two of them meet.
//
//   const PlanarCurve arc{2, {Vector2(0, 0), Vector2(1, 1), Vector2(2, 0)}};
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "majorant/elements/bernstein_space.h"

namespace majorant {

struct PlanarCurve {
  static constexpr int kMaxDegree = BezierTriangleSpace::kMaxDegree;
  // The square root of the range of doubles, a limit for coordinates: products of larger ones
  // overflow. Rounding bounds cover everything else.
  static constexpr double kLargest = 1e150;
  int degree = 1;                                      // 1..kMaxDegree
  std::array<Vector2, kMaxDegree + 1> control_points;  // degree + 1, in range

  bool in_range() const {  // all coordinates finite and below kLargest
    return std::all_of(
        control_points.begin(), control_points.begin() + degree + 1,
        [](const Vector2& p) { return std::abs(p.x()) < kLargest && std::abs(p.y()) < kLargest; });
  }

  const Vector2& front() const { return control_points[0]; }
  const Vector2& back() const { return control_points[degree]; }
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
