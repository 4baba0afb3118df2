// First-order methods with a factored metric M: one factorization at the start, then one gradient
// per iteration, whereas Newton's method needs a Hessian and a factorization.
//
//   LbfgsMinimizer lbfgs(LbfgsOptions{.history = 10});
//   SolveResult result = lbfgs.minimize(problem, y0, observer);
//
// L-BFGS [LN89] uses M^-1 as its initial inverse Hessian and learns from the steps. It pays if
// factorizing dominates and accuracy beyond the projected Hessian is not needed. Gradient flow
// converges linearly, at a rate that depends on how well M matches the Hessian. It serves as a
// reference and as a cheap first approach.
//
// Not for steps that leave the region where the metric is a good model, where both take many
// iterations. Newton's method (newton.h) is the default, and can keep each of its factors for a few
// steps.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "majorant/framework/linear_solver.h"
#include "majorant/framework/minimizer.h"
#include "majorant/framework/stepper.h"

namespace majorant {

// A minimum is found when -g.p <= stopping.decrement |E|, with the L-BFGS direction p = -B g. This
// is the decrement of Newton's method if its Hessian is B^-1.
struct LbfgsOptions {
  // The number of pairs (change of y, change of g) that B satisfies; 0: descent in the metric.
  // [NW06] Sec. 7.2 recommends 3 to 20.
  int history = 10;
  // The problem whose Hessian is the metric, shifted if need be; empty: the problem itself.
  std::optional<Problem> metric = {};
  Curvature curvature = Curvature::Projected;  // of the metric
  // Pairs with s.q <= cautious |s| |q| are skipped, so that B stays positive definite [LF01]. The
  // value is far above the rounding of s.q.
  double cautious = 1e-10;
  StoppingRules stopping = first_order_rules();
  LineSearchOptions line_search = {};
  SolverFactory linear_solver = [] { return make_direct_solver(); };
  StopCheck stop = {};  // ends a step, as in NewtonOptions
};

class LbfgsMinimizer final : public Minimizer {
 public:
  explicit LbfgsMinimizer(LbfgsOptions options = {}) : options_(std::move(options)) {}
  // Throws InvalidArgument if options.metric has other unknowns or constraints than `problem` or
  // does not support options.curvature. If a direction is not a descent direction, or nothing is
  // gained along it, the direction of the metric replaces it and the history is dropped. In the
  // records, newton_decrement is -g.p, and shift and curvature are those of the metric.
  SolveResult minimize(const Problem& problem, Vec y0, RunObserver* observer) const override;

 private:
  LbfgsOptions options_;
};

// Gradient flow in a Sobolev metric: p = -M^-1 g, with one factorization for all steps. With the
// Hessian of the Dirichlet energy as M this is the Sobolev gradient descent of [Neu97].
//
//   GradientFlowMinimizer flow(GradientFlowOptions{.metric = problem});   // of Dirichlet's energy
//   SolveResult result = flow.minimize(problem, y0, observer);
//
// A minimum is found when -g.p = g.M^-1 g <= stopping.decrement |E|, an energy in M's scale. If M
// matches the Hessian within a factor k, the excess over the minimum is below k/2 of that.
struct GradientFlowOptions {
  // The problem whose Hessian at the start is M, shifted if need be; empty: the problem itself.
  std::optional<Problem> metric = {};
  Curvature curvature = Curvature::Projected;  // of M
  StoppingRules stopping = first_order_rules();
  LineSearchOptions line_search = {};
  SolverFactory linear_solver = [] { return make_direct_solver(); };
  StopCheck stop = {};  // ends a step, as in NewtonOptions
};

class GradientFlowMinimizer final : public Minimizer {
 public:
  explicit GradientFlowMinimizer(GradientFlowOptions options = {}) : options_(std::move(options)) {}
  // Throws InvalidArgument if options.metric has other unknowns or constraints than `problem` or
  // does not support options.curvature. In the records, newton_decrement is g.M^-1 g, step and
  // step_bound are multiples of p, and shift and curvature are those of M. The first trial step of
  // an iteration is the accepted step of the last one.
  SolveResult minimize(const Problem& problem, Vec y0, RunObserver* observer) const override;

 private:
  GradientFlowOptions options_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
