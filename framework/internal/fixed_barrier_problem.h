// A problem of a barrier method that never changes, except for replaced bounds and the multipliers
// of its equalities.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "majorant/framework/barrier_minimizer.h"
#include "majorant/framework/moving_chart.h"

namespace majorant {

class FixedBarrierProblem final : public BarrierProblem {
 public:
  // problem: on the chart, which is at y0. barriers: those of bounds first. All outlive it. Throws
  // InvalidArgument for the problem of several processes and a start of another size.
  FixedBarrierProblem(const Problem& problem, MovingChart& chart,
                      const std::vector<TermId>& barriers, Bounds bounds,
                      const NewtonOptions& options, Vec y0, RunObserver* observer);

  const Bounds& bounds() const override { return bounds_; }
  Evaluator& evaluator() override { return stepper_.evaluator(); }
  std::vector<TermId> barriers() const override { return barriers_; }
  std::vector<TermId> equalities() const override { return equalities_; }
  Vec y() const override { return y_; }
  Vec point() const override { return chart_.expand(problem_.expand(y_)); }
  double barrier_size(const BarrierStage&, std::span<const BarrierPhase>) const override {
    return size_of_barriers_;
  }
  BarrierEnergies energies() const override;
  void enter(const BarrierStage& stage) override;
  bool may_move() const override { return true; }
  void move(Vec y, int steps) override {
    y_ = std::move(y);
    taken_ += steps;
    chart_.move(evaluator(), y_);
  }
  void return_to(const Place& place) override {
    y_ = place.y;
    chart_.return_to(evaluator(), y_, place.point);
  }
  bool leave_saddle() override;
  SolveResult descend(StoppingRules rules) override;

 private:
  double factor_of(TermId id, const BarrierStage& stage) const;

  const Problem& problem_;  // its terms on a chart of before
  MovingChart& chart_;
  const std::vector<TermId>& barriers_;
  const Bounds bounds_;
  const std::vector<TermId> equalities_;
  const int most_iterations_;
  RunObserver* observer_;
  NewtonStepper stepper_;
  Vec y_;
  double size_of_barriers_ = 0;
  int taken_ = 0;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
