// L-BFGS [LN89] with a factored metric as initial inverse Hessian, and a feasible line search.
//
//   LbfgsMinimizer lbfgs(LbfgsOptions{.history = 10});
//   SolveResult result = lbfgs.minimize(problem, y0, observer);
//
// One factorization at the start and a gradient per iteration instead of a Hessian and a
// factorization: for problems where factorizing dominates and accuracy beyond the projected Hessian
// is not needed. Steps beyond the reach of the metric take many iterations; Newton's method
// (newton.h) is the default, and can keep each of its factors for a few such steps.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "majorant/framework/line_search.h"
#include "majorant/framework/linear_solver.h"
#include "majorant/framework/minimizer.h"

namespace majorant {

// A minimum is found when -g.p <= stopping.decrement |E|, p = -B g the L-BFGS direction: the
// decrement that Newton's method has with B^-1 as its Hessian.
struct LbfgsOptions {
  // Pairs (change of y, change of g) that B satisfies; 0: descent in the metric. [NW06] Sec. 7.2
  // has 3 to 20.
  int history = 10;
  // The metric is its Hessian, shifted if need be; empty: the problem itself.
  std::optional<Problem> metric = {};
  Curvature curvature = Curvature::Projected;  // of the metric
  // Pairs with s.q <= cautious |s| |q| are skipped: B stays positive definite [LF01]. Far above the
  // rounding of s.q.
  double cautious = 1e-10;
  StoppingRules stopping = first_order_rules();
  LineSearchOptions line_search = {};
  SolverFactory linear_solver = [] { return make_direct_solver(); };
  StopCheck stop = {};  // ends a step, as in NewtonOptions
};

class LbfgsMinimizer final : public Minimizer {
 public:
  explicit LbfgsMinimizer(LbfgsOptions options = {}) : options_(std::move(options)) {}
  // Throws InvalidArgument when options.metric has other unknowns or constraints than
  // `problem` or does not support options.curvature. A direction that is no descent direction, or
  // along which nothing is gained, is replaced by that of the metric and the history dropped.
  // Records: newton_decrement = -g.p, shift and curvature of the metric.
  SolveResult minimize(const Problem& problem, Vec y0, RunObserver* observer) const override;

 private:
  LbfgsOptions options_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
