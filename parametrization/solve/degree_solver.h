// The optimization at one degree: Newton's method on a fixed space and any domain, with quadrature
// that is refined as necessary and remedies for stalls at the boundary of the feasible set.
//
//     DegreeSolver solver(setup, domain, map.shared_space(), map.control_points());
//     solver.soft_start(record);
//     SolveResult solved = solver.finish(record);
//     map = map.with(map.shared_space(), solver.x());
//
// Internal to parametrize(). Coordinates are normalized (see NormalizedStart). After a stop, x() is
// the best point reached, and the domain's surroundings belong to it. If the map is in parts
// (MapSpecification::part), setup.stop never stops, and all ranks' records agree.
//
// internal/degree_problem.h has the problem and the point, map_descent.h its steps,
// stall_remedies.h the remedies for stalls, bounded_descent.h bounds with a barrier.
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

  // The state from which, with x(), another solver of the same degree continues. The recent history
  // of Newton's method is not part of it.
  struct State {
    bool soft_started = false;        // soft_start() is finished
    int stalls = 0, refinements = 0;  // remedies tried, refinements of the quadrature
    bool barrier_followed = false;
    int depth = 0;               // of certificates
    std::vector<RuleId> levels;  // of quadrature, by face; empty: the lowest
    RemedyUses remedies{};
  };

  // Throws the errors of DegreeProblem and keeps references to the same arguments.
  DegreeSolver(const Setup& setup, MapDomain& domain,
               std::shared_ptr<const BezierTriangleSpace> space, const Vec& x)
      : problem_(setup, domain, std::move(space), x) {}

  // Takes the soft steps of map_descent.h.
  void soft_start(RunRecord& record);
  // Descends until one iteration decreases the energy by less than `tolerance`, without remedies.
  // For intermediate degrees.
  SolveResult approach(double tolerance, RunRecord& record, Phase phase = Phase::Newton);
  // Descends to the documented stopping rules, with all remedies.
  SolveResult finish(RunRecord& record);
  // Returns none while a stall is being resolved: the steps then lead on from x(), or back to where
  // they began. May be called by setup.watch.
  std::optional<State> state() const;
  // Must be called before any step. Throws InvalidArgument for levels that the setup's quadrature
  // does not have.
  void resume(State state);
  // Computes a step from here and returns its record, to measure its cost. The step is not taken
  // and is in no trace.
  IterationRecord try_step();

  Vec x() const { return problem_.x(); }
  GlobalIndex variables() const { return problem_.variables(); }
  double constraint_residual() const { return problem_.constraint_residual(); }
  const RemedyUses& remedies() const { return remedies_.uses; }
  // Returns the number of faces proven injective, by depth of bisection, in all checks so far.
  std::vector<long> proven() const { return problem_.proven(); }

 private:
  DegreeProblem problem_;
  RemedyState remedies_;
  bool soft_started_ = false;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
