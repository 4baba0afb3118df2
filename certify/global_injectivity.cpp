#include "majorant/certify/global_injectivity.h"

#include <cmath>

#include "majorant/certify/check_layout.h"
#include "majorant/framework/internal/rounding.h"

namespace majorant {
namespace {

// Layouts whose largest coordinate is above 2^400 are compared at a size near 1. Origin: products
// of two coordinates stay far from the end of the range of doubles, 2^1024.
constexpr int kLargeExponent = 400;

// A power of two that can be divided by without losing a digit: 1 where that is not needed, or not
// possible.
double unit_of(VecIn x) {
  const double largest = x.size() == 0 ? 0 : x.cwiseAbs().maxCoeff();
  if (!std::isfinite(largest) || std::ilogb(largest) <= kLargeExponent) return 1;
  const double unit = power_of_two(largest);
  return Vec(unit * Vec(x / unit)) == x ? unit : 1;
}

}  // namespace

GlobalInjectivity check_boundary(const BezierMap& map, const InjectivityOptions& options) {
  const double unit = unit_of(map.control_points());
  if (unit == 1) return check_layout(boundary_loops(map), options);
  const BezierMap near_one = map.with(map.shared_space(), Vec(map.control_points() / unit));
  GlobalInjectivity proof = check_layout(boundary_loops(near_one), options);
  for (BoundaryContact& contact : proof.contacts) contact.where *= unit;
  if (proof.covered_twice) *proof.covered_twice *= unit;
  return proof;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
