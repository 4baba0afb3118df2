#include "apps/compare/race.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "apps/process.h"
#include "apps/progress.h"
#include "majorant/framework/problem.h"

namespace majorant::app {
namespace {

// Every point of a run measured in the same way, whatever the method says of itself. The clock
// stands still while measuring.
class PointMeter final : public RunObserver {
 public:
  PointMeter(const Contest& contest, double time_limit)
      : evaluator_(contest.problem),
        injectivity_(contest.space, 2 * contest.specification.rest->measure),
        vertices_(contest.space, AngleSums::Vertices::Interior),
        time_limit_(time_limit) {}

  void start(const Vec& y) {
    measure(0, 0, 0, y);
    resumed_ = Clock::now();
  }
  Directive after_step(const TraceEntry& row, const Vec& y) override {
    running_ += seconds_since(resumed_);
    measure(row.record.iteration, running_, row.record.step, y);
    resumed_ = Clock::now();
    if (interrupted_->load()) return Directive::Interrupt;
    return running_ > time_limit_ ? Directive::TimeLimit : Directive::Continue;
  }
  // For what happens between two points. Only refers.
  StopCheck stop() const {
    return StopCheck([this] {
      if (interrupted_->load(std::memory_order_relaxed)) return Directive::Interrupt;
      const double now = seconds_since(resumed_);
      return running_ + now > time_limit_ ? Directive::TimeLimit : Directive::Continue;
    });
  }
  std::vector<ComparisonPoint> take_points() { return std::move(points_); }

 private:
  using Clock = std::chrono::steady_clock;
  void measure(int iteration, double seconds, double step, const Vec& y) {
    Vec gradient;
    const Vec x = evaluator_.problem().expand(y);
    const double min_det = injectivity_.lower_bounds(x).minCoeff();
    // A map that is not certified is no result: it must not become the best.
    const bool valid = min_det > 0 && vertices_.check(x).feasible;
    using Limits = std::numeric_limits<double>;
    const double energy = valid ? evaluator_.gradient(y, gradient) : Limits::infinity();
    const double norm = std::isfinite(energy) ? gradient.norm() : Limits::quiet_NaN();
    points_.push_back({iteration, seconds, energy, norm, step, min_det});
  }
  Evaluator evaluator_;
  LocalInjectivity injectivity_;
  AngleSums vertices_;  // methods that certify no paths might wind twice around a vertex
  const std::atomic<bool>* interrupted_ = interruption_flag();
  double time_limit_, running_ = 0;
  Clock::time_point resumed_;
  std::vector<ComparisonPoint> points_;
};

}  // namespace

MethodRun race(const Method& method, const Contest& contest, double time_limit) {
  const Vec y0 = contest.problem.reduce(contest.start);
  PointMeter watch(contest, time_limit);
  Contest timed = contest;
  timed.stop = watch.stop();
  const std::unique_ptr<Minimizer> minimizer = method.make(timed);
  watch.start(y0);
  const SolveResult result = minimizer->minimize(contest.problem, y0, &watch);
  const std::string message = result.status == Status::Converged ? "" : result.message;
  return {method.name, std::string(status_name(result.status)), message, watch.take_points()};
}

void warm_up(const Contest& contest) {
  Contest short_contest = contest;
  short_contest.max_iterations = 2;
  find_method("newton")
      ->make(short_contest)
      ->minimize(contest.problem, contest.problem.reduce(contest.start), {});
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
