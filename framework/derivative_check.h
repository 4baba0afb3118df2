// Compares the derivatives of an energy term with finite differences: the first thing to run on a
// new EnergyTerm.
//
//   DerivativeReport report = check_derivatives(*energy, x);
//   if (!report.ok()) std::cerr << report.message();   // names the element and the block
//
// Differences of values() check the gradient, differences of the gradient check the Hessian under
// Curvature::Exact; the other curvature models the term supports are checked to be positive
// semidefinite, blends of Exact and Projected to lie between them; local() without a Hessian has to
// give the same gradient (a term that writes through the null pointer crashes here); elements
// evaluated together have to give what each gives alone. x must lie inside the domain, away from
// its boundary and from kinks.
#pragma once

#include <string>
#include <vector>

#include "majorant/framework/energy_term.h"

namespace majorant {

struct DerivativeMismatch {
  Index element;
  std::string block;  // "gradient[3]", "hessian(4, 1)", "gradient[3] without hessian", "... among
                      // others": wrong only where elements are evaluated together
  double computed, expected;
};

struct DerivativeReport {
  double gradient_error = 0;  // largest, relative to the element's largest gradient entry
  double hessian_error = 0;   // likewise
  std::vector<DerivativeMismatch> mismatches;  // of each element at most one of every kind
  bool ok() const { return mismatches.empty(); }
  std::string message() const;  // one line per mismatch
};

// tolerance: relative to the largest entry of the element's gradient or Hessian (plus the energy
// itself divided by the size of the element, plus what 1e-5 of it changes). state: as for the
// term's evaluation.
DerivativeReport check_derivatives(const EnergyTerm& term, VecIn x, double tolerance = 1e-5,
                                   const TermState& state = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
