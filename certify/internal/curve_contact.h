// Decides by subdivision whether planar Bezier curves meet. All rounding errors are bounded, so
// that Proven (apart) and Violated are proofs.
//
//   const PlanarCurve arc{2, {Vector2(0, 0), Vector2(1, 1), Vector2(2, 0)}};
//   const PlanarCurve line{1, {Vector2(1, 0), Vector2(1, 1)}};
//   contact_between(arc, line).apart;   // ProofStatus::Violated, near (1, 0.5)
//
// Pieces are apart if an axis separates their control points, or the graph of a polynomial fitted
// between them (curve_graph.h). Curves along each other at distance d take about (size / d)^(1/8)
// pieces. Pieces cross if one stays between the ends of the other and passes from one side of its
// control points to the other; both are seen from a straight or a curved axis. Two pieces with a
// common end have nothing else in common if a line through it separates their control points. A
// piece is simple if its control polygon advances along its chord. Cases that double precision
// leaves open are tried again in quadruple precision. Lines are compared exactly.
//
// These cases stay Undecided: curves touch without crossing; they leave a common end in the same
// direction; tangents vanish; one runs along the other within about 1e-14 of its size; the budget
// ends; coordinates are out of range. Curves that touch are Violated only if an end point of one is
// an end point of the other, or lies on it and it is a line.
#pragma once

#include <functional>
#include <utility>

#include "majorant/certify/global_injectivity.h"
#include "majorant/certify/internal/planar_curve.h"

namespace majorant {

struct CurveContact {
  ProofStatus apart = ProofStatus::Proven;  // Proven: the curves do not meet
  Vector2 where = Vector2::Zero();          // where they meet or may meet, approximately
};

// A budget of subdivisions for any number of comparisons of curves, and their count: pieces cut in
// two, those in quadruple precision weighted by their cost. The count depends on the curves alone,
// except through `stopped`, which is called every few microseconds (empty: never).
class SubdivisionBudget {
 public:
  explicit SubdivisionBudget(long limit, std::function<bool()> stopped = {})
      : limit_(limit), stopped_(std::move(stopped)) {}

  // Takes subdivisions from the budget. Returns false if it is used up or `stopped` returned true,
  // now and from then on.
  bool spend(long subdivisions);
  bool stopped();  // calls `stopped`
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

// Looks for any common point. Each pair of curves is given up after some thousand subdivisions.
CurveContact contact_between(const PlanarCurve& a, const PlanarCurve& b, SubdivisionBudget& budget);
// Looks for any common point other than a.back(), which must equal b.front().
CurveContact contact_of_neighbours(const PlanarCurve& a, const PlanarCurve& b,
                                   SubdivisionBudget& budget);
// Looks for any point that the curve passes twice.
CurveContact contact_with_itself(const PlanarCurve& a, SubdivisionBudget& budget);

// Do the same without a shared budget.
CurveContact contact_between(const PlanarCurve& a, const PlanarCurve& b);
CurveContact contact_of_neighbours(const PlanarCurve& a, const PlanarCurve& b);
CurveContact contact_with_itself(const PlanarCurve& a);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
