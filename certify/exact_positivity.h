// Is det J of a planar Bezier triangle positive? Decided in exact arithmetic, on the doubles as
// they are: for the few cells where LocalInjectivity, whose bounds include rounding, finds no
// proof, and to tell what is certainly inverted from what is merely too close to call.
//
//   const Points2 points = Points2::Random(6, 2);             // #(n+1)(n+2)/2 by 2
//   const CellPositivity exact = exact_positivity(points);
//   if (exact.result == ProofStatus::Violated) exact.at;       // where det J <= 0
//
// The Bernstein coefficients of det J are scaled to integers; the triangle is bisected until all
// coefficients of every piece are positive, or one at a corner of a piece, which is a value of
// det J, is not. Degree 1 always decides. Microseconds where that is soon, up to a second for a
// minimum of zero at degree 8: not for the solver.
#pragma once

#include "majorant/elements/bernstein.h"
#include "majorant/elements/positivity.h"
#include "majorant/framework/stop_check.h"

namespace majorant {

struct CellPositivity {
  // Proven and Violated are exact; Undecided: the pieces ran out (a minimum of det J that is
  // zero, or nearly so, at a point that bisection does not meet), or coordinates are not finite,
  // as where the Bezier form of interpolated values is beyond doubles.
  ProofStatus result = ProofStatus::Undecided;
  Barycentric at = Barycentric::Zero();  // where det J <= 0, when Violated
};

// control_points: in VTK's order (elements/bernstein.h). Throws
// InvalidArgument when their number is not triangular or the degree is over
// BezierTriangleSpace::kMaxDegree; Stopped.
CellPositivity exact_positivity(const Points2& control_points, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
