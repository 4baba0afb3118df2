// The unit in which layouts are computed: products of coordinates neither overflow nor vanish.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "majorant/parametrization/maps/bezier_map.h"

namespace majorant {

// A power of two, so that dividing by it rounds nothing: the largest coordinate becomes 1 to 2.
inline double layout_unit(const std::vector<BezierMap>& charts) {
  double largest = 0;
  for (const BezierMap& chart : charts)
    largest = std::max(largest, chart.control_points().cwiseAbs().maxCoeff());
  return largest > 0 ? std::exp2(std::ilogb(largest)) : 1;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
