#include "majorant/framework/internal/fixed_barrier_problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"
#include "majorant/framework/internal/equality_rows.h"
#include "majorant/framework/partition.h"

namespace majorant {
namespace {

double element_weights(const Problem& problem, TermId id) {
  const TermState& state = problem.state(id);
  const Vec& each = state.element_weight;
  const Index count = problem.term(id).element_dofs().element_count();
  return state.weight * (each.size() ? each.sum() : static_cast<double>(count));
}

bool is_among(const std::vector<TermId>& ids, TermId id) {
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

}  // namespace

FixedBarrierProblem::FixedBarrierProblem(const Problem& problem, MovingChart& chart,
                                         const std::vector<TermId>& barriers, Bounds bounds,
                                         const NewtonOptions& options, Vec y0,
                                         RunObserver* observer)
    : problem_(problem),
      chart_(chart),
      barriers_(barriers),
      bounds_(std::move(bounds)),
      equalities_(equality_terms(problem)),
      most_iterations_(options.stopping.max_iterations),
      observer_(observer),
      stepper_(problem, options),
      y_(std::move(y0)) {
  if (!partition_of(problem).is_whole())
    throw InvalidArgument(
        "BarrierMinimizer: the problem is that of several processes, it knows one");
  require_size("the start y", y_.size(), problem_.size());
  require_finite("the start y", y_);
  for (const TermId id : barriers_) size_of_barriers_ += element_weights(problem_, id);
  for (const TermId id : equalities_)
    if (problem_.state(id).weight != 1 || problem_.state(id).element_weight.size() > 0)
      throw InvalidArgument(fmt::format(
          "BarrierMinimizer: the equality '{}' has a weight, which is 1 for what holds exactly",
          problem_.term(id).name()));
}

BarrierEnergies FixedBarrierProblem::energies() const {
  const Problem problem = chart_.on(problem_);
  const Vec x = problem.expand(y_);
  BarrierEnergies sum;
  for (const TermId id : problem.terms())
    if (!is_among(equalities_, id))
      (is_among(barriers_, id) ? sum.barrier : sum.energy) += term_energy(problem, id, x);
  return sum;
}

void FixedBarrierProblem::enter(const BarrierStage& stage) {
  MovingChart::Terms terms;
  MovingChart::Checkers checkers = chart_.checkers(problem_);
  for (std::size_t k = 0; k < bounds_.size(); ++k) {
    const BarrierStage::Bound& instead = stage.bounds[k];
    if (instead.checker == bounds_[k]) continue;
    terms.emplace_back(barriers_[k], instead.term);
    if (instead.checker)
      std::replace(checkers.begin(), checkers.end(),
                   std::shared_ptr<const FeasibilityChecker>(bounds_[k]),
                   std::shared_ptr<const FeasibilityChecker>(instead.checker));
    else
      std::erase(checkers, bounds_[k]);
  }
  TermChanges changes;
  for (const TermId id : problem_.terms())
    changes.emplace_back(id,
                         TermChange{.weight = problem_.state(id).weight * factor_of(id, stage)});
  changes.insert(changes.end(), stage.equalities.begin(), stage.equalities.end());
  const Problem problem =
      terms.empty() ? problem_ : chart_.exchanged(problem_, terms, std::move(checkers));
  stepper_.reset(chart_.on(problem.with(std::move(changes))));
}

bool FixedBarrierProblem::leave_saddle() {
  try {
    double energy = stepper_.evaluator().value(y_);
    if (stepper_.definite_at(y_) != Definite::No || !stepper_.leave_saddle(y_, energy))
      return false;
    chart_.move(evaluator(), y_);
    return true;
  } catch (const Stopped&) {
    return false;
  }
}

SolveResult FixedBarrierProblem::descend(StoppingRules rules) {
  rules.max_iterations = std::min(rules.max_iterations, most_iterations_ - taken_);
  Directive directive = Directive::Continue;  // the last one of the observer
  StepObserver numbered([&](const TraceEntry& row, const Vec& y) {
    IterationRecord record = row.record;
    record.iteration += taken_;  // numbers count through all phases
    return directive = observed(observer_, record, y);
  });
  const double start = stepper_.evaluator().value(y_);
  ChartDescent descent(stepper_, chart_, &numbered);
  descent.begin(std::move(y_), start);
  stepper_.descend(descent, rules);
  SolveResult part = std::move(descent.result);
  if (directive != Directive::Continue) {  // also where the phase had ended anyway
    part.status = stopped_status(directive);
    part.message = Stopped(directive).what();
  }
  taken_ += static_cast<int>(part.iterations.size());
  y_ = part.y;
  return part;
}

double FixedBarrierProblem::factor_of(TermId id, const BarrierStage& stage) const {
  const auto place = static_cast<std::size_t>(std::find(barriers_.begin(), barriers_.end(), id) -
                                              barriers_.begin());
  if (place == barriers_.size()) return stage.energy;
  return place < bounds_.size() ? stage.bounds[place].weight : stage.other_barriers;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
