// Proofs that a polynomial in Bernstein form is positive on its cell: det J, for the elements here.
//
// All coefficients positive => positive; where that does not decide, the cell is bisected. [MC20]
// Sec. 5.2, App. E.
#pragma once

#include "majorant/elements/element_space.h"
#include "majorant/elements/internal/step_polynomial.h"
#include "majorant/elements/internal/subdivision.h"

namespace majorant {

// Whether the polynomial with these coefficients, each exact to +- error, is positive on the cell;
// bisects down to max_depth, its own rounding included. Proven is a proof; Violated: not
// provably positive at a corner; Undecided: max_depth was reached.
PositivityProof certify_positive(const Subdivision& cell, const double* coefficients, double error,
                                 int max_depth);

// Largest s' <= s such that the polynomial whose coefficients are p(t) is positive on the cell for
// all 0 <= t < s'; bisects up to max_depth where that lengthens the step.
double largest_positive_step(const Subdivision& cell, const StepPolynomial<2>* p, double s,
                             int max_depth);
double largest_positive_step(const Subdivision& cell, const StepPolynomial<3>* p, double s,
                             int max_depth);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
