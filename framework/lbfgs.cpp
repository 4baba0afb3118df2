#include "majorant/framework/lbfgs.h"

#include <utility>

#include "majorant/framework/internal/lbfgs_history.h"
#include "majorant/framework/internal/metric.h"
#include "majorant/framework/internal/stopwatch.h"
#include "majorant/framework/stepper.h"

namespace majorant {
namespace {

class LbfgsStepper final : public Stepper {
 public:
  LbfgsStepper(const Problem& problem, const LbfgsOptions& options)
      : Stepper(problem, options.line_search, options.stopping.decrement, options.stop),
        metric_(metric_problem(problem, options.metric), options.curvature,
                options.linear_solver()),
        metric_every_(options.metric_every),
        history_(options.history, options.cautious) {}

 private:
  void advance(Vec& y, double& energy, Step& step) override {
    if (!prepare(y, step.record)) return;
    bool restarted = history_.empty();
    direction_step(y, energy, step);
    while (!restarted && step.outcome != Outcome::Moved && step.outcome != Outcome::AtMinimum) {
      history_.clear();
      restarted = true;
      direction_step(y, energy, step);
    }
  }

  // Metric, gradient and history at y; false: no metric.
  bool prepare(const Vec& y, IterationRecord& r) {
    const bool due = metric_every_ > 0 && age_ == metric_every_;
    if (!factorized_ || due) {
      factorized_ = metric_.factorize(y, stop_);
      history_.clear();
      age_ = 0;
      r.seconds.assemble = metric_.seconds().assemble;
      r.seconds.factorize = metric_.seconds().factorize;
      r.factorizations = metric_.factorizations();
      r.failed_factorizations = metric_.failed_factorizations();
    }
    r.curvature = metric_.curvature();
    r.shift = metric_.shift();
    if (!factorized_) return false;
    Stopwatch watch;
    evaluator_.gradient(y, gradient_, stop_);
    if (age_ > 0) history_.add(y - last_y_, gradient_ - last_gradient_);
    last_y_ = y;
    last_gradient_ = gradient_;
    ++age_;
    r.seconds.assemble += watch.restart();
    return true;
  }

  void direction_step(Vec& y, double& energy, Step& step) {
    Stopwatch watch;
    Vec p;
    history_.apply([this](const Vec& r, Vec& out) { metric_.solve(r, out); }, -gradient_, p);
    step.record.seconds.solve += watch.restart();
    move_along(p, 1.0, y, energy, step);
  }

  Metric metric_;
  int metric_every_;
  bool factorized_ = false;
  int age_ = 0;  // steps since the last factorization
  History history_;
  Vec last_y_, last_gradient_;
};

}  // namespace

SolveResult LbfgsMinimizer::minimize(const Problem& problem, Vec y0,
                                     const Observer& observer) const {
  LbfgsStepper stepper(problem, options_);
  return stepper.minimize(std::move(y0), options_.stopping, observer);
}

}  // namespace majorant
