#include "majorant/parametrization/solve/internal/map_descent.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace majorant {
namespace {

// Records a step. own: the step's record, of the map alone.
Directive note(const DegreeProblem& problem, const IterationRecord& own,
               StepResult::Outcome outcome, Phase phase, RunRecord& record) {
  const DegreeSetup& setup = problem.setup();
  TraceEntry row;
  row.degree = problem.space()->degree();
  row.record = own;
  row.phase = phase;
  row.outcome = outcome;
  row.energy = own.energy;
  if (phase != Phase::Newton)
    row.energy = setup.requested_energy ? setup.requested_energy(problem.x())
                                        : problem.own_energy(problem.unknowns());
  Directive directive = record.note(std::move(row));
  if (setup.watch) {
    const Directive watched =
        setup.watch(record.trace().back(), {problem.space(), problem.x(), {}});
    if (directive == Directive::Continue) directive = watched;
  }
  return directive;
}

// A descent on the problem of a domain. result.energy and the iterations are the map's own;
// result.y and energy are those of the solver's problem and unknowns.
class MapDescent : public Descent {
 public:
  MapDescent(DegreeProblem& problem, Phase phase, RunRecord& record)
      : problem_(problem), phase_(phase), record_(record) {}

  Answer after_step(const StepResult& step) override;
  void set_fallback() override {
    fallback_ = problem_.checkpoint();
    fallback_energy_ = result.energy;
  }
  void return_to_fallback() override {
    problem_.return_to(fallback_);
    result.energy = fallback_energy_;
  }

 protected:
  void follow_problem() {
    result.y = problem_.reduced();
    energy = problem_.evaluator().value(result.y);
  }

  DegreeProblem& problem_;

 private:
  Phase phase_;
  RunRecord& record_;
  DegreeProblem::Checkpoint fallback_;
  double fallback_energy_ = 0;
};

Descent::Answer MapDescent::after_step(const StepResult& step) {
  const bool moved = step.outcome == StepResult::Outcome::Moved;
  IterationRecord own = step.record;
  if (moved) {
    problem_.move_to(result.y);
    own.energy = energy - problem_.foreign_energy();
    own.relative_decrease = relative_to(result.energy, result.energy - own.energy);
    result.energy = own.energy;
    result.iterations.back() = own;
  }
  own.energy = result.energy;
  Answer answer;
  if (problem_.variables() > 0)
    answer.directive = note(problem_, own, step.outcome, phase_, record_);
  const DomainChange change = problem_.adapt(step);
  if (change == DomainChange::Structure || change == DomainChange::Deferred ||
      (!moved && change == DomainChange::Values))
    answer.since = StoppingTest::Since::ProblemChanged;
  bool is_renewed = change == DomainChange::Values;
  if (change == DomainChange::Structure) {
    problem_.rebuild();
    is_renewed = true;
  } else if (problem_.follow()) {
    is_renewed = true;
  }
  if (is_renewed) follow_problem();
  return answer;
}

// Returns the weights of the faces of a start whose mean density is soft_start or more (a Tutte map
// with nearly degenerate triangles); none for other starts. The square
// root is concave, so weights 1 / sqrt(density) give a linear majorizer of it. Each step on the
// reweighted energy therefore decreases sum A sqrt(density).
std::optional<Vec> soft_weights(const DegreeProblem& problem) {
  const Vec energy = problem.energy_by_face();
  const Vec& measure = problem.setup().map.rest->measure;
  const Partition& partition = problem.partition();
  const double all = partition.sum(energy.sum());
  if (!(all >= problem.setup().rules.soft_start * partition.sum(measure.sum())) ||
      !partition.all(energy.allFinite()))
    return {};
  return energy.cwiseQuotient(measure).cwiseSqrt().cwiseInverse();
}

// A descent whose every step uses the face weights of the last point; it ends when no face is
// stiff.
class SoftStart final : public MapDescent {
 public:
  SoftStart(DegreeProblem& problem, RunRecord& record)
      : MapDescent(problem, Phase::SoftStart, record) {}

  // Sets the weights. Returns whether any face is stiff.
  bool weigh() {
    std::optional<Vec> weight = soft_weights(problem_);
    if (!weight) return false;
    problem_.weigh_faces(*std::move(weight));
    follow_problem();
    result.energy = energy - problem_.foreign_energy();
    return true;
  }
  Answer after_step(const StepResult& step) override {
    Answer answer = MapDescent::after_step(step);
    if (!weigh()) answer.directive = Directive::Interrupt;  // ends this descent only
    return answer;
  }
};

}  // namespace

StoppingRules unlimited_rules(const DegreeSetup& setup, double relative_decrease) {
  StoppingRules rules = setup.rules.stopping;
  rules.relative_decrease = relative_decrease;
  rules.last_factor = rules.plateau_factor = std::numeric_limits<double>::infinity();
  rules.max_iterations = std::numeric_limits<int>::max();
  return rules;
}

StoppingRules final_rules(const DegreeProblem& problem) {
  const DegreeSetup& setup = problem.setup();
  StoppingRules rules = unlimited_rules(setup, setup.solve.tolerance);
  rules.last_factor = setup.rules.stopping.last_factor;
  rules.plateau_factor = setup.rules.stopping.plateau_factor;
  // A higher degree starts near the minimum of the lower one, where the Hessian is hardly ever that
  // of a saddle. A run that converges therefore takes its last steps on a kept factor, without an
  // attempt of the exact Hessian, which costs as much as several of them.
  if (problem.space()->degree() > 1) {
    rules.tail_factor = std::min(rules.tail_factor, rules.last_factor);
    rules.tail_steps = 1;
  }
  return problem.domain().final_rules(rules);
}

MapDescentResult descend(DegreeProblem& problem, StoppingRules rules, Phase phase,
                         RunRecord& record) {
  rules.max_iterations = std::min(rules.max_iterations, record.iterations_left());
  MapDescent descent(problem, phase, record);
  SolveResult& result = descent.result;
  std::optional<double> start_energy;
  try {
    problem.follow();
    result.y = problem.reduced();
    problem.move_to(result.y);
    if (!check_start(problem.evaluator(), result)) {
      const double energy = result.energy;
      return {std::move(result), energy};
    }
    descent.energy = result.energy;
    result.energy -= problem.foreign_energy();
    start_energy = result.energy;
    problem.stepper().descend(descent, rules);
  } catch (const Stopped& stop) {
    result = stopped(std::move(result), stop.why());
  }
  result.y = problem.reduced();
  const double end_energy = result.energy;
  return {std::move(result), start_energy.value_or(end_energy)};
}

SolveResult approach(DegreeProblem& problem, double tolerance, Phase phase, RunRecord& record) {
  StoppingRules rules = unlimited_rules(problem.setup(), tolerance);
  rules.stall_decrement = std::numeric_limits<double>::infinity();
  return descend(problem, rules, phase, record).result;
}

void take_soft_steps(DegreeProblem& problem, RunRecord& record) {
  problem.move_to(problem.reduced());
  if (record.directive() != Directive::Continue) return;
  SoftStart descent(problem, record);
  if (!descent.weigh()) return;
  problem.stepper().descend(descent, brief_rules(record.iterations_left(), kAnyDecrease));
  problem.weigh_faces({});
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
