#include "majorant/parametrization/solve/internal/bounded_descent.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "majorant/framework/element_values.h"
#include "majorant/parametrization/solve/internal/map_descent.h"

namespace majorant {
namespace {

// The problem of this degree in the form of BarrierMinimizer.
class WithinBounds final : public BarrierProblem {
 public:
  WithinBounds(DegreeProblem& problem, SolveResult free, RunRecord& record)
      : result(std::move(free)), problem_(problem), record_(record) {}

  const Bounds& bounds() const override { return problem_.bounds().all; }
  Evaluator& evaluator() override { return problem_.evaluator(); }
  std::vector<TermId> barriers() const override {
    return {problem_.barriers().begin(), problem_.barriers().end()};
  }
  Vec y() const override { return problem_.reduced(); }
  Vec point() const override { return problem_.x(); }
  BarrierEnergies energies() const override {
    BarrierEnergies here{problem_.own_energy(problem_.unknowns()), 0};
    for (const auto& bound : bounds()) here.barrier += values(*bound->barrier()).sum();
    return here;
  }
  // Barriers are means or sums, of -log or other functions, so their size is estimated. The first
  // weight uses the barrier's values; later ones use its decrease while the weight falls.
  double barrier_size(const BarrierStage& stage,
                      std::span<const BarrierPhase> phases) const override {
    if (phases.size() == 1) return 0;
    if (phases.size() > 1) {
      const BarrierPhase &last = phases.back(), &before = phases[phases.size() - 2];
      return std::max(last.barrier - before.barrier, 0.0) / std::log(before.mu / last.mu);
    }
    double size = 0;
    for (const auto& instead : stage.bounds)
      if (instead.checker) size += values(*instead.term).cwiseAbs().sum();
    return std::max(size, problem_.setup().rules.bounds.least_barrier);
  }
  void enter(const BarrierStage& stage) override {
    problem_.setup().stop.poll();
    problem_.enter(stage);
  }
  // A map may stall at the limit of its certificates, which also ends a phase.
  SolveResult descend(StoppingRules rules) override {
    result = majorant::descend(problem_, unlimited_rules(problem_.setup(), rules.relative_decrease),
                               Phase::Barrier, record_)
                 .result;
    return result;
  }

  SolveResult result;  // of the last descent

 private:
  Vec values(const EnergyTerm& term) const {
    return element_values(term, {}, ColoredBatches(term.element_dofs(), {}), point());
  }

  DegreeProblem& problem_;
  RunRecord& record_;
};

// Returns the rules of the barriers for an energy of this size.
BarrierOptions barrier_options(const DegreeSetup& setup, double energy) {
  const BoundRules& rules = setup.rules.bounds;
  BarrierOptions options;
  const double scale =
      std::max(std::abs(energy), rules.least_energy) / std::max(1.0, std::abs(energy));
  options.first_gap = rules.first_share * scale;
  options.tolerance = setup.solve.tolerance * scale;
  options.fall = rules.weights.fall;
  options.most_phases = rules.weights.most_phases;
  options.entry = rules.entry;
  options.centred = rules.centred;
  options.newton.stopping = unlimited_rules(setup, setup.solve.tolerance);
  return options;
}

}  // namespace

SolveResult descend_within_bounds(DegreeProblem& problem, RemedyState& state, RunRecord& record) {
  const DegreeSetup& setup = problem.setup();
  SolveResult result = approach(problem, setup.solve.elevation_tolerance, Phase::Newton, record);
  if (was_stopped(result.status)) return result;
  const auto violated = [&] { return HeldBounds(problem.bounds().all).violated(problem.x()); };
  if (!violated()) {
    result = descend_with_remedies(problem, state, record);
    if (was_stopped(result.status) || !violated()) return result;
  }
  WithinBounds run(problem, std::move(result), record);
  try {
    const BarrierResult led = BarrierMinimizer::run(run, barrier_options(setup, run.result.energy));
    result = led;
    if (was_stopped(led.status) || led.end == PathEnd::None) return result;
  } catch (const Stopped& stop) {
    return stopped(std::move(run.result), stop.why());
  }
  if (const BarrierChecker* const bound = violated()) {
    if (result.status != Status::Infeasible)
      result.message = fmt::format("no map was found that meets the bound '{}'", bound->name());
    result.status = Status::Infeasible;
    return result;
  }
  state.counts = {};
  return descend_with_remedies(problem, state, record);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
