// Interior points ([NW06] Sec. 19.6): minima of E + mu B along falling weights mu of a barrier B,
// and the way inside of bounds from a start that does not meet them.
//
//     const auto phase = [&](double mu) { return gap(mu) < e ? PathEnd::Arrived : PathEnd::None; };
//     const PathEnd end = follow_barrier({.first = 0.1}, phase);
//
// Who follows a path brings the descent of a phase and the rule that ends it.
#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "majorant/framework/feasibility.h"

namespace majorant {

// The bounds that stand in place of others at a point: each itself, or relaxed where the point does
// not meet it.
class HeldBounds {
 public:
  using Bounds = std::vector<std::shared_ptr<const BarrierChecker>>;

  HeldBounds() = default;
  explicit HeldBounds(Bounds bounds) : bounds_(std::move(bounds)) {}

  const Bounds& bounds() const { return bounds_; }
  // The first that x does not meet; null: it meets all.
  const BarrierChecker* violated(VecIn x) const;
  // Holds these from here on. Throws InvalidArgument, with its name, where a bound is relaxed to
  // nothing, or to what x does not meet either.
  void hold(VecIn x);
  // The bounds that are held, in the order of bounds(); none before hold().
  const Bounds& held() const { return held_; }
  const std::vector<std::shared_ptr<const EnergyTerm>>& barriers() const { return barriers_; }

 private:
  Bounds bounds_, held_;
  std::vector<std::shared_ptr<const EnergyTerm>> barriers_;
};

// The weight of phase k: first fall^k.
struct BarrierWeights {
  double first = 0;
  // [NW06] Sec. 19.3 has 0.2; Newton's method follows further.
  double fall = 0.1;
  int most_phases = std::numeric_limits<int>::max();
};

// Arrived: what the barrier still costs is small enough. Ended: by a limit, or without a minimum.
// None: all phases are through.
enum class PathEnd { None, Arrived, Ended };

// phase(mu): minimizes with that weight; None to go on.
template <class Phase>
PathEnd follow_barrier(const BarrierWeights& weights, const Phase& phase) {
  PathEnd end = PathEnd::None;
  for (int k = 0; k < weights.most_phases && end == PathEnd::None; ++k)
    end = phase(weights.first / std::pow(1 / weights.fall, k));  // exact where 1 / fall is whole
  return end;
}

// Bounds are relaxed as far as the start needs it, and tightened as their barriers lead away from
// them.
struct BoundEntryRules {
  // Relative decrease that ends a round on the way inside, which only leads there.
  double tolerance = 1e-3;
  // The part of the margin by which a round comes nearer; else the weight grows. A small part of
  // the tenth by which bounds are relaxed.
  double least_progress = 0.02;
  // The factor by which a weight is raised; a round costs a few steps.
  double harder = 10;
  // Bounds the cost of what leads nowhere.
  int most_rounds = 40;
};

enum class Entry { Inside, Stopped, Outside };

// point(): where the run is. descend(factor): goes on from there with what is held, the weight of
// its barriers multiplied by the factor; false where the run was stopped.
template <class Point, class Descend>
Entry enter_bounds(HeldBounds& bounds, const BoundEntryRules& rules, const Point& point,
                   const Descend& descend) {
  double factor = 1, margin = -std::numeric_limits<double>::infinity();
  for (int round = 0; round < rules.most_rounds; ++round) {
    bounds.hold(point());
    if (!descend(factor)) return Entry::Stopped;
    const BarrierChecker* violated = bounds.violated(point());
    if (!violated) {
      bounds.hold(point());
      return Entry::Inside;
    }
    const double now = violated->check(point()).margin;
    if (!(now > margin + rules.least_progress * std::abs(now))) factor *= rules.harder;
    margin = now;
  }
  return Entry::Outside;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
