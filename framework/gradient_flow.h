// Gradient flow in a Sobolev metric: p = -M^-1 g with one factorization for all steps, and a
// feasible line search. With the Hessian of the Dirichlet energy as M this is the Sobolev gradient
// descent of [Neu97] that preconditioned map optimizers use.
//
//   GradientFlowMinimizer flow(GradientFlowOptions{.metric = problem});   // of Dirichlet's energy
//   SolveResult result = flow.minimize(problem, y0, observer);
//
// Converges linearly, with a rate that depends on how well M matches the Hessian: a yardstick and a
// cheap first approach. To reach a minimum take lbfgs.h or newton.h.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "majorant/framework/line_search.h"
#include "majorant/framework/linear_solver.h"
#include "majorant/framework/minimizer.h"

namespace majorant {

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
