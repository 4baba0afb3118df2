// The optimization of a map from its lowest degree to the one asked for, one degree after the other
// (or, when asked, directly at the highest): of a whole map, or of the part of one that a rank has.
//
//     DegreeSchedule schedule(setup, domain, start, degree, record);
//     SolveResult solved = schedule.raise_degree(energy);
//     schedule.elevate_to_last();
//     BezierMap map = schedule.map();
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "majorant/framework/run_record.h"
#include "majorant/maps/bezier_map.h"
#include "majorant/parametrization/solve/degree_solver.h"

namespace majorant {

class DegreeSchedule {
 public:
  using State = DegreeSolver::State;
  // Counts over all degrees, or of the last one that was optimized.
  struct Counts {
    std::vector<long> injectivity_tests;  // elements proven, by depth of bisection; of this rank
    RemedyUses remedies{};                // of the last degree
    GlobalIndex variables = 0;            // likewise
    double constraint_residual = 0;       // likewise, normalised
  };

  // map: the start, or where an earlier run was, normalised; degree: the last one. prepare (may be
  // empty) is called before a degree is optimized, with the map as it is there, and may change
  // `setup`. The other arguments outlive the schedule.
  DegreeSchedule(const DegreeSolver::Setup& setup, MapDomain& domain, BezierMap map, int degree,
                 RunRecord& record, std::function<void(const BezierMap&)> prepare = {});

  // Sets the state that map() came with, for the next solver of its degree.
  void resume(State state) { state_ = std::move(state); }
  // Leads a start of degree 1 at which the energy asked for is not finite (an exponential of
  // Tutte's map) to the minimum of one that is finite on every injective map.
  void enter();
  // energy: of map(). What is returned is of the last degree that was optimized; a limit may end
  // the run below the last one. Throws what DegreeSolver does, but Stopped.
  SolveResult raise_degree(double energy);
  // A run that a limit has ended is elevated all the same: valid, and of the promised degree.
  void elevate_to_last();

  const BezierMap& map() const { return map_; }
  const Counts& counts() const { return counts_; }
  bool entering() const { return entering_; }  // or stopped on that way
  // The state with which another run goes on from map(), or from x of a row that setup.watch is
  // shown; none on the way around a stall.
  std::optional<State> state() const;

 private:
  void minimize_gentle_energy();
  bool is_last() const { return map_.degree() == degree_; }
  SolveResult optimize();
  void elevate();

  const DegreeSolver::Setup& setup_;
  MapDomain& domain_;
  BezierMap map_;
  const int degree_;
  RunRecord& record_;
  std::function<void(const BezierMap&)> prepare_;
  Counts counts_;
  bool entering_ = false;
  const DegreeSolver* solver_ = nullptr;  // while it solves
  std::optional<State> state_;            // of an earlier run, or of the solver that a limit ended
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
