// Minimizers: their interface, their results, and the rules by which they stop.
//
//   NewtonMinimizer newton;
//   const Minimizer& method = newton;
//   const SolveResult result = method.minimize(problem, y0, nullptr);
//   if (result.status != Status::Converged) std::cerr << result.message << "\n";
//
// The methods are in newton.h, first_order.h, barrier_minimizer.h and ceres_minimizer.h. Not for
// methods of one's own that give directions, nor for loops that do something between steps: these
// derive from Stepper, or drive one (stepper.h), which applies the stopping rules below.
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

// Says whether the exact Hessian at a point is positive definite, but for what is 1e-8 of its mean
// diagonal: there is a minimum then, else a saddle. NotTested where a term has no exact Hessian.
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
  Definite definite = Definite::NotTested;  // where Newton's method converged
};

class Minimizer {
 public:
  virtual ~Minimizer() = default;
  // y0: a feasible point of the reduced unknowns. observer: sees each step that is taken; may be
  // null. Never throws for numerical reasons.
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
// The loop of descents is Stepper::descend(). The test sees reports of steps only, no solver and no
// unknowns: the same reports give the same advice.

// Stopping formulas, with E_k the energy after iteration k, p the Newton direction, g the gradient:
//     decrement:   -g.p <= decrement |E_{k-1}|                                Converged, no step
//     taken small step:  E_{k-1} - E_k <= relative_decrease |E_{k-1}|
//       and -g.p <= tail_factor relative_decrease |E_{k-1}|: the exact Hessian gets another
//       chance after the first one, the tail_steps-th and each that follows is
//                                                                             Converged
//       if -g.p <= last_factor relative_decrease |E_{k-1}| and this is no plateau; steps with the
//       exact Hessian do not count, they converge quadratically to the decrement rule
//     idle: small step, or a certified step below stall_step, in stall_iterations successive
//       iterations: Converged if -g.p <= max(stall_decrement, tail_factor relative_decrease)
//       |E_{k-1}| - unless the certificate lets all these steps pass and this is a plateau, or -g.p
//       promises more than the last step of the tail may and the energy still falls visibly: then
//       it goes on -, else Stalled, and the result is the last point reached where the certified
//       step was at least fallback_step: what follows it led into a corner
//     plateau: with d the sum of the last w relative decreases, d' that of the w before, decreases
//       of at most `decrement` being none, q = d / d', for w = 1 or w = plateau_window (or half of
//       the steps there are)
//         d min(q / (1 - q), plateau_steps / w) > plateau_factor relative_decrease,
//       the second number where q >= 1: what is left if the decreases go on at their rate. -g.p
//       alone does not tell: a model that overestimates curvature makes it small, and so does a
//       saddle; w = 1 is for the latter, where decreases begin to grow. Where a factorization has
//       failed in the last stall_iterations steps, a Hessian was indefinite: times saddle_part
//     no step decreases the energy: Converged or Stalled by the same bound on -g.p; where the
//       problem has changed since, another try is left, after stall_iterations idle ones the last
//     the message of a stall names what shortened the idle steps (StepLimit): the feasible set, the
//       energy's domain, or neither, where the energy does not fall as its derivatives promise
//     unbounded: an energy below -1e100 max(1, |E_0|): Failed, a minimum does not exist
//     vanished: |E_{k-1}| and -g.p are at most s, and the energy does not fall as -g.p promises, or
//       -g.p is at most s / 100: Converged. E_{k-1} stands for max(|E_{k-1}|, s) in all of these
//       rules, where
//         s = 1e-14 max(energy_scale, |E_j| of the last ten iterations),
//       about what cancellation leaves of terms of that size: an energy that is 0 at its minimum
//       has no scale of its own there
// The decrement rule itself is applied inside a step, which it spares (Stepper::move_along).
//
// EnergyScale::Value is what these rules say. With EnergyScale::Decrease
//     max(G / 100, r |E_{k-1}|, s),
//     G = min(E_0 - E_{k-1} - g.p, -g.p (1 + |y_{k-1} - y_0| / |p|)^2)
// stands for |E_{k-1}|. G is what the run has gained, or would cost along p over the distance that
// it has come, whichever is less, since a start far away has an energy without meaning at the
// minimum; r = min(1, 5e-13 / relative_decrease) says where decreases are rounding. Neither a
// constant in the energy nor units nor the origin of the unknowns change when a run ends.
enum class EnergyScale { Value, Decrease };

struct StoppingRules {
  // The energies of maps are means of densities: their values are what decreases are compared with.
  EnergyScale scale = EnergyScale::Decrease;
  // Tuned by bench/tune.py stopping.relative_decrease.
  double relative_decrease = 1e-6;
  // -g.p is twice what is left, and that is 5 decreases where each step leaves 5/6.
  double tail_factor = 10;
  // bench/tolerance.py finds ten times -g.p left in valleys as curved as those of long strips.
  double last_factor = 0.1;
  // Such small steps that end a run: the first is followed by a step with the exact Hessian; 1
  // where Hessians never become exact.
  int tail_steps = 2;
  // The multiple of relative_decrease that may be left at the end; held by
  // tests/campaigns/plateaus.py.
  double plateau_factor = 2;
  // The factor of the same where Hessians are indefinite: runs pass saddles with decreases of 1e-7.
  // Tuned by bench/tune.py stopping.saddle_part.
  double saddle_part = 0.01;
  // Steps in each of the two sums; held by tests/campaigns/plateaus.py.
  int plateau_window = 12;
  // Foreseen at most: the iterations of a run, max_iterations.
  double plateau_steps = 1000;
  // Twice LineSearch::kResolution: no energy could tell what is left.
  double decrement = 1e-12;
  // Tuned by bench/tune.py stopping.stall_decrement.
  double stall_decrement = 1e-4;
  // Tuned by bench/tune.py stopping.stall_iterations.
  int stall_iterations = 3;
  // Stalls that are answered by a step with the exact Hessian, if the method has one, before the
  // run ends: -g.p of a model that is wrong says nothing about a minimum.
  int second_chances = 1;
  // Tuned by bench/tune.py stopping.stall_step.
  double stall_step = 1e-3;
  // 0: the result of a stall is the last point, which has the least energy. Maps take another one
  // (maps/newton_of_maps.h).
  double fallback_step = 0;
  // The size that energies of this kind have, where the start does not show it: a descent that goes
  // on from a minimum of 0.
  double energy_scale = 0;
  // Bounds the cost of a solve that nobody watches; parametrize() has no such limit.
  int max_iterations = 1000;
};

// For first-order methods, whose steps are many and small: only the decrement, or the end of what
// doubles resolve, counts as a minimum; a small certified step alone is no stall, since the metric
// may belong to a shape far away, and the result of a stall is the last point reached by progress.
StoppingRules first_order_rules();

// For a few steps inside an outer loop that moves on anyway: at most `steps`, ended by the first
// one that decreases the energy by no more than `relative_decrease`, which may be kAnyDecrease.
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
  bool fallback = false;  // the point reached is one to return to
};

class StoppingTest {
 public:
  // energy: of the start, which is the first fallback. Throws InvalidArgument for rules that are
  // NaN or numbers of steps below 1 (max_iterations: 0).
  StoppingTest(const StoppingRules& rules, double energy);

  // The least energy that decrements and decreases are relative to.
  double smallest_scale() const;
  // The one that they are relative to in a step from `energy`.
  double scale(double energy, const IterationRecord& step) const;

  // The stop where the iterations are used up.
  std::optional<Stop> before_step() const;

  // `Same` says that the next step minimizes the energy that this one did. A small step on a
  // problem that has changed since is no sign of a minimum.
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
  int held_ = 0;                       // of idle_: a certified step below stall_step
  StepLimit limit_ = StepLimit::None;  // of the idle steps
  std::deque<double> decreases_;       // relative, since the problem has changed, the last ones
  int definite_ = std::numeric_limits<int>::max() / 2;  // steps since a factorization failed
  int in_tail_ = 0;                                     // small steps with a small decrement
  int chances_ = 0;                                     // used
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
