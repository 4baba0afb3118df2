#pragma once

#include <cmath>

#include "majorant/framework/types.h"

namespace majorant {

// Returns the angle from `right` to `left`, radians in (-pi, pi]; 0 if one of them is 0. At a
// corner of a curved triangle the control points beside it give the two tangents, and the angle is
// positive where det J is. Lengths do not matter: tangents of maps of any size neither underflow
// nor overflow.
inline double sector_angle(const Vector2& right, const Vector2& left) {
  const double a = right.lpNorm<Eigen::Infinity>(), b = left.lpNorm<Eigen::Infinity>();
  if (a == 0 || b == 0) return 0;
  const Vector2 from = right / a, to = left / b;
  return std::atan2(cross(from, to), from.dot(to));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
