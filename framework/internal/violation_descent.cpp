#include "majorant/framework/internal/violation_descent.h"

#include <algorithm>
#include <cmath>

#include "majorant/framework/internal/equality_rows.h"
#include "majorant/framework/internal/stationary_violation.h"

namespace majorant {
namespace {

// The weights of the barriers, relative to the violation, in the descents that minimize the
// violation; the first descents lead away from corners of the bounds. kEnergyPart is the weight of
// the energy relative to these, and its factor from one of the following descents to the next.
constexpr double kViolationParts[] = {10, 1, 0.1};
constexpr double kEnergyPart = 1e-2;
// The maximum number of further descents while the violation is not stationary, and the relative
// decrease that ends them. The gradient, relative to its parts, is then about the root of that.
constexpr int kMostViolationDescents = 12;
constexpr double kViolationDecrease = 1e-10;
// The relative change of the scales of rows that counts as none.
constexpr double kSettledScales = 1e-5;

// Tests the violation without the energy that was minimized with it. Where the derivatives of all
// rows vanish, the parts of the gradient do not cancel, and Newton's predicted decrease decides: a
// gradient of kStationaryViolation predicts its square.
bool is_stationary_violation(const BarrierRun& run, const std::vector<TermId>& ids,
                             double violation) {
  const double decrement = run.result.newton_decrement;
  if (run.result.status == Status::Converged && decrement > 0 &&
      decrement <= kStationaryViolation * kStationaryViolation * violation)
    return true;
  const Problem& stage = run.problem.evaluator().problem();
  const std::vector<TermId> barriers = run.problem.barriers();
  TermChanges changes;
  for (const TermId id : stage.terms())
    if (std::find(ids.begin(), ids.end(), id) == ids.end() &&
        std::find(barriers.begin(), barriers.end(), id) == barriers.end())
      changes.emplace_back(id, TermChange{.weight = 0});
  return gradient_part(stage.with(std::move(changes)), ids, run.problem.y()) <=
         kStationaryViolation;
}

}  // namespace

LeastViolation descend_violation(BarrierRun& run, const std::vector<TermId>& ids, double penalty,
                                 double violation) {
  LeastViolation least{violation, false};
  const auto rows_here = [&] {
    const Problem& problem = run.problem.evaluator().problem();
    return EqualityRows(problem, ids, problem.expand(run.problem.y()));
  };
  const EqualityRows start = rows_here();
  const Vec no_multipliers = Vec::Zero(start.count());
  // Half the sum of the squares of all rows, relative to their scales.
  double squares = 0.5 * penalty * start.values().cwiseQuotient(start.scales()).squaredNorm();
  Vec penalties;  // of the last descent
  const auto penalties_of = [&](const EqualityRows& rows) -> Vec {
    return penalty * rows.scales().cwiseAbs2().cwiseInverse();
  };
  bool is_settled = false;  // the last descent did not change the scales of the rows
  const auto descend = [&](double barrier, double energy, const StoppingRules& rules) {
    penalties = penalties_of(rows_here());
    BarrierStage stage = run.of_bounds(barrier);
    stage.energy = energy;
    stage.equalities = equality_changes(run.problem.evaluator().problem(), ids,
                                        {no_multipliers, penalties / energy});
    run.problem.enter(stage);
    run.descend(rules);
    run.result.energy = run.problem.energies().energy;
    const EqualityRows rows = rows_here();
    least.violation = rows.violation();
    squares = 0.5 * rows.values().cwiseAbs2().dot(penalties);
    is_settled = (penalties_of(rows) - penalties).norm() <= kSettledScales * penalties.norm();
    return run.went_on();
  };
  const auto barrier_of = [&](double cost) {
    return run.barrier_size > 0 ? cost / run.barrier_size : 0;
  };
  StoppingRules rough;
  rough.scale = EnergyScale::Value;
  double barrier = 0, energy = 0;
  for (const double part : kViolationParts) {
    if (!(run.barrier_size > 0) && part > 1) continue;  // no corner to leave
    const double cost = part * squares;
    barrier = barrier_of(cost);
    energy = kEnergyPart * cost / run.energy_scale();
    if (!(energy > 0)) break;
    if (!descend(barrier, energy, rough)) return least;
  }
  StoppingRules exact;
  exact.scale = EnergyScale::Value;
  exact.relative_decrease = kViolationDecrease;
  for (int k = 0; k < kMostViolationDescents && least.violation > kNoViolation; ++k) {
    const double most = kBarrierPart * squares;
    const bool is_alone = run.barrier_size * barrier <= most && energy * run.energy_scale() <= most;
    if (is_alone && is_settled && is_stationary_violation(run, ids, squares)) {
      least.is_minimum = !run.problem.leave_saddle();
      if (least.is_minimum) return least;
    }
    barrier = std::min(barrier, barrier_of(most));
    energy = std::min(kEnergyPart * energy, most / run.energy_scale());
    if (!descend(barrier, energy, exact)) return least;
  }
  return least;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
