// The optimization of a map degree by degree, from its lowest to the final one, or directly at the
// final one. It handles a whole map, or the part of one that a rank has.
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
  // Counters: sums over all degrees, or values of the last degree that was optimized.
  struct Counts {
    std::vector<long> injectivity_tests;  // elements proven, by depth of bisection; of this rank
    RemedyUses remedies{};                // of the last degree
    GlobalIndex variables = 0;            // of the last degree
    double constraint_residual = 0;       // of the last degree, normalized
  };

  // map: the start, or the state of an earlier run, normalized. degree: the final one. prepare:
  // called before a degree is optimized, with the current map; it may change `setup`; may be empty.
  // The other arguments outlive the schedule.
  DegreeSchedule(const DegreeSolver::Setup& setup, MapDomain& domain, BezierMap map, int degree,
                 RunRecord& record, std::function<void(const BezierMap&)> prepare = {});

  // Sets the state of an earlier run that belongs to the map, for the next solver of its degree.
  void resume(State state) { state_ = std::move(state); }
  // If the energy is not finite at a start of degree 1, as an exponential is at Tutte's map, moves
  // it to the minimum of an energy that is finite on every injective map.
  void enter();
  // Optimizes all remaining degrees. energy: of map(). Returns the result of the last degree that
  // was optimized; a limit may end the run below the final degree. Throws the errors of
  // DegreeSolver, except Stopped.
  SolveResult raise_degree(double energy);
  // Elevates the map to the final degree. A run that a limit has ended then still has a valid map
  // of the requested degree.
  void elevate_to_last();

  const BezierMap& map() const { return map_; }
  const Counts& counts() const { return counts_; }
  bool entering() const { return entering_; }  // during enter(), or stopped in it
  // Returns the state from which another run continues at map(), or at x of a row shown to
  // setup.watch; none while a stall is being resolved.
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
  std::optional<State> state_;            // of an earlier run, or of a solver that a limit ended
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
