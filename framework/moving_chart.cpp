#include "majorant/framework/moving_chart.h"

#include <utility>

namespace majorant {

void ChartDescent::begin(Vec y, double start_energy) {
  result.y = std::move(y);
  result.energy = energy = start_energy;
}

Descent::Answer ChartDescent::after_step(const StepResult& step) {
  Descent::after_step(step);
  if (step.outcome != StepResult::Outcome::Moved) return {};
  chart_.move(evaluator(), result.y);
  if (!observer_) return {};
  return {observed(observer_, step.record, chart_.shown(evaluator().problem(), result.y))};
}

void ChartDescent::set_fallback() {
  Descent::set_fallback();
  fallback_ = chart_.expand(evaluator().problem().expand(result.y));
}

void ChartDescent::return_to_fallback() {
  Descent::return_to_fallback();
  chart_.return_to(evaluator(), result.y, fallback_);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
