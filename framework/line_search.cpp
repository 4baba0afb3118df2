#include "majorant/framework/line_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/backtracking.h"
#include "majorant/framework/error.h"
#include "majorant/framework/partition.h"
#include "majorant/framework/problem_parts.h"

namespace majorant {
namespace {

// An increase up to this part of kResolution counts as rounding; it is well below a change that
// counts.
constexpr double kRoundingPart = 0.25;
// The step is kept if the minimum of the parabola lies between these multiples of it: a quadratic
// then loses at most 1/16 of its decrease.
constexpr double kWorthShortening = 0.8, kWorthGrowing = 1.25;
// The growth of the step per trial of the barrier phase, where the parabola proposes 1.455.
constexpr double kStride = 2;

}  // namespace

LineSearch::LineSearch(Evaluator& evaluator, const LineSearchOptions& options, const Vec& y,
                       const Vec& p, double energy, double decrement, StopCheck stop)
    : evaluator_(evaluator),
      options_(options),
      y_(y),
      p_(p),
      stop_(std::move(stop)),
      energy_(energy),
      decrement_(decrement),
      rounding_(decrement <= kResolution * std::abs(energy)
                    ? kRoundingPart * kResolution * std::abs(energy)
                    : 0.0),
      x_(evaluator.problem().expand(y)) {
  require_no_stop("LineSearch: the stop check", stop_, partition_of(evaluator.problem()));
  ProblemParts::elimination(evaluator.problem()).expand_direction(p, d_);
}

LineSearch::Result LineSearch::find(double first) {
  bound_ = certified(std::max(1.0, first));
  const bool cut = bound_.step < first;
  if (cut) limit_ = StepLimit::Checker;
  const double s = cut ? options_.boundary_fraction * bound_.step : first;
  if (s < options_.smallest_step) return Result::Blocked;
  const auto attempt = [this](double step) { return accept(step) ? kTake : kHalve; };
  if (!backtrack(s, {.smallest = options_.smallest_step}, attempt)) return Result::NoDecrease;
  improve();
  return Result::Accepted;
}

StepBound LineSearch::certified(double s) const {
  StepBound bound{s, {}};
  for (const auto& checker : evaluator_.problem().checkers()) {
    stop_.poll();
    StepBound b = checker->max_step(x_, d_, bound.step);
    if (!(b.step >= 0))
      throw InvalidArgument(
          fmt::format("feasibility checker '{}': max_step() is {} for a step of {:g}; it may be 0 "
                      "to that step, which is the answer where paths are not certified",
                      checker->name(), b.step, bound.step));
    if (b.step < bound.step) bound = std::move(b);
  }
  const double here = bound.step;
  bound.step = partition_of(evaluator_.problem()).min(here);
  if (here > 2 * bound.step) bound.blocking.clear();  // StepBound::blocking, of all ranks
  return bound;
}

// Returns whether s passes Armijo and all checkers and beats the best step so far; s is then the
// best step.
bool LineSearch::accept(double s) {
  ++trials_;
  const Vec candidate = y_ + s * p_;
  const double trial = evaluator_.value(candidate, stop_);
  if (!std::isfinite(trial)) return refuse(StepLimit::Domain);
  if (!(trial <= energy_ - options_.armijo * s * decrement_ + rounding_))
    return refuse(StepLimit::Energy);
  if (best_step_ > 0 && !(trial < best_energy_)) return false;
  if (evaluator_.violation(evaluator_.point())) return refuse(StepLimit::Checker);
  best_step_ = s;
  best_energy_ = trial;
  return true;
}

// Returns false. Stores the limit, unless there is a good step, which no longer step limits.
bool LineSearch::refuse(StepLimit why) {
  if (best_step_ == 0) limit_ = why;
  return false;
}

// Returns the minimum of the parabola through E(0), E'(0) and the best step, at most largest_growth
// times that step.
double LineSearch::target_step() const {
  const double s = best_step_, largest = options_.largest_growth * s;
  const double curvature = (best_energy_ - energy_ + decrement_ * s) / (s * s);
  return curvature > 0 ? std::min(decrement_ / (2 * curvature), largest) : largest;
}

// Accepts `target`, or the certified part of it, if that is well above the best step.
bool LineSearch::grow(double target) {
  const double cap = certified(target).step;
  if (cap < target) target = options_.boundary_fraction * cap;
  return target > kWorthGrowing * best_step_ && accept(target);
}

// Grows the step as long as that pays, in the barrier phase. Returns whether it did.
bool LineSearch::stride() {
  if (!(decrement_ > options_.barrier_decrement * std::abs(energy_))) return false;
  const double factor = std::min(kStride, options_.largest_growth);
  bool grown = false;
  for (int round = 0; round < options_.most_improvements; ++round) {
    const double before = best_energy_;
    if (!grow(factor * best_step_)) break;
    grown = true;
    if (best_energy_ > before - options_.barrier_gain * std::abs(before)) break;
  }
  return grown;
}

void LineSearch::improve() {
  if (rounding_ > 0) return;
  if (target_step() > kWorthGrowing * best_step_ && stride()) return;
  for (int round = 0; round < options_.most_improvements; ++round) {
    const double target = target_step();
    if (target > kWorthGrowing * best_step_) {
      if (!grow(target)) return;
    } else if (target > kWorthShortening * best_step_ || !accept(target)) {
      return;
    }
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
