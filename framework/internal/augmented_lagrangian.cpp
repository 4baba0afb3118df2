#include "majorant/framework/internal/augmented_lagrangian.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "majorant/framework/internal/violation_descent.h"
#include "majorant/framework/problem_parts.h"

namespace majorant {
namespace {

// The first penalties are stiffer than the energy by this factor: a phase then leaves about a tenth
// of the violation.
constexpr double kStiffness = 10;
// Equalities whose derivatives at the start are smaller get the penalty of a derivative of norm 1:
// so small a derivative vanishes by chance.
constexpr double kFlat = 1e-7;
// Penalties rise by kRise after a phase that leaves more than kLeft of the violation.
constexpr double kRise = 10, kLeft = 0.1;
// After kMostIdle consecutive phases that leave more than this part of the violation, the violation
// itself is minimized. Penalties have risen by 10^6 then.
constexpr double kIdle = 0.5;
constexpr int kMostIdle = 6;
// The length, relative to the point, of the last Newton step on energy and equalities: the next one
// would be rounding. kPathStep is used while barriers still move the minimum.
constexpr double kLastStep = 1e-9, kPathStep = 1e-4;
// The violation below which such steps are tried before the barriers have their last weight.
constexpr double kNear = 1e-1;
// A gradient counts as 0 below this fraction of its parts, or below the change that this relative
// rounding of the unknowns causes.
constexpr double kStationary = 1e-6, kUnknownRoundoff = 1e-15;
// The maximum number of restarts, and the factor of the penalties from one to the next.
constexpr int kMostRestarts = 2;
constexpr double kRestart = 1e3;
// The largest multiplier, against overflow.
constexpr double kLargestMultiplier = 1e100;

}  // namespace

AugmentedLagrangian::AugmentedLagrangian(BarrierRun& run)
    : run_(run), ids_(run.problem.equalities()), newton_(run, ids_) {
  if (has_rows()) state_ = equality_state(run.problem.evaluator().problem(), ids_);
}

bool AugmentedLagrangian::begin() {
  start_ = run_.problem.place();
  const Vec& y = start_.y;
  const Problem& problem = run_.problem.evaluator().problem();
  const EqualityRows rows(problem, ids_, problem.expand(y));
  for (Index row = 0; row < rows.count(); ++row)
    if (!std::isfinite(rows.values()[row]) || !std::isfinite(rows.scales()[row])) {
      run_.refuse(Status::Infeasible,
                  fmt::format("the equality {} or its derivatives are not finite at the start",
                              rows.name(row)));
      return false;
    }
  violation_ = rows.violation();
  const Vec weights =
      (rows.norms().array() > kFlat).select(rows.norms(), 1.0).cwiseAbs2().cwiseInverse();
  const Vec squares = rows.diagonal_of_squares(weights);
  // The diagonal of A^T A by the unknowns of the problem.
  Vec stiffness = Vec::Zero(problem.size());
  for (Index i = 0; i < problem.full_size(); ++i)
    for (const auto& entry : ProblemParts::elimination(problem).row(i))
      stiffness[entry.reduced] += entry.coefficient * entry.coefficient * squares[i];
  TermChanges alone;
  for (const TermId id : ids_) alone.emplace_back(id, TermChange{.weight = 0});
  for (const TermId id : run_.problem.barriers()) alone.emplace_back(id, TermChange{.weight = 0});
  const Problem energy = problem.with(std::move(alone));
  Vec gradient, values;
  Evaluator(energy).linearize(
      y, energy.supports(Curvature::Exact) ? Curvature::Exact : run_.options.newton.curvature,
      gradient, values, run_.options.newton.stop);
  double bend = 0, slope = 0;
  for (Index k = 0; k < problem.size(); ++k)
    if (stiffness[k] > 0) {
      bend += std::abs(values[problem.pattern().diagonal_slot(k)]);
      slope += gradient[k] * gradient[k];
    }
  const double size = stiffness.sum();
  double penalty = kStiffness * std::max(bend / size, std::sqrt(slope / size));
  if (!(penalty > 0 && std::isfinite(penalty))) penalty = 1;
  first_penalty_ = penalty;
  first_penalties_ = penalty * weights;
  state_ = {Vec::Zero(rows.count()), first_penalties_};
  return true;
}

BarrierStage AugmentedLagrangian::stage(double mu) const {
  BarrierStage stage = run_.of_bounds(mu);
  if (has_rows())
    stage.equalities = equality_changes(run_.problem.evaluator().problem(), ids_, state_);
  return stage;
}

double AugmentedLagrangian::penalty_energy() const {
  const Problem& problem = run_.problem.evaluator().problem();
  const EqualityRows rows(problem, ids_, problem.expand(run_.problem.y()));
  return 0.5 * rows.values().cwiseAbs2().dot(state_.penalties);
}

void AugmentedLagrangian::raise_penalties() { state_.penalties *= kRise; }

AugmentedLagrangian::Progress AugmentedLagrangian::after_phase(bool is_last, bool is_settled) {
  const Problem& problem = run_.problem.evaluator().problem();
  const EqualityRows rows(problem, ids_, problem.expand(run_.problem.y()));
  if (is_last || rows.violation() <= kNear)
    if (std::optional<EqualityNewton::Minimum> minimum =
            newton_.converge(state_, is_last ? kLastStep : kPathStep)) {
      violation_ = minimum->violation;
      idle_ = 0;
      state_.multipliers = std::move(minimum->multipliers);
      return Progress::Met;
    }
  move_multipliers(rows);
  if (is_last && is_settled && violation_ <= run_.options.equality_tolerance &&
      run_.result.status == Status::Converged && is_stationary()) {
    run_.result.message += fmt::format("; the equalities hold to {:.1e}", violation_);
    return Progress::Met;
  }
  return idle_ < kMostIdle ? Progress::Going : minimize_violation();
}

// Penalties rise for rows that kept their violation, unless it is as small as the tolerance of a
// descent leaves it.
void AugmentedLagrangian::move_multipliers(const EqualityRows& rows) {
  const double before = violation_;
  violation_ = rows.violation();
  const bool is_met = violation_ <= run_.options.equality_tolerance;
  idle_ = violation_ > kIdle * before && !is_met ? idle_ + 1 : 0;
  state_.multipliers += state_.penalties.cwiseProduct(rows.values());
  state_.multipliers =
      state_.multipliers.cwiseMin(kLargestMultiplier).cwiseMax(-kLargestMultiplier);
  const double least = std::max(kLeft * before, kNoViolation);
  for (Index row = 0; row < rows.count(); ++row)
    if (!(std::abs(rows.values()[row]) <= least * rows.scales()[row]))
      state_.penalties[row] *= kRise;
}

void AugmentedLagrangian::test_minimum() { newton_.test_minimum(state_); }

// Returns true if the gradient of E + mu B + l g vanishes relative to its parts, up to its change
// by the rounding of the unknowns.
bool AugmentedLagrangian::is_stationary() const {
  const Problem& stage = run_.problem.evaluator().problem();
  const Vec none = Vec::Zero(state_.multipliers.size()), y = run_.problem.y();
  Evaluator evaluator(stage.with(equality_changes(stage, ids_, {state_.multipliers, none})));
  const Problem& problem = evaluator.problem();
  const Curvature curvature =
      problem.supports(Curvature::Exact) ? Curvature::Exact : run_.options.newton.curvature;
  Vec gradient, values, part, rounding = Vec::Zero(y.size());
  evaluator.linearize(y, curvature, gradient, values);
  const SparsePattern& pattern = problem.pattern();
  for (Index j = 0; j < pattern.size; ++j)
    for (Index s = pattern.column_starts[to_size(j)]; s < pattern.column_starts[to_size(j) + 1];
         ++s) {
      const Index i = pattern.rows[to_size(s)];
      rounding[i] += std::abs(values[s] * y[j]);
      if (i != j) rounding[j] += std::abs(values[s] * y[i]);
    }
  double scale = run_.energy_scale() / std::max(1.0, y.norm());
  for (const TermId id : problem.terms()) {
    evaluator.gradient(id, y, part);
    scale = std::max(scale, part.norm());
  }
  const Vec allowed = (kUnknownRoundoff * rounding).array() + kStationary * scale;
  return (gradient.array().abs() <= allowed.array()).all();
}

// Restarts the phases at a point without violation, with penalties that keep it small. The descent
// to this point begins at the present point, or at the start if the energy has led astray.
AugmentedLagrangian::Progress AugmentedLagrangian::minimize_violation() {
  LeastViolation least = descend_violation(run_, ids_, first_penalty_, violation_);
  violation_ = least.violation;
  if (!run_.went_on()) return Progress::Ended;
  if (violation_ > kNoViolation && restarts_ == 0) {
    const BarrierProblem::Place place = run_.problem.place();
    run_.return_to(start_);
    const LeastViolation other = descend_violation(run_, ids_, first_penalty_, violation_);
    if (!run_.went_on()) {
      violation_ = other.violation;
      return Progress::Ended;
    }
    if (other.violation >= violation_)
      run_.return_to(place);
    else
      least = other;
    violation_ = least.violation;
  }
  if (violation_ <= kNoViolation && restarts_ < kMostRestarts) {
    state_ = {Vec::Zero(state_.multipliers.size()),
              std::pow(kRestart, ++restarts_) * first_penalties_};
    idle_ = 0;
    return Progress::Going;
  }
  Index row = 0;
  const Problem& problem = run_.problem.evaluator().problem();
  const EqualityRows rows(problem, ids_, problem.expand(run_.problem.y()));
  rows.violation(&row);
  if (violation_ > kNoViolation && !least.is_minimum)
    run_.refuse(Status::Stalled,
                fmt::format("no point was found that meets the equalities: at the last one {} is "
                            "{:.3g}, not 0; that is no proof that there is none",
                            rows.name(row), rows.values()[row]));
  else if (violation_ > kNoViolation)
    run_.refuse(Status::Infeasible,
                fmt::format("no point meets the equalities, or none nearby: where their violation "
                            "is least, {} is {:.3g}, not 0",
                            rows.name(row), rows.values()[row]));
  else
    run_.refuse(
        Status::Stalled,
        fmt::format("the equalities can be met, but their multipliers grow without limit: "
                    "at the minimum the derivatives of some vanish or depend on each other, "
                    "as that of {}",
                    rows.name(row)));
  return Progress::Ended;
}

std::vector<Vec> AugmentedLagrangian::multipliers() const {
  if (!has_rows()) return {};
  return by_equality(run_.problem.evaluator().problem(), ids_, state_.multipliers);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
