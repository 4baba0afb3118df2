// The residuals of a sum of squares and their Jacobian, as matrices for inspection.
//
//   const TermId id = problem.terms().front();
//   if (dynamic_cast<const ResidualTerm*>(&problem.term(id))) {
//     const Residuals r = residuals_at(problem, id, y0);
//     const Vec gradient = r.jacobian.transpose() * r.values;    // without a loss
//   }
//
// Not for solving: Newton's method and Levenberg-Marquardt assemble J^T J themselves, and
// covariance() (sensitivity.h) computes its inverse.
#pragma once

#include <Eigen/SparseCore>

#include "majorant/framework/problem.h"
#include "majorant/framework/residual_term.h"

namespace majorant {

struct Residuals {
  Vec values;                            // element by element, times the root of its weight
  Eigen::SparseMatrix<double> jacobian;  // by the unknowns of the problem, #values by size()
};

// Returns the residuals of a term at y. Throws Error(Unsupported) for a term that is no
// ResidualTerm, InvalidArgument for another number of unknowns and for a problem of several
// processes.
Residuals residuals_at(const Problem& problem, TermId id, VecIn y);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
