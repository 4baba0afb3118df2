#include "majorant/framework/stepper.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace majorant {

double relative_to(double energy, double value) {
  return value / std::max(std::abs(energy), std::numeric_limits<double>::min());
}

Stepper::Step Stepper::step(Vec& y, double& energy) {
  Step step;
  step.record.energy = energy;
  if (y.size() == 0) {
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

void Stepper::descend(const Vec& p, double first, Vec& y, double& energy, Step& step) {
  IterationRecord& r = step.record;
  step.outcome = Outcome::Breakdown;
  r.gradient_norm = gradient_.norm();
  r.newton_decrement = -gradient_.dot(p);
  if (!p.allFinite() || !(r.newton_decrement >= 0)) return;
  if (relative_to(energy, r.newton_decrement) <= decrement_rule_) {
    step.outcome = Outcome::AtMinimum;
    return;
  }
  Lap lap;
  LineSearch search(evaluator_, line_search_, y, p, energy, r.newton_decrement, stop_);
  const LineSearch::Result result = search.find(first);
  r.step_bound = search.bound().step;
  step.blocking = search.bound().blocking;
  r.trials += search.trials();
  if (result == LineSearch::Result::Accepted) {
    step.outcome = Outcome::Moved;
    r.step = search.step();
    r.relative_decrease = relative_to(energy, energy - search.energy());
    r.energy = energy = search.energy();
    y += r.step * p;
  } else {
    step.outcome = result == LineSearch::Result::Blocked ? Outcome::Blocked : Outcome::NoDecrease;
  }
  r.seconds.line_search += lap();
}

bool check_start(Evaluator& evaluator, SolveResult& result) {
  result.status = Status::Infeasible;
  const Problem& problem = evaluator.problem();
  const Vec x = problem.expand(result.y);
  for (const auto& checker : problem.checkers())
    if (Verdict verdict = checker->check(x); !verdict.feasible) {
      result.blocking = std::move(verdict.blocking);
      result.message = std::string("the start violates ") + std::string(checker->name());
      return false;
    }
  result.energy = evaluator.value(result.y);
  if (std::isfinite(result.energy)) return true;
  result.message = "the start lies outside the energy's domain";
  return false;
}

SolveResult run(Stepper& stepper, Vec y0, const StoppingRules& rules, const Observer& observer) {
  SolveResult result;
  result.y = std::move(y0);
  const auto finish = [&](Status status, std::string message) {
    result.status = status;
    result.message = std::move(message);
    return result;
  };
  if (!check_start(stepper.evaluator(), result)) return result;

  // An energy that vanishes at its minimum has no relative scale there.
  const double smallest_scale = 1e-14 * std::abs(result.energy);
  int idle = 0;
  bool polished = false;
  Vec anchor = result.y;  // last point from which a good part of the step was possible
  double anchor_energy = result.energy;
  for (int k = 1; k <= rules.max_iterations; ++k) {
    const double scale = std::max(std::abs(result.energy), smallest_scale);
    Stepper::Step step = stepper.step(result.y, result.energy);
    if (step.outcome == Stepper::Outcome::Stopped)
      return finish(stopped_status(step.why), Stopped(step.why).what());
    step.record.iteration = k;
    result.newton_decrement = step.record.newton_decrement;
    result.blocking = std::move(step.blocking);
    using Outcome = Stepper::Outcome;
    const bool near = result.newton_decrement <= rules.stall_decrement * scale;
    if (step.outcome == Outcome::Breakdown) return finish(Status::Failed, "no finite direction");
    if (step.outcome == Outcome::AtMinimum) return finish(Status::Converged, "decrement");
    if (step.outcome != Outcome::Moved)
      return finish(near ? Status::Converged : Status::Stalled, "no further decrease");
    result.iterations.push_back(step.record);
    const Directive directive = observer ? observer(step.record, result.y) : Directive::Continue;
    const bool small_decrease = step.record.relative_decrease <= rules.relative_decrease;
    const bool exact = step.record.curvature == Curvature::Exact;
    if (small_decrease && !exact &&
        result.newton_decrement <= rules.tail_factor * rules.relative_decrease * scale) {
      if (polished) return finish(Status::Converged, "relative decrease");
      stepper.polish();
      polished = true;
    }
    idle = small_decrease || step.record.step_bound < rules.stall_step ? idle + 1 : 0;
    if (idle >= rules.stall_iterations) {
      if (near) return finish(Status::Converged, "relative decrease");
      result.y = anchor;
      result.energy = anchor_energy;
      return finish(Status::Stalled, "held at the limit of the feasible set");
    }
    if (idle == 0 && step.record.step_bound >= rules.anchor_step) {
      anchor = result.y;
      anchor_energy = result.energy;
    }
    if (directive != Directive::Continue)
      return finish(stopped_status(directive), Stopped(directive).what());
  }
  return finish(Status::MaxIterations, "iteration limit");
}

}  // namespace majorant
