#include "majorant/parametrization/exact_orientation.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>

namespace majorant {

int orientation(const Vector2& a, const Vector2& b, const Vector2& c) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  const auto point = [](const Vector2& p) { return Kernel::Point_2(p.x(), p.y()); };
  return static_cast<int>(CGAL::orientation(point(a), point(b), point(c)));
}

bool on_segment(const Vector2& a, const Vector2& b, const Vector2& p) {
  const auto within = [](double x, double s, double t) {
    return std::min(s, t) <= x && x <= std::max(s, t);
  };
  return within(p.x(), a.x(), b.x()) && within(p.y(), a.y(), b.y()) && orientation(a, b, p) == 0;
}

bool segments_meet(const Vector2& a, const Vector2& b, const Vector2& c, const Vector2& d) {
  if (orientation(a, b, c) * orientation(a, b, d) < 0 &&
      orientation(c, d, a) * orientation(c, d, b) < 0)
    return true;
  return on_segment(a, b, c) || on_segment(a, b, d) || on_segment(c, d, a) || on_segment(c, d, b);
}

}  // namespace majorant
