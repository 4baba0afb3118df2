#include "majorant/parametrization/solve/degree_solver.h"

#include <utility>

#include "majorant/parametrization/solve/internal/bounded_descent.h"
#include "majorant/parametrization/solve/internal/map_descent.h"

namespace majorant {

void DegreeSolver::soft_start(RunRecord& record) {
  if (soft_started_) return;
  try {
    take_soft_steps(problem_, record);
    soft_started_ = record.directive() == Directive::Continue;
  } catch (const Stopped&) {  // the next solve stops too
  }
}

SolveResult DegreeSolver::approach(double tolerance, RunRecord& record, Phase phase) {
  return majorant::approach(problem_, tolerance, phase, record);
}

SolveResult DegreeSolver::finish(RunRecord& record) {
  const auto solve = [&] {
    return problem_.bounds().all.empty() ? descend_with_remedies(problem_, remedies_, record)
                                         : descend_within_bounds(problem_, remedies_, record);
  };
  SolveResult result = solve();
  if (result.status == Status::Stalled && problem_.domain().hold()) result = solve();
  record.forget_mark();  // the last remedy may have had no iteration
  return result;
}

std::optional<DegreeSolver::State> DegreeSolver::state() const {
  if (remedies_.running > 0) return std::nullopt;
  return State{soft_started_,
               remedies_.counts.stalls,
               remedies_.counts.refinements,
               remedies_.barrier_followed,
               problem_.depth(),
               problem_.levels(),
               remedies_.uses};
}

void DegreeSolver::resume(State state) {
  soft_started_ = state.soft_started;
  remedies_.counts = {state.stalls, state.refinements};
  remedies_.barrier_followed = state.barrier_followed;
  remedies_.uses = state.remedies;
  problem_.set_levels(std::move(state.levels));
  if (state.depth > problem_.depth()) problem_.set_depth(state.depth);
}

IterationRecord DegreeSolver::try_step() {
  problem_.follow();
  Vec y = problem_.reduced();
  double energy = problem_.evaluator().value(y);
  return problem_.stepper().step(y, energy).record;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
