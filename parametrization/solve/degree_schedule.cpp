#include "majorant/parametrization/solve/degree_schedule.h"

#include <fmt/format.h>

#include <utility>

#include "majorant/maps/map_part.h"

namespace majorant {
namespace {

bool was_limited(Status s) { return s != Status::Converged && s != Status::Stalled; }

}  // namespace

DegreeSchedule::DegreeSchedule(const DegreeSolver::Setup& setup, MapDomain& domain, BezierMap map,
                               int degree, RunRecord& record,
                               std::function<void(const BezierMap&)> prepare)
    : setup_(setup),
      domain_(domain),
      map_(std::move(map)),
      degree_(degree),
      record_(record),
      prepare_(std::move(prepare)) {}

std::optional<DegreeSchedule::State> DegreeSchedule::state() const {
  return solver_ ? solver_->state() : state_.value_or(State());
}

void DegreeSchedule::enter() {
  entering_ = true;
  try {
    minimize_gentle_energy();
  } catch (const Stopped&) {  // the next solve stops too
  }
  entering_ = record_.directive() != Directive::Continue;
}

// Minimizes the symmetric Dirichlet energy, which is finite on every injective map. A stop ends it
// with the best map so far.
void DegreeSchedule::minimize_gentle_energy() {
  domain_.take_prepared();  // of the other energy
  DegreeSolver::Setup gentle = setup_;
  gentle.map.energy = {{symmetric_dirichlet(), 1.0}};
  gentle.solve.curvature = Curvature::Projected;
  const QuadratureLevels levels(
      optimizer_quadrature(1, setup_.solve.quadrature_points, setup_.rules.quadrature),
      map_.space().element_count());
  const DensityTerms terms = energy_terms(setup_.map, map_.shared_space(), levels.rules());
  gentle.requested_energy = [&](VecIn x) {
    return energy_of_map(setup_.map, terms, levels.of_faces(), x);
  };
  DegreeSolver solver(gentle, domain_, map_.shared_space(), map_.control_points());
  solver.soft_start(record_);
  solver.approach(setup_.solve.elevation_tolerance, record_, Phase::Entry);
  add_counts(counts_.injectivity_tests, solver.proven());
  map_ = map_.with(map_.shared_space(), solver.x());
}

SolveResult DegreeSchedule::raise_degree(double energy) {
  SolveResult solved;
  solved.energy = energy;
  try {
    for (;;) {
      if (const Directive why = record_.directive(); why != Directive::Continue)
        return stopped(std::move(solved), why);
      if (is_last() || setup_.solve.elevation == Elevation::Incremental) {
        solved = optimize();
        if (was_limited(solved.status)) return solved;
      }
      if (is_last()) return solved;
      elevate();
    }
  } catch (const Stopped& stop) {  // between two solves
    solver_ = nullptr;
    return stopped(std::move(solved), stop.why());
  }
}

SolveResult DegreeSchedule::optimize() {
  if (prepare_) prepare_(map_);
  DegreeSolver solver(setup_, domain_, map_.shared_space(), map_.control_points());
  solver_ = &solver;
  if (state_) solver.resume(*std::exchange(state_, std::nullopt));
  solver.soft_start(record_);
  SolveResult solved = is_last() ? solver.finish(record_)
                                 : solver.approach(setup_.solve.elevation_tolerance, record_);
  solver_ = nullptr;
  add_counts(counts_.injectivity_tests, solver.proven());
  counts_.remedies = solver.remedies();
  counts_.variables = solver.variables();
  counts_.constraint_residual = solver.constraint_residual();
  if (was_limited(solved.status)) state_ = solver.state();
  map_ = map_.with(map_.shared_space(), solver.x());  // the solver's start is overwritten
  return solved;
}

void DegreeSchedule::elevate() {
  record_.announce(fmt::format("raising the degree to {}", map_.degree() + 1));
  map_ = as_owners_have_it(setup_.map, map_.elevated());
  domain_.elevate(map_.shared_space());
}

void DegreeSchedule::elevate_to_last() {
  while (map_.degree() < degree_) elevate();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
