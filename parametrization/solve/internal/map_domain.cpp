#include "majorant/parametrization/solve/internal/map_domain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "majorant/framework/problem.h"
#include "majorant/framework/stopwatch.h"

namespace majorant {
ScaffoldedDomain::ScaffoldedDomain(const BezierMap& start, ScaffoldFlips flips,
                                   const SolverRules& rules, const StopCheck& stop)
    : map_faces_(start.space().element_count()),
      scaffold_([&] {
        const AddedSeconds time(seconds_);
        return Scaffold(start.shared_space(), start.control_points());
      }()),
      mode_(flips),
      rules_(rules.scaffold),
      served_below_(rules.lagged.below),
      relaxing_(newton_options(Curvature::Projected, rules, stop, {.ordering = Ordering::Amd})),
      share_(rules_.share) {
  // All relaxations share a solver: patterns differ little, and it reuses the last ordering.
  const std::shared_ptr<LinearSolver> solver = make_direct_solver({.ordering = Ordering::Amd});
  relaxing_.linear_solver = [solver] { return solver; };
}

MapProblem ScaffoldedDomain::build(const MapSpecification& map,
                                   const std::shared_ptr<const BezierTriangleSpace>& space,
                                   VecIn start, const DensityTerms& terms,
                                   const std::shared_ptr<const LocalInjectivity>& injectivity,
                                   VecIn x) {
  const AddedSeconds time(seconds_);
  ProblemBuilder builder(2 * scaffold_.joint_node_count());
  MapTerms ids = add_map(builder, map, space, start, terms,
                         std::make_shared<const ScaffoldInjectivity>(
                             injectivity, map_faces_,
                             std::make_shared<const LocalInjectivity>(
                                 scaffold_.space(), Vec::Ones(scaffold_.face_count()),
                                 depth(injectivity->max_depth()), relaxing_.stop)));
  TermState around;
  around.element_rule = scaffold_.levels();
  around_ = builder.add(scaffold_.energy_term(), around);
  builder.add(FixedPoints::at(scaffold_.frame_nodes(), x));
  lambda_.reset();
  built_ = built_ ? builder.build(*built_) : builder.build();
  return {std::move(ids), *built_};
}

TermChanges ScaffoldedDomain::before_step(const MapProblem& built, VecIn x) {
  const AddedSeconds time(seconds_);
  double mean = 0;
  for (const TermId id : built.energies) mean += term_energy(built.problem, id, x);
  if (!std::isfinite(mean)) mean = 0;  // on the way from a start of infinite energy
  TermState around = built.problem.state(*around_);
  const double share = stage_ == Stage::AtRest ? rules_.share_at_rest : share_;
  const double lambda = share * std::max(mean, rules_.least_energy) * around.weight /
                        term_energy(built.problem, *around_, x);
  if (lambda_ && std::abs(lambda - *lambda_) <= rules_.same_lambda * lambda) return {};
  lambda_ = lambda;
  around.weight = lambda;
  around.element_rule = scaffold_.levels();
  return {{*around_, std::move(around)}};
}

double ScaffoldedDomain::foreign_energy(const Problem& problem, VecIn x) const {
  return term_energy(problem, *around_, x);
}

// Enlarges, flips and relaxes the scaffold.
DomainChange ScaffoldedDomain::after_step(Vec& x, const StepResult& step, int of_map) {
  const AddedSeconds time(seconds_);
  scaffold_.take(x);
  if (refine(step.blocking)) lambda_.reset();
  if (rests(step)) stage_ = Stage::AtRest;
  if (waits(step)) return DomainChange::Deferred;
  const bool grown = scaffold_.grow();
  FlipCounts counts = flip();
  const bool relaxed = grown || needs_relaxing(step.record, counts);
  if (relaxed) {
    scaffold_.relax(rules_.relax_steps, depth(of_map), relaxing_);
    const FlipCounts more = flip();
    counts.intended += more.intended;
    counts.performed += more.performed;
  }
  flips_.intended += counts.intended;
  flips_.performed += counts.performed;
  x = scaffold_.joined(x);
  if (grown || counts.performed > 0) return DomainChange::Structure;
  return relaxed ? DomainChange::Values : DomainChange::None;
}

// Returns whether the scaffold is left unchanged, so that the factor of the last step may serve the
// next one.
bool ScaffoldedDomain::waits(const StepResult& step) {
  const bool may_wait =
      map_faces_ >= rules_.patient_faces && step.blocking.empty() &&
      step.outcome == StepResult::Outcome::Moved && step.record.step_bound >= rules_.short_bound &&
      step.record.relative_decrease < served_below_ && step.record.relative_decrease > ends_below_;
  if (may_wait && waited_ < rules_.patience) {
    ++waited_;
    return true;
  }
  waited_ = 0;
  return false;
}

// A step also moves the scaffold's nodes, which keeps their triangles in shape as long as they have
// room.
bool ScaffoldedDomain::needs_relaxing(const IterationRecord& step, const FlipCounts& flips) const {
  return step.step_bound < rules_.short_bound ||
         (flips.performed > 0 && step.relative_decrease < rules_.still_moving);
}

// Returns whether the image rests. False while a stronger scaffold is followed, whose purpose is to
// leave places where the image rests.
bool ScaffoldedDomain::rests(const StepResult& step) const {
  return stage_ == Stage::Moving && share_ == rules_.share &&
         step.outcome == StepResult::Outcome::Moved &&
         step.record.step_bound >= rules_.short_bound &&
         step.record.relative_decrease < rules_.at_rest;
}

// Refines the quadrature of scaffold faces that block a step, since their rule does not sample the
// barrier.
bool ScaffoldedDomain::refine(const std::vector<Index>& blocking) {
  std::vector<Index> faces;
  for (const Index e : blocking)
    if (e >= map_faces_) faces.push_back(e - map_faces_);
  scaffold_.refine(faces);
  return !faces.empty();
}

FlipCounts ScaffoldedDomain::flip() {
  return mode_ == ScaffoldFlips::Performed ? scaffold_.flip() : FlipCounts{};
}

bool ScaffoldedDomain::strengthen(double weight) {
  const double share = std::max(rules_.share, weight);
  lambda_.reset();
  if (stage_ == Stage::AtRest) stage_ = Stage::Moving;
  return std::exchange(share_, share) != share;
}

bool ScaffoldedDomain::hold() {
  if (stage_ != Stage::AtRest) return false;
  stage_ = Stage::Held;
  return true;
}

StoppingRules ScaffoldedDomain::final_rules(StoppingRules usual) {
  usual.relative_decrease *= rules_.part_of_tolerance;
  ends_below_ = usual.relative_decrease;
  usual.tail_steps = rules_.tail_steps;
  // The decrement of the sum does not bound the remaining decrease of the map's energy, which
  // lambda follows.
  usual.last_factor = std::numeric_limits<double>::infinity();
  return usual;
}

void ScaffoldedDomain::elevate(const std::shared_ptr<const BezierTriangleSpace>& higher) {
  const AddedSeconds time(seconds_);
  stage_ = Stage::Moving;
  scaffold_ = scaffold_.elevated(higher);
}

void ScaffoldedDomain::restore(const std::optional<Scaffold>& scaffold) {
  if (scaffold) scaffold_ = *scaffold;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
