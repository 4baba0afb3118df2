#include "majorant/parametrization/maps/distortion.h"

#include "majorant/elements/singular_values.h"

namespace majorant {

PointDistortion distortion_of(const Eigen::Matrix2d& J) {
  const auto [larger, smaller] = singular_values(J);
  return {larger, smaller};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
