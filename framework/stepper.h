// One step of a descent method and the loop around them: what a method of one's own is made of.
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

#include "majorant/framework/line_search.h"
#include "majorant/framework/minimizer.h"
#include "majorant/framework/problem.h"
#include "majorant/framework/run_record.h"

namespace majorant {

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

  // -g.p relative to StoppingTest::scale() of the descent that runs, or to |E|.
  double relative_decrement(double energy, const IterationRecord& step) const;

  Evaluator evaluator_;
  StopCheck stop_;
  Vec gradient_;

 private:
  LineSearchOptions line_search_;
  double decrement_rule_;
  const StoppingTest* test_ = nullptr;  // of the descent that runs
  double distance_ = 0;                 // from where it began
};

// True where result.y may be a start; fills result.energy then, else status Infeasible, message and
// blocking elements. For loops of one's own around step(). Throws InvalidArgument for another
// number of unknowns, one that is not finite, and a problem without terms.
bool check_start(Evaluator& evaluator, SolveResult& result);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
