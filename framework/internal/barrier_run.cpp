#include "majorant/framework/internal/barrier_run.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace majorant {

BarrierRun::BarrierRun(BarrierProblem& on, const BarrierOptions& rules)
    : problem(on), options(rules), bounds(on.bounds()) {
  result.y = on.y();
}

double BarrierRun::energy_scale() const { return std::max(1.0, std::abs(result.energy)); }

BarrierStage BarrierRun::of_bounds(double mu) const {
  BarrierStage stage;
  stage.other_barriers = mu;
  for (const auto& bound : bounds.bounds()) stage.bounds.push_back({bound, bound->barrier(), mu});
  return stage;
}

double BarrierRun::first_weight(const BarrierStage& stage) {
  barrier_size = problem.barrier_size(stage, {});
  return barrier_size > 0 ? options.first_gap * energy_scale() / barrier_size : 0;
}

bool BarrierRun::starts(const BarrierStage& stage) {
  problem.enter(stage);
  result.y = problem.y();
  return check_start(problem.evaluator(), result);
}

int BarrierRun::descend(StoppingRules rules, int most_iterations) {
  rules.max_iterations = most_iterations;
  SolveResult part = problem.descend(rules);
  const auto before = static_cast<int>(result.iterations.size());
  for (IterationRecord& record : part.iterations) record.iteration += before;
  std::vector<IterationRecord> all = std::move(result.iterations);
  all.insert(all.end(), part.iterations.begin(), part.iterations.end());
  const auto steps = static_cast<int>(part.iterations.size());
  static_cast<SolveResult&>(result) = std::move(part);
  result.iterations = std::move(all);
  return steps;
}

bool BarrierRun::went_on() const {
  return result.status == Status::Converged || result.status == Status::Stalled;
}

void BarrierRun::return_to(const BarrierProblem::Place& place) {
  problem.return_to(place);
  result.y = place.y;
}

void BarrierRun::refuse(Status status, std::string why) {
  result.status = status;
  result.message = std::move(why);
  result.energy = problem.energies().energy;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
