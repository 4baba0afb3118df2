// Maps for tests, derived from others.
#pragma once

#include <random>
#include <utility>

#include "majorant/maps/bezier_map.h"
#include "mesh/obj_file.h"

namespace majorant {

inline BezierMap elevated_to(BezierMap map, int degree) {
  while (map.degree() < degree) map = map.elevated();
  return map;
}

// Returns a map of that degree with control points moved at random by up to `amount`.
inline BezierMap shaken(const BezierMap& map, double amount, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-amount, amount);
  Vec x = map.control_points();
  for (double& value : x) value += uniform(random);
  return BezierMap(map.shared_mesh(), map.shared_space(), std::move(x));
}

inline Barycentric random_point(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  double a = uniform(random), b = uniform(random);
  if (a + b > 1) a = 1 - a, b = 1 - b;
  return {a, b, 1 - a - b};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
