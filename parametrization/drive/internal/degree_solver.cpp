#include "majorant/parametrization/drive/internal/degree_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/framework/evaluator.h"
#include "majorant/framework/internal/diagnosis.h"
#include "majorant/framework/internal/stopwatch.h"
#include "majorant/parametrization/drive/internal/meet_constraints.h"
#include "majorant/parametrization/drive/internal/solver_rules.h"

namespace majorant {
namespace {

// As the options make it for this problem; called by the constructor of the stepper alone.
SolverFactory solver_of(const SolveOptions& options, const Problem& problem, Ordering ordering) {
  if (!options.linear_solver) return {};
  return
      [&options, &problem, ordering] { return options.linear_solver(problem.pattern(), ordering); };
}

}  // namespace

DegreeSolver::DegreeSolver(const Setup& setup, MapDomain& domain,
                           std::shared_ptr<const BezierTriangleSpace> space, const Vec& x)
    : setup_(setup),
      domain_(domain),
      space_(std::move(space)),
      start_(x),
      levels_(
          optimizer_ladder(space_->degree(), setup.solve.quadrature_points, setup.rules.quadrature),
          space_->element_count()),
      terms_(energy_terms(setup.map, space_, levels_.rules())),
      depth_(setup.solve.injectivity_depth),
      injectivity_(std::make_shared<const LocalInjectivity>(space_, 2 * setup.map.rest.measure,
                                                            depth_, setup.stop)),
      element_weight_(Vec::Ones(space_->element_count())),
      x_(domain.unknowns(x)),
      added_(setup.added),
      built_([&] {
        require_curvature(terms_, setup.solve.curvature);
        added_.require_curvature(setup.solve.curvature);
        setup.stop.poll();
        DomainProblem built = domain.build(input(), x_);
        setup.stop.poll();  // what follows is the analysis of its pattern
        return built;
      }()),
      stepper_(built_.problem,
               newton_options(setup.solve.curvature, setup.rules, setup.stop, domain.ordering(),
                              solver_of(setup.solve, built_.problem, domain.ordering()))) {
  if (added_.constrained()) meet_added_constraints();
}

DomainInput DegreeSolver::input() const {
  return {setup_.map, space_, start_, terms_, injectivity_, depth_, added_, setup_.stop};
}

// What was added may hold nowhere yet.
void DegreeSolver::meet_added_constraints() {
  x_ = majorant::meet_constraints(built_.problem, *space_, x_);
  const Verdict faces = injectivity_->check(x());
  if (!faces.feasible)
    throw Error(ErrorKind::Infeasible,
                fmt::format("degree {}: the start, moved to where it satisfies the added "
                            "constraints, is not injective: face {} ({} in all) is not positively "
                            "oriented; bring a start that satisfies them",
                            space_->degree(), faces.blocking.front(), faces.blocking.size()));
  if (!AngleSums(space_, AngleSums::Vertices::Interior, setup_.map.seams).check(x()).feasible)
    throw Error(ErrorKind::Infeasible,
                fmt::format("degree {}: the start, moved to where it satisfies the added "
                            "constraints, covers a place more than once; bring a start that "
                            "satisfies them",
                            space_->degree()));
}

double DegreeSolver::constraint_residual() const {
  double residual = 0;
  built_.problem.reduce(x_, &residual);
  return residual;
}

std::vector<long> DegreeSolver::proven() const {
  std::vector<long> counts(at(std::clamp(depth_, 0, LocalInjectivity::kMaxDepth)) + 1);
  add_counts(counts, stepper_.evaluator().counters().proven);
  add_counts(counts, proven_inside_);
  return counts;
}

void DegreeSolver::rebuild() {
  built_ = domain_.build(input(), x_);
  renew_states();
  Stopwatch analysis;
  stepper_.reset(built_.problem);
  domain_.charge(analysis.restart());
}

void DegreeSolver::apply_state() {
  renew_states();
  stepper_.reset(built_.problem);
}

void DegreeSolver::renew_states() {
  built_.problem = built_.problem.with(
      energy_states(setup_.map, built_.energies, levels_.of_faces(), element_weight_));
  follow();
}

// Whether the domain has states that follow x; the stepper does not know them yet.
bool DegreeSolver::follow() {
  TermChanges changes = domain_.before_step(built_, x_);
  if (changes.empty()) return false;
  built_.problem = built_.problem.with(std::move(changes));
  return true;
}

void DegreeSolver::return_to(const Place& place) {
  x_ = place.x;
  if (!place.surroundings) return;
  domain_.restore(place.surroundings);
  rebuild();
}

// Of the map alone, on the rules of now, all elements with their full weight, and what was added.
double DegreeSolver::own_energy(VecIn x) const {
  const Vec map = x.head(2 * space_->node_count());
  return energy_of_map(setup_.map, terms_, levels_.of_faces(), map) + added_.energy(map);
}

// What the problem's energy at x_ has that nobody asked for.
double DegreeSolver::foreign_energy() const {
  double sum = domain_.foreign_energy(built_.problem, x_);
  for (const TermId id : built_.barriers) sum += term_energy(built_.problem, id, x_);
  return sum;
}

// own: the step's record, of the map alone.
Directive DegreeSolver::note(const IterationRecord& own, StepResult::Outcome outcome,
                             const Rows& rows) const {
  TraceEntry row;
  row.degree = space_->degree();
  row.record = own;
  row.phase = rows.phase;
  row.outcome = outcome;
  row.energy = own.energy;
  if (rows.phase != Phase::Newton)
    row.energy = setup_.asked_energy ? setup_.asked_energy(x()) : own_energy(x_);
  Directive directive = rows.record.note(std::move(row));
  if (setup_.watch) {
    const Directive watched = setup_.watch(rows.record.trace().back(), space_, x());
    if (directive == Directive::Continue) directive = watched;
  }
  return ranks().of_first(directive);
}

// One step and what the domain makes of it; energy: of the problem, result.energy: the map's own.
DegreeSolver::Iteration DegreeSolver::iterate(SolveResult& result, double& energy,
                                              const Rows& rows) {
  Iteration it;
  it.step = stepper_.step(result.y, energy);
  if (it.step.outcome == StepResult::Outcome::Stopped) return it;
  result.newton_decrement = it.step.record.newton_decrement;
  result.blocking = it.step.blocking;
  const bool moved = it.step.outcome == StepResult::Outcome::Moved;
  IterationRecord own = it.step.record;
  if (moved) {
    x_ = built_.problem.expand(result.y);
    own.iteration = static_cast<int>(result.iterations.size()) + 1;
    own.energy = energy - foreign_energy();
    own.relative_decrease = relative_to(result.energy, result.energy - own.energy);
    result.energy = own.energy;
    result.iterations.push_back(own);
  }
  own.energy = result.energy;
  if (built_.problem.partition().global_size() > 0) it.directive = note(own, it.step.outcome, rows);
  DomainChange change = domain_.after_step(x_, it.step, input());
  if (change == DomainChange::Structure || (!moved && change == DomainChange::Values))
    it.since = StoppingTest::Since::ProblemChanged;
  if (change == DomainChange::Structure) {
    rebuild();
  } else if (follow()) {
    stepper_.reset(built_.problem);
    change = DomainChange::Values;
  }
  if (change == DomainChange::None) return it;
  result.y = built_.problem.reduce(x_);
  energy = stepper_.evaluator().value(result.y);
  return it;
}

void DegreeSolver::iterate_until(StoppingTest& test, const Rows& rows, double energy,
                                 SolveResult& result) {
  Place anchor = place();
  double anchor_energy = result.energy;
  std::optional<Stop> stop;
  while (!(stop = test.before_step())) {
    Iteration it = iterate(result, energy, rows);
    if (it.step.outcome == StepResult::Outcome::Breakdown && it.step.why_none.empty())
      it.step.why_none =
          why_no_direction(stepper_.evaluator(), result.y, energy, it.step.record.curvature);
    const Advice advice = test.after(it.step, it.since);
    if ((stop = advice.stop)) break;
    if (advice.polish) stepper_.polish();
    if (advice.anchor) {
      anchor = place();
      anchor_energy = result.energy;
    }
    if (it.directive != Directive::Continue) throw Stopped(it.directive);
  }
  if (stop->at_anchor) {
    return_to(anchor);
    result.energy = anchor_energy;
  }
  result.status = stop->status;
  result.message = std::move(stop->message);
}

// Newton steps until the rules say so, from x_ to x_.
SolveResult DegreeSolver::descend(StoppingRules rules, Phase phase, RunRecord& record) {
  rules.max_iterations = std::min(rules.max_iterations, ranks().of_first(record.iterations_left()));
  SolveResult result;
  try {
    if (follow()) stepper_.reset(built_.problem);
    result.y = built_.problem.reduce(x_);
    x_ = built_.problem.expand(result.y);
    if (!check_start(stepper_.evaluator(), result)) return result;
    const double energy = result.energy;
    result.energy -= foreign_energy();
    began_at_ = result.energy;
    StoppingTest test(rules, energy);
    iterate_until(test, {record, phase}, energy, result);
  } catch (const Stopped& stop) {
    result = stopped(std::move(result), stop.why());
  }
  result.y = built_.problem.reduce(x_);
  return result;
}

void DegreeSolver::soften_start(RunRecord& record) {
  if (softened_) return;
  try {
    soften(record);
    softened_ = ranks().of_first(record.directive()) == Directive::Continue;
  } catch (const Stopped&) {  // so will be what follows
  }
}

void DegreeSolver::soften(RunRecord& record) {
  x_ = built_.problem.expand(built_.problem.reduce(x_));
  if (ranks().of_first(record.directive()) != Directive::Continue) return;
  StoppingTest test(brief_rules(ranks().of_first(record.iterations_left()), kAnyDecrease), 0);
  SolveResult result;
  bool softened = false;
  while (!test.before_step()) {
    const std::optional<Vec> weight =
        soft_weights(energy_by_face(setup_.map, terms_, levels_.of_faces(), x()),
                     setup_.map.rest.measure, setup_.rules.soft_start, ranks());
    if (!weight) break;
    element_weight_ = *weight;
    softened = true;
    apply_state();
    result.y = built_.problem.reduce(x_);
    double energy = stepper_.evaluator().value(result.y);
    result.energy = energy - foreign_energy();
    const Iteration it = iterate(result, energy, {record, Phase::SoftStart});
    if (test.after(it.step, it.since).stop || it.directive != Directive::Continue) break;
  }
  if (!softened) return;
  element_weight_.setOnes();
  apply_state();
}

SolveResult DegreeSolver::approach(double tolerance, RunRecord& record, Phase phase) {
  StoppingRules rules = unlimited(tolerance);
  rules.stall_decrement = std::numeric_limits<double>::infinity();
  return descend(rules, phase, record);
}

// Ended by this decrease of one iteration, be it on a plateau, whatever the next one promises, by
// no number of iterations but the run's.
StoppingRules DegreeSolver::unlimited(double relative_decrease) const {
  StoppingRules rules = setup_.rules.stopping;
  rules.relative_decrease = relative_decrease;
  rules.last_factor = rules.plateau_factor = std::numeric_limits<double>::infinity();
  rules.max_iterations = std::numeric_limits<int>::max();
  return rules;
}

StoppingRules DegreeSolver::final_rules() const {
  StoppingRules rules = unlimited(setup_.solve.tolerance);
  rules.last_factor = setup_.rules.stopping.last_factor;
  rules.plateau_factor = setup_.rules.stopping.plateau_factor;
  return domain_.final_rules(rules);
}

IterationRecord DegreeSolver::try_step() {
  if (follow()) stepper_.reset(built_.problem);
  Vec y = built_.problem.reduce(x_);
  double energy = stepper_.evaluator().value(y);
  return stepper_.step(y, energy).record;
}

std::optional<DegreeSolver::State> DegreeSolver::state() const {
  if (detours_ > 0) return std::nullopt;
  return State{softened_,          tries_.stalls, tries_.refinements, barrier_followed_, depth_,
               levels_.of_faces(), uses_};
}

void DegreeSolver::resume(State state) {
  levels_.set(std::move(state.levels));
  softened_ = state.softened;
  tries_ = {state.stalls, state.refinements};
  barrier_followed_ = state.barrier_followed;
  uses_ = state.remedies;
  if (state.depth > depth_) set_depth(state.depth);
  apply_state();
}

// Refines the elements whose integrals are worst until the rest is within the bound.
bool DegreeSolver::refine_inaccurate() {
  if (setup_.solve.quadrature_points > 0) return false;
  const bool refined = levels_.refine_inaccurate(setup_.map, terms_, x(),
                                                 setup_.rules.quadrature.error, setup_.stop);
  if (refined) apply_state();
  return refined;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
