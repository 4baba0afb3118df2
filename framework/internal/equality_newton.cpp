#include "majorant/framework/internal/equality_newton.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "majorant/framework/internal/option_check.h"
#include "majorant/framework/line_search.h"
#include "majorant/framework/problem_parts.h"

namespace majorant {
namespace {

// The maximum number of Newton steps on energy and equalities together: quadratic convergence takes
// three or four, after a few damped ones.
constexpr int kMostNewtonSteps = 12;
// Steps shorter than kLocal, relative to the point, must be at most kContraction times as long as
// the step before.
constexpr double kLocal = 1e-3, kContraction = 0.5;
// The shortest fraction of a step that is accepted.
constexpr double kShortestStep = 1e-2;
// The factor by which penalties grow until a matrix is definite, and the number of attempts.
constexpr double kStiffer = 1e2;
constexpr int kMostStiffer = 3;
// The negative curvature that a minimum may have, relative to the mean diagonal of the energy's
// Hessian: as in NewtonMinimizer.
constexpr double kNoCurvature = 1e-8;
// The largest accepted relative residual of the equations of a step.
constexpr double kSaddleResidual = 1e-6;

}  // namespace

EqualityNewton::EqualityNewton(BarrierRun& run, std::vector<TermId> ids)
    : run_(run), ids_(std::move(ids)) {}

// Each step is shortened until it lowers the augmented Lagrangian with the new multipliers.
std::optional<EqualityNewton::Minimum> EqualityNewton::converge(const EqualityState& state,
                                                                double last_step) {
  const Problem& stage = run_.problem.evaluator().problem();
  if (!stage.supports(Curvature::Exact) || stage.size() == 0) return std::nullopt;
  const StopCheck& stop = run_.options.newton.stop;
  const auto solve = [&](const Vec& b) {
    Vec p;
    solver_->solve(b, p);
    return p;
  };
  LineSearchOptions whole = run_.options.newton.line_search;
  whole.most_improvements = 0;
  Vec y = run_.problem.y(), multipliers = state.multipliers, penalties = state.penalties;
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
    return std::nullopt;
  }
  result.iterations.insert(result.iterations.end(), records.begin(), records.end());
  result.y = y;
  result.status = Status::Converged;
  result.message = "the equalities hold and the energy is stationary, by Newton's method on both";
  result.definite = Definite::Yes;
  result.blocking.clear();
  run_.problem.move(std::move(y), static_cast<int>(records.size()));
  return Minimum{std::move(multipliers), left};
}

// Factorizes the sum of the Hessian of E + l g at y, A^T R A with the penalties R, and a shift.
// Penalties grow until the sum is positive definite, as it is for large ones if E + l g has
// positive curvature along the equalities. gradient: of E + l g.
Definite EqualityNewton::factorize(const Vec& y, const EqualityRows& rows, const Vec& multipliers,
                                   Vec& penalties, double shift, Vec& gradient,
                                   int& factorizations) {
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

// The tolerance is relative to the curvature of the energy without barriers, which are stiff.
void EqualityNewton::test_minimum(const EqualityState& state) {
  SolveResult& result = run_.result;
  const Problem& stage = run_.problem.evaluator().problem();
  if (result.definite != Definite::NotTested || !stage.supports(Curvature::Exact) ||
      stage.size() == 0)
    return;
  const Vec y = run_.problem.y();
  const EqualityRows rows(stage, ids_, stage.expand(y));
  TermChanges alone = equality_changes(stage, ids_, {state.multipliers, Vec::Zero(rows.count())});
  for (const TermId id : run_.problem.barriers()) alone.emplace_back(id, TermChange{.weight = 0});
  const Problem energy = stage.with(std::move(alone));
  Vec gradient, values, penalties = state.penalties;
  Evaluator(energy).linearize(y, Curvature::Exact, gradient, values, run_.options.newton.stop);
  const double shift = kNoCurvature * mean_diagonal(energy.pattern(), values);
  int factorizations = 0;
  result.definite =
      factorize(y, rows, state.multipliers, penalties, shift, gradient, factorizations);
  if (result.definite == Definite::No)
    result.message += ", at a saddle: the exact Hessian is indefinite there";
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
