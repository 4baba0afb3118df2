// Moves a start to its pins: hard pins may have targets anywhere, but the solver only moves along
// maps that meet them.
//
//   const MapOptions placed = with_targets(map, options.map);
//   if (!meets_pins(map, placed.pins))
//     map = pin_homotopy(map, placed, options.solve, pin_solver(record), record);
//
// One pin is met by a translation. With more pins, the map is roughly optimized without them and
// moved by the similarity that fits best, which meets two. The others are pulled by springs that
// get stiffer until all can be set exactly. Triangles that invert at the end are untangled with the
// pins held. If all pins at once obstruct each other, they are moved one after the other, in
// several orders.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "majorant/framework/run_record.h"
#include "majorant/maps/map_options.h"
#include "majorant/parametrization/solve/pins.h"

namespace majorant {

// Returns a map with these options from a start of degree 1; none if no valid one was found.
// pin_solver() (parametrize_by.h) makes one from parametrize(), which itself uses this file.
using PinSolver = std::function<std::optional<BezierMap>(const BezierMap& start, const MapOptions&,
                                                         const SolveOptions&)>;

// Throws Error(Infeasible) if pins (with targets) exclude any map: two at one place, a face that
// they invert, one on a fixed boundary. Throws the errors of require_pinned_once().
void require_no_contradiction(const BezierMap& start, const MapOptions& options);

// The movement of pins and handles from where a start has them. It preserves seams, a fixed
// boundary and, with MapInjectivity::Global, the absence of overlaps.
class PinHomotopy {
 public:
  // options: with targets. All arguments but `start` outlive this object. The solver records its
  // steps in `record`.
  PinHomotopy(const BezierMap& start, const MapOptions& options, const SolveOptions& solve_options,
              const PinSolver& solver, RunRecord& record)
      : start_(start),
        options_(options),
        solve_options_(solve_options),
        solver_(solver),
        record_(record),
        map_(start) {}

  const BezierMap& map() const { return map_; }
  // Solves at degree 1 with all pins and handles soft, moved by equal fractions of their ways.
  void walk(int steps, double weight);
  // Does the same one pin after the other: pins that have arrived are held softly, the others move
  // along. Returns false as soon as one does not arrive.
  bool walk_in_turn(const std::vector<Pin>& order, int steps, double weight);
  // Sets the pins exactly if the map stays valid; nothing else moves.
  bool set_pins();
  // Sets the pins exactly and untangles the rest of the map, if possible.
  bool untangle_with_pins();
  // Solves with stiffer and stiffer springs until the pins can be set, or the result can be
  // untangled. Returns false if that fails or a limit is reached.
  bool hold();
  // Throws Error(Infeasible) that names the pin farthest from its target, or the limit.
  [[noreturn]] void refuse() const;
  bool may_continue() const;  // no limit is reached, and no Ctrl-C

 private:
  std::vector<Pin> on_the_way(double part) const;
  void pull(std::vector<Pin> to, double weight);
  std::optional<BezierMap> with_pins() const;
  bool is_valid(const BezierMap& map) const;

  BezierMap start_;
  const MapOptions& options_;
  const SolveOptions& solve_options_;
  const PinSolver& solver_;
  RunRecord& record_;
  BezierMap map_;
};

// Returns a start with all pins exactly at their targets. options: with targets. The solver records
// its steps in `record`. Throws Error(Infeasible) that says why the pins contradict each other,
// which one could not be reached, or that a limit came first. Throws the errors of the solver.
BezierMap pin_homotopy(const BezierMap& start, const MapOptions& options,
                       const SolveOptions& solve_options, const PinSolver& solver,
                       RunRecord& record);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
