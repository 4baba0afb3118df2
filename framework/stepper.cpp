#include "majorant/framework/stepper.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/internal/diagnosis.h"
#include "majorant/framework/internal/option_check.h"
#include "majorant/framework/partition.h"
#include "majorant/framework/stopwatch.h"

namespace majorant {
namespace {

class Observed final : public Descent {
 public:
  explicit Observed(RunObserver* observer) : observer_(observer) {}
  Answer after_step(const StepResult& step) override {
    Descent::after_step(step);
    if (step.outcome != StepResult::Outcome::Moved) return {};
    return {observed(observer_, step.record, result.y)};
  }

 private:
  RunObserver* observer_;
};

// An energy counts as falling without end if unknowns grow by this factor: those of the start are
// then lost in rounding.
constexpr double kUnboundedGrowth = 1e16;

// Names the checker, the blocking elements, and the violation in the checker's own measure.
std::string why_violated(const FeasibilityChecker& checker, double margin,
                         const std::vector<Index>& blocking) {
  std::string text = fmt::format("the start violates {}", checker.name());
  if (blocking.size() == 1) text += fmt::format(" at element {}", blocking.front());
  if (blocking.size() > 1)
    text += fmt::format(" at element {} and {} more", blocking.front(), blocking.size() - 1);
  if (margin < 0) text += fmt::format(", by {:.3g}", -margin);
  return text + "; start where it holds";
}

}  // namespace

Descent::Answer Descent::after_step(const StepResult&) {
  result.energy = energy;
  return {};
}

void Descent::set_fallback() {
  fallback_ = result.y;
  fallback_energy_ = result.energy;
}

void Descent::return_to_fallback() {
  result.y = fallback_;
  result.energy = fallback_energy_;
}

Stepper::Stepper(const Problem& problem, const LineSearchOptions& line_search,
                 double decrement_rule, StopCheck stop)
    : evaluator_(problem),
      stop_(std::move(stop)),
      line_search_(line_search),
      decrement_rule_(decrement_rule) {
  require_valid(line_search_);
  if (const Partition& partition = partition_of(evaluator_.problem());
      partition.ranks().count() > 1 && partition.any(stop_.may_stop()))
    throw InvalidArgument(
        "the stop check of a solver may stop one of several processes and leave the others "
        "waiting; let the observer of rank 0 say when to stop");
}

Stepper::Step Stepper::step(Vec& y, double& energy) {
  require_size("Stepper::step: y", y.size(), evaluator_.problem().size());
  Step step;
  step.record.energy = step.energy_before = energy;
  if (partition_of(evaluator_.problem()).global_size() == 0) {
    step.outcome = Outcome::AtMinimum;
    return step;
  }
  try {
    advance(y, energy, step);
  } catch (const Stopped& stopped) {
    step.outcome = Outcome::Stopped;
    step.why = stopped.why();
    step.blocking.clear();
  }
  return step;
}

double Stepper::relative_decrement(double energy, const IterationRecord& step) const {
  return relative_to(test_ ? test_->scale(energy, step) : energy, step.newton_decrement);
}

void Stepper::move_along(const Vec& p, double first, Vec& y, double& energy, Step& step) {
  IterationRecord& r = step.record;
  step.outcome = Outcome::Breakdown;
  const Partition& partition = partition_of(evaluator_.problem());
  r.gradient_norm = partition.norm(gradient_);
  r.newton_decrement = -partition.dot(gradient_, p);
  if (!partition.all_finite(p) || !(r.newton_decrement >= 0)) return;
  r.direction_norm = partition.norm(p);
  r.distance = distance_;
  if (r.gradient_norm > 0 && r.direction_norm == 0 && p.size() > 0) {
    step.why_none = "the linear solver answers 0, and the gradient is not 0";
    return;
  }
  if (relative_decrement(energy, r) <= decrement_rule_) {
    step.outcome = Outcome::AtMinimum;
    return;
  }
  Stopwatch watch;
  LineSearch search(evaluator_, line_search_, y, p, energy, r.newton_decrement, stop_);
  const LineSearch::Result result = search.find(first);
  r.step_bound = search.bound().step;
  step.blocking = search.bound().blocking;
  r.limit = search.limit();
  r.trials += search.trials();
  if (result == LineSearch::Result::Accepted) {
    step.outcome = Outcome::Moved;
    r.step = search.step();
    const double smallest = test_ ? test_->smallest_scale() : 0;
    r.relative_decrease =
        relative_to(std::max(std::abs(energy), smallest), energy - search.energy());
    r.energy = energy = search.energy();
    y += r.step * p;
  } else {
    step.outcome = result == LineSearch::Result::Blocked ? Outcome::Blocked : Outcome::NoDecrease;
  }
  r.seconds.line_search += watch.restart();
}

bool check_start(Evaluator& evaluator, SolveResult& result) {
  result.status = Status::Infeasible;
  const Problem& problem = evaluator.problem();
  require_size("the start y", result.y.size(), problem.size());
  require_finite("the start y", result.y);
  if (problem.terms().empty())
    throw InvalidArgument("the problem has no terms, nothing to minimize");
  const Vec x = problem.expand(result.y);
  if (auto violation = evaluator.violation(x)) {
    result.blocking = std::move(violation->verdict.blocking);
    result.energy = std::numeric_limits<double>::quiet_NaN();
    result.message = why_violated(*violation->checker, violation->verdict.margin, result.blocking);
    return false;
  }
  result.energy = evaluator.value(result.y);
  if (std::isfinite(result.energy)) return true;
  result.message = "the start lies outside the energy's domain: " + why_not_finite(problem, x);
  return false;
}

SolveResult Stepper::minimize(Vec y0, const StoppingRules& rules, RunObserver* observer) {
  SolveResult result;
  result.y = std::move(y0);
  if (!check_start(evaluator_, result)) return result;
  return descend_from(std::move(result.y), result.energy, rules, observer);
}

SolveResult Stepper::descend_from(Vec y, double energy, const StoppingRules& rules,
                                  RunObserver* observer) {
  require_size("the start y", y.size(), evaluator_.problem().size());
  Observed descent(observer);
  descent.result.y = std::move(y);
  descent.result.energy = descent.energy = energy;
  descend(descent, rules);
  return std::move(descent.result);
}

void Stepper::descend(Descent& descent, const StoppingRules& rules) {
  SolveResult& result = descent.result;
  StoppingTest test(rules, descent.energy);
  descent.set_fallback();
  struct Applied {
    Stepper& stepper;
    ~Applied() { stepper.test_ = nullptr; }
  } const applied{*this};
  test_ = &test;
  distance_ = 0;
  // Returns the partition of the current problem, which after_step() may change.
  const auto partition = [this]() -> const Partition& {
    return partition_of(evaluator_.problem());
  };
  const Vec start = rules.scale == EnergyScale::Decrease ? result.y : Vec();
  double size = partition().norm(result.y);
  std::optional<Stop> stop;
  while (!(stop = test.before_step())) {
    Step step = this->step(result.y, descent.energy);
    Descent::Answer answer;
    if (step.outcome != Outcome::Stopped) {
      result.newton_decrement = step.record.newton_decrement;
      result.blocking = step.blocking;
      if (step.outcome == Outcome::Moved) {
        step.record.iteration = static_cast<int>(result.iterations.size()) + 1;
        result.iterations.push_back(step.record);
        if (rules.scale == EnergyScale::Decrease &&
            partition().all(start.size() == result.y.size()))
          distance_ = partition().norm(result.y - start);
        const double now = partition().norm(result.y);
        if (result.iterations.size() == 1) size = std::max(size, now);
        if (now > kUnboundedGrowth * size) {
          descent.after_step(step);
          stop = Stop{Status::Failed, falls_without_end(step.record.energy, now)};
          break;
        }
      }
      answer = descent.after_step(step);
      answer.directive = partition().of_first(answer.directive);
    }
    if (step.outcome == Outcome::Breakdown && step.why_none.empty())
      step.why_none = why_no_direction(evaluator_, result.y, descent.energy, step.record.curvature);
    const Advice advice = test.after(step, answer.since);
    if ((stop = advice.stop)) break;
    if (advice.polish) polish();
    if (advice.fallback) descent.set_fallback();
    if (answer.directive != Directive::Continue) {
      stop = Stop{stopped_status(answer.directive), Stopped(answer.directive).what()};
      break;
    }
  }
  if (stop->at_fallback) descent.return_to_fallback();
  result.status = stop->status;
  result.message = std::move(stop->message);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
