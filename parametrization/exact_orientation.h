// On which side of a line is a point? Exactly, for all finite doubles.
//
//   orientation({0, 0}, {1, 0}, {0, 1});   // 1: to the left
#pragma once

#include "majorant/framework/types.h"

namespace majorant {

// Sign of (b - a) x (c - a): 1 if a, b, c turn left, -1 right, 0 on one line. Some nanoseconds
// unless the points are on one line to within rounding.
int orientation(const Vector2& a, const Vector2& b, const Vector2& c);

// Whether the closed segment from a to b contains p.
bool on_segment(const Vector2& a, const Vector2& b, const Vector2& p);

// Whether two closed segments have a point in common.
bool segments_meet(const Vector2& a, const Vector2& b, const Vector2& c, const Vector2& d);

}  // namespace majorant
