// Levenberg-Marquardt: damped Newton steps for least squares whose curvature is singular or
// misleading away from the minimum. Examples are poor starts, and motions that no residual sees
// (the frame of a bundle adjustment).
//
//   const SolveResult result = LevenbergMarquardtMinimizer().minimize(problem, y0, nullptr);
//   std::cout << result.iterations.back().shift;      // lambda of the last step
//
// Steps solve
//     (H + lambda D) p = -g,    D = diag(H), at least `least` times its largest entry
// [Mar63], with the Gauss-Newton curvature of make_least_squares(), or any other that is positive
// semidefinite. lambda follows the gain ratio, the decrease of the energy divided by the decrease
// of the quadratic model [Nie99, Sec. 2]. It falls if the ratio is near 1. It rises if the ratio is
// small or the step was shortened, and until H + lambda D is positive definite. A step without a
// decrease is shortened before it is damped, since an evaluation costs less than a factorization.
//
// Not for energies of maps: NewtonMinimizer (newton.h) needs fewer steps, because its line search
// tries steps beyond 1 and it ends with the exact Hessian.
#pragma once

#include "majorant/framework/linear_solver.h"
#include "majorant/framework/stepper.h"

namespace majorant {

struct DampingRules {
  // lambda of the first step, as in Ceres (1 / initial_trust_region_radius).
  double first = 1e-4;
  // The smallest entry of D, relative to the largest one; it keeps unknowns in place that no
  // residual sees. The default is that of Ceres, min_lm_diagonal.
  double least = 1e-6;
  // The bounds of lambda. Below `smallest` it only makes a singular H definite. Above `largest`,
  // steps are those of gradient descent, too short to matter.
  double smallest = 1e-12;
  double largest = 1e12;
};

struct LevenbergMarquardtOptions {
  Curvature curvature = Curvature::Projected;
  DampingRules damping = {};
  StoppingRules stopping = {};
  SolverFactory linear_solver = [] { return make_direct_solver(); };
  StopCheck stop = {};
};

class LevenbergMarquardtMinimizer final : public Minimizer {
 public:
  explicit LevenbergMarquardtMinimizer(LevenbergMarquardtOptions options = {})
      : options_(std::move(options)) {}
  // Throws InvalidArgument for options out of range, a curvature that the problem does not support,
  // and a problem of several processes. In the records, shift is lambda, and newton_decrement is
  // -(1 + lambda) g.p, which lies between -g.p of the step without damping and g.D^-1 g.
  SolveResult minimize(const Problem& problem, Vec y0, RunObserver* observer) const override;

 private:
  LevenbergMarquardtOptions options_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
