// The distribution of a map over processes. This class is one process with the whole map. For
// several processes, each with a part of one map, apps/mpi/parametrize_parts.h derives from it; the
// code of a run is the same.
//
//     RunSharing alone;
//     ParametrizationResult result = parametrize_shared(alone, start, options, record);
//
// Members that derived classes override for several processes are collective: all processes call
// them, in the same order.
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

// The state of a run from which another one continues later, also on another number of processes.
struct RunState {
  std::shared_ptr<const BezierTriangleSpace> space;  // over the faces of this process
  Vec x;                  // its control points, in NormalizedStart's coordinates
  bool entering = false;  // during DegreeSchedule::enter()
  DegreeSolver::State solver;
  double initial_value = 0;  // ParametrizationResult's
  int iterations = 0;        // of this run, counted by the owner of the state
};

class RunSharing {
 public:
  virtual ~RunSharing() = default;

  // Returns the part of the map that this process has; null: all of it.
  virtual std::shared_ptr<const MapPart> part() const { return nullptr; }
  // Returns the state of an earlier run with the same start and options; null: the run begins at
  // the start.
  virtual const RunState* from() const { return nullptr; }
  // Returns the check that ends a step, and prepares the record for its part in that.
  virtual StopCheck stop_of(RunRecord& record) const { return record.stop(); }

  // Throws Error if the first map of the run is not injective. NormalizedStart has tested a whole
  // map already. depth: of bisection, at least.
  virtual void require_injective(const BezierMap& /*map*/, const RestShapes& /*rest*/,
                                 int /*depth*/) const {}
  // Returns the mean density of the whole map.
  virtual double mean(const BezierMap& map, const RestShapes& rest, const EnergySum& energy) const;

  // Returns whether after_row() is to be called.
  virtual bool follows() const { return false; }
  // Called after every row of the trace, and when a limit has ended the run. state(): the state
  // from which another run continues; none while a stall is being resolved.
  using CurrentState = std::function<std::optional<RunState>()>;
  virtual void after_row(const CurrentState& /*state*/) {}
  virtual void at_limit(const CurrentState& /*state*/) {}

  // Replaces counts and distances of this process by those of the whole map.
  virtual void account(ParametrizationResult& /*result*/) const {}
  // Measures the whole map, into `measures`. Returns what is not proven of it; empty: nothing.
  virtual std::string measure(const BezierMap& map, const EnergySum& energy, const StopCheck& stop,
                              MapMeasures& measures) const;
};

// Does what parametrize() does, from a start that meets its pins, with this process' part of a map.
// start, options: of the part (NormalizedStart says what each process has). The result's map is
// that of the part; `sharing` provides the rest.
ParametrizationResult parametrize_shared(RunSharing& sharing, const BezierMap& start,
                                         const ParametrizationOptions& options, RunRecord& record);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
