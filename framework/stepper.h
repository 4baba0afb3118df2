// The building blocks of descent methods: one step, and the loop of steps.
//
//     NewtonStepper stepper(problem, options);
//     SolveResult result = stepper.minimize(y0, StoppingRules{});
//
// A method derives from Stepper, computes gradient and direction in advance() and leaves the rest
// to move_along(). Outer loops that change the problem between steps derive from Descent. Not for
// programs that only minimize: they use a Minimizer (minimizer.h). Not for methods with a line
// search of their own (ceres_minimizer.h).
#pragma once

#include <utility>
#include <vector>

#include "majorant/framework/line_search.h"
#include "majorant/framework/minimizer.h"
#include "majorant/framework/problem.h"
#include "majorant/framework/run_record.h"

namespace majorant {

// The state of a descent, and the hooks of its steps. The base class reports the minimized energy;
// a derived class may change the problem between steps and report another energy.
class Descent {
 public:
  virtual ~Descent() = default;

  SolveResult result;  // so far; result.y is where the next step begins
  double energy = 0;   // of the stepper's problem at result.y

  // The result of a hook: any directive but Continue ends the descent with its status.
  struct Answer {
    Directive directive = Directive::Continue;
    StoppingTest::Since since = StoppingTest::Since::Same;
  };
  // Called after every step that was not abandoned. If the step moved, result.iterations ends with
  // its record. May give the stepper another problem, and then sets result.y and energy for that
  // problem.
  virtual Answer after_step(const StepResult& step);
  // Called when the present point becomes the fallback (Advice::fallback), and when the descent
  // returns to the fallback (Stop::at_fallback).
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
  // Takes one step from y, which must be feasible; energy of y in, energy of the new y out. The
  // stop check of the step may abandon it. Throws InvalidArgument for another number of unknowns.
  Step step(Vec& y, double& energy);

  // Takes steps from y0 until a stopping rule, the observer or the stop check ends the run. An
  // infeasible y0 gives Status::Infeasible. Outer loops that change the state of the problem call
  // this repeatedly. Throws as check_start() does.
  SolveResult minimize(Vec y0, const StoppingRules& rules, RunObserver* observer = nullptr);
  // Does the same from a point that is known to be feasible, with its energy.
  SolveResult descend_from(Vec y, double energy, const StoppingRules& rules,
                           RunObserver* observer = nullptr);
  // The loop of all descents: takes steps from descent.result.y until a rule or a hook ends it.
  // Exceptions of after_step() pass through and leave descent.result as it is.
  void descend(Descent& descent, const StoppingRules& rules);

  // Called when the loop is about to stop because the energy hardly decreases. A method that has
  // not used a more accurate model recently uses it in the next step.
  virtual void polish() {}

  Evaluator& evaluator() { return evaluator_; }
  const Evaluator& evaluator() const { return evaluator_; }

 protected:
  // decrement_rule: StoppingRules::decrement. stop: polled in every piece of a step. Throws
  // InvalidArgument for options out of range.
  Stepper(const Problem& problem, const LineSearchOptions& line_search, double decrement_rule,
          StopCheck stop);

  // Takes a step of a problem that has unknowns. On entry step.record.energy is the energy of y.
  // May throw Stopped if y and energy are unchanged.
  virtual void advance(Vec& y, double& energy, Step& step) = 0;

  // Moves y along a direction p; gradient_ is the gradient at y, both of size() entries. Checks
  // that p is finite and no ascent, applies the decrement rule, and searches the line from the
  // trial step `first`.
  void move_along(const Vec& p, double first, Vec& y, double& energy, Step& step);

  // Returns -g.p relative to StoppingTest::scale() of the running descent, or to |E|.
  double relative_decrement(double energy, const IterationRecord& step) const;

  Evaluator evaluator_;
  StopCheck stop_;
  Vec gradient_;

 private:
  LineSearchOptions line_search_;
  double decrement_rule_;
  const StoppingTest* test_ = nullptr;  // of the running descent
  double distance_ = 0;                 // from its start
};

// Returns whether result.y can be a start, and fills in result.energy; otherwise fills in status
// Infeasible, message and blocking elements. For loops of your own around step(). Throws
// InvalidArgument for another number of unknowns, one that is not finite, and a problem without
// terms.
bool check_start(Evaluator& evaluator, SolveResult& result);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
