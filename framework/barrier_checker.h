// A checker that also knows how to keep away from its limit, so that a bound is a constraint of the
// optimization and no wall at which runs stall.
//
//   const auto hold = [](ProblemBuilder& b, std::shared_ptr<const BarrierChecker> bound) {
//     b.add(bound);                                        // at every step
//     const TermId barrier = b.add(bound->barrier(), 1.0);
//     return BarrierMinimizer::of_bounds({{barrier, bound}});
//   };
//
// The barrier grows to infinity towards the limit; while its weight falls, minima of the sum run
// along a path inside the feasible set to the constrained minimum (interior points, [NW06]
// Sec. 19.6). A start outside is led inside by relaxed bounds. parametrize() does the same for what
// MapExtension::add() is given (map_extension.h). Not for what has no derivatives: a
// FeasibilityChecker alone, where runs end "held at the limit of the feasible set".
#pragma once

#include <memory>

#include "majorant/framework/energy_term.h"
#include "majorant/framework/feasibility.h"

namespace majorant {

class BarrierChecker : public FeasibilityChecker {
 public:
  // Finite where check() says feasible, and ever larger towards the limit: sums of -log(room).
  virtual std::shared_ptr<const EnergyTerm> barrier() const = 0;
  // The same bound, its limit moved so far that x keeps clear of it (by a tenth of it, say), and no
  // farther; never stricter than this one.
  virtual std::shared_ptr<const BarrierChecker> relaxed(VecIn x) const = 0;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
