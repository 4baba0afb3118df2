// Do planar Bezier curves meet? Decided by subdivision; every rounding error is bounded, so that
// Proven (apart) and Violated are proofs.
//
//   const PlanarCurve arc{2, {Vector2(0, 0), Vector2(1, 1), Vector2(2, 0)}};
//   const PlanarCurve line{1, {Vector2(1, 0), Vector2(1, 1)}};
//   contact_between(arc, line).apart;   // ProofStatus::Violated, near (1, 0.5)
//
// Pieces are apart when an axis separates their control points, or the graph of a polynomial that
// is fitted between them (curve_graph.h): curves along each other at the distance d take some (size
// / d)^(1/8) pieces. They cross when one stays between the ends of the other and passes from one
// side of its control points to the other, seen from a straight or a curved axis. Two pieces with a
// common end have nothing else in common when a line through it separates their control points; a
// piece is simple when its control polygon advances along its chord. Whatever double precision
// cannot tell is tried again in quadruple precision. Lines are compared exactly.
//
// Undecided is left where curves touch without crossing (Violated only if an end point of one is an
// end point of the other, or lies on it and it is a line), where they leave a common end in the
// same direction, at zero tangents, where one runs along the other within 1e-14 of its size or so,
// where the budget ends, and out of range.
#pragma once

#include <functional>
#include <utility>

#include "majorant/certify/global_injectivity.h"
#include "majorant/certify/internal/planar_curve.h"

namespace majorant {

struct CurveContact {
  ProofStatus apart = ProofStatus::Proven;  // that the curves do not meet
  Vector2 where = Vector2::Zero();          // where they do or may, approximately
};

// The number of subdivisions that comparing curves may take, over any number of calls, and that it
// took: pieces of curves cut in two, those in quadruple precision counted by their cost. The number
// depends on the curves alone, but for `stopped`, which is asked every few microseconds (empty:
// never).
class SubdivisionBudget {
 public:
  explicit SubdivisionBudget(long limit, std::function<bool()> stopped = {})
      : limit_(limit), stopped_(std::move(stopped)) {}

  // Takes as much; false if there is not, now and from then on, or if `stopped` says so.
  bool spend(long subdivisions);
  bool stopped();  // asks
  bool was_stopped() const { return state_ == State::Stopped; }
  bool used_up() const { return state_ == State::UsedUp; }
  long limit() const { return limit_; }
  long spent() const { return spent_; }

 private:
  enum class State { Open, UsedUp, Stopped };
  long limit_, spent_ = 0, unasked_ = 0;
  State state_ = State::Open;
  std::function<bool()> stopped_;
};

// Any common point. Each pair of curves is given up by itself after some thousand subdivisions.
CurveContact contact_between(const PlanarCurve& a, const PlanarCurve& b, SubdivisionBudget& budget);
// Any common point but a.back(), which must equal b.front().
CurveContact contact_of_neighbours(const PlanarCurve& a, const PlanarCurve& b,
                                   SubdivisionBudget& budget);
// Any point that the curve passes twice.
CurveContact contact_with_itself(const PlanarCurve& a, SubdivisionBudget& budget);

// Do the same with the limit of a single pair only.
CurveContact contact_between(const PlanarCurve& a, const PlanarCurve& b);
CurveContact contact_of_neighbours(const PlanarCurve& a, const PlanarCurve& b);
CurveContact contact_with_itself(const PlanarCurve& a);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
