// Brings a start to its pins: hard pins may have targets anywhere, but the solver moves along maps
// that meet them already.
//
//   const ParametrizationOptions resolved = with_targets(map, options);
//   if (!meets_pins(map, resolved.map.pins)) map = reach_pins(map, resolved, record);
//
// Nothing is paid for a rigid motion: one pin is met by a translation. For more, the map is roughly
// optimized without them and moved by the similarity that fits best, which meets two. The others
// are pulled by springs that get stiffer; as soon as all can be set exactly, they are. What turns
// over at the end is untangled with the pins held. Where all at once get into each other's way,
// they go one after the other, in several orders.
#pragma once

#include "majorant/parametrization/drive/parametrize.h"

namespace majorant {

// The same, where pins and handles without a target get the place that `start` has for them.
ParametrizationOptions with_targets(const BezierMap& start, ParametrizationOptions options);

// Pins this close to where the start has their vertex are there, up to rounding. Model units.
double pin_tolerance(VecIn start);

// Whether all pins are where the start has them. They must have targets and exist.
bool meets_pins(const BezierMap& start, const std::vector<Pin>& pins);

// Throws Error(Unsupported) for a vertex that is pinned twice.
void require_pinned_once(const SurfaceMesh& mesh, const std::vector<Pin>& pins);

// Throws Error(Infeasible) where pins (with targets) leave no map: two at one place, a face that
// they turn over, one on a fixed boundary; as require_pinned_once().
void require_no_contradiction(const BezierMap& start, const MapOptions& asked);

// Pins and handles, pulled from where a start has them. What is kept: seams, a fixed boundary, and
// with MapInjectivity::Global that nothing overlaps.
class PinPull {
 public:
  // options: with targets; options and record outlive this.
  PinPull(const BezierMap& start, const ParametrizationOptions& options, RunRecord& record)
      : start_(start), options_(options), record_(record), map_(start) {}

  const BezierMap& map() const { return map_; }
  // Solves at degree 1 with all pins and handles soft, at equal parts of their ways.
  void walk(int steps, double weight);
  // The same, one pin after the other: those that are there are held softly, the others go along.
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
  const ParametrizationOptions& options_;
  RunRecord& record_;
  BezierMap map_;
};

// A start that has all pins exactly at their targets. options: with targets. Throws
// Error(Infeasible) that says why the pins contradict each other, which could not be reached, or
// that a limit came first; otherwise as parametrize().
BezierMap reach_pins(const BezierMap& start, const ParametrizationOptions& options,
                     RunRecord& record);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
