// Minimizes a problem under constraints: while the weight of its barriers falls to 0, inequalities
// and bounds end where they hold exactly, to a tolerance (interior points, [NW06] Sec. 19.6); while
// the multipliers of its equalities settle, these end at 0 (augmented Lagrangian, [NW06]
// Sec. 17.3).
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
// distance to its boundary: Bounds::barrier(), Inequality::barrier() (framework/terms/), or one
// that belongs to a FeasibilityChecker of the problem. With E the other terms and B the barriers,
// each with the weight it has in the problem, phases minimize E + mu B for falling mu by Newton's
// method. mu rises again if a phase is long or ends far from its minimum. If E + mu B has no
// minimum, mu falls and the run begins again. The last phase has
//     m mu <= tolerance max(1, |E|)
// with m the sum of the weights of all elements of the barriers. For convex problems and -log g, m
// mu bounds the excess of E over its constrained minimum. The last decrease of E must be as small,
// since along the path E exceeds its minimum by a multiple of mu. A constraint with multiplier l
// ends at the distance mu / l from its boundary.
//
// Starts must be inside, except for bounds of a BarrierChecker (of_bounds(); feasibility.h has the
// code). A start that violates such bounds is led inside first, along minima of the violation that
// Bounds and Inequality measure (feasibility.h). Without such a measure it is led by barriers of
// relaxed bounds, which are tightened as the point approaches. A program that rebuilds the problem
// between steps passes it as a BarrierProblem.
//
// All terms of the problem that are equalities (equality(), framework/terms/equality.h) are held,
// from any start, by
//     E + mu B + sum_e l_e g_e + r_e g_e^2 / 2
// in the same phases: after each one l_e rises by r_e g_e, and r_e by a factor where g_e has not
// fallen. Near the equalities Newton's method on energy and equalities together (the
// matrix of the augmented Lagrangian is factorized, a few conjugate gradients find the multipliers)
// ends a phase, where both hold. Where it does not, a run has converged only if the gradient of
// E + mu B + l g vanishes beside its parts.
//
// Not for linear equalities: eliminate them (constraint.h).
#pragma once

#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "majorant/framework/barrier_path.h"
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
  // A phase but the last ends with a decrease of at most so many mu (m mu where the caller brings a
  // BarrierProblem): what the next fall of mu changes is larger.
  double centred = 0.1;
  // Phases at most; a run whose last one still lowers E by more than the tolerance is stalled.
  int most_phases = std::numeric_limits<int>::max();
  // The largest |g| of an equality at the end, relative to the norm of its derivative where that is
  // above 1.
  double equality_tolerance = 1e-10;
  // How relaxed bounds are tightened.
  BoundEntryRules entry = {};
  // The options of every phase; the stopping rules hold in the last one, max_iterations counts the
  // steps of all.
  NewtonOptions newton = {};
};

// The run at one value of mu.
struct BarrierPhase {
  double mu = 0;
  double gap = 0;        // m mu
  double energy = 0;     // E where it ended
  double barrier = 0;    // B there
  double violation = 0;  // the largest |g| of equalities there, as equality_tolerance has it
  int iterations = 0;
  Status status = Status::Failed;  // MaxIterations, too, where it was left early on purpose
};

// A bound of the problem, among its checkers, and its barrier() among its terms.
struct HeldBound {
  TermId barrier;
  std::shared_ptr<const BarrierChecker> bound;
};

// The temporary replacement of a problem's bounds: relaxed bounds, their violation, or the bounds
// themselves, with the weights of the minimized terms.
struct BarrierStage {
  struct Bound {
    std::shared_ptr<const BarrierChecker> checker;  // null: none is held
    std::shared_ptr<const EnergyTerm> term;         // its barrier, or the violation
    double weight = 1;                              // a factor of that of the bound's barrier
  };
  std::vector<Bound> bounds;  // one for each bound of the problem
  // Factors of the weights of barriers that belong to no bound, and of all other terms.
  double other_barriers = 1, energy = 1;
  // The multipliers and penalties of equalities.
  TermChanges equalities = {};
};

struct BarrierEnergies {
  double energy = 0, barrier = 0;  // E, B
};

// A problem with barriers and where a run on it is, as BarrierMinimizer leads it: for loops of
// one's own that build the problem anew between steps.
class BarrierProblem {
 public:
  using Bounds = std::vector<std::shared_ptr<const BarrierChecker>>;
  virtual ~BarrierProblem() = default;

  virtual const Bounds& bounds() const = 0;
  // The problem of the present stage; the barriers' ids there, those of bounds first.
  virtual Evaluator& evaluator() = 0;
  virtual std::vector<TermId> barriers() const = 0;
  // The terms of it that are equalities to hold; a problem that cannot move() has none.
  virtual std::vector<TermId> equalities() const { return {}; }
  // Where the run is: in the unknowns of the problem, and in those that bounds and their terms see.
  virtual Vec y() const = 0;
  virtual Vec point() const = 0;
  // E and B here, each with the weight that the problem has it with, whatever the stage.
  virtual BarrierEnergies energies() const = 0;
  // m, from the phases so far: how much the barriers of `stage`, which this point meets, grow in
  // all where their weight falls by the factor e; 0 after a phase: not known, the next one ends
  // like a last one.
  virtual double barrier_size(const BarrierStage& stage,
                              std::span<const BarrierPhase> phases) const = 0;

  virtual void enter(const BarrierStage& stage) = 0;
  // Returns whether move() and leave_saddle() work, so that a run can begin anew and its end be
  // tested: not where steps build the problem anew.
  virtual bool may_move() const { return false; }
  // Goes on from another point, to which `steps` iterations have led that descend() has not seen.
  virtual void move(Vec /*y*/, int /*steps*/) {}
  // Moves down from a saddle of the present stage, along negative curvature. Returns whether the
  // point is a saddle and there was a way.
  virtual bool leave_saddle() { return false; }
  // Newton steps from here until the rules say so, of which max_iterations is the caller's.
  virtual SolveResult descend(StoppingRules rules) = 0;
};

// energy: E; energies of `iterations`: E + mu B. Iterations that led a start inside come before
// those of the phases.
struct BarrierResult : SolveResult {
  std::vector<BarrierPhase> phases;
  PathEnd end = PathEnd::Ended;  // None: after most_phases
  // l of E + sum_e l_e g_e, by equality in the order of the problem's terms, a number an element;
  // where equalities depend on each other, one choice. Those of the start, which are 0 unless it
  // says otherwise, where the run ends before its first phase.
  std::vector<Vec> multipliers;
  double violation = 0;  // BarrierPhase::violation at y
  // The weights of barriers, multipliers and penalties at the end: y minimizes
  // problem.with(states), and Sensitivity takes both.
  TermChanges states;
};

class BarrierMinimizer final : public Minimizer {
 public:
  // BarrierMinimizer({}) is for equalities alone.
  explicit BarrierMinimizer(std::vector<TermId> barriers, BarrierOptions options = {});
  // Other barriers than those of bounds: `more`. Throws InvalidArgument for a bound that is null.
  static BarrierMinimizer of_bounds(std::vector<HeldBound> bounds, std::vector<TermId> more = {},
                                    BarrierOptions options = {});

  // y0: strictly inside, but for the bounds and equalities. Status::Infeasible names what it
  // violates, or says that the violation of the bounds has a minimum that is not 0, by how much and
  // where; for bounds that are convex nothing is feasible then. The gradient of the violation is at
  // most 1e-4 of the absolute values of its parts there. Status::Stalled where no way inside was
  // found, which proves nothing. Likewise for equalities: Infeasible where their violation has a
  // minimum that is not 0, beside barriers that cost at most a hundredth of it. Throws
  // InvalidArgument for ids that the problem does not have, for bounds that are none of its
  // checkers, and for equalities of another weight than 1.
  BarrierResult run(const Problem& problem, Vec y0, RunObserver* observer = nullptr) const;
  // The same from where a problem of the caller's is; options.newton: its stopping rules alone.
  static BarrierResult run(BarrierProblem& problem, const BarrierOptions& options);
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
