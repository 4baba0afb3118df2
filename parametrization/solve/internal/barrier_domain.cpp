#include "majorant/parametrization/solve/internal/barrier_domain.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "majorant/framework/stopwatch.h"

namespace majorant {
namespace {

// The sum of the weights stands for the mean density. A mean above this multiple of it, as on the
// way from a distant start, replaces it.
constexpr double kUsualDensity = 4;
// A weight is kept while it is within this factor of its aim.
constexpr double kSameWeight = 2;
// The image rests at decreases of this multiple of the requested tolerance, or earlier, so that
// small steps do not end the run before.
constexpr double kRestBeforeEnd = 100;
// The boundary is crowded if there are more pairs than this multiple of its edges.
constexpr Index kMostPairs = 8;

double weight_of_energies(const MapSpecification& map) {
  double sum = 0;
  for (const WeightedEnergy& energy : map.energy) sum += energy.weight;
  return sum;
}

// all, some: rows in increasing order.
bool contains(const Cells& all, const Cells& some) {
  Index k = 0;
  for (const auto& pair : some.rowwise()) {
    while (k < all.rows() && all.row(k) != pair) ++k;
    if (k == all.rows()) return false;
  }
  return true;
}

}  // namespace

BarrierDomain::BarrierDomain(const BezierMap& start, double scale, const SolverRules& rules)
    : rules_(rules.boundary),
      edges_(std::make_shared<const BoundaryEdges>(start, scale)),
      simple_(std::make_shared<const SimpleBoundary>(edges_, start)),
      faces_(start.space().element_count()),
      large_(rules.scaffold.patient_faces),
      rests_below_(rules_.rests_below) {}

MapProblem BarrierDomain::build(const MapSpecification& map,
                                const std::shared_ptr<const BezierTriangleSpace>& space,
                                VecIn start, const DensityTerms& terms,
                                const std::shared_ptr<const LocalInjectivity>& injectivity,
                                VecIn x) {
  const AddedSeconds time(seconds_);
  const auto& [reach, weight] = rests_ ? rules_.at_rest : rules_.moving;
  ProblemBuilder builder(2 * space->node_count());
  MapTerms ids = add_map(builder, map, space, start, terms, injectivity);
  pairs_ = edges_->near_pairs(x, reach, rules_.listed);
  barrier_.reset();
  weight_.reset();
  usual_weight_ = weight_of_energies(map);
  strength_ = weight / whole_area(map);
  if (pairs_.rows() > 0) barrier_ = builder.add(edges_->barrier(pairs_, reach), 1.0);
  builder.add(simple_);
  builder.add(FixedPoints::at(gauge_vertices(map, *space), start));
  built_ = built_ ? builder.build(*built_) : builder.build();
  return {std::move(ids), *built_};
}

// The forces of the energies grow with their densities, and the barrier with them.
TermChanges BarrierDomain::before_step(const MapProblem& built, VecIn x) {
  if (!barrier_) return {};
  const AddedSeconds time(seconds_);
  double mean = 0;
  for (const TermId id : built.energies) mean += term_energy(built.problem, id, x);
  if (!std::isfinite(mean)) mean = 0;  // on the way from a start of infinite energy
  const double aim = strength_ * std::max(usual_weight_, mean / kUsualDensity);
  if (weight_ && aim <= kSameWeight * *weight_ && *weight_ <= kSameWeight * aim) return {};
  weight_ = aim;
  return {{*barrier_, TermChange{.weight = aim}}};
}

bool BarrierDomain::rests(const StepResult& step) const {
  if (step.outcome != StepResult::Outcome::Moved) return true;
  return step.record.step_bound >= rules_.short_bound &&
         step.record.relative_decrease < rests_below_;
}

DomainChange BarrierDomain::after_step(Vec& x, const StepResult& step, int) {
  const AddedSeconds time(seconds_);
  const bool yields = !rests_ && rests(step);
  rests_ = rests_ || yields;
  return yields || !fits(x) ? DomainChange::Structure : DomainChange::None;
}

bool BarrierDomain::is_crowded(VecIn x) const {
  return edges_->near_pairs(x, rules_.moving.reach, rules_.listed).rows() >
         kMostPairs * edges_->edge_count();
}

bool BarrierDomain::fits(VecIn x) const {
  const BarrierReach& reach = (rests_ ? rules_.at_rest : rules_.moving).reach;
  return contains(pairs_, edges_->near_pairs(x, reach));
}

double BarrierDomain::foreign_energy(const Problem& problem, VecIn x) const {
  return barrier_ ? term_energy(problem, *barrier_, x) : 0;
}

StoppingRules BarrierDomain::final_rules(StoppingRules usual) {
  rests_below_ = std::max(rules_.rests_below, kRestBeforeEnd * usual.relative_decrease);
  usual.relative_decrease *= rules_.part_of_tolerance;
  usual.tail_steps = 1;
  return usual;
}

LaggedFactorRules BarrierDomain::lagged(LaggedFactorRules usual) const {
  usual.below = std::min(usual.below, rules_.lagged_below);
  return usual;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
