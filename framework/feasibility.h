// Feasibility checkers: conditions that every point of a line search must meet beside decreasing
// the energy.
//
// A checker sees the full unknowns x. It certifies: "feasible" is a proof (up to the documented
// model of arithmetic), "not feasible" may be mere caution. A checker is immutable and called from
// several threads: what it did it returns, and who asks adds it up (Evaluator::violation).
//
// A BarrierChecker also knows how to keep away from its limit, so that a bound is a constraint of
// the optimization and no wall at which runs stall:
//
//   const auto hold = [](ProblemBuilder& b, std::shared_ptr<const BarrierChecker> bound) {
//     b.add(bound);                                        // at every step
//     const TermId barrier = b.add(bound->barrier(), 1.0);
//     return BarrierMinimizer::of_bounds({{barrier, bound}});
//   };
//
// Not for equations, which are eliminated (constraint.h).
#pragma once

#include <cstddef>
#include <memory>
#include <string_view>
#include <vector>

#include "majorant/framework/energy_term.h"
#include "majorant/framework/types.h"

namespace majorant {

struct Verdict {
  bool feasible = true;
  double margin = 0;            // checker's own measure, larger is safer
  std::vector<Index> blocking;  // elements that fail, in increasing order
  // Elements proven by depth of bisection; empty for checkers that do not bisect.
  std::vector<long> proven;
};

// Entry by entry; either may have fewer of them.
inline void add_counts(std::vector<long>& sum, const std::vector<long>& more) {
  if (sum.size() < more.size()) sum.resize(more.size());
  for (std::size_t k = 0; k < more.size(); ++k) sum[k] += more[k];
}

struct StepBound {
  double step = 0;              // largest certified step
  std::vector<Index> blocking;  // elements that admit at most twice as much; empty: unrestricted
};

class FeasibilityChecker {
 public:
  virtual ~FeasibilityChecker() = default;
  virtual std::string_view name() const = 0;
  virtual Verdict check(VecIn x) const = 0;
  // Largest s' <= s such that x + t d is feasible for all 0 <= t < s', given that x is feasible. A
  // checker that cannot certify paths returns s: its check() at the end point then decides. Solvers
  // throw InvalidArgument, with the name, for an answer that is negative or NaN.
  virtual StepBound max_step(VecIn x, VecIn d, double s) const = 0;
};

// The barrier grows to infinity towards the limit; while its weight falls, minima of the sum run
// along a path inside the feasible set to the constrained minimum (interior points, [NW06]
// Sec. 19.6). A start outside is led inside by relaxed bounds. parametrize() does the same for what
// MapExtension::add() is given (map_extension.h). Not for what has no derivatives: a
// FeasibilityChecker alone, where runs end "held at the limit of the feasible set".
class BarrierChecker : public FeasibilityChecker {
 public:
  // Finite where check() says feasible, and ever larger towards the limit: sums of -log(room).
  virtual std::shared_ptr<const EnergyTerm> barrier() const = 0;
  // The same bound, its limit moved so far that x keeps clear of it (by a tenth of it, say), and no
  // farther; never stricter than this one.
  virtual std::shared_ptr<const BarrierChecker> relaxed(VecIn x) const = 0;
};

// How far a point violates a bound, as an energy: what leads a start inside, and tells whether
// there is an inside.
//
//   struct Below final : ViolationMeasure {
//     std::shared_ptr<const EnergyTerm> violation(double margin) const override {
//       return make_term<1>("below 1", Cells{{0}}, [=](Index, const auto& z) {
//         auto missing = z[0] - 1.0 + margin;  // g = 1 - z
//         if (missing <= 0) missing = 0.0;
//         return missing * missing;
//       });
//     }
//   };
//
// BarrierMinimizer::of_bounds() asks bounds that are one beside a BarrierChecker. Other bounds are
// relaxed and tightened instead, which ends without an answer where bounds hold each other back.
class ViolationMeasure {
 public:
  virtual ~ViolationMeasure() = default;
  // max(0, margin - g)^2 of the rooms g that the bound wants positive, finite wherever g is. The
  // elements of the bound's barrier(), with one room each.
  virtual std::shared_ptr<const EnergyTerm> violation(double margin) const = 0;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
