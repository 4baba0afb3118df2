#include "majorant/framework/levenberg_marquardt.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/framework/internal/option_check.h"
#include "majorant/framework/partition.h"
#include "majorant/framework/problem_parts.h"
#include "majorant/framework/stopwatch.h"

namespace majorant {
namespace {

// Returns options that only shorten a step: none goes beyond 1.
LineSearchOptions shortening() {
  LineSearchOptions options;
  options.most_improvements = 0;
  return options;
}

class DampedStepper final : public Stepper {
 public:
  DampedStepper(const Problem& problem, const LevenbergMarquardtOptions& options)
      : Stepper(problem, shortening(), options.stopping.decrement, options.stop),
        curvature_(options.curvature),
        rules_(options.damping),
        solver_(make_solver("LevenbergMarquardtOptions", options.linear_solver)),
        decrement_(options.stopping.decrement),
        lambda_(options.damping.first) {
    require_curvature("LevenbergMarquardt", problem, curvature_);
    require_in("LevenbergMarquardtOptions: damping.least", rules_.least, 0, 1);
    if (!(0 < rules_.smallest && rules_.smallest <= rules_.first &&
          rules_.first <= rules_.largest && std::isfinite(rules_.largest)))
      throw InvalidArgument(
          "LevenbergMarquardtOptions: damping needs 0 < smallest <= first <= largest");
    if (!partition_of(problem).is_whole())
      throw InvalidArgument(
          "LevenbergMarquardt: the problem is that of several processes, it knows one");
    solver_->analyze(problem.pattern());
  }

 private:
  void advance(Vec& y, double& energy, Step& step) override {
    IterationRecord& r = step.record;
    step.outcome = Outcome::Breakdown;
    Stopwatch watch;
    evaluator_.linearize(y, curvature_, gradient_, hessian_, stop_);
    r.curvature = curvature_;
    r.seconds.assemble += watch.restart();
    if (!gradient_.allFinite()) return;
    set_diagonal();
    while (solve_damped(r)) {
      const double before = energy;
      move_along(p_, 1.0, y, energy, step);
      // -g.p falls as damping rises, however far the minimum is. The factor undoes that.
      r.newton_decrement *= 1 + lambda_;
      if (step.outcome == Outcome::AtMinimum) {
        if (relative_decrement(before, r) > decrement_) step.outcome = Outcome::NoDecrease;
        return;
      }
      if (step.outcome == Outcome::Moved) {
        learn((before - energy) / promised(), r.step);
        return;
      }
      if (step.outcome == Outcome::Breakdown || !raise()) return;
    }
  }

  void set_diagonal() {
    const SparsePattern& pattern = evaluator_.problem().pattern();
    diagonal_.resize(pattern.size);
    for (Index c = 0; c < pattern.size; ++c)
      diagonal_[c] = std::max(0.0, hessian_[pattern.diagonal_slot(c)]);
    const double largest = diagonal_.maxCoeff();
    diagonal_ = diagonal_.cwiseMax(largest > 0 ? rules_.least * largest : 1.0);
  }

  // Computes p for the smallest lambda, from the present one on, that makes the matrix definite.
  // Returns false if there is none.
  bool solve_damped(IterationRecord& r) {
    const SparsePattern& pattern = evaluator_.problem().pattern();
    do {
      stop_.poll();
      damped_ = hessian_;
      for (Index c = 0; c < pattern.size; ++c)
        damped_[pattern.diagonal_slot(c)] += lambda_ * diagonal_[c];
      r.shift = lambda_;
      Stopwatch watch;
      const FactorStatus status = solver_->factorize_until(stop_, damped_, 0);
      ++r.factorizations;
      r.seconds.factorize += watch.restart();
      if (status == FactorStatus::Ok) {
        const Solution solution = solver_->solve(-gradient_, p_);
        r.seconds.solve += watch.restart();
        r.residual = solution.residual;
        if (solution.status != SolveStatus::Indefinite && p_.allFinite()) return true;
      }
      ++r.failed_factorizations;
    } while (raise());
    return false;
  }

  // Returns the decrease of the model along p: (-g.p + lambda p.D p) / 2.
  double promised() const {
    return 0.5 * (-gradient_.dot(p_) + lambda_ * p_.dot(diagonal_.cwiseProduct(p_)));
  }

  // Updates lambda by [Nie99, Eq. 2.5].
  void learn(double gain, double taken) {
    if (!(gain > 0) || taken < 1) {
      raise();
      return;
    }
    const double g = 2 * gain - 1;
    lambda_ =
        std::clamp(lambda_ * std::max(1.0 / 3, 1 - g * g * g), rules_.smallest, rules_.largest);
    growth_ = kFirstGrowth;
  }
  bool raise() {
    if (lambda_ >= rules_.largest) return false;
    lambda_ = std::min(rules_.largest, lambda_ * growth_);
    growth_ *= kFirstGrowth;
    return true;
  }

  // [Nie99, Eq. 2.5]: consecutive failures double the factor.
  static constexpr double kFirstGrowth = 2;

  Curvature curvature_;
  DampingRules rules_;
  std::shared_ptr<LinearSolver> solver_;
  Vec hessian_, damped_, diagonal_, p_;
  double decrement_;  // of a minimum, relative
  double lambda_;
  double growth_ = kFirstGrowth;  // the next factor of lambda
};

}  // namespace

SolveResult LevenbergMarquardtMinimizer::minimize(const Problem& problem, Vec y0,
                                                  RunObserver* observer) const {
  DampedStepper stepper(problem, options_);
  return stepper.minimize(std::move(y0), options_.stopping, observer);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
