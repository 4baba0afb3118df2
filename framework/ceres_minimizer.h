// The Ceres Solver [AMT22] on a Problem, for comparison and as an independent check: L-BFGS and
// nonlinear conjugate gradients with a Wolfe line search, and for least squares
// (framework/terms/least_squares.h) Levenberg-Marquardt and dogleg steps.
//
//   CeresMinimizer ceres(CeresOptions{.method = CeresOptions::Method::LevenbergMarquardt});
//   SolveResult result = ceres.minimize(problem, y0, observer);
//
// The latter two get the residuals of each element, their Jacobians in the unknowns that
// constraints leave, weights and robust losses; Ceres assembles, factorizes and steps. Every term
// has to be a ResidualTerm: bounds and loads are none.
//
// Not for maps that must stay injective: if the energy is not finite or a FeasibilityChecker
// refuses a point, Ceres sees a failed evaluation and shortens its step. All accepted points pass
// the checkers, but the paths between them are not certified. The first two methods have no metric,
// and the number of their iterations grows with the condition of the Hessian. first_order.h has
// both.
//
// The minimizer requests silence from Ceres, which nevertheless reports restarts of conjugate
// gradients through glog, to stderr. glog's level belongs to the process, so the library does not
// change it: a program that wants silence sets FLAGS_minloglevel once, when it starts.
#pragma once

#include "majorant/framework/minimizer.h"

namespace majorant {

// Stopping formulas, with E_k the energy after iteration k, g_k its gradient there:
//     |E_k - E_{k-1}| <= function_tolerance |E_{k-1}|,
//     max_i |g_k,i| <= gradient_tolerance / scale,
//     |y_k - y_{k-1}| <= parameter_tolerance (|y_k| + parameter_tolerance).
struct CeresOptions {
  enum class Method { Lbfgs, NonlinearConjugateGradient, LevenbergMarquardt, Dogleg };
  Method method = Method::Lbfgs;
  // The default is that of first_order_rules().
  int max_iterations = 10000;
  // The default is that of first_order_rules(): only steps without a gain count.
  double function_tolerance = 1e-14;
  // Absolute: an energy per unknown, times scale. Ceres' default.
  double gradient_tolerance = 1e-10;
  // 100 unit roundoffs, below which points do not differ.
  double parameter_tolerance = 1e-14;
  double scale = 1;  // Ceres minimizes scale * E; 1 / |E_0| makes gradient_tolerance relative
  // Pairs that L-BFGS keeps, the other methods none. Ceres' default.
  int history = 20;
  StopCheck stop = {};  // ends a run between evaluations and batches of elements
};

class CeresMinimizer final : public Minimizer {
 public:
  explicit CeresMinimizer(CeresOptions options = {}) : options_(options) {}
  // Throws InvalidArgument when Ceres refuses the options, and, naming the term, where
  // Levenberg-Marquardt or dogleg get one that is no ResidualTerm. Converged: the formula of
  // the gradient holds, or another one and no checker cut the last line search short. Stalled: a
  // checker did, or the line search found nothing. Failed: Ceres gave up elsewhere. The message is
  // that of Ceres. Records: step in multiples of Ceres' direction; step_bound, newton_decrement and
  // shift are 0, since nothing is certified and the direction is not known; trials: evaluations,
  // those with gradients included; seconds.line_search: everything. Levenberg-Marquardt and dogleg:
  // step 1, shift the inverse of the trust region's radius, factorizations the steps that were
  // computed, refused ones included.
  SolveResult minimize(const Problem& problem, Vec y0, RunObserver* observer) const override;

 private:
  CeresOptions options_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
