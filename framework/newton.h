// Newton's method with a positive semidefinite curvature model and a feasible line search.
//
//   NewtonMinimizer newton(NewtonOptions{.curvature = Curvature::Projected});
//   SolveResult result = newton.minimize(problem, y0, observer);
//
// Outer loops that change the problem use NewtonStepper, which keeps the symbolic factorization. It
// is one class, since all rules of a step read what the last steps did. Needs a sparse Hessian.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "majorant/framework/curvature_choice.h"
#include "majorant/framework/linear_solver.h"
#include "majorant/framework/stepper.h"

namespace majorant {

// Near a minimum, steps with the projected Hessian converge linearly, because it overestimates
// curvature. The exact Hessian converges quadratically, but becomes positive definite late. A blend
// is in between, if all terms support both models:
//     H = H_exact + t (H_projected - H_exact)                                    (curvature.h)
// t is 1 far from a minimum. It falls by a factor with every successful step, and rises when the
// factorization fails or the Hessian misleads.
struct BlendRules {
  // t < 1 if the last -g.p was less than this part of |E|; 0: never. Tuned by bench/tune.py
  // blend.below.
  double below = 1e-3;
  // The factor of t after a successful step. Tuned by bench/tune.py blend.fall.
  double fall = 0.2;
  // A smaller t becomes 0, the exact Hessian. Tuned by bench/tune.py blend.least.
  double least = 0.06;
  // The number of steps for which t stays after a failure raised it. Tuned by bench/tune.py
  // blend.hold.
  int hold = 2;
  // A step shorter than this is followed by `whole_steps` steps with t = 1. Tuned by bench/tune.py
  // blend.short_step, blend.whole_steps.
  double short_step = 0.26;
  int whole_steps = 2;
  // After this many consecutive short steps with t = 1, the exact Hessian is tried at once,
  // wherever the run is, and kept as long as its steps are not short; 0: never. An example is a
  // Gauss-Newton model with residuals that do not vanish, which can be nearly singular where the
  // exact Hessian is not.
  int misled_steps = 3;
  // A shift of H as a function of y and its gradient, times 1 - t, such as rotation_shift(); empty:
  // none.
  std::function<double(const Vec& y, const Vec& gradient, const Partition&)> shift = {};
};

// Returns a shift for energies that are invariant under rotations about the origin. Away from a
// minimum their exact Hessian has the negative curvature y.g / |y|^2 along rotations (differentiate
// the gradient along a rotation). The shift is 1.5 times that, and 0 at a minimum.
double rotation_shift(const Vec& y, const Vec& gradient, const Partition& partition);

// Shifts of a Hessian that is not positive definite, or so nearly singular that its direction is
// much too long [NW06, 3.4]. Shifts are relative to the mean of |H_ii|.
struct ShiftRules {
  // The first shift above 0; further shifts grow by 10. The direction of a singular Hessian has a
  // relative error of rounding divided by the shift, 1e-7 here.
  double least = 1e-9;
  // If a step is shorter than this part of its direction, the next one has a larger shift: by the
  // factor that was missing, at least 10. 0: never.
  double short_step = 1e-3;
  // This part applies to a step that was shortened because the energy falls too little. If such a
  // step is shorter than half of its direction, the shift stays.
  double cut_step = 0.1;
  // The part of the last shift with which a step begins; its square if the step before needed no
  // larger shift, and so on. 0: a step begins without a shift.
  double fall = 1.0 / 3;
  // The number of steps that begin with `least` after a factorization without a shift failed; it
  // doubles with each such failure.
  int wait = 4;
};

// Steps on a lagged factor: a step may use the last factor as the metric of L-BFGS instead of a new
// factorization. Such a step costs a solve, a gradient and a line search. It pays near a minimum
// that Newton's method would reach in many steps. The start is then already close: levels of a
// multiresolution start, a map that has changed a little. Far from a minimum it wastes steps.
struct LaggedFactorRules {
  // A factor is kept if -g.p of its own step was less than this part of |E|; 0: never. Tuned by
  // bench/tune.py lagged.below.
  double below = 0;
  // The number of pairs that L-BFGS keeps. Tuned by bench/tune.py lagged.history.
  int history = 8;
  // The number of further steps with one factor; more save little at any degree.
  int steps = 5;
  // A step shorter than this is followed by a factorization.
  double short_step = 0.05;
};

// The accuracy with which H p = -g is solved, for solvers that can save time by it
// (LinearSolver::solve):
//     |H p + g| <= eta |g|,  eta = min(largest, max(part (|g_k| / |g_k-1|)^2, safeguard)),
//     safeguard = part eta_k-1^2 where that is above safeguarded, else 0
// This keeps the convergence quadratic: [EW96], choice 2. Direct solvers ignore it.
struct ForcingRules {
  // The largest eta. [EW96] uses 0.9; it is smaller here, since stopping rules use -g.p.
  double largest = 0.1;
  // The default of [EW96].
  double part = 0.9;
  // The default of [EW96].
  double safeguarded = 0.1;
};

struct NewtonOptions {
  // Sets curvature, projection and adaptive, the next three members.
  void set_curvature(const CurvatureChoice& choice) {
    curvature = choice.model;
    projection = choice.projection;
    adaptive = choice.adaptive;
  }
  Curvature curvature = Curvature::Projected;
  // The weight of the projection far from a minimum, in [0, 2], for Curvature::Projected: 0 is the
  // exact Hessian, 1 sets negative eigenvalues to 0, and 2 to their absolute values. 2 keeps
  // directions short where a projected Hessian is nearly singular. Terms without an exact Hessian
  // project by their own rule; if the weight is not 1, the message of the result names them.
  double projection = 1;
  AdaptiveProjectionRules adaptive = {};
  BlendRules blend = {};
  ShiftRules shifts = {};
  LaggedFactorRules lagged = {};
  ForcingRules forcing = {};
  StoppingRules stopping = {};
  // No barrier phase: it compares with |E|, whose value means nothing for most energies.
  LineSearchOptions line_search = {.barrier_decrement = std::numeric_limits<double>::infinity()};
  SolverFactory linear_solver = [] { return make_direct_solver(); };
  // NewtonMinimizer tests the point where it converged (SolveResult::definite).
  bool tests_minimum = true;
  // The number of saddles that NewtonMinimizer leaves, along the direction of most negative
  // curvature, when it has converged at one. After these, the result may be a saddle. Needs
  // tests_minimum.
  int saddles_to_leave = 0;
  // The motions that do not change the energy, one a column, on the unknowns of the problem. The
  // solver receives them before its analysis (LinearSolver::hint_near_null_space()). Empty: none.
  std::function<Eigen::MatrixXd(const Problem&)> near_null_space = {};
  // A gauge: holds as many unknowns as near_null_space has columns, by adding the mean diagonal to
  // the diagonal entry of each. A Hessian that only these motions make singular is then regular.
  // Steps change only by such motions. For translations of nodes with two unknowns:
  //     options.near_null_space = [](const Problem& problem) -> Eigen::MatrixXd {
  //       return Eigen::Matrix2d::Identity().replicate(problem.size() / 2, 1);
  //     };
  //     options.holds_null_space = true;
  bool holds_null_space = false;
  StopCheck stop = {};  // ends a step between batches of elements, factorizations, trials
};

class NewtonStepper final : public Stepper {
 public:
  // Throws InvalidArgument, as reset() does, if a term does not support the curvature, and for
  // options out of range.
  NewtonStepper(const Problem& problem, NewtonOptions options);
  ~NewtonStepper() override;

  // Continues with another problem; the symbolic factorization is kept if the structure is the
  // same. Blends wait until a step has come near the minimum of this problem.
  void reset(const Problem& problem);

  // Makes the next step try the exact Hessian, whatever happened before.
  void polish() override;

  // Tests y with an exact Hessian and a factorization.
  Definite definite_at(const Vec& y);
  // Moves y down from a saddle, along a direction of negative curvature, and updates its energy.
  // Returns false, with y unchanged, if no lower point was found.
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
  int hold_ = 0;                                                         // steps for which t stays
  int whole_steps_ = 0;                                                  // steps before the next
                                                                         // blend
  int misled_ = 0;                            // consecutive short steps without a blend
  bool is_exact_ = false;                     // the present step is one of BlendRules::misled_steps
  bool keeps_exact_ = false;                  // the next step is another one
  int exact_wait_ = 0, next_exact_wait_ = 1;  // steps until the exact Hessian is tried again
  double whole_weight_ = 1;                   // the projection of the next step without a blend
  double shift_ = 0;                          // of the last step without a blend, relative
  double fall_ = 0;                           // the part of it with which the next step begins
  int shift_wait_ = 0, next_wait_ = 0;        // steps until a step without a shift is tried again
  bool is_raised_ = false;                    // the next step begins with shift_
  bool is_damped_ = false;                    // the present step began with a shift
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
