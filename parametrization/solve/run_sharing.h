// How a run of parametrize() shares its map: this class is one process, which has all of it.
// Several processes, each with a part of one map, bring their own
// (apps/mpi/parametrize_parts.h); the run itself reads as that of one.
//
//     RunSharing alone;
//     ParametrizationResult result = parametrize_shared(alone, start, options, record);
//
// Members that more than one process overrides are collective: all call them, in the same order.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "majorant/framework/run_record.h"
#include "majorant/maps/map_part.h"
#include "majorant/parametrization/solve/degree_solver.h"
#include "majorant/parametrization/solve/parametrize.h"

namespace majorant {

// The state of a run, to go on from later, also on another number of processes.
struct RunState {
  std::shared_ptr<const BezierTriangleSpace> space;  // over the faces of this process
  Vec x;                  // its control points, as NormalizedStart has them
  bool entering = false;  // on the way into the energy's domain
  DegreeSolver::State solver;
  double initial_value = 0;  // ParametrizationResult's
  int iterations = 0;        // of this run, counted by who keeps the state
};

class RunSharing {
 public:
  virtual ~RunSharing() = default;

  // The part of the map that is here; null: all of it.
  virtual std::shared_ptr<const MapPart> part() const { return nullptr; }
  // Where an earlier run of the same start and options was; null: this one begins at the start.
  virtual const RunState* from() const { return nullptr; }
  // Returns what ends a step, and prepares the record for its part in that.
  virtual StopCheck stop_of(RunRecord& record) const { return record.stop(); }

  // Throws Error where the map that the run begins with is not injective. NormalizedStart has asked
  // that of a whole one. depth: of bisection, at least.
  virtual void require_injective(const BezierMap& /*map*/, const RestShapes& /*rest*/,
                                 int /*depth*/) const {}
  // The mean density of the whole map.
  virtual double mean(const BezierMap& map, const RestShapes& rest, const EnergySum& energy) const;

  // Whether after_row() is to be called.
  virtual bool follows() const { return false; }
  // Called after every row of the trace, and where a limit has ended the run. state(): what another
  // run can go on from; none on the way around a stall.
  using CurrentState = std::function<std::optional<RunState>()>;
  virtual void after_row(const CurrentState& /*state*/) {}
  virtual void at_limit(const CurrentState& /*state*/) {}

  // Makes counts and distances of this process those of the whole map.
  virtual void account(ParametrizationResult& /*result*/) const {}
  // Measures the whole map, into `measures`; returns what is not proven of it, empty: nothing is
  // amiss.
  virtual std::string measure(const BezierMap& map, const EnergySum& energy, const StopCheck& stop,
                              MapMeasures& measures) const;
};

// Does what parametrize() does, from a start that meets its pins, with the part of a map that is
// here. start, options: of the part (NormalizedStart says what each process has). The result's map
// is of this part, the rest is what `sharing` makes of it.
ParametrizationResult parametrize_shared(RunSharing& sharing, const BezierMap& start,
                                         const ParametrizationOptions& options, RunRecord& record);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
