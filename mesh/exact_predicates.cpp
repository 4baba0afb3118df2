#include "majorant/mesh/exact_predicates.h"

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <utility>

#include "majorant/framework/exact_integers.h"

namespace majorant {
namespace {

bool apart(double p, double q, double r, double s) {
  return std::max(p, q) < std::min(r, s) || std::max(r, s) < std::min(p, q);
}

bool precedes(const Vector2& a, const Vector2& b) {
  return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y());
}

int exact_orientation(const Vector2& a, const Vector2& b, const Vector2& c) {
  using Integer = boost::multiprecision::cpp_int;
  const auto x = to_integers<Integer>(std::array{a.x(), a.y(), b.x(), b.y(), c.x(), c.y()});
  const Integer left = (x[2] - x[0]) * (x[5] - x[1]), right = (x[3] - x[1]) * (x[4] - x[0]);
  return (left > right) - (left < right);
}

}  // namespace

int orientation(const Vector2& a, const Vector2& b, const Vector2& c) {
  const double left = (b.x() - a.x()) * (c.y() - a.y()), right = (b.y() - a.y()) * (c.x() - a.x());
  const double area = left - right;
  if (std::abs(area) > orientation_error(left, right)) return area > 0 ? 1 : -1;
  return exact_orientation(a, b, c);
}

bool on_segment(const Vector2& a, const Vector2& b, const Vector2& p) {
  const auto within = [](double x, double s, double t) {
    return std::min(s, t) <= x && x <= std::max(s, t);
  };
  return within(p.x(), a.x(), b.x()) && within(p.y(), a.y(), b.y()) && orientation(a, b, p) == 0;
}

bool segments_meet(const Vector2& a, const Vector2& b, const Vector2& c, const Vector2& d) {
  // Segments on one line meet where their boxes do.
  return !apart(a.x(), b.x(), c.x(), d.x()) && !apart(a.y(), b.y(), c.y(), d.y()) &&
         orientation(a, b, c) * orientation(a, b, d) <= 0 &&
         orientation(c, d, a) * orientation(c, d, b) <= 0;
}

bool segments_fold(const Vector2& a, const Vector2& b, const Vector2& d) {
  return orientation(a, b, d) == 0 && precedes(a, b) != precedes(b, d);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
