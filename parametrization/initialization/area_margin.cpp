#include "majorant/parametrization/initialization/area_margin.h"

#include <algorithm>
#include <cmath>

#include "majorant/framework/rounding.h"
#include "majorant/mesh/exact_predicates.h"

namespace majorant {
namespace {

// The least height of a triangle, in roundings of the largest coordinate: three points are rounded
// twice each, by half a rounding along both axes.
constexpr double kLeastHeight = 8;

}  // namespace

Index faces_without_area_margin(const Cells& faces, const Vec& uv) {
  const double largest = uv.cwiseAbs().maxCoeff();
  if (!(largest > 0)) return static_cast<Index>(faces.rows());
  // Exact signs are valid as long as products neither overflow nor underflow.
  const double unit = power_of_two(largest);
  const double least = kLeastHeight * 4 * kUnitRoundoff<double>;
  const auto point = [&](Index v) { return Vector2(uv[2 * v] / unit, uv[2 * v + 1] / unit); };
  Index count = 0;
  for (Index f = 0; f < static_cast<Index>(faces.rows()); ++f) {
    const Vector2 a = point(faces(f, 0)), b = point(faces(f, 1)), c = point(faces(f, 2));
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    if (!(cross(b - a, c - a) > least * longest) || orientation(a, b, c) <= 0) ++count;
  }
  return count;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
