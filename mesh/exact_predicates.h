// Signs that rounding cannot change, of points in the plane as the doubles they are.
//
//   orientation({0, 0}, {1, 0}, {0, 1});            // 1
//   in_circle({0, 0}, {1, 0}, {0, 1}, {1, 1});      // 0
//   segments_meet({0, 0}, {2, 2}, {0, 2}, {2, 0});  // true
//
// Filtered: tens of nanoseconds unless the points are close to collinear. Finite numbers only.
#pragma once

#include <cmath>
#include <limits>

#include "majorant/framework/rounding.h"
#include "majorant/framework/types.h"

namespace majorant {

// By how much rounding puts left - right off at most, left = (a - c).x (b - c).y and right =
// (a - c).y (b - c).x as they are computed [She97]: a larger difference has the sign of the
// orientation of a, b, c. The last term: more than products lose that underflow.
inline double orientation_error(double left, double right) {
  constexpr double kFourRoundings = (3 + 16 * kUnitRoundoff<double>)*kUnitRoundoff<double>;
  return kFourRoundings * (std::abs(left) + std::abs(right)) + std::numeric_limits<double>::min();
}

// +1 where a, b, c turn left (the triangle is positive), -1 where they turn right, 0 on one line.
int orientation(const Vector2& a, const Vector2& b, const Vector2& c);

// +1 where d is inside of the circle through a, b, c, which turn left, -1 where it is outside, 0 on
// it; the opposite where they turn right. [She97]
int in_circle(const Vector2& a, const Vector2& b, const Vector2& c, const Vector2& d);

// Returns whether the closed segment from a to b contains p.
bool on_segment(const Vector2& a, const Vector2& b, const Vector2& p);

// Returns whether the closed segments ab and cd have a point in common.
bool segments_meet(const Vector2& a, const Vector2& b, const Vector2& c, const Vector2& d);

// Returns whether the segments ab and bd have more in common than b. a != b, b != d.
bool segments_fold(const Vector2& a, const Vector2& b, const Vector2& d);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
