// Reports of steps for StoppingTest (minimizer.h), and its answers.
#pragma once

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "majorant/framework/minimizer.h"

namespace majorant::test {

// Returns the report of a step from energy 100.
inline StepResult moved(double decrease, double decrement, double bound = 1,
                        Curvature curvature = Curvature::Projected) {
  StepResult step;
  step.outcome = StepResult::Outcome::Moved;
  step.energy_before = 100;
  step.record.relative_decrease = decrease;
  step.record.energy = 100 * (1 - decrease);
  step.record.newton_decrement = 100 * decrement;
  step.record.step_bound = bound;
  step.record.curvature = curvature;
  return step;
}

inline StepResult ended(StepResult::Outcome outcome, double decrement = 0) {
  StepResult step = moved(0, decrement, 0);
  step.outcome = outcome;
  return step;
}

inline StoppingRules usual_rules() {
  StoppingRules r;
  r.scale = EnergyScale::Value;  // all reports begin at the same energy
  r.second_chances = 0;
  r.relative_decrease = 1e-6;
  r.tail_factor = 10;
  r.last_factor = std::numeric_limits<double>::infinity();
  r.stall_decrement = 1e-4;
  r.stall_iterations = 3;
  r.stall_step = 1e-3;
  r.fallback_step = 0.1;
  r.plateau_factor = 2;
  r.saddle_part = 0.01;
  r.plateau_window = 12;
  r.plateau_steps = 1000;
  r.decrement = 1e-12;
  r.max_iterations = 7;
  return r;
}

constexpr const char* kNotAsPromised =
    "the energy does not fall as its derivatives promise: it is not smooth there, they are "
    "wrong, or its Hessian is nearly singular";

inline void expect_goes_on(const Advice& advice) {
  EXPECT_FALSE(advice.stop.has_value()) << advice.stop->message;
}

inline void expect_stop(const Advice& advice, Status status, const std::string& message) {
  ASSERT_TRUE(advice.stop.has_value());
  EXPECT_EQ(status_name(advice.stop->status), status_name(status));
  EXPECT_EQ(advice.stop->message, message);
}

}  // namespace majorant::test

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
