// One step of a descent method, and the loop around it that all methods share.
//
//     NewtonStepper stepper(problem, options);
//     SolveResult result = stepper.minimize(y0, StoppingRules{});
//
// A method derives from Stepper, computes gradient and direction in advance() and leaves the rest
// to move_along(). Outer loops that change the problem between steps call step() and ask a
// StoppingTest themselves. Not for methods that bring a line search of their own
// (ceres_minimizer.h).
//
// Of a problem that several processes have (Problem::partition) every rank runs the same loop on
// its part. What decides is agreed on: sums, the smallest bound, the directive of rank 0's
// observer. A stop check would end one rank and leave the others waiting: InvalidArgument, on all
// of them.
#pragma once

#include <utility>
#include <vector>

#include "majorant/framework/evaluator.h"
#include "majorant/framework/line_search.h"
#include "majorant/framework/minimizer.h"

namespace majorant {

class Stepper {
 public:
  virtual ~Stepper() = default;

  using Outcome = StepResult::Outcome;
  using Step = StepResult;
  // One step from y, which must be feasible; energy of y in, energy of the new y out. A step that
  // its stop check ends is abandoned. Throws InvalidArgument for another number of unknowns.
  Step step(Vec& y, double& energy);

  // Steps from y0 until a stopping rule, the observer or the stop check says so. An infeasible y0
  // is Status::Infeasible; outer loops that change the state of the problem call this repeatedly.
  // Throws as check_start().
  SolveResult minimize(Vec y0, const StoppingRules& rules, const Observer& observer = {});
  // The same from a point that is known to be feasible, `energy` its value.
  SolveResult descend_from(Vec y, double energy, const StoppingRules& rules,
                           const Observer& observer = {});

  // The loop is about to stop because the energy hardly decreases: a method that left out a more
  // accurate model of late tries it in its next step.
  virtual void polish() {}

  Evaluator& evaluator() { return evaluator_; }
  const Evaluator& evaluator() const { return evaluator_; }

 protected:
  const Partition& partition() const { return evaluator_.problem().partition(); }

  // decrement_rule: StoppingRules::decrement. stop: polled in every piece of a step.
  // Throws InvalidArgument for options that are no rules.
  Stepper(const Problem& problem, const LineSearchOptions& line_search, double decrement_rule,
          StopCheck stop);

  // The step of a problem that has unknowns. step.record.energy is that of y. May throw Stopped as
  // long as y and energy are as they were.
  virtual void advance(Vec& y, double& energy, Step& step) = 0;

  // From gradient_ at y and a direction p, size() entries each: checks that p is finite and no
  // ascent, applies the decrement rule, searches the line from the trial step `first`, moves y.
  void move_along(const Vec& p, double first, Vec& y, double& energy, Step& step);

  Evaluator evaluator_;
  StopCheck stop_;
  Vec gradient_;

 private:
  LineSearchOptions line_search_;
  double decrement_rule_;
};

// Whether result.y may be a start: fills result.energy there, else status Infeasible, message and
// blocking elements. For loops of one's own around step(). Throws InvalidArgument for another
// number of unknowns, one that is not finite, and a problem without terms.
bool check_start(Evaluator& evaluator, SolveResult& result);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
