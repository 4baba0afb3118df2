#include "majorant/parametrization/solve/internal/degree_problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "majorant/framework/energy_term.h"
#include "majorant/framework/error.h"
#include "majorant/framework/problem.h"
#include "majorant/framework/stopwatch.h"
#include "majorant/parametrization/solve/internal/start_on_constraints.h"

namespace majorant {
namespace {

// Returns the solver that the options make for this problem; the stepper's constructor calls it.
SolverFactory solver_of(const SolveOptions& options, const Problem& problem,
                        const DirectSolverOptions& direct) {
  if (!options.linear_solver) return {};
  return [&options, &problem, direct] { return options.linear_solver(problem.pattern(), direct); };
}

BarrierProblem::Bounds bounds_of(const std::shared_ptr<const MapExtension>& added) {
  BarrierProblem::Bounds bounds;
  if (added)
    for (const auto& checker : added->checkers())
      if (auto bound = std::dynamic_pointer_cast<const BarrierChecker>(checker))
        bounds.push_back(std::move(bound));
  return bounds;
}

// Returns the parts that were prepared for a solve from x; null if there are none.
std::shared_ptr<PreparedParts> prepared_for(MapDomain& domain, const BezierTriangleSpace& space,
                                            const Vec& x) {
  std::shared_ptr<PreparedParts> prepared = domain.take_prepared();
  return prepared && prepared->fits(space, x) ? prepared : nullptr;
}

// The map's energy keeps its weight, so that scaffold, rules and trace remain valid.
double weight_beside_map(const BarrierStage::Bound& bound, const BarrierStage& stage) {
  return bound.weight / stage.energy;
}

void require_curvature(const MapExtension& added, const BarrierProblem::Bounds& bounds,
                       Curvature model) {
  const auto require = [model](const EnergyTerm& term) {
    if (!term.supports(model))
      throw InvalidArgument(
          fmt::format("term '{}' has no curvature model '{}'", term.name(), curvature_name(model)));
  };
  for (const auto& one : added.terms()) require(*one.term);
  for (const auto& bound : bounds) {
    require(*bound->barrier());
    if (const auto* measure = dynamic_cast<const ViolationMeasure*>(bound.get()))
      require(*measure->violation(0));
  }
}

}  // namespace

DegreeProblem::DegreeProblem(const DegreeSetup& setup, MapDomain& domain,
                             std::shared_ptr<const BezierTriangleSpace> space, const Vec& x)
    : DegreeProblem(setup, domain, space, x, {bounds_of(setup.map.added), {}},
                    prepared_for(domain, *space, x)) {}

DegreeProblem::DegreeProblem(const DegreeSetup& setup, MapDomain& domain,
                             std::shared_ptr<const BezierTriangleSpace> space, const Vec& x,
                             DegreeBounds bounds)
    : DegreeProblem(setup, domain, std::move(space), x, std::move(bounds), nullptr) {}

DegreeProblem::DegreeProblem(const DegreeSetup& setup, MapDomain& domain,
                             std::shared_ptr<const BezierTriangleSpace> space, const Vec& x,
                             DegreeBounds bounds, std::shared_ptr<PreparedParts> prepared)
    : setup_(setup),
      domain_(domain),
      space_(std::move(space)),
      start_(x),
      levels_(optimizer_quadrature(space_->degree(), setup.solve.quadrature_points,
                                   setup.rules.quadrature),
              space_->element_count()),
      terms_(prepared ? prepared->terms : energy_terms(setup.map, space_, levels_.rules())),
      depth_(setup.solve.injectivity_depth),
      injectivity_(prepared ? prepared->injectivity
                            : std::make_shared<const LocalInjectivity>(
                                  space_, 2 * setup.map.rest->measure, depth_, setup.stop)),
      x_(domain.unknowns(x)),
      bounds_(std::move(bounds)),
      built_([&] {
        require_curvature(terms_, setup.solve.curvature.model);
        if (setup.map.added)
          require_curvature(*setup.map.added, bounds_.all, setup.solve.curvature.model);
        setup.stop.poll();
        MapProblem built = prepared ? prepared->built : build();
        setup.stop.poll();  // the analysis of the pattern follows
        return built;
      }()),
      stepper_(built_.problem, [&] {
        const DirectSolverOptions direct{.ordering = domain.ordering(),
                                         .analysis = prepared ? prepared->analysis : nullptr};
        NewtonOptions options =
            newton_options(setup.solve.curvature, setup.rules, setup.stop, direct,
                           solver_of(setup.solve, built_.problem, direct));
        options.lagged = domain.lagged(options.lagged);
        return options;
      }()) {
  if (setup.map.added && !setup.map.added->constraints().empty())
    x_ = start_on_constraints(built_.problem, space_, *injectivity_, setup.map.seams, x_);
}

// Builds the problem with the barriers that replace the bounds, as checks and as terms.
MapProblem DegreeProblem::build() {
  const auto in = [this](const MapSpecification& map) {
    return domain_.build(map, space_, start_, terms_, injectivity_, x_);
  };
  if (bounds_.all.empty()) return in(setup_.map);
  const BarrierStage& stage = bounds_.stage;
  std::vector<std::shared_ptr<const FeasibilityChecker>> checkers;
  for (const auto& checker : setup_.map.added->checkers())
    if (!std::dynamic_pointer_cast<const BarrierChecker>(checker)) checkers.push_back(checker);
  for (const auto& instead : stage.bounds)
    if (instead.checker) checkers.push_back(instead.checker);
  MapExtension added = setup_.map.added->with(std::move(checkers));
  for (const auto& instead : stage.bounds)
    added.add(instead.term, weight_beside_map(instead, stage));
  MapSpecification map = setup_.map;
  map.added = std::make_shared<const MapExtension>(std::move(added));
  return in(map);
}

// The barriers are the terms that were added last.
std::span<const TermId> DegreeProblem::barriers() const {
  return std::span(built_.added).last(bounds_.stage.bounds.size());
}

double DegreeProblem::constraint_residual() const {
  double residual = 0;
  built_.problem.reduce(x_, &residual);
  return residual;
}

std::vector<long> DegreeProblem::proven() const {
  std::vector<long> counts(to_size(std::clamp(depth_, 0, LocalInjectivity::kMaxDepth)) + 1);
  add_counts(counts, stepper_.evaluator().counters().proven);
  add_counts(counts, proven_elsewhere_);
  return counts;
}

void DegreeProblem::add_proven(const std::vector<long>& counts) {
  add_counts(proven_elsewhere_, counts);
}

void DegreeProblem::rebuild() {
  built_ = build();
  renew_states();
  Stopwatch analysis;
  stepper_.reset(built_.problem);
  domain_.charge(analysis.restart());
}

void DegreeProblem::renew() {
  renew_states();
  stepper_.reset(built_.problem);
}

void DegreeProblem::renew_states() {
  built_.problem = built_.problem.with(
      energy_states(setup_.map, built_.energies, levels_.of_faces(), face_weight_));
  follow_states();
}

// Changes the problem without telling the stepper. Returns whether anything changed.
bool DegreeProblem::follow_states() {
  TermChanges changes = domain_.before_step(built_, x_);
  if (changes.empty()) return false;
  built_.problem = built_.problem.with(std::move(changes));
  return true;
}

bool DegreeProblem::follow() {
  if (!follow_states()) return false;
  stepper_.reset(built_.problem);
  return true;
}

void DegreeProblem::return_to(const Checkpoint& checkpoint) {
  x_ = checkpoint.x;
  if (!checkpoint.surroundings && domain_.fits(x_)) return;
  domain_.restore(checkpoint.surroundings);
  rebuild();
}

double DegreeProblem::own_energy(VecIn x) const {
  return energy_of_map(setup_.map, terms_, levels_.of_faces(), x.head(2 * space_->node_count()));
}

double DegreeProblem::foreign_energy() const {
  double sum = domain_.foreign_energy(built_.problem, x_);
  for (const TermId id : barriers()) sum += term_energy(built_.problem, id, x_);
  return sum;
}

Vec DegreeProblem::energy_by_face() const {
  return majorant::energy_by_face(setup_.map, terms_, levels_.of_faces(), x());
}

void DegreeProblem::set_depth(int depth) {
  depth_ = depth;
  injectivity_ = std::make_shared<const LocalInjectivity>(space_, 2 * setup_.map.rest->measure,
                                                          depth_, setup_.stop);
  rebuild();
}

void DegreeProblem::set_levels(std::vector<RuleId> levels) {
  levels_.set(std::move(levels));
  renew();
}

bool DegreeProblem::refine(const std::vector<Index>& faces) {
  if (!partition().any(levels_.refine(faces))) return false;
  renew();
  return true;
}

bool DegreeProblem::refine_inaccurate() {
  if (setup_.solve.quadrature_points > 0) return false;
  const bool refined = levels_.refine_inaccurate(setup_.map, terms_, x(),
                                                 setup_.rules.quadrature.error, setup_.stop);
  if (refined) renew();
  return refined;
}

void DegreeProblem::weigh_faces(Vec weight) {
  face_weight_ = std::move(weight);
  renew();
}

void DegreeProblem::enter(const BarrierStage& stage) {
  const auto same = [](const BarrierStage::Bound& a, const BarrierStage::Bound& b) {
    return a.checker == b.checker && a.checker;
  };
  const BarrierStage last = std::exchange(bounds_.stage, stage);
  if (!std::equal(last.bounds.begin(), last.bounds.end(), stage.bounds.begin(), stage.bounds.end(),
                  same))
    return rebuild();
  TermChanges changes;
  for (std::size_t k = 0; k < stage.bounds.size(); ++k)
    changes.emplace_back(barriers()[k],
                         TermChange{.weight = weight_beside_map(stage.bounds[k], stage)});
  built_.problem = built_.problem.with(std::move(changes));
  stepper_.reset(built_.problem);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
