// Bounds lower <= x <= upper on single unknowns: a barrier, and a checker that limits steps.
//
//   const double none = std::numeric_limits<double>::infinity();
//   Vec lower = Vec::Zero(60), upper = Vec::Constant(60, none);
//   const Bounds bounds(lower, upper);
//   const TermId barrier = builder.add(bounds.barrier(), 1.0);
//   builder.add(bounds.checker());
//   problem = builder.build();
//   y0 = problem.reduce(bounds.interior(x));
//   SolveResult result = BarrierMinimizer({barrier}).minimize(problem, y0, {});
//
// Every accepted point is inside; BarrierMinimizer (framework/barrier_minimizer.h) ends at the
// bounds where they hold the minimum, to its tolerance. parametrize() takes checker() as well
// (MapExtension::add()), and leads a start inside that does not meet it. Not for unknowns that are
// fixed: those are eliminated (constraints/fixed_unknowns.h).
#pragma once

#include <memory>

#include "majorant/framework/feasibility.h"

namespace majorant {

class Bounds {
 public:
  // One for each of the full unknowns, -inf or +inf where there is none. Throws
  // Error unless lower < upper and both have the same size.
  Bounds(Vec lower, Vec upper);

  const Vec& lower() const { return lower_; }
  const Vec& upper() const { return upper_; }

  // -log(x - lower), -log(upper - x): an element for each finite bound. Supports every curvature:
  // all are the exact one, which is positive.
  std::shared_ptr<const EnergyTerm> barrier() const;
  // Feasible: strictly inside. Blocking "elements" are unknowns. Steps are limited exactly, but for
  // rounding. Its members throw InvalidArgument for another number of unknowns.
  std::shared_ptr<const BarrierChecker> checker() const;
  // x moved inside where it is not: at least `margin` away from a single bound, that part of the
  // gap between two. 0 < margin <= 1/2.
  Vec interior(Vec x, double margin = 0.1) const;

 private:
  Vec lower_, upper_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
