#include "majorant/framework/hessian_factor.h"

#include <cmath>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"
#include "majorant/framework/internal/option_check.h"
#include "majorant/framework/partition.h"
#include "majorant/framework/problem_parts.h"

namespace majorant {

HessianFactor::HessianFactor(const Problem& problem, VecIn y, BlendedCurvature curvature,
                             const SolverFactory& linear_solver)
    : problem_(problem), solver_(make_solver("HessianFactor", linear_solver)) {
  if (partition_of(problem).ranks().count() > 1)
    throw InvalidArgument("HessianFactor: the problem is that of several processes");
  Evaluator evaluator(problem_);
  Vec values;
  energy_ = evaluator.linearize(y, curvature, gradient_, values);
  if (!std::isfinite(energy_) || !gradient_.allFinite() || !values.allFinite())
    throw Error(ErrorKind::Unsupported, "HessianFactor: the energy is not finite at this point");
  solver_->analyze(problem_.pattern());
  if (solver_->factorize(values, 0) != FactorStatus::Ok)
    throw Error(ErrorKind::Unsupported,
                "HessianFactor: the Hessian is not positive definite at this point");
}

Eigen::MatrixXd HessianFactor::solve(const Eigen::Ref<const Eigen::MatrixXd>& b) const {
  require_size("HessianFactor::solve: b", b.rows(), problem_.size());
  Eigen::MatrixXd x(b.rows(), b.cols());
  Vec column;
  for (Index k = 0; k < b.cols(); ++k) {
    solver_->solve(b.col(k), column);
    x.col(k) = column;
  }
  return x;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
