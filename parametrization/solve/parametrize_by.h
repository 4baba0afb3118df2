// parametrize() by other rules than its own, of a part of a map, or from where an earlier run was:
// for measurements of what a rule is worth, for what solves on the way to a solve, and for several
// processes. A part of the facade: what it is made of does not include this.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "majorant/parametrization/maps/map_part.h"
#include "majorant/parametrization/solve/degree_solver.h"
#include "majorant/parametrization/solve/parametrize.h"
#include "majorant/parametrization/solve/pin_homotopy.h"
#include "majorant/parametrization/solve/solver_rules.h"

namespace majorant {

// Does what parametrize() does from a start, whose rules are SolverRules{}. record outlives the
// call.
ParametrizationResult parametrize_by(const SolverRules& rules, const BezierMap& start,
                                     const ParametrizationOptions& options, RunRecord& record);

// The state of a run, to go on from later, also on another number of processes.
struct RunState {
  std::shared_ptr<const BezierTriangleSpace> space;  // over the faces of this process
  Vec x;                  // its control points, as NormalizedStart has them
  bool entering = false;  // on the way into the energy's domain
  DegreeSolver::State solver;
  double initial_value = 0;  // ParametrizationResult's
  int iterations = 0;        // of this run
};

// Tells how often a run keeps its state, and who takes it.
struct Keeping {
  int every = 0;  // iterations; 0: never
  // Called after so many iterations and where a limit ends the run, on all ranks together. Where
  // there is no state to go on from, after the next one that has: the way around a stall has none.
  std::function<void(const RunState&)> keep;
};

// Does what parametrize() does, from a start that meets its pins, for the part of a map that this
// rank has; collective. start, options: of the part (NormalizedStart says what each rank has). The
// result's map is this rank's, its measures are MapPart::measure()'s, the rest is of the whole map;
// the record of rank 0 decides when to stop. from: where an earlier run of the same start and
// options was, none: at the start; Error(Unreadable) where that is not injective.
ParametrizationResult parametrize_part(std::shared_ptr<const MapPart> part, const BezierMap& start,
                                       const ParametrizationOptions& options, RunRecord& record,
                                       const Keeping& keeping = {},
                                       const std::optional<RunState>& from = {});

// The solver that leads starts to their pins (pin_homotopy.h). record outlives it.
PinSolver pin_solver(RunRecord& record, const SolverRules& rules = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
