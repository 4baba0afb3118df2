// The factorized Hessian of a problem at a point: for Newton directions, sensitivities and
// compliances.
//
//   const HessianFactor factor(problem, y0);
//   const Eigen::MatrixXd columns = Eigen::MatrixXd::Identity(problem.size(), 2);
//   const Eigen::MatrixXd x = factor.solve(columns);   // the first two columns of H^-1
//
// Not for the matrix itself: Evaluator::hessian() (problem.h). Not for minimizing: NewtonMinimizer
// (newton.h) reuses its analysis from step to step.
#pragma once

#include <memory>

#include "majorant/framework/curvature.h"
#include "majorant/framework/linear_solver.h"
#include "majorant/framework/problem.h"

namespace majorant {

class HessianFactor {
 public:
  // y: problem.size() unknowns inside the domain. Throws Error(Unsupported) if the Hessian is not
  // positive definite or not finite, InvalidArgument for another number of unknowns, a curvature
  // that a term does not support, and a problem of several processes.
  HessianFactor(
      const Problem& problem, VecIn y, BlendedCurvature curvature = Curvature::Exact,
      const SolverFactory& linear_solver = [] { return make_direct_solver(); });

  double energy() const { return energy_; }          // at y
  const Vec& gradient() const { return gradient_; }  // at y
  // Returns H^-1 b for b with problem.size() rows and one column for each right-hand side. Throws
  // InvalidArgument for another number of rows.
  Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& b) const;

 private:
  Problem problem_;  // its pattern is that of the solver
  std::shared_ptr<LinearSolver> solver_;
  double energy_ = 0;
  Vec gradient_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
