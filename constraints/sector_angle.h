#pragma once

#include <cmath>

#include "majorant/framework/types.h"

namespace majorant {

// Radians in (-pi, pi] by which `left` is turned from `right`: of a corner of a curved triangle,
// whose control points beside it give the two tangents, positive where det J is. 0 where one of
// them is 0. Lengths do not matter: products of the tangents of maps of any size neither underflow
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
