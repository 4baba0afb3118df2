// First-order methods with a factored metric M: one factorization at the start, then a gradient per
// iteration, where Newton's method has a Hessian and a factorization.
//
//   LbfgsMinimizer lbfgs(LbfgsOptions{.history = 10});
//   SolveResult result = lbfgs.minimize(problem, y0, observer);
//
// L-BFGS [LN89] has M^-1 as its initial inverse Hessian and learns from the steps. It pays where
// factorizing dominates and accuracy beyond the projected Hessian is not needed. Gradient flow
// converges linearly, with a rate that depends on how well M matches the Hessian: a yardstick and a
// cheap first approach.
//
// Not where steps leave the reach of the metric: both take many iterations there. Newton's method
// (newton.h) is the default, and can keep each of its factors for a few such steps.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "majorant/framework/linear_solver.h"
#include "majorant/framework/minimizer.h"
#include "majorant/framework/stepper.h"

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

// Gradient flow in a Sobolev metric: p = -M^-1 g, with one factorization for all steps. With the
// Hessian of the Dirichlet energy as M this is the Sobolev gradient descent of [Neu97].
//
//   GradientFlowMinimizer flow(GradientFlowOptions{.metric = problem});   // of Dirichlet's energy
//   SolveResult result = flow.minimize(problem, y0, observer);
//
// A minimum is found when -g.p = g.M^-1 g <= stopping.decrement |E|, an energy in M's scale: M
// within a factor k of the Hessian puts the excess over the minimum below k/2 of that.
struct GradientFlowOptions {
  // M is its Hessian at the start, shifted if need be; empty: the problem itself.
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
  // Throws InvalidArgument when options.metric has other unknowns or constraints than
  // `problem` or does not support options.curvature. Records: newton_decrement = g.M^-1 g, step and
  // step_bound in multiples of p, shift and curvature of M. The first trial step of an iteration is
  // the step that the last one accepted.
  SolveResult minimize(const Problem& problem, Vec y0, RunObserver* observer) const override;

 private:
  GradientFlowOptions options_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
