// Brings a start to its pins: hard pins may have targets anywhere, but the solver moves along maps
// that meet them already.
//
//   const MapOptions asked = with_targets(map, options.map);
//   if (!meets_pins(map, asked.pins))
//     map = pin_homotopy(map, asked, options.solve, pin_solver(record), record);
//
// Nothing is paid for a rigid motion: one pin is met by a translation. For more, the map is roughly
// optimized without them and moved by the similarity that fits best, which meets two. The others
// are pulled by springs that get stiffer; as soon as all can be set exactly, they are. What turns
// over at the end is untangled with the pins held. Where all at once get into each other's way,
// they go one after the other, in several orders.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "majorant/framework/run_record.h"
#include "majorant/maps/map_options.h"
#include "majorant/parametrization/solve/pins.h"

namespace majorant {

// A map as it is asked for, from a start of degree 1; none where no valid one was found. Made of
// parametrize(), which itself asks for ways to pins: pin_solver() (parametrize_by.h).
using PinSolver = std::function<std::optional<BezierMap>(const BezierMap& start, const MapOptions&,
                                                         const SolveOptions&)>;

// Throws Error(Infeasible) where pins (with targets) leave no map: two at one place, a face that
// they turn over, one on a fixed boundary; as require_pinned_once().
void require_no_contradiction(const BezierMap& start, const MapOptions& asked);

// Pins and handles, pulled from where a start has them. What is kept: seams, a fixed boundary, and
// with MapInjectivity::Global that nothing overlaps.
class PinHomotopy {
 public:
  // asked: with targets. Everything but `start` outlives this; the solver notes its steps in
  // `record`.
  PinHomotopy(const BezierMap& start, const MapOptions& asked, const SolveOptions& how,
              const PinSolver& solver, RunRecord& record)
      : start_(start), asked_(asked), how_(how), solver_(solver), record_(record), map_(start) {}

  const BezierMap& map() const { return map_; }
  // Solves at degree 1 with all pins and handles soft, at equal parts of their ways.
  void walk(int steps, double weight);
  // Does so one pin after the other: those that are there are held softly, the others go along.
  // False as soon as one does not arrive.
  bool walk_in_turn(const std::vector<Pin>& order, int steps, double weight);
  // Sets the pins exactly, if the map stays valid: nothing else moves.
  bool set_pins();
  // Sets them and moves the rest until the map is valid, if it can.
  bool untangle_with_pins();
  // Stiffer and stiffer springs until the pins can be set, or what turns over then be untangled.
  // False: there was no way, or a limit.
  bool hold();
  // Throws Error(Infeasible) that names the pin farthest from its target, or the limit.
  [[noreturn]] void refuse() const;
  bool going_on() const;  // no limit was met, nor Ctrl-C

 private:
  std::vector<Pin> on_the_way(double part) const;
  void pull(std::vector<Pin> to, double weight);
  std::optional<BezierMap> with_pins() const;
  bool is_valid(const BezierMap& map) const;

  BezierMap start_;
  const MapOptions& asked_;
  const SolveOptions& how_;
  const PinSolver& solver_;
  RunRecord& record_;
  BezierMap map_;
};

// A start that has all pins exactly at their targets. asked: with targets; the solver notes its
// steps in `record`. Throws Error(Infeasible) that says why the pins contradict each other, which
// could not be reached, or that a limit came first; otherwise as the solver.
BezierMap pin_homotopy(const BezierMap& start, const MapOptions& asked, const SolveOptions& how,
                       const PinSolver& solver, RunRecord& record);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
