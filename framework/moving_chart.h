// Unknowns of a problem that are coordinates in a chart which follows a run: those of points on
// manifolds, whose base points move after each step.
//
//     MovingChart none;                          // unknowns that are no coordinates: nothing moves
//     ChartDescent descent(stepper, none, observer);
//     descent.begin(y0, energy);
//     stepper.descend(descent, rules);           // descent.result
//
// A chart that moves to a point keeps the coordinates of that point: y and the energy there are
// the same in both charts.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "majorant/framework/problem.h"
#include "majorant/framework/run_record.h"
#include "majorant/framework/stepper.h"

namespace majorant {

// The base class is the chart of unknowns that are no coordinates. Coordinates here are the full
// unknowns of the problem.
class MovingChart {
 public:
  using Terms = std::vector<std::pair<TermId, std::shared_ptr<const EnergyTerm>>>;
  using Checkers = std::vector<std::shared_ptr<const FeasibilityChecker>>;
  virtual ~MovingChart() = default;

  // Returns x, for which terms, bounds and checkers are made.
  virtual Vec expand(VecIn coordinates) const { return coordinates; }
  // Returns what observers get for y.
  virtual Vec shown(const Problem& /*problem*/, const Vec& y) const { return y; }
  // Returns the problem with its terms on the present chart.
  virtual Problem on(const Problem& problem) const { return problem; }
  // Return the checkers of the problem, and Problem::exchanged(), both by x.
  virtual Checkers checkers(const Problem& problem) const { return problem.checkers(); }
  virtual Problem exchanged(const Problem& problem, const Terms& terms, Checkers checkers) const {
    return problem.exchanged(terms, std::move(checkers));
  }

  // Moves to y of the evaluator's problem, which gets its terms on the chart there.
  virtual void move(Evaluator& /*evaluator*/, const Vec& /*y*/) {}
  // Moves to x, wherever the chart is, and gives it the coordinates of y.
  virtual void return_to(Evaluator& /*evaluator*/, const Vec& /*y*/, const Vec& /*x*/) {}
};

// A descent after each step of which the chart moves.
class ChartDescent final : public Descent {
 public:
  // All outlive it; observer may be null.
  ChartDescent(Stepper& stepper, MovingChart& chart, RunObserver* observer)
      : stepper_(stepper), chart_(chart), observer_(observer) {}
  // The energy is that of y, which is feasible.
  void begin(Vec y, double start_energy);

  Answer after_step(const StepResult& step) override;
  void set_fallback() override;
  void return_to_fallback() override;

 private:
  Evaluator& evaluator() { return stepper_.evaluator(); }

  Stepper& stepper_;
  MovingChart& chart_;
  RunObserver* observer_;
  Vec fallback_;  // x
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
