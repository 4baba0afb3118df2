// Four corners around an edge, with the tests of straight-sided triangles that precede a flip.
//
//   const Vector2 a(0, 0), d(1, -1), b(2, 0), c(1, 1);
//   const Quadrilateral q{a, d, b, c};     // counterclockwise; the edge runs from a to b
//   if (q.is_strictly_convex(1e-10) && q.wants_delaunay_flip(1e-10)) ...
//
// Tolerances are sines of angles: sines up to the tolerance count as 0, at any scale.
#pragma once

#include "majorant/framework/rounding.h"
#include "majorant/framework/types.h"

namespace majorant {

struct Quadrilateral {
  // The rounding error that differences and products of coordinates may add to the sine of an
  // angle: 32 unit roundoffs, more than the operations of wants_delaunay_flip() on one path.
  static constexpr double kRounding = 32 * kUnitRoundoff<double>;
  // The rounding error of corners that come from unfolding two triangles in space: 300 times
  // kRounding, for the distances computed there.
  static constexpr double kUnfoldedRounding = 1e-12;

  Vector2 a, d, b, c;

  // Returns whether all angles of the counterclockwise triangle p, q, r have sines above the
  // tolerance.
  static bool is_positive(const Vector2& p, const Vector2& q, const Vector2& r, double sine) {
    const auto turns = [sine](const Vector2& in, const Vector2& out) {
      return cross(in, out) > sine * in.norm() * out.norm();
    };
    return turns(q - p, r - q) && turns(r - q, p - r) && turns(p - r, q - p);
  }
  bool flips_to_positive(double sine) const {
    return is_positive(d, c, a, sine) && is_positive(c, d, b, sine);
  }
  bool is_strictly_convex(double sine) const {
    return is_positive(a, b, c, sine) && is_positive(b, a, d, sine) && flips_to_positive(sine);
  }
  // Returns whether the angles opposite the edge add up to more than pi: the sine of their sum is
  // negative.
  bool wants_delaunay_flip(double sine) const {
    const Vector2 ca = a - c, cb = b - c, da = a - d, db = b - d;
    const double sum = cross(ca, cb) * da.dot(db) + ca.dot(cb) * cross(db, da);
    return sum < -sine * ca.norm() * cb.norm() * da.norm() * db.norm();
  }
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
