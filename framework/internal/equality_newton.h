// Newton's method on the energy and the equalities of a barrier method's run together. It converges
// quadratically near a minimum.
//
//     EqualityNewton newton(run, run.problem.equalities());
//     if (const auto minimum = newton.converge(state, 1e-9))
//       state.multipliers = minimum->multipliers;
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "majorant/framework/internal/barrier_run.h"
#include "majorant/framework/internal/equality_rows.h"

namespace majorant {

class EqualityNewton {
 public:
  // `run` must outlive this object. ids: the equalities of its problem.
  EqualityNewton(BarrierRun& run, std::vector<TermId> ids);

  struct Minimum {
    Vec multipliers;
    double violation = 0;
  };
  // Steps from the present point, with the multipliers and penalties of `state`. The run moves only
  // if the steps converge to a minimum. last_step: the length of a step, relative to the point,
  // after which no other is needed.
  std::optional<Minimum> converge(const EqualityState& state, double last_step);
  // Tells a minimum from a saddle at a point where the run has converged, by the exact Hessian
  // along the equalities, and sets result.definite.
  void test_minimum(const EqualityState& state);

 private:
  Definite factorize(const Vec& y, const EqualityRows& rows, const Vec& multipliers, Vec& penalties,
                     double shift, Vec& gradient, int& factorizations);

  BarrierRun& run_;
  const std::vector<TermId> ids_;
  std::shared_ptr<LinearSolver> solver_;
  std::optional<Problem> analysed_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
