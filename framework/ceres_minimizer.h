// The Ceres Solver [AMT22] on a Problem, for comparison and as an independent check. It has L-BFGS
// and nonlinear conjugate gradients with a Wolfe line search, and for least squares
// (framework/terms/least_squares.h) Levenberg-Marquardt and dogleg steps.
//
//   CeresMinimizer ceres(CeresOptions{.method = CeresOptions::Method::LevenbergMarquardt});
//   SolveResult result = ceres.minimize(problem, y0, observer);
//
// Levenberg-Marquardt and dogleg use the residuals of each element, their Jacobians with respect to
// the reduced unknowns, weights and robust losses; Ceres assembles, factorizes and steps. Every
// term has to be a ResidualTerm; bounds and loads are not.
//
// Not for maps that must stay injective: if the energy is not finite or a FeasibilityChecker
// refuses a point, Ceres sees a failed evaluation and shortens its step. All accepted points pass
// the checkers, but the paths between them are not certified. L-BFGS and conjugate gradients have
// no metric, so the number of their iterations grows with the condition of the Hessian. The methods
// of first_order.h certify paths and have a metric.
//
// The minimizer requests silence from Ceres, which nevertheless reports restarts of conjugate
// gradients through glog, to stderr. glog's level belongs to the process, so the library does not
// change it: a program that wants silence sets FLAGS_minloglevel once, when it starts.
#pragma once

#include "majorant/framework/minimizer.h"

namespace majorant {

// Ceres stops when one of these holds; E_k is the energy after iteration k, and g_k its gradient:
//     |E_k - E_{k-1}| <= function_tolerance |E_{k-1}|,
//     max_i |g_k,i| <= gradient_tolerance / scale,
//     |y_k - y_{k-1}| <= parameter_tolerance (|y_k| + parameter_tolerance).
struct CeresOptions {
  enum class Method { Lbfgs, NonlinearConjugateGradient, LevenbergMarquardt, Dogleg };
  Method method = Method::Lbfgs;
  // The default is that of first_order_rules().
  int max_iterations = 10000;
  // The default is that of first_order_rules(): only steps without a gain end the run.
  double function_tolerance = 1e-14;
  // An absolute tolerance: an energy per unknown, times scale. The default is that of Ceres.
  double gradient_tolerance = 1e-10;
  // 100 unit roundoffs: closer points do not differ.
  double parameter_tolerance = 1e-14;
  double scale = 1;  // Ceres minimizes scale * E; 1 / |E_0| makes gradient_tolerance relative
  // The number of pairs that L-BFGS keeps; other methods ignore it. The default is that of Ceres.
  int history = 20;
  StopCheck stop = {};  // ends a run between evaluations and batches of elements
};

class CeresMinimizer final : public Minimizer {
 public:
  explicit CeresMinimizer(CeresOptions options = {}) : options_(options) {}
  // Throws InvalidArgument if Ceres refuses the options, or if Levenberg-Marquardt or dogleg get a
  // term that is no ResidualTerm; the message names the term.
  //
  // * Converged: the formula of the gradient holds, or another formula holds and no checker cut the
  //  last line search short.
  // * Stalled: a checker cut it short, or the line search found nothing.
  // * Failed: Ceres gave up for another reason.
  //
  // The message is that of Ceres. In the records, `step` is a multiple of Ceres' direction.
  // step_bound, newton_decrement and shift are 0, since nothing is certified and the direction is
  // unknown. `trials` counts all evaluations, and seconds.line_search is the time of everything.
  // Levenberg-Marquardt and dogleg have step 1; shift is the inverse of the trust region's radius,
  // and `factorizations` counts computed steps, refused ones included.
  SolveResult minimize(const Problem& problem, Vec y0, RunObserver* observer) const override;

 private:
  CeresOptions options_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
