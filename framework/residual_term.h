// A term whose elements are sums of squares, rho(|r|^2) / 2 of residuals r, in the form that other
// libraries' least squares methods need.
//
//   const TermId id = problem.terms().front();
//   Vec r;
//   RowMatrix J;
//   if (const auto* squares = dynamic_cast<const ResidualTerm*>(&problem.term(id)))
//     squares->residuals(x, 7, problem.state(id), r, &J);  // of element 7
//
// make_least_squares() (framework/terms/least_squares.h) makes such terms. Not for Gauss-Newton
// matrices, which every such term assembles itself: Curvature::Projected.
#pragma once

#include <array>

#include "majorant/framework/energy_term.h"

namespace majorant {

class ResidualTerm {
 public:
  virtual ~ResidualTerm() = default;
  // Writes the residuals of an element at x (full unknowns), not finite outside the domain, and
  // their derivatives by its local unknowns, #residuals by local_size(). jacobian may be null. Both
  // are without weights.
  virtual void residuals(VecIn x, Index element, const TermState& state, Vec& residuals,
                         RowMatrix* jacobian) const = 0;
  // Returns rho(s) and its first and second derivative, s = |r|^2.
  virtual std::array<double, 3> loss(double s) const = 0;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
