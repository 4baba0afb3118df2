// Minimizers: their interface, their results, and the rules by which they stop.
//
//   NewtonMinimizer newton;
//   const Minimizer& method = newton;
//   const SolveResult result = method.minimize(problem, y0, nullptr);
//   if (result.status != Status::Converged) std::cerr << result.message << "\n";
//
// The methods are in newton.h, first_order.h, barrier_minimizer.h and ceres_minimizer.h. Not for
// methods of your own that provide directions, nor for loops that act between steps. These derive
// from Stepper, or drive one (stepper.h), which applies the stopping rules below.
#pragma once

#include <cstddef>
#include <deque>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "majorant/framework/problem.h"
#include "majorant/framework/run_record.h"

namespace majorant {

// The result of a test for a minimum: Yes if the exact Hessian plus 1e-8 of its mean diagonal is
// positive definite, No at a saddle, NotTested if a term has no exact Hessian.
enum class Definite { NotTested, Yes, No };
std::string_view definite_name(Definite definite);  // "yes", "no", "not tested"

struct SolveResult {
  Status status = Status::Failed;
  std::string message;
  Vec y;
  double energy = 0;
  double newton_decrement = 0;  // of the last step, an energy
  std::vector<IterationRecord> iterations;
  std::vector<Index> blocking;              // elements that limited the last step
  Definite definite = Definite::NotTested;  // at the point where Newton's method converged
};

class Minimizer {
 public:
  virtual ~Minimizer() = default;
  // y0: a feasible point of the reduced unknowns. observer: sees each accepted step; may be null.
  // Never throws for numerical reasons.
  virtual SolveResult minimize(const Problem& problem, Vec y0, RunObserver* observer) const = 0;
};

// The reasons why a descent ends: the stopping rules as a value, and the test that applies them
// step by step.
//
//     StoppingTest test(rules, energy);
//     while (!(stop = test.before_step())) {
//       const StepResult step = stepper.step(y, energy);
//       const Advice advice = test.after(step);
//       if ((stop = advice.stop)) break;
//       if (advice.polish) stepper.polish();
//       if (advice.fallback) best = y;
//     }
//
// Stepper::descend() is the loop of descents. The test sees only reports of steps, no solver and no
// unknowns: the same reports give the same advice.

// Stopping formulas, with E_k the energy after iteration k, p the Newton direction, g the gradient:
//     decrement:   -g.p <= decrement |E_{k-1}|                                Converged, no step
//     taken small step:  E_{k-1} - E_k <= relative_decrease |E_{k-1}|
//       and -g.p <= tail_factor relative_decrease |E_{k-1}|. The first such step is followed by a
//       step with the exact Hessian. From the tail_steps-th on it is         Converged
//       if -g.p <= last_factor relative_decrease |E_{k-1}| and this is no plateau. Steps with the
//       exact Hessian do not count: they converge quadratically to the decrement rule.
//     idle: a small step, or a certified step below stall_step, in stall_iterations successive
//       iterations: Converged if
//         -g.p <= max(stall_decrement, tail_factor relative_decrease) |E_{k-1}|,
//       else Stalled. The result of a stall is the last point where the certified step was at
//       least fallback_step; later points lie in a corner of the feasible set. The run goes on
//       instead of converging if none of these certified steps was below stall_step, and either
//       this is a plateau, or -g.p exceeds the bound of the last tail step while the energy still
//       falls visibly.
//     plateau: with d the sum of the last w relative decreases, d' the sum of the w before
//       (decreases of at most `decrement` count as 0), q = d / d', for w = 1 or w = plateau_window
//       (or half of the steps so far)
//         d min(q / (1 - q), plateau_steps / w) > plateau_factor relative_decrease,
//       with the second number if q >= 1: the decrease that is left if decreases go on at their
//       rate. -g.p alone does not show it, since it is small for a model that overestimates
//       curvature, and at a saddle. w = 1 is for saddles, where decreases begin to grow. The right
//       side is multiplied by saddle_part if a factorization failed, because of an indefinite
//       Hessian, in the last stall_iterations steps.
//     no step decreases the energy: Converged or Stalled by the same bound on -g.p. If the problem
//       has changed since, the run goes on, up to stall_iterations idle steps.
//     the message of a stall names what shortened the idle steps (StepLimit): the feasible set, the
//       energy's domain, or neither, if the energy does not fall as its derivatives promise
//     unbounded: an energy below -1e100 max(1, |E_0|): Failed, a minimum does not exist
//     vanished: |E_{k-1}| and -g.p are at most s, and the energy does not fall as -g.p promises, or
//       -g.p is at most s / 100: Converged. E_{k-1} stands for max(|E_{k-1}|, s) in all of these
//       rules, where
//         s = 1e-14 max(energy_scale, |E_j| of the last ten iterations), at most energy_scale > 0,
//       about the rounding of terms of that size: an energy that is 0 at its minimum has no scale
//       of its own there
// The decrement rule is applied inside a step, which it saves (Stepper::move_along).
//
// EnergyScale::Value applies the rules above. With EnergyScale::Decrease
//     max(G / 100, r |E_{k-1}|, s),
//     G = min(E_0 - E_{k-1} - g.p, -g.p (1 + |y_{k-1} - y_0| / |p|)^2)
// replaces |E_{k-1}|. G is the smaller of the energy gained so far and the energy along p over the
// distance travelled so far; a start far away has an energy without meaning at the minimum. r =
// min(1, 5e-13 / relative_decrease) is the scale at which decreases are rounding. The end of a run
// then depends neither on a constant in the energy, nor on units, nor on the origin of the
// unknowns.
enum class EnergyScale { Value, Decrease };

struct StoppingRules {
  // Energies of maps are means of densities, so Value suits them.
  EnergyScale scale = EnergyScale::Decrease;
  // Tuned by bench/tune.py stopping.relative_decrease.
  double relative_decrease = 1e-6;
  // -g.p is twice the remaining decrease, which is 5 decreases if each step leaves 5/6.
  double tail_factor = 10;
  // bench/tolerance.py finds that valleys as curved as those of long strips leave ten times -g.p.
  double last_factor = 0.1;
  // The number of small steps that ends a run; a step with the exact Hessian follows the first. 1
  // if Hessians never become exact.
  int tail_steps = 2;
  // The multiple of relative_decrease that may remain at the end; tested by
  // tests/campaigns/plateaus.py.
  double plateau_factor = 2;
  // The factor of plateau_factor if Hessians are indefinite: runs pass saddles with decreases of
  // 1e-7. Tuned by bench/tune.py stopping.saddle_part.
  double saddle_part = 0.01;
  // The number of steps in each of the two sums; tested by tests/campaigns/plateaus.py.
  int plateau_window = 12;
  // The number of future steps that the plateau rule assumes, at most: max_iterations of a run.
  double plateau_steps = 1000;
  // Twice LineSearch::kResolution: a smaller decrease cannot be measured.
  double decrement = 1e-12;
  // Tuned by bench/tune.py stopping.stall_decrement.
  double stall_decrement = 1e-4;
  // Tuned by bench/tune.py stopping.stall_iterations.
  int stall_iterations = 3;
  // The number of stalls that are followed by a step with the exact Hessian, if the method has one,
  // before the run ends: -g.p of a wrong model says nothing about a minimum.
  int second_chances = 1;
  // Tuned by bench/tune.py stopping.stall_step.
  double stall_step = 1e-3;
  // 0: the result of a stall is the last point, which has the least energy. Maps set another value
  // (maps/newton_of_maps.h).
  double fallback_step = 0;
  // The typical size of such energies, for a start that does not show it, such as a minimum of 0
  // from which a descent continues.
  double energy_scale = 0;
  // Limits the cost of an unattended solve; parametrize() has no such limit.
  int max_iterations = 1000;
};

// Rules for first-order methods, whose steps are many and small. Only the decrement, or the end of
// the resolution of doubles, counts as a minimum. A small certified step alone is no stall, since
// the metric may belong to a distant shape. The result of a stall is the last point reached by
// progress.
StoppingRules first_order_rules();

// Rules for a few steps inside an outer loop that moves on anyway. There are at most `steps`; the
// first that decreases the energy by at most `relative_decrease` (kAnyDecrease: any) is the last.
inline constexpr double kAnyDecrease = -std::numeric_limits<double>::infinity();
StoppingRules brief_rules(int steps, double relative_decrease);

struct Stop {
  Status status = Status::Failed;
  std::string message;
  bool at_fallback = false;  // the result is the fallback, not the last point
};

struct Advice {
  std::optional<Stop> stop;
  bool polish = false;    // Stepper::polish() before the next step
  bool fallback = false;  // the present point is the new fallback
};

class StoppingTest {
 public:
  // energy: of the start, which is the first fallback. Throws InvalidArgument for rules that are
  // NaN, or numbers of steps below 1 (max_iterations: below 0).
  StoppingTest(const StoppingRules& rules, double energy);

  // Returns the smallest scale of decrements and decreases.
  double smallest_scale() const;
  // Returns the scale of decrements and decreases of a step from `energy`.
  double scale(double energy, const IterationRecord& step) const;

  // Returns a stop if the iterations are used up.
  std::optional<Stop> before_step() const;

  // `Same` means that the next step minimizes the same energy as this one. After ProblemChanged, a
  // small step is no sign of a minimum.
  enum class Since { Same, ProblemChanged };
  Advice after(const StepResult& step, Since since = Since::Same);

 private:
  void remember(const StepResult& step, double decrease, Since since);
  bool on_plateau() const;
  bool falls_visibly() const;
  double remaining(std::ptrdiff_t window) const;

  StoppingRules rules_;
  double start_;                 // E_0
  std::deque<double> energies_;  // of the last points
  int steps_ = 0, idle_ = 0;
  int held_ = 0;                       // idle steps whose certified step is below stall_step
  StepLimit limit_ = StepLimit::None;  // of the idle steps
  std::deque<double> decreases_;       // the last relative ones since the problem changed
  int definite_ = std::numeric_limits<int>::max() / 2;  // steps since a factorization failed
  int in_tail_ = 0;                                     // small steps with a small decrement
  int chances_ = 0;                                     // used
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
