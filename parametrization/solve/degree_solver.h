// The optimization at one degree: Newton on a fixed space, on whatever domain, with quadrature that
// is refined where it must be and the remedies for stalls at the limit of the feasible set.
//
//     DegreeSolver solver(setup, domain, map.shared_space(), map.control_points());
//     solver.soft_start(record);
//     SolveResult solved = solver.finish(record);
//     map = map.with(map.shared_space(), solver.x());
//
// Internal to parametrize(). Coordinates are normalised (see NormalizedStart). Whatever is stopped,
// x() is the best point reached, and the domain's surroundings belong to it. Where the map is in
// parts (MapSpecification::part) setup.stop never stops, and the record agrees with the others'.
//
// internal/degree_problem.h has the problem and the point, map_descent.h its steps,
// stall_remedies.h what is done about stalls, bounded_descent.h bounds with a barrier.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "majorant/framework/run_record.h"
#include "majorant/parametrization/solve/internal/degree_problem.h"
#include "majorant/parametrization/solve/internal/stall_remedies.h"

namespace majorant {

class DegreeSolver {
 public:
  using Setup = DegreeSetup;

  // Together with x() the state from which another solver of the same degree goes on. Newton's
  // method learns again what it has learned of late.
  struct State {
    bool soft_started = false;        // soft_start() is through
    int stalls = 0, refinements = 0;  // remedies tried, times the quadrature was refined
    bool barrier_followed = false;
    int depth = 0;               // of certificates
    std::vector<RuleId> levels;  // of quadrature, by face; empty: the lowest
    RemedyUses remedies{};
  };

  // Throws and keeps its arguments as DegreeProblem does.
  DegreeSolver(const Setup& setup, MapDomain& domain,
               std::shared_ptr<const BezierTriangleSpace> space, const Vec& x)
      : problem_(setup, domain, std::move(space), x) {}

  // Takes the soft steps of map_descent.h.
  void soft_start(RunRecord& record);
  // Descends until one iteration decreases the energy by less than `tolerance`, without remedies:
  // for degrees on the way.
  SolveResult approach(double tolerance, RunRecord& record, Phase phase = Phase::Newton);
  // Descends to the documented stopping rules, with all remedies.
  SolveResult finish(RunRecord& record);
  // None on the way around a stall: that leads on from x(), or back to where it began. May be
  // called by setup.watch.
  std::optional<State> state() const;
  // Called before any step. Throws InvalidArgument for levels that the setup's quadrature does not
  // have.
  void resume(State state);
  // The record of a step from here, for its cost; the step is not taken, and in no trace.
  IterationRecord try_step();

  Vec x() const { return problem_.x(); }
  GlobalIndex variables() const { return problem_.variables(); }
  double constraint_residual() const { return problem_.constraint_residual(); }
  const RemedyUses& remedies() const { return remedies_.uses; }
  // Faces proven injective, by depth of bisection, in all checks so far.
  std::vector<long> proven() const { return problem_.proven(); }

 private:
  DegreeProblem problem_;
  RemedyState remedies_;
  bool soft_started_ = false;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
