// Newton's method with a positive semidefinite curvature model and a feasible line search.
//
//   NewtonMinimizer newton(NewtonOptions{.curvature = Curvature::Projected});
//   SolveResult result = newton.minimize(problem, y0, observer);
//
// Outer loops that change the problem between steps (weights, rules) use NewtonStepper, which
// keeps the symbolic factorization. Not for problems without a sparse Hessian.
#pragma once

#include <limits>
#include <memory>

#include "majorant/framework/evaluator.h"
#include "majorant/framework/linear_solver.h"
#include "majorant/framework/minimizer.h"

namespace majorant {

struct NewtonOptions {
  Curvature curvature = Curvature::Projected;
  // Near a minimum (last -g.p <= exact_below * |E|) the exact Hessian is tried first, where all
  // terms support it and it is positive definite: the tail converges quadratically instead of
  // linearly. 0 switches this off.
  double exact_below = 1e-4;
  StoppingRules stopping;
  double armijo = 1e-4;            // accept s when E(s) <= E(0) + armijo * s * g.p
  double boundary_fraction = 0.9;  // of the largest certified step is used, when that is the limit
  double largest_growth = 4;       // of the step per trial, while the energy asks for more
  double smallest_step = 1e-14;    // give up below
  std::function<std::unique_ptr<LinearSolver>()> linear_solver = [] {
    return make_cholmod_solver();
  };
};

class NewtonStepper {
 public:
  NewtonStepper(const Problem& problem, NewtonOptions options);

  // Goes on with another state of the same structure; the symbolic factorization stays.
  void reset(const Problem& problem);

  enum class Outcome {
    Moved,
    AtMinimum,   // decrement rule, or no unknowns: y unchanged
    Blocked,     // the largest certified step is below smallest_step: y unchanged
    NoDecrease,  // no decrease down to smallest_step: y unchanged
    Breakdown,   // no factorization or no finite direction: y unchanged
  };
  struct Step {
    Outcome outcome = Outcome::Breakdown;
    IterationRecord record;
    std::vector<Index> blocking;  // elements that admit no more than record.step_bound
  };
  // One Newton step from y, which must be feasible; energy of y in, energy of the new y out.
  Step step(Vec& y, double& energy);

  // Lets the next step try the exact Hessian, whatever happened before.
  void retry_exact();

  Evaluator& evaluator() { return evaluator_; }
  const LinearSolver& linear_solver() const { return *solver_; }

 private:
  bool try_exact(const Vec& y, IterationRecord& record);
  void pause_exact();
  bool factorize(const Vec& y, IterationRecord& record);
  class LineSearch;

  NewtonOptions options_;
  Evaluator evaluator_;
  std::unique_ptr<LinearSolver> solver_;
  Vec gradient_, hessian_, rhs_;
  double relative_decrement_ = std::numeric_limits<double>::infinity();  // of the last step
  int exact_pause_ = 0, exact_failures_ = 0;  // after a failure wait, longer each time
};

// Steps until a stopping rule or the observer says so. y0 must be feasible for the stepper's
// problem; outer loops that change the state of the problem call this repeatedly.
SolveResult run(NewtonStepper& stepper, Vec y0, const StoppingRules& rules,
                const Observer& observer);

class NewtonMinimizer final : public Minimizer {
 public:
  explicit NewtonMinimizer(NewtonOptions options = {}) : options_(std::move(options)) {}
  SolveResult minimize(const Problem& problem, Vec y0, const Observer& observer) const override;

 private:
  NewtonOptions options_;
};

}  // namespace majorant
