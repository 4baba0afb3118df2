#include "majorant/framework/first_order.h"

#include <utility>

#include "majorant/framework/internal/lbfgs_history.h"
#include "majorant/framework/internal/option_check.h"
#include "majorant/framework/internal/preconditioner.h"
#include "majorant/framework/stepper.h"
#include "majorant/framework/stopwatch.h"

namespace majorant {
namespace {

class LbfgsStepper final : public Stepper {
 public:
  LbfgsStepper(const Problem& problem, const LbfgsOptions& options)
      : Stepper(problem, options.line_search, options.stopping.decrement, options.stop),
        preconditioner_(preconditioner_problem(problem, options.metric), options.curvature,
                        make_solver("LbfgsOptions", options.linear_solver)),
        own_preconditioner_(options.metric.has_value()),
        history_(options.history, options.cautious) {
    require_at_least("LbfgsOptions: history", options.history, 0);
  }

 private:
  void advance(Vec& y, double& energy, Step& step) override {
    if (!prepare(y, step.record)) {
      if (own_preconditioner_) step.why_none = preconditioner_.why_none();
      return;
    }
    bool restarted = history_.empty();
    direction_step(y, energy, step);
    while (!restarted && step.outcome != Outcome::Moved && step.outcome != Outcome::AtMinimum) {
      history_.clear();
      restarted = true;
      direction_step(y, energy, step);
    }
  }

  // Prepares preconditioner, gradient and history at y. Returns false if there is no metric.
  bool prepare(const Vec& y, IterationRecord& r) {
    if (!preconditioner_.factorize_once(y, r, stop_)) return false;
    Stopwatch watch;
    evaluator_.gradient(y, gradient_, stop_);
    if (std::exchange(started_, true))
      history_.visit(y, gradient_);
    else
      history_.start(y, gradient_, partition_of(evaluator_.problem()));
    r.seconds.assemble += watch.restart();
    return true;
  }

  void direction_step(Vec& y, double& energy, Step& step) {
    Stopwatch watch;
    Vec p;
    history_.apply([this](const Vec& r, Vec& out) { preconditioner_.solve(r, out); }, -gradient_,
                   p);
    step.record.seconds.solve += watch.restart();
    move_along(p, 1.0, y, energy, step);
  }

  Preconditioner preconditioner_;
  bool own_preconditioner_;  // not that of the problem
  bool started_ = false;
  History history_;
};

class GradientFlowStepper final : public Stepper {
 public:
  GradientFlowStepper(const Problem& problem, const GradientFlowOptions& options)
      : Stepper(problem, options.line_search, options.stopping.decrement, options.stop),
        preconditioner_(preconditioner_problem(problem, options.metric), options.curvature,
                        make_solver("GradientFlowOptions", options.linear_solver)),
        own_preconditioner_(options.metric.has_value()) {}

 private:
  void advance(Vec& y, double& energy, Step& step) override {
    IterationRecord& r = step.record;
    if (!preconditioner_.factorize_once(y, r, stop_)) {
      if (own_preconditioner_) step.why_none = preconditioner_.why_none();
      return;
    }
    Stopwatch watch;
    evaluator_.gradient(y, gradient_, stop_);
    r.seconds.assemble += watch.restart();
    Vec p;
    preconditioner_.solve(-gradient_, p);
    r.seconds.solve = watch.restart();
    move_along(p, first_, y, energy, step);
    if (step.outcome == Outcome::Moved) first_ = r.step;
  }

  Preconditioner preconditioner_;
  bool own_preconditioner_;  // not that of the problem
  double first_ = 1;         // the last step; the metric does not have the energy's scale
};

}  // namespace

SolveResult LbfgsMinimizer::minimize(const Problem& problem, Vec y0, RunObserver* observer) const {
  LbfgsStepper stepper(problem, options_);
  return stepper.minimize(std::move(y0), options_.stopping, observer);
}

SolveResult GradientFlowMinimizer::minimize(const Problem& problem, Vec y0,
                                            RunObserver* observer) const {
  GradientFlowStepper stepper(problem, options_);
  return stepper.minimize(std::move(y0), options_.stopping, observer);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
