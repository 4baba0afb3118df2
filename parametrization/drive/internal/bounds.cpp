// The bounds with a barrier of a DegreeSolver (degree_solver.h): first as if there were none, then
// inside, then along the barrier to the constrained minimum. Where the free minimum meets them, it
// is the constrained one, and no barrier is made.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "majorant/framework/evaluator.h"
#include "majorant/parametrization/drive/internal/degree_solver.h"
#include "majorant/parametrization/drive/internal/solver_rules.h"

namespace majorant {

SolveResult DegreeSolver::solve_within_bounds(RunRecord& record) {
  SolveResult result = approach(setup_.solve.elevation_tolerance, record);
  if (was_stopped(result.status)) return result;
  if (added_.met(x_)) {
    result = exhaust(kRemedies, tries_, record);
    if (was_stopped(result.status) || added_.met(x_)) return result;
  }
  try {
    if (!enter_bounds(result, record)) return result;
    if (!follow_barriers(result, record)) return result;
  } catch (const Stopped& stop) {
    return stopped(std::move(result), stop.why());
  }
  tries_ = {};
  return exhaust(kRemedies, tries_, record);
}

// Whether x_ is inside.
bool DegreeSolver::enter_bounds(SolveResult& result, RunRecord& record) {
  const BoundRules& rules = setup_.rules.bounds;
  double weight = 0;
  const auto point = [this] { return added_.of_map(x()); };
  const auto go_on = [&](double factor) {
    setup_.stop.poll();
    if (weight == 0)
      weight = rules.first_share * std::max(std::abs(result.energy), rules.least_energy) /
               std::max(added_.barrier_size(x()), rules.least_barrier);
    added_.set_barrier_weight(factor * weight);
    rebuild();
    result = descend(unlimited(rules.entry.tolerance), Phase::Barrier, record);
    return !was_stopped(result.status);
  };
  const Entry entry = majorant::enter_bounds(added_.bounds(), rules.entry, point, go_on);
  if (entry == Entry::Stopped) return false;
  if (entry == Entry::Inside) {
    rebuild();
    return true;
  }
  result.status = Status::Infeasible;
  result.message =
      fmt::format("no map was found that meets the bound '{}'", added_.violated(x())->name());
  return false;
}

// Interior points: the weight falls until what it may still cost is within the tolerance. Along the
// path the energy exceeds the constrained minimum by a multiple of the weight, so the last decrease
// tells what is left.
bool DegreeSolver::follow_barriers(SolveResult& result, RunRecord& record) {
  const BoundRules& rules = setup_.rules.bounds;
  double weight = added_.barrier_weight(), before = 0, left = 0;
  for (int round = 0; round < rules.most_rounds; ++round, weight *= rules.fall) {
    setup_.stop.poll();
    result = descend_with(weight, record);
    if (was_stopped(result.status)) return false;
    left = (before - result.energy) * rules.fall / (1 - rules.fall);
    if (round > 1 && left <= setup_.solve.tolerance * std::abs(result.energy)) return true;
    before = result.energy;
  }
  result.status = Status::Stalled;
  result.message = fmt::format(
      "inside the bounds, but after {} weights of their barriers the energy "
      "still falls by {:.1e}",
      rules.most_rounds, left);
  return false;
}

SolveResult DegreeSolver::descend_with(double barrier_weight, RunRecord& record) {
  added_.set_barrier_weight(barrier_weight);
  TermChanges changes;
  for (const TermId id : built_.barriers) {
    changes.emplace_back(id, built_.problem.state(id));
    changes.back().second.weight = barrier_weight;
  }
  built_.problem = built_.problem.with(std::move(changes));
  stepper_.reset(built_.problem);
  return descend(unlimited(setup_.solve.tolerance), Phase::Barrier, record);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
