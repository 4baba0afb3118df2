// The equalities of a run of a barrier method: multipliers l and penalties r of
//     E + sum_e l_e g_e + r_e g_e^2 / 2
// that move after each phase, l by r g ([NW06] Sec. 17.3), until Newton's method on E and g
// together takes over (equality_newton.h), which converges quadratically.
#pragma once

#include <vector>

#include "majorant/framework/internal/barrier_run.h"
#include "majorant/framework/internal/equality_newton.h"
#include "majorant/framework/internal/equality_rows.h"

namespace majorant {

class AugmentedLagrangian {
 public:
  // `run` must outlive this object.
  explicit AugmentedLagrangian(BarrierRun& run);

  // Returns whether the problem has equalities.
  bool has_rows() const { return !ids_.empty(); }
  // Chooses the penalties by the derivatives at the present point. Returns false, with the reason
  // in the result of the run, if these are not finite.
  bool begin();
  // Returns the bounds themselves, with the equalities at their present weights.
  BarrierStage stage(double mu) const;
  // Raises the penalties after a phase that left the region in which they hold.
  void raise_penalties();

  // Updates the multipliers after a phase. is_settled: the phase ended by the rules of a last
  // phase. Met: the present point satisfies the equalities to the tolerance and the energy is
  // stationary. Ended: no way leads to such a point; the result of the run has the reason.
  enum class Progress { Going, Met, Ended };
  Progress after_phase(bool is_last, bool is_settled);
  // Tests whether the point at which the run converged is a minimum, and sets result.definite.
  void test_minimum();
  double violation() const { return violation_; }
  // Returns true if the last phase hardly reduced the violation.
  bool is_idle() const { return idle_ > 0; }
  // Returns sum_e r_e g_e^2 / 2 at the present point.
  double penalty_energy() const;
  // Returns the multipliers by equality.
  std::vector<Vec> multipliers() const;

 private:
  bool is_stationary() const;
  void move_multipliers(const EqualityRows& rows);
  Progress minimize_violation();

  BarrierRun& run_;
  const std::vector<TermId> ids_;
  EqualityState state_;
  double first_penalty_ = 0;  // of rows whose derivatives have the norm 1
  Vec first_penalties_;
  double violation_ = 0;
  int idle_ = 0;                 // phases in a row that have hardly lessened it
  int restarts_ = 0;             // from a minimum of the violation
  BarrierProblem::Place start_;  // of the first phase
  EqualityNewton newton_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
