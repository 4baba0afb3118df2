#include "majorant/framework/internal/augmented_lagrangian.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "majorant/framework/internal/option_check.h"
#include "majorant/framework/internal/stationary_violation.h"
#include "majorant/framework/line_search.h"
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
// The weights of the barriers, relative to the violation, in the descents that minimize the
// violation; the first descents lead away from corners of the bounds. kEnergyPart is the weight of
// the energy relative to these, and its factor from one of the following descents to the next.
constexpr double kViolationParts[] = {10, 1, 0.1};
constexpr double kEnergyPart = 1e-2;
// A violation below this, relative to its scale, has the minimum 0.
constexpr double kNoViolation = 1e-6;
// The maximum number of further descents while the violation is not stationary, and the relative
// decrease that ends them. The gradient, relative to its parts, is then about the root of that.
constexpr int kMostViolationDescents = 12;
constexpr double kViolationDecrease = 1e-10;
// The relative change of the scales of rows that counts as none.
constexpr double kSettledScales = 1e-5;
// The maximum number of Newton steps on energy and equalities together: quadratic convergence takes
// three or four, after a few damped ones.
constexpr int kMostNewtonSteps = 12;
// The length, relative to the point, of a step that is the last one: the next would be rounding.
// kPathStep is used while barriers still move the minimum.
constexpr double kLastStep = 1e-9, kPathStep = 1e-4;
// Steps shorter than kLocal, relative to the point, must be at most kContraction times as long as
// the step before.
constexpr double kLocal = 1e-3, kContraction = 0.5;
// The shortest fraction of such a step that is accepted.
constexpr double kShortestStep = 1e-2;
// The violation below which such steps are tried before the barriers have their last weight.
constexpr double kNear = 1e-1;
// The factor by which penalties grow until a matrix is definite, and the number of attempts.
constexpr double kStiffer = 1e2;
constexpr int kMostStiffer = 3;
// The negative curvature that a minimum may have, relative to the mean diagonal of the energy's
// Hessian: as in NewtonMinimizer.
constexpr double kNoCurvature = 1e-8;
// A gradient counts as 0 below this fraction of its parts, or below the change that this relative
// rounding of the unknowns causes.
constexpr double kStationary = 1e-6, kUnknownRoundoff = 1e-15;
// The maximum number of restarts, and the factor of the penalties from one to the next.
constexpr int kMostRestarts = 2;
constexpr double kRestart = 1e3;
// The largest accepted relative residual of the equations of such a step.
constexpr double kSaddleResidual = 1e-6;
// The largest multiplier, against overflow.
constexpr double kLargestMultiplier = 1e100;

}  // namespace

AugmentedLagrangian::AugmentedLagrangian(BarrierRun& run)
    : run_(run), ids_(run.problem.equalities()) {
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
  if ((is_last || rows.violation() <= kNear) && polish(is_last ? kLastStep : kPathStep))
    return Progress::Met;
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

// Applies Newton's method to the energy and the equalities, from the present point. The run moves
// only if it converges to a minimum. Each step is shortened until it lowers the augmented
// Lagrangian with the new multipliers.
bool AugmentedLagrangian::polish(double last_step) {
  const Problem& stage = run_.problem.evaluator().problem();
  if (!stage.supports(Curvature::Exact) || stage.size() == 0) return false;
  const StopCheck& stop = run_.options.newton.stop;
  const auto solve = [&](const Vec& b) {
    Vec p;
    solver_->solve(b, p);
    return p;
  };
  LineSearchOptions whole = run_.options.newton.line_search;
  whole.most_improvements = 0;
  Vec y = run_.problem.y(), multipliers = state_.multipliers, penalties = state_.penalties;
  std::vector<IterationRecord> records;
  int factorizations = 0;
  double last = std::numeric_limits<double>::infinity(), size = y.norm();
  bool is_last = false;
  Evaluator evaluator(stage);
  for (int k = 0; k < kMostNewtonSteps && !is_last; ++k) {
    const EqualityRows rows(stage, ids_, stage.expand(y));
    const Vec& g = rows.values();
    if (k == 0) multipliers += penalties.cwiseProduct(g);
    Vec gradient;
    if (factorize(y, rows, multipliers, penalties, 0, gradient, factorizations) != Definite::Yes)
      break;
    const SaddlePoint step = solve_with_equalities(solve, ProblemParts::elimination(stage), rows,
                                                   penalties, -gradient, -g);
    if (!(step.residual <= kSaddleResidual) || !step.p.allFinite()) break;
    multipliers += step.q;
    evaluator.reset(stage.with(equality_changes(stage, ids_, {multipliers, penalties})));
    IterationRecord record;
    const double before = evaluator.value(y, stop);
    const double decrement = g.dot(step.q + penalties.cwiseProduct(g)) - gradient.dot(step.p);
    if (!std::isfinite(before) || !(decrement >= 0)) break;
    LineSearch search(evaluator, whole, y, step.p, before, decrement, stop);
    if (search.find(1.0) != LineSearch::Result::Accepted || search.step() < kShortestStep) break;
    const double length = search.step() * step.p.norm();
    if (search.step() == 1 && !(length <= kContraction * last) && last < kLocal * size) break;
    if (k == 0) size = std::max(size, length);
    y += search.step() * step.p;
    record.energy = search.energy();
    record.iteration = static_cast<int>(run_.result.iterations.size() + records.size()) + 1;
    record.relative_decrease = relative_to(before, before - record.energy);
    record.step = search.step();
    record.step_bound = search.bound().step;
    record.gradient_norm = gradient.norm();
    record.newton_decrement = decrement;
    record.direction_norm = step.p.norm();
    record.curvature = Curvature::Exact;
    record.projection_weight = 0;
    record.trials = search.trials();
    record.factorizations = std::exchange(factorizations, 0);
    records.push_back(record);
    last = length;
    is_last = search.step() == 1 && length <= last_step * size;
  }
  const double left = EqualityRows(stage, ids_, stage.expand(y)).violation();
  SolveResult& result = run_.result;
  if (!is_last || !(left <= std::max(run_.options.equality_tolerance, last_step * last_step))) {
    for (const IterationRecord& record : records) factorizations += record.factorizations;
    if (!result.iterations.empty()) result.iterations.back().factorizations += factorizations;
    return false;
  }
  violation_ = left;
  idle_ = 0;
  state_.multipliers = std::move(multipliers);
  result.iterations.insert(result.iterations.end(), records.begin(), records.end());
  result.y = y;
  result.status = Status::Converged;
  result.message = "the equalities hold and the energy is stationary, by Newton's method on both";
  result.definite = Definite::Yes;
  result.blocking.clear();
  run_.problem.move(std::move(y), static_cast<int>(records.size()));
  return true;
}

// Factorizes the sum of the Hessian of E + l g at y, A^T R A with the penalties R, and a shift.
// Penalties grow until the sum is positive definite, as it is for large ones if E + l g has
// positive curvature along the equalities. gradient: of E + l g.
Definite AugmentedLagrangian::factorize(const Vec& y, const EqualityRows& rows,
                                        const Vec& multipliers, Vec& penalties, double shift,
                                        Vec& gradient, int& factorizations) {
  const Problem& stage = run_.problem.evaluator().problem();
  if (!solver_) solver_ = make_solver("BarrierMinimizer", run_.options.newton.linear_solver);
  if (!analysed_ || !analysed_->same_structure(stage)) {
    analysed_ = stage;
    solver_->analyze(analysed_->pattern());
  }
  for (int k = 0; k < kMostStiffer; ++k) {
    if (k > 0) penalties *= kStiffer;
    // With these multipliers the augmented Lagrangian has the gradient and curvature of E + l g.
    const Vec beside = multipliers - penalties.cwiseProduct(rows.values());
    Evaluator evaluator(stage.with(equality_changes(stage, ids_, {beside, penalties})));
    Vec values;
    const double energy =
        evaluator.linearize(y, Curvature::Exact, gradient, values, run_.options.newton.stop);
    if (!std::isfinite(energy) || !gradient.allFinite() || !values.allFinite())
      return Definite::NotTested;
    ++factorizations;
    if (solver_->factorize(values, shift) == FactorStatus::Ok) return Definite::Yes;
  }
  return Definite::No;
}

// Tells a minimum from a saddle after convergence, by the exact Hessian along the equalities. The
// tolerance is relative to the curvature of the energy without barriers, which are stiff.
void AugmentedLagrangian::test_minimum() {
  SolveResult& result = run_.result;
  const Problem& stage = run_.problem.evaluator().problem();
  if (result.definite != Definite::NotTested || !stage.supports(Curvature::Exact) ||
      stage.size() == 0)
    return;
  const Vec y = run_.problem.y();
  const EqualityRows rows(stage, ids_, stage.expand(y));
  TermChanges alone = equality_changes(stage, ids_, {state_.multipliers, Vec::Zero(rows.count())});
  for (const TermId id : run_.problem.barriers()) alone.emplace_back(id, TermChange{.weight = 0});
  const Problem energy = stage.with(std::move(alone));
  Vec gradient, values, penalties = state_.penalties;
  Evaluator(energy).linearize(y, Curvature::Exact, gradient, values, run_.options.newton.stop);
  const double shift = kNoCurvature * mean_diagonal(energy.pattern(), values);
  int factorizations = 0;
  result.definite =
      factorize(y, rows, state_.multipliers, penalties, shift, gradient, factorizations);
  if (result.definite == Definite::No)
    result.message += ", at a saddle: the exact Hessian is indefinite there";
}

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

// Descends to a minimum of the violation, with a small weight for the energy. run_.went_on() tells
// whether the run went on, is_least_ whether the point is a minimum of the violation. At a minimum
// the gradient of the violation vanishes, except for forces of the barriers, whose cost must be a
// small part of the violation; and it is no saddle.
void AugmentedLagrangian::descend_violation() {
  is_least_ = false;
  const Vec no_multipliers = Vec::Zero(state_.multipliers.size());
  double violation = 0;  // half the sum of the squares of all rows, relative to their scales
  const auto rows_here = [&] {
    const Problem& problem = run_.problem.evaluator().problem();
    return EqualityRows(problem, ids_, problem.expand(run_.problem.y()));
  };
  Vec penalties;  // of the last descent
  const auto penalties_of = [&](const EqualityRows& rows) -> Vec {
    return first_penalty_ * rows.scales().cwiseAbs2().cwiseInverse();
  };
  bool is_settled = false;  // the last descent did not change the scales of the rows
  const auto descend = [&](double barrier, double energy, const StoppingRules& rules) {
    penalties = penalties_of(rows_here());
    BarrierStage stage = run_.of_bounds(barrier);
    stage.energy = energy;
    stage.equalities = equality_changes(run_.problem.evaluator().problem(), ids_,
                                        {no_multipliers, penalties / energy});
    run_.problem.enter(stage);
    run_.descend(rules);
    run_.result.energy = run_.problem.energies().energy;
    const EqualityRows rows = rows_here();
    violation_ = rows.violation();
    violation = 0.5 * rows.values().cwiseAbs2().dot(penalties);
    is_settled = (penalties_of(rows) - penalties).norm() <= kSettledScales * penalties.norm();
    return run_.went_on();
  };
  const auto barrier_of = [&](double cost) {
    return run_.barrier_size > 0 ? cost / run_.barrier_size : 0;
  };
  StoppingRules rough;
  rough.scale = EnergyScale::Value;
  const EqualityRows start = rows_here();
  violation = 0.5 * first_penalty_ * start.values().cwiseQuotient(start.scales()).squaredNorm();
  double barrier = 0, energy = 0;
  for (const double part : kViolationParts) {
    if (!(run_.barrier_size > 0) && part > 1) continue;  // no corner to leave
    const double cost = part * violation;
    barrier = barrier_of(cost);
    energy = kEnergyPart * cost / run_.energy_scale();
    if (!(energy > 0)) break;
    if (!descend(barrier, energy, rough)) return;
  }
  StoppingRules exact;
  exact.scale = EnergyScale::Value;
  exact.relative_decrease = kViolationDecrease;
  for (int k = 0; k < kMostViolationDescents && violation_ > kNoViolation; ++k) {
    const double most = kBarrierPart * violation;
    const bool is_alone =
        run_.barrier_size * barrier <= most && energy * run_.energy_scale() <= most;
    if (is_alone && is_settled && is_stationary_violation(violation)) {
      is_least_ = !run_.problem.leave_saddle();
      if (is_least_) return;
    }
    barrier = std::min(barrier, barrier_of(most));
    energy = std::min(kEnergyPart * energy, most / run_.energy_scale());
    if (!descend(barrier, energy, exact)) return;
  }
}

// Tests the violation without the energy that was minimized with it. Where the derivatives of all
// rows vanish, the parts of the gradient do not cancel, and Newton's predicted decrease decides: a
// gradient of kStationaryViolation predicts its square.
bool AugmentedLagrangian::is_stationary_violation(double violation) const {
  const double decrement = run_.result.newton_decrement;
  if (run_.result.status == Status::Converged && decrement > 0 &&
      decrement <= kStationaryViolation * kStationaryViolation * violation)
    return true;
  const Problem& stage = run_.problem.evaluator().problem();
  const std::vector<TermId> barriers = run_.problem.barriers();
  TermChanges changes;
  for (const TermId id : stage.terms())
    if (std::find(ids_.begin(), ids_.end(), id) == ids_.end() &&
        std::find(barriers.begin(), barriers.end(), id) == barriers.end())
      changes.emplace_back(id, TermChange{.weight = 0});
  return gradient_part(stage.with(std::move(changes)), ids_, run_.problem.y()) <=
         kStationaryViolation;
}

// Restarts the phases at a point without violation, with penalties that keep it small. The descent
// to this point begins at the present point, or at the start if the energy has led astray.
AugmentedLagrangian::Progress AugmentedLagrangian::minimize_violation() {
  descend_violation();
  if (!run_.went_on()) return Progress::Ended;
  if (violation_ > kNoViolation && restarts_ == 0) {
    const BarrierProblem::Place place = run_.problem.place();
    const double before = violation_;
    const bool was_least = is_least_;
    run_.return_to(start_);
    descend_violation();
    if (!run_.went_on()) return Progress::Ended;
    if (violation_ >= before) {
      violation_ = before;
      is_least_ = was_least;
      run_.return_to(place);
    }
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
  if (violation_ > kNoViolation && !is_least_)
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
