#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "majorant/framework/internal/diagnosis.h"
#include "majorant/framework/internal/option_check.h"
#include "majorant/framework/line_search.h"
#include "majorant/framework/minimizer.h"

namespace majorant {
namespace {

// The smallest scale of an energy, relative to the energies of the last points: about the rounding
// of terms of that size, 100 unit roundoffs. Only the last points count, so that a start near a
// pole of the energy does not count for long.
constexpr double kSmallestScale = 1e-14;
constexpr std::size_t kScaleWindow = 10;
// The scale of the permitted rest, as a part of the gain of the run: starts are often far above the
// minimum. Tuned by bench/newton_suite.
constexpr double kGainPart = 1e-2;
// A step gains at least this part of -g.p, unless the energy is rounding; a quadratic gains half of
// it.
constexpr double kVisible = 0.1;
// A promised decrease below this part of the smallest scale is less than a roundoff of the terms:
// the step is the last.
constexpr double kRoundoff = 0.01;
// An energy below minus this multiple of max(1, |E_0|) has no minimum. Terms of an energy with a
// minimum do not cancel to that extent; the squares of larger numbers exceed the range of doubles.
constexpr double kUnbounded = 1e100;

// The message of a run that ends near a minimum although its last step promised more.
std::string near_minimum_at(StepLimit limit) {
  return limit == StepLimit::Checker ? "near a minimum, held at the limit of the feasible set"
                                     : "no further decrease";
}

// The message of a run that ends far from a minimum.
std::string stalled_at(StepLimit limit) {
  if (limit == StepLimit::Checker) return "held at the limit of the feasible set";
  if (limit == StepLimit::Domain) return "held at the limit of the energy's domain";
  return "the energy does not fall as its derivatives promise: it is not smooth there, they are "
         "wrong, or its Hessian is nearly singular";
}

// Returns the stop after a step that did not move. held: the stop if only the line search failed.
Stop no_step(const StepResult& step, const Stop& held) {
  using Outcome = StepResult::Outcome;
  if (step.outcome == Outcome::Stopped) return {stopped_status(step.why), Stopped(step.why).what()};
  if (step.outcome == Outcome::Breakdown)
    return {Status::Failed, step.why_none.empty() ? "no finite direction" : step.why_none};
  if (step.outcome == Outcome::AtMinimum) return {Status::Converged, "decrement"};
  return held;
}

}  // namespace

std::string_view definite_name(Definite definite) {
  switch (definite) {
    case Definite::Yes:
      return "yes";
    case Definite::No:
      return "no";
    case Definite::NotTested:
      break;
  }
  return "not tested";
}

StoppingRules first_order_rules() {
  StoppingRules rules;
  rules.scale = EnergyScale::Value;
  rules.second_chances = 0;
  // Below LineSearch::kResolution, so that only steps without a gain count.
  rules.relative_decrease = 1e-14;
  rules.plateau_factor = std::numeric_limits<double>::infinity();
  // The square root of the unit roundoff, as good as a gradient is.
  rules.stall_decrement = 1e-8;
  rules.stall_step = 1e-9;
  // Steps are always short, so every point is a fallback.
  rules.fallback_step = 0;
  // Ten times the default of Newton's method.
  rules.max_iterations = 10000;
  return rules;
}

StoppingRules brief_rules(int steps, double relative_decrease) {
  StoppingRules rules;
  rules.scale = EnergyScale::Value;
  rules.second_chances = 0;
  rules.relative_decrease = relative_decrease;
  // The first small step ends the run, with an exact Hessian or not, and no other rule does.
  rules.tail_factor = 0;
  rules.last_factor = std::numeric_limits<double>::infinity();
  rules.plateau_factor = std::numeric_limits<double>::infinity();
  rules.stall_decrement = std::numeric_limits<double>::infinity();
  rules.stall_iterations = 1;
  rules.stall_step = 0;
  rules.max_iterations = steps;
  return rules;
}

StoppingTest::StoppingTest(const StoppingRules& rules, double energy)
    : rules_(rules), start_(energy), energies_{energy} {
  require_valid(rules_);
}

double StoppingTest::smallest_scale() const {
  double largest = rules_.energy_scale;
  for (const double energy : energies_) largest = std::max(largest, std::abs(energy));
  // Exponential energies fall by many orders of magnitude on the way to their typical size.
  const double typical =
      rules_.energy_scale > 0 ? rules_.energy_scale : std::numeric_limits<double>::infinity();
  return std::min(kSmallestScale * largest, typical);
}

double StoppingTest::scale(double energy, const IterationRecord& step) const {
  const double value = std::abs(energy), smallest = smallest_scale();
  if (rules_.scale == EnergyScale::Value) return std::max(value, smallest);
  const double fallen = std::max(0.0, start_ - energy) + step.newton_decrement;
  const double way = step.direction_norm > 0 ? 1 + step.distance / step.direction_norm : 1.0;
  const double visible = rules_.relative_decrease > LineSearch::kResolution
                             ? LineSearch::kResolution / rules_.relative_decrease
                             : 1.0;
  const double gain = std::min(fallen, way * way * step.newton_decrement);
  return std::max({kGainPart * gain, visible * value, smallest});
}

std::optional<Stop> StoppingTest::before_step() const {
  if (steps_ < rules_.max_iterations) return {};
  return Stop{Status::MaxIterations, "iteration limit"};
}

Advice StoppingTest::after(const StepResult& step, Since since) {
  ++steps_;
  Advice advice;
  const IterationRecord& r = step.record;
  const double smallest = smallest_scale(), before = std::abs(step.energy_before);
  const double scale = this->scale(step.energy_before, r);
  // The decrease relative to the scale; the record has the decrease relative to the energy.
  const double decrease = rules_.scale == EnergyScale::Value
                              ? r.relative_decrease
                              : r.relative_decrease * std::max(before, smallest) / scale;
  const bool is_rounding = before <= smallest && r.newton_decrement <= smallest;
  const double near =
      std::max(rules_.stall_decrement, rules_.tail_factor * rules_.relative_decrease);
  const bool near_minimum = is_rounding || (!step.is_damped && r.newton_decrement <= near * scale);
  if (step.outcome != StepResult::Outcome::Moved) {
    const bool held = step.outcome == StepResult::Outcome::Blocked ||
                      step.outcome == StepResult::Outcome::NoDecrease;
    const bool ends = !held || since == Since::Same || ++idle_ > rules_.stall_iterations;
    if (ends && held && !near_minimum && chances_ < rules_.second_chances) {
      ++chances_;
      advice.polish = true;
    } else if (ends) {
      advice.stop =
          no_step(step, near_minimum ? Stop{Status::Converged, near_minimum_at(step.record.limit)}
                                     : Stop{Status::Stalled, stalled_at(step.record.limit)});
    }
    return advice;
  }
  if (r.energy < -kUnbounded * std::max(1.0, std::abs(start_))) {
    advice.stop = Stop{Status::Failed, unbounded_below(r.energy)};
    return advice;
  }
  energies_.push_back(r.energy);
  if (energies_.size() > kScaleWindow) energies_.pop_front();
  if (is_rounding && (r.newton_decrement <= kRoundoff * smallest ||
                      decrease * scale < kVisible * r.newton_decrement)) {
    advice.stop = Stop{Status::Converged, "the energy vanishes"};
    return advice;
  }
  remember(step, decrease, since);
  const bool plateau = on_plateau();
  const bool small = decrease <= rules_.relative_decrease;
  const bool in_tail = small && !step.is_damped && since == Since::Same &&
                       r.curvature != Curvature::Exact &&
                       r.newton_decrement <= rules_.tail_factor * rules_.relative_decrease * scale;
  const bool promises = r.newton_decrement > rules_.last_factor * rules_.relative_decrease * scale;
  in_tail_ += in_tail;
  if (in_tail && in_tail_ >= rules_.tail_steps && !plateau && !promises) {
    advice.stop = Stop{Status::Converged, "relative decrease"};
    return advice;
  }
  advice.polish = in_tail && in_tail_ == 1;
  const bool held = r.step_bound < rules_.stall_step && !step.is_direction_too_long;
  idle_ = small || held ? idle_ + 1 : 0;
  held_ = idle_ == 0 ? 0 : held_ + held;
  limit_ = idle_ == 0 ? StepLimit::None
                      : std::max(limit_, held ? StepLimit::Checker : step.record.limit);
  const bool falls = plateau || (promises && since == Since::Same && falls_visibly());
  const bool goes_on = near_minimum && falls && held_ == 0;
  if (idle_ >= rules_.stall_iterations && !goes_on) {
    if (near_minimum) {
      std::string rule = "relative decrease";
      if (promises) rule = near_minimum_at(limit_);
      advice.stop = Stop{Status::Converged, std::move(rule)};
    } else if (chances_ < rules_.second_chances) {
      ++chances_;
      advice.polish = true;
      idle_ = held_ = 0;
    } else {
      Stop& stop = advice.stop.emplace();
      stop.status = Status::Stalled;
      stop.message = stalled_at(limit_);
      stop.at_fallback = rules_.fallback_step > 0;
    }
  }
  advice.fallback = idle_ == 0 && r.step_bound >= rules_.fallback_step;
  return advice;
}

void StoppingTest::remember(const StepResult& step, double decrease, Since since) {
  if (since == Since::ProblemChanged) decreases_.clear();
  definite_ = step.record.failed_factorizations > 0 ? 0 : definite_ + 1;
  decreases_.push_back(decrease > rules_.decrement ? decrease : 0.0);
  if (decreases_.size() > 2 * static_cast<std::size_t>(rules_.plateau_window))
    decreases_.pop_front();
}

bool StoppingTest::on_plateau() const {
  const auto most = static_cast<std::ptrdiff_t>(decreases_.size() / 2);
  if (most == 0) return false;
  const double part = definite_ < rules_.stall_iterations ? rules_.saddle_part : 1.0;
  return std::max(remaining(1), remaining(most)) >
         part * rules_.plateau_factor * rules_.relative_decrease;
}

// Returns the part of the energy that is left if decreases go on at the rate of the last `window`
// decreases to the `window` before.
double StoppingTest::remaining(std::ptrdiff_t window) const {
  const auto last = decreases_.end() - window;
  const double now = std::accumulate(last, decreases_.end(), 0.0);
  const double before = std::accumulate(last - window, last, 0.0);
  const double most = rules_.plateau_steps / static_cast<double>(window);
  return now * (now < before ? std::min(now / (before - now), most) : most);
}

// Returns whether one of the last stall_iterations steps decreased the energy.
bool StoppingTest::falls_visibly() const {
  const auto last = std::min<std::ptrdiff_t>(rules_.stall_iterations, std::ssize(decreases_));
  return std::any_of(decreases_.end() - last, decreases_.end(), [](double d) { return d > 0; });
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
