// The equalities of a run of a barrier method: multipliers l and penalties r of
//     E + sum_e l_e g_e + r_e g_e^2 / 2
// that move after each phase, l by r g ([NW06] Sec. 17.3), until Newton's method on E and g
// together takes over, which converges quadratically.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "majorant/framework/internal/barrier_run.h"
#include "majorant/framework/internal/equality_rows.h"

namespace majorant {

class AugmentedLagrangian {
 public:
  // run outlives it.
  explicit AugmentedLagrangian(BarrierRun& run);

  // A problem without equalities has none of what follows.
  bool has_rows() const { return !ids_.empty(); }
  // Chooses the penalties by the derivatives at the point of the run; false where these are not
  // finite, as the result of the run says.
  bool begin();
  // The bounds themselves, and the equalities as they are weighted now.
  BarrierStage stage(double mu) const;
  // A phase has left what the penalties hold: they rise.
  void raise_penalties();

  // Follows a phase; is_settled: it ended by the rules of a last
  // one. Met: the point of the run satisfies the equalities to the tolerance and the energy is
  // stationary; Ended: no way leads there, as the result of the run says.
  enum class Progress { Going, Met, Ended };
  Progress after_phase(bool is_last, bool is_settled);
  // Says whether the point of the run, where it has converged, is a minimum: its result.definite.
  void test_minimum();
  double violation() const { return violation_; }
  // Returns true if the last phase hardly reduced the violation.
  bool is_idle() const { return idle_ > 0; }
  // sum_e r_e g_e^2 / 2 at the point of the run.
  double penalty_energy() const;
  // Multipliers by equality.
  std::vector<Vec> multipliers() const;

 private:
  bool polish(double last_step);
  Definite factorize(const Vec& y, const EqualityRows& rows, const Vec& multipliers, Vec& penalties,
                     double shift, Vec& gradient, int& factorizations);
  bool is_stationary() const;
  void move_multipliers(const EqualityRows& rows);
  void descend_violation();
  bool is_stationary_violation(double violation) const;
  Progress minimize_violation();
  void move_to(const Vec& y);

  BarrierRun& run_;
  const std::vector<TermId> ids_;
  EqualityState state_;
  double first_penalty_ = 0;  // of rows whose derivatives have the norm 1
  Vec first_penalties_;
  double violation_ = 0;
  int idle_ = 0;           // phases in a row that have hardly lessened it
  int restarts_ = 0;       // from a minimum of the violation
  bool is_least_ = false;  // the last descent of the violation has ended at a minimum of it
  Vec start_;              // of the first phase
  std::shared_ptr<LinearSolver> solver_;
  std::optional<Problem> analysed_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
