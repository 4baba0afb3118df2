#include "rows.h"

namespace majorant::tinyad {

Watch::Watch(double target, bool to_rounding) : target_(target), begin_(std::clock()) {
  if (!to_rounding) return;
  options_.stopping.decrement = 1e-15;
  options_.stopping.relative_decrease = 0;
  options_.stopping.stall_decrement = 1e-12;
}

Directive Watch::after_step(const TraceEntry& row, const Vec&) {
  step(row.record, row.record.energy);
  return steps_to_target < 0 ? Directive::Continue : Directive::Interrupt;
}

void Watch::step(const IterationRecord& record, double energy) {
  ++steps;
  factorizations += record.factorizations;
  if (steps_to_target >= 0 || !(energy <= target_)) return;
  steps_to_target = steps;
  seconds_to_target = seconds();
}

double Watch::seconds() const {
  return static_cast<double>(std::clock() - begin_) / CLOCKS_PER_SEC;
}

}  // namespace majorant::tinyad

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
