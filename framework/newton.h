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

#include "majorant/framework/linear_solver.h"
#include "majorant/framework/stepper.h"

namespace majorant {

struct NewtonOptions {
  Curvature curvature = Curvature::Projected;
  // Near a minimum (last -g.p <= exact_below * |E|) the exact Hessian is tried first, where all
  // terms support it and it is positive definite: the tail converges quadratically instead of
  // linearly. 0 switches this off. Origin: bench/tune.py exact_below.
  double exact_below = 1e-4;
  StoppingRules stopping;
  LineSearchOptions line_search;
  std::function<std::unique_ptr<LinearSolver>()> linear_solver = [] {
    return make_direct_solver();
  };
  StopCheck stop;  // ends a step between chunks of elements, factorizations, trials
};

class NewtonStepper final : public Stepper {
 public:
  // Throws std::invalid_argument, as reset() does, when a term does not support the curvature.
  NewtonStepper(const Problem& problem, NewtonOptions options);

  // Goes on with another problem; the symbolic factorization stays where the structure is the same.
  // The exact Hessian waits until a step has come near this problem's minimum.
  void reset(const Problem& problem);

  // The next step tries the exact Hessian, whatever happened before.
  void polish() override { exact_pause_ = 0; }

 private:
  void advance(Vec& y, double& energy, Step& step) override;
  void require_curvature(const Problem& problem) const;
  bool try_exact(const Vec& y, IterationRecord& record);
  void pause_exact();
  bool factorize(const Vec& y, IterationRecord& record);

  NewtonOptions options_;
  std::unique_ptr<LinearSolver> solver_;
  Vec hessian_, rhs_;
  double relative_decrement_ = std::numeric_limits<double>::infinity();  // of the last step
  int exact_pause_ = 0, exact_failures_ = 0;  // after a failure wait, longer each time
};

class NewtonMinimizer final : public Minimizer {
 public:
  explicit NewtonMinimizer(NewtonOptions options = {}) : options_(std::move(options)) {}
  SolveResult minimize(const Problem& problem, Vec y0, const Observer& observer) const override;

 private:
  NewtonOptions options_;
};

}  // namespace majorant
