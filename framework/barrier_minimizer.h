// Minimizes a problem while the weight of its barriers falls to 0: inequalities and bounds then end
// where they hold exactly, to a tolerance. The interior point method of [NW06] Sec. 19.6.
//
//   auto barrier = make_term<1>("x0 > 1", Cells::Zero(1, 1), [](Index, const auto& z) {
//     using std::log;
//     return -log(z[0] - 1.0);
//   });
//   const TermId id = builder.add(barrier, 1.0);
//   problem = builder.build();
//   const BarrierResult result = BarrierMinimizer({id}).run(problem, y0);
//
// A barrier is any term that is +inf outside of the feasible set and grows like -log of the
// distance to its boundary: Bounds::barrier(), Inequality::barrier() (terms/), or one that belongs
// to a FeasibilityChecker of the problem. With E the other terms and B the barriers, each with the
// weight it has in the problem, phases minimize E + mu B for falling mu by Newton's method. The
// last one has
//     m mu <= tolerance max(1, |E|)
// with m the sum of the weights of all elements of the barriers, which for convex problems and -log
// g bounds what E is above its constrained minimum. A constraint with multiplier l ends at the
// distance mu / l from its boundary. Not for equality constraints: eliminate them (constraint.h);
// nor for starts on the boundary: they must be inside, but for a BarrierChecker's bounds
// (of_bounds(); feasibility.h has the code). A start that does not meet such bounds is first led
// inside: by minima of their violation, which is what Bounds and Inequality measure
// (feasibility.h), else by barriers of bounds relaxed as far as the point needs it, tightened as it
// comes nearer.
#pragma once

#include <vector>

#include "majorant/framework/feasibility.h"
#include "majorant/framework/newton.h"

namespace majorant {

struct BarrierOptions {
  // m mu / max(1, |E|) of the first phase: [NW06] Sec. 19.3 starts near it.
  double first_gap = 0.1;
  // The factor of mu from one phase to the next. [NW06] Sec. 19.3 has 0.2; Newton's method follows
  // a smaller one.
  double fall = 0.1;
  // m mu / max(1, |E|) of the last phase: bounds with multipliers near 1 then end within 1e-8.
  double tolerance = 1e-8;
  // A phase but the last ends with a decrease of at most so many m mu: what the next fall of mu
  // changes is larger.
  double centred = 0.1;
  // The options of every phase; the stopping rules hold in the last one, max_iterations counts the
  // steps of all.
  NewtonOptions newton = {};
};

// The run at one value of mu.
struct BarrierPhase {
  double mu = 0;
  double gap = 0;      // m mu
  double energy = 0;   // E where it ended
  double barrier = 0;  // B there
  int iterations = 0;
  Status status = Status::Failed;  // MaxIterations, too, where it was left early on purpose
};

// A bound of the problem, among its checkers, and its barrier() among its terms.
struct HeldBound {
  TermId barrier;
  std::shared_ptr<const BarrierChecker> bound;
};

// energy: E; energies of `iterations`: E + mu B. Iterations that led a start inside come before
// those of the phases.
struct BarrierResult : SolveResult {
  std::vector<BarrierPhase> phases;
};

class BarrierMinimizer final : public Minimizer {
 public:
  explicit BarrierMinimizer(std::vector<TermId> barriers, BarrierOptions options = {});
  // Other barriers than those of bounds: `more`. Throws InvalidArgument for a bound that is null.
  static BarrierMinimizer of_bounds(std::vector<HeldBound> bounds, std::vector<TermId> more = {},
                                    BarrierOptions options = {});

  // y0: strictly inside, but for the bounds. Status::Infeasible names what it violates, or says
  // that the violation of the bounds has a minimum that is not 0, by how much and where; for bounds
  // that are convex nothing is feasible then. Status::Stalled where no way inside was found, which
  // proves nothing. Throws InvalidArgument for ids that the problem does not
  // have, and for bounds that are none of its checkers.
  BarrierResult run(const Problem& problem, Vec y0, RunObserver* observer = nullptr) const;
  SolveResult minimize(const Problem& problem, Vec y0, RunObserver* observer) const override {
    return run(problem, std::move(y0), observer);
  }

 private:
  std::vector<TermId> barriers_;  // those of bounds_ first
  std::vector<HeldBound> bounds_;
  BarrierOptions options_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
