// The length of a vector whose square may leave the range of doubles, as the squares of areas of
// meshes of size 1e100 do.
//
//   const Vector3 a(3e100, 0, 0), b(0, 4e100, 0);
//   const double area = 0.5 * length_of(a.cross(b));
//
// Bit by bit norm() wherever that is right.
#pragma once

#include <cmath>

#include "majorant/framework/types.h"

namespace majorant {

inline double length_of(const Vector3& v) {
  const double norm = v.norm();
  return std::isnormal(norm) ? norm : v.stableNorm();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
