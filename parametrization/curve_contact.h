// Do planar Bezier curves meet? Decided by subdivision; every rounding error is bounded, so that
// None and Certain are proofs.
//
//   const PlanarCurve arc{2, {Vector2(0, 0), Vector2(1, 1), Vector2(2, 0)}};
//   const PlanarCurve line{1, {Vector2(1, 0), Vector2(1, 1)}};
//   contact_between(arc, line).kind;   // Contact::Certain, near (1, 0.5)
//
// Pieces are apart when an axis separates their control points. They cross when one stays between
// the ends of the other and passes from one side of its control points to the other. Two pieces
// with a common end have nothing else in common when a line through it separates their control
// points; a piece is simple when its control polygon advances along its chord. Whatever double
// precision cannot tell is tried again in quadruple precision.
//
// Possible is left where curves touch without crossing (Certain only if an end point of one is an
// end point of the other, or lies on it and it is a line), where they leave a common end in the
// same direction, at zero tangents, and where curves run closer than 1e-9 of their size along each
// other.
#pragma once

#include <array>

#include "majorant/elements/bezier_triangle_space.h"

namespace majorant {

struct PlanarCurve {
  static constexpr int kMaxDegree = BezierTriangleSpace::kMaxDegree;
  int degree = 1;                                      // 1..kMaxDegree
  std::array<Vector2, kMaxDegree + 1> control_points;  // degree + 1, finite

  const Vector2& front() const { return control_points[0]; }
  const Vector2& back() const { return control_points[static_cast<std::size_t>(degree)]; }
};

enum class Contact { None, Certain, Possible };

struct CurveContact {
  Contact kind = Contact::None;
  Vector2 where = Vector2::Zero();  // approximately, unless None
};

// Any common point.
CurveContact contact_between(const PlanarCurve& a, const PlanarCurve& b);
// Any common point but a.back(), which must equal b.front().
CurveContact contact_of_neighbours(const PlanarCurve& a, const PlanarCurve& b);
// Any point that the curve passes twice.
CurveContact contact_with_itself(const PlanarCurve& a);

}  // namespace majorant
