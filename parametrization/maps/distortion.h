// What a map does to the surface at one point, in the words of the field.
//
//   const PointDistortion d = distortion_of(map.jacobian(12, {0.2, 0.3, 0.5}));
//   const double much = d.area();     // 2: twice as large in the plane as on the surface
//   const double skew = d.angle();    // 1: conformal
//
// All of it comes from the singular values sigma_1 >= sigma_2 of the map J from the surface to the
// plane. At an isometry everything is 1. Area, sigma_1, sigma_2 and stretch depend on the scale of
// the layout: multiply J by it first (layout_scale()). Not a criterion of
// validity: that is proven, not sampled (MapMeasures::min_det).
#pragma once

#include <cmath>
#include <limits>

#include "majorant/framework/types.h"

namespace majorant {

struct PointDistortion {
  // Units of the plane per unit of the surface. sigma_2 has the sign of det J: negative where the
  // map turns the surface over; sigma_1 >= |sigma_2|.
  double sigma_1 = 1, sigma_2 = 1;

  // sigma_1 sigma_2 = det J, the area in the plane of a unit of area on the surface.
  double area() const { return sigma_1 * sigma_2; }
  // sigma_1 / sigma_2 >= 1, how far circles are from staying circles; +inf where det J <= 0.
  double angle() const { return over_positive(sigma_1); }
  // sqrt((1 / sigma_1^2 + 1 / sigma_2^2) / 2), the root mean square, over all directions, of how
  // much a texture is stretched on the surface; [SSGH01] Sec. 3 with the singular values Gamma =
  // 1 / sigma_2 and gamma = 1 / sigma_1 of the inverse map. +inf where det J <= 0.
  double stretch_l2() const {
    const double ratio = sigma_2 / sigma_1;
    return over_positive(std::sqrt(0.5 + 0.5 * ratio * ratio));
  }
  // 1 / sigma_2, the same in the worst direction; +inf where det J <= 0.
  double stretch_linf() const { return over_positive(1); }

 private:
  double over_positive(double value) const {
    return sigma_2 > 0 ? value / sigma_2 : std::numeric_limits<double>::infinity();
  }
};

// J: any 2 by 2 matrix, columns the images of an orthonormal frame of the surface.
PointDistortion distortion_of(const Eigen::Matrix2d& J);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
