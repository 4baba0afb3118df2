// Feasibility checkers: conditions that every point of a line search must meet beside decreasing
// the energy.
//
// A checker sees the full unknowns x. "Feasible" is a proof (up to the documented model of
// arithmetic); "not feasible" may be caution. A checker is immutable and called from several
// threads: it returns its counters, and the caller sums them (Evaluator::violation).
//
// A BarrierChecker also has a barrier that keeps points away from its limit. The bound is then a
// constraint of the optimization, where runs converge instead of stalling:
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
  double margin = 0;            // a measure of the checker's own; larger is safer
  std::vector<Index> blocking;  // elements that fail, in increasing order
  // The number of elements proven at each depth of bisection; empty for checkers that do not
  // bisect.
  std::vector<long> proven;
};

// Adds counts entry by entry; the two may have different lengths.
inline void add_counts(std::vector<long>& sum, const std::vector<long>& more) {
  if (sum.size() < more.size()) sum.resize(more.size());
  for (std::size_t k = 0; k < more.size(); ++k) sum[k] += more[k];
}

struct StepBound {
  double step = 0;              // largest certified step
  std::vector<Index> blocking;  // elements that admit at most twice that step; empty: unrestricted
};

class FeasibilityChecker {
 public:
  virtual ~FeasibilityChecker() = default;
  virtual std::string_view name() const = 0;
  virtual Verdict check(VecIn x) const = 0;
  // Returns the largest s' <= s such that x + t d is feasible for all 0 <= t < s', given that x is
  // feasible. A checker that cannot certify paths returns s; its check() at the end point then
  // decides. Solvers throw InvalidArgument, with the name, if the result is negative or NaN.
  virtual StepBound max_step(VecIn x, VecIn d, double s) const = 0;
};

// The barrier grows to infinity towards the limit. While its weight falls, the minima of the sum
// follow a path inside the feasible set to the constrained minimum (interior points, [NW06] Sec.
// 19.6). Relaxed bounds lead a start from outside to the inside. parametrize() does the same for
// bounds given to MapExtension::add() (map_extension.h). Not for conditions without derivatives:
// implement FeasibilityChecker alone, and runs end "held at the limit of the feasible set".
class BarrierChecker : public FeasibilityChecker {
 public:
  // A sum of -log(room): finite where check() accepts the point, growing without limit towards the
  // limit.
  virtual std::shared_ptr<const EnergyTerm> barrier() const = 0;
  // Returns this bound with its limit moved just so far that x keeps clear of it (by a tenth of the
  // limit, say); never stricter than this one.
  virtual std::shared_ptr<const BarrierChecker> relaxed(VecIn x) const = 0;
};

// The violation of a bound as an energy: its minimization leads a start inside, or shows that
// nothing is inside.
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
// BarrierMinimizer::of_bounds() uses it for a BarrierChecker that is also a ViolationMeasure. Other
// bounds are relaxed and tightened instead, which finds no answer if bounds hold each other back.
class ViolationMeasure {
 public:
  virtual ~ViolationMeasure() = default;
  // Returns the sum of max(0, margin - g)^2 over the rooms g, which the bound requires to be
  // positive; finite wherever g is. Its elements are those of barrier(), with one room each.
  virtual std::shared_ptr<const EnergyTerm> violation(double margin) const = 0;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
