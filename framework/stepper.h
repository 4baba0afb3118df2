// One step of a descent method, the line search that every step takes, and the loop around them:
// what a method of one's own is made of.
//
//     NewtonStepper stepper(problem, options);
//     SolveResult result = stepper.minimize(y0, StoppingRules{});
//
// A method derives from Stepper, computes gradient and direction in advance() and leaves the rest
// to move_along(). Outer loops that change the problem between steps derive from Descent. Not for
// who only minimizes: that is a Minimizer (minimizer.h). Nor for methods that bring a line search
// of their own (ceres_minimizer.h).
#pragma once

#include <utility>
#include <vector>

#include "majorant/framework/minimizer.h"
#include "majorant/framework/problem.h"
#include "majorant/framework/run_record.h"

namespace majorant {

// The line search of all minimizers: stays inside the feasible set and goes towards the minimum of
// the line.
//
// An acceptable step comes first (certified, Armijo, halving), then the minimum of the parabola
// through E(0), E'(0) and E(s), as long as that pays. Positive semidefinite models overestimate
// curvature where they clamp it, and barriers flatten quickly, so steps well above 1 are common far
// from a minimum and in linearly converging tails; an evaluation costs a fraction of a
// factorization. Where a barrier is all of the energy, E ~ 1 / (1 + s / 3)^2, the parabola asks for
// s = 1.455 every time although E falls on and on: there the step is doubled instead. No curvature
// (Wolfe) condition: quasi-Newton methods skip pairs instead.

// The part of the predicted decrease that a step must achieve [NW06, Sec. 3.1].
inline constexpr double kArmijo = 1e-4;
// The part that is taken of a step that must not be reached, the largest certified one. Tuned by
// bench/tune.py line_search.boundary_fraction.
inline constexpr double kPartOfLimit = 0.9;

struct LineSearchOptions {
  double armijo = kArmijo;                  // accept s when E(s) <= E(0) + armijo * s * g.p, finite
  double boundary_fraction = kPartOfLimit;  // of the largest certified step, when that is the limit
  // The growth of a step per trial, at most, while the energy asks for more. Tuned by bench/tune.py
  // line_search.largest_growth.
  double largest_growth = 4;
  // Longer or shorter steps that are tried after the first one that is good enough. Tuned by
  // bench/tune.py line_search.most_improvements.
  int most_improvements = 8;
  // In the barrier phase, decrement > barrier_decrement |E(0)|, a step that the parabola would make
  // longer is doubled instead, as long as E falls by the part barrier_gain of it. Tuned by
  // bench/tune.py line_search.barrier_decrement.
  double barrier_decrement = 0.5;
  // Tuned by bench/tune.py line_search.barrier_gain.
  double barrier_gain = 0.1;
  // Give up below: steps of this part of y are lost in its rounding.
  double smallest_step = 1e-14;
};

class LineSearch {
 public:
  // Relative changes of an energy that its evaluations may not tell from rounding: 4500 unit
  // roundoffs; a sum of N terms of one sign loses about sqrt(N) of them.
  static constexpr double kResolution = 5e-13;
  // Along y + s p from a feasible y, all of size(); energy: E(y); decrement: -g.p >= 0, an energy.
  // The arguments must outlive the search, but `stop`. Evaluations poll `stop`, checkers their own.
  LineSearch(Evaluator& evaluator, const LineSearchOptions& options, const Vec& y, const Vec& p,
             double energy, double decrement, StopCheck stop = {});

  enum class Result {
    Accepted,
    Blocked,     // the largest certified step is below smallest_step
    NoDecrease,  // no acceptable step down to smallest_step
  };
  // Tries s = first at first, or what is certified of it.
  Result find(double first);  // Stopped: an abandoned search has found nothing

  double step() const { return best_step_; }      // accepted, 0 if none
  double energy() const { return best_energy_; }  // there
  int trials() const { return trials_; }          // evaluations of the energy
  const StepBound& bound() const {
    return bound_;
  }  // largest certified step <= max(1, first), what limits
  StepLimit limit() const { return limit_; }  // why no longer step was found, growth apart

 private:
  StepBound certified(double s) const;
  bool accept(double s);
  bool refuse(StepLimit why);
  double asked() const;
  bool grow(double target);
  bool stride();
  void improve();

  Evaluator& evaluator_;
  const LineSearchOptions& options_;
  const Vec &y_, &p_;
  StopCheck stop_;
  double energy_, decrement_;
  // An increase that is taken for rounding, 0 where the decrement is above kResolution. Below, the
  // step is taken if it does no visible harm, so that gradients can go below sqrt(epsilon).
  double rounding_;
  Vec x_, d_;
  StepBound bound_;
  StepLimit limit_ = StepLimit::None;
  double best_step_ = 0, best_energy_ = 0;
  int trials_ = 0;
};

// The state of a descent, and the hooks that its steps pass. The base class reports the energy that
// is minimized; a derived one may change the problem between steps and report another energy.
class Descent {
 public:
  virtual ~Descent() = default;

  SolveResult result;  // so far; result.y is where the next step begins
  double energy = 0;   // of the stepper's problem at result.y

  // Anything but Continue ends the descent with that status.
  struct Answer {
    Directive directive = Directive::Continue;
    StoppingTest::Since since = StoppingTest::Since::Same;
  };
  // Called after every step that was not abandoned; if it moved, result.iterations ends with its
  // record. May give the stepper another problem: result.y and energy are of that one afterwards.
  virtual Answer after_step(const StepResult& step);
  // The point reached is one to return to (Advice::fallback), or is returned to
  // (Stop::at_fallback).
  virtual void set_fallback();
  virtual void return_to_fallback();

 private:
  Vec fallback_;
  double fallback_energy_ = 0;
};

class Stepper {
 public:
  virtual ~Stepper() = default;

  using Outcome = StepResult::Outcome;
  using Step = StepResult;
  // Takes one step from y, which must be feasible; energy of y in, energy of the new y out. A step
  // that its stop check ends is abandoned. Throws InvalidArgument for another number of unknowns.
  Step step(Vec& y, double& energy);

  // Steps from y0 until a stopping rule, the observer or the stop check says so. An infeasible y0
  // is Status::Infeasible; outer loops that change the state of the problem call this repeatedly.
  // Throws as check_start().
  SolveResult minimize(Vec y0, const StoppingRules& rules, RunObserver* observer = nullptr);
  // Does the same from a point that is known to be feasible, `energy` its value.
  SolveResult descend_from(Vec y, double energy, const StoppingRules& rules,
                           RunObserver* observer = nullptr);
  // The loop of all of them: steps from descent.result.y until a rule or an answer ends it. What
  // after_step() throws leaves it, with descent.result as it is then.
  void descend(Descent& descent, const StoppingRules& rules);

  // The loop is about to stop because the energy hardly decreases: a method that left out a more
  // accurate model of late tries it in its next step.
  virtual void polish() {}

  Evaluator& evaluator() { return evaluator_; }
  const Evaluator& evaluator() const { return evaluator_; }

 protected:
  // decrement_rule: StoppingRules::decrement. stop: polled in every piece of a step.
  // Throws InvalidArgument for options that are no rules.
  Stepper(const Problem& problem, const LineSearchOptions& line_search, double decrement_rule,
          StopCheck stop);

  // The step of a problem that has unknowns. step.record.energy is that of y. May throw Stopped as
  // long as y and energy are as they were.
  virtual void advance(Vec& y, double& energy, Step& step) = 0;

  // Takes gradient_ at y and a direction p, size() entries each: checks that p is finite and no
  // ascent, applies the decrement rule, searches the line from the trial step `first`, moves y.
  void move_along(const Vec& p, double first, Vec& y, double& energy, Step& step);

  Evaluator evaluator_;
  StopCheck stop_;
  Vec gradient_;

 private:
  LineSearchOptions line_search_;
  double decrement_rule_;
};

// True where result.y may be a start; fills result.energy then, else status Infeasible, message and
// blocking elements. For loops of one's own around step(). Throws InvalidArgument for another
// number of unknowns, one that is not finite, and a problem without terms.
bool check_start(Evaluator& evaluator, SolveResult& result);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
