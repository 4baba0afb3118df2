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
// distance to its boundary. Examples are Bounds::barrier() and Inequality::barrier()
// (framework/terms/), and those that belong to a FeasibilityChecker of the problem. E are the other
// terms, B the barriers, each with its weight in the problem. Phases minimize E + mu B for falling
// mu by Newton's method. mu rises again if a phase is long or ends far from its minimum. If E + mu
// B has no minimum, mu falls and the run begins again. The last phase has
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
// in the same phases: after each phase l_e rises by r_e g_e, and r_e rises by a factor where g_e
// has not fallen. Near the equalities a phase ends with Newton's method on energy and equalities
// together, if both then hold. It factorizes the matrix of the augmented Lagrangian, and a few
// conjugate gradients find the multipliers. Otherwise a run has converged only if the gradient of E
// + mu B + l g vanishes beside its parts.
//
// Not for linear equalities: eliminate them (constraint.h). Where unknowns lie on manifolds,
// ManifoldProblem::minimize() (framework/terms/manifold_problem.h) takes the minimizer.
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
  // A phase other than the last ends when its decrease is at most this many mu (m mu for a
  // BarrierProblem of the caller): the next fall of mu changes more.
  double centred = 0.1;
  // The maximum number of phases. A run whose last phase still lowers E by more than the tolerance
  // is stalled.
  int most_phases = std::numeric_limits<int>::max();
  // The largest |g| of an equality at the end, divided by the norm of its derivative if that
  // exceeds 1.
  double equality_tolerance = 1e-10;
  // The rules by which relaxed bounds are tightened.
  BoundEntryRules entry = {};
  // The options of every phase. The stopping rules hold in the last phase; max_iterations limits
  // the steps of all phases together.
  NewtonOptions newton = {};
};

// The outcome of the run at one value of mu.
struct BarrierPhase {
  double mu = 0;
  double gap = 0;        // m mu
  double energy = 0;     // E at the end of the phase
  double barrier = 0;    // B at the end of the phase
  double violation = 0;  // the largest |g| of equalities at its end, relative as in
                         // equality_tolerance
  int iterations = 0;
  Status status = Status::Failed;  // MaxIterations also if the phase was cut short on purpose
};

// A bound: one of the problem's checkers, and its barrier(), one of the problem's terms.
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
  // Factors of the weights of barriers without a bound, and of all other terms.
  double other_barriers = 1, energy = 1;
  // The multipliers and penalties of equalities.
  TermChanges equalities = {};
};

struct BarrierEnergies {
  double energy = 0, barrier = 0;  // E, B
};

// A problem with barriers, and the point that a run has reached, as BarrierMinimizer uses them: for
// outer loops that rebuild the problem between steps.
class BarrierProblem {
 public:
  using Bounds = std::vector<std::shared_ptr<const BarrierChecker>>;
  virtual ~BarrierProblem() = default;

  virtual const Bounds& bounds() const = 0;
  // The problem of the present stage, and the ids of its barriers, those of bounds first.
  virtual Evaluator& evaluator() = 0;
  virtual std::vector<TermId> barriers() const = 0;
  // The terms of that problem that are equalities to hold; none if the problem cannot move().
  virtual std::vector<TermId> equalities() const { return {}; }
  // The present point: in the unknowns of the problem, and in those of the bounds and their terms.
  virtual Vec y() const = 0;
  virtual Vec point() const = 0;
  // E and B at the present point, each with its weight in the problem, whatever the stage.
  virtual BarrierEnergies energies() const = 0;
  // Returns m, estimated from the phases so far: the total growth of the barriers of `stage`, which
  // the present point meets, when their weight falls by the factor e. Returns 0 after a phase if m
  // is unknown; the next phase then ends like a last one.
  virtual double barrier_size(const BarrierStage& stage,
                              std::span<const BarrierPhase> phases) const = 0;

  virtual void enter(const BarrierStage& stage) = 0;
  // Returns whether move() and leave_saddle() work: a run can then begin anew, and its end is
  // tested for a saddle. Problems that are rebuilt between steps cannot.
  virtual bool may_move() const { return false; }
  // Continues from another point. `steps` iterations outside of descend() have led there.
  virtual void move(Vec /*y*/, int /*steps*/) {}
  // A place of the run, to return to. It needs the point, too: where unknowns are coordinates on
  // manifolds, their charts move with the run, and y alone belongs to no chart.
  struct Place {
    Vec y, point;
  };
  Place place() const { return {y(), point()}; }
  virtual void return_to(const Place& place) { move(place.y, 0); }
  // Moves down from a saddle of the present stage, along negative curvature. Returns whether the
  // point was a saddle and a lower point was found.
  virtual bool leave_saddle() { return false; }
  // Takes Newton steps until the rules end them; max_iterations of the rules is set by the caller.
  virtual SolveResult descend(StoppingRules rules) = 0;
};

// `energy` is E; the energies of `iterations` are E + mu B. Iterations that led a start inside come
// before those of the phases.
struct BarrierResult : SolveResult {
  std::vector<BarrierPhase> phases;
  PathEnd end = PathEnd::Ended;  // None: after most_phases
  // l of E + sum_e l_e g_e, for each equality in the order of the problem's terms, one number an
  // element. If equalities depend on each other, the multipliers are one choice of many. If the run
  // ends before its first phase, they are those of the start (0 unless the start sets them).
  std::vector<Vec> multipliers;
  double violation = 0;  // BarrierPhase::violation at y
  // The weights of barriers, multipliers and penalties at the end: y minimizes
  // problem.with(states), and Sensitivity takes both.
  TermChanges states;
};

class ManifoldProblem;
class MovingChart;

class BarrierMinimizer final : public Minimizer {
 public:
  // The ids may be empty if the problem has equalities alone.
  explicit BarrierMinimizer(std::vector<TermId> barriers, BarrierOptions options = {});
  // more: barriers that belong to no bound. Throws InvalidArgument for a bound that is null.
  static BarrierMinimizer of_bounds(std::vector<HeldBound> bounds, std::vector<TermId> more = {},
                                    BarrierOptions options = {});

  // y0 must lie strictly inside all barriers but those of bounds; it may violate bounds and
  // equalities. Status::Infeasible: the message names what y0 violates, or the violation of the
  // bounds has a minimum that is not 0, and the message says by how much and where. If the bounds
  // are convex, no point is feasible then. Status::Stalled: no way inside was found, which proves
  // nothing. Equalities are Infeasible in the same way if their violation has a minimum that is not
  // 0, while barriers cost at most a hundredth of it; the gradient of that violation is at most
  // 1e-4 of the sum of the absolute values of its parts. Throws InvalidArgument for ids that the
  // problem does not have, for bounds that are none of its checkers, and for equalities with a
  // weight other than 1.
  BarrierResult run(const Problem& problem, Vec y0, RunObserver* observer = nullptr) const;
  // Runs on a BarrierProblem of the caller. Of options.newton only the stopping rules are used.
  static BarrierResult run(BarrierProblem& problem, const BarrierOptions& options);
  SolveResult minimize(const Problem& problem, Vec y0, RunObserver* observer) const override {
    return run(problem, std::move(y0), observer);
  }

 private:
  friend class ManifoldProblem;  // ManifoldProblem::minimize()
  BarrierResult run(const Problem& problem, MovingChart& chart, Vec y0,
                    RunObserver* observer) const;

  std::vector<TermId> barriers_;  // those of bounds_ first
  std::vector<HeldBound> bounds_;
  BarrierOptions options_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
