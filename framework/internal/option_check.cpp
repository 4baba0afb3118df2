#include "majorant/framework/internal/option_check.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string>

namespace majorant {

void require_in(std::string_view what, double value, double least, double limit) {
  if (!(value >= least && value < limit))
    throw InvalidArgument(
        fmt::format("{} is {:g}, it must lie in [{:g}, {:g})", what, value, least, limit));
}

void require_valid(const LineSearchOptions& options) {
  require_in("LineSearchOptions: armijo", options.armijo, 0, 1);
  require_in("LineSearchOptions: boundary_fraction", options.boundary_fraction,
             std::numeric_limits<double>::min(), 1);
  require_at_least("LineSearchOptions: largest_growth", options.largest_growth, 1);
  require_at_least("LineSearchOptions: most_improvements", options.most_improvements, 0);
  require_at_least("LineSearchOptions: barrier_decrement", options.barrier_decrement, 0);
  require_at_least("LineSearchOptions: barrier_gain", options.barrier_gain, 0);
  require_in("LineSearchOptions: smallest_step", options.smallest_step, 0, 1);
}

void require_valid(const StoppingRules& rules) {
  const auto number = [](std::string_view name, double value) {
    if (std::isnan(value)) throw InvalidArgument(fmt::format("StoppingRules: {} is nan", name));
  };
  number("relative_decrease", rules.relative_decrease);
  if (rules.relative_decrease < 0 && rules.relative_decrease != kAnyDecrease)
    throw InvalidArgument(fmt::format(
        "StoppingRules: relative_decrease is {:g}, it must not be negative, or be kAnyDecrease",
        rules.relative_decrease));
  number("tail_factor", rules.tail_factor);
  number("last_factor", rules.last_factor);
  number("plateau_factor", rules.plateau_factor);
  number("decrement", rules.decrement);
  number("stall_decrement", rules.stall_decrement);
  number("stall_step", rules.stall_step);
  number("fallback_step", rules.fallback_step);
  require_at_least("StoppingRules: plateau_window", rules.plateau_window, 1);
  require_at_least("StoppingRules: stall_iterations", rules.stall_iterations, 1);
  require_at_least("StoppingRules: max_iterations", rules.max_iterations, 0);
}

std::shared_ptr<LinearSolver> make_solver(std::string_view who,
                                          const SolverFactory& linear_solver) {
  require_given(fmt::format("{}: linear_solver", who), linear_solver);
  return given(fmt::format("what {}: linear_solver makes", who), linear_solver());
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
