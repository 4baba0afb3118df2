#include "majorant/mesh/internal/exact_predicates.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <utility>

namespace majorant {
namespace {

bool apart(double p, double q, double r, double s) {
  return std::max(p, q) < std::min(r, s) || std::max(r, s) < std::min(p, q);
}

bool precedes(const Vector2& a, const Vector2& b) {
  return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y());
}

}  // namespace

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
  // Segments on one line meet where their boxes do.
  return !apart(a.x(), b.x(), c.x(), d.x()) && !apart(a.y(), b.y(), c.y(), d.y()) &&
         orientation(a, b, c) * orientation(a, b, d) <= 0 &&
         orientation(c, d, a) * orientation(c, d, b) <= 0;
}

bool segments_fold(const Vector2& a, const Vector2& b, const Vector2& d) {
  return orientation(a, b, d) == 0 && precedes(a, b) != precedes(b, d);
}

}  // namespace majorant
