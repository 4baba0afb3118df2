// A problem of a barrier method that never changes, except for replaced bounds and the multipliers
// of its equalities.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "majorant/framework/barrier_minimizer.h"

namespace majorant {

class FixedBarrierProblem final : public BarrierProblem {
 public:
  // barriers: those of bounds first. problem and observer must outlive this object. Throws
  // InvalidArgument for a problem of several processes and for a start of another size.
  FixedBarrierProblem(const Problem& problem, const std::vector<TermId>& barriers, Bounds bounds,
                      const NewtonOptions& options, Vec y0, RunObserver* observer);

  const Bounds& bounds() const override { return bounds_; }
  Evaluator& evaluator() override { return stepper_.evaluator(); }
  std::vector<TermId> barriers() const override { return barriers_; }
  std::vector<TermId> equalities() const override { return equalities_; }
  Vec y() const override { return y_; }
  Vec point() const override { return problem_.expand(y_); }
  double barrier_size(const BarrierStage&, std::span<const BarrierPhase>) const override {
    return size_of_barriers_;
  }
  BarrierEnergies energies() const override;
  void enter(const BarrierStage& stage) override;
  bool may_move() const override { return true; }
  void move(Vec y, int steps) override {
    y_ = std::move(y);
    taken_ += steps;
  }
  bool leave_saddle() override;
  SolveResult descend(StoppingRules rules) override;

 private:
  double factor_of(TermId id, const BarrierStage& stage) const;

  const Problem& problem_;
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
