// The distance below which places of files count as the same.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>

#include "majorant/framework/rounding.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

// box: of what a file holds. Ten digits of its size, and what rounding takes far from the origin;
// 0 of an empty one. What a point computed on an edge, or printed with ten digits, may be
// off; 8 spacings of the largest coordinate for sums of a few such points.
inline double match_tolerance(const Eigen::AlignedBox3d& box) {
  if (box.isEmpty()) return 0;
  const double farthest =
      std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  return kTenDigits * box.sizes().maxCoeff() + 16 * kUnitRoundoff<double> * farthest;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
