// Shortens a step until it is good enough: the loop of all searches along a line.
//
//     const auto good = [&](double s) { return value(s) <= value(0) + kArmijo * s * slope; };
//     const auto next = [&](double s) { return good(s) ? kTake : kHalve; };
//     std::optional<double> s = backtrack(1, {.smallest = 1e-6}, next);
//
// Not for growing a step: LineSearch (line_search.h) does that.
#pragma once

#include <limits>
#include <optional>

#include "majorant/framework/stepper.h"

namespace majorant {

// The results of an attempt: the factor of the next step. kTake accepts the step, kGiveUp ends the
// search.
inline constexpr double kTake = 1, kHalve = 0.5, kGiveUp = 0;

struct Backtracking {
  double smallest = 0;  // steps below are not tried
  int most_trials = std::numeric_limits<int>::max();
};

// Returns the first accepted step, starting at `first` > 0; none if the rules or an attempt end the
// search. attempt(step) returns the factor of the next step (kTake, kHalve, kGiveUp or any other).
template <class Attempt>
std::optional<double> backtrack(double first, const Backtracking& rules, const Attempt& attempt) {
  double step = first;
  for (int k = 0; k < rules.most_trials && step >= rules.smallest; ++k) {
    const double part = attempt(step);
    if (part == kTake) return step;
    if (part == kGiveUp) break;
    step *= part;
  }
  return std::nullopt;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
