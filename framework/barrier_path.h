// Interior points ([NW06] Sec. 19.6): the minima of E + mu B along falling weights mu of a barrier
// B, and a way into bounds from a start that violates them.
//
//     const auto phase = [&](double mu) { return gap(mu) < e ? PathEnd::Arrived : PathEnd::None; };
//     const PathEnd end = follow_barrier({.first = 0.1}, phase);
//
// The caller provides the descent of a phase and the rule that ends it.
#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "majorant/framework/feasibility.h"

namespace majorant {

// The bounds that hold at a point: each bound itself, or a relaxed bound where the point violates
// it.
class HeldBounds {
 public:
  using Bounds = std::vector<std::shared_ptr<const BarrierChecker>>;

  HeldBounds() = default;
  explicit HeldBounds(Bounds bounds) : bounds_(std::move(bounds)) {}

  const Bounds& bounds() const { return bounds_; }
  // Returns the first bound that x violates, or null.
  const BarrierChecker* violated(VecIn x) const;
  // Holds the bounds that fit to x. Throws InvalidArgument, with the name of the bound, if a bound
  // relaxes to nothing or to a bound that x violates as well.
  void hold(VecIn x);
  // The held bounds, in the order of bounds(), and their barriers; none before hold().
  const Bounds& held() const { return held_; }
  const std::vector<std::shared_ptr<const EnergyTerm>>& barriers() const { return barriers_; }

 private:
  Bounds bounds_, held_;
  std::vector<std::shared_ptr<const EnergyTerm>> barriers_;
};

// The weights of the phases: phase k has the weight first fall^k.
struct BarrierWeights {
  double first = 0;
  // [NW06] Sec. 19.3 uses 0.2; Newton's method can follow faster falls.
  double fall = 0.1;
  int most_phases = std::numeric_limits<int>::max();
};

// The end of a path. Arrived: the remaining cost of the barrier is small enough. Ended: a limit was
// reached, or there is no minimum. None: the last phase is over, and neither holds.
enum class PathEnd { None, Arrived, Ended };

// phase(mu) minimizes with the weight mu, and returns None to go on.
template <class Phase>
PathEnd follow_barrier(const BarrierWeights& weights, const Phase& phase) {
  PathEnd end = PathEnd::None;
  for (int k = 0; k < weights.most_phases && end == PathEnd::None; ++k)
    end = phase(weights.first / std::pow(1 / weights.fall, k));  // exact if 1 / fall is an integer
  return end;
}

// The rules of a way into bounds: the bounds are relaxed as far as the start requires, and are
// tightened while their barriers push the point inside.
struct BoundEntryRules {
  // The relative decrease that ends a round; a round need not find its minimum exactly.
  double tolerance = 1e-3;
  // The least relative progress of the margin in a round; after less the weight grows. Bounds are
  // relaxed by a tenth, of which this is a small part.
  double least_progress = 0.02;
  // The factor by which the weight grows. It is large because a round costs only a few steps.
  double harder = 10;
  // Limits the cost of a way that leads nowhere.
  int most_rounds = 40;
};

enum class Entry { Inside, Stopped, Outside };

// point() returns the present point. descend(factor) continues from there under the held bounds,
// with the weight of their barriers multiplied by `factor`; it returns false if the run was
// stopped.
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
