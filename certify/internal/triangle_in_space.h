// A triangle in space, with tests which points lie in it and on its sides.
//
//   const Vector3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0), p(0.2, 0.2, 0);
//   const TriangleInSpace triangle({a, b, c}, 1e-9);
//   const bool is_inside = triangle.contains(p) && !triangle.has_on_a_side(p, p);
#pragma once

#include <array>

#include "majorant/framework/types.h"

namespace majorant {

class TriangleInSpace {
 public:
  // close: the distance within which places are the same.
  TriangleInSpace(const std::array<Vector3, 3>& corners, double close);

  const Vector3& area() const { return area_; }  // area times normal
  double length() const;                         // sum of the lengths of its sides
  // Returns whether it has no area, to within `close`.
  bool is_flat() const { return 2 * area_.norm() <= close_ * length(); }
  bool contains(const Vector3& p) const;
  // Returns whether one of its sides contains both points.
  bool has_on_a_side(const Vector3& p, const Vector3& q) const;

 private:
  bool is_on(std::size_t k, const Vector3& p) const;
  bool is_on_a_side(const Vector3& p) const { return is_on(0, p) || is_on(1, p) || is_on(2, p); }

  std::array<Vector3, 3> corners_;
  Vector3 area_;
  double close_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
