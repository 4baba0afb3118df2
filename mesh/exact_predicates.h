// Signs of geometric predicates in the plane, exact for points whose coordinates are doubles.
//
//   orientation({0, 0}, {1, 0}, {0, 1});            // 1
//   in_circle({0, 0}, {1, 0}, {0, 1}, {1, 1});      // 0
//   segments_meet({0, 0}, {2, 2}, {0, 2}, {2, 0});  // true
//
// The tests are filtered: they take tens of nanoseconds unless points are close to collinear.
// Numbers must be finite.
#pragma once

#include <cmath>
#include <limits>

#include "majorant/framework/rounding.h"
#include "majorant/framework/types.h"

namespace majorant {

// Returns the largest rounding error of left - right, where left = (a - c).x (b - c).y and right =
// (a - c).y (b - c).x are computed in doubles [She97]. A larger difference has the sign of the
// orientation of a, b, c. The last term exceeds the loss of products that underflow.
inline double orientation_error(double left, double right) {
  constexpr double kFourRoundings = (3 + 16 * kUnitRoundoff<double>)*kUnitRoundoff<double>;
  return kFourRoundings * (std::abs(left) + std::abs(right)) + std::numeric_limits<double>::min();
}

// Returns +1 if a, b, c turn left (the triangle is positive), -1 if they turn right, 0 on one line.
int orientation(const Vector2& a, const Vector2& b, const Vector2& c);

// Returns +1 if d is inside the circle through a, b, c, which turn left, -1 if it is outside, 0 on
// it; the opposite if they turn right. [She97]
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
