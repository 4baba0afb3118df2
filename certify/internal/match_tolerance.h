// The distance within which places in files count as the same.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>

#include "majorant/framework/rounding.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

// box: of the contents of a file. Returns ten digits of the box's size, for points computed on an
// edge or printed with ten digits. Adds 8 spacings of the largest coordinate, for sums of a few
// such points. 0 for an empty box.
inline double match_tolerance(const Eigen::AlignedBox3d& box) {
  if (box.isEmpty()) return 0;
  const double farthest =
      std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  return kTenDigits * box.sizes().maxCoeff() + 16 * kUnitRoundoff<double> * farthest;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
