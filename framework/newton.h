// Newton's method with a positive semidefinite curvature model and a feasible line search.
//
//   NewtonMinimizer newton(NewtonOptions{.curvature = Curvature::Projected});
//   SolveResult result = newton.minimize(problem, y0, observer);
//
// Outer loops that change the problem between steps (weights, rules) use NewtonStepper, which
// keeps the symbolic factorization. Not for problems without a sparse Hessian.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "majorant/framework/curvature_choice.h"
#include "majorant/framework/linear_solver.h"
#include "majorant/framework/stepper.h"

namespace majorant {

// Near a minimum the projected Hessian overestimates curvature and steps converge linearly; the
// exact one converges quadratically, but is not positive definite until late. In between stands
//     H = H_exact + t (H_projected - H_exact)                                    (curvature.h)
// where all terms support both models. t falls by a factor with every step that succeeds, rises
// when the factorization fails or the Hessian misleads, and is 1 far from a minimum.
struct BlendRules {
  // t < 1 where the last -g.p was less than this part of |E|; 0: never. Tuned by bench/tune.py
  // blend.below.
  double below = 1e-3;
  // The factor of t after a step. Tuned by bench/tune.py blend.fall.
  double fall = 0.2;
  // Below, t is 0: the exact Hessian. Tuned by bench/tune.py blend.least.
  double least = 0.06;
  // Steps during which t stays where a failure has raised it. Tuned by bench/tune.py blend.hold.
  int hold = 2;
  // A shorter step is followed by `whole_steps` steps with t = 1. Tuned by bench/tune.py
  // blend.short_step, blend.whole_steps.
  double short_step = 0.26;
  int whole_steps = 2;
  // After so many short steps with t = 1 in a row the exact Hessian is tried at once, wherever the
  // run is, and kept as long as its steps are not short; 0: never. A Gauss-Newton model with
  // residuals that do not vanish, say, may be nearly singular where the exact Hessian is not.
  int misled_steps = 3;
  // A shift of H, times 1 - t, from y and the gradient there; empty: none. rotation_shift() is one.
  std::function<double(const Vec& y, const Vec& gradient, const Partition&)> shift = {};
};

// Makes up for the negative curvature that the exact Hessian of an energy invariant under rotations
// about the origin has along them away from a minimum: it is y.g / |y|^2 (differentiate the
// gradient along a rotation). Half as much again, and 0 at a minimum.
double rotation_shift(const Vec& y, const Vec& gradient, const Partition& partition);

// Shifts of a Hessian that is not positive definite, or so nearly singular that its direction is
// much too long [NW06, 3.4]. Relative to the mean of |H_ii|.
struct ShiftRules {
  // The first shift above 0, a tenth of the next. The direction of a singular Hessian is wrong by
  // rounding over the shift: 1e-7 of it here.
  double least = 1e-9;
  // After a step that is shorter, as a part of its direction, the next one has a larger shift, by
  // the factor that is missing, or 10; 0: it has not.
  double short_step = 1e-3;
  // The same after a step that is shorter because the energy falls too little along it; after one
  // that is shorter than half of its direction for that reason, the shift stays.
  double cut_step = 0.1;
  // The part of the last step's shift that a step begins with, its square after a step that needed
  // no more, and so on; 0: it begins without any.
  double fall = 1.0 / 3;
  // Steps that begin with `least` after a factorization without a shift has failed; twice as many
  // each time that it does.
  int wait = 4;
};

// Steps on a lagged factor: a step may take the last factor as the metric of L-BFGS in place of a
// new factorization. Such a step costs a solve, a gradient and a line search. It pays near a
// minimum that Newton's method would reach in many steps, after a start that is already close
// (levels of a multiresolution start, a map that has changed a little). Far from a minimum it
// wastes steps.
struct LaggedFactorRules {
  // A factor is kept where -g.p of its own step was less than this part of |E|; 0: never. Tuned by
  // bench/tune.py lagged.below.
  double below = 0;
  // The number of pairs that L-BFGS keeps. Tuned by bench/tune.py lagged.history.
  int history = 8;
  // Steps that a factor serves beside its own; more save little at any degree.
  int steps = 5;
  // A shorter step is followed by a factorization.
  double short_step = 0.05;
};

// The accuracy with which H p = -g is solved, for solvers that can save by it
// (LinearSolver::solve):
//     |H p + g| <= eta |g|,  eta = min(largest, max(part (|g_k| / |g_k-1|)^2, safeguard)),
//     safeguard = part eta_k-1^2 where that is above safeguarded, else 0
// which keeps the convergence quadratic: [EW96], choice 2. Direct solvers do not look at it.
struct ForcingRules {
  // The largest eta. [EW96] has 0.9; stopping rules read -g.p, which has to be about right, too.
  double largest = 0.1;
  // The default of [EW96].
  double part = 0.9;
  // The default of [EW96].
  double safeguarded = 0.1;
};

struct NewtonOptions {
  // The model with its projection and its rules, of which the next three are the parts.
  void set_curvature(const CurvatureChoice& choice) {
    curvature = choice.model;
    projection = choice.projection;
    adaptive = choice.adaptive;
  }
  Curvature curvature = Curvature::Projected;
  // The weight of the projection far from a minimum, in [0, 2], for Curvature::Projected: 0 is the
  // exact Hessian, 1 sets negative eigenvalues to 0, 2 to their absolute values. The last keeps
  // directions short where a projected Hessian is nearly singular. Terms without an exact Hessian
  // project by their own rule; the message of the result names them where this is not 1.
  double projection = 1;
  AdaptiveProjectionRules adaptive = {};
  BlendRules blend = {};
  ShiftRules shifts = {};
  LaggedFactorRules lagged = {};
  ForcingRules forcing = {};
  StoppingRules stopping = {};
  // The barrier phase compares with |E|, which says something of barriers alone.
  LineSearchOptions line_search = {.barrier_decrement = std::numeric_limits<double>::infinity()};
  SolverFactory linear_solver = [] { return make_direct_solver(); };
  // NewtonMinimizer tests where it has converged (SolveResult::definite).
  bool tests_minimum = true;
  // The number of saddles that NewtonMinimizer leaves, along the direction of most negative
  // curvature, where it has converged at one; the result may be a saddle after these. Needs
  // tests_minimum.
  int saddles_to_leave = 0;
  // Motions that the energy does not see, a column each, on the unknowns of the problem: told to
  // the solver before its analysis (LinearSolver::hint_near_null_space()); empty: nothing is.
  std::function<Eigen::MatrixXd(const Problem&)> near_null_space = {};
  // A gauge: holds as many unknowns as near_null_space has columns, each by the mean diagonal that
  // is added to its own, so that the Hessian of what nothing else holds is not singular. Steps are
  // the same but for such motions. Translations of nodes of two unknowns:
  //     options.near_null_space = [](const Problem& problem) -> Eigen::MatrixXd {
  //       return Eigen::Matrix2d::Identity().replicate(problem.size() / 2, 1);
  //     };
  //     options.holds_null_space = true;
  bool holds_null_space = false;
  StopCheck stop = {};  // ends a step between batches of elements, factorizations, trials
};

class NewtonStepper final : public Stepper {
 public:
  // Throws InvalidArgument, as reset() does, when a term does not support the curvature, and for
  // options that are no rules.
  NewtonStepper(const Problem& problem, NewtonOptions options);
  ~NewtonStepper() override;

  // Goes on with another problem; the symbolic factorization stays where the structure is the same.
  // Blends wait until a step has come near this problem's minimum.
  void reset(const Problem& problem);

  // The next step tries the exact Hessian, whatever happened before.
  void polish() override;

  // Costs an exact Hessian and a factorization.
  Definite definite_at(const Vec& y);
  // Moves y down from a saddle, along a direction of negative curvature; energy of y in and out.
  // Returns whether it found a way: y is as it was otherwise.
  bool leave_saddle(Vec& y, double& energy);

 private:
  void advance(Vec& y, double& energy, Step& step) override;
  void require_curvature(const Problem& problem) const;
  void analyze();
  void newton_step(Vec& y, double& energy, Step& step);
  bool lagged_step(Vec& y, double& energy, Step& step);
  bool blends() const;
  bool find_direction(const Vec& y, IterationRecord& record);
  bool solve_blend(const Vec& y, IterationRecord& record);
  bool solve_whole(const Vec& y, IterationRecord& record);
  bool solve_absolute(const Vec& y, IterationRecord& record);
  double first_shift();
  double first_projection() const;
  void learn_shift(Step& step);
  bool no_shift_helps(const Step& step) const;
  FactorStatus solve_shifted(double shift, IterationRecord& record);
  double tolerance() const;
  double mean_diagonal() const;
  void hold_gauge();
  void learn_weight(const Step& step);
  void learn_projection(const Step& step);
  bool tries_exact();
  void learn_exact(const Step& step);
  void raise_weight(double failed);

  NewtonOptions options_;
  std::shared_ptr<LinearSolver> solver_;
  std::vector<Index> gauge_;  // unknowns that are held
  Vec hessian_, p_;
  double last_gradient_norm_ = 0, last_tolerance_ = 0;  // of the step before; 0: there is none
  double relative_decrement_ = std::numeric_limits<double>::infinity();  // of the last step
  double projection_weight_ = 1;                                         // t of the next blend
  int hold_ = 0;                                                         // steps that it stays
  int whole_steps_ = 0;                                                  // to come before it
  int misled_ = 0;                            // short steps without a blend, in a row
  bool is_exact_ = false;                     // the step at hand is one of BlendRules::misled_steps
  bool keeps_exact_ = false;                  // and the next one is another
  int exact_wait_ = 0, next_exact_wait_ = 1;  // steps until it is tried again
  double whole_weight_ = 1;                   // the projection of the next step without a blend
  double shift_ = 0;                          // of the last step without a blend, relative
  double fall_ = 0;                           // the part of it that the next step begins with
  int shift_wait_ = 0, next_wait_ = 0;        // steps until none is tried again
  bool is_raised_ = false;                    // shift_ is what the next step begins with
  bool is_damped_ = false;                    // the step at hand began with a shift
  class LaggedFactor;
  std::unique_ptr<LaggedFactor> lagged_;
};

class NewtonMinimizer final : public Minimizer {
 public:
  explicit NewtonMinimizer(NewtonOptions options = {}) : options_(std::move(options)) {}
  SolveResult minimize(const Problem& problem, Vec y0, RunObserver* observer) const override;

 private:
  NewtonOptions options_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
